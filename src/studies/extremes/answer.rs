//! The answer of a run with all its digits, and how far it is from another.

use dashu_ratio::RBig;

use super::blocks::Blocks;
use super::kept::Kept;
use engine::error::Error;
use engine::linear::{Arithmetic, ScalarName};
use engine::{self, Request};
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::SceneBuilder;

/// What a run computed, with all the digits that its scalar has.
struct Answer {
    /// Displacements by degree of freedom, length.
    u: Vec<RBig>,
    in_contact: Vec<bool>,
    /// Places in `u` of the degrees of freedom of each body.
    bodies: Vec<Vec<usize>>,
}

/// Runs `variant` on `scene` in `scalar`.
fn solve(scene: &SceneBuilder, variant: Variant, scalar: ScalarName) -> Result<Answer, Error> {
    let scene = scene.build()?;
    let arithmetic = Arithmetic { scalar, ..Arithmetic::default() };
    let request = Request::new(&scene).variant(variant).arithmetic(arithmetic);
    let solution = engine::solve(&request, &mut |_| ())?;
    let dofs = |node: &NodeId| node.dofs().map(|dof| dof.index());
    let bodies = solution.model.bodies.iter();
    Ok(Answer {
        in_contact: solution.last().statuses(),
        bodies: bodies.map(|body| body.nodes.iter().flat_map(dofs).collect()).collect(),
        u: solution.exact_displacements(),
    })
}

impl Answer {
    /// Largest error over the largest displacement of a body; infinite where the exact one is 0 and
    /// this is not.
    fn error(&self, exact: &Answer, dofs: &[usize]) -> f64 {
        let abs = |x: RBig| if x < RBig::ZERO { -x } else { x };
        let largest =
            |of: &dyn Fn(usize) -> RBig| dofs.iter().map(|&e| abs(of(e))).max().unwrap_or_default();
        let error = largest(&|e| &self.u[e] - &exact.u[e]);
        let size = largest(&|e| exact.u[e].clone());
        if error.is_zero() {
            0.0
        } else if size.is_zero() {
            f64::INFINITY
        } else {
            (error / size).to_f64().value()
        }
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
        Some(exact) if answer.in_contact == exact.in_contact => {
            let errors = exact.bodies.iter().map(|dofs| answer.error(&exact, dofs));
            Kept::of_error(errors.fold(0.0, f64::max))
        }
        Some(_) if is_unilateral => Kept::Unknown,
        Some(_) => Kept::of_status(false),
        None => Kept::Wrong("exact refuses"),
    })
}
