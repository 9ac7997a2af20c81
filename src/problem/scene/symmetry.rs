//! Half of a scene that is its own mirror image about a vertical line.
//!
//! Mesh, materials, restraints, loads and contact surfaces must be symmetric, and no triangle may lie across the line: then the
//! solution is symmetric too, the line moves along itself only, and the half right of it, held in x on the line, has the same one.

use std::collections::{HashMap, HashSet};

use nalgebra::DVector;

use super::{Body, Scene};
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::Worksheet;

/// How far from its image's place a node may lie, of the scene's size: mesh generators round as they go.
const PLACE: f64 = 1e-9;

/// How far a load may be from its image, of the largest.
const LOAD: f64 = 1e-9;

/// Half of a scene.
#[derive(Clone, Debug)]
pub struct Half {
    /// The half right of the line.
    pub scene: Scene,
    /// The whole scene's number of each of its nodes.
    pub nodes: Vec<usize>,
    /// The whole scene's row of `EL` of each of its triangles.
    pub triangles: Vec<usize>,
    /// Where the line stands: x, length.
    pub at: f64,
    /// Largest distance of a node from its image's place, length.
    pub departure: f64,
}

/// Half of `scene`; nothing where it is not symmetric about a vertical line.
pub fn half(scene: &Scene) -> Option<Half> {
    let mirror = Mirror::new(scene)?;
    let sheet = &scene.sheet;
    let images = mirror.images()?;
    let symmetric =
        mirror.triangles(&images) && mirror.surfaces(&images) && mirror.conditions(scene, &images);
    if !symmetric {
        return None;
    }
    let right = |n: usize| mirror.side(n) >= 0;
    let triangles: Vec<usize> =
        (1..=sheet.M()).filter(|&n| corners(sheet, n).into_iter().all(right)).collect();
    let mut nodes: Vec<usize> = triangles.iter().flat_map(|&n| corners(sheet, n)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let departure = nodes.iter().map(|&n| mirror.distance(n, images[n])).fold(0.0, f64::max);
    let scene = restricted(scene, &mirror, &nodes, &triangles);
    Some(Half { scene, nodes, triangles, at: mirror.at, departure })
}

fn corners(sheet: &Worksheet<f64>, n: usize) -> [usize; 3] {
    [0, 1, 2].map(|k| sheet.EL[(n, sheet.ind_1 + k)])
}

struct Mirror<'a> {
    sheet: &'a Worksheet<f64>,
    bodies: &'a [Body],
    /// x of the line.
    at: f64,
    /// Below this a distance is none.
    place: f64,
}

impl<'a> Mirror<'a> {
    /// The only line that can be one; nothing where a triangle lies across it.
    fn new(scene: &'a Scene) -> Option<Self> {
        let sheet = &scene.sheet;
        let range = |column: usize| {
            let values = (1..=sheet.R()).map(|n| sheet.node[(n, column)]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let ((left, right), (low, high)) = (range(2), range(3));
        let (at, place) = (left + (right - left) / 2.0, PLACE * (right - left).max(high - low));
        let mirror = Mirror { sheet, bodies: &scene.bodies, at, place };
        let across = |n: usize| {
            let sides = corners(sheet, n).map(|c| mirror.side(c));
            sides.contains(&1) && sides.contains(&-1)
        };
        if (1..=sheet.M()).any(across) { None } else { Some(mirror) }
    }

    /// -1 left of the line, 0 on it, 1 right of it.
    fn side(&self, n: usize) -> i32 {
        let x = self.sheet.node[(n, 2)] - self.at;
        if x.abs() <= self.place { 0 } else { x.signum() as i32 }
    }

    /// From where the image of node `n` should stand to node `m`.
    fn distance(&self, n: usize, m: usize) -> f64 {
        let node = &self.sheet.node;
        (2.0 * self.at - node[(n, 2)] - node[(m, 2)]).hypot(node[(n, 3)] - node[(m, 3)])
    }

    /// The image of each node, from 1 on; nothing where a node has none.
    fn images(&self) -> Option<Vec<usize>> {
        let cell = |x: f64| (x / (4.0 * self.place)).round() as i64;
        let mut cells: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        let node = &self.sheet.node;
        for n in 1..=self.sheet.R() {
            cells.entry([cell(node[(n, 2)]), cell(node[(n, 3)])]).or_default().push(n);
        }
        let body = |n: usize| self.bodies.iter().position(|b| b.nodes.binary_search(&n).is_ok());
        let image = |n: usize| {
            let [x, y] = [cell(2.0 * self.at - node[(n, 2)]), cell(node[(n, 3)])];
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x + i, y + j]));
            let near = around.filter_map(|at| cells.get(&at)).flatten().copied();
            let found: Vec<usize> = near.filter(|&m| self.distance(n, m) <= self.place).collect();
            // Where bodies touch, two nodes stand at one place: a body on the line is its own image.
            match found.as_slice() {
                [one] => Some(*one),
                several => several.iter().copied().find(|&m| body(m) == body(n)),
            }
        };
        let images: Option<Vec<usize>> = (1..=self.sheet.R()).map(image).collect();
        let images: Vec<usize> = std::iter::once(0).chain(images?).collect();
        if (1..images.len()).all(|n| images[images[n]] == n) { Some(images) } else { None }
    }

    /// That triangles and their materials are symmetric.
    fn triangles(&self, images: &[usize]) -> bool {
        let sheet = self.sheet;
        let key = |mut nodes: [usize; 3], n: usize| {
            nodes.sort_unstable();
            (nodes, sheet.E[n].to_bits(), sheet.nu[n].to_bits())
        };
        let all: HashSet<_> = (1..=sheet.M()).map(|n| key(corners(sheet, n), n)).collect();
        (1..=sheet.M()).all(|n| all.contains(&key(corners(sheet, n).map(|c| images[c]), n)))
    }

    /// That the contact surfaces are, as sets.
    fn surfaces(&self, images: &[usize]) -> bool {
        let sheet = self.sheet;
        let cnt: HashSet<usize> = sheet.cnt.iter().copied().collect();
        let ends = |e: &usize| [sheet.elem[(*e, 6)], sheet.elem[(*e, 7)]];
        let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let trg: HashSet<[usize; 2]> = sheet.trg.iter().map(|e| sorted(ends(e))).collect();
        cnt.iter().all(|&n| cnt.contains(&images[n]))
            && trg.iter().all(|edge| trg.contains(&sorted(edge.map(|n| images[n]))))
    }

    /// That restraints and loads are.
    fn conditions(&self, scene: &Scene, images: &[usize]) -> bool {
        let (held, load) = (&self.sheet.S, &scene.load);
        let near = LOAD * load.amax();
        (1..images.len()).all(|n| {
            let m = images[n];
            held[2 * n - 1] == held[2 * m - 1]
                && held[2 * n] == held[2 * m]
                && (load[2 * n - 2] + load[2 * m - 2]).abs() <= near
                && (load[2 * n - 1] - load[2 * m - 1]).abs() <= near
        })
    }
}

/// `scene` on some of its nodes and triangles; those on the line are held in x and carry half of their load.
fn restricted(scene: &Scene, mirror: &Mirror, nodes: &[usize], triangles: &[usize]) -> Scene {
    let number: HashMap<usize, usize> =
        nodes.iter().enumerate().map(|(k, n)| (*n, k + 1)).collect();
    let share = |n: usize| if mirror.side(n) == 0 { 0.5 } else { 1.0 };
    let load = nodes.iter().flat_map(|&n| {
        let x = if mirror.side(n) == 0 { 0.0 } else { scene.load[2 * n - 2] };
        [x, share(n) * scene.load[2 * n - 1]]
    });
    let of_body = |body: &Body| Body {
        name: body.name.clone(),
        triangles: (1..=triangles.len())
            .filter(|k| body.triangles.binary_search(&triangles[k - 1]).is_ok())
            .collect(),
        nodes: body.nodes.iter().filter_map(|n| number.get(n).copied()).collect(),
    };
    let bodies = scene.bodies.iter().map(of_body).filter(|body| !body.triangles.is_empty());
    Scene {
        bodies: bodies.collect(),
        load: DVector::from_iterator(2 * nodes.len(), load),
        sheet: worksheet(mirror, nodes, triangles, &number),
        source: None,
        ..scene.clone()
    }
}

fn worksheet(
    mirror: &Mirror,
    nodes: &[usize],
    triangles: &[usize],
    number: &HashMap<usize, usize>,
) -> Worksheet<f64> {
    let whole = mirror.sheet;
    let kept = |e: usize| {
        let ends = (whole.ind_1..=8).map(|j| whole.elem[(e, j)]).filter(|n| *n != 0);
        ends.clone().count() > 0 && ends.clone().all(|n| number.contains_key(&n))
    };
    let entry = |row: &dyn Fn(usize) -> usize, j: usize| {
        if j < whole.ind_1 { row(j) } else { number.get(&row(j)).copied().unwrap_or(0) }
    };
    let held = nodes
        .iter()
        .flat_map(|&n| [if mirror.side(n) == 0 { 1 } else { whole.S[2 * n - 1] }, whole.S[2 * n]]);
    let cnt = whole.cnt.iter().filter_map(|n| number.get(n).copied()).collect();
    let trg = whole.trg.iter().copied().filter(|&e| kept(e)).collect();
    let of = |values: &Column<f64>| {
        Column::from_vec(triangles.iter().map(|&n| values[n]).collect::<Vec<f64>>())
    };
    Worksheet {
        node: Table::from_fn(nodes.len(), 4, |i, j| match j {
            1 => i as f64,
            _ => whole.node[(nodes[i - 1], j)],
        }),
        elem: Table::from_fn(whole.elem.rows(), 8, |e, j| {
            if kept(e) { entry(&|j| whole.elem[(e, j)], j) } else { 0 }
        }),
        EL: Table::from_fn(triangles.len(), 8, |n, j| {
            entry(&|j| whole.EL[(triangles[n - 1], j)], j)
        }),
        trg: Column::from_vec(trg),
        cnt: Column::from_vec(cnt),
        S: Column::from_vec(held.collect()),
        Ae: of(&whole.Ae),
        B: Column::from_vec(triangles.iter().map(|&n| whole.B[n]).collect()),
        E: of(&whole.E),
        nu: of(&whole.nu),
        ..whole.clone()
    }
}
