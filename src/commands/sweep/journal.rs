//! The rows of a sweep as they come: a file beside the rows' own, a line a row, that an interrupted
//! sweep finds again.

use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::files::Folder;
use plane_contact::studies::sweep::Row;
use serde_json::{Value, json};

/// The most bytes of a row's file; one has some 600.
const ROW: u64 = 1 << 20;

pub struct Journal {
    path: PathBuf,
    file: File,
}

fn fault(path: &Path, why: &dyn std::fmt::Display) -> InputError {
    let what = format!("the file cannot be read or written: {why}");
    InputError::new(path.display().to_string(), what, "choose another place, or make room")
}

impl Journal {
    /// Opens the journal of the rows of `out`, or begins one.
    ///
    /// # Errors
    /// It cannot be written, or another sweep writes it.
    pub fn open(out: &Path) -> Result<Self> {
        if out.is_dir() {
            return Err(fault(out, &"it is a folder").into());
        }
        let mut name = out.as_os_str().to_owned();
        name.push(".journal");
        let path = PathBuf::from(name);
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder).map_err(|why| fault(folder, &why))?;
        }
        if path.symlink_metadata().is_ok_and(|there| !there.is_file()) {
            return Err(fault(&path, &"it is no ordinary file").into());
        }
        let file = OpenOptions::new().create(true).append(true).read(true).open(&path);
        let file = file.map_err(|why| fault(&path, &why))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let what = "another sweep writes these rows";
                return Err(InputError::new(path.display().to_string(), what, "wait for it").into());
            }
            Err(TryLockError::Error(why)) => return Err(fault(&path, &why).into()),
        }
        Ok(Journal { path, file })
    }

    /// Returns the rows that are known, by key: those of `out`, and those of the journal. What is no
    /// ordinary file (a pipe, a device) has none.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn known(&mut self, out: &Path) -> Result<HashMap<String, Row>> {
        let mut known = HashMap::new();
        for path in [out, &self.path].into_iter().filter(|path| path.is_file()) {
            known.extend(rows(&std::fs::read(path).map_err(|why| fault(path, &why))?));
        }
        // What an interruption cut off must not run into the next line.
        let torn =
            std::fs::read(&self.path).is_ok_and(|text| text.last().is_some_and(|b| *b != b'\n'));
        if torn {
            self.write("\n")?;
        }
        Ok(known)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// It cannot be written; what was written before stays.
    pub fn add(&mut self, key: &str, row: &Row) -> Result<()> {
        let mut line = Row::new();
        line.insert("key".into(), json!(key));
        line.extend(row.clone());
        self.write(&(Value::Object(line).to_string() + "\n"))
    }

    fn write(&mut self, text: &str) -> Result<()> {
        Ok(self.file.write_all(text.as_bytes()).map_err(|why| fault(&self.path, &why))?)
    }

    /// Removes the journal: its rows stand in the file of the rows.
    pub fn remove(self) {
        // It would only be read again.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Returns the rows in a text, by key, without what takes turns; lines that are no rows are skipped.
fn rows(text: &[u8]) -> Vec<(String, Row)> {
    let row = |line: &[u8]| {
        let row: Row = serde_json::from_slice(line).ok()?;
        let key = row.get("key")?.as_str()?.to_string();
        row.contains_key("exit_status").then_some(())?;
        let is_result = |name: &String| !(name.starts_with('/') || name == "case" || name == "key");
        Some((key, row.into_iter().filter(|(name, _)| is_result(name)).collect()))
    };
    text.split(|byte| *byte == b'\n').filter_map(row).collect()
}

/// Returns the rows in the files of a folder.
///
/// # Errors
/// The folder or a file cannot be read.
pub fn in_folder(folder: &Path) -> Result<Vec<(String, Row)>> {
    let there = Folder::open(folder).map_err(|why| fault(folder, &why))?;
    let mut found = Vec::new();
    for name in there.names("json").map_err(|why| fault(folder, &why))? {
        let text = there.read(&name, ROW).map_err(|why| fault(&folder.join(&name), &why))?;
        found.extend(rows(&text));
    }
    Ok(found)
}
