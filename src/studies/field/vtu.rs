//! Displacements in a VTU file, as this program, meshio and ParaView write it.
//!
//! ```text
//!  <DataArray format="ascii">    numbers
//!             format="binary"    bytes in base64
//!             format="appended"  bytes at an offset behind <AppendedData encoding="raw|base64">_
//!  bytes      how many, then the numbers; with a compressor: blocks, bytes of a block, of the last one
//!             (0: it is full), of each compressed | blocks
//! ```

use std::borrow::Cow;
use std::io::Read;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node};

use super::{HOW, Kind, Row, Rows, is_number, plain};
use base::error::{InputError, Result};

/// The names of the array of displacements, as [`plain`] leaves them.
const NAMES: [&str; 5] = ["displacement", "displacements", "disp", "depl", "u"];

/// VTK's number of a linear triangle; those of curved elements, whose sides have nodes in between, are above 20.
const CURVED: f64 = 20.0;

/// What stands behind the XML of a file.
const APPENDED: &[u8] = b"<AppendedData";

/// Why a file is refused, in words.
type Why = String;

/// A file: its XML, and the bytes behind it.
struct File<'a> {
    root: Node<'a, 'a>,
    appended: &'a [u8],
}

/// Reads the points and the displacements of a file.
///
/// # Errors
/// It is no VTU file of one piece, is written in a way that is not read, or has no array of displacements.
pub fn read(bytes: &[u8], place: &str) -> Result<Rows> {
    let wrong = |what: Why| InputError::new(place, what, HOW);
    let start = bytes.windows(APPENDED.len()).position(|at| at == APPENDED);
    let appended = start.map_or(&[][..], |start| &bytes[start..]);
    let text = &bytes[..bytes.len() - appended.len()];
    let text =
        std::str::from_utf8(text).map_err(|_| wrong("the file is no XML in UTF-8".into()))?;
    let end = appended
        .iter()
        .position(|byte| *byte == b'>')
        .map_or("", |end| std::str::from_utf8(&appended[..=end]).unwrap_or_default());
    let closed = if end.is_empty() { "" } else { "</AppendedData></VTKFile>" };
    let text = format!("{}{end}{closed}", text.trim_start_matches('\u{feff}'));
    let xml = Document::parse(&text).map_err(|why| wrong(format!("the file is no XML: {why}")))?;
    let mark = appended.iter().position(|byte| *byte == b'_').map_or(0, |at| at + 1);
    let file = File { root: xml.root_element(), appended: &appended[mark..] };
    let (rows, name) = file.rows().map_err(wrong)?;
    let taken = format!("array {name:?}");
    Ok(Rows { place: place.into(), kind: Kind::Point, names: vec![name], taken, rows })
}

impl<'a> File<'a> {
    /// Returns a row for each point, and the name of the array that was taken for the displacements.
    fn rows(&self) -> Result<(Vec<Row>, String), Why> {
        let kind = self.root.attribute("type").unwrap_or_default();
        if kind != "UnstructuredGrid" {
            return Err(format!(
                "the file is a VTKFile of type {kind:?}, expected UnstructuredGrid"
            ));
        }
        if self.root.attribute("byte_order").is_some_and(|order| order != "LittleEndian") {
            return Err("its numbers are not in the byte order LittleEndian".into());
        }
        let pieces: Vec<Node> = named(self.root, "Piece").collect();
        let [piece] = pieces[..] else {
            return Err(format!("the file has {} pieces, expected one", pieces.len()));
        };
        let count = piece.attribute("NumberOfPoints").and_then(|count| count.parse().ok());
        let count: usize = count.ok_or("its piece has no NumberOfPoints")?;
        let points = named(piece, "Points").flat_map(|points| named(points, "DataArray")).next();
        let points = self.vectors(points.ok_or("the file has no Points")?, count)?;
        self.check_cells(piece)?;
        let arrays: Vec<Node> =
            named(piece, "PointData").flat_map(|data| named(data, "DataArray")).collect();
        let vectors: Vec<Node> = arrays
            .iter()
            .copied()
            .filter(|array| matches!(array.attribute("NumberOfComponents"), Some("2" | "3")))
            .collect();
        let called = |array: &Node<'a, 'a>| array.attribute("Name").unwrap_or_default();
        let is_named = |array: &&Node<'a, 'a>| NAMES.contains(&&*plain(called(array)));
        let found: Vec<Node> = vectors.iter().filter(is_named).copied().collect();
        let [array] = found[..] else {
            let names = match &vectors.iter().map(&called).collect::<Vec<_>>()[..] {
                [] => "none".into(),
                names => names.join(", "),
            };
            return Err(format!(
                "of its arrays of vectors at points ({names}), {} are displacements by their names; one is \
                 expected, named displacement or u",
                found.len()
            ));
        };
        let u = self.vectors(array, count)?;
        let ids = arrays.iter().find(|array| is_number(called(array)));
        let ids = ids.map(|ids| self.numbers(*ids)).transpose()?.unwrap_or_default();
        let number = |point: usize| {
            let id = ids.get(point).copied().filter(|id| id.fract() == 0.0 && *id >= 0.0);
            id.map(|id| id as usize)
        };
        let row = |(line, ([x, y, _], u)): (usize, ([f64; 3], [f64; 3]))| {
            let at = Some([x, y]);
            Row { line, number: number(line), at, u }
        };
        let rows = (0..).zip(points.into_iter().zip(u)).map(row).collect();
        Ok((rows, called(&array).into()))
    }

    /// Checks that no cell has nodes on its sides, as the scene's triangles have none.
    fn check_cells(&self, piece: Node) -> Result<(), Why> {
        let types = named(piece, "Cells").flat_map(|cells| named(cells, "DataArray"));
        let types = types.filter(|array| array.attribute("Name") == Some("types"));
        let kinds = types.map(|array| self.numbers(array)).collect::<Result<Vec<_>, _>>()?.concat();
        kinds.iter().find(|kind| **kind > CURVED).map_or(Ok(()), |kind| {
            Err(format!(
                "its cells of VTK's type {kind} have nodes on their sides, the scene's linear triangles have none: \
                 give the displacements of the corners alone"
            ))
        })
    }

    /// Returns `count` vectors of two or three components; of two the third is 0.
    fn vectors(&self, array: Node, count: usize) -> Result<Vec<[f64; 3]>, Why> {
        let name = array.attribute("Name").unwrap_or("Points").to_string();
        let components = match array.attribute("NumberOfComponents") {
            Some("2") => 2,
            _ => 3,
        };
        let numbers = self.numbers(array).map_err(|why| format!("array {name:?}: {why}"))?;
        if Some(numbers.len()) != count.checked_mul(components) {
            let found = numbers.len();
            return Err(format!(
                "array {name:?} has {found} numbers, expected {components} for each of {count} points"
            ));
        }
        let vector = |v: &[f64]| [v[0], v[1], v.get(2).copied().unwrap_or(0.0)];
        Ok(numbers.chunks_exact(components).map(vector).collect())
    }

    fn numbers(&self, array: Node) -> Result<Vec<f64>, Why> {
        let text = array.text().unwrap_or_default();
        let bytes = match array.attribute("format") {
            None | Some("ascii") => {
                let number =
                    |word: &str| word.parse().map_err(|_| format!("{word:?} is no number"));
                return text.split_whitespace().map(number).collect();
            }
            Some("binary") => Cow::from(decoded(text.bytes())?),
            Some("appended") => {
                let offset =
                    array.attribute("offset").and_then(|offset| offset.parse::<usize>().ok());
                let behind = offset.and_then(|offset| self.appended.get(offset..));
                let behind = behind.ok_or("its offset leads out of the file")?;
                match named(self.root, "AppendedData")
                    .next()
                    .and_then(|data| data.attribute("encoding"))
                {
                    Some("raw") => Cow::from(behind),
                    Some("base64") => {
                        Cow::from(decoded(behind.iter().copied().take_while(|byte| *byte != b'<'))?)
                    }
                    other => return Err(format!("appended data have the encoding {other:?}")),
                }
            }
            Some(other) => return Err(format!("the format {other:?} is not read")),
        };
        let bytes = self.unpacked(&bytes)?;
        match array.attribute("type") {
            Some("Float64") => Ok(values(&bytes, f64::from_le_bytes)),
            Some("Float32") => Ok(values(&bytes, |bytes| f32::from_le_bytes(bytes).into())),
            // Numbers of nodes and kinds of cells, which are far below 2^53.
            Some("Int64") => Ok(values(&bytes, |bytes| i64::from_le_bytes(bytes) as f64)),
            Some("UInt64") => Ok(values(&bytes, |bytes| u64::from_le_bytes(bytes) as f64)),
            Some("Int32") => Ok(values(&bytes, |bytes| i32::from_le_bytes(bytes).into())),
            Some("UInt32") => Ok(values(&bytes, |bytes| u32::from_le_bytes(bytes).into())),
            Some("Int8") => Ok(values(&bytes, |bytes| i8::from_le_bytes(bytes).into())),
            Some("UInt8") => Ok(values(&bytes, |bytes| u8::from_le_bytes(bytes).into())),
            other => {
                let other = other.unwrap_or("unknown");
                Err(format!("its numbers are of type {other}, which is not read"))
            }
        }
    }

    /// Returns the bytes of an array without what stands before them.
    fn unpacked(&self, bytes: &[u8]) -> Result<Vec<u8>, Why> {
        let cut = || String::from("the file ends within it");
        let size = match self.root.attribute("header_type") {
            None | Some("UInt32") => 4,
            Some("UInt64") => 8,
            Some(other) => return Err(format!("the header_type {other:?} is not read")),
        };
        let header = |k: usize| {
            let bytes = bytes.get(k * size..(k + 1) * size).ok_or_else(cut)?;
            Ok::<usize, Why>(bytes.iter().rev().fold(0, |n, byte| n << 8 | usize::from(*byte)))
        };
        let rest = |from: usize, length: usize| {
            from.checked_add(length).and_then(|to| bytes.get(from..to)).ok_or_else(cut)
        };
        match self.root.attribute("compressor") {
            None => Ok(rest(size, header(0)?)?.to_vec()),
            Some("vtkZLibDataCompressor") => {
                let (blocks, whole, last) = (header(0)?, header(1)?, header(2)?);
                let mut from =
                    blocks.checked_add(3).and_then(|n| n.checked_mul(size)).ok_or_else(cut)?;
                let mut unpacked = Vec::new();
                for k in 0..blocks {
                    let length = header(3 + k)?;
                    let expected = if k + 1 == blocks && last > 0 { last } else { whole };
                    let before = unpacked.len();
                    ZlibDecoder::new(rest(from, length)?)
                        .take(expected as u64)
                        .read_to_end(&mut unpacked)
                        .map_err(|why| format!("its block {k} cannot be unpacked: {why}"))?;
                    if unpacked.len() - before != expected {
                        return Err(format!("its block {k} has other than {expected} bytes"));
                    }
                    from += length;
                }
                Ok(unpacked)
            }
            Some(other) => Err(format!("the compressor {other} is not read")),
        }
    }
}

/// Returns the elements of a name below another one.
fn named<'a>(within: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    within.descendants().filter(move |node| node.has_tag_name(name))
}

/// Decodes base64 in which a new text may begin behind each padding, as a header of its own is followed by data.
fn decoded(text: impl Iterator<Item = u8>) -> Result<Vec<u8>, Why> {
    let text: Vec<u8> = text.filter(|byte| !byte.is_ascii_whitespace()).collect();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for quad in text.chunks(4) {
        let added = BASE64_STANDARD.decode_vec(quad, &mut bytes);
        added.map_err(|why| format!("it is no base64: {why}"))?;
    }
    Ok(bytes)
}

fn values<const N: usize>(bytes: &[u8], value: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    bytes.as_chunks::<N>().0.iter().map(|bytes| value(*bytes)).collect()
}
