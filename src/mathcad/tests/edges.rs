//! What the page's interpreter does not have, which runs the programs of the files beside: functions at the edge of
//! their domain, systems of equations, programs within an expression.

use super::{outcome, value};
use mathcad::Settings;

/// Mathcad's functions, ours of them, at the edge of where they have a value: each call with its value, or the kind of
/// its error.
const EDGES: &[(&str, &str)] = &[
    ("(sin(0)   cos(0)   tan(0))", "0 1 0"),
    ("cot(0)", "Domain"),
    ("cot(1e-310)", "Overflow"),
    ("sec(0)", "1"),
    ("csc(0)", "Domain"),
    ("csc(1e-310)", "Overflow"),
    ("asin(2)", "Complex"),
    ("acos(−2)", "Complex"),
    ("atan(1e308)", "1.5707963267948966"),
    ("sinh(711)", "Overflow"),
    ("cosh(−711)", "Overflow"),
    ("tanh(1000)", "1"),
    ("asinh(0)", "0"),
    ("acosh(1)", "0"),
    ("acosh(0.5)", "Complex"),
    ("atanh(1)", "Domain"),
    ("atanh(−1)", "Domain"),
    ("atanh(2)", "Complex"),
    ("exp(710)", "Overflow"),
    ("exp(−1000)", "0"),
    ("ln(0)", "Domain"),
    ("ln((1; 0))", "Domain"),
    ("ln(−1)", "Complex"),
    ("(floor(−2.5)   ceil(−2.5)   trunc(−2.5))", "-3 -2 -2"),
    ("√(0)", "0"),
    ("√(−1)", "Complex"),
    ("√(0, 1)", "Singularity"),
    ("√(0, 0.5)", "Singularity"),
    ("√(0, 0)", "Singularity"),
    ("√(−2, 0)", "Singularity"),
    ("√(−3, −8)", "-0.5"),
    ("√(2.5, −8)", "Complex"),
    ("√(0.001, 10)", "Overflow"),
    ("√(0.001, 0.1)", "0"),
    ("log(0)", "Domain"),
    ("log(−1)", "Complex"),
    ("log(0, 2)", "Domain"),
    ("log(8, 0)", "Domain"),
    ("log(0.5, 0)", "Domain"),
    ("log(8, 1)", "Singularity"),
    ("log(1, 1)", "Singularity"),
    ("log(−1, 1)", "Complex"),
    ("log(2, −2)", "Complex"),
    ("mod(5, 0)", "Singularity"),
    ("mod(0, 0)", "Singularity"),
    ("(mod(−5, 3)   mod(5, −3)   mod(5, 1e308))", "-2 2 5"),
    ("factorial(170) > 7e306", "1"),
    ("factorial(171)", "Overflow"),
    ("factorial(1e300)", "Overflow"),
    ("factorial(−1)", "Domain"),
    ("(0^0   0^0.5)", "1 0"),
    ("0^−0.5", "Singularity"),
    ("(−8)^(1 / 3)", "Complex"),
    ("10^400", "Overflow"),
    ("0.1^−400", "Overflow"),
    ("0.1^400", "0"),
    ("identity(−1)", "Kind"),
    ("(rows(x)   cols(x)   length(x))", "0 0 0"),
    ("last(v)", "3"),
    ("last(m)", "Kind"),
    ("mean(7)", "7"),
    ("mean(v, 6)", "3"),
    ("mean(m)", "2.5"),
    ("mean()", "Kind"),
    ("mean(\"a\")", "Kind"),
    ("mean(1e308, 1e308)", "Overflow"),
    ("(min(m, −1)   max(m, −1))", "-1 4"),
    ("max()", "Kind"),
    ("sort((3; 1; 2; 1))", "1; 1; 2; 3"),
    ("sort((−1; −2))", "-2; -1"),
    ("sort(m)", "Kind"),
    ("sort(x)", "Kind"),
    ("sort(v, v)", "Arguments"),
    ("(round(2.5)   round(−2.5)   round(0.4))", "3 -3 0"),
    ("(round(1.005, 2)   round(2.345, 2)   round(1234, −2))", "1 2.35 1200"),
    ("round((1.25; −1.25), 1)", "1.3; -1.3"),
    ("(round(1.5, 400)   round(1.5, −400)   round(1e300, 20) = 1e300)", "1.5 0 1"),
    ("round(1.5, 0.5)", "Kind"),
    ("round(1, 2, 3)", "Arguments"),
    ("augment(v, m)", "Sizes"),
    ("stack(v, m)", "Sizes"),
    ("submatrix(m, 1, 3, 1, 1)", "IndexOutside"),
    ("lsolve((1 2; 2 4), (1; 2))", "Singular"),
    ("lsolve((1e-320 0; 0 1), (1e-320; 3))", "1; 3"),
    ("lsolve((1e-320 0; 1e-320 1), (1e-320; 3))", "1; 3"),
    ("lsolve((1e-300 0; 0 1), (1e300; 3))", "Overflow"),
    ("lsolve((1e308 1e308; −1e308 1e308), (1; 1))", "Overflow"),
    ("(1 2; 2 4)^−1", "Singular"),
    ("(1e-320 0; 0 1)^−1", "Overflow"),
    ("determinant((1e200 0; 0 1e200))", "Overflow"),
    ("determinant((1e200 1e200; 1e200 1e200))", "Overflow"),
    ("|(1e200; 0)|", "Overflow"),
    ("∑((1e308; 1e308))", "Overflow"),
    ("∏(v)", "Function"),
    ("×(v, m)", "Kind"),
    ("eigenvals((0 1; −1 0))", "Complex"),
    ("eigenvecs((1 1; 0 1))", "Unsupported"),
    ("m(3)", "Undefined"),
];

#[test]
fn functions_at_the_edge_of_their_domain() {
    for (call, expected) in EDGES {
        let found = match outcome(call, &Settings::default()) {
            Ok(outcome) => outcome.value.to_string(),
            Err(failure) => {
                let cause = format!("{:?}", failure.cause);
                assert!(!cause.contains("NaN"), "{call}: {cause}");
                cause.split(' ').next().unwrap_or_default().into()
            }
        };
        assert_eq!(found, *expected, "{call}");
    }
}

/// Results that three authors saved, the last one evelinalevina ЛР2 139, 140, 145 and 160: a division by a pivot is a
/// product with its reciprocal, and products are added up before they are subtracted.
#[test]
fn systems_of_equations_have_the_saved_bits() {
    let second = "(4.35 4.39 3.67; 4.04 3.65 3.17; 3.14 2.69 2.17)";
    let third = "(2.36 2.37 2.13; 2.51 2.4 2.1; 2.59 2.41 2.06)";
    let [b, c] = ["(40.15; 36.82; 28.1)", "(1.48; 1.92; 2.16)"];
    let saved = "7.650899962395696; 0.15817690282847832; 1.6823402071285294";
    assert_eq!(value(&format!("lsolve({second}, {b})")), saved);
    let saved = "7.650899962395705; 0.1581769028284583; 1.6823402071285614";
    assert_eq!(value(&format!("{second}^−1·{b}")), saved);
    let saved = "3.863727454909743; -3.899354264083529; 0.7526163437985781";
    assert_eq!(value(&format!("lsolve({third}, {c})")), saved);
    let saved = "3.8637274549097356; -3.899354264083513; 0.7526163437985929";
    assert_eq!(value(&format!("{third}^−1·{c}")), saved);
    let last =
        "for i ∈ 1 .. 6\n  for j ∈ 1 .. 6\n    a[i,j] ← 2·i + j + 0.1·(i = j)\n  b[i] ← i^3\n";
    let saved = "345.1023614315862; -11.516520202266069; -248.13540183612483; -304.75428346997836; \
                 -121.37316510383411; 362.00795326231";
    assert_eq!(value(&format!("{last}lsolve(a, b)")), saved);
    assert_eq!(
        value(&format!("{last}(|a|   |a·a|)")),
        "-0.020368999999999523 0.0004148961609918678"
    );
    let saved = "4.614364966370475 -3.9078992586774346 -2.430163483725261 -0.9524277087731291 0.5253080661790313 \
                 2.0030438411311033";
    assert_eq!(value(&format!("{last}submatrix(a^−1, 1, 1, 1, 6)")), saved);
}

#[test]
fn a_block_if_may_have_commas_within_its_condition() {
    assert_eq!(value("if ({for i in 1, 2 {x}; 3} > 0)\n  7"), "7");
    assert_eq!(value("if (max({for i in 1, 2 {x}; 3}, 2) > 0)\n  7"), "7");
    assert_eq!(value("7 if ({for i in 1, 2 {x}; 3} > 0)"), "7");
    assert_eq!(value("if({for i in 1, 2 {x}; 3} > 4, 7, 8)"), "8");
}
