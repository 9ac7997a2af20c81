//! What is known of an equilibrium: whether there are others, and what the couplings overlook.

use super::result::place;
use crate::layout::{counted, listed};
use crate::model::Report;
use crate::numbers::{percent, short, six_digits, with_unit};
use engine::contact::{InitialGaps, Surfaces};
use engine::{Equilibrium, Overlap, Solution, Uniqueness, beyond_range};
use problem::model::{Model, NodeId};
use problem::modelling::{Coupling, Geometry};
use problem::scene::Units;

/// Says whether the equilibrium is the only one, and where bodies lie in each other.
pub fn lines(solution: &Solution, found: &Equilibrium) -> Report {
    let length = |x: f64| with_unit(&short(x), &solution.request.scene.units.length);
    let springs = found.springs.map(|carried| {
        format!(
            "Found on springs, which hold the bodies on the way: in the end they carry at most \
             {carried:.0e} of the largest force"
        )
    });
    let unseen = found.unseen.map(|(node, depth)| {
        format!(
            "Coupling {} watches contact nodes only: target node {node} lies {} inside the \
             contact surface; mortar sees it",
            solution.request.contact.coupling,
            length(depth)
        )
    });
    let inside = found.inside.map(|(node, depth)| {
        let contact = solution.request.contact;
        let why = match (contact.coupling, contact.geometry) {
            (Coupling::Mortar, _) => ": mortar closes the averaged gap of the edges at a node",
            (Coupling::Nts, Geometry::Initial) => {
                ": gaps were closed along the normals of the initial shape"
            }
            (Coupling::Nts, Geometry::Current) => "",
        };
        format!(
            "Contact node {node} lies {} INSIDE THE TARGET in the shape reached{why}",
            length(depth)
        )
    });
    let facets = found.facets.map(|[height, least]| {
        if solution.touches_nothing() {
            return format!(
                "NOTE: no node is in contact, but the edges of a curved surface are facets, up to {} off its arc, and the \
                 smallest gap left is {}: the facets alone may keep the bodies apart; refine the surfaces",
                length(height),
                length(least)
            );
        }
        let part = match height < least {
            true => format!("of which that is {}", percent(height / least)),
            false => "less than that, so that the mesh decides it".into(),
        };
        format!(
            "NOTE: the edges of a curved surface in contact are facets, up to {} off its arc; the gaps or overlaps that \
             contact closes differ by {} before any load, {part}; peak pressures may be far off, and no error estimate \
             counts it; refine the surfaces",
            length(height),
            length(least)
        )
    });
    let lines = [springs, unseen, inside, facets].into_iter().flatten();
    lines.fold(uniqueness(solution, &found.uniqueness), Report::note)
}

fn uniqueness(solution: &Solution, found: &Uniqueness) -> Report {
    let mut found_others = &[][..];
    let words = match found {
        Uniqueness::Unique => {
            let none = "the only one, of equations that leave out what the first line says,";
            let of = if solution.doubt().is_some() { none } else { "the only one" };
            let model = &solution.request.scene.model;
            let why = if model.has_contact() { "convex, no friction" } else { "no contact" };
            format!("{of} in the shape reached ({why})")
        }
        Uniqueness::Indifferent { node } => format!(
            "NOT THE ONLY ONE: node {node} can move without work, as contacts that carry nothing may \
             open"
        ),
        Uniqueness::Unknown { node: None } => {
            "whether it is the only one is unknown: contact in the current shape is not \
             convex"
                .into()
        }
        Uniqueness::Unknown { node: Some(node) } => format!(
            "whether it is the only one is not known; node {node} can move without work as long as \
             the normals of contact stay as they are"
        ),
        Uniqueness::Tried { states, steps, all, last_only, others } => {
            found_others = &others[..];
            let steps = match last_only {
                true => "last step".into(),
                false => counted(*steps, "step of the load", "steps of the load"),
            };
            let tried = match all {
                true => format!("trying all other contact states ({states}, {steps})"),
                false => {
                    format!("changing the contact state of any one node ({states} tried, {steps})")
                }
            };
            match others.len() {
                0 => format!("{tried} gives no other equilibrium"),
                n => format!("NOT THE ONLY ONE: {tried} gives {n} more"),
            }
        }
    };
    let nodes = |nodes: &[NodeId]| match nodes {
        [] => "none".into(),
        nodes => format!("nodes {}", listed(nodes)),
    };
    let others = found_others.iter().map(|other| {
        format!(
            "at load {}: stick {}; slip {}: displacement components change by at most {}",
            six_digits(other.load),
            nodes(&other.stick),
            nodes(&other.slip),
            with_unit(&short(other.change), &solution.request.scene.units.length)
        )
    });
    Report::default().note(format!("Equilibrium: {words}")).details(others)
}

/// Says what is unusual about the gaps before any load.
pub fn initial_gaps(model: &Model, units: &Units) -> Option<String> {
    let length = |x: f64| with_unit(&short(x), &units.length);
    Some(match Surfaces::new(model).ok()?.initial_gaps(model)? {
        InitialGaps::Overlap(Overlap { nodes, node, depth, facet_height }) => {
            let lie = if nodes == 1 { "node lies" } else { "nodes lie" };
            let facets = match facet_height > 0.0 {
                true => {
                    format!(" (facets of curved surfaces account for {})", length(facet_height))
                }
                false => String::new(),
            };
            format!(
                "NOTE: before any load {nodes} contact {lie} inside the target, the deepest {} at node {node}{facets}: an \
                 interference fit, or a mistake of the drawing",
                length(depth)
            )
        }
        InitialGaps::Apart { node, gap } => format!(
            "NOTE: before any load the bodies lie far apart: the smallest gap is {}, at node {node}, more than a tenth of \
             the smaller body",
            length(gap)
        ),
    })
}

/// Says that triangles are turned inside out, or bodies lie in each other where contact does not watch them;
/// None where neither is so.
pub fn overlap(solution: &Solution) -> Option<String> {
    if solution.is_inside_out() {
        let beyond = beyond_range(&solution.model, &solution.elements, &solution.u)?;
        return Some(format!(
            "TRIANGLES ARE TURNED INSIDE OUT: all figures are those of bodies that cannot have this shape: {beyond}"
        ));
    }
    let Overlap { nodes, node, depth, facet_height } = *solution.overlap.as_ref()?;
    let length = |x: f64| with_unit(&short(x), &solution.request.scene.units.length);
    let others = match nodes {
        1 => String::new(),
        nodes => format!(", the deepest of {nodes} nodes of outlines"),
    };
    let (outside, fix) = match solution.model.has_contact() {
        true => (
            " outside the groups of contact",
            "extend the groups of contact beyond where the bodies meet",
        ),
        false => (", and the scene has no contact", "give it the contact between them"),
    };
    let beside = match facet_height > 0.0 {
        true => format!(" (its facets account for {})", length(facet_height)),
        false => String::new(),
    };
    Some(format!(
        "BODIES LIE IN EACH OTHER{outside}: {}{others}, lies {} inside another body{beside}; nothing keeps them apart \
         there, so that all figures are those of bodies that pass through each other; {fix}",
        place(solution, node),
        length(depth)
    ))
}
