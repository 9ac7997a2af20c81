//! Listing = mirror, bit for bit: on random scenes and under every reading that concerns a listing,
//! interpreter and mirror give the same bits, or fail at the same line for the same cause.
//!
//! `PROPTEST_CASES=100000 cargo test --release --test fidelity bitwise` runs any number of scenes;
//! without it, 2,000.
#![allow(non_snake_case, reason = "the paper's own names")]

use crate::common::random::fixed;
use nalgebra::SMatrix;
use plane_contact::engine::Request;
use plane_contact::mathcad::array::{Column, Table};
use plane_contact::mathcad::worksheet::execute;
use plane_contact::mathcad::xmcd::document;
use plane_contact::mathcad::{
    Cause as MathcadCause, Conjunction, Failure as MathcadFailure, Limits,
};
use plane_contact::paper::door;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::{
    Cause, Change, Failure, Km, LoopPlace, Pairs, READINGS, Reading, Wedge, Worksheet, c_cnt,
};
use plane_contact::problem::element;
use plane_contact::problem::element::Plane;
use plane_contact::problem::scene::{SCENES, Scene};
use plane_contact::report::exports::{self, Export};
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A target edge: how it leaves the last one.
#[derive(Clone, Debug)]
enum Step {
    Along(f64, f64),
    NearlyVertical(f64),
    Vertical,
    Back(f64, f64),
}

/// Where a contact node stands relative to a target edge: place along it, and gap.
#[derive(Clone, Debug)]
struct Spot {
    edge: Index,
    along: f64,
    gap: Gap,
}

#[derive(Clone, Debug)]
enum Gap {
    None,
    /// In units of c_tll.
    Times(f64),
    /// c_tll times the sign, moved by so many units in the last place.
    Tolerance(f64, i64),
    Free(f64),
}

/// What a random scene is drawn from.
#[derive(Clone, Debug)]
pub struct Draw {
    steps: Vec<Step>,
    turned: Vec<bool>,
    duplicated: Option<Index>,
    reversed_order: bool,
    spots: Vec<Spot>,
    duplicated_node: bool,
    c_tll: f64,
    scale: f64,
    /// Of x before scaling: at a scale of 1e308 a difference of coordinates then overflows, the
    /// coordinates do not.
    shift: f64,
    /// Elastic modulus of the first triangle; near the largest number, sums of stiffnesses
    /// overflow.
    modulus: f64,
    /// Displacements of the nodes; empty: the initial shape.
    moved: Vec<[f64; 2]>,
    fixed: Vec<bool>,
    triangles: Vec<[Index; 3]>,
    /// Whether triangles without area stay: B is then infinite, and Km overflows.
    degenerate: bool,
    plane: Plane,
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        6 => (0.1..1.0, -0.5..0.5).prop_map(|(x, y)| Step::Along(x, y)),
        1 => (1.0..1.9, -0.5..0.5).prop_map(|(x, y)| Step::Along(x, y)),
        1 => (0.1..1.0).prop_map(|x| Step::Along(x, 0.0)),
        1 => (-1.0..1.0).prop_map(Step::NearlyVertical),
        1 => Just(Step::Vertical),
        1 => (0.1..1.0, -0.5..0.5).prop_map(|(x, y)| Step::Back(x, y)),
    ]
}

fn gap() -> impl Strategy<Value = Gap> {
    prop_oneof![
        1 => Just(Gap::None),
        3 => (-1.5..1.5).prop_map(Gap::Times),
        3 => (select(vec![-1.0, 1.0]), -1..=1i64).prop_map(|(s, ulp)| Gap::Tolerance(s, ulp)),
        2 => (-5.0..5.0).prop_map(Gap::Times),
        1 => (-0.5..0.5).prop_map(Gap::Free),
    ]
}

fn spot() -> impl Strategy<Value = Spot> {
    let along = prop_oneof![4 => 0.0..1.0, 1 => select(vec![0.0, 1.0, 0.5]), 1 => -0.3..1.3];
    (any::<Index>(), along, gap()).prop_map(|(edge, along, gap)| Spot { edge, along, gap })
}

prop_compose! {
    pub fn draw()(
        steps in prop::collection::vec(step(), 1..6),
        turned in prop::collection::vec(any::<bool>(), 6),
        duplicated in prop::option::weighted(0.2, any::<Index>()),
        reversed_order in any::<bool>(),
        spots in prop::collection::vec(spot(), 1..6),
        duplicated_node in prop::bool::weighted(0.1),
        c_tll in select(vec![1e-3, 1e-3, 0.1, 1.0, 0.0, 1e-300]),
        scale in select(vec![1.0, 1.0, 1.0, 1.0, 1.0, 1e3, 1e-9, 1e160, 1e308]),
        shift in select(vec![0.0, 0.0, -0.9]),
        modulus in select(vec![3e4, 3e4, 3e4, 1e307, 5e307]),
        moved in prop_oneof![
            Just(vec![]),
            prop::collection::vec(prop::array::uniform2(-2e-3..2e-3), 16),
        ],
        fixed in prop::collection::vec(prop::bool::weighted(0.2), 32),
        triangles in prop::collection::vec(any::<[Index; 3]>(), 1..6),
        degenerate in prop::bool::weighted(0.1),
        plane in select(Plane::ALL),
    ) -> Draw {
        Draw {
            steps, turned, duplicated, reversed_order, spots, duplicated_node, c_tll, scale, shift,
            modulus, moved, fixed, triangles, degenerate, plane,
        }
    }
}

/// One of [`all_readings`].
pub fn reading() -> impl Strategy<Value = Reading> {
    select(all_readings())
}

/// Every combination of the readings that change the listings' text or the worksheet's settings.
pub fn all_readings() -> Vec<Reading> {
    let mut all = vec![Reading::default()];
    for row in READINGS.iter().filter(|row| row.is_option()) {
        if row.values.iter().any(|value| !matches!(value.change, Change::None)) {
            let under = |mut reading: Reading, value| {
                row.set(&mut reading, value);
                reading
            };
            let chosen =
                |reading: &Reading| row.values.iter().map(|v| under(*reading, v)).collect();
            all = all.iter().flat_map::<Vec<Reading>, _>(chosen).collect();
        }
    }
    assert!(all.len() >= 72);
    all
}

/// Target polyline, contact nodes, then the arrays of the worksheet and the current shape.
pub fn worksheet(draw: &Draw) -> (Worksheet<f64>, Table<f64>) {
    let mut points = polyline(&draw.steps);
    let edges = points.len() - 1;
    let targets = points.len();
    for spot in &draw.spots {
        points.push(place(&points[..targets], spot, draw.c_tll));
    }
    let cnt: Vec<usize> = (targets + 1..=points.len()).collect();
    points.push(APEX);
    for p in &mut points {
        *p = [(p[0] + draw.shift) * draw.scale, p[1] * draw.scale];
    }
    let mut rows: Vec<[usize; 2]> =
        (1..=edges).map(|e| if draw.turned[e - 1] { [e + 1, e] } else { [e, e + 1] }).collect();
    if let Some(at) = &draw.duplicated {
        rows.push(rows[at.index(rows.len())]);
    }
    let mut trg: Vec<usize> = (1..=rows.len()).collect();
    if draw.reversed_order {
        trg.reverse();
    }
    let repeated = cnt[..1].iter().filter(|_| draw.duplicated_node);
    let cnt = cnt.iter().chain(repeated).copied().collect();
    let node = Table::from_fn(points.len(), 4, |n, j| match j {
        1 => n as f64,
        4 => 0.0,
        _ => points[n - 1][j - 2],
    });
    let mut node_n = node.clone();
    for (k, moved) in draw.moved.iter().take(points.len()).enumerate() {
        node_n[(k + 1, 2)] += moved[0] * draw.scale;
        node_n[(k + 1, 3)] += moved[1] * draw.scale;
    }
    (assemble(draw, &points, &rows, trg, cnt, node), node_n)
}

fn polyline(steps: &[Step]) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0, 0.0]];
    for step in steps {
        let [x, y] = points[points.len() - 1];
        points.push(match *step {
            Step::Along(dx, dy) => [x + dx, y + dy],
            Step::NearlyVertical(dy) => [f64::next_up(x), y + dy],
            Step::Vertical => [x, y + 0.5],
            Step::Back(dx, dy) => [x - dx, y + dy],
        });
    }
    points
}

/// A contact node over (or in, or beside) a target edge.
fn place(target: &[[f64; 2]], spot: &Spot, c_tll: f64) -> [f64; 2] {
    let e = spot.edge.index(target.len() - 1);
    let ([ax, ay], [bx, by]) = (target[e], target[e + 1]);
    let line = ay + spot.along * (by - ay);
    let y = match spot.gap {
        Gap::None => line,
        Gap::Times(t) => line + t * c_tll,
        Gap::Free(g) => line + g,
        Gap::Tolerance(sign, ulp) => match (line + sign * c_tll, ulp) {
            (y, 1) => y.next_up(),
            (y, -1) => y.next_down(),
            (y, _) => y,
        },
    };
    [ax + spot.along * (bx - ax), y]
}

fn assemble(
    draw: &Draw,
    points: &[[f64; 2]],
    rows: &[[usize; 2]],
    trg: Vec<usize>,
    cnt: Vec<usize>,
    node: Table<f64>,
) -> Worksheet<f64> {
    let R = points.len();
    let triangles = triangles(draw, points);
    let corners: Vec<[[f64; 2]; 3]> = triangles.iter().map(|t| t.map(|n| points[n - 1])).collect();
    let elem = Table::from_fn(rows.len() + triangles.len(), 8, |e, j| {
        let nodes: &[usize] =
            if e <= rows.len() { &rows[e - 1] } else { &triangles[e - 1 - rows.len()] };
        match j {
            1 => e,
            2 => nodes.len() - 1,
            3 => 2,
            4 | 5 => 1,
            _ => nodes.get(j - 6).copied().unwrap_or(0),
        }
    });
    let M = triangles.len();
    Worksheet {
        node,
        EL: Table::from_fn(M, 8, |n, j| elem[(rows.len() + n, j)]),
        elem,
        trg: Column::from_vec(trg),
        cnt: Column::from_vec(cnt),
        c_tll: draw.c_tll * draw.scale.min(1e100),
        ind_1: 6,
        S: Column::from_vec((0..2 * R).map(|e| usize::from(draw.fixed[e % 32])).collect()),
        Ae: Column::from_vec(corners.iter().map(element::area).collect()),
        B: Column::from_vec(corners.iter().map(element::B).collect::<Vec<SMatrix<f64, 3, 6>>>()),
        E: Column::from_vec((0..M).map(|n| draw.modulus * (1.0 + 0.1 * n as f64)).collect()),
        nu: Column::from_vec((0..M).map(|n| 0.1 * n as f64 / 2.0).collect()),
        plane: draw.plane,
    }
}

/// The third corner of the one triangle that every scene has.
const APEX: [f64; 2] = [0.3, 7.0];

/// Triangles of three different nodes each.
fn triangles(draw: &Draw, points: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let node = |index: &Index| index.index(points.len()) + 1;
    let drawn = draw.triangles.iter().map(|t| [node(&t[0]), node(&t[1]), node(&t[2])]);
    let different = drawn.filter(|[a, b, c]| a != b && b != c && a != c);
    let kept =
        different.filter(|t| draw.degenerate || element::area(&t.map(|n| points[n - 1])) != 0.0);
    kept.chain([[1, 2, points.len()]]).collect()
}

pub fn bits(values: impl IntoIterator<Item = f64>) -> Vec<u64> {
    values.into_iter().map(f64::to_bits).collect()
}

type PairBits = (Vec<usize>, Vec<u64>, Vec<usize>, Vec<u64>);

fn pair_bits(pairs: &Pairs<f64>) -> PairBits {
    (
        pairs.ct.as_slice().to_vec(),
        bits(pairs.yt.iter().copied()),
        pairs.dy.as_slice().to_vec(),
        bits(pairs.k_cnt.as_matrix().iter().copied()),
    )
}

/// Line and cause of a failure, as both layers have them.
type Stop = (usize, Cause);

fn mirror_stop(failure: Failure) -> Stop {
    (failure.line, failure.cause)
}

fn listing_stop(failure: &MathcadFailure) -> Stop {
    let cause = match &failure.cause {
        MathcadCause::IndexOutside { .. } | MathcadCause::IndexBelowOrigin { .. } => {
            Cause::InvalidIndex
        }
        MathcadCause::Singularity { .. } => Cause::Singularity,
        MathcadCause::Overflow { .. } => Cause::Overflow,
        other => panic!("the mirror knows no {other:?} at line {}", failure.line),
    };
    (failure.line, cause)
}

/// Runs both layers and compares; tells what came out.
fn agree(
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    reading: &Reading,
) -> Result<Seen, TestCaseError> {
    let settings = settings(reading);
    let mirror = c_cnt(sheet, reading, node_n);
    let listing = listings::c_cnt(&Which::CCnt.under(reading), &settings, sheet, node_n, &mut ());
    let of_mirror = mirror.as_ref().map(pair_bits).map_err(|f| mirror_stop(f.clone()));
    prop_assert_eq!(
        &of_mirror,
        &listing.map(|(pairs, _)| pair_bits(&pairs)).map_err(|f| listing_stop(&f))
    );
    let k_cnt = match &mirror {
        Ok(pairs) => pairs.k_cnt.clone(),
        Err(_) => Table::filled(sheet.R(), 4, 0.0),
    };
    let mirror_km = Km(sheet, reading, &k_cnt).map(|m| m.to_table());
    let listing_km = listings::km(&Which::Km.under(reading), &settings, sheet, &k_cnt, &mut ());
    let flat = |m: &Table<f64>| bits(m.as_matrix().iter().copied());
    let of_mirror_km = mirror_km.as_ref().map(flat).map_err(|f| mirror_stop(f.clone()));
    prop_assert_eq!(
        &of_mirror_km,
        &listing_km.map(|(m, _)| flat(&m)).map_err(|f| listing_stop(&f))
    );
    Ok(Seen { c_cnt: of_mirror.map(|(_, _, dy, _)| dy.iter().sum()), km: of_mirror_km.map(|_| ()) })
}

/// What a scene went through, for the count at the end.
struct Seen {
    c_cnt: Result<usize, Stop>,
    km: Result<(), Stop>,
}

#[test]
fn listing_and_mirror_agree_on_random_scenes() {
    let mut runner = proptest::test_runner::TestRunner::new(fixed(2000));
    let seen = std::cell::RefCell::new(std::collections::BTreeMap::<String, usize>::new());
    let count = |what: String| *seen.borrow_mut().entry(what).or_default() += 1;
    let result = runner.run(&(draw(), reading()), |(draw, reading)| {
        let (sheet, node_n) = worksheet(&draw);
        let saw = agree(&sheet, &node_n, &reading)?;
        match saw.c_cnt {
            Ok(contact) => count(format!("c_cnt: {} in contact", contact.min(3))),
            Err((line, cause)) => count(format!("c_cnt: line {line} {cause:?}")),
        }
        if let Err((line, cause)) = saw.km {
            count(format!("Km: line {line} {cause:?}"));
        }
        Ok(())
    });
    println!("{:#?}", seen.borrow());
    result.unwrap_or_else(|error| panic!("{error}"));
    // The generator reaches what it was written for.
    for what in [
        "c_cnt: 0 in contact",
        "c_cnt: 1 in contact",
        "c_cnt: 3 in contact",
        "c_cnt: line 10 Singularity",
        "c_cnt: line 17 InvalidIndex",
        "c_cnt: line 18 InvalidIndex",
        "Km: line 9 Overflow",
        "Km: line 12 Overflow",
        "Km: line 23 Overflow",
    ] {
        assert!(seen.borrow().contains_key(what), "no scene gave {what:?}: {:#?}", seen.borrow());
    }
}

/// `Km` of tables of mates and weights that no search finds: two mates of a node, one of them or
/// none, at any node and with weights that may be 0; under every way to place its loops.
#[test]
fn listing_and_mirror_agree_on_any_mates() {
    let weights = || select(vec![0.0, 0.5, 1.0, -0.25, 3.0]);
    let mates = prop::collection::vec((0..8_usize, weights(), 0..8_usize, weights()), 16);
    let mut runner = proptest::test_runner::TestRunner::new(fixed(16));
    let drawn = (draw(), reading(), mates);
    let result = runner.run(&drawn, |(draw, reading, mates)| {
        let draw = Draw { modulus: 3e4, scale: 1.0, degenerate: false, ..draw };
        let (sheet, _) = worksheet(&draw);
        let k_cnt = Table::from_fn(sheet.R(), 4, |n, j| {
            let (a, first, b, second) = mates[n % mates.len()];
            // A mate of 0 is none.
            let mate = |mate: usize| if mate > sheet.R() { 0.0 } else { mate as f64 };
            [mate(a), first, mate(b), second][j - 1]
        });
        for r3 in Wedge::ALL {
            let reading = Reading { r3: *r3, ..reading };
            let flat = |m: Table<f64>| bits(m.as_matrix().iter().copied());
            let mirror =
                Km(&sheet, &reading, &k_cnt).map(|m| flat(m.to_table())).map_err(mirror_stop);
            let (which, settings) = (Which::Km.under(&reading), settings(&reading));
            let listing = listings::km(&which, &settings, &sheet, &k_cnt, &mut ());
            let listing = listing.map(|(m, _)| flat(m)).map_err(|f| listing_stop(&f));
            prop_assert_eq!(&mirror, &listing);
        }
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
}

/// A few of the random scenes, which the listing takes longer for.
#[test]
fn listing_and_mirror_agree_on_some_random_scenes() {
    let mut config = fixed(24);
    config.rng_seed = proptest::test_runner::RngSeed::Fixed(77);
    let mut runner = proptest::test_runner::TestRunner::new(config);
    let result = runner.run(&(draw(), reading()), |(draw, reading)| {
        // The usual numbers, in which most runs come to their end.
        let draw = Draw { modulus: 3e4, scale: 1.0, degenerate: false, ..draw };
        let (sheet, node_n) = worksheet(&draw);
        for r1 in LoopPlace::ALL {
            let reading = Reading { r1: *r1, r4: Conjunction::Guarded, ..reading };
            agree(&sheet, &node_n, &reading)?;
        }
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
}

/// One horizontal target edge from (0, 0) to (1, 0) and a contact node at `at`.
fn over_an_edge(at: [f64; 2], c_tll: f64) -> Worksheet<f64> {
    let points = [[0.0, 0.0], [1.0, 0.0], at, [0.0, -1.0]];
    Worksheet {
        node: Table::from_fn(4, 4, |n, j| match j {
            1 => n as f64,
            4 => 0.0,
            _ => points[n - 1][j - 2],
        }),
        elem: Table::from_fn(1, 8, |_, j| [1, 1, 2, 1, 1, 1, 2, 0][j - 1]),
        EL: Table::from_fn(1, 8, |_, j| [2, 2, 2, 1, 1, 1, 4, 2][j - 1]),
        trg: Column::from_vec(vec![1]),
        cnt: Column::from_vec(vec![3]),
        c_tll,
        ind_1: 6,
        S: Column::filled(8, 0),
        Ae: Column::filled(1, 1.0),
        B: Column::filled(1, SMatrix::zeros()),
        E: Column::filled(1, 1.0),
        nu: Column::filled(1, 0.0),
        plane: Plane::Strain,
    }
}

/// Line 7 takes an edge up to the tolerance, line 16 a distance below it; a failure names the row
/// that it stands at.
#[test]
fn c_cnt_of_one_node_over_one_edge() {
    let reading = Reading { r4: Conjunction::Guarded, ..Reading::default() };
    let pairs = |at| {
        let sheet = over_an_edge(at, 0.25);
        c_cnt(&sheet, &reading, &sheet.node).expect("it runs")
    };
    let found = |at| {
        let Pairs { ct, yt, dy, .. } = pairs(at);
        (ct[1], yt[1], dy[1])
    };
    assert_eq!(found([0.5, 0.125]), (1, -0.125, 1));
    assert_eq!(found([0.5, -0.125]), (1, 0.125, 1));
    // At the tolerance it faces the edge, and does not touch it.
    assert_eq!(found([0.5, 0.25]), (1, -0.25, 0));
    assert_eq!(found([1.25, 0.0]), (1, 0.0, 1));
    assert_eq!(found([-0.25, -0.25]), (1, 0.25, 0));
    for beyond in [[0.5, 0.3], [0.5, -0.3], [1.3, 0.0], [-0.3, 0.0]] {
        assert_eq!(found(beyond), (0, 0.0, 0), "{beyond:?}");
    }
    let touching = pairs([0.75, 0.0]).k_cnt;
    let expected = [[3.0, 0.25, 0.0, 0.0], [3.0, 0.75, 0.0, 0.0], [1.0, 0.25, 2.0, 0.75]];
    for (n, row) in (1..).zip(expected) {
        assert_eq!([1, 2, 3, 4].map(|j| touching[(n, j)]), row, "node {n}");
    }
    let words = |place: [f64; 2], c_tll: f64| {
        let mut sheet = over_an_edge([0.5, 0.0], c_tll);
        (sheet.node[(2, 2)], sheet.node[(2, 3)]) = (place[0], place[1]);
        c_cnt(&sheet, &reading, &sheet.node).expect_err("it fails").to_string()
    };
    // A box that overflows, and an edge of which both ends stand over each other.
    let box_fails = words([f64::MAX, 0.0], f64::MAX);
    assert!(box_fails.starts_with("c_cnt, line 5: "), "{box_fails}");
    assert!(box_fails.contains("i1 = 1, trg[i2] = 1, value = "), "{box_fails}");
    let vertical = words([0.0, 1.0], 1.0);
    assert!(vertical.starts_with("c_cnt, line 10: "), "{vertical}");
    assert!(vertical.contains("i1 = 1, ct[i1] = 1, numerator = 1, "), "{vertical}");
}

/// On a line that rises from (0, 0) to (1, 1), without a tolerance: a node on it is not below it,
/// beside one that the line passes above.
#[test]
fn a_node_on_the_line_is_not_below_it() {
    let mut sheet = over_an_edge([0.5, 0.5], 0.0);
    sheet.node[(2, 3)] = 1.0;
    (sheet.node[(4, 2)], sheet.node[(4, 3)]) = (0.5, 0.25);
    for (nodes, yt) in [([3, 4], [0.0, 0.25]), ([4, 3], [0.25, 0.0])] {
        sheet.cnt = Column::from_vec(nodes.to_vec());
        let reading = Reading { r4: Conjunction::Guarded, ..Reading::default() };
        let pairs = c_cnt(&sheet, &reading, &sheet.node).expect("it runs");
        assert_eq!([1, 2].map(|k| (pairs.ct[k], pairs.yt[k], pairs.dy[k])), yt.map(|y| (1, y, 0)));
    }
}

/// Read from left to right, line 18 asks for yt[0] where the line passes below the first node, and
/// only there.
#[test]
fn line_18_fails_at_the_first_node_below_its_line() {
    let reading = Reading { r4: Conjunction::LeftToRight, ..Reading::default() };
    let found = |at: [f64; 2]| {
        let sheet = over_an_edge(at, 0.25);
        c_cnt(&sheet, &reading, &sheet.node).map(|pairs| pairs.dy[1]).map_err(|why| why.to_string())
    };
    assert_eq!([[0.5, 0.0], [0.5, -0.125], [2.0, 0.0]].map(found), [Ok(1), Ok(1), Ok(0)]);
    let failure = found([0.5, 0.125]).expect_err("it fails");
    assert!(failure.starts_with("c_cnt, line 18: "), "{failure}");
    assert!(failure.contains("i1 = 1, ct[i1] = 1, index of yt = 0, rows(yt) = 1"), "{failure}");
}

/// The shipped scenes, at the initial shape, under every reading that concerns a listing: 72
/// combinations.
#[test]
fn listing_and_mirror_agree_on_the_shipped_scenes() {
    for scene in SCENES.iter().filter(|s| s.name != "strand") {
        let sheet = initial(scene.name);
        for reading in all_readings() {
            agree(&sheet, &sheet.node, &reading)
                .unwrap_or_else(|e| panic!("{} {reading:?}: {e}", scene.name));
        }
    }
    let strand = initial("strand");
    agree(&strand, &strand.node, &Reading::default()).unwrap_or_else(|e| panic!("strand: {e}"));
}

/// The worksheet of an embedded scene under the default reading.
pub fn initial(scene: &str) -> Worksheet<f64> {
    let request = Request::new(&Scene::open(scene).unwrap());
    door::worksheet(&request.model().unwrap(), |x| x)
}

/// `export --to mathcad`, read back and executed by the interpreter, has the mirror's bits on
/// random scenes; where the mirror fails, the worksheet fails too.
#[test]
fn an_exported_worksheet_has_the_mirror_s_bits() {
    let mut runner = proptest::test_runner::TestRunner::new(fixed(1_400));
    let seen = std::cell::Cell::new([0; 2]);
    let result = runner.run(&(draw(), reading()), |(draw, reading)| {
        let (sheet, node_n) = worksheet(&draw);
        // The worksheet divides by the area where the mirror's gradients are infinite.
        if sheet.B.iter().any(|b| b.iter().any(|x| !x.is_finite())) {
            return Ok(());
        }
        let export = Export {
            title: "random",
            sheet: &sheet,
            reading: &reading,
            node_n: &node_n,
            thickness: 1.0,
            run: None,
        };
        let mut read = document::read(&exports::mathcad::worksheet(&export), "export")
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        read.settings.conjunction = reading.r4;
        let limits = Limits { characters: 1 << 20, ..Limits::default() };
        let checked = execute(&read, &limits);
        let value = |tag: &str| {
            let region = checked.iter().find(|region| region.tag == tag).expect("a region");
            region.value.as_ref().map(|value| {
                bits(Table::<f64>::try_from(value).expect("an array").as_matrix().iter().copied())
            })
        };
        let pairs = c_cnt(&sheet, &reading, &node_n).ok();
        let flat = |table: &Table<f64>| bits(table.as_matrix().iter().copied());
        prop_assert_eq!(value("k_cnt"), pairs.as_ref().map(|pairs| flat(&pairs.k_cnt)));
        let mjs =
            pairs.and_then(|pairs| Km(&sheet, &reading, &pairs.k_cnt).ok()).map(|m| m.to_table());
        let [scenes, matrices] = seen.get();
        seen.set([scenes + 1, matrices + usize::from(mjs.is_some())]);
        prop_assert_eq!(value("MJS"), mjs.as_ref().map(flat));
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    let [scenes, matrices] = seen.get();
    assert!(scenes >= 1_000 && matrices >= 300, "{scenes} scenes, {matrices} with a matrix");
}
