//! Files are read up to a limit, as a device would never end, and written beside their target and
//! then renamed, so that no file is ever half written. There is one way in and one way out: no run
//! writes over what it reads.

pub mod json;
mod kind;
mod read;
mod write;

pub use kind::{fields, is_json, kind_of};
pub use read::{
    MOST, from_folder_of, names, read, read_from, read_in, read_most, read_near, text, utf8,
};
pub use write::{
    DECK, HTML, JUNIT, MARKDOWN, PER_CENT, WORKSHEET, abandon, check_file, check_folder, check_new,
    is_same_place, rewrite, temporary_folder, write, write_all, write_new,
};
