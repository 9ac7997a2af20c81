//! The paper's two listings on scenes small enough to be worked out by hand.

use mathcad::array::{Column, Table};
use mathcad::failure::Fallible;
use mathcad::xmcd::page::Page;
use mathcad::{Array, Cause, Conjunction, Edit, Ended, Limits, Listing, Settings, Sheet, Value};

const LISTINGS: [(&str, &str); 2] = [
    ("c_cnt", include_str!("../../../listings/c_cnt.txt")),
    ("Km", include_str!("../../../listings/Km.txt")),
];

/// The paper's listings print as they are written, and in ASCII are the same programs.
#[test]
fn listings_print_back_and_may_be_typed_in_ascii() {
    let signs = [
        ("←", "<-"),
        ("∈", "in"),
        ("∧", "and"),
        ("≤", "<="),
        ("≥", ">="),
        ("≠", "!="),
        ("·", "*"),
        ("−", "-"),
        ("(0 0 0 0 0 0)ᵀ", "transpose(0 0 0 0 0 0)"),
        ("B[n]ᵀ", "transpose(B[n])"),
        (" + c_tll)ᵀ", " + c_tll)"),
        ("ntx <- (", "ntx := transpose("),
        ("nty <- (", "nty := transpose("),
    ];
    for (name, text) in LISTINGS {
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let text: String = lines.map(|line| format!("{line}\n")).collect();
        let typed =
            signs.iter().fold(text.clone(), |text, (sign, typed)| text.replace(sign, typed));
        let typed = typed.replace('ν', "nu");
        assert!(typed.is_ascii(), "{typed}");
        let [printed, typed] = [&text, &typed].map(|text| Listing::parse(name, text).unwrap());
        assert_eq!(printed.to_string(), text, "the lines, byte for byte");
        let [printed, typed] = [printed, typed].map(|listing| {
            let mut page = Page::default();
            page.program(&listing);
            page.finish("", &Settings::default())
        });
        assert_eq!(typed.replace(">nu<", ">ν<"), printed, "the programs");
    }
}

fn c_cnt() -> Listing {
    Listing::parse("c_cnt", include_str!("../../../listings/c_cnt.txt")).unwrap()
}

fn km() -> Listing {
    Listing::parse("Km", include_str!("../../../listings/Km.txt")).unwrap()
}

fn under(edit: &str, listing: &Listing) -> Listing {
    Edit::parse(edit).unwrap().apply(listing).unwrap()
}

fn table<const N: usize>(rows: &[[f64; N]]) -> Table<f64> {
    Table::from_fn(rows.len(), N, |i, j| rows[i - 1][j - 1])
}

/// Target: edges 1 (nodes 1-2) and 2 (2-3) along y = x/2. Contact: nodes 4, 5, 6. Tolerance 1/4.
///
/// ```text
///         6·     3       node   current      initially
///          5·  /         4      1,    5/8    x = 5/4
///     4·    2            5      3,    1
///       /                6      7/2,  17/8
///     1
/// ```
fn find_pairs(listing: &Listing, settings: &Settings) -> Fallible<Ended> {
    let moved = table(&[
        [1.0, 0.0, 0.0, 0.0],
        [2.0, 2.0, 1.0, 0.0],
        [3.0, 4.0, 2.0, 0.0],
        [4.0, 1.0, 0.625, 0.0],
        [5.0, 3.0, 1.0, 0.0],
        [6.0, 3.5, 2.125, 0.0],
    ]);
    let mut initial = moved.clone();
    initial[(4, 2)] = 1.25;
    let mut worksheet = Sheet::empty();
    worksheet.define("node", &initial).define("c_tll", 0.25).define("R", 6usize);
    worksheet.define(
        "elem",
        &table(&[[1.0, 1.0, 2.0, 0.0, 0.0, 1.0, 2.0], [2.0, 1.0, 2.0, 0.0, 0.0, 2.0, 3.0]]),
    );
    worksheet
        .define("cnt", &Column::from_vec(vec![4usize, 5, 6]))
        .define("trg", &Column::from_vec(vec![1usize, 2]));
    listing.runner(&worksheet, settings, &Limits::default()).call(&[Value::from(&moved)])
}

#[test]
fn contact_pairs() {
    let found = find_pairs(&c_cnt(), &Settings::default()).unwrap();
    // Boxes: edge 1 [-1/4, 9/4] x [-1/4, 5/4], edge 2 [7/4, 17/4] x [3/4, 9/4].
    assert_eq!(found.locals["ct"].to_string(), "1; 2; 2");
    // Line minus node: 1/2 - 5/8, 3/2 - 1, 7/4 - 17/8.
    assert_eq!(found.locals["yt"].to_string(), "-0.125; 0.5; -0.375");
    // Node 4 within the tolerance; 5 not; 6 by line 18, as yt < 0 and its neighbour's > 0.
    assert_eq!(found.locals["dy"].to_string(), "1; 0; 1");
    assert_eq!(found.trace_output, ["1", "2"]);
    // Node 4: k1 = 1 - (5/4)/2 = 3/8, k2 = 1 - (3/4)/2 = 5/8.
    // Node 6: k1 = 1 - (3/2)/2 = 1/4, k2 = 3/4.
    // Node 2 is mate of both: the last number stays, the weights add up, 5/8 + 1/4 = 7/8.
    let expected = table(&[
        [4.0, 0.375, 0.0, 0.0],
        [6.0, 0.875, 0.0, 0.0],
        [6.0, 0.75, 0.0, 0.0],
        [1.0, 0.375, 2.0, 0.625],
        [0.0, 0.0, 0.0, 0.0],
        [2.0, 0.25, 3.0, 0.75],
    ]);
    assert_eq!(Table::try_from(&found.value), Ok(expected));
}

#[test]
fn contact_pairs_unless_conjunction_guards() {
    // i1 = 1, yt[1] < 0: line 18 reads yt[0] before it asks whether i1 ≥ 2 (C10).
    for conjunction in [Conjunction::LeftToRight, Conjunction::Eager] {
        let failure =
            find_pairs(&c_cnt(), &Settings { conjunction, ..Settings::default() }).unwrap_err();
        assert_eq!((failure.line, failure.text.as_str()), (18, "yt[i1−1]"));
        assert!(matches!(failure.cause, Cause::IndexBelowOrigin { .. }), "{failure}");
    }
}

#[test]
fn contact_pairs_under_r1_inside() {
    let listing = under(include_str!("../../../listings/readings/R1-inside.edit"), &c_cnt());
    let pairs =
        Table::<f64>::try_from(&find_pairs(&listing, &Settings::default()).unwrap().value).unwrap();
    // Row r is zeroed on turn r of 6, before that turn's weights: they are added 7 - r times.
    assert_eq!(pairs[(4, 2)], 3.0 * 0.375);
    assert_eq!(pairs[(2, 2)], 5.0 * 0.875);
    assert_eq!(pairs[(6, 4)], 0.75);
}

#[test]
fn contact_pairs_under_r5_node_n() {
    let listing = under(include_str!("../../../listings/readings/R5-node_n.edit"), &c_cnt());
    let pairs =
        Table::<f64>::try_from(&find_pairs(&listing, &Settings::default()).unwrap().value).unwrap();
    // From the current x = 1: half and half.
    assert_eq!((pairs[(4, 2)], pairs[(4, 4)]), (0.5, 0.5));
}

/// Elements 1 (nodes 1, 2, 3) and 2 (4, 5, 6); B = [I I], so that K = Ae·[D D; D D] with the
/// diagonal D = (E, E, E·ν): (2, 2, 1) for element 1 and 2·(4, 4, 1) = (8, 8, 2) for element 2.
/// Equations 1 and 10 are restrained.
fn assemble(listing: &Listing) -> Table<f64> {
    let mut worksheet = Sheet::empty();
    let unit = Array::from_fn(3, 6, |i, j| if j % 3 == i { 1.0 } else { 0.0 });
    let restrained =
        (1..=12).map(|equation| if equation == 1 || equation == 10 { 1.0 } else { 0.0 });
    worksheet.define("R", 6usize).define("M", 2usize).define("ind_1", 6usize);
    worksheet.define(
        "EL",
        &table(&[
            [0.0, 2.0, 2.0, 0.0, 0.0, 1.0, 2.0, 3.0],
            [0.0, 2.0, 2.0, 0.0, 0.0, 4.0, 5.0, 6.0],
        ]),
    );
    worksheet.define("S", &Column::from_vec(restrained.collect::<Vec<f64>>()));
    worksheet
        .define("Ae", &Column::from_vec(vec![1.0, 2.0]))
        .define("E", &Column::from_vec(vec![2.0, 4.0]));
    worksheet.define("ν", &Column::from_vec(vec![0.5, 0.25]));
    worksheet.define("B", [unit.clone(), unit].map(Value::from).into_iter().collect::<Value>());
    worksheet.define_function("D", |arguments| match arguments {
        [Value::Number(e), Value::Number(nu)] => Ok(Array::from_fn(3, 3, |i, j| {
            if i != j {
                0.0
            } else if i < 2 {
                *e
            } else {
                e * nu
            }
        })
        .into()),
        _ => Err("D takes two numbers".into()),
    });
    let pairs = table(&[
        [4.0, 0.5, 0.0, 0.0],
        [6.0, 0.75, 0.0, 0.0],
        [6.0, 0.75, 0.0, 0.0],
        [1.0, 0.5, 2.0, 0.5],
        [0.0, 0.0, 0.0, 0.0],
        [2.0, 0.25, 3.0, 0.75],
    ]);
    let outcome = listing
        .runner(&worksheet, &Settings::default(), &Limits::default())
        .call(&[Value::from(&pairs)])
        .unwrap_or_else(|failure| panic!("{failure}"));
    Table::try_from(&outcome.value).unwrap()
}

#[test]
fn stiffness() {
    let stiffness = assemble(&km());
    // Element 1, first pair: W = (7, 8, 11, 12, 11, 12), fl = 3/4, the last one's. Second pair:
    // none. Element 2, first pair: W = (0, 2, 0, 0, 3, 4), fl = 1/4; equation 1 is restrained.
    // Second: W = (3, 4, 0, 0, 5, 6), 3/4.
    let upper = [
        (1, 1, 1.0),                // restrained
        (2, 2, 2.0 + 8.0 * 0.25),   // element 1; 2 as mate, first pair
        (2, 3, 8.0 * 0.25),         // first pair
        (2, 5, 2.0),                // element 1
        (3, 3, 1.0 + 2.0 + 6.0),    // element 1; first pair 8/4; second 8·3/4
        (3, 6, 1.0),                // element 1
        (4, 4, 2.0 + 0.5 + 6.0),    // element 1; first pair 2/4; second 8·3/4
        (4, 5, 6.0),                // second pair
        (5, 5, 2.0 + 6.0),          // element 1; second pair
        (6, 6, 1.0 + 1.5),          // element 1; second pair 2·3/4
        (7, 7, 1.5 + 8.0),          // first pair 2·3/4; element 2
        (7, 12, 1.5),               // first pair
        (8, 8, 1.5 + 8.0),          // first pair; element 2
        (8, 11, 1.5 + 8.0),         // first pair; element 2
        (9, 9, 2.0),                // element 2
        (9, 12, 2.0),               // element 2
        (10, 10, 1.0),              // restrained
        (11, 11, 1.5 + 0.75 + 8.0), // first pair 2·3/4 and 1·3/4; element 2
        (11, 12, 0.75),             // first pair
        (12, 12, 1.5 + 0.75 + 2.0), // first pair; element 2
    ];
    let mut expected = Table::filled(12, 12, 0.0);
    for (i, j, value) in upper {
        expected[(i, j)] = value;
        expected[(j, i)] = value;
    }
    assert_eq!(stiffness, expected);
}

#[test]
fn stiffness_under_r2_printed() {
    let stiffness =
        assemble(&under(include_str!("../../../listings/readings/R2-printed.edit"), &km()));
    // Equation 1 stays free: K[1,1] of element 1. With 10, 9 is restrained.
    assert_eq!((stiffness[(1, 1)], stiffness[(1, 4)]), (2.0, 2.0));
    assert_eq!((stiffness[(9, 9)], stiffness[(9, 12)]), (1.0, 0.0));
}

#[test]
fn stiffness_under_r3() {
    let per_node =
        assemble(&under(include_str!("../../../listings/readings/R3-per-node.edit"), &km()));
    let nested = assemble(&under(include_str!("../../../listings/readings/R3-nested.edit"), &km()));
    for stiffness in [&per_node, &nested] {
        // Node 1 of element 1 adds alone, with its own 1/2: nothing between 7 and 12, 2/2 on 7.
        assert_eq!((stiffness[(7, 12)], stiffness[(7, 7)]), (0.0, 1.0 + 8.0));
    }
    // Equation 5 is a mate in the second pair only: 8·3/4 once, or three times.
    assert_eq!((per_node[(5, 5)], nested[(5, 5)]), (2.0 + 6.0, 2.0 + 18.0));
}

#[test]
fn an_edited_line_keeps_its_printed_number() {
    let nested = under(include_str!("../../../listings/readings/R3-nested.edit"), &km());
    let numbers: Vec<_> = nested.lines().iter().map(|line| line.printed).collect();
    let expected: Vec<_> = (1..=33).chain([24, 25, 34]).collect();
    assert_eq!(numbers, expected);
}

#[test]
fn tables_survive_the_way_there_and_back() {
    let numbers = table(&[[1.5, -0.0], [f64::MIN_POSITIVE / 2.0, 3.0], [0.1, 1e300]]);
    let back = Table::<f64>::try_from(&Value::from(&numbers)).unwrap();
    assert!(
        numbers
            .row(1)
            .chain(numbers.row(2))
            .zip(back.row(1).chain(back.row(2)))
            .all(|(a, b)| a.to_bits() == b.to_bits())
    );
    assert_eq!(back, numbers);
    let column = Column::from_vec(vec![1.0, 2.0]);
    assert_eq!(Column::<f64>::try_from(&Value::from(&column)), Ok(column));
    assert!(Column::<f64>::try_from(&Value::from(&numbers)).is_err());
    assert!(Table::<f64>::try_from(&Value::Number(1.0)).is_err());
}
