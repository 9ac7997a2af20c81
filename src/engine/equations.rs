//! The equations A(c)·u = f of an iteration of a published variant, assembled and solved.

use std::sync::Arc;

use nalgebra::DVector;

use super::contact::{Surfaces, hidden};
use super::elimination::{Constraint, Elimination};
use super::error::{Error, SingularMatrix};
use super::reactions::{reactions, support, supports};
use super::request::Request;
use super::stiffness::Stiffness;
use crate::linear::{Precision, Singular, Solved, Solver};
use mathcad::array::Table;
use numbers::scalar::Scalar;
use numbers::square::SparseSquare;
use paper::door;
use paper::edited::Interpreter;
use paper::mirror::{self, Pairs, Schedule, Worksheet};
use problem::model::{Dof, Model, NodeId};
use problem::modelling::{Coupling, Variant};

/// The source of the matrix of an iteration.
enum Assembly<T> {
    /// `Km` with the contact pairs, as printed.
    Printed,
    /// Elimination from the matrix of `Km` without contact and without restraints.
    Dense(Table<T>),
    /// Elimination from the triangles' matrices.
    Sparse,
}

/// The parts of the equations that every iteration of a run shares.
pub(super) struct Equations<'a, T> {
    pub request: &'a Request,
    pub model: &'a Arc<Model>,
    pub sheet: &'a Worksheet<T>,
    assembly: Assembly<T>,
    /// What executes the edited listings; None where no listing is edited.
    pub interpreter: Option<&'a Interpreter>,
    /// The stiffness, triangle by triangle.
    pub stiffness: Stiffness<T>,
    /// The model as the run restrains it.
    restrained: Arc<Model>,
    /// Whether each degree of freedom is a restrained one of the body to which contact passes its force.
    supports: Vec<bool>,
    /// The whole load by degree of freedom, force.
    load: DVector<T>,
    /// The load of one iteration by degree of freedom, force.
    own: DVector<T>,
    /// The same, 0 at restrained ones.
    f: DVector<T>,
}

/// The result of an iteration's own load.
#[derive(Clone)]
pub(super) struct Increment<T> {
    /// The displacements by degree of freedom, length.
    pub u: DVector<T>,
    /// The relative residual of the solution.
    pub residual: f64,
    /// The sum of what holds the body to which contact passes its force, force.
    pub support: [T; 2],
    /// What contact adds to the forces on restraints, by degree of freedom, force.
    pub passed: DVector<T>,
}

impl<T: Scalar> Increment<T> {
    /// Returns that of no load.
    pub fn none(dofs: usize) -> Self {
        let zeros = DVector::from_element(dofs, T::zero());
        Increment { u: zeros.clone(), residual: 0.0, support: [T::zero(); 2], passed: zeros }
    }

    /// Adds the next one, whose residual is that of the sum.
    pub fn add(&mut self, next: &Self) {
        self.u += &next.u;
        self.residual = next.residual;
        self.support = [0, 1].map(|d| self.support[d] + next.support[d]);
        self.passed += &next.passed;
    }
}

impl<'a, T: Precision> Equations<'a, T> {
    /// Prepares the equations of `request`, in numbers that `number` makes of those of the scene.
    ///
    /// # Errors
    /// The stiffness overflows.
    pub fn new(
        request: &'a Request,
        model: &'a Arc<Model>,
        sheet: &'a Worksheet<T>,
        interpreter: Option<&'a Interpreter>,
        number: &dyn Fn(f64) -> T,
    ) -> Result<Self, Error> {
        let share = match request.schedule() {
            Schedule::Total => T::one(),
            Schedule::Stepped => T::from_number(request.iterations),
        };
        let (load, restrained) = (model.load_in(number), restrained(model, request));
        let own = load.map(|f| f / share);
        let f = restrained.free_part(&own);
        let assembly = match (request.variant, request.solver()) {
            (Variant::Printed, _) => Assembly::Printed,
            (_, Solver::SparseCholesky) => Assembly::Sparse,
            (_, Solver::DenseLu | Solver::SparseLu) => {
                Assembly::Dense(match interpreter.and_then(|i| i.free_stiffness()) {
                    Some(edited) => edited?,
                    None => door::free_stiffness(sheet, &request.reading)?,
                })
            }
        };
        let stiffness = Stiffness::new(model, number);
        Ok(Equations {
            request,
            model,
            sheet,
            assembly,
            interpreter,
            stiffness,
            supports: supports(&restrained),
            restrained,
            load,
            own,
            f,
        })
    }

    /// Solves A(c)·u = f in iteration `k`.
    ///
    /// # Errors
    /// A singular matrix, an overflow of `Km`.
    pub fn solve(
        &self,
        pairs: &Pairs<T>,
        constraints: &[Constraint<T>],
        k: usize,
    ) -> Result<Increment<T>, Error> {
        let solver = self.request.solver();
        match &self.assembly {
            Assembly::Printed => {
                let solved = T::sweep(|| {
                    let edited = self.interpreter.and_then(|i| i.km(&pairs.k_cnt));
                    let matrix = match edited {
                        Some(edited) => SparseSquare::from_dense(edited?.as_matrix()),
                        None => mirror::Km(self.sheet, &self.request.reading, &pairs.k_cnt)?
                            .into_sparse(),
                    };
                    let matrix = door::holding_dropped(self.model, matrix);
                    let solved = T::solve(&matrix, &self.f, solver);
                    solved.map_err(|why| self.singular(why, pairs, k, Dof::new))
                })?;
                Ok(self.solved(solved.residual, solved.x, &[]))
            }
            Assembly::Dense(matrix) => self.eliminate(pairs, constraints, k, |t, f| {
                Ok(T::solve(&SparseSquare::from_dense(&t.matrix(matrix.as_matrix())), f, solver))
            }),
            Assembly::Sparse => self.eliminate(pairs, constraints, k, |t, f| {
                let matrix = self.stiffness.reduced(t);
                if matrix.entries().any(|(_, _, value)| !Scalar::is_finite(value)) {
                    // It is reported in the words of `Km`.
                    door::free_stiffness(self.sheet, &self.request.reading)?;
                }
                Ok(T::solve_symmetric(&matrix, f))
            }),
        }
    }

    /// Solves Tᵀ K T q = Tᵀ f by `solve`.
    fn eliminate(
        &self,
        pairs: &Pairs<T>,
        constraints: &[Constraint<T>],
        k: usize,
        solve: impl Fn(&Elimination<T>, &DVector<T>) -> Result<Result<Solved<T>, Singular>, Error>,
    ) -> Result<Increment<T>, Error> {
        let t = Elimination::new(&self.model.holds, constraints);
        let solved = T::sweep(|| {
            let solved = solve(&t, &t.load(&self.f))?;
            solved.map_err(|why| self.singular(why, pairs, k, |column| t.dof(column)))
        })?;
        Ok(self.solved(solved.residual, t.expand(&solved.x), constraints))
    }

    /// Returns K u − F of the whole load: the forces of contact and restraints, force.
    pub fn reaction(&self, u: &DVector<T>) -> DVector<T> {
        self.stiffness.times(u) - &self.load
    }

    /// Returns the forces of the restraints by degree of freedom, force, from the [`Self::reaction`] and from
    /// what contact adds to it there.
    pub fn reactions(&self, reaction: &DVector<f64>, passed: &DVector<T>) -> DVector<f64> {
        reactions(&self.restrained, reaction + passed.map(T::to_f64))
    }

    fn solved(&self, residual: f64, u: DVector<T>, constraints: &[Constraint<T>]) -> Increment<T> {
        let mut wanted = self.supports.clone();
        let bound = constraints.iter().flat_map(|constraint| constraint.node.dofs());
        bound.for_each(|dof| wanted[dof.index()] = true);
        let force = self.stiffness.times_of(self.stiffness.about(&wanted), &u) - &self.own;
        let (support, passed) = support(&self.restrained, constraints, &force, &self.own);
        Increment { residual, support, passed, u }
    }

    /// Returns the error of a singular matrix; `dof` maps a column to a degree of freedom.
    fn singular(
        &self,
        singular: Singular,
        pairs: &Pairs<T>,
        iteration: usize,
        dof: impl Fn(usize) -> Dof,
    ) -> Error {
        let dof = dof(singular.column);
        let body = self.model.body_of(dof.node());
        let in_contact = pairs.dy.iter().sum();
        let first = iteration == 1 && in_contact == 0 && self.model.has_contact();
        SingularMatrix {
            variant: self.request.variant.name(),
            iteration,
            node: dof.node().number(),
            direction: dof.axis(),
            pivot: singular.pivot,
            in_contact,
            no_contact: first.then(|| self.no_contact()).flatten().map(Into::into),
            scalar: self.request.arithmetic.scalar,
            slits: None,
            body: body.map_or(String::new(), |b| format!(" of body {:?}", b.name)).into(),
        }
        .into()
    }

    /// Returns why the first contact has no node, in words: the direction of the target's edges, or the
    /// gap of the initial shape that is nearest to 0. None where no contact node faces the target.
    fn no_contact(&self) -> Option<String> {
        let (model, reading) = (self.model, &self.request.reading);
        if self.request.is_as_printed()
            && let Some(why) = hidden(model, reading, &model.nodes)
        {
            return Some(why);
        }
        // Of surfaces that cannot be paired no node faces the target.
        let pairings = Surfaces::new(model).ok()?.pairings(Coupling::Nts, &model.nodes);
        let gaps = pairings.iter().flatten().map(|pairing| pairing.gap);
        let gap = gaps.min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let c_tll = model.contact.tolerance;
        Some(format!(
            "the gap nearest to 0 is {gap:e}, and c_tll is {c_tll:e}; move the bodies together, or give a \
             larger c_tll"
        ))
    }
}

/// Returns the model with its own restraints, or under reading R2 = printed, where `Km` reads the restraint
/// of y in place of that of x, with those of `Km`.
fn restrained(model: &Arc<Model>, request: &Request) -> Arc<Model> {
    if request.variant != Variant::Printed || !request.reading.r2.takes_y_for_x() {
        return Arc::clone(model);
    }
    let mut own = Model::clone(model);
    own.holds.release(model.all_dofs());
    let held = model.node_ids().filter(|node| model.is_restrained(node.y()));
    own.holds.fix(held.flat_map(NodeId::dofs));
    Arc::new(own)
}
