//! The tables that a measurement fills.

use serde::{Serialize, Serializer};

use super::errors::{Contact, Errors};
use super::order::Order;
use base::exit::ExitStatus;
use engine::error::Error;
use engine::estimates::Certainty;
use problem::modelling::Variant;
use problem::scene::Units;

/// Speed against accuracy on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Trade {
    /// The name of the scene.
    pub scene: String,
    /// Its units, which the document has beside this.
    #[serde(skip)]
    pub units: Units,
    /// The number of its nodes.
    pub nodes: usize,
    /// The number of its triangles.
    pub triangles: usize,
    /// How many times each trial is run.
    pub runs: usize,
    /// Why there is no equilibrium to measure errors against; absent where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_reference: Option<String>,
    /// A section for each axis.
    pub sections: Vec<Section>,
}

/// The trials of an axis.
#[derive(Clone, Debug, Serialize)]
pub struct Section {
    /// The name of the axis.
    pub parameter: &'static str,
    /// What errors are measured against, in words.
    pub against: &'static str,
    /// What was measured of each trial, in the order of the trials.
    pub rows: Vec<Row>,
    /// Orders of convergence, of the element size only.
    pub orders: Vec<Order>,
}

/// What was measured of a trial. Times are this machine's.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The value of the axis, in words.
    #[serde(rename = "setting")]
    pub label: String,
    /// The variant that ran.
    pub variant: Variant,
    /// Number of degrees of freedom, restrained ones included.
    pub equations: usize,
    /// How many nodes are in contact at the end; null of a failure.
    pub in_contact: Option<usize>,
    /// Iterations after which the contact state at the end returns; 1 = settled.
    pub cycle: Option<usize>,
    /// Median of the times of its runs, s.
    pub seconds: Option<f64>,
    /// How many times it was run.
    pub runs: usize,
    /// How far it is from what the section measures against, over that; nothing of a failure.
    pub error: Option<Errors>,
    /// What contact passes on; of meshes only.
    pub contact: Option<Contact>,
    /// How far it is from the same variant with the scene's own value; nothing where that was not
    /// tried.
    pub change: Option<Errors>,
    /// Whether rounding decides who is in contact; nothing of a failure and of an axis whose errors
    /// are not against the equilibrium.
    pub certainty: Option<Certainty>,
    /// Whether this is the scene's own value.
    pub own: bool,
    /// Whether no other row of the section is quicker and nearer.
    pub pareto: bool,
    /// Why it has no result; null where it has one.
    #[serde(serialize_with = "in_words")]
    pub failure: Option<Error>,
}

fn in_words<S: Serializer>(failure: &Option<Error>, serializer: S) -> Result<S::Ok, S::Error> {
    failure.as_ref().map(Error::to_string).serialize(serializer)
}

impl Trade {
    /// Returns the exit status: that of the first failure where no trial has a result.
    pub fn exit_status(&self) -> ExitStatus {
        let rows = self.sections.iter().flat_map(|section| &section.rows);
        let failures: Option<Vec<&Error>> = rows.map(|row| row.failure.as_ref()).collect();
        let first = failures.iter().flatten().next();
        first.map_or(ExitStatus::Done, |why| why.exit_status())
    }
}
