//! Exact solution of A x = b by lifting: the equations are factored modulo a prime p once, and the
//! digits of x to the base p are found one by one; when there are enough of them, the fractions are
//! known. Elimination in fractions gives the same, but carries numbers of the final length through
//! every step.
//!
//! Source: J. D. Dixon, *Exact solution of linear equations using P-adic expansions*, Numer. Math.
//! 40 (1982) 137-141.

use dashu_base::BitTest;
use dashu_int::IBig;
use dashu_ratio::RBig;

use super::elimination::Field;
use super::ldlt::Ldlt;
use super::symmetric::SparseSymmetric;
use crate::scalar::rational::lcm;

/// The prime p, 2^61 − 1.
const P: u64 = (1 << 61) - 1;

/// A number modulo p.
#[derive(Clone, Copy)]
struct Residue(u64);

impl Residue {
    fn from_integer(x: &IBig) -> Self {
        let remainder = i64::try_from(x % IBig::from(P)).expect("a remainder is below p");
        Residue(remainder.rem_euclid(P as i64) as u64)
    }

    /// Returns x modulo p, or nothing where p divides its denominator.
    fn of_fraction(x: &RBig) -> Option<Self> {
        let denominator = Residue::from_integer(&IBig::from(x.denominator().clone()));
        let defined = !denominator.vanishes();
        defined.then(|| Residue::from_integer(x.numerator()).over(&denominator))
    }

    fn times(&self, other: &Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        // 2^61 is 1 modulo p.
        Residue(((product as u64 & P) + (product >> 61) as u64) % P)
    }

    /// Returns the inverse modulo p, by Fermat x^(p − 2).
    fn inverse(self) -> Self {
        let (mut power, mut square, mut exponent) = (Residue(1), self, P - 2);
        while exponent > 0 {
            if exponent % 2 == 1 {
                power = power.times(&square);
            }
            square = square.times(&square);
            exponent /= 2;
        }
        power
    }
}

impl Field for Residue {
    const EPSILON: f64 = 0.0;

    fn zero() -> Self {
        Residue(0)
    }
    fn size(&self) -> f64 {
        if self.0 == 0 { 0.0 } else { 1.0 }
    }
    fn vanishes(&self) -> bool {
        self.0 == 0
    }
    fn over(&self, other: &Self) -> Self {
        self.times(&other.inverse())
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        self.0 = (self.0 + P - a.times(b).0) % P;
    }
}

/// A row of M x = c: A and b times the common denominator of both.
struct Row {
    entries: Vec<(usize, IBig)>,
    /// What is left of c after the digits found so far.
    rest: IBig,
    /// The inverse modulo p of the common denominator.
    scale: Residue,
}

/// Returns the solution x of A x = `b`, or nothing where A is singular modulo p, as every singular
/// matrix is.
pub fn lift(matrix: &SparseSymmetric<RBig>, b: &[RBig]) -> Option<Vec<RBig>> {
    let (mut rows, length) = whole_rows(matrix, b)?;
    let factors = Ldlt::new(&matrix.try_map(Residue::of_fraction)?).ok()?;
    // p^digits > 2 · (2^length)²: numerators and denominators are below 2^length.
    let digits = (2 * length + 2) / 60 + 1;
    let mut x: Vec<Vec<u64>> = vec![Vec::with_capacity(digits); b.len()];
    for _ in 0..digits {
        let rest: Vec<Residue> =
            rows.iter().map(|row| Residue::from_integer(&row.rest).times(&row.scale)).collect();
        let digit = factors.solve(&rest);
        for row in &mut rows {
            for (j, a) in &row.entries {
                row.rest -= a * digit[*j].0;
            }
            row.rest /= IBig::from(P);
        }
        x.iter_mut().zip(&digit).for_each(|(x, digit)| x.push(digit.0));
    }
    Some(fractions(&x, digits, length))
}

/// Returns the rows of M x = c, and the bits of a bound on its determinants (Hadamard's: the
/// product of the rows' lengths).
fn whole_rows(matrix: &SparseSymmetric<RBig>, b: &[RBig]) -> Option<(Vec<Row>, usize)> {
    let mut full: Vec<Vec<(usize, RBig)>> = vec![Vec::new(); b.len()];
    for (i, j, a) in matrix.entries() {
        if i != j {
            full[j].push((i, a.clone()));
        }
        full[i].push((j, a));
    }
    let (mut rows, mut length) = (Vec::with_capacity(b.len()), 0);
    for (entries, b) in full.into_iter().zip(b) {
        let common =
            entries.iter().fold(b.denominator().clone(), |c, (_, a)| lcm(c, a.denominator()));
        let whole = |x: &RBig| x.numerator() * (&common / x.denominator());
        let entries: Vec<(usize, IBig)> = entries.iter().map(|(j, a)| (*j, whole(a))).collect();
        let rest = whole(b);
        let squares = entries.iter().fold(&rest * &rest, |sum, (_, a)| sum + a * a);
        length += squares.bit_len().div_ceil(2);
        let scale = Residue::from_integer(&IBig::from(common.clone()));
        if scale.vanishes() {
            return None;
        }
        rows.push(Row { entries, rest, scale: scale.inverse() });
    }
    Some((rows, length))
}

/// Returns the fractions whose digits to the base p are `x`, numerators and denominators below
/// 2^`length`.
fn fractions(x: &[Vec<u64>], digits: usize, length: usize) -> Vec<RBig> {
    let mut powers = vec![IBig::from(P)];
    while 1 << powers.len() < digits {
        let last = powers.last().expect("one at least");
        powers.push(last * last);
    }
    let modulus = IBig::from(P).pow(digits);
    // All denominators divide the determinant: the one common to those found so far is mostly that
    // of the next.
    let mut common = IBig::ONE;
    x.iter()
        .map(|digits| {
            let value = combined(digits, &powers) * &common % &modulus;
            let (numerator, denominator) = fraction(value, &modulus, length);
            common *= denominator;
            RBig::from_parts_signed(numerator, common.clone())
        })
        .collect()
}

/// Returns the whole number with these digits; `powers[k]` is p^(2^k).
fn combined(digits: &[u64], powers: &[IBig]) -> IBig {
    if let [digit] = digits {
        return IBig::from(*digit);
    }
    // The largest power of 2 below the number of digits.
    let k = (digits.len() - 1).ilog2() as usize;
    let (low, high) = digits.split_at(1 << k);
    combined(low, powers) + combined(high, powers) * &powers[k]
}

/// Returns numerator and denominator, both below 2^`length` but for their signs, of the fraction that is
/// `value` modulo `modulus`: Euclid's algorithm, stopped halfway.
fn fraction(value: IBig, modulus: &IBig, length: usize) -> (IBig, IBig) {
    let (mut last, mut rest) = (modulus.clone(), value);
    let (mut last_factor, mut factor) = (IBig::ZERO, IBig::ONE);
    while rest.bit_len() > length {
        let quotient = &last / &rest;
        let next = &last - &quotient * &rest;
        let next_factor = &last_factor - quotient * &factor;
        (last, rest) = (rest, next);
        (last_factor, factor) = (factor, next_factor);
    }
    (rest, factor)
}
