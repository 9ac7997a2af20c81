//! A request: the scene, the contact model, the variant, the reading, and the numbers.

use std::sync::Arc;

use super::contact;
use crate::linear::{Arithmetic, Solver};
use base::error::InputError;
use paper::door;
use paper::edited::Edited;
use paper::listings::Which;
use paper::mirror::{Reading, Schedule};
use problem::model::Model;
use problem::modelling::{ContactModel, Coupling, Friction, Geometry, StatusRule, Variant};
use problem::scene::Scene;

/// A request. [`Request::new`] asks for what the scene says; every field may be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The scene to be solved.
    pub scene: Scene,
    /// How contact is modelled beyond what the paper prints.
    pub contact: ContactModel,
    /// The variant to be run.
    pub variant: Variant,
    /// The number of iterations of the variants that the paper describes.
    pub iterations: usize,
    /// The reading of the print.
    pub reading: Reading,
    /// The scalar and the solver.
    pub arithmetic: Arithmetic,
    /// The tolerance of the contact search in place of the scene's own, length.
    pub tolerance: Option<f64>,
    /// The edited listings that are executed in place of the paper's.
    pub edited: Vec<Edited>,
}

impl Request {
    /// Requests what the scene itself says, under the default reading, in `f64`.
    pub fn new(scene: &Scene) -> Self {
        Request {
            contact: ContactModel { coupling: scene.coupling(scene.variant), ..scene.contact },
            variant: scene.variant,
            iterations: scene.iterations,
            reading: Reading::default(),
            arithmetic: Arithmetic::default(),
            tolerance: None,
            edited: Vec::new(),
            scene: scene.clone(),
        }
    }

    /// Returns the same request with another variant, and with the coupling that the scene has under it
    /// unless another one is asked for.
    #[must_use]
    pub fn variant(self, variant: Variant) -> Self {
        let [own, other] = [self.variant, variant].map(|variant| self.scene.coupling(variant));
        let is_own = self.contact.coupling == own;
        let coupling = if is_own { other } else { self.contact.coupling };
        Request { variant, contact: ContactModel { coupling, ..self.contact }, ..self }
    }

    /// Returns the same request under another reading.
    #[must_use]
    pub fn reading(self, reading: Reading) -> Self {
        Request { reading, ..self }
    }

    /// Returns the same request in other numbers or by another solver.
    #[must_use]
    pub fn arithmetic(self, arithmetic: Arithmetic) -> Self {
        Request { arithmetic, ..self }
    }

    /// Returns the same request with another contact model.
    #[must_use]
    pub fn contact(self, contact: ContactModel) -> Self {
        Request { contact, ..self }
    }

    /// Returns the request for the reference solution, which runs are measured against:
    /// `unilateral` with mortar, without friction, in the initial geometry, in `f64`. Where contact
    /// holds the bodies it has one solution: its problem is convex.
    #[must_use]
    pub fn reference(&self) -> Self {
        let (friction, geometry) = (Friction::NONE, Geometry::Initial);
        let contact = ContactModel { friction, geometry, ..self.contact };
        self.clone().contact(contact).equilibrium()
    }

    /// Returns the request for the equilibrium under the scene's own friction and geometry, at the
    /// end of the path of its load: `unilateral` with mortar in `f64`.
    #[must_use]
    pub fn equilibrium(&self) -> Self {
        let contact = ContactModel { coupling: Coupling::Mortar, ..self.contact };
        let (variant, arithmetic) = (Variant::Unilateral, Arithmetic::default());
        Request { contact, variant, arithmetic, edited: Vec::new(), ..self.clone() }
    }

    /// Returns whether `other` asks for the same solution of the same scene under `unilateral`.
    pub fn is_same_equilibrium(&self, other: &Request) -> bool {
        let only = |request: &Request| ContactModel {
            status: StatusRule::default(),
            load_steps: if request.contact.friction == Friction::NONE {
                1
            } else {
                request.contact.load_steps
            },
            ..request.contact
        };
        [self, other].iter().all(|request| request.variant == Variant::Unilateral)
            && only(self) == only(other)
    }

    /// Returns the solver asked for, or the variant's and the scalar's own.
    pub fn solver(&self) -> Solver {
        self.arithmetic.solver(self.variant == Variant::Printed)
    }

    /// Returns whether its run holds dense 2R x 2R matrices of the scalar: sparse LU takes a sparse `Km` as
    /// printed, but no sparse Tᵀ K T.
    pub fn is_dense(&self) -> bool {
        match (self.variant, self.solver()) {
            (Variant::Unilateral, _) | (_, Solver::SparseCholesky) => false,
            (Variant::Printed | Variant::Tied | Variant::Stepped, Solver::DenseLu) => true,
            (variant, Solver::SparseLu) => variant != Variant::Printed,
        }
    }

    /// Returns the coupling that gives eq. (1) its weights, under the variants that impose it.
    pub fn bound_by(&self) -> Option<Coupling> {
        match self.variant {
            Variant::Tied | Variant::Stepped => Some(self.contact.coupling),
            Variant::Printed | Variant::Unilateral => None,
        }
    }

    /// Returns whether one of the paper's listings is edited.
    pub fn is_edited(&self, which: Which) -> bool {
        self.edited.iter().any(|edited| edited.which == which)
    }

    /// Returns whether `c_cnt`, as printed or as edited, decides who is in contact.
    pub fn decides_by_listing(&self) -> bool {
        match self.variant {
            Variant::Printed => true,
            Variant::Tied | Variant::Stepped => self.contact.status.is_printed(),
            Variant::Unilateral => false,
        }
    }

    /// Returns whether `c_cnt` as printed decides who is in contact.
    pub fn is_as_printed(&self) -> bool {
        self.decides_by_listing() && !self.is_edited(Which::CCnt)
    }

    /// Returns the load of an iteration: R7 where the reading sets it, else the variant's own.
    pub fn schedule(&self) -> Schedule {
        match self.variant {
            Variant::Unilateral => Schedule::Total,
            Variant::Printed | Variant::Tied => self.reading.r7.unwrap_or(Schedule::Total),
            Variant::Stepped => self.reading.r7.unwrap_or(Schedule::Stepped),
        }
    }

    /// Returns the model under the reading and with the requested tolerance. Under `unilateral` the
    /// nodes of the contact surface stand in order along it, each once, however they are listed;
    /// the variants that the paper describes visit them as listed.
    ///
    /// # Errors
    /// The plane problem of R6 does not allow a Poisson's ratio, R8 = m does not know the unit of length, or under `unilateral` the nodes of
    /// the contact surface make no chain.
    pub fn model(&self) -> Result<Arc<Model>, InputError> {
        // What changes nothing leaves it shared.
        let mut model = Arc::clone(&self.scene.model);
        if let Some(tolerance) = self.tolerance {
            Arc::make_mut(&mut model).contact.tolerance = tolerance;
        }
        if self.variant == Variant::Unilateral {
            let nodes = contact::along(&model)?;
            if nodes != model.contact.nodes {
                Arc::make_mut(&mut model).contact.nodes = nodes;
            }
        }
        door::under(model, &self.scene.units.length, &self.reading)
    }
}
