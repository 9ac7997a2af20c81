//! The discretisation error bar against fields that are known exactly.

mod common;
#[path = "discretisation/fields.rs"]
mod fields;
#[path = "discretisation/meshes.rs"]
mod meshes;

use fields::{CANTILEVER, CONSTANT, Field, KIRSCH, LAME, LINEAR, Stress};
use meshes::{Cut, Grid, annulus, beam, holed_plate, rectangle};
use nalgebra::Vector2;
use plane_contact::contact::{Outcome, Variant, run};
use plane_contact::error_bars::discretisation::Discretisation;
use plane_contact::mirror::Reading;

struct Benchmark {
    name: &'static str,
    field: &'static Field,
    map: fn([f64; 2]) -> [f64; 2],
    cells: [[usize; 2]; 3],
}

const BENCHMARKS: [Benchmark; 4] = [
    Benchmark { name: "Lame", field: &LAME, map: annulus, cells: [[5, 8], [10, 16], [20, 32]] },
    Benchmark { name: "cantilever", field: &CANTILEVER, map: beam, cells: [[16, 4], [32, 8], [60, 10]] },
    Benchmark { name: "linear", field: &LINEAR, map: rectangle, cells: [[6, 4], [14, 7], [32, 16]] },
    Benchmark { name: "Kirsch", field: &KIRSCH, map: holed_plate, cells: [[8, 8], [16, 16], [26, 26]] },
];

const THICKNESS: f64 = 2.5;

fn solve(grid: &Grid, field: &Field) -> Outcome {
    let scene = grid.scene(field, THICKNESS);
    run(&scene, Variant::Tied, &Reading::default(), |_| ()).expect("it solves")
}

/// The true error in the energy norm, by quadrature over 16 parts of each triangle.
fn true_error(grid: &Grid, field: &Field, outcome: &Outcome) -> f64 {
    let points = grid.points();
    let of_triangle = |(t, state): (&[usize; 3], &plane_contact::element::State)| {
        let p = t.map(|n| Vector2::from(points[n]));
        let density = |x: Vector2<f64>| {
            field.energy_density(&((field.stress)([x.x, x.y]) - state.sigma))
        };
        let area = (p[1] - p[0]).perp(&(p[2] - p[0])) / 2.0;
        parts(p, 2).iter().map(|q| {
            let mids = [0, 1, 2].map(|k| density((q[k] + q[(k + 1) % 3]) / 2.0));
            area / 16.0 * mids.iter().sum::<f64>() / 3.0
        }).sum::<f64>()
    };
    (THICKNESS * grid.triangles().iter().zip(&outcome.elements).map(of_triangle).sum::<f64>()).sqrt()
}

/// A triangle in four by its midpoints, `depth` times.
fn parts(p: [Vector2<f64>; 3], depth: usize) -> Vec<[Vector2<f64>; 3]> {
    if depth == 0 {
        return vec![p];
    }
    let m = [0, 1, 2].map(|k| (p[k] + p[(k + 1) % 3]) / 2.0);
    let four = [[p[0], m[0], m[2]], [m[0], p[1], m[1]], [m[2], m[1], p[2]], m];
    four.into_iter().flat_map(|q| parts(q, depth - 1)).collect()
}

#[test]
fn explore() {
    for b in &BENCHMARKS {
        for cells in b.cells {
            for (cut, distortion) in [(Cut::Same, 0.0), (Cut::Same, 0.15), (Cut::Alternating, 0.0), (Cut::Alternating, 0.15), (Cut::Same, 0.25)] {
                let grid = Grid { cells, map: b.map, cut, distortion };
                let outcome = solve(&grid, b.field);
                let d = Discretisation::new(&outcome.sheet, &outcome.elements);
                let truth = true_error(&grid, b.field, &outcome);
                let vm = |s: &Stress| b.field.von_mises(s);
                let value = outcome.elements.iter().map(|s| s.von_mises_stress).fold(0.0, f64::max);
                let at = outcome.elements.iter().position(|s| s.von_mises_stress == value).unwrap();
                let exact = b.field.largest_von_mises();
                let smooth = d.recovered.iter().flatten().map(&vm).fold(0.0, f64::max);
                let diff = |t: usize| d.recovered[t].iter().map(|s| vm(&(s - outcome.elements[t].sigma))).fold(0.0, f64::max);
                let c2 = (0..d.recovered.len()).map(|t| outcome.elements[t].von_mises_stress + diff(t)).fold(0.0, f64::max) - value;
                let e = (exact - value).abs();
                println!("{:10} {:?} {:?} {:4} rel {:.3} theta {:.3} | max {:.3} exact {:.3} smooth {:.3} err {:.1}% | c1 {:.2} c2 {:.2} c3 {:.2}",
                    b.name, cells, cut, distortion, d.relative(), d.total() / truth, value, exact, smooth, 100.0*(exact-value)/exact,
                    (smooth - value)/e, c2/e, diff(at)/e);
            }
        }
    }
}
