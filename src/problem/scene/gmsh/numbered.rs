//! Nodes or elements by number.

use std::collections::BTreeMap;

use crate::scene::mesh::{Element, Node};

/// What has a number of its own.
pub trait HasNumber {
    fn number(&self) -> usize;
}

impl HasNumber for Node {
    fn number(&self) -> usize {
        self.number
    }
}

impl HasNumber for Element {
    fn number(&self) -> usize {
        self.number
    }
}

/// Items by number. Gmsh writes them in ascending order as a rule: those that come so are kept in a
/// row, only the others need a search.
pub struct Numbered<T> {
    ascending: Vec<T>,
    others: BTreeMap<usize, T>,
}

impl<T> Default for Numbered<T> {
    fn default() -> Self {
        Numbered { ascending: Vec::new(), others: BTreeMap::new() }
    }
}

impl<T: HasNumber> Numbered<T> {
    pub fn len(&self) -> usize {
        self.ascending.len() + self.others.len()
    }

    pub fn contains(&self, number: usize) -> bool {
        // Most meshes number from 1 without a gap.
        let likely = self.ascending.get(number.wrapping_sub(1));
        likely.is_some_and(|found| found.number() == number)
            || !self.is_next(number)
                && (self.ascending.binary_search_by_key(&number, T::number).is_ok()
                    || self.others.contains_key(&number))
    }

    /// Returns whether a number is above all that are kept.
    fn is_next(&self, number: usize) -> bool {
        self.ascending.last().is_none_or(|last| last.number() < number)
    }

    /// Keeps an item, and returns whether its number was free.
    pub fn insert(&mut self, item: T) -> bool {
        let number = item.number();
        if self.is_next(number) {
            self.ascending.push(item);
            return true;
        }
        !self.contains(number) && self.others.insert(number, item).is_none()
    }

    /// Returns the items in ascending order.
    pub fn into_values(self) -> Vec<T> {
        let mut all = self.ascending;
        all.extend(self.others.into_values());
        // In place, and quick on what is sorted already.
        all.sort_unstable_by_key(T::number);
        all
    }
}
