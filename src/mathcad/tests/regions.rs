//! What a worksheet's regions say, in the elements of its file: constructs that are named, names
//! that change what they stand for, operators within operators.

use fastrand::Rng;
use mathcad::worksheet::{Agreement, ExecutedRegion, execute};
use mathcad::xmcd::document::{self, Content};
use mathcad::xmcd::write;
use mathcad::{Limits, Listing, Value};

fn worksheet(regions: &str) -> document::Worksheet {
    let text = format!("<worksheet><regions>{regions}</regions></worksheet>");
    document::read(&text, "sheet").unwrap()
}

/// Executes regions of these elements, which are called 0, 1, 2, ...
fn executed(regions: &[String]) -> Vec<ExecutedRegion> {
    let region = |(k, inside): (usize, &String)| {
        format!("<region region-id=\"{k}\"><math>{inside}</math></region>")
    };
    let regions: String = regions.iter().enumerate().map(region).collect();
    let sheet = worksheet(&regions);
    execute(&sheet, &Limits::default())
}

fn define(left: &str, right: &str) -> String {
    format!("<define>{left}{right}</define>")
}

/// An evaluation, with the number that Mathcad saved.
fn eval(expression: &str, saved: Option<f64>) -> String {
    let saved = saved.map(|x| format!("<result>{}</result>", real(x))).unwrap_or_default();
    format!("<eval>{expression}{saved}</eval>")
}

fn apply(operator: &str, operands: &[&str]) -> String {
    format!("<apply><{operator}/>{}</apply>", operands.concat())
}

fn id(name: &str) -> String {
    format!("<id>{name}</id>")
}

fn real(x: f64) -> String {
    format!("<real>{x}</real>")
}

fn matrix(rows: usize, cols: usize, entries: &[String]) -> String {
    format!("<matrix rows=\"{rows}\" cols=\"{cols}\">{}</matrix>", entries.concat())
}

fn unsupported(words: &str) -> Agreement {
    Agreement::Unsupported(words.into())
}

fn verdicts(checked: &[ExecutedRegion]) -> Vec<Agreement> {
    checked.iter().map(|checked| checked.agreement.clone()).collect()
}

/// Each with the words that name it; nothing is half understood.
#[test]
fn unsupported_constructs_are_named() {
    let [one, a, b] = [real(1.0), id("a"), id("b")];
    let lambda = format!("<lambda><boundVars>{a}</boundVars>{b}</lambda>");
    let three = [one.clone(), one.clone(), one.clone()];
    for (expression, words) in [
        (apply("summation", &[&a]), "the operator summation"),
        (apply("summation", &[&lambda]), "a series over what is no range variable"),
        (apply("product", &[&a, "<bounds/>"]), "the operator product"),
        (apply("polyroots", &[&a]), "the function polyroots"),
        (apply("gradient", &[&a]), "the operator gradient"),
        (apply("vectorize", &[&apply("transpose", &[&one])]), "vectorize of `1ᵀ`"),
        (matrix(2, 2, &three), "a matrix that is not full"),
        (matrix(1, 2, &three), "a matrix that is not full"),
        (matrix(0, 0, &[]), "a matrix that is not full"),
        (matrix(3, 0, &[]), "a matrix that is not full"),
        (format!("<matrix rows=\"3\">{}</matrix>", three.concat()), "a matrix without its size"),
        ("<str>a \"b\"</str>".into(), "a string with quotation marks or several lines"),
        ("<str>a\nb</str>".into(), "a string with quotation marks or several lines"),
        ("<real>1e999</real>".into(), "the number \"1e999\""),
    ] {
        let checked = executed(&[eval(&expression, None)]);
        assert_eq!(checked[0].agreement, unsupported(words), "{expression}");
    }
    let symbolic = executed(&[format!("<symEval>{a}</symEval>")]);
    assert_eq!(verdicts(&symbolic), [unsupported("symbolics")]);
    // Of a saved result too.
    for entries in [&three[..2], &[one.clone(), one.clone(), one.clone(), one.clone(), one]] {
        let result = format!("<result>{}</result>", matrix(2, 2, entries));
        let checked = executed(&[format!("<eval>{}{result}</eval>", real(2.0))]);
        assert_eq!(checked[0].agreement, unsupported("a matrix that is not full"));
    }
}

/// The numbers of a matrix's entries, column by column as the file has them.
fn numbers(rows: usize, cols: usize, entries: &[f64]) -> String {
    matrix(rows, cols, &entries.iter().map(|x| real(*x)).collect::<Vec<_>>())
}

/// Executes definitions, and checks what expressions are below them, by their text.
fn assert_values(definitions: &[String], expected: &[(String, &str)]) {
    let evaluations = expected.iter().map(|(expression, _)| eval(expression, None));
    let regions: Vec<String> = definitions.iter().cloned().chain(evaluations).collect();
    let checked = executed(&regions);
    for ((expression, value), region) in expected.iter().zip(&checked[definitions.len()..]) {
        let found = region.value.as_ref().map(Value::to_string);
        assert_eq!(found.as_deref(), Some(*value), "{expression}: {:?}", region.agreement);
    }
}

#[test]
fn several_names_get_the_entries_in_their_places() {
    let names = matrix(2, 2, &[id("a"), id("b"), id("c"), id("d")]);
    let swap = define(&matrix(1, 2, &[id("a"), id("b")]), &matrix(1, 2, &[id("b"), id("a")]));
    let defined = [define(&names, &numbers(2, 2, &[1.0, 2.0, 3.0, 4.0])), swap];
    let expected = [("a", "2"), ("b", "1"), ("c", "3"), ("d", "4")];
    assert_values(&defined, &expected.map(|(name, value)| (id(name), value)));
    // Of another size, and of what is unsupported, each is unknown.
    let integral = apply("integral", &[&id("t")]);
    let checked = executed(&[
        define(&names, &numbers(4, 1, &[1.0, 2.0, 3.0, 4.0])),
        eval(&id("d"), None),
        define(&names, &integral),
        eval(&id("b"), None),
    ]);
    assert!(
        matches!(&checked[0].agreement, Agreement::Fails(why) if why.contains("2 x 2 ← 4 x 1"))
    );
    assert!(
        matches!(&checked[1].agreement, Agreement::Unsupported(why) if why.contains("rests on d"))
    );
    assert_eq!(checked[2].agreement, unsupported("an integral"));
    assert_eq!(checked[3].agreement, unsupported("an integral (it rests on b)"));
}

#[test]
fn columns_are_assigned_and_multiplied() {
    let column = apply("matcol", &[&id("M"), &real(1.0)]);
    let three = numbers(3, 1, &[1.0, 2.0, 3.0]);
    let defined = [define(&column, &three), define(&id("v"), &three)];
    let cross = apply("crossProduct", &[&id("v"), &numbers(3, 1, &[4.0, 5.0, 6.0])]);
    let square = apply("vectorize", &[&apply("mult", &[&id("v"), &id("v")])]);
    let one = |x: f64| numbers(1, 1, &[x]);
    let rows = |of: &str| format!("<apply>{}{of}</apply>", id("rows"));
    assert_values(
        &defined,
        &[
            (id("M"), "0 1; 0 2; 0 3"),
            (cross, "-3; 6; -3"),
            (square, "1; 4; 9"),
            (apply("determinant", &[&one(5.0)]), "5"),
            (rows(&one(5.0)), "1"),
            (rows(&real(5.0)), "0"),
        ],
    );
}

/// Of a table over two range variables the last one named changes first.
#[test]
fn range_variables_stand_in_sums_and_tables() {
    let range = |from, to| format!("<range>{}{}</range>", real(from), real(to));
    let lambda = format!("<lambda><boundVars>{0}</boundVars>{0}</lambda>", id("i"));
    let defined = [define(&id("i"), &range(1.0, 3.0)), define(&id("j"), &range(5.0, 6.0))];
    let table = |a, b| apply("minus", &[&apply("mult", &[&real(10.0), &id(a)]), &id(b)]);
    assert_values(
        &defined,
        &[
            (apply("summation", &[&lambda]), "6"),
            (apply("product", &[&lambda]), "6"),
            (table("i", "j"), "5; 4; 15; 14; 25; 24"),
            (table("j", "i"), "49; 48; 47; 59; 58; 57"),
        ],
    );
    // What Mathcad makes of a name that is defined over one is unknown.
    let checked = executed(&[defined[0].clone(), define(&id("y"), &table("i", "i"))]);
    assert_eq!(checked[1].agreement, unsupported("a range variable in an expression (i)"));
}

/// A loop, a choice and an error, each within a product.
#[test]
fn programs_stand_within_expressions() {
    let assign =
        |name: &str, value: &str| format!("<localDefine>{}{value}</localDefine>", id(name));
    let double = assign("s", &apply("mult", &[&id("s"), &real(2.0)]));
    let range = format!("<range>{}{}</range>", real(1.0), real(3.0));
    let power = format!(
        "<parens><program>{}<for>{}{range}{double}</for>{}</program></parens>",
        assign("s", &real(1.0)),
        id("k"),
        id("s")
    );
    let choice = format!(
        "<program><ifThen>{}{}</ifThen><otherwise>{}</otherwise></program>",
        apply("greaterThan", &[&real(1.0), &real(2.0)]),
        real(7.0),
        real(5.0)
    );
    let fails = apply("div", &[&real(1.0), &real(0.0)]);
    let caught = format!("<program><tryCatch>{fails}{}</tryCatch></program>", real(3.0));
    let twice = |x: &str| apply("mult", &[&real(2.0), x]);
    assert_values(&[], &[(twice(&power), "16"), (twice(&choice), "10"), (twice(&caught), "6")]);
    let back = format!("<program><return>{}</return></program>", real(3.0));
    let checked = executed(&[eval(&twice(&back), None)]);
    let words = "break, continue or return in a program within an expression";
    assert_eq!(checked[0].agreement, unsupported(words));
}

/// Their order and signs are Mathcad's own, so that what differs in them alone is not called different.
#[test]
fn eigenvalues_agree_in_any_order() {
    let call = |name: &str, m: &str| format!("<apply>{}{m}</apply>", id(name));
    let m = numbers(2, 2, &[2.0, 0.0, 1.0, 3.0]);
    let saved = |name: &str, result: &str| {
        let text = format!("<eval>{}<result>{result}</result></eval>", call(name, &m));
        executed(&[text]).remove(0).agreement
    };
    assert_eq!(saved("eigenvals", &numbers(2, 1, &[2.0, 3.0])), Agreement::Same);
    let order = "Mathcad's order of eigenvalues and its signs of eigenvectors; the numbers agree";
    assert_eq!(saved("eigenvals", &numbers(2, 1, &[3.0, 2.0])), unsupported(order));
    let half = 0.5_f64.sqrt();
    assert_eq!(saved("eigenvecs", &numbers(2, 2, &[half, half, -1.0, 0.0])), unsupported(order));
    assert!(matches!(saved("eigenvals", &numbers(2, 1, &[2.0, 4.0])), Agreement::Differs { .. }));
    // Columns of which rounding decides the order, and entries that are 0 but for rounding.
    let equal = numbers(2, 2, &[1.0, 0.3, 0.3, 1.0]);
    let (more, zero) = (f64::from_bits(half.to_bits() + 1), 1e-17);
    for saved in [[half, more, -more, half], [more, half, half, -more], [more, half, -half, more]] {
        let text = format!("<result>{}</result>", numbers(2, 2, &saved));
        let checked = executed(&[format!("<eval>{}{text}</eval>", call("eigenvecs", &equal))]);
        assert_eq!(checked[0].agreement, unsupported(order), "{saved:?}");
    }
    let diagonal = numbers(2, 2, &[3.0, 0.0, 0.0, 2.0]);
    let text = format!("<result>{}</result>", numbers(2, 2, &[1.0, zero, -zero, -1.0]));
    let checked = executed(&[format!("<eval>{}{text}</eval>", call("eigenvecs", &diagonal))]);
    assert_eq!(checked[0].agreement, unsupported(order));
    // Two columns are not the same one twice.
    let twice = numbers(2, 2, &[half, half, half, half]);
    let checked =
        executed(&[format!("<eval>{}<result>{twice}</result></eval>", call("eigenvecs", &equal))]);
    assert!(matches!(checked[0].agreement, Agreement::Differs { .. }));
    // A rotation's are complex; those of a symmetric matrix are an orthogonal matrix.
    let rotation = numbers(2, 2, &[0.0, 1.0, -1.0, 0.0]);
    let checked = executed(&[eval(&call("eigenvals", &rotation), None)]);
    assert_eq!(checked[0].agreement, unsupported("complex numbers"));
    let double = numbers(2, 2, &[2.0, 0.0, 1.0, 2.0]);
    let checked = executed(&[eval(&call("eigenvecs", &double), None)]);
    assert_eq!(
        checked[0].agreement,
        unsupported("eigenvectors of an eigenvalue that occurs twice")
    );
    let symmetric = numbers(3, 3, &[2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0]);
    let values = numbers(3, 1, &[-1.0, 0.0, 1.0].map(|root: f64| 2.0 + root * 2.0_f64.sqrt()));
    let text = format!("<eval>{}<result>{values}</result></eval>", call("eigenvals", &symmetric));
    let verdict = &executed(&[text])[0].agreement;
    assert!(matches!(verdict, Agreement::Same | Agreement::Digits(14..)), "{verdict:?}");
}

/// What a name stood for is gone: a range, a function, a construct that is unsupported.
#[test]
fn a_name_defined_anew_is_what_it_was_defined_as() {
    let range = format!("<range>{}{}</range>", real(1.0), real(3.0));
    let function = format!("<function>{}<boundVars>{}</boundVars></function>", id("y"), id("t"));
    let call = format!("<apply>{}{}</apply>", id("y"), real(4.0));
    let integral = apply("integral", &[&id("t")]);
    let checked = executed(&[
        define(&id("y"), &range),
        eval(&id("y"), None),
        define(&id("y"), &real(5.0)),
        eval(&id("y"), None),
        define(&function, &id("t")),
        eval(&call, None),
        define(&id("y"), &integral),
        eval(&id("y"), None),
        eval(&call, None),
        define(&id("y"), &real(6.0)),
        eval(&id("y"), None),
        eval(&call, None),
    ]);
    let values: Vec<_> =
        checked.iter().filter_map(|c| Some(c.value.as_ref()?.to_string())).collect();
    assert_eq!(values, ["1; 2; 3", "5", "5", "4", "6", "6"], "each definition is a value too");
    let rests = unsupported("an integral (it rests on y)");
    assert_eq!(verdicts(&checked)[6..9], [unsupported("an integral"), rests.clone(), rests]);
    assert_eq!(
        checked[11].agreement,
        unsupported("`y`, which nothing above defines"),
        "it is a function no more"
    );
}

/// A name of a unit that is called is no unit, whether a function's definition calls it or an evaluation does.
#[test]
fn a_unit_is_not_called() {
    let function = format!("<function>{}<boundVars>{}</boundVars></function>", id("f"), id("t"));
    let call = |name: &str| format!("<apply>{}{}</apply>", id(name), real(2.0));
    let unknown = "`m`, which nothing above defines";
    let checked = executed(&[eval(&call("m"), Some(1.0)), define(&function, &call("m"))]);
    assert_eq!(verdicts(&checked), [unsupported(unknown), unsupported(unknown)]);
    let product = apply("mult", &[&id("t"), &id("m")]);
    assert_eq!(executed(&[define(&function, &product)])[0].agreement, unsupported("units: m"));
}

/// The saved value of a definition that is unsupported goes on; that of a name that
/// nothing defines does not, for it may be a unit.
#[test]
fn a_saved_value_goes_on_only_where_a_name_is_defined() {
    let integral = apply("integral", &[&id("t")]);
    let checked = executed(&[
        define(&id("y"), &eval(&integral, Some(4.0))),
        eval(&id("y"), Some(4.0)),
        eval(&id("kg"), Some(2.0)),
        eval(&id("kg"), Some(2.0)),
    ]);
    let expected = [
        unsupported("an integral"),
        Agreement::Same,
        unsupported("units: kg"),
        unsupported("units: kg"),
    ];
    assert_eq!(verdicts(&checked), expected);
    assert_eq!(checked[1].inputs.iter().collect::<Vec<_>>(), ["0"]);
    let too_many = format!("<apply>{}{}{}</apply>", id("sin"), real(1.0), real(2.0));
    let words = "This function has 1 arguments; 2 were given.";
    assert_eq!(verdicts(&executed(&[eval(&too_many, None)])), [Agreement::Fails(words.into())]);
}

/// Areas within areas are looked into, but not without end.
#[test]
fn areas_are_entered_thirty_deep() {
    let nested = |depth: usize| {
        let math = format!("<region><math>{}</math></region>", eval(&real(1.0), None));
        let [open, close] = ["<region><area>", "</area></region>"].map(|tag| tag.repeat(depth));
        worksheet(&format!("{open}{math}{close}")).regions
    };
    assert!(matches!(nested(30)[..], [document::Region { content: Content::Evaluation(_), .. }]));
    assert!(matches!(nested(31)[..], [document::Region { content: Content::Silent, .. }]));
}

/// The elements of a region stand at most 299 deep, the text of the innermost included.
#[test]
fn regions_are_read_three_hundred_deep() {
    let deep = |parens: usize| {
        let [open, close] = ["<parens>", "</parens>"].map(|tag| tag.repeat(parens));
        match &executed(&[eval(&format!("{open}{}{close}", real(1.0)), None)])[0].agreement {
            Agreement::Unsupported(words) => words.clone(),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(deep(296), "its size or form: found brackets more than 64 deep");
    assert_eq!(deep(297), "an expression nested too deeply");
    assert_eq!(deep(2_000), "an expression nested too deeply");
}

#[test]
fn files_are_read_up_to_their_largest_size() {
    let [open, close] = ["<worksheet>", "</worksheet>"];
    let mut text = open.to_owned() + &" ".repeat(document::LARGEST - open.len() - close.len());
    text += close;
    assert_eq!(document::read(&text, "sheet").unwrap().regions.len(), 0);
    text += " ";
    assert!(document::read(&text, "sheet").is_err());
}

/// The document, its root, and 2^23 times an element and a text: two nodes beyond 2^24.
#[test]
fn files_of_too_many_nodes_are_refused() {
    let text = format!("<worksheet>{}</worksheet>", "<a/> ".repeat(1 << 23));
    let why = document::read(&text, "sheet").unwrap_err().to_string();
    assert!(why.contains("the file has too many elements"), "{why}");
}

/// `x on error y` of an assignment, under a condition.
#[test]
fn an_attempt_under_a_condition_is_a_block() {
    let attempt =
        format!("<tryCatch>{}{}</tryCatch>", apply("div", &[&real(1.0), &id("a")]), id("a"));
    let assign = format!("<localDefine>{}{attempt}</localDefine>", id("y"));
    let body = format!("<program><ifThen>{}{assign}</ifThen>{}</program>", id("a"), id("y"));
    let function = format!("<function>{}<boundVars>{}</boundVars></function>", id("f"), id("a"));
    let call = |x: f64| eval(&format!("<apply>{}{}</apply>", id("f"), real(x)), None);
    let checked = executed(&[define(&function, &body), call(4.0), call(0.0)]);
    let text = "f(a) :=\n  if a\n    try\n      y ← 1 / a\n    on error\n      y ← a\n  y\n";
    assert_eq!(checked[0].text, text);
    let values: Vec<_> = checked.iter().filter_map(|c| c.value.clone()).collect();
    assert_eq!(values, [Value::Number(0.25), Value::Number(0.0)]);
}

/// Elements of a row stand close if each is a name, a number, an entry of a name or in brackets.
#[test]
fn rows_stand_apart_where_an_element_has_something_behind() {
    let [a, one] = [id("a"), real(1.0)];
    let transposed = apply("transpose", &[&a]);
    let in_brackets = format!("<parens>{transposed}</parens>");
    for (element, row) in [
        (a.clone(), "(a 1)"),
        (apply("indexer", &[&a, &one]), "(a[1] 1)"),
        (apply("indexer", &[&in_brackets, &one]), "((aᵀ)[1]   1)"),
        (apply("matcol", &[&a, &one]), "(a⟨1⟩   1)"),
        (transposed, "(aᵀ   1)"),
        (in_brackets, "((aᵀ) 1)"),
        (apply("pow", &[&a, &one]), "(a^1   1)"),
        (apply("neg", &[&a]), "(−a   1)"),
        (real(-2.0), "(−2   1)"),
    ] {
        let checked = executed(&[eval(&matrix(1, 2, &[element, one.clone()]), None)]);
        assert_eq!(checked[0].text, format!("{row} ="));
    }
}

/// In the worksheet parentheses stand only where Mathcad shows them: not in a fraction or an
/// exponent, but round what a transpose or a subscript stands behind.
#[test]
fn parentheses_are_written_as_mathcad_shows_them() {
    for (text, parentheses) in [
        ("(¬a) / 2", 0),
        ("(a < b) / 2", 0),
        ("(a + b) / (a·b)", 0),
        ("(−a) / (−b)", 2),
        ("a^(−b)", 1),
        ("a^(−b^2)", 0),
        ("a^(b^2)", 0),
        ("a^(b[1])", 1),
        ("a^(bᵀ)", 1),
        ("a[1]ᵀ", 1),
        ("aᵀ", 0),
        ("aᵀ[1,2]", 1),
        ("a⟨1⟩[2]", 1),
        ("a[1][2]", 1),
        ("a[1]⟨2⟩", 1),
        ("(a)[1]", 1),
        ("(1 2)ᵀ", 0),
    ] {
        let listing = Listing::parse("f", &format!("_() :=\n  {text}\n")).unwrap();
        let written = write::expression(&listing).document();
        assert_eq!(written.matches("<ml:parens>").count(), parentheses, "{text}: {written}");
    }
}

/// A random expression of numbers without parentheses, and what it comes to, if anything.
fn tree(rng: &mut Rng, depth: usize) -> (String, Option<f64>) {
    let Some(depth) = depth.checked_sub(1) else {
        let x = [-2.0, -1.0, 0.0, 0.5, 1.0, 2.0, 3.0][rng.usize(..7)];
        return (real(x), Some(x));
    };
    let below = rng.usize(..=depth);
    let [(a, x), (b, y)] = [tree(rng, depth), tree(rng, below)];
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    let truth = |truth: bool| if truth { 1.0 } else { 0.0 };
    let both = |f: fn(f64, f64) -> f64| x.zip(y).and_then(|(x, y)| finite(f(x, y)));
    let [any, all] = [[x, y].map(|x| x.is_some_and(|x| x != 0.0)), [x, y].map(|x| x == Some(0.0))];
    let (operator, value) = match rng.u8(..12) {
        0 => ("plus", both(|x, y| x + y)),
        1 => ("minus", both(|x, y| x - y)),
        2 => ("mult", both(|x, y| x * y)),
        3 => ("div", both(|x, y| x / y)),
        4 => ("pow", both(f64::powf)),
        // One operand may decide though the other fails.
        5 if any.contains(&true) => ("or", Some(1.0)),
        5 => ("or", both(|_, _| 0.0)),
        6 if all.contains(&true) => ("and", Some(0.0)),
        6 => ("and", both(|_, _| 1.0)),
        7 => ("lessThan", both(|x, y| if x < y { 1.0 } else { 0.0 })),
        8 => ("equal", both(|x, y| if x == y { 1.0 } else { 0.0 })),
        9 => return (apply("not", &[&a]), x.map(|x| truth(x == 0.0))),
        10 => return (apply("absval", &[&a]), x.map(f64::abs)),
        _ => return (apply("neg", &[&a]), x.map(|x| -x)),
    };
    // A comparison on the left of another would be a chain.
    let is_chain = ["lessThan", "equal"].contains(&operator)
        && ["<apply><lessThan/>", "<apply><equal/>"].iter().any(|head| a.starts_with(head));
    let a = if is_chain { format!("<parens>{a}</parens>") } else { a };
    (apply(operator, &[&a, &b]), value)
}

/// The elements say what is an operand of what; the text gets the parentheses that it needs.
#[test]
fn operators_within_operators_need_no_parentheses() {
    let mut rng = Rng::with_seed(7);
    let (trees, values): (Vec<_>, Vec<_>) = (0..600).map(|k| tree(&mut rng, 1 + k % 5)).unzip();
    let regions: Vec<_> = trees.iter().map(|tree| eval(tree, None)).collect();
    let checked = executed(&regions);
    assert!(values.iter().filter(|value| value.is_some()).count() > 300);
    for ((checked, value), tree) in checked.iter().zip(values).zip(trees) {
        let found = checked.value.as_ref().and_then(Value::number);
        assert_eq!(found, value, "{} {tree}: {:?}", checked.text, checked.agreement);
    }
}

/// An evaluation at which Mathcad saved an error.
fn failed(expression: &str, words: &str) -> Agreement {
    let region =
        format!("<region><math error=\"{words}\"><eval>{expression}</eval></math></region>");
    execute(&worksheet(&region), &Limits::default()).remove(0).agreement
}

/// Both fail: they agree only if the cause is the same.
#[test]
fn failures_agree_where_their_cause_is_the_same() {
    let division = apply("div", &[&real(1.0), &real(0.0)]);
    let undefined = id("nobody");
    for (expression, words, agrees) in [
        (&division, "Деление на ноль.", true),
        (&division, "Found a singularity. You may be dividing by zero.", true),
        (&division, "This variable is undefined.", false),
        (&undefined, "Эта переменная не определена.", true),
        (&undefined, "Деление на ноль.", false),
    ] {
        match failed(expression, words) {
            Agreement::SameFailure { .. } => assert!(agrees, "{expression} {words}"),
            Agreement::Differs { .. } => assert!(!agrees, "{expression} {words}"),
            other => panic!("{other:?}"),
        }
    }
    let Agreement::Unsupported(words) = failed(&division, "Решение не было найдено.")
    else {
        panic!("a message that is not known")
    };
    assert!(
        words.starts_with("Mathcad's error «Решение не было найдено.»; here: Division"),
        "{words}"
    );
    let Agreement::Unsupported(words) = failed(&id("kg"), "Деление на ноль.") else {
        panic!("units")
    };
    assert_eq!(words, "units: kg; Mathcad saved an error: «Деление на ноль.»");
}

/// A range variable is one only as long as nothing defines its name anew; a loop's own variable, a
/// parameter and a local name stand before it.
#[test]
fn loops_run_over_range_variables() {
    let range = |from: f64, to: f64| format!("<range>{}{}</range>", real(from), real(to));
    let sum = |over: &str| {
        let add = format!(
            "<localDefine>{}{}</localDefine>",
            id("s"),
            apply("plus", &[&id("s"), &id("x")])
        );
        let every = format!("<for>{}{}{add}</for>", id("x"), id(over));
        let zero = format!("<localDefine>{}{}</localDefine>", id("s"), real(0.0));
        format!("<program>{zero}{every}{}</program>", id("s"))
    };
    let function = |name: &str, parameter: &str| {
        format!("<function>{}<boundVars>{}</boundVars></function>", id(name), id(parameter))
    };
    let call = |name: &str, x: &str| eval(&format!("<apply>{}{x}</apply>", id(name)), None);
    let checked = executed(&[
        define(&id("X"), &range(1.0, 4.0)),
        define(&function("f", "y"), &sum("X")),
        define(&function("g", "X"), &sum("X")),
        call("f", &real(0.0)),
        call("g", &matrix(2, 1, &[real(7.0), real(8.0)])),
        define(&id("X"), &range(3.0, 1.0)),
        call("f", &real(0.0)),
        define(&id("X"), &real(5.0)),
        call("f", &real(0.0)),
        eval(&apply("plus", &[&id("X"), &real(1.0)]), None),
    ]);
    let values: Vec<_> =
        checked.iter().filter_map(|c| Some(c.value.as_ref()?.to_string())).collect();
    assert_eq!(values, ["10", "15", "10", "5", "10", "6"], "f has the X above it");
}

/// Where a construct is unsupported, its saved value goes on as input, and is marked.
#[test]
fn saved_values_go_on_as_input() {
    let integral = apply("integral", &[&id("t")]);
    let twice = apply("mult", &[&real(2.0), &id("y")]);
    let first = apply("indexer", &[&id("z"), &real(0.0)]);
    let checked = executed(&[
        define(&id("y"), &integral),
        eval(&twice, Some(8.0)),
        eval(&id("y"), Some(4.0)),
        eval(&twice, Some(8.0)),
        define(&id("z"), &integral),
        define(&first, &real(0.0)),
        eval(&id("z"), Some(5.0)),
    ]);
    let [one, y, z] = ["an integral", "an integral (it rests on y)", "an integral (it rests on z)"]
        .map(unsupported);
    assert_eq!(verdicts(&checked[..4]), [one.clone(), y.clone(), y, Agreement::Same]);
    assert_eq!(
        verdicts(&checked[4..]),
        [one, z.clone(), z],
        "one entry does not make others known"
    );
    assert_eq!(checked[3].inputs.iter().collect::<Vec<_>>(), ["2"]);
}

/// A definition that came to another value than Mathcad's is judged once: what follows goes on from
/// the saved one.
#[test]
fn definitions_that_differ_go_on_with_what_is_saved() {
    let three = define(&id("y"), &eval(&real(3.0), Some(4.0)));
    let checked = executed(&[three, eval(&id("y"), Some(4.0))]);
    let differs = Agreement::Differs { saved: "4".into(), ours: "3".into() };
    assert_eq!(verdicts(&checked), [differs, Agreement::Same]);
    assert_eq!(checked[1].inputs.iter().collect::<Vec<_>>(), ["0"]);
}

/// `ORIGIN := 0` counts from there on; a definition of an entry shows that entry.
#[test]
fn origin_is_set_by_a_region_and_entries_show_themselves() {
    let entry = |i: f64| apply("indexer", &[&id("v"), &real(i)]);
    let regions = [
        define(&entry(2.0), &real(7.0)),
        eval(&entry(2.0), Some(7.0)),
        // Another name.
        define("<id subscript=\"\">v</id>", &real(3.0)),
        define(&id("ORIGIN"), &real(0.0)),
        eval(&entry(1.0), Some(7.0)),
        define(&entry(0.0), &eval(&real(5.0), Some(5.0))),
        define(&id("ORIGIN"), &real(0.5)),
    ];
    let regions = regions.map(|inside| format!("<region><math>{inside}</math></region>")).concat();
    let text = format!(
        "<worksheet><settings><calculation><builtInVariables array-origin=\"1\"/></calculation>\
         </settings><regions>{regions}</regions></worksheet>"
    );
    let checked = execute(&document::read(&text, "sheet").unwrap(), &Limits::default());
    let (none, same) = (Agreement::NothingSaved, Agreement::Same);
    let half = unsupported("an ORIGIN that is no whole number");
    let defined = [none.clone(), same.clone(), none.clone(), none, same.clone(), same, half];
    assert_eq!(verdicts(&checked), defined);
}

/// What has no operator, or an operator that is none, is unsupported; it was once a recursion without
/// end.
#[test]
fn an_empty_operator_is_named() {
    let empty = format!("<apply><apply/>{}</apply>", real(1.0));
    let checked = executed(&[eval("<apply/>", None), eval(&empty, None)]);
    let words = ["an incomplete `apply`", "an empty place"];
    assert_eq!(verdicts(&checked), words.map(unsupported));
}

/// A solve block begins with the word Given; an equation within it defines nothing.
#[test]
fn a_solve_block_is_named() {
    let equation = apply("equal", &[&id("x"), &real(1.0)]);
    let checked = executed(&[id("Given"), equation, id("Gives")]);
    assert_eq!(verdicts(&checked), [unsupported("a solve block")]);
    assert_eq!(checked[0].id, "0", "the region of the word");
}

/// An array of one entry is no number, though both look the same.
#[test]
fn values_that_look_the_same_are_told_apart() {
    let checked = executed(&[eval(&numbers(1, 1, &[49.0]), Some(49.0))]);
    let [saved, ours] = ["49, a number", "49, a 1 x 1 array"].map(String::from);
    assert_eq!(checked[0].agreement, Agreement::Differs { saved, ours });
}
