//! Scenes worked out by hand, and in what `unilateral` ends: `scenes/rows.txt`, each row of which is a scene as
//! `testing::rows` has it, ` only=start` behind it where the first contact state alone is asked for.
//!
//! States are o open, s sticks, f and b slips forward and backward, c slips without friction. A number is `zero` up to
//! 1e-10 of the largest force, or 1e-12 of a gap; a list of zeros is left out, and what a search tried on springs too.

use std::path::Path;

use plane_contact::engine::contact::ContactNode;
use plane_contact::engine::error::Error;
use plane_contact::engine::{self, Request, Solution, share_of_load};
use plane_contact::error::InputError;
use plane_contact::problem::model::NodeId;
use plane_contact::problem::scene::Scene;

use crate::common::letter::letter;
use crate::common::rows::{assert_rows, scene_of};
use crate::common::same_text::same_text;
use crate::common::tolerances::{Tolerance, assert_near};

/// Asks for the first contact state alone.
const START: &str = " only=start";

/// A displacement in a scene a million of its sizes from the origin, relative to itself.
const FAR_FROM_THE_ORIGIN: Tolerance = Tolerance {
    limit: 1e-6,
    reason: "a coordinate of 3e6 resolves 5e-10; strains, and gaps over displacements of 1e-3, a \
         thousand times less",
};

pub const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/contact/scenes");

#[test]
fn scenes_by_hand() {
    assert_rows(&Path::new(FOLDER).join("rows.txt"), same_text, answer);
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_answer() {
    for model in ["nts geometry=current", "mortar geometry=current", "nts", "mortar"] {
        let row = format!(
            "stack /materials/1/nu=0.3 /materials/2/nu=0.3 geometry=initial coupling={model}"
        );
        let top = |row: &str| {
            let solution = engine::solve(&Request::new(&scene(row).expect("sound")), &mut |_| ());
            NodeId::from_number(8).components(&solution.expect("it rests").u)[1]
        };
        let (near, far) = (top(&row), top(&format!("{row} shift=1e6,-3e6")));
        assert_near(model, far, near, near, &FAR_FROM_THE_ORIGIN);
    }
}

fn scene(row: &str) -> Result<Scene, InputError> {
    scene_of(FOLDER, row.trim_end_matches(START))
}

/// Returns what is found on the scene of a row.
fn answer(row: &str) -> String {
    let mut start = None;
    let ending = scene(row).map_err(Error::from).and_then(|scene| {
        engine::solve(&Request::new(&scene), &mut |step| {
            if step.unilateral().is_some() {
                start.get_or_insert_with(|| step.statuses.iter().map(letter).collect::<String>());
            }
        })
    });
    match (ending, start) {
        (_, Some(start)) if row.ends_with(START) => start,
        (Ok(solution), start) => format!("{} to {}", start.unwrap_or_default(), end(&solution)),
        (Err(why), _) => {
            let (status, why) = (why.exit_status().number(), why.to_string());
            let tried = why.find("; on springs").unwrap_or(why.len());
            format!("status {status}: {}", &why[..tried])
        }
    }
}

/// Returns the end of a run: nodes with their states, what they carry, and where the last node of the scene went.
fn end(solution: &Solution) -> String {
    let nodes = &solution.contact;
    let state =
        |node: &ContactNode| format!("{}{}", node.node, node.status.map_or('?', |s| letter(&s)));
    let states = nodes.iter().map(state).collect::<Vec<_>>().join(" ");
    let most = nodes.iter().filter_map(|node| node.force).fold(0.0, f64::max);
    // To 1e-10 of the largest force.
    let digits = if most > 0.0 { 10 - most.log10().ceil() as i32 } else { 10 }.max(0) as usize;
    let list = |name: &str, zero: f64, of: fn(&ContactNode) -> Option<f64>| {
        let number = |x: Option<f64>| match x {
            None => "-".to_owned(),
            Some(x) if x.abs() <= zero => "zero".to_owned(),
            Some(x) => format!("{x:.digits$}"),
        };
        let numbers: Vec<_> = nodes.iter().map(|node| number(of(node))).collect();
        let says_something = numbers.iter().any(|number| number != "zero");
        says_something.then(|| format!("{name} {}", numbers.join(" ")))
    };
    let [x, y] = solution.model.node_ids().last().expect("a node").components(&solution.u);
    let unseen = solution.equilibrium.as_ref().and_then(|found| found.unseen);
    let status = solution.exit_status().number();
    let parts = [
        Some(states),
        list("gap", 1e-12, |node| Some(node.gap)),
        list("force", 1e-10 * most, |node| node.force),
        list("pressure", 1e-10 * most, |node| node.pressure),
        list("shear", 1e-10 * most, |node| node.shear),
        list("friction needed", 1e-10, |node| node.friction_needed),
        Some(format!("passes on {:.digits$}", solution.target_force())),
        Some(format!("the last node moves {x:.12} {y:.12}")),
        share_of_load(&solution.model, solution.target_force())
            .map(|share| format!("{share:.10} of the load")),
        unseen.map(|(node, depth)| format!("unseen {node} {depth:.10}")),
        solution
            .overlap
            .as_ref()
            .map(|at| format!("{} nodes inside, {} deepest", at.nodes, at.node)),
        solution.is_inside_out().then(|| "inside out".to_owned()),
        solution.transmits_nothing().then(|| "passes nothing on".to_owned()),
        (status != 0).then(|| format!("status {status}")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}
