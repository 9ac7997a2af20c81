//! The scene that most generators start from: a block of three triangles, and a stamp of three on it.
//!
//! ```text
//!         10----9     y = 3.7     pressure; x held
//!         /|  / |
//!        6--7---8     y = 2       contact nodes 6, 7, 8 on the target edges 4-5 and 5-3
//!      4-----5-----3
//!      |   /  \    |
//!      1-----------2  y = 0       held
//! ```

use serde_json::{Value, json};

/// What may be changed of the scene.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// Factor of all lengths.
    pub length: f64,
    /// What is added to each coordinate.
    pub origin: f64,
    /// Elastic moduli of block and stamp.
    pub e: [f64; 2],
    /// Poisson's ratio of both.
    pub nu: f64,
    /// Pressure on the stamp.
    pub pressure: f64,
    /// Tolerance of the contact search.
    pub c_tll: f64,
    /// Iterations.
    pub iterations: usize,
    /// Contact nodes.
    pub cnt: Vec<usize>,
    /// Target edges.
    pub trg: Vec<usize>,
    /// Distance of an eleventh node from the edge 1-5, in lengths: a sliver stands on that edge.
    pub sliver: Option<f64>,
    /// The stamp is held whole at its top, and forces act at nodes 5 and 7: for `printed`, which joins no bodies.
    pub held: bool,
}

impl Default for Blocks {
    fn default() -> Self {
        Blocks {
            length: 1.0,
            origin: 0.0,
            e: [30000.0, 210000.0],
            nu: 0.3,
            pressure: 6.3,
            c_tll: 1e-3,
            iterations: 1,
            cnt: vec![6, 7, 8],
            trg: vec![1, 2],
            sliver: None,
            held: false,
        }
    }
}

const NODES: [[f64; 2]; 10] = [
    [0.0, 0.0],
    [3.0, 0.0],
    [3.0, 2.0],
    [0.0, 2.0],
    [1.6, 2.0],
    [0.4, 2.0],
    [1.3, 2.0],
    [2.7, 2.0],
    [2.5, 3.7],
    [0.6, 3.7],
];

impl Blocks {
    /// The scene file.
    pub fn json(&self) -> Value {
        json!({
            "plane": "strain",
            "node": self.nodes(),
            "elem": self.elements(),
            "materials": {
                "1": { "E": self.e[0], "nu": self.nu }, "2": { "E": self.e[1], "nu": self.nu }
            },
            "restraints": [
                { "on": 10, "fix": ["x", "y"] },
                { "on": 21, "fix": if self.held { vec!["x", "y"] } else { vec!["x"] } }
            ],
            "loads": self.loads(),
            "contact": {
                "cnt": self.cnt, "trg": self.trg, "c_tll": self.c_tll, "geometry": "initial"
            },
            "iterations": self.iterations
        })
    }

    fn nodes(&self) -> Vec<Value> {
        let beside = |height: f64| [0.45 * 1.6 + 0.78 * height, 0.45 * 2.0 - 0.62 * height];
        let points = NODES.into_iter().chain(self.sliver.map(beside));
        let moved = points.map(|p| p.map(|x| x * self.length + self.origin));
        moved.enumerate().map(|(k, [x, y])| json!([k + 1, x, y, 0.0])).collect()
    }

    fn elements(&self) -> Vec<Vec<usize>> {
        let edges = [[4, 5], [5, 3], [6, 7], [7, 8], [9, 10], [1, 2]];
        let surfaces = [11, 11, 20, 20, 21, 10];
        let edges = edges.into_iter().zip(surfaces).map(|([a, b], tag)| vec![1, 2, tag, tag, a, b]);
        let below: &[[usize; 3]] = match self.sliver {
            None => &[[1, 2, 5]],
            Some(_) => &[[1, 2, 11], [2, 5, 11], [5, 1, 11]],
        };
        let block = below.iter().chain(&[[1, 5, 4], [2, 3, 5]]).map(|t| (1, t));
        let stamp = [[6, 7, 10], [7, 9, 10], [7, 8, 9]];
        let triangles = block.chain(stamp.iter().map(|t| (2, t)));
        let triangles = triangles.map(|(tag, t)| [&[2, 2, tag, tag], t.as_slice()].concat());
        edges.chain(triangles).enumerate().map(|(k, row)| [vec![k + 1], row].concat()).collect()
    }

    fn loads(&self) -> Value {
        if !self.held {
            return json!([{ "on": 21, "pressure": self.pressure }]);
        }
        let force = self.pressure * self.length;
        json!([
            { "node": 5, "force": [0.3 * force, -force] }, { "node": 7, "force": [-force, 0.7 * force] }
        ])
    }
}
