//! The element, models, scenes and their files.

extern crate plane_contact_problem as problem;

mod element;
mod first;
mod gmsh;
mod models;
mod scene_builder;
mod schema;
mod supports;
mod tree;
