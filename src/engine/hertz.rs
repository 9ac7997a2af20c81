//! Hertz's pressure for a scene whose surfaces meet the assumptions of Hertz's theory.
//!
//! ```text
//!   p(s) = p0 sqrt(1 − (s/a)²)    a² = 4 P R / (π E*)    p0 = 2 P / (π a)    1/E* = Σ (1 − ν²)/E
//! ```
//!
//! The gaps of the initial shape near the first point of contact yield R: g(s) = g0 + s²/(2R).
//!
//! Source: K. L. Johnson, *Contact Mechanics*, sections 4.2(c), eq. (4.43) to (4.45).

use std::f64::consts::PI;

use serde::Serialize;

use super::contact::{Pairing, Surfaces, arcs};
use super::solution::Solution;
use super::stretches::{Stretch, stretches};
use problem::element::Plane;
use problem::model::{Model, NodeId};
use problem::modelling::Coupling;

/// The allowed departure of gaps from the parabola, over its height at the edge of contact.
const PARABOLA: f64 = 0.05;

/// The half width over a radius, of both surfaces or relative, beyond which the theory does not apply.
const SHALLOW: f64 = 0.3;

/// The part of the load that other stretches of contact may carry.
const ALONE: f64 = 1e-3;

/// The least number of nodes in the half width that show its curve.
const FEWEST: usize = 3;

/// Hertz's contact of two cylinders along a line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hertz {
    /// The relative radius of the two surfaces, length.
    pub radius: f64,
    /// The half width of the contact, length.
    pub half_width: f64,
    /// The largest pressure, stress.
    pub peak: f64,
    /// The distance of that pressure along the contact surface, length.
    pub centre: f64,
}

impl Hertz {
    /// Returns Hertz's contact for the load that the contact surface of `solution` carries. None where the
    /// surfaces form no parabola there, the contact is too wide for the theory, as that of a pin in a hole of
    /// its size, or too few nodes lie in it.
    pub fn from_solution(solution: &Solution) -> Option<Self> {
        let Pressed { gaps, pairings, least, load, modulus, centre } = Pressed::of(solution)?;
        // The half width decides which gaps count for the radius, which decides the half width.
        let length = gaps[gaps.len() - 1].arc - gaps[0].arc;
        let mut half_width = 0.25 * length;
        let mut radius = 0.0;
        for _ in 0..20 {
            radius = fit(&gaps, centre, least, half_width)?;
            half_width = (4.0 * load * radius / (PI * modulus)).sqrt();
        }
        let contact = Hertz { radius, half_width, peak: 2.0 * load / (PI * half_width), centre };
        // Flat surfaces, whose radius is rounding, touch up to their ends.
        let is_shallow = half_width < length.min(SHALLOW * radius)
            && contact.turn(&solution.model, &gaps, &pairings) < 2.0 * SHALLOW;
        (is_shallow && contact.fits(&gaps, least)).then_some(contact)
    }

    /// Returns Hertz's contact of surfaces whose relative radius is known, where chords are too coarse to
    /// show it, about the centre of the contact forces of `solution`.
    pub fn of_radius(solution: &Solution, radius: f64) -> Option<Self> {
        let Pressed { load, modulus, .. } = Pressed::of(solution)?;
        let moments = solution.in_contact().filter_map(|c| Some(c.force? * c.arc));
        let centre = moments.sum::<f64>() / normal_load(solution)?;
        let half_width = (4.0 * load * radius / (PI * modulus)).sqrt();
        Some(Hertz { radius, half_width, peak: 2.0 * load / (PI * half_width), centre })
    }

    /// Returns the pressure at distance `arc` along the contact surface, stress.
    pub fn pressure(&self, arc: f64) -> f64 {
        let s = (arc - self.centre) / self.half_width;
        self.peak * (1.0 - s * s).max(0.0).sqrt()
    }

    /// Returns the angle by which the surface that turns more does so within the contact: its width over its
    /// radius.
    fn turn(&self, model: &Model, gaps: &[Gap], pairings: &[Option<Pairing>]) -> f64 {
        let within = gaps.iter().filter(|g| (g.arc - self.centre).abs() <= self.half_width);
        let entries: Vec<usize> = within.map(|gap| gap.entry).collect();
        let place = |entry: &usize| model.coordinates(model.contact.nodes[*entry]);
        let along: Vec<[f64; 2]> = entries
            .windows(2)
            .map(|ends| [0, 1].map(|d| place(&ends[1])[d] - place(&ends[0])[d]))
            .collect();
        let normals = entries.iter().filter_map(|entry| Some(pairings[*entry].as_ref()?.normal));
        let turns = |directions: &[[f64; 2]]| {
            let angle = |pair: &[[f64; 2]]| {
                let ([ax, ay], [bx, by]) = (pair[0], pair[1]);
                (ax * by - ay * bx).atan2(ax * bx + ay * by).abs()
            };
            directions.windows(2).map(angle).sum::<f64>()
        };
        turns(&along).max(turns(&normals.collect::<Vec<_>>()))
    }

    fn fits(&self, gaps: &[Gap], least: f64) -> bool {
        let height = self.half_width * self.half_width / (2.0 * self.radius);
        let within = gaps.iter().filter(|g| (g.arc - self.centre).abs() <= self.half_width);
        let departure = |g: &Gap| {
            let s = g.arc - self.centre;
            (g.gap - least - s * s / (2.0 * self.radius)).abs()
        };
        within.clone().count() >= FEWEST
            && within.map(departure).fold(0.0, f64::max) <= PARABOLA * height
    }
}

/// What Hertz's theory takes from a solution.
struct Pressed {
    gaps: Vec<Gap>,
    /// What each contact node faces in the initial shape.
    pairings: Vec<Option<Pairing>>,
    /// The least gap, length.
    least: f64,
    /// The force across the contact, over the thickness.
    load: f64,
    /// E*, stress.
    modulus: f64,
    /// The first point of contact along the contact surface, length.
    centre: f64,
}

impl Pressed {
    fn of(solution: &Solution) -> Option<Self> {
        let model = &*solution.model;
        let surfaces = Surfaces::new(model).ok()?;
        let pairings = surfaces.pairings(Coupling::Nts, &model.nodes);
        let gaps = gaps(model, &pairings);
        let first = gaps.iter().min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        // Where the first point of contact is at the end of what faces the target, that is half of a
        // symmetric scene, which carries half the load, or the edge of a body.
        let at_an_end =
            [&gaps[0], &gaps[gaps.len() - 1]].iter().any(|end| end.entry == first.entry);
        let on_line = surfaces.ends_on_symmetry(model.contact.nodes[first.entry]);
        let sides = match (at_an_end, on_line) {
            (false, _) => 1.0,
            (true, true) => 2.0,
            (true, false) => return None,
        };
        let load = sides * normal_load(solution)? / model.thickness;
        let modulus = modulus(model, pairings[first.entry].as_ref()?)?;
        let (least, centre) = (first.gap, first.arc);
        Some(Pressed { gaps, pairings, least, load, modulus, centre })
    }
}

/// The position and gap of a contact node in the initial shape.
struct Gap {
    /// Its index in the contact surface.
    entry: usize,
    arc: f64,
    gap: f64,
}

fn gaps(model: &Model, pairings: &[Option<Pairing>]) -> Vec<Gap> {
    let faced = pairings.iter().zip(arcs(model)).enumerate();
    let gap = |(entry, (p, arc)): (usize, (&Option<Pairing>, f64))| {
        p.as_ref().map(|p| Gap { entry, arc, gap: p.gap })
    };
    faced.filter_map(gap).collect()
}

/// Returns the relative radius from the gaps within `reach` of `centre` by least squares, length;
/// None where the gaps do not open.
fn fit(gaps: &[Gap], centre: f64, least: f64, reach: f64) -> Option<f64> {
    let within = gaps.iter().filter(|g| (g.arc - centre).abs() <= reach);
    let (mut above, mut below) = (0.0, 0.0);
    for g in within {
        let square = (g.arc - centre).powi(2);
        above += square * square;
        below += square * (g.gap - least);
    }
    (below > 0.0 && above > 0.0).then(|| above / (2.0 * below))
}

/// Returns the sum of the normal forces of the contact nodes, force; None where they do not press, or not in
/// one unbroken stretch.
fn normal_load(solution: &Solution) -> Option<f64> {
    let all = solution.pressed();
    let of = |stretch: &Stretch| {
        let own = solution.in_contact().filter(|c| stretch.nodes.contains(&c.node));
        own.filter_map(|c| c.force).sum::<f64>()
    };
    let most = stretches(solution).iter().map(of).fold(0.0, f64::max);
    (all > 0.0 && most > (1.0 - ALONE) * all).then_some(all)
}

/// Returns E* of the two materials at a contact node, stress.
fn modulus(model: &Model, pairing: &Pairing) -> Option<f64> {
    let compliance = |node: NodeId| {
        let triangle = model.triangles.iter().find(|triangle| triangle.nodes.contains(&node))?;
        let nu = match model.plane {
            Plane::Strain => triangle.material.nu,
            Plane::Stress => 0.0,
        };
        Some((1.0 - nu * nu) / triangle.material.e)
    };
    Some(1.0 / (compliance(pairing.node)? + compliance(pairing.masters[0].0)?))
}
