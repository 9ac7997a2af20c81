//! The ambiguities of the print, one by one: what the other reading changes on a scene.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::case::Case;
use engine::error::Error;
use engine::{Detail, Solution, max_displacement, solve};
use mathcad::array::Table;
use mathcad::{Failure, Settings};
use paper::door::{self, Call};
use paper::listings::{self, Which};
use paper::mirror::{Km, Pairs, Reading};
use problem::element::{self, Plane};
use problem::modelling::Variant;

#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Effect {
    /// The ambiguity's name, `R1` to `R10`.
    pub id: &'static str,
    /// What differs from the default: `R1 = inside`, or a setting of the worksheet.
    pub reading: String,
    pub lines: &'static str,
    /// Contact nodes whose dy changes at the initial shape; nothing where that was not computed.
    pub statuses: Option<usize>,
    /// Entries of MJS that change at the initial shape; likewise.
    pub entries: Option<usize>,
    /// The largest difference at the end of what `of` names: of a node's displacement, length, or of a
    /// triangle's von Mises strain; nothing where no solution is asked for.
    pub displacement: Option<f64>,
    /// What differs, and under which variant; or that the listings were executed once.
    pub of: String,
    /// Why the reading cannot be run on this scene.
    pub failure: Option<String>,
}

enum Trial {
    /// The mirror under the reading, solved under a variant.
    Mirror(Variant),
    /// Another order of evaluation of `∧`.
    Conjunction,
    /// The other load schedule: for `tied` and `stepped` that is the other of the two.
    Schedule(Variant),
    Worksheet(fn(&mut Settings)),
    StrainFormula,
}

/// Nothing where a trial runs through, else what stopped it.
type Outcome<'a> = Result<(), Box<dyn std::error::Error + 'a>>;

/// An alternative of R9: the lines that it concerns, its name, and what it sets.
pub type Alternative = (&'static str, &'static str, fn(&mut Settings));

/// What a worksheet, or Mathcad itself, may do otherwise around the listings.
pub const WORKSHEETS: [Alternative; 6] = [
    ("both", "ORIGIN = 0", |s| s.origin = 0),
    ("c_cnt 10, 22, 23", "0/0 = 0", |s| s.zero_over_zero_is_zero = true),
    ("both", "comparisons to 1e-12", |s| s.exact_boolean = false),
    ("both", "below 1e-307 is 0", |s| s.tiny_is_zero = true),
    ("both", "1 .. 0 is empty", |s| s.descending_is_empty = true),
    ("both", "a failed last if is 0", |s| s.last_if_is_zero = true),
];

/// Every other reading on a scene, in the order of `listings/READING.md`, section 4.
pub fn effects(case: &Case) -> Vec<Effect> {
    use Trial::{Conjunction, Mirror, StrainFormula, Worksheet};
    let own = case.published_variant();
    let plane = match case.model().plane {
        Plane::Strain => "R6 = stress",
        Plane::Stress => "R6 = strain",
    };
    let (schedule, load) = match own {
        Variant::Stepped => ("R7 = total", Trial::Schedule(Variant::Tied)),
        Variant::Tied => ("R7 = stepped", Trial::Schedule(Variant::Stepped)),
        Variant::Printed | Variant::Unilateral => ("R7 = stepped", Mirror(own)),
    };
    let mut trials: Vec<(&str, &str, &str, Trial)> = vec![
        ("R1", "c_cnt 14", "R1 = inside", Mirror(own)),
        ("R2", "Km 7", "R2 = printed", Mirror(Variant::Printed)),
        ("R3", "Km 16-33", "R3 = per-node", Mirror(Variant::Printed)),
        ("R3", "Km 16-33", "R3 = nested", Mirror(Variant::Printed)),
        ("R4", "c_cnt 17, 18", "R4 = left-to-right", Conjunction),
        ("R4", "c_cnt 17, 18", "R4 = eager", Conjunction),
        ("R5", "c_cnt 22, 23", "R5 = node_n", Mirror(own)),
        ("R6", "Km 9", plane, Mirror(own)),
        ("R7", "-", schedule, load),
        ("R8", "c_cnt 5-7, 16", "R8 = m", Mirror(own)),
    ];
    trials.extend(
        WORKSHEETS.map(|(lines, reading, change)| ("R9", lines, reading, Worksheet(change))),
    );
    trials.push(("R10", "-", "stress formula / (1 + nu)", StrainFormula));
    let blank = executed(case, &Settings::default());
    let effect =
        |(id, lines, reading, trial): (&'static str, &'static str, &'static str, Trial)| {
            let of = match trial {
                Mirror(variant) => format!("displacement under {variant}"),
                Conjunction | Trial::Schedule(_) => format!("displacement under {own}"),
                Worksheet(_) => "listings executed once".into(),
                StrainFormula => format!("von Mises strain under {own}"),
            };
            let mut effect = Effect {
                id,
                reading: reading.into(),
                lines,
                statuses: None,
                entries: None,
                displacement: None,
                of,
                failure: None,
            };
            let outcome = match trial {
                Mirror(variant) => effect.mirror(case, variant),
                Conjunction => effect.conjunction(case, own),
                Trial::Schedule(other) => effect.schedule(case, own, other),
                Worksheet(change) => effect.worksheet(case, &blank, change),
                StrainFormula => effect.strain_formula(case, own),
            };
            effect.failure = outcome.err().map(|why| why.to_string());
            effect
        };
    trials.into_par_iter().map(effect).collect()
}

/// What `c_cnt` and `Km` compute at the initial shape.
struct Initial {
    pairs: Pairs<f64>,
    matrix: Table<f64>,
}

fn initial(case: &Case, reading: &Reading) -> Result<Initial, Error> {
    let model = case.request(case.scene.variant).reading(*reading).model()?;
    let call = Call::c_cnt(&model, reading, &model.nodes)?;
    let matrix = Km(&call.sheet, reading, &call.pairs.k_cnt)?.to_table();
    Ok(Initial { pairs: call.pairs, matrix })
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

impl Effect {
    fn parsed(&self) -> Reading {
        self.reading.parse().expect("the readings of this table are sound")
    }

    /// The mirror under the reading, beside the mirror under the default one.
    fn mirror<'a>(&mut self, case: &'a Case, variant: Variant) -> Outcome<'a> {
        let reading = self.parsed();
        self.compare(&initial(case, &Reading::default())?, &initial(case, &reading)?);
        let other = solve(&case.request(variant).reading(reading), &mut |_| ())?;
        let own = case.run(variant).map_err(|why| format!("under the default reading: {why}"))?;
        self.displacement = Some(largest_difference(own, &other));
        Ok(())
    }

    /// The shapes of a variant once more under another order of evaluation: it can only make
    /// `c_cnt` fail, or leave everything as it is.
    fn conjunction<'a>(&mut self, case: &'a Case, variant: Variant) -> Outcome<'a> {
        let solution = case.run(variant)?;
        for step in &solution.steps {
            let call = Call::c_cnt(&solution.model, &self.parsed(), &step.shape)
                .map_err(|why| format!("iteration {}: {why}", step.k))?;
            if case.scene.contact.status.is_printed() {
                let Detail::Published(own) = &step.detail else {
                    unreachable!("a published variant")
                };
                assert_eq!(
                    call.pairs,
                    own.pairs.whole(),
                    "the order of evaluation changes no value"
                );
            }
        }
        (self.statuses, self.entries, self.displacement) = (Some(0), Some(0), Some(0.0));
        Ok(())
    }

    fn schedule<'a>(&mut self, case: &'a Case, own: Variant, other: Variant) -> Outcome<'a> {
        self.displacement = Some(largest_difference(case.run(own)?, case.run(other)?));
        Ok(())
    }

    /// The listings under other settings of the worksheet, beside those under a blank one's.
    fn worksheet<'a>(
        &mut self,
        case: &'a Case,
        blank: &Result<Initial, Box<Failure>>,
        change: fn(&mut Settings),
    ) -> Outcome<'a> {
        let mut settings = Settings::default();
        change(&mut settings);
        let changed = executed(case, &settings)?;
        let blank = blank.as_ref();
        let blank =
            blank.map_err(|why| format!("runs; under a blank worksheet it fails: {why}"))?;
        self.compare(blank, &changed);
        Ok(())
    }

    /// R10: the von Mises strain by the formula of the von Mises stress on strains, divided by
    /// 1 + nu, beside the default: the largest difference of a triangle.
    fn strain_formula<'a>(&mut self, case: &'a Case, variant: Variant) -> Outcome<'a> {
        let solution = case.run(variant)?;
        let model = &*solution.model;
        let other = solution.elements.iter().zip(&model.triangles).map(|(state, triangle)| {
            let (nu, epsilon) = (triangle.material.nu, &state.epsilon);
            let other = element::von_mises_strain_by_stress_formula(model.plane, nu, epsilon);
            (state.von_mises_strain - other).abs()
        });
        self.displacement = Some(other.fold(0.0, f64::max));
        Ok(())
    }

    /// Counts the statuses and the entries in which the two differ.
    fn compare(&mut self, a: &Initial, b: &Initial) {
        let statuses = a.pairs.dy.iter().zip(b.pairs.dy.iter());
        let entries = a.matrix.as_matrix().iter().zip(b.matrix.as_matrix().iter());
        self.statuses = Some(statuses.filter(|(a, b)| a != b).count());
        self.entries = Some(entries.filter(|(a, b)| a != b).count());
    }

    /// Whether anything of the result depends on the reading.
    pub fn changes(&self) -> bool {
        self.failure.is_some()
            || self.statuses.is_some_and(|n| n > 0)
            || self.entries.is_some_and(|n| n > 0)
            || self.displacement.is_some_and(|d| d > 0.0)
    }
}

/// Largest |u| between two displacement fields, length.
fn largest_difference(a: &Solution, b: &Solution) -> f64 {
    max_displacement(&(&a.u - &b.u))
}
