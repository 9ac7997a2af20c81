//! How much there may be of anything: plain counts, so that no input ends the process for want of memory.
//! Each is set so that a run stays below some 8 GB; the measured bytes stand beside it.

use crate::error::{InputError, Result};

/// The most bytes of a file: 268 MB.
pub const FILE: u64 = 1 << 28;

/// The most that there may be of something.
pub struct Limit {
    most: usize,
    of: &'static str,
    fix: &'static str,
}

/// Equations of a dense matrix: one of so many has 1 GB. Dense LU holds three, of f64x2 twice as large; an
/// audit some seven.
pub const DENSE: Limit = Limit {
    most: 11_000,
    of: "equations in a dense matrix",
    fix: "use a coarser mesh, or solve by a sparse solver",
};

/// Free equations of a run: each takes 2 to 4 kB in mesh, factors and files.
pub const EQUATIONS: Limit =
    Limit { most: 2_500_000, of: "free equations", fix: "use a coarser mesh" };

/// Values of a JSON document, lists and objects included: a number takes up to 144 bytes, an empty list 304.
pub const VALUES: Limit =
    Limit { most: 15_000_000, of: "values in one file", fix: "give a smaller file" };

/// Bytes of a file that is read whole.
pub const BYTES: Limit =
    Limit { most: FILE as usize, of: "bytes in one file", fix: "give a smaller file" };

/// Bytes of the values of all jobs of a sweep, as JSON: a value of two bytes takes some 32.
pub const JOBS: Limit =
    Limit { most: 1 << 28, of: "bytes of values in all jobs", fix: "divide the sweep" };

/// Numbers of a mesh file: a node or an element, which takes 310 bytes, has four at least.
pub const MESH: Limit =
    Limit { most: 60_000_000, of: "numbers in one mesh file", fix: "use a coarser mesh" };

/// Cells of a table: one takes up to 75 bytes.
pub const CELLS: Limit =
    Limit { most: 40_000_000, of: "cells in one table", fix: "give the nodes of one mesh" };

/// Edges and nodes that are loaded, each counted once for every load: 100 bytes each.
pub const LOADED: Limit = Limit {
    most: 10_000_000,
    of: "loaded edges and nodes",
    fix: "give fewer loads, or groups of fewer edges",
};

/// Stages of the load times equations: 8 bytes each.
pub const STAGES: Limit =
    Limit { most: 100_000_000, of: "stages times equations", fix: "give fewer stages" };

/// Iterations, or steps of the load, times the nodes and 100 more for what each takes besides: of 13 nodes a
/// report holds 73 kB for an iteration, of 26 nodes a path under mortar 100 kB for a step.
const STEPS: usize = 5_000_000;

impl Limit {
    /// Checks a count; `place` is that of the error.
    ///
    /// # Errors
    /// There are more than there may be.
    pub fn check(&self, count: usize, place: &str) -> Result<()> {
        if count <= self.most {
            return Ok(());
        }
        let Limit { most, of, fix } = self;
        Err(InputError::new(place, format!("{count} {of} are more than {most}"), *fix))
    }
}

/// Checks a number of iterations, or of steps of the load, on a mesh of so many nodes; `place` is the field
/// that asks for them.
///
/// # Errors
/// There are more than are kept on such a mesh.
pub fn check_steps(steps: usize, nodes: usize, place: &str) -> Result<()> {
    let most = STEPS / (nodes + 100);
    if steps <= most.max(1) {
        return Ok(());
    }
    let what = format!("{steps} on {nodes} nodes are more than {most}");
    Err(InputError::new(place, what, "ask for fewer, or use a coarser mesh"))
}
