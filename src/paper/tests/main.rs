//! The reference: listing = mirror, quotes, and the listings worked out by hand.

extern crate plane_contact_paper as paper;

mod bitwise;
mod corrected;
mod listings;
mod quotes;
mod scalars;
