//! A magnitude swept, and where something breaks down.

use rayon::prelude::*;
use serde::Serialize;

use super::verdict::Verdict;

/// Fewer right digits than these, and an engineer is misled.
const LEAST: f64 = 3.0;

/// What a generator sweeps.
#[derive(Clone, Copy, Debug)]
pub enum Sweep {
    /// Powers of ten `from` .. `to` by `step`, walked from `start` outwards.
    Decades { from: i32, to: i32, step: usize, start: i32 },
    /// Named cases; the magnitude is the case's number, from 0.
    Cases(&'static [&'static str]),
}

/// A method of doing a problem.
pub struct Method {
    /// Its name: variant or remedy, and scalar.
    pub name: String,
    /// Digits that its scalar carries.
    pub carried: f64,
    /// Fewer digits than these count as broken.
    pub least: f64,
    /// What comes of a magnitude.
    measure: Box<dyn Fn(f64) -> Verdict + Send + Sync>,
}

impl Method {
    /// A method whose scalar carries `carried` digits.
    pub fn new(
        name: impl Into<String>,
        carried: f64,
        measure: impl Fn(f64) -> Verdict + Send + Sync + 'static,
    ) -> Self {
        Method { name: name.into(), carried, least: LEAST, measure: Box::new(measure) }
    }

    /// The same method, which breaks down only with fewer than `least` digits.
    pub fn down_to(self, least: f64) -> Self {
        Method { least, ..self }
    }
}

/// Where a method breaks down.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Break {
    /// Power of ten, bisected to half a decade.
    pub exponent: f64,
    /// What comes of it there.
    pub verdict: Verdict,
}

/// What came of one method.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// The method's name.
    pub name: String,
    /// Digits that its scalar carries.
    pub carried: f64,
    /// A verdict for each magnitude.
    pub verdicts: Vec<Verdict>,
    /// Where it breaks down towards smaller magnitudes.
    pub below: Option<Break>,
    /// Where it breaks down towards larger ones.
    pub above: Option<Break>,
}

impl Sweep {
    /// Exponents or numbers of the cases.
    pub fn points(&self) -> Vec<i32> {
        match *self {
            Sweep::Decades { from, to, step, .. } => (from..=to).step_by(step).collect(),
            Sweep::Cases(names) => (0..names.len() as i32).collect(),
        }
    }

    /// The name of a point.
    pub fn label(&self, point: i32) -> String {
        match self {
            Sweep::Decades { .. } => format!("1e{point}"),
            Sweep::Cases(names) => names[point as usize].into(),
        }
    }

    /// The magnitude of a point, or of one between.
    pub fn magnitude(&self, point: f64) -> f64 {
        match self {
            // A power of ten is read, not computed: correctly rounded on every machine.
            Sweep::Decades { .. } if point.fract() == 0.0 => {
                format!("1e{point}").parse().expect("a number")
            }
            Sweep::Decades { .. } => 10f64.powf(point),
            Sweep::Cases(_) => point,
        }
    }

    /// What comes of `method`.
    pub fn run(&self, method: &Method) -> Column {
        let points = self.points();
        let at = |point: f64| (method.measure)(self.magnitude(point)).at_most(method.carried);
        let verdicts: Vec<Verdict> = points.par_iter().map(|p| at(f64::from(*p))).collect();
        let (below, above) = match *self {
            Sweep::Cases(_) => (None, None),
            Sweep::Decades { start, .. } => {
                let (down, up): (Vec<_>, Vec<_>) =
                    points.iter().zip(&verdicts).partition(|(p, _)| **p < start);
                let inwards = down.into_iter().rev().collect::<Vec<_>>();
                let first = up.first().copied();
                let below = first.into_iter().chain(inwards).collect::<Vec<_>>();
                (breakdown(&below, method, &at), breakdown(&up, method, &at))
            }
        };
        let (name, carried) = (method.name.clone(), method.carried);
        Column { name, carried, verdicts, below, above }
    }
}

/// The first point outwards at which a method breaks down, bisected; nothing where there is none.
fn breakdown(
    outwards: &[(&i32, &Verdict)],
    method: &Method,
    at: &dyn Fn(f64) -> Verdict,
) -> Option<Break> {
    let first = outwards.iter().position(|(_, verdict)| verdict.breaks_down(method.least))?;
    let (point, verdict) = outwards[first];
    let mut broken = Break { exponent: f64::from(*point), verdict: verdict.clone() };
    if first == 0 {
        return Some(broken);
    }
    let mut holds = f64::from(*outwards[first - 1].0);
    while (broken.exponent - holds).abs() > 0.5 {
        let middle = (broken.exponent + holds) / 2.0;
        let verdict = at(middle);
        if verdict.breaks_down(method.least) {
            broken = Break { exponent: middle, verdict };
        } else {
            holds = middle;
        }
    }
    Some(broken)
}
