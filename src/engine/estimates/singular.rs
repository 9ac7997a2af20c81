//! Points where the stress grows without limit as the mesh is refined: no mesh has its largest value.
//!
//! - About a corner of the outline the stress goes like r^(λ−1); λ < 1 begins at 180° between sides that are
//!   held alike, at sin²ω = (κ + 1) / 4 between a fixed and a free one, with κ = 3 − 4ν in plane strain and
//!   (3 − ν) / (1 + ν) in plane stress. (Sides on rollers count as free.)
//! - Under a force on a single node, of the load or of a restraint, it goes like r^(−1).
//! - Where contact ends and sticks, and at the edge of a punch or of a contact group, it goes like r^(−1/2) or nearly so.
//!
//! Source: M. L. Williams, "Stress singularities resulting from various boundary conditions in
//! angular corners of plates in extension", J. Appl. Mech. 19 (1952) 526-528.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use nalgebra::DVector;

use crate::contact::{Status, Surfaces};
use crate::{Constraint, Solution, Stiffness};
use base::choices;
use problem::element::Plane;
use problem::model::{Dof, Force, Model, NodeId, Triangle, TriangleSide};

/// The turn of an outline below which it is taken for a chord of a curve and not for a corner, rad.
const CHORD: f64 = PI / 6.0;

/// The force on a single restrained node, over the largest on any node, below which a restraint
/// only keeps the body from moving as a whole.
const IDLE: f64 = 1e-6;

/// What is left by rounding of α (α − 2 β) of like materials.
const UNLIKE: f64 = 1e-12;

choices! {
    /// Why the stress at a point has no limit.
    Cause {
        /// The outline turns inwards, or a held edge ends.
        Corner = "a re-entrant corner or the end of a restrained edge",
        /// One node is loaded or held by a force.
        Force = "a force on a single node",
        /// Nodes that stick end where nodes are open.
        Sticking = "the end of the sticking zone",
        /// A body ends in contact, and the other goes on, as at the edge of a punch.
        Edge = "contact at the edge of a body",
        /// A contact group ends in contact, and both bodies go on.
        Group = "the end of a contact group on a surface that goes on",
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
    let (model, turns) = (&*solution.model, turns(&solution.model));
    let corners = corners(model, &turns).into_iter().map(|node| (Cause::Corner, [node, node]));
    let forces = forces(solution).into_iter().map(|node| (Cause::Force, [node, node]));
    let mut found: Vec<(Cause, [NodeId; 2])> =
        corners.chain(forces).chain(contact_ends_at(solution, &turns)).collect();
    found.sort_by_key(|(_, nodes)| nodes[0]);
    found.dedup_by_key(|(_, nodes)| nodes[0]);
    let point = |(cause, nodes): (Cause, [NodeId; 2])| {
        let beside = model.triangles.iter().filter(|t| t.nodes.iter().any(|n| nodes.contains(n)));
        Singular { node: nodes[0], cause, about: beside.flat_map(|t| t.nodes).collect() }
    };
    found.into_iter().map(point).collect()
}

/// Two sides of an outline that meet at a node.
struct Turn {
    /// The side that ends there and the one that starts, with the body on the left.
    sides: [TriangleSide; 2],
    /// The angle of the body between them, rad.
    angle: f64,
}

impl Turn {
    fn is_smooth(&self) -> bool {
        (self.angle - PI).abs() < CHORD
    }

    fn is_convex(&self) -> bool {
        self.angle <= PI - CHORD
    }
}

/// How the outline turns at each of its nodes.
type Turns = BTreeMap<NodeId, Turn>;

fn turns(model: &Model) -> Turns {
    let outline: Vec<TriangleSide> = model.sides.outline().collect();
    let going: BTreeMap<NodeId, TriangleSide> =
        outline.iter().map(|side| (side.nodes[0], *side)).collect();
    let turn = |coming: &TriangleSide| {
        let [before, node] = coming.nodes;
        let after = *going.get(&node)?;
        let [x, y] = model.coordinates(node);
        let ([ax, ay], [bx, by]) = (model.coordinates(after.nodes[1]), model.coordinates(before));
        let ([ax, ay], [bx, by]) = ([ax - x, ay - y], [bx - x, by - y]);
        let angle = (ax * by - ay * bx).atan2(ax * bx + ay * by).rem_euclid(TAU);
        Some((node, Turn { sides: [*coming, after], angle }))
    };
    outline.iter().filter_map(turn).collect()
}

/// Returns the nodes of the outline where two sides meet at an angle beyond the widest one at which the
/// stress has a limit.
fn corners(model: &Model, turns: &Turns) -> Vec<NodeId> {
    let is_fixed =
        |side: TriangleSide| side.nodes.iter().all(|node| model.holds.of(*node).len() == 2);
    let is_corner = |turn: &Turn| {
        let [coming, after] = turn.sides;
        let kappa = kappa(model.plane, model.triangle(coming.triangle).material.nu);
        let widest = match is_fixed(coming) == is_fixed(after) {
            true => PI + CHORD,
            false => ((kappa + 1.0) / 4.0).sqrt().min(1.0).asin(),
        };
        turn.angle > widest
    };
    turns.iter().filter(|(_, turn)| is_corner(turn)).map(|(node, _)| *node).collect()
}

/// Returns Kolosov's constant κ.
fn kappa(plane: Plane, nu: f64) -> f64 {
    match plane {
        Plane::Strain => 3.0 - 4.0 * nu,
        Plane::Stress => (3.0 - nu) / (1.0 + nu),
    }
}

/// What acts along a degree of freedom.
#[derive(PartialEq)]
enum Kind {
    Held,
    Loaded,
    Free,
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
    let kind = |dof: Dof| match (model.holds.takes(dof), applied[dof.index()] != 0.0) {
        (true, _) => Kind::Held,
        (false, true) => Kind::Loaded,
        (false, false) => Kind::Free,
    };
    let mut together = vec![false; model.dofs()];
    for triangle in &model.triangles {
        for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|side| side.map(|k| triangle.nodes[k].dofs())) {
            for (a, b) in a.into_iter().zip(b).filter(|(a, b)| kind(*a) == kind(*b)) {
                (together[a.index()], together[b.index()]) = (true, true);
            }
        }
    }
    let acts_alone = |dof: Dof| match kind(dof) {
        _ if together[dof.index()] => false,
        Kind::Held => force[dof.index()].abs() > idle,
        Kind::Loaded => true,
        Kind::Free => false,
    };
    model.node_ids().filter(|node| node.dofs().into_iter().any(acts_alone)).collect()
}

/// Returns the nodes of the contact surface at which contact that sticks ends, each with a target node:
/// beside an open node that which carries most of it, and where both bodies end in corners of unlike
/// materials the target's.
fn ends(solution: &Solution, turns: &Turns) -> Vec<[NodeId; 2]> {
    let (model, last) = (&*solution.model, solution.last());
    let nodes = &model.contact.nodes;
    let opens = |k: usize| {
        let mut beside = [k.wrapping_sub(1), k + 1].into_iter();
        beside.any(|k| last.statuses.get(k) == Some(&Status::Open))
    };
    let end = |k: usize| {
        let constraint = last.constraints.iter().find(|constraint| constraint.node == nodes[k])?;
        let unlike = || {
            // A corner that a restraint holds may be one of symmetry.
            let own = turns.get(&nodes[k]).filter(|_| model.holds.of(nodes[k]).is_empty())?;
            let mut masters = constraint.masters.iter().map(|(master, _)| *master);
            masters.find(|master| {
                turns.get(master).is_some_and(|other| are_unlike_corners(model, [own, other]))
            })
        };
        let other = if opens(k) { carrier(constraint) } else { unlike() };
        Some([nodes[k], other?])
    };
    (0..nodes.len()).filter(|k| last.statuses[*k] == Status::Stick).filter_map(end).collect()
}

/// Returns whether bodies that are bonded at the corners of both make a point without a limit there. Where
/// their sides are flush and at right angles to the bond, that is where Dundurs' α (α − 2 β) > 0.
///
/// Source: D. B. Bogy, "Two edge-bonded elastic wedges of different materials and wedge angles under surface
/// tractions", J. Appl. Mech. 38 (1971) 377-386.
fn are_unlike_corners(model: &Model, corners: [&Turn; 2]) -> bool {
    let [(m, k), (n, l)] = corners.map(|turn| {
        let material = model.triangle(turn.sides[0].triangle).material;
        (material.e / (1.0 + material.nu), kappa(model.plane, material.nu))
    });
    let sum = m * (l + 1.0) + n * (k + 1.0);
    let alpha = (m * (l + 1.0) - n * (k + 1.0)) / sum;
    let beta = (m * (l - 1.0) - n * (k - 1.0)) / sum;
    let is_flush = corners.iter().map(|turn| turn.angle).sum::<f64>() > PI - CHORD;
    corners.iter().all(|turn| turn.is_convex()) && is_flush && alpha * (alpha - 2.0 * beta) > UNLIKE
}

/// Returns the nodes at which contact ends in a point without a limit, each with the cause and a target node
/// there.
pub fn contact_ends(solution: &Solution) -> Vec<(Cause, [NodeId; 2])> {
    contact_ends_at(solution, &turns(&solution.model))
}

fn contact_ends_at(solution: &Solution, turns: &Turns) -> Vec<(Cause, [NodeId; 2])> {
    let sticking = ends(solution, turns).into_iter().map(|nodes| (Cause::Sticking, nodes));
    edges(solution, turns).into_iter().chain(sticking).collect()
}

/// Returns the nodes in contact at which a body ends while the other goes on, or a contact group while both
/// do, each with the target node there. A body that goes on past the end of a group may enter the other
/// unseen.
fn edges(solution: &Solution, turns: &Turns) -> Vec<(Cause, [NodeId; 2])> {
    let model = &*solution.model;
    let Ok(surfaces) = Surfaces::new(model) else { return Vec::new() };
    let is = |node: NodeId, test: fn(&Turn) -> bool| turns.get(&node).is_some_and(test);
    let constraints = &solution.last().constraints;
    let pairs = constraints.iter().filter_map(|own| Some([own.node, carrier(own)?]));
    let pairs: Vec<[NodeId; 2]> = pairs.collect();
    let goes_on_beside = |node: NodeId, other: NodeId| {
        let body = model.body_of(other);
        let outline =
            turns.iter().filter(|(at, _)| **at != node && body.is_some_and(|b| b.has(**at)));
        let distance = |other: &NodeId| model.length([node, *other]);
        let nearest = outline.min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
        nearest.is_some_and(|(_, turn)| turn.is_smooth())
    };
    let is_edge = |pair: &&[NodeId; 2]| {
        let ends =
            |own: usize| is(pair[own], Turn::is_convex) && goes_on_beside(pair[own], pair[1 - own]);
        ends(0) || ends(1)
    };
    let [of_contact, of_target] = surfaces.ends();
    let at_end = |end: NodeId| {
        let weight = |own: &Constraint| {
            own.masters.iter().filter(|(node, _)| *node == end).map(|(_, w)| w.abs()).sum::<f64>()
        };
        let most = constraints.iter().max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
        (weight(most) > 0.0).then_some([most.node, end])
    };
    let of_contact = pairs.iter().filter(|pair| of_contact.contains(&pair[0])).copied();
    let groups = of_contact.chain(of_target.into_iter().filter_map(at_end));
    let groups = groups.filter(|pair| pair.iter().all(|node| is(*node, Turn::is_smooth)));
    let edges = pairs.iter().filter(is_edge).map(|pair| (Cause::Edge, *pair));
    groups.map(|pair| (Cause::Group, pair)).chain(edges).collect()
}

/// Returns the target node that carries most of a contact node.
fn carrier(constraint: &Constraint) -> Option<NodeId> {
    let heaviest = constraint.masters.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some(heaviest.0)
}
