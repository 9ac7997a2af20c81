//! Regression snapshots: what a scene gives, recorded; verified later by running it again; and where
//! it differs, what went in and differs too, and what differed first.
//!
//! ```text
//!  Scene --input--> Input --+                                   +--> Difference --> First
//!  Request --record--> Run -+--> Snapshot <--difference--> other +
//!                                             (verify: run again) +--> Change
//! ```
//!
//! Discrete facts (who is in contact, the target edge of each node, the number of iterations) stand
//! apart from numbers: facts are the same or not, numbers agree but for what rounding does, as measured.
//!
//! | file                                       | what it holds                                      |
//! |--------------------------------------------|----------------------------------------------------|
//! | `file`, `input`                            | a snapshot, its reader and its writer; its scene   |
//! | `run`, `entry`, `numbers`                  | a run recorded, and what rounding does to it       |
//! | `summary`                                  | what a reviewer reads of it                        |
//! | `difference`, `changes`, `first_difference` | what differs: what came out, what went in, where  |
//! | `verified`, `verified_file`, `words`       | snapshots compared, and what is said of that       |
//! | `command`                                  | a file for each `plane-contact snapshot ...`       |

mod changes;
pub(crate) mod command;
mod difference;
mod entry;
mod file;
mod first_difference;
mod input;
mod numbers;
mod run;
mod summary;
mod verified;
pub mod verified_file;
mod words;

pub use base::files::json::{FORMAT, VERSION};
pub use changes::Change;
pub use difference::{Difference, Kind, compare};
pub use engine::options::Options;
pub use entry::{Entry, FIELDS, Quantity};
pub use file::Snapshot;
pub use first_difference::{First, Status};
pub use input::Input;
pub use numbers::{Number, Numbers, Tolerance, UNMEASURED, Values};
pub use run::{Decision, Run, record};
pub use verified::{Presence, Verified, VerifiedRun, accept, difference, verify};
