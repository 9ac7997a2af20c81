//! Stress fields that are known exactly, without body force and compatible.

use nalgebra::Vector3;
use plane_contact::problem::element::Plane;

/// sigma_x, sigma_y, tau_xy.
pub type Stress = Vector3<f64>;

/// An exact solution.
pub struct Field<'a> {
    pub plane: Plane,
    pub e: f64,
    pub nu: f64,
    pub stress: &'a dyn Fn([f64; 2]) -> Stress,
}

impl Field<'_> {
    /// sᵀ D⁻¹ s by Hooke's law in three dimensions.
    pub fn energy_density(&self, s: &Stress) -> f64 {
        let z = if self.plane == Plane::Strain { self.nu * (s[0] + s[1]) } else { 0.0 };
        let strain = |a: f64, b: f64, c: f64| (a - self.nu * (b + c)) / self.e;
        let shear = 2.0 * (1.0 + self.nu) / self.e * s[2];
        s[0] * strain(s[0], s[1], z) + s[1] * strain(s[1], s[0], z) + s[2] * shear
    }
}

/// Lamé: annulus of radii 10 and 20 under the inner pressure 10.
pub const LAME: Field<'static> = Field { plane: Plane::Strain, e: 30000.0, nu: 0.2, stress: &lame };

fn lame([x, y]: [f64; 2]) -> Stress {
    let (ri2, ro2, p) = (100.0, 400.0, 10.0);
    let r2 = x * x + y * y;
    let mean = p * ri2 / (ro2 - ri2);
    turned(mean * (1.0 - ro2 / r2), mean * (1.0 + ro2 / r2), 0.0, [x, y])
}

/// Kirsch: hole of radius 1 in a plate pulled by 1 in x.
pub const KIRSCH: Field<'static> =
    Field { plane: Plane::Stress, e: 1000.0, nu: 0.3, stress: &kirsch };

fn kirsch([x, y]: [f64; 2]) -> Stress {
    let q = 1.0 / (x * x + y * y);
    let (cos2, sin2) = ((x * x - y * y) * q, 2.0 * x * y * q);
    let radial = 0.5 * (1.0 - q) + 0.5 * (1.0 - 4.0 * q + 3.0 * q * q) * cos2;
    let hoop = 0.5 * (1.0 + q) - 0.5 * (1.0 + 3.0 * q * q) * cos2;
    let shear = -0.5 * (1.0 + 2.0 * q - 3.0 * q * q) * sin2;
    turned(radial, hoop, shear, [x, y])
}

/// Radial, hoop and shear stress in x and y.
fn turned(radial: f64, hoop: f64, shear: f64, [x, y]: [f64; 2]) -> Stress {
    let r = x.hypot(y);
    let (c, s) = (x / r, y / r);
    Stress::new(
        radial * c * c + hoop * s * s - 2.0 * shear * s * c,
        radial * s * s + hoop * c * c + 2.0 * shear * s * c,
        (radial - hoop) * s * c + shear * (c * c - s * s),
    )
}

/// Timoshenko: cantilever of length 8 and half depth 1, moment of inertia 2/3, end load 1.
pub const CANTILEVER: Field<'static> =
    Field { plane: Plane::Stress, e: 1000.0, nu: 0.3, stress: &cantilever };

fn cantilever([x, y]: [f64; 2]) -> Stress {
    let i = 2.0 / 3.0;
    Stress::new(-(8.0 - x) * y / i, 0.0, (1.0 - y * y) / (2.0 * i))
}

/// Linear stresses, of a cubic Airy function, on a rectangle 2 x 1.
pub const LINEAR: Field<'static> =
    Field { plane: Plane::Strain, e: 500.0, nu: 0.35, stress: &linear };

fn linear([x, y]: [f64; 2]) -> Stress {
    Stress::new(1.0 * x + 6.0 * y, 3.0 * x - 2.0 * y, 2.0 * x - 1.0 * y)
}

/// The same stress everywhere, on a rectangle 2 x 1.
pub const CONSTANT: Field<'static> =
    Field { plane: Plane::Strain, e: 500.0, nu: 0.35, stress: &constant };

fn constant(_: [f64; 2]) -> Stress {
    Stress::new(3.0, -1.0, 0.7)
}
