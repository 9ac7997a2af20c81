//! The worksheet's settings, and the limits of a run.

/// What `0/0` gives: the worksheet's `zero-over-zero`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ZeroOverZero {
    /// The division fails, as any division by zero does.
    #[default]
    Error,
    /// The quotient is the number 0.
    Zero,
}

/// How `a ∧ b ∧ ...` is evaluated. Not known for Mathcad 14.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Conjunction {
    /// All operands are evaluated; any false one decides, even if another fails. With none false
    /// and one failed, the first failure stands.
    #[default]
    Guarded,
    /// Operands are evaluated from the left, up to the first false one.
    LeftToRight,
    /// All operands are evaluated, and the first failure stands.
    Eager,
}

/// What a range that ends below its start, as `1 .. 0`, runs through. Not known for Mathcad 14.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Descending {
    /// The range counts down: 1, then 0.
    #[default]
    CountsDown,
    /// The range is empty, and its body does not run.
    Empty,
}

/// The value of a program whose last step is an `if` that was false. Not known for Mathcad 14.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LastIf {
    /// The program has the value of the statement evaluated before it.
    #[default]
    Previous,
    /// The program has the value 0.
    Zero,
}

/// The settings of a worksheet. The defaults are those of a blank Mathcad 14 worksheet, but for
/// `origin`, which the paper's listings need to be 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// `ORIGIN`, the subscript of an array's first entry.
    pub origin: i32,
    /// `zero-over-zero`, what 0/0 gives.
    pub zero_over_zero: ZeroOverZero,
    /// `exact-boolean`: true compares as IEEE 754 does; false takes two numbers as equal when they
    /// differ by less than 1e-12 of their mean, in `<` and its kin too.
    pub exact_boolean: bool,
    /// Whether numbers below 1e-307 in magnitude count as 0 in comparisons, as Mathcad's help
    /// describes; otherwise comparisons are those of IEEE 754.
    pub tiny_is_zero: bool,
    /// The method by which `∧` is evaluated.
    pub conjunction: Conjunction,
    /// What a descending range does.
    pub descending: Descending,
    /// The value of a program that ends in an `if` that was false.
    pub last_if: LastIf,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            origin: 1,
            zero_over_zero: ZeroOverZero::default(),
            exact_boolean: true,
            tiny_is_zero: false,
            conjunction: Conjunction::default(),
            descending: Descending::default(),
            last_if: LastIf::default(),
        }
    }
}

/// How much a listing may ask for before it is refused. Beyond a limit stands an error, never a
/// hang, an overflowing stack or an exhausted memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The number of lines of a listing.
    pub lines: usize,
    /// The number of characters of one line.
    pub characters: usize,
    /// The levels of an expression's operators and brackets, and of blocks within blocks.
    pub depth: usize,
    /// The numbers that all arrays and trace lines of a run may store together, eight bytes each.
    pub entries: usize,
    /// The statements executed, plus the numbers that array operations work through.
    pub steps: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { lines: 1_000, characters: 2_000, depth: 64, entries: 1 << 26, steps: 1 << 30 }
    }
}
