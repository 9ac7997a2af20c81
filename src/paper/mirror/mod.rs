//! The paper's two listings in Rust, line by line: dense, 1-based, in the printed order.
//!
//! The mirror is not optimised. Above every piece is its listing line, quoted as `//# <line>
//! <text>` from `listings/`; a test compares each quote byte for byte and checks that each line is
//! mirrored once.
//!
//! ```text
//!            6 *-----* 7      elem[e,6], elem[e,7]: the two nodes of target edge e
//!               \  ^
//!      line 10:  \ | yt       vertical distance from the contact node to the target line,
//!                 \|          > 0 where the line is above the node
//!                  o cnt[i1]
//! ```

#![allow(non_snake_case, reason = "the paper's own names")]

mod ambiguity;
mod by_name;
mod c_cnt;
mod conditions;
mod failure;
mod km;
mod reading;
mod worksheet;

pub use ambiguity::{Change, DefaultFrom, Trial, Value};
pub use c_cnt::{Pairs, c_cnt, distances, own_weights, status, weights, weights_from};
pub use conditions::{Operand, and, is_jumped_after, is_jumped_before, is_near};
pub use failure::{Cause, Failure};
pub use km::Km;
pub use reading::{
    Ambiguity, LoopPlace, NodeTable, READINGS, Reading, RestraintIndex, Schedule, ToleranceUnit,
    Wedge,
};
pub use worksheet::Worksheet;
