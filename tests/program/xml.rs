//! XML files read back: texts, and the arrays of a VTU file.

use plane_contact::report::vtu::document;
use plane_contact::report::xml::Element;
use roxmltree::Document;

#[test]
fn text_reads_back() {
    let text = "a < b & \"c\" > 'd' · 10⁻³";
    let written = Element::new("r").set("a", text).with(Element::with_text("t", text)).document();
    let read = Document::parse(&written).unwrap();
    assert_eq!(read.root_element().attribute("a"), Some(text));
    assert_eq!(read.root_element().first_element_child().unwrap().text(), Some(text));
}

#[test]
fn forbidden_characters_are_replaced() {
    let written = Element::with_text("t", "a\0b\u{1b}c\u{ffff}").document();
    assert!(written.contains(">a\u{fffd}b\u{fffd}c\u{fffd}<"), "{written}");
}

const POINTS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, -0.0], [1.0, 1.0 / 3.0], [0.0, 1e300]];
const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const DISPLACEMENT: [f64; 8] =
    [0.1 + 0.2, -1e-300, 5e-324, 0.0, -0.0, f64::MAX, f64::EPSILON, -2.5];

fn written() -> String {
    let of_triangles = [("a < b", 1, &[6.3, f64::MIN_POSITIVE][..])];
    document(&POINTS, &TRIANGLES, &[("displacement", 2, &DISPLACEMENT)], &of_triangles)
}

/// Returns the components and the numbers of an array, as a reader finds them.
fn read(file: &str, name: &str) -> (Option<String>, Vec<String>) {
    let document = Document::parse(file).unwrap();
    let mut arrays = document.descendants().filter(|n| n.attribute("Name") == Some(name));
    let array = arrays.next().unwrap();
    let numbers = array.text().unwrap().split_whitespace().map(String::from).collect();
    (array.attribute("NumberOfComponents").map(String::from), numbers)
}

fn bits(numbers: &[String]) -> Vec<u64> {
    numbers.iter().map(|number| number.parse::<f64>().unwrap().to_bits()).collect()
}

#[test]
fn floats_read_back_to_the_same_bits() {
    let with_zero = |vectors: &[[f64; 2]]| -> Vec<u64> {
        vectors.iter().flat_map(|&[x, y]| [x, y, 0.0]).map(f64::to_bits).collect()
    };
    let file = written();
    assert_eq!(bits(&read(&file, "Points").1), with_zero(&POINTS));
    let (components, displacement) = read(&file, "displacement");
    assert_eq!(components.as_deref(), Some("3"));
    assert_eq!(bits(&displacement), with_zero(DISPLACEMENT.as_chunks().0));
    assert_eq!(bits(&read(&file, "a < b").1), [6.3, f64::MIN_POSITIVE].map(f64::to_bits));
}

#[test]
fn cells_are_triangles() {
    let file = written();
    assert_eq!(read(&file, "connectivity").1, ["0", "1", "2", "0", "2", "3"]);
    assert_eq!(read(&file, "offsets").1, ["3", "6"]);
    assert_eq!(read(&file, "types").1, ["5", "5"]);
}

#[test]
#[should_panic(expected = "displacement: 2 values for each of 4")]
fn missing_values_are_refused() {
    document(&POINTS, &TRIANGLES, &[("displacement", 2, &DISPLACEMENT[..6])], &[]);
}
