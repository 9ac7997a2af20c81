//! The contact pressure along the contact surface, several runs in one picture.

use super::numbers::{figure, quantity};
use super::picture::{Axis, Series, Style, chart, small_chart};
use engine::contact::ContactNode;
use engine::quantities::Value;
use engine::{Hertz, Quantity, Solution};
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
    if let Some(hertz) = hertz {
        captions.push(format!(
            "Hertz: half width {}, peak {}, relative radius {}.",
            figure(hertz.half_width, None),
            figure(hertz.peak, None),
            figure(hertz.radius, None)
        ));
    }
    let hertz = hertz.map(|hertz| hertz_curve(hertz, shown(runs)));
    along_surface(scene, runs, named("pressure"), hertz, &captions)
}

/// Draws the pressure of runs under their names, and `hertz`'s, among other pictures.
pub fn small_picture(scene: &Scene, runs: &[(String, &Solution)], hertz: Option<&Hertz>) -> String {
    let solutions: Vec<&Solution> = runs.iter().map(|(_, run)| *run).collect();
    let range = shown(&solutions);
    let curve = |(name, run): &(String, &Solution)| Series {
        name: name.clone(),
        ..curve(run, named("pressure"), range)
    };
    let hertz = hertz.map(|hertz| hertz_curve(hertz, range));
    let series: Vec<Series> = runs.iter().map(curve).chain(hertz).collect();
    let [x, y] = labels(scene, named("pressure"));
    small_chart(&y, [axis(&x), axis(&y)], &series)
}

/// Draws the shear and the gap of contact nodes in the same way.
pub fn shear_and_gap(scene: &Scene, runs: &[&Solution]) -> [String; 2] {
    ["shear", "gap"].map(|name| along_surface(scene, runs, named(name), None, &[]))
}

fn named(name: &str) -> &'static Quantity<ContactNode> {
    ContactNode::QUANTITIES.iter().find(|quantity| quantity.name == name).expect("it is declared")
}

/// Draws a quantity of contact nodes: a curve of each run, and one more.
fn along_surface(
    scene: &Scene,
    runs: &[&Solution],
    drawn: &Quantity<ContactNode>,
    more: Option<Series>,
    captions: &[String],
) -> String {
    let range = shown(runs);
    let series: Vec<Series> = runs.iter().map(|run| curve(run, drawn, range)).chain(more).collect();
    let [x, y] = labels(scene, drawn);
    let title = format!("{}: {}", scene.title, drawn.title);
    chart(&title, [axis(&x), axis(&y)], &series, captions)
}

/// Returns what the axes show.
fn labels(scene: &Scene, drawn: &Quantity<ContactNode>) -> [String; 2] {
    [
        quantity("distance along the contact surface", &scene.units.length),
        quantity(drawn.title, drawn.unit.in_scene(&scene.units)),
    ]
}

fn axis(label: &str) -> Axis<'_> {
    Axis { label, logarithmic: false }
}

/// Returns the stretch of the surface that any run has in contact, with a margin; all of it where
/// none has. Lengths along the surface.
fn shown(runs: &[&Solution]) -> [f64; 2] {
    let nodes = || runs.iter().flat_map(|run| &run.contact);
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

fn curve(run: &Solution, drawn: &Quantity<ContactNode>, [from, to]: [f64; 2]) -> Series {
    let shown = run.contact.iter().filter(|c| from <= c.arc && c.arc <= to);
    let point = |c: &ContactNode| match (drawn.value)(c) {
        Value::Number(y) => Some([c.arc, y]),
        Value::Unknown
        | Value::Count(_)
        | Value::Components(_)
        | Value::State(..)
        | Value::Words(_) => None,
    };
    Series { name: name(run), points: shown.filter_map(point).collect(), style: Style::Dotted }
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

fn hertz_curve(hertz: &Hertz, [from, to]: [f64; 2]) -> Series {
    let ends = [hertz.centre - hertz.half_width, hertz.centre + hertz.half_width];
    let (from, to) = (from.max(ends[0]), to.min(ends[1]));
    let arc = |k: usize| from + (to - from) * k as f64 / (POINTS - 1) as f64;
    Series {
        name: "Hertz".into(),
        points: (0..POINTS).map(|k| [arc(k), hertz.pressure(arc(k))]).collect(),
        style: Style::Line,
    }
}
