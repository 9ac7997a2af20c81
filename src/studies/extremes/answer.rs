//! The answer of a run with all its digits, and how far it is from another.

use dashu_ratio::RBig;

use super::verdict::Verdict;
use crate::answer::error::Error;
use crate::answer::{self, Request, Solution};
use crate::numbers::solve::{Arithmetic, ScalarName, Solver};
use crate::problem::model::{Dof, NodeId};
use crate::problem::modelling::Variant;
use crate::problem::scene::SceneBuilder;

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Displacements, relative to the largest of their body.
    Displacement,
    /// Von Mises stresses, relative to the largest.
    Mises,
}

/// An answer.
pub struct Answer {
    /// Displacements by degree of freedom, length.
    pub u: Vec<RBig>,
    /// Von Mises stresses.
    mises: Vec<f64>,
    /// Who is in contact at the end.
    in_contact: Vec<bool>,
    /// Degrees of freedom of each body.
    bodies: Vec<Vec<Dof>>,
}

/// Runs `variant` on `scene` in `scalar`, by its own solver unless another is given.
///
/// # Errors
/// Those of the scene and of the run.
pub fn solve(
    scene: &SceneBuilder,
    variant: Variant,
    scalar: ScalarName,
    solver: Option<Solver>,
) -> Result<Answer, Error> {
    let scene = scene.build()?;
    let arithmetic = Arithmetic { scalar, solver, ..Arithmetic::default() };
    let request = Request::new(&scene).variant(variant).arithmetic(arithmetic);
    Ok(Answer::new(&answer::solve(&request, &mut |_| ())?))
}

impl Answer {
    /// The answer of a run, with all the digits that its scalar has.
    pub fn new(solution: &Solution) -> Self {
        let value = |x: &f64| RBig::try_from(*x).expect("a run's displacements are finite");
        let dofs = |nodes: &[NodeId]| nodes.iter().flat_map(|node| node.dofs()).collect();
        let doubles = || solution.u.iter().map(value).collect();
        Answer {
            u: solution.digits.clone().unwrap_or_else(doubles),
            mises: solution.elements.iter().map(|state| state.von_mises_stress).collect(),
            in_contact: solution.last().statuses(),
            bodies: solution.model.bodies.iter().map(|body| dofs(&body.nodes)).collect(),
        }
    }

    /// The answer with its displacements times `factor`.
    pub fn times(mut self, factor: f64) -> Self {
        let factor = RBig::try_from(factor).expect("a power of two");
        self.u.iter_mut().for_each(|u| *u = &*u * &factor);
        self
    }

    /// This answer against the `exact` one: another contact state is wrong, whatever the
    /// displacements.
    pub fn against(&self, exact: &Answer, quantity: Quantity) -> Verdict {
        if self.in_contact != exact.in_contact {
            return Verdict::of_status(false);
        }
        self.beside(exact, quantity)
    }

    /// The same, whoever is in contact.
    pub fn beside(&self, exact: &Answer, quantity: Quantity) -> Verdict {
        match quantity {
            Quantity::Displacement => {
                let of_body = |dofs: &Vec<Dof>| self.error(exact, dofs);
                Verdict::of_error(exact.bodies.iter().map(of_body).fold(0.0, f64::max))
            }
            Quantity::Mises => {
                let pairs = self.mises.iter().zip(&exact.mises);
                let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                Verdict::of_error(error / exact.mises.iter().fold(0.0, |m: f64, x| m.max(*x)))
            }
        }
    }

    /// Largest error over the largest displacement of a body; infinite where the exact one is 0 and
    /// this is not.
    fn error(&self, exact: &Answer, dofs: &[Dof]) -> f64 {
        let abs = |x: RBig| if x < RBig::ZERO { -x } else { x };
        let largest = |x: &dyn Fn(usize) -> RBig| {
            dofs.iter().map(|dof| abs(x(dof.index()))).max().unwrap_or(RBig::ZERO)
        };
        let (error, size) =
            (largest(&|e| &self.u[e] - &exact.u[e]), largest(&|e| exact.u[e].clone()));
        match () {
            _ if error.is_zero() => 0.0,
            _ if size.is_zero() => f64::INFINITY,
            _ => (error / size).to_f64().value(),
        }
    }
}

/// Runs `variant` on `scene` in `scalar` and compares it with the exact run.
pub fn against_exact(
    scene: &SceneBuilder,
    variant: Variant,
    scalar: ScalarName,
    solver: Option<Solver>,
    quantity: Quantity,
) -> Verdict {
    match solve(scene, variant, scalar, solver) {
        Err(error) => error.into(),
        Ok(answer) => compared(&answer, scene, variant, quantity),
    }
}

/// Compares `answer` with the exact run of `variant` on `scene`; `unilateral` has no exact run and
/// is compared with `tied`, which is its answer where nothing opens.
pub fn compared(
    answer: &Answer,
    scene: &SceneBuilder,
    variant: Variant,
    quantity: Quantity,
) -> Verdict {
    let unilateral = variant == Variant::Unilateral;
    let exact = if unilateral { Variant::Tied } else { variant };
    match solve(scene, exact, ScalarName::Exact, None) {
        Ok(exact) if unilateral && answer.in_contact != exact.in_contact => Verdict::Unknown,
        Ok(exact) => answer.against(&exact, quantity),
        Err(_) => Verdict::Wrong("exact refuses"),
    }
}
