//! What is asked for: a scene, how contact is modelled, a variant, a reading, and the numbers to
//! compute in.

use std::sync::Arc;

use crate::error::InputError;
use crate::numbers::solve::Arithmetic;
use crate::paper::door;
use crate::paper::mirror::{Reading, Schedule};
use crate::problem::model::Model;
use crate::problem::modelling::{ContactModel, Variant};
use crate::problem::scene::Scene;

/// What is asked for. [`Request::new`] asks for what the scene says; every field may be changed.
#[derive(Clone, Debug)]
pub struct Request {
    /// The scene.
    pub scene: Scene,
    /// How contact is modelled beyond what the paper prints.
    pub contact: ContactModel,
    /// What is run.
    pub variant: Variant,
    /// Number of iterations of the variants that the paper describes.
    pub iterations: usize,
    /// The reading of the print.
    pub reading: Reading,
    /// In which numbers, and by which solver.
    pub arithmetic: Arithmetic,
    /// The tolerance of the contact search in place of the scene's own, length.
    pub tolerance: Option<f64>,
}

impl Request {
    /// What the scene itself says, under the default reading, in `f64`.
    pub fn new(scene: &Scene) -> Self {
        Request {
            contact: scene.contact,
            variant: scene.variant,
            iterations: scene.iterations,
            reading: Reading::default(),
            arithmetic: Arithmetic::default(),
            tolerance: None,
            scene: scene.clone(),
        }
    }

    /// The same with another variant.
    #[must_use]
    pub fn variant(self, variant: Variant) -> Self {
        Request { variant, ..self }
    }

    /// The same under another reading.
    #[must_use]
    pub fn reading(self, reading: Reading) -> Self {
        Request { reading, ..self }
    }

    /// The same in other numbers or by another solver.
    #[must_use]
    pub fn arithmetic(self, arithmetic: Arithmetic) -> Self {
        Request { arithmetic, ..self }
    }

    /// The same with contact modelled in another way.
    #[must_use]
    pub fn contact(self, contact: ContactModel) -> Self {
        Request { contact, ..self }
    }

    /// What load an iteration carries: R7 where it is given, else the variant's own.
    pub fn schedule(&self) -> Schedule {
        match self.variant {
            Variant::Unilateral => Schedule::Total,
            Variant::Printed | Variant::Tied => self.reading.r7.unwrap_or(Schedule::Total),
            Variant::Stepped => self.reading.r7.unwrap_or(Schedule::Stepped),
        }
    }

    /// The model under the reading and with the tolerance that is asked for.
    ///
    /// # Errors
    /// A Poisson's ratio that the plane problem of R6 does not allow.
    pub fn model(&self) -> Result<Arc<Model>, InputError> {
        let mut model = (*self.scene.model).clone();
        if let Some(tolerance) = self.tolerance {
            model.contact.tolerance = tolerance;
        }
        Ok(Arc::new(door::under(model, &self.reading)?))
    }
}
