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
use super::quantities::{Array, array, contact_array, triangle_array};
use base::files::json::VERSION;
use base::xml::Element;
use engine::options::Options;
use engine::{Assessment, ContactNode, NodeFields, Solution, TriangleValues};

/// VTK's number for a triangle of three nodes.
const TRIANGLE: u8 = 5;

/// The bytes of a block before it is compressed.
const BLOCK: usize = 1 << 18;

/// What the file says of itself: a name and a text each.
type About = (&'static str, String);

/// Writes the mesh of `drawing`, the quantities of its nodes, contact nodes and triangles, and the body
/// of each triangle. Every number reads back to the same bits.
///
/// `active` is 1 on the contact surface, and 0 elsewhere, where its numbers are 0 and its states -1.
///
/// # Panics
///
/// If a result is infinite.
pub fn vtu(drawing: &Drawing, solution: &Solution, assessment: &Assessment) -> Vec<u8> {
    let scene = &solution.request.scene;
    let units = &scene.units;
    let values = TriangleValues::all(solution, assessment.mesh_error().as_deref());
    let triangles = TriangleValues::QUANTITIES.iter();
    let mut triangles: Vec<Array> =
        triangles.filter_map(|quantity| triangle_array(quantity, &values, units)).collect();
    let body = drawing.region.iter().map(|region| *region as f64);
    triangles.push(Array::new("body", "", 1, body.collect()));
    let nodes = NodeFields::new(solution);
    let count = nodes.nodes.len();
    let at_nodes = NodeFields::QUANTITIES.iter().filter(|quantity| !quantity.title.is_empty());
    let at_nodes = at_nodes.filter_map(|q| Some(array(q, (q.value)(&nodes).numbers()?, units)));
    let contact = ContactNode::QUANTITIES.iter();
    let contact = contact.filter_map(|q| contact_array(q, &solution.contact, count, units));
    let mut active = vec![0.0; count];
    solution.contact.iter().for_each(|node| active[node.node.index()] = 1.0);
    let active = (!solution.contact.is_empty()).then(|| Array::new("active", "", 1, active));
    let points: Vec<Array> = at_nodes.chain(contact).chain(active).collect();
    let [scene_sha256, mesh_sha256] = scene.hashes().clone();
    let mut about: Vec<About> = vec![
        ("program", format!("plane-contact {VERSION}")),
        ("scene", scene.name.clone()),
        ("scene_sha256", scene_sha256),
        ("mesh_sha256", mesh_sha256),
        ("run", Options::from_request(&solution.request).name()),
    ];
    about.retain(|(_, text)| !text.is_empty());
    document(&about, &drawing.points, &drawing.triangles, &points, &triangles)
}

/// Writes the fields of a solution as a VTU file.
pub fn document(
    about: &[About],
    points: &[[f64; 2]],
    triangles: &[[usize; 3]],
    at_points: &[Array],
    at_triangles: &[Array],
) -> Vec<u8> {
    let mut arrays = Arrays::default();
    let coordinates = Array::new("Points", "", 2, points.as_flattened().to_vec());
    // The last array is stored first: meshio 5 rewrites the offsets one by one as it reads, and takes the
    // first element with an offset for the one that it looks for, which must be one that it has not
    // rewritten.
    let cells = arrays.cells(triangles);
    let places = Element::new("Points").with(arrays.floats(&coordinates));
    let of_triangles = arrays.results("CellData", at_triangles, triangles.len());
    let of_points = arrays.results("PointData", at_points, points.len());
    let piece = Element::new("Piece")
        .set("NumberOfPoints", points.len().to_string())
        .set("NumberOfCells", triangles.len().to_string())
        .with(of_points)
        .with(of_triangles)
        .with(places)
        .with(cells);
    let mut grid = Element::new("UnstructuredGrid");
    if !about.is_empty() {
        // Every viewer reads texts as arrays of the bytes of UTF-8; not all read arrays of type `String`.
        let texts = about.iter().map(|(name, text)| {
            let bytes: Vec<String> = text.bytes().map(|byte| byte.to_string()).collect();
            Element::with_text("DataArray", &bytes.join(" "))
                .set("type", "UInt8")
                .set("Name", name)
                .set("NumberOfTuples", text.len().to_string())
                .set("format", "ascii")
        });
        grid.push(Element::new("FieldData").with_all(texts));
    }
    let text = Element::new("VTKFile")
        .set("type", "UnstructuredGrid")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64")
        .set("compressor", "vtkZLibDataCompressor")
        .with(grid.with(piece))
        .with(Element::with_text("AppendedData", "_").set("encoding", "raw"))
        .document();
    let (before, after) = text.rsplit_once('_').expect("the arrays follow it");
    let mut file = arrays.bytes;
    file.splice(0..0, before.bytes().chain(*b"_"));
    // Readers that look for the end of the arrays expect a line of its own.
    file.push(b'\n');
    file.extend_from_slice(after.as_bytes());
    file
}

/// The arrays, one after the other.
#[derive(Default)]
struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    fn results(&mut self, place: &'static str, data: &[Array], count: usize) -> Element {
        let mut element = Element::new(place);
        // What a viewer takes first.
        let first = |components: usize| data.iter().find(|array| array.components == components);
        let stress = data.iter().find(|array| array.name == "von_mises_stress");
        for (kind, array) in [("Scalars", stress), ("Vectors", first(2)), ("Tensors", first(9))] {
            if let Some(array) = array {
                element = element.set(kind, &array.name);
            }
        }
        let mut stored = Vec::new();
        for array in data.iter().rev() {
            let Array { name, components, values, .. } = array;
            let size = components * count;
            assert_eq!(values.len(), size, "{name}: {components} values for each of {count}");
            stored.push(self.floats(array));
        }
        element.with_all(stored.into_iter().rev())
    }

    fn cells(&mut self, triangles: &[[usize; 3]]) -> Element {
        let bytes = |number: usize| (number as i64).to_le_bytes();
        let corners: Vec<_> = triangles.as_flattened().iter().map(|n| bytes(*n)).collect();
        let offsets: Vec<_> = (1..=triangles.len()).map(|count| bytes(3 * count)).collect();
        let types = self.array("UInt8", "types", vec![TRIANGLE; triangles.len()]);
        let offsets = self.array("Int64", "offsets", offsets.into_flattened());
        let corners = self.array("Int64", "connectivity", corners.into_flattened());
        Element::new("Cells").with(corners).with(offsets).with(types)
    }

    /// Adds floats with all their bits. A vector in the plane gets a third component, 0: viewers
    /// warp by three.
    fn floats(&mut self, Array { name, unit, components, values }: &Array) -> Element {
        assert!(
            !values.iter().any(|value| value.is_infinite()),
            "{name}: a file for a viewer needs finite numbers"
        );
        let third: &[f64] = if *components == 2 { &[0.0] } else { &[] };
        let rows = values.chunks(*components).flat_map(|row| row.iter().chain(third));
        let bytes: Vec<_> = rows.map(|value| value.to_le_bytes()).collect();
        let mut element = self
            .array("Float64", name, bytes.into_flattened())
            .set("NumberOfComponents", (components + third.len()).to_string());
        if !unit.is_empty() {
            let key = Element::with_text("InformationKey", unit).set("name", "UNITS_LABEL");
            element.push(key.set("location", "vtkDataArray"));
        }
        element
    }

    /// Adds an array in compressed blocks: quickly, for most bits of a result are noise to a compressor.
    fn array(&mut self, kind: &str, name: &str, content: Vec<u8>) -> Element {
        let compressed = |block: &[u8]| {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(block).expect("memory takes any bytes");
            encoder.finish().expect("memory takes any bytes")
        };
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
