//! The three-node triangle of constant strain (CST), with the paper's `Ae`, `B` and `D`.
//!
//! ```text
//!              3
//!             / \        nodes counter-clockwise: area > 0
//!            /   \       displacements in the order u1 v1 u2 v2 u3 v3
//!           1-----2      strains in the order e_xx e_yy g_xy (engineering shear)
//! ```
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor, *The Finite Element Method*, vol. 1.
#![allow(non_snake_case, reason = "the paper's own names")]

use nalgebra::{SMatrix, SVector};
use serde::Serialize;

use base::choices;
use base::error::{InputError, Result};
use base::plain::six_digits;
use numbers::scalar::Scalar;

choices! {
    #[cfg_attr(feature = "scenes", derive(schemars::JsonSchema))]
    /// The plane problem behind `D` (reading R6: the paper does not print which).
    Plane {
        /// Plane strain: no strain across the plane.
        Strain = "strain",
        /// Plane stress: no stress across the plane.
        Stress = "stress",
    }
}

impl Plane {
    /// Checks that `nu` is a Poisson's ratio of the plane problem.
    ///
    /// # Errors
    /// The ratio is outside (-1, 0.5) in plane strain, or (-1, 1) in plane stress.
    pub fn check_poisson(self, nu: f64, place: &str) -> Result<()> {
        let (below, name) = match self {
            Plane::Strain => (0.5, "plane strain"),
            Plane::Stress => (1.0, "plane stress"),
        };
        if nu > -1.0 && nu < below {
            return Ok(());
        }
        let what = format!("nu = {} is outside (-1, {below}) in {name}", six_digits(nu));
        Err(InputError::new(place, what, "give a Poisson's ratio inside"))
    }
}

/// The corner coordinates of a triangle, counted from 0, length.
pub type Corners<T> = [[T; 2]; 3];

/// Returns the signed area of the triangle, length²: negative where its corners run clockwise.
pub fn area<T: Scalar>(p: &Corners<T>) -> T {
    let two = T::one() + T::one();
    ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])) / two
}

/// Returns how the displacement of each corner changes along x and y, 1/length, for an area not 0.
pub fn gradients<T: Scalar>(p: &Corners<T>) -> [[T; 2]; 3] {
    let double_area = area(p) + area(p);
    [0, 1, 2].map(|k| {
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        let (dx, dy) = (p[next][1] - p[last][1], p[last][0] - p[next][0]);
        [dx / double_area, dy / double_area]
    })
}

/// Returns the strain matrix, 3 x 6, 1/length: strains = B · displacements, for an area not 0.
pub fn B<T: Scalar>(p: &Corners<T>) -> SMatrix<T, 3, 6> {
    strain_matrix(&gradients(p))
}

/// Returns B of a triangle with these gradients.
pub fn strain_matrix<T: Scalar>(gradients: &[[T; 2]; 3]) -> SMatrix<T, 3, 6> {
    let mut b = SMatrix::zeros();
    for (k, [dx, dy]) in gradients.iter().enumerate() {
        b[(0, 2 * k)] = *dx;
        b[(1, 2 * k + 1)] = *dy;
        b[(2, 2 * k)] = *dy;
        b[(2, 2 * k + 1)] = *dx;
    }
    b
}

/// Returns the elasticity matrix, 3 x 3, stress: stresses = D · strains.
pub fn D<T: Scalar>(plane: Plane, E: T, nu: T) -> SMatrix<T, 3, 3> {
    let (zero, one) = (T::zero(), T::one());
    let two = one + one;
    let (factor, diagonal, shear) = match plane {
        Plane::Strain => (E / ((one + nu) * (one - two * nu)), one - nu, (one - two * nu) / two),
        Plane::Stress => (E / (one - nu * nu), one, (one - nu) / two),
    };
    let (diagonal, other) = (factor * diagonal, factor * nu);
    SMatrix::from([[diagonal, other, zero], [other, diagonal, zero], [zero, zero, factor * shear]])
}

/// Returns Bᵀ·D·B, 6 x 6: the stiffness of a volume of 1, from left to right, without the products
/// with what is 0 in B and D.
pub fn stiffness<T: Scalar>(B: &SMatrix<T, 3, 6>, D: &SMatrix<T, 3, 3>) -> SMatrix<T, 6, 6> {
    let mut k = SMatrix::zeros();
    for p in 0..6 {
        // Displacements along x strain e_xx, along y e_yy; both shear.
        let strain = B[(p % 2, p)];
        let stress = [strain * D[(p % 2, 0)], strain * D[(p % 2, 1)], B[(2, p)] * D[(2, 2)]];
        for q in 0..6 {
            k[(p, q)] = stress[q % 2] * B[(q % 2, q)] + stress[2] * B[(2, q)];
        }
    }
    k
}

/// The strains and stresses of an element, each constant over the element.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct State {
    /// The stresses sigma_x, sigma_y, tau_xy, stress.
    pub sigma: SVector<f64, 3>,
    /// The strains e_xx, e_yy, g_xy.
    pub epsilon: SVector<f64, 3>,
    /// The von Mises stress, stress.
    pub von_mises_stress: f64,
    /// The von Mises strain, which has no unit.
    pub von_mises_strain: f64,
}

impl State {
    /// Computes strains, stresses and their von Mises values from the element's six displacements.
    ///
    /// The paper prints no formula for either von Mises value. Stress: sqrt(3/2 s:s) of the stress
    /// deviator, with sigma_z = nu (sigma_x + sigma_y) in plane strain. Strain: sqrt(2/3 e:e) of
    /// the strain deviator, with e_zz = −nu/(1 − nu) (e_xx + e_yy) in plane stress.
    ///
    /// Each is computed in T and rounded once at the end, exact numbers to the nearest `f64`.
    pub fn new<T: Scalar>(
        plane: Plane,
        E: T,
        nu: T,
        B: &SMatrix<T, 3, 6>,
        u: &SVector<T, 6>,
    ) -> Self {
        let two = T::one() + T::one();
        let three = two + T::one();
        let (u, common) = T::over_common(u.as_slice().to_vec());
        let epsilon = B * SVector::<T, 6>::from_vec(u);
        let sigma = D(plane, E, nu) * epsilon;
        let sigma_z = out_of_plane_stress(plane, nu, &sigma);
        let epsilon_z = out_of_plane_strain(plane, nu, &epsilon);
        let stress = [sigma[0], sigma[1], sigma_z, sigma[2]];
        let strain = [epsilon[0], epsilon[1], epsilon_z, epsilon[2] / two];
        State {
            sigma: sigma.map(|s| (s / common).to_f64()),
            epsilon: epsilon.map(|e| (e / common).to_f64()),
            von_mises_stress: deviator_norm(three / two, stress, common),
            von_mises_strain: deviator_norm(two / three, strain, common),
        }
    }
}

/// Returns the von Mises strain by the other common formula (R10): that of the stress, applied to
/// strains, divided by 1 + nu.
pub fn von_mises_strain_by_stress_formula(plane: Plane, nu: f64, e: &SVector<f64, 3>) -> f64 {
    let e_zz = out_of_plane_strain(plane, nu, e);
    deviator_norm(1.5, [e[0], e[1], e_zz, e[2] / 2.0], 1.0) / (1.0 + nu)
}

/// Returns sigma_z: nu (sigma_x + sigma_y) in plane strain, 0 in plane stress.
pub fn out_of_plane_stress<T: Scalar>(plane: Plane, nu: T, sigma: &SVector<T, 3>) -> T {
    match plane {
        Plane::Strain => nu * (sigma[0] + sigma[1]),
        Plane::Stress => T::zero(),
    }
}

/// Returns e_zz: 0 in plane strain, −nu/(1 − nu) (e_xx + e_yy) in plane stress.
pub fn out_of_plane_strain<T: Scalar>(plane: Plane, nu: T, e: &SVector<T, 3>) -> T {
    match plane {
        Plane::Strain => T::zero(),
        Plane::Stress => -nu / (T::one() - nu) * (e[0] + e[1]),
    }
}

/// Returns sqrt(factor · d:d) of the deviator d of a symmetric tensor with the components xx, yy,
/// zz, xy over `common`; scaled, so that no square overflows or vanishes.
fn deviator_norm<T: Scalar>(factor: T, tensor: [T; 4], common: T) -> f64 {
    let (two, three) = (T::one() + T::one(), T::one() + T::one() + T::one());
    let largest = tensor.into_iter().fold(T::zero(), |m, x| m.max(x.abs()));
    if largest == T::zero() {
        return 0.0;
    }
    let scale = T::scale(largest);
    let [xx, yy, zz, xy] = tensor.map(|x| x / scale);
    let square = |x: T| x * x;
    let squares = square(xx - yy) + square(yy - zz) + square(zz - xx);
    T::scaled_root(factor, scale / common, squares / three + two * xy * xy)
}
