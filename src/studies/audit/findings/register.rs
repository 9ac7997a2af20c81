//! The findings (`listings/READING.md`, section 5).

use super::{Finding, Preparation, Repair, search, status, stiffness, weights};
use engine::contact::turned;
use paper::findings::FindingId;
use paper::listings::Which;
use problem::model::Model;

/// A repair that is a file in `listings/`.
macro_rules! edit {
    ($file:literal) => {
        Repair::Edit { text: include_str!(concat!("../../../../listings/", $file)) }
    };
}

/// All findings, in the order of their ids.
pub const FINDINGS: &[Finding] = &[
    Finding {
        id: FindingId::C1,
        listing: Some(Which::CCnt),
        lines: &[5, 6],
        title: "the search box grows by c_tll for an edge that runs towards +x (+y) and shrinks by \
                c_tll for one that runs the other way",
        why: "the direction in which a mesh generator happened to write an edge decides who is in \
              contact",
        repair: "order the two coordinates first: min − c_tll .. max + c_tll",
        edit: edit!("repairs/C1.edit"),
        before: Preparation::Model("each target edge reversed", |model| *model = turned(model)),
        number: "contact nodes that get or lose a target edge or dy = 1 once every target edge is reversed",
        measure: search::turned_edges,
    },
    Finding {
        id: FindingId::C2,
        listing: Some(Which::CCnt),
        lines: &[7],
        title: "the loop over the target edges does not stop at a hit: where boxes overlap, the \
                last edge in trg wins",
        why: "the order of trg, which the text never mentions, decides which edge a node near a \
              joint is tied to",
        repair: "keep the edge with the smallest distance",
        edit: edit!("repairs/C2.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes with another target edge once trg is reversed",
        measure: search::reversed_target,
    },
    Finding {
        id: FindingId::C3,
        listing: Some(Which::CCnt),
        lines: &[10],
        title: "the distance is vertical, not normal",
        why: "on a slope of angle t the tolerance acts as c_tll · cos t, and a vertical edge \
              divides by zero",
        repair: "project on the edge's normal",
        edit: edit!("repairs/C3.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes nearer than c_tll along the normal that are not in contact",
        measure: search::vertical_distance,
    },
    Finding {
        id: FindingId::C4,
        listing: Some(Which::CCnt),
        lines: &[17, 18],
        title: "the sign rule is one-sided: it flags a node with yt < 0 beside one with yt > 0, \
                never the other",
        why: "with the target below the stamp it takes the separated node and leaves the one that \
              went in; upside down it is the other way round",
        repair: "flag the node that is inside, by the side on which the target lies",
        edit: edit!("repairs/C4.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes, their target edge unchanged, whose dy changes once the scene is \
                 turned upside down",
        measure: status::upside_down,
    },
    Finding {
        id: FindingId::C5,
        listing: Some(Which::CCnt),
        lines: &[17, 18],
        title: "the sign rule compares neighbours only: in a run of nodes deeper inside than c_tll \
                it sees the ends, or nothing",
        why: "a step that carries two neighbours in loses both, for good",
        repair: "flag every node that is inside",
        edit: edit!("repairs/C5.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes in runs of two or more deeper inside than c_tll that are not \
                 flagged",
        measure: status::deep_runs,
    },
    Finding {
        id: FindingId::C6,
        listing: Some(Which::CCnt),
        lines: &[22, 23],
        title: "the weights come from initial coordinates, the partners from current ones",
        why: "after sliding over an edge's end the weights leave [0, 1] and extrapolate",
        repair: "node_n in place of node (reading R5)",
        edit: Repair::None {
            reason: "the first call, which a lesson shows, has both tables the same, since nothing has \
                     moved; solve findings/C6 --reading R5=node_n has all iterations with weights \
                     within [0, 1]",
        },
        before: Preparation::AsPrinted,
        number: "largest excess of a weight of a node in contact beyond [0, 1]",
        measure: weights::outside_the_edge,
    },
    Finding {
        id: FindingId::C7,
        listing: Some(Which::CCnt),
        lines: &[27, 28, 29, 30],
        title: "a target node keeps the last contact node's number and the sum of all weights; its \
                columns 3 and 4 are never set",
        why: "the text promises two pairs for every node; Km puts the weights of all on the last",
        repair: "as K1: the pairs of the contact nodes are enough",
        edit: edit!("repairs/K1.edit"),
        before: Preparation::AsPrinted,
        number: "target nodes to which two or more contact nodes are tied",
        measure: weights::shared_nodes,
    },
    Finding {
        id: FindingId::C8,
        listing: Some(Which::CCnt),
        lines: &[16],
        title: "the comparison is strict: with c_tll = 0 line 16 flags nothing; lines 17 and 18 \
                still can, over sloping edges",
        why: "a node exactly on its edge is not in contact while a separated one beside it may be",
        repair: "≤ in place of <",
        edit: edit!("repairs/C8.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes exactly on their edge that are not flagged with c_tll = 0",
        measure: status::strictly_less,
    },
    Finding {
        id: FindingId::C9,
        listing: Some(Which::CCnt),
        lines: &[5, 6, 7, 9, 17, 18],
        title: "only a node inside some edge's box gets a ct, and without one its yt is 0; over a \
                horizontal edge the box is 2 · c_tll high",
        why: "the node that jumped deeper than c_tll, for which the text has the sign rule, is \
              lost; over a horizontal edge the rule can fire at |yt| = c_tll at most",
        repair: "search along the normal, without a box",
        edit: edit!("repairs/C9.edit"),
        before: Preparation::Model(
            "turned upside down, so that the sign rule takes the node that is inside (C4)",
            turn_scene,
        ),
        number: "contact nodes inside the target, deeper than c_tll, without a target edge",
        measure: search::lost_inside,
    },
    Finding {
        id: FindingId::C10,
        listing: Some(Which::CCnt),
        lines: &[18],
        title: "the line names yt[i1−1] before its own guard i1 ≥ 2",
        why: "evaluated from left to right the listing stops with an index error as soon as the \
              first contact node has a target edge and yt[1] < 0",
        repair: "the guard first, as in line 17",
        edit: edit!("repairs/C10.edit"),
        before: Preparation::Reading(
            "the operands of ∧ from left to right (R4)",
            "R4=left-to-right",
        ),
        number: "yt of the first contact node at the initial shape, length",
        measure: status::left_to_right,
    },
    Finding {
        id: FindingId::C11,
        listing: Some(Which::CCnt),
        lines: &[17, 18],
        title: "yt is compared with exactly 0: of a node that lies on its edge it is a rounding \
                error, and its sign decides on the neighbours",
        why: "another processor, another order of operations, another contact set",
        repair: "compare with c_tll",
        edit: edit!("repairs/C11.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes whose dy changes as a node on its edge moves by a rounding error",
        measure: status::rounding_noise,
    },
    Finding {
        id: FindingId::C12,
        listing: Some(Which::CCnt),
        lines: &[24, 26],
        title: "a node that cnt lists twice gets its weights twice",
        why: "eq. (1) with them reads u_cont = 2 · u_targ",
        repair: "set the weights, do not add",
        edit: edit!("repairs/C12.edit"),
        before: Preparation::AsPrinted,
        number: "largest sum of the two weights of a node in contact",
        measure: weights::listed_twice,
    },
    Finding {
        id: FindingId::C13,
        listing: None,
        lines: &[],
        title: "the printed matrix depends on the order of cnt (C7, K2: the last one wins)",
        why: "a scene and its mirror image have different answers",
        repair: "as K1: nothing is read that depends on the order",
        edit: edit!("repairs/K1.edit"),
        before: Preparation::AsPrinted,
        number: "entries of MJS that change once cnt is reversed",
        measure: weights::reversed_contact,
    },
    Finding {
        id: FindingId::C14,
        listing: Some(Which::CCnt),
        lines: &[5, 6, 7],
        title: "the box of an edge that falls by h is |h − 2 · c_tll| high (of one that rises, h + \
                2 · c_tll)",
        why: "a node that lies on the edge is not found; of a symmetric scene one half is",
        repair: "as C1",
        edit: edit!("repairs/C1.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes over or under a target edge, vertically nearer to it than c_tll, that \
                 have no target edge",
        measure: search::missed_near,
    },
    Finding {
        id: FindingId::C15,
        listing: Some(Which::CCnt),
        lines: &[16, 17, 18],
        title: "the text gives the nodes within c_tol a fixed Y before signs are compared (which, \
                it does not say); the listing compares yt itself",
        why: "a node that merely touches, with 0 < yt < c_tll, puts its separated neighbour in \
              contact",
        repair: "leave nodes that line 16 flags out of the comparison",
        edit: edit!("repairs/C15.edit"),
        before: Preparation::AsPrinted,
        number: "contact nodes apart by c_tll or more, flagged beside nodes that only touch",
        measure: status::touching_neighbour,
    },
    Finding {
        id: FindingId::K1,
        listing: Some(Which::Km),
        lines: &[15, 21, 22, 23, 31, 32, 33],
        title: "only blocks (W, W) are added, never (V, W)",
        why: "nothing couples the two bodies: no load reaches the target",
        repair: "Tᵀ·K·T with eq. (1) in T (variants tied and stepped)",
        edit: edit!("repairs/K1.edit"),
        before: Preparation::Model(
            "the contact node held along x, the last node of the stamp free along y",
            let_stamp_sink,
        ),
        number: "entries of MJS that join two bodies",
        measure: stiffness::nothing_joins,
    },
    Finding {
        id: FindingId::K2,
        listing: Some(Which::Km),
        lines: &[20, 30],
        title: "one fl for the whole element: of several linked nodes the last one's weight scales \
                all",
        why: "the other weights are lost",
        repair: "as K1: Tᵀ·K·T has a weight for each row and column",
        edit: edit!("repairs/K1.edit"),
        before: Preparation::AsPrinted,
        number: "triangles in which linked nodes have different weights",
        measure: stiffness::one_weight_for_all,
    },
    Finding {
        id: FindingId::K3,
        listing: Some(Which::Km),
        lines: &[13],
        title: "restrained equations get 1 on the diagonal, whatever the unit",
        why: "beside stiffnesses of 1e4 to 1e6 the choice of units decides the condition number",
        repair: "the size of the other diagonal entries, or leave the equations out",
        edit: edit!("repairs/K3.edit"),
        before: Preparation::AsPrinted,
        number: "largest over smallest diagonal entry of MJS",
        measure: stiffness::ones_on_the_diagonal,
    },
    Finding {
        id: FindingId::K4,
        listing: Some(Which::Km),
        lines: &[2, 3, 13],
        title: "a node that belongs to no triangle leaves two rows of zeros, \
                even where S restrains it",
        why: "the matrix is singular: one stray point of the mesh is enough",
        repair: "set the 1 in a loop over nodes",
        edit: edit!("repairs/K4.edit"),
        before: Preparation::Model("with one more node, which belongs to no triangle", |model| {
            model.add_node([1.0, 0.0]);
        }),
        number: "rows of zeros that one such node adds",
        measure: stiffness::orphan,
    },
    Finding {
        id: FindingId::K5,
        listing: None,
        lines: &[],
        title: "eq. (1) on total displacements takes a gap that closed back to its initial width",
        why: "the node leaves contact and returns: the contact set cycles, and where in the cycle \
              the 20th iteration falls decides the result",
        repair: "increments (variant stepped), or the gap itself in eq. (1)",
        edit: Repair::None {
            reason: "the iterations stand around the listings, and no listing prints them; solve \
                     findings/K5 --variant stepped, eq. (1) on increments, does not cycle",
        },
        before: Preparation::AsPrinted,
        number: "iterations after which the contact state repeats under tied; settled would be 1",
        measure: stiffness::cycle,
    },
    Finding {
        id: FindingId::K6,
        listing: None,
        lines: &[],
        title: "one linked node is a hinge: the stamp turns about it",
        why: "the matrix is singular unless restraints hold the stamp",
        repair: "hold the stamp's axis",
        edit: Repair::None {
            reason: "what is restrained is the scene's choice, not a listing's; solve findings/K6, whose \
                     stamp's axis is held, runs",
        },
        before: Preparation::Model(
            "the stamp released and its second node out of contact",
            release_stamp,
        ),
        number: "most linked nodes, of one and two, with which the released stamp is singular",
        measure: stiffness::hinge,
    },
    Finding {
        id: FindingId::K7,
        listing: Some(Which::Km),
        lines: &[20, 21, 30, 31],
        title: "fl is weight and switch in one: a last weight of exactly 0 leaves the whole \
                addition out",
        why: "a contact node over the end of an edge takes its neighbours' additions with it",
        repair: "a switch of its own, a weight for each node",
        edit: edit!("readings/R3-per-node.edit"),
        before: Preparation::AsPrinted,
        number: "additions (triangle, pair) left out because the last weight is 0 and another is \
                 not",
        measure: stiffness::switched_off,
    },
    Finding {
        id: FindingId::K8,
        listing: Some(Which::Km),
        lines: &[23, 33],
        title: "a weight below 0 (C1, C6) takes stiffness away",
        why: "MJS may lose its positive definiteness, and a load may move its node backwards",
        repair: "weights in [0, 1]",
        edit: edit!("repairs/K8.edit"),
        before: Preparation::AsPrinted,
        number: "smallest diagonal entry of MJS, force/length",
        measure: stiffness::stiffness_taken_away,
    },
    Finding {
        id: FindingId::K9,
        listing: None,
        lines: &[],
        title: "the status looks at the gap only and eq. (1) ties both components: nothing \
                releases a node that pulls, and nothing lets it slide",
        why: "a contact that carries tension stays, against the text's own condition of no \
              penetration and friction",
        repair: "release a node whose contact force pulls",
        edit: Repair::None {
            reason: "no line of a listing looks at a contact force; solve findings/K9 --variant \
                     unilateral releases the node",
        },
        before: Preparation::AsPrinted,
        number: "nodes kept in contact under tension at the end of stepped",
        measure: stiffness::pulls,
    },
];

one_row_for_each!(FindingId, FINDINGS);

/// Turns the scene about the middle between x = 0 and x = 1, so that the target lies above the stamp.
fn turn_scene(model: &mut Model) {
    model.nodes.iter_mut().for_each(|[x, y]| [*x, *y] = [1.0 - *x, -*y]);
}

/// Gives the stamp an equation of its own beside those of its contact node, which then only moves up and
/// down: `MJS` has a place at which the two bodies can be joined.
fn let_stamp_sink(model: &mut Model) {
    let contact = model.contact.nodes[0];
    let stamp = model.body_of(contact).expect("a contact node is of a body");
    let last = *stamp.nodes.last().expect("a body has nodes");
    model.holds.fix([contact.x()]);
    model.holds.release([last.y()]);
}

/// Takes every restraint from the stamp, and all but its first contact node.
fn release_stamp(model: &mut Model) {
    model.contact.nodes.truncate(1);
    let stamp = model.body_of(model.contact.nodes[0]).expect("a contact node is of a body");
    let dofs: Vec<_> = stamp.nodes.iter().flat_map(|node| node.dofs()).collect();
    model.holds.release(dofs);
}
