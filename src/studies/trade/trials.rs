//! What is tried of each knob.

use super::Knob;
use crate::error::InputError;
use crate::numbers::solve::{Arithmetic, ScalarName, Solver, cost};
use crate::paper::mirror::{NodeTable, Reading};
use crate::problem::modelling::{Coupling, StatusRule, Variant};
use crate::problem::scene::{Scene, symmetry};

/// Seconds beyond which exact numbers are left out.
const EXACT: f64 = 10.0;

/// Equations beyond which no finer mesh is tried, and meshes that are tried at most.
const EQUATIONS: usize = 150_000;
const MESHES: usize = 5;

/// The tolerances, in the scene's unit of length.
const TOLERANCES: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

/// The numbers of iterations.
const ITERATIONS: [usize; 9] = [1, 2, 5, 10, 20, 40, 80, 160, 320];

/// The variants whose knobs are turned.
const TURNED: [Variant; 2] = [Variant::Tied, Variant::Stepped];

/// How a trial's scene differs from the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// Not at all.
    Own,
    /// `c_tll`, length.
    Tolerance(f64),
    /// The number of iterations.
    Iterations(usize),
    /// The status rule.
    Status(StatusRule),
    /// The coupling.
    Coupling(Coupling),
    /// Its mesh, refined so many times.
    Refined(usize),
    /// Half of it.
    Half,
}

/// What a trial's error is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The converged answer on the same mesh.
    Converged,
    /// Another trial of the same knob, by place.
    Trial(usize),
}

/// Something to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The knob that is turned.
    pub knob: Knob,
    /// Where it stands.
    pub rung: String,
    /// What is run.
    pub variant: Variant,
    /// In which numbers, by which solver.
    pub arithmetic: Arithmetic,
    /// On what.
    pub setting: Setting,
    /// What its error is measured against.
    pub against: Against,
    /// Whether this is where the scene has the knob.
    pub own: bool,
}

impl Trial {
    /// The scene that it runs on.
    ///
    /// # Errors
    /// A scene that cannot be refined or halved.
    pub fn scene(&self, scene: &Scene) -> Result<Scene, InputError> {
        let mut scene = scene.clone();
        match self.setting {
            Setting::Own => (),
            Setting::Tolerance(c_tll) => scene.set_c_tll(c_tll),
            Setting::Iterations(iterations) => scene.iterations = iterations,
            Setting::Status(rule) => scene.contact.status = rule,
            Setting::Coupling(coupling) => scene.contact.coupling = coupling,
            Setting::Refined(times) => {
                for _ in 0..times {
                    scene = scene.refined()?.ok_or_else(no_mesh)?.scene;
                }
            }
            Setting::Half => scene = symmetry::half(&scene).ok_or_else(no_half)?.scene,
        }
        Ok(scene)
    }

    /// Knob, variant and place: a name that no other trial has.
    pub fn name(&self) -> String {
        format!("{}/{}/{}", self.knob, self.variant, self.rung)
    }
}

fn no_mesh() -> InputError {
    InputError::new("the scene", "half a scene cannot be refined", "refine the whole scene")
}

fn no_half() -> InputError {
    let what = "the scene is not symmetric about a vertical line";
    InputError::new("the scene", what, "run the whole scene")
}

/// The trial of that name ([`Trial::name`]).
pub fn find(scene: &Scene, reading: &Reading, name: &str) -> Option<Trial> {
    let all = Knob::ALL.iter().flat_map(|knob| trials(scene, reading, *knob));
    all.into_iter().find(|trial| trial.name() == name)
}

/// Everything to measure of a knob; nothing where the scene does not have it.
pub fn trials(scene: &Scene, reading: &Reading, knob: Knob) -> Vec<Trial> {
    let contact = scene.target().is_some();
    match knob {
        Knob::Arithmetic => arithmetic(scene, reading),
        Knob::Solver => solvers(scene),
        Knob::Mesh => meshes(scene),
        Knob::Symmetry => halves(scene, contact),
        _ if !contact => Vec::new(),
        Knob::Tolerance => turned(knob, tolerances(scene)),
        Knob::Iterations => turned(knob, iterations(scene)),
        Knob::Status => turned(knob, statuses(scene)),
        Knob::Coupling => couplings(scene),
    }
}

/// The quickest rung that rounds as little as Mathcad does: that in which knobs are turned.
fn quick() -> Arithmetic {
    rung(ScalarName::F64, Solver::SparseCholesky)
}

fn rung(scalar: ScalarName, solver: Solver) -> Arithmetic {
    Arithmetic { scalar, solver: Some(solver), ..Arithmetic::default() }
}

/// The variant on which rungs are measured: the scene's; `unilateral` has one rung only.
fn of_the_ladder(scene: &Scene) -> Variant {
    if scene.variant == Variant::Unilateral { Variant::Stepped } else { scene.variant }
}

/// Seconds that exact numbers may take.
pub(super) fn exact_seconds(scene: &Scene, reading: &Reading) -> f64 {
    let free = scene.sheet().S.iter().filter(|s| **s == 0).count();
    cost::seconds(free, reading.r5 == NodeTable::NodeN, scene.iterations)
}

fn arithmetic(scene: &Scene, reading: &Reading) -> Vec<Trial> {
    use {ScalarName::*, Solver::*};
    let mut rungs = vec![
        ("f32", rung(F32, SparseCholesky)),
        ("f32 factors refined in f64", rung(F64, Refined)),
        ("f64", rung(F64, SparseCholesky)),
        ("f64 with a bound", rung(Bounded, SparseCholesky)),
        ("f64 factors refined in f64x2", rung(F64x2, Refined)),
        ("f64x2", rung(F64x2, SparseCholesky)),
    ];
    if exact_seconds(scene, reading) <= EXACT {
        rungs.push(("exact", rung(Exact, SparseCholesky)));
    }
    ladder(Knob::Arithmetic, of_the_ladder(scene), rungs)
}

fn solvers(scene: &Scene) -> Vec<Trial> {
    use {ScalarName::*, Solver::*};
    let cg = |tol: f64| Arithmetic { tol: Some(tol), ..rung(F64, Cg) };
    let rungs = vec![
        ("dense-lu", rung(F64, DenseLu)),
        ("dense-cholesky", rung(F64, DenseCholesky)),
        ("sparse-cholesky", rung(F64, SparseCholesky)),
        ("cg to 1e-4", cg(1e-4)),
        ("cg to 1e-6", cg(1e-6)),
        ("cg to 1e-8", cg(1e-8)),
        ("cg to 1e-10", cg(1e-10)),
        ("cg to 1e-12", cg(1e-12)),
        ("cg to 16 eps", rung(F64, Cg)),
        ("f64x2 to compare", rung(F64x2, SparseCholesky)),
    ];
    ladder(Knob::Solver, of_the_ladder(scene), rungs)
}

/// Rungs of one variant, measured against the last.
fn ladder(knob: Knob, variant: Variant, rungs: Vec<(&str, Arithmetic)>) -> Vec<Trial> {
    let against = Against::Trial(rungs.len() - 1);
    let trial = |(rung, arithmetic): (&str, Arithmetic)| Trial {
        knob,
        rung: rung.into(),
        variant,
        arithmetic,
        setting: Setting::Own,
        against,
        own: false,
    };
    rungs.into_iter().map(trial).collect()
}

/// Meshes under `unilateral`, which keeps no dense matrix.
fn meshes(scene: &Scene) -> Vec<Trial> {
    let equations = |times: usize| (2 * scene.sheet().R()) << (2 * times);
    let count = (1..MESHES).take_while(|times| equations(*times) <= EQUATIONS).count() + 1;
    let trial = |times: usize| Trial {
        knob: Knob::Mesh,
        rung: format!("h / {}", 1 << times),
        variant: Variant::Unilateral,
        arithmetic: quick(),
        setting: Setting::Refined(times),
        against: Against::Trial(count - 1),
        own: times == 0,
    };
    (0..count).map(trial).collect()
}

/// A knob under each variant of the paper that carries load across.
fn turned(knob: Knob, places: Vec<(String, Setting, bool)>) -> Vec<Trial> {
    TURNED.iter().flat_map(|variant| under(knob, *variant, &places)).collect()
}

fn under(knob: Knob, variant: Variant, places: &[(String, Setting, bool)]) -> Vec<Trial> {
    let trial = |(rung, setting, own): &(String, Setting, bool)| Trial {
        knob,
        rung: rung.clone(),
        variant,
        arithmetic: quick(),
        setting: *setting,
        against: Against::Converged,
        own: *own,
    };
    places.iter().map(trial).collect()
}

fn tolerances(scene: &Scene) -> Vec<(String, Setting, bool)> {
    let own = scene.sheet().c_tll;
    let mut values = TOLERANCES.to_vec();
    if !values.contains(&own) {
        values.push(own);
        values.sort_by(f64::total_cmp);
    }
    let place = |c: f64| (format!("{c:e}"), Setting::Tolerance(c), c == own);
    values.into_iter().map(place).collect()
}

fn iterations(scene: &Scene) -> Vec<(String, Setting, bool)> {
    let mut values = ITERATIONS.to_vec();
    // One more than the scene's shows what a cycle of two does.
    values.extend([scene.iterations, scene.iterations + 1]);
    values.sort_unstable();
    values.dedup();
    let place = |n: usize| (n.to_string(), Setting::Iterations(n), n == scene.iterations);
    values.into_iter().map(place).collect()
}

fn statuses(scene: &Scene) -> Vec<(String, Setting, bool)> {
    let own = scene.contact.status;
    let place = |rule: &StatusRule| (rule.to_string(), Setting::Status(*rule), *rule == own);
    StatusRule::ALL.iter().map(place).collect()
}

fn couplings(scene: &Scene) -> Vec<Trial> {
    let own = scene.contact.coupling;
    let place = |c: &Coupling| (c.to_string(), Setting::Coupling(*c), *c == own);
    let places: Vec<_> = Coupling::ALL.iter().map(place).collect();
    let variants = TURNED.into_iter().chain([Variant::Unilateral]);
    variants.flat_map(|variant| under(Knob::Coupling, variant, &places)).collect()
}

/// The whole scene, then its half, under each variant.
fn halves(scene: &Scene, contact: bool) -> Vec<Trial> {
    if symmetry::half(scene).is_none() {
        return Vec::new();
    }
    let own = [of_the_ladder(scene)];
    let all = [Variant::Tied, Variant::Stepped, Variant::Unilateral];
    let variants: &[Variant] = if contact { &all } else { &own };
    let trial = |(k, variant): (usize, &Variant)| {
        let trial = |rung: &str, setting, own| Trial {
            knob: Knob::Symmetry,
            rung: rung.into(),
            variant: *variant,
            arithmetic: quick(),
            setting,
            against: Against::Trial(2 * k),
            own,
        };
        [trial("whole", Setting::Own, true), trial("half", Setting::Half, false)]
    };
    variants.iter().enumerate().flat_map(trial).collect()
}
