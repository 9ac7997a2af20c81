//! Points where the stress grows without limit as the mesh is refined: no mesh has its largest
//! value.
//!
//! ```text
//!   re-entrant corner      end of a held edge       edge of sticking contact
//!     +------+                                          \        /
//!     |      |                //+--------                 \______/
//!     |  +---+                //|   <- fixed to free    ====*====*====
//!     +--+   <- here          //+--------
//! ```
//!
//! - About a corner of the outline the stress goes like r^(λ−1); λ < 1 begins at 180° between sides that are
//!   held alike, at sin²ω = (κ + 1) / 4 between a fixed and a free one, with κ = 3 − 4ν in plane strain and
//!   (3 − ν) / (1 + ν) in plane stress. (Sides on rollers count as free.)
//! - Under a force on a single node, of the load or of a restraint, it goes like r^(−1), and displacements like
//!   log r.
//! - Where contact ends and sticks, it goes like r^(−1/2) or nearly so.
//!
//! Source: M. L. Williams, "Stress singularities resulting from various boundary conditions in
//! angular corners of plates in extension", J. Appl. Mech. 19 (1952) 526-528.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use nalgebra::DVector;

use crate::contact::Status;
use crate::{Detail, Solution, Stiffness};
use base::choices;
use problem::element::Plane;
use problem::model::{Dof, Force, Model, NodeId, Triangle, TriangleSide};

/// The turn of an outline below which it is taken for a chord of a curve and not for a corner, rad.
const CHORD: f64 = PI / 6.0;

/// The force on a single restrained node, over the largest on any node, below which a restraint
/// only keeps the body from moving as a whole.
const IDLE: f64 = 1e-6;

choices! {
    /// Why the stress at a point has no limit.
    Cause {
        /// The outline turns inwards, or a held edge ends.
        Corner = "a re-entrant corner or the end of a restrained edge",
        /// One node is loaded or held by a force.
        Force = "a force on a single node",
        /// Nodes that stick end where nodes are open.
        Sticking = "the end of sticking contact",
    }
}

/// A point where the stress has no limit.
#[derive(Clone, Debug)]
pub struct Singular {
    /// The node that stands there; of contact, that of the contact surface.
    pub node: NodeId,
    /// Why it has none.
    pub cause: Cause,
    /// The nodes of the triangles about it.
    about: BTreeSet<NodeId>,
}

impl Singular {
    /// Returns whether a triangle is one of the two rings about the point, whose stresses show it.
    pub fn is_near(&self, triangle: &Triangle) -> bool {
        triangle.nodes.iter().any(|node| self.about.contains(node))
    }
}

/// Returns the points of a solution where the stress has no limit, in the order of their nodes; of several
/// causes the first.
pub fn singular(solution: &Solution) -> Vec<Singular> {
    let model = &*solution.model;
    let mut found: BTreeMap<NodeId, (Cause, Vec<NodeId>)> = BTreeMap::new();
    let mut add = |node, cause, nodes| _ = found.entry(node).or_insert((cause, nodes));
    corners(model).into_iter().for_each(|node| add(node, Cause::Corner, vec![node]));
    forces(solution).into_iter().for_each(|node| add(node, Cause::Force, vec![node]));
    ends(solution)
        .into_iter()
        .for_each(|[node, master]| add(node, Cause::Sticking, vec![node, master]));
    let point = |(node, (cause, nodes)): (NodeId, (Cause, Vec<NodeId>))| {
        let about = nodes.into_iter().flat_map(|node| beside(model, node)).collect();
        Singular { node, cause, about }
    };
    found.into_iter().map(point).collect()
}

/// Returns the nodes that share a triangle with a node, itself among them.
fn beside(model: &Model, node: NodeId) -> impl Iterator<Item = NodeId> {
    model.triangles.iter().filter(move |t| t.nodes.contains(&node)).flat_map(|t| t.nodes)
}

/// Returns the nodes of the outline where two sides meet at an angle beyond the widest one at which the
/// stress has a limit.
fn corners(model: &Model) -> Vec<NodeId> {
    let sides =
        model.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| [t.nodes[k], t.nodes[(k + 1) % 3]]));
    let outline: Vec<TriangleSide> = sides.filter_map(|ends| model.sides.boundary(ends)).collect();
    let going: BTreeMap<NodeId, TriangleSide> =
        outline.iter().map(|side| (side.nodes[0], *side)).collect();
    let is_fixed = |side: TriangleSide| {
        let [a, b] = side.nodes.map(|node| model.restraints_of(node));
        a == [true; 2] && b == [true; 2]
    };
    let corner = |coming: &TriangleSide| {
        let [before, node] = coming.nodes;
        let after = *going.get(&node)?;
        let [x, y] = model.coordinates(node);
        let to = |other: NodeId| {
            let [ax, ay] = model.coordinates(other);
            [ax - x, ay - y]
        };
        let ([ax, ay], [bx, by]) = (to(after.nodes[1]), to(before));
        let angle = (ax * by - ay * bx).atan2(ax * bx + ay * by).rem_euclid(TAU);
        let nu = model.triangle(coming.triangle).material.nu;
        let kappa = match model.plane {
            Plane::Strain => 3.0 - 4.0 * nu,
            Plane::Stress => (3.0 - nu) / (1.0 + nu),
        };
        let widest = match is_fixed(*coming) == is_fixed(after) {
            true => PI + CHORD,
            false => ((kappa + 1.0) / 4.0).sqrt().min(1.0).asin(),
        };
        (angle > widest).then_some(node)
    };
    outline.iter().filter_map(corner).collect()
}

/// Returns the nodes on which a force of the load, or of a restraint, acts and acts on no node beside them:
/// forces on all nodes of an edge are a traction.
fn forces(solution: &Solution) -> Vec<NodeId> {
    let model = &*solution.model;
    let mut applied = DVector::zeros(model.dofs());
    for force in model.forces.iter().filter(|force| matches!(force, Force::Node(..))) {
        force.add_to(&mut applied, model, &|x| x);
    }
    let force = Stiffness::new(model, |x| x).times(&solution.u);
    let idle = IDLE * force.amax();
    let mut together = vec![false; model.dofs()];
    for triangle in &model.triangles {
        for d in 0..2 {
            let dofs = triangle.nodes.map(|node| node.dofs()[d]);
            let held: Vec<Dof> = dofs.into_iter().filter(|dof| model.is_restrained(*dof)).collect();
            let loaded = dofs.into_iter().filter(|dof| applied[dof.index()] != 0.0);
            let loaded: Vec<Dof> = loaded.filter(|dof| !model.is_restrained(*dof)).collect();
            let beside = [held, loaded].into_iter().filter(|dofs| dofs.len() > 1).flatten();
            beside.for_each(|dof| together[dof.index()] = true);
        }
    }
    let acts_alone = |dof: Dof| match model.is_restrained(dof) {
        _ if together[dof.index()] => false,
        true => force[dof.index()].abs() > idle,
        false => applied[dof.index()] != 0.0,
    };
    model.node_ids().filter(|node| node.dofs().into_iter().any(acts_alone)).collect()
}

/// Returns the nodes of the contact surface at which contact that sticks ends beside an open node, each with
/// the target node that carries most of it.
fn ends(solution: &Solution) -> Vec<[NodeId; 2]> {
    let (nodes, last) = (&solution.model.contact.nodes, solution.last());
    let closed = last.statuses();
    let sticks = |k: usize| match &last.detail {
        Detail::Unilateral(own) => own.statuses[k] == Status::Stick,
        Detail::Published(_) => closed[k],
    };
    let opens =
        |k: usize| [k.wrapping_sub(1), k + 1].iter().any(|k| closed.get(*k) == Some(&false));
    let end = |k: usize| {
        let constraint = last.constraints.iter().find(|constraint| constraint.node == nodes[k])?;
        let heaviest = constraint.masters.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some([nodes[k], heaviest.0])
    };
    (0..nodes.len()).filter(|k| sticks(*k) && opens(*k)).filter_map(end).collect()
}
