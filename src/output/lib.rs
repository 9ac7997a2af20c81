//! What a run leaves: tables for people, pictures for the eye, files for machines.
//!
//! Reports print and draw what [`engine`] found, and
//! solve nothing. The same input gives the same bytes: no clock, no hash order and no machine is in
//! them, but for the times and the memory that `trade` measures.
//!
//! | module                                             | what it writes                         |
//! |----------------------------------------------------|----------------------------------------|
//! | `tables`, `folder`, `result_file`, `pressure`      | a run: tables, folder, `result.json`   |
//! | `quantities`                                       | columns and arrays of quantities       |
//! | `plan`                                             | what a run will take                   |
//! | `picture`, `vtu`                                   | pictures and files for viewers         |
//! | `page`                                             | pages of HTML, each one file           |
//! | `evaluation`, `failure`, `json`                    | JSON, and what is in it                |
//! | `matrix_market`                                    | a matrix as a file                     |
//! | `worksheet`                                        | a worksheet of Mathcad, compared       |
//! | `edited`                                           | edited listings                        |
//! | `model`; `text`, `csv`, `markdown`, `html`         | reports of tables, and their renderings |
//! | `layout`, `numbers`                                | lists of words, numbers as text        |
#![forbid(unsafe_code)]

mod csv;
pub mod edited;
pub mod evaluation;
pub mod exports;
pub mod failure;
pub mod folder;
pub mod html;
pub mod json;
pub mod layout;
pub mod markdown;
pub mod matrix_market;
pub mod model;
pub mod numbers;
pub mod page;
pub mod picture;
pub mod plan;
pub mod pressure;
pub mod quantities;
mod result_file;
pub mod tables;
pub mod text;
pub mod vtu;
pub mod worksheet;

pub use result_file::{ElementRow, MOST_TRIANGLES, ResultFile};
