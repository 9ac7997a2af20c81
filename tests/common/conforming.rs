//! Closed forms of a disc that is pressed into a hole of nearly its radius, without friction, in plane
//! strain: the back of an envelope beside the scene `strand`.
//!
//! ```text
//!            R = R1 R2 / (R2 − R1)      1/E* = c1 + c2,  c = (1 − ν²)/E      1: disc, 2: hole
//!  Hertz     a² = 4 P R / (π E*)        p0 = 2 P / (π a)
//!
//!            b = tan(ε/2), y = tan(φ/2), φ the angle from the middle of the contact, ε at its end
//!  Persson   E* (R2 − R1) / P = (1 − c2 E* (ln(1 + b²) + 2 b⁴)) / (π b² (1 + b²))
//!            p r / P = 2/π √((b² − y²)/(1 + b²)) / (1 + y²)
//!                      + artanh(√((b² − y²)/(1 + b²))) / (π b² (1 + b²)),     r = √(R1 R2)
//! ```
//!
//! P is the load per thickness. Hertz takes both bodies for half planes. Persson takes the disc, loaded at
//! its centre, and the hole in an unbounded plane, and neglects Dundurs' β, which frictionless half planes
//! do not notice.
//!
//! Source: K. L. Johnson, *Contact Mechanics*, 1985, sections 4.2(c) and 5.3; A. Persson, *On the stress
//! distribution of cylindrical elastic bodies in contact*, Chalmers, 1964; M. Ciavarella and P. Decuzzi,
//! *The state of stress induced by the plane frictionless cylindrical contact*, parts I and II,
//! Int. J. Solids Struct. 38, 2001. A test puts the pressure into the integral equation of both bodies.

use std::f64::consts::PI;

/// A disc in a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conforming {
    /// R1 of the disc and R2 of the hole, length.
    pub radii: [f64; 2],
    /// c1 and c2, (1 − ν²)/E of either body, 1/stress.
    pub compliances: [f64; 2],
    /// P, force per thickness, > 0.
    pub load: f64,
}

/// What a closed form gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedForm {
    /// Half of the contact's width along the arc, length.
    pub half_width: f64,
    /// The largest pressure, stress.
    pub peak_pressure: f64,
}

impl Conforming {
    /// Hertz's closed form; None where the radii are equal.
    pub fn hertz(&self) -> Option<ClosedForm> {
        let [disc, hole] = self.radii;
        let radius = disc * hole / (hole - disc);
        let half_width = (4.0 * self.load * radius / (PI * self.modulus())).sqrt();
        let peak_pressure = 2.0 * self.load / (PI * half_width);
        half_width.is_finite().then_some(ClosedForm { half_width, peak_pressure })
    }

    /// Persson's closed form.
    pub fn persson(&self) -> ClosedForm {
        let half_angle = self.half_angle();
        ClosedForm {
            half_width: self.radius() * half_angle,
            peak_pressure: self.pressure(half_angle, 0.0),
        }
    }

    /// Persson's ε, the angle from the middle of the contact to its end, by bisection.
    pub fn half_angle(&self) -> f64 {
        let clearance = (self.radii[1] - self.radii[0]) * self.modulus() / self.load;
        let [mut low, mut high] = [0.0, PI];
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            let is_low = self.relative_clearance(middle) > clearance;
            *(if is_low { &mut low } else { &mut high }) = middle;
        }
        low
    }

    /// Persson's E* (R2 − R1) / P of a contact that ends at the angle ε.
    pub fn relative_clearance(&self, half_angle: f64) -> f64 {
        let b2 = (half_angle / 2.0).tan().powi(2);
        let share = self.compliances[1] * self.modulus();
        (1.0 - share * (b2.ln_1p() + 2.0 * b2 * b2)) / (PI * b2 * (1.0 + b2))
    }

    /// Persson's pressure at the angle φ of a contact that ends at the angle ε, stress.
    pub fn pressure(&self, half_angle: f64, angle: f64) -> f64 {
        let [b2, y2] = [half_angle, angle].map(|angle| (angle / 2.0).tan().powi(2));
        let root = ((b2 - y2).max(0.0) / (1.0 + b2)).sqrt();
        let share = 2.0 * root / (1.0 + y2) + root.atanh() / (b2 * (1.0 + b2));
        share * self.load / (PI * self.radius())
    }

    /// E*, stress.
    fn modulus(&self) -> f64 {
        1.0 / (self.compliances[0] + self.compliances[1])
    }

    /// The radius of the common arc, which are nearly one, length.
    fn radius(&self) -> f64 {
        (self.radii[0] * self.radii[1]).sqrt()
    }
}
