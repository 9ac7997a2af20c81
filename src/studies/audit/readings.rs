//! The ambiguities of the print, one by one: what each other value of a reading changes on a scene.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use super::evidence::{NoFigures, Outcome, differ};
use super::findings::ROUNDING;
use engine::error::Error;
use engine::{Detail, max_displacement, over};
use mathcad::{Failure, Settings};
use numbers::square::SparseSquare;
use paper::door::{self, Call};
use paper::listings::{self, Which};
use paper::mirror::{Ambiguity, Change, Pairs, READINGS, Reading, Trial, Value};
use problem::element;
use problem::modelling::Variant;

/// What another value of a reading changes on a scene.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Effect {
    /// The ambiguity's name, `R1` to `R10`.
    pub id: &'static str,
    /// The value that differs from the default, such as `R1 = inside` or `R9: ORIGIN = 0`.
    pub reading: String,
    /// The lines of the listing that it concerns.
    pub lines: &'static str,
    /// Contact nodes whose dy changes at the initial shape; nothing where that was not computed.
    pub statuses: Option<usize>,
    /// Entries of MJS that change at the initial shape; likewise.
    pub entries: Option<usize>,
    /// The largest difference at the end of what `of` names: of a node's displacement, length, or of a
    /// triangle's von Mises strain; nothing where no solution is asked for.
    pub displacement: Option<f64>,
    /// The distance in the energy norm, relative, of the run under this reading from the equilibrium;
    /// nothing where there is no equilibrium, and where the reading has no run of its own.
    pub equilibrium_error: Option<f64>,
    /// The largest displacement of the variant's own run, length; 1 where there is none.
    #[serde(skip)]
    size: f64,
    /// The variant that was run under this reading; nothing where none was.
    #[serde(skip)]
    pub variant: Option<Variant>,
    /// Whether the reading has another plane problem, with an equilibrium of its own (R6).
    #[serde(skip)]
    pub apart: bool,
    /// Whether the contact state of the run alternates, so that its figures are those of one of several
    /// states.
    pub unsettled: bool,
    /// What differs, and under which variant; or that the listings were executed once.
    pub of: String,
    /// Why the reading cannot be run on this scene, or that rounding decides on its figures.
    pub failure: Option<NoFigures>,
}

/// Tries every other value of every reading on a scene, in the order of [`READINGS`].
pub fn effects(case: &Case) -> Vec<Effect> {
    let cases = || [case].into_iter().chain(case.equivalents());
    let as_read =
        |case| AsRead { mirror: initial(case), blank: executed(case, &Settings::default()) };
    let as_read: Vec<(&Case, AsRead)> = cases().map(|case| (case, as_read(case))).collect();
    let effect = |(row, other)| {
        let mut effects = as_read.iter().map(|(case, own)| Effect::new(row, other, case, own));
        effects.next().expect("the case itself").confirmed_by(effects)
    };
    others(case).into_par_iter().map(effect).collect()
}

/// What the listings compute as a case is read.
struct AsRead {
    /// In the mirror.
    mirror: Result<Initial, Error>,
    /// Executed under a blank worksheet's settings.
    blank: Result<Initial, Box<Failure>>,
}

/// The values of the ambiguities that differ from what a case is read by, each with the reading that it
/// makes of that.
pub(super) fn others(case: &Case) -> Vec<(&'static Ambiguity, (&'static Value, Reading))> {
    let (plane, own) = (case.model().plane, case.request(case.published_variant()));
    let (base, schedule) = (*case.reading(), own.schedule());
    let of_row =
        |row: &'static Ambiguity| row.others(base, plane, schedule).map(move |other| (row, other));
    READINGS.iter().flat_map(of_row).collect()
}

/// What `c_cnt` and `Km` compute at the initial shape.
struct Initial {
    pairs: Pairs<f64>,
    matrix: SparseSquare,
}

fn initial(case: &Case) -> Result<Initial, Error> {
    let call = case.initial()?;
    let matrix = call.km(case.reading())?;
    Ok(Initial { pairs: call.pairs, matrix })
}

/// The two listings, executed at the initial shape.
fn executed(case: &Case, settings: &Settings) -> Result<Initial, Box<Failure>> {
    let (sheet, reading) = (&door::worksheet(case.model(), |x| x), *case.reading());
    let pairs = if case.model().has_contact() {
        let listing = Which::CCnt.under(&reading);
        listings::c_cnt(&listing, settings, sheet, &sheet.node, None)?.0
    } else {
        // Without contact nothing of contact is built: `c_cnt` is not called.
        Pairs::none(sheet.R())
    };
    let listing = Which::Km.under(&reading);
    let (matrix, _) = listings::km(&listing, settings, sheet, &pairs.k_cnt, None)?;
    Ok(Initial { pairs, matrix: matrix.sparse() })
}

impl Effect {
    fn new(
        row: &Ambiguity,
        (value, reading): (&Value, Reading),
        case: &Case,
        as_read: &AsRead,
    ) -> Self {
        let own = case.published_variant();
        let (variant, of) = match row.trial {
            Trial::OwnVariant | Trial::EveryShape => {
                (Some(own), format!("displacement under {own}"))
            }
            Trial::Printed => {
                (Some(Variant::Printed), format!("displacement under {}", Variant::Printed))
            }
            Trial::Worksheet => (None, "listings executed once".into()),
            Trial::Strains => (None, format!("von Mises strain under {own}")),
        };
        let run = variant.and_then(|variant| case.run(variant).ok());
        let mut effect = Effect {
            id: row.id,
            reading: row.label(value),
            lines: row.lines,
            size: run.map_or(1.0, |run| max_displacement(&run.u)),
            variant,
            of,
            ..Effect::default()
        };
        let outcome = effect.measure(row.trial, value.change, reading, case, as_read);
        effect.failure = outcome.err();
        effect
    }

    fn measure(
        &mut self,
        trial: Trial,
        change: Change,
        reading: Reading,
        case: &Case,
        as_read: &AsRead,
    ) -> Outcome<()> {
        let own = case.run(self.variant.unwrap_or(case.published_variant()));
        match trial {
            // The mirror under the reading, beside the mirror under the default one.
            Trial::OwnVariant | Trial::Printed => {
                let as_read = as_read.mirror.as_ref()?;
                let other = case.under(reading)?;
                self.compare(as_read, &initial(&other)?);
                let run = other.run(self.variant.expect("the trial runs one"))?;
                self.apart = run.model.plane != case.model().plane;
                let of = if self.apart { &other } else { case };
                self.equilibrium_error = of.from_equilibrium(run).map(|from| from.energy_relative);
                self.unsettled = run.last().cycle.as_ref().is_some_and(|cycle| cycle.length > 1);
                let own = own.map_err(|why| format!("as it is read: {why}"))?;
                self.displacement = Some(max_displacement(&(&own.u - &run.u)));
            }
            // The shapes of a variant once more under the reading, which can only make `c_cnt` fail, or
            // leave everything as it is.
            Trial::EveryShape => {
                let solution = own?;
                for step in &solution.steps {
                    let call = Call::c_cnt(&solution.model, &reading, &step.shape)
                        .map_err(|why| format!("iteration {}: {why}", step.k))?;
                    if case.scene.contact.status.is_printed() {
                        let Detail::Published(own) = &step.detail else {
                            unreachable!("a published variant")
                        };
                        assert_eq!(call.pairs, *own, "{} changes no value", self.reading);
                    }
                }
                (self.statuses, self.entries, self.displacement) = (Some(0), Some(0), Some(0.0));
                self.equilibrium_error =
                    case.from_equilibrium(solution).map(|from| from.energy_relative);
            }
            // The listings under other settings of the worksheet, beside those under a blank one's.
            Trial::Worksheet => {
                let mut settings = Settings::default();
                change.set(&mut settings);
                let changed = executed(case, &settings).map_err(|why| why.to_string())?;
                let blank = as_read.blank.as_ref();
                let blank = blank
                    .map_err(|why| format!("runs; under a blank worksheet it fails: {why}"))?;
                self.compare(blank, &changed);
            }
            // The von Mises strain by the formula of the von Mises stress on strains, divided by 1 + nu,
            // beside the default: the largest difference of a triangle.
            Trial::Strains => {
                let solution = own?;
                let model = &*solution.model;
                let other =
                    solution.elements.iter().zip(&model.triangles).map(|(state, triangle)| {
                        let (nu, epsilon) = (triangle.material.nu, &state.epsilon);
                        let other =
                            element::von_mises_strain_by_stress_formula(model.plane, nu, epsilon);
                        (state.von_mises_strain - other).abs()
                    });
                self.displacement = Some(other.fold(0.0, f64::max));
            }
        }
        Ok(())
    }

    /// Counts the statuses and the entries in which the two differ by more than rounding.
    fn compare(&mut self, a: &Initial, b: &Initial) {
        let statuses = a.pairs.dy.iter().zip(b.pairs.dy.iter());
        let least = ROUNDING * a.matrix.amax();
        self.statuses = Some(statuses.filter(|(a, b)| a != b).count());
        let entries = a.matrix.differences(&b.matrix);
        self.entries = Some(entries.filter(|change| change.abs() > least).count());
    }

    /// Whether anything of the result depends on the reading.
    pub fn changes(&self) -> bool {
        self.failure.is_some()
            || self.statuses.is_some_and(|n| n > 0)
            || self.entries.is_some_and(|n| n > 0)
            || self.displacement.is_some_and(|d| d > 0.0)
    }

    /// Leaves the figures out where one of `others`, measured on inputs that mean the same, has other ones.
    fn confirmed_by(self, mut others: impl Iterator<Item = Self>) -> Self {
        let figures = self.figures();
        if others.all(|other| !differ(&figures, &other.figures())) {
            return self;
        }
        Effect {
            statuses: None,
            entries: None,
            displacement: None,
            equilibrium_error: None,
            failure: Some(NoFigures::Rounding),
            ..self
        }
    }

    /// Returns whether it fails, and the figures, each over the scale of its kind.
    fn figures(&self) -> [Option<f64>; 5] {
        [
            Some(f64::from(self.failure.is_some())),
            self.statuses.map(|n| n as f64),
            self.entries.map(|n| n as f64),
            self.displacement.map(|displacement| over(displacement, self.size)),
            self.equilibrium_error,
        ]
    }
}
