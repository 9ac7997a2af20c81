//! Corners of the target: no answer depends on the place, the direction or the order in which a
//! scene is written, and no apex passes through the other body.

use crate::common::tolerances::{APEX, INVARIANCE, assert_near};
use plane_contact::engine::contact::Surfaces;
use plane_contact::engine::error::Error;
use plane_contact::engine::{Request, Solution, solve};
use plane_contact::problem::element::Plane;
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};

/// Two bodies by their nodes, numbered from 0.
#[derive(Clone)]
pub struct Bodies {
    pub nodes: Vec<[f64; 2]>,
    /// Triangles of the lower and of the upper body.
    pub triangles: [Vec<[usize; 3]>; 2],
    pub moduli: [(f64, f64); 2],
    pub contact: Vec<usize>,
    pub target: Vec<[usize; 2]>,
    pub restrained: Vec<(usize, Vec<Axis>)>,
    pub loads: Vec<(usize, [f64; 2])>,
}

/// How a scene is written.
#[derive(Clone, Copy, Debug, Default)]
pub struct Writing {
    pub shift: [f64; 2],
    /// By quarter turns, which are exact.
    pub turns: usize,
    /// By an angle beyond them, degrees; restraints in one direction cannot turn with it.
    pub degrees: f64,
    pub mirror: bool,
    pub scale: f64,
    /// The factor of moduli and loads; 0 for 1.
    pub moduli: f64,
    /// The seed of the numbers of nodes and of the order of triangles; 0 for those given.
    pub numbers: u64,
    pub contact_reversed: bool,
    pub contact_shuffled: bool,
    pub target_reversed: bool,
    pub edges_turned: bool,
}

impl Writing {
    /// Returns a vector as it is written, without the shift and the scale.
    pub fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let start = if self.mirror { [-x, y] } else { [x, y] };
        let [x, y] = (0..self.turns).fold(start, |[x, y], _| [-y, x]);
        let (s, c) = self.degrees.to_radians().sin_cos();
        [c * x - s * y, s * x + c * y]
    }

    /// Returns the place of each of `count` things in the order in which they are written.
    pub fn places(&self, count: usize) -> Vec<usize> {
        let mut places: Vec<usize> = (0..count).collect();
        if self.numbers != 0 {
            fastrand::Rng::with_seed(self.numbers).shuffle(&mut places);
        }
        places
    }

    fn point(&self, p: [f64; 2]) -> [f64; 2] {
        let v = self.vector(p);
        [0, 1].map(|d| self.scale() * v[d] + self.shift[d])
    }

    pub fn scale(&self) -> f64 {
        if self.scale == 0.0 { 1.0 } else { self.scale }
    }

    fn moduli(&self) -> f64 {
        if self.moduli == 0.0 { 1.0 } else { self.moduli }
    }

    fn axis(&self, axis: Axis) -> Axis {
        match (axis, self.turns % 2) {
            (axis, 0) => axis,
            (Axis::X, _) => Axis::Y,
            (Axis::Y, _) => Axis::X,
        }
    }
}

impl Bodies {
    /// Writes the scene down, without friction.
    pub fn scene(&self, writing: &Writing, coupling: Coupling, geometry: Geometry) -> SceneBuilder {
        let friction = Friction::NONE;
        self.modelled(writing, ContactModel { coupling, geometry, friction, ..Default::default() })
    }

    /// Writes the scene down with a model of contact.
    pub fn modelled(&self, writing: &Writing, model: ContactModel) -> SceneBuilder {
        let mut mesh = MeshBuilder::default();
        let places = writing.places(self.nodes.len());
        let number = |n: usize| places[n] + 1;
        let mut nodes = vec![[0.0; 2]; self.nodes.len()];
        self.nodes.iter().zip(&places).for_each(|(p, place)| nodes[*place] = writing.point(*p));
        mesh.row(nodes);
        let mut target = self.target.clone();
        if writing.target_reversed {
            target.reverse();
        }
        for [a, b] in &target {
            let edge = if writing.edges_turned { [*b, *a] } else { [*a, *b] };
            mesh.edges("target", &edge.map(number));
        }
        for (name, triangles) in ["lower", "upper"].into_iter().zip(&self.triangles) {
            let of = |t: &usize| {
                let [a, b, c] = triangles[*t].map(number);
                if writing.mirror { [a, c, b] } else { [a, b, c] }
            };
            mesh.triangles(name, writing.places(triangles.len()).iter().map(of));
        }
        let mut contact: Vec<usize> = self.contact.iter().map(|n| number(*n)).collect();
        if writing.contact_reversed {
            contact.reverse();
        }
        if writing.contact_shuffled {
            contact.sort_by_key(|n| (n % 3, *n));
        }
        let [lower, upper] = self.moduli.map(|(e, nu)| (writing.moduli() * e, nu));
        let ContactModel { coupling, friction, geometry, load_steps, status } = model;
        let edges = (1..=target.len()).collect::<Vec<_>>();
        let mut scene = SceneBuilder::new("corner", mesh.finish(), Plane::Strain)
            .material("lower", lower.0, lower.1)
            .material("upper", upper.0, upper.1)
            .variant(Variant::Unilateral)
            .contact(Contact {
                coupling,
                friction,
                geometry,
                load_steps,
                status,
                ..Contact::new(contact, edges, 0.001)
            });
        for (node, axes) in &self.restrained {
            let axes: Vec<Axis> = axes.iter().map(|axis| writing.axis(*axis)).collect();
            scene = scene.restrain_node(number(*node), &axes);
        }
        let factor = writing.scale() * writing.moduli();
        for (node, force) in &self.loads {
            let force = writing.vector(*force).map(|f| factor * f);
            scene = scene.force(number(*node), force);
        }
        scene
    }

    pub fn solved(
        &self,
        writing: &Writing,
        coupling: Coupling,
        geometry: Geometry,
    ) -> Result<Solution, Error> {
        let scene = self.scene(writing, coupling, geometry).build()?;
        solve(&Request::new(&scene), &mut |_| ())
    }
}

/// The triangles of a grid of rows, from node `first`.
pub fn grid(first: usize, columns: usize, rows: usize) -> Vec<[usize; 3]> {
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for k in 0..columns - 1 {
            let a = first + row * columns + k;
            let [b, c, d] = [a + 1, a + 1 + columns, a + columns];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

/// A flat block over the apex of a symmetric roof, whose height is `apex`, and which touches where
/// `gap` is 0.
pub fn roof(apex: f64, gap: f64) -> Bodies {
    let mut nodes = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, apex]];
    let rows = [0.0, 1.0, 2.0].map(|y| apex + gap + y);
    nodes.extend(rows.iter().flat_map(|y| [0.0, 1.0, 2.0].map(|x| [x, *y])));
    let upper = [
        [4, 5, 8],
        [4, 8, 7],
        [5, 6, 8],
        [6, 9, 8],
        [7, 8, 11],
        [7, 11, 10],
        [8, 9, 11],
        [9, 12, 11],
    ];
    Bodies {
        nodes,
        triangles: [vec![[0, 1, 3], [1, 2, 3]], upper.to_vec()],
        moduli: [(30000.0, 0.2), (210000.0, 0.3)],
        contact: vec![4, 5, 6],
        target: vec![[0, 3], [3, 2]],
        restrained: vec![
            (0, vec![Axis::X, Axis::Y]),
            (1, vec![Axis::X, Axis::Y]),
            (2, vec![Axis::X, Axis::Y]),
            (8, vec![Axis::X]),
            (11, vec![Axis::X]),
        ],
        loads: [10, 11, 12]
            .into_iter()
            .zip([3.15, 6.3, 3.15])
            .map(|(n, f)| (n, [0.0, -f]))
            .collect(),
    }
}

/// Two blocks whose wavy surfaces have convex and concave corners of up to 53 degrees.
pub fn blocks() -> Bodies {
    let heights = [3.2726, 3.6942, 3.0988, 2.3587, 2.5581, 3.4049, 3.6585];
    let middle = [1.6363, 1.7261, 1.4101, 1.2564, 1.4704, 1.7629, 1.8293];
    let below = [4.0150, 4.1470, 3.7643, 3.1076, 2.8062, 3.0962, 3.8175, 4.1537];
    let above = [4.7641, 4.9327, 4.5547, 4.2705, 4.0525, 4.4068, 4.5210, 4.8479];
    let lower_x = |k: usize| k as f64;
    let upper_x = |k: usize| 0.35 + 5.3 / 7.0 * k as f64;
    let mut nodes = Vec::new();
    nodes.extend((0..7).map(|k| [lower_x(k), 0.0]));
    nodes.extend((0..7).map(|k| [lower_x(k), middle[k]]));
    nodes.extend((0..7).map(|k| [lower_x(k), heights[k]]));
    nodes.extend((0..8).map(|k| [upper_x(k), below[k]]));
    nodes.extend((0..8).map(|k| [upper_x(k), above[k]]));
    nodes.extend((0..8).map(|k| [upper_x(k), 5.5]));
    let mut restrained: Vec<_> = (0..7).map(|n| (n, vec![Axis::X, Axis::Y])).collect();
    restrained.extend([(37, vec![Axis::X]), (44, vec![Axis::X])]);
    Bodies {
        nodes,
        triangles: [grid(0, 7, 3), grid(21, 8, 3)],
        moduli: [(3705.0, 0.04), (411.0, 0.26)],
        contact: (21..29).collect(),
        target: (0..6).map(|k| [15 + k, 14 + k]).collect(),
        restrained,
        loads: (37..45).map(|n| (n, [0.0, -40.0])).collect(),
    }
}

pub fn writings() -> Vec<Writing> {
    let w = Writing::default();
    vec![
        Writing { shift: [0.1, 0.1], ..w },
        Writing { shift: [0.1, -0.3], target_reversed: true, ..w },
        Writing { shift: [1e3, 0.0], ..w },
        Writing { shift: [-1e3, 1e3], edges_turned: true, ..w },
        Writing { turns: 1, ..w },
        Writing { turns: 2, contact_reversed: true, ..w },
        Writing { turns: 3, shift: [0.1, 0.7], ..w },
        Writing { mirror: true, ..w },
        Writing { mirror: true, shift: [0.1, 0.0], target_reversed: true, ..w },
        Writing { scale: 1e-3, ..w },
        Writing { scale: 1e3, shift: [0.1, 0.1], ..w },
        Writing { contact_reversed: true, ..w },
        Writing { contact_shuffled: true, ..w },
        Writing { target_reversed: true, ..w },
        Writing { edges_turned: true, ..w },
    ]
}

fn displacement(solution: &Solution, node: usize) -> [f64; 2] {
    NodeId::new(node).components(&solution.u)
}

/// Asserts that displacements do not depend on the writing; `Err` must be one everywhere.
fn assert_invariant(name: &str, bodies: &Bodies, coupling: Coupling, geometry: Geometry) {
    let plain = bodies.solved(&Writing::default(), coupling, geometry);
    for writing in writings() {
        let what = format!("{name}, {coupling}, {geometry:?}, {writing:?}");
        let other = bodies.solved(&writing, coupling, geometry);
        let (plain, other) = match (&plain, &other) {
            (Ok(plain), Ok(other)) => (plain, other),
            (Err(_), Err(_)) => continue,
            (one, other) => panic!("{what}: {:?} {:?}", one.as_ref().err(), other.as_ref().err()),
        };
        for node in 0..bodies.nodes.len() {
            let expected = writing.vector(displacement(plain, node));
            let of = displacement(other, node);
            for d in [0, 1] {
                let scale = plain.u.amax();
                assert_near(&what, of[d] / writing.scale(), expected[d], scale, &INVARIANCE);
            }
        }
    }
}

#[test]
fn a_roof_has_one_answer_however_it_is_written() {
    for gap in [0.0, 0.05] {
        for apex in [0.7, 0.2, 1.1] {
            for geometry in [Geometry::Initial, Geometry::Current] {
                assert_invariant("roof", &roof(apex, gap), Coupling::Nts, geometry);
            }
        }
    }
}

#[test]
fn blocks_with_corners_have_one_answer_however_they_are_written() {
    for coupling in [Coupling::Nts, Coupling::Mortar] {
        assert_invariant("blocks", &blocks(), coupling, Geometry::Initial);
    }
}

/// The answer of a symmetric scene is symmetric.
#[test]
fn a_symmetric_roof_has_a_symmetric_answer() {
    for (apex, gap) in [(0.7, 0.05), (0.7, 0.0), (1.1, 0.05), (1.1, 0.0), (3.0, 0.05)] {
        let bodies = roof(apex, gap);
        let solution =
            bodies.solved(&Writing::default(), Coupling::Nts, Geometry::Initial).unwrap();
        let of = |node| displacement(&solution, node);
        let scale = solution.u.amax();
        assert_near("apex", of(5)[0], 0.0, scale, &INVARIANCE);
        assert_near("sides", of(4)[1], of(6)[1], scale, &INVARIANCE);
    }
}

/// The apex holds the block, however sharp it is and whether or not it touches at the start.
#[test]
fn no_apex_passes_through_the_block() {
    for apex in [0.5, 0.99, 1.0, 1.01, 1.1, 2.0, 5.0, 20.0] {
        for gap in [0.0, 0.05] {
            for geometry in [Geometry::Initial, Geometry::Current] {
                let bodies = roof(apex, gap);
                let solution = bodies.solved(&Writing::default(), Coupling::Nts, geometry).unwrap();
                let pressing: Vec<usize> = solution.in_contact().map(|c| c.node.index()).collect();
                assert_eq!(pressing, [5], "apex {apex}, gap {gap}, {geometry:?}");
                let (block, tip) = (displacement(&solution, 5)[1], displacement(&solution, 3)[1]);
                assert_near("gap", gap + block - tip, 0.0, 1.0, &APEX);
            }
        }
    }
}

fn surfaces(scene: &Scene) -> Surfaces {
    Surfaces::new(&scene.model).unwrap()
}

/// A shape turned by any angle has the same pairings, turned.
#[test]
fn pairings_turn_with_the_shape() {
    for bodies in [blocks(), roof(0.7, 0.05), roof(1.1, 0.0)] {
        let scene =
            bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
        let of = |shape: &[[f64; 2]], coupling| surfaces(&scene).pairings(coupling, shape);
        // The shape alone turns; which surfaces face each other is decided without it.
        for angle in [0.1_f64, 0.7, 1.0, 2.5] {
            let (s, c) = angle.sin_cos();
            let turn = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
            let turned: Vec<[f64; 2]> = scene.model.nodes.iter().map(|p| turn(*p)).collect();
            for coupling in [Coupling::Nts, Coupling::Mortar] {
                let pairs = of(&scene.model.nodes, coupling).into_iter().zip(of(&turned, coupling));
                for (one, other) in pairs {
                    let (Some(one), Some(other)) = (&one, &other) else {
                        // The cone of a vertex faces the node by the direction in the shape.
                        continue;
                    };
                    let expected = turn(one.normal);
                    assert_near("gap", other.gap, one.gap, 1.0, &INVARIANCE);
                    for d in [0, 1] {
                        assert_near("normal", other.normal[d], expected[d], 1.0, &INVARIANCE);
                    }
                }
            }
        }
    }
}

/// A node inside a convex corner and equally near to both faces is paired with the vertex.
#[test]
fn a_node_on_the_bisector_is_paired_with_the_vertex() {
    let bodies = roof(0.7, 0.05);
    let scene =
        bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
    for (depth, gap) in [(0.2, -0.2), (0.0, 0.0), (-0.3, 0.3)] {
        let mut shape = scene.model.nodes.clone();
        shape[5] = [1.0, 0.7 - depth];
        let pairing = surfaces(&scene).pairings(Coupling::Nts, &shape)[1].clone().unwrap();
        assert_eq!(pairing.masters, [(NodeId::new(3), 1.0)]);
        assert_near("gap", pairing.gap, gap, 1.0, &INVARIANCE);
        assert_near("normal", pairing.normal[1], 1.0, 1.0, &INVARIANCE);
    }
}

/// A tip of the target that enters the block between two contact nodes is found.
#[test]
fn a_target_node_in_the_contact_body_is_found() {
    let mut bodies = roof(0.7, 0.05);
    bodies.nodes[3][0] = 1.4;
    let scene =
        bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial).build().unwrap();
    let mut shape = scene.model.nodes.clone();
    assert_eq!(surfaces(&scene).deepest_target_node(&shape), None);
    shape[3][1] = 0.85;
    let (node, depth) = surfaces(&scene).deepest_target_node(&shape).unwrap();
    assert_eq!(node, NodeId::new(3));
    assert_near("depth", depth, 0.1, 1.0, &INVARIANCE);
}
