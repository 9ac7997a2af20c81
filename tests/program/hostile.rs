//! Scenes and results that once led to a panic, a false number or none: how each ends now. What
//! exhausted memory or had no end is in `limits.rs`.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::oracles::sound::text as has_no_undefined_number;

/// A load shared by contact nodes is passed on by none beyond its size, but for this.
const ROUNDING: f64 = 1e-9;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/hostile").join(name)
}

/// How a run ended: its exit status, both outputs, and its `result.json`.
struct Ended {
    status: Option<i32>,
    text: String,
    result: Value,
}

/// Runs a command on a case, with its files in a folder of its own.
fn ended(command: &str, name: &str, options: &str) -> Ended {
    let folder = TempDir::new().expect("a folder");
    let scene = case(&format!("{name}.json")).display().to_string();
    let mut args = vec![command, &scene, "--out", "o"];
    args.extend(options.split_whitespace());
    let output = run(folder.path(), &args);
    let text = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
    let file = folder.path().join("o/result.json");
    let result = std::fs::read(file)
        .map_or(Value::Null, |text| serde_json::from_slice(&text).expect("JSON"));
    Ended { status: output.status.code(), text: text.concat(), result }
}

/// A run that ends well, without a number that is undefined.
#[track_caller]
fn solved(name: &str, options: &str) -> Ended {
    let ended = ended("solve", name, options);
    assert_eq!(ended.status, Some(0), "{name} {options}: {}", ended.text);
    has_no_undefined_number(&ended.text);
    ended
}

/// A run that ends with `status` and says all the `words`.
#[track_caller]
fn fails(name: &str, options: &str, status: i32, words: &[&str]) -> Ended {
    let ended = ended("solve", name, options);
    assert_eq!(ended.status, Some(status), "{name} {options}: {}", ended.text);
    for word in words {
        assert!(ended.text.contains(word), "{name} {options}: {word:?} is not in {}", ended.text);
    }
    ended
}

/// The force of each contact node with its number.
fn forces(ended: &Ended) -> Vec<(u64, Option<f64>)> {
    let nodes = ended.result["contact"].as_array().expect("a list of contact nodes");
    nodes.iter().map(|c| (c["node"].as_u64().expect("a number"), c["force"].as_f64())).collect()
}

/// A contact node that is restrained along the normal, or nearly: it divided by a tiny component of
/// the normal, up to a force of 48,154 N under a load of 18.9 N.
#[test]
fn no_force_is_larger_than_the_load_where_a_restraint_is_near_the_normal() {
    let variants = ["printed", "tied", "stepped", "unilateral"];
    let runs = variants.map(|variant| format!("--variant {variant} --load-factor 0.01"));
    for (name, load) in [
        ("two-blocks-10y", 0.126),
        ("two-blocks-11y", 0.126),
        ("absurd-pressure-held-y", 0.189),
        ("panic-held-along-normal", 0.01),
    ] {
        for options in &runs {
            if name == "panic-held-along-normal" && options.contains("printed") {
                continue;
            }
            let forces = forces(&solved(name, options));
            let largest = forces.iter().filter_map(|(_, force)| *force).fold(0.0, f64::max);
            assert!(largest <= load * (1.0 + ROUNDING), "{name} {options}: {forces:?}");
        }
    }
    solved("absurd-pressure-held-y", "--variant unilateral --friction stick");
}

#[test]
fn a_force_that_restraints_leave_undetermined_is_a_dash() {
    for (name, options, of) in [
        ("panic-held-along-normal", "--variant unilateral --load-factor 0.01", &[4][..]),
        ("nan-pressure-held-along-normal", "--variant printed", &[4]),
        ("wrong-pressure-stick-held-node", "--variant unilateral --friction stick", &[10, 12]),
    ] {
        let forces = forces(&solved(name, options));
        let none = forces.iter().filter(|(_, force)| force.is_none()).map(|(node, _)| *node);
        assert_eq!(none.collect::<Vec<_>>(), of, "{name} {options}");
    }
}

#[test]
fn no_number_of_a_table_is_undefined() {
    solved("accuracy-inf", "--accuracy 1e-3");
    solved("inf-percent", "--variant unilateral");
    let several = ended("solve", "friction-inf", "--variant unilateral --geometry initial");
    assert_eq!(several.status, Some(4), "{}", several.text);
    has_no_undefined_number(&several.text);
    for (name, parameter) in [("trade-NaN", "mesh"), ("pivot-NaN", "solver")] {
        let ended = ended("trade", name, &format!("--runs 1 --only {parameter}"));
        assert_eq!(ended.status, Some(0), "{name}: {}", ended.text);
        has_no_undefined_number(&ended.text);
    }
}

/// Under `unilateral` the list is ordered; the listing takes it as it stands, and that is said.
#[test]
fn a_list_of_contact_nodes_that_is_no_walk_is_ordered_or_named() {
    let folder = TempDir::new().expect("a folder");
    let text = std::fs::read(case("cnt-shuffled.json")).expect("a case");
    let mut scene: Value = serde_json::from_slice(&text).expect("JSON");
    let said = "cnt does not follow its surface";
    scene["contact"]["cnt"] = json!([24, 23, 22, 21]);
    let mut in_order = |variant: &str| {
        scene["variant"] = variant.into();
        std::fs::write(folder.path().join("s.json"), scene.to_string()).expect("it is written");
        let output = run(folder.path(), &["solve", "s.json", "--json"]);
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    };
    let ordered = in_order("unilateral");
    for (name, what) in [
        ("cnt-shuffled", "nodes 21 and 22 share an edge and are listed apart"),
        ("cnt-node-twice", "node 21 is listed more than once"),
    ] {
        assert_eq!(solved(name, "--variant unilateral").result["u"], ordered["u"], "{name}");
        let text = solved(name, "--variant tied").text;
        assert!(text.contains(said) && text.contains(what), "{name}: {text}");
    }
    let output = run(folder.path(), &["solve", "s.json", "--variant", "tied"]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains(said));
    let one = solved("cnt-one-node", "--variant tied");
    assert!(one.result["contact"][0]["pressure"].is_null(), "a node bounds no contact edge");
    fails("cnt-one-node", "--variant unilateral", 2, &["can move", "contact node"]);
}

#[test]
fn the_order_of_the_list_decides_nothing_under_unilateral() {
    for name in ["cnt-order-decides", "cnt-order-decides-mortar"] {
        let [a, b] = ["a", "b"].map(|x| solved(&format!("{name}-{x}"), ""));
        assert_eq!(a.result["u"], b.result["u"], "{name}");
    }
}

#[test]
fn an_equilibrium_that_is_not_the_only_one_is_named() {
    for x in ["a", "b"] {
        let text = solved(&format!("rocking-two-answers-{x}"), "").text;
        assert!(text.contains("whether it is the only one is unknown"), "{text}");
        let words = ["there are several equilibria", "can move without work"];
        fails(&format!("rocking-two-answers-{x}"), "--geometry initial", 4, &words);
        let words = ["NOT THE ONLY ONE: node 11 can move without work"];
        fails(&format!("indifferent-verdict-{x}"), "", 4, &words);
    }
}

/// It reported a node as open that lay inside. Contact is measured in the shape reached, and sticking counts from
/// where the bodies touch, moved apart as rigid ones; the output says so.
#[test]
fn no_node_is_reported_open_that_lies_inside() {
    let found = solved("stick-penetrates", "");
    assert!(found.text.contains("The start is not determined by the overlap"), "{}", found.text);
    for node in found.result["contact"].as_array().expect("a list of contact nodes") {
        let inside = node["gap"].as_f64().map_or(0.0, |gap| -gap);
        assert!(inside < 1e-12, "{node}");
    }
}

/// The last change of shape was that of the surfaces alone: the top of a
/// block that rocks moves five times as far.
#[test]
fn the_last_change_of_shape_is_that_of_the_whole_bodies() {
    let ended = solved(
        "tall-block-rocks",
        "--variant unilateral --friction 0 --geometry current --coupling nts --load-steps 1",
    );
    let change = ended.result["equilibrium"]["shape_change"].as_f64().expect("a length");
    assert!((3e-10..3e-9).contains(&change), "{change:e}");
}

/// All forces are rounding, or nearly.
#[test]
fn an_overlap_without_a_load_comes_to_rest() {
    let options = "--variant unilateral --friction stick --coupling mortar --geometry current \
                   --load-steps 1 --load-factor ";
    for factor in ["0", "1e-12", "1e-9", "1"] {
        solved("overlap-without-load", &format!("{options}{factor}"));
    }
}

#[test]
fn a_stamp_below_its_target_is_refused() {
    fails("stamp-below-target", "", 2, &["no contact node faces the target"]);
}

/// Outputs had numbers of their own, 1 to R without the dropped nodes.
#[test]
fn dropped_nodes_leave_the_others_their_numbers() {
    let ended = solved("dropped-renumbers-output", "");
    assert!(ended.text.contains("Dropped: node 1 of the mesh"), "{}", ended.text);
    assert_eq!(ended.result["dropped"], json!([1]));
    let nodes: Vec<u64> = forces(&ended).iter().map(|(node, _)| *node).collect();
    assert_eq!(nodes, [6, 7, 8, 9, 10]);
}

/// A result of -1e308 in the file of ccx, whose energy would be no number.
#[cfg(unix)]
#[test]
fn an_absurd_result_of_calculix_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().expect("a folder");
    let ccx = folder.path().join("ccx");
    let results = case("calculix-1e308.dat");
    let script = format!(
        "#!/bin/sh\n[ \"$1\" = -v ] && echo This is Version 2.20 || cp '{}' job.dat\n",
        results.display()
    );
    std::fs::write(&ccx, script).expect("it is written");
    std::fs::set_permissions(&ccx, std::fs::Permissions::from_mode(0o755)).expect("executable");
    let ccx = ccx.display().to_string();
    let args = ["compare", "fig1", "--with", "calculix", "--ccx", &ccx];
    let output = run(folder.path(), &args);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("-1e308") && error.contains("is not understood"), "{error}");
}

/// Characters that colour, ring, delete, clear the screen and turn the text around.
const CONTROLS: &str = "\u{1b}[31m\u{7}\u{8}\u{9b}2J\u{202e}\u{2066}";

#[track_caller]
fn commands_no_terminal(what: &str, text: &str) {
    let harmful = |c: char| (c.is_control() && c != '\n') || "\u{202e}\u{2066}".contains(c);
    assert!(!text.contains(harmful), "{what}: {text:?}");
}

/// A title, the name of a group and the name of a file reach a terminal without what commands it;
/// JSON keeps the title.
#[test]
fn no_name_of_a_scene_commands_a_terminal() {
    let folder = TempDir::new().expect("a folder");
    let said = |args: &[&str]| {
        let output = run(folder.path(), args);
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8")).concat()
    };
    let mut scene = crate::common::embedded::scene_json("fig1");
    let title = format!("a{CONTROLS}zz");
    scene["title"] = title.as_str().into();
    let write = |name: &str, scene: &Value| {
        std::fs::write(folder.path().join(name), scene.to_string()).expect("it is written");
    };
    write("s.json", &scene);
    let name = format!("n{CONTROLS}.json");
    write(&name, &scene);
    for args in [
        &["solve", "s.json", "--out", "o"][..],
        &["audit", "s.json"],
        &["solve", &name, "--out", "o"],
        &["listing", "run", "c_cnt", &name],
        &["snapshot", "record", &name, "--out", "snapshot.json"],
        &["snapshot", "verify", "snapshot.json", "--scene", "fig1"],
        &["solve", "s.json", "--out", &title],
        &["solve", &title],
        &["snapshot", "verify", &title],
        &["solve", "s.json", &format!("--{title}")],
        &["solve", "s.json", "--variant", &title],
    ] {
        commands_no_terminal(&args.join(" "), &said(args));
    }
    let snapshot = std::fs::read(folder.path().join("snapshot.json")).expect("it was recorded");
    let json: Value = serde_json::from_slice(&snapshot).expect("JSON");
    assert_eq!(json["input"]["scene"]["title"], title.as_str());
    let group = format!("g{CONTROLS}");
    scene["materials"][group.as_str()] = json!({ "E": 1, "nu": 0 });
    write("g.json", &scene);
    let text = said(&["solve", "g.json"]);
    assert!(text.contains("where: g.json: materials.g"), "{text}");
    commands_no_terminal("a material", &text);
    let failure: Value =
        serde_json::from_slice(&run(folder.path(), &["solve", "g.json", "--json"]).stdout)
            .expect("JSON");
    assert_eq!(failure["failure"]["where"], format!("g.json: materials.{group}"));
}

/// Files that a scene's title goes into are of their format, whatever the title is.
#[test]
fn files_are_valid_whatever_a_title_is() {
    let folder = TempDir::new().expect("a folder");
    let mut scene = crate::common::embedded::scene_json("fig1");
    scene["title"] = format!("a{CONTROLS}<&>\nquit()").into();
    std::fs::write(folder.path().join("s.json"), scene.to_string()).expect("it is written");
    std::fs::copy(folder.path().join("s.json"), folder.path().join("a\nb.json")).expect("a copy");
    for args in [
        &["solve", "s.json", "--out", "."][..],
        &["mathcad", "export", "s.json", "--to", "mathcad", "--out", "s.xmcd"],
        &["mathcad", "export", "s.json", "--to", "octave", "--out", "s.m"],
        &["listing", "run", "Km", "a\nb.json", "--matrix-market", "s.mtx"],
        &["report", "s.json", "--out", "s.html"],
    ] {
        assert_eq!(run(folder.path(), args).status.code(), Some(0), "{args:?}");
    }
    let text = |name: &str| {
        let bytes = std::fs::read(folder.path().join(name)).expect(name);
        String::from_utf8_lossy(&bytes).into_owned()
    };
    for name in ["mesh.svg", "von_mises_stress.svg", "pressure.svg", "s.xmcd"] {
        roxmltree::Document::parse(&text(name)).unwrap_or_else(|why| panic!("{name}: {why}"));
    }
    let vtu = text("fields.vtu");
    let (head, _) = vtu.split_once("<AppendedData").expect("arrays follow the XML");
    roxmltree::Document::parse(&format!("{head}</VTKFile>")).expect("XML before the arrays");
    let forbidden = |c: char| c < ' ' && !"\n\t\r".contains(c);
    assert!(!text("s.html").contains(forbidden));
    assert!(text("s.mtx").lines().nth(2).is_some_and(|sizes| sizes.starts_with("26 26 ")));
    let octave = text("s.m");
    assert!(
        octave.lines().nth(1).is_some_and(|line| line.starts_with("% The listings")),
        "{octave}"
    );
}
