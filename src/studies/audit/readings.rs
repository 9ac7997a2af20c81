//! The ambiguities of the print, one by one: what the other reading changes on a scene.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use crate::answer::error::Error;
use crate::answer::{Detail, Solution, max_displacement, solve};
use crate::paper::door::{self, Call};
use crate::paper::listings::{self, Which};
use crate::paper::mathcad::array::Table;
use crate::paper::mathcad::settings::{Descending, LastIf, ZeroOverZero};
use crate::paper::mathcad::{Failure, Settings};
use crate::paper::mirror::{Km, Order, Pairs, Reading};
use crate::problem::element::{self, Plane};
use crate::problem::modelling::{StatusRule, Variant};

/// What another reading changes.
#[derive(Clone, Debug, Serialize)]
pub struct Effect {
    /// `R1` to `R10`.
    pub id: &'static str,
    /// What differs from the default: `R1 = inside`, or a setting of the worksheet.
    pub reading: String,
    /// Listing and lines that it concerns.
    pub lines: &'static str,
    /// Contact nodes whose dy changes at the initial shape; nothing where that was not computed.
    pub statuses: Option<usize>,
    /// Entries of MJS that change at the initial shape; likewise.
    pub entries: Option<usize>,
    /// Largest difference of a displacement at the end, of the variant named; nothing where no solution is asked for.
    pub displacement: Option<f64>,
    /// That variant, or where the number stands for something else, what it is.
    pub of: String,
    /// Why the reading cannot be run on this scene.
    pub failure: Option<String>,
}

/// How a reading is tried.
enum Trial {
    /// The mirror under another reading, solved under a variant.
    Mirror(&'static str, Variant),
    /// Another order of evaluation of `∧`.
    Conjunction(Order),
    /// The other load schedule; for `tied` and `stepped` that is the other of the two.
    Schedule(Variant),
    /// The listings under other settings of the worksheet.
    Worksheet(&'static str, fn(&mut Settings)),
    /// The von Mises strain by the other formula.
    StrainFormula,
}

/// Every other reading on a scene, in the order of `listings/READING.md`, section 4.
pub fn effects(case: &Case) -> Vec<Effect> {
    let own = case.published_variant();
    let plane = match case.model().plane {
        Plane::Strain => "R6=stress",
        Plane::Stress => "R6=strain",
    };
    let trials: Vec<(&str, &str, Trial)> = vec![
        ("R1", "c_cnt 14", Trial::Mirror("R1=inside", own)),
        ("R2", "Km 7", Trial::Mirror("R2=printed", Variant::Printed)),
        ("R3", "Km 16-33", Trial::Mirror("R3=per-node", Variant::Printed)),
        ("R3", "Km 16-33", Trial::Mirror("R3=nested", Variant::Printed)),
        ("R4", "c_cnt 17, 18", Trial::Conjunction(Order::LeftToRight)),
        ("R4", "c_cnt 17, 18", Trial::Conjunction(Order::Eager)),
        ("R5", "c_cnt 22, 23", Trial::Mirror("R5=node_n", own)),
        ("R6", "Km 9", Trial::Mirror(plane, own)),
        ("R7", "-", Trial::Schedule(own)),
        ("R8", "c_cnt 5-7, 16", Trial::Mirror("R8=m", own)),
        ("R9", "both", Trial::Worksheet("ORIGIN = 0", |s| s.origin = 0)),
        (
            "R9",
            "c_cnt 10, 22, 23",
            Trial::Worksheet("0/0 = 0", |s| s.zero_over_zero = ZeroOverZero::Zero),
        ),
        ("R9", "both", Trial::Worksheet("comparisons to 1e-12", |s| s.exact_boolean = false)),
        ("R9", "both", Trial::Worksheet("below 1e-307 is 0", |s| s.tiny_is_zero = true)),
        ("R9", "both", Trial::Worksheet("1 .. 0 is empty", |s| s.descending = Descending::Empty)),
        ("R9", "both", Trial::Worksheet("a failed last if is 0", |s| s.last_if = LastIf::Zero)),
        ("R10", "-", Trial::StrainFormula),
    ];
    let blank = executed(case, &Settings::default());
    trials
        .into_par_iter()
        .map(|(id, lines, trial)| match trial {
            Trial::Mirror(reading, variant) => mirror(case, id, lines, reading, variant),
            Trial::Conjunction(order) => conjunction(case, id, lines, order),
            Trial::Schedule(variant) => schedule(case, id, lines, variant),
            Trial::Worksheet(name, change) => worksheet(case, &blank, (id, lines), name, change),
            Trial::StrainFormula => strain_formula(case, id, lines),
        })
        .collect()
}

/// What `c_cnt` and `Km` give at the initial shape.
struct Initial {
    pairs: Pairs<f64>,
    matrix: Table<f64>,
}

fn initial(case: &Case, reading: &Reading) -> Result<Initial, Error> {
    let model = case.request(case.scene.variant).reading(*reading).model()?;
    let call = Call::c_cnt(&model, reading, &model.nodes)?;
    let matrix = Km(&call.sheet, reading, &call.pairs.k_cnt)?;
    Ok(Initial { pairs: call.pairs, matrix })
}

/// The mirror under `text`, beside the mirror under the default reading.
fn mirror(
    case: &Case,
    id: &'static str,
    lines: &'static str,
    text: &str,
    variant: Variant,
) -> Effect {
    let reading: Reading = text.parse().expect("the readings of this table are sound");
    let shown = text.replace('=', " = ");
    let effect = Effect::none(id, shown, lines, variant.name().into());
    let compared =
        initial(case, &Reading::default()).and_then(|a| Ok((a, initial(case, &reading)?)));
    let (statuses, entries) = match compared {
        Ok((a, b)) => (
            Some(changed_statuses(&a.pairs, &b.pairs)),
            Some(changed_entries(&a.matrix, &b.matrix)),
        ),
        Err(why) => return effect.failed(&why),
    };
    let effect = Effect { statuses, entries, ..effect };
    let other = match solve(&case.request(variant).reading(reading), &mut |_| ()) {
        Ok(other) => other,
        Err(why) => return effect.failed(&why),
    };
    match case.run(variant) {
        Ok(own) => Effect { displacement: Some(largest_difference(own, &other)), ..effect },
        Err(why) => effect.failed(&format!("under the default reading: {why}")),
    }
}

/// The shapes of the scene's own variant once more under another order of evaluation: it can only make `c_cnt` fail, or leave
/// everything as it is.
fn conjunction(case: &Case, id: &'static str, lines: &'static str, r4: Order) -> Effect {
    let variant = case.published_variant();
    let effect = Effect::none(id, format!("R4 = {r4}"), lines, variant.name().into());
    let solution = match case.run(variant) {
        Ok(solution) => solution,
        Err(why) => return effect.failed(why),
    };
    let reading = Reading { r4, ..Reading::default() };
    for step in &solution.steps {
        let call = match Call::c_cnt(&solution.model, &reading, &step.shape) {
            Err(why) => return effect.failed(&format!("iteration {}: {why}", step.k)),
            Ok(call) => call,
        };
        if case.scene.contact.status == StatusRule::Signs {
            let Detail::Published(own) = &step.detail else { unreachable!("a published variant") };
            assert_eq!(call.pairs, own.pairs, "the order of evaluation changes no value");
        }
    }
    Effect { statuses: Some(0), entries: Some(0), displacement: Some(0.0), ..effect }
}

/// A variant under the other load schedule.
fn schedule(case: &Case, id: &'static str, lines: &'static str, variant: Variant) -> Effect {
    let (other, text) = match variant {
        Variant::Stepped => (Variant::Tied, "R7=total"),
        Variant::Tied => (Variant::Stepped, "R7=stepped"),
        Variant::Printed | Variant::Unilateral => {
            return mirror(case, id, lines, "R7=stepped", variant);
        }
    };
    let effect = Effect::none(id, text.replace('=', " = "), lines, variant.name().into());
    match (case.run(variant), case.run(other)) {
        (Ok(a), Ok(b)) => Effect { displacement: Some(largest_difference(a, b)), ..effect },
        (Err(why), _) | (_, Err(why)) => effect.failed(why),
    }
}

/// The listings under other settings of the worksheet, beside the listings under those of a blank one.
fn worksheet(
    case: &Case,
    blank: &Result<Initial, Box<Failure>>,
    (id, lines): (&'static str, &'static str),
    name: &str,
    change: fn(&mut Settings),
) -> Effect {
    let mut settings = Settings::default();
    change(&mut settings);
    let effect = Effect::none(id, name.into(), lines, "listings executed once".into());
    match (blank, executed(case, &settings)) {
        (Ok(a), Ok(b)) => Effect {
            statuses: Some(changed_statuses(&a.pairs, &b.pairs)),
            entries: Some(changed_entries(&a.matrix, &b.matrix)),
            ..effect
        },
        (_, Err(why)) => effect.failed(&why),
        (Err(why), Ok(_)) => {
            effect.failed(&format!("runs; under a blank worksheet it fails: {why}"))
        }
    }
}

/// The two listings, executed at the initial shape.
fn executed(case: &Case, settings: &Settings) -> Result<Initial, Box<Failure>> {
    let (sheet, reading) = (&door::worksheet(case.model(), |x| x), Reading::default());
    let pairs = if case.model().has_contact() {
        let listing = Which::CCnt.under(&reading);
        listings::c_cnt(&listing, settings, sheet, &sheet.node, &mut ())?.0
    } else {
        // Without contact nothing of contact is built: `c_cnt` is not called.
        Pairs::none(sheet.R())
    };
    let listing = Which::Km.under(&reading);
    let (matrix, _) = listings::km(&listing, settings, sheet, &pairs.k_cnt, &mut ())?;
    Ok(Initial { pairs, matrix })
}

/// R10: the largest von Mises strain by the formula of the von Mises stress on strains, divided by 1 + nu, beside the default.
fn strain_formula(case: &Case, id: &'static str, lines: &'static str) -> Effect {
    let what = "largest von Mises strain, difference";
    let effect = Effect::none(id, "stress formula / (1 + nu)".into(), lines, what.into());
    match case.run(case.published_variant()) {
        Err(why) => effect.failed(why),
        Ok(solution) => {
            let model = &*solution.model;
            let other = solution.elements.iter().zip(&model.triangles).map(|(state, triangle)| {
                let (nu, epsilon) = (triangle.material.nu, &state.epsilon);
                let other = element::von_mises_strain_by_stress_formula(model.plane, nu, epsilon);
                (state.von_mises_strain - other).abs()
            });
            Effect { displacement: Some(other.fold(0.0, f64::max)), ..effect }
        }
    }
}

impl Effect {
    fn none(id: &'static str, reading: String, lines: &'static str, of: String) -> Self {
        Effect {
            id,
            reading,
            lines,
            statuses: None,
            entries: None,
            displacement: None,
            of,
            failure: None,
        }
    }

    fn failed(self, why: &dyn std::fmt::Display) -> Self {
        Effect { failure: Some(why.to_string()), ..self }
    }

    /// Whether anything of the result depends on the reading.
    pub fn changes(&self) -> bool {
        self.failure.is_some()
            || self.statuses.is_some_and(|n| n > 0)
            || self.entries.is_some_and(|n| n > 0)
            || self.displacement.is_some_and(|d| d > 0.0)
    }
}

fn changed_statuses(a: &Pairs<f64>, b: &Pairs<f64>) -> usize {
    a.dy.iter().zip(b.dy.iter()).filter(|(a, b)| a != b).count()
}

fn changed_entries(a: &Table<f64>, b: &Table<f64>) -> usize {
    a.as_matrix().iter().zip(b.as_matrix().iter()).filter(|(a, b)| a != b).count()
}

/// Largest |u| between two displacement fields, length.
pub fn largest_difference(a: &Solution, b: &Solution) -> f64 {
    max_displacement(&(&a.u - &b.u))
}
