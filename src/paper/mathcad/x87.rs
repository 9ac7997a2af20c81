//! Sine, cosine and tangent of x87, which are Mathcad's: those of the angle that is left once multiples
//! of a π/2 of 66 bits are taken away.

use std::f64::consts::FRAC_PI_2;

/// What π/2 has beyond that of x87.
const BEYOND: f64 = 2.022_266_248_795_950_6e-21;

/// From so many multiples of π/2 on x87 has no sine; they are exact below.
const LARGEST: f64 = 9_007_199_254_740_992.0;

pub fn sin(x: f64) -> f64 {
    let more = turned(x);
    x.sin() * more.cos() + x.cos() * more.sin()
}

pub fn cos(x: f64) -> f64 {
    let more = turned(x);
    x.cos() * more.cos() - x.sin() * more.sin()
}

pub fn tan(x: f64) -> f64 {
    let (tan, more) = (x.tan(), turned(x).tan());
    (tan + more) / (1.0 - tan * more)
}

/// Returns the angle by which too little is taken away from x.
fn turned(x: f64) -> f64 {
    let multiples = (x / FRAC_PI_2).round();
    if multiples.abs() < LARGEST { multiples * BEYOND } else { 0.0 }
}
