//! The iterations that the paper describes (`READING.md` section 6): `printed`, `tied`, `stepped`.
//!
//! - total load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·U = F; node_n = node + U.
//! - stepped load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·dU = F/n; U = U + dU; node_n = node + U.
//!
//! A(c) is Km(c) under `printed`, else Tᵀ·K·T on the free equations, K being Km without contact and without restraints.

use nalgebra::DVector;

use super::elimination::{Elimination, Tie, interpolations, sum, ties};
use super::outcome::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, shape, states};
use super::pairing::Surfaces;
use super::pressure::{ContactNode, Surface};
use super::sparse::Sparse;
use super::status;
use super::stiffness::Stiffness;
use super::support::{against_load, support};
use super::task::Task;
use super::variant::schedule;
use crate::answer::error::{Error, SingularMatrix};
use crate::error::InputError;
use crate::numbers::scalar::Scalar;
use crate::numbers::solve::{
    Inputs, Precision, ScalarName, Solved, Solver, SparseSymmetric, Unsolved, cost, memory,
};
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::{
    Failure, Km, NodeTable, Pairs, Reading, RestraintIndex, Schedule, Worksheet, c_cnt,
};
use crate::problem::modelling::Coupling;
use crate::problem::modelling::StatusRule;
use crate::problem::modelling::Variant;

/// The iterations that the paper describes. `sparse` solves where the rung is sparse Cholesky; without it that rung builds a dense matrix too.
///
/// # Errors
/// The published algorithm failing as printed, a matrix that cannot be solved, a dense matrix that does not fit.
pub(super) fn published<T: Precision>(
    task: &Task,
    sparse: Option<Sparse<T>>,
    watch: &mut dyn FnMut(&Iteration),
) -> Result<Outcome, Error> {
    check_size::<T>(task)?;
    let number = |x: f64| match task.arithmetic.inputs {
        Inputs::Binary => T::from_f64(x),
        Inputs::Decimal => T::from_decimal(x),
    };
    let sheet = task.sheet.recomputed(number, task.scene.thickness);
    let load = task.scene.load.map(number);
    check_load(task, &load)?;
    let mut run = Run::new(task, &sheet, load, sparse)?;
    let mut iterations: Vec<Iteration> = Vec::new();
    for k in 1..=task.scene.iterations {
        let iteration = run.iterate(k)?;
        watch(&iteration);
        iterations.push(iteration);
    }
    let last = iterations.last().expect("a scene has an iteration");
    let contact = run.contact(&last.pairs)?;
    Ok(Outcome {
        variant: task.variant,
        schedule: run.schedule,
        reading: *task.reading,
        model: task.scene.contact,
        sheet: task.sheet.clone(),
        iterations,
        elements: states(&sheet, &run.u),
        contact,
        factored: run.met.len(),
        arithmetic: task.arithmetic,
        digits: run.u.iter().map(|u| u.digits()).collect(),
        error_bound: run.u.iter().try_fold(0.0, |m: f64, u| u.error_bound().map(|e| m.max(e))),
        u: run.u.map(T::to_f64),
    })
}

/// That no load vanished or lost digits where the scalar has no smaller numbers: an answer of zeros would look like one.
fn check_load<T: Scalar>(task: &Task, load: &DVector<T>) -> Result<(), InputError> {
    /// Relative error of a load that is within the scalar's range is 6e-8 in the coarsest, f32.
    const ROUNDED: f64 = 1e-6;
    let lost = |(x, y): &(&f64, &T)| {
        y.to_f64().is_finite() && (y.to_f64() - **x).abs() > ROUNDED * x.abs()
    };
    match task.scene.load.iter().zip(load.iter()).find(lost) {
        None => Ok(()),
        Some((x, _)) => {
            let what =
                format!("the force {x:e} is too small to represent in {}", task.arithmetic.scalar);
            Err(InputError::new("loads", what, "choose other units, or use --scalar f64"))
        }
    }
}

/// That the matrices fit in memory, and exact numbers in a bearable time.
fn check_size<T: Precision>(task: &Task) -> Result<(), InputError> {
    // Of the numbers' own size, in units of an f64.
    let matrices = task.dense_matrices() * size_of::<T>().div_ceil(size_of::<f64>());
    memory::check(task.sheet.R(), matrices, memory::free())?;
    if task.arithmetic.scalar != ScalarName::Exact {
        return Ok(());
    }
    let free = task.sheet.S.iter().filter(|s| **s == 0).count();
    cost::check(free, task.reading.r5 == NodeTable::NodeN, task.scene.iterations)
}

/// What an iteration needs of those before it.
struct Run<'a, T> {
    task: &'a Task<'a>,
    sheet: &'a Worksheet<T>,
    schedule: Schedule,
    /// How the matrix of an iteration comes about.
    assembly: Assembly<T>,
    /// The stiffness by triangles.
    stiffness: Stiffness<T>,
    /// The restrained equations.
    held: Vec<bool>,
    /// What mortar needs of the surfaces; nothing under `nts`.
    surfaces: Option<Surfaces>,
    /// The whole load, force.
    load: DVector<T>,
    /// The load that one iteration carries, 0 at restrained equations.
    f: DVector<T>,
    /// The whole load over the load of one iteration.
    share: T,
    /// Total displacements.
    u: DVector<T>,
    /// What supports the target so far.
    support: [T; 2],
    /// Contact states met, each with its solution and the last iteration that met it. The load of an iteration is always
    /// the same, so a state that came before has the same matrix and the same solution: nothing is factored again.
    met: Vec<Met<T>>,
}

/// How the matrix of an iteration comes about.
enum Assembly<T> {
    /// By `Km` with the contact pairs.
    Printed,
    /// By elimination from `Km` without contact and without restraints.
    Dense(Table<T>),
    /// By elimination from the triangles; solved by the function.
    Sparse(Sparse<T>),
}

/// A contact state, all of k_cnt and the weights of the ties, and what came of it.
struct Met<T> {
    k_cnt: Table<T>,
    ties: Vec<Tie<T>>,
    /// The last iteration that met it.
    k: usize,
    solution: Solution<T>,
}

/// The displacements of an iteration's own load.
#[derive(Clone)]
struct Solution<T> {
    u: DVector<T>,
    residual: f64,
    /// What supports the target.
    support: [T; 2],
}

impl<'a, T: Precision> Run<'a, T> {
    fn new(
        task: &'a Task<'a>,
        sheet: &'a Worksheet<T>,
        load: DVector<T>,
        sparse: Option<Sparse<T>>,
    ) -> Result<Self, Error> {
        let Task { scene, variant, reading, .. } = *task;
        let schedule = schedule(variant, reading);
        let share = match schedule {
            Schedule::Total => T::one(),
            Schedule::Stepped => T::from_number(scene.iterations),
        };
        let equations = 2 * sheet.R();
        let held = held(sheet, variant, reading);
        let f =
            DVector::from_fn(equations, |e, _| if held[e] { T::zero() } else { load[e] / share });
        let mortar = scene.contact.coupling == Coupling::Mortar && variant != Variant::Printed;
        let sparse = sparse.filter(|_| task.arithmetic.solver() == Solver::SparseCholesky);
        let assembly = match (variant, sparse) {
            (Variant::Printed, _) => Assembly::Printed,
            (_, Some(solve)) => Assembly::Sparse(solve),
            (_, None) => Assembly::Dense(free_stiffness(sheet, reading)?),
        };
        let surfaces = if mortar { Some(mortar_surfaces(task)?) } else { None };
        Ok(Run {
            task,
            sheet,
            schedule,
            assembly,
            stiffness: Stiffness::new(sheet),
            held,
            surfaces,
            load,
            f,
            share,
            u: DVector::from_element(equations, T::zero()),
            support: [T::zero(), T::zero()],
            met: Vec::new(),
        })
    }

    fn iterate(&mut self, k: usize) -> Result<Iteration, Error> {
        let node_n = shape(self.sheet, &self.u);
        let pairs = if self.sheet.cnt.rows() == 0 {
            // Without contact nothing of contact is built: `c_cnt` is not called.
            Pairs::none(self.sheet.R())
        } else {
            self.pairs(&node_n)?
        };
        let ties = self.ties(&pairs, &node_n);
        let before = self.met.iter().position(|met| met.is(&pairs, &ties));
        let (cycle, solution) = match before.map(|at| self.met.swap_remove(at)) {
            Some(met) => {
                let cycle = Cycle { length: k - met.k, members: (met.k..k).collect() };
                (Some(cycle), met.solution)
            }
            None => (None, self.solve(&pairs, &ties, k)?),
        };
        self.advance(&solution);
        let iteration = self.report(k, &node_n, (&pairs, &ties), cycle, &solution);
        self.met.push(Met { k_cnt: pairs.k_cnt, ties, k, solution });
        Ok(iteration)
    }

    /// The contact pairs, by `c_cnt`; under another status rule, which decides in f64, by that. `printed` is the listing's own.
    fn pairs(&self, node_n: &Table<T>) -> Result<Pairs<T>, Failure> {
        let Task { scene, sheet, reading, variant, .. } = *self.task;
        match scene.contact.status {
            StatusRule::Signs => c_cnt(self.sheet, reading, node_n),
            _ if variant == Variant::Printed => c_cnt(self.sheet, reading, node_n),
            rule => {
                let pairs = status::pairs(rule, sheet, reading, &node_n.map(T::to_f64))?;
                Ok(pairs.map(T::from_f64))
            }
        }
    }

    /// From one shape to the next.
    fn advance(&mut self, solution: &Solution<T>) {
        match self.schedule {
            Schedule::Total => (self.u, self.support) = (solution.u.clone(), solution.support),
            Schedule::Stepped => {
                self.u += &solution.u;
                self.support = [0, 1].map(|d| self.support[d] + solution.support[d]);
            }
        }
    }

    fn report(
        &self,
        k: usize,
        node_n: &Table<T>,
        (pairs, ties): (&Pairs<T>, &[Tie<T>]),
        cycle: Option<Cycle>,
        solution: &Solution<T>,
    ) -> Iteration {
        let bound: &[Tie<T>] = if self.task.variant == Variant::Printed { &[] } else { ties };
        let interpolations = match &self.surfaces {
            Some(_) => ties.to_vec(),
            None => interpolations(self.sheet, pairs, self.weights_from(node_n)),
        };
        Iteration {
            k,
            in_contact: pairs.dy.iter().sum(),
            max_displacement: max_displacement(&self.u),
            cycle,
            eq1_residual: eq1_residual(&interpolations, &self.u),
            eq1_residual_step: eq1_residual(&interpolations, &solution.u),
            target_force: against_load(self.task.scene, self.support.map(T::to_f64)),
            solve_residual: solution.residual,
            node_n: node_n.map(T::to_f64),
            ties: bound.iter().map(|tie| tie.map(T::to_f64)).collect(),
            pairs: pairs.map(T::to_f64),
        }
    }

    /// The shape that weights come from (R5).
    fn weights_from<'b>(&'b self, node_n: &'b Table<T>) -> &'b Table<T> {
        match self.task.reading.r5 {
            NodeTable::Node => &self.sheet.node,
            NodeTable::NodeN => node_n,
        }
    }

    /// Eq. (1) for the nodes in contact: the weights of k_cnt, or mortar's for the nodes whose edges cover the target.
    fn ties(&self, pairs: &Pairs<T>, node_n: &Table<T>) -> Vec<Tie<T>> {
        let mut ties = ties(self.sheet, pairs);
        let Some(surfaces) = &self.surfaces else { return ties };
        let shape = self.weights_from(node_n).map(T::to_f64);
        let pairings = surfaces.pairings(Coupling::Mortar, &shape);
        for pairing in pairings.into_iter().flatten() {
            for tie in ties.iter_mut().filter(|tie| tie.node == pairing.node) {
                tie.weights =
                    pairing.weights.iter().map(|(mate, w)| (*mate, T::from_f64(*w))).collect();
            }
        }
        ties
    }

    /// Solves A(c)·u = f.
    fn solve(&self, pairs: &Pairs<T>, ties: &[Tie<T>], k: usize) -> Result<Solution<T>, Error> {
        let (solver, tol) = (self.task.arithmetic.solver(), self.task.arithmetic.tol);
        match &self.assembly {
            Assembly::Printed => {
                let solved = T::sweep(|| {
                    let matrix = Km(self.sheet, self.task.reading, &pairs.k_cnt)?.into_matrix();
                    let solved = T::solve(matrix, &self.f, solver, tol);
                    solved.map_err(|why| self.unsolved(why, pairs, k, |column| column))
                })?;
                Ok(self.solution(solved.residual, solved.x, &[]))
            }
            Assembly::Dense(matrix) => self.eliminate(pairs, ties, k, |t, f| {
                Ok(T::solve(t.matrix(matrix.as_matrix()), f, solver, tol))
            }),
            Assembly::Sparse(solve) => {
                self.eliminate(pairs, ties, k, |t, f| Ok(solve(self.reduced(t)?, f)))
            }
        }
    }

    /// Solves Tᵀ K T q = Tᵀ f by `solve`.
    fn eliminate(
        &self,
        pairs: &Pairs<T>,
        ties: &[Tie<T>],
        k: usize,
        solve: impl Fn(&Elimination<T>, &DVector<T>) -> Result<Result<Solved<T>, Unsolved>, Error>,
    ) -> Result<Solution<T>, Error> {
        let t = Elimination::new(self.sheet, ties);
        let solved = T::sweep(|| {
            let solved = solve(&t, &t.load(&self.f))?;
            solved.map_err(|why| self.unsolved(why, pairs, k, |column| t.equation(column)))
        })?;
        Ok(self.solution(solved.residual, t.expand(&solved.x), ties))
    }

    /// Tᵀ K T without a dense K.
    ///
    /// # Errors
    /// An overflow, in the words of `Km`.
    fn reduced(&self, t: &Elimination<T>) -> Result<SparseSymmetric<T>, Error> {
        let matrix = self.stiffness.reduced(t);
        if matrix.entries().any(|(_, _, value)| !Scalar::is_finite(value)) {
            free_stiffness(self.sheet, self.task.reading)?;
        }
        Ok(matrix)
    }

    fn solution(&self, residual: f64, u: DVector<T>, ties: &[Tie<T>]) -> Solution<T> {
        let load = self.load.map(|f| f / self.share);
        let force = self.stiffness.times(&u) - load;
        Solution { residual, support: support(self.task.scene, &self.held, ties, &force), u }
    }

    /// Why there is no solution, in words; `equation` gives the equation of a column.
    fn unsolved(
        &self,
        why: Unsolved,
        pairs: &Pairs<T>,
        iteration: usize,
        equation: impl Fn(usize) -> usize,
    ) -> Error {
        let stopped = match why {
            Unsolved::Singular(s) => {
                return self.singular_matrix(pairs, iteration, equation(s.column), s.pivot).into();
            }
            Unsolved::NotConverged(stopped) => stopped,
        };
        let what = format!(
            "{} in {} stopped after {} iterations at a relative residual of {:e}",
            self.task.arithmetic.solver(),
            self.task.arithmetic.scalar,
            stopped.iterations,
            stopped.residual
        );
        InputError::new("--solver, --tol", what, "give a larger --tol or another solver").into()
    }

    /// The contact surface at the end.
    fn contact(&self, last: &Pairs<f64>) -> Result<Vec<ContactNode>, InputError> {
        let Task { scene, sheet, .. } = *self.task;
        if sheet.cnt.rows() == 0 {
            return Ok(Vec::new());
        }
        let node_n = shape(self.sheet, &self.u).map(T::to_f64);
        let surface = Surface {
            sheet,
            thickness: scene.thickness,
            pairings: &Surfaces::new(sheet)?.pairings(Coupling::Nts, &node_n),
            measured_in: &node_n,
            dy: last.dy.as_slice(),
            reaction: &(self.stiffness.times(&self.u) - &self.load).map(T::to_f64),
        };
        surface.nodes()
    }

    fn singular_matrix(
        &self,
        pairs: &Pairs<T>,
        iteration: usize,
        equation: usize,
        pivot: f64,
    ) -> SingularMatrix {
        let node = equation / 2 + 1;
        let body = self.task.scene.body_of(node);
        SingularMatrix {
            variant: self.task.variant.name(),
            iteration,
            node,
            direction: ['x', 'y'][equation % 2],
            pivot,
            in_contact: pairs.dy.iter().sum(),
            body: body.map_or(String::new(), |b| format!(" of body {:?}", b.name)),
        }
    }
}

impl<T: Scalar> Met<T> {
    /// Whether this is the state of `pairs` and `ties`.
    fn is(&self, pairs: &Pairs<T>, ties: &[Tie<T>]) -> bool {
        let mut entries = self.k_cnt.as_matrix().iter().zip(pairs.k_cnt.as_matrix().iter());
        let weights = |ties: &[Tie<T>]| -> Vec<(usize, T)> {
            ties.iter().flat_map(|tie| tie.weights.clone()).collect()
        };
        let (mine, theirs) = (weights(&self.ties), weights(ties));
        entries.all(|(a, b)| a.same(*b))
            && mine.len() == theirs.len()
            && mine.iter().zip(&theirs).all(|(a, b)| a.0 == b.0 && a.1.same(b.1))
    }
}

/// What mortar needs of the surfaces: its integrals are taken in `f64`.
fn mortar_surfaces(task: &Task) -> Result<Surfaces, InputError> {
    if task.arithmetic.scalar == ScalarName::F64 {
        return Surfaces::new(task.sheet);
    }
    let what = format!("mortar coupling does not run in {}", task.arithmetic.scalar);
    Err(InputError::new("--scalar", what, "use f64, or --coupling nts"))
}

/// The equations that are restrained: those that S names, but under reading R2 = printed, where `Km` reads S, those that
/// `Km` takes for restrained.
fn held<T: Scalar>(sheet: &Worksheet<T>, variant: Variant, reading: &Reading) -> Vec<bool> {
    let by_km = variant == Variant::Printed && reading.r2 == RestraintIndex::Printed;
    let index = |e: usize| if by_km { 2 * (e / 2) + 2 } else { e + 1 };
    (0..2 * sheet.R()).map(|e| sheet.S[index(e)] == 1).collect()
}

/// Largest component of u_cont − u_targ over the nodes in contact, u_targ interpolated on the target edge.
fn eq1_residual<T: Scalar>(interpolations: &[Tie<T>], u: &DVector<T>) -> f64 {
    let component = |node: usize, direction: usize| u[2 * node - 2 + direction];
    let mut largest = T::zero();
    for tie in interpolations {
        for direction in [0, 1] {
            let target = sum(tie.weights.iter().map(|&(mate, k)| k * component(mate, direction)));
            largest = largest.max((component(tie.node, direction) - target).abs());
        }
    }
    largest.to_f64()
}
