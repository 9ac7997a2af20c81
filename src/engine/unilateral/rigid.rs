//! Whether restraints and contact hold the bodies as rigid ones: what they leave free moves without
//! any force, whatever the materials.

use nalgebra::{DMatrix, DVector};

use super::forces::tangent;
use super::nonnegative::least;
use crate::contact::Pairing;
use crate::elimination::{Constraint, Motion};
use problem::model::{Dof, Hold, Model, NodeId};

/// The least eigenvalue of the Gram matrix, over the largest, that a motion free of force has.
const FREE: f64 = 1e-12;

/// The part of the load below which what nothing opposes is rounding.
const OPPOSED: f64 = 1e-9;

/// The gap, over the deepest overlap, beyond which bodies are apart.
const ROOM: f64 = 1e-3;

/// The load, over the one that moves bodies by their deepest overlap on springs.
const VANISHING: f64 = 1e-6;

/// The number of edges that make an arc, and half an edge over the radius up to which it is a facet of one: of
/// a circle of twelve edges, and no body's corner.
const ARC: usize = 3;
const FACET: f64 = 0.28;

/// The part of a motion along the normals of a surface up to which it slides along itself: what a mesh of a
/// circle misses.
const ALONG: f64 = 1e-4;

/// The number of contact nodes up to which a motion is looked for that no contact opposes.
const MOST: usize = 150;

/// Returns whether no body can move as a rigid one under its restraints and `constraints`.
pub(super) fn holds(model: &Model, constraints: &[Constraint]) -> bool {
    let motions = RigidMotions::new(model, &model.nodes);
    let mut gram = motions.restrained();
    for Constraint { node, masters, motion } in constraints {
        let directions = match motion {
            Motion::Along(normal, _) => vec![*normal],
            Motion::Both(_) => vec![[1.0, 0.0], [0.0, 1.0]],
        };
        for direction in directions {
            let row = motions.relative(*node, masters, direction);
            gram += &row * row.transpose();
        }
    }
    let stiffness = gram.symmetric_eigenvalues();
    stiffness.is_empty() || stiffness.min() > FREE * stiffness.max()
}

/// Returns the degree of freedom that moves most in a motion of rigid bodies on which the load does
/// work and which no contact force opposes: under it there is no equilibrium. `friction` is the
/// coefficient of a pairing, infinite where it sticks. None where there is no such motion, and of more
/// than 150 contact nodes.
///
/// ```text
///   d = f + Σ λ_i a_i    λ ≥ 0,  a_iᵀ d ≥ 0,  λ_i a_iᵀ d = 0    so that   fᵀ d = dᵀ d
/// ```
///
/// f is the load and a_i the work of an extreme force of contact, n or n ± μ t on the node and the
/// reverse on its target, in each motion that the restraints leave: d is what is left of the load where
/// contact forces Σ λ_i a_i oppose the most of it (J. J. Moreau, C. R. Acad. Sci. Paris 255 (1962) 238-240).
pub(super) fn escape(
    (model, shape): (&Model, &[[f64; 2]]),
    pairings: &[Option<Pairing>],
    friction: impl Fn(&Pairing) -> f64,
    load: &DVector<f64>,
) -> Option<Dof> {
    let motions = RigidMotions::new(model, shape);
    let gaps: Vec<&Pairing> = pairings.iter().flatten().collect();
    let basis = free_part(&motions.restrained());
    if basis.ncols() == 0 || gaps.len() > MOST {
        return None;
    }
    let f = basis.tr_mul(&motions.work_of(load));
    let forces = gaps.iter().flat_map(|pairing| {
        let of_force = |force| motions.relative(pairing.node, &pairing.masters, force);
        extreme_forces(pairing, friction(pairing)).into_iter().map(of_force).collect::<Vec<_>>()
    });
    let columns: Vec<DVector<f64>> = forces.map(|force| basis.tr_mul(&force)).collect();
    let forces = if columns.is_empty() {
        DMatrix::zeros(basis.ncols(), 0)
    } else {
        DMatrix::from_columns(&columns)
    };
    let sizes = least(&forces.tr_mul(&forces), &forces.tr_mul(&f), DVector::zeros(forces.ncols()))?;
    let left = &f + forces * sizes;
    if left.amax() <= OPPOSED * load.amax() {
        return None;
    }
    let motion = basis * left;
    let size = |dof: &Dof| motions.along(*dof).dot(&motion).abs();
    model.all_dofs().max_by(|a, b| size(a).total_cmp(&size(b)))
}

/// Where rigid bodies that overlap come to touch, by the displacements of each degree of freedom, length.
pub(super) enum Release {
    /// In one place: in that to which a vanishing load brings them without friction, or by their only motion.
    There(DVector<f64>),
    /// In one place in which all nodes that overlap touch and none has slipped.
    Unslipped(DVector<f64>),
    /// In no place more than in another one.
    Anywhere(DVector<f64>),
}

/// Returns the motion of rigid bodies in a shape by which they come to touch under a vanishing load, or else without
/// slip, where they can come apart; None where they cannot, and where nothing is known. `pairings` have their gaps,
/// length, are `closed` up to one of these, and hold within the `reach` of a motion.
///
/// ```text
///   the least ½ ε dᵀ d − fᵀ d with A d + g ≥ 0
///     ε d = f + Aᵀ λ,   the least ½ λᵀ A Aᵀ λ + (A f + ε g)ᵀ λ  over λ ≥ 0
/// ```
///
/// f is the load in the free motions, of unit length. Without it d is the least motion.
///
/// Source: C. L. Lawson, R. J. Hanson, *Solving Least Squares Problems* (1974), section 23.4; O. L. Mangasarian,
/// R. R. Meyer, SIAM J. Control Optim. 17 (1979) 745-752 (a small ε leaves the solution exact).
pub(super) fn release(
    (model, shape): (&Model, &[[f64; 2]]),
    pairings: &[(&Pairing, f64)],
    load: &DVector<f64>,
    [closed, reach]: [f64; 2],
) -> Option<Release> {
    let motions = RigidMotions::new(model, shape);
    let basis = free_part(&motions.restrained());
    let deepest = pairings.iter().map(|(_, gap)| -gap).fold(0.0, f64::max);
    let along = |p: &Pairing, to| basis.tr_mul(&motions.relative(p.node, &p.masters, to));
    let opening = |p: &Pairing| along(p, p.normal);
    let mut near = pairings.to_vec();
    near.sort_by(|a, b| a.1.total_cmp(&b.1));
    near.truncate(MOST);
    let opens = DMatrix::from_columns(&near.iter().map(|(p, _)| opening(p)).collect::<Vec<_>>());
    let least_under = |f: &DVector<f64>, weight: f64, room: f64| {
        let gaps = near.iter().map(|(_, gap)| weight * (gap - room));
        let right = opens.tr_mul(f) + DVector::from_iterator(near.len(), gaps);
        let forces = least(&opens.tr_mul(&opens), &right, DVector::zeros(near.len()))?;
        Some((f + &opens * forces) / weight)
    };
    let none = DVector::zeros(basis.ncols());
    let apart = least_under(&none, 1.0, ROOM * deepest)?;
    if !pairings.iter().all(|(p, gap)| gap + opening(p).dot(&apart) > 0.0) {
        return None;
    }
    let in_all = |motion: DVector<f64>| {
        let motion = &basis * motion;
        let u = model.all_dofs().map(|dof| motions.along(dof).dot(&motion));
        DVector::from_iterator(model.dofs(), u)
    };
    let f = basis.tr_mul(&motions.work_of(load));
    let under_load = (f.norm() > OPPOSED * load.amax())
        .then(|| least_under(&f.normalize(), VANISHING / deepest, 0.0))
        .flatten()
        .filter(|motion| motion.norm() <= reach);
    if let Some(motion) = under_load {
        return Some(Release::There(in_all(motion)));
    }
    if basis.ncols() == 1 {
        return Some(Release::There(in_all(least_under(&none, 1.0, 0.0)?)));
    }
    // Every node that overlaps comes to touch, and none moves along the target.
    let rows = near
        .iter()
        .filter(|(_, gap)| *gap <= closed)
        .flat_map(|(p, gap)| [(opening(p), -gap), (along(p, tangent(p)), 0.0)]);
    let (rows, apart_by): (Vec<_>, Vec<f64>) = rows.unzip();
    let rows = DMatrix::from_columns(&rows).transpose();
    let svd = rows.clone().svd(true, true);
    let holds = svd.rank(FREE.sqrt() * svd.singular_values.max()) == basis.ncols();
    let motion = svd.solve(&DVector::from(apart_by.clone()), 0.0).ok().filter(|motion| {
        let missed = (rows * motion - DVector::from(apart_by)).amax();
        holds
            && missed <= closed
            && pairings.iter().all(|(p, gap)| gap + opening(p).dot(motion) >= -closed)
    });
    Some(match motion {
        Some(motion) => Release::Unslipped(in_all(motion)),
        None => Release::Anywhere(in_all(apart)),
    })
}

/// Returns a body that can turn as a rigid one while its part of some edges, an arc of a circle, slides along
/// itself, and the place about which it turns; None where there is none. `edges` have their normal and their length.
pub(super) fn turns(
    model: &Model,
    edges: &[([NodeId; 2], [f64; 2], f64)],
) -> Option<(usize, [f64; 2])> {
    let motions = RigidMotions::new(model, &model.nodes);
    (0..model.bodies.len()).find_map(|b| {
        let of_body = edges.iter().filter(|(nodes, ..)| motions.body[nodes[0].index()] == Some(b));
        let arc: Vec<_> = of_body.collect();
        let own = |rows: DMatrix<f64>| rows.view((3 * b, 3 * b), (3, 3)).into_owned();
        let basis = free_part(&own(motions.restrained()));
        if arc.len() < ARC || basis.ncols() == 0 {
            return None;
        }
        // The motion of which the least part is along the normals in the middle of the edges.
        let (mut across, mut all) = (DMatrix::zeros(3, 3), DMatrix::zeros(3, 3));
        for (nodes, normal, _) in &arc {
            let middle = |d| own_part(&motions, b, *nodes, d);
            let normal = middle(*normal);
            across += &normal * normal.transpose();
            for direction in [[1.0, 0.0], [0.0, 1.0]] {
                let row = middle(direction);
                all += &row * row.transpose();
            }
        }
        let [across, all] = [across, all].map(|gram| basis.tr_mul(&(gram * &basis)));
        let root = all.cholesky()?.l().try_inverse()?;
        let eigen = (&root * across * root.transpose()).symmetric_eigen();
        let (k, part) = eigen.eigenvalues.argmin();
        let motion = basis * root.tr_mul(&eigen.eigenvectors.column(k));
        // A flat surface slides along itself too, about a point that is far away.
        let turning = motion[2] / motions.size;
        if turning.abs() * motions.size <= ALONG * motion.norm() {
            return None;
        }
        let [mx, my] = motions.middle[b];
        let centre = [mx - motion[1] / turning, my + motion[0] / turning];
        // Without the rounding of a 0.
        let centre = centre.map(|x| if x.abs() > ALONG * ALONG * motions.size { x } else { 0.0 });
        let far = |node: NodeId| {
            let [x, y] = model.coordinates(node);
            (x - centre[0]).hypot(y - centre[1])
        };
        let is_round = arc.iter().all(|(nodes, _, length)| length / 2.0 <= FACET * far(nodes[0]));
        (part <= ALONG * ALONG && is_round).then_some((b, centre))
    })
}

/// Returns the component along a direction of the middle of an edge of a body in each of its rigid motions.
fn own_part(m: &RigidMotions, body: usize, edge: [NodeId; 2], to: [f64; 2]) -> DVector<f64> {
    let sum = m.motion(edge[0], to) + m.motion(edge[1], to);
    sum.rows(3 * body, 3) / 2.0
}

/// Returns a basis of the motions that a Gram matrix leaves free.
fn free_part(gram: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = gram.clone().symmetric_eigen();
    let limit = FREE * eigen.eigenvalues.amax();
    let free: Vec<usize> = (0..gram.nrows()).filter(|i| eigen.eigenvalues[*i] <= limit).collect();
    eigen.eigenvectors.select_columns(&free)
}

/// Returns the directions of the forces on a node whose sums are all forces that contact transmits
/// under a coefficient of friction.
fn extreme_forces(pairing: &Pairing, friction: f64) -> Vec<[f64; 2]> {
    let (n, t) = (pairing.normal, tangent(pairing));
    match friction {
        0.0 => vec![n],
        f64::INFINITY => vec![n, t, t.map(|x| -x)],
        mu => [mu, -mu].map(|mu| [0, 1].map(|d| n[d] + mu * t[d])).to_vec(),
    }
}

/// The rigid motions of all bodies in a shape: two translations and a rotation each.
struct RigidMotions<'a> {
    model: &'a Model,
    /// The coordinates of each node, length.
    shape: &'a [[f64; 2]],
    /// The body of each node; None for a node of no triangle.
    body: Vec<Option<usize>>,
    /// The middle of each body, length.
    middle: Vec<[f64; 2]>,
    /// The larger extent of the model, length.
    size: f64,
}

impl<'a> RigidMotions<'a> {
    fn new(model: &'a Model, shape: &'a [[f64; 2]]) -> Self {
        let mut body = vec![None; model.nodes.len()];
        let mut middle = Vec::new();
        for (b, part) in model.bodies.iter().enumerate() {
            part.nodes.iter().for_each(|n| body[n.index()] = Some(b));
            let places = part.nodes.iter().map(|n| shape[n.index()]);
            let sum = places.fold([0.0; 2], |[x, y], p| [x + p[0], y + p[1]]);
            middle.push(sum.map(|s| s / part.nodes.len() as f64));
        }
        let far = |n: &NodeId| {
            let [x, y] = shape[n.index()];
            (x - middle[0][0]).hypot(y - middle[0][1])
        };
        let nodes = model.bodies.iter().flat_map(|body| &body.nodes);
        let size = nodes.map(far).fold(0.0, f64::max);
        RigidMotions { model, shape, body, middle, size }
    }

    fn count(&self) -> usize {
        3 * self.middle.len()
    }

    /// Returns the Gram matrix of the restraints.
    fn restrained(&self) -> DMatrix<f64> {
        let mut gram = DMatrix::zeros(self.count(), self.count());
        for dof in self.model.all_dofs().filter(|dof| self.model.is_restrained(*dof)) {
            let row = self.along(dof);
            gram += &row * row.transpose();
        }
        for (_, Hold { node, direction, .. }) in self.model.oblique() {
            let row = self.motion(*node, *direction);
            gram += &row * row.transpose();
        }
        gram
    }

    /// Returns the work of a load in each rigid motion.
    fn work_of(&self, load: &DVector<f64>) -> DVector<f64> {
        self.model.all_dofs().map(|dof| self.along(dof) * load[dof.index()]).sum()
    }

    /// Returns a degree of freedom in each rigid motion.
    fn along(&self, dof: Dof) -> DVector<f64> {
        self.motion(dof.node(), [0, 1].map(|d| if d == dof.direction() { 1.0 } else { 0.0 }))
    }

    /// Returns the component along `direction` of a node's motion less that of its masters in each
    /// rigid motion.
    fn relative(
        &self,
        node: NodeId,
        masters: &[(NodeId, f64)],
        direction: [f64; 2],
    ) -> DVector<f64> {
        let target = masters.iter().map(|(master, w)| self.motion(*master, direction) * *w);
        target.fold(self.motion(node, direction), |row, part| row - part)
    }

    /// Returns the component of a node's motion along `direction` in each rigid motion.
    fn motion(&self, node: NodeId, [dx, dy]: [f64; 2]) -> DVector<f64> {
        let mut row = DVector::zeros(self.count());
        if let Some(b) = self.body[node.index()] {
            let ([x, y], [mx, my]) = (self.shape[node.index()], self.middle[b]);
            row[3 * b] = dx;
            row[3 * b + 1] = dy;
            row[3 * b + 2] = (dy * (x - mx) - dx * (y - my)) / self.size;
        }
        row
    }
}
