//! The bodies of the mesh and the contact pair, and the legend to them.

use super::drawing::{Contact, Drawing};
use super::page::Sign;
use super::svg::{Pixel, circle, group, polygon, segments};
use super::view::View;
use crate::report::xml::Element;

/// The colours of the block, green, and of the stamp, yellow, as in fig. 4.
const BLOCK_AND_STAMP: [&str; 2] = ["#9ccb9a", "#f4d35e"];

/// The muted colours of further bodies, in turn.
const FURTHER_BODIES: [&str; 4] = ["#a9c1dc", "#dcb1ab", "#c3b3d9", "#cdc5b0"];

const TRIANGLE_EDGE: &str = "#4a4a4a";

const CONTACT_NODE: &str = "#1a1a1a";

const TARGET_EDGE: &str = "#c1272d";

/// Draws the triangles in the colours of their bodies, and the contact pair over them.
pub fn draw_bodies(drawing: &Drawing, view: &View) -> Element {
    let pixels = view.all(&drawing.points);
    let width = if view.enlarged { 0.9 } else { 0.5 };
    let regions = 0..drawing.region_names.len();
    let bodies = regions.map(|region| draw_body(drawing, region, view, &pixels));
    let contact = drawing.contact.as_ref().map(|contact| contact_pair(contact, view, &pixels));
    let triangles = group().stroke(TRIANGLE_EDGE, width).set("stroke-linejoin", "round");
    group().with(triangles.with_all(bodies)).with_all(contact)
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
    let triangles = drawing.triangles.iter().zip(&drawing.region).filter(|&(_, &of)| of == region);
    let corners = triangles.map(|(triangle, _)| triangle.map(|point| pixels[point]));
    let seen = corners.filter(|corners| view.shows(corners));
    group().fill(body_colour(region)).with_all(seen.map(|corners| polygon(&corners)))
}

fn contact_pair(contact: &Contact, view: &View, pixels: &[Pixel]) -> Element {
    let [width, radius] = if view.enlarged { [3.0, 3.5] } else { [2.0, 1.5] };
    let nodes = contact.nodes.iter().map(|&node| circle(pixels[node], radius).fill(CONTACT_NODE));
    group().with(segments(&contact.edges, pixels).stroke(TARGET_EDGE, width)).with_all(nodes)
}

fn body_colour(region: usize) -> &'static str {
    match BLOCK_AND_STAMP.get(region) {
        Some(colour) => colour,
        None => FURTHER_BODIES[(region - BLOCK_AND_STAMP.len()) % FURTHER_BODIES.len()],
    }
}
