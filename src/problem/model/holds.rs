//! What holds nodes in their places: directions along which their displacements are given.
//!
//! A node has at most two directions. A third one is left out where the two determine it.

use serde::Serialize;
use std::collections::HashSet;

use super::ids::{Dof, NodeId};

/// A displacement of a node that is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hold {
    /// The node.
    pub node: NodeId,
    /// The direction, of length 1.
    pub direction: [f64; 2],
    /// The displacement along it at the end of the first stage, length.
    pub displacement: f64,
    /// The place of the restraint in the scene that gives it; None for a node that belongs to no triangle,
    /// and on a line of symmetry.
    pub restraint: Option<usize>,
}

impl Hold {
    /// Returns the degree of freedom that is 0; None along another direction than an axis, and for another
    /// displacement than 0.
    pub fn dof(&self) -> Option<Dof> {
        let [x, y] = self.node.dofs();
        match self.direction {
            _ if self.displacement != 0.0 => None,
            [_, 0.0] => Some(x),
            [0.0, _] => Some(y),
            [_, _] => None,
        }
    }
}

/// What holds the nodes of a model: that of a node is in the order of the scene's restraints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Holds {
    /// By node.
    all: Vec<Hold>,
    /// Where those of each node start, and where the last ones end.
    starts: Vec<u32>,
}

impl Holds {
    /// Collects what holds some of so many nodes: of each the first two.
    pub fn new(nodes: usize, mut all: Vec<Hold>) -> Self {
        all.sort_by_key(|hold| hold.node);
        let mut before = [None; 2];
        all.retain(|hold| {
            let is_third = before == [Some(hold.node); 2];
            before = [before[1], Some(hold.node)];
            !is_third
        });
        let start = |node: usize| all.partition_point(|hold| hold.node.index() < node) as u32;
        let starts = (0..=nodes).map(start).collect();
        Holds { all, starts }
    }

    /// Returns what holds the nodes that `number` numbers anew, of which there are `nodes`.
    pub fn renumbered(&self, nodes: usize, number: impl Fn(NodeId) -> Option<NodeId>) -> Self {
        let own =
            self.all.iter().filter_map(|hold| Some(Hold { node: number(hold.node)?, ..*hold }));
        Holds::new(nodes, own.collect())
    }

    /// Returns the number of nodes, held or not.
    pub fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns all of them, by node.
    pub fn iter(&self) -> std::slice::Iter<'_, Hold> {
        self.all.iter()
    }

    /// Returns what holds a node.
    pub fn of(&self, node: NodeId) -> &[Hold] {
        let [from, to] = [0, 1].map(|k| self.starts[node.index() + k] as usize);
        &self.all[from..to]
    }

    /// Returns whether a node is displaced.
    pub fn displace(&self) -> bool {
        self.all.iter().any(|hold| hold.displacement != 0.0)
    }

    /// Returns the displacement along a degree of freedom where it is given, length.
    pub fn given(&self, dof: Dof) -> Option<f64> {
        let d = dof.direction();
        match self.of(dof.node()) {
            [a, b] => Some(crossing([a, b])[d]),
            [one] if one.direction[1 - d] == 0.0 => Some(one.direction[d] * one.displacement),
            _ => None,
        }
    }

    /// Returns what alone holds a node, and along no axis: neither of its displacements is given.
    pub fn oblique(&self, node: NodeId) -> Option<&Hold> {
        match self.of(node) {
            [one] if !one.direction.contains(&0.0) => Some(one),
            _ => None,
        }
    }

    /// Returns whether a force along a degree of freedom may be one of what holds its node.
    pub fn takes(&self, dof: Dof) -> bool {
        self.of(dof.node()).iter().any(|hold| hold.direction[dof.direction()] != 0.0)
    }

    /// Holds degrees of freedom at 0, unless they are given.
    pub fn fix(&mut self, dofs: impl IntoIterator<Item = Dof>) {
        let hold = |dof: Dof| {
            let direction = [0, 1].map(|d| if d == dof.direction() { 1.0 } else { 0.0 });
            Hold { node: dof.node(), direction, displacement: 0.0, restraint: None }
        };
        let free = dofs.into_iter().filter(|dof| self.given(*dof).is_none());
        let all = self.all.iter().copied().chain(free.map(hold)).collect();
        *self = Holds::new(self.nodes(), all);
    }

    /// Takes away what holds degrees of freedom at 0.
    pub fn release(&mut self, dofs: impl IntoIterator<Item = Dof>) {
        let dofs: HashSet<Dof> = dofs.into_iter().collect();
        let is_left = |hold: &&Hold| hold.dof().is_none_or(|dof| !dofs.contains(&dof));
        *self = Holds::new(self.nodes(), self.all.iter().filter(is_left).copied().collect());
    }

    /// Adds a node that nothing holds.
    pub fn add_node(&mut self) {
        self.starts.push(self.all.len() as u32);
    }
}

/// Returns the displacement of a node that is held along two directions, length.
pub(crate) fn crossing([a, b]: [&Hold; 2]) -> [f64; 2] {
    let ([ax, ay], [bx, by]) = (a.direction, b.direction);
    let (p, q, cross) = (a.displacement, b.displacement, ax * by - ay * bx);
    [(p * by - q * ay) / cross, (q * ax - p * bx) / cross]
}
