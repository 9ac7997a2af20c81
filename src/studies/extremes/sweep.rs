//! A magnitude swept, and where something breaks down.

use rayon::prelude::*;
use serde::Serialize;

use super::answer::Exacts;
use super::verdict::Verdict;
use engine::error::Error;
use numbers::solve::ScalarName;

/// Fewer right digits than these, and an engineer is misled.
pub const LEAST: f64 = 3.0;

/// A family of scenes in which one magnitude becomes extreme.
pub struct Generator {
    /// Its name.
    pub name: &'static str,
    /// What the generator tries, in a line for people.
    pub title: &'static str,
    /// What is swept, with its unit.
    pub magnitude: &'static str,
    sweep: Sweep,
    methods: Vec<Method>,
}

pub enum Sweep {
    /// Powers of ten `from` .. `to` by `step`, walked from 1 outwards.
    Decades { from: i32, to: i32, step: usize },
    /// Named cases; the magnitude is the case's number, from 0.
    Cases(&'static [&'static str]),
}

/// How a problem is solved: a variant or a remedy, and a scalar.
pub struct Method {
    name: String,
    carried: f64,
    /// Fewer digits than these count as broken.
    least: f64,
    measure: Box<Measure>,
}

/// Solves the problem of a magnitude, and judges the answer.
type Measure = dyn Fn(f64, &Exacts) -> Result<Verdict, Error> + Send + Sync;

impl Method {
    /// A method in `scalar`; `measure` solves the problem of a magnitude and judges the answer.
    pub fn new(
        name: impl Into<String>,
        scalar: ScalarName,
        measure: impl Fn(f64, &Exacts) -> Result<Verdict, Error> + Send + Sync + 'static,
    ) -> Self {
        // An exact answer is compared as an f64.
        let carried = f64::from(scalar.properties().digits.unwrap_or(16));
        Method { name: name.into(), carried, least: LEAST, measure: Box::new(measure) }
    }

    /// The same method, of which no more than `carried` digits are known.
    pub fn carrying(self, carried: f64) -> Self {
        Method { carried: self.carried.min(carried), ..self }
    }

    /// The same method, which breaks down only with fewer than `least` digits.
    pub fn down_to(self, least: f64) -> Self {
        Method { least, ..self }
    }

    fn verdict(&self, magnitude: f64, exacts: &Exacts) -> Verdict {
        (self.measure)(magnitude, exacts).unwrap_or_else(Verdict::from).at_most(self.carried)
    }
}

/// What the methods made of the scenes of a generator.
#[derive(Clone, Debug, Serialize)]
pub struct SweepTable {
    /// The generator's name.
    pub name: &'static str,
    /// What the generator tries, in a line for people.
    pub title: &'static str,
    /// What was swept, with its unit.
    pub magnitude: &'static str,
    /// The magnitudes in words.
    pub labels: Vec<String>,
    /// The magnitudes; the number of a case, from 1, where they are no numbers.
    pub magnitudes: Vec<f64>,
    /// Whether the magnitudes are powers of ten.
    pub logarithmic: bool,
    /// The verdicts, a column for each method.
    pub columns: Vec<Column>,
}

/// The verdicts on a method.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// The method's name: variant or remedy, and scalar.
    pub name: String,
    /// The digits that the method's scalar carries.
    pub carried: f64,
    /// A verdict for each magnitude.
    pub verdicts: Vec<Verdict>,
    /// Where it breaks down towards smaller magnitudes.
    pub below: Option<Break>,
    /// Where it breaks down towards larger ones.
    pub above: Option<Break>,
}

/// Where a method breaks down.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Break {
    /// Power of ten, bisected to half a decade.
    pub exponent: f64,
    /// The verdict there.
    pub verdict: Verdict,
}

impl Generator {
    /// A generator that tries each of `methods` on what is swept.
    pub fn new(
        name: &'static str,
        title: &'static str,
        magnitude: &'static str,
        sweep: Sweep,
        methods: impl IntoIterator<Item = Vec<Method>>,
    ) -> Self {
        let methods = methods.into_iter().flatten().collect();
        Generator { name, title, magnitude, sweep, methods }
    }

    /// Runs all methods on all magnitudes.
    pub fn measure(&self) -> SweepTable {
        let Generator { name, title, magnitude, ref sweep, ref methods } = *self;
        let points = sweep.points();
        let logarithmic = matches!(sweep, Sweep::Decades { .. });
        let of = |p: &i32| sweep.magnitude(f64::from(*p)) + if logarithmic { 0.0 } else { 1.0 };
        let exacts = Exacts::default();
        // One method after the other at each point, as they share its exact answer.
        let at = |p: &i32| {
            let magnitude = sweep.magnitude(f64::from(*p));
            methods.iter().map(|method| method.verdict(magnitude, &exacts)).collect()
        };
        let verdicts: Vec<Vec<Verdict>> = points.par_iter().map(at).collect();
        let column = |(k, method): (usize, &Method)| {
            sweep.column(method, verdicts.iter().map(|row| row[k].clone()).collect(), &exacts)
        };
        SweepTable {
            name,
            title,
            magnitude,
            labels: points.iter().map(|p| sweep.label(*p)).collect(),
            magnitudes: points.iter().map(of).collect(),
            logarithmic,
            columns: methods.par_iter().enumerate().map(column).collect(),
        }
    }
}

impl Sweep {
    fn points(&self) -> Vec<i32> {
        match *self {
            Sweep::Decades { from, to, step } => (from..=to).step_by(step).collect(),
            Sweep::Cases(names) => (0..names.len() as i32).collect(),
        }
    }

    fn label(&self, point: i32) -> String {
        match self {
            Sweep::Decades { .. } => format!("1e{point}"),
            Sweep::Cases(names) => names[point as usize].into(),
        }
    }

    fn magnitude(&self, point: f64) -> f64 {
        match self {
            // A power of ten is read, not computed: correctly rounded on every machine.
            Sweep::Decades { .. } if point.fract() == 0.0 => {
                format!("1e{point}").parse().expect("a number")
            }
            Sweep::Decades { .. } => 10f64.powf(point),
            Sweep::Cases(_) => point,
        }
    }

    /// Finds where a method breaks down that was judged at each point.
    fn column(&self, method: &Method, verdicts: Vec<Verdict>, exacts: &Exacts) -> Column {
        let points = self.points();
        let at = |point: f64| method.verdict(self.magnitude(point), exacts);
        let (below, above) = match self {
            Sweep::Cases(_) => (None, None),
            Sweep::Decades { .. } => {
                let known: Vec<(i32, &Verdict)> = points.iter().copied().zip(&verdicts).collect();
                let start = points.partition_point(|p| *p < 0);
                let downwards = known[..=start].iter().rev();
                (breakdown(downwards, method, at), breakdown(known[start..].iter(), method, at))
            }
        };
        Column { name: method.name.clone(), carried: method.carried, verdicts, below, above }
    }
}

/// The first of the points outwards at which a method breaks down, bisected towards the point
/// before it; nothing where there is none. `at` judges a point between.
fn breakdown<'a>(
    outwards: impl Iterator<Item = &'a (i32, &'a Verdict)>,
    method: &Method,
    at: impl Fn(f64) -> Verdict,
) -> Option<Break> {
    let mut sound = None;
    for (point, verdict) in outwards {
        let exponent = f64::from(*point);
        if !verdict.breaks_down(method.least) {
            sound = Some(exponent);
            continue;
        }
        let mut broken = Break { exponent, verdict: (*verdict).clone() };
        while let Some(inner) = sound.filter(|inner| (broken.exponent - inner).abs() > 0.5) {
            let exponent = (broken.exponent + inner) / 2.0;
            let verdict = at(exponent);
            if verdict.breaks_down(method.least) {
                broken = Break { exponent, verdict };
            } else {
                sound = Some(exponent);
            }
        }
        return Some(broken);
    }
    None
}
