//! The search on springs: every node is tied to its place in the shape before, so that the bodies are held
//! whatever contact does. As the shape settles the springs let go: in the equilibrium they carry nothing.
//!
//! ```text
//!   (K + s D) u = F + s D u_before + forces of contact        s D (u − u_before) → 0
//! ```
//!
//! D is at each node the mean diagonal entry of the matrices of its triangles. Springs get softer while the
//! bodies move on, and stiffer where they turn back. So a body that contact holds in other shapes alone, or
//! that contact balances and does not hold, comes to rest.
//!
//! Source: R. T. Rockafellar, SIAM J. Control Optim. 14 (1976) 877-898 (the proximal point method).

use nalgebra::DVector;

use super::problem::{Equilibrium, Problem, Setting, Watch};
use super::search::{SETTLED, STALLED};
use super::status::History;
use crate::contact::Status;
use crate::error::{Cause, Error, NoEquilibrium};
use crate::linear::largest;

/// The stiffness s of the first springs.
const FIRST: f64 = 1e-3;

/// The least and the greatest stiffness: softer springs hold less than rounding moves, stiffer ones hold
/// everything.
const RANGE: [f64; 2] = [1e-9, 1e3];

/// What a move onwards, and one back, makes of the stiffness. Measured on 120 rings and arcs whose search
/// without springs finds nothing for 68: with 1/2 and 8 it finds nothing for 1, with 1/4 and 4 for 20.
const ONWARDS: f64 = 0.5;
const BACK: f64 = 8.0;

/// The number of shapes after which the search ends.
const SHAPES: usize = 300;

/// A displacement over the size of the model with which a body has left.
const AWAY: f64 = 10.0;

impl Problem<'_> {
    /// Finds the equilibrium of a setting on springs; `why` says why it was not found without.
    ///
    /// # Errors
    /// Contact does not hold the bodies on springs, or the springs do not let go.
    pub(super) fn on_springs(
        &self,
        setting: &Setting,
        why: &str,
        watch: &mut Watch,
    ) -> Result<Equilibrium, Error> {
        let mut springs = self.with_springs(FIRST);
        let mut u = setting.before.clone();
        let mut statuses = setting.statuses.map(<[Status]>::to_vec);
        let mut last_move = DVector::zeros(u.len());
        let mut history = History::default();
        let mut config = self.configuration(&u);
        let (mut most, mut least, mut shapes) = (0.0_f64, f64::INFINITY, 0);
        while shapes < SHAPES && largest(u.as_slice()) < AWAY * self.model.bounds().larger_side() {
            shapes += 1;
            history.move_on();
            config = self.configuration(&u);
            let load = &setting.load + self.force_of(&springs, &u);
            let own = Setting { load, reduced: None, ..*setting };
            let settled =
                springs.search(&config, &own).settle(statuses.as_deref(), &mut history, watch);
            let last = settled.map_err(|more| more.prefixed(&format!("{why}; on springs ")))?;
            let moved = &last.solution.u - &u;
            let change = largest(moved.as_slice());
            // Without load the forces of contact vanish with those of the springs, to rounding.
            let whole = self.force_of(&springs, &last.solution.u) / springs.stiffness.springs;
            let rounding = f64::EPSILON / SETTLED * largest(whole.as_slice());
            let forces = last.solution.forces.iter().map(|f| f.normal.hypot(f.tangent));
            most = forces.fold(most, f64::max).max(largest(setting.load.as_slice())).max(rounding);
            let pushing = largest(self.force_of(&springs, &moved).as_slice());
            let carried = if pushing == 0.0 { 0.0 } else { pushing / most };
            least = least.min(carried);
            if carried <= SETTLED && change <= STALLED * largest(last.solution.u.as_slice()) {
                let (closing, springs) = (None, Some(carried));
                return Ok(Equilibrium { config, last, closing, shape_change: change, springs });
            }
            let softer = if moved.dot(&last_move) < 0.0 { BACK } else { ONWARDS };
            let [softest, stiffest] = RANGE;
            springs =
                self.with_springs((springs.stiffness.springs * softer).clamp(softest, stiffest));
            (u, statuses, last_move) = (last.solution.u, Some(last.statuses), moved);
        }
        let escaping = self.escape(&config, &setting.load, self.friction);
        let tried = format!(
            "on springs the bodies do not come to rest in {shapes} shapes, {least:.1e} of the largest force is left \
             to the springs at best"
        );
        let what = match escaping {
            Some(dof) => format!("{}; {tried}; {why}", self.escapes(dof).what),
            None => format!("{why}; {tried}"),
        };
        Err(NoEquilibrium { cause: Cause::NotFound, what }.into())
    }

    /// Returns the forces with which springs hold bodies after displacements `u`, force.
    fn force_of(&self, springs: &Problem, u: &DVector<f64>) -> DVector<f64> {
        springs.stiffness.times(u) - self.stiffness.times(u)
    }
}
