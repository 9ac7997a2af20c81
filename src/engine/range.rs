//! The range of linear elements: small strains, small rotations, and no triangle turned inside out.

use nalgebra::DVector;

use problem::element::{Plane, State, area, gradients};
use problem::model::{Model, TriangleId};

/// The strain beyond which small strains describe a body badly: they leave out squares of strains, half
/// of which is then 5 % of the strain itself.
const LARGE_STRAIN: f64 = 0.1;

/// The rotation, in radians, beyond which linear elements take it for a strain: of half its square, 0.005.
const LARGE_ROTATION: f64 = 0.1;

/// Poisson's ratio in plane strain beyond which a material is nearly incompressible: linear triangles lock, as their
/// areas can hardly change. Nothing is known then of the error of the mesh: it looks small where displacements are
/// far too small. Measured on a roller on a flat, both of one material, with edges of a quarter, an eighth and a
/// sixteenth of the half width of contact; the peak pressure over Hertz's:
///
/// | ν     | 0.3   | 0.45  | 0.48  | 0.49  | 0.495 | 0.499 | 0.4999 |
/// |-------|-------|-------|-------|-------|-------|-------|--------|
/// | 1/4   | 0.996 | 1.015 | 1.057 | 1.128 | 1.244 | 1.884 | 2.913  |
/// | 1/8   | 1.004 | 1.014 | 1.035 | 1.069 | 1.141 | 2.232 | 3.972  |
/// | 1/16  | 1.005 | 1.012 | 1.031 | 1.067 | 1.118 | 1.595 | 3.010  |
///
/// Up to 0.48 the error is that of a mesh; beyond it a finer one hardly helps.
const INCOMPRESSIBLE: f64 = 0.48;

/// Returns whether linear triangles of a material lock.
pub fn locks(plane: Plane, nu: f64) -> bool {
    plane == Plane::Strain && nu > INCOMPRESSIBLE
}

/// Says that linear triangles of a material lock; None where they do not.
pub fn locking(plane: Plane, nu: f64) -> Option<String> {
    locks(plane, nu).then(|| {
        format!(
            "Poisson's ratio {nu} in plane strain is nearly incompressible: linear triangles lock: displacements \
             come out too small and contact pressures too large, a roller's peak by about a tenth at 0.49, twofold at 0.499"
        )
    })
}

/// Says so of the material of a model that is nearest to incompressible.
pub fn locking_of(model: &Model) -> Option<String> {
    let ratios = model.triangles.iter().map(|triangle| triangle.material.nu);
    locking(model.plane, ratios.fold(0.0, f64::max))
}

/// Says how far displacements, and the states of the triangles under them, lie beyond the range of linear
/// elements; None where they do not.
pub fn beyond_range(model: &Model, elements: &[State], u: &DVector<f64>) -> Option<String> {
    let strain = elements.iter().map(|state| state.von_mises_strain).fold(0.0, f64::max);
    let rotations = model.triangle_ids().map(|id| rotation(model, id, u).abs());
    let rotation = rotations.fold(0.0, f64::max);
    let inside_out = inside_out(model, &model.shape(u)).count();
    let parts = [
        (strain > LARGE_STRAIN)
            .then(|| format!("the von Mises strain reaches {}", three_digits(strain))),
        (rotation > LARGE_ROTATION)
            .then(|| format!("triangles turn by up to {} rad", three_digits(rotation))),
        (inside_out > 0).then(|| {
            format!("{inside_out} of {} triangles are turned inside out", model.triangles.len())
        }),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| {
        let size = if strain >= 1.0 { "displacements are as large as the bodies: " } else { "" };
        format!(
            "{size}{}; linear elements are for strains below {LARGE_STRAIN} and rotations below \
             {LARGE_ROTATION} rad; check the units of E and of the load",
            parts.join(", ")
        )
    })
}

fn three_digits(x: f64) -> String {
    if x < 1000.0 { format!("{x:.2}") } else { format!("{x:.2e}") }
}

/// Returns the triangles whose corners run clockwise in a shape.
pub fn inside_out<'a>(
    model: &'a Model,
    shape: &'a [[f64; 2]],
) -> impl Iterator<Item = TriangleId> + 'a {
    let corners = |id: &TriangleId| model.triangle(*id).nodes.map(|node| shape[node.index()]);
    model.triangle_ids().filter(move |id| area(&corners(id)) <= 0.0)
}

/// Returns the angle by which a triangle turns, in radians, for small angles.
fn rotation(model: &Model, id: TriangleId, u: &DVector<f64>) -> f64 {
    let nodes = model.triangle(id).nodes;
    let turns = nodes.iter().zip(gradients(&model.corners(id))).map(|(node, [dx, dy])| {
        let [ux, uy] = node.components(u);
        (dx * uy - dy * ux) / 2.0
    });
    turns.sum()
}
