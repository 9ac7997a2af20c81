//! What a run takes: operations and bytes.
//!
//! Counted: operations of the factorisations, numbers in the matrices. Measured, on meshes of 13 to 15,045 nodes, and stated as constants: what a
//! node, a triangle, an entry takes besides.

use serde::Serialize;

use super::candidates::Candidates;
use crate::answer::Request;
use crate::numbers::solve::{FactorSize, ScalarName};
use crate::problem::model::Model;
use crate::problem::modelling::{Coupling, Friction, Variant};

/// What is to be done.
pub struct Work<'a> {
    /// What is asked for.
    pub request: &'a Request,
    /// The model.
    pub model: &'a Model,
    /// Dense matrices held at once.
    pub dense: usize,
    /// One factorisation of the run.
    pub factors: FactorSize,
    /// One factorisation of a sparse matrix of the same equations: of the run itself where `dense` is 0, and of the converged answer.
    pub sparse: FactorSize,
    /// The contact; none where the scene has none.
    pub candidates: Option<&'a Candidates>,
}

/// What a run takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Dense 2R x 2R matrices of `f64` that are held at once: what is compared with the memory that is free.
    pub dense_matrices: usize,
    /// Contact states that are likely to be met: each is factored once.
    pub states: usize,
    /// The same for the converged answer that `solve` measures the run against; 0 where it runs nothing more.
    pub reference_states: usize,
    /// Additions and multiplications of all factorisations.
    pub operations: f64,
    /// Peak memory of the process.
    pub bytes: Bytes,
}

/// Peak memory of the process, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bytes {
    /// The program itself.
    pub program: f64,
    /// Mesh, worksheet, results and files.
    pub mesh: f64,
    /// Matrices and factors.
    pub matrices: f64,
    /// What is kept of each iteration.
    pub iterations: f64,
}

impl Bytes {
    /// All.
    pub fn total(&self) -> f64 {
        self.program + self.mesh + self.matrices + self.iterations
    }
}

/// Bytes, measured.
mod bytes {
    /// The program's pages and the allocator's first ones.
    pub const PROGRAM: f64 = 14.5e6;
    /// A triangle and its share of the nodes: worksheet, strain matrix, stiffness, states, sparse matrix, pictures.
    pub const TRIANGLE: f64 = 3700.0;
    /// What is freed and not given back at once, a triangle; and at most. Without contact, and with it.
    pub const FREED: [[f64; 2]; 2] = [[12e3, 17e6], [25e3, 13e6]];
    /// A node in an iteration that is kept: shape, k_cnt, what its solution keeps.
    pub const KEPT: f64 = 160.0;
    /// An entry of the printed matrix while its error bar is found: the matrix with a bound on each entry, its values, their factors.
    pub const PRINTED_BAR: f64 = 43.0;
    /// A number of sparse factors: its value, and its share of a row's number.
    pub const FACTOR: f64 = 10.0;
}

/// Contact states that a run is likely to meet.
mod states {
    /// Measured on `strand`: printed, stepped, tied, unilateral where nodes stick.
    pub const PRINTED: usize = 3;
    pub const STEPPED: usize = 5;
    pub const TIED: usize = 8;
    pub const STICKING: usize = 3;
    /// Measured on Hertz's contact with 5 to 59 elements on the half width: where nodes slide, one more for each so many that do not touch yet.
    pub const NODES: usize = 2;
}

impl Work<'_> {
    /// What the run takes, with what `solve` adds: files, and the converged answer where there is contact and the run is not itself that.
    pub fn cost(&self) -> Cost {
        Cost {
            dense_matrices: self.dense * self.width(),
            states: self.states(),
            reference_states: self.reference_states(),
            operations: self.states() as f64 * self.factors.operations
                + self.reference_states() as f64 * self.sparse.operations,
            bytes: self.bytes(),
        }
    }

    fn states(&self) -> usize {
        let most = match self.request.variant {
            Variant::Unilateral => return self.converging(),
            Variant::Printed => states::PRINTED,
            Variant::Stepped => states::STEPPED,
            Variant::Tied => states::TIED,
        };
        if self.settled() { 1 } else { most.min(self.request.iterations) }
    }

    /// Iterations that the converged answer takes.
    fn converging(&self) -> usize {
        match (self.candidates, self.request.contact.friction) {
            (Some(found), Friction::None) => 1 + (found.near - found.touching) / states::NODES,
            _ if self.settled() => 1,
            _ => states::STICKING,
        }
    }

    /// Whether every node that can meet an edge touches one already: there is no contact, or the first state is likely the last.
    fn settled(&self) -> bool {
        self.candidates.is_none_or(|found| found.near == found.touching)
    }

    fn reference_states(&self) -> usize {
        let same = self.request.variant == Variant::Unilateral
            && self.request.contact.coupling == Coupling::Mortar;
        if self.candidates.is_none() || same { 0 } else { self.converging() }
    }

    /// Iterations of which something is kept.
    fn kept(&self) -> usize {
        let own = match self.request.variant {
            Variant::Unilateral => self.states(),
            _ => self.request.iterations,
        };
        own + self.reference_states()
    }

    /// Size of a number, in units of an `f64`.
    fn width(&self) -> usize {
        match self.request.arithmetic.scalar {
            ScalarName::F32 | ScalarName::F64 => 1,
            _ => 2,
        }
    }

    fn bytes(&self) -> Bytes {
        let (r, m) = (self.model.nodes.len() as f64, self.model.triangles.len() as f64);
        let [each, most] = bytes::FREED[usize::from(self.candidates.is_some())];
        let freed = (each * m).min(most);
        Bytes {
            program: bytes::PROGRAM,
            mesh: bytes::TRIANGLE * m + freed,
            matrices: self.dense_bytes() + bytes::FACTOR * self.sparse.nonzeros as f64,
            iterations: bytes::KEPT * r * self.kept() as f64,
        }
    }

    /// K is 2R x 2R, the others have the equations that are solved.
    fn dense_bytes(&self) -> f64 {
        let size = match self.request.arithmetic.scalar {
            ScalarName::F32 => 4.0,
            ScalarName::F64 => 8.0,
            _ => 16.0,
        };
        let square = |n: usize| size * (n as f64).powi(2);
        let (all, solved) = (2 * self.model.nodes.len(), self.factors.equations);
        match (self.dense, self.request.variant) {
            (0, _) => 0.0,
            (matrices, Variant::Printed) => {
                (matrices as f64 * square(all)).max(bytes::PRINTED_BAR * (all as f64).powi(2))
            }
            (matrices, _) => square(all) + (matrices - 1) as f64 * square(solved),
        }
    }
}
