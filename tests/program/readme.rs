//! The numbers of README.md's first table are those that the program computes.

use plane_contact::answer::{Assessment, Measured};
use plane_contact::problem::modelling::{ContactModel, Coupling, Variant};
use plane_contact::{Request, Scene, Solution, solve};

/// The row's cells behind its words: contact nodes at the end, load that reaches the block, largest
/// von Mises stress of block and stamp, errors in the energy norm against the equilibrium under the
/// scene's own friction and against the reference solution.
fn cells(request: &Request, [own, reference]: [&Solution; 2]) -> String {
    let solution = solve(request, &mut |_| ()).expect("the variant runs");
    let assessment = Assessment::against(&solution, [Some(reference), Some(own)]);
    let [fx, fy] = solution.model.total_load();
    let share = 100.0 * solution.last().target_force / fx.hypot(fy);
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
    format!("| {} | {share:.0} % | {} | {errors} |", contact(&solution), stresses.join(" / "))
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

#[test]
fn the_papers_example() {
    let readme = include_str!("../../README.md");
    let scene = Scene::open("strand").expect("an embedded scene");
    let request = Request::new(&scene);
    let mortar = ContactModel { coupling: Coupling::Mortar, ..scene.contact };
    let rows = [
        ("| `printed` |", request.clone().variant(Variant::Printed)),
        ("| `tied` |", request.clone().variant(Variant::Tied)),
        ("| `stepped` |", request.clone().variant(Variant::Stepped)),
        ("| `unilateral` |", request.clone().variant(Variant::Unilateral)),
        (
            "| `unilateral` with `mortar` |",
            request.clone().variant(Variant::Unilateral).contact(mortar),
        ),
        ("| the reference solution |", request.reference()),
    ];
    let solved = |request: Request| solve(&request, &mut |_| ()).expect("strand has both");
    let others = [request.equilibrium(), request.reference()].map(solved);
    for (head, request) in rows {
        let row = readme.lines().find(|line| line.starts_with(head)).expect("README has the row");
        let cells = cells(&request, others.each_ref());
        assert!(row.ends_with(&cells), "README: {row}\nthe program: {cells}");
    }
}
