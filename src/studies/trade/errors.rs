//! How far one run is from another, on the same mesh, on a coarser one or on half of it.

use nalgebra::DVector;
use serde::Serialize;

use super::trials::{Setting, Trial};
use crate::answer::contact::{Outcome, distance};
use crate::error::InputError;
use crate::problem::scene::{Refined, Scene, symmetry};

/// Differences relative to the run that is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Largest difference of a node's displacement over the largest displacement.
    pub displacement: f64,
    /// Energy norm of the difference.
    pub energy: f64,
    /// Largest difference of a body's largest von Mises stress.
    pub von_mises: f64,
}

impl Errors {
    /// Those of `outcome`, a run on `scene`.
    pub fn new(scene: &Scene, outcome: &Outcome, truth: &Outcome) -> Self {
        let of = distance(scene, outcome, truth);
        Errors {
            displacement: of.displacement_relative,
            energy: of.energy_relative,
            von_mises: of.bodies.iter().map(|body| body.relative.abs()).fold(0.0, f64::max),
        }
    }
}

/// A run to measure, another to measure it against, and the scene of both.
pub(super) struct Pair {
    pub scene: Scene,
    pub outcome: Outcome,
    pub truth: Outcome,
}

impl Pair {
    /// Brings the runs of `trial` and of `best`, what it is measured against, to one mesh; `scene` is the scene of both as it came.
    pub fn new(
        scene: &Scene,
        (trial, outcome): (&Trial, &Outcome),
        (best, truth): (Setting, &Outcome),
    ) -> Result<Self, InputError> {
        let (outcome, truth) = (outcome.clone(), truth.clone());
        match (trial.setting, best) {
            (Setting::Refined(coarse), Setting::Refined(fine)) => {
                let meshes = meshes(scene, fine)?;
                let finest = meshes.last().map_or(scene, |refined| &refined.scene).clone();
                let outcome = prolonged(outcome, &meshes[coarse..], &truth);
                Ok(Pair { scene: finest, outcome, truth })
            }
            (Setting::Half, Setting::Own) => {
                let half = symmetry::half(scene).expect("its half was run");
                let truth = restricted(&truth, &half, &outcome);
                Ok(Pair { scene: half.scene, outcome, truth })
            }
            _ => Ok(Pair { scene: scene.clone(), outcome, truth }),
        }
    }

    pub fn errors(&self) -> Errors {
        Errors::new(&self.scene, &self.outcome, &self.truth)
    }
}

/// The scene refined once, twice, ...
pub(super) fn meshes(scene: &Scene, times: usize) -> Result<Vec<Refined>, InputError> {
    let mut meshes: Vec<Refined> = Vec::new();
    for _ in 0..times {
        let last = meshes.last().map_or(scene, |refined| &refined.scene);
        meshes.push(last.refined()?.expect("a scene that was refined has a mesh"));
    }
    Ok(meshes)
}

/// A run in the terms of a finer mesh, that of `finest`: displacements are linear along each edge, so nothing changes but names.
pub(super) fn prolonged(coarse: Outcome, meshes: &[Refined], finest: &Outcome) -> Outcome {
    let Outcome { mut u, mut elements, .. } = coarse;
    for mesh in meshes {
        let mut finer: Vec<f64> = u.iter().copied().collect();
        for [a, b] in &mesh.parents {
            finer.extend([0, 1].map(|d| (u[2 * a - 2 + d] + u[2 * b - 2 + d]) / 2.0));
        }
        u = DVector::from_vec(finer);
        elements = elements.into_iter().flat_map(|state| std::iter::repeat_n(state, 4)).collect();
    }
    Outcome { u, elements, ..finest.clone() }
}

/// A run of the whole in the terms of its half, on which `of_half` was run.
fn restricted(whole: &Outcome, half: &symmetry::Half, of_half: &Outcome) -> Outcome {
    let u = half.nodes.iter().flat_map(|n| [whole.u[2 * n - 2], whole.u[2 * n - 1]]);
    Outcome {
        u: DVector::from_iterator(2 * half.nodes.len(), u),
        elements: half.triangles.iter().map(|n| whole.elements[n - 1].clone()).collect(),
        ..of_half.clone()
    }
}
