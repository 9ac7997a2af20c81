//! What a scene file says of its mesh, checked: materials, restraints, contact surfaces, bodies that something holds.

use std::collections::{HashMap, HashSet};

use super::body::{self, Body};
use super::description::{Axis, Description, Material};
use super::mesh::Mesh;
use super::{groups, surface};
use crate::error::InputError;
use crate::paper::mathcad::array::Column;
use crate::paper::mirror::Worksheet;
use crate::problem::element::Plane;

/// More iterations than anybody waits for.
const MOST_ITERATIONS: usize = 1_000_000;

/// The scene's plain numbers, checked.
pub struct Numbers {
    /// The plane problem behind `D`.
    pub plane: Plane,
    /// Thickness across the plane, length.
    pub thickness: f64,
}

impl Numbers {
    /// Checks thickness and number of iterations.
    ///
    /// # Errors
    /// A thickness that is not positive; no iteration.
    pub fn check(file: &Description) -> Result<Self, InputError> {
        if !(file.thickness > 0.0 && file.thickness.is_finite()) {
            let what = format!("the thickness {} is not positive", file.thickness);
            return Err(InputError::new("field thickness", what, "the paper's is 1"));
        }
        if !(1..=MOST_ITERATIONS).contains(&file.iterations) {
            let what = format!("{} iterations are outside 1 .. {MOST_ITERATIONS}", file.iterations);
            return Err(InputError::new("field iterations", what, "the paper's number is 20"));
        }
        Ok(Numbers { plane: file.plane, thickness: file.thickness })
    }
}

/// Each triangle's material and the name of its group, in the order of `EL`.
///
/// # Errors
/// A material out of its range; a triangle with no material or two; a group with no triangle.
pub fn materials(
    mesh: &Mesh,
    file: &Description,
) -> Result<(Vec<Material>, Vec<String>), InputError> {
    let mut of_element = HashMap::new();
    for (group, material) in &file.materials.0 {
        let place = format!("materials.{}", group.text());
        if !(material.e > 0.0 && material.e.is_finite()) {
            let what = format!("E = {} is not positive", material.e);
            return Err(InputError::new(
                format!("{place}.E"),
                what,
                "give an elastic modulus above 0",
            ));
        }
        poisson(material.nu, file.plane, &format!("{place}.nu"))?;
        for triangle in groups::members(mesh, 2, group, &place)? {
            if let Some((_, other)) = of_element.insert(triangle.number, (*material, group.text()))
            {
                let what = format!(
                    "triangle {} has two materials, {other} and {}",
                    triangle.number,
                    group.text()
                );
                return Err(InputError::new(place, what, "give each triangle one material"));
            }
        }
    }
    let found = mesh.of_dimension(2).map(|triangle| {
        of_element.remove(&triangle.number).ok_or_else(|| {
            let what = format!(
                "triangle {} has no material (its physical groups: {:?})",
                triangle.number, triangle.physical
            );
            InputError::new("materials", what, "give each physical group of triangles a material")
        })
    });
    Ok(found.collect::<Result<Vec<_>, _>>()?.into_iter().unzip())
}

/// That `nu` is a Poisson's ratio of the plane problem.
///
/// # Errors
/// It is outside (-1, 0.5) in plane strain, (-1, 1) in plane stress.
pub fn poisson(nu: f64, plane: Plane, place: &str) -> Result<(), InputError> {
    let (below, name) = match plane {
        Plane::Strain => (0.5, "plane strain"),
        Plane::Stress => (1.0, "plane stress"),
    };
    if nu > -1.0 && nu < below {
        return Ok(());
    }
    let what = format!("nu = {nu} is outside (-1, {below}) in {name}");
    Err(InputError::new(place, what, "give a Poisson's ratio inside"))
}

/// The paper's `S`: 1 where a direction of a node is held.
///
/// # Errors
/// A restraint that names no place, or two; a node or group that is not there.
pub fn restraints(mesh: &Mesh, file: &Description) -> Result<Column<usize>, InputError> {
    let mut fixed = Column::filled(2 * mesh.nodes.len(), 0);
    for (k, restraint) in file.restraints.iter().enumerate() {
        let place = format!("restraints[{k}]");
        let nodes = match (&restraint.on, restraint.node) {
            (Some(on), None) => groups::nodes(mesh, on, &format!("{place}.on"))?,
            (None, Some(n)) => {
                mesh.check_node(n, &format!("{place}.node"))?;
                vec![n]
            }
            _ => {
                let what = "a restraint is {on, fix} or {node, fix}";
                return Err(InputError::new(place, what, "give exactly one of on and node"));
            }
        };
        if restraint.fix.is_empty() {
            let what = "a restraint that fixes no direction";
            return Err(InputError::new(format!("{place}.fix"), what, "name \"x\", \"y\" or both"));
        }
        for n in nodes {
            for axis in &restraint.fix {
                fixed[2 * n - if *axis == Axis::X { 1 } else { 0 }] = 1;
            }
        }
    }
    Ok(fixed)
}

/// `cnt`, `trg` and `c_tll`; empty where the scene has no contact.
///
/// # Errors
/// A negative tolerance; surfaces that are not there or share a node.
pub fn contact(
    mesh: &Mesh,
    file: &Description,
) -> Result<(Vec<usize>, Vec<usize>, f64), InputError> {
    let Some(contact) = &file.contact else { return Ok((vec![], vec![], 0.0)) };
    if !(contact.c_tll >= 0.0 && contact.c_tll.is_finite()) {
        let what = format!("c_tll = {} is negative", contact.c_tll);
        return Err(InputError::new("contact.c_tll", what, "the paper's is 0.001"));
    }
    let cnt = surface::contact_nodes(mesh, &contact.cnt)?;
    let trg = surface::target_edges(mesh, &contact.trg)?;
    let (on_cnt, on_trg): (HashSet<usize>, HashSet<usize>) =
        (cnt.iter().copied().collect(), trg.iter().copied().collect());
    for edge in mesh.of_dimension(1).filter(|e| on_trg.contains(&e.number)) {
        if let Some(n) = edge.nodes.iter().find(|n| on_cnt.contains(n)) {
            let what = format!("contact node {n} is also on the target edge {}", edge.number);
            return Err(InputError::new("contact", what, "let the two bodies share no node"));
        }
    }
    Ok((cnt, trg, contact.c_tll))
}

/// That restraints hold each body that no contact surface touches, and, taken as one, the bodies that contact joins.
///
/// # Errors
/// A body that can still move, and how.
pub fn held(mesh: &Mesh, bodies: &[Body], sheet: &Worksheet<f64>) -> Result<(), InputError> {
    let target_nodes = sheet.trg.iter().map(|&e| sheet.elem[(e, 6)]);
    let in_contact: Vec<usize> = sheet.cnt.iter().copied().chain(target_nodes).collect();
    let touched = |body: &Body| in_contact.iter().any(|n| body.nodes.binary_search(n).is_ok());
    let fixed = |n: usize| [sheet.S[2 * n - 1] == 1, sheet.S[2 * n] == 1];
    let (joined, alone): (Vec<&Body>, Vec<&Body>) = bodies.iter().partition(|body| touched(body));
    for body in alone {
        if let Some(freedom) = body::freedom(mesh, &body.nodes, fixed) {
            let what =
                format!("body {:?} is held by no contact and can still {freedom}", body.name);
            return Err(InputError::new(
                "restraints",
                what,
                "hold it, or give it a contact surface",
            ));
        }
    }
    let nodes: Vec<usize> = joined.iter().flat_map(|body| body.nodes.iter().copied()).collect();
    if let Some(freedom) = body::freedom(mesh, &nodes, fixed).filter(|_| !joined.is_empty()) {
        let what = format!("the bodies that contact joins can still {freedom}, all together");
        return Err(InputError::new("restraints", what, "hold one of them"));
    }
    Ok(())
}
