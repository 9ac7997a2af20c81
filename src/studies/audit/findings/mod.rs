//! The register of findings: what the listings do that the text does not say.
//!
//! A finding is data (where it stands, why it matters, what would repair it), the smallest scene that shows it
//! (`golden/findings/<id>/`), and a measure: an experiment with the listings as printed, under the default reading, that
//! runs on any scene. C: `c_cnt`; K: `Km` and the iterations.

mod experiment;
mod geometry;
mod register;
mod search;
mod status;
mod stiffness;
mod weights;

pub use register::FINDINGS;

use super::Case;
use crate::problem::scene::Scene;

/// Something that a listing does and the text does not say.
pub struct Finding {
    /// C1, C2, ..., K1, ...
    pub id: &'static str,
    /// `c_cnt`, `Km`, or `-` where it is the iterations'.
    pub listing: &'static str,
    /// Printed lines.
    pub lines: &'static [usize],
    /// What the listing does that the text does not say.
    pub title: &'static str,
    /// Why it matters.
    pub why: &'static str,
    /// What a repair would be.
    pub repair: &'static str,
    /// What the measured number is, with its unit.
    pub number: &'static str,
    measure: fn(&Case) -> Measured,
}

impl Finding {
    /// Looks for the finding in a scene. Where a listing or a run fails, that is said; it never panics.
    pub fn measure(&self, case: &Case) -> Measured {
        (self.measure)(case)
    }

    /// The smallest scene that shows it.
    pub fn scene(&self) -> Scene {
        Scene::open(&format!("findings/{}", self.id)).expect("a finding's scene is sound")
    }
}

/// Whether a scene shows a finding. Ordered by weight: of several shapes the heaviest verdict counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The scene lacks what the finding needs.
    DoesNotArise,
    /// The scene has what the finding needs, and yet it does not happen: the finding is wrong.
    Contradicted,
    /// It happens.
    Holds,
}

impl Verdict {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::DoesNotArise => "does not arise",
            Verdict::Contradicted => "contradicted",
        }
    }
}

/// What a scene shows of a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Whether it shows it.
    pub verdict: Verdict,
    /// The number that the finding names; 0 where it does not arise and nothing could be counted.
    pub number: f64,
    /// The values behind the number.
    pub detail: String,
}
