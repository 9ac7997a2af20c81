//! The list of the files that a folder has from the program, in the form of `sha256sum`: it tells
//! which of them a later run may remove, and `sha256sum --check` whether one was changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use sha2::{Digest, Sha256};

use super::folder::{Folder, leads_out, no_ordinary_file, plain};

/// The name of the list.
pub const MANIFEST: &str = "SHA256SUMS";

/// The most bytes of a list; that of an audit has 3,000.
const MOST: u64 = 1 << 20;

/// The most bytes of a file that is compared with its sum.
const MOST_OF_FILE: u64 = 1 << 32;

/// How a line begins that names the command whose files follow.
const COMMAND: &str = "# plane-contact ";

/// The sum of each file by its name, for each command that wrote to the folder.
#[derive(Clone, Debug, Default)]
pub(super) struct Manifest(BTreeMap<String, BTreeMap<String, String>>);

impl Manifest {
    /// Reads that of `folder`; an empty one where there is none, or where it is not exactly what this
    /// program writes: then it tells of no file.
    ///
    /// # Errors
    /// It is a list of the user's.
    pub(super) fn read(folder: &Folder) -> io::Result<Self> {
        let text = match folder.read(MANIFEST, MOST) {
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(Manifest::default()),
            text => text.map_err(|why| in_folder(MANIFEST, why))?,
        };
        if !text.starts_with(COMMAND.as_bytes()) {
            return Err(in_folder(MANIFEST, io::Error::other("it is no list of this program")));
        }
        let manifest = std::str::from_utf8(&text).ok().and_then(Manifest::parse);
        Ok(manifest.filter(|manifest| manifest.is_within(folder)).unwrap_or_default())
    }

    /// Returns whether no name leads out of `folder`, through a link.
    fn is_within(&self, folder: &Folder) -> bool {
        let mut names = self.0.values().flat_map(BTreeMap::keys);
        names.all(|name| !folder.0.symlink_metadata(name).is_err_and(|why| leads_out(&why)))
    }

    /// Reads a list; None where it is not what [`Manifest::text`] writes.
    fn parse(text: &str) -> Option<Self> {
        let mut manifest = Manifest::default();
        let mut names = BTreeSet::new();
        let mut files: Option<&mut BTreeMap<String, String>> = None;
        for line in text.lines() {
            if let Some(command) = line.strip_prefix(COMMAND) {
                files = Some(manifest.0.entry(command.into()).or_default());
            } else {
                let (sum, name) = line.split_once("  ")?;
                let is_file = is_sum(sum) && is_inside(name) && names.insert(name);
                is_file.then(|| files.as_mut()?.insert(name.into(), sum.into()))?;
            }
        }
        (manifest.text() == text).then_some(manifest)
    }

    /// Returns the names of a command's files.
    pub(super) fn names(&self, command: &str) -> BTreeSet<&str> {
        self.0.get(command).into_iter().flat_map(BTreeMap::keys).map(String::as_str).collect()
    }

    /// Returns whether the file `name` is in `folder`.
    ///
    /// # Errors
    /// What is there is not a file as the list has it.
    pub(super) fn has_unchanged(&self, folder: &Folder, name: &str) -> io::Result<bool> {
        let there = match folder.0.symlink_metadata(name).map_err(plain) {
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(false),
            there => there.map_err(|why| in_folder(name, why))?,
        };
        if there.is_dir() {
            let why = format!("{name} is a folder in it");
            return Err(io::Error::new(io::ErrorKind::IsADirectory, why));
        }
        if !there.is_file() {
            return Err(in_folder(name, no_ordinary_file()));
        }
        let Some(listed) = self.0.values().find_map(|files| files.get(name)) else {
            let why = format!("it is not from this program, as far as {MANIFEST} tells");
            return Err(in_folder(name, io::Error::other(why)));
        };
        let is_unchanged = folder.file(name).and_then(|(file, length)| {
            Ok(length <= MOST_OF_FILE && sum_of(file.take(length))? == *listed)
        });
        if is_unchanged.map_err(|why| in_folder(name, why))? {
            return Ok(true);
        }
        Err(in_folder(name, io::Error::other("it was changed since it was written")))
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

/// Returns the SHA-256 of what is read, as `sha256sum` prints it.
///
/// # Errors
/// It cannot be read to its end.
pub fn sum_of(mut content: impl Read) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut part = vec![0; 1 << 16];
    loop {
        match content.read(&mut part)? {
            0 => break,
            length => hash.update(&part[..length]),
        }
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

fn is_sum(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
}

/// Returns whether a name is that of a file in the folder or below, written in the one way.
fn is_inside(name: &str) -> bool {
    let path = Path::new(name);
    let is_plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    is_plain && path.components().collect::<PathBuf>().as_os_str() == name && name != MANIFEST
}

fn in_folder(name: &str, why: io::Error) -> io::Error {
    io::Error::new(why.kind(), format!("{name} is in the way: {why}"))
}
