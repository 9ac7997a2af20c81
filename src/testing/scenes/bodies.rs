//! Two bodies, and the ways in which one scene of them may be written.

use crate::draws::one_of;
use fastrand::Rng;
use problem::element::Plane;
use problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};

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
            (axis @ (Axis::X | Axis::Y), 0) => axis,
            (Axis::X, _) => Axis::Y,
            (Axis::Y, _) => Axis::X,
            (Axis::Direction(vector), _) => Axis::Direction(self.vector(vector)),
            (of_edges @ (Axis::Normal | Axis::Tangent), _) => of_edges,
        }
    }
}

impl Bodies {
    /// Holds nodes along axes.
    pub fn hold(&mut self, nodes: &[usize], axes: &[Axis]) {
        self.restrained.extend(nodes.iter().map(|node| (*node, axes.to_vec())));
    }

    /// Spreads a force over nodes.
    pub fn load(&mut self, nodes: &[usize], [x, y]: [f64; 2]) {
        let part = 1.0 / nodes.len() as f64;
        self.loads.extend(nodes.iter().map(|node| (*node, [x * part, y * part])));
    }

    /// The smaller of the moduli.
    pub fn softest(&self) -> f64 {
        self.moduli[0].0.min(self.moduli[1].0)
    }

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
                coupling: Some(coupling),
                friction: Some(friction),
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

/// Two blocks on a grid of whole numbers: nodes stand over nodes, ends over ends, as far apart as the
/// tolerance or not at all, and many comparisons are ties.
pub fn regular(rng: &mut Rng) -> Bodies {
    let (below, above) = (rng.usize(3..8), rng.usize(2..6));
    let (from, step) = (one_of(rng, &[0.0, 1.0, 0.5]), one_of(rng, &[1.0, 0.5, 1.5]));
    let gap = one_of(rng, &[0.0, 0.0, 0.0, 0.001, -0.001, 0.01]);
    let rise = one_of(rng, &[0.0, 0.0, 0.0, 0.5, -0.5]);
    let lower = |y: f64, rise: f64| {
        (0..below).map(move |k| [k as f64, y + if k % 2 == 1 { rise } else { 0.0 }])
    };
    let upper = |y: f64| (0..above).map(move |k| [from + step * k as f64, y]);
    let top = f64::max(rise, 0.0) + gap;
    let mut nodes: Vec<[f64; 2]> = lower(-2.0, 0.0).chain(lower(-1.0, 0.0)).collect();
    nodes.extend(lower(0.0, rise));
    let first = nodes.len();
    nodes.extend(upper(top).chain(upper(top + 1.0)));
    let mut target: Vec<[usize; 2]> =
        (0..below - 1).map(|k| [2 * below + k, 2 * below + k + 1]).collect();
    if rng.bool() {
        // Its sides too.
        target.extend([[below, 2 * below], [2 * below - 1, 3 * below - 1]]);
    }
    let both = vec![Axis::X, Axis::Y];
    let mut restrained: Vec<_> = (0..below).map(|n| (n, both.clone())).collect();
    let on_top = first + above;
    match rng.u8(..4) {
        0 => restrained.push((on_top, vec![Axis::X])),
        1 => restrained.extend([on_top, on_top + above - 1].map(|n| (n, both.clone()))),
        _ => restrained.extend([on_top, on_top + above - 1].map(|n| (n, vec![Axis::X]))),
    }
    let side = one_of(rng, &[0.0, 0.0, 1.0, -3.0]);
    let loads = (0..above).map(|k| (on_top + k, [side, -10.0])).collect();
    Bodies {
        nodes,
        triangles: [grid(0, below, 3), grid(first, above, 2)],
        moduli: one_of(rng, &[[(1e4, 0.25); 2], [(1e4, 0.0), (2e4, 0.0)]]),
        contact: (first..first + above).collect(),
        target,
        restrained,
        loads,
    }
}
