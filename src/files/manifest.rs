//! The list of the files that a folder has from the program, in the form of `sha256sum`: it tells
//! which of them a later run may remove, and `sha256sum --check` whether one was changed.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use sha2::{Digest, Sha256};

/// The name of the list.
pub const MANIFEST: &str = "SHA256SUMS";

/// How a line begins that names the command whose files follow.
const COMMAND: &str = "# plane-contact ";

/// The sum of each file by its name, for each command that wrote to the folder.
#[derive(Clone, Debug, Default)]
pub(super) struct Manifest(BTreeMap<String, BTreeMap<String, String>>);

impl Manifest {
    /// Reads that of `folder`; an empty one where there is none. A line that is not understood
    /// tells of no file.
    pub(super) fn read(folder: &Path) -> Self {
        let text = super::read_text(&folder.join(MANIFEST)).unwrap_or_default();
        let mut manifest = Manifest::default();
        let mut files: Option<&mut BTreeMap<String, String>> = None;
        for line in text.lines() {
            if let Some(command) = line.strip_prefix(COMMAND) {
                files = Some(manifest.0.entry(command.into()).or_default());
            } else if let (Some(files), Some((sum, name))) = (&mut files, line.split_once("  ")) {
                files.insert(name.into(), sum.into());
            }
        }
        manifest
    }

    /// Returns the names of a command's files that are in `folder` as they were written.
    pub(super) fn unchanged(&self, folder: &Path, command: &str) -> Vec<String> {
        let files = self.0.get(command).into_iter().flatten();
        let is_same = |(name, sum): &(&String, &String)| {
            std::fs::read(folder.join(name)).is_ok_and(|content| sum_of(&content) == **sum)
        };
        files.filter(is_same).map(|(name, _)| name.clone()).collect()
    }

    /// Takes `files` for those of `command`, and for no other's.
    pub(super) fn set(&mut self, command: &str, files: BTreeMap<String, String>) {
        for others in self.0.values_mut() {
            others.retain(|name, _| !files.contains_key(name));
        }
        self.0.insert(command.into(), files);
        self.0.retain(|_, files| !files.is_empty());
    }

    /// Returns the text of the list.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for (command, files) in &self.0 {
            let _ = writeln!(text, "{COMMAND}{command}");
            files.iter().for_each(|(name, sum)| {
                let _ = writeln!(text, "{sum}  {name}");
            });
        }
        text
    }
}

/// Returns the SHA-256 of `content` as `sha256sum` prints it.
pub(super) fn sum_of(content: &[u8]) -> String {
    Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect()
}
