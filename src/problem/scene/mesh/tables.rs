//! Meshes from the paper's own tables, and triangles of several physical groups.

use super::{Element, KINDS, Mesh, Node, OtherKind, PhysicalName};
use base::error::{InputError, Result};

impl Mesh {
    /// Reads the paper's own tables: rows of `node` are number, x, y, z; rows of `elem` are number,
    /// type, 2, physical tag, geometric tag, nodes.
    ///
    /// # Errors
    /// A row has another form.
    pub fn from_tables(node: &[[f64; 4]], elem: &[Vec<usize>]) -> Result<Self> {
        let mut nodes = Vec::with_capacity(node.len());
        for (k, &[number, x, y, z]) in node.iter().enumerate() {
            if number.fract() != 0.0 || !(1.0..9e15).contains(&number) {
                let what = format!("{number} is no node number");
                let fix = "number the nodes 1, 2, 3, ...";
                return Err(InputError::new(format!("node[{k}]"), what, fix));
            }
            nodes.push(Node { number: number as usize, xyz: [x, y, z] });
        }
        let row = |(k, row): (usize, &Vec<usize>)| {
            element(row).map_err(|error| error.within(&format!("elem[{k}]")))
        };
        let elements = elem.iter().enumerate().map(row).collect::<Result<_>>()?;
        Ok(Mesh::of(nodes, elements, Vec::new()))
    }

    /// Puts nodes and elements in order, and joins the rows of a triangle that differ in number and physical
    /// group alone: MSH 2.2 and the paper's tables have one for each group of a triangle. The first keeps
    /// all its groups, as the one row of MSH 4.1 has them.
    pub(in crate::scene) fn of(
        mut nodes: Vec<Node>,
        mut elements: Vec<Element>,
        names: Vec<PhysicalName>,
    ) -> Self {
        nodes.sort_by_key(|node| node.number);
        elements.sort_by_key(|element| element.number);
        let mut rows: Vec<([usize; 3], usize, usize)> = Vec::new();
        rows.extend(elements.iter().enumerate().filter_map(|(place, element)| {
            let &[a, b, c] = &element.nodes[..] else { return None };
            Some(([a, b, c], element.geometric, place))
        }));
        rows.sort_unstable();
        let mut is_joined = vec![false; elements.len()];
        for row in rows.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|rows| rows.len() > 1) {
            let first = row[0].2;
            for &(_, _, place) in &row[1..] {
                let tags = elements[place].physical.clone();
                let kept = &mut elements[first].physical;
                if !tags.is_empty() && tags.iter().all(|tag| !kept.contains(tag)) {
                    kept.extend(tags);
                    kept.sort_unstable();
                    is_joined[place] = true;
                }
            }
        }
        let mut is_joined = is_joined.into_iter();
        elements.retain(|_| !is_joined.next().expect("one for each element"));
        Mesh { nodes, elements, names, ..Mesh::default() }
    }
}

/// Reads a row of `elem`: number, type, 2, physical tag, geometric tag, nodes.
fn element(row: &[usize]) -> Result<Element> {
    let fix = "a row is number, type, 2, physical tag, geometric tag, nodes: \
               [7, 1, 2, 10, 1, 3, 4] for an edge";
    let bad = |what: String| InputError::new("", what, fix);
    let [number, kind, tags, physical, geometric, ref nodes @ ..] = *row else {
        return Err(bad(format!("{} entries are too few", row.len())));
    };
    let known = KINDS.iter().find(|known| known.number == kind);
    let unknown = || {
        let other = OtherKind::new(i32::try_from(kind).unwrap_or(i32::MAX));
        let what = format!("type {kind} is none of 15 (point), 1 (edge), 2 (triangle)");
        let fix = format!("for a mesh of Gmsh that has them, {}", other.remedy(geometric));
        InputError::new("", what, fix)
    };
    let expected = known.ok_or_else(unknown)?.nodes;
    if tags != 2 {
        return Err(bad(format!(
            "{tags} tags: the listings read nodes from column 6 on, so there must be 2"
        )));
    }
    if nodes.len() != expected {
        return Err(bad(format!("type {kind} has {expected} nodes, not {}", nodes.len())));
    }
    let physical = (physical != 0).then_some(physical).into_iter().collect();
    Ok(Element { number, kind, physical, geometric, nodes: nodes.into() })
}
