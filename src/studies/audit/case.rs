//! What an audit looks at: a scene, and a run of each variant under the default reading.

use std::sync::OnceLock;

use crate::answer::error::Error;
use crate::answer::{Request, Solution, equilibrium, solve};
use crate::paper::door::Call;
use crate::paper::mirror::{Failure, Reading};
use crate::problem::model::Model;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// A scene under audit. Runs are made when they are first asked for, once.
pub struct Case {
    pub scene: Scene,
    runs: [OnceLock<Result<Solution, Error>>; Variant::ALL.len()],
    reference: OnceLock<Option<Solution>>,
    equilibrium: OnceLock<Option<Solution>>,
}

impl Case {
    /// The case of a scene, of which nothing has run yet.
    pub fn new(scene: Scene) -> Self {
        Case {
            scene,
            runs: Default::default(),
            reference: OnceLock::new(),
            equilibrium: OnceLock::new(),
        }
    }

    /// The model, as it is under the default reading.
    pub fn model(&self) -> &Model {
        &self.scene.model
    }

    /// What is asked for under the default reading.
    pub fn request(&self, variant: Variant) -> Request {
        Request::new(&self.scene).variant(variant)
    }

    /// The run of a variant under the default reading, or why there is none.
    pub fn run(&self, variant: Variant) -> Result<&Solution, &Error> {
        let at = Variant::ALL.iter().position(|v| *v == variant).expect("ALL holds every variant");
        self.runs[at].get_or_init(|| solve(&self.request(variant), &mut |_| ())).as_ref()
    }

    /// The reference solution; nothing without contact, and where it does not run.
    pub fn reference(&self) -> Option<&Solution> {
        self.model().target()?;
        let request = Request::new(&self.scene).reference();
        self.reference.get_or_init(|| solve(&request, &mut |_| ()).ok()).as_ref()
    }

    /// The equilibrium under the scene's own friction, which variants are measured against; nothing
    /// without contact, and where it does not run.
    pub fn equilibrium(&self) -> Option<&Solution> {
        self.model().target()?;
        self.equilibrium.get_or_init(|| equilibrium(&Request::new(&self.scene)).ok()).as_ref()
    }

    /// The scene's variant where it is one of the paper's, else the first of those.
    pub fn published_variant(&self) -> Variant {
        let own = Some(self.scene.variant).filter(|v| Variant::OF_THE_PAPER.contains(v));
        own.unwrap_or(Variant::OF_THE_PAPER[0])
    }

    /// What `c_cnt` finds at the initial shape under the default reading.
    pub fn initial(&self) -> Result<Call, Failure> {
        Call::c_cnt(self.model(), &Reading::default(), &self.model().nodes)
    }
}
