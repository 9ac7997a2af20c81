//! The largest of several values, where rounding alone may tell some of them apart.

use numbers::largest::{Largest, largest};

fn found(values: &[f64]) -> Option<Largest> {
    largest(values.iter().copied())
}

fn at(first: usize, others: usize) -> Option<Largest> {
    Some(Largest { first, others })
}

#[test]
fn of_values_that_rounding_tells_apart_the_first_is_the_largest() {
    assert_eq!(found(&[1.0, 36.7, 36.7 * (1.0 + 4.0 * f64::EPSILON), 2.0]), at(1, 1));
    assert_eq!(found(&[1.0, 36.7, 36.7 * (1.0 + 0.9e-9)]), at(1, 1));
    assert_eq!(found(&[1.0, 36.7, 36.7 * (1.0 + 1.1e-9)]), at(2, 0));
}

#[test]
fn of_negative_values_and_of_zeros_too() {
    assert_eq!(found(&[-3.0, -2.0, -2.0]), at(1, 1));
    assert_eq!(found(&[0.0, 0.0, 0.0]), at(0, 2));
    // Against a value of 1, 1e-12 is nothing.
    assert_eq!(found(&[-1.0, -1e-12, 0.0]), at(1, 1));
}

#[test]
fn of_none_there_is_none() {
    assert_eq!(found(&[]), None);
    assert_eq!(found(&[f64::MIN]), at(0, 0));
}
