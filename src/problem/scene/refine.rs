//! A scene on a finer mesh: every triangle is split in four, every edge in two.
//!
//! ```text
//!          c                   new nodes halve the edges; the outline stays the same polygon,
//!        / \                   because only the corners of a curved surface are known.
//!      ca---bc
//!      / \  / \
//!     a---ab---b
//! ```

use std::collections::{HashMap, HashSet};

use super::Scene;
use super::derived::Derived;
use super::mesh::{Element, Mesh, Node, NodeNumbers};
use super::surface::Surface;
use crate::model::{NodeId, unordered};
use base::error::Result;

impl Scene {
    /// Returns the scene on a mesh of half the element size, with everything else unchanged. Nodes keep their
    /// numbers, and new ones follow, each of which halves an edge; triangle n (row of `EL`) becomes 4n − 3 ..
    /// 4n. A restraint or a force on a single node stays on that node.
    ///
    /// # Errors
    /// The finer scene cannot be built.
    pub fn refined(&self) -> Result<Derived> {
        let (description, mesh) = self.source();
        // Each side of an element is halved once; a point has none.
        let (mut parents, mut halves) = (Vec::new(), HashMap::new());
        for Element { nodes, .. } in &mesh.elements {
            let sides = if nodes.len() == 3 { 3 } else { nodes.len() - 1 };
            for k in 0..sides {
                let ends = unordered([nodes[k], nodes[(k + 1) % nodes.len()]]);
                halves.entry(ends).or_insert_with(|| {
                    parents.push(ends);
                    mesh.nodes.len() + parents.len()
                });
            }
        }
        let mut nodes = mesh.nodes.clone();
        for [a, b] in &parents {
            let xyz =
                [0, 1, 2].map(|d| (mesh.nodes[a - 1].xyz[d] + mesh.nodes[b - 1].xyz[d]) / 2.0);
            nodes.push(Node { number: nodes.len() + 1, xyz });
        }
        // Elements are numbered from 1, with children in the place of their parent.
        let (mut elements, mut children) = (Vec::new(), HashMap::<usize, Vec<usize>>::new());
        for parent in &mesh.elements {
            let half = |a, b| halves[&unordered([a, b])];
            let parts: Vec<NodeNumbers> = match parent.nodes[..] {
                [a, b, c] => {
                    let [ab, bc, ca] = [half(a, b), half(b, c), half(c, a)];
                    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
                    parts.map(NodeNumbers::from).to_vec()
                }
                [a, b] => [[a, half(a, b)], [half(a, b), b]].map(|ends| ends[..].into()).to_vec(),
                _ => vec![parent.nodes.clone()],
            };
            for nodes in parts {
                let number = elements.len() + 1;
                elements.push(Element { number, nodes, ..parent.clone() });
                children.entry(parent.number).or_default().push(number);
            }
        }
        // The lists of contact nodes and of target edges get the new ones.
        let mut description = description.clone();
        if let Some(contact) = &mut description.contact {
            if let Surface::Numbers(nodes) = &mut contact.contact {
                // The outline's edges between listed nodes; those that do not follow the list, as one that
                // closes a surface, come last.
                let listed: HashSet<usize> = nodes.iter().copied().collect();
                let outline = self.model.sides.outline();
                let outline = outline.map(|side| side.nodes.map(NodeId::number));
                let own = outline.filter(|ends| ends.iter().all(|n| listed.contains(n)));
                let own: Vec<[usize; 2]> = own.map(unordered).collect();
                let edges: HashSet<[usize; 2]> = own.iter().copied().collect();
                let follow = |k: usize| Some(unordered([nodes[k], *nodes.get(k + 1)?]));
                let followed: HashSet<[usize; 2]> = (0..nodes.len()).filter_map(follow).collect();
                let half = |ends: [usize; 2]| edges.contains(&ends).then(|| halves[&ends]);
                let along = (0..nodes.len())
                    .flat_map(|k| [Some(nodes[k]), follow(k).and_then(half)])
                    .flatten();
                let rest =
                    own.iter().filter(|ends| !followed.contains(*ends)).map(|ends| halves[ends]);
                *nodes = along.chain(rest).collect();
            }
            if let Surface::Numbers(edges) = &mut contact.target {
                *edges = edges.iter().flat_map(|number| children[number].clone()).collect();
            }
        }
        let (names, adapted) = (mesh.names.clone(), mesh.adapted.clone());
        let finer = Mesh { nodes, elements, names, adapted, in_file: Vec::new() };
        let scene = self.on(description, finer, self.model.dropped.clone())?;
        let parents = parents.into_iter().map(|ends| ends.map(NodeId::from_number));
        Ok(Derived {
            scene,
            nodes: self.model.node_ids().map(|node| [node; 2]).chain(parents).collect(),
            triangles: self.model.triangle_ids().flat_map(|id| [id; 4]).collect(),
        })
    }
}
