//! Files are read up to a limit, as a device would never end, and written beside their target and
//! then renamed, so that no file is ever half written; those of a folder all at once.

mod folder;
pub mod json;
mod manifest;
mod read;
mod set;
mod staged;
mod write;

pub use folder::Folder;
pub use manifest::{MANIFEST, sum_of};
pub use read::{MOST, read, read_from, read_text, read_up_to, text};
pub use set::{check_folder, write_all};
pub use staged::{Staged, abandon};
pub use write::{check_file, write, write_new};
