//! The numbers to reach: whole processes from the outside, time and peak memory beside their
//! limits; then the interpreter against the mirror, in turn in one run. Prints tables; asserts no
//! time, for machines differ.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use plane_contact::paper::door;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::{Reading, c_cnt};
use plane_contact::problem::scene::Scene;

/// A command, how often it runs, and what it should keep to.
struct Case {
    name: &'static str,
    args: &'static [&'static str],
    runs: usize,
    seconds: f64,
    megabytes: f64,
}

const CASES: [Case; 8] = [
    Case {
        name: "solve strand",
        args: &["solve", "strand"],
        runs: 5,
        seconds: 2.0,
        megabytes: 300.0,
    },
    Case {
        name: "solve strand --variant tied",
        args: &["solve", "strand", "--variant", "tied"],
        runs: 5,
        seconds: 2.0,
        megabytes: 300.0,
    },
    Case {
        name: "solve strand --variant printed",
        args: &["solve", "strand", "--variant", "printed"],
        runs: 5,
        seconds: 2.0,
        megabytes: 300.0,
    },
    Case {
        name: "solve fig1 --scalar exact",
        args: &["solve", "fig1", "--scalar", "exact"],
        runs: 3,
        seconds: 1.0,
        megabytes: 300.0,
    },
    Case {
        name: "solve strand --scalar f64x2",
        args: &["solve", "strand", "--scalar", "f64x2"],
        runs: 3,
        seconds: 2.0,
        megabytes: 600.0,
    },
    Case { name: "audit strand", args: &["audit"], runs: 3, seconds: 10.0, megabytes: 1000.0 },
    Case {
        name: "trace strand",
        args: &["trace", "strand"],
        runs: 3,
        seconds: 10.0,
        megabytes: 1000.0,
    },
    Case {
        name: "c-cnt fig1",
        args: &["c-cnt", "fig1"],
        runs: 20,
        seconds: 0.020,
        megabytes: 300.0,
    },
];

fn main() {
    whole_processes();
    interpreter_against_mirror();
}

/// c_cnt of the paper's example, listing and mirror in turn, after a check that both give the same.
fn interpreter_against_mirror() {
    let reading = Reading::default();
    let sheet = door::worksheet(&Scene::open("strand").expect("embedded").model, |x| x);
    let (listing, settings) = (Which::CCnt.under(&reading), settings(&reading));
    let interpreted = || listings::c_cnt(&listing, &settings, &sheet, &sheet.node, &mut ());
    let mirrored = || c_cnt(&sheet, &reading, &sheet.node);
    assert_eq!(interpreted().expect("it runs").0, mirrored().expect("it runs"));
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..200 {
        let start = Instant::now();
        std::hint::black_box(interpreted().is_ok());
        times[0].push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        std::hint::black_box(mirrored().is_ok());
        times[1].push(start.elapsed().as_secs_f64());
    }
    let [listing, mirror] = times.map(|mut t| {
        t.sort_by(f64::total_cmp);
        t[t.len() / 2]
    });
    println!(
        "\nc_cnt of strand, median: listing {:.3} ms, mirror {:.3} ms, ratio {:.0} (limit 200)",
        listing * 1e3,
        mirror * 1e3,
        listing / mirror
    );
}

fn whole_processes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!(
        "{:32} {:>10} {:>10} {:>10} {:>10}",
        "whole process", "median s", "limit s", "peak MB", "limit MB"
    );
    for case in CASES {
        let mut seconds: Vec<f64> = Vec::new();
        let mut peak = 0.0_f64;
        for _ in 0..case.runs {
            let (time, megabytes) = measure(case.args, folder.path());
            seconds.push(time.as_secs_f64());
            peak = peak.max(megabytes);
        }
        seconds.sort_by(f64::total_cmp);
        let median = seconds[seconds.len() / 2];
        println!(
            "{:32} {median:>10.4} {:>10.3} {peak:>10.1} {:>10.0}",
            case.name, case.seconds, case.megabytes
        );
    }
}

/// Wall time and peak resident memory of one run.
fn measure(args: &[&str], folder: &Path) -> (Duration, f64) {
    let start = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(args)
        .current_dir(folder)
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    // VmHWM is the peak so far: read it until the process is gone.
    let status = format!("/proc/{}/status", child.id());
    let mut kilobytes = 0.0_f64;
    while child.try_wait().expect("the child is ours").is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let value = line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse().ok());
        kilobytes = kilobytes.max(value.unwrap_or(0.0));
        std::thread::sleep(Duration::from_micros(500));
    }
    (start.elapsed(), kilobytes / 1024.0)
}
