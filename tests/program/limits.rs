//! What asks for more than there is, or has no end, is refused with what it needs; and what standard
//! error cannot take is no reason to fail.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::{Command, Output};

use crate::common::embedded::scene_json;
use crate::common::program;

/// Runs a line of the shell, in which `$P` is the program.
pub fn shell(folder: &Path, line: &str) -> Output {
    Command::new("sh")
        .args(["-c", line])
        .env("P", env!("CARGO_BIN_EXE_plane-contact"))
        .current_dir(folder)
        .output()
        .expect("a shell")
}

/// Checks that a line ends with exit status 2, and that its error has all the `words`.
#[track_caller]
pub fn refused(folder: &Path, line: &str, words: &[&str]) {
    let output = shell(folder, line);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{line}: {error}");
    for word in words {
        assert!(error.contains(word), "{line}: {word:?} is not in {error}");
    }
}

#[test]
fn what_would_not_fit_in_memory_is_refused_by_its_counts() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let made = program::run(
        folder,
        &["scene", "mesh", "blocks", "--upper", "80", "--lower", "80", "--out", "c"],
    );
    assert!(made.status.success());
    let words = ["13284 equations in a dense matrix are more than 11000", "coarser mesh"];
    for command in
        ["audit c", "report c", "listing run Km c", "solve c --variant tied --solver dense-lu"]
    {
        refused(folder, &format!("$P {command}"), &words);
    }
    refused(folder, "$P scene mesh blocks --lower 2000", &["--lower", "outside 1 .. 1000"]);
    let mut scene = scene_json("fig1");
    scene["iterations"] = 1_000_000.into();
    std::fs::write(folder.join("long.json"), scene.to_string()).expect("it is written");
    let words = ["iterations", "1000000 on 13 nodes are more than 44247", "fewer"];
    for command in
        ["solve long.json", "solve long.json --variant printed", "snapshot record long.json"]
    {
        refused(folder, &format!("$P {command}"), &words);
    }
}

#[test]
fn what_has_no_end_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for (command, most) in [
        ("solve", 1 << 28),
        ("snapshot verify", 1 << 28),
        ("mathcad run", 1 << 26),
        ("solve fig1 --c-cnt", 1 << 24),
        ("listing evaluate", 1 << 24),
        ("sweep run", 1 << 22),
    ] {
        let words = ["/dev/zero", &format!("more than {most} bytes")];
        refused(folder.path(), &format!("$P {command} /dev/zero"), &words);
    }
    refused(folder.path(), "$P solve - < /dev/zero", &["standard input", "more than"]);
    let line = "$P snapshot record fig1 --out /dev/zero";
    refused(folder.path(), line, &["/dev/zero", "it is no ordinary file"]);
    let kept = std::fs::File::create(folder.path().join("long.json")).expect("a file");
    kept.set_len(300_000_000).expect("a length");
    let words = ["long.json", "there cannot be read", "more than 268435456 bytes"];
    refused(folder.path(), "$P snapshot record fig1 --out long.json", &words);
    assert_eq!(kept.metadata().expect("a file").len(), 300_000_000);
}

/// A program in the place of `ccx` that prints without end is ended, though it would sleep then.
#[test]
fn what_a_program_prints_without_end_is_not_kept() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let ccx = folder.path().join("ccx");
    let id = folder.path().join("id");
    let script = format!("#!/bin/sh\necho $$ >'{}'; yes; sleep 60\n", id.display());
    std::fs::write(&ccx, script).expect("it is written");
    std::fs::set_permissions(&ccx, std::fs::Permissions::from_mode(0o755)).expect("executable");
    for ccx in ["yes", "./ccx"] {
        let line = format!("ulimit -v 1000000; $P compare fig1 --with calculix --ccx {ccx}");
        let words =
            format!("{ccx} was ended, as its output cannot be read: it has more than 16777216");
        refused(folder.path(), &line, &[&words, "name its program"]);
    }
    let id = std::fs::read_to_string(id).expect("a number");
    assert!(!Path::new("/proc").join(id.trim()).exists(), "it is still there");
}

/// Writes a scene whose mesh file begins with `sections` and is `length` bytes long, with nothing else
/// on the disk.
fn scene_of_a_long_mesh(folder: &Path, sections: &str, length: u64) {
    let mut scene = scene_json("fig1");
    scene.as_object_mut().expect("an object").retain(|field, _| field != "node" && field != "elem");
    scene["mesh"] = "large.msh".into();
    std::fs::write(folder.join("s.json"), scene.to_string()).expect("it is written");
    let text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{sections}");
    std::fs::write(folder.join("large.msh"), text).expect("it is written");
    let mesh = std::fs::File::options().write(true).open(folder.join("large.msh"));
    mesh.and_then(|mesh| mesh.set_len(length)).expect("a length");
}

const MANY_NODES: &str = "$Nodes\n100000000\n";
const MANY_ELEMENTS: &str = "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n100000000\n";

/// A mesh file is read whole, up to a limit; no memory is asked for by the counts that it declares.
#[test]
fn a_mesh_file_that_is_too_long_or_too_short_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for (sections, length, word) in [
        (MANY_NODES, 2_000_000_000, "it has more than 268435456 bytes"),
        (MANY_NODES, 8_000_000, "line 6"),
        (MANY_ELEMENTS, 8_000_000, "line 10"),
    ] {
        scene_of_a_long_mesh(folder.path(), sections, length);
        refused(folder.path(), "ulimit -v 5000000; $P solve s.json", &["large.msh", word]);
    }
    scene_of_a_long_mesh(folder.path(), &" ".repeat(60_000_001), 60_000_100);
    let words = ["large.msh", "numbers in one mesh file are more than 60000000", "a coarser mesh"];
    refused(folder.path(), "$P solve s.json", &words);
}

/// Once a number of an array took 455 bytes.
#[test]
fn a_large_array_is_printed_as_json_in_little_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("f.txt"), "f(n) :=\n  A[n] <- 1\n  A\n").expect("written");
    let call = "ulimit -v 1000000; $P listing evaluate f.txt --call 'f(3000000)' --json";
    let output = shell(folder.path(), call);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.stdout.iter().filter(|byte| **byte == b'[').count(), 3_000_002);
}

/// What is singular to the digits of a scalar may be so by rounding: the message says what tells.
#[test]
fn a_singular_matrix_is_not_blamed_on_the_print_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(shell(folder.path(), "$P scene mesh hertz --size 19 --out hertz").status.success());
    let output = shell(folder.path(), "$P solve hertz --variant printed");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    let words = "f64 rounds: --scalar exact, or f64x2 on a large mesh, tells";
    assert!(error.contains("the matrix is singular") && error.contains(words), "{error}");
}

/// What carries a force does so in any unit: the pressure of this scene is 1e-12 of the usual.
#[test]
fn small_loads_leave_an_equilibrium_the_only_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "$P solve two-blocks --variant unilateral --friction 0 --geometry initial \
                --load-factor 1e-12";
    let output = shell(folder.path(), line);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("Equilibrium: the only one"), "{text}");
}

#[test]
fn steps_of_a_listing_have_a_limit_which_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let times = "    for i2 ∈ 1 .. 1000\n      for i3 ∈ 1 .. 1000\n        x ← 1\n";
    let listing = format!("c_cnt(node_n) :=\n  for i1 ∈ 1 .. 1000\n{times}  x\n");
    std::fs::write(folder.path().join("l.txt"), listing).expect("it is written");
    let words = ["The limit of 67130496 steps is reached", "correct the edited listing"];
    refused(folder.path(), "$P solve fig1 --c-cnt l.txt", &words);
}

#[test]
fn a_listing_that_is_not_in_utf_8_has_a_line() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("l.txt"), b"c_cnt :=\n  \xff").expect("it is written");
    refused(folder.path(), "$P solve fig1 --c-cnt l.txt", &["l.txt", "line 2 is not in UTF-8"]);
}

#[test]
fn what_standard_error_cannot_take_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let code = |line: &str| shell(folder.path(), line).status.code();
    assert_eq!(code("$P solve nosuch 2>/dev/full"), Some(2));
    assert_eq!(code("$P lesson fig1 2>/dev/full"), Some(0));
    let line = "$P solve fig1 --accuracy 1e-3 --json";
    let [plain, full] = [line, &format!("{line} 2>/dev/full")].map(|l| shell(folder.path(), l));
    assert_eq!(full.status.code(), Some(0));
    assert!(!plain.stderr.is_empty() && plain.stdout == full.stdout && !full.stdout.is_empty());
}

/// What `trace()` writes of many long numbers is refused; long lines and loops take no memory.
#[test]
fn hostile_listings_stay_within_the_memory_of_a_process() {
    let folder = tempfile::tempdir().expect("a folder");
    let head = "c_cnt(node_n) :=\n  for i1 ∈ 1 .. R\n    for i2 ∈ 1 .. 4\n      k_cnt[i1,i2] ← 0\n  \
                for i1 ∈ 1 .. rows(cnt)\n    ct[i1] ← 0\n    yt[i1] ← 0\n    dy[i1] ← 0\n";
    let run = |body: &str| {
        let text = format!("{head}{body}  k_cnt\n");
        std::fs::write(folder.path().join("l.txt"), text).expect("written");
        let line = "ulimit -v 2000000; $P solve fig1 --variant printed --c-cnt l.txt --no-pictures";
        let output = shell(folder.path(), line);
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let reads = vec!["rows(v)>0"; 40].join("∧");
    let fill = "  for i1 ∈ 1 .. 36\n    v[i1] ← 0.1234567890123456\n";
    let loops = format!("{fill}  for i1 ∈ 1 .. 30000\n    x ← 1 if {reads}\n");
    for body in [&loops, &"  a ← 1\n".repeat(900), "  for i1 ∈ 1 .. 1000000\n    x ← i1\n"] {
        // The listing ends without a pair, so that nothing holds the stamp.
        let (code, why) = run(body);
        assert!(code == Some(2) && why.contains("no node is in contact"), "{code:?} {why}");
    }
    let (code, why) = run(&format!("  v ← identity(2800)·0 + 1{}\n  trace(v)\n", "0".repeat(308)));
    assert!(code == Some(2) && why.contains("The limit of"), "{code:?} {why}");
}
