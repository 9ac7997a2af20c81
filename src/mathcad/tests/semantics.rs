//! Rules that take more than a line of `rules.txt`.

use super::{called, outcome, program, value};
use mathcad::{Array, Cause, Conjunction, Limits, Settings, Sheet, Value};

#[test]
fn writes_to_the_worksheet_s_names_are_local() {
    let listing = program("v[1] ← v[1] + x\nv");
    let mut worksheet = Sheet::empty();
    worksheet.define("v", Array::column(vec![1.0, 2.0]));
    let mut runner = listing.runner(&worksheet, &Settings::default(), &Limits::default());
    for _ in 0..2 {
        let outcome = runner.call(&[Value::Number(5.0)]).unwrap();
        assert_eq!(outcome.value.to_string(), "6; 2");
        assert_eq!(outcome.locals.keys().collect::<Vec<_>>(), ["v"]);
    }
}

/// Each setting by its words; what is not named keeps its default.
#[test]
fn settings_are_read_by_their_names() {
    let read = |text: &str| text.parse::<Settings>();
    assert_eq!(read(""), Ok(Settings::default()));
    assert_eq!(
        read("conjunction=eager"),
        Ok(Settings { conjunction: Conjunction::Eager, ..Settings::default() })
    );
    let all = "origin=-1, zero-over-zero=0, exact-boolean=false, tiny=0, \
               conjunction=left-to-right, descending=empty, last-if=0";
    let other = Settings {
        origin: -1,
        zero_over_zero_is_zero: true,
        exact_boolean: false,
        tiny_is_zero: true,
        conjunction: Conjunction::LeftToRight,
        descending_is_empty: true,
        last_if_is_zero: true,
    };
    assert_eq!(read(all), Ok(other));
    for wrong in ["conjunction=lazy", "tiny=1", "origin=0.5", "origin", "colour=red"] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
}

/// An array without entries has no determinant and no inverse, and is an entry as any other.
#[test]
fn an_empty_array_is_no_square_matrix() {
    let mut worksheet = Sheet::empty();
    worksheet.define("a", Array::default());
    let outcome = called(&program("b[2] ← a\nrows(b)"), &worksheet, &Settings::default());
    assert_eq!(outcome.unwrap().value, Value::Number(2.0));
    for body in ["|a|", "a^(−1)", "determinant(a)"] {
        let cause = called(&program(body), &worksheet, &Settings::default()).unwrap_err().cause;
        assert!(matches!(cause, Cause::Kind { expected: "a square matrix", .. }), "{body}");
    }
}

#[test]
fn functions_from_outside() {
    let listing = program("y ← D(x, 2)\nD(y, 0)");
    let mut worksheet = Sheet::empty();
    worksheet.define_function("D", |arguments| match arguments {
        [Value::Number(x), Value::Number(y)] if *y > 0.0 => Ok(Value::Number(x * y)),
        _ => Err("y must be above 0".into()),
    });
    let mut runner = listing.runner(&worksheet, &Settings::default(), &Limits::default());
    let failure = runner.call(&[Value::Number(3.0)]).unwrap_err();
    assert_eq!(
        failure.cause,
        Cause::Function { name: "D".into(), message: "y must be above 0".into() }
    );
    assert_eq!((failure.line, failure.text.as_str()), (3, "D(y, 0)"));
    assert_eq!(runner.call(&[]).unwrap_err().cause, Cause::Arguments { expected: 1, found: 0 });
}

/// What a copy has of its own, the array that it was copied from has not.
#[test]
fn arrays_within_arrays_are_values() {
    let locals = outcome("a[1] ← v\nb ← a\nb[1] ← 1\na", &Settings::default()).unwrap().locals;
    assert_eq!((locals["a"].count(), locals["b"].count()), (3, 1));
}

/// AEkaterina lab_1 61: a row times a column is saved as a number.
#[test]
fn a_scalar_product_is_a_number() {
    assert_eq!(outcome("vᵀ·v", &Settings::default()).unwrap().value, Value::Number(14.0));
}

#[test]
fn trace_prints_and_returns_a_string() {
    let run = outcome("trace(x)\ny ← trace(v[2], 0.5)\ny", &Settings::default()).unwrap();
    assert_eq!(run.trace_output, ["5", "2 0.5"]);
    assert_eq!(run.value, Value::Text("2 0.5".into()));
}

#[test]
fn a_worksheet_has_arrays_of_arrays() {
    let mut worksheet = Sheet::empty();
    worksheet.define("B", [1.0, 2.0].map(Value::from).into_iter().collect::<Value>());
    let outcome = called(&program("B[2]·x"), &worksheet, &Settings::default());
    assert_eq!(outcome.unwrap().value, Value::Number(10.0));
}

#[test]
fn sines_of_small_angles_are_near_the_library_s() {
    for n in -50..50 {
        let x = f64::from(n) / 7.0;
        let of = |f: &str| value(&format!("{f}({})", x.to_string().replace('-', "−")));
        let near = |f: &str, y: f64| (of(f).parse::<f64>().unwrap() - y).abs() <= 1e-13 * y.abs();
        assert!(near("sin", x.sin()) && near("cos", x.cos()) && near("tan", x.tan()), "{x}");
    }
}
