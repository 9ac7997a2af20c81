//! The field of a difference: the displacements of a run less those that were recorded.

use std::collections::BTreeMap;
use std::path::Path;

use crate::json;
use crate::picture::{self, Drawing, Field};
use crate::quantities::Array;
use crate::vtu;
use base::error::Result;
use base::files;
use problem::scene::Scene;
use studies::snapshot::Run;

/// Writes `difference.vtu` and `difference.svg` to `folder`: the displacements of `new` less those of
/// `old`, by node; and `difference.json`, which names the scene. Returns false, and writes nothing, where the two have other nodes or none.
///
/// # Errors
/// A file cannot be written.
pub fn difference_files(folder: &Path, scene: &Scene, [old, new]: [&Run; 2]) -> Result<bool> {
    let displacements = |run: &Run| {
        let numbers = run.numbers.get("u")?;
        let values: Vec<f64> = numbers.places().into_iter().map(|(_, x)| x).collect();
        (values.len() == 2 * scene.model.nodes.len() && values.iter().all(|x| x.is_finite()))
            .then_some(values)
    };
    let (Some(was), Some(is)) = (displacements(old), displacements(new)) else { return Ok(false) };
    let difference: Vec<f64> = is.iter().zip(&was).map(|(is, was)| is - was).collect();
    let sizes: Vec<f64> = difference.chunks(2).map(|u| u[0].hypot(u[1])).collect();
    let drawing = Drawing::new(scene, &format!("{}: difference", scene.title));
    let at_corners =
        |triangle: &[usize; 3]| triangle.map(|k| sizes[k]).into_iter().fold(0.0, f64::max);
    let values: Vec<f64> = drawing.triangles.iter().map(at_corners).collect();
    let displacement: Vec<[f64; 2]> = is.chunks(2).map(|u| [u[0], u[1]]).collect();
    let field = Field {
        quantity: "difference of displacements",
        unit: &scene.units.length,
        values: &values,
        displacement: &displacement,
        largest_at: None,
    };
    let unit = &scene.units.length[..];
    let points =
        [Array::new("difference", unit, 2, difference), Array::new("displacement", unit, 2, is)];
    let vtu = vtu::document(&[], &drawing.points, &drawing.triangles, &points, &[]);
    let picture = picture::field(&drawing, &field);
    let mark = json::line(Some(scene), &BTreeMap::from([("scene", &scene.name)]));
    let files = [
        ("difference.svg", picture.as_bytes()),
        ("difference.vtu", &vtu),
        ("difference.json", mark.as_bytes()),
    ];
    files::write_all(folder, &files)?;
    Ok(true)
}
