//! Sentences and labels.

use super::{Case, check};

#[test]
fn sentences() {
    check("sentences", CASES);
}

/// The force that contact transmits is the same whichever body is restrained, and whatever else is
/// loaded; and a contact that is not found for the direction of an edge is called so.
const CASES: &[Case] = &[
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"cnt\": 20, \"trg\": 11/\"cnt\": 11, \
                  \"trg\": 20/' d/scene.json && plane-contact solve d/scene.json --variant tied",
        status: 0,
        contains: &["force on the target 12.6", "transmits the whole load"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"cnt\": 20, \"trg\": 11/\"cnt\": 11, \
                  \"trg\": 20/' d/scene.json && plane-contact solve d/scene.json --variant stepped",
        status: 0,
        contains: &["force on the target 12.6", "transmits the whole load", " 5.0 % "],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"cnt\": 20, \"trg\": 11/\"cnt\": 11, \
                  \"trg\": 20/' d/scene.json && plane-contact solve d/scene.json --variant unilateral",
        status: 0,
        contains: &["force on the target 12.6"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"cnt\": 20, \"trg\": 11/\"cnt\": 11, \
                  \"trg\": 20/' d/scene.json && plane-contact audit d/scene.json --full",
        status: 0,
        contains: &["tied                    100 %  3 "],
        lacks: &["panicked"],
    },
    // Under `printed` nothing couples the bodies.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"cnt\": 20, \"trg\": 11/\"cnt\": 11, \
                  \"trg\": 20/' d/scene.json && plane-contact solve d/scene.json --variant printed",
        status: 0,
        contains: &["nothing couples the bodies", "Nothing transmitted"],
        lacks: &["transmits the whole load"],
    },
    // A load on the target as well: it is no force of contact.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"pressure\": 6.3 }/\"pressure\": 6.3 }, \
                  { \"node\": 2, \"force\": [0.0, -100.0] }/' d/scene.json && plane-contact solve \
                  d/scene.json --variant tied",
        status: 0,
        contains: &["Contact presses: force on the target 12.6 N, down", "the whole load is 112.6"],
        lacks: &["transmits"],
    },
    // Opposite loads on both bodies: the sum is 0, and contact passes 12.6 all the same.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"pressure\": 6.3 }/\"pressure\": 6.3 }, \
                  { \"node\": 2, \"force\": [0.0, 12.6] }/' d/scene.json && plane-contact solve \
                  d/scene.json --variant unilateral",
        status: 0,
        contains: &["Contact presses: force on the target 12.6 N, down"],
        lacks: &["transmits", " % of the load"],
    },
    // A load on a held edge and on a contact surface, and a restraint of one.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/\"pressure\": 6.3 }/\"pressure\": 6.3 }, \
                  { \"on\": 10, \"pressure\": 1.0 }, { \"on\": 20, \"pressure\": 1.0 }/; s/{ \"on\": 10, \"fix\"/{ \
                  \"on\": 11, \"fix\": [\"x\"] }, &/' d/scene.json && plane-contact solve d/scene.json --variant tied",
        status: 0,
        contains: &[
            "loads[1]: restraints hold 2 of its 2 edges or nodes along it",
            "loads[2]: 2 of its 2 edges belong to a contact surface",
            "The restraint of 11 holds 2 of the 4 edges of the contact surfaces",
        ],
        lacks: &["loads[0]:", "loads[2]: restraints", "The restraint of 10"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/11, 11, 7, 8/11, 11, 8, 7/; s/11, 11, 8, \
                  9/11, 11, 9, 8/' d/scene.json && plane-contact solve d/scene.json",
        status: 3,
        contains: &[
            "ct of node 10 is 0",
            "runs towards -x",
            "finding C1",
            "turn the target's edges round",
        ],
        lacks: &["larger c_tll", "move the bodies together"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/11, 11, 7, 8/11, 11, 8, 7/; s/11, 11, 8, \
                  9/11, 11, 9, 8/' d/scene.json && plane-contact listing run c_cnt d/scene.json",
        status: 0,
        contains: &["No node is in contact: ct of node 10 is 0", "finding C1"],
        lacks: &["panicked"],
    },
    // The upper block is held: the run ends, and says why it has no contact.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/11, 11, 7, 8/11, 11, 8, 7/; s/11, 11, 8, \
                  9/11, 11, 9, 8/; s/{ \"on\": 10, \"fix\"/{ \"node\": 17, \"fix\": [\"y\"] }, { \"on\": 10, \
                  \"fix\"/' d/scene.json && plane-contact solve d/scene.json --variant tied",
        status: 0,
        contains: &[
            "In contact at the end: no node",
            "No node is in contact: ct of node",
            "finding C1",
        ],
        lacks: &["panicked"],
    },
    // A real gap is called a gap.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i -E 's/\\[(1[0-8]), (.\\..), (.)\\.0/[\\1, \\2, \
                  \\3.5/' d/scene.json && plane-contact solve d/scene.json",
        status: 3,
        contains: &["the gap nearest to 0 is 5e-1", "give a larger c_tll"],
        lacks: &["finding C1"],
    },
    // A rule other than the listing's has no box.
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out d && sed -i 's/11, 11, 7, 8/11, 11, 8, 7/; s/11, 11, 8, \
                  9/11, 11, 9, 8/' d/scene.json && plane-contact solve d/scene.json --status intersection",
        status: 0,
        contains: &["In contact at the end: nodes 10, 11, 12"],
        lacks: &["finding C1"],
    },
    Case {
        input: "",
        command: "plane-contact listing run c_cnt fig1",
        status: 0,
        contains: &["in fig. 1", "2.1", "2.2", "2.3", "2.4", "2.5", "1.4"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact listing run c_cnt two-blocks",
        status: 0,
        contains: &["dy"],
        lacks: &["fig. 1"],
    },
    Case {
        input: "",
        command: "plane-contact mathcad export fig1 --to octave",
        status: 0,
        contains: &["beside('U', U, [", "beside('ct', ct, [", "beside('k_cnt', k_cnt, ["],
        lacks: &["show('U', U)"],
    },
    Case {
        input: "",
        command: "plane-contact audit fig1 --claim P10",
        status: 0,
        contains: &[
            "largest difference of a node's displacement between c_tol and a thousandth of it",
        ],
        lacks: &["change of the largest displacement"],
    },
    Case {
        input: "",
        command: "COLUMNS=40 plane-contact audit fig1 --claim P1",
        status: 0,
        contains: &["/variants/0/penetration/relative\n"],
        lacks: &["panicked"],
    },
];
