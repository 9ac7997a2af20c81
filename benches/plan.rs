//! What `plan` predicts against what `solve` takes, whole processes from the outside: peak memory
//! within 20 %. Beside it the operations that are planned and the time taken. Then half of the
//! strand against the whole of it. Prints tables; a ratio beyond its limit is marked.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use clap::Parser;
use plane_contact::engine::{Request, max_displacement, solve};
use plane_contact::numbers::solve::{Arithmetic, Solver};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::problem::scene::symmetry::half;
use plane_contact::studies::benchmark::Kind;
use plane_contact::studies::plan::Plan;

/// A scene, or the words of `mesh` that make it; variant and solver where they are not the scene's.
type Case = (&'static str, Option<Variant>, Option<Solver>);

const SPARSE: Option<Solver> = Some(Solver::SparseCholesky);

/// A run of fewer operations than this is over in a tenth of a second: it is measured more often.
const SMALL: f64 = 1e9;

const CASES: [Case; 15] = [
    ("two-blocks", None, None),
    ("fig1", None, None),
    ("fig1", Some(Variant::Unilateral), None),
    ("strand", Some(Variant::Printed), None),
    ("strand", Some(Variant::Tied), None),
    ("strand", Some(Variant::Stepped), None),
    ("strand", Some(Variant::Unilateral), None),
    ("strand", Some(Variant::Tied), SPARSE),
    ("strand", Some(Variant::Stepped), SPARSE),
    ("strand", Some(Variant::Stepped), Some(Solver::DenseLu)),
    ("hertz --size 10", None, None),
    ("hertz --size 20", None, None),
    ("hertz --size 40", None, None),
    ("hertz --size 59", None, None),
    ("blocks --upper 28 --lower 40", None, None),
];

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!(
        "{:52} {:>8} {:>8} {:>6}   {:>10} {:>8} {:>8}",
        "solve", "MB", "planned", "ratio", "operations", "cpu s", "wall s"
    );
    for case in CASES {
        compare(case, folder.path());
    }
    half_against_whole();
}

/// The run alone, without files, in this process: least of three.
fn half_against_whole() {
    let whole = Scene::open("strand").expect("embedded");
    let half = half(&whole).expect("strand is symmetric").scene;
    println!(
        "\n{:40} {:>9} {:>9} {:>7} {:>12}",
        "strand", "whole s", "half s", "saves", "|u| differs"
    );
    let dense = Variant::ALL.iter().map(|variant| (*variant, None));
    for (variant, solver) in dense.chain([(Variant::Stepped, SPARSE), (Variant::Tied, SPARSE)]) {
        let arithmetic = Arithmetic { solver, ..Arithmetic::default() };
        let request = |scene| Request::new(scene).variant(variant).arithmetic(arithmetic);
        let [(whole, u), (half, v)] = [&whole, &half].map(|scene| timed(&request(scene)));
        let name = format!("{variant} {}", solver.map_or("", Solver::name));
        let (saves, differs) = (1.0 - half / whole, (u - v).abs() / u);
        println!("{name:40} {whole:>9.3} {half:>9.3} {:>5.0} % {differs:>12.1e}", 100.0 * saves);
    }
}

/// Seconds, and the largest displacement.
fn timed(request: &Request) -> (f64, f64) {
    let attempt = || {
        let start = Instant::now();
        let solution = solve(request, &mut |_| ());
        let u = max_displacement(&solution.expect("strand runs").u);
        (start.elapsed().as_secs_f64(), u)
    };
    (0..3).map(|_| attempt()).reduce(|a, b| if b.0 < a.0 { b } else { a }).expect("three runs")
}

fn compare((words, variant, solver): Case, folder: &Path) {
    let place = scene(words, folder);
    let scene = Scene::open(&place).expect("the scene is sound");
    let variant = variant.unwrap_or(scene.variant);
    let arithmetic = Arithmetic { solver, ..Arithmetic::default() };
    let request = Request::new(&scene).variant(variant).arithmetic(arithmetic);
    let plan = Plan::new(&request).expect("it is sound");
    let mut args = vec!["solve".to_string(), place, "--variant".into(), variant.to_string()];
    args.extend(solver.into_iter().flat_map(|s| ["--solver".into(), s.to_string()]));
    let small = plan.cost.operations < SMALL;
    let taken = measure(&args, folder, if small { 20 } else { 3 });
    let megabytes = plan.cost.bytes.total() / 1e6;
    let name = format!("{words} {variant} {}", plan.solver);
    let memory = megabytes / taken.megabytes;
    println!(
        "{name:52} {:>8.1} {megabytes:>8.1} {memory:>5.2}{}   {:>10.1e} {:>8.3} {:>8.3}",
        taken.megabytes,
        mark((1.0 / 1.2..=1.2).contains(&memory)),
        plan.cost.operations,
        taken.processor,
        taken.wall
    );
}

fn mark(within: bool) -> char {
    if within { ' ' } else { '!' }
}

/// The path of a scene: an embedded one's name, or a benchmark written to `folder`.
fn scene(words: &str, folder: &Path) -> String {
    #[derive(Parser)]
    struct Mesh {
        #[command(subcommand)]
        kind: Kind,
    }
    if !words.contains(' ') {
        return words.into();
    }
    let place = folder.join(words.replace(' ', "-"));
    let mesh = Mesh::parse_from(std::iter::once("mesh").chain(words.split(' ')));
    mesh.kind.generate().and_then(|benchmark| benchmark.write(&place)).expect("a benchmark");
    place.to_str().expect("a path in UTF-8").into()
}

/// What a process took.
struct Taken {
    /// Processor time, mean, s.
    processor: f64,
    /// Wall time, least, s.
    wall: f64,
    /// Peak memory, 10⁶ bytes.
    megabytes: f64,
}

fn measure(args: &[String], folder: &Path, runs: usize) -> Taken {
    let (before, mut wall, mut peak) = (children(), f64::INFINITY, 0.0_f64);
    for _ in 0..runs {
        let start = Instant::now();
        peak = peak.max(once(args, folder));
        wall = wall.min(start.elapsed().as_secs_f64());
    }
    Taken { processor: (children() - before) / runs as f64, wall, megabytes: peak }
}

/// Peak resident memory of one run, 10⁶ bytes.
fn once(args: &[String], folder: &Path) -> f64 {
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
    kilobytes * 1024.0 / 1e6
}

/// Processor time of all children that have ended, s: fields 16 and 17 of /proc/self/stat, in
/// hundredths.
fn children() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let ticks = |field: usize| -> f64 {
        after_name.split_whitespace().nth(field - 3).and_then(|t| t.parse().ok()).unwrap_or(0.0)
    };
    (ticks(16) + ticks(17)) / 100.0
}
