//! The scalars beside exact rational numbers: double-double within its proven errors, exact numbers
//! to the last bit.

use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::scalar::{Exact, F64x2, Scalar, rational, scope};
use proptest::prelude::*;
use testing::random::fixed;
use testing::tolerances::Tolerance;

testing::tolerances! {
    /// A double-double operation against exact arithmetic, relative to its result.
    DOUBLE_DOUBLE = 1.3e-31,
        "the proven errors, in units of u² = 2^-106 = 1.2e-32: sum 3, product 4, quotient 9.8, root of a square 3.125 \
         + 2";
}

/// A float of any sign whose size is within 2^±`range`.
fn float(range: i32) -> impl Strategy<Value = f64> {
    (1.0..2.0_f64, -range..=range, any::<bool>())
        .prop_map(|(m, e, minus)| if minus { -m * 2f64.powi(e) } else { m * 2f64.powi(e) })
}

/// A double-double whose low half is anything from half a unit in the last place of the high one to
/// 0.
fn double_double(range: i32) -> impl Strategy<Value = F64x2> {
    (float(range), -1.0..1.0_f64, 0..60)
        .prop_map(|(hi, m, e)| F64x2::from_f64(hi) + F64x2::from_f64(hi * m * 2f64.powi(-53 - e)))
}

fn exact(x: F64x2) -> RBig {
    x.to_rational().expect("finite")
}

/// |value − expected| / |expected|, as far as `f64` goes.
fn relative_error(value: F64x2, expected: &RBig) -> f64 {
    if expected.is_zero() {
        return exact(value).to_f64().value().abs();
    }
    ((exact(value) - expected) / expected).to_f64().value().abs()
}

fn within(value: F64x2, expected: &RBig, Tolerance { limit, reason }: &Tolerance) {
    let error = relative_error(value, expected);
    assert!(error <= *limit, "value {value}, error {error:e}, limit {limit:e} ({reason})");
    let [hi, lo] = value.halves();
    assert!(hi + lo == hi, "the halves {hi:e} and {lo:e} overlap");
}

proptest! {
    #![proptest_config(fixed(4000))]

    #[test]
    fn double_double_keeps_its_proven_errors(x in double_double(200), y in double_double(200)) {
        let (p, q) = (exact(x), exact(y));
        within(x + y, &(&p + &q), &DOUBLE_DOUBLE);
        within(x - y, &(&p - &q), &DOUBLE_DOUBLE);
        within(x * y, &(&p * &q), &DOUBLE_DOUBLE);
        within(x / y, &(&p / &q), &DOUBLE_DOUBLE);
    }

    #[test]
    fn double_double_survives_cancellation(
        x in double_double(3),
        y in double_double(3),
        k in 1..100_i16,
    ) {
        let y = -x + y * F64x2::from_f64(2f64.powi(-i32::from(k)));
        within(x + y, &(exact(x) + exact(y)), &DOUBLE_DOUBLE);
    }

    #[test]
    fn double_double_root_of_a_square(x in double_double(200)) {
        // The root of x² is |x|: half of the square's own error, and the root's.
        within((x * x).root(), &exact(Scalar::abs(x)), &DOUBLE_DOUBLE);
    }

    #[test]
    fn double_double_compares_as_its_value(x in double_double(3), y in double_double(3)) {
        prop_assert_eq!(x.partial_cmp(&y), Some(exact(x).cmp(&exact(y))));
        prop_assert_eq!(x.partial_cmp(&x), Some(std::cmp::Ordering::Equal));
    }

    #[test]
    fn nearest_double_double_is_within_half_a_unit(
        x in double_double(200),
        p in 1..1000_i64,
        q in 1..1000_i64,
    ) {
        prop_assert_eq!(F64x2::nearest(&exact(x)), x);
        let third = RBig::from(p) / RBig::from(q);
        within(F64x2::nearest(&third), &third, &DOUBLE_DOUBLE);
    }

    #[test]
    fn an_overflow_or_nan_is_what_f64_says(x in any::<f64>(), y in any::<f64>()) {
        let (a, b) = (F64x2::from_f64(x), F64x2::from_f64(y));
        let four = [(a + b, x + y), (a - b, x - y), (a * b, x * y), (a / b, x / y)];
        for (value, plain) in four.into_iter().chain([(a.root(), x.sqrt())]) {
            let [hi, lo] = value.halves();
            prop_assert_eq!(hi.is_finite(), plain.is_finite());
            prop_assert!(lo.is_finite());
            prop_assert_eq!(Scalar::is_finite(value), plain.is_finite());
            if !plain.is_finite() {
                let both_nan = hi.is_nan() && plain.is_nan();
                prop_assert_eq!(hi.total_cmp(&plain).is_eq() || both_nan, true);
            }
        }
    }

    #[test]
    fn rationals_round_to_the_nearest_f64(digits in 1..u64::MAX, exponent in -345..310_i32) {
        // The reader of the standard library rounds correctly.
        let text = format!("{digits}e{exponent}");
        let x = RBig::from_str_decimal(&text).expect("a decimal");
        let parsed = text.parse::<f64>().expect("a decimal");
        prop_assert_eq!(rational::nearest(&x).to_bits(), parsed.to_bits());
    }

    #[test]
    fn roots_round_to_the_nearest_f64(p in 1..u64::MAX, q in 1..u64::MAX, e in -400..400_i32) {
        let x = RBig::from(p) / RBig::from(q) * RBig::try_from(2f64.powi(e)).expect("finite");
        let root = rational::nearest_root(&x);
        // The middles between the root and its neighbours enclose it.
        let value = |x: f64| RBig::try_from(x).expect("finite");
        let middle = |other: f64| (value(root) + value(other)) / RBig::from(2);
        let (low, high) = (middle(root.next_down()), middle(root.next_up()));
        prop_assert!(&low * &low <= x && x <= &high * &high);
    }

    #[test]
    fn the_root_of_a_square_is_exact(x in float(500)) {
        let exact = RBig::try_from(x).expect("finite");
        prop_assert_eq!(rational::nearest_root(&(&exact * &exact)), x.abs());
    }

    #[test]
    fn exact_numbers_follow_the_laws(a in float(100), b in float(100), c in float(100)) {
        scope(|| {
            let [a, b, c] = [a, b, c].map(Exact::from_f64);
            prop_assert_eq!((a + b) + c, a + (b + c));
            prop_assert_eq!((a + b) * c, a * c + b * c);
            prop_assert_eq!(a / b * b, a);
            prop_assert_eq!(a - a, Exact::zero());
            Ok(())
        })?;
    }

    #[test]
    fn the_written_decimal_reads_back(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
        let exact = rational::of_decimal(x).expect("finite");
        prop_assert_eq!(rational::nearest(&exact), x);
        prop_assert_eq!(F64x2::from_decimal(x).to_f64(), x);
    }
}

#[test]
fn roots_of_the_smallest_and_largest() {
    let largest = RBig::try_from(f64::MAX).unwrap();
    assert_eq!(rational::nearest_root(&(&largest * &largest)), f64::MAX);
    let least = RBig::try_from(5e-324).unwrap();
    assert_eq!(rational::nearest_root(&(&least * &least)), 5e-324);
    // 2.5 of the smallest is a tie of subnormals: to even; a hair more goes up.
    let tie = &least * RBig::from(5) / RBig::from(2);
    assert_eq!(rational::nearest_root(&(&tie * &tie)), 1e-323);
    let more = &tie * &tie * (RBig::ONE + RBig::try_from(2f64.powi(-900)).unwrap());
    assert_eq!(rational::nearest_root(&more), 1.5e-323);
    assert_eq!(rational::nearest_root(&RBig::ZERO), 0.0);
}

#[test]
fn a_tenth_as_written_and_as_stored() {
    let tenth = RBig::from(1) / RBig::from(10);
    assert_eq!(Exact::from_decimal(0.1).to_rational(), Some(tenth.clone()));
    assert_ne!(Exact::from_f64(0.1).to_rational(), Some(tenth));
    assert_eq!(F64x2::from_decimal(0.1).to_string(), "1e-1");
    assert_eq!(f64::from_decimal(0.1).to_bits(), 0.1_f64.to_bits());
}

#[test]
fn x_over_zero_is_undefined_and_no_panic() {
    for x in [
        Exact::one() / Exact::zero(),
        Exact::from_f64(f64::INFINITY),
        Exact::from_decimal(f64::NAN),
    ] {
        assert!(
            !x.is_finite() && !(x + Exact::one()).is_finite() && !(Exact::zero() * x).is_finite()
        );
        assert!(!(Exact::one() / x).is_finite());
        assert_eq!((x == x, x.partial_cmp(&Exact::zero())), (false, None));
        assert!(x.to_f64().is_nan());
        assert_eq!(x.to_rational(), None);
    }
}

#[test]
#[should_panic(expected = "outlived its scope")]
fn an_exact_number_ends_with_its_scope() {
    let escaped = scope(|| Exact::from_f64(0.5));
    let _other = Exact::from_f64(0.25);
    escaped.to_f64();
}

#[test]
fn infinities_and_nans_go_through_double_doubles_as_through_f64() {
    let special = [0.0, 1.0, -2.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX, f64::MIN];
    for (x, y) in special.iter().flat_map(|x| special.map(|y| (*x, y))) {
        let (a, b) = (F64x2::from_f64(x), F64x2::from_f64(y));
        let results = [(a + b, x + y), (a - b, x - y), (a * b, x * y), (a / b, x / y)];
        for (k, (value, plain)) in results.into_iter().enumerate() {
            let value = value.to_f64();
            assert!(value == plain || value.is_nan() && plain.is_nan(), "{k}: {x} {y} {value}");
        }
    }
}

/// Half a unit of the largest double, in two parts that its high half does not feel.
#[test]
fn a_sum_that_overflows_only_with_its_low_halves_is_infinite() {
    for sign in [1.0, -1.0] {
        let [most, quarter] = [f64::MAX, 2_f64.powi(969)].map(|x| F64x2::from_f64(sign * x));
        let below = most + quarter;
        assert_eq!(below.halves(), [sign * f64::MAX, sign * 2_f64.powi(969)]);
        assert_eq!((below + quarter).halves(), [sign * f64::INFINITY, 0.0]);
    }
}

#[test]
fn of_two_zeros_the_first_is_the_larger_and_the_smaller() {
    for [x, y] in [[0.0_f64, -0.0], [-0.0, 0.0]] {
        assert_eq!(Scalar::max(x, y).to_bits(), x.to_bits());
        assert_eq!(Scalar::min(x, y).to_bits(), x.to_bits());
    }
}

#[test]
fn numbers_are_read_and_written_as_they_are() {
    let half = RBig::from(1) / RBig::from(2);
    assert_eq!((0.5_f64.to_rational(), 0.5_f32.to_rational()), (Some(half.clone()), Some(half)));
    assert_eq!((f64::INFINITY.to_rational(), f64::NAN.to_rational()), (None, None));
    scope(|| assert_eq!(Exact::from_f64(0.5).to_string(), "0.5"));
    scope(|| assert_eq!(format!("{:?}", Exact::from_f64(0.5)), "1/2"));
    assert_eq!(format!("{:?}", Exact::from_f64(f64::NAN)), "undefined");
}
