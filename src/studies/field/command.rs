//! `plane-contact compare SCENE --with FIELD`.

use std::path::Path;

use super::table::{self, Compared};
use super::{Beside, Rows};
use base::error::InputError;
use base::exit::ExitStatus;
use base::plain::six_digits;
use engine::error::{Error, Result};
use engine::{self, Request, max_displacement};

use commands::{TablesArgs, print, waiting};

/// The tolerance where none is asked for: that of another code's contact by penalty.
const TOLERANCE: f64 = 1e-3;

/// The largest displacement over the size of the mesh: more is no slip of units, of metres for nanometres.
const FARTHEST: f64 = 1e9;

/// Puts a file of displacements beside the solution of a request, and prints it; returns whether they are the same.
///
/// # Errors
/// The file is at fault, or the request cannot be solved.
pub fn run(
    path: &Path,
    request: &Request,
    rtol: Option<f64>,
    tables: &TablesArgs,
) -> Result<ExitStatus> {
    let tolerance = rtol.unwrap_or(TOLERANCE);
    let rows = Rows::read(path)?;
    engine::check(request)?;
    let (u, how) = rows.on_mesh(&request.scene, &request.scene.model)?;
    let size = request.scene.model.bounds().larger_side();
    if u.amax() > FARTHEST * size {
        let what =
            format!("a displacement of {} in a mesh of {}", six_digits(u.amax()), six_digits(size));
        return Err(
            InputError::new(rows.place, what, "give them in the scene's unit of length").into()
        );
    }
    let reference = waiting("solving", || engine::solve(request, &mut |_| ()));
    let reference = reference.map_err(|why| without_reference(why, request))?;
    let beside = Beside::new(&reference, u, tolerance)?;
    let moves = max_displacement(&reference.u) > 0.0;
    if moves && !beside.distance.energy_relative.is_finite() {
        let what = "the displacements are too large for their energy to be a number";
        return Err(
            InputError::new(rows.place, what, "give them in the scene's unit of length").into()
        );
    }
    let compared = Compared { rows: &rows, how: &how, beside };
    match tables.json {
        true => print(&table::json(&compared))?,
        false => tables.print(table::report(&compared))?,
    }
    Ok(ExitStatus::compared(compared.beside.is_same()))
}

/// Says that there is nothing to compare with where the published algorithm fails: that is no verdict on it here.
fn without_reference(why: Error, request: &Request) -> Error {
    match why {
        Error::Listing(_) | Error::Execution(_) | Error::Singular(_) => {
            let what = format!("the run of {} does not finish: {why}", request.variant);
            let fix = "leave it out, which compares with the equilibrium, or name another variant";
            InputError::new("--variant", what, fix).into()
        }
        Error::Input(_) | Error::Equilibrium(_) => why,
    }
}
