//! The worksheet's settings, and the limits of a run.

use std::str::FromStr;

use base::choices;
use serde::Serialize;

choices! {
    /// R4, c_cnt 17 and 18: the evaluation of `a ∧ b ∧ ...`. Not known for Mathcad 14.
    Conjunction {
        /// All operands are evaluated; any false one decides, even if another fails. With none
        /// false and one failed, the first failure stands.
        Guarded = "guarded",
        /// Operands are evaluated from the left, up to the first false one.
        LeftToRight = "left-to-right",
        /// All operands are evaluated, and the first failure stands.
        Eager = "eager",
    }
}

/// The settings of a worksheet. The defaults are those of a blank Mathcad 14 worksheet, but for
/// `origin`, which the paper's listings need to be 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// `ORIGIN`, the subscript of an array's first entry.
    pub origin: i32,
    /// `zero-over-zero`: whether 0/0 is 0; otherwise it fails, as any division by zero does.
    pub zero_over_zero_is_zero: bool,
    /// `exact-boolean`: true compares as IEEE 754 does; false takes two numbers as equal when they
    /// differ by less than 1e-12 of their mean, in `<` and its kin too.
    pub exact_boolean: bool,
    /// Whether numbers below 1e-307 in magnitude count as 0 in comparisons, as Mathcad's help
    /// describes; otherwise comparisons are those of IEEE 754.
    pub tiny_is_zero: bool,
    /// The method by which `∧` is evaluated.
    pub conjunction: Conjunction,
    /// Whether a range that ends below its start, as `1 .. 0`, is empty; otherwise it counts down:
    /// 1, then 0. Not known for Mathcad 14.
    pub descending_is_empty: bool,
    /// Whether a program whose last step is an `if` that was false has the value 0; otherwise it
    /// has that of the statement evaluated before. Not known for Mathcad 14.
    pub last_if_is_zero: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            origin: 1,
            zero_over_zero_is_zero: false,
            exact_boolean: true,
            tiny_is_zero: false,
            conjunction: Conjunction::default(),
            descending_is_empty: false,
            last_if_is_zero: false,
        }
    }
}

impl FromStr for Settings {
    type Err = String;

    /// Reads a list such as `origin=0,zero-over-zero=error`; other settings keep their default.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut settings = Settings::default();
        for item in text.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let (name, value) = item
                .split_once('=')
                .ok_or_else(|| format!("{item:?} is not of the form origin=0"))?;
            let choice = |no, yes| match value {
                v if v == no => Ok(false),
                v if v == yes => Ok(true),
                _ => Err(format!("{name}: {value:?} is neither {no} nor {yes}")),
            };
            match name {
                "origin" => {
                    settings.origin = value.parse().map_err(|_| {
                        format!("origin: {value:?} is no whole number of at most nine digits")
                    })?;
                }
                "zero-over-zero" => settings.zero_over_zero_is_zero = choice("error", "0")?,
                "exact-boolean" => settings.exact_boolean = choice("false", "true")?,
                "tiny" => settings.tiny_is_zero = choice("itself", "0")?,
                "conjunction" => settings.conjunction = value.parse()?,
                "descending" => settings.descending_is_empty = choice("counts-down", "empty")?,
                "last-if" => settings.last_if_is_zero = choice("previous", "0")?,
                _ => return Err(format!("{name:?} is no setting")),
            }
        }
        Ok(settings)
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
    /// The levels of blocks and expressions of all functions that call one another.
    pub calls: usize,
    /// The numbers that all arrays and trace lines of a run may store together, eight bytes each.
    pub entries: usize,
    /// The statements and expressions executed, plus the numbers that array operations work through,
    /// and what functions take: about 15 ns each.
    pub steps: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            lines: 1_000,
            characters: 2_000,
            depth: 64,
            calls: 600,
            entries: 1 << 26,
            steps: 1 << 30,
        }
    }
}
