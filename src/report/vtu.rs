//! Mesh and results as a VTU file: VTK's XML format for unstructured grids, as ParaView reads it.

use super::picture::Drawing;
use super::xml::Element;
use crate::answer::{Assessment, Solution};
use crate::problem::element::State;

/// VTK's number for a triangle of three nodes.
const TRIANGLE: u8 = 5;

/// A result: the name that the viewer lists, the number of its components, and all components of
/// the first point or triangle, then of the second, and so on.
type Data<'a> = (&'a str, usize, &'a [f64]);

/// Writes the mesh of `drawing`, the displacements of its points, and the stresses, the strains,
/// the body and the estimated error of its triangles. Every number reads back to the same bits.
///
/// # Panics
///
/// If a result is not finite.
pub fn vtu(drawing: &Drawing, solution: &Solution, assessment: &Assessment) -> String {
    let elements = &solution.elements;
    let three = |of: fn(&State) -> [f64; 3]| elements.iter().flat_map(of).collect::<Vec<_>>();
    let one = |of: fn(&State) -> f64| elements.iter().map(of).collect::<Vec<_>>();
    let body: Vec<f64> = drawing.region.iter().map(|region| *region as f64).collect();
    let triangles: [Data; 6] = [
        ("sigma_x sigma_y tau_xy", 3, &three(|s| s.sigma.into())),
        ("epsilon_x epsilon_y gamma_xy", 3, &three(|s| s.epsilon.into())),
        ("von_mises_stress", 1, &one(|s| s.von_mises_stress)),
        ("von_mises_strain", 1, &one(|s| s.von_mises_strain)),
        ("body", 1, &body),
        ("mesh_error", 1, &assessment.estimates.mesh.error_map()),
    ];
    let points: [Data; 1] = [("displacement", 2, solution.u.as_slice())];
    document(&drawing.points, &drawing.triangles, &points, &triangles)
}

pub fn document(
    points: &[[f64; 2]],
    triangles: &[[usize; 3]],
    of_points: &[Data],
    of_triangles: &[Data],
) -> String {
    let piece = Element::new("Piece")
        .set("NumberOfPoints", points.len().to_string())
        .set("NumberOfCells", triangles.len().to_string())
        .with(results("PointData", of_points, points.len()))
        .with(results("CellData", of_triangles, triangles.len()))
        .with(Element::new("Points").with(floats(&("Points", 2, points.as_flattened()))))
        .with(cells(triangles));
    Element::new("VTKFile")
        .set("type", "UnstructuredGrid")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64")
        .with(Element::new("UnstructuredGrid").with(piece))
        .document()
}

fn results(place: &'static str, data: &[Data], count: usize) -> Element {
    for (name, components, values) in data {
        assert_eq!(
            values.len(),
            components * count,
            "{name}: {components} values for each of {count}"
        );
    }
    Element::new(place).with_all(data.iter().map(floats))
}

fn cells(triangles: &[[usize; 3]]) -> Element {
    let corners = triangles.iter().map(|corners| corners.map(|point| point.to_string()));
    let offsets = (1..=triangles.len()).map(|count| [(3 * count).to_string()]);
    let types = triangles.iter().map(|_| [TRIANGLE.to_string()]);
    Element::new("Cells")
        .with(array("Int64", "connectivity", corners))
        .with(array("Int64", "offsets", offsets))
        .with(array("UInt8", "types", types))
}

/// Writes floats in the shortest text that reads back to the same bits, a point or triangle on each
/// line. A vector in the plane gets a third component, 0: viewers warp by three.
fn floats((name, components, values): &Data) -> Element {
    assert!(
        values.iter().all(|value| value.is_finite()),
        "{name}: a file for a viewer needs finite numbers"
    );
    let plane = *components == 2;
    let text = |value: &f64| format!("{value:?}");
    let row = |row: &[f64]| -> Vec<String> {
        row.iter().map(text).chain(plane.then(|| text(&0.0))).collect()
    };
    let written = if plane { 3 } else { *components };
    let rows = values.chunks(*components).map(row);
    array("Float64", name, rows).set("NumberOfComponents", written.to_string())
}

fn array(kind: &str, name: &str, rows: impl IntoIterator<Item = impl AsRef<[String]>>) -> Element {
    let rows: Vec<_> = rows.into_iter().map(|row| row.as_ref().join(" ")).collect();
    let element = Element::with_text("DataArray", &rows.join("\n"));
    element.set("type", kind).set("Name", name).set("format", "ascii")
}
