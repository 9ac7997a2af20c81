//! What the contact surface carries at the end of a run, whatever the variant: the reaction of the stamp's equations, K u − F.

use nalgebra::DVector;
use serde::Serialize;

use super::pairing::{Pairing, Surfaces};
use super::support::normal_force;
use crate::error::InputError;
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::Worksheet;

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
    /// Force on the node along the normal, force; < 0 where it pulls.
    pub force: f64,
    /// The same over the undeformed surface that the node stands for: contact pressure, stress.
    pub pressure: f64,
    /// Traction along the tangent (the normal turned left), stress.
    pub shear: f64,
    /// |shear| / pressure: the friction coefficient that keeps the node from sliding; none where it does not press.
    pub friction_needed: Option<f64>,
}

/// The contact surface at the end of a run.
pub struct Surface<'a> {
    /// The paper's arrays.
    pub sheet: &'a Worksheet<f64>,
    /// Thickness, length.
    pub thickness: f64,
    /// The shape in which contact is measured: R x 4.
    pub measured_in: &'a Table<f64>,
    /// What each entry of `cnt` faces in it.
    pub pairings: &'a [Option<Pairing>],
    /// By entry of `cnt`, 1 = in contact.
    pub dy: &'a [usize],
    /// K u − F, force.
    pub reaction: &'a DVector<f64>,
}

impl Surface<'_> {
    /// The contact nodes that face the target, in the order of `cnt`.
    ///
    /// # Errors
    /// A target edge that bounds no triangle.
    pub fn nodes(&self) -> Result<Vec<ContactNode>, InputError> {
        let surfaces = Surfaces::new(self.sheet)?;
        let lengths = [&self.sheet.node, self.measured_in].map(|shape| surfaces.tributary(shape));
        let arcs = arcs(self.sheet, &self.sheet.node);
        let node = |i: usize| {
            let pairing = self.pairings[i].as_ref()?;
            let stretch = lengths[1][i] / lengths[0][i];
            Some(self.node(pairing, arcs[i], self.dy[i], over(pairing.length, stretch)))
        };
        Ok((0..self.pairings.len()).filter_map(node).collect())
    }

    /// A contact node that stands for `length` of the undeformed surface.
    fn node(&self, pairing: &Pairing, arc: f64, dy: usize, length: f64) -> ContactNode {
        let (sheet, reaction) = (self.sheet, self.reaction);
        let first = 2 * pairing.node - 2;
        let [nx, ny] = pairing.normal;
        let held = sheet.S[first + 1] == 1 || sheet.S[first + 2] == 1;
        let normal = normal_force(sheet, pairing, reaction);
        // Of a node that a restraint holds the part along the tangent cannot be told from the restraint's own.
        let tangent = if held { 0.0 } else { nx * reaction[first + 1] - ny * reaction[first] };
        let area = length * self.thickness;
        let presses = dy == 1 && normal > 0.0;
        ContactNode {
            node: pairing.node,
            arc,
            dy,
            gap: pairing.gap,
            force: normal,
            pressure: over(normal, area),
            shear: over(tangent, area),
            friction_needed: presses.then(|| tangent.abs() / normal),
        }
    }
}

/// a / b; 0 for a node that stands for no length.
fn over(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}

/// Distance of each entry of `cnt` from the first along the polyline, length.
pub(super) fn arcs(sheet: &Worksheet<f64>, node: &Table<f64>) -> Vec<f64> {
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
