//! Scenes whose equilibrium is hard to find: rough blocks and leaning arms under friction, rings and arcs in
//! the current geometry without.

use std::f64::consts::{PI, TAU};

use fastrand::Rng;
use problem::element::area;
use problem::modelling::{ContactModel, Coupling, Friction, Geometry};
use problem::scene::{Axis, Scene};

use testing::bodies::{Bodies, Writing};
use testing::draws::{between, one_of};

const BOTH: [Axis; 2] = [Axis::X, Axis::Y];

/// How a scene of a kind is drawn.
pub type Draw = fn(&mut Rng, Coupling) -> Hard;

/// A scene whose equilibrium is hard to find.
pub struct Hard {
    pub bodies: Bodies,
    pub degrees: f64,
    pub mu: f64,
    pub steps: usize,
    pub geometry: Geometry,
    pub coupling: Coupling,
}

impl Hard {
    /// Writes the scene down.
    pub fn scene(&self, writing: &Writing) -> Scene {
        let model = ContactModel {
            coupling: self.coupling,
            geometry: self.geometry,
            friction: Friction::new(self.mu).expect("a coefficient"),
            load_steps: self.steps,
            ..Default::default()
        };
        self.bodies.modelled(writing, model).build().expect("a sound scene")
    }
}

fn magnitude(rng: &mut Rng, least: f64, most: f64) -> f64 {
    10_f64.powf(between(rng, least.log10(), most.log10()))
}

/// Two bodies of rows of nodes.
#[derive(Default)]
struct Rows {
    nodes: Vec<[f64; 2]>,
    triangles: Vec<Vec<[usize; 3]>>,
}

impl Rows {
    /// Adds a body of rows of as many nodes each, which close to rings or not; returns its rows.
    fn body(&mut self, rows: &[Vec<[f64; 2]>], closed: bool) -> Vec<Vec<usize>> {
        let (first, n) = (self.nodes.len(), rows[0].len());
        self.nodes.extend(rows.iter().flatten());
        let mut triangles = Vec::new();
        for row in 0..rows.len() - 1 {
            for k in 0..if closed { n } else { n - 1 } {
                let [a, b] = [k, (k + 1) % n].map(|k| first + row * n + k);
                let halves = match (row + k) % 2 {
                    0 => [[a, b, a + n], [b, b + n, a + n]],
                    _ => [[a, b, b + n], [a, b + n, a + n]],
                };
                let in_order = |[a, b, c]: [usize; 3]| {
                    let is_so = area(&[a, b, c].map(|n| self.nodes[n])) > 0.0;
                    if is_so { [a, b, c] } else { [a, c, b] }
                };
                triangles.extend(halves.map(in_order));
            }
        }
        self.triangles.push(triangles);
        (0..rows.len()).map(|row| (first + row * n..first + (row + 1) * n).collect()).collect()
    }

    fn finish(self, rng: &mut Rng, contact: &[usize], target: &[usize], closed: bool) -> Bodies {
        let mut edges: Vec<[usize; 2]> = target.windows(2).map(|w| [w[0], w[1]]).collect();
        let mut contact = contact.to_vec();
        if closed {
            edges.push([target[target.len() - 1], target[0]]);
            contact.push(contact[0]);
        }
        let [lower, upper] = self.triangles.try_into().expect("two bodies");
        Bodies {
            nodes: self.nodes,
            triangles: [lower, upper],
            moduli: [(); 2].map(|()| (magnitude(rng, 50.0, 2000.0), between(rng, 0.0, 0.45))),
            contact,
            target: edges,
            restrained: Vec::new(),
            loads: Vec::new(),
        }
    }
}

/// Points along a line from one to another, moved across it by `height`.
fn line(n: usize, [from, to]: [f64; 2], mut height: impl FnMut(f64) -> f64) -> Vec<[f64; 2]> {
    let x = |k: usize| from + (to - from) * k as f64 / (n - 1) as f64;
    (0..n).map(|k| [x(k), height(x(k))]).collect()
}

/// `n` rows from one row to another.
fn rows(n: usize, from: &[[f64; 2]], to: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let row = |k: usize| {
        let part = k as f64 / (n - 1) as f64;
        let between = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|d| a[d] + part * (b[d] - a[d]));
        from.iter().zip(to).map(between).collect()
    };
    (0..n).map(row).collect()
}

fn along_arc(n: usize, half: f64, radius: f64, rise: f64) -> Vec<[f64; 2]> {
    let at = |a: f64| [radius * a.sin(), rise - radius * a.cos()];
    (0..n).map(|k| at(half * (2.0 * k as f64 / (n - 1) as f64 - 1.0))).collect()
}

fn along_ring(n: usize, radius: f64, phase: f64, rise: f64) -> Vec<[f64; 2]> {
    let at = |a: f64| [radius * a.cos(), rise + radius * a.sin()];
    (0..n).map(|k| at(phase - TAU * k as f64 / n as f64)).collect()
}

/// A rough block of 16 to 40 contact nodes on a rough one, some of them inside it at the start, pressed and
/// sheared; guided, or held at a corner and turned.
pub fn rough(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let width = between(rng, 3.0, 4.0);
    let wide = width + between(rng, 0.6, 1.6);
    let rough = one_of(rng, &[0.0, 0.003, 0.006, 0.01]);
    let mut heights = rng.fork();
    let mut random = move |_: f64| between(&mut heights, -rough, rough);
    let (m, depth) = (rng.usize(14..=32), between(rng, 0.8, 1.6));
    let top = line(m, [-wide / 2.0, wide / 2.0], &mut random);
    let ground = line(m, [-wide / 2.0, wide / 2.0], |_| -depth);
    let lower = all.body(&rows(rng.usize(2..=4), &ground, &top), false);
    let (n, height) = (rng.usize(16..=40), between(rng, 1.0, 3.0));
    let gap = one_of(rng, &[0.0, 0.0, -0.002, 0.002, -0.006]);
    let bottom = line(n, [-width / 2.0, width / 2.0], |x| gap + random(x));
    let taper = one_of(rng, &[1.0, 1.0, 0.8]) * width / 2.0;
    let upper =
        all.body(&rows(rng.usize(3..=5), &bottom, &line(n, [-taper, taper], |_| height)), false);
    let mut bodies = all.finish(rng, &upper[0], &lower[lower.len() - 1], false);
    bodies.hold(&lower[0], &BOTH);
    let over = &upper[upper.len() - 1];
    let mu = between(rng, 0.05, 0.5);
    let degrees = match rng.bool() {
        true => {
            bodies.hold(&[over[0], over[n - 1]], &[Axis::X]);
            0.0
        }
        false => {
            bodies.hold(&[one_of(rng, &[over[0], over[n - 1]])], &BOTH);
            between(rng, -180.0, 180.0)
        }
    };
    let press = bodies.softest() * magnitude(rng, 1e-4, 3e-3) * width;
    let shear = press * between(rng, -1.2, 1.2) * mu * one_of(rng, &[0.3, 1.0, 2.0]);
    bodies.load(over, [shear, -press]);
    Hard { bodies, degrees, mu, steps: 8, geometry: Geometry::Initial, coupling }
}

/// A block with a round bottom in a round groove, held at one or two nodes of its top along x.
pub fn arc(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let (radius, wall) = (between(rng, 1.5, 2.6), between(rng, 1.2, 1.8));
    let (half, m) = (between(rng, 0.8, 1.4), rng.usize(12..=28));
    let inner = along_arc(m, half, radius, 0.0);
    let lower =
        all.body(&rows(rng.usize(3..=4), &along_arc(m, half, radius + wall, 0.0), &inner), false);
    let (n, own) = (rng.usize(14..=40), radius * between(rng, 0.93, 1.0));
    let gap = one_of(rng, &[0.0, 0.0, 0.002, -0.002]) * radius;
    let part = half * between(rng, 0.6, 0.95);
    let bottom = along_arc(n, part, own, own - radius + gap);
    let (wide, high) = (own * part.sin() / 2.0, 0.05 * radius * between(rng, -1.0, 1.0));
    let upper =
        all.body(&rows(rng.usize(3..=6), &bottom, &line(n, [-wide, wide], |_| high)), false);
    let mut bodies = all.finish(rng, &upper[0], &lower[lower.len() - 1], false);
    bodies.hold(&lower[0], &BOTH);
    let over = &upper[upper.len() - 1];
    bodies.hold(&[one_of(rng, &[over[0], over[n / 2]])], &[Axis::X]);
    if rng.f64() < 0.6 {
        bodies.hold(&[over[n - 1]], &[Axis::X]);
    }
    let press = bodies.softest() * magnitude(rng, 1e-4, 3e-3) * 2.0 * wide;
    bodies.load(over, [0.0, -press]);
    Hard { bodies, degrees: 0.0, mu: 0.0, steps: 1, geometry: Geometry::Current, coupling }
}

/// A ring in a ring, held at one or two nodes of its hole along x.
pub fn ring(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let (radius, wall, m) = (2.0, between(rng, 0.5, 1.2), rng.usize(16..=32));
    let phase = between(rng, 0.0, TAU);
    let around = |radius: f64| along_ring(m, radius, phase, 0.0);
    let lower = all.body(&rows(3, &around(radius), &around(radius + wall)), true);
    let (n, own) = (rng.usize(14..=30), radius * between(rng, 0.9, 0.99));
    let (phase, lower_by) =
        (between(rng, 0.0, TAU), (radius - own) * one_of(rng, &[0.5, 0.9, 0.95]));
    let around = |radius: f64| along_ring(n, radius, phase, -lower_by);
    let upper = all.body(&rows(3, &around(own * between(rng, 0.35, 0.5)), &around(own)), true);
    let mut bodies = all.finish(rng, &upper[2], &lower[0], true);
    bodies.hold(&lower[2], &BOTH);
    bodies.hold(&[upper[0][0]], &[Axis::X]);
    if rng.f64() < 0.4 {
        bodies.hold(&[upper[0][n / 2]], &[Axis::X]);
    }
    let press = bodies.softest() * magnitude(rng, 1e-4, 5e-3);
    bodies.load(&upper[0], [press * one_of(rng, &[0.0, 0.0, 0.1]), -press]);
    Hard { bodies, degrees: 0.0, mu: 0.0, steps: 1, geometry: Geometry::Current, coupling }
}

/// A leaning arm, clamped at its top, whose foot of 2 to 5 nodes rests on a stiff block.
pub fn arm(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let ground = |y: f64| line(3, [-3.0, 3.0], |_| y);
    let lower = all.body(&[ground(-1.0), ground(0.0)], false);
    let (n, half) = (rng.usize(2..=5), between(rng, 0.15, 0.6));
    let (lean, long) = (between(rng, -1.2, 1.2), between(rng, 1.5, 3.5));
    let gap = one_of(rng, &[0.0, 0.0, 0.0, -0.002, 0.002]);
    let foot = line(n, [-half, half], |_| gap);
    let [right, up] = [long * lean.sin(), long * lean.cos()];
    let top: Vec<[f64; 2]> = foot.iter().map(|[x, y]| [x + right, y + up]).collect();
    let upper = all.body(&rows(rng.usize(3..=4), &foot, &top), false);
    let mut bodies = all.finish(rng, &upper[0], &lower[1], false);
    bodies.moduli[0].0 = 1e6;
    bodies.hold(&lower[0], &BOTH);
    bodies.hold(&upper[upper.len() - 1], &BOTH);
    let force = magnitude(rng, 5e-5, 2e-3) * bodies.moduli[1].0;
    let at = one_of(rng, &upper[0]);
    bodies.load(&[at], [force * between(rng, -1.0, 1.0), force * between(rng, -1.0, 0.3)]);
    let mu = match rng.bool() {
        true => between(rng, 0.05, 1.2),
        false => between(rng, 1.2, 4.0),
    };
    let steps = one_of(rng, &[1, 4, 16]);
    Hard {
        bodies,
        degrees: between(rng, -PI, PI),
        mu,
        steps,
        geometry: Geometry::Initial,
        coupling,
    }
}

/// A thin arch, clamped at its left side and pressed on a block: most states of its nodes bend it through the
/// block.
pub fn thin(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let (n, span) = (rng.usize(6..=9), between(rng, 2.0, 4.0));
    let (thick, rise) = (between(rng, 0.05, 0.2), one_of(rng, &[0.0, 0.01, 0.02, 0.05]));
    let wide = span / 2.0 + 0.5;
    let ground = |y: f64| line(4, [-wide, wide], |_| y);
    let lower = all.body(&[ground(-1.0), ground(0.0)], false);
    let arch = |x: f64| rise * (1.0 - (2.0 * x / span).powi(2));
    let ends = [-span / 2.0, span / 2.0];
    let (bottom, top) = (line(n, ends, arch), line(n, ends, |x| arch(x) + thick));
    let upper = all.body(&[bottom, top], false);
    let mut bodies = all.finish(rng, &upper[0][1..], &lower[1], false);
    bodies.hold(&lower[0], &BOTH);
    bodies.hold(&[upper[0][0], upper[1][0]], &BOTH);
    let press = bodies.moduli[1].0 * magnitude(rng, 1e-4, 1e-2) * thick;
    bodies.load(&upper[1][1..], [press * between(rng, -0.3, 0.3), -press]);
    let (mu, geometry) = (one_of(rng, &[0.1, 0.3, 0.6]), Geometry::Initial);
    Hard { bodies, degrees: 0.0, mu, steps: one_of(rng, &[1, 4]), geometry, coupling }
}

/// A round disc in a groove, on a plate or in a ring, held so that it can turn in its place.
pub fn disc(rng: &mut Rng, coupling: Coupling) -> Hard {
    let mut all = Rows::default();
    let (radius, n) = (between(rng, 1.0, 3.0), 2 * rng.usize(8..=20));
    let around = |radius: f64| along_ring(n, radius, 0.0, radius);
    let upper_middle = |r: f64| along_ring(n, r, 0.0, radius);
    let bed = match rng.bool() {
        true => line(9, [-1.5 * radius, 1.5 * radius], |_| 0.0),
        false => along_arc(13, 1.0, 1.2 * radius, 1.2 * radius),
    };
    let ground = line(bed.len(), [-1.5 * radius, 1.5 * radius], |_| -radius);
    let lower = all.body(&rows(3, &ground, &bed), false);
    let upper =
        all.body(&[upper_middle(0.3 * radius), upper_middle(0.6 * radius), around(radius)], true);
    let mut bodies = all.finish(rng, &upper[2], &lower[2], false);
    bodies.hold(&lower[0], &BOTH);
    // A node as high as the middle moves up and down as the disc turns.
    bodies.hold(&[upper[0][0]], &[Axis::X]);
    let press = bodies.softest() * magnitude(rng, 1e-5, 1e-3) * radius;
    bodies.load(&upper[0], [0.0, -press]);
    let geometry = one_of(rng, &[Geometry::Initial, Geometry::Current]);
    Hard { bodies, degrees: 0.0, mu: 0.0, steps: 1, geometry, coupling }
}
