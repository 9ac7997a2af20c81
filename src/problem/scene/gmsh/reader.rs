//! The sections of a file. In MSH 4.1 each element belongs to a geometric entity, and has its physical tags.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::tokens::{Encoding, Tokens};
use super::{GmshError, Result};
use crate::scene::mesh::{
    ENTITIES, Element, KINDS, Kind, Mesh, Node, NodeNumbers, OtherKind, PhysicalName, Tags,
};

/// Reads a mesh from the bytes of a `.msh` file.
///
/// Nodes, elements and physical names are returned in ascending order; tags that are negative in
/// the file (a reversed orientation) are returned positive.
///
/// # Errors
/// The first fault, with its line (text) or byte (binary).
pub fn read<'a>(file: &'a [u8]) -> Result<Mesh, GmshError> {
    let mut tokens = Tokens::new(file);
    tokens.skip_mark()?;
    let version = version(&mut tokens)?;
    let mut reader = Reader {
        tokens,
        sections: BTreeSet::new(),
        names: BTreeMap::new(),
        names_have_dimensions: true,
        entities: BTreeMap::new(),
        nodes: Vec::new(),
        elements: Vec::new(),
        numbers: Default::default(),
    };
    while let Some(section) = reader.tokens.section("the beginning of a section, such as $Nodes")? {
        let body: fn(&mut Reader<'a>) -> Result<()> = match (&*section, version) {
            ("PhysicalNames", _) => Reader::physical_names,
            ("Entities", Version::V4) => Reader::entities_4,
            ("Nodes", Version::V2) => Reader::nodes_2,
            ("Nodes", Version::V4) => Reader::nodes_4,
            ("Elements", Version::V2) => Reader::elements_2,
            ("Elements", Version::V4) => Reader::elements_4,
            _ => {
                reader.tokens.skip(&section)?;
                continue;
            }
        };
        // Each may occur once, `$Elements` behind the sections to which the elements refer.
        let Reader { tokens, sections, .. } = &mut reader;
        if section == "Elements" && !sections.contains("Nodes") {
            let expected = "$Nodes before it (in Gmsh set Mesh.SaveParametric = 0)";
            return Err(tokens.unexpected("$Elements", expected));
        }
        if section == "Entities" && sections.contains("Elements") {
            return Err(tokens.unexpected("$Entities after $Elements", "$Entities first"));
        }
        if !sections.insert(section.clone()) {
            return Err(tokens.refused(format!("a second section ${section}, expected one")));
        }
        body(&mut reader)?;
        let end = format!("$End{section}");
        reader.tokens.keyword(&end)?;
    }
    let Reader { tokens, sections, mut names, names_have_dimensions, nodes, elements, .. } = reader;
    for section in ["Nodes", "Elements"] {
        if !sections.contains(section) {
            return Err(tokens.refused(format!("the file has no section ${section}")));
        }
    }
    if !names_have_dimensions {
        let groups = |e: &Element| e.physical.iter().map(|tag| (e.dim(), *tag)).collect::<Vec<_>>();
        let used: HashSet<(usize, usize)> = elements.iter().flat_map(groups).collect();
        names.retain(|group, _| used.contains(group));
    }
    let named = |((dim, tag), name)| PhysicalName { dim, tag, name };
    Ok(Mesh::of(nodes, elements, names.into_iter().map(named).collect()))
}

/// Reads `$MeshFormat`, and skips the sections before it that other programs write.
fn version(tokens: &mut Tokens) -> Result<Version> {
    let expected = "$MeshFormat, the first section of a Gmsh mesh (MSH 2.0 to 2.2, or 4.1)";
    while let Some(section) = tokens.section(expected)? {
        match &*section {
            "MeshFormat" => {
                let version = format(tokens)?;
                tokens.keyword("$EndMeshFormat")?;
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
        "2" | "2.0" | "2.1" | "2.2" => Version::V2,
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
        "the file has MSH version {found}; versions 2.0 to 2.2 and 4.1 can be read: in Gmsh set \
         Mesh.MshFileVersion = 4.1 and save the mesh again"
    ))
}

#[derive(Clone, Copy)]
enum Version {
    V2,
    V4,
}

/// What the number of an element is expected to be.
const NUMBER: &str = "an element's number, 1 or more";

/// The parts of a file that have been read so far.
struct Reader<'a> {
    tokens: Tokens<'a>,
    /// The names of the sections read so far, without those that are skipped.
    sections: BTreeSet<String>,
    names: BTreeMap<(usize, usize), String>,
    names_have_dimensions: bool,
    entities: BTreeMap<(usize, i32), Vec<usize>>,
    nodes: Vec<Node>,
    elements: Vec<Element>,
    /// The numbers of the nodes, and of the elements.
    numbers: [HashSet<usize>; 2],
}

impl<'a> Reader<'a> {
    /// Reads `$PhysicalNames`: a count, then lines `dimension tag "name"`, always text. MSH 2.0 has no
    /// dimension: the name is that of the tag in each.
    fn physical_names(&mut self) -> Result<()> {
        let count: usize = self.tokens.parse("the number of physical names")?;
        for _ in 0..count {
            let first: i32 = self.tokens.parse("a dimension from 0 to 3")?;
            let (dims, tag) = match (self.tokens.is_quote_next(), first) {
                (true, tag) => {
                    self.names_have_dimensions = false;
                    (0..=3, tag)
                }
                (false, dim @ 0..=3) => {
                    let dim = magnitude(dim);
                    (dim..=dim, self.tokens.parse("a physical tag")?)
                }
                (false, other) => {
                    return Err(self.tokens.unexpected(other, "a dimension from 0 to 3"));
                }
            };
            let name = self.tokens.quoted("a name in quotation marks")?;
            for dim in dims {
                if self.names.insert((dim, magnitude(tag)), name.clone()).is_some() {
                    return self
                        .repeated(format!("the name of the physical {} {tag}", ENTITIES[dim]));
                }
            }
        }
        Ok(())
    }

    /// Reads the coordinates of the node `number`, and keeps it.
    fn node(&mut self, number: usize) -> Result<()> {
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

    /// Returns the kind of an element, whose type has the number `number` in Gmsh; `physical` and
    /// `geometric` are its tags.
    ///
    /// # Errors
    /// The kind is not among those that are read.
    fn kind(
        &self,
        element: usize,
        number: i32,
        (physical, geometric): (&[usize], usize),
    ) -> Result<&'static Kind> {
        KINDS.iter().find(|kind| i32::try_from(kind.number) == Ok(number)).ok_or_else(|| {
            let other = OtherKind::new(number);
            let names = physical.iter().filter_map(|tag| self.names.get(&(other.dim, *tag)));
            let names: String = names.map(|name| format!(", {name:?}")).collect();
            let entity = format!("{} {geometric}{names}", ENTITIES[other.dim]);
            self.tokens.refused(format!(
                "element {element} is {} ({entity}); only points, two-node edges and three-node \
                 triangles can be read: in Gmsh {}, and mesh again in two dimensions (-2)",
                other.name,
                other.remedy(geometric)
            ))
        })
    }

    /// Reads the nodes of an element of a kind, each by `int` or by `size` of the tokens, and keeps it,
    /// unless it has a node that the file does not have, or its number is taken.
    fn element(
        &mut self,
        number: usize,
        kind: &Kind,
        (physical, geometric): (Tags, usize),
        node: fn(&mut Tokens<'a>, usize, &str) -> Result<usize>,
    ) -> Result<()> {
        let read = |_| node(&mut self.tokens, 1, "a node's number, 1 or more");
        let own = (0..kind.nodes).map(read).collect::<Result<NodeNumbers>>()?;
        let [nodes, elements] = &mut self.numbers;
        if let Some(node) = own.iter().find(|node| !nodes.contains(*node)) {
            let what = format!("element {number} has the node {node}, which is not in $Nodes");
            return Err(self.tokens.refused(what));
        }
        if !elements.insert(number) {
            return self.repeated(format!("element {number}"));
        }
        self.elements.push(Element { number, kind: kind.number, physical, geometric, nodes: own });
        Ok(())
    }

    /// Compares a total that the file declares with what was read.
    fn check_count(&self, what: &str, declared: usize, found: usize) -> Result<()> {
        if declared != found {
            let what = format!("{declared} {what} are declared but {found} are given");
            return Err(self.tokens.refused(what));
        }
        Ok(())
    }

    /// Refuses an item that occurs a second time.
    fn repeated(&self, what: String) -> Result<()> {
        Err(self.tokens.refused(format!("{what} comes a second time")))
    }

    /// Reads `$Nodes` of MSH 2: a count, then `number x y z`.
    fn nodes_2(&mut self) -> Result<()> {
        for _ in 0..self.tokens.count_line("the number of nodes")? {
            let number = self.tokens.int_from(1, "a node's number, 1 or more")?;
            self.node(number)?;
        }
        Ok(())
    }

    /// Reads `$Elements` of MSH 2: a count, then `number kind tags nodes` each, or binary blocks, of which
    /// each has the kind and the counts of elements and of tags first.
    fn elements_2(&mut self) -> Result<()> {
        let declared = self.tokens.count_line("the number of elements")?;
        let is_text = self.tokens.encoding == Encoding::Text;
        while self.elements.len() < declared {
            let mut number = if is_text { self.tokens.int_from(1, NUMBER)? } else { 0 };
            let kind_number = self.tokens.int("an element's type")?;
            let count = match is_text {
                true => 1,
                false => self.tokens.int_from(1, "the number of elements of a block, 1 or more")?,
            };
            let tags = self.tokens.int_from(0, "an element's number of tags")?;
            for _ in 0..count {
                if !is_text {
                    number = self.tokens.int_from(1, NUMBER)?;
                }
                // The first tag is physical (0: none), the second geometric.
                let mut first = [0; 2];
                for k in 0..tags {
                    let tag = self.tokens.int("an element's tag").map(magnitude)?;
                    if let Some(kept) = first.get_mut(k) {
                        *kept = tag;
                    }
                }
                let [physical, geometric] = first;
                let physical: Tags = (physical != 0).then_some(physical).into_iter().collect();
                let kind = self.kind(number, kind_number, (&physical, geometric))?;
                self.element(number, kind, (physical, geometric), Tokens::int_from)?;
            }
        }
        self.check_count("elements", declared, self.elements.len())
    }

    /// Reads `$Entities`: counts of points, curves, surfaces and volumes, then each of them: tag, coordinates
    /// or box, physical tags, and (except for a point) the tags of the entities that bound it.
    fn entities_4(&mut self) -> Result<()> {
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = self.tokens.size("a number of entities")?;
        }
        let each = (0..4).flat_map(|dim| std::iter::repeat_n(dim, counts[dim]));
        for dim in each {
            let tag = self.tokens.int("an entity's tag")?;
            if self.entities.contains_key(&(dim, tag)) {
                return self.repeated(format!("{} {tag}", ENTITIES[dim]));
            }
            for _ in 0..if dim == 0 { 3 } else { 6 } {
                self.tokens.double("a coordinate of the entity's box")?;
            }
            // Each element of the entity gets a copy of its tags: without a limit a hostile file of some
            // kilobytes would take gigabytes. 0 is none, as in format 2.2.
            const MOST: usize = 32;
            let count = self.tokens.size("the number of physical tags")?;
            if count > MOST {
                let expected = format!("at most {MOST} physical groups of an entity");
                return Err(self.tokens.unexpected(count, expected));
            }
            let tags: Result<BTreeSet<usize>> =
                (0..count).map(|_| self.tokens.int("a physical tag").map(magnitude)).collect();
            let physical = tags?.into_iter().filter(|tag| *tag != 0).collect();
            self.entities.insert((dim, tag), physical);
            if dim > 0 {
                for _ in 0..self.tokens.size("the number of bounding entities")? {
                    self.tokens.int("the tag of a bounding entity")?;
                }
            }
        }
        Ok(())
    }

    /// Reads `$Nodes` of MSH 4.1: the totals, then blocks: `dimension tag parametric count`, the nodes'
    /// numbers, then their coordinates. On a parametric entity as many parameters as it has dimensions follow
    /// each node's coordinates.
    fn nodes_4(&mut self) -> Result<()> {
        let (blocks, declared) = self.totals("node")?;
        for _ in 0..blocks {
            let (dim, _) = self.entity_of_block()?;
            let parameters = match self.tokens.int("0 or 1 (parametric)")? {
                0 => 0,
                1 => dim,
                other => return Err(self.tokens.unexpected(other, "0 or 1 (parametric)")),
            };
            let count = self.tokens.size("the number of nodes of a block")?;
            let numbers: Result<Vec<usize>> = (0..count)
                .map(|_| self.tokens.size_from(1, "a node's number, 1 or more"))
                .collect();
            for number in numbers? {
                self.node(number)?;
                for _ in 0..parameters {
                    self.tokens.double("a node's parameter on its entity")?;
                }
            }
        }
        self.check_count("nodes", declared, self.nodes.len())
    }

    /// Reads `$Elements` of MSH 4.1: the totals, then blocks: `dimension tag kind count`, then `number nodes`
    /// of each element.
    fn elements_4(&mut self) -> Result<()> {
        let (blocks, declared) = self.totals("element")?;
        for _ in 0..blocks {
            let (dim, tag) = self.entity_of_block()?;
            let physical = match self.entities.get(&(dim, tag)) {
                Some(tags) => tags.clone(),
                None if !self.sections.contains("Entities") => Vec::new(),
                None => {
                    return Err(self.tokens.refused(format!(
                        "the elements are part of the {} {tag}, which is not in $Entities; if the mesh is \
                         partitioned, save it unpartitioned",
                        ENTITIES[dim]
                    )));
                }
            };
            let kind_number = self.tokens.int("an element's type")?;
            for _ in 0..self.tokens.size("the number of elements of a block")? {
                let number = self.tokens.size_from(1, NUMBER)?;
                let kind = self.kind(number, kind_number, (&physical, magnitude(tag)))?;
                if kind.dim != dim {
                    return Err(self.tokens.refused(format!(
                        "element {number} has dimension {}, but it is listed in an entity of dimension {dim}",
                        kind.dim
                    )));
                }
                let tags = (physical[..].into(), magnitude(tag));
                self.element(number, kind, tags, Tokens::size_from)?;
            }
        }
        self.check_count("elements", declared, self.elements.len())
    }

    /// Reads a section's numbers of blocks and items, and skips the least and greatest number.
    fn totals(&mut self, what: &str) -> Result<(usize, usize)> {
        let blocks = self.tokens.size(&format!("the number of {what} blocks"))?;
        let declared = self.tokens.size(&format!("the number of {what}s"))?;
        self.tokens.size(&format!("the least {what} number"))?;
        self.tokens.size(&format!("the greatest {what} number"))?;
        Ok((blocks, declared))
    }

    /// Reads dimension and tag of the entity that a block belongs to.
    fn entity_of_block(&mut self) -> Result<(usize, i32)> {
        let expected = "an entity's dimension, 0 to 3";
        let dim = self.tokens.int_from(0, expected)?;
        if dim > 3 {
            return Err(self.tokens.unexpected(dim, expected));
        }
        Ok((dim, self.tokens.int("an entity's tag")?))
    }
}

/// Returns a tag without its sign, which is an orientation in Gmsh.
fn magnitude(tag: i32) -> usize {
    tag.unsigned_abs() as usize
}
