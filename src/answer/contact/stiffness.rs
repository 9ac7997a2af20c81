//! Stiffness without contact and without restraints, triangle by triangle: what `Km` would add up in a dense matrix.

use nalgebra::{DVector, SMatrix, SVector};

use super::elimination::Elimination;
use crate::numbers::scalar::Scalar;
use crate::numbers::solve::SparseSymmetric;
use crate::paper::mirror::Worksheet;
use crate::problem::element::D;

/// The stiffness matrix K, 2R x 2R, force/length, kept as its triangles' matrices.
pub struct Stiffness<T = f64> {
    equations: usize,
    triangles: Vec<Triangle<T>>,
}

/// One triangle: its six equations, counted from 0, and Ae·Bᵀ·D·B, force/length.
struct Triangle<T> {
    equations: [usize; 6],
    k: SMatrix<T, 6, 6>,
}

impl<T: Scalar> Stiffness<T> {
    /// The stiffness of every triangle.
    pub fn new(sheet: &Worksheet<T>) -> Self {
        let triangle = |n: usize| {
            let b = &sheet.B[n];
            let node = |k: usize| sheet.EL[(n, sheet.ind_1 + k)];
            Triangle {
                equations: std::array::from_fn(|k| 2 * node(k / 2) - 2 + k % 2),
                k: b.transpose() * D(sheet.plane, sheet.E[n], sheet.nu[n]) * b * sheet.Ae[n],
            }
        };
        Stiffness { equations: 2 * sheet.R(), triangles: (1..=sheet.M()).map(triangle).collect() }
    }

    /// K u: the forces that hold the shape `u`.
    pub fn times(&self, u: &DVector<T>) -> DVector<T> {
        let mut force = DVector::from_element(self.equations, T::zero());
        let (u, common) = T::over_common(u.as_slice().to_vec());
        let u = DVector::from_vec(u);
        for triangle in &self.triangles {
            let product = triangle.k * triangle.displacements(&u);
            for (e, value) in triangle.equations.into_iter().zip(product.iter()) {
                force[e] += *value;
            }
        }
        force.map(|f| f / common)
    }

    /// Tᵀ K T.
    pub fn reduced(&self, t: &Elimination<T>) -> SparseSymmetric<T> {
        let entries = self.triangles.iter().flat_map(|triangle| triangle.reduced(t));
        SparseSymmetric::new(t.size(), entries)
    }
}

impl Stiffness {
    /// sqrt(uᵀ K u): the energy norm, (force · length)^½. Summed by triangle, so that nothing negative is left of a cancellation.
    pub fn energy_norm(&self, u: &DVector<f64>) -> f64 {
        let of_triangle = |triangle: &Triangle<f64>| {
            let u = triangle.displacements(u);
            u.dot(&(triangle.k * u)).max(0.0)
        };
        self.triangles.iter().map(of_triangle).sum::<f64>().sqrt()
    }
}

impl<T: Scalar> Triangle<T> {
    /// What it adds to the lower triangle of Tᵀ K T: row, column, value.
    fn reduced(&self, t: &Elimination<T>) -> Vec<(usize, usize, T)> {
        let mut entries = Vec::with_capacity(36);
        for (i, p) in self.equations.into_iter().enumerate() {
            for (j, q) in self.equations.into_iter().enumerate() {
                for &(row, wr) in t.row(p) {
                    for &(column, wc) in t.row(q).iter().filter(|(column, _)| *column <= row) {
                        entries.push((row, column, wr * self.k[(i, j)] * wc));
                    }
                }
            }
        }
        entries
    }

    fn displacements(&self, u: &DVector<T>) -> SVector<T, 6> {
        SVector::from_fn(|k, _| u[self.equations[k]])
    }
}
