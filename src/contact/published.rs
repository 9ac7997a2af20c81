//! The iterations that the paper describes (`READING.md` section 6): `printed`, `tied`, `stepped`.
//!
//! - total load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·U = F; node_n = node + U.
//! - stepped load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·dU = F/n; U = U + dU; node_n = node + U.
//!
//! A(c) is Km(c) under `printed`, else Tᵀ·K·T on the free equations, K being Km without contact and without restraints.

use std::collections::HashMap;

use nalgebra::DVector;

use super::elimination::{Elimination, Tie, interpolations, ties};
use super::pairing::{Coupling, Surfaces};
use super::pressure::{ContactNode, contact_nodes};
use super::run::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, shape, states};
use super::stiffness::Stiffness;
use super::support::{against_load, support};
use super::variant::Variant;
use crate::error::{Error, InputError, SingularMatrix};
use crate::mathcad::array::Table;
use crate::mirror::{Km, NodeTable, Pairs, Reading, RestraintIndex, Schedule, Worksheet, c_cnt};
use crate::scene::Scene;
use crate::solve::{DenseLu, memory};

/// The iterations that the paper describes.
///
/// # Errors
/// The published algorithm failing as printed, a matrix that cannot be solved, a dense matrix that does not fit.
pub(super) fn published(
    scene: &Scene,
    sheet: Worksheet<f64>,
    variant: Variant,
    reading: &Reading,
    mut watch: impl FnMut(&Iteration),
) -> Result<Outcome, Error> {
    memory::check(sheet.R(), memory::OF_A_SOLUTION, memory::free())?;
    let mut run = Run::new(scene, &sheet, variant, reading)?;
    let mut iterations: Vec<Iteration> = Vec::new();
    for k in 1..=scene.iterations {
        let iteration = run.iterate(k)?;
        watch(&iteration);
        iterations.push(iteration);
    }
    let last = iterations.last().expect("a scene has an iteration");
    let contact = run.contact(&last.pairs)?;
    let (schedule, u, factored) = (run.schedule, run.u, run.met.len());
    let elements = states(&sheet, &u);
    let reading = *reading;
    Ok(Outcome { variant, schedule, reading, sheet, iterations, u, elements, contact, factored })
}

/// What an iteration needs of those before it.
struct Run<'a> {
    scene: &'a Scene,
    sheet: &'a Worksheet<f64>,
    variant: Variant,
    reading: &'a Reading,
    schedule: Schedule,
    /// `Km` without contact and without restraints.
    k: Table<f64>,
    /// The same by triangles, for forces.
    stiffness: Stiffness,
    /// The restrained equations.
    held: Vec<bool>,
    /// What mortar needs of the surfaces; nothing under `nts`.
    surfaces: Option<Surfaces>,
    /// The load that one iteration carries, 0 at restrained equations.
    f: DVector<f64>,
    /// The whole load over the load of one iteration.
    share: f64,
    /// Total displacements.
    u: DVector<f64>,
    /// What supports the target so far.
    support: [f64; 2],
    /// Contact states met, each with its solution and the last iteration that met it. The load of an iteration is always
    /// the same, so a state that came before has the same matrix and the same solution: nothing is factored again.
    met: HashMap<Vec<u64>, Met>,
}

struct Met {
    k: usize,
    solution: Solution,
}

/// The displacements of an iteration's own load.
#[derive(Clone)]
struct Solution {
    u: DVector<f64>,
    residual: f64,
    /// What supports the target.
    support: [f64; 2],
}

impl<'a> Run<'a> {
    fn new(
        scene: &'a Scene,
        sheet: &'a Worksheet<f64>,
        variant: Variant,
        reading: &'a Reading,
    ) -> Result<Self, Error> {
        let schedule = variant.schedule(reading);
        let share = match schedule {
            Schedule::Total => 1.0,
            Schedule::Stepped => scene.iterations as f64,
        };
        let equations = 2 * sheet.R();
        let held = held(sheet, variant, reading);
        let f =
            DVector::from_fn(equations, |e, _| if held[e] { 0.0 } else { scene.load[e] / share });
        let mortar = scene.contact.coupling == Coupling::Mortar && variant != Variant::Printed;
        let surfaces = if mortar { Some(Surfaces::new(sheet)?) } else { None };
        Ok(Run {
            scene,
            sheet,
            variant,
            reading,
            schedule,
            k: free_stiffness(sheet, reading)?,
            stiffness: Stiffness::new(sheet),
            held,
            surfaces,
            f,
            share,
            u: DVector::zeros(equations),
            support: [0.0, 0.0],
            met: HashMap::new(),
        })
    }

    fn iterate(&mut self, k: usize) -> Result<Iteration, Error> {
        let node_n = shape(self.sheet, &self.u);
        let pairs = if self.sheet.cnt.rows() == 0 {
            // Without contact nothing of contact is built: `c_cnt` is not called.
            Pairs::none(self.sheet.R())
        } else {
            c_cnt(self.sheet, self.reading, &node_n)?
        };
        let ties = self.ties(&pairs, &node_n);
        let key = state(&pairs, &ties);
        let (cycle, solution) = match self.met.get(&key) {
            Some(met) => {
                let cycle = Cycle { length: k - met.k, members: (met.k..k).collect() };
                (Some(cycle), met.solution.clone())
            }
            None => (None, self.solve(&pairs, &ties, k)?),
        };
        self.advance(&solution);
        let iteration = self.report(k, node_n, pairs, cycle, &solution);
        self.met.insert(key, Met { k, solution });
        Ok(iteration)
    }

    /// From one shape to the next.
    fn advance(&mut self, solution: &Solution) {
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
        node_n: Table<f64>,
        pairs: Pairs<f64>,
        cycle: Option<Cycle>,
        solution: &Solution,
    ) -> Iteration {
        let interpolations = match &self.surfaces {
            Some(_) => self.ties(&pairs, &node_n),
            None => interpolations(self.sheet, &pairs, self.weights_from(&node_n)),
        };
        Iteration {
            k,
            in_contact: pairs.dy.iter().sum(),
            max_displacement: max_displacement(&self.u),
            cycle,
            eq1_residual: eq1_residual(&interpolations, &self.u),
            eq1_residual_step: eq1_residual(&interpolations, &solution.u),
            target_force: against_load(self.scene, self.support),
            solve_residual: solution.residual,
            node_n,
            pairs,
        }
    }

    /// The shape that weights come from (R5).
    fn weights_from<'b>(&'b self, node_n: &'b Table<f64>) -> &'b Table<f64> {
        match self.reading.r5 {
            NodeTable::Node => &self.sheet.node,
            NodeTable::NodeN => node_n,
        }
    }

    /// Eq. (1) for the nodes in contact: the weights of k_cnt, or mortar's for the nodes whose edges cover the target.
    fn ties(&self, pairs: &Pairs<f64>, node_n: &Table<f64>) -> Vec<Tie> {
        let mut ties = ties(self.sheet, pairs);
        let Some(surfaces) = &self.surfaces else { return ties };
        let pairings = surfaces.pairings(Coupling::Mortar, self.weights_from(node_n));
        for pairing in pairings.into_iter().flatten() {
            for tie in ties.iter_mut().filter(|tie| tie.node == pairing.node) {
                tie.weights.clone_from(&pairing.weights);
            }
        }
        ties
    }

    /// Solves A(c)·u = f.
    fn solve(&self, pairs: &Pairs<f64>, ties: &[Tie], k: usize) -> Result<Solution, Error> {
        let singular =
            |equation: usize, pivot: f64| self.singular_matrix(pairs, k, equation, pivot);
        if self.variant == Variant::Printed {
            let matrix = Km(self.sheet, self.reading, &pairs.k_cnt)?.into_matrix();
            let lu = DenseLu::new(matrix).map_err(|s| singular(s.column, s.pivot))?;
            let u = lu.solve(&self.f);
            return Ok(self.solution(lu.residual(&u, &self.f), u, &[]));
        }
        let t = Elimination::new(self.sheet, ties);
        let lu = DenseLu::new(t.matrix(self.k.as_matrix()))
            .map_err(|s| singular(t.equation(s.column), s.pivot))?;
        let f = t.load(&self.f);
        let q = lu.solve(&f);
        Ok(self.solution(lu.residual(&q, &f), t.expand(&q), ties))
    }

    fn solution(&self, residual: f64, u: DVector<f64>, ties: &[Tie]) -> Solution {
        let force = self.stiffness.times(&u) - &self.scene.load / self.share;
        Solution { residual, support: support(self.scene, &self.held, ties, &force), u }
    }

    /// The contact surface at the end.
    fn contact(&self, last: &Pairs<f64>) -> Result<Vec<ContactNode>, InputError> {
        if self.sheet.cnt.rows() == 0 {
            return Ok(Vec::new());
        }
        let surfaces = Surfaces::new(self.sheet)?;
        let pairings = surfaces.pairings(Coupling::Nts, &shape(self.sheet, &self.u));
        let force = self.stiffness.times(&self.u) - &self.scene.load;
        Ok(contact_nodes(self.sheet, self.scene.thickness, &pairings, last.dy.as_slice(), &force))
    }

    fn singular_matrix(
        &self,
        pairs: &Pairs<f64>,
        iteration: usize,
        equation: usize,
        pivot: f64,
    ) -> SingularMatrix {
        let node = equation / 2 + 1;
        let body = self.scene.body_of(node);
        SingularMatrix {
            variant: self.variant.name(),
            iteration,
            node,
            direction: ['x', 'y'][equation % 2],
            pivot,
            in_contact: pairs.dy.iter().sum(),
            body: body.map_or(String::new(), |b| format!(" of body {:?}", b.name)),
        }
    }
}

/// What decides an iteration's matrix: all of k_cnt, and the weights of the ties.
fn state(pairs: &Pairs<f64>, ties: &[Tie]) -> Vec<u64> {
    let weights = ties.iter().flat_map(|tie| &tie.weights);
    let weights = weights.flat_map(|(mate, w)| [*mate as u64, w.to_bits()]);
    pairs.k_cnt.as_matrix().iter().map(|x| x.to_bits()).chain(weights).collect()
}

/// The equations that are restrained: those that S names, but under reading R2 = printed, where `Km` reads S, those that
/// `Km` takes for restrained.
fn held(sheet: &Worksheet<f64>, variant: Variant, reading: &Reading) -> Vec<bool> {
    let by_km = variant == Variant::Printed && reading.r2 == RestraintIndex::Printed;
    let index = |e: usize| if by_km { 2 * (e / 2) + 2 } else { e + 1 };
    (0..2 * sheet.R()).map(|e| sheet.S[index(e)] == 1).collect()
}

/// Largest component of u_cont − u_targ over the nodes in contact, u_targ interpolated on the target edge.
fn eq1_residual(interpolations: &[Tie], u: &DVector<f64>) -> f64 {
    let component = |node: usize, direction: usize| u[2 * node - 2 + direction];
    let mut largest = 0.0_f64;
    for tie in interpolations {
        for direction in [0, 1] {
            let target: f64 =
                tie.weights.iter().map(|&(mate, k)| k * component(mate, direction)).sum();
            largest = largest.max((component(tie.node, direction) - target).abs());
        }
    }
    largest
}
