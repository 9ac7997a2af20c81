//! The contact patch test of Taylor and Papadopoulos.

use serde_json::json;

use super::builder::{Builder, Grid};
use super::line::part;
use super::{Benchmark, check};
use crate::error::InputError;

/// Taylor and Papadopoulos' contact patch test: a punch on the middle of a wider foundation, one pressure on both.
///
/// Foundation 8 x 5, punch 2 x 2, E = 1000, nu = 0.4, plane strain. The pressure acts on the punch's top and on what the punch
/// leaves free of the foundation's top, so sigma_y = -pressure everywhere and nothing else but sigma_z.
///
/// Source: R. L. Taylor, P. Papadopoulos, "On a patch test for contact problems in two dimensions", in Computational Methods in
/// Nonlinear Mechanics, Springer, 1991.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact mesh punch-patch
  plane-contact mesh punch-patch --punch 4 --foundation 4      matching nodes")]
pub struct PunchPatch {
    /// Divisions of the punch along the contact line, even.
    #[arg(long, default_value_t = PunchPatch::default().punch)]
    pub punch: usize,
    /// Divisions of the foundation below the punch, even.
    #[arg(long, default_value_t = PunchPatch::default().foundation)]
    pub foundation: usize,
    /// The pressure.
    #[arg(long, default_value_t = PunchPatch::default().pressure)]
    pub pressure: f64,
}

impl Default for PunchPatch {
    fn default() -> Self {
        PunchPatch { punch: 6, foundation: 4, pressure: 1.0 }
    }
}

/// Half width of the punch.
const PUNCH: f64 = 1.0;
/// Half width of the foundation.
const FOUNDATION: f64 = 4.0;
/// Height of the foundation.
const TOP: f64 = 5.0;
/// Height of the foundation and the punch.
const ALL: f64 = 7.0;

impl PunchPatch {
    /// Generates the scene.
    ///
    /// # Errors
    /// An odd number of divisions, none, or too many; a pressure that is not positive.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        check::even("--punch", self.punch)?;
        check::even("--foundation", self.foundation)?;
        check::positive("--pressure", self.pressure)?;
        let mut builder = Builder::default();
        self.add_foundation(&mut builder);
        let n = self.punch;
        let punch = Grid::add(&mut builder, "punch", [n, n], |i, j| {
            [part(-PUNCH, PUNCH, i, n), part(TOP, ALL, j, n)]
        });
        builder.edges("contact", punch.first());
        builder.edges("punch_top", punch.last());
        builder.edges("punch_axis", &punch.0.iter().map(|row| row[n / 2]).collect::<Vec<_>>());
        Ok(Benchmark::new("punch-patch", builder.finish(), self.scene()))
    }

    /// The foundation: `foundation` columns below the punch, as wide ones on both sides of it.
    fn add_foundation(&self, builder: &mut Builder) {
        let (below, beside) = (self.foundation, self.foundation * 3 / 2);
        let rows = self.foundation * 5 / 2;
        let x = |i: usize| match i {
            i if i < beside => part(-FOUNDATION, -PUNCH, i, beside),
            i if i <= beside + below => part(-PUNCH, PUNCH, i - beside, below),
            i => part(PUNCH, FOUNDATION, i - beside - below, beside),
        };
        let grid = Grid::add(builder, "foundation", [below + 2 * beside, rows], |i, j| {
            [x(i), part(0.0, TOP, j, rows)]
        });
        let (top, middle) = (grid.last(), beside + below / 2);
        builder.edges("bottom", grid.first());
        builder.edges("foundation_axis", &grid.0.iter().map(|r| r[middle]).collect::<Vec<_>>());
        builder.edges("target", top);
        builder.edges("free_left", &top[..=beside]);
        builder.edges("free_right", &top[beside + below..]);
    }

    fn scene(&self) -> serde_json::Value {
        let p = self.pressure;
        json!({
            "title": "Contact patch test of Taylor and Papadopoulos",
            "plane": "strain",
            "materials": { "foundation": { "E": 1000.0, "nu": 0.4 }, "punch": { "E": 1000.0, "nu": 0.4 } },
            "restraints": [
                { "on": "bottom", "fix": ["y"] },
                { "on": "foundation_axis", "fix": ["x"] },
                { "on": "punch_axis", "fix": ["x"] }
            ],
            "loads": [
                { "on": "punch_top", "pressure": p },
                { "on": "free_left", "pressure": p },
                { "on": "free_right", "pressure": p }
            ],
            "contact": { "cnt": "contact", "trg": "target", "c_tll": 0.001, "coupling": "mortar", "friction": 0 },
        "variant": "unilateral"
        })
    }
}
