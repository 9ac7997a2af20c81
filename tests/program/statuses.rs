//! The paper's own trade measured: "the second option appears preferable from the point of view of
//! the volume of computation".
//!
//! On random scenes whose statuses are known, for each status rule: how many contact nodes it gets
//! wrong, by how deep the stamp jumped, and how many operations it takes, by the number of target
//! edges. The listing's count is the mirror's, whose `∧` on line 7 stops early: the least that Mathcad
//! can do. `golden/tables/statuses.md` has the numbers, and claims P6 and P8 rest on them.

mod counted;
mod drawn;

use fastrand::Rng;
use plane_contact::Scene;
use plane_contact::engine::contact::status_rules::statuses;
use plane_contact::numbers::scalar::Scalar;
use plane_contact::paper::door;
use plane_contact::paper::mirror::{Reading, c_cnt};
use plane_contact::problem::modelling::StatusRule;
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::claims::{Claim, ClaimId};

use crate::common::page::{assert_table, markdown, percent};
use counted::{Counted, counting};
use drawn::{DrawnScene, Kind, draw};

/// Scenes for each row.
const SCENES: usize = 200;
/// Depths of the jump, in c_tll. Target edges are some 250 c_tll long: the last sinks whole cells.
const DEPTHS: [f64; 6] = [0.5, 2.0, 8.0, 32.0, 128.0, 512.0];
/// Number of target edges where the depth is varied.
const EDGES: usize = 16;
/// Numbers of target edges where operations are counted, and the depth: no element sinks whole.
const SIZES: [usize; 6] = [8, 16, 32, 64, 128, 256];
const DEPTH: f64 = 4.0;
/// Operations of lines 22 to 30 for a node in contact: all rules share them, none is charged.
const WEIGHTS: u64 = 12;

/// The scenes of one kind, together: contact nodes, those in contact, and what each rule made of them.
#[derive(Default)]
struct Row {
    nodes: usize,
    touching: usize,
    scores: [Score; StatusRule::ALL.len()],
}

#[derive(Clone, Copy, Default)]
struct Score {
    /// Nodes in contact that the rule treats as separated.
    missed: usize,
    /// Nodes apart that it takes for in contact.
    false_contacts: usize,
    /// Operations on lengths: search and status, without the weights.
    operations: u64,
}

impl Row {
    fn of(rng: &mut Rng, edges: usize, depth: f64, above: impl Fn(usize) -> bool) -> Self {
        let mut row = Row::default();
        for k in 0..SCENES {
            let scene = draw(rng, Kind { edges, depth, above: above(k) });
            row.nodes += scene.touching.len();
            row.touching += scene.touching.iter().filter(|touching| **touching).count();
            for (score, rule) in row.scores.iter_mut().zip(StatusRule::ALL) {
                score.add(*rule, &scene);
            }
        }
        row
    }
}

impl Score {
    fn add(&mut self, rule: StatusRule, drawn: &DrawnScene) {
        let (model, reading) = (&*drawn.scene.model, Reading::default());
        let sheet = door::worksheet(model, Counted::from_f64);
        let vertical = "no target edge is drawn vertical";
        let (found, operations) =
            counting(|| statuses(rule, model, &sheet, &reading, &sheet.node).expect(vertical));
        for (status, touching) in found.iter().zip(&drawn.touching) {
            self.missed += usize::from(*touching && !status.in_contact);
            self.false_contacts += usize::from(!*touching && status.in_contact);
        }
        // The weights, which the listing computes at once, are no part of search and status.
        let pairs = c_cnt(&sheet, &reading, &sheet.node).expect(vertical);
        let linked = pairs.dy.iter().sum::<usize>();
        self.operations += operations - WEIGHTS * linked as u64;
    }
}

/// Joins a cell for each status rule.
fn cells<T>(of: impl IntoIterator<Item = T>, cell: impl Fn(T) -> String) -> String {
    of.into_iter().map(cell).collect::<Vec<_>>().join(" | ")
}

#[test]
fn status_rules() {
    let mut rng = Rng::with_seed(1);
    let mut rows = Vec::new();
    for depth in DEPTHS {
        for target in ["below", "above"] {
            let row = Row::of(&mut rng, EDGES, depth, |_| target == "above");
            let share = |score: &Score| {
                percent((score.missed + score.false_contacts) as f64 / row.nodes as f64, 1)
            };
            let (touching, missed) = (row.touching, row.scores[0].missed);
            rows.push(format!(
                "{depth} | {target} | {touching} | {missed} | {}",
                cells(&row.scores, share)
            ));
        }
    }
    let [signs, ..] = StatusRule::ALL else { panic!("there are rules") };
    for edges in SIZES {
        let Row { scores, .. } = Row::of(&mut rng, edges, DEPTH, |k| k % 2 == 1);
        let quotient =
            |score: &Score| format!("{:.2}", score.operations as f64 / scores[0].operations as f64);
        rows.push(format!(
            "operations on {edges} target edges, over those of `{signs}` | both | - | - | {}",
            cells(&scores, quotient)
        ));
    }
    let heads = cells(StatusRule::ALL, |rule| format!("`{rule}`, wrong"));
    let head = format!(
        "depth of the jump over c_tll | target lies | nodes in contact | of them missed by `{signs}` | {heads}"
    );
    let title =
        format!("Status rules on random scenes whose contact is known, {SCENES} for each row.");
    let source = "Made by the test `status_rules`";
    assert_table("statuses", &title, source, &markdown(&head, rows));
}

/// P6 and P8 quote the table.
#[test]
fn the_claims_on_random_scenes_are_those_of_the_table() {
    let table = std::fs::read_to_string("golden/tables/statuses.md").expect("the table");
    let row = |starts: &str| -> Vec<&str> {
        let row = table.lines().rfind(|line| line.starts_with(starts)).expect("a row");
        row.split('|').map(str::trim).collect()
    };
    let case = Case::new(Scene::open("fig1").expect("an embedded scene"));
    let measured = |id: ClaimId| Claim::of(id).measure(&case);
    let number = |id: ClaimId| measured(id).number.expect("a number");
    let cell =
        |starts: &str, column: usize| -> f64 { row(starts)[column].parse().expect("a number") };
    assert_eq!(number(ClaimId::P6), cell("| 2 | below ", 4) / cell("| 2 | below ", 3));
    let missed = |target: &str| {
        let row = row(&format!("| 2 | {target} "));
        format!("target {target}: {} of {} missed", row[4], row[3])
    };
    let detail = ["below", "above"].map(missed).join(", ");
    assert_eq!(measured(ClaimId::P6).detail, detail);
    assert_eq!(number(ClaimId::P8), cell("| operations on 256 ", 6));
}
