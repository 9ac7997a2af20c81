//! The bodies of a scene, and which of them nothing can move.

use serde::Serialize;

use crate::choices;
use crate::paper::mirror::Worksheet;
use crate::problem::modelling::Variant;
use crate::problem::scene::{Body, Scene};

choices! {
    /// Why nothing moves a body: its displacements are exactly 0.
    Idle {
        /// No load acts on a free equation of it, and no contact surface lies on it.
        NoLoadNoContact = "no load, no contact",
        /// No load acts on a free equation of it, and `Km` as printed passes none between bodies (finding K1).
        NotCoupled = "no load, and Km as printed couples no bodies (K1)",
        /// All its equations are restrained.
        Restrained = "all its equations are restrained",
    }
}

/// A body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyPlan {
    /// Its name.
    pub name: String,
    /// Its nodes.
    pub nodes: usize,
    /// Its triangles.
    pub triangles: usize,
    /// Its free equations.
    pub free: usize,
    /// Whether a contact surface lies on it.
    pub in_contact: bool,
    /// Why nothing moves it; nothing where something may.
    pub idle: Option<Idle>,
}

/// The bodies of `scene`.
pub fn plan(scene: &Scene, sheet: &Worksheet<f64>, variant: Variant) -> Vec<BodyPlan> {
    scene.bodies.iter().map(|body| of_body(scene, sheet, variant, body)).collect()
}

fn of_body(scene: &Scene, sheet: &Worksheet<f64>, variant: Variant, body: &Body) -> BodyPlan {
    let equations = body.nodes.iter().flat_map(|n| [2 * n - 1, 2 * n]);
    let free: Vec<usize> = equations.filter(|&e| sheet.S[e] == 0).collect();
    let loaded = free.iter().any(|e| scene.load[e - 1] != 0.0);
    let in_contact = touched(sheet, body);
    let idle = match (free.is_empty(), loaded, in_contact) {
        (true, ..) => Some(Idle::Restrained),
        (_, true, _) => None,
        (_, _, false) => Some(Idle::NoLoadNoContact),
        (_, _, true) => (variant == Variant::Printed).then_some(Idle::NotCoupled),
    };
    BodyPlan {
        name: body.name.clone(),
        nodes: body.nodes.len(),
        triangles: body.triangles.len(),
        free: free.len(),
        in_contact,
        idle,
    }
}

/// Whether an entry of `cnt` or an end of a target edge lies on it.
fn touched(sheet: &Worksheet<f64>, body: &Body) -> bool {
    let ends = sheet.trg.iter().flat_map(|&e| [sheet.elem[(e, 6)], sheet.elem[(e, 7)]]);
    sheet.cnt.iter().copied().chain(ends).any(|n| body.nodes.binary_search(&n).is_ok())
}
