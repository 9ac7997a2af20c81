//! Listing = mirror, bit for bit: on random scenes and under every reading that concerns a listing,
//! interpreter and mirror give the same bits, or fail at the same line for the same cause.
//!
//! `PROPTEST_CASES=100000 cargo test --release -p plane-contact-paper bitwise` runs any number of scenes;
//! without it, 2,000.
#![allow(non_snake_case, reason = "the paper's own names")]

use std::rc::Rc;

use mathcad::array::{Column, Table};
use mathcad::value::Array;
use mathcad::{Cause as MathcadCause, Conjunction, Failure as MathcadFailure, Value};
use nalgebra::SMatrix;
use paper::listings::{self, Which, settings};
use paper::mirror::{Cause, Failure, Km, Pairs, Reading, Wedge, Worksheet, c_cnt};
use problem::element::Plane;
use problem::scene::SCENES;
use proptest::prelude::*;
use proptest::sample::select;
use testing::random::fixed;
use testing::worksheets::{Draw, all_readings, bits, draw, initial, reading, worksheet};

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
    let listing = listings::c_cnt(&Which::CCnt.under(reading), &settings, sheet, node_n, None);
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
    let listing_km = listings::km(&Which::Km.under(reading), &settings, sheet, &k_cnt, None);
    let flat = |m: &Table<f64>| bits(m.as_matrix().iter().copied());
    let of_mirror_km = mirror_km.as_ref().map(flat).map_err(|f| mirror_stop(f.clone()));
    prop_assert_eq!(
        &of_mirror_km,
        &listing_km.map(|(m, _)| flat(&table(m))).map_err(|f| listing_stop(&f))
    );
    Ok(Seen { c_cnt: of_mirror.map(|(_, _, dy, _)| dy.iter().sum()), km: of_mirror_km.map(|_| ()) })
}

fn table(array: Rc<Array>) -> Table<f64> {
    Table::try_from(&Value::Array(array)).expect("numbers")
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
            let listing = listings::km(&which, &settings, &sheet, &k_cnt, None);
            let listing = listing.map(|(m, _)| flat(table(m))).map_err(|f| listing_stop(&f));
            prop_assert_eq!(&mirror, &listing);
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
