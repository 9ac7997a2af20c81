//! The sections of a file, and the parts that all versions of the format share.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::error::{GmshError, Result};
use super::tokens::{Encoding, Tokens};
use crate::scene::mesh::{ENTITIES, Element, Mesh, Node, PhysicalName};

/// Reads a mesh from the bytes of a `.msh` file.
///
/// Nodes, elements and physical names are returned in ascending order; tags that are negative in
/// the file (a reversed orientation) are returned positive.
///
/// # Errors
/// The first fault, with its line (text) or byte (binary).
pub fn read(file: &[u8]) -> Result<Mesh, GmshError> {
    let mut tokens = Tokens::new(file);
    tokens.skip_mark()?;
    let version = version(&mut tokens)?;
    let mut reader = Reader {
        tokens,
        version,
        sections: BTreeSet::new(),
        names: BTreeMap::new(),
        entities: BTreeMap::new(),
        nodes: Vec::new(),
        elements: Vec::new(),
        numbers: Default::default(),
    };
    while let Some(section) = reader.tokens.section("the beginning of a section, such as $Nodes")? {
        reader.section(&section)?;
    }
    reader.finish()
}

/// Reads `$MeshFormat`, and skips the sections before it that other programs write.
fn version(tokens: &mut Tokens) -> Result<Version> {
    let expected = "$MeshFormat, the first section of a Gmsh mesh (MSH 2.2 or 4.1)";
    while let Some(section) = tokens.section(expected)? {
        match &*section {
            "MeshFormat" => {
                let version = format(tokens)?;
                tokens.keyword("$EndMeshFormat", "$EndMeshFormat")?;
                return Ok(version);
            }
            "NOD" => return Err(other_version(tokens, "1")),
            "PhysicalNames" | "Entities" | "Nodes" | "Elements" => {
                return Err(tokens.unexpected(format!("${section}"), expected));
            }
            _ => tokens.skip(&section)?,
        }
    }
    Err(tokens.unexpected("the end of the file", expected))
}

/// Reads the body of `$MeshFormat`, after which `tokens` knows its encoding.
fn format(tokens: &mut Tokens) -> Result<Version> {
    let found: String = tokens.parse("a version of the format")?;
    let version = match found.as_str() {
        "2.2" => Version::V2,
        "4.1" => Version::V4,
        other => return Err(other_version(tokens, other)),
    };
    let binary: i32 = tokens.parse("0 (text) or 1 (binary)")?;
    if !(0..=1).contains(&binary) {
        return Err(tokens.unexpected(binary, "0 (text) or 1 (binary)"));
    }
    let bytes: i32 = tokens.parse("8, the bytes of a number")?;
    if bytes != 8 {
        let fix = "save the mesh with a 64-bit Gmsh";
        return Err(
            tokens.refused(format!("the file has numbers of {bytes} bytes, expected 8: {fix}"))
        );
    }
    if binary == 1 {
        tokens.line_end()?;
        tokens.byte_order()?;
        tokens.encoding = Encoding::Binary;
    }
    Ok(version)
}

fn other_version(tokens: &Tokens, found: &str) -> GmshError {
    tokens.refused(format!(
        "the file has MSH version {found}; versions 2.2 and 4.1 can be read: in Gmsh set \
         Mesh.MshFileVersion = 4.1 and save the mesh again"
    ))
}

#[derive(Clone, Copy)]
enum Version {
    V2,
    V4,
}

/// The parts of a file that have been read so far.
pub struct Reader<'a> {
    pub tokens: Tokens<'a>,
    version: Version,
    /// The names of the sections read so far, without those that are skipped.
    pub sections: BTreeSet<String>,
    pub names: BTreeMap<(usize, usize), String>,
    pub entities: BTreeMap<(usize, i32), Vec<usize>>,
    pub nodes: Vec<Node>,
    pub elements: Vec<Element>,
    /// The numbers of the nodes, and of the elements.
    numbers: [HashSet<usize>; 2],
}

impl Reader<'_> {
    fn section(&mut self, name: &str) -> Result<()> {
        match (name, self.version) {
            ("PhysicalNames", _) => self.once(name, Self::physical_names),
            ("Entities", Version::V4) => self.once(name, Self::entities_4),
            ("Nodes", Version::V2) => self.once(name, Self::nodes_2),
            ("Nodes", Version::V4) => self.once(name, Self::nodes_4),
            ("Elements", Version::V2) => self.once(name, Self::elements_2),
            ("Elements", Version::V4) => self.once(name, Self::elements_4),
            _ => self.tokens.skip(name),
        }
    }

    /// Reads by `body` a section that may occur only once. `$Elements` follows the sections to
    /// which the elements refer.
    fn once(&mut self, name: &str, body: fn(&mut Self) -> Result<()>) -> Result<()> {
        if name == "Elements" && !self.sections.contains("Nodes") {
            let expected = "$Nodes before it (in Gmsh set Mesh.SaveParametric = 0)";
            return Err(self.tokens.unexpected("$Elements", expected));
        }
        if name == "Entities" && self.sections.contains("Elements") {
            return Err(self.tokens.unexpected("$Entities after $Elements", "$Entities first"));
        }
        if !self.sections.insert(name.to_owned()) {
            return Err(self.tokens.refused(format!("a second section ${name}, expected one")));
        }
        body(self)?;
        let end = format!("$End{name}");
        self.tokens.keyword(&end, &end)
    }

    fn finish(mut self) -> Result<Mesh> {
        for section in ["Nodes", "Elements"] {
            if !self.sections.contains(section) {
                return Err(self.tokens.refused(format!("the file has no section ${section}")));
            }
        }
        self.nodes.sort_unstable_by_key(|node| node.number);
        self.elements.sort_unstable_by_key(|element| element.number);
        let named = |((dim, tag), name)| PhysicalName { dim, tag, name };
        let mut mesh = Mesh {
            nodes: self.nodes,
            elements: self.elements,
            names: self.names.into_iter().map(named).collect(),
            ..Mesh::default()
        };
        mesh.join_groups();
        Ok(mesh)
    }

    /// Reads `$PhysicalNames`: a count, then lines `dimension tag "name"`, always text.
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
                return self.repeated(format!("the name of the physical {} {tag}", ENTITIES[dim]));
            }
        }
        Ok(())
    }

    /// Reads the coordinates of the node `number`, and keeps it.
    pub fn node(&mut self, number: usize) -> Result<()> {
        if !self.numbers[0].insert(number) {
            return self.repeated(format!("node {number}"));
        }
        let mut xyz = [0.0; 3];
        for x in &mut xyz {
            *x = self.tokens.double("a node's coordinate")?;
            if !x.is_finite() {
                let what =
                    format!("node {number} has the coordinate {x}, expected a finite number");
                return Err(self.tokens.refused(what));
            }
        }
        self.nodes.push(Node { number, xyz });
        Ok(())
    }

    /// Keeps an element, unless it has a node that the file does not have, or its number is taken.
    pub fn keep(&mut self, element: Element) -> Result<()> {
        let number = element.number;
        let [nodes, elements] = &mut self.numbers;
        if let Some(node) = element.nodes.iter().find(|node| !nodes.contains(*node)) {
            let what = format!("element {number} has the node {node}, which is not in $Nodes");
            return Err(self.tokens.refused(what));
        }
        if !elements.insert(number) {
            return self.repeated(format!("element {number}"));
        }
        self.elements.push(element);
        Ok(())
    }

    /// Compares a total that the file declares with what was read.
    pub fn check_count(&self, what: &str, declared: usize, found: usize) -> Result<()> {
        if declared != found {
            let what = format!("{declared} {what} are declared but {found} are given");
            return Err(self.tokens.refused(what));
        }
        Ok(())
    }

    /// Refuses an item that occurs a second time.
    pub fn repeated(&self, what: String) -> Result<()> {
        Err(self.tokens.refused(format!("{what} comes a second time")))
    }
}

/// Returns a tag without its sign, which is an orientation in Gmsh.
pub fn magnitude(tag: i32) -> usize {
    tag.unsigned_abs() as usize
}
