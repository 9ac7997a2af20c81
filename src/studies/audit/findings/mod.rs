//! The register of findings: what the listings do that the text does not say.
//!
//! A finding is one entry of the register: data (where it stands, why it matters, its repair), a measure, and
//! the smallest scene that shows it (`golden/findings/<id>/`). A measure is an experiment with the listings
//! as printed, under the case's reading, that runs on any scene. C: `c_cnt`; K: `Km` and the iterations.

mod experiment;
mod register;
mod search;
mod status;
mod stiffness;
mod weights;

pub(super) use experiment::ROUNDING;
pub use paper::findings::FindingId;
pub use register::FINDINGS;

use serde::Serialize;

use super::evidence::{self, Outcome};
use super::{Case, tables};
use base::choices;
use paper::listings::Which;
use problem::model::Model;
use problem::scene::Scene;

/// Something that a listing does and the text does not say.
#[derive(Serialize)]
pub struct Finding {
    /// Its name: C1, C2, ..., K1, ...
    pub id: FindingId,
    /// The listing; nothing where it is the iterations around them that do it.
    #[serde(serialize_with = "tables::name_of_listing")]
    pub listing: Option<Which>,
    /// The numbers of the printed lines that do it, from 1.
    pub lines: &'static [usize],
    /// What the listing does that the text does not say.
    pub title: &'static str,
    /// What follows from it for a user of the listing.
    pub why: &'static str,
    /// What would repair it, in words.
    pub repair: &'static str,
    /// The repair as an edit of a listing.
    pub edit: Repair,
    /// What is changed for it to show in one call of each listing on its own scene.
    #[serde(skip)]
    pub before: Preparation,
    /// What the measured number is, with its unit.
    #[serde(rename = "of")]
    pub number: &'static str,
    #[serde(skip)]
    measure: fn(&Case) -> Outcome<Evidence>,
}

/// The repair of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Repair {
    /// An edit of a listing.
    Edit {
        /// Its text, in the format of `listings/readings/README.md`.
        text: &'static str,
    },
    /// No edit of a listing.
    None {
        /// Why not, and what shows the repair.
        reason: &'static str,
    },
}

/// What is changed on a finding's scene before the listings are executed once, with its words.
#[derive(Clone, Copy)]
pub enum Preparation {
    /// Nothing.
    AsPrinted,
    /// A reading takes another value: the value, and the words for it.
    Reading(&'static str, &'static str),
    /// The model is changed: the words, and how.
    Model(&'static str, fn(&mut Model)),
}

impl Finding {
    /// Returns the finding of a name.
    pub fn of(id: FindingId) -> &'static Self {
        &FINDINGS[id as usize]
    }

    /// Looks for the finding in a scene, and on the inputs that mean the same. Where a listing or a run
    /// fails, the detail says so; it never panics.
    pub fn measure(&self, case: &Case) -> Evidence {
        let measure = |case: &Case| {
            (self.measure)(case)
                .unwrap_or_else(|why| Evidence::present_if(false, 0.0, why.to_string()))
        };
        let others: Vec<Evidence> = case.equivalents().iter().map(measure).collect();
        measure(case).confirmed_by(&others)
    }

    /// Returns the smallest scene that shows the finding.
    pub fn scene(&self) -> Scene {
        Scene::open(format!("findings/{}", self.id)).expect("a finding's scene is sound")
    }
}

choices! {
    /// Whether a scene shows a finding. Ordered by weight: of several shapes the heaviest counts.
    #[derive(PartialOrd, Ord)]
    Presence {
        /// The scene lacks what the finding needs.
        NotTriggered = "not triggered here",
        /// The scene has what the finding needs, and yet it does not happen: the finding is wrong.
        Contradicted = "contradicted",
        /// The scene has what the finding needs, and it happens.
        Present = "present",
    }
}

/// What a scene says of a finding; the number is 0 where it is not triggered and nothing could be counted.
pub type Evidence = evidence::Evidence<Presence>;

impl Evidence {
    /// Returns what is evidence of the verdict `present` or `not triggered here`.
    fn present_if(is_present: bool, number: f64, detail: impl Into<String>) -> Self {
        let verdict = if is_present { Presence::Present } else { Presence::NotTriggered };
        Evidence::new(verdict, number, detail)
    }

    /// Returns what is evidence of the verdict `present` or `contradicted`, on a scene that has what the
    /// finding needs.
    fn must_be_present(is_present: bool, number: f64, detail: impl Into<String>) -> Self {
        let verdict = if is_present { Presence::Present } else { Presence::Contradicted };
        Evidence::new(verdict, number, detail)
    }
}
