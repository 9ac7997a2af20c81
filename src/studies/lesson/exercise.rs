//! An exercise: a scene of its own for each student, what `c_cnt` finds on it, and the marks of the
//! answers.

mod drawn;

use fastrand::Rng;
use serde::{Deserialize, Serialize};

use base::error::{InputError, Result};
use paper::door::Call;
use paper::mirror::Reading;
use problem::model::NodeId;
use problem::scene::Scene;

/// The kind of file that the page of an exercise exports.
pub const ANSWERS: &str = "plane-contact answers";

/// How far an answered weight may be from the listing's: two digits are asked for.
const WEIGHT: f64 = 0.0051;

/// What a right weight counts; a right edge or status counts 1.
pub const WEIGHT_POINTS: usize = 2;

/// The exercise of a student: a number, and the seed of the class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Exercise {
    /// The number of the student in the class.
    pub exercise: u64,
    /// The seed of the class.
    pub seed: u64,
}

/// What `c_cnt` finds of a contact node, or what a student says of it; nothing where he says
/// nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The number of the contact node.
    pub node: usize,
    /// The number of its target edge; 0 for none.
    pub ct: Option<f64>,
    /// 1 in contact, else 0.
    pub dy: Option<f64>,
    /// The weight of the edge's first node, `k_cnt` in column 2; 0 for a node that is apart.
    pub k1: Option<f64>,
}

/// The answers of a student, as the page of an exercise exports them.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answers {
    /// [`ANSWERS`].
    pub kind: String,
    /// The number of the student in the class.
    pub exercise: u64,
    /// The seed of the class.
    pub seed: u64,
    /// The student's name.
    pub student: String,
    /// An answer for each contact node.
    pub answers: Vec<Answer>,
}

/// A value that was asked for: what was said, and what the listing finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// The number of the contact node.
    pub node: usize,
    /// What was asked for.
    pub of: &'static str,
    /// What the student says; null where he says nothing.
    pub said: Option<f64>,
    /// What the listing finds.
    pub found: f64,
    /// Whether that is the same.
    pub right: bool,
    /// What it counts where it is right.
    pub points: usize,
}

impl Exercise {
    /// Draws the scene, whose coordinates have two decimals: at least one node is in contact, one not,
    /// and one by the sign rule alone.
    pub fn scene(self) -> Scene {
        let mut seeds = Rng::with_seed(self.seed);
        let own = seeds.u64(..).wrapping_add(self.exercise);
        drawn::draw(&mut Rng::with_seed(own))
    }

    /// Returns what `c_cnt` finds on the scene, by contact node.
    pub fn found(self) -> Vec<[f64; 4]> {
        let model = self.scene().model;
        let call = Call::c_cnt(&model, &Reading::default(), &model.nodes)
            .expect("no target edge that is drawn is vertical");
        let row = |(place, node): (usize, &NodeId)| {
            let pairs = &call.pairs;
            let (ct, dy) = (pairs.ct[place] as f64, pairs.dy[place] as f64);
            [node.number() as f64, ct, dy, call.row(*node)[1]]
        };
        (1..).zip(&model.contact.nodes).map(row).collect()
    }
}

impl Answers {
    /// Marks the answers: of each contact node its edge and its status, and of one in contact its weight.
    ///
    /// # Errors
    /// They name a node that is no contact node of the exercise, or one twice.
    pub fn marks(&self) -> Result<Vec<Mark>> {
        let found = Exercise { exercise: self.exercise, seed: self.seed }.found();
        self.check(&found)?;
        let of_node = |[node, ct, dy, k1]: [f64; 4]| {
            let node = node as usize;
            let own = self.answers.iter().find(|answer| answer.node == node);
            let mark = |of, said: fn(&Answer) -> Option<f64>, found: f64, within, points| {
                let said = own.and_then(said);
                let right = said.is_some_and(|x| (x - found).abs() <= within);
                Mark { node, of, said, found, right, points }
            };
            let weight = mark("k1", |answer| answer.k1, k1, WEIGHT, WEIGHT_POINTS);
            let mut marks = vec![
                mark("ct", |answer| answer.ct, ct, 0.0, 1),
                mark("dy", |answer| answer.dy, dy, 0.0, 1),
            ];
            marks.extend((dy == 1.0).then_some(weight));
            marks
        };
        Ok(found.into_iter().flat_map(of_node).collect())
    }

    fn check(&self, found: &[[f64; 4]]) -> Result<()> {
        let Answers { exercise, seed, .. } = self;
        let fix = format!(
            "save them from the page that `plane-contact lesson --exercise {exercise} --seed {seed}` \
             makes"
        );
        let refused = |what: String| Err(InputError::new("field answers", what, fix.clone()));
        for (k, Answer { node, .. }) in self.answers.iter().enumerate() {
            if !found.iter().any(|[own, ..]| *own == *node as f64) {
                return refused(format!(
                    "node {node} is no contact node of exercise {exercise} under seed {seed}"
                ));
            }
            if self.answers[..k].iter().any(|answer| answer.node == *node) {
                return refused(format!("node {node} is answered twice"));
            }
        }
        Ok(())
    }
}
