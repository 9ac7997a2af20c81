//! What is varied, and the trials of each axis.

use super::trial::{Trial, most_exact};
use base::error::InputError;
use engine::Request;
use engine::linear::{Arithmetic, ScalarName, Solver};
use problem::modelling::{Coupling, StatusRule, Variant};
use problem::scene::symmetry;

/// Degrees of freedom beyond which no finer mesh is tried.
const EQUATIONS: usize = 150_000;
/// How many meshes are tried at most.
const MESHES: usize = 5;
/// The tolerances of the contact search that are tried, in the scene's unit of length.
const TOLERANCES: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// The numbers of iterations that are tried, beside the scene's own.
const ITERATIONS: [usize; 9] = [1, 2, 5, 10, 20, 40, 80, 160, 320];
/// The variants that carry load across; the last one is not the paper's.
const CARRYING: [Variant; 3] = [Variant::Tied, Variant::Stepped, Variant::Unilateral];

/// Something of a run that takes several values, one after another, while all else stays: a row of [`AXES`].
#[derive(Debug)]
pub struct Axis {
    /// Its name, on the command line and in files.
    pub name: &'static str,
    /// What it is, as a part of a sentence.
    pub meaning: &'static str,
    /// What errors are measured against.
    pub truth: Truth,
    /// A trial for each of its values; none where the scene of the request does not have it.
    trials: fn(&Request) -> Result<Vec<Trial>, InputError>,
}

/// What the errors of an axis are measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// The equilibrium on the same mesh. Where the last digit decides who is in contact, a row says so.
    Equilibrium,
    /// The last trial that ran, in words.
    Last(&'static str),
    /// The finest mesh that ran; the order of convergence is fitted.
    Finest,
    /// The trial of the same variant that has what the scene has, in words.
    Own(&'static str),
}

impl Truth {
    /// What errors are measured against, in words.
    pub fn words(self) -> &'static str {
        match self {
            Truth::Equilibrium => {
                "the equilibrium under the scene's own friction on the same mesh (unilateral, mortar)"
            }
            Truth::Last(words) | Truth::Own(words) => words,
            Truth::Finest => {
                "the reference solution on the finest mesh that ran, whose outline is the polygon of the \
                 scene's own"
            }
        }
    }
}

/// Everything that is varied, in the order of the tables.
pub static AXES: [Axis; 8] = [
    Axis {
        name: "arithmetic",
        meaning: "the number type in which a run computes",
        truth: Truth::Last("the last row that ran"),
        trials: |request| {
            use ScalarName::{Exact, F32, F64, F64x2};
            let mut tried = vec![("f32", F32), ("f64", F64), ("f64x2", F64x2)];
            if request.scene.model.free_dofs() <= most_exact(request) {
                tried.push(("exact", Exact));
            }
            let by_cholesky = |(label, scalar)| (label, Solver::SparseCholesky, scalar);
            Ok(computed(request, tried.into_iter().map(by_cholesky)))
        },
    },
    Axis {
        name: "solver",
        meaning: "how the equations are solved",
        truth: Truth::Last("f64x2"),
        trials: |request| {
            let tried = [
                ("dense-lu", Solver::DenseLu, ScalarName::F64),
                ("sparse-lu", Solver::SparseLu, ScalarName::F64),
                ("sparse-cholesky", Solver::SparseCholesky, ScalarName::F64),
                ("f64x2 to compare", Solver::SparseCholesky, ScalarName::F64x2),
            ];
            Ok(computed(request, tried))
        },
    },
    Axis {
        name: "mesh",
        meaning: "the element size: each triangle divided into four, the outline kept",
        truth: Truth::Finest,
        trials: meshes,
    },
    Axis {
        name: "c_tll",
        meaning: "the tolerance of the contact search",
        truth: Truth::Equilibrium,
        trials: |request| {
            let own = request.tolerance.unwrap_or(request.scene.model.contact.tolerance);
            let (values, label) = (ordered(&TOLERANCES, &[own]), |c: &f64| format!("{c:e}"));
            let set = |trial: &mut Request, c| trial.tolerance = Some(c);
            Ok(turned(request, &CARRYING[..2], &values, own, label, set))
        },
    },
    Axis {
        name: "iterations",
        meaning: "the number of iterations, or of steps",
        truth: Truth::Equilibrium,
        trials: |request| {
            let own = request.iterations;
            // One more shows what a cycle of two does.
            let values = ordered(&ITERATIONS, &[own, own + 1]);
            let set = |trial: &mut Request, n| trial.iterations = n;
            Ok(turned(request, &CARRYING[..2], &values, own, usize::to_string, set))
        },
    },
    Axis {
        name: "status",
        meaning: "the rule that decides who is in contact",
        truth: Truth::Equilibrium,
        trials: |request| {
            let (values, own) = (StatusRule::ALL, request.contact.status);
            let set = |trial: &mut Request, rule| trial.contact.status = rule;
            Ok(turned(request, &CARRYING[..2], values, own, StatusRule::to_string, set))
        },
    },
    Axis {
        name: "coupling",
        meaning: "how a contact node is bound",
        truth: Truth::Equilibrium,
        trials: |request| {
            let (values, own) = (Coupling::ALL, request.contact.coupling);
            let set = |trial: &mut Request, coupling| trial.contact.coupling = coupling;
            Ok(turned(request, &CARRYING, values, own, Coupling::to_string, set))
        },
    },
    Axis {
        name: "symmetry",
        meaning: "half of a symmetric scene",
        truth: Truth::Own("the whole scene under the same variant"),
        trials: |request| Ok(halves(request)),
    },
];

impl Axis {
    /// A trial for each of its values under each variant that is tried; none where the scene does not have
    /// it.
    ///
    /// # Errors
    /// The scene cannot be refined.
    pub fn trials(&self, request: &Request) -> Result<Vec<Trial>, InputError> {
        let needs_contact = self.truth == Truth::Equilibrium;
        match needs_contact && request.scene.model.target().is_none() {
            true => Ok(Vec::new()),
            false => (self.trials)(request),
        }
    }

    /// Each name with what it means, for help.
    pub fn help() -> String {
        AXES.each_ref().map(|axis| format!("{}: {}", axis.name, axis.meaning)).join("; ")
    }
}

/// The variant on which arithmetics are measured: that of the request; `unilateral` has one arithmetic only.
fn measured_variant(request: &Request) -> Variant {
    if request.variant == Variant::Unilateral { Variant::Stepped } else { request.variant }
}

/// What is asked for under a variant, in the quickest arithmetic that rounds as little as Mathcad does.
fn under(request: &Request, variant: Variant) -> Request {
    let arithmetic = Arithmetic { solver: Some(Solver::SparseCholesky), ..Arithmetic::default() };
    request.clone().variant(variant).arithmetic(arithmetic)
}

/// A trial for each solver and scalar, by its name.
fn computed(
    request: &Request,
    tried: impl IntoIterator<Item = (&'static str, Solver, ScalarName)>,
) -> Vec<Trial> {
    let trial = |(label, solver, scalar)| {
        let arithmetic = Arithmetic { scalar, solver: Some(solver), ..Arithmetic::default() };
        let request = request.clone().variant(measured_variant(request)).arithmetic(arithmetic);
        Trial { label: String::from(label), request, own: false, mesh: None }
    };
    tried.into_iter().map(trial).collect()
}

/// Values in ascending order, each once, with others among them.
fn ordered<T: Copy + PartialOrd>(values: &[T], others: &[T]) -> Vec<T> {
    let mut values = [values, others].concat();
    values.sort_by(|a, b| a.partial_cmp(b).expect("no value is NaN"));
    values.dedup();
    values
}

/// A trial for each value under each of the variants, which have it; `own` is the value of the request.
fn turned<T: Copy + PartialEq>(
    request: &Request,
    variants: &[Variant],
    values: &[T],
    own: T,
    label: fn(&T) -> String,
    set: fn(&mut Request, T),
) -> Vec<Trial> {
    let trial = |(variant, value): (&Variant, &T)| {
        let mut request = under(request, *variant);
        set(&mut request, *value);
        Trial { label: label(value), request, own: *value == own, mesh: None }
    };
    let each = variants.iter().flat_map(|variant| values.iter().map(move |value| (variant, value)));
    each.map(trial).collect()
}

/// The reference solution, which has no path of the load to follow, on the scene's mesh and on finer ones.
fn meshes(request: &Request) -> Result<Vec<Trial>, InputError> {
    let equations = |times: usize| request.scene.model.dofs() << (2 * times);
    let (label, request) = (String::from("h / 1"), request.reference());
    let mut trials = vec![Trial { label, request, own: true, mesh: None }];
    for times in (1..MESHES).take_while(|times| equations(*times) <= EQUATIONS) {
        let coarser = &trials[times - 1].request;
        let mesh = coarser.scene.refined()?;
        trials.push(Trial {
            label: format!("h / {}", 1 << times),
            request: Request { scene: mesh.scene.clone(), ..coarser.clone() },
            own: false,
            mesh: Some((times - 1, mesh)),
        });
    }
    Ok(trials)
}

/// The whole scene, then its half, under each variant.
fn halves(request: &Request) -> Vec<Trial> {
    let Some(half) = symmetry::half(&request.scene) else { return Vec::new() };
    let own = [measured_variant(request)];
    let has_contact = request.scene.model.target().is_some();
    let variants: &[Variant] = if has_contact { &CARRYING } else { &own };
    let trials = |(k, variant): (usize, &Variant)| {
        let request = under(request, *variant);
        let of_half = Request { scene: half.scene.clone(), ..request.clone() };
        let mesh = Some((2 * k, half.clone()));
        [
            Trial { label: "whole".into(), request, own: true, mesh: None },
            Trial { label: "half".into(), request: of_half, own: false, mesh },
        ]
    };
    variants.iter().enumerate().flat_map(trials).collect()
}
