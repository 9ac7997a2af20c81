//! A magnitude swept, and where something breaks down.

use rayon::prelude::*;
use serde::Serialize;

use super::blocks::Blocks;
use super::search::{Quantity, Search};
use super::verdict::Verdict;
use super::{Generator, Known, Made, Values, answer};
use engine::error::Error;
use numbers::scalar::F64x2;
use numbers::solve::ScalarName;
use problem::modelling::Variant;

/// Fewer right digits than these, or than half of what the scalar carries, and an engineer is misled.
const LEAST: f64 = 3.0;

/// How a problem is solved: a variant or formulas, and a scalar.
struct Method {
    name: String,
    carried: f64,
    /// Fewer digits than these count as broken.
    least: f64,
    measure: Box<Measure>,
}

/// Solves the problem of a value, and judges the answer.
type Measure = dyn Fn(f64) -> Result<Verdict, Error> + Send + Sync;

impl Method {
    fn new(
        name: String,
        scalar: ScalarName,
        measure: impl Fn(f64) -> Result<Verdict, Error> + Send + Sync + 'static,
    ) -> Self {
        // An exact answer is compared as an f64.
        let carried = f64::from(scalar.properties().digits.unwrap_or(16));
        Method { name, carried, least: LEAST.min(carried / 2.0), measure: Box::new(measure) }
    }

    fn verdict(&self, value: f64) -> Verdict {
        (self.measure)(value).unwrap_or_else(Verdict::from).at_most(self.carried)
    }
}

/// Whether methods are tried in a scalar: those that keep a bound compute as those that they bound, and exact
/// numbers are what all are compared with.
fn is_tried(scalar: ScalarName) -> bool {
    match scalar {
        ScalarName::F32 | ScalarName::F64 | ScalarName::F64x2 => true,
        ScalarName::Bounded | ScalarName::BoundedDouble | ScalarName::Exact => false,
    }
}

/// What is tried on blocks: `tied` in each scalar, the others in f64.
fn on_blocks(blocks: fn(f64) -> Blocks) -> Vec<Method> {
    let tied = tried().map(|scalar| (Variant::Tied, scalar));
    let others = [Variant::Unilateral, Variant::Printed].map(|v| (v, ScalarName::F64));
    let method = |(variant, scalar): (Variant, ScalarName)| {
        let measure = move |x| answer::judge(&blocks(x), variant, scalar);
        Method::new(format!("{variant} {scalar}"), scalar, measure)
    };
    tied.chain(others).map(method).collect()
}

/// The blocks' Poisson's ratio on an annulus, which locks long before the arithmetic breaks down.
fn by_lame(blocks: fn(f64) -> Blocks) -> Vec<Method> {
    let method = |radial| {
        let name = format!("f64, {radial} x {} mesh against Lame", 2 * radial);
        let measure = move |x| answer::judge_by_lame(blocks(x).nu, radial);
        Method { least: 1.0, ..Method::new(name, ScalarName::F64, measure) }
    };
    [4, 16].map(method).into()
}

/// What is tried on a search: each quantity in each scalar.
fn on_search(search: fn(f64) -> Search, quantities: &[Quantity]) -> Vec<Method> {
    let method = |(of, scalar): (Quantity, ScalarName)| {
        Method::new(format!("{} {scalar}", of.name()), scalar, move |x| match scalar {
            ScalarName::F32 => of.judge::<f32>(search(x)),
            ScalarName::F64 => of.judge::<f64>(search(x)),
            ScalarName::F64x2 => of.judge::<F64x2>(search(x)),
            ScalarName::Bounded | ScalarName::BoundedDouble | ScalarName::Exact => {
                unreachable!("it is not tried")
            }
        })
    };
    let each = quantities.iter().flat_map(|of| tried().map(|scalar| (*of, scalar)));
    each.map(method).collect()
}

fn tried() -> impl Iterator<Item = ScalarName> {
    ScalarName::ALL.iter().copied().filter(|scalar| is_tried(*scalar))
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
    fn methods(&self) -> Vec<Method> {
        let of = |known: &Known| match (known, self.made) {
            (Known::Exact, Made::Blocks(blocks)) => on_blocks(blocks),
            (Known::Exact, Made::Search(search, of)) => on_search(search, of),
            (Known::Lame, Made::Blocks(blocks)) => by_lame(blocks),
            (Known::Lame, Made::Search(..)) => Vec::new(),
        };
        self.known.iter().flat_map(of).collect()
    }

    /// Runs all methods on all values.
    pub(super) fn measure(&self) -> SweepTable {
        let Generator { name, title, magnitude, ref values, .. } = *self;
        let points = values.points();
        let logarithmic = matches!(values, Values::Decades { .. });
        let of = |p: &i32| values.value(f64::from(*p)) + if logarithmic { 0.0 } else { 1.0 };
        let column = |method: &Method| {
            let at = |p: &i32| method.verdict(values.value(f64::from(*p)));
            values.column(method, points.par_iter().map(at).collect())
        };
        SweepTable {
            name,
            title,
            magnitude,
            labels: points.iter().map(|p| values.label(*p)).collect(),
            magnitudes: points.iter().map(of).collect(),
            logarithmic,
            columns: self.methods().par_iter().map(column).collect(),
        }
    }
}

impl Values {
    fn points(&self) -> Vec<i32> {
        match *self {
            Values::Decades { from, to, step } => (from..=to).step_by(step).collect(),
            Values::Cases(names) => (0..names.len() as i32).collect(),
        }
    }

    fn label(&self, point: i32) -> String {
        match self {
            Values::Decades { .. } => format!("1e{point}"),
            Values::Cases(names) => names[point as usize].into(),
        }
    }

    fn value(&self, point: f64) -> f64 {
        match self {
            // A power of ten is read, not computed: correctly rounded on every machine.
            Values::Decades { .. } if point.fract() == 0.0 => {
                format!("1e{point}").parse().expect("a number")
            }
            Values::Decades { .. } => 10f64.powf(point),
            Values::Cases(_) => point,
        }
    }

    /// Finds where a method breaks down that was judged at each point.
    fn column(&self, method: &Method, verdicts: Vec<Verdict>) -> Column {
        let points = self.points();
        let at = |point: f64| method.verdict(self.value(point));
        let (below, above) = match self {
            Values::Cases(_) => (None, None),
            Values::Decades { .. } => {
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
