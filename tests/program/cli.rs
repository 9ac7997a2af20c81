//! The program from the outside: exit statuses, files, what stands on standard output and error.

use std::path::Path;
use std::process::Command;

use plane_contact::problem::modelling::Variant;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::limits::shell;

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("UTF-8")
}

#[track_caller]
fn succeeds(folder: &Path, args: &[&str]) -> String {
    let output = run(folder, args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout).to_string()
}

#[track_caller]
fn fails(folder: &Path, args: &[&str], status: i32, words: &[&str]) {
    let output = run(folder, args);
    assert_eq!(output.status.code(), Some(status), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty(), "a failure prints nothing on standard output");
    for word in words {
        assert!(text(&output.stderr).contains(word), "{word:?}: {}", text(&output.stderr));
    }
}

#[test]
fn q_and_v_say_less_and_more_on_standard_error_alone() {
    let folder = TempDir::new().expect("a folder");
    let streams = |args: &[&str]| {
        let output = run(folder.path(), args);
        (output.status.code(), [output.stdout, output.stderr].map(|bytes| text(&bytes).to_string()))
    };
    let solve = ["solve", "fig1", "--no-pictures"];
    let (status, [result, usual]) = streams(&solve);
    assert_eq!((status, &*usual), (Some(0), ""));
    for [more, less] in [["-v", "-q"], ["--verbose", "--quiet"]] {
        let (status, [same, stages]) = streams(&[&[more], &solve[..]].concat());
        assert_eq!((status, &same), (Some(0), &result));
        for stage in ["reading", "solving", "assessing", "writing"] {
            let (start, end) = (format!("{stage} ...\n"), format!("{stage}: "));
            assert!(stages.contains(&start) && stages.contains(&end), "{stages}");
        }
        assert_eq!(
            streams(&[&solve[..], &[less]].concat()),
            (Some(0), [result.clone(), "".into()])
        );
        assert_eq!(streams(&["audit", "fig1", "--claim", "P12", less]).1[1], "");
        let (status, [nothing, error]) = streams(&[less, "solve", "nowhere"]);
        assert_eq!((status, &*nothing), (Some(2), ""));
        assert!(error.starts_with("error: "), "{error}");
    }
    let pages = ["--man", "pages"];
    assert!(streams(&pages).1[1].contains("Written to"));
    assert_eq!(streams(&[&pages[..], &["-q"]].concat()).1[1], "");
    fails(folder.path(), &["solve", "-q", "-v"], 2, &["cannot be used with"]);
    fails(folder.path(), &["-q"], 2, &["there is no command"]);
    fails(folder.path(), &["--man", "x", "scene", "list"], 2, &["in place of a command"]);
    let first = succeeds(folder.path(), &["--help"]);
    assert_eq!((first.matches("--quiet").count(), first.matches("--verbose").count()), (1, 1));
    assert!(!succeeds(folder.path(), &["solve", "--help"]).contains("--quiet"));
    assert!(succeeds(folder.path(), &["guide", "options"]).contains("`-q`, `--quiet`"));
}

/// A command or a path may have any bytes; a path stands on one line.
#[cfg(target_os = "linux")]
#[test]
fn arguments_need_not_be_utf_8() {
    let folder = TempDir::new().expect("a folder");
    let line = "$P $(printf 'solv\\351'); echo $?; \
                $P scene copy two-blocks --out my >/dev/null; f=my/$(printf 'a\\351\\nforged').json; \
                cp my/scene.json \"$f\"; $P solve \"$f\" --no-pictures --out o >/dev/null; echo $?; \
                echo 5 > \"$f\"; $P solve \"$f\"; echo $?";
    let output = shell(folder.path(), line);
    assert_eq!(text(&output.stdout), "2\n0\n2\n");
    let error = text(&output.stderr);
    assert!(error.contains("where: my/a��forged.json: the scene file"), "{error}");
    assert!(!error.contains("panicked") && !error.contains("\nforged"), "{error}");
}

/// An error of JSON has no words of the library that reads it.
#[test]
fn errors_of_json_are_in_plain_words() {
    let folder = TempDir::new().expect("a folder");
    succeeds(folder.path(), &["snapshot", "record", "fig1", "--out", "s.json"]);
    let file = folder.path().join("s.json");
    let recorded: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    for (pointer, wrong, words) in [
        ("numbers/u/values", json!({"a": 1}), "values are numbers, or rows of a number"),
        ("numbers/u/values", json!([["a"]]), "values are numbers, or rows of a number"),
        ("options/variant", json!({"a": 1}), "\"a\" is none of"),
        ("decided_by_rounding", json!([5]), "the number 5 where an object is expected"),
        ("facts", json!([5]), "a list where an object is expected"),
    ] {
        let mut changed = recorded.clone();
        let (outer, name) = pointer.rsplit_once('/').unwrap_or(("", pointer));
        let outer = format!("/runs/stepped/{outer}");
        let place = changed.pointer_mut(outer.trim_end_matches('/')).expect(pointer);
        place[name] = wrong;
        std::fs::write(&file, changed.to_string()).unwrap();
        fails(
            folder.path(),
            &["snapshot", "diff", "s.json", "fig1"],
            2,
            &[words, ", line 1, column "],
        );
    }
    let mut changed = recorded.clone();
    changed["input"]["scene_sha256"] = json!("0".repeat(64));
    std::fs::write(&file, changed.to_string()).unwrap();
    fails(folder.path(), &["snapshot", "diff", "s.json", "fig1"], 2, &["was changed after it"]);
}

#[test]
fn solve_prints_tables_and_writes_pictures_and_data() {
    let folder = TempDir::new().unwrap();
    let tables = succeeds(folder.path(), &["solve", "fig1", "--variant", "tied"]);
    for words in [
        "variant tied",
        "Iterations",
        "Bodies",
        "In contact at the end: nodes 5, 6, 7, 9",
        "Contact surface",
        "Rounding\n",
        "Distance from the reference solution (unilateral, mortar, friction 0, initial",
        "Distance from the equilibrium under the scene's own friction",
    ] {
        assert!(tables.contains(words), "{words:?}: {tables}");
    }
    let out = folder.path().join("out/fig1-tied");
    let fields = ["von_mises_stress.svg", "von_mises_strain.svg", "mesh_error.svg"];
    for picture in ["mesh.svg", "pressure.svg"].into_iter().chain(fields) {
        let svg = std::fs::read_to_string(out.join(picture)).expect("the picture is there");
        roxmltree::Document::parse(&svg).expect("the picture is XML");
    }
    let vtu = head_of_vtu(&out);
    let vtu = roxmltree::Document::parse(&vtu).expect("the VTU file is XML before its arrays");
    let piece = vtu.descendants().find(|n| n.has_tag_name("Piece")).unwrap();
    assert_eq!(
        (piece.attribute("NumberOfPoints"), piece.attribute("NumberOfCells")),
        (Some("13"), Some("9"))
    );
    let count = std::fs::read_dir(&out).unwrap().count();
    assert_eq!(count, 8, "no temporary file is left");
}

/// Returns `fields.vtu` of a run's folder without its arrays.
fn head_of_vtu(out: &Path) -> String {
    let vtu = std::fs::read(out.join("fields.vtu")).unwrap();
    let text = String::from_utf8_lossy(&vtu);
    let (head, _) = text.split_once("<AppendedData").expect("arrays follow the XML");
    format!("{head}</VTKFile>")
}

#[test]
fn solve_leaves_out_pictures_and_estimates() {
    let folder = TempDir::new().unwrap();
    let solve = |more: &[&str]| succeeds(folder.path(), &[&["solve", "fig1"], more].concat());
    let all = solve(&["--out", "all"]);
    let [pictures, estimates] = ["no-pictures", "no-error-estimate"].map(|option| {
        let tables = solve(&["--out", option, &format!("--{option}")]);
        let out = folder.path().join(option);
        let result = std::fs::read_to_string(out.join("result.json")).unwrap();
        let result: Value = serde_json::from_str(&result).unwrap();
        (tables, out, result)
    });
    let files = |out: &Path| {
        let entries = std::fs::read_dir(out).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    assert_eq!(files(&pictures.1), ["fields.vtu", "result.json"]);
    assert_eq!(files(&estimates.1).len(), 7);
    assert_eq!(pictures.0.replace("no-pictures", "all"), all);
    assert!(head_of_vtu(&pictures.1).contains("\"mesh_error\""));
    assert!(!head_of_vtu(&estimates.1).contains("\"mesh_error\""));
    assert!(all.contains("Rounding\n") && !estimates.0.contains("Rounding\n"));
    assert!(estimates.0.contains("Distance from the reference solution"));
    assert_eq!(estimates.2.get("error_estimates"), None);
    assert_eq!(estimates.2["u"], pictures.2["u"]);
}

#[test]
fn json_is_result_json_and_nothing_else() {
    let folder = TempDir::new().unwrap();
    let printed = succeeds(folder.path(), &["solve", "fig1", "--json", "--out", "there"]);
    assert_eq!(printed, std::fs::read_to_string(folder.path().join("there/result.json")).unwrap());
    let result: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!((&result["scene"], &result["variant"]), (&"fig1".into(), &"stepped".into()));
    assert_eq!(result["reading"]["R7"], "stepped");
    let iterations = result["iterations"].as_array().unwrap();
    assert_eq!(iterations.len(), 20);
    for key in [
        "k",
        "in_contact",
        "dy",
        "max_displacement",
        "cycle",
        "eq1_residual",
        "target_force",
        "solve_residual",
    ] {
        assert!(iterations[0].get(key).is_some(), "{key}");
    }
    assert_eq!(iterations[1]["cycle"]["length"], 1);
    assert_eq!(result["u"].as_array().unwrap().len(), 13);
    let elements = result["elements"].as_array().unwrap();
    assert_eq!(elements.len(), 9);
    for key in ["n", "sigma", "epsilon", "von_mises_stress", "von_mises_strain"] {
        assert!(elements[0].get(key).is_some(), "{key}");
    }
}

#[test]
fn json_alone_writes_no_file_and_a_failure_is_json() {
    let folder = TempDir::new().unwrap();
    let printed = succeeds(folder.path(), &["solve", "fig1", "--json"]);
    let result: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!((&result["format"], &result["c_tll"]), (&1.into(), &0.001.into()));
    assert_eq!(result["scene_sha256"].as_str().map(str::len), Some(64));
    assert_eq!(result["materials"][1], serde_json::json!({"E": 210000.0, "nu": 0.3}));
    assert_eq!(result["nodes"][1], serde_json::json!([1.0, 0.02]));
    assert_eq!(result["elements"][0]["nodes"], serde_json::json!([1, 10, 2]));
    assert_eq!(result["elements"][8]["material"], 2);
    assert_eq!(result["arithmetic"]["solver"], "sparse-cholesky");
    assert!(printed.lines().count() > 100, "a line a fact");
    for args in [
        &["solve", "fig1", "--reading", "R4=eager", "--json"][..],
        &["listing", "run", "c_cnt", "fig1", "--reading", "R4=eager", "--json"],
    ] {
        let output = run(folder.path(), args);
        assert_eq!(output.status.code(), Some(3));
        let failure: Value = serde_json::from_str(text(&output.stdout)).unwrap();
        let failure = &failure["failure"];
        assert_eq!((&failure["exit_status"], &failure["line"]), (&3.into(), &18.into()));
    }
    let output = run(folder.path(), &["scene", "plan", "nowhere", "--json"]);
    let failure: Value = serde_json::from_str(text(&output.stdout)).unwrap();
    assert_eq!(
        (&failure["failure"]["kind"], &failure["failure"]["where"]),
        (&"input".into(), &"nowhere".into())
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "no file is written");
}

#[test]
fn a_scene_is_read_from_standard_input() {
    let folder = TempDir::new().unwrap();
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/fig1/scene.json");
    for command in [&["listing", "run", "c_cnt"][..], &["solve"]] {
        let output = Command::new(env!("CARGO_BIN_EXE_plane-contact"))
            .args(command)
            .args(["-", "--json"])
            .current_dir(folder.path())
            .stdin(std::fs::File::open(&golden).unwrap())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let printed = text(&output.stdout).replace("\"stdin\"", "\"fig1\"");
        assert_eq!(printed, succeeds(folder.path(), &[command, &["fig1", "--json"]].concat()));
    }
}

#[test]
fn fields_vtu_has_tensors_contact_units_and_where_it_is_from() {
    let folder = TempDir::new().unwrap();
    succeeds(folder.path(), &["solve", "fig1", "--out", "o", "--no-pictures"]);
    let head = head_of_vtu(&folder.path().join("o"));
    let vtu = roxmltree::Document::parse(&head).unwrap();
    let array = |name: &str| vtu.descendants().find(|n| n.attribute("Name") == Some(name)).unwrap();
    for (name, components, unit) in [
        ("stress", "9", "MPa"),
        ("strain", "9", "1"),
        ("contact_pressure", "1", "MPa"),
        ("gap", "1", "mm"),
        ("displacement", "3", "mm"),
    ] {
        let array = array(name);
        assert_eq!(array.attribute("NumberOfComponents"), Some(components), "{name}");
        let key = array.children().find(|n| n.has_tag_name("InformationKey")).unwrap();
        assert_eq!((key.attribute("name"), key.text()), (Some("UNITS_LABEL"), Some(unit)));
    }
    assert_eq!(array("in_contact").attribute("NumberOfComponents"), Some("1"));
    let data = vtu.descendants().find(|n| n.has_tag_name("CellData")).unwrap();
    assert_eq!(data.attribute("Tensors"), Some("stress"));
    let words = |name: &str| {
        let codes = array(name).text().unwrap().split_whitespace();
        let bytes: Vec<u8> = codes.map(|code| code.parse().unwrap()).collect();
        String::from_utf8(bytes).unwrap()
    };
    assert!(words("program").starts_with("plane-contact "));
    assert_eq!((words("run"), words("scene_sha256").len()), ("stepped".to_string(), 64));
}

#[test]
fn floats_read_back_to_the_same_bits() {
    let folder = TempDir::new().unwrap();
    let printed = succeeds(folder.path(), &["solve", "fig1", "--json"]);
    let result: Value = serde_json::from_str(&printed).unwrap();
    let scene = plane_contact::problem::scene::Scene::open("fig1").unwrap();
    let request = plane_contact::engine::Request::new(&scene);
    let solution = plane_contact::engine::solve(&request, &mut |_| ()).unwrap();
    for (n, u) in result["u"].as_array().unwrap().iter().enumerate() {
        assert_eq!(u[0].as_f64().unwrap().to_bits(), solution.u[2 * n].to_bits());
        assert_eq!(u[1].as_f64().unwrap().to_bits(), solution.u[2 * n + 1].to_bits());
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    for out in ["a", "b"] {
        succeeds(folder.path(), &["solve", "two-blocks", "--out", out]);
    }
    for entry in std::fs::read_dir(folder.path().join("a")).unwrap() {
        let name = entry.unwrap().file_name();
        let read = |out: &str| std::fs::read(folder.path().join(out).join(&name)).unwrap();
        assert!(read("a") == read("b"), "{name:?}");
    }
}

#[test]
fn c_cnt_prints_tables_and_json() {
    let folder = TempDir::new().unwrap();
    let tables = succeeds(folder.path(), &["listing", "run", "c_cnt", "fig1"]);
    assert!(tables.contains("Contact nodes (c_tll = 0.001)"), "{tables}");
    assert!(tables.contains("k_cnt: 8 of 13 rows are not zero"), "{tables}");
    let json: Value = serde_json::from_str(&succeeds(
        folder.path(),
        &["listing", "run", "c_cnt", "fig1", "--json"],
    ))
    .unwrap();
    assert_eq!(json["ct"], serde_json::json!([1, 2, 2, 3, 3]));
    assert_eq!(json["dy"], serde_json::json!([1, 1, 1, 0, 1]));
    assert_eq!(json["yt"].as_array().unwrap().len(), 5);
    let rows = json["k_cnt"].as_array().unwrap();
    assert_eq!(rows.len(), 13);
    assert!(rows.iter().all(|row| row.as_array().unwrap().len() == 4));
}

#[test]
fn km_writes_matrix_market() {
    let folder = TempDir::new().unwrap();
    let printed = succeeds(folder.path(), &["listing", "run", "Km", "fig1"]);
    succeeds(folder.path(), &["listing", "run", "Km", "fig1", "--matrix-market", "MJS.mtx"]);
    assert_eq!(printed, std::fs::read_to_string(folder.path().join("MJS.mtx")).unwrap());
    let mut lines = printed.lines().filter(|line| !line.starts_with("% "));
    assert_eq!(lines.next(), Some("%%MatrixMarket matrix coordinate real general"));
    let size: Vec<usize> = lines.next().unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
    assert_eq!((size[0], size[1]), (26, 26));
    let entries: Vec<Vec<&str>> = lines.map(|line| line.split(' ').collect()).collect();
    assert_eq!(entries.len(), size[2]);
    let digits =
        |entry: &str| entry.chars().take_while(|c| *c != 'e').filter(char::is_ascii_digit).count();
    assert!(entries.iter().all(|entry| digits(entry[2]) == 17));
    let free = succeeds(folder.path(), &["listing", "run", "Km", "fig1", "--coupled-by", "none"]);
    assert_ne!(free, printed);
}

#[test]
fn the_published_algorithm_failing_is_exit_status_3() {
    let folder = TempDir::new().unwrap();
    let args = ["listing", "run", "c_cnt", "fig1", "--reading", "R4=left-to-right"];
    let words =
        ["c_cnt, line 18", "This array index is invalid for this array.", "index of yt = 0"];
    fails(folder.path(), &args, 3, &words);
    fails(folder.path(), &["solve", "fig1", "--reading", "R4=eager"], 3, &["c_cnt, line 18"]);
    assert!(!folder.path().join("out").exists(), "nothing is written");
}

/// A stamp that touches nothing and that nothing holds in y: the matrix of the first iteration is
/// singular.
#[test]
fn a_singular_matrix_is_exit_status_3() {
    let folder = TempDir::new().unwrap();
    // Without a tolerance line 16 flags no node (C8), and with node 2.4 above the target nor do
    // lines 17 and 18.
    let scene = include_str!("../../golden/fig1/scene.json")
        .replace("\"c_tll\": 0.001", "\"c_tll\": 0.0")
        .replace("[8, 2.3, 0.032,", "[8, 2.3, 0.038,");
    std::fs::write(folder.path().join("c8.json"), scene).unwrap();
    for variant in Variant::OF_THE_PAPER.iter().map(|variant| variant.name()) {
        let words = ["iteration 1", "singular", "no node is in contact", "body \"2\""];
        fails(folder.path(), &["solve", "c8.json", "--variant", variant], 3, &words);
    }
}

#[test]
fn bad_input_is_exit_status_2_and_loses_no_file() {
    let folder = TempDir::new().unwrap();
    fails(
        folder.path(),
        &["solve", "nowhere.json"],
        2,
        &["nowhere.json", "strand, fig1, two-blocks"],
    );
    fails(folder.path(), &["solve", "fig1", "--reading", "R9=x"], 2, &["which no run takes"]);
    fails(
        folder.path(),
        &["solve", "fig1", "--reading", "R2=odd-ish"],
        2,
        &["none of odd, printed"],
    );
    fails(folder.path(), &["solve", "fig1", "--variant", "glued"], 2, &["glued"]);
    succeeds(folder.path(), &["solve", "two-blocks", "--out", "kept"]);
    let kept = std::fs::read(folder.path().join("kept/result.json")).unwrap();
    std::fs::write(folder.path().join("bad.json"), "{ \"plane\": 3 }").unwrap();
    fails(folder.path(), &["solve", "bad.json", "--out", "kept"], 2, &["field plane", "fix"]);
    assert_eq!(std::fs::read(folder.path().join("kept/result.json")).unwrap(), kept);
    std::fs::write(folder.path().join("file"), "").unwrap();
    fails(folder.path(), &["solve", "fig1", "--out", "file"], 2, &["cannot be written"]);
    // Before anything is run: this run would end with exit status 3.
    for option in ["--out", "--csv"] {
        let failing = ["solve", "fig1", "--reading", "R4=eager", option, "file"];
        fails(folder.path(), &failing, 2, &["file is a file"]);
    }
}

#[test]
fn a_change_of_a_scene_is_named_by_its_option() {
    let folder = TempDir::new().unwrap();
    for (change, what) in [
        ("--c-tll=nan", "NaN is no finite number"),
        ("--c-tll=inf", "inf is no finite number"),
        ("--c-tll=-1", "c_tll = -1 is negative"),
        ("--load-factor=nan", "NaN times the loads is no finite number"),
        ("--load-factor=inf", "inf times the loads is no finite number"),
        ("--load-factor=1e308", "1e308 times the loads is no finite number"),
        ("--iterations=0", "0 iterations are outside"),
    ] {
        let option = change.split('=').next().unwrap();
        let place = format!("where: {option}\n");
        fails(folder.path(), &["solve", "fig1", change], 2, &[what, &place]);
    }
}

/// No link is followed, and no pipe is written to: neither is replaced.
#[cfg(unix)]
#[test]
fn links_and_pipes_are_refused() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("real.mtx"), "old").unwrap();
    std::os::unix::fs::symlink("real.mtx", at("link.mtx")).unwrap();
    std::os::unix::fs::symlink("nowhere", at("dangling.mtx")).unwrap();
    let made = Command::new("mkfifo").arg(at("pipe")).status().expect("mkfifo");
    assert!(made.success());
    for (name, words) in [
        ("link.mtx", "it is a link"),
        ("dangling.mtx", "it is a link"),
        ("pipe", "it is no ordinary file"),
        ("/dev/null", "it is no ordinary file"),
    ] {
        let args = ["listing", "run", "Km", "fig1", "--matrix-market", name];
        let output = run(folder.path(), &args);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && error.contains(words), "{name}: {error}");
    }
    assert_eq!(std::fs::read_to_string(at("real.mtx")).unwrap(), "old");
    assert!(!at("nowhere").exists());
}

/// An output that would replace what the run reads is refused.
#[test]
fn no_output_replaces_an_input() {
    let folder = TempDir::new().unwrap();
    succeeds(folder.path(), &["scene", "copy", "fig1", "--out", "my"]);
    succeeds(folder.path(), &["snapshot", "record", "fig1", "--out", "s.json"]);
    let c_cnt = concat!(env!("CARGO_MANIFEST_DIR"), "/listings/c_cnt.txt");
    std::fs::copy(c_cnt, folder.path().join("l.txt")).unwrap();
    #[cfg(unix)]
    std::fs::hard_link(folder.path().join("s.json"), folder.path().join("t.json")).unwrap();
    for (line, file) in [
        #[cfg(unix)]
        ("snapshot verify s.json --report t.json", "t.json"),
        ("report my --out my/scene.json", "my/scene.json"),
        ("lesson ./my/../my/scene.json --out my/scene.json", "my/scene.json"),
        ("scene export my --out my/scene.json", "my/scene.json"),
        ("mathcad export my --out my/scene.json", "my/scene.json"),
        ("lesson fig1 --listing l.txt --out l.txt", "l.txt"),
        ("snapshot verify s.json --report s.json", "s.json"),
        ("snapshot verify s.json --junit s.json", "s.json"),
    ] {
        let before = std::fs::read(folder.path().join(file)).unwrap();
        let output = run(folder.path(), &line.split(' ').collect::<Vec<_>>());
        let error = String::from_utf8(output.stderr).unwrap();
        let words = ["this run reads it", "it does not tell that it is from this program"];
        let says = words.iter().any(|words| error.contains(words));
        assert!(output.status.code() == Some(2) && says, "{line}: {error}");
        assert!(std::fs::read(folder.path().join(file)).unwrap() == before, "{line}");
    }
}

/// A scene by path: its mesh is resolved beside it, its name is that of its folder.
#[test]
fn a_scene_by_path_reads_its_mesh_beside_it() {
    let folder = TempDir::new().unwrap();
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/strand");
    let by_path =
        succeeds(folder.path(), &["listing", "run", "c_cnt", golden.to_str().unwrap(), "--json"]);
    assert_eq!(by_path, succeeds(folder.path(), &["listing", "run", "c_cnt", "strand", "--json"]));
    std::fs::copy(golden.join("scene.json"), folder.path().join("alone.json")).unwrap();
    fails(
        folder.path(),
        &["listing", "run", "c_cnt", "alone.json"],
        2,
        &["strand.msh", "resolved beside the scene"],
    );
}

/// Edited listings that end in something else than the paper's listing does, that ask for too much, or that
/// are no listing: errors, no panic. `limits.rs` has one that never ends.
#[test]
fn edited_listings_that_are_wrong_are_refused() {
    let folder = TempDir::new().unwrap();
    let c_cnt = include_str!("../../listings/c_cnt.txt");
    let solved = |option: &str, text: &str| {
        std::fs::write(folder.path().join("listing.txt"), text).unwrap();
        let args = ["solve", "fig1", "--variant", "tied", option, "listing.txt", "--no-pictures"];
        let output = run(folder.path(), &args);
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let refused = |option: &str, text: &str, words: &str| {
        let (status, error) = solved(option, text);
        assert!(status == Some(2) && error.contains(words), "{status:?} {error}");
    };
    let edited = |from: &str, to: &str| c_cnt.replace(from, to);
    refused("--c-cnt", &edited("dy[i1] ← 0\n", "dy[i1] ← 0.4\n"), "whole numbers");
    let sum = vec!["x + 0"; 35].join(", ");
    let large = format!("c_cnt(node_n) :=\n  x[30000000] ← 1\n  a ← min({sum}, 0)\n");
    refused("--c-cnt", &large, "limit");
    let missing = edited("ct[i1] ← 0\n", "ct[i1] ← none\n");
    refused("--c-cnt", &missing, "none");
    for matrix in ["MJS[26,1] ← 1", "MJS[30,1] ← 1", "MJS[1,99] ← 1"] {
        refused("--km", &format!("Km(c_cnt) :=\n  {matrix}\n  MJS\n"), "MJS is ");
    }
    for nothing in ["", "\u{feff}", "\tc_cnt", "f(x) :=\n  x\n"] {
        refused("--c-cnt", nothing, "");
    }
    for runs in [edited("trace(ct[i1])", "trace(identity(0))"), format!("\u{feff}{c_cnt}")] {
        assert_eq!(solved("--c-cnt", &runs).0, Some(0));
    }
    refused("--c-cnt", "Km(c_cnt) :=\n  MJS\n", "");
}

#[test]
fn audit_shows_readings_findings_and_variants() {
    let folder = TempDir::new().unwrap();
    let tables = succeeds(folder.path(), &["audit", "fig1", "--full", "--out", "audit"]);
    for words in [
        "1. Readings",
        "R4 = left-to-right",
        "fails (",
        "2. Findings",
        "K1",
        "3. Variants",
        "stepped",
        "error: against the equilibrium under the scene's own friction (unilateral, mortar, friction stick",
        "the reference solution (unilateral, mortar, friction 0, initial geometry)",
        "4. Pressure, shear and status",
    ] {
        assert!(tables.contains(words), "{words:?}: {tables}");
    }
    assert_eq!(tables, std::fs::read_to_string(folder.path().join("audit/audit.txt")).unwrap());
    let json: Value =
        serde_json::from_str(&succeeds(folder.path(), &["audit", "fig1", "--json"])).unwrap();
    assert_eq!(json["readings"].as_array().unwrap().len(), 17);
    assert!(json["findings"].as_array().unwrap().len() >= 16);
    assert_eq!(json["variants"].as_array().unwrap().len(), 4);
    assert!(folder.path().join("audit/findings/C4.svg").exists());
    assert!(folder.path().join("audit/printed/von_mises_stress.svg").exists());
    let c4 = succeeds(folder.path(), &["audit", "--finding", "c4"]);
    for words in ["c_cnt 17", "Why it matters", "A repair", "c_cnt lines 17-18:", "present"] {
        assert!(c4.contains(words), "{words:?}: {c4}");
    }
    fails(folder.path(), &["audit", "--finding", "Z9"], 2, &["no finding", "C1, C2"]);
    fails(folder.path(), &["audit", "--claim", "P99"], 2, &["no claim", "P1, P2"]);
}

/// A scene without contact has an audit.
#[test]
fn a_scene_without_contact_is_audited_too() {
    let folder = TempDir::new().unwrap();
    let mut scene: Value =
        serde_json::from_str(include_str!("../../golden/two-blocks/scene.json")).unwrap();
    scene.as_object_mut().unwrap().remove("contact");
    scene["restraints"].as_array_mut().unwrap().push(serde_json::json!({ "on": 20, "fix": ["y"] }));
    std::fs::write(folder.path().join("plain.json"), scene.to_string()).unwrap();
    let audit: Value =
        serde_json::from_str(&succeeds(folder.path(), &["audit", "plain.json", "--json"])).unwrap();
    let failed = |row: &&Value| !row["failure"].is_null();
    let rows: Vec<&Value> = audit["readings"].as_array().unwrap().iter().filter(failed).collect();
    assert_eq!(rows.iter().map(|row| &row["reading"]).collect::<Vec<_>>(), ["R9: ORIGIN = 0"]);
}

/// What depends on a reading and what does not, on a scene small enough to know.
#[test]
fn audit_of_readings_on_fig1() {
    let folder = TempDir::new().unwrap();
    let json: Value =
        serde_json::from_str(&succeeds(folder.path(), &["audit", "fig1", "--json"])).unwrap();
    let of = |reading: &str| {
        let rows = json["readings"].as_array().unwrap();
        rows.iter()
            .find(|row| row["reading"] == reading)
            .unwrap_or_else(|| panic!("{reading}"))
            .clone()
    };
    assert!(of("R2 = printed")["entries"].as_u64().unwrap() > 0);
    assert!(of("R4 = left-to-right")["failure"].as_str().unwrap().contains("line 18"));
    assert!(of("R9: ORIGIN = 0")["failure"].as_str().unwrap().contains("index is invalid"));
    for reading in [
        "R9: 0/0 = 0",
        "R9: comparisons to 1e-12",
        "R9: below 1e-307 is 0",
        "R9: 1 .. 0 is empty",
        "R9: a failed last if is 0",
    ] {
        let row = of(reading);
        assert_eq!(
            (&row["statuses"], &row["entries"], &row["failure"]),
            (&0.into(), &0.into(), &Value::Null)
        );
    }
}
