//! Random worksheets: the arrays that both listings take, with all that makes them stop.
#![allow(non_snake_case, reason = "the paper's own names")]

use mathcad::array::{Column, Table};
use nalgebra::SMatrix;
use paper::door;
use paper::mirror::{Change, READINGS, Reading, Worksheet};
use problem::element::{self, Plane};
use problem::scene::Scene;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A target edge: how it leaves the last one.
#[derive(Clone, Debug)]
pub enum Step {
    Along(f64, f64),
    NearlyVertical(f64),
    Vertical,
    Back(f64, f64),
}

/// Where a contact node stands relative to a target edge: place along it, and gap.
#[derive(Clone, Debug)]
pub struct Spot {
    edge: Index,
    along: f64,
    gap: Gap,
}

#[derive(Clone, Debug)]
pub enum Gap {
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
    pub steps: Vec<Step>,
    pub turned: Vec<bool>,
    pub duplicated: Option<Index>,
    pub reversed_order: bool,
    pub spots: Vec<Spot>,
    pub duplicated_node: bool,
    pub c_tll: f64,
    pub scale: f64,
    /// Of x before scaling: at a scale of 1e308 a difference of coordinates then overflows, the
    /// coordinates do not.
    pub shift: f64,
    /// Elastic modulus of the first triangle; near the largest number, sums of stiffnesses
    /// overflow.
    pub modulus: f64,
    /// Displacements of the nodes; empty: the initial shape.
    pub moved: Vec<[f64; 2]>,
    pub fixed: Vec<bool>,
    pub triangles: Vec<[Index; 3]>,
    /// Whether triangles without area stay: B is then infinite, and Km overflows.
    pub degenerate: bool,
    pub plane: Plane,
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

/// The worksheet of an embedded scene under the default reading.
pub fn initial(scene: &str) -> Worksheet<f64> {
    door::worksheet(&Scene::open(scene).expect("embedded scenes are sound").model, |x| x)
}
