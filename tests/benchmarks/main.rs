//! Problems with a known solution, and the meshes that are generated for them.

#[path = "../common"]
mod common {
    pub use testing::{annulus, page, tolerances};

    pub mod conforming;
    pub mod fitted_hertz;
    pub mod outcome;
    pub mod program;
    pub mod recovery;
}

mod conforming;
mod cook;
mod delaunay;
mod discretisation;
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
