//! Numbers as ccx reads them.

/// ccx reads no more characters of a field.
const WIDTH: usize = 20;

/// `x` in at most 20 characters, with as many of its digits as fit: all that it has, or at least
/// 13.
pub fn field(x: f64) -> String {
    let exact = [format!("{x}"), format!("{x:e}")];
    let rounded = (0..WIDTH).rev().map(|digits| format!("{x:.digits$e}"));
    let mut written = exact.into_iter().chain(rounded);
    written.find(|text| text.len() <= WIDTH).expect("one digit and an exponent fit")
}

#[cfg(test)]
mod tests {
    use super::field;

    #[test]
    fn a_number_keeps_the_digits_that_fit() {
        assert_eq!(field(0.1), "0.1");
        assert_eq!(field(-210000.0), "-210000");
        assert_eq!(field(-0.1234567890123456), "-0.1234567890123456");
        assert_eq!(field(1.0 / 3.0), "0.3333333333333333");
        assert_eq!(field(1e300), "1e300");
        assert_eq!(field(-1.2345678901234567e-4), "-1.23456789012346e-4");
        assert_eq!(field(-1.2345678901234567e-300), "-1.234567890123e-300");
    }
}
