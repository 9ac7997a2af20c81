//! Problems with a known solution, and the meshes that are generated for them.

#[path = "../common"]
mod common {
    pub mod annulus;
    pub mod conforming;
    pub mod fitted_hertz;
    pub mod golden_file;
    pub mod json;
    pub mod program;
    pub mod recovery;
    pub mod tolerances;
}

mod conforming;
mod cook;
mod delaunay;
mod grid;
mod hertz;
mod kirsch;
mod lame;
mod le1;
mod meshes;
mod patch;
mod punch;
mod punch_patch;
mod singular;
mod strand;
mod table;
