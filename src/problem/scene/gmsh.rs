//! Reads a mesh from a file of Gmsh: MSH 2.2 and 4.1, text or binary, of either byte order.
//!
//! ```text
//! $MeshFormat        version, text or binary, bytes of a number
//! $PhysicalNames     dimension, tag, "name"                          always text
//! $Entities          4.1: point, curve, ... with its physical tags
//! $Nodes             number, x, y, z
//! $Elements          number, kind, tags, node numbers
//! $...               any other section is skipped
//! ```
//!
//! A grammar is written once for text and binary: both are read as the same run of numbers, by `Tokens`. Nothing is
//! ever reserved for a count that the file declares: a wrong count runs into the file's end, not out of memory.
//!
//! Reference: Gmsh's manual, "MSH file format" and "MSH file format version 2 (Legacy)".

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::mesh::{Element, Mesh, Node, PhysicalName};

/// Why a file cannot be read, and where.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}: {fault}")]
pub struct GmshError {
    /// Where the fault was met.
    pub place: Place,
    /// What it is.
    pub fault: Fault,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of a text file, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// What may be wrong with a file.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Fault {
    /// Something else stands where the format asks for `expected`.
    #[error("found {found}, expected {expected}")]
    Unexpected { found: String, expected: String },
    /// A version of the format that is not read.
    #[error(
        "the file has MSH version {found}; versions 2.2 and 4.1 can be read: in Gmsh set Mesh.MshFileVersion = 4.1 \
         and save the mesh again"
    )]
    Version { found: String },
    /// Numbers of another width than eight bytes.
    #[error("the file has numbers of {found} bytes, expected 8: save the mesh with a 64-bit Gmsh")]
    DataSize { found: i32 },
    /// The file ends without a section it must have.
    #[error("the file has no section ${section}")]
    MissingSection { section: &'static str },
    /// A section comes a second time.
    #[error("a second section ${section}, expected one")]
    RepeatedSection { section: String },
    /// A number or tag that must be unique comes a second time.
    #[error("{what} comes a second time")]
    Repeated { what: String },
    /// A total that the file declares is not what its blocks add up to.
    #[error("{declared} {what} are declared but {found} are given")]
    Count { what: &'static str, declared: usize, found: usize },
    /// A coordinate is infinite or not a number.
    #[error("node {node} has the coordinate {value}, expected a finite number")]
    Coordinate { node: usize, value: f64 },
    /// An element of a kind that is not read.
    #[error(
        "element {element} is {kind}; only points, two-node edges and three-node triangles can be read: in Gmsh set \
         Mesh.RecombineAll = 0 and Mesh.ElementOrder = 1, and mesh in two dimensions"
    )]
    Kind { element: usize, kind: String },
    /// An element stands among those of a geometric entity of another dimension.
    #[error(
        "element {element} has dimension {found}, but it is listed in an entity of dimension {expected}"
    )]
    Dimension { element: usize, found: usize, expected: usize },
    /// An element names a node that the file does not have.
    #[error("element {element} has the node {node}, which is not in $Nodes")]
    NoNode { element: usize, node: usize },
    /// An element is part of a geometric entity that the file does not have.
    #[error(
        "the elements are part of the {kind} {tag}, which is not in $Entities; if the mesh is partitioned, save it \
         unpartitioned"
    )]
    NoEntity { kind: &'static str, tag: i32 },
}

/// Shorthand of this module.
type Result<T, E = GmshError> = std::result::Result<T, E>;

/// Reads a mesh from the bytes of a `.msh` file.
///
/// Returns the nodes, elements and physical names, ascending; tags that are negative in the file (a reversed
/// orientation) are returned positive.
///
/// # Errors
///
/// The first fault met, with its line (text) or byte (binary).
pub fn read(bytes: &[u8]) -> Result<Mesh, GmshError> {
    let mut tokens = Tokens { bytes, at: 0, last: 0, encoding: Encoding::Text };
    tokens.keyword("$MeshFormat", "$MeshFormat, the first line of a Gmsh mesh (MSH 2.2 or 4.1)")?;
    let version = format(&mut tokens)?;
    tokens.keyword("$EndMeshFormat", "$EndMeshFormat")?;
    let mut reader = Reader { tokens, version, ..Reader::default() };
    while let Some(section) = reader.tokens.section()? {
        reader.section(&section)?;
        let end = format!("$End{section}");
        reader.tokens.keyword(&end, &end)?;
    }
    reader.finish()
}

/// Reads the body of `$MeshFormat`; from here on `tokens` knows text from binary.
fn format(tokens: &mut Tokens) -> Result<Version> {
    let found: String = tokens.parse("a version of the format")?;
    let version = match found.as_str() {
        "2.2" => Version::V2,
        "4.1" => Version::V4,
        _ => return Err(tokens.error(Fault::Version { found })),
    };
    let binary: i32 = tokens.parse("0 (text) or 1 (binary)")?;
    if !(0..=1).contains(&binary) {
        return Err(tokens.unexpected(binary, "0 (text) or 1 (binary)"));
    }
    let found = tokens.parse("8, the bytes of a number")?;
    if found != 8 {
        return Err(tokens.error(Fault::DataSize { found }));
    }
    if binary == 1 {
        tokens.line_end()?;
        tokens.encoding = tokens.byte_order()?;
    }
    Ok(version)
}

/// The versions of the format that can be read.
#[derive(Clone, Copy, Default, PartialEq)]
enum Version {
    #[default]
    V2,
    V4,
}

/// What has been read of a file so far.
#[derive(Default)]
struct Reader<'a> {
    tokens: Tokens<'a>,
    version: Version,
    /// The sections met, without those that are skipped.
    sections: BTreeSet<String>,
    /// Names by dimension and tag.
    names: BTreeMap<(usize, usize), String>,
    /// Physical tags by dimension and tag of the geometric entity.
    entities: BTreeMap<(usize, i32), Vec<usize>>,
    nodes: BTreeMap<usize, Node>,
    elements: BTreeMap<usize, Element>,
}

impl Reader<'_> {
    /// Reads the body of a section.
    fn section(&mut self, name: &str) -> Result<()> {
        match (name, self.version) {
            ("PhysicalNames", _) => self.once(name, Self::physical_names),
            ("Entities", Version::V4) => self.once(name, Self::entities),
            ("Nodes", Version::V2) => self.once(name, Self::nodes_2),
            ("Nodes", Version::V4) => self.once(name, Self::nodes_4),
            ("Elements", Version::V2) => self.once(name, Self::elements_2),
            ("Elements", Version::V4) => self.once(name, Self::elements_4),
            _ => self.tokens.skip_to(&format!("$End{name}")),
        }
    }

    /// Reads by `body` a section that may come once only; `$Elements` after what the elements refer to.
    fn once(&mut self, name: &str, body: fn(&mut Self) -> Result<()>) -> Result<()> {
        if name == "Elements" && !self.sections.contains("Nodes") {
            return Err(self.tokens.unexpected(
                "$Elements",
                "$Nodes before it (in Gmsh set Mesh.SaveParametric = 0)",
            ));
        }
        if name == "Entities" && self.sections.contains("Elements") {
            return Err(self.tokens.unexpected("$Entities after $Elements", "$Entities first"));
        }
        if !self.sections.insert(name.to_owned()) {
            return Err(self.tokens.error(Fault::RepeatedSection { section: name.to_owned() }));
        }
        body(self)
    }

    /// The mesh, when the file has ended.
    fn finish(self) -> Result<Mesh> {
        for section in ["Nodes", "Elements"] {
            if !self.sections.contains(section) {
                return Err(self.tokens.error(Fault::MissingSection { section }));
            }
        }
        Ok(Mesh {
            nodes: self.nodes.into_values().collect(),
            elements: self.elements.into_values().collect(),
            names: self
                .names
                .into_iter()
                .map(|((dim, tag), name)| PhysicalName { dim, tag, name })
                .collect(),
        })
    }

    /// `$PhysicalNames`: a count, then `dimension tag "name"` on a line each; text in binary files too.
    fn physical_names(&mut self) -> Result<()> {
        let count: usize = self.tokens.parse("the number of physical names")?;
        for _ in 0..count {
            let dim: usize = self.tokens.parse("a dimension from 0 to 3")?;
            if dim > 3 {
                return Err(self.tokens.unexpected(dim, "a dimension from 0 to 3"));
            }
            let tag: i32 = self.tokens.parse("a physical tag")?;
            let name = self.tokens.quoted("a name in quotation marks")?;
            if self.names.insert((dim, magnitude(tag)), name).is_some() {
                let what = format!("the name of the physical {} {tag}", ENTITIES[dim]);
                return Err(self.tokens.error(Fault::Repeated { what }));
            }
        }
        Ok(())
    }

    /// `$Entities` of 4.1: counts of points, curves, surfaces and volumes, then each of them.
    fn entities(&mut self) -> Result<()> {
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = self.tokens.size("a number of entities")?;
        }
        for (dim, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                self.entity(dim)?;
            }
        }
        Ok(())
    }

    /// One entity: tag, place or box, physical tags, and (but for a point) the tags of what bounds it.
    fn entity(&mut self, dim: usize) -> Result<()> {
        let tag = self.tokens.int("an entity's tag")?;
        if self.entities.contains_key(&(dim, tag)) {
            return Err(self
                .tokens
                .error(Fault::Repeated { what: format!("{} {tag}", ENTITIES[dim]) }));
        }
        for _ in 0..if dim == 0 { 3 } else { 6 } {
            self.tokens.double("a coordinate of the entity's box")?;
        }
        let physical = self.physical_tags()?;
        self.entities.insert((dim, tag), physical);
        if dim > 0 {
            for _ in 0..self.tokens.size("the number of bounding entities")? {
                self.tokens.int("the tag of a bounding entity")?;
            }
        }
        Ok(())
    }

    /// An entity's physical tags. Each of its elements gets a copy: hence a limit, or a hostile file of some kilobytes
    /// would take gigabytes.
    fn physical_tags(&mut self) -> Result<Vec<usize>> {
        const MOST: usize = 32;
        let count = self.tokens.size("the number of physical tags")?;
        if count > MOST {
            return Err(self
                .tokens
                .unexpected(count, format!("at most {MOST} physical groups of an entity")));
        }
        let tags: Result<BTreeSet<usize>> =
            (0..count).map(|_| self.tokens.int("a physical tag").map(magnitude)).collect();
        Ok(tags?.into_iter().collect())
    }

    /// `$Nodes` of 2.2: a count, then `number x y z`.
    fn nodes_2(&mut self) -> Result<()> {
        for _ in 0..self.tokens.count_line("the number of nodes")? {
            let number = self.tokens.int_from(1, "a node's number, 1 or more")?;
            self.node(number)?;
        }
        Ok(())
    }

    /// `$Nodes` of 4.1: counts of blocks and nodes, least and greatest number, then the blocks.
    fn nodes_4(&mut self) -> Result<()> {
        let blocks = self.tokens.size("the number of node blocks")?;
        let declared = self.tokens.size("the number of nodes")?;
        self.tokens.size("the least node number")?;
        self.tokens.size("the greatest node number")?;
        for _ in 0..blocks {
            self.node_block_4()?;
        }
        self.check_count("nodes", declared, self.nodes.len())
    }

    /// A block: `dimension tag parametric count`, the nodes' numbers, then their coordinates, which on a parametric
    /// entity are followed by as many parameters as it has dimensions.
    fn node_block_4(&mut self) -> Result<()> {
        let (dim, _) = self.entity_of_block()?;
        let parametric = self.tokens.int("0 or 1 (parametric)")?;
        let parameters = match parametric {
            0 => 0,
            1 => dim,
            _ => return Err(self.tokens.unexpected(parametric, "0 or 1 (parametric)")),
        };
        let count = self.tokens.size("the number of nodes of a block")?;
        let numbers: Result<Vec<usize>> =
            (0..count).map(|_| self.tokens.size_from(1, "a node's number, 1 or more")).collect();
        for number in numbers? {
            self.node(number)?;
            for _ in 0..parameters {
                self.tokens.double("a node's parameter on its entity")?;
            }
        }
        Ok(())
    }

    /// The coordinates of the node `number`, which is kept.
    fn node(&mut self, number: usize) -> Result<()> {
        if self.nodes.contains_key(&number) {
            return Err(self.tokens.error(Fault::Repeated { what: format!("node {number}") }));
        }
        let mut xyz = [0.0; 3];
        for x in &mut xyz {
            *x = self.tokens.double("a node's coordinate")?;
            if !x.is_finite() {
                return Err(self.tokens.error(Fault::Coordinate { node: number, value: *x }));
            }
        }
        self.nodes.insert(number, Node { number, xyz });
        Ok(())
    }

    /// `$Elements` of 2.2: a count, then in text `number kind tags nodes` each, and in binary blocks.
    fn elements_2(&mut self) -> Result<()> {
        let declared = self.tokens.count_line("the number of elements")?;
        if self.tokens.encoding == Encoding::Text {
            for _ in 0..declared {
                let number = self.tokens.int_from(1, "an element's number, 1 or more")?;
                let kind = self.tokens.int("an element's type")?;
                let tags = self.tokens.int_from(0, "an element's number of tags")?;
                self.element_2(number, kind, tags)?;
            }
        } else {
            while self.elements.len() < declared {
                self.element_block_2()?;
            }
        }
        self.check_count("elements", declared, self.elements.len())
    }

    /// A binary block: kind, number of elements, number of tags; then `number tags nodes` of each element.
    fn element_block_2(&mut self) -> Result<()> {
        let kind = self.tokens.int("an element's type")?;
        let count = self.tokens.int_from(1, "the number of elements of a block, 1 or more")?;
        let tags = self.tokens.int_from(0, "an element's number of tags")?;
        for _ in 0..count {
            let number = self.tokens.int_from(1, "an element's number, 1 or more")?;
            self.element_2(number, kind, tags)?;
        }
        Ok(())
    }

    /// The tags and nodes of an element of 2.2; the first tag is physical (0: none), the second geometric.
    fn element_2(&mut self, number: usize, kind: i32, tags: usize) -> Result<()> {
        let kind = self.kind(number, kind)?;
        let tags: Result<Vec<usize>> =
            (0..tags).map(|_| self.tokens.int("an element's tag").map(magnitude)).collect();
        let tags = tags?;
        let nodes: Result<Vec<usize>> = (0..kind.nodes)
            .map(|_| self.tokens.int_from(1, "a node's number, 1 or more"))
            .collect();
        self.keep(Element {
            number,
            kind: kind.number,
            physical: tags.iter().copied().take(1).filter(|&tag| tag != 0).collect(),
            geometric: tags.get(1).copied().unwrap_or(0),
            nodes: nodes?,
        })
    }

    /// `$Elements` of 4.1: counts of blocks and elements, least and greatest number, then the blocks.
    fn elements_4(&mut self) -> Result<()> {
        let blocks = self.tokens.size("the number of element blocks")?;
        let declared = self.tokens.size("the number of elements")?;
        self.tokens.size("the least element number")?;
        self.tokens.size("the greatest element number")?;
        for _ in 0..blocks {
            self.element_block_4()?;
        }
        self.check_count("elements", declared, self.elements.len())
    }

    /// A block: `dimension tag kind count`, then `number nodes` of each element.
    fn element_block_4(&mut self) -> Result<()> {
        let (dim, tag) = self.entity_of_block()?;
        let physical = self.physical_of(dim, tag)?;
        let kind = self.tokens.int("an element's type")?;
        for _ in 0..self.tokens.size("the number of elements of a block")? {
            let number = self.tokens.size_from(1, "an element's number, 1 or more")?;
            let kind = self.kind(number, kind)?;
            if kind.dim != dim {
                return Err(self.tokens.error(Fault::Dimension {
                    element: number,
                    found: kind.dim,
                    expected: dim,
                }));
            }
            let nodes: Result<Vec<usize>> = (0..kind.nodes)
                .map(|_| self.tokens.size_from(1, "a node's number, 1 or more"))
                .collect();
            let (physical, geometric) = (physical.clone(), magnitude(tag));
            self.keep(Element { number, kind: kind.number, physical, geometric, nodes: nodes? })?;
        }
        Ok(())
    }

    /// Dimension and tag of the entity that a block of 4.1 belongs to.
    fn entity_of_block(&mut self) -> Result<(usize, i32)> {
        let expected = "an entity's dimension, 0 to 3";
        let dim = self.tokens.int_from(0, expected)?;
        if dim > 3 {
            return Err(self.tokens.unexpected(dim, expected));
        }
        Ok((dim, self.tokens.int("an entity's tag")?))
    }

    /// The physical tags of an entity; none if the file has no `$Entities` at all.
    fn physical_of(&self, dim: usize, tag: i32) -> Result<Vec<usize>> {
        match self.entities.get(&(dim, tag)) {
            Some(tags) => Ok(tags.clone()),
            None if !self.sections.contains("Entities") => Ok(Vec::new()),
            None => Err(self.tokens.error(Fault::NoEntity { kind: ENTITIES[dim], tag })),
        }
    }

    /// The kind of an element, if it is one that is read.
    fn kind(&self, element: usize, number: i32) -> Result<&'static Kind> {
        KINDS.iter().find(|kind| i32::try_from(kind.number) == Ok(number)).ok_or_else(|| {
            let kind = usize::try_from(number)
                .ok()
                .and_then(|n| OTHER_KINDS.get(n).copied())
                .unwrap_or_default();
            let kind =
                if kind.is_empty() { format!("of Gmsh's type {number}") } else { kind.to_owned() };
            self.tokens.error(Fault::Kind { element, kind })
        })
    }

    /// Keeps an element, unless it has a node that the file does not have, or its number is taken.
    fn keep(&mut self, element: Element) -> Result<()> {
        let number = element.number;
        if let Some(&node) = element.nodes.iter().find(|node| !self.nodes.contains_key(node)) {
            return Err(self.tokens.error(Fault::NoNode { element: number, node }));
        }
        if self.elements.insert(number, element).is_some() {
            return Err(self.tokens.error(Fault::Repeated { what: format!("element {number}") }));
        }
        Ok(())
    }

    /// Holds a declared total against what was read.
    fn check_count(&self, what: &'static str, declared: usize, found: usize) -> Result<()> {
        if declared != found {
            return Err(self.tokens.error(Fault::Count { what, declared, found }));
        }
        Ok(())
    }
}

/// The sort of geometric entity of each dimension.
const ENTITIES: [&str; 4] = ["point", "curve", "surface", "volume"];

/// A kind of element that is read.
struct Kind {
    /// Gmsh's element type.
    number: usize,
    dim: usize,
    nodes: usize,
}

/// The kinds that are read.
const KINDS: [Kind; 3] = [
    Kind { number: 15, dim: 0, nodes: 1 },
    Kind { number: 1, dim: 1, nodes: 2 },
    Kind { number: 2, dim: 2, nodes: 3 },
];

/// Names of the other kinds by Gmsh's element type; empty where there is none or the kind is read.
#[rustfmt::skip]
const OTHER_KINDS: [&str; 32] = [
    "", "", "", "a four-node quadrangle", "a four-node tetrahedron", "an eight-node hexahedron",
    "a six-node prism", "a five-node pyramid", "a three-node edge", "a six-node triangle",
    "a nine-node quadrangle", "a ten-node tetrahedron", "a 27-node hexahedron",
    "an 18-node prism", "a 14-node pyramid", "", "an eight-node quadrangle",
    "a 20-node hexahedron", "a 15-node prism", "a 13-node pyramid", "a nine-node triangle",
    "a ten-node triangle", "a twelve-node triangle", "a 15-node triangle of fourth order",
    "a 15-node triangle of fifth order", "a 21-node triangle", "a four-node edge",
    "a five-node edge", "a six-node edge", "a 20-node tetrahedron", "a 35-node tetrahedron",
    "a 56-node tetrahedron",
];

/// A tag without its sign, which in Gmsh tells orientation.
fn magnitude(tag: i32) -> usize {
    tag.unsigned_abs() as usize
}

/// How a file writes its numbers.
#[derive(Clone, Copy, Default, PartialEq)]
enum Encoding {
    #[default]
    Text,
    LittleEndian,
    BigEndian,
}

/// The run of numbers and words that a file is, whatever its encoding.
#[derive(Default)]
struct Tokens<'a> {
    bytes: &'a [u8],
    /// Where the next token is looked for.
    at: usize,
    /// Where the last token began: the place that errors report.
    last: usize,
    encoding: Encoding,
}

impl<'a> Tokens<'a> {
    /// The next whole number: in binary files of four bytes.
    fn int(&mut self, expected: &str) -> Result<i32> {
        self.number(expected, i32::from_le_bytes, i32::from_be_bytes)
    }

    /// The next [`Self::int`], which must be at least `least`.
    fn int_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.int(expected)?;
        let number = usize::try_from(found).ok().filter(|&number| number >= least);
        number.ok_or_else(|| self.unexpected(found, expected))
    }

    /// The next count or number of 4.1: in binary files of eight bytes.
    fn size(&mut self, expected: &str) -> Result<usize> {
        let found = self.number(expected, u64::from_le_bytes, u64::from_be_bytes)?;
        usize::try_from(found).map_err(|_| self.unexpected(found, expected))
    }

    /// The next [`Self::size`], which must be at least `least`.
    fn size_from(&mut self, least: usize, expected: &str) -> Result<usize> {
        let found = self.size(expected)?;
        if found < least { Err(self.unexpected(found, expected)) } else { Ok(found) }
    }

    /// The next real number: in binary files of eight bytes.
    fn double(&mut self, expected: &str) -> Result<f64> {
        self.number(expected, f64::from_le_bytes, f64::from_be_bytes)
    }

    /// The next number, of `N` bytes in binary files.
    fn number<T: FromStr, const N: usize>(
        &mut self,
        expected: &str,
        little: fn([u8; N]) -> T,
        big: fn([u8; N]) -> T,
    ) -> Result<T> {
        match self.encoding {
            Encoding::Text => self.parse(expected),
            Encoding::LittleEndian => self.raw(expected).map(little),
            Encoding::BigEndian => self.raw(expected).map(big),
        }
    }

    /// The next `N` bytes.
    fn raw<const N: usize>(&mut self, expected: &str) -> Result<[u8; N]> {
        self.last = self.at;
        let Some(raw) = self.bytes[self.at..].first_chunk() else {
            return Err(self.unexpected("the end of the file", expected));
        };
        self.at += N;
        Ok(*raw)
    }

    /// The next word, as a `T`.
    fn parse<T: FromStr>(&mut self, expected: &str) -> Result<T> {
        let word = self.word();
        let parsed = std::str::from_utf8(word)
            .ok()
            .filter(|word| !word.is_empty())
            .and_then(|word| word.parse().ok());
        parsed.ok_or_else(|| self.unexpected(shown(word), expected))
    }

    /// The next word: what stands between white space; empty at the file's end.
    fn word(&mut self) -> &'a [u8] {
        self.at += run(&self.bytes[self.at..], |byte| byte.is_ascii_whitespace());
        self.last = self.at;
        let rest = &self.bytes[self.at..];
        let word = &rest[..run(rest, |byte| !byte.is_ascii_whitespace())];
        self.at += word.len();
        word
    }

    /// A count with a line to itself, which is text in binary files too (2.2).
    fn count_line(&mut self, expected: &str) -> Result<usize> {
        let count = self.parse(expected)?;
        self.line_end()?;
        Ok(count)
    }

    /// What stands from the line's first to its last quotation mark.
    fn quoted(&mut self, expected: &str) -> Result<String> {
        let line = self.line();
        let name = std::str::from_utf8(line)
            .ok()
            .and_then(|line| line.trim().strip_prefix('"')?.strip_suffix('"'));
        name.map(str::to_owned).ok_or_else(|| {
            let line = String::from_utf8_lossy(line);
            self.unexpected(format!("{:?}", line.trim()), expected)
        })
    }

    /// The end of the line, with no more than blanks before it; the file's end will do.
    fn line_end(&mut self) -> Result<()> {
        let line = self.line().trim_ascii();
        if line.is_empty() {
            Ok(())
        } else {
            Err(self.unexpected(shown(line), "the end of the line"))
        }
    }

    /// The rest of the line.
    fn line(&mut self) -> &'a [u8] {
        self.last = self.at;
        let rest = &self.bytes[self.at..];
        let length = run(rest, |&byte| byte != b'\n');
        self.at += rest.len().min(length + 1);
        &rest[..length]
    }

    /// The name of the section that begins here, without its `$`; none at the file's end.
    fn section(&mut self) -> Result<Option<String>> {
        let word = self.word();
        if word.is_empty() {
            return Ok(None);
        }
        match std::str::from_utf8(word).ok().and_then(|word| word.strip_prefix('$')) {
            Some(name) if !name.is_empty() && !name.starts_with("End") => {
                self.line_end()?;
                Ok(Some(name.to_owned()))
            }
            _ => Err(self.unexpected(shown(word), "the beginning of a section, such as $Nodes")),
        }
    }

    /// The line `keyword`.
    fn keyword(&mut self, keyword: &str, expected: &str) -> Result<()> {
        let word = self.word();
        if word != keyword.as_bytes() {
            return Err(self.unexpected(shown(word), expected));
        }
        self.line_end()
    }

    /// Goes to the next place where `keyword` stands.
    fn skip_to(&mut self, keyword: &str) -> Result<()> {
        self.last = self.bytes.len();
        match self.bytes[self.at..]
            .windows(keyword.len())
            .position(|window| window == keyword.as_bytes())
        {
            Some(distance) => self.at += distance,
            None => return Err(self.unexpected("the end of the file", keyword)),
        }
        Ok(())
    }

    /// The byte order in which the next four bytes are the number 1.
    fn byte_order(&mut self) -> Result<Encoding> {
        let expected = "the number 1 in four bytes, which tells their order";
        match self.raw(expected)? {
            [1, 0, 0, 0] => Ok(Encoding::LittleEndian),
            [0, 0, 0, 1] => Ok(Encoding::BigEndian),
            found => Err(self.unexpected(format!("the bytes {found:?}"), expected)),
        }
    }

    /// An error at the last token: `found` where `expected` should stand.
    fn unexpected(&self, found: impl ToString, expected: impl ToString) -> GmshError {
        self.error(Fault::Unexpected { found: found.to_string(), expected: expected.to_string() })
    }

    /// An error at the last token.
    fn error(&self, fault: Fault) -> GmshError {
        let place = match self.encoding {
            Encoding::Text => Place::Line(
                1 + self.bytes[..self.last].iter().filter(|&&byte| byte == b'\n').count(),
            ),
            _ => Place::Byte(self.last),
        };
        GmshError { place, fault }
    }
}

/// How many of the first bytes are `such`.
fn run(bytes: &[u8], such: impl Fn(&u8) -> bool) -> usize {
    bytes.iter().position(|byte| !such(byte)).unwrap_or(bytes.len())
}

/// A word as an error shows it: in quotation marks and cut short, or the file's end.
fn shown(word: &[u8]) -> String {
    const MOST: usize = 40;
    match word.len() {
        0 => "the end of the file".to_owned(),
        1..=MOST => format!("{:?}", String::from_utf8_lossy(word)),
        _ => format!("{:?} and more", String::from_utf8_lossy(&word[..MOST])),
    }
}
