//! Nodes or elements by number.

use std::collections::BTreeMap;

/// Items by number. Gmsh writes them in ascending order as a rule: those that come so are kept in a
/// row, only the others need a search.
pub struct Numbered<T> {
    ascending: Vec<(usize, T)>,
    others: BTreeMap<usize, T>,
}

impl<T> Default for Numbered<T> {
    fn default() -> Self {
        Numbered { ascending: Vec::new(), others: BTreeMap::new() }
    }
}

impl<T> Numbered<T> {
    pub fn len(&self) -> usize {
        self.ascending.len() + self.others.len()
    }

    pub fn contains(&self, number: usize) -> bool {
        // Most meshes number from 1 without a gap.
        let likely = self.ascending.get(number.wrapping_sub(1));
        likely.is_some_and(|(found, _)| *found == number)
            || !self.is_next(number)
                && (self.ascending.binary_search_by_key(&number, |(found, _)| *found).is_ok()
                    || self.others.contains_key(&number))
    }

    /// Returns whether a number is above all that are kept.
    fn is_next(&self, number: usize) -> bool {
        self.ascending.last().is_none_or(|(last, _)| *last < number)
    }

    /// Keeps an item, and returns whether its number was free.
    pub fn insert(&mut self, number: usize, item: T) -> bool {
        if self.is_next(number) {
            self.ascending.push((number, item));
            return true;
        }
        !self.contains(number) && self.others.insert(number, item).is_none()
    }

    /// Returns the items in ascending order.
    pub fn into_values(self) -> Vec<T> {
        let mut all = self.ascending;
        all.extend(self.others);
        // Stable, and quick on what is sorted already.
        all.sort_by_key(|(number, _)| *number);
        all.into_iter().map(|(_, item)| item).collect()
    }
}
