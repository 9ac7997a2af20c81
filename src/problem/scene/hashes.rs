//! What tells one input from another: the SHA-256 of a document as JSON without blanks.

use std::io::{BufWriter, Write};

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::{Description, Mesh};

/// Returns the SHA-256 of a document as JSON without blanks, in hexadecimal.
pub fn sha256(document: &impl Serialize) -> String {
    let mut hashing = BufWriter::new(Hashing(Sha256::new()));
    serde_json::to_writer(&mut hashing, document).expect("a document has string keys");
    let Ok(Hashing(hash)) = hashing.into_inner() else { unreachable!("nothing is written") };
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Returns the hashes of a description and of a mesh: those of their content, whatever the order of
/// the keys in the files.
pub fn source_hashes(description: &Description, mesh: &Mesh) -> [String; 2] {
    let mut description = description.clone();
    description.materials.0.sort_by_cached_key(|(group, _)| group.text());
    let scene = serde_json::to_value(description).expect("a description is an object");
    [sha256(&scene), sha256(mesh)]
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
