//! A tree of boxes around edges: the edges near a point, or across a strip, without a look at all.

pub use super::model::Bounds;

/// A point or a direction: x and y.
type Vector = [f64; 2];

/// The most edges of a box that is not divided.
const LEAF: usize = 4;

/// Boxes around edges, each divided in two halves of as many edges.
pub struct Tree {
    /// Each edge's place in the list that the tree was built from, in the order of the leaves.
    edges: Vec<usize>,
    /// The root first; the two halves of a divided box stand at `halves` and behind it.
    boxes: Vec<Divided>,
}

struct Divided {
    bounds: Bounds,
    from: usize,
    to: usize,
    halves: Option<usize>,
}

impl Bounds {
    /// Returns the distance from `p`, length; 0 inside.
    pub fn distance(self, p: Vector) -> f64 {
        let [x, y] = [0, 1].map(|d| (self.low[d] - p[d]).max(p[d] - self.high[d]).max(0.0));
        // Beside a box that is one of them.
        if x.min(y) == 0.0 { x.max(y) } else { x.hypot(y) }
    }

    /// Returns the least and the largest of (x − `from`)·`direction` over its points x.
    pub fn along(self, from: Vector, direction: Vector) -> [f64; 2] {
        let ends = |d: usize| [self.low[d], self.high[d]].map(|x| (x - from[d]) * direction[d]);
        let ([a, b], [c, d]) = (ends(0), ends(1));
        [a.min(b) + c.min(d), a.max(b) + c.max(d)]
    }
}

impl Tree {
    /// Builds the tree over edges, each given by its number and its two ends.
    pub fn new(edges: impl IntoIterator<Item = (usize, [Vector; 2])>) -> Self {
        let mut bounds: Vec<(usize, Bounds)> =
            edges.into_iter().map(|(k, ends)| (k, Bounds::around(&ends))).collect();
        let mut tree = Tree { edges: Vec::new(), boxes: Vec::new() };
        if !bounds.is_empty() {
            tree.boxes.push(Divided::over(&bounds, 0));
            tree.divide(0, &mut bounds, 0);
        }
        tree.edges = bounds.into_iter().map(|(k, _)| k).collect();
        tree
    }

    /// Divides box `at` over `bounds`, of which the first is edge number `from` of the leaves.
    fn divide(&mut self, at: usize, bounds: &mut [(usize, Bounds)], from: usize) {
        if bounds.len() <= LEAF {
            return;
        }
        let Bounds { low, high } = self.boxes[at].bounds;
        let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
        let half = bounds.len() / 2;
        let key = |(k, b): &(usize, Bounds)| ((b.low[axis] + b.high[axis]) / 2.0, *k);
        bounds.select_nth_unstable_by(half, |a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        });
        let (left, right) = bounds.split_at_mut(half);
        let first = self.boxes.len();
        self.boxes[at].halves = Some(first);
        self.boxes.push(Divided::over(left, from));
        self.boxes.push(Divided::over(right, from + half));
        self.divide(first, left, from);
        self.divide(first + 1, right, from + half);
    }

    /// Returns the box around all edges; None without an edge.
    pub fn bounds(&self) -> Option<Bounds> {
        self.boxes.first().map(|root| root.bounds)
    }

    /// Calls `found` with each edge in the boxes for which `key` returns a number, those of the
    /// smaller number first; `key` is asked again when a box's turn comes.
    pub fn visit(&self, key: &impl Fn(Bounds) -> Option<f64>, found: &mut impl FnMut(usize)) {
        if !self.boxes.is_empty() {
            self.visit_box(0, key, found);
        }
    }

    /// Calls `found` with each edge in the boxes that meet another one.
    pub fn visit_in(&self, near: Bounds, found: &mut impl FnMut(usize)) {
        self.visit(&|bounds: Bounds| bounds.meets(near).then_some(0.0), found);
    }

    fn visit_box(
        &self,
        at: usize,
        key: &impl Fn(Bounds) -> Option<f64>,
        found: &mut impl FnMut(usize),
    ) {
        let Divided { bounds, from, to, halves } = self.boxes[at];
        if key(bounds).is_none() {
            return;
        }
        let Some(first) = halves else {
            return self.edges[from..to].iter().for_each(|k| found(*k));
        };
        let [left, right] = [first, first + 1].map(|half| key(self.boxes[half].bounds));
        let order = if right < left { [first + 1, first] } else { [first, first + 1] };
        order.into_iter().for_each(|half| self.visit_box(half, key, found));
    }
}

impl Divided {
    /// Returns the box over `bounds`, undivided.
    fn over(bounds: &[(usize, Bounds)], from: usize) -> Self {
        let around = Bounds::around(bounds.iter().flat_map(|(_, b)| [&b.low, &b.high]));
        Divided { bounds: around, from, to: from + bounds.len(), halves: None }
    }
}
