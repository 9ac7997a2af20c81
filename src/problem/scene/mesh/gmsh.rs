//! What a Gmsh file may have in another form than the paper's tables: numbers with gaps, and triangles
//! that run clockwise.

use super::{Element, Mesh};
use crate::element;
use crate::scene::description::Description;
use base::error::{InputError, Result};

impl Mesh {
    /// Numbers the nodes from 1 without gaps, in their order, and does so with elements whose numbers
    /// are far above their count; turns the triangles that run clockwise.
    /// `description` names nodes and edges by the file's numbers.
    ///
    /// # Errors
    /// The description names a number that the file does not have.
    pub(in crate::scene) fn adapt(&mut self, description: &mut Description) -> Result<()> {
        let numbers: Vec<usize> = self.nodes.iter().map(|node| node.number).collect();
        if numbers.last().is_some_and(|last| *last > numbers.len()) {
            for (place, n) in description.named_nodes() {
                *n = rank(&numbers, *n, "node", &place)?;
            }
            for n in self.elements.iter_mut().flat_map(|element| &mut element.nodes) {
                *n = rank(&numbers, *n, "node", "the mesh's elements")?;
            }
            self.nodes.iter_mut().zip(1..).for_each(|(node, n)| node.number = n);
            self.adapted.push(renumbered("node", &numbers));
            self.in_file = numbers;
        }
        let numbers: Vec<usize> = self.elements.iter().map(|element| element.number).collect();
        if numbers.last().is_some_and(|last| *last > Self::largest_number(numbers.len())) {
            let contact = description.contact.as_mut();
            for n in contact.map_or(&mut [][..], |contact| contact.target.numbers()) {
                *n = rank(&numbers, *n, "element", "contact.trg")?;
            }
            self.elements.iter_mut().zip(1..).for_each(|(element, n)| element.number = n);
            self.adapted.push(renumbered("element", &numbers));
        }
        self.turn_triangles();
        Ok(())
    }

    /// Turns each triangle that runs clockwise.
    fn turn_triangles(&mut self) {
        let is_clockwise =
            |element: &Element| element.dim() == 2 && element::area(&self.corners(element)) < 0.0;
        let places = (0..self.elements.len()).filter(|k| is_clockwise(&self.elements[*k]));
        let clockwise: Vec<usize> = places.collect();
        let Some(first) = clockwise.first().map(|k| &self.elements[*k]) else { return };
        self.adapted.push(format!(
            "In the mesh file {} of {} triangles run clockwise, the first {} ({}); they were turned",
            clockwise.len(),
            self.of_dimension(2).count(),
            first.number,
            self.whereabouts(first)
        ));
        clockwise.iter().for_each(|k| self.elements[*k].nodes.swap(1, 2));
    }

    /// Returns the largest number that one of `count` elements may have: `elem` has a row for each.
    pub(super) fn largest_number(count: usize) -> usize {
        16 * count + 1024
    }
}

/// Returns the place of a number of the file among `numbers`, from 1.
fn rank(numbers: &[usize], number: usize, kind: &str, place: &str) -> Result<usize> {
    numbers.binary_search(&number).map(|at| at + 1).map_err(|_| {
        let what = format!("the mesh file has no {kind} {number}");
        InputError::new(place, what, "name one by its number in the mesh file")
    })
}

fn renumbered(kind: &str, numbers: &[usize]) -> String {
    let first = numbers.iter().zip(1..).find(|(number, n)| *number != n);
    let (number, n) = first.expect("there is a gap");
    let count = numbers.len();
    format!(
        "The {kind} numbers of the mesh file have gaps: its {kind}s are numbered 1 to {count} here, in \
         their order, so that {kind} {number} of the file is {kind} {n}; the scene names the file's"
    )
}
