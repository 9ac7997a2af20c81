//! The discretisation error of the stresses: the effect of the mesh, not of the arithmetic.
//!
//! A triangle's stress is constant; the true stress is not. The recovered stress sigma*
//! (`recovery.rs`) is continuous within a material and nearer to the truth, so that sigma* −
//! sigma_h estimates the error:
//!
//! ```text
//!  eta_e² = ∫ (sigma* − sigma_h)ᵀ D⁻¹ (sigma* − sigma_h) dV over the triangle,   eta² = Σ eta_e²
//! ```
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 33 (1992) 1331 and 1365.
//!
//! The error estimate of a largest von Mises stress rests on this: the von Mises values of two
//! stresses differ by at most the von Mises value of their difference, because it is a seminorm.
//! Let d_e be the largest von Mises value of sigma* − sigma_h over triangle e, vm_e its von Mises
//! stress, and m the triangle with the largest stress. Then
//!
//! ```text
//!  estimate = SAFETY · max( d_e1 ,  vm_e2 + d_e2 − vm_m )
//! ```
//!
//! where e1 is any triangle that shares a node with m, and e2 any triangle of the body: the second
//! term covers a peak that the mesh hides elsewhere. |recovered maximum − maximum| is no error
//! estimate: on the benchmarks of `tests/numbers/discretisation.rs` it is about half of the true
//! error, and on coarse meshes about zero. The price is a wide estimate: there it is typically 2.6
//! to 10 times the true error, and more where that error happens to be small. At a re-entrant
//! corner, under a point load or at the edge of a sticking contact the true stress has no largest
//! value, and no estimate bounds it (`singular.rs` finds such places); nor does a triangle see the
//! error that such a place causes far away.
#![allow(non_snake_case, reason = "the paper's own names")]

use std::sync::Arc;

use nalgebra::Matrix3;

use super::recovery::{Patches, Stress, recover};
use crate::range::locks;
use problem::element::{self, Plane, State};
use problem::model::{Model, Triangle, TriangleId};

/// The factor by which d_e may underrate the true error near the largest stress: it is an estimate,
/// not a bound. The estimate was chosen among twelve on the benchmarks and 400 random polynomial
/// fields (1.62 would have covered them all), then tried on 4,000 other fields, on four domains and
/// 24 to 400 triangles: 1.1 % of the estimates missed; where [`Discretisation::relative`] is at
/// most 0.2, 0.13 %, and where at most 0.1, none.
pub const SAFETY: f64 = 2.0;

/// The estimated error that the mesh causes in a solution.
#[derive(Clone, Debug)]
pub struct Discretisation {
    /// The recovered stresses at the corners of each triangle, in the order of its nodes.
    pub recovered: Vec<[Stress; 3]>,
    /// The error eta_e of each triangle in the energy norm, sqrt(force·length).
    pub indicators: Vec<f64>,
    /// The error d_e of each triangle, the largest von Mises value of sigma* − sigma_h, stress;
    /// infinite where it is unknown.
    pub stress_errors: Vec<f64>,
    /// The energy norm of the solution, sqrt(∫ sigma_hᵀ D⁻¹ sigma_h dV), sqrt(force·length).
    pub energy_norm: f64,
    /// The triangles whose error is unknown: of parts that are too small to estimate it, or that lock.
    pub unrecovered: Vec<TriangleId>,
    patches: Arc<Patches>,
}

/// The largest von Mises stress of a body, and an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestVonMises {
    /// The largest von Mises stress of its triangles, stress.
    pub value: f64,
    /// The triangle that has it.
    pub at: TriangleId,
    /// The largest of the recovered stresses, typically nearer to the truth than `value`, stress.
    pub recovered: f64,
    /// The error estimate, stress: the true largest value is expected within `value` ± `error`.
    /// Infinite where nothing is known.
    pub error: f64,
}

impl Discretisation {
    /// Estimates the error of a solution from the state of each triangle.
    pub fn new(model: &Model, elements: &[State]) -> Self {
        Self::on(Arc::new(Patches::new(model)), model, elements)
    }

    /// Estimates the error of another solution on the same mesh.
    pub(super) fn of_other(&self, model: &Model, elements: &[State]) -> Self {
        Self::on(Arc::clone(&self.patches), model, elements)
    }

    fn on(patches: Arc<Patches>, model: &Model, elements: &[State]) -> Self {
        let stresses: Vec<Stress> = elements.iter().map(|state| state.sigma).collect();
        let at_sites = recover(&patches, &stresses);
        let known = |k: usize| {
            !locks(model.plane, model.triangles[k].material.nu)
                && patches.corners[k].iter().all(|s| at_sites[*s as usize].is_some())
        };
        let corners =
            |k: usize| patches.corners[k].map(|s| at_sites[s as usize].unwrap_or(stresses[k]));
        let triangles = || model.triangles.iter().enumerate();
        let recovered: Vec<[Stress; 3]> = (0..stresses.len()).map(corners).collect();
        let error = |k: usize| recovered[k].map(|s| s - stresses[k]);
        let stress_error = |(k, triangle): (usize, &Triangle)| {
            if known(k) { largest(model.plane, triangle, &error(k)) } else { f64::INFINITY }
        };
        let norm = |k: usize, triangle: &Triangle, corners: &[Stress; 3]| {
            let volume = element::area(&model.corners(TriangleId::new(k))) * model.thickness;
            energy_norm(model.plane, triangle, volume, corners)
        };
        Discretisation {
            indicators: triangles().map(|(k, t)| norm(k, t, &error(k))).collect(),
            stress_errors: triangles().map(stress_error).collect(),
            energy_norm: root_of_squares(triangles().map(|(k, t)| norm(k, t, &[stresses[k]; 3]))),
            unrecovered: model.triangle_ids().filter(|id| !known(id.index())).collect(),
            recovered,
            patches,
        }
    }

    /// Returns eta, the estimated error in the energy norm, sqrt(force·length); infinite where the
    /// error of a triangle is unknown.
    pub fn total(&self) -> f64 {
        if self.unrecovered.is_empty() { self.known_part() } else { f64::INFINITY }
    }

    /// Returns eta / |u|, where |u|² is estimated by |u_h|² + eta²; infinite where eta is.
    pub fn relative(&self) -> f64 {
        match self.total() {
            eta if eta == 0.0 || eta.is_infinite() => eta,
            eta => eta / eta.hypot(self.energy_norm),
        }
    }

    /// Returns, for a picture, each eta_e over the energy norm of an average triangle, |u| /
    /// sqrt(M). Their quadratic mean is [`Self::relative`]; a triangle whose error is unknown has
    /// 0.
    pub fn error_map(&self) -> Vec<f64> {
        let whole = self.known_part().hypot(self.energy_norm);
        let average = whole / (self.indicators.len() as f64).sqrt();
        let part = |eta: &f64| if *eta == 0.0 { 0.0 } else { eta / average };
        self.indicators.iter().map(part).collect()
    }

    fn known_part(&self) -> f64 {
        root_of_squares(self.indicators.iter().copied())
    }

    /// Returns the largest von Mises stress of a body and its error estimate, from the state of
    /// each triangle of the model and the body's triangles, at least one.
    pub fn largest_von_mises(
        &self,
        model: &Model,
        elements: &[State],
        triangles: &[TriangleId],
    ) -> LargestVonMises {
        let stress = |id: TriangleId| elements[id.index()].von_mises_stress;
        let stresses = triangles.iter().map(|id| stress(*id));
        let at =
            triangles[numbers::largest::largest(stresses).expect("a body has a triangle").first];
        let nodes = |id: TriangleId| model.triangle(id).nodes;
        let beside = |id: TriangleId| nodes(id).iter().any(|node| nodes(at).contains(node));
        let error = |&id: &TriangleId| {
            let (here, peak) = (self.stress_errors[id.index()], stress(id) - stress(at));
            if beside(id) { here } else { here + peak }
        };
        let recovered = |&id: &TriangleId| {
            largest(model.plane, model.triangle(id), &self.recovered[id.index()])
        };
        LargestVonMises {
            value: stress(at),
            at,
            recovered: triangles.iter().map(recovered).fold(0.0, f64::max),
            error: SAFETY * triangles.iter().map(error).fold(0.0, f64::max),
        }
    }
}

/// Returns the largest von Mises value at the corners of a triangle, stress.
fn largest(plane: Plane, triangle: &Triangle, corners: &[Stress; 3]) -> f64 {
    let nu = triangle.material.nu;
    corners.iter().map(|s| von_mises(plane, nu, s)).fold(0.0, f64::max)
}

/// Returns the von Mises stress, as in [`State::new`]; scaled, so that no square overflows.
pub fn von_mises(plane: Plane, nu: f64, stress: &Stress) -> f64 {
    let scale = stress.amax();
    if scale == 0.0 {
        return 0.0;
    }
    let s = stress / scale;
    let z = match plane {
        Plane::Strain => nu * (s[0] + s[1]),
        Plane::Stress => 0.0,
    };
    let squares = (s[0] - s[1]).powi(2) + (s[1] - z).powi(2) + (z - s[0]).powi(2);
    scale * (squares / 2.0 + 3.0 * s[2] * s[2]).sqrt()
}

/// Returns the energy norm over a triangle of a stress that is linear between its corners,
/// sqrt(force·length). `volume` is in length³.
fn energy_norm(plane: Plane, triangle: &Triangle, volume: f64, corners: &[Stress; 3]) -> f64 {
    let scale = corners.iter().map(|s| s.amax()).fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    let c = compliance(plane, triangle.material.nu);
    let product = |s: Stress| s.dot(&(c * s));
    let [s1, s2, s3] = corners.map(|s| s / scale);
    // Exact for a quadratic: ∫ N_i N_j = A (1 + [i = j]) / 12.
    let mean = (product(s1) + product(s2) + product(s3) + product(s1 + s2 + s3)) / 12.0;
    scale * (volume / triangle.material.e * mean).sqrt()
}

/// Returns E · D⁻¹, which has no unit.
pub fn compliance(plane: Plane, nu: f64) -> Matrix3<f64> {
    let (diagonal, other) = match plane {
        Plane::Strain => ((1.0 + nu) * (1.0 - nu), -(1.0 + nu) * nu),
        Plane::Stress => (1.0, -nu),
    };
    let shear = 2.0 * (1.0 + nu);
    Matrix3::new(diagonal, other, 0.0, other, diagonal, 0.0, 0.0, 0.0, shear)
}

/// Returns sqrt(Σ x²); scaled, so that no square overflows or vanishes.
pub fn root_of_squares(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let scale = values.clone().fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    scale * values.map(|x| (x / scale).powi(2)).sum::<f64>().sqrt()
}
