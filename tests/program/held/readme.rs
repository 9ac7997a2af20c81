//! The passages of README.md.

use std::collections::BTreeMap;

use plane_contact::Request;
use plane_contact::engine::{Assessment, Measured, Session, Solution};
use plane_contact::numbers::solve::{ScalarName, Solver};
use plane_contact::problem::modelling::{Coupling, Friction, LOAD_STEPS, Variant};
use plane_contact::problem::scene::symmetry;
use plane_contact::report;
use plane_contact::studies::audit::statuses::Row;
use plane_contact::studies::benchmark::{Annulus, Blocks, Cook, Ellipse, Hertz, Hole, PunchPatch};
use plane_contact::studies::calculix::{Comparison, Pair};
use serde_json::json;

use super::Passages;
use super::measured::{
    BESIDE_CALCULIX, STATUSES, STRAND, VARIANTS, apart, below, digits_of_two, golden, jump,
    mean_edge, own_equilibrium, solved, stiffest, turned,
};
use crate::claims::JUDGED;
use crate::common::fitted_hertz::over_hertz;
use crate::common::json::build;
use crate::common::recovery::{averaged, extrapolated, node_at, order, solved as run, solved_by};
use crate::common::tolerances::{BALANCE, CATTANEO, COMPLEMENTARITY, PUNCH, SHEAR_LAG};

pub const PASSAGES: Passages = Passages {
    computed: &[
        evidence, example, variants, claims, calculix, defaults, patches, hertz, plates,
        tolerances, c_tol, iterations, statuses, halves, arithmetic, extremes, mutants,
    ],
    given: &[
        ("eq. (1)", "the number of an equation of the paper"),
        ("(its figure 1)", "the number of a figure of the paper"),
        ("fig. 2", "as above"),
        ("fig. 3", "as above"),
        ("fig. 4, fig. 5", "as above"),
        ("so have 82 of the results", "held by tests/fidelity/mathcad/package.rs"),
        ("recalculated by Mathcad 14.1.5, 6 agree", "as above, and a version"),
        ("If you have Mathcad 14 or\n15, open", "versions of Mathcad"),
        ("to fewer than 300 nodes", "the limit of `export`, held by tests/program/mathcad.rs"),
        ("NAFEMS CGS-1", "the name of a benchmark"),
        ("with exit status 3", "exit statuses are held by tests/program/cli.rs"),
        ("the exit status is 4", "as above"),
        ("exit status 1 where one differs", "held by tests/program/cases/worksheets.rs"),
        ("Exit status: 0 done, 1 what was compared differs, 2 the input is at fault", "as above"),
        ("3 the published algorithm fails as printed, 4 no equilibrium", "as above"),
        ("friction 0.2 both |", "which runs are compared"),
        ("MSH 2.2 or 4.1", "versions of a file format"),
        ("(number, type, 2, physical tag", "a column of the paper's tables: a number of tags"),
        ("numbered 1 to R", "the paper counts from 1"),
        ("sqrt(2/3 e:e)", "a formula"),
        ("up to 0.75 a", "where a limit is tested"),
        ("Q/(μ P) = 0.25 and 0.5", "the loads of a benchmark"),
        ("n = 2 .. 64", "the meshes of a benchmark"),
        ("LE1, 8² .. 64²", "as above"),
        ("limit 92.7", "the published number of a benchmark"),
        ("(or `COLUMNS`) from 40 characters up", "held by tests/program/printed.rs"),
        (
            "prescribed displacements other than 0, a crack",
            "the meaning of a value, its definition",
        ),
        ("in at most 20 iterations under one load", "held by tests/contact/unilateral.rs"),
        ("at 1 − 2nu =", "a formula"),
        ("| c_cnt 14: weights", "lines of the listings"),
        ("| Km 7: index", "as above"),
        ("| Km 16-33: one", "as above"),
        ("| c_cnt 17, 18: how", "as above"),
        ("| c_cnt 22, 23: initial", "as above"),
        (
            "ORIGIN 0, 0/0 = 0, comparisons to 1e-12, numbers below 1e-307 as 0, an empty 1 .. 0, a failed last `if` as 0",
            "the names of a worksheet's settings",
        ),
        ("on strains over 1 + ν", "a formula"),
        ("all counted from 1", "the paper counts from 1"),
        ("R x 4", "the shape of a symbol, its definition"),
        ("(Gmsh 2 rows)", "a version of a file format"),
        ("rows x 8", "the shape of a symbol, its definition"),
        ("from column `ind_1` = 6 | M x 8", "as above"),
        ("0 = none", "the meaning of a value, its definition"),
        ("1 = in contact", "as above"),
        ("1 = restrained; entry 2n−1 for x, 2n for y", "as above"),
        ("| 2R |", "the shape of a symbol, its definition"),
        ("M of 3 x 6; 3 x 3", "as above"),
        ("| 6 | - |", "as above"),
        ("0 where restrained, else 1", "the meaning of a value, its definition"),
        ("2R x 2R", "the shape of a symbol, its definition"),
        ("as of 24 November 2026", "a date"),
        ("MIT or Apache-2.0", "the name of a licence"),
        ("length³; 1/length; stress", "a unit"),
    ],
};

/// What `solve strand` says of the scene.
/// What Mathcad itself saved.
fn evidence() -> Vec<String> {
    let [_, saved, same] = crate::evidence::counts();
    vec![format!(
        "Of {saved} numbers that Mathcad itself saved with expressions of public worksheets, {same} have"
    )]
}

fn example() -> Vec<String> {
    let model = &STRAND.model;
    let [fx, fy] = model.total_load();
    let (nodes, triangles, iterations) =
        (model.nodes.len(), model.triangles.len(), STRAND.iterations);
    vec![
        format!("pressed on the wall of its duct in concrete; {iterations} iterations;"),
        format!(
            "{},{:03} nodes, {},{:03} triangles, plane strain, {iterations} iterations, load \
             {:.2} N per mm of thickness.",
            nodes / 1000,
            nodes % 1000,
            triangles / 1000,
            triangles % 1000,
            fx.hypot(fy)
        ),
        format!("eq. (1) on increments, {iterations} equal steps"),
        format!("*{iterations} iterations*"),
        format!("| \"{iterations} iterations\" |"),
    ]
}

/// The rows of the first table: contact nodes at the end, load that reaches the block, largest von
/// Mises stress of block and stamp, errors in the energy norm against the equilibrium under the
/// scene's own friction and against the reference solution.
fn variants() -> Vec<String> {
    let [printed, ..] = &*VARIANTS;
    let block = printed.model.target().expect("strand has contact");
    let moved = block.nodes.iter().flat_map(|node| node.of(&printed.u)).map(f64::abs);
    let moved = format!("its displacements are exactly {}", moved.fold(0.0, f64::max));
    VARIANTS.iter().map(cells).chain([moved]).collect()
}

fn cells(solution: &Solution) -> String {
    let others = [Some(&VARIANTS[5]), Some(own_equilibrium())];
    let assessment = Assessment::against(solution, &Session::default(), others);
    let [fx, fy] = solution.model.total_load();
    let share = 100.0 * solution.target_force() / fx.hypot(fy);
    let stresses: Vec<String> = assessment
        .bodies
        .iter()
        .map(|body| match body.max_von_mises_stress {
            0.0 => "0".into(),
            stress => format!("{stress:.1}"),
        })
        .collect();
    let error = |measured: Option<&Measured>| {
        let error = measured.expect("strand has both").distance.energy_relative;
        if error == 0.0 { "0".into() } else { format!("{:.0} %", 100.0 * error) }
    };
    let errors = [assessment.own(), assessment.measure()].map(error).join(" | ");
    format!("| {} | {share:.0} % | {} | {errors} |", contact(solution), stresses.join(" / "))
}

fn contact(solution: &Solution) -> String {
    let (last, count) = (solution.last(), solution.last().in_contact);
    if solution.request.variant == Variant::Unilateral {
        let path = solution.equilibrium.as_ref().and_then(|found| found.path.as_ref());
        return match path {
            Some(path) => format!("{count} after {} steps of the load", path.steps),
            None => format!("{count} in {} iterations", solution.steps.len()),
        };
    }
    match &last.cycle {
        Some(cycle) if cycle.length == 1 => format!("{count}, settled"),
        Some(cycle) => {
            let counts = cycle.members.iter().map(|k| solution.steps[k - 1].in_contact);
            let mut counts: Vec<usize> = counts.collect();
            counts.sort_unstable();
            let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
            format!("cycle of {}: {}", cycle.length, counts.join(" and "))
        }
        None => format!("{count}, still changing"),
    }
}

/// The tables of claims, as the program writes it: line by line, so that a number that changed is
/// seen.
fn claims() -> Vec<String> {
    let tables =
        [report::claims::verdicts(&JUDGED).markdown(), report::claims::range(&JUDGED).markdown()];
    tables.iter().flat_map(|table| table.lines().skip(2)).map(String::from).collect()
}

/// The table beside CalculiX; where `ccx` is not installed its rows are taken as they stand.
fn calculix() -> Vec<String> {
    let pair = Pair::new(&STRAND.model, None, Friction::STICK);
    let penalty = format!(
        "penalty {:.3e} MPa/mm, {:.0} times E over the edge length",
        pair.penalty,
        pair.penalty * mean_edge() / stiffest()
    );
    let rows = match &*BESIDE_CALCULIX {
        Some(comparisons) => READINGS.iter().zip(comparisons).map(beside).collect(),
        None => {
            eprintln!("ccx is not installed: README's table beside CalculiX is not computed");
            let readme = include_str!("../../../README.md");
            let of_the_table = |line: &&str| READINGS.iter().any(|name| line.starts_with(name));
            let after = readme.lines().skip_while(|line| !line.starts_with("| reading |"));
            after.filter(of_the_table).map(String::from).collect::<Vec<_>>()
        }
    };
    [vec![penalty], rows].concat()
}

/// The heads of the table's rows, in the order of `BESIDE_CALCULIX`.
const READINGS: [&str; 7] = [
    "| `printed` |",
    "| `tied` |",
    "| `stepped` |",
    "| `unilateral`, `nts` |",
    "| `unilateral`, `nts`, friction 0.2 both |",
    "| `unilateral`, `nts`, frictionless both |",
    "| `unilateral`, `mortar` |",
];

fn beside((head, comparison): (&&str, &Comparison)) -> String {
    let stress = |body: usize| {
        let body = &comparison.bodies[body];
        let relative = 100.0 * body.relative().expect("CalculiX has stress in both bodies");
        format!("{:.1} / {:.1}: {:.1} %", body.ours, body.calculix, relative.abs())
    };
    let apart = comparison.displacement.largest.relative.expect("CalculiX has displacements");
    let apart = 100.0 * apart;
    format!("{head} {apart:.1} % | {} | {} |", stress(0), stress(1))
}

/// What a scene file leaves out.
fn defaults() -> Vec<String> {
    let scene = build(&json!({
        "plane": "strain",
        "node": [[1, 0.0, 0.0, 0.0], [2, 1.0, 0.0, 0.0], [3, 0.0, 1.0, 0.0]],
        "elem": [[1, 2, 2, 1, 1, 1, 2, 3]],
        "materials": { "1": { "E": 1.0, "nu": 0.3 } },
        "restraints": [{ "node": 1, "fix": ["x", "y"] }, { "node": 2, "fix": ["y"] }]
    }))
    .expect("a scene with nothing optional");
    vec![
        format!("`thickness` ({})", scene.model.thickness),
        format!("`iterations` ({})", scene.iterations),
        format!("`load_steps` ({LOAD_STEPS}: equal steps"),
    ]
}

/// Least and largest sigma_y / p of the patch test under node to segment, and how far that is from
/// −1, in per cent.
fn misses(upper: usize, lower: usize) -> [f64; 2] {
    let blocks = Blocks { upper, lower }.generate();
    let solution = solved_by(blocks, |model| model.coupling = Coupling::Nts);
    let off = solution.elements.iter().map(|state| 100.0 * (state.sigma[1] / P + 1.0));
    off.fold([0.0; 2], |[least, most], off| [f64::min(least, off), f64::max(most, off)])
}

/// The pressure of the patch test, MPa.
const P: f64 = 6.3;

fn patches() -> Vec<String> {
    let (upper, lower) = (Blocks::default().upper, Blocks::default().lower);
    let mortar = solved_by(Blocks::default().generate(), |m| m.coupling = Coupling::Mortar);
    let top = mortar.u.iter().skip(1).step_by(2).fold(0.0_f64, |least, v| least.min(*v));
    let von_mises = mortar.elements[0].von_mises_stress;
    let off = |of: &Solution, p: f64| {
        of.elements.iter().map(|state| (state.sigma[1] / p + 1.0).abs()).fold(0.0, f64::max)
    };
    let [least, most] = misses(upper, lower);
    let [fine_least, fine_most] = misses(4 * upper, 4 * lower);
    assert!(fine_least < 0.9 * least && fine_most > 0.9 * most, "refinement does not help");
    let [other_least, other_most] = misses(lower, upper);
    let punch = run(PunchPatch::default().generate());
    vec![
        format!(
            "| contact patch test, {upper} on {lower} divisions | von Mises {von_mises:.3}, top \
             −{:.6} | `mortar` to {}; `nts` misses sigma_y by {most:.1} to {:.1} %, also on a mesh \
             four times as fine, and by {:.1} % with {lower} on {upper} |",
            -top,
            below(off(&mortar, P), "1e-13"),
            -least,
            (-other_least).max(other_most)
        ),
        format!("| sigma_y = −p everywhere | `mortar` to {} |", below(off(&punch, 1.0), "1e-13")),
    ]
}

fn hertz() -> Vec<String> {
    let hertz = Hertz::default();
    let [half_width, peak] =
        over_hertz(hertz.size, hertz.load, |_| ()).map(|ratio| 100.0 * (ratio - 1.0).abs());
    let equations = hertz.generate().and_then(|b| b.build()).expect("it is sound").model.dofs();
    vec![format!(
        "| half width {:.4}, peak {:.1} | fitted without the node on the axis: half width \
         {half_width:.2} %, peak {peak:.2} % at {},{:03} equations |",
        hertz.half_width(),
        hertz.peak_pressure(),
        equations / 1000,
        equations % 1000
    )]
}

/// Lamé, Kirsch, Cook, NAFEMS LE1.
fn plates() -> Vec<String> {
    let annulus = |n| run(Annulus { radial: n, around: 2 * n }.generate());
    let bore = |solution: &Solution| {
        let node = node_at(&solution.model, [50f64.sqrt(); 2]);
        let [x, y] = node.of(&solution.u);
        let [xx, yy, xy] = extrapolated(solution, node);
        [x.hypot(y), (xx + yy) / 2.0 - xy]
    };
    let (p, [a2, b2], e, nu) = (10.0, [100.0_f64, 400.0], 30000.0, 0.2);
    let exact =
        (1.0 + nu) * p * a2 / (e * (b2 - a2)) * ((1.0 - 2.0 * nu) * a2.sqrt() + b2 / a2.sqrt());
    let [coarse, fine] = [32, 64].map(|n| bore(&annulus(n)));
    let [top, side] = [[0.0, 1.0], [1.0, 0.0]].map(|place| {
        let hole = run(Hole { around: 64, ..Hole::default() }.generate());
        extrapolated(&hole, node_at(&hole.model, place))
    });
    let cook = |n| {
        let solution = run(Cook { n }.generate());
        node_at(&solution.model, [48.0, 52.0]).of(&solution.u)[1]
    };
    let ellipse = |n| {
        let solution = run(Ellipse { n }.generate());
        let node = node_at(&solution.model, [2.0, 0.0]);
        [averaged(&solution, node)[1], extrapolated(&solution, node)[1]]
    };
    let [known, finest] = [ellipse(8)[0], ellipse(64)[0]];
    vec![
        format!(
            "| Lamé | u(ri) {exact:.8}, hoop {:.4} | {:.8}, {:.4}; order {:.2} in u |",
            p * (b2 + a2) / (b2 - a2),
            fine[0],
            fine[1],
            order(coarse[0] - exact, fine[0] - exact)
        ),
        format!(
            "| Kirsch | {} and −{} | {:.3}, −{:.3} |",
            Hole::stress([0.0, 1.0])[0],
            -Hole::stress([1.0, 0.0])[1],
            top[0],
            -side[1]
        ),
        format!("| Cook, n = 2 .. 64 | {:.3} .. {:.3} |", cook(2), cook(64)),
        format!("| NAFEMS LE1, 8² .. 64² | {known:.2} .. {finest:.2}, limit"),
        format!("extrapolated {:.1} |", ellipse(64)[1]),
    ]
}

/// Limits that tests of their own hold.
fn tolerances() -> Vec<String> {
    let stick = |pull: f64| (1.0 - pull).sqrt();
    vec![
        format!("| {:.1} % up to 0.75 a |", 100.0 * PUNCH.limit),
        format!("within {} heights of the strip", SHEAR_LAG.limit),
        format!(
            "| Cattaneo and Mindlin, Q/(μ P) = 0.25 and 0.5 | zone of stick c/a = {:.3} and {:.3} \
             | {:.1} % |",
            stick(0.25),
            stick(0.5),
            100.0 * CATTANEO.limit
        ),
        format!(
            "forces balance to {:e} of the load, gap times pressure is 0 to {:e} of its scale",
            BALANCE.limit, COMPLEMENTARITY.limit
        ),
    ]
}

/// The tolerance, in numbers in which rounding decides nothing.
fn c_tol() -> Vec<String> {
    let at = |variant, c_tol| {
        turned(variant, ScalarName::F64x2, |request| request.tolerance = Some(c_tol))
    };
    let own = STRAND.model.contact.tolerance;
    let stepped = [own, 1e-4, 1e-5, 1e-6].map(|c_tol| at(Variant::Stepped, c_tol));
    let tied = [own, 1e-6].map(|c_tol| at(Variant::Tied, c_tol));
    let errors = stepped.each_ref().map(|solution| apart(solution, own_equilibrium()));
    assert!(errors.iter().all(|error| *error >= errors[1]), "1e-4 is the nearest: {errors:?}");
    vec![
        format!("*c_tol = {own} is small enough"),
        format!(
            "From {own:e} to 1e-6 mm displacements change by {:.1} % (`stepped`) and {:.1} % (`tied`) \
             in `f64x2`;",
            apart(&stepped[3], &stepped[0]),
            apart(&tied[1], &tied[0])
        ),
        format!(
            "`stepped` is nearest that equilibrium at 1e-4: an error of {:.1} %, against {:.1} % at \
             {own:e}.",
            errors[1], errors[0]
        ),
    ]
}

fn iterations() -> Vec<String> {
    let [_, tied, stepped, ..] = &*VARIANTS;
    let more = |variant, iterations| {
        turned(variant, ScalarName::F64, |request| request.iterations = iterations)
    };
    let (own, most) = (STRAND.iterations, 320);
    let long = more(Variant::Stepped, most);
    let next = more(Variant::Tied, own + 1);
    vec![
        format!(
            "`tied` is in a cycle of {}, and iteration {} changes displacements by {:.0} %.",
            tied.last().cycle.as_ref().expect("it repeats").length,
            own + 1,
            apart(&next, tied)
        ),
        format!(
            "`stepped` changes by {:.1} % from {own} to {most} steps, and comes no nearer to that \
             equilibrium: {:.1} % and {:.1} %.",
            apart(&long, stepped),
            apart(stepped, own_equilibrium()),
            apart(&long, own_equilibrium())
        ),
    ]
}

/// The text's two remedies for a node that jumped deeper than c_tol, and the signed distance.
fn statuses() -> Vec<String> {
    let [signs, intersection, projection] = [0, 1, 2];
    let wrong = |row: &Row, rule: usize| 100.0 * row.rules[rule].wrong_share(row.nodes);
    let at = |depth, target, rule| wrong(jump(depth, target), rule);
    let upto = STATUSES.by_depth.iter().filter(|row| row.depth <= 128.0);
    let worst = upto.map(|row| wrong(row, intersection)).fold(0.0, f64::max);
    let operations = |rule: usize| -> f64 {
        STATUSES.by_size.iter().map(|row| row.rules[rule].operations as f64).sum()
    };
    vec![
        format!(
            "at twice c_tol {:.0} % of the statuses are wrong with the target below the stamp and \
             {:.0} % with it above, at 128 times {:.0} and {:.0} %;",
            at(2.0, "below", signs),
            at(2.0, "above", signs),
            at(128.0, "below", signs),
            at(128.0, "above", signs)
        ),
        format!(
            "the text's other remedy is wrong in {worst:.1} % at most up to 128 times and in \
             {:.0} to {:.0} % at 512, where whole elements have sunk, and takes, over all sizes \
             tried, {:.1} times the operations; the signed distance takes {:.1} times.",
            at(512.0, "below", intersection),
            at(512.0, "above", intersection),
            operations(intersection) / operations(signs),
            operations(projection) / operations(signs)
        ),
    ]
}

fn halves() -> Vec<String> {
    let half = symmetry::half(&STRAND).expect("the strand is symmetric");
    let change = |whole: &Solution| {
        let of_half = solved(&Request::new(&half.scene).variant(whole.request.variant));
        let differences = half.nodes.iter().enumerate().map(|(k, node)| {
            let ([x, y], [own_x, own_y]) =
                (node.of(&whole.u), [of_half.u[2 * k], of_half.u[2 * k + 1]]);
            (x - own_x).hypot(y - own_y)
        });
        differences.fold(0.0, f64::max) / plane_contact::engine::max_displacement(&whole.u)
    };
    let [_, tied, stepped, unilateral, ..] = &*VARIANTS;
    vec![format!(
        "has the same answer under `unilateral` (to {}), but not under the published variants, \
         which change by {:.0} % (`tied`) and {:.1} % (`stepped`)",
        below(change(unilateral), "1e-12"),
        100.0 * change(tied),
        100.0 * change(stepped)
    )]
}

/// What rounding does by either solver, and the digits of numbers.
fn arithmetic() -> Vec<String> {
    let stepped = &VARIANTS[2];
    let best = turned(Variant::Stepped, ScalarName::F64x2, |_| ());
    let dense = turned(Variant::Stepped, ScalarName::F64, |request| {
        request.arithmetic.solver = Some(Solver::DenseLu);
    });
    let worst = [stepped, &dense].map(|solution| apart(solution, &best) / 100.0);
    vec![
        format!(
            "errs alike (both below {} of the largest displacement)",
            below(worst[0].max(worst[1]), "1e-12")
        ),
        format!("`f64x2` has {} digits", digits_of_two()),
    ]
}

/// Where f64 breaks down: the golden table of `extremes`.
fn extremes() -> Vec<String> {
    let at = |table, row, column| golden("extremes/table.snap", table, row, column);
    let (below, above) = (2, 4);
    vec![
        format!("f64 breaks down at moduli {} apart", at("moduli:", "tied f64", above)),
        format!("at 1 − 2nu = {}", at("incompressible:", "tied f64", below)),
        format!("pressed to {} of their length", at("slivers:", "tied f64", below)),
        format!(
            "at lengths of {} and {} unless scaled",
            at("lengths:", "tied f64", below),
            at("lengths:", "tied f64", above)
        ),
        format!(
            "keeps fewer than {} digits at {} rad",
            plane_contact::studies::extremes::LEAST,
            at("steep-edge:", "yt 7e-4 off the edge f64", below)
        ),
    ]
}

/// What `.ci/mutants/kept.json` has: a letter for each mutant, `-` where it is not graded.
fn mutants() -> Vec<String> {
    let kept: BTreeMap<String, BTreeMap<String, String>> =
        serde_json::from_str(include_str!("../../../.ci/mutants/kept.json")).expect("JSON");
    let letters = || kept.values().flat_map(BTreeMap::values).flat_map(|letters| letters.chars());
    let count = |of: &str| letters().filter(|letter| of.contains(*letter)).count();
    let (noticed, graded) = (count("ct"), count("ctmuo"));
    let part = 100.0 * noticed as f64 / graded as f64;
    vec![format!("of {graded} such mutants the tests notice {noticed}, {part:.1} %")]
}
