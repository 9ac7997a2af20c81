//! Scalars beside exact rational numbers, and the largest of several values.

extern crate plane_contact_numbers as numbers;

mod arithmetic;
mod largest;
