//! How fast the machine is: one small dense factorisation, timed.

use std::time::Instant;

use nalgebra::DMatrix;

use crate::numbers::solve::DenseLu;

/// Equations of the factorisation that is timed: half a millisecond, and large enough for faer's blocks.
const EQUATIONS: usize = 256;

/// How often it is timed; the least counts, for whatever else runs on the machine only adds.
const ROUNDS: usize = 7;

/// Seconds of that factorisation on the machine that the constants of [`Work`](super::Work) were measured on: x86-64 with AVX-512, 2 cores shared.
const REFERENCE: f64 = 4.5e-4;

/// A machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// How many times as fast it is as the one that the constants were measured on.
    pub speed: f64,
}

impl Machine {
    /// The machine that the constants were measured on.
    pub const REFERENCE: Machine = Machine { speed: 1.0 };

    /// This machine, as it is now.
    pub fn measure() -> Self {
        // Diagonally dominant, so that no pivot vanishes.
        let matrix = DMatrix::from_fn(EQUATIONS, EQUATIONS, |i, j| {
            if i == j { EQUATIONS as f64 } else { ((7 * i + 3 * j) % 11) as f64 / 11.0 }
        });
        let time = |_| {
            let matrix = matrix.clone();
            let start = Instant::now();
            std::hint::black_box(DenseLu::new(matrix).is_ok());
            start.elapsed().as_secs_f64()
        };
        let least = (0..ROUNDS).map(time).fold(f64::INFINITY, f64::min);
        Machine { speed: REFERENCE / least }
    }
}
