//! Mesh and results as a VTU file: VTK's XML format for unstructured grids, as ParaView reads it.
//!
//! ```text
//! <VTKFile compressor="vtkZLibDataCompressor" header_type="UInt64" ...>
//!   <DataArray format="appended" offset="0" .../>              what stands where
//!   <DataArray format="appended" offset="4711" .../>
//!   <AppendedData encoding="raw">_                             arrays, as bytes
//!      blocks, bytes of a block, of the last one (0: it is full), of each compressed | blocks
//! ```

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;

use super::picture::Drawing;
use super::xml::Element;
use crate::answer::{Assessment, Solution};
use crate::problem::element::State;

/// VTK's number for a triangle of three nodes.
const TRIANGLE: u8 = 5;

/// The bytes of a block before it is compressed.
const BLOCK: usize = 1 << 18;

/// A result: the name that the viewer lists, the number of its components, and all components of
/// the first point or triangle, then of the second, and so on.
type Data<'a> = (&'a str, usize, &'a [f64]);

/// Writes the mesh of `drawing`, the displacements of its points, and the stresses, the strains,
/// the body and, where it was estimated, the error of its triangles. Every number reads back to the same bits.
///
/// # Panics
///
/// If a result is not finite.
pub fn vtu(drawing: &Drawing, solution: &Solution, assessment: &Assessment) -> Vec<u8> {
    let elements = &solution.elements;
    let three = |of: fn(&State) -> [f64; 3]| elements.iter().flat_map(of).collect::<Vec<_>>();
    let one = |of: fn(&State) -> f64| elements.iter().map(of).collect::<Vec<_>>();
    let body: Vec<f64> = drawing.region.iter().map(|region| *region as f64).collect();
    let mesh_error = assessment.estimates.as_ref().map(|estimates| estimates.mesh.error_map());
    let triangles: [Data; 5] = [
        ("sigma_x sigma_y tau_xy", 3, &three(|s| s.sigma.into())),
        ("epsilon_x epsilon_y gamma_xy", 3, &three(|s| s.epsilon.into())),
        ("von_mises_stress", 1, &one(|s| s.von_mises_stress)),
        ("von_mises_strain", 1, &one(|s| s.von_mises_strain)),
        ("body", 1, &body),
    ];
    let mesh_error = mesh_error.as_deref().map(|error| ("mesh_error", 1, error));
    let triangles: Vec<Data> = triangles.into_iter().chain(mesh_error).collect();
    let points: [Data; 1] = [("displacement", 2, solution.u.as_slice())];
    document(&drawing.points, &drawing.triangles, &points, &triangles)
}

pub fn document(
    points: &[[f64; 2]],
    triangles: &[[usize; 3]],
    of_points: &[Data],
    of_triangles: &[Data],
) -> Vec<u8> {
    let mut arrays = Arrays::default();
    let piece = Element::new("Piece")
        .set("NumberOfPoints", points.len().to_string())
        .set("NumberOfCells", triangles.len().to_string())
        .with(arrays.results("PointData", of_points, points.len()))
        .with(arrays.results("CellData", of_triangles, triangles.len()))
        .with(Element::new("Points").with(arrays.floats(&("Points", 2, points.as_flattened()))))
        .with(arrays.cells(triangles));
    let text = Element::new("VTKFile")
        .set("type", "UnstructuredGrid")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64")
        .set("compressor", "vtkZLibDataCompressor")
        .with(Element::new("UnstructuredGrid").with(piece))
        .with(Element::with_text("AppendedData", "_").set("encoding", "raw"))
        .document();
    let (before, after) = text.rsplit_once('_').expect("the arrays follow it");
    // Readers that look for the end of the arrays expect a line of its own.
    [before.as_bytes(), b"_", &arrays.bytes, b"\n", after.as_bytes()].concat()
}

/// The arrays, one after the other.
#[derive(Default)]
struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    fn results(&mut self, place: &'static str, data: &[Data], count: usize) -> Element {
        for (name, components, values) in data {
            assert_eq!(
                values.len(),
                components * count,
                "{name}: {components} values for each of {count}"
            );
        }
        Element::new(place).with_all(data.iter().map(|data| self.floats(data)))
    }

    fn cells(&mut self, triangles: &[[usize; 3]]) -> Element {
        let corners = triangles.as_flattened().iter();
        let corners = corners.flat_map(|corner| (*corner as i64).to_le_bytes());
        let offsets = (1..=triangles.len()).flat_map(|count| (3 * count as i64).to_le_bytes());
        Element::new("Cells")
            .with(self.array("Int64", "connectivity", corners.collect()))
            .with(self.array("Int64", "offsets", offsets.collect()))
            .with(self.array("UInt8", "types", vec![TRIANGLE; triangles.len()]))
    }

    /// Adds floats with all their bits. A vector in the plane gets a third component, 0: viewers
    /// warp by three.
    fn floats(&mut self, (name, components, values): &Data) -> Element {
        assert!(
            values.iter().all(|value| value.is_finite()),
            "{name}: a file for a viewer needs finite numbers"
        );
        let third: &[f64] = if *components == 2 { &[0.0] } else { &[] };
        let rows = values.chunks(*components).flat_map(|row| row.iter().chain(third));
        let bytes = rows.flat_map(|value| value.to_le_bytes()).collect();
        self.array("Float64", name, bytes)
            .set("NumberOfComponents", (components + third.len()).to_string())
    }

    /// Adds an array in compressed blocks.
    fn array(&mut self, kind: &str, name: &str, content: Vec<u8>) -> Element {
        let offset = self.bytes.len();
        let blocks: Vec<Vec<u8>> = content.par_chunks(BLOCK).map(compressed).collect();
        let sizes = blocks.iter().map(Vec::len);
        let numbers = [blocks.len(), BLOCK, content.len() % BLOCK].into_iter().chain(sizes);
        self.bytes.extend(numbers.flat_map(|number| (number as u64).to_le_bytes()));
        blocks.iter().for_each(|block| self.bytes.extend_from_slice(block));
        Element::new("DataArray")
            .set("type", kind)
            .set("Name", name)
            .set("format", "appended")
            .set("offset", offset.to_string())
    }
}

/// Compresses a block: quickly, for most bits of a result are noise to a compressor.
fn compressed(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(block).expect("memory takes any bytes");
    encoder.finish().expect("memory takes any bytes")
}
