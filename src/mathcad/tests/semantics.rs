//! Each rule of `src/mathcad/README.md`, on the smallest listing that shows it.

use super::{failure, failure_under, outcome, program, value, value_under};
use mathcad::failure::Subscripts;
use mathcad::{Array, Cause, Conjunction, Limits, Settings, Value};

fn with(change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    change(&mut settings);
    settings
}

#[test]
fn origin() {
    assert_eq!(value("v[1]"), "1");
    let from_zero = with(|s| s.origin = 0);
    assert_eq!(value_under(&from_zero, "v[2]"), "3");
    assert_eq!(value_under(&from_zero, "a[2] ← 7\na"), "0; 0; 7");
    assert_eq!(value_under(&with(|s| s.origin = -1), "v[−1]"), "1");
}

#[test]
fn assignment_creates_and_grows_arrays() {
    assert_eq!(value("a[3] ← 7\na"), "0; 0; 7");
    assert_eq!(value("a[2,3] ← 7\na"), "0 0 0; 0 0 7");
    assert_eq!(value("a[1,1] ← 1\na[2,1] ← 2\na[1,2] ← 3\na"), "1 3; 2 0");
    assert_eq!(value("a[2] ← 1\na[1,2] ← 3\na"), "0 3; 1 0");
    assert_eq!(value("a[2,1] ← 1\na[2]"), "1", "a matrix of one column is a column");
    assert_eq!(value("v[5] ← 9\nrows(v)"), "5");
}

#[test]
fn reading_outside_is_an_error() {
    let subscripts = Subscripts { row: 4.0, col: None };
    assert_eq!(
        failure("v[4]"),
        Cause::IndexOutside { name: "v".into(), subscripts, rows: 3, cols: 1 }
    );
    let message = outcome("y ← 1 + v[x − 1]", &Settings::default()).unwrap_err().to_string();
    let expected = "f, line 2: This array index is invalid for this array. v[4] of 3 x 1 entries. \
                    In `v[x − 1]`, column 9 of `y ← 1 + v[x − 1]`.";
    assert_eq!(message, expected);
    assert!(matches!(failure("m[1,3]"), Cause::IndexOutside { cols: 2, .. }));
    assert!(matches!(failure("m[1]"), Cause::IndexOutside { .. }), "a matrix takes two subscripts");
    assert!(matches!(failure("m[1] ← 0"), Cause::IndexOutside { .. }), "also in writing");
    let of_its_own = "a[2,2] ← 1\na[1] ← 5";
    assert!(matches!(failure(of_its_own), Cause::IndexOutside { .. }), "to the program's own");
    assert!(matches!(failure("a[1,2] ← v\na[1]"), Cause::IndexOutside { .. }), "of arrays too");
    let (_, huge) = failure_under(&with(|s| s.origin = -1), "v[1E19]");
    assert!(matches!(huge, Cause::IndexOutside { .. }), "however far outside");
    let below = Cause::IndexBelowOrigin {
        name: "v".into(),
        subscripts: Subscripts { row: 0.0, col: None },
        origin: 1,
    };
    assert_eq!(failure("v[0]"), below);
    assert_eq!(failure("v[0] ← 1"), below);
    assert!(below.to_string().starts_with("This array index is invalid for this array."));
}

#[test]
fn subscripts_are_whole() {
    assert!(matches!(failure("v[1.5]"), Cause::IndexNotWhole { .. }));
    assert!(matches!(failure("v[3 / 2] ← 1"), Cause::IndexNotWhole { .. }));
    assert!(matches!(failure("v[v]"), Cause::Kind { .. }));
    assert!(matches!(failure("x[1]"), Cause::Kind { .. }), "a number has no entries");
}

/// DBosiy/iSET, example 498 to 502, result 875: a table that begins as the number 1 has six
/// entries, each an array, and no trace of the 1.
#[test]
fn an_entry_assigned_to_a_number_makes_it_an_array() {
    assert_eq!(value("x[2] ← 7\nx"), "0; 7", "the number is gone");
    assert_eq!(value("rows(x)"), "0");
    assert_eq!(value("for k ∈ 1 .. 3\n  x[rows(x) + 1] ← 10·k\nx"), "10; 20; 30");
    assert_eq!(value("for k ∈ 1 .. 3\n  x[rows(x) + 1] ← (k   k·v)ᵀ\n((x[3])[2])[1]"), "3");
    assert_eq!(value("a[2] ← v\n(rows(a)   a[1]   (a[2])[3])"), "2 0 3", "entries between are 0");
    assert_eq!(value("a[1,2] ← m\na[1,1] ← 5\n(a[1,1]   (a[1,2])[2,1])"), "5 3");
    assert_eq!(value("a[1] ← v\na[1] ← 2\na[1]"), "2", "and a number again");
    assert_eq!(value("m[1,1] ← v\n(m[1,2]   m[2,1]   m[2,2])"), "2 3 4", "the others stay");
    let locals = outcome("a[1] ← v\nb ← a\nb[1] ← 1\na", &Settings::default()).unwrap().locals;
    assert_eq!((locals["a"].count(), locals["b"].count()), (3, 1), "arrays of arrays are values");
}

#[test]
fn arrays_are_values() {
    assert_eq!(value("w ← v\nw[1] ← 9\nv"), "1; 2; 3");
    assert_eq!(value("w ← v\nv[1] ← 9\nw"), "1; 2; 3");
    assert_eq!(value("w ← v\nw[1] ← 9\nw"), "9; 2; 3");
}

#[test]
fn writes_to_the_worksheet_s_names_are_local() {
    let listing = program("v[1] ← v[1] + x\nv");
    let mut worksheet = listing.runner(&Settings::default(), &Limits::default());
    worksheet.define("v", Array::column(vec![1.0, 2.0]));
    for _ in 0..2 {
        let outcome = worksheet.call(&[Value::Number(5.0)]).unwrap();
        assert_eq!(outcome.value.to_string(), "6; 2");
        assert_eq!(outcome.locals.keys().collect::<Vec<_>>(), ["v"]);
    }
}

#[test]
fn a_program_is_worth_its_last_statement() {
    assert_eq!(value("1\n2"), "2");
    assert_eq!(value("y ← 3"), "3");
    assert_eq!(value("for i ∈ 1 .. 3\n  10·i"), "30");
    assert_eq!(value("if x > 0\n  7"), "7");
    assert_eq!(value("7\ny ← 1 if x < 0"), "7", "the one before");
    assert_eq!(value_under(&with(|s| s.last_if_is_zero = true), "7\ny ← 1 if x < 0"), "0");
    assert_eq!(failure("y ← 1 if x < 0"), Cause::NoValue);
}

#[test]
fn division_by_zero() {
    assert_eq!(failure("x / 0"), Cause::Singularity { numerator: 5.0, denominator: 0.0 });
    assert_eq!(failure("0 / 0"), Cause::Singularity { numerator: 0.0, denominator: 0.0 });
    let zero = with(|s| s.zero_over_zero_is_zero = true);
    assert_eq!(value_under(&zero, "0 / 0"), "0");
    assert!(matches!(failure_under(&zero, "x / 0"), (2, Cause::Singularity { .. })));
    // xmcd 0.4.0, errors-mathcad14.xmcd, region 13.
    let words = "Division by zero. («Деление на ноль.» in Mathcad 14.1.) 5/0.";
    assert_eq!(failure("x / 0").to_string(), words);
}

#[test]
fn overflow() {
    let huge = format!("y ← 1{}\n", "0".repeat(200));
    assert_eq!(failure(&format!("{huge}y·y")), Cause::Overflow { result: f64::INFINITY });
    assert_eq!(failure(&format!("{huge}y·−y")), Cause::Overflow { result: f64::NEG_INFINITY });
    assert!(matches!(failure(&format!("{huge}v·y·y")), Cause::Overflow { .. }), "in arrays too");
    assert_eq!(value(&format!("{huge}1 / y / y")), "0", "underflow is none");
}

#[test]
fn comparisons() {
    let comparisons = "(1 < 2   2 < 1   1 ≤ 1   2 > 1   1 ≥ 2   1 = 1   1 ≠ 1)";
    assert_eq!(value(comparisons), "1 0 1 1 0 1 0");
    let close = "y ← 1 + 1 / 10000000000000\n(y = 1   y ≠ 1   y > 1   y ≤ 1   1 < y   1 ≥ y)";
    assert_eq!(value(close), "0 1 1 0 1 0", "exact");
    let relative = with(|s| s.exact_boolean = false);
    assert_eq!(value_under(&relative, close), "1 0 0 1 0 1", "to 1e-12");
    assert_eq!(value_under(&relative, "(0 = 0   1 = −1   1 = 1.0001)"), "1 0 0");
    // The mean is that of both numbers, far from 1 too.
    for (x, same) in [("1000.0000000007", "1"), ("1000.0000000015", "0")] {
        let lines = format!("({x} = 1000   1000 = {x}   {x} ≠ 1000)");
        let expected = format!("{same} {same} {}", u8::from(same == "0"));
        assert_eq!(value_under(&relative, &lines), expected, "{x}");
    }
    let just = "(1000000000000.5 = 999999999999.5   1000000000000.4 = 999999999999.6)";
    assert_eq!(value_under(&relative, just), "0 1", "a difference of 1e-12 of the mean is one");
}

/// Snelast 153 (0.8 at α = 15; taken from the left, `30 < α` = 0 would be below 60).
#[test]
fn chains_of_comparisons() {
    assert_eq!(value("(3 < 2 < 5   1 < 2 < 3   1 ≤ 1 < 2 > 0 ≠ 1)"), "0 1 1");
    assert_eq!(value("(3 > 2 > 1   (3 > 2) > 1   ¬3 < 2 < 5)"), "1 0 1", "but with parentheses");
    let between = "y ← 15\n0.8 if 0 ≤ y ≤ 30\n1.2 if 30 < y < 60";
    assert_eq!(value(between), "0.8");
}

/// Olivka73/numerical_methods lab6 101; evelinalevina ЛР2 319, whose order of products this is.
#[test]
fn powers_of_arrays() {
    assert_eq!(value("v^2"), "1; 4; 9");
    assert_eq!(value("(1 2; 3 4)^3"), "37 54; 81 118");
    assert_eq!(value("(1 2; 3 4)^1"), "1 2; 3 4");
    let by_squares = "m ← (0.1 0.3; 0.7 0.2)\nm^7 − (m^2·m^2)·(m^2·m)";
    assert_eq!(value(by_squares), "0 0; 0 0");
    assert!(matches!(failure("(1 2; 3 4)^1.5"), Cause::Kind { .. }));
    assert!(matches!(failure("(1 2 3; 3 4 5)^2"), Cause::Sizes { .. }));
}

/// Ryu-ko/OKG lab0 584.
#[test]
fn functions_of_arrays() {
    assert_eq!(value("floor(v / 2)"), "0; 1; 1");
    assert!(matches!(failure("ln(v − v)"), Cause::Domain { .. }));
}

/// Of four entries it is the difference of the products, not what an elimination leaves.
#[test]
fn a_determinant_of_two_rows_takes_no_quotient() {
    for [a, b, c, d] in [[0.1, 0.3, 0.7, 0.9], [3.3, 0.1, 0.7, 1.9], [0.3, 1.7, 2.9, 0.7]] {
        let matrix = format!("m ← ({a} {b}; {c} {d})\n|m|");
        assert_eq!(value(&matrix), (a * d - b * c).to_string(), "{matrix}");
    }
}

/// Ryu-ko/OKG 14334 (the sine of π), SunGrow Lab7_Var5 15 (what a cosine of 1e12 was added to).
#[test]
fn sines_and_cosines_are_those_of_x87() {
    assert_eq!(value("sin(3.1415926535897931)"), "0.00000000000000012246063538223773");
    assert_eq!(value("cos(3.1415926535897931 / 2)"), "0.00000000000000006123031769111886");
    assert_eq!(value("tan(3.1415926535897931)"), "-0.00000000000000012246063538223773");
    let trapezoid = "x ← 10^−6\n(cos(1 / x^2)·(1 / √(x)) + cos(1)) / 2";
    assert_eq!(value(trapezoid), "395.9933024728381");
    for n in -50..50 {
        let x = f64::from(n) / 7.0;
        let of = |f: &str| value(&format!("{f}({})", x.to_string().replace('-', "−")));
        let near = |f: &str, y: f64| (of(f).parse::<f64>().unwrap() - y).abs() <= 1e-13 * y.abs();
        assert!(near("sin", x.sin()) && near("cos", x.cos()) && near("tan", x.tan()), "{x}");
    }
}

/// The exact sines of what x is beyond a multiple of x87's π/2, rounded: where the part of it that
/// a double cannot hold decides the last digit. From 2^53 multiples on, the sines are the true
/// ones.
#[test]
fn sines_keep_what_is_left_of_the_reduction() {
    for (x, sine) in [
        ("13.2", "0.592073514707223"),
        ("11.9", "-0.6181371122370333"),
        ("4.76", "-0.9988668094904142"),
        ("10.83", "-0.9863238646169981"),
        ("10^20", "-0.6452512852657808"),
        ("13.071", "0.4834830548776953"),
        ("19.361", "0.4894370489773324"),
        ("16.216", "-0.48646287584410186"),
        ("65.722", "0.24880448149893727"),
    ] {
        assert_eq!(value(&format!("sin({x})")), sine, "{x}");
    }
    for (x, cosine) in [
        ("2.082", "-0.48922739216531747"),
        ("33.495", "-0.4866729041568579"),
        ("4.191", "-0.4980850419671549"),
        ("5.227", "0.49219628498505913"),
    ] {
        assert_eq!(value(&format!("cos({x})")), cosine, "{x}");
    }
}

#[test]
fn tiny_numbers_compare_as_zero_if_asked_to() {
    let tiny = format!("y ← 1 / 1{}\n(y = 0   y > 0)", "0".repeat(308));
    assert_eq!(value(&tiny), "0 1");
    assert_eq!(value_under(&with(|s| s.tiny_is_zero = true), &tiny), "1 0");
    let limit = "(1E-307 = 0   9E-308 = 0   −1E-307 = 0   −9E-308 = 0   1E-306 = 2E-306)";
    assert_eq!(value_under(&with(|s| s.tiny_is_zero = true), limit), "0 1 0 1 0");
}

#[test]
fn conjunction_guarded() {
    assert_eq!(value("v[0] > 0 ∧ x < 0"), "0", "a false operand decides, though another failed");
    assert_eq!(value("x < 0 ∧ v[0] > 0"), "0");
    assert_eq!(value("x > 0 ∧ v[1] > 0 ∧ 2"), "1");
    assert!(
        matches!(failure("v[0] > 0 ∧ x > 0"), Cause::IndexBelowOrigin { .. }),
        "no operand is false"
    );
    assert!(
        matches!(failure("v[9] > 0 ∧ v[0] > 0"), Cause::IndexOutside { .. }),
        "the first failure stands"
    );
}

#[test]
fn conjunction_left_to_right() {
    let settings = with(|s| s.conjunction = Conjunction::LeftToRight);
    assert_eq!(value_under(&settings, "x < 0 ∧ v[0] > 0"), "0");
    assert!(matches!(
        failure_under(&settings, "v[0] > 0 ∧ x < 0"),
        (2, Cause::IndexBelowOrigin { .. })
    ));
}

#[test]
fn conjunction_eager() {
    let settings = with(|s| s.conjunction = Conjunction::Eager);
    assert_eq!(value_under(&settings, "x < 0 ∧ v[1] > 0"), "0");
    assert!(matches!(
        failure_under(&settings, "x < 0 ∧ v[0] > 0"),
        (2, Cause::IndexBelowOrigin { .. })
    ));
}

/// `∨` follows `∧`, with true for false.
#[test]
fn disjunction_follows_conjunction() {
    let [eager, from_left] = [Conjunction::Eager, Conjunction::LeftToRight]
        .map(|conjunction| with(|s| s.conjunction = conjunction));
    let decided = "x > 0 ∨ v[0] > 0";
    assert_eq!(value(decided), "1", "a true operand decides, though another failed");
    assert_eq!(value_under(&from_left, decided), "1", "and what follows it is not evaluated");
    for (settings, lines) in [(eager, decided), (from_left, "v[0] > 0 ∨ x > 0")] {
        let (line, cause) = failure_under(&settings, lines);
        assert!(matches!((line, cause), (2, Cause::IndexBelowOrigin { .. })), "{settings:?}");
    }
}

/// Each setting by its words; what is not named keeps its default.
#[test]
fn settings_are_read_by_their_names() {
    let read = |text: &str| text.parse::<Settings>();
    assert_eq!(read(""), Ok(Settings::default()));
    assert_eq!(read("conjunction=eager"), Ok(with(|s| s.conjunction = Conjunction::Eager)));
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

#[test]
fn descending_ranges() {
    let lines = "n ← 0\nfor i ∈ 1 .. 0\n  n ← n + 1\n  a[n] ← i\nn";
    let run = outcome(lines, &Settings::default()).unwrap();
    assert_eq!((run.value.to_string(), run.locals["a"].to_string()), ("2".into(), "1; 0".into()));
    assert_eq!(value_under(&with(|s| s.descending_is_empty = true), lines), "0");
}

#[test]
fn loops() {
    assert_eq!(value("for i ∈ 1 .. 3\n  y ← i\ni"), "3", "the variable keeps its last value");
    assert_eq!(
        value("n ← 3\ny ← 0\nfor i ∈ 1 .. n\n  n ← 9\n  y ← y + 1\ny"),
        "3",
        "the range is fixed on entry"
    );
    let nested = "y ← 0\nfor i ∈ 1 .. 3\n  for i ∈ 1 .. 2\n    y ← y + i\n(y   i)";
    assert_eq!(value(nested), "9 2", "an inner loop leaves the outer range alone");
    assert_eq!(value("y ← 0\nfor i ∈ 1 .. 2.5\n  y ← i\ny"), "2");
    assert_eq!(
        value("y ← 7\nfor i ∈ 1 .. 3 if x < 0\n  y ← i\ny"),
        "7",
        "the condition guards the loop"
    );
    assert_eq!(
        value("y ← 7\nfor i ∈ 1 .. 3 if x > 0\n  y ← i\n  x ← −1\ny"),
        "3",
        "and is asked once"
    );
}

#[test]
fn names() {
    assert_eq!(failure("y"), Cause::Undefined { name: "y".into() });
    assert_eq!(failure("y[1]"), Cause::Undefined { name: "y".into() });
    assert_eq!(failure("g(1)"), Cause::Undefined { name: "g".into() });
    assert_eq!(
        failure_under(&Settings::default(), "y ← 1\n\nz"),
        (3, Cause::Undefined { name: "z".into() })
    );
}

/// evelinalevina/mathcad, program 108, result 179: a sum whose name has no value before its first
/// turn is 6; SunGrow/Num_Methods, Lab8_Var5 184 and 235: two names assigned on ways not taken are
/// equal.
#[test]
fn a_local_name_without_a_value_is_0() {
    assert_eq!(value("for k ∈ 1 .. 3\n  if v[k] > 0\n    y ← y + v[k]"), "6");
    assert_eq!(value("if x < 0\n  y ← 1\n  z ← 2\n(y   z   y = z)"), "0 0 1");
    assert_eq!(value("y[rows(y) + 1] ← 4\ny"), "4");
    assert_eq!(value("w ← 1 if x < 0\nw + v[1]"), "1", "its own, though v is the worksheet's");
    assert_eq!(failure("y + 1"), Cause::Undefined { name: "y".into() }, "no line assigns y");
}

#[test]
fn functions() {
    assert_eq!(value("rows(v)"), "3");
    assert_eq!(value("rows(m)"), "2");
    assert_eq!(value("(min(v)   max(v)   min(4, m, 2)   max(m, 9))"), "1 3 1 9");
    assert_eq!(value("identity(2)"), "1 0; 0 1");
    assert_eq!(value("identity(2)·0"), "0 0; 0 0");
    assert!(matches!(failure("rows(v, v)"), Cause::Arguments { expected: 1, found: 2 }));
    assert!(matches!(failure("identity(1.5)"), Cause::Kind { .. }));
    assert!(matches!(failure("min()"), Cause::Kind { .. }));
}

/// What worksheets of others use beyond the paper's listings; values saved by Mathcad 14.1.5 are
/// those of the worksheets of xmcd 0.4.0.
#[test]
fn functions_of_matrices() {
    assert_eq!(
        value("(cols(m)   length(v)   rows(augment(m, m))   cols(augment(m, m)))"),
        "2 3 2 4"
    );
    assert_eq!(value("stack(m, m)"), "1 2; 3 4; 1 2; 3 4");
    assert_eq!(value("submatrix(m, 2, 2, 1, 2)"), "3 4");
    assert_eq!(value("lsolve((2 1; 1 3), (5; 10))"), "1; 3", "numerics 14");
    assert_eq!(value("m⟨2⟩"), "2; 4");
    assert_eq!(value("|m|"), "-2", "core 6");
    assert_eq!(value("|identity(4)·2|"), "16");
    assert_eq!(value("|(0 1 0; 1 0 0; 0 0 1)|"), "-1", "a row exchanged");
    assert_eq!(value("∑((1; 2; 3))"), "6", "advanced 18");
    assert_eq!(value("∏(i ∈ 1 .. 5, i)"), "120", "advanced 19");
    assert!(failure("∏(v)").to_string().contains("it multiplies over a range"));
    assert_eq!(value("∑(i ∈ 1 .. x, i)"), "15", "core 12");
    assert_eq!(value("i ← 9\n∑(i ∈ 1 .. 2, i)·10 + i"), "39", "its variable is its own");
    assert_eq!(value("(2 1; 1 1)^−1"), "1 -1; -1 2");
    assert_eq!(value("(0 2; 4 0)^−1"), "0 0.25; 0.5 0", "a row exchanged");
    assert!(matches!(failure("(m·0)^−1"), Cause::Singular));
    assert!(matches!(failure("v^−1"), Cause::Kind { .. }));
    assert!(matches!(failure("lsolve(m·0, (1; 1))"), Cause::Singular));
    assert!(matches!(failure("lsolve(m, v)"), Cause::Sizes { .. }));
    assert!(matches!(failure("augment(m, v)"), Cause::Sizes { .. }));
    for part in ["1, 3, 1, 1", "1, 1, 1, 3", "2, 1, 1, 1", "1, 1, 2, 1", "2, 1, 2, 1"] {
        let failure = failure(&format!("submatrix(m, {part})"));
        assert!(matches!(failure, Cause::IndexOutside { .. }), "{part}");
    }
    assert!(matches!(failure("m⟨0⟩"), Cause::IndexBelowOrigin { .. }));
}

/// The pivot of a column is its largest entry; of equal ones it is the first, which decides how the
/// result rounds.
#[test]
fn of_equal_pivots_the_first_is_taken() {
    assert_eq!(value("|(0.2 0.6 0.1; 0.2 0.1 0.9; 0.1 0.7 0.4)|"), "-0.099");
    assert_eq!(value("|(0.2 0.1 0.9; 0.2 0.6 0.1; 0.1 0.7 0.4)|"), "0.09899999999999999");
}

/// An array without entries has no determinant and no inverse.
#[test]
fn an_empty_array_is_no_square_matrix() {
    for body in ["|a|", "a^(−1)", "determinant(a)"] {
        let listing = program(body);
        let mut worksheet = listing.runner(&Settings::default(), &Limits::default());
        worksheet.define("a", Array::default());
        let cause = worksheet.call(&[5.0.into()]).unwrap_err().cause;
        assert!(matches!(cause, Cause::Kind { expected: "a square matrix", .. }), "{body}");
    }
}

#[test]
fn powers_roots_and_elementary_functions() {
    assert_eq!(value("(2 + 3)^4"), "625", "precedence 6");
    assert_eq!(value("2^(3 + 4)"), "128", "precedence 8");
    assert_eq!(value("−x^2"), "-25", "the power binds tighter than the sign");
    assert_eq!(value("2^−1·4"), "2");
    assert_eq!(value("√(2 + 3)"), "2.23606797749979", "precedence 15");
    assert_eq!(value("√(5, 32)"), "2", "advanced 21");
    assert_eq!(value("√(3, −8)"), "-2", "an odd root");
    assert_eq!(value("(√(3, 0)   √(2, 0)   0^0   0^1)"), "0 0 1 0", "none of these is −0");
    assert!(matches!(failure("√(2, −4)"), Cause::Complex { .. }), "an even one");
    assert_eq!(value("log(8, 2)"), "3", "advanced 22");
    assert_eq!(value("factorial(x)"), "120", "advanced 20");
    assert_eq!(value("(exp(0)   ln(1)   sin(0)   floor(2.5)   mod(7, 3))"), "1 0 0 2 1");
    assert!(matches!(failure("√(−1)"), Cause::Complex { .. }));
    assert!(matches!(failure("ln(0)"), Cause::Domain { .. }));
    assert!(matches!(failure("factorial(2.5)"), Cause::Domain { .. }), "errors 15");
    assert!(matches!(failure("0^−1"), Cause::Singularity { .. }));
    assert!(matches!(failure("sin(1, 2)"), Cause::Arguments { expected: 1, found: 2 }), "errors 5");
}

/// The programs of xmcd's programs-mathcad14.xmcd ask for a sum that stops, one that skips, an
/// early return and a caught division; these are our own of the same kinds.
#[test]
fn the_words_of_programs() {
    assert_eq!(value("y ← 1\nwhile y < 100\n  y ← 3·y\ny"), "243");
    assert_eq!(value("for i ∈ 1 .. 9\n  break if i·i > 20\n  y ← i\ny"), "4");
    assert_eq!(value("for i ∈ 1 .. 5\n  continue if mod(i, 2) = 0\n  y ← y + i\ny"), "9");
    assert_eq!(
        value("for i ∈ 1 .. 5\n  for j ∈ 1 .. 5\n    break if j > i\n    y ← y + 1\ny"),
        "15"
    );
    assert_eq!(value("return 7 if x > 0\n−1"), "7");
    assert_eq!(value("for i ∈ 1 .. 9\n  return i if i·i > x\n0"), "3");
    assert_eq!(value("try\n  y ← 1 / 0\non error\n  y ← 99\ny"), "99");
    assert_eq!(value("try\n  v[1]\non error\n  9"), "1");
    assert_eq!(value("if x < 0\n  1\nif x < 1\n  2\notherwise\n  3"), "3");
    assert_eq!(value("2 if x > 0\notherwise\n  3"), "2");
    assert_eq!(value("1 if x < 0\n2 if x > 0\notherwise\n  3"), "2", "any of the ifs above");
    assert_eq!(value("(1 = 2 ∨ x > 0   ¬(x > 0)   ¬1 = 2)"), "1 0 1");
    assert_eq!(value("1 < 0 ∨ v[9] > 0 ∨ x > 0"), "1", "guarded, as ∧");
    assert_eq!(value("for y ∈ m\n  a[rows(a) + 1] ← y\na"), "1; 3; 2; 4", "entries by columns");
    assert_eq!(value("for y ∈ 7\n  a[rows(a) + 1] ← y\na"), "7", "a number is its only entry");
    assert_eq!(failure("break"), Cause::OutsideLoop);
    let endless = Limits { steps: 1_000, ..Limits::default() };
    let listing = program("while x > 0\n  x ← x + 1\nx");
    let error = listing.runner(&Settings::default(), &endless).call(&[5.0.into()]).unwrap_err();
    assert!(matches!(error.cause, Cause::Limit { .. }));
}

/// pastilkaxo/OKG lab1, 54 and 172, and xmcd's range tables: the k-th value of a range is its first
/// plus k steps, not a sum of steps.
#[test]
fn ranges_with_a_step() {
    let third = value("for i ∈ 0, 0.1 .. 0.5\n  a[rows(a) + 1] ← i\na[4]");
    assert_eq!(third, "0.30000000000000004");
    assert_eq!(value("for i ∈ 1, 3 .. 8\n  y ← 10·y + i"), "1357");
    assert_eq!(value("for i ∈ 9, 6 .. 1\n  y ← 10·y + i\ny"), "963");
    let near = value("for i ∈ 0, 1000 .. 999.9999999995\n  y ← i\ny");
    assert_eq!(near, "1000", "its end is passed by what is 1e-12 of a step");
    let near = value("for i ∈ 0, 1000 .. 999.999999998\n  y ← i\ny");
    assert_eq!(near, "0", "and by no more");
    assert_eq!(value("for i ∈ 5, 7 .. 5\n  y ← 10·y + i\ny"), "5", "its start is its end");
    assert!(matches!(failure("for i ∈ 6, 7 .. 5\n  i"), Cause::Range { .. }));
    assert!(matches!(failure("for i ∈ 6, 6 .. 6\n  i"), Cause::Range { .. }), "without a step");
    assert!(matches!(failure("for i ∈ 6, 6 .. 7\n  i"), Cause::Range { .. }));
}

/// AEkaterina lab_1 61: a row times a matrix times a column, 1340, is saved as a number;
/// Rushollow/FrictionalContactFEM 26344: such products become entries. Ryu-ko/OKG lab1 8: |column|.
#[test]
fn what_has_one_entry_is_a_number() {
    assert_eq!(value("a[1] ← vᵀ·(v·vᵀ)·v\na"), "196");
    assert_eq!(outcome("vᵀ·v", &Settings::default()).unwrap().value, Value::Number(14.0));
    assert_eq!(value("|(4; 5)|"), "6.4031242374328485", "its saved length, bit for bit");
}

#[test]
fn functions_from_outside() {
    let listing = program("y ← D(x, 2)\nD(y, 0)");
    let mut worksheet = listing.runner(&Settings::default(), &Limits::default());
    worksheet.define_function("D", |arguments| match arguments {
        [Value::Number(x), Value::Number(y)] if *y > 0.0 => Ok(Value::Number(x * y)),
        _ => Err("y must be above 0".into()),
    });
    let failure = worksheet.call(&[Value::Number(3.0)]).unwrap_err();
    assert_eq!(
        failure.cause,
        Cause::Function { name: "D".into(), message: "y must be above 0".into() }
    );
    assert_eq!((failure.line, failure.text.as_str()), (3, "D(y, 0)"));
    assert_eq!(worksheet.call(&[]).unwrap_err().cause, Cause::Arguments { expected: 1, found: 0 });
}

#[test]
fn trace_prints_and_returns_a_string() {
    let run = outcome("trace(x)\ny ← trace(v[2], 0.5)\ny", &Settings::default()).unwrap();
    assert_eq!(run.trace_output, ["5", "2 0.5"]);
    assert_eq!(run.value, Value::Text("2 0.5".into()));
}

#[test]
fn matrices() {
    assert_eq!(value("m·m"), "7 10; 15 22");
    assert_eq!(value("mᵀ"), "1 3; 2 4");
    assert_eq!(value("vᵀ"), "1 2 3");
    assert_eq!(value("vᵀ·v"), "14");
    assert_eq!(value("v·v"), "14", "two columns: the scalar product");
    assert_eq!(value("v·vᵀ"), "1 2 3; 2 4 6; 3 6 9");
    assert_eq!(value("2·m − m + m / 2"), "1.5 3; 4.5 6");
    assert_eq!(value("m + 1"), "2 3; 4 5");
    assert_eq!(value("−m"), "-1 -2; -3 -4");
    assert!(matches!(failure("m·v"), Cause::Sizes { .. }));
    assert!(matches!(failure("m + v"), Cause::Sizes { .. }));
    assert!(matches!(failure("1 / m"), Cause::Kind { .. }));
    assert!(matches!(failure("v < 1"), Cause::Kind { .. }));
}

#[test]
fn arrays_of_arrays_are_read() {
    let listing = program("B[2]·x");
    let mut worksheet = listing.runner(&Settings::default(), &Limits::default());
    worksheet.define("B", [1.0, 2.0].map(Value::from).into_iter().collect::<Value>());
    assert_eq!(worksheet.call(&[Value::Number(5.0)]).unwrap().value, Value::Number(10.0));
    let spelled = "a ← (v 2; 3 4)\n((a[1,1])[3]   a[1,2]   a[2,1]   a[2,2])";
    assert_eq!(value(spelled), "3 2 3 4", "row by row");
}

#[test]
fn every_operation_rounds_on_its_own() {
    // A fused multiply-add would give 2^-54 - 2^-108 ... of the exact square instead of the rounded
    // one's 0.
    let lines = "y ← 1 + 1 / 134217728\ny·y − (1 + 2 / 134217728)";
    assert_eq!(value(lines), "0");
    // 0.1 + 0.2 + 0.3 from the left is 0.6000000000000001, from the right 0.6.
    assert_eq!(value("0.1 + 0.2 + 0.3"), "0.6000000000000001");
    assert_eq!(value("(0.1   0.2   0.3)·(1   1   1)ᵀ"), "0.6000000000000001");
    // The sum of a product starts from its first term: -0, where 0 + -0 is 0.
    assert_eq!(value("(0   0)·(−1   −1)ᵀ"), "-0");
}
