//! A scene on a finer mesh: every triangle is split in four, every edge in two.
//!
//! ```text
//!          c                   new nodes halve the edges; the outline stays the same polygon,
//!        / \                   because only the corners of a curved surface are known.
//!      ca---bc
//!      / \  / \
//!     a---ab---b
//! ```

use std::collections::HashMap;

use super::Scene;
use super::description::Description;
use super::mesh::{Element, Mesh, Node, NodeNumbers};
use super::surface::Surface;
use crate::model::NodeId;
use base::error::Result;

/// A finer scene. Nodes keep their numbers; triangle n (row of `EL`) becomes 4n − 3 .. 4n.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The finer scene.
    pub scene: Scene,
    /// The ends of the edge that each new node halves, from node R + 1 on.
    pub parents: Vec<[NodeId; 2]>,
}

impl Scene {
    /// Returns the scene on a mesh of half the element size, with everything else unchanged; None
    /// for half a scene, which has no mesh. A restraint or a force on a single node stays on that
    /// node.
    ///
    /// # Errors
    /// The finer scene cannot be built.
    pub fn refined(&self) -> Result<Option<Refined>> {
        let Some(source) = &self.source else { return Ok(None) };
        let (file, mesh) = (&source.description, &source.mesh);
        let halves = Halves::new(mesh);
        let (elements, children) = halves.elements(mesh);
        let mut nodes = mesh.nodes.clone();
        for [a, b] in &halves.parents {
            let xyz =
                [0, 1, 2].map(|d| (mesh.nodes[a - 1].xyz[d] + mesh.nodes[b - 1].xyz[d]) / 2.0);
            nodes.push(Node { number: nodes.len() + 1, xyz });
        }
        let (names, adapted) = (mesh.names.clone(), mesh.adapted.clone());
        let finer = Mesh { nodes, elements, names, adapted, in_file: Vec::new() };
        let file = halves.renumbered(file, &children);
        let mut scene = Scene::assemble(&self.name, file, finer, self.model.dropped.clone())?;
        (scene.variant, scene.contact) = (self.variant, self.contact);
        scene.word.clone_from(&self.word);
        scene.iterations = self.iterations;
        let parents = halves.parents.into_iter().map(|ends| ends.map(NodeId::from_number));
        Ok(Some(Refined { scene, parents: parents.collect() }))
    }
}

/// The new nodes of a refined mesh.
struct Halves {
    parents: Vec<[usize; 2]>,
    /// The node that halves each edge, by the edge's nodes, ascending.
    node: HashMap<[usize; 2], usize>,
}

impl Halves {
    fn new(mesh: &Mesh) -> Self {
        let mut halves = Halves { parents: Vec::new(), node: HashMap::new() };
        for element in &mesh.elements {
            let nodes = &element.nodes;
            match nodes.len() {
                3 => (0..3).for_each(|k| halves.add(mesh, nodes[k], nodes[(k + 1) % 3])),
                2 => halves.add(mesh, nodes[0], nodes[1]),
                _ => (),
            }
        }
        halves
    }

    fn add(&mut self, mesh: &Mesh, a: usize, b: usize) {
        let key = [a.min(b), a.max(b)];
        if !self.node.contains_key(&key) {
            self.parents.push(key);
            self.node.insert(key, mesh.nodes.len() + self.parents.len());
        }
    }

    fn between(&self, a: usize, b: usize) -> Option<usize> {
        self.node.get(&[a.min(b), a.max(b)]).copied()
    }

    /// Returns the elements, numbered from 1, with children in the place of their parent, and the
    /// children's numbers by the parent's.
    fn elements(&self, mesh: &Mesh) -> (Vec<Element>, HashMap<usize, Vec<usize>>) {
        let (mut elements, mut children) = (Vec::new(), HashMap::new());
        for parent in &mesh.elements {
            for nodes in self.split(&parent.nodes) {
                let number = elements.len() + 1;
                elements.push(Element { number, nodes, ..parent.clone() });
                children.entry(parent.number).or_insert_with(Vec::new).push(number);
            }
        }
        (elements, children)
    }

    fn split(&self, nodes: &[usize]) -> Vec<NodeNumbers> {
        let half = |a, b| self.between(a, b).expect("every edge is halved");
        match *nodes {
            [a, b, c] => {
                let [ab, bc, ca] = [half(a, b), half(b, c), half(c, a)];
                let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
                parts.map(NodeNumbers::from).to_vec()
            }
            [a, b] => [[a, half(a, b)], [half(a, b), b]].map(|ends| ends[..].into()).to_vec(),
            _ => vec![nodes.into()],
        }
    }

    /// Returns the description with its lists of contact nodes and target edges refined.
    fn renumbered(&self, file: &Description, children: &HashMap<usize, Vec<usize>>) -> Description {
        let mut file = file.clone();
        let Some(contact) = &mut file.contact else { return file };
        if let Surface::Numbers(nodes) = &mut contact.contact {
            let mut finer = Vec::new();
            for (k, n) in nodes.iter().enumerate() {
                finer.push(*n);
                finer.extend(nodes.get(k + 1).and_then(|next| self.between(*n, *next)));
            }
            *nodes = finer;
        }
        if let Surface::Numbers(edges) = &mut contact.target {
            *edges = edges.iter().flat_map(|number| children[number].clone()).collect();
        }
        file
    }
}
