//! The options of a run: what is asked for in place of what the scene says.

use serde::{Deserialize, Serialize};

use crate::Request;
use crate::linear::{Inputs, ScalarName, Solver};
use base::error::InputError;
use paper::mirror::Reading;
use problem::modelling::{Coupling, Friction, Geometry, StatusRule, Variant};
use problem::scene::Scene;

/// The options of a run, each absent where the scene or the program decides.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// The variant that is run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
    /// The number of iterations of the variants that the paper describes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iterations: Option<usize>,
    /// The tolerance of the contact search, length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c_tll: Option<f64>,
    /// The readings that differ from the default, as on the command line.
    #[serde(skip_serializing_if = "is_default", with = "as_text")]
    pub reading: Reading,
    /// The coupling of a contact node to the target.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// The coefficient of friction, or that nothing slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// The shape in which equilibrium is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub geometry: Option<Geometry>,
    /// In how many steps the load is applied.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_steps: Option<usize>,
    /// The rule that decides who is in contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub status: Option<StatusRule>,
    /// The numbers in which it ran.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scalar: Option<ScalarName>,
    /// The solver of its equations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solver: Option<Solver>,
    /// Which numbers are given: as they are written, or rounded to single precision.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inputs: Option<Inputs>,
}

fn is_default(reading: &Reading) -> bool {
    *reading == Reading::default()
}

/// Writes and reads readings as on the command line: `R2=printed,R5=node_n`.
mod as_text {
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::Serializer;

    use paper::mirror::Reading;

    pub fn serialize<S: Serializer>(reading: &Reading, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(reading)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Reading, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl Options {
    /// Returns the options of a request: its variant, and all else that differs from what its scene
    /// and the program do by themselves.
    pub fn from_request(request: &Request) -> Self {
        fn other<T: PartialEq>(value: T, own: T) -> Option<T> {
            (value != own).then_some(value)
        }
        let own = Request::new(&request.scene).variant(request.variant);
        let (contact, arithmetic) = (request.contact, request.arithmetic);
        Options {
            variant: Some(request.variant),
            iterations: other(request.iterations, own.iterations),
            c_tll: request.tolerance,
            reading: request.reading,
            coupling: other(contact.coupling, own.contact.coupling),
            friction: other(contact.friction, own.contact.friction),
            geometry: other(contact.geometry, own.contact.geometry),
            load_steps: other(contact.load_steps, own.contact.load_steps),
            status: other(contact.status, own.contact.status),
            scalar: other(arithmetic.scalar, own.arithmetic.scalar),
            solver: arithmetic.solver,
            inputs: other(arithmetic.inputs, own.arithmetic.inputs),
        }
    }

    /// Returns the request for these options of a scene.
    ///
    /// # Errors
    /// Neither says anything of friction, which is part of what `unilateral` solves.
    pub fn request(&self, scene: &Scene) -> Result<Request, InputError> {
        fn set<T: Copy>(own: &mut T, asked: Option<T>) {
            *own = asked.unwrap_or(*own);
        }
        let mut request = Request::new(scene).variant(self.variant.unwrap_or(scene.variant));
        if request.variant == Variant::Unilateral && self.friction.is_none() {
            scene.check_friction()?;
        }
        let Request { contact, arithmetic, .. } = &mut request;
        set(&mut contact.coupling, self.coupling);
        set(&mut contact.friction, self.friction);
        set(&mut contact.geometry, self.geometry);
        set(&mut contact.load_steps, self.load_steps);
        set(&mut contact.status, self.status);
        set(&mut arithmetic.scalar, self.scalar);
        set(&mut arithmetic.inputs, self.inputs);
        arithmetic.solver = self.solver;
        set(&mut request.iterations, self.iterations);
        Ok(Request { tolerance: self.c_tll, reading: self.reading, ..request })
    }

    /// Returns a name for a run with these options: its variant, then every other option.
    pub fn name(&self) -> String {
        let word = |(name, text): (String, String)| match &*name {
            "variant" | "reading" => text,
            _ => format!("{name}={text}"),
        };
        let words: Vec<String> = self.given().map(word).collect();
        if words.is_empty() { "scene".into() } else { words.join(" ") }
    }

    /// Returns the options that are given, each by its name, with its value as text.
    pub fn given(&self) -> impl Iterator<Item = (String, String)> + use<> {
        let Ok(serde_json::Value::Object(options)) = serde_json::to_value(self) else {
            panic!("options are an object");
        };
        options.into_iter().map(|(name, value)| {
            let text = value.as_str().map_or(value.to_string(), String::from);
            (name, text)
        })
    }
}
