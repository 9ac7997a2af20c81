//! Structured meshes, and a field's exact tractions on their boundary.

use plane_contact::problem::modelling::Variant;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use plane_contact::problem::scene::{Axis, MeshBuilder, Scene, SceneBuilder};

use super::fields::Field;

/// How each cell of the grid is cut in two.
#[derive(Clone, Copy, Debug)]
pub enum Cut {
    /// Every cell by the same diagonal.
    Same,
    /// Neighbours by different diagonals: nodes with four and with eight triangles.
    Alternating,
}

/// A grid of `cells` on the unit square, mapped to the domain.
#[derive(Clone, Copy)]
pub struct Grid {
    pub cells: [usize; 2],
    pub map: fn([f64; 2]) -> [f64; 2],
    pub cut: Cut,
    /// How far inner nodes are moved, as a part of a cell.
    pub distortion: f64,
}

pub fn rectangle([s, t]: [f64; 2]) -> [f64; 2] {
    [2.0 * s, t]
}

pub fn beam([s, t]: [f64; 2]) -> [f64; 2] {
    [8.0 * s, 2.0 * t - 1.0]
}

/// A quarter of the annulus of radii 10 and 20.
pub fn annulus([s, t]: [f64; 2]) -> [f64; 2] {
    polar(10.0 * (1.0 + s), t)
}

/// A quarter of a plate with side 8 and a hole of radius 1; cells grow away from the hole.
pub fn holed_plate([s, t]: [f64; 2]) -> [f64; 2] {
    let [x, y] = polar(1.0, t);
    let edge = 4.0 / x.max(y);
    let r = edge.powf(s);
    [r * x, r * y]
}

fn polar(r: f64, t: f64) -> [f64; 2] {
    [r * (FRAC_PI_2 * t).cos(), r * (FRAC_PI_2 * t).sin()]
}

impl Grid {
    /// Node coordinates, row by row.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let [nx, ny] = self.cells;
        let at = |i: usize, j: usize| {
            let inner = 0 < i && i < nx && 0 < j && j < ny;
            let moved = if inner { self.distortion } else { 0.0 };
            let [di, dj] = [noise(i, j), noise(j + 100, i)].map(|x| moved * x);
            (self.map)([(i as f64 + di) / nx as f64, (j as f64 + dj) / ny as f64])
        };
        (0..=ny).flat_map(|j| (0..=nx).map(move |i| at(i, j))).collect()
    }

    /// Corners of each triangle, counter-clockwise, from 0.
    pub fn triangles(&self) -> Vec<[usize; 3]> {
        let [nx, ny] = self.cells;
        let cell = |i: usize, j: usize| {
            let a = j * (nx + 1) + i;
            let [b, c, d] = [a + 1, a + nx + 2, a + nx + 1];
            match self.cut {
                Cut::Alternating if (i + j) % 2 == 1 => [[a, b, d], [b, c, d]],
                _ => [[a, b, c], [a, c, d]],
            }
        };
        (0..ny).flat_map(|j| (0..nx).flat_map(move |i| cell(i, j))).collect()
    }

    /// The scene of `field`: the exact tractions as loads, and three restraints against rigid
    /// motion.
    pub fn scene(&self, field: &Field, thickness: f64) -> Scene {
        let (points, triangles) = (self.points(), self.triangles());
        let forces = tractions(field, &points, &triangles, thickness);
        let scene = SceneBuilder::new("test", mesh(&points, &triangles).finish(), field.plane)
            .variant(Variant::Stepped)
            .thickness(thickness)
            .material(BODY, field.e, field.nu)
            .restrain_node(1, &[Axis::X, Axis::Y])
            .restrain_node(self.cells[0] + 1, &[Axis::Y])
            .iterations(1);
        let loaded = forces.into_iter().fold(scene, |scene, (n, force)| scene.force(n + 1, force));
        loaded.build().expect("a sound scene")
    }
}

/// −1 to 1, the same on every machine.
fn noise(i: usize, j: usize) -> f64 {
    ((i * 7919 + j * 104_729 + i * j * 31) % 199) as f64 / 99.0 - 1.0
}

/// The group of the triangles of a mesh.
pub const BODY: &str = "body";

/// A mesh of `points` and of `triangles`, which count points from 0.
pub fn mesh(points: &[[f64; 2]], triangles: &[[usize; 3]]) -> MeshBuilder {
    let mut mesh = MeshBuilder::default();
    let nodes = mesh.row(points.iter().copied());
    mesh.triangles(BODY, triangles.iter().map(|t| t.map(|point| nodes[point])));
    mesh
}

/// Nodal forces of the field's tractions on the boundary edges, by three Gauss points an edge.
fn tractions(
    field: &Field,
    points: &[[f64; 2]],
    triangles: &[[usize; 3]],
    thickness: f64,
) -> BTreeMap<usize, [f64; 2]> {
    let mut forces: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for [a, b] in boundary(triangles) {
        let [p, q] = [points[a], points[b]].map(Vector2::from);
        // Outward normal times length: the triangle lies to the left of a -> b.
        let normal = Vector2::new(q.y - p.y, p.x - q.x);
        for (at, weight) in GAUSS {
            let point = p + (q - p) * at;
            let s = (field.stress)([point.x, point.y]);
            let t = [s[0] * normal.x + s[2] * normal.y, s[2] * normal.x + s[1] * normal.y];
            for (node, share) in [(a, 1.0 - at), (b, at)] {
                let force = forces.entry(node).or_default();
                (0..2).for_each(|d| force[d] += weight * share * thickness * t[d]);
            }
        }
    }
    forces
}

/// Points and weights on 0 to 1.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// The edges of one triangle only, in its direction.
fn boundary(triangles: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let edges = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let all: std::collections::BTreeSet<[usize; 2]> = triangles.iter().flat_map(edges).collect();
    all.iter().copied().filter(|[a, b]| !all.contains(&[*b, *a])).collect()
}
