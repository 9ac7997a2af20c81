//! What contact nodes face at the limits of the rules, worked out by hand: which edges count, how little of an edge, the
//! nearest of two, a surface's end, its bends and its tips.
//!
//! In `faced.txt` a coupling stands before a line of the target's chains, ` / ` between them, and of the contact surface,
//! or its one node; `reversed` lists the target's edges from the last. INSTA_UPDATE=always writes what is faced anew.

use engine::contact::{Pairing, Surfaces};
use problem::model::Model;
use problem::modelling::{ContactModel, Coupling};
use problem::scene::Axis;

use testing::bodies::{Bodies, Writing};
use testing::golden_file::assert_rows_by;
use testing::same_text::same_text;

type Chain<'a> = &'a [[f64; 2]];

/// Surfaces along chains of points with the body on the left, a triangle at each edge: the target's
/// nodes are numbered from 0, chain by chain, then the contact surface's, then the others.
pub fn model(target: &[Chain], contact: Chain) -> Model {
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    let mut edges = |chain: Chain| {
        let first = nodes.len();
        nodes.extend(chain);
        (first..nodes.len() - 1).map(|n| [n, n + 1]).collect::<Vec<_>>()
    };
    let target: Vec<[usize; 2]> = target.iter().flat_map(|chain| edges(chain)).collect();
    let contact = edges(contact);
    let mut inner = |&[a, b]: &[usize; 2]| {
        let ([ax, ay], [bx, by]) = (nodes[a], nodes[b]);
        // So flat that the triangles at a sharp tip do not overlap.
        let [across, along] = [(by - ay) / 256.0, (bx - ax) / 256.0];
        nodes.push([(ax + bx) / 2.0 - across, (ay + by) / 2.0 + along]);
        [a, b, nodes.len() - 1]
    };
    let triangles = [&target, &contact].map(|edges| edges.iter().map(&mut inner).collect());
    let held = (0..nodes.len()).map(|n| (n, vec![Axis::X, Axis::Y])).collect();
    let bodies = Bodies {
        nodes,
        triangles,
        moduli: [(1.0, 0.0); 2],
        contact: (contact[0][0]..=contact[contact.len() - 1][1]).collect(),
        target,
        restrained: held,
        loads: Vec::new(),
    };
    let scene = bodies.modelled(&Writing::default(), ContactModel::default()).build();
    (*scene.expect("the scene is sound").model).clone()
}

#[test]
fn what_is_faced_by_hand() {
    assert_rows_by("tests/faced.txt", same_text, faced);
}

/// Returns a line for each contact node of a row.
fn faced(row: &str) -> String {
    let (how, surfaces) = row.split_once(": ").expect("a coupling");
    let (target, contact) = surfaces.split_once(" | ").expect("two surfaces");
    let number = |x: &str| x.parse::<f64>().expect("a number");
    let point = |p: &str| p.split_once(',').map(|(x, y)| [number(x), number(y)]).expect("a point");
    let chain = |points: &str| points.split(' ').map(point).collect::<Vec<_>>();
    let target: Vec<_> = target.split(" / ").map(chain).collect();
    let target: Vec<Chain> = target.iter().map(Vec::as_slice).collect();
    let mut model = match chain(contact)[..] {
        [[x, y]] => model(&target, &[[x, y], [x + 1.0, y]]),
        ref contact => model(&target, contact),
    };
    if !contact.contains(' ') {
        model.contact.nodes.truncate(1);
    }
    if how.ends_with("reversed") {
        model.contact.target.reverse();
    }
    let coupling = how.split(' ').next().and_then(|name| name.parse().ok());
    let surfaces = Surfaces::new(&model).expect("edges of the outline");
    let pairings = surfaces.pairings(coupling.expect("a coupling"), &model.nodes);
    pairings.iter().map(|pairing| line(pairing.as_ref())).collect::<Vec<_>>().join("\n")
}

fn line(pairing: Option<&Pairing>) -> String {
    let Some(Pairing { edge, masters, normal: [x, y], gap, length, .. }) = pairing else {
        return "faces nothing".to_owned();
    };
    let masters = masters.iter().map(|(node, w)| format!("{w:.14} of node {}", node.index()));
    let masters = masters.collect::<Vec<_>>().join(", ");
    let edge = edge.index();
    format!("edge {edge}: {masters}; gap {gap:.14} along {x:.14} {y:.14}, length {length:.14}")
}

/// One edge alone has no tip: where it did not face a node in the undeformed shape, it never does.
#[test]
fn an_edge_alone_has_no_tip() {
    let model = model(&[&[[0.0, -1.0], [0.0, 0.0]]], &[[0.0, 0.0], [1.0, 0.0]]);
    let mut shape = model.nodes.clone();
    (shape[0], shape[1]) = ([1.5, 0.25], [-0.5, 0.25]);
    let surfaces = Surfaces::new(&model).expect("edges of the outline");
    assert_eq!(surfaces.pairings(Coupling::Nts, &shape), [None, None]);
}
