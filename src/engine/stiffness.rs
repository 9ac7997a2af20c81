//! The stiffness without contact and restraints, by triangle, which `Km` adds up in a matrix.

use nalgebra::{DVector, SMatrix, SVector};

use super::elimination::Elimination;
use crate::linear::{Pattern, SparseSymmetric};
use numbers::scalar::Scalar;
use problem::element::{self, D, Plane, State};
use problem::model::{Dof, Model, NodeId, TriangleId};

/// The stiffness matrix K, 2R x 2R, force/length, as what its triangles' matrices, and their stresses,
/// are computed from.
pub struct Stiffness<T = f64> {
    plane: Plane,
    dofs: usize,
    materials: Vec<Elastic<T>>,
    triangles: Vec<Element<T>>,
    /// The stiffness of the springs on which each node of a triangle stands, over the mean diagonal entry
    /// of its matrix.
    pub(super) springs: T,
}

/// A material in the numbers of a run.
struct Elastic<T> {
    /// The elastic modulus, stress.
    e: T,
    nu: T,
    /// Stress over strain, stress.
    d: SMatrix<T, 3, 3>,
}

/// One triangle in the numbers of a run.
struct Element<T> {
    nodes: [NodeId; 3],
    /// Its place in [`Stiffness::materials`].
    material: u32,
    /// What the strain matrix is made of, 1/length.
    gradients: [[T; 2]; 3],
    /// The area times the thickness, length³.
    volume: T,
}

impl<T: Scalar> Stiffness<T> {
    /// Computes the stiffness of every triangle in T from numbers that pass through `number`.
    pub fn new(model: &Model, number: impl Fn(f64) -> T) -> Self {
        // One for each run of triangles of the same material.
        let mut materials = Vec::new();
        let mut last = None;
        let triangle = |id: TriangleId| {
            let material = model.triangle(id).material;
            if last != Some(material) {
                let [e, nu] = [material.e, material.nu].map(&number);
                materials.push(Elastic { e, nu, d: D(model.plane, e, nu) });
                last = Some(material);
            }
            let corners = model.corners(id).map(|p| p.map(&number));
            Element {
                nodes: model.triangle(id).nodes,
                material: materials.len() as u32 - 1,
                gradients: element::gradients(&corners),
                volume: element::area(&corners) * number(model.thickness),
            }
        };
        let triangles: Vec<Element<T>> = model.triangle_ids().map(triangle).collect();
        let (plane, dofs) = (model.plane, model.dofs());
        Stiffness { plane, dofs, materials, triangles, springs: T::zero() }
    }

    /// Returns the matrix Ae·Bᵀ·D·B of a triangle, force/length, with its springs.
    fn matrix(&self, triangle: &Element<T>) -> SMatrix<T, 6, 6> {
        let d = &self.materials[triangle.material as usize].d;
        let own = element::stiffness(&triangle.strain(), d) * triangle.volume;
        if self.springs.is_zero() {
            return own;
        }
        let spring = self.springs * own.trace() / T::from_f64(6.0);
        own + SMatrix::identity() * spring
    }

    /// Returns K u, the forces that keep the shape `u`, force.
    pub fn times(&self, u: &DVector<T>) -> DVector<T> {
        self.times_of(0..self.triangles.len(), u)
    }

    /// Returns the triangles, ascending, with a `wanted` degree of freedom.
    pub fn about(&self, wanted: &[bool]) -> Vec<usize> {
        let is_about = |i: &usize| self.triangles[*i].dofs().iter().any(|d| wanted[d.index()]);
        (0..self.triangles.len()).filter(is_about).collect()
    }

    /// Returns what some triangles, ascending, add to K u, force: on the degrees of freedom
    /// [about](Self::about) which they all are, K u to the bit.
    pub fn times_of(
        &self,
        triangles: impl IntoIterator<Item = usize>,
        u: &DVector<T>,
    ) -> DVector<T> {
        let mut force = DVector::from_element(self.dofs, T::zero());
        let (u, common) = T::over_common(u.as_slice().to_vec());
        let u = DVector::from_vec(u);
        for i in triangles {
            let triangle = &self.triangles[i];
            // A shift moves a few nodes alone.
            let dofs = triangle.dofs();
            if dofs.iter().any(|dof| !u[dof.index()].is_zero()) {
                let product = self.matrix(triangle) * triangle.displacements(&u);
                dofs.iter().zip(&product).for_each(|(dof, value)| force[dof.index()] += *value);
            }
        }
        force.map(|f| f / common)
    }

    /// Returns Tᵀ K T, force/length.
    pub fn reduced(&self, t: &Elimination<T>) -> SparseSymmetric<T> {
        let has_row = |dof: &Dof| !t.row(*dof).is_empty();
        let about = self.triangles.iter().filter(|triangle| triangle.dofs().iter().any(has_row));
        let corners = about.clone().map(|triangle| triangle.nodes.map(NodeId::index));
        let equations = |node: usize| {
            let rows = NodeId::new(node).dofs().map(|dof| t.row(dof));
            rows.into_iter().flatten().map(|(equation, _)| *equation)
        };
        let pattern = Pattern::of_triangles(t.size(), self.dofs / 2, corners, equations);
        SparseSymmetric::summed(pattern, |visit| {
            about.for_each(|triangle| triangle.reduced(&self.matrix(triangle), t, visit));
        })
    }

    /// Returns the stresses and strains of every triangle under displacements `u`.
    pub fn states(&self, u: &DVector<T>) -> Vec<State> {
        let states = self.triangles.iter().map(|t| {
            let Elastic { e, nu, .. } = self.materials[t.material as usize];
            State::new(self.plane, e, nu, &t.strain(), &t.displacements(u))
        });
        states.collect()
    }
}

impl Stiffness {
    /// Computes the same with every node of a triangle on springs of `part` times the mean diagonal entry
    /// of the triangle's matrix.
    pub fn on_springs(model: &Model, part: f64) -> Self {
        Stiffness { springs: part, ..Stiffness::new(model, |x| x) }
    }

    /// Returns the energy norm sqrt(uᵀ K u), sqrt(force·length). It is summed by triangle, so that
    /// no cancellation leaves a negative number.
    pub fn energy_norm(&self, u: &DVector<f64>) -> f64 {
        let squares = self.triangles.iter().map(|triangle| {
            let u = triangle.displacements(u);
            u.dot(&(self.matrix(triangle) * u)).max(0.0)
        });
        squares.sum::<f64>().sqrt()
    }
}

impl<T: Scalar> Element<T> {
    /// Returns the strain matrix B, 1/length.
    fn strain(&self) -> SMatrix<T, 3, 6> {
        element::strain_matrix(&self.gradients)
    }

    /// Returns the degrees of freedom of its corners: x, y of each corner in turn.
    fn dofs(&self) -> [Dof; 6] {
        let [a, b, c] = self.nodes.map(|node| node.dofs());
        [a[0], a[1], b[0], b[1], c[0], c[1]]
    }

    /// Visits the entries that it adds to the lower triangle of Tᵀ K T: row, column, value.
    fn reduced(
        &self,
        k: &SMatrix<T, 6, 6>,
        t: &Elimination<T>,
        visit: &mut dyn FnMut(usize, usize, T),
    ) {
        for (i, p) in self.dofs().into_iter().enumerate() {
            for (j, q) in self.dofs().into_iter().enumerate() {
                for &(row, wr) in t.row(p) {
                    for &(column, wc) in t.row(q).iter().filter(|(column, _)| *column <= row) {
                        visit(row, column, wr * k[(i, j)] * wc);
                    }
                }
            }
        }
    }

    fn displacements(&self, u: &DVector<T>) -> SVector<T, 6> {
        let [a, b, c] = self.nodes.map(|node| node.components(u));
        SVector::from([a[0], a[1], b[0], b[1], c[0], c[1]])
    }
}
