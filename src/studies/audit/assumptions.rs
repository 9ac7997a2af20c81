//! What the paper does not give, and what a scene has in its place.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::range::is_example;
use base::plain::six_digits;
use problem::model::{Model, NodeId};
use problem::scene::Scene;

/// A thing that the paper leaves open.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assumption {
    /// What is assumed.
    pub what: &'static str,
    /// What the scene has.
    pub set_to: String,
}

impl Display for Assumption {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}", self.what, self.set_to)
    }
}

/// What a scene assumes; nothing without contact.
pub fn assumptions(scene: &Scene) -> Vec<Assumption> {
    let model = &*scene.model;
    let (contact, target): (&[NodeId], Vec<NodeId>) =
        (&model.contact.nodes, model.target_edges().flat_map(|edge| edge.nodes).collect());
    let Some(stamp) = contact.first().and_then(|node| model.body_of(*node)) else {
        return Vec::new();
    };
    let unit = &scene.units.length;
    let [width, height] = across(model, &stamp.nodes);
    let restrained =
        |axis: usize| stamp.nodes.iter().filter(|node| model.restraints_of(**node)[axis]).count();
    let [nodes, triangles] = [model.nodes.len(), model.triangles.len()];
    let edges = model.contact.target.len();
    let mesh = format!("{nodes} nodes, {triangles} triangles, {edges} target edges");
    let assumed = |what, set_to: String| Assumption { what, set_to: set_to.trim_end().into() };
    // The parts of the paper's example have names of their own.
    let [of_target, of_contact, shape, axis] = match is_example(scene) {
        true => [
            "radius of the duct (half the width of the target surface)",
            "radius of the strand (half the width of the contact surface)",
            "shape of the stamp (width x height)",
            "restraint of the stamp's axis",
        ],
        false => [
            "half the width of the target surface",
            "half the width of the contact surface",
            "contact body (width x height)",
            "restraint of the contact body",
        ],
    };
    vec![
        assumed(of_target, format!("{} {unit}", six_digits(across(model, &target)[0] / 2.0))),
        assumed(of_contact, format!("{} {unit}", six_digits(across(model, contact)[0] / 2.0))),
        assumed("mesh", mesh),
        assumed(shape, format!("{} x {} {unit}", six_digits(width), six_digits(height))),
        assumed("plane problem", format!("plane {}", model.plane)),
        assumed(axis, format!("{} nodes in x, {} in y", restrained(0), restrained(1))),
        assumed("unit of c_tol", format!("{} {unit}", model.contact.tolerance)),
    ]
}

/// The relative radius of duct and strand in the paper's example, length: both arcs are half circles or more.
pub fn relative_radius(scene: &Scene) -> Option<f64> {
    let target: Vec<NodeId> = scene.model.target_edges().flat_map(|edge| edge.nodes).collect();
    let [duct, strand] =
        [&target, &scene.model.contact.nodes].map(|nodes| across(&scene.model, nodes)[0] / 2.0);
    is_example(scene).then(|| duct * strand / (duct - strand))
}

/// Width and height of a set of nodes, length.
fn across(model: &Model, nodes: &[NodeId]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let places = nodes.iter().map(|node| model.coordinates(*node)[axis]);
        places.clone().fold(f64::MIN, f64::max) - places.fold(f64::MAX, f64::min)
    })
}
