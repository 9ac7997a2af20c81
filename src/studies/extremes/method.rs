//! A magnitude swept, and where something breaks down.

use rayon::prelude::*;
use serde::Serialize;

use super::blocks::Blocks;
use super::kept::Kept;
use super::search::{Quantity, Search};
use super::{Generator, Made, answer};
use engine::error::Error;
use engine::linear::ScalarName;
use numbers::scalar::F64x2;
use problem::modelling::Variant;

/// Fewer right digits than these, or than half of what the scalar carries, and an engineer is misled.
const LEAST: f64 = 3.0;

/// How a problem is solved: a variant or formulas, and a scalar.
struct Method {
    name: String,
    carried: f64,
    measure: Box<Measure>,
}

/// Solves the problem of a value, and judges the answer.
type Measure = dyn Fn(f64) -> Result<Kept, Error> + Send + Sync;

impl Method {
    /// Whether a verdict counts as broken.
    fn is_broken(&self, verdict: &Kept) -> bool {
        verdict.breaks_down(LEAST.min(self.carried / 2.0))
    }

    fn verdict(&self, value: f64) -> Kept {
        (self.measure)(value).unwrap_or_else(Kept::from).at_most(self.carried)
    }
}

/// The digits that a scalar carries.
fn carried(scalar: ScalarName) -> f64 {
    f64::from(scalar.properties().digits.expect("exact numbers are not tried"))
}

/// Judges a quantity of a search.
type OfSearch = fn(Quantity, Search) -> Result<Kept, Error>;

/// The scalars that are tried, each with how it judges a search: exact numbers are what all are compared
/// with.
fn tried() -> impl Iterator<Item = (ScalarName, OfSearch)> {
    let of = |scalar: &ScalarName| -> Option<(ScalarName, OfSearch)> {
        match scalar {
            ScalarName::F32 => Some((*scalar, Quantity::judge::<f32>)),
            ScalarName::F64 => Some((*scalar, Quantity::judge::<f64>)),
            ScalarName::F64x2 => Some((*scalar, Quantity::judge::<F64x2>)),
            ScalarName::Exact => None,
        }
    };
    ScalarName::ALL.iter().filter_map(of)
}

/// What is tried on blocks: `tied` in each scalar, the others in f64; `stepped` is `tied` in steps.
fn on_blocks(blocks: fn(f64) -> Blocks) -> Vec<Method> {
    let tied = tried().map(|(scalar, _)| (Variant::Tied, scalar));
    let others = Variant::ALL.iter().rev().filter(|variant| match variant {
        Variant::Unilateral | Variant::Printed => true,
        Variant::Tied | Variant::Stepped => false,
    });
    let others = others.map(|variant| (*variant, ScalarName::F64));
    let method = |(variant, scalar): (Variant, ScalarName)| {
        let measure = Box::new(move |x| answer::judge(&blocks(x), variant, scalar));
        Method { name: format!("{variant} {scalar}"), carried: carried(scalar), measure }
    };
    tied.chain(others).map(method).collect()
}

/// What is tried on a search: each quantity in each scalar.
fn on_search(search: fn(f64) -> Search, quantities: &[Quantity]) -> Vec<Method> {
    let method = |(of, (scalar, judge)): (Quantity, (ScalarName, OfSearch))| {
        let measure = Box::new(move |x| judge(of, search(x)));
        Method { name: format!("{} {scalar}", of.name()), carried: carried(scalar), measure }
    };
    let each = quantities.iter().flat_map(|of| tried().map(|scalar| (*of, scalar)));
    each.map(method).collect()
}

/// What the methods made of the scenes of a generator.
#[derive(Clone, Debug, Serialize)]
pub struct SweepTable {
    /// The generator.
    #[serde(flatten)]
    pub generator: &'static Generator,
    /// The magnitudes, powers of ten.
    pub magnitudes: Vec<f64>,
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
    pub verdicts: Vec<Kept>,
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
    pub verdict: Kept,
}

/// A power of ten. A whole one is read, not computed: correctly rounded on every machine.
fn power(exponent: f64) -> f64 {
    match exponent.fract() == 0.0 {
        true => format!("1e{exponent}").parse().expect("a number"),
        false => 10f64.powf(exponent),
    }
}

impl Generator {
    /// Runs all methods on all powers of ten.
    pub(super) fn measure(&'static self) -> SweepTable {
        let (from, to, step) = self.decades;
        let exponents: Vec<f64> = (from..=to).step_by(step).map(f64::from).collect();
        let methods = match self.made {
            Made::Blocks(blocks) => on_blocks(blocks),
            Made::Search(search, quantities) => on_search(search, quantities),
        };
        SweepTable {
            generator: self,
            magnitudes: exponents.iter().map(|e| power(*e)).collect(),
            columns: methods.par_iter().map(|method| column(method, &exponents)).collect(),
        }
    }
}

/// Judges a method at each power of ten, and finds where it breaks down on both sides of 1.
fn column(method: &Method, exponents: &[f64]) -> Column {
    let verdicts: Vec<_> = exponents.par_iter().map(|e| method.verdict(power(*e))).collect();
    let known: Vec<(f64, &Kept)> = exponents.iter().copied().zip(&verdicts).collect();
    let start = exponents.partition_point(|e| *e < 0.0);
    let below = breakdown(known[..=start].iter().rev(), method);
    let above = breakdown(known[start..].iter(), method);
    Column { name: method.name.clone(), carried: method.carried, verdicts, below, above }
}

/// The first of the points outwards at which a method breaks down, bisected towards the point
/// before it; nothing where there is none.
fn breakdown<'a>(
    mut outwards: impl Iterator<Item = &'a (f64, &'a Kept)>,
    method: &Method,
) -> Option<Break> {
    let mut sound = None;
    let broken = outwards.find(|(exponent, verdict)| {
        let broken = method.is_broken(verdict);
        sound = if broken { sound } else { Some(*exponent) };
        broken
    })?;
    let mut broken = Break { exponent: broken.0, verdict: broken.1.clone() };
    while let Some(inner) = sound.filter(|inner| (broken.exponent - inner).abs() > 0.5) {
        let exponent = (broken.exponent + inner) / 2.0;
        let verdict = method.verdict(power(exponent));
        if method.is_broken(&verdict) {
            broken = Break { exponent, verdict };
        } else {
            sound = Some(exponent);
        }
    }
    Some(broken)
}
