//! Edited listings that drive a run: `solve --c-cnt FILE --km FILE`; and what else `solve` changes.

use std::path::Path;

use plane_contact::paper::listings::Which;
use plane_contact::problem::modelling::Variant;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;

/// Runs `solve` in `folder`; returns its exit status, its output and its messages.
fn solve(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(folder, &[&["solve"], args].concat());
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("a status"), text(output.stdout), text(output.stderr))
}

/// Returns `result.json` of a run that succeeds.
fn result(folder: &Path, args: &[&str]) -> Value {
    let (status, text, why) = solve(folder, &[args, &["--json", "--no-error-estimate"]].concat());
    assert_eq!(status, 0, "{args:?}: {why}");
    serde_json::from_str(&text).expect("JSON")
}

/// Both listings with one piece of text replaced, in a folder of their own.
fn listings(replace: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    for which in Which::ALL {
        let mut text = which.text().to_string();
        for (old, new) in replace {
            text = text.replace(old, new);
        }
        std::fs::write(folder.path().join(format!("{which}.txt")), text).expect("a file");
    }
    folder
}

/// As printed, typed in ASCII in part, the listings give the mirror's displacements to the bit;
/// under `tied` and `stepped` by the solver that takes their matrix.
#[test]
fn the_printed_listings_run_as_their_mirror() {
    let folder = listings(&[("←", "<-"), ("∧", "and"), ("≤", "<=")]);
    for scene in ["fig1", "two-blocks"] {
        for variant in Variant::OF_THE_PAPER.iter().map(|variant| variant.name()) {
            let common = [scene, "--variant", variant, "--solver", "dense-lu"];
            let own = result(folder.path(), &common);
            let edited = ["--c-cnt", "c_cnt.txt", "--km", "Km.txt"];
            let edited = result(folder.path(), &[&common[..], &edited].concat());
            for same in ["u", "reaction", "iterations"] {
                assert!(!own[same].is_null());
                assert_eq!(edited[same], own[same], "{scene} {variant}: {same}");
            }
            let which = [0, 1].map(|k| &edited["edited"][k]["listing"]);
            assert_eq!(which, ["c_cnt", "Km"]);
        }
    }
}

/// The limit of steps is one for all iterations: each of these is far below that of an execution.
#[test]
fn the_executions_of_a_run_have_one_limit() {
    let slow = "c_cnt(node_n) :=\n  A[1000000] <- 1\n  for zz in 1 .. 20\n    B <- A + A";
    let header = Which::CCnt.text().lines().find(|line| line.starts_with("c_cnt")).expect("one");
    let folder = listings(&[(header, slow)]);
    let args = ["fig1", "--variant", "tied", "--c-cnt", "c_cnt.txt", "--iterations"];
    assert_eq!(solve(folder.path(), &[&args[..], &["1", "--no-pictures"]].concat()).0, 0);
    let (status, _, why) = solve(folder.path(), &[&args[..], &["1000"]].concat());
    assert!(status == 2 && why.contains("steps in all iterations"), "{status}: {why}");
}

/// Without its sign rule and with a box that has no direction, another `c_cnt` finds other nodes:
/// the run follows, and says what changed.
#[test]
fn a_run_follows_its_listing() {
    let folder =
        listings(&[("    dy[i1] ← 1 if |yt[i1]| < c_tll", "    dy[i1] ← 1 if |yt[i1]| < 0")]);
    let at = folder.path();
    let args = ["strand", "--c-cnt", "c_cnt.txt", "--no-error-estimate", "--no-pictures"];
    let (status, text, why) = solve(at, &args);
    assert_eq!(status, 0, "{why}");
    assert!(text.contains("with c_cnt as edited in c_cnt.txt"), "{text}");
    assert!(text.contains("What the edited listings change"), "{text}");
    assert!(at.join("out/strand-stepped-edited-c_cnt/result.json").exists());
    let own = result(at, &["strand"]);
    let edited = result(at, &args[..3]);
    let [of_own, of_edited] = [&own, &edited].map(|result| &result["iterations"][19]["dy"]);
    assert!(of_own.is_array() && of_edited.is_array());
    assert_ne!(of_own, of_edited);
    assert_eq!(own.get("edited"), None);
}

#[test]
fn a_listing_that_makes_no_sense_is_refused() {
    let wrong = [
        ("ct[i1] ← trg[i2]", "ct[i1] ← 7", "neither 0 nor the number of a target edge"),
        ("    dy[i1] ← 0", "    dy[i1] ← 2", "but it is 1 or 0"),
        ("k_cnt[cnt[i1],1] ← elem[ct[i1],6]", "k_cnt[cnt[i1],1] ← 1.5", "is no node"),
        ("k_cnt[elem[ct[i1],6],1] ← cnt", "k_cnt[elem[ct[i1],6],1] ← R + cnt", "is no node"),
        ("    dy[i1] ← 0", "    dy[i1+1] ← 0", "not one for each of"),
        ("ct[i1] ← 0", "ct[i1] ← 1/0", "Division by zero"),
        ("  MJS ← identity(2·R)·0", "  MJS ← identity(2·R+1)·0", "MJS is"),
        ("← MJS[W[i],W[j]] + K[i,j]·fl", "← MJS[W[i],W[j]]·0", "the matrix is singular"),
    ];
    for (old, new, words) in wrong {
        let folder = listings(&[(old, new)]);
        let option =
            if new.contains("MJS") { ["--km", "Km.txt"] } else { ["--c-cnt", "c_cnt.txt"] };
        let args = [&["fig1", "--variant", "printed"], &option[..]].concat();
        let (status, _, why) = solve(folder.path(), &args);
        assert_eq!(status, 2, "{new}: {why}");
        assert!(why.contains(words), "{new}: {why}");
    }
    let folder = listings(&[]);
    for (args, words) in [
        (&["--km", "c_cnt.txt"][..], "it is the listing c_cnt, not Km"),
        (&["--c-cnt", "none.txt"], "cannot be read"),
        (&["--c-cnt", "c_cnt.txt", "--variant", "unilateral"], "executes no listing"),
        (&["--c-cnt", "c_cnt.txt", "--scalar", "f64x2"], "is not executed in f64x2"),
        (
            &["--c-cnt", "c_cnt.txt", "--status", "intersection", "--variant", "tied"],
            "is not called",
        ),
        (&["--km", "Km.txt", "--solver", "sparse-cholesky", "--variant", "tied"], "use sparse-lu"),
    ] {
        let (status, _, why) = solve(folder.path(), &[&["fig1"], args].concat());
        assert_eq!(status, 2, "{args:?}: {why}");
        assert!(why.contains(words), "{args:?}: {why}");
    }
}

/// The tolerance, the iterations and the load of a scene change as in its file.
#[test]
fn solve_changes_its_scene() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let own = result(at, &["two-blocks"]);
    let half = result(at, &["two-blocks", "--load-factor", "0.5", "--variant", "unilateral"]);
    let whole = result(at, &["two-blocks", "--variant", "unilateral"]);
    let load = |result: &Value, axis: usize| result["load"][axis].as_f64().expect("a number");
    assert_eq!([0, 1].map(|axis| load(&half, axis)), [0, 1].map(|axis| load(&whole, axis) / 2.0));
    let changed = result(at, &["two-blocks", "--c-tll", "0.5", "--iterations", "3"]);
    assert_eq!(changed["c_tll"], json!(0.5));
    assert_eq!(changed["iterations"].as_array().map(Vec::len), Some(3));
    assert_ne!(changed["scene_sha256"], own["scene_sha256"], "it is another scene");
    assert_eq!(changed["mesh_sha256"], own["mesh_sha256"]);
    for (args, words) in [(["--c-tll", "-1"], "c_tll"), (["--iterations", "0"], "iterations")] {
        let (status, _, why) = solve(at, &[&["two-blocks"], &args[..]].concat());
        assert_eq!(status, 2, "{args:?}");
        assert!(why.contains(words), "{why}");
    }
}

/// What is typed nearly right is named; the scenes of the program are listed, and written to edit.
#[test]
fn scenes_are_found_and_written() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let program = |args: &[&str]| {
        let output = run(at, args);
        let text = [output.stdout, output.stderr].concat();
        (output.status.code().expect("a status"), String::from_utf8(text).expect("UTF-8"))
    };
    let (status, text) = program(&["scene", "list"]);
    assert_eq!(status, 0);
    for name in ["strand", "two-blocks", "C15", "K9", "hertz", "punch"] {
        assert!(text.contains(&format!("\n  {name} ")), "{name}: {text}");
    }
    for (name, scene) in [("strand", "my/strand"), ("c4", "my/C4")] {
        assert_eq!(program(&["scene", "copy", name, "--out", scene]).0, 0);
        assert_eq!(program(&["listing", "run", "c_cnt", scene]).0, 0);
        let (status, text) = program(&["scene", "copy", name, "--out", scene]);
        assert_eq!((status, text.contains("exists already")), (2, true), "{text}");
    }
    let file = at.join("my/C4/scene.json");
    let scene = std::fs::read_to_string(&file).expect("a file").replace("c_tll", "c_tol");
    std::fs::write(&file, scene).expect("a file");
    for (args, words) in [
        (&["solve", "my/C4"][..], "did you mean \"c_tll\"?"),
        (&["solve", "strnd"], "did you mean \"strand\"?"),
        (&["scene", "copy", "two-block"], "did you mean \"two-blocks\"?"),
        (&["audit", "--finding", "CC4"], "did you mean \"C14\"?"),
        (&["solve", "fig1", "--variant", "steped"], "did you mean \"stepped\"?"),
    ] {
        let (status, text) = program(args);
        assert_eq!(status, 2, "{args:?}");
        assert!(text.contains(words), "{args:?}: {text}");
    }
}
