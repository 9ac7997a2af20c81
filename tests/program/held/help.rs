//! The passages of the texts of help, all pages one behind the other, their examples left out.

use std::path::Path;

use plane_contact::numbers::solve::{Arithmetic, Solver};
use plane_contact::problem::model::{Body, Model};
use plane_contact::problem::modelling::{Friction, Geometry, LOAD_STEPS};
use plane_contact::problem::scene::SceneBuilder;
use plane_contact::report::MOST_TRIANGLES;
use plane_contact::studies::benchmark::{
    Annulus, Blocks, Cook, Ellipse, Hertz, Hole, Punch, PunchPatch, Strand,
};
use plane_contact::studies::calculix::Pair;
use plane_contact::studies::{extremes, trade};
use plane_contact::{Request, Scene};

use super::Passages;
use super::measured::{STRAND, digits_of_two, mean_edge, solved as solve, stiffest};
use crate::common::fitted_hertz::over_hertz;
use crate::common::program::run;
use crate::common::recovery::{node_at, solved};

pub const PASSAGES: Passages = Passages {
    computed: &[commands, patches, hertz, punch, plates, strand],
    given: &[
        ("eq. (1)", "the number of an equation of the paper"),
        (
            "such as origin=0,zero-over-zero=0,exact-boolean=false. origin N (default 1), zero-over-zero error|0,",
            "the names of a worksheet's settings",
        ),
        ("last-if previous|0, tiny itself|0", "as above"),
        ("printed lines, such as 16-18, or 7", "lines of a listing"),
        ("Mathcad 13 to 15", "versions of Mathcad"),
        ("fig. 4", "the number of a figure of the paper"),
        ("fig. 5", "as above"),
        (
            "Exit status: 0 done; 1 what was compared differs; 2 the input is at fault; 3 the published",
            "exit statuses are held by tests/program/cli.rs",
        ),
        ("4 no equilibrium was found", "as above"),
        ("Exit status: 0 where results were compared", "held by tests/program/cases/worksheets.rs"),
        (
            "1 where one differs or none could be compared, 2 where the file is no worksheet",
            "as above",
        ),
        ("[default: 1073741824]", "the default limit of steps, of `Limits`"),
        ("1 = in contact", "the meaning of a value, its definition"),
        ("Coulomb's coefficient, 0 (contact nodes slide freely)", "as above"),
        ("NAFEMS CGS-1", "the name of a benchmark"),
        ("Finite Element Contact Problems, CGS-1", "as above"),
        ("MSH 2.2", "a version of a file format"),
        ("P / (pi sqrt(a^2 - x^2))", "a formula"),
        ("Springer, 1991.", "the year of a source"),
        ("Contact Mechanics, 1985, section 4.2.", "a place in a source"),
        ("Contact Mechanics, 1985, section 2.8.", "as above"),
        ("art. 28.", "as above"),
        ("art. 35.", "as above"),
        ("ASCE 100 (1974) 1851-1863.", "as above"),
        ("rev. 3, 1990, test", "as above"),
        ("23.96 in the limit", "the published number of a benchmark"),
        ("sigma_y = 92.7 MPa at (2, 0)", "as above"),
        ("a strand 15K7 is 15.2 mm thick", "the name of a strand and its thickness"),
        ("symmetric about x = 0", "a line"),
        (
            "The whole takes 30 to 80 times as long as solve",
            "measured on fig1, two-blocks and strand",
        ),
        ("It takes 30 to 80 times as long as solve, and 3 times with --no-audit", "as above"),
        ("The whole takes 50 to 150 times as long as solve", "as above"),
        ("on a scene of 20 nodes is 50 times as long as solve", "as above"),
        ("It takes 300 times as long as solve on fig1", "as above"),
        ("It takes 150 times as long as solve on fig1", "as above"),
        ("strand's radius, 1 being half a disc", "the meaning of a value, its definition"),
        ("(48, 52) is a node where it is even", "a place"),
    ],
};

/// Every page of help, without examples, which are commands, and without what clap writes of itself:
/// defaults that are numbers.
pub fn pages() -> String {
    let of =
        |command: String| page(&command.split_whitespace().chain(["--help"]).collect::<Vec<_>>());
    std::iter::once(String::new()).chain(crate::texts::commands()).map(of).collect()
}

fn page(args: &[&str]) -> String {
    let output = run(Path::new("."), args);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let is_default = |line: &&str| {
        let value = line.trim().strip_prefix("[default: ").and_then(|rest| rest.strip_suffix(']'));
        value.is_some_and(|value| value.parse::<f64>().is_ok())
    };
    let text = text.split("Examples:").next().expect("a page");
    let lines: Vec<&str> = text.lines().filter(|line| !is_default(line)).collect();
    lines.join("\n").replace("[default: 200]", "").replace("[default: 1]", "") + "\n"
}

fn commands() -> Vec<String> {
    let km = String::from_utf8(run(Path::new("."), &["listing", "run", "Km", "fig1"]).stdout)
        .expect("UTF-8");
    let entry = km.split_whitespace().last().and_then(|entry| entry.split('e').next());
    let figures = entry.expect("an entry").chars().filter(char::is_ascii_digit).count();
    let pair = Pair::new(&STRAND.model, None, Friction::STICK);
    vec![
        format!("f64x2 ({} digits)", digits_of_two()),
        stops_at(16.0),
        format!("[default: the scene's, or {LOAD_STEPS}]"),
        format!(
            "[default: {:.0} times the largest E over the target's mean edge]",
            pair.penalty * mean_edge() / stiffest()
        ),
        format!("keeps fewer than {} digits", extremes::LEAST),
        format!("what has taken {} s is not run again", trade::PATIENCE),
        format!("coordinate format, {figures} significant digits"),
        format!("Beyond {} triangles result.json leaves", thousands(MOST_TRIANGLES)),
    ]
}

/// A number below a million with a comma before its last three digits.
fn thousands(number: usize) -> String {
    format!("{},{:03}", number / 1000, number % 1000)
}

/// Where cg stops unless it is told: at so many units of the scalar's last place.
fn stops_at(eps: f64) -> String {
    let fig1 = Scene::open("fig1").expect("an embedded scene");
    let by = |tol| {
        let arithmetic = Arithmetic { solver: Some(Solver::Cg), tol, ..Arithmetic::default() };
        solve(&Request::new(&fig1).arithmetic(arithmetic)).u
    };
    assert_eq!(by(None), by(Some(eps * f64::EPSILON)), "cg stops elsewhere");
    format!("[default: {eps} eps of the scalar]")
}

fn built(benchmark: Result<SceneBuilder, plane_contact::error::InputError>) -> Scene {
    benchmark.and_then(|builder| builder.build()).expect("the defaults are sound")
}

/// `E = 30000`, `nu = 0.2` of a body.
fn material(model: &Model, body: &str) -> [String; 2] {
    let body = model.bodies.iter().find(|b| b.name == body).expect("the body");
    let material = model.triangle(body.triangles[0]).material;
    [format!("E = {}", material.e), format!("nu = {}", material.nu)]
}

/// Width and height of a body.
fn size(model: &Model, body: &Body) -> [f64; 2] {
    [0, 1].map(|axis| {
        let of = body.nodes.iter().map(|node| model.at(*node)[axis]);
        of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
    })
}

/// A body's size as `50 x 25`.
fn across(model: &Model, body: &str) -> String {
    let body = model.bodies.iter().find(|b| b.name == body).expect("the body");
    let [width, height] = size(model, body).map(|length| (1e9 * length).round() / 1e9);
    format!("{width} x {height}")
}

fn patches() -> Vec<String> {
    let blocks = solved(Blocks::default().generate());
    let top = blocks.u.iter().skip(1).step_by(2).fold(0.0_f64, |least, v| least.min(*v));
    let [e, nu] = material(&blocks.model, "lower");
    let (stress, each) = (&blocks.elements[0], across(&blocks.model, "lower"));
    assert_eq!(each, across(&blocks.model, "upper"));
    let punch = built(PunchPatch::default().generate());
    let [punch_e, punch_nu] = material(&punch.model, "punch");
    vec![
        format!("sigma_y = {:.1} MPa everywhere", stress.sigma[1]),
        format!(
            "Each {each} mm, {e} MPa, {nu}, plane strain: von Mises {:.3} MPa, top displacement \
             {top:.6} mm.",
            stress.von_mises_stress
        ),
        format!(
            "Foundation {}, punch {}, {punch_e}, {punch_nu}, plane strain.",
            across(&punch.model, "foundation"),
            across(&punch.model, "punch")
        ),
    ]
}

fn hertz() -> Vec<String> {
    let hertz = Hertz::default();
    let model = built(hertz.generate()).model;
    let [[stiff, nu], [soft, _]] = ["cylinder", "block"].map(|body| material(&model, body));
    let body = model.bodies.iter().find(|body| body.name == "block").expect("a block");
    let [half, height] = size(&model, body);
    let peak = |geometry| over_hertz(40, hertz.load, |model| model.geometry = geometry)[1];
    let higher = 100.0 * (peak(Geometry::Current) / peak(Geometry::Initial) - 1.0);
    vec![
        format!(
            "a cylinder of radius {} mm ({stiff} MPa) on a block of {:.0} x {height:.0} mm ({soft} \
             MPa), {nu}, plane strain, {} N/mm, of which the model carries half: half width {:.4} \
             mm, peak pressure {:.1} MPa.",
            hertz.radius,
            2.0 * half,
            hertz.load,
            hertz.half_width(),
            hertz.peak_pressure()
        ),
        format!("the peak is {higher:.1} % higher at any mesh"),
    ]
}

fn punch() -> Vec<String> {
    let model = built(Punch::default().generate()).model;
    let [e, _] = material(&model, "punch");
    let [soft, nu] = material(&model, "foundation");
    let [_, load] = model.total_load();
    let a = size(&model, model.bodies.iter().find(|b| b.name == "punch").expect("a punch"))[0];
    vec![format!(
        "with a = {a} and {}, foundation {soft}, {nu}, plane strain, P = {} on both halves ({} on \
         the model)",
        e.replace("10000000", "1e7"),
        -2.0 * load,
        -load
    )]
}

fn plates() -> Vec<String> {
    let [annulus, hole, cook, ellipse] = [
        Annulus::default().generate(),
        Hole::default().generate(),
        Cook::default().generate(),
        Ellipse::default().generate(),
    ]
    .map(|benchmark| built(benchmark).model);
    let [wall, sheet, membrane, le1] =
        [(&annulus, "wall"), (&hole, "sheet"), (&cook, "membrane"), (&ellipse, "membrane")]
            .map(|(model, body)| material(model, body));
    let radius = |model: &Model, reduce: fn(f64, f64) -> f64| {
        let of = model.nodes.iter().map(|[x, y]| x.hypot(*y));
        (1e9 * of.reduce(reduce).expect("nodes")).round() / 1e9
    };
    let (inner, outer) = (radius(&annulus, f64::min), radius(&annulus, f64::max));
    let p = annulus.total_load()[0] / inner;
    let (a2, b2, e, nu) = (inner * inner, outer * outer, 30000.0, 0.2);
    let u = (1.0 + nu) * p * a2 / (e * (b2 - a2)) * ((1.0 - 2.0 * nu) * inner + b2 / inner);
    let corners = [[0, 0], [48, 44], [48, 60], [0, 44]];
    for corner in corners {
        node_at(&cook, corner.map(f64::from));
    }
    for end in [[2.0, 0.0], [0.0, 1.0], [3.25, 0.0], [0.0, 2.75]] {
        node_at(&ellipse, end);
    }
    let corners = corners.map(|[x, y]| format!("({x}, {y})")).join(", ");
    vec![
        format!(
            "Radii {inner} and {outer} mm, {p:.0} MPa inside, {} MPa, {}, plane strain. At the \
             bore: u = {u:.8} mm, hoop stress {:.4} MPa.",
            wall[0],
            wall[1],
            p * (b2 + a2) / (b2 - a2)
        ),
        format!(
            "Hole of radius {}, {}, {}, plane stress.",
            radius(&hole, f64::min),
            sheet[0],
            sheet[1]
        ),
        format!(
            "At the hole sigma_x = {} at (0, 1) and sigma_y = {} at (1, 0).",
            Hole::stress([0.0, 1.0])[0],
            Hole::stress([1.0, 0.0])[1]
        ),
        format!("under a shear load of {:.0} on its right edge", cook.total_load()[1]),
        format!("Corners {corners}; {}, nu = 1/3, plane stress.", membrane[0]),
        format!("Vertical displacement of ({}, {}):", 48, 52),
        format!(
            "Inner ellipse 2 x 1 m, outer 3.25 x 2.75 m, thickness {} m, 10 MPa outward on the \
             outer edge, {} MPa, {}, plane stress.",
            ellipse.thickness, le1[0], le1[1]
        ),
    ]
}

fn strand() -> Vec<String> {
    let scene = built(Strand::default().generate());
    let [[soft, soft_nu], [stiff, nu]] =
        ["block", "stamp"].map(|body| material(&scene.model, body));
    let [_, load] = scene.model.total_load();
    let pressure = -load / (2.0 * Strand::default().strand);
    vec![
        format!(
            "a block of {} mm, {soft} MPa, {soft_nu}; a stamp with {stiff} MPa, {nu}, simplified \
             with its contact surface kept; {pressure:.1} MPa on its top; symmetry on the outer \
             sides; c_tol = {}; {} iterations.",
            across(&scene.model, "block"),
            scene.model.contact.tolerance,
            scene.iterations
        ),
        format!("plane strain, thickness {} mm", scene.model.thickness),
        "up to 9 times longer".into(),
    ]
}
