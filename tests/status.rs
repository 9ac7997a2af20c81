//! The status rules on scenes worked out by hand, and on the paper's example with a wider duct.

mod common;

use common::tolerances::{FOOT, assert_near};
use plane_contact::audit::statuses::{Measurement, measure};
use plane_contact::contact::{
    Operations, Outcome, StatusRule, TargetSurface, Variant, pairs, run, run_by, statuses,
    summaries,
};
use plane_contact::mathcad::array::{Column, Table};
use plane_contact::mirror::{Cause, NodeTable, Plane, Reading, Worksheet, c_cnt};
use plane_contact::scene::Scene;

const C: f64 = 0.001;

/// A target fan under the surface chain, and a stamp triangle over each contact node.
///
/// ```text
///      q1 *---* q2 = contact node + sides
///          \ /
///   *-------o---*-------*    chain
///     \         |     /
///       `-------*--'         inner
/// ```
fn sheet(chain: &[[f64; 2]], contact: &[[f64; 2]], sides: [[f64; 2]; 2]) -> Worksheet<f64> {
    let (m, n) = (chain.len(), contact.len());
    let inner = [0.0, -5.0];
    let corner = |p: &[f64; 2], by: [f64; 2]| [p[0] + by[0], p[1] + by[1]];
    let corners = contact.iter().flat_map(|p| sides.map(|side| corner(p, side)));
    let points: Vec<[f64; 2]> = chain
        .iter()
        .copied()
        .chain([inner])
        .chain(contact.iter().copied())
        .chain(corners)
        .collect();
    let edges = (1..m).map(|j| vec![j, j + 1]);
    let fan = (1..m).map(|j| vec![m + 1, j + 1, j]);
    let stamp = (1..=n).map(|i| vec![m + 1 + i, m + n + 2 * i + 1, m + n + 2 * i]);
    let rows: Vec<Vec<usize>> = edges.chain(fan).chain(stamp).collect();
    let cell = |k: usize, j: usize| match j {
        1 => k,
        2 => rows[k - 1].len() - 1,
        3..6 => 2,
        _ => rows[k - 1].get(j - 6).copied().unwrap_or(0),
    };
    let triangles = m - 1 + n;
    Worksheet {
        node: Table::from_fn(points.len(), 4, |i, j| match j {
            1 => i as f64,
            4 => 0.0,
            _ => points[i - 1][j - 2],
        }),
        elem: Table::from_fn(rows.len(), 8, cell),
        EL: Table::from_fn(triangles, 8, |k, j| cell(m - 1 + k, j)),
        trg: Column::from_vec((1..m).collect()),
        cnt: Column::from_vec((m + 2..m + 2 + n).collect()),
        c_tll: C,
        ind_1: 6,
        S: Column::filled(2 * points.len(), 0),
        Ae: Column::filled(triangles, 0.0),
        B: Column::filled(triangles, nalgebra::SMatrix::zeros()),
        E: Column::filled(triangles, 0.0),
        nu: Column::filled(triangles, 0.0),
        plane: Plane::Strain,
    }
}

/// The shape with every point mapped.
fn mapped(sheet: &Worksheet<f64>, map: impl Fn([f64; 2]) -> [f64; 2]) -> Table<f64> {
    let mut node = sheet.node.clone();
    for n in 1..=sheet.R() {
        [node[(n, 2)], node[(n, 3)]] = map([sheet.node[(n, 2)], sheet.node[(n, 3)]]);
    }
    node
}

fn turned(degrees: f64) -> impl Fn([f64; 2]) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |[x, y]| [cos * x - sin * y, sin * x + cos * y]
}

fn dy(rule: StatusRule, sheet: &Worksheet<f64>, node_n: &Table<f64>) -> Vec<usize> {
    let found = statuses(rule, sheet, &Reading::default(), node_n, &Operations::default());
    found.unwrap_or_else(|failure| panic!("{rule}: {failure}")).dy.as_slice().to_vec()
}

const UPRIGHT: [[f64; 2]; 2] = [[-0.4, 1.0], [0.4, 1.0]];
const FLAT: &[[f64; 2]] = &[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
const ROOF: &[[f64; 2]] = &[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
const VALLEY: &[[f64; 2]] = &[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]];
const SLOPE: &[[f64; 2]] = &[[-2.0, -0.4], [2.0, 0.4]];

/// Name, chain, contact node; statuses by signs, intersection, projection.
type Row = (&'static str, &'static [[f64; 2]], [f64; 2], [usize; 3]);

/// Nodes farther than c_tll from the surface: here line 16 has no say.
const FAR: &[Row] = &[
    ("above", FLAT, [0.3, 0.5], [0, 0, 0]),
    ("deep", FLAT, [0.3, -0.1], [0, 1, 1]),
    ("deep under a node of the surface", FLAT, [0.0, -0.1], [0, 1, 1]),
    ("deeper than its element", FLAT, [0.3, -3.0], [0, 0, 1]),
    ("past the end", FLAT, [1.5, -0.1], [0, 0, 0]),
    ("past the end, a side through the flank", FLAT, [1.02, -0.1], [0, 1, 0]),
    ("above a convex corner", ROOF, [0.0, 1.3], [0, 0, 0]),
    ("beside a convex corner", ROOF, [0.3, 0.9], [0, 0, 0]),
    ("under a convex corner", ROOF, [0.0, 0.9], [0, 1, 1]),
    ("above a concave corner", VALLEY, [0.0, 0.3], [0, 0, 0]),
    ("under a concave corner", VALLEY, [0.0, -0.1], [0, 1, 1]),
    ("above a slope", SLOPE, [1.0, 0.25], [0, 0, 0]),
    ("deep under a slope", SLOPE, [1.0, 0.15], [0, 1, 1]),
];

/// Nodes no farther than c_tll.
const NEAR: &[Row] = &[
    ("within c_tll", FLAT, [0.3, 0.0005], [1, 1, 1]),
    ("on the surface", FLAT, [0.3, 0.0], [1, 1, 1]),
    ("just inside", FLAT, [0.3, -0.0005], [1, 1, 1]),
    ("past the end, within c_tll", FLAT, [1.0005, -0.0002], [1, 1, 1]),
    ("within c_tll of a convex corner", ROOF, [0.0, 1.0005], [1, 1, 1]),
];

/// The nodes of `NEAR` and `FAR` upright.
#[test]
fn each_rule_on_hand_made_scenes() {
    for (name, chain, node, expected) in NEAR.iter().chain(FAR) {
        let sheet = sheet(chain, &[*node], UPRIGHT);
        let found = [StatusRule::Signs, StatusRule::Intersection, StatusRule::Projection]
            .map(|rule| dy(rule, &sheet, &sheet.node)[0]);
        assert_eq!(found, *expected, "{name}");
    }
}

/// Mirrored in y and turned, statuses by projection stay; so do those by intersection away from line 16's vertical distance (C1, C3).
#[test]
fn projection_and_intersection_do_not_depend_on_the_axes() {
    for (k, (name, chain, node, expected)) in NEAR.iter().chain(FAR).enumerate() {
        let sheet = sheet(chain, &[*node], UPRIGHT);
        for degrees in [0.0, 30.0, 90.0, 137.0, 180.0, 270.0, 301.0] {
            for mirrored in [false, true] {
                let turn = turned(degrees);
                let shape = mapped(&sheet, |[x, y]| turn([x, if mirrored { -y } else { y }]));
                let place = format!("{name}, turned by {degrees}, mirrored {mirrored}");
                let projection = dy(StatusRule::Projection, &sheet, &shape);
                assert_eq!(projection, [expected[2]], "{place}");
                if k >= NEAR.len() {
                    assert_eq!(
                        dy(StatusRule::Intersection, &sheet, &shape),
                        [expected[1]],
                        "{place}"
                    );
                }
            }
        }
    }
}

/// C4: node 1 is apart, node 2 inside. The sign rule takes each for the other, and upside down it does not.
#[test]
fn the_sign_rule_depends_on_which_way_is_up() {
    let sheet = sheet(SLOPE, &[[0.8, 0.17], [1.2, 0.23]], UPRIGHT);
    let upside_down = mapped(&sheet, |[x, y]| [x, -y]);
    assert_eq!(dy(StatusRule::Signs, &sheet, &sheet.node), [1, 0]);
    assert_eq!(dy(StatusRule::Signs, &sheet, &upside_down), [0, 1]);
    for rule in [StatusRule::Intersection, StatusRule::Projection] {
        for shape in [&sheet.node, &upside_down] {
            assert_eq!(dy(rule, &sheet, shape), [0, 1], "{rule}");
        }
    }
}

/// C8: with c_tll = 0 a node on its edge is in contact by projection, not by line 16.
#[test]
fn without_a_tolerance_a_touching_node_is_in_contact_by_projection() {
    let sheet = Worksheet { c_tll: 0.0, ..sheet(FLAT, &[[0.3, 0.0]], UPRIGHT) };
    assert_eq!(dy(StatusRule::Signs, &sheet, &sheet.node), [0]);
    assert_eq!(dy(StatusRule::Projection, &sheet, &sheet.node), [1]);
}

/// A vertical edge: line 10, which intersection keeps, divides by zero where the node is in the edge's box; projection knows.
#[test]
fn a_vertical_edge_stops_what_keeps_line_10() {
    let sheet = sheet(&[[-1.0, 0.0], [1.0, 0.0]], &[[0.3, 0.0005]], UPRIGHT);
    let upright = mapped(&sheet, |[x, y]| [y, -x]);
    for rule in [StatusRule::Signs, StatusRule::Intersection] {
        let failure = pairs(rule, &sheet, &Reading::default(), &upright).unwrap_err();
        assert_eq!((failure.line, failure.cause), (10, Cause::Singularity), "{rule}");
    }
    assert_eq!(dy(StatusRule::Projection, &sheet, &upright), [1]);
    let current: Reading = "R5=node_n".parse().unwrap();
    let failure = pairs(StatusRule::Projection, &sheet, &current, &upright).unwrap_err();
    assert_eq!(
        (failure.line, failure.cause),
        (22, Cause::Singularity),
        "its weights are the listing's"
    );
}

/// Sharp corners, where one of the two edges has the point on its wrong side, whichever comes first.
#[test]
fn the_foot_at_a_corner_has_the_right_side() {
    let sharp = [[-0.2, 0.0], [0.0, 1.0], [0.2, 0.0]];
    let notch = [[-0.2, 1.0], [0.0, 0.0], [0.2, 1.0]];
    for (chain, point, distance) in [
        (sharp, [-0.1, 1.1], 0.02_f64.sqrt()),
        (sharp, [0.1, 1.1], 0.02_f64.sqrt()),
        (notch, [-0.1, -0.1], -0.02_f64.sqrt()),
        (notch, [0.1, -0.1], -0.02_f64.sqrt()),
    ] {
        let one = sheet(&chain, &[[9.0, 9.0]], UPRIGHT);
        let other = Worksheet { trg: Column::from_vec(vec![2, 1]), ..one.clone() };
        for sheet in [one, other] {
            let foot = TargetSurface::new(&sheet, &sheet.node).nearest(point).unwrap();
            assert_near("distance", foot.distance, distance, 1.0, &FOOT);
            assert!(foot.beyond == 0.0 && (foot.xi == 0.0 || foot.xi == 1.0), "{foot:?}");
        }
    }
}

/// The foot's edge, place, normal and what lies past the end, turned.
#[test]
fn the_foot_of_a_point() {
    let sheet = sheet(FLAT, &[[9.0, 9.0]], UPRIGHT);
    for degrees in [0.0, 30.0, 90.0, 200.0] {
        let turn = turned(degrees);
        let surface = TargetSurface::new(&sheet, &mapped(&sheet, &turn));
        for (point, edge, xi, distance, beyond) in [
            ([0.25, 0.5], 2, 0.25, 0.5, 0.0),
            ([-0.25, -0.5], 1, 0.75, -0.5, 0.0),
            ([1.3, 0.4], 2, 1.0, 0.5, 0.3),
            ([-1.3, -0.4], 1, 0.0, -0.5, 0.3),
        ] {
            let foot = surface.nearest(turn(point)).unwrap();
            assert_eq!(foot.edge, edge);
            assert_near("xi", foot.xi, xi, 1.0, &FOOT);
            assert_near("distance", foot.distance, distance, 1.0, &FOOT);
            assert_near("beyond", foot.beyond, beyond, 1.0, &FOOT);
            let normal = turn([0.0, 1.0]);
            assert_near("normal x", foot.normal[0], normal[0], 1.0, &FOOT);
            assert_near("normal y", foot.normal[1], normal[1], 1.0, &FOOT);
        }
    }
}

#[test]
fn a_surface_without_an_edge_has_no_foot() {
    let bare = Worksheet { trg: Column::filled(0, 0), ..sheet(FLAT, &[[0.3, -0.1]], UPRIGHT) };
    assert_eq!(TargetSurface::new(&bare, &bare.node).nearest([0.0, 0.0]), None);
    assert_eq!(dy(StatusRule::Projection, &bare, &bare.node), [0]);
}

/// A deep node, outside every box (C9), gets the nearest edge and the listing's weights at it.
#[test]
fn a_lost_node_gets_the_nearest_edge_and_its_weights() {
    let sheet = sheet(FLAT, &[[0.25, -0.1]], UPRIGHT);
    let node = sheet.cnt[1];
    for rule in [StatusRule::Intersection, StatusRule::Projection] {
        let found = pairs(rule, &sheet, &Reading::default(), &sheet.node).unwrap();
        assert_eq!(found.ct.as_slice(), [2], "{rule}");
        assert_eq!(
            found.k_cnt.row(node).copied().collect::<Vec<_>>(),
            [2.0, 0.75, 3.0, 0.25],
            "{rule}"
        );
        let mates = [2, 3].map(|n| found.k_cnt.row(n).copied().collect::<Vec<_>>());
        let own = node as f64;
        assert_eq!(mates, [[own, 0.75, 0.0, 0.0], [own, 0.25, 0.0, 0.0]], "{rule}");
    }
}

/// Where statuses and edges are the listing's, so are the weights, to the last bit, under R1 and R5.
#[test]
fn weights_are_those_of_the_listing() {
    let contact = [[-0.7, 0.0005], [-0.3, -0.0004], [0.2, 0.0], [0.6, 0.0003]];
    let sheet = sheet(FLAT, &contact, UPRIGHT);
    let moved = mapped(&sheet, |[x, y]| [1.01 * x, y]);
    for reading in ["", "R1=inside", "R5=node_n", "R1=inside,R5=node_n"] {
        let reading: Reading = reading.parse().unwrap();
        let printed = c_cnt(&sheet, &reading, &moved).unwrap();
        assert_eq!(printed.dy.as_slice(), [1; 4]);
        for rule in [StatusRule::Intersection, StatusRule::Projection] {
            let found = pairs(rule, &sheet, &reading, &moved).unwrap();
            assert_eq!((&found.ct, &found.dy), (&printed.ct, &printed.dy), "{rule}");
            assert_eq!(found.k_cnt, printed.k_cnt, "{rule}, {:?}", reading.r5 == NodeTable::Node);
        }
    }
}
