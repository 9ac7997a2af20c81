//! The reference: what the paper's listings compute, line by line.
//!
//! | module | what stands there |
//! |---|---|
//! | [`mirror`] | the two listings in Rust, in printed order, each line quoted above its own piece; their printed conditions, failures and worksheet, and the table of readings (R1 to R10) |
//! | [`listings`] | the listings as text, executed by the interpreter of Mathcad's notation |
//! | [`corrected`] | the corrected listings, with the loop around them, executed |
//! | [`edited`] | listings that a user edited, in place of the paper's |
//! | [`findings`] | the names of what the listings do and the text does not say |
//! | [`door`] | the only conversion between the model, which counts from 0, and the paper's tables, which count from 1 |
//!
//! Begin with [`mirror::c_cnt`] (fig. 2: the contact pairs) and [`mirror::Km`] (fig. 3: the stiffness
//! matrix). Text and mirror are equal to the last bit on random scenes, failures included.
#![forbid(unsafe_code)]

pub mod corrected;
pub mod door;
pub mod edited;
pub mod findings;
pub mod listings;
pub mod mirror;
