//! The paper's arrays from a mesh that is known to be sound.

use super::check::Numbers;
use super::description::Material;
use super::mesh::{Element, Mesh};
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::Worksheet;
use crate::problem::element;

/// The worksheet around the listings.
#[allow(non_snake_case, reason = "the paper's own names")]
pub fn worksheet(
    mesh: &Mesh,
    numbers: Numbers,
    materials: &[Material],
    S: Column<usize>,
    (cnt, trg, c_tll): (Vec<usize>, Vec<usize>, f64),
) -> Worksheet<f64> {
    let triangles: Vec<&Element> = mesh.of_dimension(2).collect();
    let corners: Vec<_> = triangles.iter().map(|t| mesh.corners(t)).collect();
    let last = mesh.elements.last().map_or(0, |e| e.number);
    let mut elem = Table::filled(last, 8, 0);
    for element in &mesh.elements {
        for (j, value) in row(element).enumerate() {
            elem[(element.number, j + 1)] = value;
        }
    }
    Worksheet {
        node: Table::from_fn(mesh.nodes.len(), 4, |i, j| match j {
            1 => i as f64,
            _ => mesh.nodes[i - 1].xyz[j - 2],
        }),
        EL: Table::from_fn(triangles.len(), 8, |n, j| elem[(triangles[n - 1].number, j)]),
        elem,
        trg: Column::from_vec(trg),
        cnt: Column::from_vec(cnt),
        c_tll,
        ind_1: 6,
        S,
        Ae: Column::from_vec(
            corners.iter().map(|p| element::area(p) * numbers.thickness).collect(),
        ),
        B: Column::from_vec(corners.iter().map(element::B).collect()),
        E: Column::from_vec(materials.iter().map(|m| m.e).collect()),
        nu: Column::from_vec(materials.iter().map(|m| m.nu).collect()),
        plane: numbers.plane,
    }
}

/// A row of `elem`: number, type, number of tags, physical tag, geometric tag, nodes.
fn row(element: &Element) -> impl Iterator<Item = usize> {
    let physical = element.physical.first().copied().unwrap_or(0);
    let head = [element.number, element.kind, 2, physical, element.geometric];
    head.into_iter().chain(element.nodes.iter().copied())
}
