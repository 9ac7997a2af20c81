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
//! It is an estimate of the whole: at a re-entrant corner, under a point load or at the edge of a sticking
//! contact it is too low, and it says little of one displacement or stress, which `trade --only mesh`
//! measures.
#![allow(non_snake_case, reason = "the paper's own names")]

use nalgebra::Matrix3;

use super::recovery::{Patches, Stress, recover};
use crate::range::locks;
use problem::element::{self, Plane, State};
use problem::model::{Model, Triangle, TriangleId};

/// The estimated error that the mesh causes in a solution.
#[derive(Clone, Debug)]
pub struct Discretisation {
    /// The error eta_e of each triangle in the energy norm, sqrt(force·length).
    pub indicators: Vec<f64>,
    /// The energy norm of the solution, sqrt(∫ sigma_hᵀ D⁻¹ sigma_h dV), sqrt(force·length).
    pub energy_norm: f64,
    /// The triangles whose error is unknown: of parts that are too small to estimate it, or that lock.
    pub unrecovered: Vec<TriangleId>,
}

impl Discretisation {
    /// Estimates the error of a solution from the state of each triangle.
    pub fn new(model: &Model, elements: &[State]) -> Self {
        let patches = Patches::new(model);
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
        let norm = |k: usize, triangle: &Triangle, corners: &[Stress; 3]| {
            let volume = element::area(&model.corners(TriangleId::new(k))) * model.thickness;
            energy_norm(model.plane, triangle, volume, corners)
        };
        Discretisation {
            indicators: triangles().map(|(k, t)| norm(k, t, &error(k))).collect(),
            energy_norm: root_of_squares(triangles().map(|(k, t)| norm(k, t, &[stresses[k]; 3]))),
            unrecovered: model.triangle_ids().filter(|id| !known(id.index())).collect(),
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
fn compliance(plane: Plane, nu: f64) -> Matrix3<f64> {
    let (diagonal, other) = match plane {
        Plane::Strain => ((1.0 + nu) * (1.0 - nu), -(1.0 + nu) * nu),
        Plane::Stress => (1.0, -nu),
    };
    let shear = 2.0 * (1.0 + nu);
    Matrix3::new(diagonal, other, 0.0, other, diagonal, 0.0, 0.0, 0.0, shear)
}

/// Returns sqrt(Σ x²); scaled, so that no square overflows or vanishes.
fn root_of_squares(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let scale = values.clone().fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    scale * values.map(|x| (x / scale).powi(2)).sum::<f64>().sqrt()
}
