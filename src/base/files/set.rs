//! The files of a run in a folder appear all at once, in place of those of an earlier run.
//!
//! They are written to a temporary folder. It takes the place of the old one where that holds
//! nothing but files of the same command, which [`MANIFEST`] lists; that is one step of
//! the file system. Where the folder holds anything else, or cannot be moved, the files are moved
//! into it one by one, and the old run's are removed; the list is missing meanwhile. A folder in which
//! a file would be lost that the user changed or put there is refused.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use super::folder::Folder;
use super::manifest::{MANIFEST, Manifest, sum_of};
use super::staged::{Staged, locked, registry};
use super::write::folder_of;
use crate::error::{InputError, Result};

/// Writes files of `command`, by their names in `folder`, all or none, and removes those that an
/// earlier run of the same command left there.
///
/// # Errors
/// Those of [`check_folder`], or a file cannot be written; what was there stays as it was.
pub fn write_all<N: AsRef<str>, C: AsRef<[u8]>>(
    folder: &Path,
    command: &str,
    files: &[(N, C)],
) -> Result<()> {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(n, c)| (n.as_ref(), c.as_ref())).collect();
    write(folder, command, &files).map_err(|why| unwritable(folder, &why))
}

/// Checks that files of `command` can be written to a folder, before they are computed; `names` are
/// those that are known already.
///
/// # Errors
/// Says which file is in place of the folder, or is in it and would be lost: one of `names` that is not
/// from this program, or one of the command's that was changed since.
pub fn check_folder(folder: &Path, command: &str, names: &[&str]) -> Result<(), InputError> {
    let checked = no_file(folder).and_then(|()| {
        if !folder.exists() {
            return Ok(());
        }
        let there = Folder::open(folder)?;
        old_files(&there, &Manifest::read(&there)?, command, names).map(drop)
    });
    checked.map_err(|why| unwritable(folder, &why))
}

fn unwritable(folder: &Path, why: &io::Error) -> InputError {
    let what = format!("the folder cannot be written: {why}");
    let fix = "choose another place, or move what is in the way";
    InputError::new(folder.display().to_string(), what, fix)
}

fn no_file(folder: &Path) -> io::Result<()> {
    let Some(file) = folder.ancestors().find(|there| there.exists() && !there.is_dir()) else {
        return Ok(());
    };
    let why = format!("{} is a file", file.display());
    Err(io::Error::new(io::ErrorKind::NotADirectory, why))
}

/// Returns the files of an earlier run of `command` in `folder`, which may be removed.
///
/// # Errors
/// Says which of them, or of `names`, would be lost with what the user did to it.
fn old_files(
    folder: &Folder,
    manifest: &Manifest,
    command: &str,
    names: &[&str],
) -> io::Result<BTreeSet<String>> {
    for name in names {
        manifest.has_unchanged(folder, name)?;
    }
    let mut old = BTreeSet::new();
    for name in manifest.names(command) {
        if manifest.has_unchanged(folder, name)? {
            old.insert(name.to_string());
        }
    }
    Ok(old)
}

fn write(folder: &Path, command: &str, files: &[(&str, &[u8])]) -> io::Result<()> {
    no_file(folder)?;
    let path = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.into());
    let home = folder_of(&path);
    std::fs::create_dir_all(home)?;
    // A folder can be writable where the one above is not, and on a file system of its own.
    let is_within = path.exists() && !is_on_one_device(home, &path);
    let staged = match Staged::new(if is_within { &path } else { home }) {
        Err(_) if path.exists() => Staged::new(&path)?,
        staged => staged?,
    };
    // Before anything is locked: who waits for other threads may begin another run's writing.
    let sum = |(name, content): &(&str, &[u8])| {
        (name.to_string(), sum_of(*content).expect("memory can be read"))
    };
    let sums = files.iter().map(sum).collect();
    files.iter().try_for_each(|(name, content)| staged.write(name, content))?;
    // Runs into the same folder take turns.
    let _alone = locked(home);
    if !path.exists() {
        let mut manifest = Manifest::default();
        manifest.set(command, sums);
        staged.write(MANIFEST, manifest.text())?;
        let _undisturbed = registry();
        return std::fs::rename(staged.path(), &path);
    }
    let there = Folder::open(&path)?;
    let mut manifest = Manifest::read(&there)?;
    let new: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let old = old_files(&there, &manifest, command, &new)?;
    manifest.set(command, sums);
    staged.write(MANIFEST, manifest.text())?;
    let is_replaced = !is_current(&path) && has_only(&there, Path::new("."), &old)?;
    let _undisturbed = registry();
    if is_replaced && exchange(staged.path(), &path).is_ok() {
        return Ok(());
    }
    one_by_one(staged.folder(), &there, &old, &new)
}

/// Returns whether the process works in `folder`, which then cannot be another one of the same
/// name.
fn is_current(folder: &Path) -> bool {
    std::env::current_dir().is_ok_and(|current| current.starts_with(folder))
}

/// Returns whether the folder `within` of `folder` holds nothing but the list and the files `old`.
fn has_only(folder: &Folder, within: &Path, old: &BTreeSet<String>) -> io::Result<bool> {
    for entry in folder.0.read_dir(within)? {
        let entry = entry?;
        let path: PathBuf = within.join(entry.file_name());
        let name = path.strip_prefix(".").expect("it begins in the folder");
        let is_old = if entry.file_type()?.is_dir() {
            old.iter().any(|file| Path::new(file).starts_with(name))
                && has_only(folder, &path, old)?
        } else {
            name == Path::new(MANIFEST) || name.to_str().is_some_and(|name| old.contains(name))
        };
        if !is_old {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Moves the files `new` and the list from `staged` into `folder`, and removes those of `old` that
/// are not new.
fn one_by_one(
    staged: &Folder,
    folder: &Folder,
    old: &BTreeSet<String>,
    new: &[&str],
) -> io::Result<()> {
    match folder.0.remove_file(MANIFEST) {
        Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
        _ => {}
    }
    for name in new {
        folder.make_parent(name)?;
        staged.0.rename(name, &folder.0, name)?;
    }
    for name in old.iter().filter(|name| !new.contains(&name.as_str())) {
        folder.0.remove_file(name)?;
        if let Some(parent) = Path::new(name).parent().filter(|parent| *parent != Path::new("")) {
            // It goes where it is empty.
            let _ = folder.0.remove_dir(parent);
        }
    }
    staged.0.rename(MANIFEST, &folder.0, MANIFEST)
}

/// Lets two folders take each other's place, and gives `new` the permissions of `old`.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(new: &Path, old: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    std::fs::set_permissions(new, std::fs::metadata(old)?.permissions())?;
    Ok(renameat_with(CWD, new, CWD, old, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Returns whether what is in `home` can be moved into `folder`.
#[cfg(unix)]
fn is_on_one_device(home: &Path, folder: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| std::fs::metadata(path).map(|there| there.dev()).ok();
    device(home) == device(folder)
}

#[cfg(not(unix))]
fn is_on_one_device(_: &Path, _: &Path) -> bool {
    true
}
