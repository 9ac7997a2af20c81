//! The bodies of the mesh and the contact pair, and the legend to them.

use super::drawing::{Contact, Drawing};
use super::page::Sign;
use super::raster::{Raster, rgb};
use std::collections::BTreeSet;

use super::svg::{Coloured, Pixel, circle, group, line, polygon, polygons, segments};
use super::view::View;
use crate::layout::counted;
use base::xml::Element;

/// The colours of the block, green, and of the stamp, yellow, as in fig. 4; then muted ones of
/// further bodies, in turn.
const BODIES: [&str; 6] = ["#9ccb9a", "#f4d35e", "#a9c1dc", "#dcb1ab", "#c3b3d9", "#cdc5b0"];

const TRIANGLE_EDGE: &str = "#4a4a4a";

const CONTACT_NODE: &str = "#1a1a1a";

const TARGET_EDGE: &str = "#c1272d";

const RESTRAINT: &str = "#0072b2";

const LOAD: &str = "#7b3294";

/// Half the length of the bar of a restraint, the head of an arrow, and the longest shaft, pixels.
const BAR: f64 = 5.0;
const HEAD: f64 = 8.0;
const ARROW: f64 = 26.0;

/// Draws the triangles in the colours of their bodies, and the contact pair over them. Those of a
/// fine mesh are pixels, and its `outline` is drawn with them.
pub fn draw_bodies(drawing: &Drawing, outline: &[[usize; 2]], view: &View) -> Element {
    let pixels = view.all(&drawing.points);
    let width = if view.enlarged { 0.9 } else { 0.5 };
    // The corners of the triangles of a region that can be seen.
    let seen = |region: usize| {
        let own =
            drawing.triangles.iter().zip(&drawing.region).filter(move |(_, of)| **of == region);
        let corners = own.map(|(triangle, _)| triangle.map(|point| pixels[point]));
        corners.filter(|corners| view.shows(corners))
    };
    let regions = 0..drawing.region_names.len();
    let triangles = if drawing.is_fine() {
        let mut raster = Raster::new(view.frame);
        for region in regions {
            seen(region).for_each(|corners| raster.triangle(corners, colour_of(region) as u8));
        }
        let outline = segments(outline, &pixels).stroke(TRIANGLE_EDGE, width);
        group().with(raster.image(&BODIES.map(rgb))).with(outline)
    } else {
        let bodies = regions.map(|region| polygons(seen(region)).fill(BODIES[colour_of(region)]));
        let triangles = group().stroke(TRIANGLE_EDGE, width).set("stroke-linejoin", "round");
        triangles.with_all(bodies)
    };
    let contact = drawing.contact.as_ref().map(|contact| {
        let [width, radius] = if view.enlarged { [3.0, 3.5] } else { [2.0, 1.5] };
        let nodes = contact.nodes.iter().map(|&n| circle(pixels[n], radius).fill(CONTACT_NODE));
        let edges = segments(&contact.edges, &pixels).stroke(TARGET_EDGE, width);
        group().with(edges).with_all(nodes)
    });
    group()
        .with(triangles)
        .with_all(contact)
        .with(restraints(drawing, &pixels))
        .with(loads(drawing, &pixels))
}

/// Draws a bar across each direction along which a point is held.
fn restraints(drawing: &Drawing, pixels: &[Pixel]) -> Element {
    let bar = |&(point, [dx, dy]): &(usize, [f64; 2])| {
        let ([x, y], [across, along]) = (pixels[point], [-dy * BAR, -dx * BAR]);
        line([x - across, y - along], [x + across, y + along])
    };
    group().stroke(RESTRAINT, 2.0).with_all(drawing.held.iter().map(bar))
}

/// Draws an arrow that ends at each loaded point, the longer the larger the force.
fn loads(drawing: &Drawing, pixels: &[Pixel]) -> Element {
    let size = |[fx, fy]: [f64; 2]| fx.hypot(fy);
    let largest = drawing.loaded.iter().map(|(_, force)| size(*force)).fold(0.0, f64::max);
    let arrow = |&(point, force): &(usize, [f64; 2])| {
        let ([x, y], part) = (pixels[point], size(force) / largest);
        let [dx, dy] = [force[0] / size(force), -force[1] / size(force)];
        let back =
            |along: f64, across: f64| [x - along * dx - across * dy, y - along * dy + across * dx];
        let head = polygon(&[[x, y], back(HEAD, 0.4 * HEAD), back(HEAD, -0.4 * HEAD)]).fill(LOAD);
        group().with(line(back(HEAD + part * ARROW, 0.0), back(HEAD, 0.0))).with(head)
    };
    group().stroke(LOAD, 1.2).with_all(drawing.loaded.iter().map(arrow))
}

/// Returns the legend to the bodies and the contact pair.
pub fn legend(drawing: &Drawing) -> Vec<(Sign, String)> {
    let mut entries = Vec::new();
    for (region, name) in drawing.region_names.iter().enumerate() {
        let count = drawing.region.iter().filter(|of| **of == region).count();
        let words = format!("{name} ({})", counted(count, "triangle", "triangles"));
        entries.push((Sign::Body(BODIES[colour_of(region)]), words));
    }
    if let Some(Contact { nodes, edges }) = &drawing.contact {
        let (nodes, edges) = (nodes.len(), edges.len());
        entries.push((Sign::Node(CONTACT_NODE), format!("contact nodes ({nodes})")));
        entries.push((Sign::Edge(TARGET_EDGE), format!("target edges ({edges})")));
    }
    for (points, colour, name) in
        [(&drawing.held, RESTRAINT, "restraints"), (&drawing.loaded, LOAD, "loads")]
    {
        let nodes: BTreeSet<usize> = points.iter().map(|(point, _)| *point).collect();
        if !nodes.is_empty() {
            entries.push((
                Sign::Edge(colour),
                format!("{name} ({})", counted(nodes.len(), "node", "nodes")),
            ));
        }
    }
    entries
}

/// Returns which of the colours of bodies a region has: the first two stand for one body each.
fn colour_of(region: usize) -> usize {
    if region < 2 { region } else { 2 + (region - 2) % (BODIES.len() - 2) }
}
