//! Mesh and results as a VTU file (VTK's XML format for unstructured grids), for ParaView and its kin.

use std::fmt::Display;

use super::xml::Element;

/// VTK's number for a triangle of three nodes.
const TRIANGLE: u8 = 5;

/// What goes into the file. Points and triangles count from 0.
pub struct VtuMesh<'a> {
    /// x and y of each node; z is written as 0.
    pub points: &'a [[f64; 2]],
    /// The corners of each triangle, as indices of points.
    pub triangles: &'a [[usize; 3]],
    /// Results per point: the displacement.
    pub point_data: &'a [Data<'a>],
    /// Results per triangle: stress, strain, the body's number.
    pub cell_data: &'a [Data<'a>],
}

/// A named result.
pub struct Data<'a> {
    /// The name that the viewer lists.
    pub name: &'a str,
    /// Numbers per point or triangle. A vector in the plane has 2 and is written with a third, 0: viewers warp by 3.
    pub components: usize,
    /// All components of the first point or triangle, then of the second, and so on; finite.
    pub values: &'a [f64],
}

/// The file's text. Every number reads back to the same bits.
///
/// # Panics
///
/// If a result has not `components` finite values for every point or triangle.
pub fn vtu(mesh: &VtuMesh) -> String {
    let piece = Element::new("Piece")
        .set("NumberOfPoints", mesh.points.len().to_string())
        .set("NumberOfCells", mesh.triangles.len().to_string())
        .with(results("PointData", mesh.point_data, mesh.points.len()))
        .with(results("CellData", mesh.cell_data, mesh.triangles.len()))
        .with(Element::new("Points").with(floats("Points", 2, mesh.points.as_flattened())))
        .with(cells(mesh.triangles));
    Element::new("VTKFile")
        .set("type", "UnstructuredGrid")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64")
        .with(Element::new("UnstructuredGrid").with(piece))
        .document()
}

fn results(place: &'static str, data: &[Data], count: usize) -> Element {
    let array = |data: &Data| {
        let expected = data.components * count;
        assert_eq!(
            data.values.len(),
            expected,
            "{}: {} values for each of {count}",
            data.name,
            data.components
        );
        floats(data.name, data.components, data.values)
    };
    Element::new(place).with_all(data.iter().map(array))
}

fn cells(triangles: &[[usize; 3]]) -> Element {
    let corners = lines(triangles);
    let offsets: Vec<_> = (1..=triangles.len()).map(|triangle| [3 * triangle]).collect();
    Element::new("Cells")
        .with(array("Int64", "connectivity", corners))
        .with(array("Int64", "offsets", lines(&offsets)))
        .with(array("UInt8", "types", lines(&vec![[TRIANGLE]; triangles.len()])))
}

/// Floats in the shortest text that reads back to the same bits, a point or triangle per line.
fn floats(name: &str, components: usize, values: &[f64]) -> Element {
    assert!(
        values.iter().all(|value| value.is_finite()),
        "{name}: a file for a viewer needs finite numbers"
    );
    let line = |values: &[f64]| match values {
        [x, y] => format!("{x:?} {y:?} 0.0"),
        _ => spaced(values.iter().map(|value| format!("{value:?}"))),
    };
    let text: Vec<_> = values.chunks(components).map(line).collect();
    let written = if components == 2 { 3 } else { components };
    array("Float64", name, text.join("\n")).set("NumberOfComponents", written.to_string())
}

fn lines<const N: usize>(rows: &[[impl Display; N]]) -> String {
    let rows: Vec<_> = rows.iter().map(|row| spaced(row.iter().map(ToString::to_string))).collect();
    rows.join("\n")
}

fn spaced(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(" ")
}

fn array(kind: &str, name: &str, text: String) -> Element {
    Element::with_text("DataArray", text).set("type", kind).set("Name", name).set("format", "ascii")
}

#[cfg(test)]
mod tests {
    use roxmltree::Document;

    use super::*;

    const POINTS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, -0.0], [1.0, 1.0 / 3.0], [0.0, 1e300]];
    const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
    const DISPLACEMENT: [f64; 8] =
        [0.1 + 0.2, -1e-300, 5e-324, 0.0, -0.0, f64::MAX, f64::EPSILON, -2.5];

    fn written() -> String {
        vtu(&VtuMesh {
            points: &POINTS,
            triangles: &TRIANGLES,
            point_data: &[Data { name: "displacement", components: 2, values: &DISPLACEMENT }],
            cell_data: &[Data { name: "a < b", components: 1, values: &[6.3, f64::MIN_POSITIVE] }],
        })
    }

    /// Components and numbers of an array, as a reader finds them.
    fn read(file: &str, name: &str) -> (Option<String>, Vec<String>) {
        let document = Document::parse(file).unwrap();
        let array =
            document.descendants().find(|node| node.attribute("Name") == Some(name)).unwrap();
        let numbers = array.text().unwrap().split_whitespace().map(String::from).collect();
        (array.attribute("NumberOfComponents").map(String::from), numbers)
    }

    fn bits(numbers: &[String]) -> Vec<u64> {
        numbers.iter().map(|number| number.parse::<f64>().unwrap().to_bits()).collect()
    }

    fn bits_with_zero(vectors: &[[f64; 2]]) -> Vec<u64> {
        vectors.iter().flat_map(|&[x, y]| [x, y, 0.0]).map(f64::to_bits).collect()
    }

    #[test]
    fn floats_read_back_to_the_same_bits() {
        let file = written();
        assert_eq!(bits(&read(&file, "Points").1), bits_with_zero(&POINTS));
        let (components, displacement) = read(&file, "displacement");
        assert_eq!(components.as_deref(), Some("3"));
        assert_eq!(bits(&displacement), bits_with_zero(DISPLACEMENT.as_chunks().0));
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
        let data = [Data { name: "displacement", components: 2, values: &DISPLACEMENT[..6] }];
        vtu(&VtuMesh { points: &POINTS, triangles: &TRIANGLES, point_data: &data, cell_data: &[] });
    }
}
