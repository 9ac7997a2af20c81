//! What a lesson can switch: readings, an edited listing, a finding's repair.

use std::sync::Arc;

use super::{Listing, Model, Reading, Request, Scene, Settings, Which, settings};
use crate::audit::findings::{Finding, Preparation, Repair};
use engine::error::Result;
use paper::listings;
use paper::mirror::{Change, READINGS};
use problem::modelling::Variant;

/// A change of one thing against the listings as printed under the default reading.
#[derive(Clone)]
pub struct Switch {
    /// Its name, such as `R2 = printed`.
    pub name: String,
    /// The listing and the lines that it concerns, `both` for both listings; empty for neither.
    pub lines: &'static str,
    /// What it does, in words, one behind the other.
    pub about: Vec<&'static str>,
    reading: Reading,
    /// What is changed of the worksheet beside the reading.
    worksheet: Change,
    /// What is changed of the scene's model.
    model: fn(&mut Model),
    /// The listing in place of one of the paper's.
    edited: Option<(Which, Listing)>,
}

/// Returns the switches that a lesson offers on a scene, first the one that changes nothing: of the
/// readings those that concern a printed line, which a call of the listings can show.
pub fn switches(scene: &Scene) -> Vec<Switch> {
    let (plane, schedule) = (scene.model.plane, Request::new(scene).schedule());
    let readings = READINGS.iter().filter(|row| row.lines != "-").flat_map(|row| {
        row.others(Reading::default(), plane, schedule).map(move |(value, reading)| Switch {
            name: row.label(value),
            lines: row.lines,
            about: vec![value.words],
            reading,
            worksheet: if row.is_option() { Change::None } else { value.change },
            ..Switch::as_printed()
        })
    });
    std::iter::once(Switch::as_printed()).chain(readings).collect()
}

/// Returns what a finding's chapter runs: the listings as printed, where the finding shows, and
/// with its repair if that is an edit of a listing.
pub fn chapter(finding: &Finding) -> Vec<Switch> {
    let printed = Switch::as_printed();
    let about = |what: &'static str| [&printed.about[..], &[what]].concat();
    let before = match finding.before {
        Preparation::AsPrinted => printed,
        Preparation::Reading(words, reading) => Switch {
            about: about(words),
            reading: reading.parse().expect("a reading of the register"),
            ..printed
        },
        Preparation::Model(words, model) => Switch { about: about(words), model, ..printed },
    };
    match finding.edit {
        Repair::None { .. } => vec![before],
        Repair::Edit { text } => {
            let which = Which::from_text(text).expect("an edit names its listing");
            let listing = listings::edited(&which.under(&Reading::default()), text);
            let after = Switch {
                name: "repaired".into(),
                lines: which.name(),
                about: vec![finding.repair],
                edited: Some((which, listing)),
                ..before.clone()
            };
            vec![before, after]
        }
    }
}

impl Switch {
    /// Returns the switch that changes nothing.
    pub fn as_printed() -> Self {
        Switch {
            name: "as printed".into(),
            lines: "",
            about: vec!["the listings as printed, under the default of every reading"],
            reading: Reading::default(),
            worksheet: Change::None,
            model: |_| (),
            edited: None,
        }
    }

    /// Returns the switch that has a user's listing in place of the printed one.
    pub fn edited(which: Which, listing: Listing) -> Self {
        Switch {
            name: "edited".into(),
            lines: which.name(),
            about: vec!["as edited"],
            edited: Some((which, listing)),
            ..Switch::as_printed()
        }
    }

    /// Returns the scene's model under the switch.
    ///
    /// # Errors
    /// The plane problem of R6 does not allow a Poisson's ratio.
    pub fn model(&self, scene: &Scene) -> Result<Arc<Model>> {
        let request = Request::new(scene).variant(Variant::Printed).reading(self.reading);
        let mut model = Arc::unwrap_or_clone(request.model()?);
        (self.model)(&mut model);
        Ok(Arc::new(model))
    }

    /// Returns a listing under the switch.
    pub fn listing(&self, which: Which) -> Listing {
        match &self.edited {
            Some((edited, listing)) if *edited == which => listing.clone(),
            _ => which.under(&self.reading),
        }
    }

    /// Returns whether the restraint of x is taken from that of y (R2).
    pub fn reads_restraint_of_y(&self) -> bool {
        self.reading.r2.takes_y_for_x()
    }

    /// Returns the worksheet's settings under the switch.
    pub fn settings(&self) -> Settings {
        let mut settings = settings(&self.reading);
        self.worksheet.set(&mut settings);
        settings
    }
}
