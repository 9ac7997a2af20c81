//! The bodies of the mesh and the contact pair, and the legend to them.

use std::collections::BTreeMap;

use super::page::Sign;
use super::svg::{Paint, Pixel, circle, group, polygon, segments};
use super::view::View;
use super::{Contact, Drawing};
use crate::report::xml::Element;

/// Green block and yellow stamp, as in fig. 4; then muted colours for any further body, in turn.
const BLOCK_AND_STAMP: [&str; 2] = ["#9ccb9a", "#f4d35e"];
const FURTHER_BODIES: [&str; 4] = ["#a9c1dc", "#dcb1ab", "#c3b3d9", "#cdc5b0"];
const TRIANGLE_EDGE: &str = "#4a4a4a";
const CONTACT_NODE: &str = "#1a1a1a";
const TARGET_EDGE: &str = "#c1272d";

/// The triangles in the colours of their bodies, and the contact pair over them.
pub fn draw_bodies(drawing: &Drawing, view: &View) -> Element {
    let pixels = view.all(drawing.points);
    let width = if view.enlarged { 0.9 } else { 0.5 };
    let bodies =
        regions(drawing).into_keys().map(|region| draw_body(drawing, region, view, &pixels));
    let contact = drawing.contact.as_ref().map(|contact| contact_pair(contact, view, &pixels));
    let triangles =
        group().stroke(TRIANGLE_EDGE, width).set("stroke-linejoin", "round").with_all(bodies);
    group().with(triangles).with_all(contact)
}

/// The signs of the picture and their words.
pub fn legend(drawing: &Drawing) -> Vec<(Sign, String)> {
    let mut entries: Vec<_> = regions(drawing)
        .into_iter()
        .map(|(region, count)| {
            (Sign::Body(body_colour(region)), body_in_words(drawing, region, count))
        })
        .collect();
    if let Some(contact) = &drawing.contact {
        entries
            .push((Sign::Node(CONTACT_NODE), format!("contact nodes ({})", contact.nodes.len())));
        entries.push((Sign::Edge(TARGET_EDGE), format!("target edges ({})", contact.edges.len())));
    }
    entries
}

fn draw_body(drawing: &Drawing, region: usize, view: &View, pixels: &[Pixel]) -> Element {
    let triangles = drawing.triangles.iter().zip(drawing.region).filter(|&(_, &of)| of == region);
    let corners = triangles.map(|(triangle, _)| triangle.map(|point| pixels[point]));
    let seen = corners.filter(|corners| view.shows(corners));
    group().fill(body_colour(region)).with_all(seen.map(|corners| polygon(&corners)))
}

fn contact_pair(contact: &Contact, view: &View, pixels: &[Pixel]) -> Element {
    let [width, radius] = if view.enlarged { [3.0, 3.5] } else { [2.0, 1.5] };
    let nodes = contact.nodes.iter().map(|&node| circle(pixels[node], radius).fill(CONTACT_NODE));
    group().with(segments(contact.edges, pixels).stroke(TARGET_EDGE, width)).with_all(nodes)
}

fn body_in_words(drawing: &Drawing, region: usize, count: usize) -> String {
    let name = drawing.region_names.get(region).map_or("body", String::as_str);
    let plural = if count == 1 { "" } else { "s" };
    format!("{name} ({count} triangle{plural})")
}

/// The regions in use, and how many triangles each has.
fn regions(drawing: &Drawing) -> BTreeMap<usize, usize> {
    let mut counts = BTreeMap::new();
    for &region in drawing.region {
        *counts.entry(region).or_insert(0) += 1;
    }
    counts
}

fn body_colour(region: usize) -> &'static str {
    match BLOCK_AND_STAMP.get(region) {
        Some(colour) => colour,
        None => FURTHER_BODIES[(region - BLOCK_AND_STAMP.len()) % FURTHER_BODIES.len()],
    }
}
