//! The status rules on scenes worked out by hand.

use crate::faced;
use engine::contact::search::closest;
use engine::contact::status_rules::statuses;
use engine::contact::{NodeEnd, Pairing, Surfaces, reactions};
use engine::{self, Constraint, Detail, Request};
use nalgebra::DVector;
use numbers::scalar::Scalar;
use paper::door::{self, Call};
use paper::mirror::{Cause, Failure, Pairs, Reading};
use problem::element::Plane;
use problem::model::{EdgeId, Model};
use problem::modelling::StatusRule::{Intersection, Signs};
use problem::modelling::{ContactModel, Coupling, StatusRule, Variant};
use problem::scene::{Axis, Contact, MeshBuilder, Scene, SceneBuilder};
use testing::tolerances::assert_near;

testing::tolerances! {
    /// A closest point, its distance and its normal against the closed form, relative to coordinates of order 1.
    CLOSEST_POINT = 1e-14, "a dozen roundings of 1e-16, of turned coordinates too";
}

const C: f64 = 0.001;

/// A target fan under the surface chain, and a stamp triangle over each contact node.
///
/// ```text
///      q1 *---* q2 = contact node + sides
///          \ /
///   *-------o---*-------*    chain
///     \         |     /
///       `-------*--'         inner
/// ```
fn model(chain: &[[f64; 2]], contact: &[[f64; 2]], sides: [[f64; 2]; 2]) -> Model {
    let mut mesh = MeshBuilder::default();
    let chain = mesh.row(chain.iter().copied());
    let inner = mesh.node([0.0, -5.0]);
    let nodes = mesh.row(contact.iter().copied());
    mesh.edges("surface", &chain);
    mesh.triangles("target", chain.windows(2).map(|edge| [inner, edge[1], edge[0]]));
    for (n, p) in nodes.iter().zip(contact) {
        let [q1, q2] = sides.map(|by| mesh.node([p[0] + by[0], p[1] + by[1]]));
        mesh.triangles("stamp", [[*n, q2, q1]]);
    }
    let scene = SceneBuilder::new("by hand", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("target", 1.0, 0.0)
        .material("stamp", 1.0, 0.0)
        .restrain("target", &[Axis::X, Axis::Y])
        .restrain("stamp", &[Axis::X, Axis::Y])
        .contact(Contact::new(nodes, "surface", C))
        .build();
    (*scene.expect("the scene is sound").model).clone()
}

/// The shape with every point mapped.
fn mapped(model: &Model, map: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[f64; 2]> {
    model.nodes.iter().map(|p| map(*p)).collect()
}

fn turned(degrees: f64) -> impl Fn([f64; 2]) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |[x, y]| [cos * x - sin * y, sin * x + cos * y]
}

fn dy(rule: StatusRule, model: &Model, shape: &[[f64; 2]]) -> Vec<usize> {
    let (sheet, node_n) = (door::worksheet(model, |x| x), door::node_n(model, shape));
    let found = statuses(rule, model, &sheet, &Reading::default(), &node_n);
    let found = found.unwrap_or_else(|failure| panic!("{rule}: {failure}"));
    found.iter().map(|status| usize::from(status.in_contact)).collect()
}

/// The contact pairs in a shape, statuses by `rule`, weights from the shape that R5 names.
fn pairs(
    rule: StatusRule,
    model: &Model,
    reading: &Reading,
    shape: &[[f64; 2]],
) -> Result<Pairs<f64>, Failure> {
    if rule == StatusRule::Signs {
        return Ok(Call::c_cnt(model, reading, shape)?.pairs);
    }
    let (sheet, node_n) = (door::worksheet(model, |x| x), door::node_n(model, shape));
    let statuses = statuses(rule, model, &sheet, reading, &node_n)?;
    door::pairs(model, &sheet, reading, &node_n, &statuses)
}

const UPRIGHT: [[f64; 2]; 2] = [[-0.4, 1.0], [0.4, 1.0]];
const FLAT: &[[f64; 2]] = &[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
const ROOF: &[[f64; 2]] = &[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
const VALLEY: &[[f64; 2]] = &[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]];
const SLOPE: &[[f64; 2]] = &[[-2.0, -0.4], [2.0, 0.4]];

/// Name, chain, contact node; whether it is in contact, and the rules that get that wrong.
type Case = (&'static str, &'static [[f64; 2]], [f64; 2], bool, &'static [StatusRule]);

/// The status of a case by a rule.
fn expected(case: &Case, rule: StatusRule) -> usize {
    let (_, _, _, touches, wrong) = case;
    usize::from(*touches != wrong.contains(&rule))
}

/// Nodes farther than c_tll from the surface: here line 16 has no say.
const FAR: &[Case] = &[
    ("above", FLAT, [0.3, 0.5], false, &[]),
    ("deep", FLAT, [0.3, -0.1], true, &[Signs]),
    ("deep under a node of the surface", FLAT, [0.0, -0.1], true, &[Signs]),
    ("deeper than its element", FLAT, [0.3, -3.0], true, &[Signs, Intersection]),
    ("past the end", FLAT, [1.5, -0.1], false, &[]),
    ("past the end, a side through the flank", FLAT, [1.02, -0.1], false, &[Intersection]),
    ("above a convex corner", ROOF, [0.0, 1.3], false, &[]),
    ("beside a convex corner", ROOF, [0.3, 0.9], false, &[]),
    ("under a convex corner", ROOF, [0.0, 0.9], true, &[Signs]),
    ("above a concave corner", VALLEY, [0.0, 0.3], false, &[]),
    ("under a concave corner", VALLEY, [0.0, -0.1], true, &[Signs]),
    ("above a slope", SLOPE, [1.0, 0.25], false, &[]),
    ("deep under a slope", SLOPE, [1.0, 0.15], true, &[Signs]),
];

/// Nodes no farther than c_tll.
const NEAR: &[Case] = &[
    ("within c_tll", FLAT, [0.3, 0.0005], true, &[]),
    ("on the surface", FLAT, [0.3, 0.0], true, &[]),
    ("just inside", FLAT, [0.3, -0.0005], true, &[]),
    ("past the end, within c_tll", FLAT, [1.0005, -0.0002], true, &[]),
    ("within c_tll of a convex corner", ROOF, [0.0, 1.0005], true, &[]),
];

/// The nodes of `NEAR` and `FAR` upright.
#[test]
fn each_rule_on_hand_made_scenes() {
    for case in NEAR.iter().chain(FAR) {
        let (name, chain, node, ..) = case;
        let model = model(chain, &[*node], UPRIGHT);
        for rule in StatusRule::ALL {
            let found = dy(*rule, &model, &model.nodes);
            assert_eq!(found, [expected(case, *rule)], "{name}, {rule}");
        }
    }
}

/// Mirrored in y and turned, statuses by intersection stay away from line 16's vertical distance (C1, C3).
#[test]
fn intersection_does_not_depend_on_the_axes() {
    for case in FAR {
        let (name, chain, node, ..) = case;
        let model = model(chain, &[*node], UPRIGHT);
        for degrees in [0.0, 30.0, 90.0, 137.0, 180.0, 270.0, 301.0] {
            for mirrored in [false, true] {
                let turn = turned(degrees);
                let shape = mapped(&model, |[x, y]| turn([x, if mirrored { -y } else { y }]));
                let place = format!("{name}, turned by {degrees}, mirrored {mirrored}");
                assert_eq!(
                    dy(Intersection, &model, &shape),
                    [expected(case, Intersection)],
                    "{place}"
                );
            }
        }
    }
}

/// C4: node 1 is apart, node 2 inside. The sign rule takes each for the other, and upside down it
/// does not.
#[test]
fn the_sign_rule_depends_on_which_way_is_up() {
    let model = model(SLOPE, &[[0.8, 0.17], [1.2, 0.23]], UPRIGHT);
    let upside_down = mapped(&model, |[x, y]| [x, -y]);
    assert_eq!(dy(StatusRule::Signs, &model, &model.nodes), [1, 0]);
    assert_eq!(dy(StatusRule::Signs, &model, &upside_down), [0, 1]);
    for shape in [&model.nodes, &upside_down] {
        assert_eq!(dy(Intersection, &model, shape), [0, 1]);
    }
}

/// A vertical edge: line 10, which intersection keeps, divides by zero where the node is in the
/// edge's box.
#[test]
fn a_vertical_edge_stops_what_keeps_line_10() {
    let model = model(&[[-1.0, 0.0], [1.0, 0.0]], &[[0.3, 0.0005]], UPRIGHT);
    let upright = mapped(&model, |[x, y]| [y, -x]);
    for rule in [StatusRule::Signs, StatusRule::Intersection] {
        let failure = pairs(rule, &model, &Reading::default(), &upright).unwrap_err();
        assert_eq!((failure.line, failure.cause), (10, Cause::Singularity), "{rule}");
    }
}

/// Sharp corners, where one of the two edges has the point on its wrong side, whichever comes
/// first.
#[test]
fn the_closest_point_at_a_corner_has_the_right_side() {
    let sharp = [[-0.2, 0.0], [0.0, 1.0], [0.2, 0.0]];
    let notch = [[-0.2, 1.0], [0.0, 0.0], [0.2, 1.0]];
    for (chain, point, is_inside) in [
        (sharp, [-0.1, 1.1], false),
        (sharp, [0.1, 1.1], false),
        (notch, [-0.1, -0.1], true),
        (notch, [0.1, -0.1], true),
    ] {
        let [a, b, c] = chain.map(|[x, y]| [-x, y]);
        for segments in [[[a, b], [b, c]], [[b, c], [a, b]]] {
            let [a, b] = segments[closest(&segments, point).expect("there are two")];
            assert_eq!(f64::orientation(a, b, point) > 0.0, is_inside, "{point:?}");
        }
    }
}

/// Intersection asks the listing for edges and distances alone: where R4 lets its sign rule fail,
/// it does not, and the weights' shape is the one that R5 names.
#[test]
fn intersection_keeps_every_reading_but_that_of_the_sign_rule() {
    let of = |model: &Model, shape: &[[f64; 2]], rule: StatusRule, reading: &str| {
        let (sheet, node_n) = (door::worksheet(model, |x| x), door::node_n(model, shape));
        let found = statuses(rule, model, &sheet, &reading.parse().unwrap(), &node_n);
        found.map(|found| found[0].in_contact).map_err(|failure| failure.line)
    };
    let above = model(FLAT, &[[0.3, 0.0005]], UPRIGHT);
    for (reading, line) in [("R4=eager", 17), ("R4=left-to-right", 18)] {
        assert_eq!(of(&above, &above.nodes, StatusRule::Signs, reading), Err(line));
        assert_eq!(of(&above, &above.nodes, StatusRule::Intersection, reading), Ok(true));
    }
    let upright = model(&[[2.0, 1.0], [2.0, -1.0]], &[[2.0005, 0.3]], UPRIGHT);
    let level = mapped(&upright, |[x, y]| [-y, x]);
    for (reading, expected) in [("", Err(22)), ("R5=node_n", Ok(true))] {
        assert_eq!(of(&upright, &level, StatusRule::Intersection, reading), expected, "{reading}");
    }
}

/// Where a contact node faces the surface: edge, place, gap, and the normal out of the target,
/// turned.
#[test]
fn the_normal_at_the_closest_point() {
    for (point, edge, xi, gap) in [([0.25, 0.5], 2, 0.25, 0.5), ([-0.25, -0.5], 1, 0.75, -0.5)] {
        let model = model(FLAT, &[point], UPRIGHT);
        for degrees in [0.0, 30.0, 90.0, 200.0] {
            let turn = turned(degrees);
            let surfaces = Surfaces::new(&model).unwrap();
            let pairings = surfaces.pairings(Coupling::Nts, &mapped(&model, &turn));
            let pairing = pairings[0].as_ref().expect("it is beside the surface");
            assert_eq!(model.edge(pairing.edge).number, edge);
            let [(_, from_left), _] = pairing.masters[..] else { panic!("an edge has two nodes") };
            assert_near("xi", from_left, xi, 1.0, &CLOSEST_POINT);
            assert_near("gap", pairing.gap, gap, 1.0, &CLOSEST_POINT);
            let normal = turn([0.0, 1.0]);
            assert_near("normal x", pairing.normal[0], normal[0], 1.0, &CLOSEST_POINT);
            assert_near("normal y", pairing.normal[1], normal[1], 1.0, &CLOSEST_POINT);
        }
    }
}

/// A deep node, outside every box (C9), gets the nearest edge and the listing's weights at it.
#[test]
fn a_lost_node_gets_the_nearest_edge_and_its_weights() {
    let model = model(FLAT, &[[0.25, -0.1]], UPRIGHT);
    let node = model.contact.nodes[0].number();
    let found = pairs(Intersection, &model, &Reading::default(), &model.nodes).unwrap();
    assert_eq!(found.ct.as_slice(), [2]);
    let row = |n| found.k_cnt.row(n).copied().collect::<Vec<_>>();
    assert_eq!(row(node), [2.0, 0.75, 3.0, 0.25]);
    let own = node as f64;
    assert_eq!([2, 3].map(row), [[own, 0.75, 0.0, 0.0], [own, 0.25, 0.0, 0.0]]);
}

/// Readings that concern the weights.
const OF_WEIGHTS: [&str; 4] = ["", "R1=inside", "R5=node_n", "R1=inside,R5=node_n"];

/// Where statuses and edges are the listing's, so are the weights, to the last bit, under R1 and
/// R5, and for a node listed twice (C12).
#[test]
fn weights_are_those_of_the_listing() {
    let contact = [[-0.7, 0.0005], [-0.3, -0.0004], [0.2, 0.0], [0.6, 0.0003]];
    let once = model(FLAT, &contact, UPRIGHT);
    let mut twice = once.clone();
    twice.contact.nodes.push(once.contact.nodes[1]);
    for model in [once, twice] {
        let moved = mapped(&model, |[x, y]| [1.01 * x, y]);
        for reading in OF_WEIGHTS {
            let reading: Reading = reading.parse().unwrap();
            let printed = pairs(StatusRule::Signs, &model, &reading, &moved).unwrap();
            assert_eq!(printed.dy.as_slice(), [1].repeat(model.contact.nodes.len()));
            let found = pairs(Intersection, &model, &reading, &moved).unwrap();
            assert_eq!((&found.ct, &found.dy), (&printed.ct, &printed.dy));
            assert_eq!(found.k_cnt, printed.k_cnt, "{reading:?}");
        }
    }
}

/// A run binds its nodes by these weights, each step in the shape that it starts from.
#[test]
fn a_run_binds_by_the_weights_of_its_shapes() {
    let scene = Scene::open("fig1").unwrap();
    for reading in OF_WEIGHTS {
        let reading: Reading = reading.parse().unwrap();
        let request = by_rule(Intersection, &scene).reading(reading);
        let solution = engine::solve(&request, &mut |_| ()).expect("the variant runs");
        let sheet = door::worksheet(&solution.model, |x| x);
        for step in &solution.steps {
            let pairs = pairs(Intersection, &solution.model, &reading, &step.shape).unwrap();
            let Detail::Published(found) = &step.detail else { panic!("stepped searches") };
            assert_eq!(*found, pairs, "{reading:?}, step {}", step.k);
            let bound = door::linked(&sheet, &pairs).into_iter().map(Constraint::from);
            assert_eq!(step.constraints, bound.collect::<Vec<_>>(), "{reading:?}");
        }
    }
}

/// What `stepped` is asked for under a status rule.
fn by_rule(rule: StatusRule, scene: &Scene) -> Request {
    let contact = ContactModel { status: rule, ..scene.contact };
    Request::new(scene).variant(Variant::Stepped).contact(contact)
}

/// The default status rule is what the paper prints.
#[test]
fn signs_are_the_default() {
    let scene = Scene::open("fig1").unwrap();
    let request = Request::new(&scene).variant(Variant::Stepped);
    let solved = |request: &Request| engine::solve(request, &mut |_| ()).unwrap().u;
    assert_eq!(solved(&request), solved(&by_rule(StatusRule::Signs, &scene)));
    assert_eq!(StatusRule::default(), StatusRule::Signs);
}

/// Where a contact node is restrained along x, the restraint's part of its reaction is unknown unless
/// its equation was eliminated, or the normal is vertical; along y likewise; and along both always.
#[test]
fn what_a_restraint_shares_is_no_force_of_contact() {
    let mut model = (*Scene::open("fig1").unwrap().model).clone();
    let node = model.contact.nodes[1];
    let reaction = DVector::from_element(model.dofs(), 3.0);
    let mut of = |restrained: [bool; 2], normal: [f64; 2], eliminated: bool| {
        model.holds.release(node.dofs());
        model.holds.fix(node.dofs().into_iter().filter(|dof| restrained[dof.direction()]));
        let (edge, masters) = (EdgeId::new(0), Vec::new());
        let pairing = Pairing { node, edge, masters, normal, gap: 0.0, length: 1.0, corner: 0.0 };
        reactions(&model, &[Some(pairing), None], &reaction, eliminated)
    };
    let (up, side, tilted) = ([0.0, 1.0], [1.0, 0.0], [0.6, 0.8]);
    assert_eq!(of([false; 2], up, false), [Some([3.0, -3.0]), None]);
    for (restrained, across, along) in [([true, false], up, side), ([false, true], side, up)] {
        assert_eq!(of(restrained, across, false)[0].unwrap()[0], 3.0);
        assert_eq!(of(restrained, tilted, false)[0], None);
        assert_eq!(of(restrained, along, false)[0], None);
        assert!(of(restrained, tilted, true)[0].is_some());
        assert_eq!(of(restrained, along, true)[0].unwrap()[0], 0.0);
    }
    assert_eq!(of([true; 2], up, true)[0], None);
    // A normal so far from the axis is not along it.
    let short = 1.0 - 1e-9;
    assert_eq!(of([true, false], [0.0, short], false)[0], None);
    assert_eq!(of([false, true], [short, 0.0], false)[0], None);
}

/// A stress is a force over the length of the node, a half here, and the thickness; the friction
/// needed is told of nodes that press by more than a hundred thousand millionth of the largest.
#[test]
fn tractions_on_two_nodes_by_hand() {
    let mut model = faced::model(&[&[[1.0, 0.0], [0.0, 0.0]]], &[[0.0, 0.0], [1.0, 0.0]]);
    model.thickness = 4.0;
    let surfaces = Surfaces::new(&model).unwrap();
    let pairings = surfaces.pairings(Coupling::Nts, &model.nodes);
    let of = |forces: [[f64; 2]; 2], in_contact: bool| {
        let u = DVector::zeros(model.dofs());
        surfaces.nodes_at_end((&model, &u), (&model.nodes, &pairings), |i, _| NodeEnd {
            gap: 0.0,
            in_contact,
            status: None,
            force: Some(forces[i]),
        })
    };
    let node = &of([[6.0, -3.0], [0.0, 0.0]], true)[0];
    assert_eq!(
        (node.pressure, node.shear, node.friction_needed),
        (Some(3.0), Some(-1.5), Some(0.5))
    );
    assert_eq!(of([[6.0, -3.0], [0.0, 0.0]], false)[0].friction_needed, None);
    for largest in [1e3, 1e-3] {
        let of = |part: f64| of([[largest, 0.0], [part * largest, 0.0]], true)[1].friction_needed;
        assert_eq!((of(1e-11), of(1.1e-11)), (None, Some(0.0)), "{largest}");
    }
    assert_eq!(of([[0.0, 0.0]; 2], true)[0].friction_needed, None);
}
