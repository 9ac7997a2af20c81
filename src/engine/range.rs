//! The range of linear elements: small strains, small rotations, and no triangle turned inside out.

use nalgebra::DVector;

use problem::element::{Plane, State, area, gradients};
use problem::model::{Model, TriangleId};

/// The strain beyond which small strains describe a body badly: they leave out squares of strains, half
/// of which is then 5 % of the strain itself.
const LARGE_STRAIN: f64 = 0.1;

/// The rotation, in radians, beyond which linear elements take it for a strain: of half its square, 0.005.
const LARGE_ROTATION: f64 = 0.1;

/// Poisson's ratio in plane strain beyond which a material is nearly incompressible: linear triangles lock,
/// as their areas can hardly change. Nothing is known then of the error of the mesh: it looks small where
/// displacements are far too small. The largest errors measured, in per cent, with 4, 8 and 16 edges on the
/// length in question: of the pressure on three quarters of the half width under a roller (Hertz), and of the
/// displacement of the bore of a tube under pressure (Lamé), of free and of regular meshes:
///
/// | ν               | 0.3       | 0.45      | 0.47       | 0.48       | 0.49       | 0.495       | 0.499      |
/// |-----------------|-----------|-----------|------------|------------|------------|-------------|------------|
/// | Hertz, free     | 2, 1, 1   | 6, 3, 2   | 6, 4, 2    | 8, 5, 3    | 12, 8, 5   | 22, 11, 9   | 98, 66, 21 |
/// | Lamé, free      | 4, 1, 0   | 9, 2, 0   | 13, 3, 1   | 16, 5, 1   | 24, 8, 1   | 33, 14, 2   | 49, 34, 9  |
/// | Lamé, regular   | 2, 1, 0   | 7, 3, 1   | 10, 5, 2   | 12, 7, 3   | 16, 10, 4  | 20, 15, 7   | 23, 23, 17 |
///
/// Up to 0.45 it is two to three times that at 0.3; a finer mesh helps, less and less towards 0.5. On a
/// regular mesh a roller's peak was 2.2 times Hertz's at 0.499, with 8 edges on the half width.
const INCOMPRESSIBLE: f64 = 0.45;

/// Returns whether linear triangles of a material lock.
pub fn locks(plane: Plane, nu: f64) -> bool {
    plane == Plane::Strain && nu > INCOMPRESSIBLE
}

/// Says that linear triangles of a material lock; None where they do not.
pub fn locking(plane: Plane, nu: f64) -> Option<String> {
    locks(plane, nu).then(|| {
        format!(
            "Poisson's ratio {nu} in plane strain is nearly incompressible: linear triangles lock: displacements \
             come out too small as a rule, and contact pressures too large; measured with 4 to 16 edges on the half width of \
             contact or on a wall: errors up to 9 % at 0.45, 16 % at 0.48, 24 % at 0.49, twofold at 0.499; refine, and compare"
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
