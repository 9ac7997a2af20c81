//! What an audit looks at: a scene, and a run of each variant.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::prices;
use super::variants::apart;
use base::error::InputError;
use base::limits;
use engine::error::Error;
use engine::estimates::{equivalent, moves};
use engine::{Distance, Request, Solution, distance, last_under_each_load, solve};
use paper::corrected;
use paper::door::{self, Call};
use paper::mirror::{Failure, Reading};
use problem::model::Model;
use problem::modelling::{ContactModel, Friction, Variant};
use problem::scene::Scene;

/// The relative distance from the least coefficient of friction at which two runs confirm it.
const BESIDE: f64 = 1e-3;

/// A scene under audit. Runs are made when they are first asked for, once.
pub struct Case {
    /// The scene.
    pub scene: Scene,
    base: Request,
    /// The scene's model under the reading.
    model: Arc<Model>,
    runs: [OnceLock<Result<Solution, Error>>; Variant::OF_THE_PAPER.len()],
    finer: OnceLock<Result<Solution, Error>>,
    unilateral: Arc<Unilateral>,
    equivalents: OnceLock<Vec<Case>>,
    /// The most of those.
    most_equivalents: usize,
}

/// The runs of `unilateral`, which no reading changes but by the model.
#[derive(Default)]
struct Unilateral {
    run: OnceLock<Result<Solution, Error>>,
    sticking: OnceLock<Result<Solution, Error>>,
    least_friction: OnceLock<bool>,
    reference: OnceLock<Result<Solution, Error>>,
    corrected: OnceLock<Result<Solution, Error>>,
    equilibrium: OnceLock<Result<Solution, Error>>,
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
            finer: OnceLock::new(),
            unilateral: Arc::default(),
            equivalents: OnceLock::new(),
            most_equivalents: usize::MAX,
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

    /// The case with so many inputs that mean the same at most: each takes as long as the case itself.
    #[must_use]
    pub fn with_equivalents(self, most: usize) -> Self {
        Case { most_equivalents: most, ..self }
    }

    /// The case of the same request under another reading.
    ///
    /// # Errors
    /// The plane problem of R6 does not allow a Poisson's ratio.
    pub fn under(&self, reading: Reading) -> Result<Self, InputError> {
        self.changed(&|base| base.reading(reading))
    }

    /// The case of the same request with another variant as the scene's own.
    pub fn with_variant(&self, variant: Variant) -> Self {
        let changed = self.changed(&|mut base| {
            base.scene.variant = variant;
            base
        });
        changed.expect("the reading allows the model")
    }

    /// The case of a changed request, with the runs of `unilateral` where it leaves the model as it is.
    fn changed(&self, change: &dyn Fn(Request) -> Request) -> Result<Self, InputError> {
        let mut changed = Case::from_request(change(self.base.clone()))?;
        if Arc::ptr_eq(&changed.model, &self.model) {
            changed.unilateral = Arc::clone(&self.unilateral);
        }
        if let Some(equivalents) = self.equivalents.get() {
            let changed_too = equivalents.iter().map(|case| case.changed(change));
            changed.equivalents = OnceLock::from(changed_too.collect::<Result<Vec<_>, _>>()?);
        }
        Ok(changed)
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
        let of_the_paper = Variant::OF_THE_PAPER.iter().position(|other| *other == variant);
        of_the_paper.map_or(&self.unilateral.run, |k| &self.runs[k]).get_or_init(run).as_ref()
    }

    /// The run of `unilateral` in which no node slides.
    ///
    /// # Errors
    /// The run fails.
    pub fn sticking(&self) -> Result<&Solution, &Error> {
        if self.request(Variant::Unilateral).contact.friction == Friction::STICK {
            return self.run(Variant::Unilateral);
        }
        self.unilateral.sticking.get_or_init(|| self.rubbing(Friction::STICK)).as_ref()
    }

    /// `unilateral` under a coefficient of friction.
    fn rubbing(&self, friction: Friction) -> Result<Solution, Error> {
        let request = self.request(Variant::Unilateral);
        let contact = ContactModel { friction, ..request.contact };
        solve(&request.contact(contact), &mut |_| ())
    }

    /// The largest friction coefficient that a node in contact needs on the path of the load, where none
    /// slides.
    pub fn friction_needed(&self) -> Option<f64> {
        let sticking = self.sticking().ok()?;
        let ends = last_under_each_load(&sticking.steps).into_iter();
        let needed = ends.filter_map(|end| sticking.steps[end].unilateral()?.friction_needed);
        needed.reduce(f64::max)
    }

    /// Whether that coefficient is the least under which no node slides, by a run on either side.
    pub fn is_least_friction(&self) -> bool {
        let (Some(least), Ok(sticking)) = (self.friction_needed(), self.sticking()) else {
            return false;
        };
        let sticks = |part: f64| {
            let friction = Friction::new(part * least).expect("a coefficient that is not negative");
            // A run that fails confirms nothing.
            let run = self.rubbing(friction).ok();
            let apart = run.map(|run| distance(&run, sticking).displacement_relative);
            !moves(apart, Some(0.0), 1.0)
        };
        let is_none = !moves(Some(least), Some(0.0), 1.0);
        let is_least = || sticks(1.0 + BESIDE) && (is_none || !sticks(1.0 - BESIDE));
        *self.unilateral.least_friction.get_or_init(is_least)
    }

    /// The run of the scene's variant of the paper with a thousandth of its c_tll; or why there is none.
    ///
    /// # Errors
    /// The finer run fails.
    pub fn finer(&self) -> Result<&Solution, &Error> {
        let run = || {
            let mut request = self.request(self.published_variant());
            // R8 multiplies what is asked for.
            request.tolerance = Some(self.scene.model.contact.tolerance / 1000.0);
            solve(&request, &mut |_| ())
        };
        self.finer.get_or_init(run).as_ref()
    }

    /// The cases that mean the same ([`equivalent`]): what is another number there is decided by rounding.
    pub fn equivalents(&self) -> &[Case] {
        let case = |request| Case::from_request(request).expect("the reading allows the model");
        self.equivalents
            .get_or_init(|| equivalent(&self.base).take(self.most_equivalents).map(case).collect())
    }

    /// Makes the runs that claims, findings and variants ask for, each in a job of its own. A thread
    /// that waits for a parallel computation takes up other jobs; if one of these asked for the very
    /// run that it is making, neither would end. Where jobs share a case they find its runs made.
    pub fn prepare(&self) {
        self.equivalents().par_iter().chain([self]).for_each(|case| {
            Variant::ALL.par_iter().for_each(|variant| {
                let _kept_for_later = case.run(*variant);
            });
            // The others may be one of those runs.
            case.model().target().map(|_| (case.finer(), case.equilibrium(), case.sticking()));
        });
        self.model().target().map(|_| self.is_least_friction());
    }

    /// The reference solution; nothing without contact, and where [`Case::unsolved`] says why.
    pub fn reference(&self) -> Option<&Solution> {
        self.solved_reference()?.ok()
    }

    /// The equilibrium under the scene's own friction, which variants are measured against; nothing
    /// without contact, and where [`Case::unsolved`] says why.
    pub fn equilibrium(&self) -> Option<&Solution> {
        self.solved_equilibrium()?.ok()
    }

    /// How far a run is from the equilibrium; nothing where there is none.
    pub fn from_equilibrium(&self, run: &Solution) -> Option<Distance> {
        Some(apart(run, self.equilibrium()?))
    }

    /// The solution that the corrected algorithm has: without friction, node to segment, in the initial
    /// geometry. Of the reading only what changes the model matters (R6, R8).
    ///
    /// # Errors
    /// The scene has no contact or lists a contact node twice, or there is no such solution.
    pub fn corrected(&self) -> Result<&Solution, Error> {
        corrected::check(self.model())?;
        let run = || solve(&prices::reference(&self.base), &mut |_| ());
        self.unilateral.corrected.get_or_init(run).as_ref().map_err(Clone::clone)
    }

    fn solved_reference(&self) -> Option<Result<&Solution, &Error>> {
        self.model().target()?;
        let run = || solve(&self.base.reference(), &mut |_| ());
        Some(self.unilateral.reference.get_or_init(run).as_ref())
    }

    fn solved_equilibrium(&self) -> Option<Result<&Solution, &Error>> {
        self.model().target()?;
        let wanted = self.base.equilibrium();
        if self.request(Variant::Unilateral).is_same_equilibrium(&wanted) {
            return Some(self.run(Variant::Unilateral));
        }
        let run = || solve(&wanted, &mut |_| ());
        Some(self.unilateral.equilibrium.get_or_init(run).as_ref())
    }

    /// Why there is no equilibrium, or no reference solution, to compare with.
    pub fn unsolved(&self) -> Vec<String> {
        let found = [
            ("equilibrium under the scene's own friction", self.solved_equilibrium()),
            ("reference solution", self.solved_reference()),
        ];
        let why = |(what, found): (_, Option<Result<_, &Error>>)| {
            Some(format!("no {what} to compare with: {}", found?.err()?))
        };
        found.into_iter().filter_map(why).collect()
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
