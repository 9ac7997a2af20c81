//! The iterations of a variant (`READING.md` section 6).
//!
//! - total load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·U = F; node_n = node + U.
//! - stepped load, for k = 1 .. n: c = c_cnt(node_n); solve A(c)·dU = F/n; U = U + dU; node_n = node + U.
//!
//! A(c) is Km(c) under the printed coupling, else Tᵀ·K·T on the free equations, K being Km without contact and without
//! restraints.

use std::collections::HashMap;

use nalgebra::{DVector, SVector};
use serde::Serialize;

use super::elimination::{Elimination, Tie, interpolations, ties};
use super::status::{self, StatusRule};
use super::variant::{Coupling, Variant};
use crate::element::State;
use crate::error::{Error, InputError, SingularMatrix};
use crate::mathcad::array::{Column, Table};
use crate::mirror::{Failure, Km, NodeTable, Pairs, Reading, RestraintIndex, Schedule, Worksheet};
use crate::scene::Scene;
use crate::solve::{DenseLu, memory};

/// One iteration.
#[derive(Clone, Debug)]
pub struct Iteration {
    /// Its number, from 1.
    pub k: usize,
    /// The shape that the iteration started from: R x 4, as `node`.
    pub node_n: Table<f64>,
    /// What `c_cnt` found in it.
    pub pairs: Pairs<f64>,
    /// Number of contact nodes with dy = 1.
    pub in_contact: usize,
    /// Largest |u| of a node, total, length.
    pub max_displacement: f64,
    /// Where this contact state (all of k_cnt) was met before.
    pub cycle: Option<Cycle>,
    /// Eq. (1): largest |u_cont − u_targ|, |v_cont − v_targ| over nodes in contact, total displacements, length.
    pub eq1_residual: f64,
    /// The same on what this iteration solved for: the increment where the load is stepped.
    pub eq1_residual_step: f64,
    /// Sum of the reactions of the target body against the direction of the load applied so far, force; 0 without contact.
    pub target_force: f64,
    /// Relative residual |A x − b| / (|A| |x| + |b|) of the solution.
    pub solve_residual: f64,
}

/// A contact state that came before.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cycle {
    /// Iterations since the state was last met; 1 = it did not change.
    pub length: usize,
    /// Those iterations: the last that had this state, and those between.
    pub members: Vec<usize>,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What was run.
    pub variant: Variant,
    /// What an iteration carried.
    pub schedule: Schedule,
    /// The reading.
    pub reading: Reading,
    /// The paper's arrays.
    pub sheet: Worksheet<f64>,
    /// The iterations.
    pub iterations: Vec<Iteration>,
    /// Displacements of the 2R equations, length.
    pub u: DVector<f64>,
    /// Stresses and strains, by row of `EL`.
    pub elements: Vec<State>,
    /// Number of matrices factored: one for each contact state.
    pub factored: usize,
}

/// Runs `variant` on `scene`; `watch` is called after each iteration.
///
/// # Errors
/// The published algorithm failing as printed, a matrix that cannot be solved, a dense matrix that does not fit.
pub fn run(
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    watch: impl FnMut(&Iteration),
) -> Result<Outcome, Error> {
    run_by(StatusRule::Signs, scene, variant, reading, watch)
}

/// As [`run`], the status of contact nodes decided by `rule`.
///
/// # Errors
/// As those of [`run`].
pub fn run_by(
    rule: StatusRule,
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    mut watch: impl FnMut(&Iteration),
) -> Result<Outcome, Error> {
    let sheet = scene.worksheet(reading)?;
    memory::check(sheet.R(), memory::OF_A_SOLUTION, memory::free())?;
    let schedule = variant.schedule(reading);
    let mut run = Run { rule, ..Run::new(scene, &sheet, variant, reading, schedule)? };
    let mut iterations: Vec<Iteration> = Vec::new();
    for k in 1..=scene.iterations {
        let iteration = run.iterate(k)?;
        watch(&iteration);
        iterations.push(iteration);
    }
    let (u, factored) = (run.u, run.met.len());
    let elements = states(&sheet, &u);
    check_finite(&iterations, &u, &elements)?;
    Ok(Outcome { variant, schedule, reading: *reading, sheet, iterations, u, elements, factored })
}

/// What an iteration needs of those before it.
struct Run<'a> {
    scene: &'a Scene,
    sheet: &'a Worksheet<f64>,
    variant: Variant,
    rule: StatusRule,
    reading: &'a Reading,
    schedule: Schedule,
    /// `Km` without contact and without restraints.
    k: Table<f64>,
    /// The restrained equations.
    held: Vec<bool>,
    /// The load that one iteration carries, 0 at restrained equations.
    f: DVector<f64>,
    /// The whole load over the load of one iteration.
    share: f64,
    /// Total displacements.
    u: DVector<f64>,
    /// Sum of the target body's reactions so far.
    reaction: [f64; 2],
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
    /// Sum of the target body's reactions.
    reaction: [f64; 2],
}

impl<'a> Run<'a> {
    fn new(
        scene: &'a Scene,
        sheet: &'a Worksheet<f64>,
        variant: Variant,
        reading: &'a Reading,
        schedule: Schedule,
    ) -> Result<Self, Error> {
        let share = match schedule {
            Schedule::Total => 1.0,
            Schedule::Stepped => scene.iterations as f64,
        };
        let equations = 2 * sheet.R();
        let held = held(sheet, variant, reading);
        let f =
            DVector::from_fn(equations, |e, _| if held[e] { 0.0 } else { scene.load[e] / share });
        let (k, u) = (free_stiffness(sheet, reading)?, DVector::zeros(equations));
        Ok(Run {
            scene,
            sheet,
            variant,
            rule: StatusRule::Signs,
            reading,
            schedule,
            k,
            held,
            f,
            share,
            u,
            reaction: [0.0, 0.0],
            met: HashMap::new(),
        })
    }

    fn iterate(&mut self, k: usize) -> Result<Iteration, Error> {
        let node_n = shape(self.sheet, &self.u);
        let pairs = if self.sheet.cnt.rows() == 0 {
            // Without contact nothing of contact is built: `c_cnt` is not called.
            Pairs::none(self.sheet.R())
        } else {
            status::pairs(self.rule, self.sheet, self.reading, &node_n)?
        };
        let key: Vec<u64> = pairs.k_cnt.as_matrix().iter().map(|x| x.to_bits()).collect();
        let (cycle, solution) = match self.met.get(&key) {
            Some(met) => {
                let cycle = Cycle { length: k - met.k, members: (met.k..k).collect() };
                (Some(cycle), met.solution.clone())
            }
            None => (None, self.solve(&pairs, k)?),
        };
        self.advance(&solution);
        let iteration = self.report(k, node_n, pairs, cycle, &solution);
        self.met.insert(key, Met { k, solution });
        Ok(iteration)
    }

    /// From one shape to the next.
    fn advance(&mut self, solution: &Solution) {
        match self.schedule {
            Schedule::Total => (self.u, self.reaction) = (solution.u.clone(), solution.reaction),
            Schedule::Stepped => {
                self.u += &solution.u;
                self.reaction = [0, 1].map(|d| self.reaction[d] + solution.reaction[d]);
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
        let weights_from = match self.reading.r5 {
            NodeTable::Node => &self.sheet.node,
            NodeTable::NodeN => &node_n,
        };
        let interpolations = interpolations(self.sheet, &pairs, weights_from);
        Iteration {
            k,
            in_contact: pairs.dy.iter().sum(),
            max_displacement: max_displacement(&self.u),
            cycle,
            eq1_residual: eq1_residual(&interpolations, &self.u),
            eq1_residual_step: eq1_residual(&interpolations, &solution.u),
            target_force: self.target_force(),
            solve_residual: solution.residual,
            node_n,
            pairs,
        }
    }

    /// Solves A(c)·u = f.
    fn solve(&self, pairs: &Pairs<f64>, k: usize) -> Result<Solution, Error> {
        let singular =
            |equation: usize, pivot: f64| self.singular_matrix(pairs, k, equation, pivot);
        let (residual, u) = match self.variant.coupling() {
            Coupling::Printed => {
                let matrix = Km(self.sheet, self.reading, &pairs.k_cnt)?.into_matrix();
                let lu = DenseLu::new(matrix).map_err(|s| singular(s.column, s.pivot))?;
                let u = lu.solve(&self.f);
                (lu.residual(&u, &self.f), u)
            }
            Coupling::Eliminated => {
                let t = Elimination::new(self.sheet, pairs);
                let lu = DenseLu::new(t.matrix(self.k.as_matrix()))
                    .map_err(|s| singular(t.equation(s.column), s.pivot))?;
                let f = t.load(&self.f);
                let u = lu.solve(&f);
                (lu.residual(&u, &f), t.expand(&u))
            }
        };
        Ok(Solution { residual, reaction: self.target_reaction(pairs, &u), u })
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

    /// Sum of the target body's reactions to an iteration's own load: K·u − F at its restrained equations, and what ties pass
    /// straight to them.
    fn target_reaction(&self, pairs: &Pairs<f64>, u: &DVector<f64>) -> [f64; 2] {
        let Some(target) = self.scene.target() else { return [0.0, 0.0] };
        let unbalanced = self.k.as_matrix() * u - &self.scene.load / self.share;
        let mut reaction = [0.0, 0.0];
        for e in target.nodes.iter().flat_map(|n| [2 * n - 2, 2 * n - 1]).filter(|&e| self.held[e])
        {
            reaction[e % 2] += unbalanced[e];
        }
        if self.variant.coupling() == Coupling::Printed {
            return reaction;
        }
        for tie in ties(self.sheet, pairs) {
            for direction in [0, 1].into_iter().filter(|d| !self.held[2 * tie.node - 2 + d]) {
                let held =
                    tie.weights.iter().filter(|(mate, _)| self.held[2 * mate - 2 + direction]);
                let passed: f64 = held.map(|(_, k)| k).sum();
                reaction[direction] += passed * unbalanced[2 * tie.node - 2 + direction];
            }
        }
        reaction
    }

    /// The target body's reactions so far, taken against the direction of the load.
    fn target_force(&self) -> f64 {
        let [fx, fy] = self.scene.total_load();
        let ([rx, ry], size) = (self.reaction, fx.hypot(fy));
        if size == 0.0 {
            return rx.hypot(ry);
        }
        // 0 − x rather than −x: no reaction at all is 0, not −0.
        0.0 - (rx * (fx / size) + ry * (fy / size))
    }
}

/// `Km` without contact and without restraints: 2R x 2R, force/length.
///
/// # Errors
/// An overflow.
pub fn free_stiffness(sheet: &Worksheet<f64>, reading: &Reading) -> Result<Table<f64>, Failure> {
    let free = Worksheet { S: Column::filled(2 * sheet.R(), 0), ..sheet.clone() };
    Km(&free, reading, &Table::filled(sheet.R(), 4, 0.0))
}

/// node_n = node + U: R x 4, length.
pub fn shape(sheet: &Worksheet<f64>, u: &DVector<f64>) -> Table<f64> {
    let mut node_n = sheet.node.clone();
    for n in 1..=sheet.R() {
        node_n[(n, 2)] += u[2 * n - 2];
        node_n[(n, 3)] += u[2 * n - 1];
    }
    node_n
}

/// Largest |u| of a node.
pub fn max_displacement(u: &DVector<f64>) -> f64 {
    u.as_slice().chunks(2).map(|u| u[0].hypot(u[1])).fold(0.0, f64::max)
}

/// The equations that are restrained: those that S names, but under reading R2 = printed, where `Km` reads S, those that
/// `Km` takes for restrained.
fn held(sheet: &Worksheet<f64>, variant: Variant, reading: &Reading) -> Vec<bool> {
    let by_km = variant.coupling() == Coupling::Printed && reading.r2 == RestraintIndex::Printed;
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

/// Stresses and strains of every triangle.
fn states(sheet: &Worksheet<f64>, u: &DVector<f64>) -> Vec<State> {
    (1..=sheet.M())
        .map(|n| {
            let of_element = SVector::<f64, 6>::from_fn(|k, _| {
                u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2]
            });
            State::new(sheet.plane, sheet.E[n], sheet.nu[n], &sheet.B[n], &of_element)
        })
        .collect()
}

/// That every displacement, stress and strain can be represented.
fn check_finite(
    iterations: &[Iteration],
    u: &DVector<f64>,
    elements: &[State],
) -> Result<(), InputError> {
    let of_element = |s: &State| (s.von_mises_stress + s.von_mises_strain).is_finite();
    let of_iteration = |it: &Iteration| {
        (it.max_displacement + it.eq1_residual + it.target_force + it.solve_residual).is_finite()
    };
    if u.iter().all(|x| x.is_finite())
        && elements.iter().all(of_element)
        && iterations.iter().all(of_iteration)
    {
        return Ok(());
    }
    let what = "the displacements or stresses are too large to represent";
    Err(InputError::new("loads, materials, mesh", what, "choose other units"))
}
