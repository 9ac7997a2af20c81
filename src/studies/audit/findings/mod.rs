//! The register of findings: what the listings do that the text does not say.
//!
//! A finding is data (where it stands, why it matters, what would repair it), the smallest scene
//! that shows it (`golden/findings/<id>/`), and a measure: an experiment with the listings as
//! printed, under the default reading, that runs on any scene. C: `c_cnt`; K: `Km` and the
//! iterations.

mod experiment;
mod register;
mod search;
mod status;
mod stiffness;
mod weights;

pub use register::FINDINGS;

use super::Case;
use base::choices;
use problem::scene::Scene;

/// Something that a listing does and the text does not say.
pub struct Finding {
    /// Its name: C1, C2, ..., K1, ...
    pub id: &'static str,
    /// `c_cnt`, `Km`, or `-` where it is the iterations'.
    pub listing: &'static str,
    /// The numbers of the printed lines that do it, from 1.
    pub lines: &'static [usize],
    /// What the listing does that the text does not say.
    pub title: &'static str,
    /// What follows from it for a user of the listing.
    pub why: &'static str,
    /// What would repair it.
    pub repair: &'static str,
    /// What the measured number is, with its unit.
    pub number: &'static str,
    measure: fn(&Case) -> Outcome<'_>,
}

/// What a scene shows, or why a listing or a run failed.
type Outcome<'a> = Result<Measured, Box<dyn std::error::Error + 'a>>;

impl Finding {
    /// Looks for the finding in a scene. Where a listing or a run fails, the detail says so; it
    /// never panics.
    pub fn measure(&self, case: &Case) -> Measured {
        (self.measure)(case).unwrap_or_else(|why| Measured::holds_if(false, 0.0, why.to_string()))
    }

    pub fn scene(&self) -> Scene {
        Scene::open(&format!("findings/{}", self.id)).expect("a finding's scene is sound")
    }
}

choices! {
    /// Whether a scene shows a finding. Ordered by weight: of several shapes the heaviest counts.
    #[derive(PartialOrd, Ord)]
    Verdict {
        /// The scene lacks what the finding needs.
        DoesNotArise = "does not arise",
        /// The scene has what the finding needs, and yet it does not happen: the finding is wrong.
        Contradicted = "contradicted",
        /// The scene has what the finding needs, and it happens.
        Holds = "holds",
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    pub verdict: Verdict,
    /// The number that the finding names; 0 where it does not arise and nothing could be counted.
    pub number: f64,
    pub detail: String,
}

impl Measured {
    /// A measure of the verdict `holds` or `does not arise`.
    fn holds_if(holds: bool, number: f64, detail: impl Into<String>) -> Self {
        let verdict = if holds { Verdict::Holds } else { Verdict::DoesNotArise };
        Measured { verdict, number, detail: detail.into() }
    }

    /// A measure of the verdict `holds` or `contradicted`, on a scene that has what it needs.
    fn must_hold(holds: bool, number: f64, detail: impl Into<String>) -> Self {
        let verdict = if holds { Verdict::Holds } else { Verdict::Contradicted };
        Measured { verdict, number, detail: detail.into() }
    }
}
