//! All that exists only for speed, each part with what it earns and tested against the slow way.
//!
//! | part | without it `solve` takes | tested |
//! |---|---|---|
//! | [`condensation`]: the bodies are factored once, contact states on what is kept of them | 9 to 13 times as long on `strand` (mortar in the current geometry 4 times), 3 times on Hertz's contact of 29,852 and 113,394 equations | `tests/contact/condensed.rs`, `gaps.rs` |
//! | [`listings`]: `c_cnt` with its boxes in a tree | `benches/README.md`, "One call of `c_cnt`" | `tests/fidelity/bitwise.rs`, to the last bit |
//!
//! Within condensation the parts of the bodies are factored at once, each on a thread of its own.

pub mod condensation;
pub mod listings;
