//! What rounding may do to the numbers of a run, by the sizes of what they are computed from.

use engine::contact::ContactNode;
use engine::estimates::arithmetic::stress_bounds;
use engine::{Solution, Stiffness};
use numbers::scalar::{Bounded, Scalar};
use problem::element;
use problem::model::{Model, TriangleId};

/// The relative effect of the roundings in a position, a pressure or an entry of a triangle's matrix.
pub const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// The sizes of which positions and distances are differences, length.
pub struct Scale {
    /// The largest coordinate.
    coordinate: f64,
    /// The largest displacement of a node in any iteration.
    displacement: f64,
    /// The shortest edge of the target; infinite where there is none.
    pub edge: f64,
}

impl Scale {
    /// Returns the sizes of a model whose nodes are displaced by at most `displacement`, length.
    pub fn new(model: &Model, displacement: f64) -> Self {
        let coordinate = model.nodes.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let length = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let lengths =
            model.target_edges().map(|edge| length(edge.nodes.map(|n| model.coordinates(n))));
        Scale { coordinate, displacement, edge: lengths.fold(f64::INFINITY, f64::min) }
    }

    /// Returns the least error of a displacement, length.
    pub fn displacement_error(&self) -> f64 {
        ROUNDED * self.displacement
    }

    /// Returns the error of a node's distance from its edge where displacements are known to `moved`.
    pub fn distance(&self, moved: f64) -> f64 {
        // The node and both ends of its edge are displaced by at most 1.5 errors each.
        6.0 * moved + ROUNDED * self.coordinate
    }
}

/// The largest error of any number of each array of a solution.
pub struct Errors {
    pub displacement: f64,
    pub stress: f64,
    pub von_mises: f64,
    pub strain: f64,
    pub force: f64,
    pub gap: f64,
    pub pressure: f64,
}

/// Returns what is left of errors of the displacements, of size `displacement`, in the other numbers of a solution.
pub fn errors(
    solution: &Solution,
    stiffness: &Stiffness<Bounded>,
    scale: &Scale,
    displacement: f64,
) -> Errors {
    let model = &*solution.model;
    let u = solution.u.map(|u| Bounded::new(u, displacement));
    let stresses = stiffness.stresses(&u);
    let force = stiffness.times(&u) - model.load_in(Bounded::from_f64);
    let force = force.iter().map(|f| f.error()).fold(0.0, f64::max);
    let von_mises = stress_bounds(solution, stiffness, Some(displacement));
    // A strain is at most the sum of the sizes of its components.
    let strain = |id: TriangleId| {
        let b = element::B(&model.corners(id)).abs().sum();
        b * (displacement + ROUNDED * solution.u.amax())
    };
    // The normal turns by at most the displacement of both ends over the length of the edge.
    let turned = 4.0 * displacement / scale.edge + ROUNDED;
    let pressure = |c: &ContactNode| {
        let (own, pressure) = (c.force?, c.pressure?);
        let per_force = if own == 0.0 { 0.0 } else { (pressure / own).abs() };
        Some(1.5 * force * per_force + turned * (pressure.abs() + c.shear.unwrap_or(0.0).abs()))
    };
    Errors {
        displacement,
        stress: stresses.iter().flat_map(|s| s.iter().map(|s| s.error())).fold(0.0, f64::max),
        von_mises: von_mises.into_iter().fold(0.0, f64::max),
        strain: model.triangle_ids().map(strain).fold(0.0, f64::max),
        force,
        gap: scale.distance(displacement),
        pressure: solution.contact.iter().filter_map(pressure).fold(0.0, f64::max),
    }
}
