//! The range of what the paper leaves open: its example with one thing at a time set otherwise.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use serde::Serialize;

use super::Case;
use crate::benchmark::Strand;
use base::choices;
use base::error::Result;
use engine::Request;
use output::numbers::percent;
use paper::mirror::{Reading, ToleranceUnit};
use problem::scene::Scene;

choices! {
    /// What the paper leaves open of its example.
    Parameter {
        /// Clearance, mm.
        Clearance = "clearance",
        /// Radius of the strand at the same clearance, mm.
        Radius = "radius",
        /// Edges on the duct's lower wall, mm.
        Mesh = "mesh",
        /// Height of the stamp's top over the strand's radius.
        Top = "top",
        /// c_tol, mm.
        Unit = "unit",
    }
}

impl Parameter {
    /// The values that are tried, that of the paper's example as we assume it among them.
    pub fn values(self) -> &'static [f64] {
        match self {
            Parameter::Clearance => &[0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.9, 2.0, 5.0, 12.0],
            Parameter::Radius => &[3.0, 5.0, 7.6, 12.0, 20.0],
            Parameter::Mesh => &[0.9, 0.6, 0.45, 0.3, 0.2],
            Parameter::Top => &[0.3, 0.5, 1.0, 1.5, 1.7],
            Parameter::Unit => &[0.001, 1.0],
        }
    }

    /// The paper's example with the parameter at `value`, and how its c_tol is read.
    fn strand(self, value: f64) -> (Strand, ToleranceUnit) {
        let own = Strand::default();
        let clearance = own.duct - own.strand;
        let (mut strand, mut unit) = (own, ToleranceUnit::Millimetre);
        match self {
            Parameter::Clearance => strand.duct = decimal(strand.strand + value),
            Parameter::Radius => {
                (strand.strand, strand.duct) = (value, decimal(value + clearance));
            }
            Parameter::Mesh => strand.size = value,
            Parameter::Top => strand.top = value,
            Parameter::Unit if value == 1.0 => unit = ToleranceUnit::Metre,
            Parameter::Unit => (),
        }
        (strand, unit)
    }
}

/// A length as it is written, mm: without what rounding adds to a sum.
fn decimal(length: f64) -> f64 {
    (1e6 * length).round() / 1e6
}

/// A parameter at one of its values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ParameterValue {
    /// The parameter.
    pub parameter: Parameter,
    /// Its value, in the parameter's unit.
    pub value: f64,
    /// Whether it is the paper's example as we assume it.
    pub own: bool,
}

/// The places that are tried, each with its scene.
pub type Range = Vec<(ParameterValue, Arc<Case>)>;

/// The places of the range, each with its scene under `reading` but for R8; the runs of the one
/// that is in the range of every parameter are made once.
///
/// # Errors
/// A value is outside what the generator allows.
pub fn range(reading: Reading) -> Result<Range> {
    let case = |(strand, r8): &(Strand, ToleranceUnit)| {
        let scene = strand.generate().and_then(|scene| scene.build())?;
        let reading = Reading { r8: *r8, ..reading };
        Ok(Arc::new(Case::from_request(Request::new(&scene).reading(reading))?.with_equivalents(1)))
    };
    let own = (Strand::default(), ToleranceUnit::default());
    let own_case = case(&own)?;
    let places = Parameter::ALL.iter().flat_map(|p| p.values().iter().map(|value| (*p, *value)));
    let placed = places.map(|(parameter, value)| {
        let at = parameter.strand(value);
        let is_own = at == own;
        let case = if is_own { own_case.clone() } else { case(&at)? };
        Ok((ParameterValue { parameter, value, own: is_own }, case))
    });
    placed.collect()
}

/// Claim P12 at the places that are not the example as we assume it.
#[derive(Debug, PartialEq)]
pub struct Recorded {
    /// The places that have a distance of the nearest run from the equilibrium.
    pub places: usize,
    /// The least and the largest such distance.
    pub error: [f64; 2],
    /// The places on which rounding decides.
    pub by_rounding: usize,
}

/// What `audit --range` measures, which takes some minutes.
pub const RECORDED: Recorded = Recorded { places: 17, error: [0.1977, 0.8148], by_rounding: 5 };

/// Says how far the nearest run is from the equilibrium on other geometries of the paper's example.
impl Display for Recorded {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let Recorded { places, error, by_rounding } = self;
        let [least, most] = error.map(percent);
        write!(
            out,
            "At {places} other choices of what the paper leaves open (clearance, radius, mesh, stamp, c_tol) the \
             nearest run is {least} to {most} from it"
        )?;
        match by_rounding {
            0 => out.write_str("."),
            n => write!(out, "; at {n} more rounding decides."),
        }
    }
}

/// Whether a scene is the paper's example, whose parameters are known: the embedded `strand`.
pub fn is_example(scene: &Scene) -> bool {
    let example = Scene::open("strand").expect("it is embedded");
    scene.name == example.name && scene.model.nodes == example.model.nodes
}
