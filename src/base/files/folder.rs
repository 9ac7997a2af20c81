//! Folders of which the program itself finds the files: by names that stand in a file, or by looking.
//!
//! No name leads out of such a folder, be it absolute, by `..` or through a symbolic link, and only
//! ordinary files are opened: a pipe would wait, and a device would never end.

use std::fs::File;
use std::io;
use std::path::Path;

use cap_std::ambient_authority;
use cap_std::fs::{Dir, OpenOptions};

use super::read::read_up_to;

/// A folder that the user named.
#[derive(Debug)]
pub struct Folder(pub(super) Dir);

impl Folder {
    /// Opens the folder at `path`; the current one where that is empty.
    ///
    /// # Errors
    /// There is no folder, or it may not be read.
    pub fn open(path: &Path) -> io::Result<Self> {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        Dir::open_ambient_dir(path, ambient_authority()).map(Folder)
    }

    /// Opens an ordinary file, and returns its length too.
    ///
    /// # Errors
    /// The name leads out of the folder or to no ordinary file, or the file may not be read.
    pub fn file(&self, name: impl AsRef<Path>) -> io::Result<(File, u64)> {
        let file = self.0.open_with(name, &reading()).map_err(plain)?.into_std();
        let metadata = file.metadata()?;
        if metadata.is_file() { Ok((file, metadata.len())) } else { Err(no_ordinary_file()) }
    }

    /// Reads an ordinary file of up to `most` bytes.
    ///
    /// # Errors
    /// Those of [`Folder::file`], or the file is longer.
    pub fn read(&self, name: impl AsRef<Path>, most: u64) -> io::Result<Vec<u8>> {
        read_up_to(self.file(name)?.0, most)
    }

    /// Makes the folders that `name` leads through.
    pub(super) fn make_parent(&self, name: &str) -> io::Result<()> {
        match Path::new(name).parent().filter(|parent| *parent != Path::new("")) {
            Some(parent) => self.0.create_dir_all(parent).map_err(plain),
            None => Ok(()),
        }
    }

    /// Returns the names of the entries that end in `.extension`, sorted; a name that is no text is
    /// left out.
    ///
    /// # Errors
    /// The folder may not be read.
    pub fn names(&self, extension: &str) -> io::Result<Vec<String>> {
        let mut names = Vec::new();
        for entry in self.0.entries()? {
            let name = entry?.file_name().into_string();
            names.extend(name.ok().filter(|name| {
                Path::new(name).extension().is_some_and(|found| found == extension)
            }));
        }
        names.sort();
        Ok(names)
    }
}

/// Returns how a file is opened: without waiting for a pipe's other end.
fn reading() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    {
        use cap_std::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NONBLOCK.bits() as i32);
    }
    options
}

pub(super) fn no_ordinary_file() -> io::Error {
    io::Error::other("it is no ordinary file")
}

/// Returns whether a name was refused as it leads out of its folder: the system's own refusals have a
/// number.
pub(super) fn leads_out(why: &io::Error) -> bool {
    why.kind() == io::ErrorKind::PermissionDenied && why.raw_os_error().is_none()
}

/// Says of a name that leads out of the folder what it does.
pub(super) fn plain(why: io::Error) -> io::Error {
    if !leads_out(&why) {
        return why;
    }
    io::Error::new(why.kind(), "the name leads out of the folder")
}
