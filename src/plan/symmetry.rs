//! Whether a scene is its own mirror image: mesh, materials, restraints, loads and contact.

use std::collections::{HashMap, HashSet};

use serde::Serialize;

use crate::choices;
use crate::mirror::Worksheet;
use crate::scene::Scene;

/// How far, of the scene's size, a node may lie from its mirror image's place.
const PLACE: f64 = 1e-9;

/// How far, of the largest one, a load may be from its mirror image.
const LOAD: f64 = 1e-9;

choices! {
    /// The direction across the line of symmetry.
    Axis {
        /// x ← 2 at − x.
        X = "x",
        /// y ← 2 at − y.
        Y = "y",
    }
}

/// A mirror symmetry.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Symmetry {
    /// The direction that it turns round.
    pub across: Axis,
    /// Where the line of symmetry lies along it, length.
    pub at: f64,
    /// Nodes that half the scene needs: on the line and on one side.
    pub nodes_of_half: usize,
}

/// The symmetries of a scene.
pub fn find(scene: &Scene, sheet: &Worksheet<f64>) -> Vec<Symmetry> {
    Axis::ALL.iter().filter_map(|&across| Mirror::new(scene, sheet, across)?.symmetry()).collect()
}

/// A mirror that maps the nodes of a scene on themselves.
struct Mirror<'a> {
    scene: &'a Scene,
    sheet: &'a Worksheet<f64>,
    across: Axis,
    at: f64,
    /// For each node, from 1, its image; entry 0 unused.
    image: Vec<usize>,
}

impl<'a> Mirror<'a> {
    fn new(scene: &'a Scene, sheet: &'a Worksheet<f64>, across: Axis) -> Option<Self> {
        let column = across.column();
        let values = (1..=sheet.R()).map(|n| sheet.node[(n, column)]);
        let (low, high) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let at = low + (high - low) / 2.0;
        let image = images(scene, sheet, column, at, PLACE * (high - low))?;
        Some(Mirror { scene, sheet, across, at, image })
    }

    fn symmetry(&self) -> Option<Symmetry> {
        let symmetric =
            self.triangles() && self.restraints() && self.loads() && self.contact_surfaces();
        let column = self.across.column();
        let own_side = |n: &usize| self.image[*n] == *n || self.sheet.node[(*n, column)] > self.at;
        symmetric.then(|| Symmetry {
            across: self.across,
            at: self.at,
            nodes_of_half: (1..=self.sheet.R()).filter(own_side).count(),
        })
    }

    /// Triangles of the same material on both sides.
    fn triangles(&self) -> bool {
        let sheet = self.sheet;
        let corners = |n: usize| [0, 1, 2].map(|k| sheet.EL[(n, sheet.ind_1 + k)]);
        let material = |n: usize| (sheet.E[n].to_bits(), sheet.nu[n].to_bits());
        let all: HashMap<[usize; 3], (u64, u64)> =
            (1..=sheet.M()).map(|n| (sorted(corners(n)), material(n))).collect();
        let mirrored = |n: usize| all.get(&sorted(corners(n).map(|c| self.image[c])));
        (1..=sheet.M()).all(|n| mirrored(n) == Some(&material(n)))
    }

    fn restraints(&self) -> bool {
        let s = |n: usize| [self.sheet.S[2 * n - 1], self.sheet.S[2 * n]];
        (1..=self.sheet.R()).all(|n| s(n) == s(self.image[n]))
    }

    /// Loads, on free equations: the component across turns round.
    fn loads(&self) -> bool {
        let load = |n: usize, d: usize| match self.sheet.S[2 * n - 1 + d] {
            1 => 0.0,
            _ => self.scene.load[2 * n - 2 + d],
        };
        let limit = LOAD * self.scene.load.amax();
        let turned = |d: usize| if d == self.across.column() - 2 { -1.0 } else { 1.0 };
        let equal =
            |n: usize, d: usize| (load(n, d) - turned(d) * load(self.image[n], d)).abs() <= limit;
        (1..=self.sheet.R()).all(|n| [0, 1].into_iter().all(|d| equal(n, d)))
    }

    fn contact_surfaces(&self) -> bool {
        let sheet = self.sheet;
        let nodes: HashSet<usize> = sheet.cnt.iter().copied().collect();
        let ends = |e: usize| [6, 7].map(|column| sheet.elem[(e, column)]);
        let edges: HashSet<[usize; 2]> = sheet.trg.iter().map(|&e| sorted(ends(e))).collect();
        nodes.iter().all(|n| nodes.contains(&self.image[*n]))
            && edges.iter().all(|e| edges.contains(&sorted(e.map(|n| self.image[n]))))
    }
}

impl Axis {
    /// Its column of `node`.
    fn column(self) -> usize {
        match self {
            Axis::X => 2,
            Axis::Y => 3,
        }
    }
}

/// For each node its image; nothing where a node has none. Of two nodes in one place the one of the same body is taken.
fn images(
    scene: &Scene,
    sheet: &Worksheet<f64>,
    column: usize,
    at: f64,
    close: f64,
) -> Option<Vec<usize>> {
    let mut body = vec![0; sheet.R() + 1];
    for (k, of) in scene.bodies.iter().enumerate() {
        of.nodes.iter().for_each(|n| body[*n] = k);
    }
    let place = |n: usize| [sheet.node[(n, 2)], sheet.node[(n, 3)]];
    let mut by_x: Vec<usize> = (1..=sheet.R()).collect();
    by_x.sort_by(|a, b| place(*a)[0].total_cmp(&place(*b)[0]));
    let mut image = vec![0; sheet.R() + 1];
    for n in 1..=sheet.R() {
        let mut there = place(n);
        there[column - 2] = 2.0 * at - there[column - 2];
        let from = by_x.partition_point(|m| place(*m)[0] < there[0] - close);
        let within = by_x[from..].iter().take_while(|m| place(**m)[0] <= there[0] + close);
        let near = within.filter(|m| (place(**m)[1] - there[1]).abs() <= close);
        image[n] = *near.min_by_key(|m| (body[**m] != body[n], **m))?;
    }
    Some(image)
}

fn sorted<const N: usize>(mut nodes: [usize; N]) -> [usize; N] {
    nodes.sort_unstable();
    nodes
}
