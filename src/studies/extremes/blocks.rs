//! The scene that most generators start from: a block of three triangles, and a stamp of three on
//! it.
//!
//! ```text
//!         10----9     y = 3.7     pressure; x restrained
//!         /|  / |
//!        6--7---8     y = 2       contact nodes 6, 7, 8 on the target edges 4-5 and 5-3
//!      4-----5-----3
//!      |   /  \    |
//!      1-----------2  y = 0       restrained
//! ```

use problem::element::Plane;
use problem::modelling::{Geometry, Variant};
use problem::scene::{Axis, Contact, Mesh, MeshBuilder, SceneBuilder};

/// What a generator may change of the scene.
pub struct Blocks {
    pub length: f64,
    /// What is added to each coordinate, length.
    pub origin: f64,
    /// Elastic moduli of block and stamp, stress.
    pub e: [f64; 2],
    /// Poisson's ratio of both.
    pub nu: f64,
    /// Pressure on the stamp, stress.
    pub pressure: f64,
    /// Tolerance of the contact search, length.
    pub c_tll: f64,
    pub iterations: usize,
    /// Distance of an eleventh node from the edge 1-5, in lengths: a sliver stands on that edge.
    pub sliver: Option<f64>,
}

/// Coordinates x and y of the ten nodes, in lengths.
const X: [f64; 10] = [0.0, 3.0, 3.0, 0.0, 1.6, 0.4, 1.3, 2.7, 2.5, 0.6];
const Y: [f64; 10] = [0.0, 0.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 3.7, 3.7];

/// Tags of the bodies' groups of triangles, then of the groups of edges.
const BLOCK: usize = 1;
const STAMP: usize = 2;
const BOTTOM: usize = 10;
const TARGET: usize = 11;
const CONTACT: usize = 20;
const TOP: usize = 21;

impl Blocks {
    /// Blocks with nothing extreme.
    pub fn new() -> Self {
        Blocks {
            length: 1.0,
            origin: 0.0,
            e: [30000.0, 210000.0],
            nu: 0.3,
            pressure: 6.3,
            c_tll: 1e-3,
            iterations: 1,
            sliver: None,
        }
    }

    /// The scene on which `variant` runs. `printed` joins no bodies: the stamp is restrained at its
    /// top in both directions, and forces act at nodes 5 and 7.
    pub fn scene(&self, variant: Variant) -> SceneBuilder {
        let contact = Contact::new(vec![6, 7, 8], vec![1, 2], self.c_tll);
        let scene = SceneBuilder::new("extreme", self.mesh(), Plane::Strain)
            .variant(Variant::Stepped)
            .material(BLOCK, self.e[0], self.nu)
            .material(STAMP, self.e[1], self.nu)
            .restrain(BOTTOM, &[Axis::X, Axis::Y])
            .contact(Contact { geometry: Geometry::Initial, ..contact })
            .iterations(self.iterations);
        if variant != Variant::Printed {
            return scene.restrain(TOP, &[Axis::X]).pressure(TOP, self.pressure);
        }
        let force = self.pressure * self.length;
        scene
            .restrain(TOP, &[Axis::X, Axis::Y])
            .force(5, [0.3 * force, -force])
            .force(7, [-force, 0.7 * force])
    }

    fn mesh(&self) -> Mesh {
        let mut mesh = MeshBuilder::default();
        let beside = |height: f64| [0.45 * 1.6 + 0.78 * height, 0.45 * 2.0 - 0.62 * height];
        let points = X.into_iter().zip(Y).map(<[f64; 2]>::from).chain(self.sliver.map(beside));
        mesh.row(points.map(|p| p.map(|x| x * self.length + self.origin)));
        mesh.edges(TARGET, &[4, 5, 3]);
        mesh.edges(CONTACT, &[6, 7, 8]);
        mesh.edges(TOP, &[9, 10]);
        mesh.edges(BOTTOM, &[1, 2]);
        match self.sliver {
            None => mesh.triangles(BLOCK, [[1, 2, 5]]),
            Some(_) => mesh.triangles(BLOCK, [[1, 2, 11], [2, 5, 11], [5, 1, 11]]),
        }
        mesh.triangles(BLOCK, [[1, 5, 4], [2, 3, 5]]);
        mesh.triangles(STAMP, [[6, 7, 10], [7, 9, 10], [7, 8, 9]]);
        mesh.finish()
    }
}
