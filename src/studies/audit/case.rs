//! What an audit looks at: a scene, and a run of each variant.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use base::error::InputError;
use base::limits;
use engine::error::Error;
use engine::estimates::discretisation::Discretisation;
use engine::estimates::{Certainty, certain};
use engine::{Request, Solution, solve};
use paper::door::{self, Call};
use paper::mirror::{Failure, Reading};
use problem::model::Model;
use problem::modelling::Variant;
use problem::scene::Scene;

/// A scene under audit. Runs are made when they are first asked for, once.
pub struct Case {
    /// The scene.
    pub scene: Scene,
    base: Request,
    /// The scene's model under the reading.
    model: Arc<Model>,
    runs: [OnceLock<Result<Solution, Error>>; Variant::ALL.len()],
    certain: [OnceLock<(Solution, Certainty)>; Variant::ALL.len()],
    finer: OnceLock<Result<(Solution, Certainty), Error>>,
    reference: OnceLock<Option<Solution>>,
    equilibrium: OnceLock<Option<Solution>>,
}

impl Case {
    /// The case of a scene under the default reading, of which nothing has run yet.
    pub fn new(scene: Scene) -> Self {
        Case::from_request(Request::new(&scene)).expect("the default reading changes no model")
    }

    /// The case of a scene under a reading, where the dense matrices of an audit fit in memory.
    ///
    /// # Errors
    /// They do not. The reading does not allow the model.
    pub fn within_memory(scene: &Scene, reading: Reading) -> Result<Self, InputError> {
        limits::DENSE.check(scene.model.dofs(), "the mesh")?;
        Case::from_request(Request::new(scene).reading(reading))
    }

    /// The case of a request's scene under its reading, its variant aside.
    ///
    /// # Errors
    /// The plane problem of R6 does not allow a Poisson's ratio.
    pub fn from_request(base: Request) -> Result<Self, InputError> {
        Ok(Case {
            scene: base.scene.clone(),
            model: door::under(
                Arc::clone(&base.scene.model),
                &base.scene.units.length,
                &base.reading,
            )?,
            base,
            runs: Default::default(),
            certain: Default::default(),
            finer: OnceLock::new(),
            reference: OnceLock::new(),
            equilibrium: OnceLock::new(),
        })
    }

    /// The model, as it is under the reading.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The reading under which the scene is audited.
    pub fn reading(&self) -> &Reading {
        &self.base.reading
    }

    /// The case of the same request under another reading.
    ///
    /// # Errors
    /// The plane problem of R6 does not allow a Poisson's ratio.
    pub fn under(&self, reading: Reading) -> Result<Self, InputError> {
        Case::from_request(self.base.clone().reading(reading))
    }

    /// The case of the same request with another variant as the scene's own.
    pub fn with_variant(&self, variant: Variant) -> Self {
        let mut base = self.base.clone();
        base.scene.variant = variant;
        Case::from_request(base).expect("the reading allows the model")
    }

    /// What is asked for.
    pub fn request(&self, variant: Variant) -> Request {
        self.base.clone().variant(variant)
    }

    /// The run of a variant, or why there is none.
    ///
    /// # Errors
    /// The run fails.
    pub fn run(&self, variant: Variant) -> Result<&Solution, &Error> {
        let run = || solve(&self.request(variant), &mut |_| ());
        self.runs[variant_index(variant)].get_or_init(run).as_ref()
    }

    /// The run of a variant, in double-doubles where rounding decides nothing but in those
    /// ([`certain`]); or why there is none.
    ///
    /// # Errors
    /// The run fails.
    pub fn certain(&self, variant: Variant) -> Result<&(Solution, Certainty), &Error> {
        let run = self.run(variant)?;
        Ok(self.certain[variant_index(variant)].get_or_init(|| certain(run.clone())))
    }

    /// The run of the scene's variant of the paper with a thousandth of its c_tll, as
    /// [`certain`](Case::certain) is; or why there is none.
    ///
    /// # Errors
    /// The finer run fails.
    pub fn finer(&self) -> Result<&(Solution, Certainty), &Error> {
        let run = || {
            let mut request = self.request(self.published_variant());
            // R8 multiplies what is asked for.
            request.tolerance = Some(self.scene.model.contact.tolerance / 1000.0);
            solve(&request, &mut |_| ()).map(certain)
        };
        self.finer.get_or_init(run).as_ref()
    }

    /// Makes the runs that claims, findings and variants ask for, each in a job of its own. A thread
    /// that waits for a parallel computation takes up other jobs; if one of these asked for the very
    /// run that it is making, neither would end. Where jobs share a case they find its runs made.
    pub fn prepare(&self) {
        let run = |variant: &Variant| match variant {
            Variant::Printed => drop(self.run(*variant)),
            Variant::Tied | Variant::Stepped | Variant::Unilateral => drop(self.certain(*variant)),
        };
        let unilateral = || {
            let _ = self.certain(Variant::Unilateral);
            // It may be that very run.
            let _ = self.equilibrium();
        };
        let finer = || {
            let _ = self.model().target().map(|_| self.finer());
        };
        let published = || Variant::OF_THE_PAPER.par_iter().for_each(run);
        rayon::join(|| rayon::join(unilateral, finer), published);
    }

    /// The reference solution; nothing without contact, and where it does not run.
    pub fn reference(&self) -> Option<&Solution> {
        self.model().target()?;
        let run = || solve(&self.base.reference(), &mut |_| ()).ok();
        self.reference.get_or_init(run).as_ref()
    }

    /// The equilibrium under the scene's own friction, which variants are measured against; nothing
    /// without contact, and where it does not run.
    pub fn equilibrium(&self) -> Option<&Solution> {
        self.model().target()?;
        if self.request(Variant::Unilateral).is_same_equilibrium(&self.base.equilibrium()) {
            return self.run(Variant::Unilateral).ok();
        }
        let run = || solve(&self.base.equilibrium(), &mut |_| ()).ok();
        self.equilibrium.get_or_init(run).as_ref()
    }

    /// The estimated error of the mesh itself in the equilibrium, in the energy norm, relative; nothing
    /// where there is no equilibrium, and where a body has too few triangles for an estimate.
    pub fn mesh_error(&self) -> Option<f64> {
        let equilibrium = self.equilibrium()?;
        let estimate = Discretisation::new(&equilibrium.model, &equilibrium.elements).relative();
        Some(estimate).filter(|error| error.is_finite())
    }

    /// The scene's variant where it is one of the paper's, else the first of those.
    pub fn published_variant(&self) -> Variant {
        let own = Some(self.scene.variant).filter(|v| Variant::OF_THE_PAPER.contains(v));
        own.unwrap_or(Variant::OF_THE_PAPER[0])
    }

    /// What `c_cnt` finds at the initial shape.
    ///
    /// # Errors
    /// `c_cnt` fails: says in which line.
    pub fn initial(&self) -> Result<Call, Failure> {
        Call::c_cnt(self.model(), self.reading(), &self.model().nodes)
    }
}

/// Returns where the run of a variant stands.
pub(super) fn variant_index(variant: Variant) -> usize {
    Variant::ALL.iter().position(|v| *v == variant).expect("ALL holds every variant")
}
