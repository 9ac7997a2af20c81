//! XML files read back: texts, and the arrays of a VTU file.

use std::io::Read;

use flate2::read::ZlibDecoder;
use plane_contact::output::quantities::Array;
use plane_contact::output::vtu::document;
use plane_contact::xml::Element;
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

fn written() -> Vec<u8> {
    let of_triangles = [Array::new("a < b", "MPa", 1, vec![6.3, f64::MIN_POSITIVE])];
    let points = [Array::new("displacement", "mm", 2, DISPLACEMENT.to_vec())];
    document(&[("scene", "fig1 <&>".into())], &POINTS, &TRIANGLES, &points, &of_triangles)
}

/// Returns the type, the components and the bytes of an array, as a reader finds them: the XML ends
/// where the arrays begin, each as counts and compressed blocks.
fn read(file: &[u8], name: &str) -> (String, Option<String>, Vec<u8>) {
    let mark = b"<AppendedData encoding=\"raw\">_";
    let start = file.windows(mark.len()).position(|bytes| bytes == mark).unwrap() + mark.len();
    let end = b"\n</AppendedData>\n</VTKFile>\n";
    assert!(file.ends_with(end));
    let text =
        std::str::from_utf8(&file[..start]).unwrap().to_owned() + "</AppendedData></VTKFile>";
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("compressor"), Some("vtkZLibDataCompressor"));
    assert_eq!(root.attribute("header_type"), Some("UInt64"));
    let array = document.descendants().find(|n| n.attribute("Name") == Some(name)).unwrap();
    assert_eq!(array.attribute("format"), Some("appended"));
    let offset: usize = array.attribute("offset").unwrap().parse().unwrap();
    let mut rest = &file[start + offset..file.len() - end.len()];
    let mut number = || {
        let (number, after) = rest.split_first_chunk().unwrap();
        rest = after;
        u64::from_le_bytes(*number) as usize
    };
    let [blocks, full, last] = [number(), number(), number()];
    let sizes: Vec<usize> = (0..blocks).map(|_| number()).collect();
    let mut content = Vec::new();
    for (k, size) in sizes.into_iter().enumerate() {
        let (block, after) = rest.split_at(size);
        rest = after;
        let before = content.len();
        ZlibDecoder::new(block).read_to_end(&mut content).unwrap();
        let expected = if k + 1 == blocks && last > 0 { last } else { full };
        assert_eq!(content.len() - before, expected, "block {k} of {name}");
    }
    let attribute = |name| array.attribute(name).map(String::from);
    (attribute("type").unwrap(), attribute("NumberOfComponents"), content)
}

/// Returns the bits of the floats of an array.
fn bits(file: &[u8], name: &str) -> Vec<u64> {
    let (kind, _, content) = read(file, name);
    assert_eq!(kind, "Float64");
    content.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect()
}

fn whole(file: &[u8], name: &str) -> Vec<i64> {
    let (kind, _, content) = read(file, name);
    assert_eq!(kind, "Int64");
    content.as_chunks().0.iter().map(|bytes| i64::from_le_bytes(*bytes)).collect()
}

#[test]
fn floats_read_back_to_the_same_bits() {
    let with_zero = |vectors: &[[f64; 2]]| -> Vec<u64> {
        vectors.iter().flat_map(|&[x, y]| [x, y, 0.0]).map(f64::to_bits).collect()
    };
    let file = written();
    assert_eq!(bits(&file, "Points"), with_zero(&POINTS));
    assert_eq!(read(&file, "displacement").1.as_deref(), Some("3"));
    assert_eq!(bits(&file, "displacement"), with_zero(DISPLACEMENT.as_chunks().0));
    assert_eq!(bits(&file, "a < b"), [6.3, f64::MIN_POSITIVE].map(f64::to_bits));
}

#[test]
fn cells_are_triangles() {
    let file = written();
    assert_eq!(whole(&file, "connectivity"), [0, 1, 2, 0, 2, 3]);
    assert_eq!(whole(&file, "offsets"), [3, 6]);
    let (kind, _, types) = read(&file, "types");
    assert_eq!((kind.as_str(), types.as_slice()), ("UInt8", &[5, 5][..]));
}

/// Arrays of many blocks, the last one full or not.
#[test]
fn long_arrays_read_back() {
    let seeded = |k: usize| f64::from_bits((k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 2);
    for count in [1 << 16, 100_003] {
        let values: Vec<f64> = (0..count).map(seeded).collect();
        let triangles = vec![[0, 1, 2]; count];
        let file =
            document(&[], &POINTS, &triangles, &[], &[Array::new("v", "", 1, values.clone())]);
        assert_eq!(bits(&file, "v"), values.iter().map(|v| v.to_bits()).collect::<Vec<_>>());
        assert_eq!(whole(&file, "connectivity"), [0, 1, 2].repeat(count));
        assert_eq!(
            document(&[], &POINTS, &triangles, &[], &[Array::new("v", "", 1, values.clone())]),
            file
        );
    }
}

#[test]
#[should_panic(expected = "displacement: 2 values for each of 4")]
fn missing_values_are_refused() {
    let points = [Array::new("displacement", "", 2, DISPLACEMENT[..6].to_vec())];
    document(&[], &POINTS, &TRIANGLES, &points, &[]);
}
