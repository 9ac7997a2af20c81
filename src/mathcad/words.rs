//! What Mathcad's error messages mean, in the languages in which worksheets have them.

use super::failure::Cause;

/// Kinds of failures that Mathcad and the interpreter tell apart.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Undefined,
    Division,
    Overflow,
    Index,
    Sizes,
    Arguments,
    Singular,
    Domain,
    Type,
}

/// Parts of messages in lower case. The first that is found decides.
const WORDS: [(&str, Kind); 27] = [
    ("в одной или нескольких указанных точках", Kind::Domain),
    ("at one or more of the points", Kind::Domain),
    ("не определена", Kind::Undefined),
    ("неопределена", Kind::Undefined),
    ("is undefined", Kind::Undefined),
    ("is not defined", Kind::Undefined),
    ("деление на ноль", Kind::Division),
    ("by zero", Kind::Division),
    ("singularity", Kind::Division),
    ("10^307", Kind::Overflow),
    ("с плавающей запятой", Kind::Overflow),
    ("floating point error", Kind::Overflow),
    ("индекс массива", Kind::Index),
    ("array index", Kind::Index),
    ("размерности массива", Kind::Sizes),
    ("array dimensions", Kind::Sizes),
    ("array sizes", Kind::Sizes),
    ("аргумент", Kind::Arguments),
    ("argument", Kind::Arguments),
    ("матрица вырождена", Kind::Singular),
    ("сингулярн", Kind::Singular),
    ("matrix is singular", Kind::Singular),
    ("this value must be", Kind::Type),
    ("must have the form", Kind::Type),
    ("значение должно", Kind::Type),
    ("must be an array", Kind::Type),
    ("must be a scalar", Kind::Type),
];

/// Returns whether a message of Mathcad's is of the kind of a failure; nothing if the message is not
/// known.
pub fn is_of(message: &str, cause: &Cause) -> Option<bool> {
    let message = message.to_lowercase();
    let (_, kind) = WORDS.iter().find(|(words, _)| message.contains(words))?;
    let own = match cause {
        Cause::Undefined { .. } => Kind::Undefined,
        Cause::Singularity { .. } => Kind::Division,
        Cause::Overflow { .. } => Kind::Overflow,
        Cause::IndexOutside { .. }
        | Cause::IndexBelowOrigin { .. }
        | Cause::IndexNotWhole { .. } => Kind::Index,
        Cause::Sizes { .. } => Kind::Sizes,
        Cause::Arguments { .. } => Kind::Arguments,
        Cause::Singular => Kind::Singular,
        Cause::Domain { .. } => Kind::Domain,
        Cause::Kind { .. } => Kind::Type,
        Cause::Unsupported { .. }
        | Cause::Function { .. }
        | Cause::NoValue
        | Cause::Range { .. }
        | Cause::OutsideLoop
        | Cause::Complex { .. }
        | Cause::Limit { .. } => return Some(false),
    };
    Some(*kind == own)
}
