//! The sections `$Nodes` and `$Elements` of MSH 2.2.

use super::error::Result;
use super::reader::{Reader, magnitude};
use super::tokens::Encoding;
use crate::scene::mesh::{Element, NodeNumbers, Tags};

impl Reader<'_> {
    /// Reads `$Nodes`: a count, then `number x y z`.
    pub fn nodes_2(&mut self) -> Result<()> {
        let declared = self.tokens.count_line("the number of nodes")?;
        for _ in 0..declared {
            let number = self.tokens.int_from(1, "a node's number, 1 or more")?;
            self.node(number)?;
        }
        Ok(())
    }

    /// Reads `$Elements`: a count, then `number kind tags nodes` each, or binary blocks.
    pub fn elements_2(&mut self) -> Result<()> {
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

    /// Reads a binary block: kind, counts of elements and tags; then `number tags nodes` each.
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

    /// Reads an element's tags, the first physical (0: none), the second geometric, and nodes.
    fn element_2(&mut self, number: usize, kind_number: i32, tags: usize) -> Result<()> {
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
        let nodes: Result<NodeNumbers> = (0..kind.nodes)
            .map(|_| self.tokens.int_from(1, "a node's number, 1 or more"))
            .collect();
        self.keep(Element { number, kind: kind.number, physical, geometric, nodes: nodes? })
    }
}
