//! A field of displacements beside the reference solution: their distance, and what both imply of contact.

use nalgebra::DVector;
use serde::Serialize;

use base::error::Result;
use engine::contact::{ContactNode, ROUNDING_OF_A_FORCE};
use engine::{
    Distance, Implied, Resultant, Solution, distance, implied, max_displacement, over, resultant,
    resultant_of_field,
};
use problem::model::NodeId;

/// A field beside the reference solution.
#[derive(Serialize)]
pub struct Beside<'a> {
    /// What is compared with.
    #[serde(skip)]
    pub reference: &'a Solution,
    /// The field, and all that follows from it on the mesh.
    #[serde(skip)]
    pub field: Solution,
    /// The node inside the bodies with the largest force that nothing balances in the field, and its part of
    /// the largest force that the triangles put on a node; None where nothing is deformed.
    pub unbalanced: Option<AtNode>,
    /// The distance of the field from the reference solution.
    pub distance: Distance,
    /// The largest difference of the displacements in each body.
    pub bodies: Vec<BodyDifference>,
    /// The difference of each node's displacement, length.
    #[serde(rename = "nodes")]
    pub differences: Vec<f64>,
}

/// The largest difference of the displacements in a body.
#[derive(Clone, Debug, Serialize)]
pub struct BodyDifference {
    /// The name of the body.
    pub name: String,
    /// The node where it is.
    pub node: NodeId,
    /// The difference there, length.
    pub difference: f64,
    /// That over the body's largest displacement in the reference solution.
    pub relative: f64,
}

impl<'a> Beside<'a> {
    /// Puts displacements `u` by degree of freedom, length, beside `reference`.
    ///
    /// # Errors
    /// The contact surfaces bound no body.
    pub fn new(reference: &'a Solution, u: DVector<f64>) -> Result<Self> {
        let Implied { solution: field, unbalanced } = implied(reference, u)?;
        let size = |[x, y]: [f64; 2]| x.hypot(y);
        let apart = reference.by_node(&(&field.u - &reference.u));
        let differences: Vec<f64> = apart.into_iter().map(size).collect();
        let own: Vec<f64> = reference.displacements().into_iter().map(size).collect();
        let at = |node: &NodeId| differences[node.index()];
        let bodies = reference.model.bodies.iter().map(|body| {
            let worst =
                body.nodes.iter().copied().reduce(|a, b| if at(&b) > at(&a) { b } else { a });
            let node = worst.expect("a body has nodes");
            let scale = body.nodes.iter().map(|node| own[node.index()]).fold(0.0, f64::max);
            let (name, difference) = (body.name.clone(), at(&node));
            BodyDifference { name, node, difference, relative: over(difference, scale) }
        });
        let bodies = bodies.collect();
        let distance = distance(&field, reference);
        let unbalanced = unbalanced.map(|(node, value)| AtNode { node, value });
        Ok(Beside { reference, field, unbalanced, distance, bodies, differences })
    }

    /// Returns what the field and the reference solution imply of contact; None without contact.
    pub fn contact(&self) -> Option<[ContactValues; 2]> {
        let Beside { field, reference, .. } = self;
        let field = ContactValues::of(field, resultant_of_field(field))?;
        Some([field, ContactValues::of(reference, resultant(reference))?])
    }

    /// Returns whether the field is the reference solution within a part of it, in the energy norm and in
    /// displacements.
    pub fn is_within(&self, part: f64) -> bool {
        self.distance.energy_relative <= part && self.distance.displacement_relative <= part
    }

    /// Returns the nodes with the largest differences, the largest first.
    pub fn worst(&self, count: usize) -> Vec<NodeId> {
        let mut nodes: Vec<NodeId> = self.reference.model.node_ids().collect();
        let at = |node: &NodeId| self.differences[node.index()];
        nodes.sort_by(|a, b| at(b).total_cmp(&at(a)));
        nodes.truncate(count);
        nodes
    }
}

/// The value of a node.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct AtNode {
    /// The node.
    pub node: NodeId,
    /// Its value.
    pub value: f64,
}

/// What displacements imply of contact.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ContactValues {
    /// The force on the target's body along x and y, force.
    pub force: Option<[f64; 2]>,
    /// The deepest penetration, length; 0 where there is none.
    pub penetration: Option<AtNode>,
    /// The largest pressure, stress.
    pub pressure: Option<AtNode>,
    /// The largest traction that pulls, stress; 0 where none does.
    pub pull: Option<AtNode>,
    /// The largest shear, stress.
    pub shear: Option<AtNode>,
}

impl ContactValues {
    /// Collects the values of a solution, which passes `passed` to the target; None without contact.
    fn of(solution: &Solution, passed: Option<Resultant>) -> Option<Self> {
        solution.model.target()?;
        // Up to a part of `size` a value is rounding.
        let largest = |value: &dyn Fn(&ContactNode) -> Option<f64>, size: f64| {
            let beyond = |value: f64| if value > ROUNDING_OF_A_FORCE * size { value } else { 0.0 };
            let values = solution
                .contact
                .iter()
                .filter_map(|at| Some(AtNode { node: at.node, value: beyond(value(at)?) }));
            values.reduce(|a, b| if b.value > a.value { b } else { a })
        };
        let pressure = largest(&|at| at.pressure, 0.0);
        let size = pressure.map_or(0.0, |at| at.value);
        Some(ContactValues {
            force: passed.map(|passed| passed.force),
            penetration: largest(&|at| Some(-at.gap), max_displacement(&solution.u)),
            pressure,
            pull: largest(&|at| Some(-at.pressure?), size),
            shear: largest(&|at| at.shear.map(f64::abs), size),
        })
    }
}
