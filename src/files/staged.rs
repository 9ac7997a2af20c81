//! Temporary files and folders, which vanish with their process: at its end, where a signal ends
//! it, and, where it was killed, as soon as another process writes beside them.
//!
//! Each is locked as long as its process lives. Whoever finds one without a lock may remove it.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// How the name of everything temporary begins.
const PREFIX: &str = ".plane-contact-staged-";

/// The temporary folders of this process.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Returns the list of the temporary folders; who holds it is not disturbed by a signal.
pub(super) fn registry() -> MutexGuard<'static, Vec<PathBuf>> {
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is temporary and does `last`, while nothing is being written.
pub fn abandon(last: impl FnOnce()) {
    let mut folders = registry();
    for folder in folders.drain(..) {
        let _ = std::fs::remove_dir_all(folder);
    }
    last();
}

/// A temporary folder.
#[derive(Debug)]
pub struct Staged {
    path: PathBuf,
    /// What says that the process lives.
    _alive: Option<File>,
}

impl Staged {
    /// Makes a temporary folder in `home`, and removes there what killed processes left.
    ///
    /// # Errors
    /// `home` is missing or cannot be written.
    pub fn new(home: &Path) -> io::Result<Self> {
        let mut folders = registry();
        let _alone = locked(home);
        remove_left(home);
        let path = make(home, |path| std::fs::create_dir(path))?.into_temp_path().keep()?;
        folders.push(path.clone());
        Ok(Staged { _alive: locked(&path), path })
    }

    /// Returns where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        let mut folders = registry();
        folders.retain(|folder| *folder != self.path);
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

/// Makes a temporary file in `home`, and removes there what killed processes left.
pub(super) fn file(home: &Path) -> io::Result<NamedTempFile> {
    let _alone = locked(home);
    remove_left(home);
    let file = make(home, |path| File::create_new(path))?;
    // Where files cannot be locked, nothing is removed that was left.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Waits for the lock of a folder; None where it has none.
pub(super) fn locked(folder: &Path) -> Option<File> {
    File::open(folder).and_then(|file| file.lock().map(|()| file)).ok()
}

/// Removes from `home` what is temporary and belongs to no process.
fn remove_left(home: &Path) {
    let entries = std::fs::read_dir(home).into_iter().flatten().flatten();
    for entry in entries.filter(|e| e.file_name().to_string_lossy().starts_with(PREFIX)) {
        let path = entry.path();
        if File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = match path.is_dir() {
                true => std::fs::remove_dir_all(path),
                false => std::fs::remove_file(path),
            };
        }
    }
}

/// Makes what is temporary in `home`, with the permissions and the errors of other files and
/// folders: those that tempfile makes are the owner's alone, and its errors hold names that no two
/// runs share.
fn make<T>(home: &Path, new: impl Fn(&Path) -> io::Result<T>) -> io::Result<NamedTempFile<T>> {
    Builder::new().prefix(PREFIX).make_in(home, new)
}
