//! A scene as a worksheet of Mathcad and as a program for Octave and MATLAB: the listings with the
//! tables that they need, and the run around them.

pub mod mathcad;
pub mod octave;

use ::mathcad::Listing;
use ::mathcad::array::Table;
use paper::mirror::{Pairs, Reading, Worksheet};

/// What is exported.
pub struct Export<'a> {
    /// What the worksheet is called.
    pub title: &'a str,
    /// The worksheet of the scene.
    pub sheet: &'a Worksheet<f64>,
    /// The reading of the listings.
    pub reading: &'a Reading,
    /// The shape in which `c_cnt` is called.
    pub node_n: &'a Table<f64>,
    /// What the areas are multiplied by, length.
    pub thickness: f64,
    /// The load and its iterations, if they are exported too.
    pub run: Option<Iterated>,
}

/// The corrected algorithm on a scene, whose contact nodes slide freely, and what this program has for it.
pub struct CorrectedExport<'a> {
    /// What the worksheet is called.
    pub title: &'a str,
    /// The worksheet of the scene.
    pub sheet: &'a Worksheet<f64>,
    /// What the areas are multiplied by, length.
    pub thickness: f64,
    /// The load on each equation, force. 2R.
    pub force: Vec<f64>,
    /// The displacements at the end, length. 2R.
    pub u: Vec<f64>,
}

/// The iterations of the variant `printed`, and what this program has for them.
pub struct Iterated {
    /// The load vector, 0 at restrained equations, force. 2R.
    pub force: Vec<f64>,
    /// How many iterations were run.
    pub iterations: usize,
    /// The pairs at the initial shape.
    pub pairs: Pairs<f64>,
    /// The displacements at the end, length. 2R.
    pub u: Vec<f64>,
    /// The von Mises stresses at the end, stress. M.
    pub stress: Vec<f64>,
}

/// The nodes in the shape of some displacements.
const MOVED: &str = "moved(u) :=
  x ← node
  for n ∈ 1 .. R
    x[n,2] ← node[n,2] + u[2·n−1]
    x[n,3] ← node[n,3] + u[2·n]
  x
";

/// The displacements after so many iterations of the listings.
const ITERATED: &str = "iterated(steps) :=
  x ← node
  for k ∈ 1 .. steps
    u ← lsolve(Km(c_cnt(x)),F)
    x ← moved(u)
  u
";

fn listing(text: &str) -> Listing {
    Listing::parse("export", text).expect("the export's own programs are sound")
}
