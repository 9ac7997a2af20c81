//! What things take: whole processes from the outside beside their peers; then parts of a run.
//! Answers are compared before anything is timed. Prints tables, writes `target/numbers.json`, and
//! with `--page` `benches/README.md`; asserts no time, for machines differ.
//!
//! `cargo bench --bench numbers -- --largest 116 --page`

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use clap::Parser;
use nalgebra::DVector;
use plane_contact::engine::linear::{Factors, SparseCholesky};
use plane_contact::engine::{Elimination, Stiffness};
use plane_contact::output::exports::{self, Export};
use plane_contact::paper::door;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::{Km, Reading, c_cnt};
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use plane_contact::{Request, solve};
use serde_json::{Value, json};

#[derive(Parser)]
struct Args {
    /// The largest Hertz mesh, in elements on the contact half width: 59, 116, 340.
    #[arg(long, default_value_t = 340)]
    largest: usize,
    /// Write benches/README.md.
    #[arg(long)]
    page: bool,
    /// Print what faer takes for the matrix of a scene: equations, s in all, s of a solution.
    #[arg(long, hide = true)]
    alone: Option<String>,
    /// What `cargo bench` itself hands over.
    #[arg(long, hide = true)]
    bench: bool,
}

/// What was measured: a table of its own.
struct Table {
    title: &'static str,
    columns: Vec<&'static str>,
    rows: Vec<(String, Vec<Option<f64>>)>,
}

/// A run of the program from the outside.
#[derive(Clone, Copy)]
struct Taken {
    seconds: f64,
    megabytes: f64,
}

fn main() {
    let args = Args::parse();
    if let Some(scene) = &args.alone {
        let [equations, all, solution] = factors_of(scene);
        println!("{equations} {all} {solution}");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sizes: Vec<usize> =
        [59, 116, 340].into_iter().filter(|size| *size <= args.largest).collect();
    let tables: [&dyn Fn() -> Table; 8] = [
        &interpreter,
        &iteration,
        &|| octave(folder.path()),
        &long_surfaces,
        &|| processes(folder.path()),
        &|| hertz(folder.path(), &sizes),
        &|| factors_alone(folder.path(), &sizes),
        &|| calculix(folder.path()),
    ];
    let mut text = String::new();
    let tables = tables.map(|measure| {
        let table = measure();
        print!("{}", table.text());
        text += &table.text();
        table
    });
    let json: Vec<Value> = tables.iter().map(Table::json).collect();
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/numbers.json");
    std::fs::create_dir_all(target.parent().expect("a folder")).expect("the folder is made");
    std::fs::write(&target, format!("{:#}\n", Value::from(json))).expect("it is written");
    if args.page {
        let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/README.md");
        std::fs::write(page, page_of(&text)).expect("it is written");
    }
}

impl Table {
    fn new(title: &'static str, columns: &[&'static str]) -> Self {
        Table { title, columns: columns.to_vec(), rows: Vec::new() }
    }

    fn row(&mut self, name: impl Into<String>, values: &[Option<f64>]) {
        self.rows.push((name.into(), values.to_vec()));
    }

    fn text(&self) -> String {
        let mut text = format!("\n## {}\n\n| |", self.title);
        self.columns.iter().for_each(|c| write!(text, " {c} |").expect("a string"));
        text += "\n|---|";
        self.columns.iter().for_each(|_| text += "---|");
        for (name, values) in &self.rows {
            write!(text, "\n| {name} |").expect("a string");
            for value in values {
                let value = value.map_or("-".into(), digits);
                write!(text, " {value} |").expect("a string");
            }
        }
        text + "\n"
    }

    fn json(&self) -> Value {
        let row = |(name, values): &(String, Vec<Option<f64>>)| {
            let named = self.columns.iter().zip(values).map(|(c, v)| ((*c).to_string(), json!(v)));
            json!({ "what": name, "values": named.collect::<serde_json::Map<_, _>>() })
        };
        json!({ "table": self.title, "rows": self.rows.iter().map(row).collect::<Vec<_>>() })
    }
}

/// Returns a number in three digits.
fn digits(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let decimals = (2 - x.abs().log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}

fn page_of(text: &str) -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "# What things take\n\nMade by `cargo bench --bench numbers -- --page` on {cores} cores, by \
         version {}; machines differ, so compare what stands in one table. Seconds are wall time and \
         the least of several runs, megabytes the peak of the whole process.\n{text}{BY_HAND}",
        env!("CARGO_PKG_VERSION")
    )
}

/// What was measured by hand, beside a version of the program that no longer is.
const BY_HAND: &str = "
## What the reduction to the contact surfaces buys (`src/engine/reduction.rs`)

CPU seconds of `solve --variant unilateral --no-error-estimate`, measured once by hand on 2 cores, with each state's whole matrix factored
and with the bodies factored once. CalculiX takes 0.54 s of `strand` without friction, and more than 100 s of Hertz's contact of 113,394 equations.

| | whole, s | reduced, s | contact states |
|---|---|---|---|
| strand, frictionless | 0.13 | 0.09 | 9 |
| strand, 16 steps of the load where nodes stick | 1.00 | 0.25 | 84 |
| Hertz of 29,852 equations, mortar, friction 0.3 | more than 46 | 18.6 | 870 |
| Hertz of 113,394 equations | 3.3 | 1.5 | 9 |
| Hertz of 961,810 equations | 45.0 | 17.3 | 10 |
";

/// Runs the program in `folder` and returns the least time and the largest peak of `runs`.
fn process(args: &[&str], folder: &Path, runs: usize) -> Taken {
    let program = Path::new(env!("CARGO_BIN_EXE_plane-contact"));
    let all = (0..runs).map(|_| measured(program, args, folder));
    all.reduce(|a, b| Taken {
        seconds: a.seconds.min(b.seconds),
        megabytes: a.megabytes.max(b.megabytes),
    })
    .expect("at least one run")
}

fn measured(program: &Path, args: &[&str], folder: &Path) -> Taken {
    let start = Instant::now();
    let mut child = Command::new(program)
        .args(args)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
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
        std::thread::sleep(std::time::Duration::from_micros(500));
    }
    let done = child.wait().expect("the child is ours");
    assert!(done.success(), "{} {args:?} ends with {done}", program.display());
    Taken { seconds: start.elapsed().as_secs_f64(), megabytes: kilobytes / 1024.0 }
}

/// Returns the least time of several runs of `work`, s.
fn least(runs: usize, mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(once).fold(f64::INFINITY, f64::min)
}

fn processes(folder: &Path) -> Table {
    let mut table = Table::new("Whole processes, all files written", &["s", "MB"]);
    for (words, runs) in [
        ("solve strand --variant printed", 5),
        ("solve strand --variant tied", 5),
        ("solve strand --variant stepped", 5),
        ("solve strand --variant unilateral", 5),
        ("audit", 3),
        ("extremes", 1),
        ("trade strand", 1),
    ] {
        let taken = process(&words.split(' ').collect::<Vec<_>>(), folder, runs);
        table.row(format!("`{words}`"), &[Some(taken.seconds), Some(taken.megabytes)]);
    }
    table
}

/// The path of Hertz's scene of a size, written to `folder`.
fn hertz_scene(size: usize, folder: &Path) -> String {
    let place = folder.join(format!("hertz-{size}"));
    if !place.exists() {
        let size = size.to_string();
        process(
            &["scene", "mesh", "hertz", "--size", &size, "--out", place.to_str().expect("a path")],
            folder,
            1,
        );
    }
    place.join("scene.json").to_str().expect("a path").into()
}

/// How many times a mesh of a size is run: the least time of several is what it takes.
fn runs_of(size: usize) -> usize {
    if size < 200 { 3 } else { 2 }
}

fn equations(scene: &str) -> f64 {
    Scene::open(scene).expect("the scene is sound").model.free_dofs() as f64
}

fn hertz(folder: &Path, sizes: &[usize]) -> Table {
    let mut table = Table::new(
        "Hertz, unilateral",
        &["equations", "s", "MB", "s without pictures and error estimates", "growth exponent"],
    );
    let mut before: Option<(f64, f64)> = None;
    for size in sizes {
        let scene = hertz_scene(*size, folder);
        let runs = runs_of(*size);
        let all = process(&["solve", &scene], folder, runs);
        let bare = ["solve", &scene, "--no-pictures", "--no-error-estimate"];
        let bare = process(&bare, folder, runs);
        let n = equations(&scene);
        let growth = before.map(|(m, s)| (all.seconds / s).ln() / (n / m).ln());
        before = Some((n, all.seconds));
        let values = [Some(n), Some(all.seconds), Some(all.megabytes), Some(bare.seconds), growth];
        table.row(format!("{size} elements on the half width"), &values);
    }
    table
}

/// The library's order, factor and one solution of the matrix of the held bodies, in a process of its
/// own, as the program's is: memory that was used before comes sooner.
fn factors_alone(folder: &Path, sizes: &[usize]) -> Table {
    let mut table = Table::new(
        "faer alone: order, factor and a solution of the same matrix",
        &["equations", "s", "solution, s"],
    );
    for size in sizes {
        let scene = hertz_scene(*size, folder);
        let runs = runs_of(*size);
        let taken = (0..runs).map(|_| alone(&scene));
        let least = taken.min_by(|a, b| a[1].total_cmp(&b[1])).expect("it is run");
        table.row(format!("{size} elements on the half width"), &least.map(Some));
    }
    table
}

/// Runs [`factors_of`] in a process of its own.
fn alone(scene: &str) -> [f64; 3] {
    let own = std::env::current_exe().expect("this program");
    let done = Command::new(own).args(["--alone", scene]).output().expect("it starts");
    let text = String::from_utf8(done.stdout).expect("numbers");
    let numbers: Vec<f64> = text.split_whitespace().map_while(|word| word.parse().ok()).collect();
    numbers.try_into().expect("three numbers")
}

/// Returns the number of equations, what order, factor and one solution take, and what of that the
/// solution takes, s.
fn factors_of(scene: &str) -> [f64; 3] {
    let model = Scene::open(scene).expect("it is sound").model;
    // The cylinder is held by its contact nodes, all of them.
    let mut holds = model.holds.clone();
    holds.fix(model.contact.nodes.iter().flat_map(|node| node.dofs()));
    let stiffness = Stiffness::new(&model, |x| x);
    let matrix = stiffness.reduced(&Elimination::new(&holds, &[]));
    let n = matrix.size();
    let start = Instant::now();
    let factors = SparseCholesky::new(&matrix).expect("the bodies are held");
    let factored = start.elapsed().as_secs_f64();
    let b = DVector::from_element(n, 1.0);
    let solution = least(3, || drop(black_box(factors.solve(&b))));
    [n as f64, factored + solution, solution]
}

/// CalculiX's own contact on the same meshes, where `ccx` is installed.
fn calculix(folder: &Path) -> Table {
    /// Its pairs take minutes on finer meshes.
    const SIZES: [usize; 2] = [10, 20];
    let mut table = Table::new(
        "CalculiX (`ccx`), its contact pair by penalty, on the same scene",
        &["ours, s", "ccx, s", "ratio", "displacements differ by, %"],
    );
    if Command::new("ccx").arg("-v").stdout(Stdio::null()).status().is_err() {
        return table;
    }
    let hertz = SIZES.map(|size| (format!("Hertz {size}"), hertz_scene(size, folder), "0"));
    let strand = ["0", "stick"].map(|mu| (format!("strand, friction {mu}"), "strand".into(), mu));
    for (name, scene, friction) in strand.into_iter().chain(hertz) {
        let pair = ["--variant", "unilateral", "--contact", "pair", "--friction", friction];
        let compared = Command::new(env!("CARGO_BIN_EXE_plane-contact"))
            .args(["compare", &scene, "--with", "calculix", "--json"])
            .args(pair)
            .current_dir(folder)
            .output()
            .expect("the program starts");
        let compared: Value = serde_json::from_slice(&compared.stdout).unwrap_or_default();
        let Some(differs) = compared["distance"]["displacement_relative"].as_f64() else {
            table.row(format!("{name}: ccx found no answer"), &[None; 4]);
            continue;
        };
        let deck = ["scene", "export", &scene, "--to", "calculix", "--out", "deck.inp"];
        process(&[&deck[..], &pair[..]].concat(), folder, 1);
        let peer = measured(Path::new("ccx"), &["-i", "deck"], folder).seconds;
        let ours = ["solve", &scene, "--variant", "unilateral", "--friction", friction];
        let ours = process(&ours, folder, 3).seconds;
        table.row(name, &[ours, peer, peer / ours, 100.0 * differs].map(Some));
    }
    table
}

/// Two thin strips on each other, with `n` edges along the target.
fn strips(n: usize) -> Scene {
    let mut mesh = MeshBuilder::default();
    let mut line = |from: f64, to: f64, pieces: usize, y: f64| {
        let at = |k: usize| [from + (to - from) * k as f64 / pieces as f64, y];
        mesh.row((0..=pieces).map(at))
    };
    let length = n as f64 / 10.0;
    let (bottom, target) = (line(0.0, length, n, 0.0), line(0.0, length, n, 0.1));
    let (contact, top) =
        (line(0.03, length - 0.03, n - 1, 0.1), line(0.03, length - 0.03, n - 1, 0.2));
    mesh.join("lower", &bottom, &target);
    mesh.join("upper", &contact, &top);
    mesh.edges("bottom", &bottom);
    mesh.edges("target", &target);
    mesh.edges("contact", &contact);
    mesh.edges("top", &top);
    SceneBuilder::new("strips", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("lower", 30_000.0, 0.2)
        .material("upper", 210_000.0, 0.3)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .restrain("top", &[Axis::X])
        .pressure("top", 6.3)
        .contact(Contact::new("contact", "target", 0.001))
        .build()
        .expect("the scene is sound")
}

fn long_surfaces() -> Table {
    let mut table = Table::new(
        "Long surfaces: two strips of one row of triangles each",
        &["unilateral, s", "tied, s", "growth exponent of both"],
    );
    let mut before: Option<f64> = None;
    for n in [2_500, 5_000, 10_000] {
        let scene = strips(n);
        let run = |variant| {
            let request = Request::new(&scene).variant(variant);
            least(1, || drop(black_box(solve(&request, &mut |_| ()).expect("it is sound"))))
        };
        let [unilateral, tied] = [Variant::Unilateral, Variant::Tied].map(run);
        let growth = before.map(|s| ((unilateral + tied) / s).log2());
        before = Some(unilateral + tied);
        table.row(format!("{n} contact nodes"), &[Some(unilateral), Some(tied), growth]);
    }
    table
}

/// What an iteration takes beyond the first.
fn iteration() -> Table {
    let mut table = Table::new("An iteration of `strand` beyond the first", &["ms", "20 over 1"]);
    let scene = Scene::open("strand").expect("embedded");
    for variant in [Variant::Tied, Variant::Stepped] {
        table.row(variant.to_string(), &beyond_the_first(&scene, variant).map(Some));
    }
    table
}

/// Returns what an iteration of a scene takes beyond the first, ms, and the least time of 20 over that of 1.
fn beyond_the_first(scene: &Scene, variant: Variant) -> [f64; 2] {
    let mut request = Request::new(scene).variant(variant);
    let [one, twenty] = [1, 20].map(|iterations| {
        request.iterations = iterations;
        least(5, || drop(black_box(solve(&request, &mut |_| ()).expect("it runs"))))
    });
    [1e3 * (twenty - one) / 19.0, twenty / one]
}

/// The listings of an iteration in Octave, where `octave-cli` is installed, beside the mirror's, and
/// beside an iteration of `stepped` with its solution.
fn octave(folder: &Path) -> Table {
    const CALLS: usize = 3;
    let columns = ["Octave, ms", "mirror, ms", "ratio", "iteration with solution, ms", "ratio"];
    let mut table = Table::new("`c_cnt` and `Km` of `strand` in Octave, an iteration", &columns);
    if Command::new("octave-cli").arg("--version").stdout(Stdio::null()).status().is_err() {
        return table;
    }
    let (scene, reading) = (Scene::open("strand").expect("embedded"), Reading::default());
    let sheet = door::worksheet(&scene.model, |x| x);
    let (title, thickness) = ("strand", scene.model.thickness);
    let (sheet, reading, node_n) = (&sheet, &reading, &sheet.node);
    let export = Export { title, sheet, reading, node_n, thickness, run: None };
    let program = exports::octave::program(&export);
    let timed = format!(
        "  started = tic();\n  for call = 1:{CALLS}\n    MJS = Km(c_cnt(node_n));\n  end\n  \
         show('seconds', toc(started) / {CALLS});\n  show('size', sum(sum(abs(MJS))));\n"
    );
    let program = program.replace("  show('MJS', Km(k_cnt));\n", &timed);
    std::fs::write(folder.join("strand.m"), program).expect("it is written");
    let output = Command::new("octave-cli")
        .args(["--no-init-file", "--eval", title])
        .current_dir(folder)
        .output()
        .expect("Octave starts");
    let printed = String::from_utf8(output.stdout).expect("UTF-8");
    let number = |name: &str| -> f64 {
        let line = printed.lines().find_map(|line| line.strip_prefix(name)).expect("a line");
        line.split(' ').next_back().and_then(|word| word.parse().ok()).expect("a number")
    };
    let mirrored = || {
        let pairs = c_cnt(sheet, reading, node_n).expect("it runs");
        Km(sheet, reading, &pairs.k_cnt).expect("it runs").to_table().into_matrix()
    };
    let size: f64 = mirrored().iter().map(|x| x.abs()).sum();
    assert!((number("size") - size).abs() <= 1e-12 * size, "the matrices are the same");
    let octave = 1e3 * number("seconds");
    let mirror = 1e3 * least(5, || drop(black_box(mirrored())));
    let [whole, _] = beyond_the_first(&scene, Variant::Stepped);
    let values = [octave, mirror, octave / mirror, whole, octave / whole];
    table.row("one iteration", &values.map(Some));
    table
}

/// `c_cnt` of the paper's example, listing and mirror in turn.
fn interpreter() -> Table {
    let reading = Reading::default();
    let sheet = door::worksheet(&Scene::open("strand").expect("embedded").model, |x| x);
    let (listing, settings) = (Which::CCnt.under(&reading), settings(&reading));
    let interpreted = || listings::c_cnt(&listing, &settings, &sheet, &sheet.node, None);
    let mirrored = || c_cnt(&sheet, &reading, &sheet.node);
    assert_eq!(interpreted().expect("it runs").0, mirrored().expect("it runs"));
    let listing = 1e3 * least(200, || drop(black_box(interpreted())));
    let mirror = 1e3 * least(200, || drop(black_box(mirrored())));
    let mut table = Table::new(
        "`c_cnt` of `strand`, interpreted and mirrored",
        &["listing, ms", "mirror, ms", "ratio", "limit"],
    );
    table.row("one call", &[Some(listing), Some(mirror), Some(listing / mirror), Some(200.0)]);
    table
}
