//! Unilateral contact with Coulomb's friction: no gap in contact, no node that pulls, none that
//! penetrates, and no tangential force beyond friction.
//!
//! ```text
//!   gap g_i = n·(x_i − Σ w_ij x_j)       apart      g ≥ 0, p = 0, q = 0
//!   slip Δs_i = t·(Δu_i − Σ w_ij Δu_j)   sticks     g = 0, p ≥ 0, Δs = 0, |q| ≤ μ p
//!   p along n, q along t on node i       slides     g = 0, p ≥ 0, q = −μ p sign Δs
//! ```
//!
//! The load grows in equal steps, stage by stage, and Δ is the change over a step (implicit Euler):
//! with friction the path of the load is part of the problem, and its end is the solution. Without
//! friction there is one step.
//!
//! In each step the statuses are found by a primal-dual active set: each iteration imposes them,
//! and takes as the next ones those that the forces, gaps and slips ask for. Statuses that return,
//! other than the last, would return without end: from then on one node changes at a time, the last
//! along the surface of those that should; without friction that ends for every problem with one
//! solution (K. G. Murty's least-index rule, Opsearch 11 (1974)). Where they do not restrain the
//! bodies, the node that the load's motion brings to the target first closes; where no node comes
//! nearer, those with the least gaps close. In the current geometry normals, weights and gaps are
//! measured again in the shape reached, until that no longer changes the displacements. Where the
//! active set finds no equilibrium, a motion of rigid bodies may show that without friction there is
//! none (`rigid`), else Lemke's method looks for one under a finite coefficient (`condensed`); a step
//! without one is halved.
//!
//! The search goes on with the condensed bodies alone where they can be condensed, once more with fewer
//! roundings where it finds nothing; the contact state that it ends with is solved again on the whole
//! bodies, refined, and must ask for itself there too.
//!
//! Source: S. Hüeber, B. I. Wohlmuth, Comput. Methods Appl. Mech. Engrg. 194 (2005) 3147-3166; S.
//! Hüeber, G. Stadler, B. I. Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572-596 (friction); J. J.
//! Júdice, F. M. Pires, Comput. Oper. Res. 21 (1994) 587-596 (the fall-back).

mod condensed;
mod equilibria;
mod forces;
mod imposed;
mod lemke;
mod path;
mod problem;
mod reduced;
mod rigid;
mod search;
mod status;
mod unrestrained;

pub(super) use search::{FIRST_GROWTH, PATIENCE};

use super::error::{Error, NoEquilibrium};
use super::request::Request;
use super::solution::{Solution, Step, Uniqueness};

/// Finds the equilibrium at the end of the load's path, which is the last step; `watch` is called
/// after each iteration.
///
/// # Errors
/// Contact and restraints do not restrain the bodies, or no equilibrium was found.
pub(super) fn unilateral(
    request: &Request,
    watch: &mut dyn FnMut(&Step),
) -> Result<Solution, Error> {
    let model = request.model()?;
    let problem = problem::Problem::new(request, &model)?;
    path::solve(&problem, watch).map_err(|why| with_its_indifference(request, why))
}

/// Says of a search without an equilibrium whether the bodies can move without work in the initial
/// geometry without friction: then rounding decides where they come to rest.
fn with_its_indifference(request: &Request, why: Error) -> Error {
    let Error::Equilibrium(NoEquilibrium { what }) = why else { return why };
    let reference = request.reference();
    let is_reference = request.is_same_equilibrium(&reference);
    let found = (!is_reference).then(|| unilateral(&reference, &mut |_| ()).ok()).flatten();
    let known = found.and_then(|solution| solution.equilibrium);
    let Some(Uniqueness::Indifferent { node }) = known.map(|known| known.uniqueness) else {
        return NoEquilibrium { what }.into();
    };
    let what = format!(
        "{what}; without friction in the initial geometry the equilibrium is not the only one: node \
         {node} can move without work"
    );
    NoEquilibrium { what }.into()
}
