//! Whether exact numbers on a scene end in a bearable time.

use base::error::{InputError, Result};

/// Seconds of an exact iteration of `EQUATIONS` equations of a plane mesh whose coordinates use all
/// digits of an f64; most of them go into forces and stresses, whose fractions are as long as the
/// displacements'. They grow with the cube of the equations.
const SECONDS: f64 = 2.0;
const EQUATIONS: f64 = 144.0;

/// The seconds beyond which an exact run is refused.
const LIMIT: f64 = 600.0;

/// Estimates the seconds of `iterations` exact solutions of `equations` equations. `growing`:
/// weights come from the shape that the iteration before led to, so that numbers grow longer by a
/// factor of the equations each time.
pub fn seconds(equations: usize, growing: bool, iterations: usize) -> f64 {
    let n = equations as f64;
    let first = SECONDS * (n / EQUATIONS).powi(3);
    let last = if growing { n.powi(iterations as i32 - 1) } else { 1.0 };
    first * last * iterations as f64
}

/// Checks that exact solutions end within the limit.
///
/// # Errors
/// Says how long they may take where they do not.
pub fn check(equations: usize, growing: bool, iterations: usize) -> Result<()> {
    let seconds = seconds(equations, growing, iterations);
    if seconds <= LIMIT {
        return Ok(());
    }
    let what = format!(
        "{equations} equations in exact numbers, {iterations} iterations, may take \
         {seconds:.0e} s: more than {LIMIT} s"
    );
    Err(InputError::new("scalar", what, "use f64x2, fewer iterations or a coarser mesh"))
}
