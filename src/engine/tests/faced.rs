//! What contact nodes face at the limits of the rules, worked out by hand: which edges count, how
//! little of an edge, the nearest of two, a surface's end, its bends and its tips.

use engine::contact::{Pairing, Surfaces};
use problem::model::{Model, NodeId};
use problem::modelling::{ContactModel, Coupling};
use problem::scene::Axis;

use testing::bodies::{Bodies, Writing};
use testing::tolerances::{CLOSEST_POINT, assert_near};

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

fn faced(model: &Model, coupling: Coupling) -> Vec<Option<Pairing>> {
    Surfaces::new(model).expect("edges of the outline").pairings(coupling, &model.nodes)
}

/// The nodes of the target that a contact node is bound to.
fn masters(pairing: Option<&Pairing>) -> Vec<usize> {
    let masters = pairing.into_iter().flat_map(|pairing| &pairing.masters);
    masters.map(|(node, _)| node.index()).collect()
}

/// The contact surface of most tests: an edge of length 1, whose body lies above.
const UNIT: Chain = &[[0.0, 0.0], [1.0, 0.0]];

/// A cosine of −0.1 between the normals still faces under mortar.
#[test]
fn edges_face_each_other_down_to_a_cosine_of_a_tenth() {
    for (height, faces) in [(99.0_f64.sqrt(), true), (9.9, true), (10.0, false)] {
        let model = model(&[&[[1.0, -height], [0.0, 0.0]]], UNIT);
        let found = faced(&model, Coupling::Mortar);
        assert_eq!(found.iter().all(Option::is_some), faces, "{height}");
    }
}

/// A number near `guess` for which `is_wanted` holds to the last bit.
fn near(guess: f64, is_wanted: impl Fn(f64) -> bool) -> f64 {
    let mut around = (0..4096).map(|k| f64::from_bits(guess.to_bits() - 2048 + k));
    around.find(|x| is_wanted(*x)).expect("one of them is")
}

/// A part of a contact edge, and the edge's length, over which it is 1e-12 to the last bit.
fn rounding() -> (f64, f64) {
    let part = 2.0_f64.powi(-40);
    (part, near(part / 1e-12, |length| part / length == 1e-12))
}

/// A part of a contact edge of a millionth of a millionth, which rounding may leave, covers
/// nothing: neither an edge that reaches so far, nor one that is free so far beside a nearer one.
#[test]
fn a_part_of_an_edge_that_is_rounding_does_not_count() {
    let (sliver, length) = rounding();
    let contact = [[0.0, 0.0], [length, 0.0]];
    for (target, expected) in [
        ([[[sliver, -0.25], [-1.0, -0.25]], [[2.0, -0.5], [sliver, -0.5]]], vec![2, 3]),
        ([[[2.0, -0.25], [sliver, -0.25]], [[2.0, -0.5], [-1.0, -0.5]]], vec![0, 1]),
        ([[[2.0, -0.5], [sliver, -0.5]], [[2.0, -0.25], [-1.0, -0.25]]], vec![2, 3]),
    ] {
        let model = model(&[&target[0], &target[1]], &contact);
        for pairing in &faced(&model, Coupling::Mortar) {
            assert_eq!(masters(pairing.as_ref()), expected);
        }
    }
}

/// Of two target edges a contact edge covers the one that is nearer along its own normal, in the
/// middle of what both face.
#[test]
fn of_two_target_edges_the_nearer_one_counts() {
    let flat = |depth: f64| [[1.0, -depth], [0.0, -depth]];
    let sloped = |left: f64, right: f64| [[1.0, -right], [0.0, -left]];
    for (one, other, nearer) in [
        (flat(0.5), sloped(0.1, 0.7), 1),
        (flat(0.5), sloped(0.7, 0.1), 1),
        (flat(0.5), sloped(0.3, 0.9), 0),
        (flat(0.5), sloped(0.9, 0.3), 0),
        // Steep: its distance across itself is less than that along the contact edge's normal.
        (flat(0.5), sloped(0.1, 1.1), 0),
        (flat(0.5), sloped(1.1, 0.1), 0),
    ] {
        for (edges, nearer) in [([one, other], nearer), ([other, one], 1 - nearer)] {
            let model = model(&[&edges[0], &edges[1]], UNIT);
            let expected = vec![2 * nearer, 2 * nearer + 1];
            for pairing in &faced(&model, Coupling::Mortar) {
                assert_eq!(masters(pairing.as_ref()), expected, "{edges:?}");
            }
        }
    }
}

/// Two target edges as near as each other: the one that is named first counts.
#[test]
fn of_two_target_edges_as_near_as_each_other_the_first_counts() {
    let edge = [[1.0, -0.5], [0.0, -0.5]];
    let found = faced(&model(&[&edge, &edge], UNIT), Coupling::Mortar);
    assert_eq!(masters(found[0].as_ref()), [0, 1]);
}

/// A nearer target edge leaves a farther one the rest of the contact edge alone: what both cover
/// counts once.
#[test]
fn what_two_target_edges_cover_counts_once() {
    let near: Chain = &[[2.0, -0.1], [0.4, -0.1]];
    let far: Chain = &[[2.0, -0.42], [-1.0, 0.18]];
    for target in [[near, far], [far, near]] {
        for pairing in faced(&model(&target, UNIT), Coupling::Mortar) {
            let pairing = pairing.expect("it is covered");
            assert_near("length", pairing.length, 0.5, 1.0, &CLOSEST_POINT);
            let sum = pairing.masters.iter().map(|(_, weight)| weight).sum();
            assert_near("weights", sum, 1.0, 1.0, &CLOSEST_POINT);
        }
    }
}

/// Behind a jump of the target a contact edge covers nothing: here 0 to 0.5, of which node 0 has 3/8 and node 1 1/8.
/// What lies before the nearer edge's line, or meets it, is covered.
#[test]
fn what_lies_behind_a_jump_is_not_covered() {
    let near: Chain = &[[2.0, -0.1], [0.5, -0.1]];
    for (end, lengths) in [(-0.1, [0.5, 0.5]), (-0.1001, [0.125, 0.375]), (-0.9, [0.125, 0.375])] {
        let far = [[0.5, end], [-1.0, end]];
        for target in [[near, &far], [&far, near]] {
            let found = faced(&model(&target, UNIT), Coupling::Mortar);
            for (pairing, length) in found.into_iter().zip(lengths) {
                let pairing = pairing.expect("it is covered");
                assert_near("length", pairing.length, length, 1.0, &CLOSEST_POINT);
            }
        }
    }
}

/// A node rests on the last edge's line as far as a twentieth of the edge past its end.
#[test]
fn a_node_hangs_over_the_end_by_a_twentieth_of_the_last_edge() {
    for (x, rests) in [(1.05, true), (1.0501, false)] {
        for right in [1.0, -1.0] {
            let target = [[1.0, 0.0], [0.0, 0.0]].map(|[x, y]| [right * x, y]);
            let contact = [[0.5, 0.0], [x, 0.0]].map(|[x, y]| [right * x, y]);
            let (target, contact) = match right {
                1.0 => (target, contact),
                _ => ([target[1], target[0]], [contact[1], contact[0]]),
            };
            let found = faced(&model(&[&target], &contact), Coupling::Nts);
            let last = if right == 1.0 { 1 } else { 0 };
            assert_eq!(found[last].is_some(), rests, "{x}");
            assert!(found[1 - last].is_some());
        }
    }
}

/// One edge alone has no tip: where it did not face a node in the undeformed shape, it never does.
#[test]
fn an_edge_alone_has_no_tip() {
    let model = model(&[&[[0.0, -1.0], [0.0, 0.0]]], UNIT);
    let mut shape = model.nodes.clone();
    (shape[0], shape[1]) = ([1.5, 0.25], [-0.5, 0.25]);
    let surfaces = Surfaces::new(&model).expect("edges of the outline");
    assert_eq!(surfaces.pairings(Coupling::Nts, &shape), [None, None]);
}

/// A single contact node, which faces every edge, at `p`.
fn alone(target: &[Chain], p: [f64; 2]) -> Pairing {
    let mut model = model(target, &[p, [p[0] + 1.0, p[1]]]);
    model.contact.nodes.truncate(1);
    faced(&model, Coupling::Nts).remove(0).expect("it faces every edge")
}

/// At a vertex the edge whose line is farther from the node is named; of those as far, up to the
/// tolerance and with it, that with the lower nodes, in whichever order they are listed.
#[test]
fn the_edge_at_a_vertex_does_not_depend_on_the_order_of_the_edges() {
    let corner = [[0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]];
    let [flank, top] = [0, 1];
    for (x, y, edge) in [
        (0.0, 0.0, flank),
        (0.0, 0.5e-9, flank),
        (0.0, 1e-9, flank),
        (1e-9, 0.0, flank),
        (0.2, 0.1, flank),
        (0.1, 0.2, top),
    ] {
        let model = |reversed: bool| {
            let mut model = model(&[&corner], &[[x, y], [x + 1.0, y]]);
            model.contact.nodes.truncate(1);
            if reversed {
                model.contact.target.reverse();
            }
            model
        };
        for model in [false, true].map(model) {
            let found = faced(&model, Coupling::Nts).remove(0).expect("it faces every edge");
            assert_eq!(found.edge.index(), edge, "{x}, {y}");
            assert_eq!(found.masters, [(NodeId::new(1), 1.0)]);
        }
    }
}

/// Where the normals of two edges have a cosine of 0.866 they meet in a corner: beside it the
/// normal is the edge's own, and over it the vertex alone is faced. With a larger cosine they meet
/// in a bend: the normal turns, and over it the end of an edge is faced.
#[test]
fn edges_meet_in_a_corner_up_to_the_limit_of_a_bend() {
    for (cosine, turns) in [(0.866_f64, false), (0.86601, true)] {
        let [start, end] = [[1.0, 0.0], [0.0, 0.0]];
        // A length of 1 to the last bit.
        let rise = (1.0 - cosine * cosine).sqrt();
        assert_eq!(cosine.hypot(rise), 1.0);
        let pairing = alone(&[&[start, end, [-cosine, -rise]]], [0.25, 0.125]);
        assert_eq!(masters(Some(&pairing)), [0, 1]);
        assert_eq!(pairing.normal != [0.0, 1.0], turns, "{cosine}");
        let over = alone(&[&[start, end, [-cosine, -rise]]], [-rise / 4.0, (1.0 + cosine) / 4.0]);
        assert_eq!(masters(Some(&over)).len(), if turns { 2 } else { 1 }, "{cosine}");
    }
}

/// A node beside a tip's flank faces the tip where that is its nearer end, from the middle too, whichever
/// way the edge is gone along.
#[test]
fn a_tip_is_found_from_the_middle_of_either_flank() {
    for (height, is_faced) in [(10.0, false), (20.0, true), (30.0, true)] {
        for mirror in [1.0, -1.0] {
            let mut target = [[0.0, 0.0], [0.0, 40.0], [-1.0, 10.0]].map(|[x, y]| [mirror * x, y]);
            let mut contact = [[-0.05, height], [0.95, height]].map(|[x, y]| [mirror * x, y]);
            if mirror < 0.0 {
                target.reverse();
                contact.reverse();
            }
            let mut found = faced(&model(&[&target], &contact), Coupling::Nts);
            if mirror < 0.0 {
                found.reverse();
            }
            let found = found.iter().map(Option::is_some).collect::<Vec<_>>();
            assert_eq!(found, [is_faced, false], "{height} {mirror}");
        }
    }
}
