//! The paper's own trade measured: "the second option appears preferable from the point of view of
//! the volume of computation".
//!
//! On random scenes whose statuses are known, for each status rule: how many contact nodes it gets
//! wrong, by how deep the stamp jumped, and how many operations it takes, by the number of nodes.
//! The listing's count is the mirror's, whose `∧` on line 7 stops early: the least that Mathcad can
//! do.
//!
//! What projection gets wrong lies at the target's ends: its flank is no target edge, so under a
//! sloping last edge a node beside the target may stand over the surface, and one inside past its
//! end.

mod counted;
mod drawn;

use fastrand::Rng;
use serde::Serialize;

use counted::{Counted, counting};
use drawn::{DrawnScene, Kind, draw};
use engine::contact::status::statuses;
use numbers::scalar::Scalar;
use paper::door;
use paper::mirror::{Reading, c_cnt};
use problem::modelling::StatusRule;
use problem::scene::sha256;

/// Depths of the jump, in c_tll. Target edges are some 250 c_tll long: the last sinks whole cells.
const DEPTHS: [f64; 6] = [0.5, 2.0, 8.0, 32.0, 128.0, 512.0];
/// Number of target edges where the depth is varied.
const EDGES: usize = 16;
/// Numbers of target edges where operations are counted, and the depth: no element sinks whole.
const SIZES: [usize; 6] = [8, 16, 32, 64, 128, 256];
const DEPTH: f64 = 4.0;
/// Operations of lines 22 to 30 for a node in contact: all rules share them, none is charged.
const WEIGHTS: u64 = 12;

/// What was measured, in numbers that the seed determines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// How many scenes were drawn.
    pub scenes: usize,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The SHA-256 of the scenes: over that of the scenes before and those of a scene and its mesh.
    pub scenes_sha256: String,
    /// The mistakes of the rules by the depth of the jump.
    pub by_depth: Vec<Row>,
    /// Operations by size, both orientations together.
    pub by_size: Vec<Row>,
}

/// The scenes of one kind, together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The number of target edges.
    pub edges: usize,
    /// Depth of the jump, in c_tll.
    pub depth: f64,
    /// `below` or `above` the stamp, or `both`: where the target lies.
    pub target: &'static str,
    /// The number of contact nodes, over all scenes.
    pub nodes: usize,
    /// How many of them are in contact.
    pub touching: usize,
    /// What each status rule made of them.
    pub rules: Vec<Score>,
}

/// What a status rule made of the contact nodes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Score {
    /// The rule.
    pub rule: StatusRule,
    /// Nodes in contact that it treats as separated.
    pub missed: usize,
    /// Nodes apart that it takes for in contact.
    pub false_contacts: usize,
    /// Operations on lengths: search and status, without the weights.
    pub operations: u64,
}

/// Measures on `scenes` scenes for each depth and orientation, and for each size. The same seed
/// leads to the same numbers.
pub fn measure(scenes: usize, seed: u64) -> Measurement {
    let mut rng = Rng::with_seed(seed);
    let mut scenes_sha256 = String::new();
    let mut row = |edges, depth, target: &'static str| {
        let score = |rule: &StatusRule| Score { rule: *rule, ..Score::default() };
        let rules = StatusRule::ALL.iter().map(score).collect();
        let mut row = Row { edges, depth, target, nodes: 0, touching: 0, rules };
        for k in 0..scenes {
            let above = if target == "both" { k % 2 == 1 } else { target == "above" };
            let scene = draw(&mut rng, Kind { edges, depth, above });
            let hashes = scene.scene.hashes().expect("it was built");
            scenes_sha256 = sha256(&(&scenes_sha256, hashes));
            row.nodes += scene.touching.len();
            row.touching += scene.touching.iter().filter(|touching| **touching).count();
            row.rules.iter_mut().for_each(|score| score.add(&scene));
        }
        row
    };
    let depths = DEPTHS.iter().flat_map(|depth| [(*depth, "below"), (*depth, "above")]);
    let by_depth = depths.map(|(depth, target)| row(EDGES, depth, target)).collect();
    let by_size = SIZES.iter().map(|edges| row(*edges, DEPTH, "both")).collect();
    Measurement { scenes, seed, scenes_sha256, by_depth, by_size }
}

impl Score {
    /// Share of wrong statuses among `nodes`.
    pub fn wrong_share(&self, nodes: usize) -> f64 {
        (self.missed + self.false_contacts) as f64 / nodes.max(1) as f64
    }

    fn add(&mut self, drawn: &DrawnScene) {
        let (model, reading) = (&*drawn.scene.model, Reading::default());
        let sheet = door::worksheet(model, Counted::from_f64);
        let vertical = "no target edge is drawn vertical";
        let (found, operations) =
            counting(|| statuses(self.rule, model, &sheet, &reading, &sheet.node).expect(vertical));
        for (status, touching) in found.iter().zip(&drawn.touching) {
            self.missed += usize::from(*touching && !status.in_contact);
            self.false_contacts += usize::from(!*touching && status.in_contact);
        }
        // The weights, which the listing computes at once, are no part of search and status.
        let linked = match self.rule {
            StatusRule::Projection => 0,
            StatusRule::Signs | StatusRule::Intersection => {
                c_cnt(&sheet, &reading, &sheet.node).expect(vertical).dy.iter().sum::<usize>()
            }
        };
        self.operations += operations - WEIGHTS * linked as u64;
    }
}
