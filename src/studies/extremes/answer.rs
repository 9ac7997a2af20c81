//! The answer of a run with all its digits, and how far it is from another.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use dashu_ratio::RBig;

use super::verdict::Verdict;
use engine::error::Error;
use engine::{self, Request};
use numbers::solve::{Arithmetic, ScalarName, Solver};
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::SceneBuilder;

/// What is compared of an answer and the exact one, whoever is in contact.
pub type Quantity = fn(&Answer, &Answer) -> Verdict;

/// What a run computed, with all the digits that its scalar has.
pub struct Answer {
    /// Displacements by degree of freedom, length.
    u: Vec<RBig>,
    /// Von Mises stress of each triangle.
    mises: Vec<f64>,
    in_contact: Vec<bool>,
    /// Places in `u` of the degrees of freedom of each body.
    bodies: Vec<Vec<usize>>,
}

/// Runs `variant` on `scene` in `scalar`, by its own solver unless another is given.
pub fn solve(
    scene: &SceneBuilder,
    variant: Variant,
    scalar: ScalarName,
    solver: Option<Solver>,
) -> Result<Answer, Error> {
    let scene = scene.build()?;
    let arithmetic = Arithmetic { scalar, solver, ..Arithmetic::default() };
    let request = Request::new(&scene).variant(variant).arithmetic(arithmetic);
    let solution = engine::solve(&request, &mut |_| ())?;
    let value = |x: &f64| RBig::try_from(*x).expect("a run's displacements are finite");
    let dofs = |node: &NodeId| node.dofs().map(|dof| dof.index());
    let bodies = solution.model.bodies.iter();
    Ok(Answer {
        mises: solution.elements.iter().map(|state| state.von_mises_stress).collect(),
        in_contact: solution.last().statuses(),
        bodies: bodies.map(|body| body.nodes.iter().flat_map(dofs).collect()).collect(),
        u: solution.digits.unwrap_or_else(|| solution.u.iter().map(value).collect()),
    })
}

impl Answer {
    /// The answer with its displacements times `factor`.
    pub fn times(mut self, factor: f64) -> Self {
        let factor = RBig::try_from(factor).expect("a power of two");
        self.u.iter_mut().for_each(|u| *u = &*u * &factor);
        self
    }

    /// This answer against the `exact` one: another contact state is wrong, whatever `quantity` is.
    pub fn against(&self, exact: &Answer, quantity: Quantity) -> Verdict {
        if self.in_contact == exact.in_contact {
            quantity(self, exact)
        } else {
            Verdict::of_status(false)
        }
    }

    /// Displacements, relative to the largest of their body.
    pub fn displacement(&self, exact: &Answer) -> Verdict {
        let of_body = |dofs: &Vec<usize>| self.error(exact, dofs);
        Verdict::of_error(exact.bodies.iter().map(of_body).fold(0.0, f64::max))
    }

    /// Von Mises stresses, relative to the largest.
    pub fn mises(&self, exact: &Answer) -> Verdict {
        let pairs = self.mises.iter().zip(&exact.mises);
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        Verdict::of_error(error / exact.mises.iter().fold(0.0, |m: f64, x| m.max(*x)))
    }

    /// Largest error over the largest displacement of a body; infinite where the exact one is 0 and
    /// this is not.
    fn error(&self, exact: &Answer, dofs: &[usize]) -> f64 {
        let abs = |x: RBig| if x < RBig::ZERO { -x } else { x };
        let largest =
            |of: &dyn Fn(usize) -> RBig| dofs.iter().map(|&e| abs(of(e))).max().unwrap_or_default();
        let error = largest(&|e| &self.u[e] - &exact.u[e]);
        let size = largest(&|e| exact.u[e].clone());
        if error.is_zero() {
            0.0
        } else if size.is_zero() {
            f64::INFINITY
        } else {
            (error / size).to_f64().value()
        }
    }
}

/// Exact answers, each solved once for all methods that are compared with it.
#[derive(Default)]
pub struct Exacts(Mutex<Vec<Known>>);

struct Known {
    scene: SceneBuilder,
    variant: Variant,
    answer: Result<Arc<Answer>, Verdict>,
}

impl Exacts {
    /// Runs `variant` on `scene` in exact numbers; else returns how that is refused.
    pub fn answer(&self, scene: &SceneBuilder, variant: Variant) -> Result<Arc<Answer>, Verdict> {
        let is_known = |known: &&Known| known.variant == variant && known.scene == *scene;
        if let Some(known) = self.known().iter().find(is_known) {
            return known.answer.clone();
        }
        let answer = solve(scene, variant, ScalarName::Exact, None);
        let answer = answer.map(Arc::new).map_err(Verdict::from);
        self.known().push(Known { scene: scene.clone(), variant, answer: answer.clone() });
        answer
    }

    /// Compares `answer` with the exact run of `variant` on `scene`; `unilateral` has no exact run
    /// and is compared with `tied`, which is its answer where nothing opens.
    pub fn judge(
        &self,
        answer: &Answer,
        scene: &SceneBuilder,
        variant: Variant,
        quantity: Quantity,
    ) -> Verdict {
        let unilateral = variant == Variant::Unilateral;
        match self.answer(scene, if unilateral { Variant::Tied } else { variant }) {
            Ok(exact) if unilateral && answer.in_contact != exact.in_contact => Verdict::Unknown,
            Ok(exact) => answer.against(&exact, quantity),
            Err(_) => Verdict::Wrong("exact refuses"),
        }
    }

    fn known(&self) -> MutexGuard<'_, Vec<Known>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
