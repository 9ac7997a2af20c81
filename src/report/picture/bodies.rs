//! The bodies of the mesh and the contact pair, and the legend to them.

use super::drawing::{Contact, Drawing};
use super::page::Sign;
use super::raster::{Raster, rgb};
use super::svg::{Coloured, Pixel, circle, group, polygons, segments};
use super::view::View;
use base::xml::Element;

/// The colours of the block, green, and of the stamp, yellow, as in fig. 4; then muted ones of
/// further bodies, in turn.
const BODIES: [&str; 6] = ["#9ccb9a", "#f4d35e", "#a9c1dc", "#dcb1ab", "#c3b3d9", "#cdc5b0"];

const TRIANGLE_EDGE: &str = "#4a4a4a";

const CONTACT_NODE: &str = "#1a1a1a";

const TARGET_EDGE: &str = "#c1272d";

/// Draws the triangles in the colours of their bodies, and the contact pair over them. Those of a
/// fine mesh are pixels, and its `outline` is drawn with them.
pub fn draw_bodies(drawing: &Drawing, outline: &[[usize; 2]], view: &View) -> Element {
    let pixels = view.all(&drawing.points);
    let width = if view.enlarged { 0.9 } else { 0.5 };
    let regions = 0..drawing.region_names.len();
    let contact = drawing.contact.as_ref().map(|contact| contact_pair(contact, view, &pixels));
    let triangles = if drawing.is_fine() {
        let outline = segments(outline, &pixels).stroke(TRIANGLE_EDGE, width);
        group().with(raster(drawing, view, &pixels)).with(outline)
    } else {
        let bodies = regions.map(|region| draw_body(drawing, region, view, &pixels));
        let triangles = group().stroke(TRIANGLE_EDGE, width).set("stroke-linejoin", "round");
        triangles.with_all(bodies)
    };
    group().with(triangles).with_all(contact)
}

pub fn legend(drawing: &Drawing) -> Vec<(Sign, String)> {
    let body = |(region, name): (usize, &String)| {
        let count = drawing.region.iter().filter(|of| **of == region).count();
        let plural = if count == 1 { "" } else { "s" };
        (Sign::Body(body_colour(region)), format!("{name} ({count} triangle{plural})"))
    };
    let mut entries: Vec<_> = drawing.region_names.iter().enumerate().map(body).collect();
    if let Some(Contact { nodes, edges }) = &drawing.contact {
        let (nodes, edges) = (nodes.len(), edges.len());
        entries.push((Sign::Node(CONTACT_NODE), format!("contact nodes ({nodes})")));
        entries.push((Sign::Edge(TARGET_EDGE), format!("target edges ({edges})")));
    }
    entries
}

fn draw_body(drawing: &Drawing, region: usize, view: &View, pixels: &[Pixel]) -> Element {
    polygons(seen(drawing, region, view, pixels)).fill(body_colour(region))
}

/// Draws the bodies one over the other as pixels.
fn raster(drawing: &Drawing, view: &View, pixels: &[Pixel]) -> Element {
    let mut raster = Raster::new(view.frame);
    for region in 0..drawing.region_names.len() {
        let colour = colour_of(region) as u8;
        seen(drawing, region, view, pixels).for_each(|corners| raster.triangle(corners, colour));
    }
    raster.image(&BODIES.map(rgb))
}

/// Returns the corners of the triangles of a region that can be seen.
fn seen<'a>(
    drawing: &'a Drawing,
    region: usize,
    view: &'a View,
    pixels: &'a [Pixel],
) -> impl Iterator<Item = [Pixel; 3]> + 'a {
    let own = drawing.triangles.iter().zip(&drawing.region);
    let own = own.filter(move |&(_, &of)| of == region);
    let corners = own.map(|(triangle, _)| triangle.map(|point| pixels[point]));
    corners.filter(|corners| view.shows(corners))
}

fn contact_pair(contact: &Contact, view: &View, pixels: &[Pixel]) -> Element {
    let [width, radius] = if view.enlarged { [3.0, 3.5] } else { [2.0, 1.5] };
    let nodes = contact.nodes.iter().map(|&node| circle(pixels[node], radius).fill(CONTACT_NODE));
    group().with(segments(&contact.edges, pixels).stroke(TARGET_EDGE, width)).with_all(nodes)
}

fn body_colour(region: usize) -> &'static str {
    BODIES[colour_of(region)]
}

/// Returns which of the colours of bodies a region has: the first two stand for one body each.
fn colour_of(region: usize) -> usize {
    if region < 2 { region } else { 2 + (region - 2) % (BODIES.len() - 2) }
}
