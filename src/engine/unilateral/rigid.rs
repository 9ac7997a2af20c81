//! Whether restraints and contact hold the bodies as rigid ones: what they leave free moves without
//! any force, whatever the materials.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Vector3};

use super::nonnegative::least;
use crate::contact::Pairing;
use crate::elimination::{Constraint, Motion};
use numbers::joined::joined;
use problem::model::{Dof, Model, NodeId};

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
    let rows: Vec<Vec<(usize, Vector3<f64>)>> = constraints
        .iter()
        .flat_map(|Constraint { node, masters, motion }| {
            let directions = match motion {
                Motion::Along(normal, _) => vec![*normal],
                Motion::Both(_) => vec![[1.0, 0.0], [0.0, 1.0]],
            };
            directions.into_iter().map(|direction| motions.relative(*node, masters, direction))
        })
        .collect();
    // Bodies that no constraint joins are independent.
    let pairs = rows.iter().flat_map(|row| row.iter().map(|(b, _)| (row[0].0, *b)));
    let joined = joined(model.bodies.len(), pairs);
    let of_group = |first: usize| {
        let members: Vec<usize> = (0..joined.len()).filter(|b| joined[*b] == first).collect();
        let place = |b: usize| 3 * members.binary_search(&b).expect("it is a member");
        let mut gram = DMatrix::zeros(3 * members.len(), 3 * members.len());
        for b in &members {
            gram.fixed_view_mut::<3, 3>(place(*b), place(*b)).copy_from(&motions.restrained[*b]);
        }
        for row in rows.iter().filter(|row| row.first().is_some_and(|(b, _)| joined[*b] == first)) {
            for ((b, own), (c, other)) in
                row.iter().flat_map(|own| row.iter().map(move |c| (own, c)))
            {
                let mut block = gram.fixed_view_mut::<3, 3>(place(*b), place(*c));
                block += own * other.transpose();
            }
        }
        let stiffness = gram.symmetric_eigenvalues();
        stiffness.min() > FREE * stiffness.max()
    };
    (0..joined.len()).filter(|b| joined[*b] == *b).all(of_group)
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
    if motions.free == 0 || gaps.len() > MOST {
        return None;
    }
    let f = motions.work_of(load);
    let columns: Vec<DVector<f64>> = gaps
        .iter()
        .flat_map(|pairing| {
            let forces = extreme_forces(pairing, friction(pairing)).into_iter();
            forces.map(|force| {
                motions.in_free(&motions.relative(pairing.node, &pairing.masters, force))
            })
        })
        .collect();
    let forces = if columns.is_empty() {
        DMatrix::zeros(motions.free, 0)
    } else {
        DMatrix::from_columns(&columns)
    };
    let sizes = least(&forces.tr_mul(&forces), &forces.tr_mul(&f), DVector::zeros(forces.ncols()))?;
    let left = &f + forces * sizes;
    if left.amax() <= OPPOSED * load.amax() {
        return None;
    }
    model.all_dofs().nth(motions.displacements(&left).iamax())
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
    let deepest = pairings.iter().map(|(_, gap)| -gap).fold(0.0, f64::max);
    let along = |p: &Pairing, to| motions.in_free(&motions.relative(p.node, &p.masters, to));
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
    let none = DVector::zeros(motions.free);
    let apart = least_under(&none, 1.0, ROOM * deepest)?;
    if !pairings.iter().all(|(p, gap)| gap + opening(p).dot(&apart) > 0.0) {
        return None;
    }
    let in_all = |motion: DVector<f64>| motions.displacements(&motion);
    let f = motions.work_of(load);
    let under_load = (f.norm() > OPPOSED * load.amax())
        .then(|| least_under(&f.normalize(), VANISHING / deepest, 0.0))
        .flatten()
        .filter(|motion| motion.norm() <= reach);
    if let Some(motion) = under_load {
        return Some(Release::There(in_all(motion)));
    }
    if motions.free == 1 {
        return Some(Release::There(in_all(least_under(&none, 1.0, 0.0)?)));
    }
    // Every node that overlaps comes to touch, and none moves along the target.
    let rows = near
        .iter()
        .filter(|(_, gap)| *gap <= closed)
        .flat_map(|(p, gap)| [(opening(p), -gap), (along(p, p.tangent()), 0.0)]);
    let (rows, apart_by): (Vec<_>, Vec<f64>) = rows.unzip();
    let rows = DMatrix::from_columns(&rows).transpose();
    let svd = rows.clone().svd(true, true);
    let holds = svd.rank(FREE.sqrt() * svd.singular_values.max()) == motions.free;
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
        let (_, basis) = &motions.bases[b];
        if arc.len() < ARC || basis.ncols() == 0 {
            return None;
        }
        // The motion of which the least part is along the normals in the middle of the edges.
        let (mut across, mut all) = (Matrix3::zeros(), Matrix3::zeros());
        for (nodes, normal, _) in &arc {
            let middle =
                |d| nodes.iter().map(|n| motions.motion(b, *n, d)).sum::<Vector3<f64>>() / 2.0;
            let normal = middle(*normal);
            across += normal * normal.transpose();
            for direction in [[1.0, 0.0], [0.0, 1.0]] {
                let row = middle(direction);
                all += row * row.transpose();
            }
        }
        let [across, all] = [across, all].map(|gram| basis.tr_mul(&(gram * basis)));
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

/// Returns the directions of the forces on a node whose sums are all forces that contact transmits
/// under a coefficient of friction.
fn extreme_forces(pairing: &Pairing, friction: f64) -> Vec<[f64; 2]> {
    let (n, t) = (pairing.normal, pairing.tangent());
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
    /// The Gram matrix of each body's restraints.
    restrained: Vec<Matrix3<f64>>,
    /// A basis of the motions of each body that its restraints leave free, behind the number of those of the bodies
    /// before it.
    bases: Vec<(usize, Matrix3xX<f64>)>,
    /// The number of free motions of all bodies.
    free: usize,
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
        let restrained = vec![Matrix3::zeros(); middle.len()];
        let bases = Vec::new();
        let mut motions =
            RigidMotions { model, shape, body, middle, size, restrained, bases, free: 0 };
        let axes = model.all_dofs().filter(|dof| model.is_restrained(*dof));
        let along_axes = axes.map(|dof| (dof.node(), axis(dof)));
        for (node, direction) in
            along_axes.chain(model.oblique().map(|(_, hold)| (hold.node, hold.direction)))
        {
            if let Some(b) = motions.body[node.index()] {
                let row = motions.motion(b, node, direction);
                motions.restrained[b] += row * row.transpose();
            }
        }
        for gram in &motions.restrained {
            let eigen = gram.symmetric_eigen();
            let limit = FREE * eigen.eigenvalues.amax();
            let free: Vec<usize> = (0..3).filter(|i| eigen.eigenvalues[*i] <= limit).collect();
            motions.bases.push((motions.free, eigen.eigenvectors.select_columns(&free)));
            motions.free += free.len();
        }
        motions
    }

    /// Returns the work of a load in each free motion.
    fn work_of(&self, load: &DVector<f64>) -> DVector<f64> {
        let of_dof = |dof: Dof| Some((self.body[dof.node().index()]?, dof, load[dof.index()]));
        let loaded =
            self.model.all_dofs().filter(|dof| load[dof.index()] != 0.0).filter_map(of_dof);
        let rows = loaded.map(|(b, dof, force)| (b, self.motion(b, dof.node(), axis(dof)) * force));
        self.in_free(&rows.collect::<Vec<_>>())
    }

    /// Returns what is given for the motions of some bodies for each free motion.
    fn in_free(&self, rows: &[(usize, Vector3<f64>)]) -> DVector<f64> {
        let mut all = DVector::zeros(self.free);
        for (b, row) in rows {
            let (from, basis) = &self.bases[*b];
            let mut own = all.rows_mut(*from, basis.ncols());
            own += basis.tr_mul(row);
        }
        all
    }

    /// Returns the displacement of each degree of freedom in a motion, given by its free motions.
    fn displacements(&self, motion: &DVector<f64>) -> DVector<f64> {
        let of_body =
            |(from, basis): &(usize, Matrix3xX<f64>)| basis * motion.rows(*from, basis.ncols());
        let bodies: Vec<Vector3<f64>> = self.bases.iter().map(of_body).collect();
        let u = self.model.all_dofs().map(|dof| {
            let body = self.body[dof.node().index()];
            body.map_or(0.0, |b| self.motion(b, dof.node(), axis(dof)).dot(&bodies[b]))
        });
        DVector::from_iterator(self.model.dofs(), u)
    }

    /// Returns the component along `direction` of a node's motion less that of its masters in the rigid motions of
    /// their bodies.
    fn relative(
        &self,
        node: NodeId,
        masters: &[(NodeId, f64)],
        direction: [f64; 2],
    ) -> Vec<(usize, Vector3<f64>)> {
        let target = masters.iter().map(|(master, w)| (*master, -w));
        let parts = std::iter::once((node, 1.0)).chain(target);
        let of_part = |(node, w): (NodeId, f64)| {
            let b = self.body[node.index()]?;
            Some((b, self.motion(b, node, direction) * w))
        };
        parts.filter_map(of_part).collect()
    }

    /// Returns the component along `direction` of a node's motion in the rigid motions of its body.
    fn motion(&self, body: usize, node: NodeId, [dx, dy]: [f64; 2]) -> Vector3<f64> {
        let ([x, y], [mx, my]) = (self.shape[node.index()], self.middle[body]);
        Vector3::new(dx, dy, (dy * (x - mx) - dx * (y - my)) / self.size)
    }
}

/// Returns the direction of a degree of freedom.
fn axis(dof: Dof) -> [f64; 2] {
    [0, 1].map(|d| if d == dof.direction() { 1.0 } else { 0.0 })
}
