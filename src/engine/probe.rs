//! The displacement, stress and strain at a point, each with what rounding and the mesh may do to
//! it.

use nalgebra::{DVector, SVector, Vector3};
use serde::{Deserialize, Serialize};

use super::contact::search::Segment;
use super::distance::finite;
use super::estimates::arithmetic::{bounded, stress_bounds, within};
use super::estimates::discretisation::{SAFETY, compliance, von_mises};
use super::estimates::{Cause, Dual, Estimates, Singular, StateFactors, singular};
use super::quantities::{Quantity, TriangleState, TriangleValues, Unit};
use super::solution::Solution;
use base::error::InputError;
use base::plain::six_digits;
use numbers::scalar::Bounded;
use problem::element::{self, Corners, State};
use problem::model::{Body, Model, TriangleId};

/// How far outside a triangle, over its size, a point is still of it: typed with eight digits.
const NEAR: f64 = 1e-8;

/// What a run says of a point of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    /// The point in the undeformed shape, length.
    pub at: [f64; 2],
    /// The body that has it.
    pub body: String,
    /// The number of the triangle whose values these are, from 1: its row of `EL`.
    pub triangle: usize,
    /// The triangles of the body that have the point too, where it is on an edge or a node.
    pub shared: Vec<usize>,
    /// Why no mesh bounds the stress here, within two rings of triangles about a point where it has
    /// no limit; nothing elsewhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_limit: Option<Cause>,
    /// The components of the displacement, then the quantities of the triangle.
    pub quantities: Vec<ProbeValue>,
}

/// A number at a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeValue {
    /// What it is: `u_x`, `sigma_x`, `epsilon_x`, ...
    pub name: String,
    /// What it is measured in.
    pub unit: Unit,
    /// The triangle's value: of a displacement linear, of a stress or strain the same everywhere.
    pub value: f64,
    /// The recovered value, which is continuous within a material and typically nearer to the
    /// truth; null for a displacement, and where nothing is recovered.
    pub recovered: Option<f64>,
    /// The estimated error of the mesh; null where it is not known.
    pub mesh: Option<f64>,
    /// The bound on the error of rounding; null where it is not known.
    pub arithmetic: Option<f64>,
}

/// Returns what there is to say of each of `points`: a probe of each body that has it.
///
/// # Errors
/// A point lies outside every body.
pub fn probes(
    solution: &Solution,
    estimates: &Estimates,
    points: &[[f64; 2]],
) -> Result<Vec<Probe>, InputError> {
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let model = &*solution.model;
    check_points(model, points)?;
    let stiffness = bounded(model);
    let bench = Bench {
        solution,
        estimates,
        dual: StateFactors::new(solution).map(|state| Dual::new(solution, state, &estimates.mesh)),
        singular: singular(solution),
        of_stress: stress_bounds(solution, &stiffness, estimates.errors.displacement_arithmetic),
        bounded: stiffness.stresses(&within(solution, estimates.errors.displacement_arithmetic)),
    };
    let bodies = |at| model.bodies.iter().map(move |body| (body, at));
    let places = points.iter().flat_map(|at| bodies(*at));
    Ok(places.filter_map(|(body, at)| bench.probe(body, at)).collect())
}

/// Checks that each of `points` lies in a body of the undeformed shape.
///
/// # Errors
/// Names a point that lies outside every body.
pub fn check_points(model: &Model, points: &[[f64; 2]]) -> Result<(), InputError> {
    let is_inside = |at: &[f64; 2]| model.triangle_ids().any(|id| has(model, id, *at));
    points.iter().find(|at| !is_inside(at)).map_or(Ok(()), |at| Err(outside(model, *at)))
}

/// Returns whether a triangle has a point.
fn has(model: &Model, id: TriangleId, at: [f64; 2]) -> bool {
    weights(&model.corners(id), at).iter().all(|weight| *weight >= -NEAR)
}

struct Bench<'a> {
    solution: &'a Solution,
    estimates: &'a Estimates,
    dual: Option<Dual<'a>>,
    singular: Vec<Singular>,
    /// What rounding may do to the von Mises stress of each triangle, stress.
    of_stress: Vec<f64>,
    /// The stresses of each triangle with what rounding may do to them, stress.
    bounded: Vec<SVector<Bounded, 3>>,
}

impl Bench<'_> {
    fn probe(&self, body: &Body, at: [f64; 2]) -> Option<Probe> {
        let model = &*self.solution.model;
        let mut triangles = body.triangles.iter().filter(|id| has(model, **id, at));
        let id = *triangles.next()?;
        let weights = weights(&model.corners(id), at);
        Some(Probe {
            at,
            body: body.name.clone(),
            triangle: id.number(),
            shared: triangles.map(|id| id.number()).collect(),
            no_limit: self.no_limit(id),
            quantities: [self.displacement(id, weights), self.triangle(id, weights)].concat(),
        })
    }

    fn no_limit(&self, id: TriangleId) -> Option<Cause> {
        let near = self.singular.iter().find(|point| point.triangles.contains(&id));
        near.map(|point| point.cause)
    }

    fn displacement(&self, id: TriangleId, weights: [f64; 3]) -> Vec<ProbeValue> {
        let (model, u) = (&*self.solution.model, &self.solution.u);
        let nodes = model.triangle(id).nodes;
        let component = |(d, name): (usize, &str)| {
            let (mut force, mut value) = (DVector::zeros(u.len()), 0.0);
            for (node, weight) in nodes.into_iter().zip(weights) {
                let dof = node.dofs()[d].index();
                force[dof] = weight;
                value += weight * u[dof];
            }
            ProbeValue {
                name: name.into(),
                unit: Unit::Length,
                value,
                recovered: None,
                mesh: self.dual.as_ref().and_then(|dual| finite(dual.error(&force))),
                arithmetic: self.estimates.errors.displacement_arithmetic,
            }
        };
        ["u_x", "u_y"].into_iter().enumerate().map(component).collect()
    }

    /// Returns the quantities of a triangle, component by component. A difference of stresses is
    /// estimated by its own value: each quantity is linear in stress, or a seminorm.
    fn triangle(&self, id: TriangleId, weights: [f64; 3]) -> Vec<ProbeValue> {
        let (model, k) = (&*self.solution.model, id.index());
        let state = &self.solution.elements[k];
        let corners = &self.estimates.mesh.recovered[k];
        let between = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let own = TriangleValues::new(&TriangleState::new(model, id, state, None));
        let bounds = self.rounding(id);
        let recovered = self.stressed(id, &between);
        let differences = corners.map(|corner| self.stressed(id, &(corner - state.sigma)));
        let is_recovered = self.estimates.mesh.stress_errors[k].is_finite();
        let is_bounded = is_recovered && self.no_limit(id).is_none();
        let quantity = |quantity: &Quantity<TriangleValues>| {
            let numbers = |of: &TriangleValues| (quantity.value)(of).numbers();
            let bounds = (quantity.value)(&bounds).components().unwrap_or_default();
            let (recovered, differences) =
                (numbers(&recovered), differences.each_ref().map(numbers));
            let component = |(c, (name, value)): (usize, (String, f64))| {
                let size = |of: &Option<Vec<f64>>| Some(of.as_ref()?[c].abs());
                let mesh = differences.iter().map(size).collect::<Option<Vec<_>>>();
                let mesh = mesh.map(|sizes| SAFETY * sizes.into_iter().fold(0.0, f64::max));
                ProbeValue {
                    name,
                    unit: quantity.unit,
                    value,
                    recovered: recovered.as_ref().map(|of| of[c]).filter(|_| is_recovered),
                    mesh: mesh.filter(|_| is_bounded),
                    arithmetic: finite(bounds[c]),
                }
            };
            let names = match quantity.symbols {
                [] | [_] => vec![quantity.title.to_string()],
                _ => quantity.components(),
            };
            let named = names.into_iter().zip(numbers(&own).unwrap_or_default()).enumerate();
            named.map(component).collect::<Vec<_>>()
        };
        TriangleValues::QUANTITIES.iter().flat_map(quantity).collect()
    }

    /// Returns the values of a triangle under a stress; its von Mises strain is not known.
    fn stressed(&self, id: TriangleId, stress: &Vector3<f64>) -> TriangleValues {
        let model = &*self.solution.model;
        let material = model.triangle(id).material;
        let state = State {
            sigma: *stress,
            epsilon: compliance(model.plane, material.nu) / material.e * stress,
            von_mises_stress: von_mises(model.plane, material.nu, stress),
            von_mises_strain: f64::NAN,
        };
        TriangleValues::new(&TriangleState::new(model, id, &state, None))
    }

    /// Returns what rounding may do to the values of a triangle; NaN where no bound is computed.
    fn rounding(&self, id: TriangleId) -> TriangleValues {
        let (model, k) = (&*self.solution.model, id.index());
        let material = model.triangle(id).material;
        let stress = Vector3::from_fn(|c, _| self.bounded[k][c].error());
        let compliance = compliance(model.plane, material.nu) / material.e;
        let [x, y, xy] = stress.into();
        let [e_x, e_y, g_xy] = (compliance.abs() * stress).into();
        TriangleValues::new(&TriangleState {
            sigma: [x, y, xy, element::out_of_plane_stress(model.plane, material.nu, &stress)],
            epsilon: [e_x, e_y, g_xy, f64::NAN],
            von_mises_stress: self.of_stress[k],
            von_mises_strain: f64::NAN,
            mesh_error: None,
        })
    }
}

/// Returns the parts of a triangle's area on the other side of `p` from each corner: all ≥ 0
/// inside.
fn weights(corners: &Corners<f64>, p: [f64; 2]) -> [f64; 3] {
    let whole = element::area(corners);
    std::array::from_fn(|k| {
        let mut part = *corners;
        part[k] = p;
        element::area(&part) / whole
    })
}

/// Says that a point lies outside every body, and which point of a body is nearest.
fn outside(model: &Model, p: [f64; 2]) -> InputError {
    let sides = model.triangle_ids().flat_map(|id| {
        let nodes = model.triangle(id).nodes;
        [0, 1, 2].map(|k| [nodes[k], nodes[(k + 1) % 3]])
    });
    let nearest = |side: [_; 2]| {
        let (body, [a, b]) = (model.body_of(side[0]), side.map(|node| model.coordinates(node)));
        let closest = Segment::new([a, b]).closest(p);
        let xi = closest.xi.clamp(0.0, 1.0);
        (closest.distance_square, [0, 1].map(|d| a[d] + xi * (b[d] - a[d])), body)
    };
    let outline = sides.filter(|side| model.sides.boundary(*side).is_some()).map(nearest);
    let (square, nearest, body) =
        outline.min_by(|a, b| a.0.total_cmp(&b.0)).expect("a body has an outline");
    let what = format!("the point {} lies outside every body", p.map(six_digits).join(","));
    let name = body.map_or("", |body| &body.name);
    let nearest = nearest.map(six_digits).join(",");
    let fix = format!(
        "give a point of the undeformed mesh; the nearest is {nearest} of body {name}, {:.3e} away",
        square.sqrt()
    );
    InputError::new("probe", what, fix)
}
