//! How far one solution is from another, on the same mesh, on a coarser one or on half of it.

use nalgebra::DVector;
use serde::Serialize;

use super::trials::Setting;
use base::error::InputError;
use engine::{Solution, distance};
use problem::scene::{Refined, Scene, symmetry};

/// Differences relative to the solution that is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Largest difference of a node's displacement over the largest displacement.
    pub displacement: f64,
    /// Energy norm of the difference over that of the solution compared with.
    pub energy: f64,
    /// Largest difference of a body's largest von Mises stress, over that of the solution compared with.
    pub von_mises: f64,
}

impl Errors {
    /// The errors of `solution` against `truth`, a solution on the same mesh.
    pub fn new(solution: &Solution, truth: &Solution) -> Self {
        let of = distance(solution, truth);
        Errors {
            displacement: of.displacement_relative,
            energy: of.energy_relative,
            von_mises: of.bodies.iter().map(|body| body.relative.abs()).fold(0.0, f64::max),
        }
    }

    /// The errors of the solution of one trial against that of another, each with the trial's
    /// setting: both are brought to one mesh. `scene` is the scene of both as it came, `meshes` are
    /// its refined ones.
    pub(super) fn between(
        scene: &Scene,
        meshes: &[Refined],
        (setting, solution): (Setting, &Solution),
        (best, truth): (Setting, &Solution),
    ) -> Self {
        use Setting::{Coupling, Half, Iterations, Own, Refined, Status, Tolerance};
        match (setting, best) {
            (Refined(coarse), Refined(fine)) => {
                let solution = prolonged(solution.clone(), &meshes[coarse..fine], truth);
                Errors::new(&solution, truth)
            }
            (Half, Own) => {
                // The whole in the terms of its half.
                let half = symmetry::half(scene).expect("its half was run");
                let u = half.nodes.iter().flat_map(|node| node.components(&truth.u));
                let elements = half.triangles.iter().map(|id| truth.elements[id.index()].clone());
                let u = DVector::from_iterator(2 * half.nodes.len(), u);
                Errors::new(solution, &solution.with_fields(u, elements.collect()))
            }
            (
                Own | Tolerance(_) | Iterations(_) | Status(_) | Coupling(_) | Refined(_) | Half,
                _,
            ) => Errors::new(solution, truth),
        }
    }
}

pub(super) fn meshes(scene: &Scene, times: usize) -> Result<Vec<Refined>, InputError> {
    let mut meshes: Vec<Refined> = Vec::new();
    for _ in 0..times {
        let last = meshes.last().map_or(scene, |refined| &refined.scene);
        meshes.push(last.refined()?.expect("a scene that was refined has a mesh"));
    }
    Ok(meshes)
}

/// A solution in the terms of a finer mesh, that of `finest`: displacements are linear along each
/// edge, so nothing changes but names.
pub(super) fn prolonged(coarse: Solution, meshes: &[Refined], finest: &Solution) -> Solution {
    let Solution { mut u, mut elements, .. } = coarse;
    for mesh in meshes {
        let mut finer: Vec<f64> = u.iter().copied().collect();
        for ends in &mesh.parents {
            let [a, b] = ends.map(|node| node.components(&u));
            finer.extend([0, 1].map(|d| (a[d] + b[d]) / 2.0));
        }
        u = DVector::from_vec(finer);
        elements = elements.into_iter().flat_map(|state| std::iter::repeat_n(state, 4)).collect();
    }
    finest.with_fields(u, elements)
}
