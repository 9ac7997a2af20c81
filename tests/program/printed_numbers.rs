//! Numbers as reports print them: round ones, ticks, significant digits, values with their errors.

use plane_contact::output::numbers::{
    common_exponent, figure, nearest_round, percent, round_at_most, shifted, significant, ticks,
};

#[test]
fn round_numbers() {
    let numbers = [1.0, 1.5, 120.0, 0.034, 8.0, 3e299, 3e-300];
    let nearest = numbers.map(nearest_round);
    assert_eq!(nearest, [1.0, 2.0, 100.0, 0.05, 10.0, 2e299, 2e-300]);
    let at_most = [1.99, 2.0, 12.5, 0.7, 9.99e-301].map(round_at_most);
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
        (36.774_58, Some(0.17), "37"),
        (36.774_58, Some(0.012), "36.8"),
        (36.774_58, None, "36.8"),
        (36.774_58, Some(0.0), "36.7746"),
        (-45.5, Some(0.2), "-46"),
        (0.005_636_9, Some(0.17), "0.0056"),
        (9.8e-4, Some(0.17), "9.8e-4"),
        // Two digits are the least.
        (3.0, Some(40.0), "3.0"),
        (1234.0, Some(0.3), "1.2e3"),
        (2.346e9, Some(0.02), "2.35e9"),
        // Rounding that carries.
        (99.96, Some(0.002), "100.0"),
        (0.0, Some(0.1), "0"),
        (-0.0, Some(0.0), "0"),
        (f64::INFINITY, Some(0.1), "-"),
    ] {
        assert_eq!(figure(value, error), text, "{value} {error:?}");
    }
}

#[test]
fn per_cent_have_two_digits() {
    let parts = [0.3005, 0.094, 1.0, 0.05, 1.0534, 0.000_04, -1e-9, 0.0, f64::NAN];
    let texts = ["30 %", "9.4 %", "100 %", "5.0 %", "105 %", "0.00 %", "0.00 %", "0 %", "-"];
    assert_eq!(parts.map(percent), texts);
}
