//! What is tried of each parameter.

use super::Varied;
use base::error::InputError;
use engine::Request;
use engine::linear::{Arithmetic, ScalarName, Solver, cost};
use problem::modelling::{Coupling, StatusRule, Variant};
use problem::scene::{Scene, symmetry};

/// Free equations beyond which exact numbers are left out: 20 iterations of so many take 13 s.
const EXACT: usize = 100;
/// Degrees of freedom beyond which no finer mesh is tried.
const EQUATIONS: usize = 150_000;
/// How many meshes are tried at most.
const MESHES: usize = 5;
/// The tolerances of the contact search that are tried, in the scene's unit of length.
const TOLERANCES: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// The numbers of iterations that are tried, beside the scene's own.
const ITERATIONS: [usize; 9] = [1, 2, 5, 10, 20, 40, 80, 160, 320];
/// The variants that carry load across; the last one is not the paper's.
pub(super) const CARRYING: [Variant; 3] = [Variant::Tied, Variant::Stepped, Variant::Unilateral];

/// How a trial's request differs from the one whose parameters are turned, beside variant and
/// arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// Its request does not differ.
    Own,
    /// Another tolerance of the contact search, length.
    Tolerance(f64),
    Iterations(usize),
    Status(StatusRule),
    Coupling(Coupling),
    /// The reference solution of the scene with its mesh refined so many times.
    Refined(usize),
    Half,
}

/// What a trial's error is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorReference {
    Reference,
    Trial(usize),
}

/// A run with one parameter changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The parameter.
    pub parameter: Varied,
    /// Its value in words.
    pub label: String,
    /// The variant that runs.
    pub variant: Variant,
    /// The numbers in which it runs, and the solver.
    pub arithmetic: Arithmetic,
    /// What else is changed.
    pub setting: Setting,
    /// What its error is measured against.
    pub against: ErrorReference,
    /// Whether this is where the scene has the parameter.
    pub own: bool,
}

impl Trial {
    /// `variant` as the request has it, in the quickest arithmetic that rounds as little as Mathcad
    /// does, against the reference solution.
    fn new(parameter: Varied, label: impl Into<String>, variant: Variant) -> Self {
        Trial {
            parameter,
            label: label.into(),
            variant,
            arithmetic: sparse(ScalarName::F64),
            setting: Setting::Own,
            against: ErrorReference::Reference,
            own: false,
        }
    }

    /// What it asks for, where everything but the parameter is as `request` has it.
    ///
    /// # Errors
    /// The scene cannot be refined or halved.
    pub fn request(&self, request: &Request) -> Result<Request, InputError> {
        let mut request = request.clone().variant(self.variant).arithmetic(self.arithmetic);
        match self.setting {
            Setting::Own => (),
            Setting::Tolerance(tolerance) => request.tolerance = Some(tolerance),
            Setting::Iterations(iterations) => request.iterations = iterations,
            Setting::Status(rule) => request.contact.status = rule,
            Setting::Coupling(coupling) => request.contact.coupling = coupling,
            Setting::Refined(times) => {
                for _ in 0..times {
                    let refined = request.scene.refined()?.ok_or_else(|| {
                        let what = "half a scene cannot be refined";
                        InputError::new("the scene", what, "refine the whole scene")
                    })?;
                    request.scene = refined.scene;
                }
                request = request.reference();
            }
            Setting::Half => {
                let half = symmetry::half(&request.scene).ok_or_else(|| {
                    let what = "the scene is not symmetric about a vertical line";
                    InputError::new("the scene", what, "run the whole scene")
                })?;
                request.scene = half.scene;
            }
        }
        Ok(request)
    }
}

/// Everything to measure of a parameter of `request`; nothing where its scene does not have the parameter.
pub fn trials(request: &Request, parameter: Varied) -> Vec<Trial> {
    let contact = request.scene.model.target().is_some();
    if !contact && judges(parameter) {
        return Vec::new();
    }
    match parameter {
        Varied::Arithmetic => {
            use ScalarName::{Bounded, Exact, F32, F64, F64x2};
            let mut tried = vec![
                ("f32", sparse(F32)),
                ("f64", sparse(F64)),
                ("f64 with a bound", sparse(Bounded)),
                ("f64x2", sparse(F64x2)),
            ];
            if request.scene.model.free_dofs() <= most_exact(request) {
                tried.push(("exact", sparse(Exact)));
            }
            against_the_last(parameter, request, &tried)
        }
        Varied::Solver => {
            let tried = [
                ("dense-lu", by(ScalarName::F64, Solver::DenseLu)),
                ("sparse-lu", by(ScalarName::F64, Solver::SparseLu)),
                ("sparse-cholesky", sparse(ScalarName::F64)),
                ("f64x2 to compare", sparse(ScalarName::F64x2)),
            ];
            against_the_last(parameter, request, &tried)
        }
        Varied::Mesh => meshes(&request.scene),
        Varied::Symmetry => halves(request, contact),
        Varied::Tolerance => {
            let own = request.tolerance.unwrap_or(request.scene.model.contact.tolerance);
            let place = |c: f64| (format!("{c:e}"), Setting::Tolerance(c));
            let mut values = TOLERANCES.to_vec();
            if !values.contains(&own) {
                values.push(own);
                values.sort_by(f64::total_cmp);
            }
            turned(parameter, &CARRYING[..2], &values, own, place)
        }
        Varied::Iterations => {
            let place = |n: usize| (n.to_string(), Setting::Iterations(n));
            let own = request.iterations;
            let mut values = ITERATIONS.to_vec();
            // One more shows what a cycle of two does.
            values.extend([own, own + 1]);
            values.sort_unstable();
            values.dedup();
            turned(parameter, &CARRYING[..2], &values, own, place)
        }
        Varied::Status => {
            let place = |rule: StatusRule| (rule.to_string(), Setting::Status(rule));
            turned(parameter, &CARRYING[..2], StatusRule::ALL, request.contact.status, place)
        }
        Varied::Coupling => {
            let place = |c: Coupling| (c.to_string(), Setting::Coupling(c));
            turned(parameter, &CARRYING, Coupling::ALL, request.contact.coupling, place)
        }
    }
}

/// Whether a parameter is one of the paper's, which needs contact, and whose verdict must not rest on
/// rounding.
pub(super) fn judges(parameter: Varied) -> bool {
    match parameter {
        Varied::Tolerance | Varied::Iterations | Varied::Status | Varied::Coupling => true,
        Varied::Arithmetic | Varied::Solver | Varied::Mesh | Varied::Symmetry => false,
    }
}

/// A parameter at each of `values` under each of `variants`, which have it; the scene has the parameter at
/// `own`.
fn turned<T: Copy + PartialEq>(
    parameter: Varied,
    variants: &[Variant],
    values: &[T],
    own: T,
    place: impl Fn(T) -> (String, Setting),
) -> Vec<Trial> {
    let trial = |(variant, value): (&Variant, &T)| {
        let (label, setting) = place(*value);
        Trial { setting, own: *value == own, ..Trial::new(parameter, label, *variant) }
    };
    let each = variants.iter().flat_map(|variant| values.iter().map(move |value| (variant, value)));
    each.map(trial).collect()
}

/// Numbers of type `scalar`, solved by sparse Cholesky.
pub(super) fn sparse(scalar: ScalarName) -> Arithmetic {
    by(scalar, Solver::SparseCholesky)
}

pub(super) fn by(scalar: ScalarName, solver: Solver) -> Arithmetic {
    Arithmetic { scalar, solver: Some(solver), ..Arithmetic::default() }
}

/// The variant on which arithmetics are measured: that of the request; `unilateral` has one
/// arithmetic only.
fn measured_variant(request: &Request) -> Variant {
    if request.variant == Variant::Unilateral { Variant::Stepped } else { request.variant }
}

/// The free equations up to which exact numbers are tried.
pub(super) fn most_exact(request: &Request) -> usize {
    let growing = request.reading.r5.follows_the_shape();
    cost::most_equations(growing, request.iterations).min(EXACT)
}

fn against_the_last(
    parameter: Varied,
    request: &Request,
    arithmetics: &[(&str, Arithmetic)],
) -> Vec<Trial> {
    let against = ErrorReference::Trial(arithmetics.len() - 1);
    let trial = |(label, arithmetic): &(&str, Arithmetic)| Trial {
        arithmetic: *arithmetic,
        against,
        ..Trial::new(parameter, *label, measured_variant(request))
    };
    arithmetics.iter().map(trial).collect()
}

/// Meshes, each with its reference solution, which has no path of the load to follow.
fn meshes(scene: &Scene) -> Vec<Trial> {
    let equations = |times: usize| scene.model.dofs() << (2 * times);
    let count = (1..MESHES).take_while(|times| equations(*times) <= EQUATIONS).count() + 1;
    let trial = |times: usize| Trial {
        setting: Setting::Refined(times),
        against: ErrorReference::Trial(count - 1),
        own: times == 0,
        ..Trial::new(Varied::Mesh, format!("h / {}", 1 << times), Variant::Unilateral)
    };
    (0..count).map(trial).collect()
}

/// The whole scene, then its half, under each variant.
fn halves(request: &Request, contact: bool) -> Vec<Trial> {
    if symmetry::half(&request.scene).is_none() {
        return Vec::new();
    }
    let own = [measured_variant(request)];
    let variants: &[Variant] = if contact { &CARRYING } else { &own };
    let trial = |(k, variant): (usize, &Variant)| {
        let against = ErrorReference::Trial(2 * k);
        let whole = Trial { against, own: true, ..Trial::new(Varied::Symmetry, "whole", *variant) };
        let half =
            Trial { setting: Setting::Half, own: false, label: "half".into(), ..whole.clone() };
        [whole, half]
    };
    variants.iter().enumerate().flat_map(trial).collect()
}
