//! Node to segment: the point of the target closest to each contact node, by the rules of
//! `outline.rs`.

use std::collections::HashSet;

use super::outline::{FacedPoint, Outline};
use super::pairing::{Pairing, Vector};
use super::surface::Surfaces;
use problem::model::NodeId;

/// Returns, for each entry of the contact surface, its closest point on the target.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let outline = Outline::new(&surfaces.target, shape);
    let mut listed = HashSet::new();
    let pairing = |(&node, length): (&NodeId, f64)| {
        let faced = outline.faced((node, &surfaces.contact), [shape, &surfaces.at_rest])?;
        let FacedPoint { edge, masters, normal, gap, corner, .. } = faced;
        let edge = surfaces.target_edges[edge];
        let pairing = Pairing { node, edge, masters, normal, gap, length, corner };
        listed.insert(node).then_some(pairing)
    };
    surfaces.nodes.iter().zip(surfaces.tributary(shape)).map(pairing).collect()
}
