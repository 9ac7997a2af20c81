//! A flat rigid punch on a half plane.

use serde_json::json;

use super::builder::{Builder, Grid, ends};
use super::confocal;
use super::line::{part, quarter};
use super::{Benchmark, check};
use crate::error::InputError;

/// A flat stiff punch, frictionless, on a half plane: p(x) = P / (pi sqrt(a^2 - x^2)).
///
/// Half model: punch a x a with a = 1 and E = 1e7, foundation E = 1000, nu = 0.3, plane strain, P = 2 on both halves (1 on the
/// model). The foundation ends, held, along an ellipse that is nearly a circle of radius --outer. Nodes on the contact line
/// stand at a cos(angle), equal angles apart, so each carries the same share of P in the closed form, the two end nodes half of it.
///
/// Source: K. L. Johnson, Contact Mechanics, 1985, section 2.8.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact mesh punch
  plane-contact mesh punch --punch 24 --foundation 32 --outer 50")]
pub struct Punch {
    /// Divisions of the punch along the contact line.
    #[arg(long, default_value_t = Punch::default().punch)]
    pub punch: usize,
    /// Divisions of the foundation along the contact line.
    #[arg(long, default_value_t = Punch::default().foundation)]
    pub foundation: usize,
    /// Radius of the foundation, in half widths of the punch.
    #[arg(long, default_value_t = Punch::default().outer)]
    pub outer: f64,
}

impl Default for Punch {
    fn default() -> Self {
        Punch { punch: 24, foundation: 24, outer: 20.0 }
    }
}

impl Punch {
    /// Generates the scene.
    ///
    /// # Errors
    /// Fewer than four divisions, or too many; an outer radius below 2 or beyond 1e4.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        check::count("--punch", self.punch, 4)?;
        check::count("--foundation", self.foundation, 4)?;
        check::between("--outer", self.outer, [2.0, 1e4])?;
        let mut builder = Builder::default();
        self.add_foundation(&mut builder);
        self.add_punch(&mut builder);
        Ok(Benchmark::new("punch", builder.finish(), scene()))
    }

    fn add_foundation(&self, builder: &mut Builder) {
        let rings = confocal::rings(self.foundation, self.outer.acosh());
        let below = |[x, y]: [f64; 2]| [x, -y];
        let rows: Vec<_> = rings.iter().map(|r| confocal::add(builder, 1.0, *r, below)).collect();
        builder.join_all("foundation", &rows);
        builder.edges("outer", &rows[rows.len() - 1]);
        builder.edges("foundation_axis", &ends(&rows));
        builder.edges("target", &confocal::surface(builder, &rows, 1.5));
    }

    /// The punch; its columns are the foundation's angles, from the axis to the corner.
    fn add_punch(&self, builder: &mut Builder) {
        let (n, rows) = (self.punch, self.punch.div_ceil(2));
        let grid = Grid::add(builder, "punch", [n, rows], |i, j| {
            [quarter(n - i, n)[0], part(0.0, 1.0, j, rows)]
        });
        builder.edges("contact", grid.first());
        builder.edges("top", grid.last());
        builder.edges("punch_axis", &grid.starts());
    }
}

fn scene() -> serde_json::Value {
    json!({
        "title": "Flat punch on a half plane",
        "plane": "strain",
        "materials": { "foundation": { "E": 1000.0, "nu": 0.3 }, "punch": { "E": 1e7, "nu": 0.3 } },
        "restraints": [
            { "on": "outer", "fix": ["x", "y"] },
            { "on": "foundation_axis", "fix": ["x"] },
            { "on": "punch_axis", "fix": ["x"] }
        ],
        "loads": [{ "on": "top", "pressure": 1.0 }],
        "contact": { "cnt": "contact", "trg": "target", "c_tll": 0.001, "coupling": "mortar", "friction": 0 },
        "variant": "unilateral"
    })
}
