//! The answer of a run with all its digits, and how far it is from the exact one.

use dashu_ratio::RBig;

use super::blocks::Blocks;
use super::kept::Kept;
use engine::error::Error;
use engine::linear::{Arithmetic, ScalarName};
use engine::{self, Request, Solution};
use problem::model::Body;
use problem::modelling::Variant;
use problem::scene::SceneBuilder;

/// Runs `variant` on `scene` in `scalar`.
fn solve(scene: &SceneBuilder, variant: Variant, scalar: ScalarName) -> Result<Solution, Error> {
    let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
    let request = Request::new(&scene.build()?).variant(variant).arithmetic(arithmetic);
    engine::solve(&request, &mut |_| ())
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

/// Runs `variant` on `blocks` in `scalar`, and compares with exact numbers: another contact state is wrong.
/// `unilateral` has no exact run and is compared with `tied`, which is its answer where nothing opens.
pub fn judge(blocks: &Blocks, variant: Variant, scalar: ScalarName) -> Result<Kept, Error> {
    let scene = blocks.scene(variant);
    let answer = solve(&scene, variant, scalar)?;
    let is_unilateral = variant == Variant::Unilateral;
    let known = if is_unilateral { Variant::Tied } else { variant };
    Ok(match Error::found(solve(&scene, known, ScalarName::Exact))? {
        Some(exact) if answer.last().closed().eq(exact.last().closed()) => {
            let (found, known) = (answer.exact_displacements(), exact.exact_displacements());
            let errors = exact.model.bodies.iter().map(|body| error(body, &found, &known));
            Kept::of_error(errors.fold(0.0, f64::max))
        }
        Some(_) if is_unilateral => Kept::Unknown,
        Some(_) => Kept::of_status(false),
        None => Kept::Wrong("exact refuses"),
    })
}
