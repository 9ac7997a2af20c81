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
fn memory_that_a_process_may_not_have_is_refused_with_what_is_needed() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    assert!(
        program::run(folder, &["scene", "mesh", "cook", "--n", "200", "--out", "c"])
            .status
            .success()
    );
    let few = "ulimit -v 8000000; $P";
    let words = ["365.6 GB", "80802 x 80802", "coarser mesh"];
    refused(folder, &format!("{few} audit c"), &words);
    refused(folder, &format!("{few} report c"), &words);
    let words = ["limit of 134217728 numbers", "a smaller scene"];
    refused(folder, "$P listing trace c --listing Km --node 5", &words);
    refused(
        folder,
        "ulimit -v 4000000; $P scene mesh cook --n 2000",
        &["--n", "7.2 GB", "smaller"],
    );
    let mut scene = scene_json("fig1");
    scene["iterations"] = 1_000_000.into();
    std::fs::write(folder.join("long.json"), scene.to_string()).expect("it is written");
    let words = ["1000000 iterations of 13 nodes need 7.3 GB", "fewer"];
    refused(folder, "ulimit -v 5000000; $P solve long.json", &words);
    refused(folder, "ulimit -v 5000000; $P solve long.json --variant printed", &words);
}

/// Returns how many bytes are free by the message of a program with so many threads that may have so
/// many kilobytes of addresses; one place for all that the C library allocates.
fn free(limit: usize, threads: usize) -> f64 {
    let folder = tempfile::tempdir().expect("a folder");
    let variables = format!("MALLOC_ARENA_MAX=1 RAYON_NUM_THREADS={threads}");
    let line = format!("ulimit -v {limit}; {variables} $P scene mesh cook --n 2000");
    let output = shell(folder.path(), &line);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    let (number, unit) = error
        .split(" are free")
        .next()
        .and_then(|before| before.rsplit("; ").next())
        .and_then(|free| free.split_once(' '))
        .expect(&error);
    let unit = if unit == "GB" { 1e9 } else { 1e6 };
    unit * number.parse::<f64>().expect(&error)
}

/// Of 1.055 GB, 5 MB at least are the program's already.
#[test]
fn what_the_program_takes_itself_is_not_free() {
    assert!(free(1_030_273, 4) <= 1.0e9);
}

/// Of 4.096 GB some 0.05 GB are in use and 0.13 stay between what is used, of 0.2 GB a quarter of what
/// is left; 40 threads more have 2 MB each.
#[test]
fn what_is_used_is_not_free() {
    for (limit, threads, expected) in
        [(200_000, 1, 5e7..1.5e8), (4_000_000, 1, 3.75e9..3.95e9), (4_000_000, 41, 3.6e9..3.9e9)]
    {
        let free = free(limit, threads);
        assert!(expected.contains(&free), "{limit} {threads}: {free}");
    }
}

#[test]
fn what_has_no_end_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for (command, most) in [
        ("solve", 1 << 28),
        ("snapshot verify", 1 << 28),
        ("mathcad run", 1 << 26),
        ("listing trace fig1 --listing", 1 << 24),
        ("listing evaluate", 1 << 24),
    ] {
        let words = ["/dev/zero", &format!("more than {most} bytes")];
        refused(folder.path(), &format!("$P {command} /dev/zero"), &words);
    }
    refused(folder.path(), "$P sweep /dev/zero", &["/dev/zero", "this is no ordinary file"]);
    refused(folder.path(), "$P solve - < /dev/zero", &["standard input", "more than"]);
    // What is no file has no snapshot and no rows that are kept.
    let sweep = r#"{"format": 1, "scene": "fig1", "list": []}"#;
    std::fs::write(folder.path().join("sweep.json"), sweep).expect("it is written");
    for (command, device) in [
        ("snapshot record fig1", "null"),
        ("snapshot record fig1", "zero"),
        ("sweep sweep.json", "zero"),
    ] {
        let line = format!("ln -sf /dev/{device} to; ulimit -v 3000000; $P {command} --out to");
        assert_eq!(shell(folder.path(), &line).status.code(), Some(0), "{line}");
    }
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
        let line =
            format!("ulimit -v 1000000; $P compare fig1 --with calculix --ccx {ccx} --out o");
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

/// What it needs is foreseen from its headers.
#[test]
fn a_mesh_file_beyond_the_memory_is_refused_before_it_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for (sections, needed) in [
        (MANY_NODES, "line 5: 100000000 nodes need 13.0 GB"),
        (MANY_ELEMENTS, "line 9: 100000000 elements need 31.0 GB"),
    ] {
        scene_of_a_long_mesh(folder.path(), sections, 2_000_000_000);
        let words = ["large.msh", needed, "a coarser mesh"];
        refused(folder.path(), "ulimit -v 5000000; $P solve s.json", &words);
    }
}

/// 8,000,000 bytes have room for a million nodes at most, which need 0.13 GB.
#[test]
fn what_a_file_is_too_short_for_is_not_foreseen() {
    let folder = tempfile::tempdir().expect("a folder");
    for (sections, words) in [
        (MANY_NODES, ["line 6", "a node's number"]),
        (MANY_ELEMENTS, ["line 10", "an element's number"]),
    ] {
        scene_of_a_long_mesh(folder.path(), sections, 8_000_000);
        refused(folder.path(), "ulimit -v 5000000; $P solve s.json", &words);
    }
}

#[test]
fn less_than_a_tenth_of_a_gigabyte_is_told_in_megabytes() {
    let folder = tempfile::tempdir().expect("a folder");
    scene_of_a_long_mesh(folder.path(), MANY_NODES, 5_000_000);
    let words = ["line 5: 625000 nodes need 81 MB; ", " MB are free"];
    refused(folder.path(), "ulimit -v 80000; $P solve s.json", &words);
}

/// It is refused by its elements or by its plan under the smaller limits, and runs under the largest.
#[test]
fn a_mesh_is_read_within_the_memory_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let cook = shell(folder.path(), "$P scene mesh cook --n 300 --out cook");
    assert_eq!(cook.status.code(), Some(0));
    for (limit, expected) in [80_000, 100_000, 120_000, 2_000_000].into_iter().zip([2, 2, 2, 0]) {
        let line = format!("ulimit -v {limit}; $P scene plan cook/scene.json --json");
        let output = shell(folder.path(), &line);
        assert_eq!(output.status.code(), Some(expected), "{limit}: {output:?}");
        assert!(output.stdout.ends_with(b"}\n"), "{limit}: {output:?}");
    }
}

#[test]
fn a_large_run_that_does_not_fit_in_memory_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(shell(folder.path(), "$P scene mesh cook --n 230 --out c").status.success());
    let words = ["106260 free equations need 0.4 GB", "use a coarser mesh"];
    refused(folder.path(), "ulimit -v 300000; $P solve c/scene.json", &words);
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
    let line = "$P solve two-blocks --variant unilateral --friction 0 --load-factor 1e-12";
    let output = shell(folder.path(), line);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("Equilibrium: the only one"), "{text}");
}

#[test]
fn threads_that_cannot_start_are_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "ulimit -v 300000; RAYON_NUM_THREADS=1000 $P solve fig1 --json";
    refused(folder.path(), line, &["where: the process", "threads cannot start", "fewer threads"]);
}

/// What each variant takes is foreseen; of 1.6 GB the allocator reserves a gigabyte that is free.
#[test]
fn a_run_of_each_variant_fits_in_the_memory_or_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for mesh in ["hertz --size 50 --out hertz", "cook --n 105 --out cook"] {
        assert!(shell(folder.path(), &format!("$P scene mesh {mesh}")).status.success());
    }
    for run in
        ["cook --variant printed", "hertz", "hertz --variant tied", "hertz --variant stepped"]
    {
        for (limit, codes) in
            [(150_000, [2, 2]), (300_000, [0, 2]), (500_000, [0, 2]), (1_600_000, [0, 0])]
        {
            let line = format!("ulimit -v {limit}; RAYON_NUM_THREADS=4 $P solve {run}");
            let output = shell(folder.path(), &line);
            let error = String::from_utf8_lossy(&output.stderr);
            let code = output.status.code().expect(&error);
            assert!(codes.contains(&code), "{run}, {limit}: {code} {error}");
            assert!(code == 0 || error.contains(" need "), "{run}: {error}");
        }
    }
}

#[test]
fn steps_of_a_listing_have_a_limit_which_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let times = "    for i2 ∈ 1 .. 1000\n      for i3 ∈ 1 .. 1000\n        x ← 1\n";
    let listing = format!("c_cnt(node_n) :=\n  for i1 ∈ 1 .. 1000\n{times}  x\n");
    std::fs::write(folder.path().join("l.txt"), listing).expect("it is written");
    let words = ["The limit of 67130496 steps is reached", "correct the edited listing"];
    refused(folder.path(), "$P listing trace fig1 --listing l.txt", &words);
    refused(folder.path(), "$P solve fig1 --c-cnt l.txt", &words);
}

#[test]
fn a_listing_that_is_not_in_utf_8_has_a_line() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("l.txt"), b"c_cnt :=\n  \xff").expect("it is written");
    refused(
        folder.path(),
        "$P listing trace fig1 --listing l.txt",
        &["l.txt", "line 2 is not in UTF-8"],
    );
}

#[test]
fn what_standard_error_cannot_take_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let code = |line: &str| shell(folder.path(), line).status.code();
    assert_eq!(code("$P solve nosuch 2>/dev/full"), Some(2));
    assert_eq!(code("$P lesson --exercise 1 2>/dev/full"), Some(0));
    let line = "$P solve fig1 --accuracy 1e-3 --json";
    let [plain, full] = [line, &format!("{line} 2>/dev/full")].map(|l| shell(folder.path(), l));
    assert_eq!(full.status.code(), Some(0));
    assert!(!plain.stderr.is_empty() && plain.stdout == full.stdout && !full.stdout.is_empty());
}

/// Reads of arrays by the thousand are written as they are executed, what `trace()` writes of many long
/// numbers is refused, and a listing of many lines has each of them at once.
#[test]
fn hostile_listings_stay_within_the_memory_of_a_process() {
    let folder = tempfile::tempdir().expect("a folder");
    let head = "c_cnt(node_n) :=\n  for i1 ∈ 1 .. R\n    for i2 ∈ 1 .. 4\n      k_cnt[i1,i2] ← 0\n  \
                for i1 ∈ 1 .. rows(cnt)\n    ct[i1] ← 0\n    yt[i1] ← 0\n    dy[i1] ← 0\n";
    let tail = "  k_cnt\n";
    let listing = |name: &str, body: &str| {
        std::fs::write(folder.path().join(name), format!("{head}{body}{tail}")).expect("written");
    };
    let reads = vec!["rows(v)>0"; 40].join("∧");
    let many = format!(
        "  for i1 ∈ 1 .. 36\n    v[i1] ← 0.1234567890123456\n  for i1 ∈ 1 .. 30000\n    x ← 1 if {reads}\n"
    );
    listing("reads.txt", &many);
    listing("lines.txt", &"  a ← 1\n".repeat(900));
    listing("long.txt", "  for i1 ∈ 1 .. 1000000\n    x ← i1\n");
    let long = format!("  v ← identity(2800)·0 + 1{}\n  trace(v)\n", "0".repeat(308));
    listing("trace.txt", &long);
    let run = |name: &str| {
        let line = format!("ulimit -v 4000000; $P listing trace fig1 --listing {name}");
        let output = shell(folder.path(), &line);
        let text = [&output.stdout, &output.stderr]
            .map(|bytes| String::from_utf8_lossy(bytes).into_owned());
        (output.status.code(), text.concat())
    };
    let (code, text) = run("reads.txt");
    assert!(code == Some(0) && text.contains("shown in the order of execution"), "{code:?}");
    assert!(text.contains("(30000 times, last ⇒ x ← 1)"), "each of them is counted");
    let json = shell(folder.path(), "$P listing trace fig1 --listing reads.txt --json").stdout;
    let trace: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let is_written = |step: &&serde_json::Value| step["writes"][0]["name"] == "x";
    let steps = trace["steps"].as_array().expect("steps").iter();
    let reads = steps.filter(is_written).map(|step| step["reads"].as_array().map(Vec::len));
    assert_eq!(reads.collect::<Vec<_>>(), [Some(1); 30_000], "v is read forty times");
    assert_eq!(run("lines.txt").0, Some(0));
    let line = "(ulimit -v 1000000; $P listing trace fig1 --listing long.txt --json || echo failed) | tail -c 400";
    let end = String::from_utf8(shell(folder.path(), line).stdout).expect("UTF-8");
    assert!(end.ends_with("}\n") && end.contains("\"failure\":null"), "{end}");
    let (code, text) = run("trace.txt");
    assert!(code == Some(2) && text.contains("The limit of"), "{code:?} {text}");
}
