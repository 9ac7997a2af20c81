//! The stiffness of a mesh.

use engine::Stiffness;
use nalgebra::{DVector, SVector};
use problem::element::{B, D, area, stiffness};
use problem::model::Dof;
use testing::annulus::annulus;

/// Computed each time they are needed, as of a mesh of more than 100,000 triangles, or kept: the
/// matrices are the same.
#[test]
fn the_stiffness_of_a_mesh_is_that_of_its_triangles() {
    for n in [4, 230] {
        let scene = annulus(n, n).build().unwrap();
        let model = &*scene.model;
        let u = DVector::from_fn(model.dofs(), |e, _| (e * 7919 % 101) as f64);
        let mut force = DVector::zeros(model.dofs());
        let mut energy = 0.0;
        for id in model.triangle_ids() {
            let (corners, triangle) = (model.corners(id), model.triangle(id));
            let d = D(model.plane, triangle.material.e, triangle.material.nu);
            let k = stiffness(&B(&corners), &d) * (area(&corners) * model.thickness);
            let dofs: Vec<Dof> = triangle.nodes.iter().flat_map(|node| node.dofs()).collect();
            let moved = SVector::<f64, 6>::from_fn(|e, _| u[dofs[e].index()]);
            let product = k * moved;
            dofs.iter().zip(&product).for_each(|(dof, f)| force[dof.index()] += f);
            energy += moved.dot(&product);
        }
        let whole = Stiffness::new(model, |x| x);
        assert_eq!(whole.times(&u), force, "{n}");
        assert_eq!(whole.energy_norm(&u), energy.sqrt(), "{n}");
        let wanted: Vec<bool> = (0..model.dofs()).map(|e| e % 1000 == 7).collect();
        let part = whole.times_of(whole.about(&wanted), &u);
        assert!((0..model.dofs()).filter(|e| wanted[*e]).all(|e| part[e] == force[e]), "{n}");
    }
}
