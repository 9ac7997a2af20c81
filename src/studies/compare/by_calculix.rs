//! The displacements that CalculiX computed, beside the solution whose contact its decks have.

use serde::Serialize;

use super::{Beside, Compared};
use crate::calculix::{CalculixRun, Contact, Pair, Part};
use base::error::Result;
use engine::Solution;
use engine::estimates::Certainty;
use output::numbers::{short, with_unit};
use output::tables::certainty;
use problem::element::Plane;
use problem::modelling::Friction;
use problem::scene::Units;

/// How CalculiX came to a field.
#[derive(Clone, Debug, Serialize)]
pub struct ByCalculix {
    version: String,
    contact: InDeck,
    /// How many decks were run.
    decks: usize,
    /// Whether rounding decides who is in contact in the run that is compared.
    certainty: Certainty,
}

/// How the bodies touch in a deck; the last of several.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum InDeck {
    /// The same linear systems: the number of equations.
    Equation { equations: usize },
    /// CalculiX's own contact: its penalty, stress/length.
    Pair { penalty: f64, friction: Friction },
}

impl<'a> Compared<'a> {
    /// Puts what CalculiX computed of the `parts` of a solution beside it.
    ///
    /// # Errors
    /// The contact surfaces bound no body.
    pub fn with_calculix(
        solution: &'a Solution,
        certain: Certainty,
        parts: &[Part],
        ran: CalculixRun,
        tolerance: Option<f64>,
    ) -> Result<Self> {
        let contact = match &parts.last().expect("a run has an iteration").contact {
            Contact::Equations(all, _) => InDeck::Equation { equations: all.len() },
            Contact::Pair(Pair { penalty, friction }) => {
                InDeck::Pair { penalty: *penalty, friction: *friction }
            }
        };
        let shared = (solution.model.plane == Plane::Stress).then(|| {
            "Plane stress: CalculiX lets triangles share their thickness at nodes, and so differs.".into()
        });
        let touch = contact.words(parts.len(), &solution.request.scene.units);
        let (version, decks) = (ran.version, parts.len());
        Ok(Compared {
            other: format!("CalculiX {version}"),
            about: [Some(touch), shared, certainty(certain)].into_iter().flatten().collect(),
            calculix: Some(ByCalculix { version, contact, decks, certainty: certain }),
            tolerance,
            beside: Beside::new(solution, ran.u)?,
        })
    }
}

impl InDeck {
    /// Says how the bodies touch.
    fn words(&self, decks: usize, units: &Units) -> String {
        match (self, decks) {
            (InDeck::Equation { equations }, 1) => {
                format!("{equations} equations: those of the last iteration")
            }
            (InDeck::Equation { .. }, decks) => format!(
                "{decks} decks, one for each contact state of the increments, summed with their shares of the load"
            ),
            (InDeck::Pair { penalty, friction }, _) => {
                let unit = match (units.stress.as_str(), units.length.as_str()) {
                    ("", _) | (_, "") => String::new(),
                    (stress, length) => format!("{stress}/{length}"),
                };
                let penalty = with_unit(&short(*penalty), &unit);
                format!("contact pair, penalty {penalty}, friction {friction}")
            }
        }
    }
}
