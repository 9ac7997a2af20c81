//! Temporary folders, which vanish with their process: at its end, where a signal ends it, and, where
//! it was killed, as soon as another process writes beside them.
//!
//! Each is locked as long as its process lives. Whoever finds one without a lock may remove it.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::Builder;

use super::folder::Folder;

/// How the name of everything temporary begins.
const PREFIX: &str = ".plane-contact-staged-";

/// How often a folder is emptied in which another thread or a program is still writing.
const TRIES: usize = 100;

/// The temporary folders of this process.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Returns the list of the temporary folders; who holds it is not disturbed by a signal, and must do
/// nothing that may wait.
pub(super) fn registry() -> MutexGuard<'static, Vec<PathBuf>> {
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is temporary and does `last`, which ends the process.
pub fn abandon(last: impl FnOnce()) {
    let mut folders = registry();
    folders.drain(..).for_each(|folder| remove(&folder));
    last();
}

/// A temporary folder.
#[derive(Debug)]
pub struct Staged {
    path: PathBuf,
    folder: Folder,
    /// What says that the process lives.
    _alive: Option<File>,
}

impl Staged {
    /// Makes a temporary folder in `home`, and removes there what killed processes left.
    ///
    /// # Errors
    /// `home` is missing or cannot be written.
    pub fn new(home: &Path) -> io::Result<Self> {
        let _alone = locked(home);
        remove_left(home);
        let path = make(home)?;
        let folder = Folder::open(&path)?;
        Ok(Staged { _alive: locked(&path), path, folder })
    }

    /// Returns where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the folder. Once a signal has removed it, nothing can be written to it.
    pub fn folder(&self) -> &Folder {
        &self.folder
    }

    /// Writes a file in it, and makes the folders that `name` leads through.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> io::Result<()> {
        self.folder.make_parent(name)?;
        self.folder.0.write(name, content)
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        remove(&self.path);
        registry().retain(|folder| *folder != self.path);
    }
}

/// Makes a temporary folder in `home`, with the permissions and the errors of other folders: those that
/// tempfile makes are the owner's alone, and its errors hold names that no two runs share.
fn make(home: &Path) -> io::Result<PathBuf> {
    let mut folders = registry();
    let made = Builder::new().prefix(PREFIX).make_in(home, |path| std::fs::create_dir(path))?;
    let path = made.into_temp_path().keep()?;
    folders.push(path.clone());
    Ok(path)
}

/// Waits for the lock of a folder; None where it has none.
pub(super) fn locked(folder: &Path) -> Option<File> {
    File::open(folder).and_then(|file| file.lock().map(|()| file)).ok()
}

/// Removes from `home` the temporary folders that belong to no process.
fn remove_left(home: &Path) {
    for entry in std::fs::read_dir(home).into_iter().flatten().flatten() {
        let is_staged = entry.file_name().to_string_lossy().starts_with(PREFIX)
            && entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_staged && File::open(entry.path()).is_ok_and(|folder| folder.try_lock().is_ok()) {
            remove(&entry.path());
        }
    }
}

fn remove(folder: &Path) {
    for _ in 0..TRIES {
        match std::fs::remove_dir_all(folder) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => {}
            _ => return,
        }
    }
}
