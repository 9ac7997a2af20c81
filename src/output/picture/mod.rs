//! Pictures as SVG: the mesh (the paper's fig. 4), a field on the deformed mesh (fig. 5), charts.
//!
//! | module        | what it holds                                      |
//! |---------------|----------------------------------------------------|
//! | `drawing`     | what the pictures of a mesh draw on                |
//! | `bodies`      | what the mesh's panels and legend show             |
//! | `fields`      | a field on the deformed mesh                       |
//! | `chart`       | curves over one axis                               |
//! | `page`        | layout: title, panels, legend, captions            |
//! | `colour`      | values to colours, and the colour bar              |
//! | `raster`      | triangles of a fine mesh as pixels                 |
//! | `view`        | the mesh's coordinates to pixels                   |
//! | `svg`         | shapes, on top of the XML writer                   |

use std::collections::BTreeSet;

mod bodies;
mod chart;
pub mod colour;
mod drawing;
mod fields;
pub mod page;
mod raster;
pub mod svg;
pub mod view;

pub use self::chart::{Axis, SERIES, Series, Style, chart, small_chart};
pub use self::drawing::{Contact, Drawing, MOST_SHAPES, boundary_edges};
pub use self::fields::field;

use self::bodies::{draw_bodies, legend};
use self::colour::{ColourScale, SHADES, parts};
use self::page::Page;
use self::raster::Raster;
use self::svg::{Anchor, Coloured, DARK, Pixel, group, segments, text};
use self::view::{Bounds, View};
use base::xml::Element;

/// A contact zone that fills this part of the picture is not enlarged beside it.
const ENLARGED_UP_TO: f64 = 0.8;

/// The room for arrows, over the size of the mesh.
const ROOM: f64 = 0.07;

/// How much is shown about a contact surface, over its size.
const ABOUT: f64 = 0.15;

/// A mesh of more nodes has no numbers in its picture.
const MOST_NUMBERED: usize = 40;

/// Draws the mesh: its bodies, the contact nodes and the target edges.
pub fn mesh(drawing: &Drawing) -> String {
    mesh_on(Page::new(&drawing.title), drawing)
}

/// Draws the mesh among other pictures.
pub fn small_mesh(drawing: &Drawing) -> String {
    mesh_on(Page::small(&drawing.title), drawing)
}

fn mesh_on(mut page: Page, drawing: &Drawing) -> String {
    let outline = if drawing.is_fine() { boundary_edges(&drawing.triangles) } else { Vec::new() };
    // Arrows have room where they begin.
    let size = ROOM * Bounds::around(&drawing.points).larger_side();
    let start = |&(point, [fx, fy]): &(usize, [f64; 2])| {
        let ([x, y], force) = (drawing.points[point], f64::hypot(fx, fy));
        [x - size * fx / force, y - size * fy / force]
    };
    let shown: Vec<[f64; 2]> =
        drawing.points.iter().copied().chain(drawing.loaded.iter().map(start)).collect();
    put_panels(&mut page, drawing, &shown, |view| {
        let bodies = draw_bodies(drawing, &outline, view);
        if drawing.points.len() > MOST_NUMBERED {
            return bodies;
        }
        group().with(bodies).with(numbers(&drawing.triangles, &view.all(&drawing.points)))
    });
    page.legend(&legend(drawing));
    if drawing.is_fine() {
        page.paragraph(raster::CAPTION);
    }
    page.finish()
}

/// Writes the number of each point that is a corner of a triangle beside it.
fn numbers(triangles: &[[usize; 3]], pixels: &[Pixel]) -> Element {
    let number = |k: &usize| {
        let [x, y] = pixels[*k];
        text([x + 5.0, y - 5.0], Anchor::Start, &(k + 1).to_string())
    };
    let corners: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
    group().fill(DARK).with_all(corners.iter().map(number))
}

/// Returns what is shown of a mesh where its contact matters: the contact surface and what lies about it; the
/// whole where that is not much more.
fn around_contact(drawing: &Drawing) -> Bounds {
    let whole = Bounds::around(&drawing.points);
    let nodes = drawing.contact.as_ref().map_or(&[][..], |contact| &contact.nodes);
    if nodes.is_empty() {
        return whole;
    }
    let zone = Bounds::around(nodes.iter().map(|node| &drawing.points[*node]));
    let zone = zone.padded(ABOUT * zone.larger_side());
    if zone.larger_side() < ENLARGED_UP_TO * whole.larger_side() { zone } else { whole }
}

/// Draws a quantity of the triangles under several names side by side on the undeformed mesh, all in the
/// colours of one scale, as pixels.
pub fn beside(
    drawing: &Drawing,
    quantity: &str,
    unit: &str,
    fields: &[(String, Vec<f64>)],
) -> String {
    let mut page = if fields.len() > 2 { Page::new(quantity) } else { Page::small(quantity) };
    let all: Vec<f64> = fields.iter().flat_map(|(_, values)| values.iter().copied()).collect();
    let scale = ColourScale::from_values(&all);
    let outline = boundary_edges(&drawing.triangles);
    let views = page.repeated(&around_contact(drawing), fields.len());
    for ((name, values), view) in fields.iter().zip(&views) {
        let [x, y] = view.frame.corner;
        let pixels = view.all(&drawing.points);
        let mut raster = Raster::new(view.frame);
        for (triangle, value) in drawing.triangles.iter().zip(values) {
            raster.triangle(triangle.map(|point| pixels[point]), scale.part(*value, SHADES));
        }
        page.put(text([x, y - 8.0], Anchor::Start, name));
        page.put(raster.image(&parts(SHADES)));
        let seen = |edge: &&[usize; 2]| edge.iter().all(|end| view.shows(&[pixels[*end]]));
        let outline: Vec<[usize; 2]> = outline.iter().filter(seen).copied().collect();
        page.put(segments(&outline, &pixels).stroke(DARK, 0.8));
    }
    let lowest = views.iter().map(|view| view.frame.corner[1] + view.frame.size[1]);
    page.y = lowest.fold(page.y, f64::max) + 4.0;
    page.colour_bar(&scale, quantity, unit);
    page.finish()
}

/// Puts the panels of a mesh whose points are drawn at `drawn`; where they were stays in sight.
fn put_panels(
    page: &mut Page,
    drawing: &Drawing,
    drawn: &[[f64; 2]],
    draw: impl Fn(&View) -> Element,
) {
    let whole = Bounds::around(drawing.points.iter().chain(drawn));
    let contact = drawing.contact.as_ref().filter(|contact| !contact.nodes.is_empty());
    let zone = contact.map(|contact| {
        let nodes = contact.nodes.iter();
        let tight = Bounds::around(nodes.flat_map(|&node| [&drawing.points[node], &drawn[node]]));
        tight.padded(0.12 * tight.larger_side().max(0.1 * whole.larger_side()))
    });
    let zone = zone.filter(|zone| zone.larger_side() < ENLARGED_UP_TO * whole.larger_side());
    page.panels(&whole, zone.as_ref(), &drawing.length_unit, draw);
}
