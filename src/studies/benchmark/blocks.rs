//! Two stacked blocks under uniform pressure: the contact patch test.

use serde_json::json;

use super::builder::{Builder, Grid};
use super::line::part;
use super::{Benchmark, check};
use crate::error::InputError;

/// Contact patch test: two stacked blocks, sigma_y = -6.3 MPa everywhere.
///
/// Each 50 x 25 mm, E = 30000 MPa, nu = 0.2, plane strain: von Mises 5.774 MPa, top displacement -0.010080 mm.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact mesh blocks
  plane-contact mesh blocks --upper 10 --lower 10      matching nodes")]
pub struct Blocks {
    /// Divisions of the upper block along the contact line.
    #[arg(long, default_value_t = Blocks::default().upper)]
    pub upper: usize,
    /// Divisions of the lower block along the contact line.
    #[arg(long, default_value_t = Blocks::default().lower)]
    pub lower: usize,
}

impl Default for Blocks {
    fn default() -> Self {
        Blocks { upper: 7, lower: 10 }
    }
}

/// Width and height of a block, mm.
const SIZE: [f64; 2] = [50.0, 25.0];

impl Blocks {
    /// Generates the scene.
    ///
    /// # Errors
    /// No division, or too many.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        check::count("--upper", self.upper, 1)?;
        check::count("--lower", self.lower, 1)?;
        let mut builder = Builder::default();
        let lower = block(&mut builder, "lower", self.lower, 0.0);
        let upper = block(&mut builder, "upper", self.upper, SIZE[1]);
        builder.edges("bottom", lower.first());
        builder.edges("target", lower.last());
        builder.edges("contact", upper.first());
        builder.edges("top", upper.last());
        builder.edges("lower_left", &lower.starts());
        builder.edges("upper_left", &upper.starts());
        Ok(Benchmark::new("blocks", builder.finish(), scene()))
    }
}

/// A block with near square cells whose bottom is at `y`.
fn block(builder: &mut Builder, body: &'static str, columns: usize, y: f64) -> Grid {
    let [width, height] = SIZE;
    let rows = columns.div_ceil(2);
    Grid::add(builder, body, [columns, rows], |i, j| {
        [part(0.0, width, i, columns), part(y, y + height, j, rows)]
    })
}

fn scene() -> serde_json::Value {
    json!({
        "title": "Contact patch test: two stacked blocks",
        "plane": "strain",
        "units": { "length": "mm", "stress": "MPa", "force": "N" },
        "materials": { "lower": { "E": 30000.0, "nu": 0.2 }, "upper": { "E": 30000.0, "nu": 0.2 } },
        "restraints": [
            { "on": "bottom", "fix": ["y"] },
            { "on": "lower_left", "fix": ["x"] },
            { "on": "upper_left", "fix": ["x"] }
        ],
        "loads": [{ "on": "top", "pressure": 6.3 }],
        "contact": { "cnt": "contact", "trg": "target", "c_tll": 0.001, "coupling": "mortar", "friction": 0 },
        "variant": "unilateral"
    })
}
