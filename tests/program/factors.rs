//! What the plan says of the sparse factors, against numbers worked out by hand, and against what
//! the solver does.

use std::cell::Cell;

use plane_contact::engine::{Constraint, Elimination, Request, Stiffness, solve};
use plane_contact::numbers::solve::{Arithmetic, FactorSize, Field, Ldlt, Solver};
use plane_contact::problem::model::Model;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::studies::benchmark::{Annulus, Hertz};
use plane_contact::studies::plan::Plan;

fn planned(scene: &Scene, solver: Solver) -> FactorSize {
    let arithmetic = Arithmetic { solver: Some(solver), ..Arithmetic::default() };
    let request = Request::new(scene).variant(Variant::Tied).arithmetic(arithmetic);
    Plan::new(&request).expect("the scene is sound").factors
}

/// fig1 by hand, contact left out. Of the block, nodes 1 to 4 have two equations each, and three
/// sides between them: a chain. Of the stamp, 5 to 9 have two, 12 and 13 one, and eleven sides
/// between them: a strip of triangles. A node of two equations has 3 entries, one of one 1; a side
/// 4, 2 or 1. Eliminated from its ends neither fills anything in: columns of 4 and 3 three times,
/// then 2, 1; of 5 and 4 four times, then 4, 3, 2, 1.
#[test]
fn the_factors_of_fig1_are_those_worked_out_by_hand() {
    let fig1 = Scene::open("fig1").expect("embedded");
    let block = (4 * 3 + 3 * 4, 3 * (16 + 9) + 4 + 1);
    let stamp = (5 * 3 + 2 + 4 * 4 + 6 * 2 + 1, 4 * (25 + 16) + 16 + 9 + 4 + 1);
    let entries = block.0 + stamp.0;
    let operations = f64::from(block.1 + stamp.1);
    let by_hand = FactorSize { equations: 20, entries, nonzeros: entries, operations };
    assert_eq!(planned(&fig1, Solver::SparseCholesky), by_hand);
    let dense = |operations| FactorSize { entries: 210, nonzeros: 400, operations, ..by_hand };
    let twice = FactorSize { nonzeros: 2 * entries, operations: 2.0 * operations, ..by_hand };
    assert_eq!(by_hand.as_lu(), twice);
    assert_eq!(planned(&fig1, Solver::DenseLu), dense(16000.0 / 3.0));
}

thread_local! {
    /// How often the solver divided, and how often it subtracted a product.
    static COUNTS: Cell<[usize; 2]> = const { Cell::new([0; 2]) };
}

/// A number without a value that counts what is done with it, and never vanishes.
#[derive(Clone)]
struct Counting;

impl Field for Counting {
    const EPSILON: f64 = 0.0;

    fn zero() -> Self {
        Counting
    }
    fn size(&self) -> f64 {
        1.0
    }
    fn vanishes(&self) -> bool {
        false
    }
    fn over(&self, _: &Self) -> Self {
        COUNTS.set([COUNTS.get()[0] + 1, COUNTS.get()[1]]);
        Counting
    }
    fn subtract_product(&mut self, _: &Self, _: &Self) {
        COUNTS.set([COUNTS.get()[0], COUNTS.get()[1] + 1]);
    }
}

/// What the sparse solver does with the matrix under `constraints`. Of a column of L with c entries
/// it divides c − 1, and subtracts c (c − 1) / 2 products from what is left of the matrix; with the
/// pivot that is (c − 1) + 2 · c (c − 1) / 2 + 1 = c² operations.
fn factored(model: &Model, constraints: &[Constraint]) -> FactorSize {
    let t = Elimination::new(&model.restrained, constraints);
    let matrix = Stiffness::new(model, |x| x).reduced(&t);
    COUNTS.set([0; 2]);
    assert!(Ldlt::new(&matrix.map(|_| Counting)).is_ok());
    let (equations, [divided, subtracted]) = (matrix.size(), COUNTS.get());
    FactorSize {
        equations,
        entries: matrix.entries().count(),
        nonzeros: equations + divided,
        operations: (2 * subtracted + divided + equations) as f64,
    }
}

/// The second of Hertz's contacts has so many equations that those of a node are ordered together.
#[test]
fn what_is_predicted_is_what_the_solver_factors() {
    let fine = Hertz { size: 36, ..Hertz::default() };
    let generated =
        [Annulus { radial: 6, around: 6 }.generate(), Hertz::default().generate(), fine.generate()];
    let embedded = ["fig1", "two-blocks", "strand"].map(Scene::open);
    let generated = generated.map(|benchmark| benchmark.and_then(|b| b.build()));
    for scene in generated.into_iter().chain(embedded) {
        let scene = scene.expect("a sound scene");
        let planned = planned(&scene, Solver::SparseCholesky);
        assert_eq!(planned, factored(&scene.model, &[]), "{}", scene.name);
    }
}

/// In contact at the end: of fig1 nodes 5, 6, 7 and 9, two equations each; of two-blocks 10 and 12,
/// held in x, and 11.
#[test]
fn a_node_in_contact_takes_its_own_equations_out() {
    for (name, taken) in [("fig1", 8), ("two-blocks", 4)] {
        let scene = Scene::open(name).expect("embedded");
        let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
        let run = factored(&solution.model, &solution.last().constraints);
        let planned = planned(&scene, Solver::SparseCholesky);
        assert_eq!(planned.equations - run.equations, taken, "{name}");
    }
}
