//! A magnitude swept, and where something breaks down.

use dashu_ratio::RBig;
use rayon::prelude::*;
use serde::Serialize;

use super::Generator;
use super::blocks::Blocks;
use super::kept::Kept;
use engine::error::Error;
use engine::linear::{Arithmetic, ScalarName};
use engine::{Request, Solution, solve};
use problem::model::Body;
use problem::modelling::Variant;

/// Fewer right digits than these, or than half of what the scalar carries, and an engineer is misled.
const LEAST: f64 = 3.0;

/// How blocks are solved.
#[derive(Clone, Copy)]
struct Method {
    variant: Variant,
    scalar: ScalarName,
}

/// What is tried: `tied` in each scalar, the others in f64; `stepped` is `tied` in steps. Exact numbers are
/// what all are compared with.
const METHODS: [Method; 5] = [
    Method { variant: Variant::Tied, scalar: ScalarName::F64 },
    Method { variant: Variant::Tied, scalar: ScalarName::F32 },
    Method { variant: Variant::Tied, scalar: ScalarName::F64x2 },
    Method { variant: Variant::Unilateral, scalar: ScalarName::F64 },
    Method { variant: Variant::Printed, scalar: ScalarName::F64 },
];

impl Method {
    /// The digits that its scalar carries.
    fn carried(self) -> f64 {
        f64::from(self.scalar.properties().digits.expect("exact numbers are not tried"))
    }

    /// Whether a verdict counts as broken.
    fn is_broken(self, verdict: &Kept) -> bool {
        verdict.breaks_down(LEAST.min(self.carried() / 2.0))
    }

    /// Solves blocks, and compares with exact numbers: another contact state is wrong. `unilateral` has no
    /// exact run and is compared with `tied`, which is its answer where nothing opens.
    fn judge(self, blocks: &Blocks) -> Result<Kept, Error> {
        let scene = blocks.scene(self.variant).build()?;
        let solved = |variant, scalar| {
            let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
            solve(&Request::new(&scene).variant(variant).arithmetic(arithmetic), &mut |_| ())
        };
        let answer: Solution = solved(self.variant, self.scalar)?;
        let is_unilateral = self.variant == Variant::Unilateral;
        let known = if is_unilateral { Variant::Tied } else { self.variant };
        Ok(match Error::found(solved(known, ScalarName::Exact))? {
            Some(exact) if answer.last().statuses() == exact.last().statuses() => {
                let (found, known) = (answer.exact_displacements(), exact.exact_displacements());
                let errors = exact.model.bodies.iter().map(|body| error(body, &found, &known));
                Kept::of_error(errors.fold(0.0, f64::max))
            }
            Some(_) if is_unilateral => Kept::Unknown,
            Some(_) => Kept::Wrong("contact"),
            None => Kept::Wrong("exact refuses"),
        })
    }
}

/// The largest error of a body's displacements over its largest displacement; infinite where the exact one is
/// 0 and this is not.
fn error(body: &Body, found: &[RBig], exact: &[RBig]) -> f64 {
    let dofs = || body.nodes.iter().flat_map(|node| node.dofs()).map(|dof| dof.index());
    let abs = |x: RBig| if x < RBig::ZERO { -x } else { x };
    let error = dofs().map(|e| abs(&found[e] - &exact[e])).max().unwrap_or_default();
    let size = dofs().map(|e| abs(exact[e].clone())).max().unwrap_or_default();
    if error.is_zero() {
        0.0
    } else if size.is_zero() {
        f64::INFINITY
    } else {
        (error / size).to_f64().value()
    }
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
    /// The method's name: variant and scalar.
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
        SweepTable {
            generator: self,
            magnitudes: exponents.iter().map(|e| power(*e)).collect(),
            columns: METHODS.par_iter().map(|method| self.column(*method, &exponents)).collect(),
        }
    }

    /// Judges a method at each power of ten, and finds where it breaks down on both sides of 1.
    fn column(&self, method: Method, exponents: &[f64]) -> Column {
        let verdicts: Vec<_> = exponents.par_iter().map(|e| self.verdict(method, *e)).collect();
        let known: Vec<(f64, &Kept)> = exponents.iter().copied().zip(&verdicts).collect();
        let start = exponents.partition_point(|e| *e < 0.0);
        let below = self.breakdown(known[..=start].iter().rev(), method);
        let above = self.breakdown(known[start..].iter(), method);
        let name = format!("{} {}", method.variant, method.scalar);
        Column { name, carried: method.carried(), verdicts, below, above }
    }

    fn verdict(&self, method: Method, exponent: f64) -> Kept {
        let judged = method.judge(&(self.blocks)(power(exponent)));
        judged.unwrap_or_else(Kept::from).at_most(method.carried())
    }

    /// The first of the points outwards at which a method breaks down, bisected towards the point
    /// before it; nothing where there is none.
    fn breakdown<'a>(
        &self,
        mut outwards: impl Iterator<Item = &'a (f64, &'a Kept)>,
        method: Method,
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
            let verdict = self.verdict(method, exponent);
            if method.is_broken(&verdict) {
                broken = Break { exponent, verdict };
            } else {
                sound = Some(exponent);
            }
        }
        Some(broken)
    }
}
