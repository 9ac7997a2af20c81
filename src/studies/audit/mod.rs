//! The audit: what the ambiguities and the findings of the print do on a scene.
//!
//! | what | its table | what is measured of it, an [`evidence::Outcome`] |
//! |---|---|---|
//! | a claim: what the paper says | [`claims::CLAIMS`] | [`claims::Evidence`] |
//! | a finding: what a listing does beside the text | [`findings::FINDINGS`] | [`findings::Evidence`] |
//! | a price: what a printed fault costs | `paper::corrected::FAULTS` | [`prices::CorrectedRun`] |
//! | a reading: what another one changes | `paper::mirror::READINGS` | [`readings::Effect`] |
//! | a variant | `problem::modelling::Variant` | [`variants::VariantRun`] |

/// Checks, when the program is built, that a table has one row for each id, in the order of the ids.
macro_rules! one_row_for_each {
    ($id:ty, $table:ident) => {
        const _: () = {
            assert!($table.len() == <$id>::ALL.len());
            let mut k = 0;
            while k < $table.len() {
                assert!($table[k].id as usize == k);
                k += 1;
            }
        };
    };
}

mod assumptions;
mod case;
pub mod claims;
pub(crate) mod command;
pub mod conclusion;
pub mod evidence;
pub mod findings;
pub mod prices;
pub mod range;
pub mod readings;
pub mod tables;
pub mod variants;
pub mod words;

use rayon::prelude::*;
use serde::Serialize;

pub use assumptions::{Assumption, assumptions, relative_radius};
pub use case::Case;

use claims::{CLAIMS, JudgedClaim, UnderReading};
use conclusion::Conclusion;
use engine::estimates::{Perturbed, perturbed};
use engine::{BodySummary, Solution, summaries};
use evidence::{NoFigures, Outcome};
use findings::{Evidence, FINDINGS, Finding};
use prices::Price;
use problem::modelling::ContactModel;
use problem::scene::Scene;
use range::Range;
use readings::Effect;
use variants::VariantRow;

/// The results of an audit: what `--json` prints, and what every sentence of [`words`] is made of.
#[derive(Serialize)]
pub struct Audit {
    /// The scene; of which the JSON has the name.
    #[serde(serialize_with = "tables::name")]
    pub scene: Scene,
    /// What follows from the rest.
    pub conclusion: Conclusion,
    /// What the paper says, each with its verdict, in the order of its text.
    pub claims: Vec<JudgedClaim>,
    /// The claims where the paper is read otherwise.
    pub by_reading: Vec<UnderReading>,
    /// What the paper leaves open, and what the scene has in its place.
    pub assumptions: Vec<Assumption>,
    /// What each other reading changes, in the order of `listings/READING.md`, section 4.
    pub readings: Vec<Effect>,
    /// What the scene shows of each finding, in the order of the register.
    #[serde(serialize_with = "tables::rows")]
    pub findings: Vec<(&'static Finding, Evidence)>,
    /// What each printed fault costs, reintroduced alone into the corrected algorithm; or why that is not
    /// known.
    pub prices: Outcome<Vec<Price>>,
    /// The end of each variant, in the order of `Variant::ALL`.
    pub variants: Vec<VariantRow>,
    /// The equilibrium under the scene's own friction, which the variants are measured against;
    /// nothing without contact, and where it does not run.
    pub equilibrium: Option<EquilibriumRow>,
    /// The reference solution; nothing without contact, and where it does not run.
    pub reference: Option<EquilibriumRow>,
    /// Why one of these two, or both, are missing on a scene with contact.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unsolved: Vec<String>,
}

/// An equilibrium that runs are compared with, in short.
#[derive(Clone, Debug, Serialize)]
pub struct EquilibriumRow {
    /// How contact was modelled.
    pub model: ContactModel,
    /// How many contact nodes are in contact.
    pub in_contact: usize,
    /// The force that contact passes on over the size of the whole load; None without a load.
    pub target_share: Option<f64>,
    /// The largest displacement and stress of each body.
    pub bodies: Vec<BodySummary>,
    /// Where its bodies lie in each other outside the groups of contact, in words; absent where they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<String>,
    /// The error of the mesh in the energy norm, relative; nothing where it is not known.
    pub mesh_error: Option<f64>,
    /// What changes of the input in the last digits do to it.
    pub rounding: Option<Perturbed>,
}

/// The number of times that [`audit`] calls its `watch` at most.
pub fn steps() -> usize {
    FINDINGS.len() + prices::runs() + 5
}

/// Audits a scene: claims, readings, findings and variants, each against the default, and what each printed
/// fault costs; claims also at the `places` of the range of what the paper leaves open. Where it `is_whole`,
/// not for the first screen alone, also the claims under each other reading, and what rounding does to the
/// solutions that others are compared with. `watch` is called after each step.
pub fn audit(case: &Case, places: &Range, is_whole: bool, watch: &(dyn Fn() + Sync)) -> Audit {
    case.prepare();
    watch();
    let measured = |finding: &'static Finding| {
        let measured = finding.measure(case);
        watch();
        (finding, measured)
    };
    let findings = || FINDINGS.par_iter().map(measured).collect::<Vec<_>>();
    let readings = || watched(readings::effects(case), watch);
    let variants = || watched(variants::side_by_side(case), watch);
    let claims = || watched(claims::judge(CLAIMS, case, places), watch);
    let by_reading = || match is_whole {
        true => watched(claims::by_reading(CLAIMS, case), watch),
        false => watched(Vec::new(), watch),
    };
    let prices = || prices::on(case, watch).map_err(NoFigures::from);
    // All at once, the longest first: each alone would end with one long run on one core.
    let (prices, (findings, (readings, (claims, (by_reading, variants))))) =
        rayon::join(prices, || {
            let others = || rayon::join(by_reading, variants);
            rayon::join(findings, || rayon::join(readings, || rayon::join(claims, others)))
        });
    let (equilibrium, reference) = rayon::join(
        || case.equilibrium().map(|solution| equilibrium_row(solution, is_whole)),
        || case.reference().map(|solution| equilibrium_row(solution, is_whole)),
    );
    Audit {
        conclusion: Conclusion::new(case, &readings, &findings, &variants),
        scene: case.scene.clone(),
        claims,
        by_reading,
        assumptions: assumptions(&case.scene),
        readings,
        findings,
        prices,
        variants,
        equilibrium,
        reference,
        unsolved: case.unsolved(),
    }
}

/// Returns what was computed, after a call of `watch`.
fn watched<T>(computed: T, watch: &(dyn Fn() + Sync)) -> T {
    watch();
    computed
}

fn equilibrium_row(solution: &Solution, is_whole: bool) -> EquilibriumRow {
    EquilibriumRow {
        model: solution.request.contact,
        in_contact: solution.in_contact().count(),
        target_share: variants::target_share(solution),
        bodies: summaries(solution),
        overlap: output::tables::overlap(solution),
        mesh_error: variants::mesh_error(solution),
        rounding: if is_whole { perturbed(solution) } else { None },
    }
}
