//! What tells one input from another: the SHA-256 of a document as JSON without blanks.

use std::io::{self, BufWriter, Read, Write};

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::{Description, Mesh};

/// Returns the SHA-256 of a document as JSON without blanks, in hexadecimal.
pub fn sha256(document: &impl Serialize) -> String {
    let mut hashing = BufWriter::new(Hashing(Sha256::new()));
    serde_json::to_writer(&mut hashing, document).expect("a document has string keys");
    let Ok(hashing) = hashing.into_inner() else { unreachable!("nothing is written") };
    hashing.in_hexadecimal()
}

/// Returns the SHA-256 of what is read, in hexadecimal.
///
/// # Errors
/// It cannot be read to its end.
pub fn sha256_of(mut content: impl Read) -> io::Result<String> {
    let mut hashing = Hashing(Sha256::new());
    io::copy(&mut content, &mut hashing)?;
    Ok(hashing.in_hexadecimal())
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

impl Hashing {
    fn in_hexadecimal(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl Write for Hashing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
