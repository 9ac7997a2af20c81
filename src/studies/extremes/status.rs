//! Generators of the contact search: steep edges, gaps at the tolerance, the tolerance itself,
//! unusual surfaces.

use super::answer::solve;
use super::blocks::{Blocks, BlocksOf};
use super::methods::{DOUBLE, in_each_scalar, in_scalar};
use super::search::{Quantity, Search, SearchOf, printed, projected};
use super::sweep::{Generator, Method, Sweep};
use numbers::solve::ScalarName;
use problem::modelling::Variant;

/// A node beside an edge of height 1 at `angle` (its tangent) from the vertical, `gap` away along
/// the normal. All move by a thousandth, and the edge widens by another: it keeps its angle, but
/// not the bits of its x difference.
fn at_angle(angle: f64, gap: f64) -> Search {
    let a = [1.0 / 3.0, 1.0 / 7.0];
    let n = [a[0] + 0.4 * angle - gap, a[1] + 0.4 + gap * angle];
    let moved = [0.0, 0.37e-3, 0.148e-3].map(|part| [1.1e-3 + part * angle, -2.3e-3]);
    // A tolerance of 10 edges keeps the node in contact: its status would hide its weights.
    Search { a, b: [a[0] + angle, a[1] + 1.0], n, moved, c_tll: 10.0 }
}

fn steep(angle: f64) -> Search {
    at_angle(angle, 0.0)
}

/// A node nearer to the edge than the paper's c_tol.
fn near_edge(angle: f64) -> Search {
    at_angle(angle, 7e-4)
}

/// C3: the target edge turned to the vertical.
pub fn steep_edge() -> Generator {
    Generator::new(
        "steep-edge",
        "C3: a target edge turned to the vertical; errors over the edge length, so that 3 digits \
         are the paper's c_tol of 0.001",
        "angle from the vertical, rad",
        Sweep::Decades { from: -18, to: 0, step: 1 },
        [
            printed("yt", Quantity::Gap, steep),
            printed("yt 7e-4 off the edge", Quantity::Gap, near_edge),
            projected("normal gap 7e-4 off", Quantity::Gap, near_edge, |_| [0.0, 0.0]),
            printed("weight", Quantity::Weight, steep),
            projected("projected weight", Quantity::Weight, steep, |_| [0.0, 0.0]),
        ],
    )
}

/// The gap of a node over a sloping edge far from the origin.
pub fn offset_gap() -> Generator {
    let search: SearchOf = |origin| {
        let home = near_edge(1.0);
        let moved = |p: [f64; 2]| p.map(|x| x + origin);
        Search { a: moved(home.a), b: moved(home.b), n: moved(home.n), ..home }
    };
    Generator::new(
        "offset-gap",
        "Gap and weights far from the origin; errors over the edge length",
        "distance from the origin / edge length",
        Sweep::Decades { from: 0, to: 16, step: 1 },
        [
            printed("yt", Quantity::Gap, search),
            projected("normal gap, origin shifted", Quantity::Gap, search, |search| search.a),
            printed("weight", Quantity::Weight, search),
        ],
    )
}

const ULPS: &[&str] = &[
    "level edge, c_tll - 1 ulp",
    "level edge, c_tll",
    "level edge, c_tll + 1 ulp",
    "sloping edge, c_tll - 1 ulp",
    "sloping edge, c_tll",
    "sloping edge, c_tll + 1 ulp",
];

/// A node above the edge by the tolerance, or by the next number to it.
fn at_tolerance(case: f64) -> Search {
    let (case, c_tll) = (case as usize, 1e-3);
    let step = |x: f64| [x.next_down(), x, x.next_up()][case % 3];
    let moved = [[0.0; 2]; 3];
    if case < 3 {
        return Search { a: [0.0, 0.0], b: [2.0, 0.0], n: [0.7, step(c_tll)], moved, c_tll };
    }
    Search { a: [0.0, 0.0], b: [3.0, 1.0], n: [0.7, step(0.7 / 3.0 + c_tll)], moved, c_tll }
}

/// The gap within a unit in the last place of c_tll: who is in contact.
pub fn gap_at_tolerance() -> Generator {
    Generator::new(
        "gap-at-tolerance",
        "A gap within a unit in the last place of c_tll: is the node in contact",
        "case",
        Sweep::Cases(ULPS),
        [printed("status", Quantity::Status, at_tolerance)],
    )
}

const TOLERANCES: &[&str] = &[
    "0", "5e-324", "1e-310", "1e-300", "1e-100", "1e-46", "1e-40", "1e-20", "1e-3", "1e0", "1e20",
    "1e38", "1e39", "1e100", "1e300", "1.7e308",
];

/// c_tll of any size, the gaps being 0.
pub fn tolerance() -> Generator {
    let blocks: BlocksOf = |case| {
        let c_tll = TOLERANCES[case as usize].parse().expect("a number");
        Blocks { c_tll, ..Blocks::default() }
    };
    let beside = beside("beside c_tll = 1e-3", blocks, |_| Blocks::default());
    Generator::new(
        "tolerance",
        "c_tll 0, subnormal, huge; all gaps are 0",
        "case",
        Sweep::Cases(TOLERANCES),
        [in_each_scalar(Variant::Tied, blocks), beside.into()],
    )
}

/// `tied` and `unilateral` in f64 on blocks, each beside `others`, whoever is in contact: `tied`
/// beside exact numbers, `unilateral`, which has none, beside itself.
fn beside(name: &str, blocks: BlocksOf, others: BlocksOf) -> [Method; 2] {
    [(Variant::Tied, ScalarName::Exact), (Variant::Unilateral, DOUBLE)].map(|(variant, scalar)| {
        Method::new(format!("{variant} f64, {name}"), DOUBLE, move |case, _| {
            let answer = solve(&blocks(case).scene(variant), variant, DOUBLE, None)?;
            let other = solve(&others(case).scene(variant), variant, scalar, None)?;
            Ok(answer.displacement(&other))
        })
    })
}

const SURFACES: &[&str] = &[
    "as it is",
    "one contact node",
    "one target edge",
    "a node twice in cnt",
    "an edge twice in trg",
];

/// The smallest surfaces, and lists that name something twice.
pub fn surfaces() -> Generator {
    fn blocks(case: f64) -> Blocks {
        let clean = Blocks::default();
        match case as usize {
            1 => Blocks { contact: vec![7], ..clean },
            2 => Blocks { target: vec![1], ..clean },
            3 => Blocks { contact: vec![6, 7, 7, 8], ..clean },
            4 => Blocks { target: vec![1, 1, 2], ..clean },
            _ => clean,
        }
    }
    fn once(case: f64) -> Blocks {
        if case > 2.0 { Blocks::default() } else { blocks(case) }
    }
    Generator::new(
        "surfaces",
        "One contact node, one edge, a node or an edge named twice",
        "case",
        Sweep::Cases(SURFACES),
        [
            in_each_scalar(Variant::Tied, blocks),
            in_each_scalar(Variant::Printed, blocks),
            vec![in_scalar(Variant::Stepped, DOUBLE, blocks)],
            beside("beside each once", blocks, once).into(),
        ],
    )
}
