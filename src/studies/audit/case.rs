//! What an audit looks at: a scene, its arrays under the default reading, and a run of each variant.

use std::sync::{Arc, OnceLock};

use crate::answer::contact::{self, Outcome};
use crate::answer::error::Error;
use crate::paper::mirror::{Failure, Pairs, Reading, Worksheet, c_cnt};
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// A run, or why there is none.
pub type Run = Result<Outcome, Arc<Error>>;

/// A scene under audit. Runs are made when they are first asked for, once.
pub struct Case {
    /// The scene.
    pub scene: Scene,
    /// Its arrays under the default reading.
    pub sheet: Worksheet<f64>,
    runs: [OnceLock<Run>; Variant::ALL.len()],
    converged: OnceLock<Run>,
}

impl Case {
    /// The case of a scene.
    ///
    /// # Errors
    /// A scene that the default reading does not allow.
    pub fn new(scene: Scene) -> Result<Self, Error> {
        let sheet = scene.worksheet(&Reading::default())?;
        Ok(Case { scene, sheet, runs: Default::default(), converged: OnceLock::new() })
    }

    /// The run of a variant under the default reading.
    pub fn run(&self, variant: Variant) -> &Run {
        let at = Variant::ALL.iter().position(|v| *v == variant).expect("ALL holds every variant");
        self.runs[at].get_or_init(|| {
            contact::run(&self.scene, variant, &Reading::default(), |_| ()).map_err(Arc::new)
        })
    }

    /// The converged answer that runs are measured against.
    pub fn converged(&self) -> &Run {
        self.converged
            .get_or_init(|| contact::reference(&self.scene, &Reading::default()).map_err(Arc::new))
    }

    /// The scene's variant where it is one of the paper's, else the first of those.
    pub fn published_variant(&self) -> Variant {
        let own = Some(self.scene.variant).filter(|v| Variant::OF_THE_PAPER.contains(v));
        own.unwrap_or(Variant::OF_THE_PAPER[0])
    }

    /// What `c_cnt` finds at the initial shape under the default reading.
    ///
    /// # Errors
    /// Where the listing fails as printed.
    pub fn initial(&self) -> Result<Pairs<f64>, Failure> {
        c_cnt(&self.sheet, &Reading::default(), &self.sheet.node)
    }
}
