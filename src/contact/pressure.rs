//! What the contact surface carries at the end of a run, whatever the variant: the reaction of the stamp's equations, K u − F.

use nalgebra::DVector;
use serde::Serialize;

use super::pairing::Pairing;
use super::unilateral::normal_force;
use crate::mathcad::array::Table;
use crate::mirror::Worksheet;

/// A contact node at the end of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactNode {
    /// Its number.
    pub node: usize,
    /// Distance from the first contact node along the undeformed contact surface, length.
    pub arc: f64,
    /// 1 = in contact by the variant's own rule.
    pub dy: usize,
    /// Distance from the target along its normal, length; < 0 where the node penetrates.
    pub gap: f64,
    /// Contact pressure, stress; < 0 where the node pulls.
    pub pressure: f64,
    /// Traction along the tangent (the normal turned left), stress.
    pub shear: f64,
    /// |shear| / pressure: the friction coefficient that keeps the node from sliding; none where it does not press.
    pub friction_needed: Option<f64>,
}

/// The contact nodes that face the target, in the order of `cnt`. `pairings` are those of the last shape, `reaction` is K u − F.
pub fn contact_nodes(
    sheet: &Worksheet<f64>,
    thickness: f64,
    pairings: &[Option<Pairing>],
    dy: &[usize],
    reaction: &DVector<f64>,
) -> Vec<ContactNode> {
    let arcs = arcs(sheet, &sheet.node);
    let faced = pairings.iter().zip(arcs).zip(dy);
    faced
        .filter_map(|((pairing, arc), dy)| {
            pairing.as_ref().map(|p| contact_node(sheet, thickness, p, arc, *dy, reaction))
        })
        .collect()
}

fn contact_node(
    sheet: &Worksheet<f64>,
    thickness: f64,
    pairing: &Pairing,
    arc: f64,
    dy: usize,
    reaction: &DVector<f64>,
) -> ContactNode {
    let first = 2 * pairing.node - 2;
    let [nx, ny] = pairing.normal;
    let held = sheet.S[first + 1] == 1 || sheet.S[first + 2] == 1;
    let normal = normal_force(sheet, pairing, reaction);
    // Of a node that a restraint holds the part along the tangent cannot be told from the restraint's own.
    let tangent = if held { 0.0 } else { nx * reaction[first + 1] - ny * reaction[first] };
    let area = pairing.length * thickness;
    let presses = dy == 1 && normal > 0.0;
    ContactNode {
        node: pairing.node,
        arc,
        dy,
        gap: pairing.gap,
        pressure: over(normal, area),
        shear: over(tangent, area),
        friction_needed: presses.then(|| tangent.abs() / normal),
    }
}

/// Force over area; a node that stands for no length carries nothing that can be told.
fn over(force: f64, area: f64) -> f64 {
    if area > 0.0 { force / area } else { 0.0 }
}

/// Distance of each entry of `cnt` from the first along the polyline, length.
fn arcs(sheet: &Worksheet<f64>, node: &Table<f64>) -> Vec<f64> {
    let at = |i1: usize| [2, 3].map(|column| node[(sheet.cnt[i1], column)]);
    let mut arc = 0.0;
    (1..=sheet.cnt.rows())
        .map(|i1| {
            if i1 > 1 {
                let ([ax, ay], [bx, by]) = (at(i1 - 1), at(i1));
                arc += (bx - ax).hypot(by - ay);
            }
            arc
        })
        .collect()
}
