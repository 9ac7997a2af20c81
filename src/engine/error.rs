//! The reasons why a run ends without a result, by cause: the input or the published algorithm.

use std::fmt;

use serde::Serialize;

use crate::linear::ScalarName;
use base::error::InputError;
use base::exit::ExitStatus;
use paper::mirror::Failure;

/// A value, or the reason why there is none.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// The reason why a command ended without a result.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Error {
    /// The input breaks a condition.
    #[error("{0}")]
    Input(#[from] InputError),
    /// A listing fails as printed, which is an audit result.
    #[error("the published algorithm fails as printed: {0}")]
    Listing(#[from] Failure),
    /// A listing fails as it is executed, which is an audit result.
    #[error("the published algorithm fails as printed: {0}")]
    Execution(Box<mathcad::Failure>),
    /// The matrix of an iteration cannot be solved, which is an audit result.
    #[error("{0}")]
    Singular(#[from] SingularMatrix),
    /// No equilibrium, or several.
    #[error("{0}")]
    Equilibrium(#[from] NoEquilibrium),
}

impl From<Box<mathcad::Failure>> for Error {
    /// A limit is this program's own: it is no fault of the published algorithm.
    fn from(failure: Box<mathcad::Failure>) -> Self {
        if !failure.is_limit() {
            return Error::Execution(failure);
        }
        let fix = "trace a smaller scene, or a listing that asks for less";
        InputError::new("the listing", failure.to_string(), fix).into()
    }
}

impl Error {
    /// Returns the same with words before what is said of a search for an equilibrium.
    pub fn prefixed(self, before: &str) -> Self {
        match self {
            Error::Equilibrium(NoEquilibrium { cause, what }) => {
                NoEquilibrium { cause, what: format!("{before}{what}") }.into()
            }
            other => other,
        }
    }

    /// Returns the same with what may be its cause, such as a slit of the mesh.
    pub fn hinting(self, cause: Option<&str>) -> Self {
        let added = cause.map_or(String::new(), |cause| format!(". {cause}"));
        match self {
            Error::Input(why) => why.hinting(cause).into(),
            Error::Equilibrium(NoEquilibrium { cause, what }) => {
                NoEquilibrium { cause, what: what + &added }.into()
            }
            Error::Singular(why) => SingularMatrix { slits: cause.map(Into::into), ..why }.into(),
            Error::Listing(_) | Error::Execution(_) => self,
        }
    }

    /// Returns what a run found; None where the published algorithm fails, or no equilibrium is found.
    ///
    /// # Errors
    /// The input is at fault.
    pub fn found<T>(result: Result<T>) -> Result<Option<T>, InputError> {
        match result {
            Ok(found) => Ok(Some(found)),
            Err(Error::Input(why)) => Err(why),
            Err(
                Error::Listing(_)
                | Error::Execution(_)
                | Error::Singular(_)
                | Error::Equilibrium(_),
            ) => Ok(None),
        }
    }

    /// Returns the exit status of the process, which reports the cause.
    pub fn exit_status(&self) -> ExitStatus {
        match self {
            Error::Input(_) => ExitStatus::Input,
            Error::Equilibrium(_) => ExitStatus::Equilibrium,
            Error::Listing(_) | Error::Execution(_) | Error::Singular(_) => ExitStatus::Algorithm,
        }
    }
}

/// The end of a search for an equilibrium without the one that there should be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{cause}: {what}")]
pub struct NoEquilibrium {
    /// Which of the ends it is.
    pub cause: Cause,
    /// What was found or tried.
    pub what: String,
}

/// Why a search for an equilibrium ends without one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// It is proved that there is none.
    NoneExists,
    /// There are several.
    Several,
    /// None was found, which does not say that there is none.
    NotFound,
    /// The shape that was reached is none that the model describes.
    OutOfRange,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Cause::NoneExists => "there is no equilibrium",
            Cause::Several => "there are several equilibria",
            Cause::NotFound => "no equilibrium was found",
            Cause::OutOfRange => "the model leaves its range",
        })
    }
}

/// A matrix that has no unique solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "variant {variant} stops: iteration {iteration}: the matrix is singular at node \
     {node}{body}, direction {direction} ({}); {} in contact, and {}",
    if .pivot.is_nan() {
        "no pivot: the matrix is not positive definite".into()
    } else {
        format!("pivot {pivot:.1e}")
    },
    match .in_contact {
        0 => "no node is".into(),
        1 => "1 node is".into(),
        n => format!("{n} nodes are"),
    },
    match .in_contact {
        0 => "the restraints alone do not hold the body",
        _ => "that does not hold the body (finding K6), or to the last digit it does not",
    }.to_string() + &.no_contact.as_ref().map_or(String::new(), |why| format!(": {why}")) + &match .scalar.is_exact() {
        true => String::new(),
        false => format!(
            "; {scalar} rounds: --scalar exact, or f64x2 on a large mesh, tells whether rounding is at fault"
        ),
    } + &.slits.as_ref().map_or(String::new(), |slits| format!(". {slits}"))
)]
pub struct SingularMatrix {
    /// The name of the variant that was run.
    pub variant: &'static str,
    /// The iteration that failed, from 1.
    pub iteration: usize,
    /// The number of the node of the equation whose pivot vanished.
    pub node: usize,
    /// The direction of that equation, `x` or `y`.
    pub direction: char,
    /// The value of the pivot, force/length.
    pub pivot: f64,
    /// The number of contact nodes with dy = 1.
    pub in_contact: usize,
    /// Where the first contact fails, why, and what to do, in words.
    pub no_contact: Option<Box<str>>,
    /// The scalar of the run, whose rounding may be the cause.
    pub scalar: ScalarName,
    /// Where the mesh has slits, in words.
    pub slits: Option<Box<str>>,
    /// The text ` of body "stamp"`, or no text where no body has the node.
    pub body: Box<str>,
}

/// Says that displacements or stresses cannot be represented.
pub(super) fn too_large() -> InputError {
    let what = "the displacements or stresses are too large to represent";
    InputError::new("loads, materials, mesh", what, "choose other units")
}
