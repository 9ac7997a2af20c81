//! The contact pressure along the contact surface, several runs in one picture.

use super::numbers::{figure, quantity};
use super::picture::{Axis, Series, Style, chart, small_chart};
use engine::contact::ContactNode;
use engine::quantities::Value;
use engine::{Hertz, Solution};
use problem::modelling::Variant;
use problem::scene::Scene;

/// How far the picture reaches beyond the outermost node in contact, over the contact's width.
const MARGIN: f64 = 0.25;

/// How many points Hertz's curve is drawn through.
const POINTS: usize = 101;

/// Draws the contact pressure against the distance along the undeformed contact surface: a curve of
/// each run, and `hertz`'s.
pub fn picture(scene: &Scene, runs: &[&Solution], hertz: Option<&Hertz>) -> String {
    let mut captions = vec![String::from(
        "Pressure of a node: the reaction of its equations, K u − F, along the target's normal, \
         over the length that the node stands for.",
    )];
    captions.extend(hertz.map(|hertz| {
        let [width, peak, radius] =
            [hertz.half_width, hertz.peak, hertz.radius].map(|x| figure(x, None));
        format!("Hertz: half width {width}, peak {peak}, relative radius {radius}.")
    }));
    along_surface(scene, &named(runs), "pressure", hertz, Some(&captions))
}

/// Draws the pressure of runs under their names, and `hertz`'s, among other pictures.
pub fn small_picture(scene: &Scene, runs: &[(String, &Solution)], hertz: Option<&Hertz>) -> String {
    along_surface(scene, runs, "pressure", hertz, None)
}

/// Draws the shear and the gap of contact nodes in the same way.
pub fn shear_and_gap(scene: &Scene, runs: &[&Solution]) -> [String; 2] {
    ["shear", "gap"].map(|drawn| along_surface(scene, &named(runs), drawn, None, Some(&[])))
}

fn named<'a>(runs: &[&'a Solution]) -> Vec<(String, &'a Solution)> {
    runs.iter().map(|run| (name(run), *run)).collect()
}

/// Draws the quantity of contact nodes that has this name: a curve of each run, and `hertz`'s. A picture
/// without captions stands among others.
fn along_surface(
    scene: &Scene,
    runs: &[(String, &Solution)],
    drawn: &str,
    hertz: Option<&Hertz>,
    captions: Option<&[String]>,
) -> String {
    let mut quantities = ContactNode::QUANTITIES.iter();
    let drawn = quantities.find(|quantity| quantity.name == drawn).expect("it is declared");
    let [from, to] = shown(runs);
    let mut series = Vec::new();
    for (name, run) in runs {
        let mut points = Vec::new();
        for node in run.contact.iter().filter(|c| from <= c.arc && c.arc <= to) {
            if let Value::Number(y) = (drawn.value)(node) {
                points.push([node.arc, y]);
            }
        }
        series.push(Series { name: name.clone(), points, style: Style::Dotted });
    }
    series.extend(hertz.map(|hertz| {
        let from = from.max(hertz.centre - hertz.half_width);
        let to = to.min(hertz.centre + hertz.half_width);
        let arc = |k: usize| from + (to - from) * k as f64 / (POINTS - 1) as f64;
        let points = (0..POINTS).map(|k| [arc(k), hertz.pressure(arc(k))]).collect();
        Series { name: "Hertz".into(), points, style: Style::Line }
    }));
    let labels = [
        quantity("distance along the contact surface", &scene.units.length),
        quantity(drawn.title, drawn.unit.in_scene(&scene.units)),
    ];
    let axes = labels.each_ref().map(|label| Axis { label, logarithmic: false });
    match captions {
        Some(captions) => {
            chart(&format!("{}: {}", scene.title, drawn.title), axes, &series, captions)
        }
        None => small_chart(&labels[1], axes, &series),
    }
}

/// Returns the stretch of the surface that any run has in contact, with a margin; all of it where
/// none has. Lengths along the surface.
fn shown(runs: &[(String, &Solution)]) -> [f64; 2] {
    let nodes = || runs.iter().flat_map(|(_, run)| &run.contact);
    let extent = |nodes: &mut dyn Iterator<Item = &ContactNode>| {
        nodes.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| [a.min(c.arc), b.max(c.arc)])
    };
    let [from, to] = extent(&mut nodes().filter(|c| c.in_contact));
    if from < to {
        let margin = MARGIN * (to - from);
        [from - margin, to + margin]
    } else {
        extent(&mut nodes())
    }
}

/// Names the run by its variant, and by how contact was modelled where the variant leaves a choice.
pub fn name(run: &Solution) -> String {
    let (variant, contact) = (run.request.variant, run.request.contact);
    match variant {
        Variant::Printed => variant.to_string(),
        Variant::Tied | Variant::Stepped => format!("{variant}, {}", contact.coupling),
        Variant::Unilateral => {
            format!("{variant}, {}, friction {}", contact.coupling, contact.friction)
        }
    }
}
