//! The stiffness without contact and restraints, by triangle, which `Km` adds up in a matrix.

use nalgebra::{DVector, SMatrix, SVector};

use super::elimination::Elimination;
use crate::numbers::scalar::Scalar;
use crate::numbers::solve::SparseSymmetric;
use crate::problem::element::{self, D, Plane, State};
use crate::problem::model::{Dof, Model, TriangleId};

/// The stiffness matrix K, 2R x 2R, force/length, stored as its triangles' matrices, from which
/// stresses are computed too.
pub struct Stiffness<T = f64> {
    plane: Plane,
    dofs: usize,
    triangles: Vec<Element<T>>,
}

/// One triangle in the numbers of a run.
struct Element<T> {
    /// The degrees of freedom of its corners: x, y of each corner in turn.
    dofs: [Dof; 6],
    /// The elastic modulus, stress.
    e: T,
    nu: T,
    /// The strain matrix, 1/length.
    b: SMatrix<T, 3, 6>,
    /// The stiffness Ae·Bᵀ·D·B, force/length.
    k: SMatrix<T, 6, 6>,
}

impl<T: Scalar> Stiffness<T> {
    /// Computes the stiffness of every triangle in T from numbers that pass through `number`.
    pub fn new(model: &Model, number: impl Fn(f64) -> T) -> Self {
        let triangle = |id: TriangleId| {
            let material = model.triangle(id).material;
            let (e, nu) = (number(material.e), number(material.nu));
            let corners = model.corners(id).map(|p| p.map(&number));
            let b = element::B(&corners);
            let volume = element::area(&corners) * number(model.thickness);
            let nodes = model.triangle(id).nodes;
            Element {
                dofs: std::array::from_fn(|k| nodes[k / 2].dofs()[k % 2]),
                k: element::stiffness(&b, &D(model.plane, e, nu)) * volume,
                e,
                nu,
                b,
            }
        };
        let triangles = model.triangle_ids().map(triangle).collect();
        Stiffness { plane: model.plane, dofs: model.dofs(), triangles }
    }

    /// Returns K u, the forces that keep the shape `u`, force.
    pub fn times(&self, u: &DVector<T>) -> DVector<T> {
        let mut force = DVector::from_element(self.dofs, T::zero());
        let (u, common) = T::over_common(u.as_slice().to_vec());
        let u = DVector::from_vec(u);
        self.triangles.iter().for_each(|triangle| triangle.add_times(&u, &mut force));
        force.map(|f| f / common)
    }

    /// Returns the part of K u on the `wanted` degrees of freedom, force, the same to the bit; other
    /// entries hold parts of theirs.
    pub fn times_on(&self, wanted: &[bool], u: &DVector<T>) -> DVector<T> {
        let mut force = DVector::from_element(self.dofs, T::zero());
        let is_wanted =
            |triangle: &&Element<T>| triangle.dofs.iter().any(|dof| wanted[dof.index()]);
        for triangle in self.triangles.iter().filter(is_wanted) {
            triangle.add_times(u, &mut force);
        }
        force
    }

    /// Returns Tᵀ K T, force/length.
    pub fn reduced(&self, t: &Elimination<T>) -> SparseSymmetric<T> {
        let entries = self.triangles.iter().flat_map(|triangle| triangle.reduced(t));
        SparseSymmetric::new(t.size(), entries)
    }

    /// Returns the stresses and strains of every triangle under displacements `u`.
    pub fn states(&self, u: &DVector<T>) -> Vec<State> {
        let state = |t: &Element<T>| State::new(self.plane, t.e, t.nu, &t.b, &t.displacements(u));
        self.triangles.iter().map(state).collect()
    }

    /// Returns sigma_x, sigma_y, tau_xy of every triangle under displacements `u`, stress.
    pub fn stresses(&self, u: &DVector<T>) -> Vec<SVector<T, 3>> {
        let stress = |t: &Element<T>| D(self.plane, t.e, t.nu) * (t.b * t.displacements(u));
        self.triangles.iter().map(stress).collect()
    }
}

impl Stiffness {
    /// Returns the energy norm sqrt(uᵀ K u), sqrt(force·length). It is summed by triangle, so that
    /// no cancellation leaves a negative number.
    pub fn energy_norm(&self, u: &DVector<f64>) -> f64 {
        let of_triangle = |triangle: &Element<f64>| {
            let u = triangle.displacements(u);
            u.dot(&(triangle.k * u)).max(0.0)
        };
        self.triangles.iter().map(of_triangle).sum::<f64>().sqrt()
    }
}

impl<T: Scalar> Element<T> {
    /// Returns the entries that it adds to the lower triangle of Tᵀ K T: row, column, value.
    fn reduced(&self, t: &Elimination<T>) -> Vec<(usize, usize, T)> {
        let mut entries = Vec::with_capacity(36);
        for (i, p) in self.dofs.into_iter().enumerate() {
            for (j, q) in self.dofs.into_iter().enumerate() {
                for &(row, wr) in t.row(p) {
                    for &(column, wc) in t.row(q).iter().filter(|(column, _)| *column <= row) {
                        entries.push((row, column, wr * self.k[(i, j)] * wc));
                    }
                }
            }
        }
        entries
    }

    /// Adds its part of K u.
    fn add_times(&self, u: &DVector<T>, force: &mut DVector<T>) {
        let product = self.k * self.displacements(u);
        for (dof, value) in self.dofs.into_iter().zip(product.iter()) {
            force[dof.index()] += *value;
        }
    }

    fn displacements(&self, u: &DVector<T>) -> SVector<T, 6> {
        SVector::from_fn(|k, _| u[self.dofs[k].index()])
    }
}
