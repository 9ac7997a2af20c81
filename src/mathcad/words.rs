//! What Mathcad's error messages mean, in the languages in which worksheets have them.

use super::failure::Cause;

/// Whether a failure is of one kind.
type IsOf = fn(&Cause) -> bool;

/// Parts of messages in lower case, and the failures that they say. The first that is found decides.
const WORDS: [(&[&str], IsOf); 9] = [
    (
        &["в одной или нескольких указанных точках", "at one or more of the points"],
        |cause| matches!(cause, Cause::Domain { .. }),
    ),
    (
        &["не определена", "неопределена", "is undefined", "is not defined"],
        |cause| matches!(cause, Cause::Undefined { .. }),
    ),
    (&["деление на ноль", "by zero", "singularity"], |cause| {
        matches!(cause, Cause::Singularity { .. })
    }),
    (&["10^307", "с плавающей запятой", "floating point error"], |cause| {
        matches!(cause, Cause::Overflow { .. })
    }),
    (&["индекс массива", "array index"], |cause| {
        use Cause::*;
        matches!(cause, IndexOutside { .. } | IndexBelowOrigin { .. } | IndexNotWhole { .. })
    }),
    (&["размерности массива", "array dimensions", "array sizes"], |cause| {
        matches!(cause, Cause::Sizes { .. })
    }),
    (&["аргумент", "argument"], |cause| matches!(cause, Cause::Arguments { .. })),
    (&["матрица вырождена", "сингулярн", "matrix is singular"], |cause| {
        matches!(cause, Cause::Singular)
    }),
    (
        &[
            "this value must be",
            "must have the form",
            "значение должно",
            "must be an array",
            "must be a scalar",
        ],
        |cause| matches!(cause, Cause::Kind { .. }),
    ),
];

/// Returns whether a message of Mathcad's is of the kind of a failure; nothing if the message is not
/// known.
pub fn is_of(message: &str, cause: &Cause) -> Option<bool> {
    let message = message.to_lowercase();
    let (_, is_of) = WORDS.iter().find(|(all, _)| all.iter().any(|one| message.contains(one)))?;
    Some(is_of(cause))
}
