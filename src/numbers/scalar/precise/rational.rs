//! Rational numbers from and to `f64` and decimals, each conversion exact or correctly rounded.

use dashu_base::{BitTest, DivRem, Gcd, SquareRootRem};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// Returns the `f64` nearest to `x`, ties to even, ±∞ beyond the largest.
pub fn nearest(x: &RBig) -> f64 {
    x.to_f64().value()
}

/// Returns the shortest decimal that reads back to `x`, or nothing for an infinity or NaN.
pub fn of_decimal(x: f64) -> Option<RBig> {
    if x.is_finite() { RBig::from_str_decimal(&format!("{x:e}")).ok() } else { None }
}

/// Returns the `f64` nearest to the square root of `x` ≥ 0, ties to even.
pub fn nearest_root(x: &RBig) -> f64 {
    /// Bits of the root: past 54, one more that tells an inexact root rounds as the root itself
    /// does, subnormals too.
    const BITS: isize = 64;
    assert!(*x >= RBig::ZERO, "no real root of a negative number");
    if x.is_zero() {
        return 0.0;
    }
    let (p, q) = (x.numerator().clone().into_parts().1, x.denominator().clone());
    let size = p.bit_len() as isize - q.bit_len() as isize;
    // The root is taken of p/q · 4^shift.
    let shift = BITS - size.div_euclid(2);
    let (p, q) =
        if shift >= 0 { (p << (2 * shift) as usize, q) } else { (p, q << (-2 * shift) as usize) };
    let (quotient, left) = p.div_rem(q);
    let (root, rest) = quotient.sqrt_rem();
    let inexact = !left.is_zero() || !rest.is_zero();
    let mantissa = (root << 1) + UBig::from(inexact);
    nearest(&times_power_of_two(mantissa, -shift - 1))
}

/// Returns the square root of `x` ≥ 0, exactly where it is rational, else to 100 digits.
pub fn root(x: &RBig) -> RBig {
    /// Bits of 100 digits.
    const BITS: usize = 333;
    let q = x.denominator().clone();
    let product = x.numerator().clone().into_parts().1 * &q;
    match product.sqrt_rem() {
        (root, rest) if rest.is_zero() => RBig::from_parts(root.into(), q),
        _ => {
            let (root, _) = (product << (2 * BITS)).sqrt_rem();
            RBig::from_parts(root.into(), q << BITS)
        }
    }
}

/// Writes `x` in scientific decimal, correctly rounded to `digits` significant digits, or fewer
/// where fewer say it exactly.
pub fn decimal(x: &RBig, digits: usize) -> String {
    let text = format!("{:.*e}", digits - 1, x.in_expanded(10));
    let (mantissa, exponent) = text.split_once('e').expect("scientific notation has an exponent");
    let mantissa = match mantissa.contains('.') {
        true => mantissa.trim_end_matches('0').trim_end_matches('.'),
        false => mantissa,
    };
    format!("{mantissa}e{exponent}")
}

/// Returns the least common multiple of two numbers.
pub fn lcm(a: UBig, b: &UBig) -> UBig {
    if a == *b {
        return a;
    }
    let common = (&a).gcd(b);
    a / common * b
}

fn times_power_of_two(mantissa: UBig, exponent: isize) -> RBig {
    let power = UBig::ONE << exponent.unsigned_abs();
    if exponent >= 0 {
        RBig::from(mantissa * power)
    } else {
        RBig::from_parts(IBig::from(mantissa), power)
    }
}
