//! Numbers as reports print them: round ones, ticks, significant digits, values with their errors.

use plane_contact::report::numbers::{
    Decimal, common_exponent, shifted, significant, ticks, uncertain,
};

#[test]
fn round_numbers() {
    let numbers = [1.0, 1.5, 120.0, 0.034, 8.0, 3e299, 3e-300];
    let nearest = numbers.map(|x| Decimal::nearest_round(x).value());
    assert_eq!(nearest, [1.0, 2.0, 100.0, 0.05, 10.0, 2e299, 2e-300]);
    let at_most = [1.99, 2.0, 12.5, 0.7, 9.99e-301].map(|x| Decimal::round_at_most(x).value());
    assert_eq!(at_most, [1.0, 2.0, 10.0, 0.5, 5e-301]);
}

fn texts(low: f64, high: f64) -> Vec<String> {
    ticks(low, high).into_iter().map(|(_, text)| text).collect()
}

#[test]
fn ticks_are_round() {
    assert_eq!(texts(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    assert_eq!(texts(-7.0, 12.3), ["−5", "0", "5", "10"]);
    assert_eq!(
        texts(100.001, 100.002),
        ["100.0010", "100.0012", "100.0014", "100.0016", "100.0018", "100.0020"]
    );
}

#[test]
fn tick_count() {
    for tenths in 10..=100 {
        let count = ticks(0.0, f64::from(tenths) / 10.0).len();
        assert!((4..=9).contains(&count), "{count} ticks up to {tenths}/10");
    }
}

#[test]
fn significant_digits() {
    let numbers = [0.0, -0.0, 12.3456, -250.0, 1e5, 2.5e-7, -1e300, 1e6, 123_456_789.0];
    let texts = ["0", "0", "12.35", "−250", "100000", "2.5·10⁻⁷", "−10³⁰⁰", "10⁶", "1.235·10⁸"];
    assert_eq!(numbers.map(|x| significant(x, 4)), texts);
}

#[test]
fn common_exponents() {
    let numbers = [0.0, 0.02, 99_999.0, 2.1e-4, 6.3e6, 1e300, 1e-300];
    assert_eq!(numbers.map(common_exponent), [0, 0, 0, -6, 6, 300, -300]);
}

#[test]
fn shifts_out_of_range() {
    assert!((shifted(3e-300, 300) - 3.0).abs() < 1e-12);
    assert!((shifted(3e-320, 320) - 3.0).abs() < 1e-3);
}

#[test]
fn the_error_decides_the_digits() {
    for (value, error, text) in [
        (41.94, 2.6, "41.9 +- 2.6"),
        (41.94, 2.61, "41.9 +- 2.7"),
        (41.94, 2.99, "42 +- 3"),
        (41.94, 3.1, "42 +- 4"),
        (41.94, 9.5, "42 +- 10"),
        (41.94, 0.1 + 0.2, "41.9 +- 0.3"),
        (41.94, 0.0123, "41.940 +- 0.013"),
        (41.94, 12.3, "42 +- 13"),
        // Errors larger than the value.
        (3.0, 40.0, "0 +- 40"),
        (6.0, 40.0, "10 +- 40"),
        (-6.0, 40.0, "-10 +- 40"),
        (-3.0, 40.0, "0 +- 40"),
        (0.004, 0.05, "0.00 +- 0.05"),
        (1e-300, 1e300, "0 +- 1.0e300"),
        (0.0, 4e-9, "0 +- 4e-9"),
        // Rounding that carries.
        (99.96, 0.4, "100.0 +- 0.4"),
        (9.96e-8, 4e-10, "9.96e-8 +- 4e-10"),
        (9.996e-8, 4e-10, "1.000e-7 +- 4e-10"),
        (1234.0, 400.0, "1200 +- 400"),
        (2.346e9, 4e7, "2.35e9 +- 4e7"),
        // An error of zero leaves the value as it is.
        (41.95, 0.0, "41.95 +- 0"),
        (0.0, 0.0, "0 +- 0"),
        (2.5e-300, 0.0, "2.5e-300 +- 0"),
        // No digit beyond those of a float.
        (0.1, 1e-30, "0.1 +- 1.0e-30"),
        (41.95, 2e-12, "41.9500000000000 +- 2.0e-12"),
        // What is not known is told in words.
        (0.0, f64::NAN, "about 0, error unknown"),
        (f64::INFINITY, 1.0, "about inf, error unknown"),
    ] {
        let written = uncertain(value, "", Some(error).filter(|error| error.is_finite()));
        assert_eq!(written, format!("{text} (arithmetic)"), "{value} {error}");
    }
}

#[test]
fn a_unit_stands_behind_the_error() {
    assert_eq!(uncertain(41.95, "MPa", Some(3.0)), "42 +- 3 MPa (arithmetic)");
    assert_eq!(uncertain(41.95, "MPa", None), "about 42 MPa, error unknown (arithmetic)");
}
