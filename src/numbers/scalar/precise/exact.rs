//! Exact rational numbers that are `Copy`, as the mirror's code wants them: handles into an arena
//! of their thread.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::fmt;
use std::marker::PhantomData;

use dashu_int::UBig;
use dashu_ratio::RBig;

use super::rational;
use crate::operators;
use crate::scalar::number::{Scalar, Subscript};

/// A rational number, or *undefined*: x/0, and what comes of it. Undefined equals nothing, as NaN
/// does.
///
/// The number lives in an arena of its thread until the [`scope`] that it was made in ends; to use
/// it later is a panic.
#[derive(Clone, Copy)]
pub struct Exact {
    at: u32,
    epoch: u32,
    /// Another thread has another arena.
    of_thread: PhantomData<*const ()>,
}

/// The numbers of a thread, each with the epoch that it was made in.
struct Arena {
    numbers: Vec<(u32, RBig)>,
    epoch: u32,
}

thread_local! {
    static ARENA: RefCell<Arena> =
        RefCell::new(Arena { numbers: vec![(0, RBig::ZERO), (0, RBig::ONE)], epoch: 0 });
}

/// Does `work`, then frees every number that it made.
pub fn scope<R>(work: impl FnOnce() -> R) -> R {
    let _guard = Guard { size: ARENA.with_borrow(|arena| arena.numbers.len()) };
    work()
}

struct Guard {
    size: usize,
}

impl Drop for Guard {
    fn drop(&mut self) {
        ARENA.with_borrow_mut(|arena| {
            arena.numbers.truncate(self.size);
            arena.epoch += 1;
        });
    }
}

impl Exact {
    /// The two numbers that always stand in the arena, made in epoch 0, and the undefined one.
    const ZERO: Self = Exact::fixed(0);
    const ONE: Self = Exact::fixed(1);
    const UNDEFINED: Self = Exact::fixed(u32::MAX);

    /// Makes the number `x`; 0 and 1 take no place in the arena.
    pub fn new(x: RBig) -> Self {
        if x.is_zero() {
            return Exact::ZERO;
        }
        if x.is_one() {
            return Exact::ONE;
        }
        ARENA.with_borrow_mut(|arena| {
            let at = u32::try_from(arena.numbers.len()).expect("fewer than 2^32 numbers");
            arena.numbers.push((arena.epoch, x));
            Exact { at, epoch: arena.epoch, of_thread: PhantomData }
        })
    }

    const fn fixed(at: u32) -> Self {
        Exact { at, epoch: 0, of_thread: PhantomData }
    }

    /// Returns what `read` makes of the number, or nothing where it is undefined.
    fn with<R>(self, read: impl FnOnce(&RBig) -> R) -> Option<R> {
        if self.is(Exact::UNDEFINED) {
            return None;
        }
        ARENA.with_borrow(|arena| {
            let entry = arena.numbers.get(self.at as usize);
            let entry = entry.filter(|(epoch, _)| *epoch == self.epoch);
            Some(read(&entry.expect("an exact number outlived its scope").1))
        })
    }

    fn combine(x: Self, y: Self, operation: impl FnOnce(&RBig, &RBig) -> RBig) -> Self {
        let result = x.with(|x| y.with(|y| operation(x, y))).flatten();
        result.map_or(Exact::UNDEFINED, Exact::new)
    }

    fn is(self, fixed: Self) -> bool {
        self.at == fixed.at
    }

    fn sum(x: Self, y: Self) -> Self {
        if x.is(Exact::ZERO) {
            y
        } else if y.is(Exact::ZERO) {
            x
        } else {
            Exact::combine(x, y, |x, y| x + y)
        }
    }

    fn difference(x: Self, y: Self) -> Self {
        if y.is(Exact::ZERO) { x } else { Exact::combine(x, y, |x, y| x - y) }
    }

    fn product(x: Self, y: Self) -> Self {
        if x.is(Exact::ONE) {
            y
        } else if y.is(Exact::ONE) {
            x
        } else {
            Exact::combine(x, y, |x, y| x * y)
        }
    }

    /// Returns x/y, undefined where y is 0.
    fn quotient(x: Self, y: Self) -> Self {
        if y.is(Exact::ZERO) {
            Exact::UNDEFINED
        } else if y.is(Exact::ONE) {
            x
        } else {
            Exact::combine(x, y, |x, y| x / y)
        }
    }

    fn negative(x: Self) -> Self {
        Exact::ZERO - x
    }

    fn vanishes(x: Self) -> bool {
        x.is(Exact::ZERO)
    }
}

operators!(Exact);

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.with(|x| other.with(|y| x.cmp(y))).flatten()
    }
}

impl Subscript for Exact {
    fn index(self) -> usize {
        let whole =
            self.with(|x| if x.is_int() { usize::try_from(x.numerator()).ok() } else { None });
        whole.flatten().unwrap_or_else(|| panic!("{self} is no subscript"))
    }
}

impl Scalar for Exact {
    const EPSILON: f64 = 0.0;

    /// Returns exactly `x`, undefined for an infinity or NaN.
    fn from_f64(x: f64) -> Self {
        RBig::try_from(x).map_or(Exact::UNDEFINED, Exact::new)
    }
    /// Rounds ties to even; an undefined number is NaN.
    fn to_f64(self) -> f64 {
        self.with(rational::nearest).unwrap_or(f64::NAN)
    }
    fn from_decimal(x: f64) -> Self {
        rational::of_decimal(x).map_or(Exact::UNDEFINED, Exact::new)
    }
    fn to_rational(self) -> Option<RBig> {
        self.with(RBig::clone)
    }
    /// The displacements of a solution have long denominators, nearly all of them the same.
    fn over_common(values: Vec<Self>) -> (Vec<Self>, Self) {
        let Some(fractions) = values.iter().map(|x| x.to_rational()).collect::<Option<Vec<_>>>()
        else {
            return (values, Exact::ONE);
        };
        let common =
            fractions.iter().fold(UBig::ONE, |common, x| rational::lcm(common, x.denominator()));
        let whole = |x: &RBig| Exact::new(RBig::from(x.numerator() * (&common / x.denominator())));
        (fractions.iter().map(whole).collect(), Exact::new(RBig::from(common.clone())))
    }
    /// Returns 40 significant digits: the fraction itself may have thousands.
    fn digits(self) -> Option<String> {
        self.with(|x| rational::decimal(x, 40))
    }
    fn root(self) -> Self {
        self.with(rational::root).map_or(Exact::UNDEFINED, Exact::new)
    }
    fn length(x: Self, y: Self) -> Self {
        (x * x + y * y).root()
    }
    fn scale(_: Self) -> Self {
        Exact::ONE
    }
    /// Rounds once, at the root.
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        (factor * scale * scale * square).with(rational::nearest_root).unwrap_or(f64::NAN)
    }
    fn is_finite(self) -> bool {
        !self.is(Exact::UNDEFINED)
    }
}

impl fmt::Display for Exact {
    /// Writes the nearest `f64`: the number itself may have thousands of digits.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.to_f64())
    }
}

impl fmt::Debug for Exact {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.with(|x| write!(f, "{x}")).unwrap_or_else(|| f.write_str("undefined"))
    }
}
