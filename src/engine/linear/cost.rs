//! Whether exact numbers on a scene end in a bearable time.

use base::error::{InputError, Result};

/// The free equations that an exact run may have. On a plane mesh whose coordinates use all digits of an
/// f64 an iteration of 144 equations takes 2 s, and the time grows with their cube: 1,000 take some ten
/// minutes.
const EQUATIONS: f64 = 1000.0;

/// The free equations that an exact run of `iterations` may have. `growing`: weights come from the shape
/// that the iteration before led to, so that numbers grow longer by a factor of the equations each time.
pub fn most_equations(growing: bool, iterations: usize) -> usize {
    let power = if growing { 2.0 + iterations as f64 } else { 3.0 };
    EQUATIONS.powf(3.0 / power) as usize
}

/// Checks that exact solutions end in a bearable time.
///
/// # Errors
/// There are more equations than an exact run may have.
pub fn check(equations: usize, growing: bool, iterations: usize) -> Result<()> {
    let most = most_equations(growing, iterations);
    if equations <= most {
        return Ok(());
    }
    let of = if growing { format!(" of {iterations} iterations") } else { String::new() };
    let what = format!("{equations} free equations: an exact run{of} may have {most}");
    Err(InputError::new("scalar", what, "use f64x2, fewer iterations or a coarser mesh"))
}
