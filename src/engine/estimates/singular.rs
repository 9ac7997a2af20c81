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
//! About the meeting of two straight sides the stress goes like r^(λ−1); it has a limit unless λ <
//! 1, which begins at an angle ω between the sides that depends on how they are held:
//!
//! | sides | λ < 1 beyond |
//! |---|---|
//! | both free, both fixed, both on rollers | 180° |
//! | one on rollers, a mirror: the body and its image make the angle | 90° |
//! | one fixed, one free: sin²ω = (κ + 1) / 4 | 57° in plane strain at ν = 0.3 |
//!
//! κ = 3 − 4ν in plane strain, (3 − ν) / (1 + ν) in plane stress. Where contact ends and sticks, or
//! ends at the edge of a body, the traction goes like r^(−1/2) or nearly so; where it ends
//! without friction between smooth surfaces, it goes to 0.
//!
//! Under a force on a single node the stress goes like r^(−1) and the displacement like log r; so it
//! does where a single node is held by a force. Where two materials meet at the outline, or their
//! interface turns, the exponent depends on both (D. B. Bogy, J. Appl. Mech. 35 (1968) 460-466): such
//! points are named as ones where the stress may have no limit.
//!
//! Source: M. L. Williams, "Stress singularities resulting from various boundary conditions in
//! angular corners of plates in extension", J. Appl. Mech. 19 (1952) 526-528.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::contact::Status;
use crate::{Detail, Solution, Stiffness};
use base::choices;
use problem::element::Plane;
use problem::model::{Force, Model, NodeId, TriangleId, TriangleSide};

/// The turn of an outline below which it is taken for a chord of a curve and not for a corner, rad.
const CHORD: f64 = PI / 6.0;

/// The force of a restraint on a single node, over the largest force on any node, below which it
/// only keeps the body from moving as a whole.
const IDLE: f64 = 1e-6;

/// How near, in lengths of an edge, the ends of two surfaces in contact make one straight outline.
const FLUSH: f64 = 0.5;

choices! {
    /// Why the stress at a point has no limit.
    Cause {
        /// The outline turns inwards.
        Corner = "a re-entrant corner",
        /// A held edge ends.
        Restraint = "the end of a restrained edge",
        /// One node is held by a force.
        Support = "a restraint of a single node",
        /// One node is loaded by a force.
        Load = "a force on a single node",
        /// Two materials meet at the outline, or their interface turns or branches.
        Interface = "a corner of two materials",
        /// Nodes that stick end where nodes are open.
        Sticking = "the end of sticking contact",
        /// Contact ends at the edge of a body.
        Edge = "contact at the edge of a body",
    }
}

impl Cause {
    /// Says whether the stress at the point "diverges" under refinement, or "may diverge".
    pub fn diverges(self) -> &'static str {
        if self == Cause::Interface { "may diverge" } else { "diverges" }
    }

    /// Returns whether displacements have no limit either: those of the node under a load, and all
    /// that are measured from a node that is held.
    pub fn moves(self) -> bool {
        matches!(self, Cause::Load | Cause::Support)
    }
}

/// A point where the stress has no limit.
#[derive(Clone, Debug)]
pub struct Singular {
    /// The node that stands there; of contact, that of the contact surface.
    pub node: NodeId,
    /// Why it has none.
    pub cause: Cause,
    /// The triangles about it, in two rings, whose stresses show it.
    pub triangles: BTreeSet<TriangleId>,
}

/// Returns the points of a solution where the stress has no limit, in the order of their nodes; of several
/// causes the first.
pub fn singular(solution: &Solution) -> Vec<Singular> {
    let model = &*solution.model;
    let outline = Outline::new(model);
    let around = TrianglesAtNodes::new(model);
    let all = |nodes: Vec<NodeId>, cause: Cause| nodes.into_iter().map(move |node| (node, cause));
    let points = outline.corners(model).into_iter();
    let points = points
        .chain(all(around.supports(solution), Cause::Support))
        .chain(all(around.loaded(model), Cause::Load))
        .chain(all(outline.material_corners(model), Cause::Interface))
        .chain(outline.contact_ends(solution));
    let mut found: BTreeMap<NodeId, Cause> = BTreeMap::new();
    points.for_each(|(node, cause)| _ = found.entry(node).or_insert(cause));
    let point = |(node, cause): (NodeId, Cause)| {
        let mut nodes = vec![node];
        if matches!(cause, Cause::Sticking | Cause::Edge) {
            let constraint = solution.last().constraints.iter().find(|c| c.node == node);
            let masters = constraint.into_iter().flat_map(|constraint| &constraint.masters);
            let heaviest = masters.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            nodes.extend(heaviest.map(|master| master.0));
        }
        Singular { node, cause, triangles: around.two_rings(model, &nodes) }
    };
    found.into_iter().map(point).collect()
}

/// The triangles at each node.
struct TrianglesAtNodes(Vec<Vec<TriangleId>>);

impl TrianglesAtNodes {
    fn new(model: &Model) -> Self {
        let mut around = vec![Vec::new(); model.nodes.len()];
        for id in model.triangle_ids() {
            model.triangle(id).nodes.iter().for_each(|node| around[node.index()].push(id));
        }
        TrianglesAtNodes(around)
    }

    fn two_rings(&self, model: &Model, nodes: &[NodeId]) -> BTreeSet<TriangleId> {
        let at = |node: &NodeId| self.0[node.index()].iter().copied();
        let first: BTreeSet<TriangleId> = nodes.iter().flat_map(at).collect();
        first
            .iter()
            .flat_map(|id| model.triangle(*id).nodes)
            .flat_map(|n| self.0[n.index()].clone())
            .collect()
    }

    /// Returns the nodes that share a triangle with a node, itself among them.
    fn beside(&self, model: &Model, node: NodeId) -> impl Iterator<Item = NodeId> {
        self.0[node.index()].iter().flat_map(|id| model.triangle(*id).nodes)
    }

    /// Returns the nodes that are held by a force where no node beside them is.
    fn supports(&self, solution: &Solution) -> Vec<NodeId> {
        let model = &*solution.model;
        let reaction = Stiffness::new(model, |x| x).times(&solution.u) - &model.load;
        let idle = IDLE * reaction.amax().max(model.load.amax());
        let alone = |node: &NodeId| {
            node.dofs().into_iter().enumerate().any(|(d, dof)| {
                let holds = |other: NodeId| other != *node && model.restraints_of(other)[d];
                model.is_restrained(dof)
                    && !self.beside(model, *node).any(holds)
                    && reaction[dof.index()].abs() > idle
            })
        };
        model.node_ids().filter(alone).collect()
    }

    /// Returns the nodes that a force moves where none moves a node beside them: forces on all nodes
    /// of an edge are a traction.
    fn loaded(&self, model: &Model) -> Vec<NodeId> {
        let mut forces: BTreeMap<NodeId, [f64; 2]> = BTreeMap::new();
        for force in &model.forces {
            match force {
                Force::Node(node, [fx, fy]) => {
                    let sum = forces.entry(*node).or_default();
                    *sum = [sum[0] + fx, sum[1] + fy];
                }
                Force::Pressure(..) | Force::Traction(..) => (),
            }
        }
        forces.retain(|node, force| {
            let held = model.restraints_of(*node);
            (0..2).any(|d| force[d] != 0.0 && !held[d])
        });
        let is_loaded = |node: NodeId| forces.contains_key(&node);
        let alone = |node: &NodeId| {
            !self.beside(model, *node).any(|other| other != *node && is_loaded(other))
        };
        forces.keys().copied().filter(alone).collect()
    }
}

/// How a side of the outline is held.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SideSupport {
    Free,
    Roller,
    Fixed,
}

/// The sides at each node of the outline that two of them meet at: the one that comes, the one that
/// goes, the body on their left.
struct Outline(BTreeMap<NodeId, [TriangleSide; 2]>);

impl Outline {
    fn new(model: &Model) -> Self {
        let (mut coming, mut going) = (BTreeMap::new(), BTreeMap::new());
        let mut pinched = BTreeSet::new();
        for triangle in &model.triangles {
            for k in 0..3 {
                let ends = [k, (k + 1) % 3].map(|k| triangle.nodes[k]);
                let Some(side) = model.sides.boundary(ends) else { continue };
                let [a, b] = side.nodes;
                pinched.extend(going.insert(a, side).map(|_| a));
                pinched.extend(coming.insert(b, side).map(|_| b));
            }
        }
        let both = |(node, side): (NodeId, TriangleSide)| Some((node, [side, *going.get(&node)?]));
        let sides = coming.into_iter().filter(|(node, _)| !pinched.contains(node));
        Outline(sides.filter_map(both).collect())
    }

    /// Returns the angle of the body at a node of the outline, rad.
    fn angle(model: &Model, [coming, going]: [TriangleSide; 2]) -> f64 {
        let [x, y] = model.coordinates(going.nodes[0]);
        let to = |node: NodeId| {
            let [ax, ay] = model.coordinates(node);
            [ax - x, ay - y]
        };
        let ([ax, ay], [bx, by]) = (to(going.nodes[1]), to(coming.nodes[0]));
        (ax * by - ay * bx).atan2(ax * bx + ay * by).rem_euclid(TAU)
    }

    fn side_support(model: &Model, side: TriangleSide) -> SideSupport {
        let [a, b] = side.nodes.map(|node| model.restraints_of(node));
        let ([ax, ay], [bx, by]) =
            (model.coordinates(side.nodes[0]), model.coordinates(side.nodes[1]));
        let along = [(bx - ax).abs(), (by - ay).abs()];
        match [a[0] && b[0], a[1] && b[1]] {
            [false, false] => SideSupport::Free,
            [true, false] if along[0] < CHORD * along[1] => SideSupport::Roller,
            [false, true] if along[1] < CHORD * along[0] => SideSupport::Roller,
            _ => SideSupport::Fixed,
        }
    }

    /// Returns the corners of the outline where two sides meet at an angle beyond the widest one at
    /// which the stress has a limit.
    fn corners(&self, model: &Model) -> Vec<(NodeId, Cause)> {
        let corner = |(node, sides): (&NodeId, &[TriangleSide; 2])| {
            let held = sides.map(|side| Outline::side_support(model, side));
            let nu = model.triangle(sides[0].triangle).material.nu;
            let cause = match held {
                [a, b] if a == b => Cause::Corner,
                _ => Cause::Restraint,
            };
            (Outline::angle(model, *sides) > widest(held, model.plane, nu))
                .then_some((*node, cause))
        };
        self.0.iter().filter_map(corner).collect()
    }

    /// Returns the nodes at which an interface of two materials ends, turns or branches.
    fn material_corners(&self, model: &Model) -> Vec<NodeId> {
        let mut across: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
        for triangle in &model.triangles {
            for k in 0..3 {
                let [a, b] = [k, (k + 1) % 3].map(|k| triangle.nodes[k]);
                let [one, other] = model.sides.beside([a, b]) else { continue };
                let materials = [one, other].map(|beside| model.triangle(beside.triangle).material);
                // Both triangles have the edge: it is taken from the one that runs along it so.
                if a < b && materials[0] != materials[1] {
                    across.entry(a).or_default().push(b);
                    across.entry(b).or_default().push(a);
                }
            }
        }
        let turns = |node: NodeId, ends: &[NodeId]| {
            let [x, y] = model.coordinates(node);
            let [[ax, ay], [bx, by]] = [ends[0], ends[1]].map(|end| {
                let [ex, ey] = model.coordinates(end);
                [ex - x, ey - y]
            });
            PI - (ax * by - ay * bx).abs().atan2(ax * bx + ay * by) > CHORD
        };
        let corner = |(node, ends): (NodeId, Vec<NodeId>)| {
            let smooth = ends.len() == 2 && !self.0.contains_key(&node) && !turns(node, &ends);
            (!smooth).then_some(node)
        };
        across.into_iter().filter_map(corner).collect()
    }

    /// Returns the nodes of the contact surface at which contact ends and does not fade away.
    fn contact_ends(&self, solution: &Solution) -> Vec<(NodeId, Cause)> {
        let (model, last) = (&*solution.model, solution.last());
        let (nodes, closed) = (&model.contact.nodes, last.statuses());
        let sticks = |k: usize| match &last.detail {
            Detail::Unilateral(own) => own.statuses[k] == Status::Stick,
            Detail::Published(_) => true,
        };
        let corner = |node: NodeId| {
            self.0.get(&node).is_none_or(|sides| Outline::angle(model, *sides) < PI - CHORD)
        };
        let mut found = Vec::new();
        for k in (0..nodes.len()).filter(|k| closed[*k]) {
            let beside = [k.checked_sub(1), Some(k + 1).filter(|k| *k < nodes.len())];
            if beside.iter().flatten().all(|other| closed[*other])
                && beside.iter().all(Option::is_some)
            {
                continue;
            }
            let is_end = beside.iter().any(Option::is_none);
            let on_axis = is_end && model.restraints_of(nodes[k]).contains(&true);
            let opens = beside.iter().flatten().any(|other| !closed[*other]);
            if opens && sticks(k) {
                found.push((nodes[k], Cause::Sticking));
            } else if !on_axis && (is_end || corner(nodes[k])) && !flush(model, k) {
                found.push((nodes[k], Cause::Edge));
            }
        }
        found
    }
}

/// Whether an end of the target surface stands at entry `k` of the contact surface.
fn flush(model: &Model, k: usize) -> bool {
    let nodes = &model.contact.nodes;
    let far = |a: NodeId, b: NodeId| {
        let ([ax, ay], [bx, by]) = (model.coordinates(a), model.coordinates(b));
        (bx - ax).hypot(by - ay)
    };
    let beside = if k == 0 { nodes.get(1) } else { nodes.get(k - 1) };
    let Some(edge) = beside.map(|other| far(nodes[k], *other)) else { return false };
    let ends = model.target_edges().flat_map(|edge| edge.nodes);
    let mut count: BTreeMap<NodeId, usize> = BTreeMap::new();
    ends.for_each(|node| *count.entry(node).or_default() += 1);
    let is_near = |node: &NodeId| far(nodes[k], *node) < FLUSH * edge;
    count.iter().any(|(node, count)| *count == 1 && is_near(node))
}

/// Returns the widest angle between two sides at which the stress has a limit, rad, and what an
/// outline of chords may add to it.
fn widest(held: [SideSupport; 2], plane: Plane, nu: f64) -> f64 {
    let kappa = match plane {
        Plane::Strain => 3.0 - 4.0 * nu,
        Plane::Stress => (3.0 - nu) / (1.0 + nu),
    };
    match held {
        [a, b] if a == b => PI + CHORD,
        held if held.contains(&SideSupport::Roller) => FRAC_PI_2 + CHORD / 2.0,
        _ => ((kappa + 1.0) / 4.0).sqrt().min(1.0).asin(),
    }
}
