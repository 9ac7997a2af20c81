//! Contact as a reader looks at it: unbroken stretches of nodes in contact, how wide each is and what it
//! passes on.

use std::collections::HashMap;

use serde::Serialize;

use super::contact::rounding;
use super::quantities::ContactNode;
use super::reactions::sides;
use super::solution::{Detail, Solution};
use numbers::joined::joined;
use problem::model::{Model, NodeId};

/// The part of the forces of the nodes up to which their sum is 0: what the path leaves out of balance, some 1e-9
/// on a ring between two plates.
const BALANCED: f64 = 1e-8;

/// What contact passes to the target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Resultant {
    /// The force on the target along x and y, force.
    pub force: [f64; 2],
    /// The point of its line of action next to where contact presses on average, in the undeformed shape,
    /// length; None where it vanishes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub through: Option<[f64; 2]>,
}

/// Nodes in contact that follow each other along the outline of one body, and face one other body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stretch {
    /// The names of the contact body and of the target's.
    pub bodies: [String; 2],
    /// The nodes, in order along the contact surface.
    pub nodes: Vec<NodeId>,
    /// The length of the edges between them in the undeformed shape, length.
    pub width: f64,
    /// What it passes to the target's body.
    #[serde(flatten)]
    pub passed: Resultant,
}

/// Returns the unbroken stretches of contact at the end of a run, in order along the contact surface.
pub fn stretches(solution: &Solution) -> Vec<Stretch> {
    let model = &*solution.model;
    let nodes: Vec<&ContactNode> = solution.in_contact().collect();
    let known = bodies(solution);
    let bodies: Vec<_> = nodes.iter().map(|at| known.get(&at.node).copied()).collect();
    let entry: HashMap<NodeId, usize> = nodes.iter().map(|at| at.node).zip(0..).collect();
    let pair = |side: [NodeId; 2]| Some([*entry.get(&side[0])?, *entry.get(&side[1])?]);
    let is_one = |[a, b]: &[usize; 2]| bodies[*a].is_some() && bodies[*a] == bodies[*b];
    let sides = model.sides.outline().filter_map(|side| pair(side.nodes)).filter(is_one);
    let sides: Vec<[usize; 2]> = sides.collect();
    let first = joined(nodes.len(), sides.iter().map(|[a, b]| (*a, *b)));
    let forces = Forces::new(solution, &nodes);
    let stretch = |k: usize| {
        let own: Vec<&ContactNode> =
            (0..nodes.len()).filter(|i| first[*i] == k).map(|i| nodes[i]).collect();
        let of_stretch = sides.iter().filter(|side| first[side[0]] == k);
        let length = |side: &[usize; 2]| model.length(side.map(|i| nodes[i].node));
        Some(Stretch {
            bodies: bodies[k]?.map(|body| model.bodies[body].name.clone()),
            width: of_stretch.map(length).sum(),
            passed: forces.resultant(&own),
            nodes: own.into_iter().map(|at| at.node).collect(),
        })
    };
    (0..nodes.len()).filter(|k| first[*k] == *k).filter_map(stretch).collect()
}

/// Returns what contact passes to the bodies of the target that rest on no other target. None without
/// contact, where both surfaces are one body's, and where nothing is passed on.
pub fn resultant(solution: &Solution) -> Option<Resultant> {
    if solution.transmits_nothing() {
        return None;
    }
    passed(solution, solution.in_contact())
}

/// Returns what a field of displacements from elsewhere passes to these bodies, by all contact nodes, as which of
/// them are in contact is another program's to say. None without contact, and where both surfaces are one body's.
pub fn resultant_of_field(field: &Solution) -> Option<Resultant> {
    passed(field, field.contact.iter())
}

fn passed<'a>(
    solution: &'a Solution,
    nodes: impl Iterator<Item = &'a ContactNode>,
) -> Option<Resultant> {
    let [contact, target] = sides(&solution.model)?;
    if contact.iter().any(|body| target.contains(body)) {
        return None;
    }
    let bodies = bodies(solution);
    let is_last =
        |at: &&ContactNode| bodies.get(&at.node).is_none_or(|[_, faced]| target.contains(faced));
    let nodes: Vec<&ContactNode> = nodes.filter(is_last).collect();
    Some(Forces::new(solution, &nodes).resultant(&nodes))
}

/// Returns the indices of the body of each node that faces another body at the end, and of that body.
fn bodies(solution: &Solution) -> HashMap<NodeId, [usize; 2]> {
    let faced: Vec<[NodeId; 2]> = match &solution.last().detail {
        Detail::Unilateral(own) => {
            own.pairings.iter().flatten().map(|p| [p.node, p.masters[0].0]).collect()
        }
        Detail::Published(own) => {
            let rows = own.written().filter(|(_, row)| row[0] >= 1.0);
            rows.map(|(node, row)| [node, row[0] as usize].map(NodeId::from_number)).collect()
        }
    };
    let body_of = |node| solution.model.bodies.iter().position(|body| body.has(node));
    let bodies = |[node, master]: [NodeId; 2]| Some((node, [body_of(node)?, body_of(master)?]));
    faced.into_iter().filter_map(bodies).collect()
}

/// The forces of contact on the contact nodes, force: what stresses, loads and restraints leave.
struct Forces<'a> {
    model: &'a Model,
    of_node: HashMap<NodeId, [f64; 2]>,
}

impl<'a> Forces<'a> {
    fn new(solution: &'a Solution, nodes: &[&ContactNode]) -> Self {
        let model = &*solution.model;
        let outer = &model.load + &solution.reactions;
        let mut of_node: HashMap<NodeId, [f64; 2]> = nodes
            .iter()
            .map(|at| (at.node, at.node.components(&outer).map(|force| -force)))
            .collect();
        for (triangle, state) in model.triangles.iter().zip(&solution.elements) {
            let [x, y, xy] = state.sigma.into();
            for k in 0..3 {
                let Some(force) = of_node.get_mut(&triangle.nodes[k]) else { continue };
                // The stress on the side opposite the node, half of which the node takes.
                let [b, c] = [1, 2].map(|next| model.coordinates(triangle.nodes[(k + next) % 3]));
                let half = [b[1] - c[1], c[0] - b[0]].map(|side| model.thickness * side / 2.0);
                force[0] += x * half[0] + xy * half[1];
                force[1] += xy * half[0] + y * half[1];
            }
        }
        let rounding = rounding(model, &solution.u);
        for (node, force) in &mut of_node {
            if force[0].hypot(force[1]) <= rounding[node.index()] {
                *force = [0.0; 2];
            }
        }
        Forces { model, of_node }
    }

    /// Returns what some nodes pass to what they face.
    fn resultant(&self, nodes: &[&ContactNode]) -> Resultant {
        let pressed = || nodes.iter().filter_map(|at| Some((at.node, at.force?.max(0.0))));
        let all: f64 = pressed().map(|(_, force)| force).sum();
        let middle = [0, 1].map(|d| {
            pressed().map(|(node, force)| force * self.model.coordinates(node)[d]).sum::<f64>()
                / all
        });
        let (mut force, mut moment, mut sizes) = ([0.0; 2], 0.0, 0.0);
        for at in nodes {
            let ([fx, fy], [x, y]) = (self.of_node[&at.node], self.model.coordinates(at.node));
            force = [force[0] - fx, force[1] - fy];
            moment -= (x - middle[0]) * fy - (y - middle[1]) * fx;
            sizes += fx.hypot(fy);
        }
        let [fx, fy] = force;
        let size = fx.hypot(fy);
        if size <= BALANCED * sizes {
            return Resultant { force: [0.0; 2], through: None };
        }
        // Divided twice: the square of a small force is 0.
        let arm = moment / size / size;
        let through = (all > 0.0).then(|| [middle[0] - arm * -fy, middle[1] - arm * fx]);
        Resultant { force, through }
    }
}
