//! What a file is, where another kind of file is wanted.

use std::fmt;

use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};

use super::read::utf8;

/// The documents of JSON, each with fields that no one before it has.
const DOCUMENTS: &[(&str, &[&str])] = &[
    ("a snapshot", &["input", "runs"]),
    ("a result of a job", &["key", "result"]),
    ("a result", &["arithmetic", "bodies"]),
    ("a sweep", &["format", "scene"]),
    ("a scene file", &["plane"]),
    ("a scene file", &["materials"]),
];

/// How files that are no JSON begin.
const STARTS: &[(&str, &[u8])] = &[
    ("a Gmsh geometry", b"SetFactory("),
    ("a Gmsh geometry", b"Point("),
    ("a packed file (gzip)", b"\x1F\x8B"),
    ("a packed file (zip)", b"PK\x03\x04"),
    ("a picture (PNG)", b"\x89PNG"),
    ("a deck of CalculiX or Abaqus", b"*"),
    ("a VTK file", b"# vtk"),
];

/// Returns what a file is, with its article, as far as its beginning or its fields tell.
pub fn kind_of(file: &[u8]) -> Option<&'static str> {
    let text = file.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(file).trim_ascii_start();
    let has = |word: &str| text.windows(word.len()).any(|window| window == word.as_bytes());
    match text.first()? {
        b'{' => {
            let fields = fields(text);
            let is =
                |(_, own): &&(_, &[&str])| own.iter().all(|own| fields.iter().any(|f| f == own));
            DOCUMENTS.iter().find(is).map(|(kind, _)| *kind)
        }
        b'<' if has("<worksheet") => Some("a Mathcad worksheet"),
        b'<' if has("<html") => Some("an HTML page"),
        b'<' => Some("an XML file"),
        b'$' if has("$MeshFormat") || has("$NOD") => Some("a Gmsh mesh"),
        b'/' if has("\nPoint(") => Some("a Gmsh geometry"),
        _ => STARTS.iter().find(|(_, start)| text.starts_with(start)).map(|(kind, _)| *kind),
    }
}

/// Returns whether a document is of JSON, be it malformed.
pub fn is_json(file: &[u8]) -> bool {
    matches!(file.trim_ascii_start(), [b'{' | b'[', ..])
}

/// Returns the names of the fields of the outermost object of `text`, as far as it can be read.
pub fn fields(text: &[u8]) -> Vec<String> {
    let mut names = Vec::new();
    if let Ok(text) = utf8(text) {
        // What is malformed behind a field does not matter here.
        let _ = serde_json::Deserializer::from_str(text).deserialize_map(Names(&mut names));
    }
    names
}

struct Names<'a>(&'a mut Vec<String>);

impl<'de> Visitor<'de> for Names<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(name) = map.next_key()? {
            self.0.push(name);
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}
