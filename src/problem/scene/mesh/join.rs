//! Triangles of several physical groups.

use super::Mesh;

impl Mesh {
    /// Joins the rows of a triangle that differ in number and physical group alone: MSH 2.2 and the
    /// paper's tables have one for each group of a triangle. The first keeps all its groups, as the one
    /// row of MSH 4.1 has them.
    pub(in crate::scene) fn join_groups(&mut self) {
        let mut rows: Vec<([usize; 3], usize, usize)> = Vec::new();
        rows.extend(self.elements.iter().enumerate().filter_map(|(place, element)| {
            let &[a, b, c] = &element.nodes[..] else { return None };
            Some(([a, b, c], element.geometric, place))
        }));
        rows.sort_unstable();
        let mut is_joined = vec![false; self.elements.len()];
        for row in rows.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|rows| rows.len() > 1) {
            let first = row[0].2;
            for &(_, _, place) in &row[1..] {
                let tags = self.elements[place].physical.clone();
                let kept = &mut self.elements[first].physical;
                if !tags.is_empty() && tags.iter().all(|tag| !kept.contains(tag)) {
                    kept.extend(tags);
                    kept.sort_unstable();
                    is_joined[place] = true;
                }
            }
        }
        let mut is_joined = is_joined.into_iter();
        self.elements.retain(|_| !is_joined.next().expect("one for each element"));
    }
}
