//! What a run leaves: tables for people, pictures for the eye, files for machines.
//!
//! Reports print and draw what [`engine`] and [`studies`] found, and
//! solve nothing. The same input gives the same bytes: no clock, no hash order and no machine is in
//! them, but for the times and the memory that `trade` measures.
//!
//! | module                                             | what it writes                         |
//! |----------------------------------------------------|----------------------------------------|
//! | `tables`, `folder`, `result_file`, `pressure`      | a run: tables, folder, `result.json`   |
//! | `quantities`                                       | columns and arrays of quantities       |
//! | `audit`, `claims`, `conclusion`, `prices`          | the audit                              |
//! | `document`, `glossary`                             | the audit report that is handed in     |
//! | `comparison`, `extremes`, `plan`                   | a study each                           |
//! | `snapshot`, `trade`                                | a study each                           |
//! | `picture`, `vtu`                                   | pictures and files for viewers         |
//! | `page`                                             | pages of HTML, each one file           |
//! | `evaluation`, `failure`, `json`                    | JSON, and what is in it                |
//! | `matrix_market`, `output`                          | other files                            |
//! | `sweep`                                            | job files of engines, table of results |
//! | `worksheet`                                        | a worksheet of Mathcad, compared       |
//! | `edited`, `scenes`                                 | edited listings, scenes that are there |
//! | `model`; `text`, `csv`, `markdown`, `html`         | reports of tables, and their renderings |
//! | `layout`, `numbers`                                | lists of words, numbers as text        |
//! | `language`                                         | the lesson's words in Russian          |
#![forbid(unsafe_code)]

pub mod audit;
pub mod claims;
pub mod comparison;
pub mod conclusion;
mod csv;
pub mod document;
pub mod edited;
pub mod evaluation;
pub mod exports;
pub mod extremes;
pub mod failure;
pub mod folder;
mod glossary;
mod html;
pub mod json;
pub mod language;
mod layout;
mod markdown;
pub mod matrix_market;
pub mod model;
pub mod numbers;
pub mod page;
pub mod picture;
pub mod plan;
pub mod pressure;
pub mod prices;
pub mod quantities;
mod result_file;
pub mod scenes;
pub mod snapshot;
pub mod sweep;
pub mod tables;
pub mod text;
pub mod trade;
pub mod vtu;
pub mod worksheet;

pub use result_file::{ElementRow, MOST_TRIANGLES, ResultFile};
