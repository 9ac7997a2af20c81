//! The sections `$Entities`, `$Nodes` and `$Elements` of MSH 4.1, in which each element belongs to
//! a geometric entity and has its physical tags.

use std::collections::BTreeSet;

use super::error::Result;
use super::reader::{Reader, magnitude};
use crate::scene::mesh::{ENTITIES, Element, NodeNumbers};

impl Reader<'_> {
    /// Reads `$Entities`: counts of points, curves, surfaces and volumes, then each of them.
    pub fn entities_4(&mut self) -> Result<()> {
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

    /// Reads an entity: tag, coordinates or box, physical tags, and (except for a point) the tags
    /// of the entities that bound it.
    fn entity(&mut self, dim: usize) -> Result<()> {
        let tag = self.tokens.int("an entity's tag")?;
        if self.entities.contains_key(&(dim, tag)) {
            return self.repeated(format!("{} {tag}", ENTITIES[dim]));
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

    /// Reads an entity's physical tags; 0 is none, as in format 2.2. Their number is limited, because
    /// each element of the entity gets a copy: without a limit a hostile file of some kilobytes would
    /// take gigabytes.
    fn physical_tags(&mut self) -> Result<Vec<usize>> {
        const MOST: usize = 32;
        let count = self.tokens.size("the number of physical tags")?;
        if count > MOST {
            let expected = format!("at most {MOST} physical groups of an entity");
            return Err(self.tokens.unexpected(count, expected));
        }
        let tags: Result<BTreeSet<usize>> =
            (0..count).map(|_| self.tokens.int("a physical tag").map(magnitude)).collect();
        Ok(tags?.into_iter().filter(|tag| *tag != 0).collect())
    }

    /// Reads `$Nodes`: the totals, then the blocks.
    pub fn nodes_4(&mut self) -> Result<()> {
        let (blocks, declared) = self.totals("node")?;
        for _ in 0..blocks {
            self.node_block()?;
        }
        self.check_count("nodes", declared, self.nodes.len())
    }

    /// Reads `$Elements`: the totals, then the blocks.
    pub fn elements_4(&mut self) -> Result<()> {
        let (blocks, declared) = self.totals("element")?;
        for _ in 0..blocks {
            self.element_block()?;
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

    /// Reads a block: `dimension tag parametric count`, the nodes' numbers, then their coordinates.
    /// On a parametric entity as many parameters as it has dimensions follow each node's
    /// coordinates.
    fn node_block(&mut self) -> Result<()> {
        let (dim, _) = self.entity_of_block()?;
        let parameters = match self.tokens.int("0 or 1 (parametric)")? {
            0 => 0,
            1 => dim,
            other => return Err(self.tokens.unexpected(other, "0 or 1 (parametric)")),
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

    /// Reads a block: `dimension tag kind count`, then `number nodes` of each element.
    fn element_block(&mut self) -> Result<()> {
        let (dim, tag) = self.entity_of_block()?;
        let physical = self.physical_of(dim, tag)?;
        let kind_number = self.tokens.int("an element's type")?;
        for _ in 0..self.tokens.size("the number of elements of a block")? {
            let number = self.tokens.size_from(1, "an element's number, 1 or more")?;
            let kind = self.kind(number, kind_number, (&physical, magnitude(tag)))?;
            if kind.dim != dim {
                return Err(self.tokens.refused(format!(
                    "element {number} has dimension {}, but it is listed in an entity of dimension {dim}",
                    kind.dim
                )));
            }
            let nodes: Result<NodeNumbers> = (0..kind.nodes)
                .map(|_| self.tokens.size_from(1, "a node's number, 1 or more"))
                .collect();
            let (physical, geometric) = (physical[..].into(), magnitude(tag));
            self.keep(Element { number, kind: kind.number, physical, geometric, nodes: nodes? })?;
        }
        Ok(())
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

    /// Returns the physical tags of an entity; none if the file has no `$Entities` at all.
    fn physical_of(&self, dim: usize, tag: i32) -> Result<Vec<usize>> {
        match self.entities.get(&(dim, tag)) {
            Some(tags) => Ok(tags.clone()),
            None if !self.sections.contains("Entities") => Ok(Vec::new()),
            None => Err(self.tokens.refused(format!(
                "the elements are part of the {} {tag}, which is not in $Entities; if the mesh is \
                 partitioned, save it unpartitioned",
                ENTITIES[dim]
            ))),
        }
    }
}
