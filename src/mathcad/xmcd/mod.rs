//! The second notation: XMCD, the XML of a worksheet that Mathcad 13 to 15 open and save.
//!
//! What is read becomes the text notation of `listings/README.md`, and with it the one syntax tree;
//! what is written comes from that tree. Parentheses differ: a fraction's bar and an exponent's
//! place need none in Mathcad, and a transposed entry needs some. Both directions follow
//! `parentheses`, so that a listing comes back byte for byte.

pub mod document;
pub mod page;
mod parentheses;
pub mod read;
mod scan;
pub mod write;

/// A construct that the interpreter does not have, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported(pub String);

/// The operators of one operand or two that are functions in the text: the operator's element, the
/// function, and the number of operands.
const FUNCTIONS: [(&str, &str, usize); 8] = [
    ("ml:sqrt", "√", 1),
    ("ml:nthRoot", "√", 2),
    ("ml:log", "log", 2),
    ("ml:vectorSum", "∑", 1),
    ("ml:determinant", "determinant", 1),
    ("ml:factorial", "factorial", 1),
    ("ml:crossProduct", "×", 2),
    ("ml:vectorize", "→", 1),
];

/// Returns the name of an element without that of its namespace.
fn tag(element: &'static str) -> &'static str {
    element.trim_start_matches("ml:")
}
