//! The variants that can be run, and how contact is modelled beyond what the paper prints.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;

use base::choices;
use base::error::{InputError, Result};
use base::plain::six_digits;

choices! {
    #[derive(schemars::JsonSchema)]
    /// A variant: how the contact pairs enter the equations, and what load an iteration carries.
    Variant {
        /// Eq. (1) on increments, the shape updated after each of equal steps of the load.
        Stepped = "stepped",
        /// Eq. (1) on total displacements.
        Tied = "tied",
        /// `Km` exactly as printed.
        Printed = "printed",
        /// Gaps closed along the normal, and released where they would pull.
        Unilateral = "unilateral",
    }
}

/// Coulomb's coefficient of friction μ between the surfaces under `unilateral`: the tangential
/// force of a contact node is at most μ times its normal force. 0 lets it slide; infinity, which is
/// written `stick`, lets no node in contact slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction(f64);

impl Friction {
    /// No friction: a node in contact slides.
    pub const NONE: Friction = Friction(0.0);
    /// A node in contact never slides.
    pub const STICK: Friction = Friction(f64::INFINITY);

    /// Returns the friction with the coefficient `mu`; None where it is negative or no number.
    pub fn new(mu: f64) -> Option<Self> {
        (mu >= 0.0).then_some(Friction(mu + 0.0))
    }

    /// Returns the coefficient μ, infinite where nodes stick.
    pub fn coefficient(self) -> f64 {
        self.0
    }
}

impl Default for Friction {
    /// Sticks, as eq. (1) asks.
    fn default() -> Self {
        Friction::STICK
    }
}

impl fmt::Display for Friction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.0 == f64::INFINITY { f.write_str("stick") } else { write!(f, "{}", self.0) }
    }
}

impl FromStr for Friction {
    type Err = String;

    /// Reads `stick`, or a finite coefficient.
    fn from_str(text: &str) -> Result<Self, String> {
        let number = || text.parse().ok().filter(|mu: &f64| mu.is_finite()).and_then(Friction::new);
        let read = if text == "stick" { Some(Friction::STICK) } else { number() };
        read.ok_or_else(|| no_friction(format!("{text:?}")))
    }
}

fn no_friction(found: impl fmt::Display) -> String {
    format!("friction {found} is neither a number of 0 or more nor \"stick\"")
}

impl Serialize for Friction {
    /// Writes the coefficient as a number, or `"stick"`.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            0.0 => serializer.serialize_u8(0),
            f64::INFINITY => serializer.serialize_str("stick"),
            mu => serializer.serialize_f64(mu),
        }
    }
}

impl JsonSchema for Friction {
    fn schema_name() -> Cow<'static, str> {
        "Friction".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number", "minimum": 0 }, { "const": "stick" }] })
    }
}

impl<'de> Deserialize<'de> for Friction {
    /// Reads a coefficient or `"stick"`.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = match Value::deserialize(deserializer)? {
            Value::String(text) if text == "stick" => Ok(Friction::STICK),
            Value::Number(mu) => mu.to_string().parse(),
            other => Err(no_friction(other)),
        };
        read.map_err(de::Error::custom)
    }
}

choices! {
    #[derive(schemars::JsonSchema)]
    /// The shape in which `unilateral` measures normals, weights and gaps.
    Geometry {
        /// The one that is reached.
        Current = "current",
        /// That of small displacements, as in Hertz's theory.
        Initial = "initial",
    }
}

impl Geometry {
    /// Returns whether contact is measured again in each shape that is reached.
    pub fn is_current(self) -> bool {
        match self {
            Geometry::Current => true,
            Geometry::Initial => false,
        }
    }
}

choices! {
    #[derive(schemars::JsonSchema)]
    /// The method that binds a contact node to the target surface.
    Coupling {
        /// Node to segment, which has two master nodes, those of one edge, as in `c_cnt`.
        Nts = "nts",
        /// Dual multipliers, averaged over what the node's edges cover.
        Mortar = "mortar",
    }
}

choices! {
    #[derive(schemars::JsonSchema)]
    /// The rule that decides the status of a contact node.
    StatusRule {
        /// Lines 16 to 18 of `c_cnt` as printed.
        Signs = "signs",
        /// Line 16, or a side of the node's triangles crosses the target surface, the text's other
        /// remedy.
        Intersection = "intersection",
    }
}

impl StatusRule {
    /// Returns whether `c_cnt` itself decides, by the lines that the paper prints.
    pub fn is_printed(self) -> bool {
        match self {
            StatusRule::Signs => true,
            StatusRule::Intersection => false,
        }
    }
}

/// The number of equal steps in which the load of a stage is applied where a scene sets none.
pub const LOAD_STEPS: usize = 16;

/// The most iterations of the variants that the paper describes.
const MOST_ITERATIONS: usize = 1_000_000;

/// The most steps in which the load of a stage is applied.
pub const MOST_LOAD_STEPS: usize = 100_000;

/// Checks a number of iterations.
///
/// # Errors
/// It is 0 or too large.
pub fn check_iterations(iterations: usize) -> Result<()> {
    if (1..=MOST_ITERATIONS).contains(&iterations) {
        return Ok(());
    }
    let what = format!("{iterations} iterations are outside 1 .. {MOST_ITERATIONS}");
    Err(InputError::new("field iterations", what, "give a number inside; the paper's is 20"))
}

/// Checks a tolerance of the contact search, length.
///
/// # Errors
/// It is negative, or no number.
pub fn check_tolerance(tolerance: f64) -> Result<()> {
    if tolerance >= 0.0 && tolerance.is_finite() {
        return Ok(());
    }
    let fault = if tolerance.is_finite() { "negative" } else { "no finite number" };
    let what = format!("c_tll = {} is {fault}", six_digits(tolerance));
    Err(InputError::new("contact.c_tll", what, "give 0 or more; the paper's is 0.001"))
}

/// The model of contact, beyond what the paper prints.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ContactModel {
    /// The method that binds a contact node to the target surface.
    pub coupling: Coupling,
    /// The coefficient of friction, or that nothing slides.
    pub friction: Friction,
    /// The shape in which equilibrium is asked for.
    pub geometry: Geometry,
    /// The number of equal steps in which `unilateral` applies the load of a stage; without
    /// friction the path of the load has no effect, and there is one.
    pub load_steps: usize,
    /// The rule by which `tied` and `stepped` decide which nodes are in contact.
    pub status: StatusRule,
}

impl ContactModel {
    /// Checks the number of steps.
    ///
    /// # Errors
    /// It is 0 or too large.
    pub fn check(&self) -> Result<()> {
        if (1..=MOST_LOAD_STEPS).contains(&self.load_steps) {
            return Ok(());
        }
        let what =
            format!("{} steps of the load are outside 1 .. {MOST_LOAD_STEPS}", self.load_steps);
        let fix = format!("give a number inside; {LOAD_STEPS} where there is none");
        Err(InputError::new("contact.load_steps", what, fix))
    }
}

impl Default for ContactModel {
    fn default() -> Self {
        ContactModel {
            coupling: Coupling::default(),
            friction: Friction::default(),
            geometry: Geometry::default(),
            load_steps: LOAD_STEPS,
            status: StatusRule::default(),
        }
    }
}

impl Variant {
    /// The paper's own variants, which search with `c_cnt`.
    pub const OF_THE_PAPER: &'static [Variant] =
        &[Variant::Stepped, Variant::Tied, Variant::Printed];
}
