//! A run from end to end: of a scene file, or of a scene and options drawn from bytes. It fails with
//! the exit status of who is to blame, or ends in numbers that all have a value, and that another way
//! to compute them confirms.

use arbitrary::{Result, Unstructured};
use plane_contact::engine::Assessment;
use plane_contact::engine::contact::pulling;
use plane_contact::engine::estimates::perturbed;
use plane_contact::engine::linear::cost;
use plane_contact::engine::plan::Plan;
use plane_contact::input::{Arithmetic, ScalarName, Solver, Variant};
use plane_contact::output::{ResultFile, tables};
use plane_contact::problem::scene::Scene;
use plane_contact::{Request, Solution, solve};

use super::{drawn, sound};

/// Scenes of files with more nodes, and more iterations and steps of theirs, are left out: a run is
/// to end in some milliseconds.
const MOST: usize = 40;

pub fn hold(data: &[u8]) {
    let request = match data.first() {
        Some(b'{') => of_file(data),
        _ => of_draws(&mut Unstructured::new(data)).ok().flatten(),
    };
    let Some(request) = request else { return };
    let solution = match solve(&request, &mut |_| ()) {
        Ok(solution) => solution,
        Err(error) => return sound::failed_run(&error, request.variant),
    };
    is_written(&solution);
    match request.variant {
        Variant::Unilateral => {
            assert_eq!(pulling(&solution.contact, solution.model.load.amax()), []);
        }
        Variant::Printed | Variant::Tied | Variant::Stepped => is_confirmed(&solution),
    }
}

fn of_file(text: &[u8]) -> Option<Request> {
    let scene = Scene::build("fuzz", text, |_| Err("there is no other file".into())).ok()?;
    let sizes = [scene.model.nodes.len(), scene.iterations, scene.contact.load_steps];
    sizes.into_iter().all(|size| size <= MOST).then(|| Request::new(&scene))
}

fn of_draws(u: &mut Unstructured) -> Result<Option<Request>> {
    let scene = drawn::scene(u)?.build();
    scene.ok().map(|scene| drawn::request(u, &scene)).transpose()
}

/// The result and its tables have no number without a value.
fn is_written(solution: &Solution) {
    let assessment = Assessment::new(solution);
    let plan = Plan::new(&solution.request).expect("what ran can be planned");
    sound::document(&ResultFile::new(solution, &assessment, Some(&plan), false).to_json());
    sound::text(&tables::solution(solution, &assessment).text(usize::MAX));
    sound::text(&tables::error_estimates(solution, &assessment).text(usize::MAX));
    sound::text(&tables::distance(solution, &assessment).text(usize::MAX));
}

/// Sparse and dense equations lead to the same displacements but for what rounding is measured to do, and so do exact
/// numbers where they take no time.
fn is_confirmed(solution: &Solution) {
    /// How many times what three runs show; few runs underestimate it.
    const MARGIN: f64 = 100.0;
    let Request { arithmetic, reading, iterations, .. } = solution.request;
    let Some(measured) = perturbed(solution).filter(|found| !found.decides()) else { return };
    let size = solution.u.amax();
    let bound = MARGIN * size * measured.displacement.unwrap_or(0.0).max(f64::EPSILON);
    let within = |scalar: ScalarName, solver: Option<Solver>| {
        let other = Arithmetic { scalar, solver, ..arithmetic };
        match solve(&solution.request.clone().arithmetic(other), &mut |_| ()) {
            Ok(other) => {
                let apart = (&solution.u - &other.u).amax();
                assert!(
                    apart <= bound,
                    "{apart:e} apart, {bound:e} at most: {:?}",
                    solution.request
                );
            }
            // What takes square roots does not run in exact numbers, and f32 is not solved by all.
            Err(why) => assert_eq!(why.exit_status().number(), 2, "{why}"),
        }
    };
    within(arithmetic.scalar, Some(Solver::DenseLu));
    // Of so few equations 20 iterations in exact numbers take less than 0.1 s.
    let most = cost::most_equations(reading.r5.follows_the_shape(), iterations).min(15);
    if solution.model.free_dofs() <= most {
        within(ScalarName::Exact, None);
    }
}
