//! The numbers of README.md's first table are those that the program computes.

use plane_contact::answer::Assessment;
use plane_contact::problem::modelling::{ContactModel, Coupling, Variant};
use plane_contact::{Request, Scene, Solution, solve};

/// The row's cells behind its words: contact nodes at the end, load that reaches the block, largest
/// von Mises stress of block and stamp, error against the reference solution in the energy norm.
fn cells(request: &Request) -> String {
    let solution = solve(request, &mut |_| ()).expect("the variant runs");
    let assessment = Assessment::new(&solution);
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
    let error =
        assessment.measure().expect("strand has a reference solution").distance.energy_relative;
    let error = if error == 0.0 { "0".into() } else { format!("{:.0} %", 100.0 * error) };
    format!("| {} | {share:.0} % | {} | {error} |", contact(&solution), stresses.join(" / "))
}

fn contact(solution: &Solution) -> String {
    let (last, count) = (solution.last(), solution.last().in_contact);
    if solution.request.variant == Variant::Unilateral {
        return format!("{count} in {} iterations", solution.steps.len());
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
        ("| `unilateral` with `mortar` |", request.variant(Variant::Unilateral).contact(mortar)),
    ];
    for (head, request) in rows {
        let row = readme.lines().find(|line| line.starts_with(head)).expect("README has the row");
        let cells = cells(&request);
        assert!(row.ends_with(&cells), "README: {row}\nthe program: {cells}");
    }
}
