//! How the bodies of a deck touch.

use nalgebra::DVector;

use base::choices;
use base::error::{InputError, Result};
use engine::{Constraint, Detail, Motion, Solution};
use paper::mirror::Schedule;
use problem::model::{Dof, Model, NodeId};
use problem::modelling::{Friction, Variant};

choices! {
    /// How the deck has the bodies touch.
    ContactKind {
        /// `*EQUATION`: eq. (1) as an iteration has it.
        Equation = "equation",
        /// `*CONTACT PAIR`: node to surface, linear penalty.
        Pair = "pair",
    }
}

/// How contact is given to `ccx`.
#[derive(Clone, Debug)]
pub enum Contact {
    /// By these equations, which `ccx` satisfies, and the friction of sliding nodes by degree of
    /// freedom, force, which is a load on them.
    Equations(Vec<Equation>, Option<DVector<f64>>),
    /// `ccx` looks for contact itself.
    Pair(Pair),
}

/// A contact pair of `ccx`, node to surface.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Pressure over penetration, stress/length.
    pub penalty: f64,
    /// The coefficient of friction, or that nothing slides.
    pub friction: Friction,
}

impl From<Pair> for Part {
    fn from(pair: Pair) -> Self {
        Part { contact: Contact::Pair(pair), share: 1.0 }
    }
}

/// One of the problems whose sum is a run: the whole load on one contact state.
pub struct Part {
    /// Its contact.
    pub contact: Contact,
    /// Its share of the run, from 0 to 1.
    pub share: f64,
}

impl Contact {
    /// Checks that a variant constrains something, so that there are equations to write.
    ///
    /// # Errors
    /// The variant is `printed`, which constrains nothing.
    pub fn check_equations(variant: Variant) -> Result<()> {
        if variant != Variant::Printed {
            return Ok(());
        }
        let what = "the variant printed adds stiffness and constrains nothing: there are no \
                    equations to write";
        let fix = "choose tied, stepped or unilateral, or a contact pair";
        Err(InputError::new("variant", what, fix))
    }

    /// The problems whose sum a solution is. With total load that is its last step. With stepped
    /// load it is the sum of the increments: each contact state that came, with the whole load,
    /// times its share of the steps. The last step's state comes last.
    ///
    /// # Errors
    /// The variant is `printed`, which constrains nothing.
    pub fn parts(solution: &Solution) -> Result<Vec<Part>> {
        Contact::check_equations(solution.request.variant)?;
        let steps = solution.steps.len();
        let carried = match solution.request.schedule() {
            Schedule::Total => steps - 1..steps,
            Schedule::Stepped => 0..steps,
        };
        let share = 1.0 / carried.len() as f64;
        let mut states: Vec<(Vec<Equation>, f64)> = Vec::new();
        for step in &solution.steps[carried] {
            let of = |one| Equation::of_constraint(&solution.model, one);
            let equations = step.constraints.iter().flat_map(of).collect();
            let same = states.iter().position(|(other, _)| *other == equations);
            let before = same.map_or(0.0, |k| states.remove(k).1);
            states.push((equations, before + share));
        }
        let friction = match &solution.last().detail {
            Detail::Unilateral(own) => Some(own.friction(solution.u.len())),
            Detail::Published(_) => None,
        };
        let contact = |equations| Contact::Equations(equations, friction.clone());
        let part = |(equations, share)| Part { contact: contact(equations), share };
        Ok(states.into_iter().map(part).collect())
    }
}

impl Pair {
    /// Penalty times edge length over elastic modulus, unless a penalty is given: the manual
    /// advises 5 to 50 times the modulus, in mm. With more, ccx takes many more iterations, and may
    /// settle on another contact zone.
    const STIFFNESS: f64 = 10.0;

    /// A pair with `penalty`, or with one that suits the model: 10 E / h, E the largest modulus and
    /// h the mean length of the target's edges.
    pub fn new(model: &Model, penalty: Option<f64>, friction: Friction) -> Self {
        let suits = || {
            let moduli = model.triangles.iter().map(|triangle| triangle.material.e);
            let mean_edge = match model.contact.target.len() {
                0 => 1.0,
                n => {
                    model.target_edges().map(|edge| model.length(edge.nodes)).sum::<f64>()
                        / n as f64
                }
            };
            Self::STIFFNESS * moduli.fold(0.0, f64::max) / mean_edge
        };
        Pair { penalty: penalty.unwrap_or_else(suits), friction }
    }
}

/// Σ coefficient · displacement = constant. The first term is the dependent one: its displacement
/// is not restrained, and no other equation has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The displacements and their coefficients, the dependent one first.
    pub terms: Vec<(Dof, f64)>,
    /// The right-hand side, length.
    pub constant: f64,
}

impl Equation {
    /// The equations of a constraint: one along its normal, or one in each direction in which its
    /// node is not restrained.
    pub fn of_constraint(model: &Model, constraint: &Constraint) -> Vec<Equation> {
        let along = |normal, shift| Equation::along(model, constraint, normal, shift);
        match constraint.motion {
            Motion::Along(normal, shift) => vec![along(normal, shift)],
            Motion::Both([x, y]) => {
                let [fixed_x, fixed_y] = model.restraints_of(constraint.node);
                let in_x = (!fixed_x).then(|| along([1.0, 0.0], x));
                let in_y = (!fixed_y).then(|| along([0.0, 1.0], y));
                in_x.into_iter().chain(in_y).collect()
            }
        }
    }

    /// n·u_c − Σ w n·u_t = `constant`: first those components of the contact node that are not
    /// restrained, the larger one of the normal before the other.
    fn along(model: &Model, constraint: &Constraint, normal: [f64; 2], constant: f64) -> Equation {
        let larger = usize::from(normal[1].abs() > normal[0].abs());
        let directions = [larger, 1 - larger].into_iter().filter(|&d| normal[d] != 0.0);
        let of_node = |node: NodeId, weight: f64| {
            directions.clone().map(move |d| (node.dofs()[d], weight * normal[d]))
        };
        let own = of_node(constraint.node, 1.0).filter(|(dof, _)| !model.is_restrained(*dof));
        let masters = constraint.masters.iter().filter(|(_, weight)| *weight != 0.0);
        let masters = masters.flat_map(|&(master, weight)| of_node(master, -weight));
        Equation { terms: own.chain(masters).collect(), constant }
    }
}
