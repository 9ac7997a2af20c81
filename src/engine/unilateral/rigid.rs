//! Whether restraints and contact hold the bodies as rigid ones: what they leave free moves without
//! any force, whatever the materials.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Vector3};

use super::nonnegative::least;
use crate::contact::Pairing;
use crate::elimination::Constraint;
use problem::model::{Body, Dof, FREE, Model, NodeId, RigidBody};

/// The part of forces, or of their moments about the farthest node, below which what is left of them is
/// rounding: coordinates and loads have 16 digits, and a pressure along 10,000 nodes loses 4 of them.
pub(super) const BALANCED: f64 = 1e-9;

/// The gap, over the deepest overlap, beyond which bodies are apart.
const ROOM: f64 = 1e-3;

/// The load, over the one that moves bodies by their deepest overlap on springs.
const VANISHING: f64 = 1e-6;

/// The number of edges that make an arc, and half an edge over the radius up to which it is a facet of one:
/// of a circle of twelve edges, and no body's corner.
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
    let mut gram = DMatrix::<f64>::zeros(motions.free, motions.free);
    for (direction, _, Constraint { node, masters, .. }) in
        constraints.iter().flat_map(Constraint::equations)
    {
        let row = motions.relative(*node, masters, direction);
        let bound: Vec<usize> = (0..row.len()).filter(|k| row[*k] != 0.0).collect();
        for (i, j) in bound.iter().flat_map(|i| bound.iter().map(move |j| (*i, *j))) {
            gram[(i, j)] += row[i] * row[j];
        }
    }
    let diagonal = gram.diagonal();
    gram.cholesky().is_some_and(|factors| {
        let pivots = factors.l_dirty().diagonal();
        pivots.iter().zip(&diagonal).all(|(pivot, own)| pivot * pivot > FREE * own)
    })
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
            forces.map(|force| motions.relative(pairing.node, &pairing.masters, force))
        })
        .collect();
    let entries = columns.iter().flat_map(|column| column.iter().copied());
    let forces = DMatrix::from_iterator(motions.free, columns.len(), entries);
    let sizes = least(&forces.tr_mul(&forces), &forces.tr_mul(&f), DVector::zeros(forces.ncols()))?;
    let left = &f + forces * sizes;
    if left.amax() <= BALANCED * load.amax() {
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

/// Returns the motion of rigid bodies in a shape by which they come to touch under a vanishing load, or else
/// without slip, where they can come apart; None where they cannot, and where nothing is known. `pairings`
/// have their gaps, length, are `closed` up to one of these, and hold within the `reach` of a motion.
///
/// ```text
///   the least ½ ε dᵀ d − fᵀ d with A d + g ≥ 0
///     ε d = f + Aᵀ λ,   the least ½ λᵀ A Aᵀ λ + (A f + ε g)ᵀ λ  over λ ≥ 0
/// ```
///
/// f is the load in the free motions, of unit length. Without it d is the least motion.
///
/// Source: C. L. Lawson, R. J. Hanson, *Solving Least Squares Problems* (1974), section 23.4; O. L.
/// Mangasarian, R. R. Meyer, SIAM J. Control Optim. 17 (1979) 745-752 (a small ε leaves the solution exact).
pub(super) fn release(
    (model, shape): (&Model, &[[f64; 2]]),
    pairings: &[(&Pairing, f64)],
    load: &DVector<f64>,
    [closed, reach]: [f64; 2],
) -> Option<Release> {
    let motions = RigidMotions::new(model, shape);
    let deepest = pairings.iter().map(|(_, gap)| -gap).fold(0.0, f64::max);
    let along = |p: &Pairing, to| motions.relative(p.node, &p.masters, to);
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
    let under_load = (f.norm() > BALANCED * load.amax())
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
/// itself, and the place about which it turns; None where there is none. `edges` have their normal and their
/// length.
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
        let RigidBody { middle: [mx, my], size, .. } = motions.bodies[b];
        if motion[2].abs() <= ALONG * motion.norm() {
            return None;
        }
        let turning = motion[2] / size;
        let centre = [mx - motion[1] / turning, my + motion[0] / turning];
        // Without the rounding of a 0.
        let centre = centre.map(|x| if x.abs() > ALONG * ALONG * size { x } else { 0.0 });
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

/// The rigid motions of all bodies in a shape.
struct RigidMotions<'a> {
    model: &'a Model,
    /// The coordinates of each node, length.
    shape: &'a [[f64; 2]],
    /// The body of each node; None for a node of no triangle.
    body: Vec<Option<usize>>,
    /// The bodies under their restraints.
    bodies: Vec<RigidBody>,
    /// A basis of the motions of each body that its restraints leave free, behind the number of those of the
    /// bodies before it.
    bases: Vec<(usize, Matrix3xX<f64>)>,
    /// The number of free motions of all bodies.
    free: usize,
}

impl<'a> RigidMotions<'a> {
    fn new(model: &'a Model, shape: &'a [[f64; 2]]) -> Self {
        let places = |part: &'a Body| part.nodes.iter().map(|node| shape[node.index()]);
        let mut bodies: Vec<_> = model.bodies.iter().map(|b| RigidBody::new(places(b))).collect();
        let all = model.bodies.iter().flat_map(places);
        let size = all.map(|p| bodies[0].far(p)).fold(0.0, f64::max);
        bodies.iter_mut().for_each(|body| body.size = size);
        let mut body = vec![None; model.nodes.len()];
        for (b, part) in model.bodies.iter().enumerate() {
            part.nodes.iter().for_each(|node| body[node.index()] = Some(b));
        }
        for hold in model.holds.iter() {
            if let Some(b) = body[hold.node.index()] {
                bodies[b].hold(shape[hold.node.index()], hold.direction);
            }
        }
        let (mut bases, mut free) = (Vec::new(), 0);
        for basis in bodies.iter().map(RigidBody::free) {
            free += basis.ncols();
            bases.push((free - basis.ncols(), basis));
        }
        RigidMotions { model, shape, body, bodies, bases, free }
    }

    /// Returns the work of a load in each free motion.
    fn work_of(&self, load: &DVector<f64>) -> DVector<f64> {
        let of_dof = |dof: Dof| Some((self.body[dof.node().index()]?, dof, load[dof.index()]));
        let loaded =
            self.model.all_dofs().filter(|dof| load[dof.index()] != 0.0).filter_map(of_dof);
        let rows =
            loaded.map(|(b, dof, force)| (b, self.motion(b, dof.node(), dof.unit()) * force));
        self.in_free(rows)
    }

    /// Returns what is given for the motions of some bodies for each free motion.
    fn in_free(&self, rows: impl Iterator<Item = (usize, Vector3<f64>)>) -> DVector<f64> {
        let mut all = DVector::zeros(self.free);
        for (b, row) in rows {
            let (from, basis) = &self.bases[b];
            let mut own = all.rows_mut(*from, basis.ncols());
            own += basis.tr_mul(&row);
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
            body.map_or(0.0, |b| self.motion(b, dof.node(), dof.unit()).dot(&bodies[b]))
        });
        DVector::from_iterator(self.model.dofs(), u)
    }

    /// Returns the component along `direction` of a node's motion less that of its masters in each free motion.
    fn relative(
        &self,
        node: NodeId,
        masters: &[(NodeId, f64)],
        direction: [f64; 2],
    ) -> DVector<f64> {
        let target = masters.iter().map(|(master, w)| (*master, -w));
        let parts = std::iter::once((node, 1.0)).chain(target);
        let of_part = |(node, w): (NodeId, f64)| {
            let b = self.body[node.index()]?;
            Some((b, self.motion(b, node, direction) * w))
        };
        self.in_free(parts.filter_map(of_part))
    }

    /// Returns the component along `direction` of a node's motion in the rigid motions of its body.
    fn motion(&self, body: usize, node: NodeId, direction: [f64; 2]) -> Vector3<f64> {
        self.bodies[body].motion(self.shape[node.index()], direction)
    }
}
