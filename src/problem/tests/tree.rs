//! The tree of boxes over the target's edges.

use problem::tree::{Bounds, Tree};

#[test]
fn the_edges_near_a_point_are_found_and_few_others() {
    let edge = |k: usize| (k, [[k as f64, 0.0], [k as f64 + 1.0, 0.0]]);
    let tree = Tree::new((0..1000).map(edge));
    let mut found = Vec::new();
    let near = |b: Bounds| Some(b.distance([500.5, 2.0])).filter(|d| *d <= 2.5);
    tree.visit(&near, &mut |k| found.push(k));
    assert!([499, 500, 501].iter().all(|k| found.contains(k)));
    assert!(found.len() < 20, "{found:?}");
    assert!(Tree::new([]).bounds().is_none());
}
