//! Sine, cosine and tangent of x87, which are Mathcad's: exact but for π, which has 66 bits there.

use std::f64::consts::FRAC_PI_2;

/// What x87's π/2 has beyond the double's.
const REST: f64 = 1.224_606_353_822_377_3e-16 / 2.0;

/// What π/2 has beyond x87's.
const BEYOND: f64 = 2.022_266_248_795_950_6e-21;

/// From here on x87 has no sine; multiples of π/2 are exact below.
const LARGEST: f64 = 9_007_199_254_740_992.0;

pub fn sin(x: f64) -> f64 {
    sine_after(0, x)
}

pub fn cos(x: f64) -> f64 {
    sine_after(1, x)
}

/// Returns the sine of x and so many quarters of the circle.
fn sine_after(quarters: i64, x: f64) -> f64 {
    let (quarter, r, rest) = reduced(x);
    match (quarter + quarters) % 4 {
        0 => r.sin() + rest * r.cos(),
        1 => r.cos() - rest * r.sin(),
        2 => -(r.sin() + rest * r.cos()),
        _ => -(r.cos() - rest * r.sin()),
    }
}

pub fn tan(x: f64) -> f64 {
    let (quarter, r, rest) = reduced(x);
    // The tangent of a sum, the second part of which is its own tangent.
    let tan = (r.tan() + rest) / (1.0 - r.tan() * rest);
    if quarter % 2 == 0 { tan } else { -1.0 / tan }
}

/// Returns quarters of the circle, 0 to 3, and the angle beyond them, in two parts whose sum it is.
fn reduced(x: f64) -> (i64, f64, f64) {
    let k = (x / FRAC_PI_2).round();
    let beyond = k * BEYOND;
    if k.abs() >= LARGEST || !k.is_finite() {
        return (0, x, 0.0);
    }
    // The library's sine of x itself is rounded once; a sum of two parts is wrong in its last digit for
    // 15 % of the arguments. It has the true π, which differs by less than rounding here.
    if beyond.abs() < 1e-18 {
        return (0, x, beyond);
    }
    let multiple = k * FRAC_PI_2;
    let tail = k.mul_add(FRAC_PI_2, -multiple) + k * REST;
    let head = x - multiple;
    let r = head - tail;
    ((k as i64).rem_euclid(4), r, (head - r) - tail)
}
