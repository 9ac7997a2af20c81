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
//! In each step the statuses are looked for by these methods, in this order. What each of them finds is
//! checked against the same conditions.
//!
//! The search goes on with the stiffness on the contact surfaces alone ([`reduction`](crate::reduction))
//! where there is one; the contact state with which the path ends is solved again on the whole bodies, and
//! must ask for itself there too.
//!
//! 1. A primal-dual active set (`search`): each iteration imposes statuses, and takes as the next ones those
//!    that the forces, gaps and slips ask for. Statuses that return, other than the last, would return
//!    without end: from then on one node changes at a time, the last along the surface of those that should;
//!    without friction that ends for every problem with one solution (K. G. Murty's least-index rule,
//!    Opsearch 11 (1974)). Where they do not restrain the bodies, the node that the load's motion brings to
//!    the target first closes; where no node comes nearer, those with the least gaps close.
//! 2. Complementary pivots on the contact nodes alone (`condensed`, `lemke`).
//! 3. All statuses that there are on these, where they are few (`condensed`, `equilibria`).
//! 4. Under friction, all of this for the step of the load in two halves (`path`).
//! 5. The first three again with the bodies on springs, which vanish as they come to rest (`springs`).
//!
//! In the initial geometry a motion of the bodies as rigid ones that nothing opposes proves that there is no
//! equilibrium (`rigid`); without it, that none was found proves nothing. In the current geometry normals,
//! weights and gaps are measured again in the shape reached, until that no longer changes the
//! displacements.
//!
//! # Why has this node this status?
//!
//! | question | where |
//! |---|---|
//! | which status do its force, gap and slip ask for? | `search.rs`, `wanted` |
//! | what is the friction of a node that slides? | `imposed.rs`, `slide` |
//! | what does a status impose, and does friction act there at all? | `problem.rs`, `constraints` and `transmits_shear` |
//! | up to which shear does a node stick, in a corner too? | `problem.rs`, `holding` |
//! | which status comes next where statuses return? | `status.rs`, `History::next` |
//!
//! In the current geometry a node in a concave corner of the target, under node to segment, is held there
//! while its force lies between the normals of both edges; its normal is then that of its force.
//!
//! A node sticks beyond μ p in the result by rounding alone (`CONE` in `problem.rs`), or under `stick`, where
//! no node slides. In an iteration on the way it may wait until other nodes have changed.
//!
//! Source: S. Hüeber, B. I. Wohlmuth, Comput. Methods Appl. Mech. Engrg. 194 (2005) 3147-3166; S.
//! Hüeber, G. Stadler, B. I. Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572-596 (friction).

mod condensed;
mod equilibria;
mod implied;
mod imposed;
mod lemke;
mod nonnegative;
mod path;
mod problem;
mod rigid;
mod search;
mod springs;
mod status;
mod unrestrained;

pub use implied::{Implied, implied};
pub(super) use path::unilateral;
