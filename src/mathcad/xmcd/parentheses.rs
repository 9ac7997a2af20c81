//! How tightly the text notation binds, and where the two notations differ in parentheses.

use crate::syntax::Level;

/// What the places ask of an expression, in either notation.
pub trait Operand: Copy {
    fn level(self) -> Level;

    /// Returns what stands in the parentheses, if the expression is parenthesised.
    fn inside(self) -> Option<Self>;

    /// Returns whether this is a sign before what binds more tightly than a power.
    fn is_plain_opposite(self) -> bool;

    /// Returns whether this is a name with subscripts.
    fn is_entry(self) -> bool;
}

/// Returns whether the text puts parentheses round an operand that Mathcad's fraction bar holds
/// together: round what binds less tightly than `least`, and round such parentheses themselves.
pub fn in_fraction(x: impl Operand, least: Level) -> bool {
    x.level() < least || x.inside().is_some_and(|x| in_fraction(x, least))
}

/// Returns whether the text puts parentheses round an exponent, which Mathcad raises.
pub fn in_exponent(x: impl Operand) -> bool {
    let bare = x.level() >= Level::Behind || x.is_plain_opposite();
    !bare || x.inside().is_some_and(in_exponent)
}

/// Returns whether Mathcad needs parentheses round what is transposed, where the text has none: the
/// superscript would go to the subscript.
pub fn in_transpose(x: impl Operand) -> bool {
    x.is_entry() || x.inside().is_some_and(in_transpose)
}
