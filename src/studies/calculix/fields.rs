//! Displacements and stresses, by either program.

use engine::Solution;
use problem::element::{Plane, State};
use problem::model::Triangle;

/// Displacements by node and stresses by triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// x and y of each node, length.
    pub u: Vec<[f64; 2]>,
    /// sigma_x, sigma_y, sigma_z, tau_xy, tau_xz, tau_yz of each triangle, stress.
    pub sigma: Vec<[f64; 6]>,
}

impl Fields {
    /// Zero at `nodes` nodes and in `triangles` triangles.
    pub fn zero(nodes: usize, triangles: usize) -> Self {
        Fields { u: vec![[0.0; 2]; nodes], sigma: vec![[0.0; 6]; triangles] }
    }

    /// The displacements and stresses of a solution by this program.
    pub fn from_solution(solution: &Solution) -> Self {
        let model = &solution.model;
        let stress = |(state, triangle): (&State, &Triangle)| {
            let [x, y, xy] = state.sigma.into();
            let z = match model.plane {
                Plane::Strain => triangle.material.nu * (x + y),
                Plane::Stress => 0.0,
            };
            [x, y, z, xy, 0.0, 0.0]
        };
        Fields {
            sigma: solution.elements.iter().zip(&model.triangles).map(stress).collect(),
            u: solution.displacements(),
        }
    }

    /// Adds `share` times `other`.
    pub fn add(&mut self, share: f64, other: &Fields) {
        let add = |to: &mut [f64], from: &[f64]| {
            to.iter_mut().zip(from).for_each(|(a, b)| *a += share * b);
        };
        add(self.u.as_flattened_mut(), other.u.as_flattened());
        add(self.sigma.as_flattened_mut(), other.sigma.as_flattened());
    }

    /// Von Mises stress of each triangle.
    pub fn von_mises(&self) -> Vec<f64> {
        self.sigma.iter().map(von_mises).collect()
    }
}

fn von_mises(s: &[f64; 6]) -> f64 {
    let normal = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
    let shear = s[3].powi(2) + s[4].powi(2) + s[5].powi(2);
    (normal / 2.0 + 3.0 * shear).sqrt()
}
