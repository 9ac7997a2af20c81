//! The discretisation error of the stresses: what the mesh, not the arithmetic, does to them.
//!
//! A triangle's stress is constant; the true one is not. The recovered stress sigma* ([`super::recovery`]) is continuous within
//! a material and nearer to the truth, so that sigma* − sigma_h stands for the error:
//!
//! ```text
//!  eta_e² = ∫ (sigma* − sigma_h)ᵀ D⁻¹ (sigma* − sigma_h) dV over the triangle,   eta² = Σ eta_e²
//! ```
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 33 (1992) 1331-1364 and 1365-1382.
#![allow(non_snake_case, reason = "the paper's own names")]

use nalgebra::Matrix3;

use super::patches::Patches;
use super::recovery::{Stress, recover};
use crate::element::State;
use crate::mirror::{Plane, Worksheet};

/// What the mesh does to a solution.
#[derive(Clone, Debug)]
pub struct Discretisation {
    /// Recovered stresses at the three corners of each triangle, in the order of its nodes.
    pub recovered: Vec<[Stress; 3]>,
    /// eta_e of each triangle, in the energy norm: sqrt(force·length).
    pub indicators: Vec<f64>,
    /// Energy norm of the solution, sqrt(∫ sigma_hᵀ D⁻¹ sigma_h dV): sqrt(force·length).
    pub energy_norm: f64,
    /// Triangles of parts too small to say anything of their error: rows of `EL`, from 1.
    pub unrecovered: Vec<usize>,
}

impl Discretisation {
    /// The error of a solution, estimated.
    ///
    /// Given: the worksheet and the state of each row of its `EL`.
    pub fn new(sheet: &Worksheet<f64>, elements: &[State]) -> Self {
        let patches = Patches::new(sheet);
        let stresses: Vec<Stress> = elements.iter().map(|state| state.sigma).collect();
        let at_sites = recover(&patches, &stresses);
        let known = |n: &usize| patches.corners[n - 1].iter().all(|&s| at_sites[s].is_some());
        let unrecovered = (1..=sheet.M()).filter(|n| !known(n)).collect();
        let recovered: Vec<[Stress; 3]> = (0..sheet.M())
            .map(|t| patches.corners[t].map(|site| at_sites[site].unwrap_or(stresses[t])))
            .collect();
        let triangles = 1..=sheet.M();
        let indicators = triangles
            .clone()
            .map(|n| energy_norm(sheet, n, &recovered[n - 1].map(|s| s - stresses[n - 1])));
        let norms = triangles.map(|n| energy_norm(sheet, n, &[stresses[n - 1]; 3]));
        Discretisation {
            indicators: indicators.collect(),
            energy_norm: root_of_squares(norms),
            recovered,
            unrecovered,
        }
    }

    /// eta, the estimated error in the energy norm: sqrt(force·length). Infinite where some triangle's error is unknown.
    pub fn total(&self) -> f64 {
        if self.unrecovered.is_empty() {
            root_of_squares(self.indicators.iter().copied())
        } else {
            f64::INFINITY
        }
    }

    /// eta / |u|, |u|² being estimated by |u_h|² + eta²; 0 of no stress at all.
    pub fn relative(&self) -> f64 {
        match self.total() {
            eta if eta == 0.0 || eta.is_infinite() => eta,
            eta => eta / eta.hypot(self.energy_norm),
        }
    }
}

/// Energy norm over triangle n of a stress that is linear between its corners: sqrt(force·length).
fn energy_norm(sheet: &Worksheet<f64>, n: usize, corners: &[Stress; 3]) -> f64 {
    let scale = corners.iter().map(|s| s.amax()).fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    let c = compliance(sheet.plane, sheet.nu[n]);
    let product = |s: Stress| s.dot(&(c * s));
    let [s1, s2, s3] = corners.map(|s| s / scale);
    // Exact for a quadratic: ∫ N_i N_j = A (1 + [i = j]) / 12.
    let mean = (product(s1) + product(s2) + product(s3) + product(s1 + s2 + s3)) / 12.0;
    scale * (sheet.Ae[n] / sheet.E[n] * mean).sqrt()
}

/// E · D⁻¹, without unit.
fn compliance(plane: Plane, nu: f64) -> Matrix3<f64> {
    let (diagonal, other) = match plane {
        Plane::Strain => ((1.0 + nu) * (1.0 - nu), -(1.0 + nu) * nu),
        Plane::Stress => (1.0, -nu),
    };
    let shear = 2.0 * (1.0 + nu);
    Matrix3::new(diagonal, other, 0.0, other, diagonal, 0.0, 0.0, 0.0, shear)
}

/// sqrt(Σ x²); scaled, so that no square overflows or vanishes.
fn root_of_squares(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let scale = values.clone().fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    scale * values.map(|x| (x / scale).powi(2)).sum::<f64>().sqrt()
}
