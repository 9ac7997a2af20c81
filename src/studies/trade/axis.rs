//! What is varied, and the trials of each axis.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::{Serialize, Serializer};

use super::trial::{Trial, most_exact};
use base::choices;
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
    /// The equilibrium on the same mesh. Who is in contact must not rest on rounding then.
    Equilibrium,
    /// The last trial that ran, in words.
    Last(&'static str),
    /// The finest mesh that ran; the order of convergence is fitted.
    Finest,
    /// The trial of the same variant where the scene has the axis.
    Whole,
}

impl Truth {
    /// What errors are measured against, in words.
    pub fn words(self) -> &'static str {
        match self {
            Truth::Equilibrium => {
                "the equilibrium under the scene's own friction on the same mesh (unilateral, mortar)"
            }
            Truth::Last(words) => words,
            Truth::Finest => {
                "the reference solution on the finest mesh that ran, whose outline is the polygon of the \
                 scene's own"
            }
            Truth::Whole => "the whole scene under the same variant",
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
            use ScalarName::{Bounded, Exact, F32, F64, F64x2};
            let mut tried =
                vec![("f32", F32), ("f64", F64), ("f64 with a bound", Bounded), ("f64x2", F64x2)];
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
            let mut values = TOLERANCES.to_vec();
            if !values.contains(&own) {
                values.push(own);
                values.sort_by(f64::total_cmp);
            }
            let values = values.into_iter().map(|c| (format!("{c:e}"), c));
            Ok(turned(request, &CARRYING[..2], values, own, |trial, c| trial.tolerance = Some(c)))
        },
    },
    Axis {
        name: "iterations",
        meaning: "the number of iterations, or of steps",
        truth: Truth::Equilibrium,
        trials: |request| {
            let own = request.iterations;
            let mut values = ITERATIONS.to_vec();
            // One more shows what a cycle of two does.
            values.extend([own, own + 1]);
            values.sort_unstable();
            values.dedup();
            let values = values.into_iter().map(|n| (n.to_string(), n));
            Ok(turned(request, &CARRYING[..2], values, own, |trial, n| trial.iterations = n))
        },
    },
    Axis {
        name: "status",
        meaning: "the rule that decides who is in contact",
        truth: Truth::Equilibrium,
        trials: |request| {
            let values = StatusRule::ALL.iter().map(|rule| (rule.to_string(), *rule));
            let own = request.contact.status;
            Ok(turned(request, &CARRYING[..2], values, own, |trial, rule| {
                trial.contact.status = rule;
            }))
        },
    },
    Axis {
        name: "coupling",
        meaning: "how a contact node is bound",
        truth: Truth::Equilibrium,
        trials: |request| {
            let values = Coupling::ALL.iter().map(|coupling| (coupling.to_string(), *coupling));
            let own = request.contact.coupling;
            Ok(turned(request, &CARRYING, values, own, |trial, coupling| {
                trial.contact.coupling = coupling;
            }))
        },
    },
    Axis {
        name: "symmetry",
        meaning: "half of a symmetric scene",
        truth: Truth::Whole,
        trials: |request| Ok(halves(request)),
    },
];

impl Axis {
    /// A trial for each of its values under each variant that is tried; none where the scene does not have it.
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
        AXES.each_ref().map(|axis| format!("{axis}: {}", axis.meaning)).join("; ")
    }
}

impl FromStr for &'static Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        choices::named(text, &AXES, |axis| axis.name)
    }
}

impl Display for Axis {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl Serialize for Axis {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
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

/// A trial for each value, with its name, under each of the variants, which have it; `own` is the request's value.
fn turned<T: Copy + PartialEq>(
    request: &Request,
    variants: &[Variant],
    values: impl Iterator<Item = (String, T)> + Clone,
    own: T,
    set: fn(&mut Request, T),
) -> Vec<Trial> {
    let trial = |variant: Variant, (label, value): (String, T)| {
        let mut request = under(request, variant);
        set(&mut request, value);
        Trial { label, request, own: value == own, mesh: None }
    };
    let each = variants.iter().map(|variant| (*variant, values.clone()));
    each.flat_map(|(variant, values)| values.map(move |value| trial(variant, value))).collect()
}

/// The reference solution, which has no path of the load to follow, on the scene's mesh and on finer ones.
fn meshes(request: &Request) -> Result<Vec<Trial>, InputError> {
    let equations = |times: usize| request.scene.model.dofs() << (2 * times);
    let (label, request) = (String::from("h / 1"), request.reference());
    let mut trials = vec![Trial { label, request, own: true, mesh: None }];
    for times in (1..MESHES).take_while(|times| equations(*times) <= EQUATIONS) {
        let coarser = &trials[times - 1].request;
        let Some(mesh) = coarser.scene.refined()? else { break };
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
