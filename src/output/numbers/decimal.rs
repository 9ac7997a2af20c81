//! Round numbers, and the decimal exponent of a float. What is said of them holds from 1e-300 to 1e300.

/// Returns the round number (1, 2 or 5 times a power of ten) nearest to `x` > 0 as a ratio.
pub fn nearest_round(x: f64) -> f64 {
    round(x, [2.0, 10.0, 50.0].map(f64::sqrt))
}

/// Returns the largest round number that is at most `x` > 0.
pub fn round_at_most(x: f64) -> f64 {
    round(x, [2.0, 5.0, 10.0])
}

/// Returns the round number of the size of `x`; from each of the three mantissas in `limits` on that is 2, 5 and 10
/// in turn.
fn round(x: f64, limits: [f64; 3]) -> f64 {
    let text = format!("{x:e}");
    let (mantissa, place) = split(&text);
    let mantissa: f64 = mantissa.parse().expect("a mantissa");
    let digits = [1, 2, 5, 10][limits.iter().filter(|&&limit| mantissa >= limit).count()];
    format!("{digits}e{place}").parse().expect("digits and an exponent")
}

/// Returns how many decimals reach down to a place: 2 for −2, and 0 from the units upwards.
pub fn decimals(place: i32) -> usize {
    usize::try_from(-place).unwrap_or(0)
}

/// Returns the decimal exponent of `x`, as its shortest text has it; 0 of 0, infinity and NaN.
pub fn exponent(x: f64) -> i32 {
    if x.is_finite() { split(&format!("{x:e}")).1 } else { 0 }
}

/// Returns the mantissa and the exponent of a number in scientific notation.
pub fn split(scientific: &str) -> (&str, i32) {
    let (mantissa, exponent) = scientific.split_once('e').expect("scientific notation");
    (mantissa, exponent.parse().expect("an exponent"))
}
