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
use base::xml::Element;
use engine::contact::Status;
use engine::{Assessment, Solution};
use problem::element::{self, State};
use problem::model::Triangle;
use studies::snapshot::{Options, VERSION};

/// VTK's number for a triangle of three nodes.
const TRIANGLE: u8 = 5;

/// The bytes of a block before it is compressed.
const BLOCK: usize = 1 << 18;

/// A result: the name that the viewer lists, its unit, the number of its components, and all
/// components of the first point or triangle, then of the second, and so on. Nine are a tensor.
type Data<'a> = (&'a str, &'a str, usize, &'a [f64]);

/// What the file says of itself: a name and a text each.
type About<'a> = (&'a str, &'a str);

/// Writes the mesh of `drawing`; of its points the displacements and, with contact, status, pressure
/// and gap; of its triangles stress and strain as tensors, their von Mises values, the body and, where
/// it was estimated, the error. Every number reads back to the same bits.
///
/// The status is -1 of a point that is none of the contact surface's, else 0 open, 1 in contact, 2
/// sliding; pressure and gap are 0 where there is none.
///
/// # Panics
///
/// If a result is not finite.
pub fn vtu(drawing: &Drawing, solution: &Solution, assessment: &Assessment) -> Vec<u8> {
    let (model, scene) = (&*solution.model, &solution.request.scene);
    let states = || solution.elements.iter().zip(&model.triangles);
    let tensor = |of: &dyn Fn(&State, &Triangle) -> [f64; 4]| {
        let nine = |[xx, yy, zz, xy]: [f64; 4]| [xx, xy, 0.0, xy, yy, 0.0, 0.0, 0.0, zz];
        states().flat_map(|(state, triangle)| nine(of(state, triangle))).collect::<Vec<_>>()
    };
    let one = |of: fn(&State) -> f64| solution.elements.iter().map(of).collect::<Vec<_>>();
    let stress = tensor(&|state, triangle| {
        let [x, y, xy]: [f64; 3] = state.sigma.into();
        [x, y, element::out_of_plane_stress(model.plane, triangle.material.nu, &state.sigma), xy]
    });
    let strain = tensor(&|state, triangle| {
        let [x, y, xy]: [f64; 3] = state.epsilon.into();
        let z = element::out_of_plane_strain(model.plane, triangle.material.nu, &state.epsilon);
        [x, y, z, xy / 2.0]
    });
    let body: Vec<f64> = drawing.region.iter().map(|region| *region as f64).collect();
    let mesh_error = assessment.estimates.as_ref().map(|estimates| estimates.mesh.error_map());
    let units = &scene.units;
    let triangles: [Data; 5] = [
        ("stress", &units.stress[..], 9, &stress),
        ("strain", "1", 9, &strain),
        ("von_mises_stress", &units.stress[..], 1, &one(|s| s.von_mises_stress)),
        ("von_mises_strain", "1", 1, &one(|s| s.von_mises_strain)),
        ("body", "", 1, &body),
    ];
    let mesh_error = mesh_error.as_deref().map(|error| ("mesh_error", &units.stress[..], 1, error));
    let triangles: Vec<Data> = triangles.into_iter().chain(mesh_error).collect();
    let [status, pressure, gap] = surface(solution);
    let mut points: Vec<Data> = vec![("displacement", &units.length[..], 2, solution.u.as_slice())];
    if model.has_contact() {
        points.push(("contact_status", "", 1, &status));
        points.push(("contact_pressure", &units.stress, 1, &pressure));
        points.push(("contact_gap", &units.length, 1, &gap));
    }
    let [scene_sha256, mesh_sha256] = scene.hashes().cloned().unwrap_or_default();
    let program = format!("plane-contact {VERSION}");
    let run = Options::of(&solution.request).name();
    let about: [About; 5] = [
        ("program", &program),
        ("scene", &scene.name),
        ("scene_sha256", &scene_sha256),
        ("mesh_sha256", &mesh_sha256),
        ("run", &run),
    ];
    let known: Vec<About> = about.into_iter().filter(|(_, text)| !text.is_empty()).collect();
    document(&known, &drawing.points, &drawing.triangles, &points, &triangles)
}

/// Returns status, pressure and gap of every node, as [`vtu`] says.
fn surface(solution: &Solution) -> [Vec<f64>; 3] {
    let nodes = solution.model.nodes.len();
    let [mut status, mut pressure, mut gap] = [-1.0, 0.0, 0.0].map(|value| vec![value; nodes]);
    for contact in &solution.contact {
        let k = contact.node.index();
        status[k] = match (contact.in_contact, contact.status) {
            (_, Some(Status::Slip(_))) => 2.0,
            (in_contact, _) => f64::from(in_contact),
        };
        (pressure[k], gap[k]) = (contact.pressure.unwrap_or(0.0), contact.gap);
    }
    [status, pressure, gap]
}

pub fn document(
    about: &[About],
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
        .with(Element::new("Points").with(arrays.floats(&("Points", "", 2, points.as_flattened()))))
        .with(arrays.cells(triangles));
    let text = Element::new("VTKFile")
        .set("type", "UnstructuredGrid")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64")
        .set("compressor", "vtkZLibDataCompressor")
        .with(Element::new("UnstructuredGrid").with_all(field_data(about)).with(piece))
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

/// Returns texts as every viewer reads them: arrays of the bytes of UTF-8. Not all read arrays of type
/// `String`.
fn field_data(about: &[About]) -> Option<Element> {
    let array = |(name, text): &About| {
        let bytes: Vec<String> = text.bytes().map(|byte| byte.to_string()).collect();
        Element::with_text("DataArray", &bytes.join(" "))
            .set("type", "UInt8")
            .set("Name", name)
            .set("NumberOfTuples", text.len().to_string())
            .set("format", "ascii")
    };
    (!about.is_empty()).then(|| Element::new("FieldData").with_all(about.iter().map(array)))
}

/// The arrays, one after the other.
#[derive(Default)]
struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    fn results(&mut self, place: &'static str, data: &[Data], count: usize) -> Element {
        for (name, _, components, values) in data {
            assert_eq!(
                values.len(),
                components * count,
                "{name}: {components} values for each of {count}"
            );
        }
        // The tensor that a viewer takes first.
        let tensor = data.iter().find(|(_, _, components, _)| *components == 9);
        let element = tensor
            .map_or(Element::new(place), |(name, ..)| Element::new(place).set("Tensors", name));
        element.with_all(data.iter().map(|data| self.floats(data)))
    }

    fn cells(&mut self, triangles: &[[usize; 3]]) -> Element {
        let bytes = |number: usize| (number as i64).to_le_bytes();
        let corners: Vec<_> = triangles.as_flattened().iter().map(|n| bytes(*n)).collect();
        let offsets: Vec<_> = (1..=triangles.len()).map(|count| bytes(3 * count)).collect();
        Element::new("Cells")
            .with(self.array("Int64", "connectivity", corners.into_flattened()))
            .with(self.array("Int64", "offsets", offsets.into_flattened()))
            .with(self.array("UInt8", "types", vec![TRIANGLE; triangles.len()]))
    }

    /// Adds floats with all their bits. A vector in the plane gets a third component, 0: viewers
    /// warp by three.
    fn floats(&mut self, (name, unit, components, values): &Data) -> Element {
        assert!(
            values.iter().all(|value| value.is_finite()),
            "{name}: a file for a viewer needs finite numbers"
        );
        let third: &[f64] = if *components == 2 { &[0.0] } else { &[] };
        let rows = values.chunks(*components).flat_map(|row| row.iter().chain(third));
        let bytes: Vec<_> = rows.map(|value| value.to_le_bytes()).collect();
        let key = |unit: &str| {
            Element::with_text("InformationKey", unit)
                .set("name", "UNITS_LABEL")
                .set("location", "vtkDataArray")
        };
        self.array("Float64", name, bytes.into_flattened())
            .set("NumberOfComponents", (components + third.len()).to_string())
            .with_all((!unit.is_empty()).then(|| key(unit)))
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
