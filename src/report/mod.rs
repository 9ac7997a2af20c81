//! Tables, pictures, files.

pub mod files;
pub mod json;
pub mod matrix_market;
mod summary;
pub mod tables;
