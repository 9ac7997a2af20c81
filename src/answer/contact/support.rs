//! What holds the target up: the forces on its restraints, and what ties pass straight to them.

use nalgebra::DVector;

use super::elimination::{Motion, Tie, sum};
use super::pairing::Pairing;
use crate::numbers::scalar::Scalar;
use crate::paper::mirror::Worksheet;
use crate::problem::scene::Scene;

/// Sum of the target body's reactions, force. `force` is K·u − F on all 2R equations, `held` the restrained ones.
pub fn support<T: Scalar>(
    scene: &Scene,
    held: &[bool],
    ties: &[Tie<T>],
    force: &DVector<T>,
) -> [T; 2] {
    let mut total = [T::zero(), T::zero()];
    let Some(target) = scene.target() else { return total };
    for e in target.nodes.iter().flat_map(|n| [2 * n - 2, 2 * n - 1]).filter(|&e| held[e]) {
        total[e % 2] += force[e];
    }
    for tie in ties {
        let passed = passed(tie, held, force);
        for direction in [0, 1] {
            let to_held = tie.weights.iter().filter(|(mate, _)| held[2 * mate - 2 + direction]);
            total[direction] += sum(to_held.map(|(_, w)| *w)) * passed[direction];
        }
    }
    total
}

/// The contact force on a tied node, force.
fn passed<T: Scalar>(tie: &Tie<T>, held: &[bool], force: &DVector<T>) -> [T; 2] {
    let first = 2 * tie.node - 2;
    let free = [!held[first], !held[first + 1]];
    match tie.motion {
        Motion::Both(_) => [0, 1].map(|d| if free[d] { force[first + d] } else { T::zero() }),
        Motion::Along(normal, _) => {
            normal.map(|n| n * along(normal, free, [force[first], force[first + 1]]))
        }
    }
}

/// The component along `normal` of a force that acts along it, from the components that no restraint has a share in.
pub(super) fn along<T: Scalar>(normal: [T; 2], free: [bool; 2], force: [T; 2]) -> T {
    match free {
        [true, true] => normal[0] * force[0] + normal[1] * force[1],
        [false, true] => force[1] / normal[1],
        [true, false] => force[0] / normal[0],
        [false, false] => T::zero(),
    }
}

/// A contact force's component along the normal, force: where S holds one direction of the node, from the other one.
pub(super) fn normal_force(
    sheet: &Worksheet<f64>,
    pairing: &Pairing,
    reaction: &DVector<f64>,
) -> f64 {
    let first = 2 * pairing.node - 2;
    let free = [0, 1].map(|d| sheet.S[first + d + 1] == 0);
    along(pairing.normal, free, [reaction[first], reaction[first + 1]])
}

/// The reactions taken against the direction of the load, force.
pub fn against_load(scene: &Scene, [rx, ry]: [f64; 2]) -> f64 {
    let [fx, fy] = scene.total_load();
    let size = fx.hypot(fy);
    if size == 0.0 {
        return rx.hypot(ry);
    }
    // 0 − x rather than −x: no reaction at all is 0, not −0.
    0.0 - (rx * (fx / size) + ry * (fy / size))
}
