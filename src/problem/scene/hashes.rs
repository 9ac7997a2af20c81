//! What tells one input from another: the SHA-256 of a document as JSON without blanks.

use std::io::{BufWriter, Write};

use serde::{Serialize, Serializer};
use sha2::{Digest, Sha256};

use super::{Description, Element, Mesh, Node};

/// Returns the SHA-256 of a document as JSON without blanks, in hexadecimal.
pub fn sha256(document: &impl Serialize) -> String {
    let mut hashing = BufWriter::new(Hashing(Sha256::new()));
    serde_json::to_writer(&mut hashing, document).expect("a document has string keys");
    let Ok(Hashing(hash)) = hashing.into_inner() else { unreachable!("nothing is written") };
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Returns the hashes of a description and of a mesh as a snapshot has them: its rows of numbers.
pub(super) fn of_source(description: &Description, mesh: &Mesh) -> [String; 2] {
    let scene = serde_json::to_value(description).expect("a description is an object");
    let groups = mesh.names.iter().map(|n| (n.dim, n.tag, &n.name[..])).collect();
    let rows = Rows { groups, nodes: Nodes(&mesh.nodes), elements: Elements(&mesh.elements) };
    [sha256(&scene), sha256(&rows)]
}

/// A mesh as rows of numbers, none of which is copied.
#[derive(Serialize)]
struct Rows<'a> {
    groups: Vec<(usize, usize, &'a str)>,
    nodes: Nodes<'a>,
    elements: Elements<'a>,
}

struct Nodes<'a>(&'a [Node]);

impl Serialize for Nodes<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = |node: &Node| (node.number, node.xyz[0], node.xyz[1], node.xyz[2]);
        serializer.collect_seq(self.0.iter().map(row))
    }
}

struct Elements<'a>(&'a [Element]);

impl Serialize for Elements<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|e| {
            let (physical, nodes): (&[usize], &[usize]) = (&e.physical, &e.nodes);
            (e.number, e.kind, physical, e.geometric, nodes)
        }))
    }
}

/// A hash of what is written to it.
struct Hashing(Sha256);

impl Write for Hashing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
