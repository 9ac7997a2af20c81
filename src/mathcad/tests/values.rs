//! Values by themselves: arrays that grow, arrays within arrays, JSON, what a worksheet defines.

use std::rc::Rc;

use mathcad::value::{Grid, Nested};
use mathcad::{Array, Listing, Sheet, Value, json};
use serde_json::json;

/// For places within the array, beyond its rows, beyond its columns, and beyond both.
#[test]
fn what_is_missing_is_what_growing_adds() {
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        let mut array = Array::from_rows(2, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let (rows, cols) = (3.max(i + 1), 2.max(j + 1));
        let missing = array.missing(i, j);
        assert_eq!(missing, rows * cols - 6, "{i}, {j}");
        array.write(i, j, 9.0);
        assert_eq!((array.rows(), array.cols()), (rows, cols));
        assert_eq!(array.entries().count(), 6 + missing);
        assert_eq!(array.get(i, j), Some(&9.0));
        let last = if (i, j) == (2, 1) { 9.0 } else { 6.0 };
        assert_eq!(array.get(2, 1), Some(&last), "the entries keep their places");
    }
}

/// An array within another goes one deeper; what a nested array stores follows its entries.
#[test]
fn nested_arrays_know_their_size_and_depth() {
    let column = Value::from(Array::column(vec![1.0, 2.0, 3.0]));
    assert_eq!((column.count(), column.depth()), (3, 0));
    let nest = |value: &Value| {
        let mut nested = Nested::new(Grid::column(vec![]));
        nested.write(1, 0, value.clone());
        Value::Nested(Rc::new(nested))
    };
    let once = nest(&column);
    assert_eq!((once.count(), once.depth()), (4, 1), "a 0 and three numbers");
    let twice = nest(&once);
    assert_eq!((twice.count(), twice.depth()), (5, 2));
    let made = Nested::new(Grid::column(vec![twice.clone(), 7.0.into(), once]));
    assert_eq!((made.count(), Value::Nested(Rc::new(made)).depth()), (10, 3));
    let mut nested = Nested::new(Grid::column(vec![twice, column.clone()]));
    nested.write(0, 0, 1.0.into());
    assert_eq!(nested.count(), 4, "what is written over counts no more");
    nested.write(1, 1, column);
    assert_eq!(nested.count(), 8, "two new entries, one of them three numbers");
}

#[test]
fn json_spells_values() {
    let read = |value: serde_json::Value| json::read(&value).map(|value| value.to_string());
    assert_eq!(json::read(&json!([])), Ok(Array::default().into()), "no rows, no columns");
    assert_eq!(read(json!([1, 2])), Ok("1; 2".into()));
    assert_eq!(read(json!([[1, 2], [3, 4]])), Ok("1 2; 3 4".into()));
    assert_eq!(read(json!([[1, true], ["a", 4]])), Ok("a 2 x 2 array of arrays".into()));
    for uneven in [json!([[]]), json!([[], []]), json!([[1], [2, 3]]), json!([[1], []])] {
        assert_eq!(read(uneven), Err("expected rows of one length".into()));
    }
    for other in [json!(null), json!({"a": 1}), json!([[1, null]])] {
        assert!(read(other).is_err());
    }
}

#[test]
fn a_name_that_is_removed_stands_for_nothing() {
    let mut sheet = Sheet::default();
    let twice = Listing::parse("twice", "twice(x) :=\n  2·x\n").unwrap();
    sheet.define("twice", 3.0).define_program(twice.into());
    assert_eq!(sheet.value("twice"), Some(3.0.into()));
    assert_eq!(sheet.program("twice").map(|program| program.function()), Some("twice"));
    sheet.remove("twice");
    assert!(sheet.value("twice").is_none() && sheet.program("twice").is_none());
}
