//! Random scenes of two bodies: flat, bent and wavy surfaces, roofs and corners, plates, grooves,
//! and contact nodes that restraints hold.

use std::f64::consts::TAU;

use fastrand::Rng;
use problem::scene::Axis;

use crate::bodies::{Bodies, grid};
use crate::draws::{between, one_of};

/// What a scene shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Flat surfaces, slightly inclined.
    Flat,
    /// A target bent at its nodes, to either side.
    Bent,
    /// Two wavy surfaces.
    Wavy,
    /// A flat surface over one apex or two of the target.
    Roof,
    /// A target narrower than the contact surface, with or without its sides.
    Narrow,
    /// A flat surface over a groove with a flat bottom; a node may be as near to both flanks.
    Groove,
    /// A thin plate, clamped at one end, that bends onto the target.
    Plate,
    /// Contact nodes restrained along the normal, and an elastic target that is pressed on them.
    Held,
}

pub const KINDS: [Kind; 8] = [
    Kind::Flat,
    Kind::Bent,
    Kind::Wavy,
    Kind::Roof,
    Kind::Narrow,
    Kind::Groove,
    Kind::Plate,
    Kind::Held,
];

/// How the contact body is held beside the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// It can move along y only.
    Guided,
    /// It can move along y and turn.
    Hinged,
    /// One side is clamped.
    Clamped,
}

/// A random scene.
pub struct Drawn {
    pub kind: Kind,
    pub support: Support,
    pub bodies: Bodies,
}

impl Drawn {
    /// Whether every restraint holds both directions, so that it can be turned by any angle.
    pub fn turns(&self) -> bool {
        self.bodies.restrained.iter().all(|(_, axes)| axes.len() == 2)
    }
}

/// `n` numbers from `least` to `most`, evenly or unevenly spaced.
fn spread(rng: &mut Rng, n: usize, least: f64, most: f64) -> Vec<f64> {
    let uneven = rng.bool();
    let steps: Vec<f64> =
        (1..n).map(|_| if uneven { between(rng, 0.5, 1.5) } else { 1.0 }).collect();
    let total: f64 = steps.iter().sum();
    let mut sum = 0.0;
    let mut x = vec![least];
    for step in steps {
        sum += step;
        x.push(least + (most - least) * sum / total);
    }
    x
}

/// A surface by its nodes, from left to right.
type Line = Vec<[f64; 2]>;

/// Returns the height of a surface at `x`; None beside it.
fn height(line: &Line, x: f64) -> Option<f64> {
    let piece = line.windows(2).find(|w| w[0][0] <= x && x <= w[1][0])?;
    let [a, b] = [piece[0], piece[1]];
    Some(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]))
}

/// Returns the least height of `upper` over `lower`.
fn least_distance(upper: &Line, lower: &Line) -> f64 {
    let over = |p: &[f64; 2]| height(lower, p[0]).map(|y| p[1] - y);
    let under = |p: &[f64; 2]| height(upper, p[0]).map(|y| y - p[1]);
    let all = upper.iter().filter_map(over).chain(lower.iter().filter_map(under));
    all.fold(f64::INFINITY, f64::min)
}

/// Returns the surfaces of target and contact body, the second at no defined height.
fn surfaces(rng: &mut Rng, kind: Kind) -> [Line; 2] {
    let n = rng.usize(2..=10);
    let flat = |x: Vec<f64>| x.into_iter().map(|x| [x, 0.0]).collect::<Line>();
    let wave = |rng: &mut Rng, x: Vec<f64>, size: f64| {
        let (length, phase) = (between(rng, 2.5, 6.0), TAU * rng.f64());
        x.into_iter().map(|x| [x, size * (TAU * x / length + phase).sin()]).collect::<Line>()
    };
    let wide = |rng: &mut Rng, n: usize| {
        let (left, right) = (between(rng, -0.4, 0.9), between(rng, 4.5, 6.4));
        spread(rng, n, left, right)
    };
    let count = rng.usize(2..=8);
    let under = spread(rng, count, -1.0, 7.0);
    match kind {
        Kind::Flat | Kind::Held => {
            let slope = one_of(rng, &[0.0, 1.0]) * between(rng, -0.01, 0.01);
            let upper = wide(rng, n).into_iter().map(|x| [x, slope * x]).collect();
            [flat(under), upper]
        }
        Kind::Bent => {
            let mut y = 0.0;
            let mut lower: Line = vec![[under[0], 0.0]];
            for w in under.windows(2) {
                y += between(rng, -0.5, 0.5) * (w[1] - w[0]);
                lower.push([w[1], y]);
            }
            let upper = wide(rng, n);
            let size = one_of(rng, &[0.0, 0.05]);
            [lower, wave(rng, upper, size)]
        }
        Kind::Wavy => {
            let upper = wide(rng, n.max(4));
            let (a, b) = (between(rng, 0.1, 0.5), between(rng, 0.1, 0.5));
            [wave(rng, under, a), wave(rng, upper, b)]
        }
        Kind::Roof => {
            let rise = one_of(rng, &[0.3, 0.7, 1.1, 2.5]) * between(rng, 0.9, 1.1);
            let mut lower: Line = vec![[-1.0, 0.0], [3.0, rise], [7.0, 0.0]];
            if rng.bool() {
                lower = vec![[-1.0, 0.0], [1.0, rise], [3.0, 0.0], [5.0, rise], [7.0, 0.0]];
            }
            // Symmetric, with a node over the middle where there is an odd number.
            let upper = match rng.bool() {
                true => (0..n).map(|k| 1.0 + 4.0 * k as f64 / (n - 1) as f64).collect(),
                false => wide(rng, n),
            };
            [lower, flat(upper)]
        }
        Kind::Narrow => {
            let (left, right) = (between(rng, 1.2, 2.2), between(rng, 3.0, 4.4));
            let lower = spread(rng, count.min(4), left, right);
            let mut upper = wide(rng, n.max(3));
            if rng.bool() {
                // A node over the corner.
                let nearest = (1..upper.len() - 1)
                    .min_by(|a, b| (upper[*a] - left).abs().total_cmp(&(upper[*b] - left).abs()));
                if let Some(k) = nearest
                    && upper[k - 1] + 0.1 < left
                    && left < upper[k + 1] - 0.1
                {
                    upper[k] = left;
                }
            }
            [flat(lower), flat(upper)]
        }
        Kind::Groove => {
            let depth = between(rng, 0.8, 2.0);
            let wall = between(rng, 0.2, 0.8);
            let bottom = between(rng, 0.3, 1.0);
            let at = |x: f64| [3.0 - x, 3.0 + x];
            let ([a, f], [b, e], [c, d]) = (at(4.0), at(bottom + wall), at(bottom));
            let lower: Line =
                vec![[a, 0.0], [b, 0.0], [c, -depth], [d, -depth], [e, 0.0], [f, 0.0]];
            let upper = match rng.bool() {
                true => (0..n).map(|k| 1.0 + 4.0 * k as f64 / (n - 1) as f64).collect(),
                false => wide(rng, n),
            };
            [lower, flat(upper)]
        }
        Kind::Plate => {
            let end = between(rng, 4.0, 6.0);
            let upper = spread(rng, n.max(5), 0.0, end);
            let lower = match rng.u8(..3) {
                0 => flat(under),
                1 => vec![[1.0, 0.0], [2.5, 0.8], [4.0, 0.0]],
                _ => wave(rng, under, 0.2),
            };
            [lower, flat(upper)]
        }
    }
}

/// Returns the nodes of rows between two heights over each x: the second may be a surface.
fn rows(from: &Line, to: &Line, n: usize) -> Vec<[f64; 2]> {
    let row = |k: usize| {
        let part = k as f64 / (n - 1) as f64;
        from.iter().zip(to).map(move |(a, b)| [a[0], a[1] + part * (b[1] - a[1])])
    };
    (0..n).flat_map(row).collect()
}

fn level(line: &Line, y: f64) -> Line {
    line.iter().map(|[x, _]| [*x, y]).collect()
}

/// Draws the scene of a kind.
pub fn draw(rng: &mut Rng, kind: Kind) -> Drawn {
    let [lower, mut upper] = surfaces(rng, kind);
    let gap = match kind {
        Kind::Plate => between(rng, 0.05, 0.2),
        _ => match rng.u8(..4) {
            0 | 1 => 0.0,
            2 => between(rng, 0.0, 0.05),
            _ => -between(rng, 0.0, 0.01),
        },
    };
    let lift = gap - least_distance(&upper, &lower);
    upper.iter_mut().for_each(|p| p[1] += lift);
    let least = lower.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let most = upper.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let (below, above) = (lower.len(), upper.len());
    let thick = if kind == Kind::Plate { between(rng, 0.1, 0.3) } else { between(rng, 1.0, 2.0) };
    let (low, high) = (3, if kind == Kind::Plate { 2 } else { 3 });
    let mut nodes = rows(&level(&lower, least - 1.5), &lower, low);
    let first = nodes.len();
    nodes.extend(rows(&upper, &level(&upper, most + thick), high));
    let exponents = [between(rng, 3.0, 5.0), between(rng, 3.0, 5.0)];
    let [e, f] = exponents.map(|x| 10_f64.powf(x));
    let moduli = [(e, between(rng, 0.0, 0.4)), (f, between(rng, 0.0, 0.4))];
    let mut target: Vec<[usize; 2]> =
        (0..below - 1).map(|k| [(low - 1) * below + k, (low - 1) * below + k + 1]).collect();
    if kind == Kind::Narrow && rng.bool() {
        for row in 0..low - 1 {
            let [a, b] = [row * below, (row + 1) * below];
            target.extend([[a, b], [a + below - 1, b + below - 1]]);
        }
    }
    let both = vec![Axis::X, Axis::Y];
    let mut restrained: Vec<_> = (0..below).map(|n| (n, both.clone())).collect();
    let support = match kind {
        Kind::Plate => Support::Clamped,
        Kind::Held => one_of(rng, &[Support::Guided, Support::Clamped]),
        _ => match rng.u8(..10) {
            0..4 => Support::Guided,
            4 => Support::Hinged,
            _ => Support::Clamped,
        },
    };
    let top = first + (high - 1) * above;
    let side = [first + above, top];
    match support {
        Support::Guided => restrained.extend(side.map(|n| (n, vec![Axis::X]))),
        Support::Hinged => restrained.push((top + above / 2, vec![Axis::X])),
        Support::Clamped if kind == Kind::Plate => {
            restrained.extend([first, top].map(|n| (n, both.clone())));
        }
        Support::Clamped => restrained.extend(side.map(|n| (n, both.clone()))),
    }
    let mut loads: Vec<(usize, [f64; 2])> = Vec::new();
    let soft = e.min(f);
    let size = match kind {
        Kind::Plate => f * thick.powi(3) * between(rng, 0.01, 0.1),
        _ => 0.01 * soft * between(rng, 0.1, 1.0),
    };
    let across = if rng.bool() { between(rng, -0.3, 0.3) } else { 0.0 };
    let eccentric = one_of(rng, &[0.0, 0.3, 0.8]);
    for k in 0..above {
        let arm = 2.0 * k as f64 / (above - 1) as f64 - 1.0;
        let force = size * (1.0 + eccentric * arm) / above as f64;
        loads.push((top + k, [across * force, -force]));
    }
    if kind == Kind::Held {
        for k in (0..above).filter(|_| rng.u8(..3) > 0) {
            restrained.push((first + k, vec![Axis::Y]));
        }
        for k in 0..below {
            let up = 0.01 * e * between(rng, 0.1, 0.5);
            loads.push(((low - 1) * below + k, [0.0, up]));
        }
    }
    let bodies = Bodies {
        nodes,
        triangles: [grid(0, below, low), grid(first, above, high)],
        moduli,
        contact: (first..first + above).collect(),
        target,
        restrained,
        loads,
    };
    Drawn { kind, support, bodies }
}

/// Draws `count` scenes, of each kind in turn.
pub fn scenes(seed: u64, count: usize) -> impl Iterator<Item = Drawn> {
    let mut rng = Rng::with_seed(seed);
    (0..count).map(move |k| draw(&mut rng, KINDS[k % KINDS.len()]))
}
