//! Whether restraints and contact hold the bodies as rigid ones: what they leave free moves without
//! any force, whatever the materials.

use nalgebra::{DMatrix, DVector};

use crate::answer::elimination::{Constraint, Motion};
use crate::problem::model::{Model, NodeId};

/// The least eigenvalue of the Gram matrix, over the largest, that a motion free of force has.
const FREE: f64 = 1e-12;

/// Returns whether no body can move as a rigid one under its restraints and `constraints`.
pub(super) fn holds(model: &Model, constraints: &[Constraint]) -> bool {
    let motions = Motions::new(model);
    let mut gram = DMatrix::zeros(motions.count(), motions.count());
    let mut add = |row: DVector<f64>| gram += &row * row.transpose();
    for dof in model.all_dofs().filter(|dof| model.is_restrained(*dof)) {
        let direction = [0, 1].map(|d| if d == dof.direction() { 1.0 } else { 0.0 });
        add(motions.of(dof.node(), direction));
    }
    for Constraint { node, masters, motion } in constraints {
        let directions = match motion {
            Motion::Along(normal, _) => vec![*normal],
            Motion::Both(_) => vec![[1.0, 0.0], [0.0, 1.0]],
        };
        for direction in directions {
            let own = motions.of(*node, direction);
            let target = masters.iter().map(|(master, w)| motions.of(*master, direction) * *w);
            add(target.fold(own, |row, part| row - part));
        }
    }
    let stiffness = gram.symmetric_eigenvalues();
    stiffness.is_empty() || stiffness.min() > FREE * stiffness.max()
}

/// The rigid motions of all bodies: two translations and a rotation each.
struct Motions<'a> {
    model: &'a Model,
    /// The body of each node; None for a node of no triangle.
    body: Vec<Option<usize>>,
    /// The middle of each body, length.
    middle: Vec<[f64; 2]>,
    /// The larger extent of the model, length.
    size: f64,
}

impl<'a> Motions<'a> {
    fn new(model: &'a Model) -> Self {
        let mut body = vec![None; model.nodes.len()];
        let mut middle = Vec::new();
        for (b, part) in model.bodies.iter().enumerate() {
            part.nodes.iter().for_each(|n| body[n.index()] = Some(b));
            let places = part.nodes.iter().map(|n| model.at(*n));
            let sum = places.fold([0.0; 2], |[x, y], p| [x + p[0], y + p[1]]);
            middle.push(sum.map(|s| s / part.nodes.len() as f64));
        }
        let far = |[x, y]: &[f64; 2]| (x - middle[0][0]).hypot(y - middle[0][1]);
        let size = model.nodes.iter().map(far).fold(0.0, f64::max);
        Motions { model, body, middle, size }
    }

    fn count(&self) -> usize {
        3 * self.middle.len()
    }

    /// Returns the component of a node's motion along `direction` in each rigid motion.
    fn of(&self, node: NodeId, [dx, dy]: [f64; 2]) -> DVector<f64> {
        let mut row = DVector::zeros(self.count());
        if let Some(b) = self.body[node.index()] {
            let ([x, y], [mx, my]) = (self.model.at(node), self.middle[b]);
            row[3 * b] = dx;
            row[3 * b + 1] = dy;
            row[3 * b + 2] = (dy * (x - mx) - dx * (y - my)) / self.size;
        }
        row
    }
}
