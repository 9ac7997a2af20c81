//! Files that reports write.

use std::path::Path;

use crate::error::Result;
use crate::files;

/// Writes each content to the file of its name in `folder`.
pub fn write_all(folder: &Path, contents: &[(&str, &str)]) -> Result<()> {
    contents.iter().try_for_each(|(name, content)| files::write(&folder.join(name), content))
}

/// Lays out a table as RFC 4180 has it: the line `head`, then a line for each of `rows`.
pub fn csv(head: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let quoted = |cell: &String| match cell.contains([',', '"', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    };
    let line = |row: Vec<String>| row.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n";
    format!("{head}\n") + &rows.into_iter().map(line).collect::<String>()
}
