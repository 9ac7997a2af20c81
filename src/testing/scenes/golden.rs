//! Golden files, `golden/<folder>/<name>.snap`, under any rule of what is the same.

use std::path::Path;

use insta::internals::SnapshotContents;
use insta::{Comparator, Settings, Snapshot};

/// Compares `text` with `golden/<folder>/<name>.snap` under a rule of what is the same, which gets
/// the golden text, then the value; `cargo insta review` (or INSTA_UPDATE=always) changes the file.
#[track_caller]
pub fn assert_golden_by(folder: &str, name: &str, text: &str, same: fn(&str, &str) -> bool) {
    let mut settings = Settings::clone_current();
    settings
        .set_snapshot_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden").join(folder));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(Toleranced(same)));
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// Two texts under a rule.
struct Toleranced(fn(&str, &str) -> bool);

impl Comparator for Toleranced {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (reference.contents(), test.contents()) {
            (SnapshotContents::Text(a), SnapshotContents::Text(b)) => {
                (self.0)(&a.to_string(), &b.to_string())
            }
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(Toleranced(self.0))
    }
}
