//! Golden files of what many random cases come to, `golden/recorded/<name>.snap`.

use crate::golden::assert_golden_by;

/// Compares `text` with `golden/recorded/<name>.snap`, word by word; `cargo insta review` (or
/// INSTA_UPDATE=always) changes it.
#[track_caller]
pub fn assert_recorded_exactly(name: &str, text: &str) {
    assert_golden_by("recorded", name, text, |recorded, found| {
        recorded.trim_end() == found.trim_end()
    });
}
