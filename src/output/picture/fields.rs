//! A field on the deformed mesh, and what is said under it.

use super::colour::{COLOURS, ColourScale, parts, with_unit};
use super::drawing::{Drawing, boundary_edges};
use super::page::Page;
use super::raster::{CAPTION, Raster};
use super::svg::{Coloured, circle, group, path, polygon, segments};
use super::view::Bounds;
use crate::numbers::{nearest_round, significant};
use numbers::largest::largest;

const OUTLINE: &str = "#111111";

const UNDEFORMED_OUTLINE: &str = "#b5b5b5";

/// The largest displacement as it is drawn, about, as a part of the picture's size.
const DRAWN_DISPLACEMENT: f64 = 0.035;

/// Draws the `values` of a quantity on the mesh deformed by the `displacement` of each point, one flat colour per
/// triangle. The unit is `""` where the scene names none, and `"1"` of a quantity without dimension.
///
/// # Panics
///
/// If there is not one value per triangle and one displacement per point, all finite.
pub fn field(
    drawing: &Drawing,
    quantity: &str,
    unit: &str,
    values: &[f64],
    displacement: &[[f64; 2]],
) -> String {
    let Drawing { points, triangles, .. } = drawing;
    assert_eq!(values.len(), triangles.len(), "one value per triangle");
    assert_eq!(displacement.len(), points.len(), "one displacement per point");
    let is_finite = values.iter().chain(displacement.as_flattened()).all(|x| x.is_finite());
    assert!(is_finite, "a picture needs finite numbers");

    // The deformation is enlarged by a round number.
    let farthest = displacement.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    let size = Bounds::around(points).larger_side();
    let times = match farthest {
        0.0 => 1.0,
        farthest => {
            let ratio = size / farthest * DRAWN_DISPLACEMENT;
            nearest_round(ratio.clamp(1e-300, 1e300))
        }
    };
    let moved = points.iter().zip(displacement);
    let deformed: Vec<[f64; 2]> =
        moved.map(|(point, u)| [0, 1].map(|axis| point[axis] + times * u[axis])).collect();

    // The extremes are in the middle of a triangle.
    let scale = ColourScale::from_values(values);
    let [smallest, largest] = [-1.0, 1.0]
        .map(|sign| largest(values.iter().map(|x| sign * x)).expect("at least one triangle"));
    let middle = |triangle: usize, places: &[[f64; 2]]| -> [f64; 2] {
        let corners = triangles[triangle].map(|point| places[point]);
        [0, 1].map(|axis| corners.iter().map(|corner| corner[axis] / 3.0).sum())
    };

    let boundary = boundary_edges(triangles);
    // The stamp over the block.
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by_key(|&triangle| drawing.region[triangle]);
    let mut page = Page::new(&format!("{}: {quantity}", drawing.title));
    super::put_panels(&mut page, drawing, &deformed, |view| {
        let [before, after] = [points, &deformed].map(|points| view.all(points));
        let seen = order.iter().map(|&k| (k, triangles[k].map(|point| after[point])));
        let seen = seen.filter(|(_, corners)| view.shows(corners));
        let mut drawn = group();
        if drawing.is_fine() {
            let mut raster = Raster::new(view.frame);
            seen.for_each(|(k, corners)| raster.triangle(corners, scale.part(values[k], COLOURS)));
            drawn.push(raster.image(&parts(COLOURS)));
        } else {
            // In its colour along its edges too, so that no white shows between two triangles.
            let shapes = seen.map(|(k, corners)| {
                let colour = scale.colour(values[k]);
                polygon(&corners).fill(&colour).set("stroke", colour)
            });
            let coloured = group().set("stroke-width", "0.8").set("stroke-linejoin", "round");
            drawn.push(coloured.with_all(shapes));
            if view.enlarged {
                let rings = triangles.iter().map(|&[a, b, c]| [a, b, c, a].map(|k| after[k]));
                let grid = path(rings.filter(|ring| view.shows(ring)));
                drawn.push(grid.stroke("#000000", 0.5).set("stroke-opacity", "0.25"));
            }
        }
        drawn.push(segments(&boundary, &before).stroke(UNDEFORMED_OUTLINE, 0.8));
        let width = if view.enlarged { 1.6 } else { 1.1 };
        drawn.push(segments(&boundary, &after).stroke(OUTLINE, width));
        if !scale.is_uniform() {
            // White under the red: it stands out from any colour.
            let at = middle(largest.first, &after);
            let ring = |colour, width| circle(at, 7.0).fill("none").stroke(colour, width);
            drawn.push(group().with(ring("#ffffff", 4.5)).with(ring("#d4001a", 2.2)));
        }
        drawn
    });
    page.colour_bar(&scale, quantity, unit);

    let [least, most] =
        [smallest, largest].map(|found| scale.value_in_words(values[found.first], unit));
    let place = |place: [f64; 2]| {
        let [x, y] = place.map(|x| significant(if x.abs() < 1e-6 * size { 0.0 } else { x }, 4));
        // No-break spaces: a line must not end with the sign.
        format!("x\u{a0}=\u{a0}{x}, y\u{a0}=\u{a0}{}", with_unit(&y, &drawing.length_unit))
    };
    let others = |count: usize| match count {
        0 => String::new(),
        1 => " and in 1 other triangle".into(),
        _ => format!(" and in {count} other triangles"),
    };
    page.paragraph(&match scale.is_uniform() {
        true => format!("The value is the same in every triangle: {most}."),
        false => format!(
            "Largest value {most} at {} (red circle){}; smallest value {least} at {}{}.",
            place(middle(largest.first, points)),
            others(largest.others),
            place(middle(smallest.first, points)),
            others(smallest.others)
        ),
    });
    page.paragraph(&format!(
        "Deformation × {} (largest displacement {}). Dark line: deformed outline; thin light line: undeformed outline.",
        significant(times, 1),
        with_unit(&significant(farthest, 4), &drawing.length_unit)
    ));
    if drawing.contact.is_some() && times != 1.0 {
        page.paragraph(
            "Displacements are magnified, gaps are not: bodies that overlap here need not do so in the calculation.",
        );
    }
    page.paragraph(
        "One flat colour per triangle: the value is constant within an element, and nothing is smoothed.",
    );
    if drawing.is_fine() {
        page.paragraph(CAPTION);
    }
    page.finish()
}
