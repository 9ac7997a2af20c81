//! What a lesson can switch: readings, the worksheet's settings, the tolerance, an edited listing.

use std::sync::Arc;

use super::{Listing, Model, Reading, Request, Scene, Settings, Which, settings};
use crate::audit::readings::WORKSHEETS;
use engine::error::Result;
use problem::element::Plane;
use problem::modelling::Variant;

/// A change of one thing against the listings as printed under the default reading.
#[derive(Clone)]
pub struct Switch {
    /// Its name, such as `R2 = printed`.
    pub name: String,
    /// What it does, in words.
    pub about: String,
    pub(super) reading: Reading,
    pub(super) worksheet: fn(&mut Settings),
    /// The tolerance over the scene's.
    pub(super) factor: f64,
    /// What is changed of the scene's model.
    pub(super) change: fn(&mut Model),
    /// The listing in place of one of the paper's.
    pub(super) edited: Option<(Which, Listing)>,
}

/// The values of R1 to R8 that are not the default and that a call of the listings depends on; R6
/// depends on the scene.
const READINGS: [(&str, &str); 8] = [
    ("R1=inside", "c_cnt 14: the weights loop stands inside the zeroing loop"),
    ("R2=printed", "Km 7: the restraint is read under the index of line 8"),
    ("R3=per-node", "Km 16-33: each linked node adds with its own weight"),
    ("R3=nested", "Km 16-33: as per-node, and the second pair within the first"),
    ("R4=left-to-right", "c_cnt 17, 18: the operands of ∧ up to the first false one"),
    ("R4=eager", "c_cnt 17, 18: all operands of ∧, and a failure stands"),
    (
        "R5=node_n",
        "c_cnt 22, 23: weights from current coordinates; this is the first call, \
                   where they are the initial ones",
    ),
    ("R8=m", "c_cnt 5-7, 16: c_tll in metres, where the scene is in mm"),
];

/// Tolerances over the scene's own.
const TOLERANCES: [(f64, &str); 3] =
    [(0.1, "c_tll / 10"), (2.0, "c_tll · 2"), (10.0, "c_tll · 10")];

/// Returns the switches that a lesson offers on a scene, first the one that changes nothing.
pub fn switches(scene: &Scene) -> Vec<Switch> {
    let plane = match scene.model.plane {
        Plane::Strain => "R6=stress",
        Plane::Stress => "R6=strain",
    };
    let plane = (plane, "Km 9: D of the other plane problem");
    let readings = READINGS.into_iter().chain([plane]).map(|(reading, about)| Switch {
        reading: reading.parse().expect("the readings of this table are sound"),
        ..Switch::named(reading.replace('=', " = "), about)
    });
    let worksheets = WORKSHEETS.map(|(lines, name, worksheet)| Switch {
        worksheet,
        ..Switch::named(format!("R9: {name}"), lines)
    });
    let tolerances = TOLERANCES
        .map(|(factor, name)| Switch { factor, ..Switch::named(name, "c_cnt 5-7, 16: tolerance") });
    let all = std::iter::once(Switch::as_printed()).chain(readings);
    all.chain(worksheets).chain(tolerances).collect()
}

impl Switch {
    fn named(name: impl Into<String>, about: impl Into<String>) -> Self {
        Switch {
            name: name.into(),
            about: about.into(),
            reading: Reading::default(),
            worksheet: |_| (),
            factor: 1.0,
            change: |_| (),
            edited: None,
        }
    }

    /// Returns the switch that changes nothing.
    pub fn as_printed() -> Self {
        Switch::named("as printed", "the listings as printed, under the default of every reading")
    }

    /// Returns the switch that has another listing in place of the printed one.
    pub fn edited(name: &str, about: String, which: Which, listing: Listing) -> Self {
        Switch { edited: Some((which, listing)), ..Switch::named(name, about) }
    }

    /// Returns the scene's model under the switch.
    pub(super) fn model(&self, scene: &Scene) -> Result<Arc<Model>> {
        let mut request = Request::new(scene).variant(Variant::Printed).reading(self.reading);
        request.tolerance = Some(self.factor * scene.model.contact.tolerance);
        let mut model = Arc::unwrap_or_clone(request.model()?);
        (self.change)(&mut model);
        Ok(Arc::new(model))
    }

    pub(super) fn listing(&self, which: Which) -> Listing {
        match &self.edited {
            Some((edited, listing)) if *edited == which => listing.clone(),
            _ => which.under(&self.reading),
        }
    }

    pub(super) fn settings(&self) -> Settings {
        let mut own = settings(&self.reading);
        (self.worksheet)(&mut own);
        own
    }
}
