//! What every answer of the program is, whatever it was asked: errors say who is to blame, documents
//! explain each null, and nothing is infinite or no number.

use plane_contact::Error;
use plane_contact::error::InputError;
use plane_contact::input::Variant;
use plane_contact::output::failure::failure;
use serde_json::Value;

/// An error of the input says what is wrong, and how to fix it.
pub fn input_error(error: &InputError) {
    assert!(!error.what.is_empty() && !error.fix.is_empty(), "{error:?}");
}

/// A run fails by the input, by the listings that only the paper's variants execute, or for want of
/// an equilibrium, which only `unilateral` looks for.
pub fn failed_run(error: &Error, variant: Variant) {
    let is_unilateral = variant == Variant::Unilateral;
    match error {
        Error::Input(why) => input_error(why),
        Error::Listing(_) | Error::Execution(_) | Error::Singular(_) => {
            assert!(!is_unilateral, "unilateral executes no listing: {error}");
        }
        Error::Equilibrium(_) => assert!(is_unilateral, "{variant} seeks none: {error}"),
    }
    document(&failure(error));
}

/// The fields that are null where there is nothing to say, and are never made of a number.
const ABSENT: [&str; 4] = ["contact", "half", "idle", "path"];

/// A document is JSON, and gives a reason for every number that is null: JSON has no other way to
/// write what is infinite or no number.
pub fn document(text: &str) -> Value {
    let document: Value = serde_json::from_str(text).expect("a document is JSON");
    for field in nulls(&document, "").into_iter().filter(|field| !ABSENT.contains(field)) {
        let reason = document["nulls"][field].as_str().unwrap_or_default();
        assert!(!["", "there is none"].contains(&reason), "{field} is null: {reason:?}\n{text}");
    }
    document
}

/// Returns the names of the fields that are null.
pub fn nulls<'a>(value: &'a Value, field: &'a str) -> Vec<&'a str> {
    match value {
        Value::Null => vec![field],
        Value::Array(values) => values.iter().flat_map(|value| nulls(value, field)).collect(),
        Value::Object(fields) => {
            fields.iter().flat_map(|(field, value)| nulls(value, field)).collect()
        }
        _ => Vec::new(),
    }
}

/// A text for people has a dash where a number has no value.
#[track_caller]
pub fn text(text: &str) {
    for word in text.split(|c: char| c.is_whitespace() || ",;()=".contains(c)) {
        assert!(!["inf", "-inf", "NaN"].contains(&word), "{word} in\n{text}");
    }
}
