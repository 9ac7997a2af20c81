//! Equilibria: those that are hard to find, what is said of others, and what the model does not describe.

use super::{Case, check};

#[test]
fn contact() {
    check("contact", CASES);
}

const CASES: &[Case] = &[
    // Half of a model under friction: on the line of symmetry both surfaces are held in x, and the normal of the end
    // of a surface is inclined to that line. No shear acts there: nothing sticks or slides in another way.
    Case {
        input: "axis",
        command: "plane-contact solve scene.json",
        status: 0,
        contains: &[
            "Contact force on the target -0.1166, -12.7958",
            "Equilibrium: trying all other contact states",
        ],
        lacks: &["NOT THE ONLY ONE"],
    },
    // An overlap of a thousandth: the load alone would move the punch by more than its own width before it touches.
    Case {
        input: "thrown",
        command: "plane-contact solve scene.json",
        status: 4,
        contains: &["the start is not determined"],
        lacks: &["Largest |u|"],
    },
    // The pressure at the edge of a punch has no limit; between blocks of one width it has.
    Case {
        input: "",
        command: "plane-contact scene mesh punch --out p >log; plane-contact solve p --no-pictures --out o",
        status: 0,
        contains: &[
            "; unbounded under refinement (contact at the edge of a body)",
            "; unbounded under refinement (node 411, contact at the edge of a body)",
        ],
        lacks: &["one node alone"],
    },
    Case {
        input: "",
        command: "plane-contact scene copy two-blocks --out m >log; sed -i 's/\"loads\": .*/\"loads\": [],/; \
                  s/{ \"on\": 10, \"fix\": .\"y\". },/& { \"on\": 21, \"fix\": [\"y\"], \"displacement\": [-0.001] },/' \
                  m/scene.json; plane-contact solve m --variant unilateral --friction 0 --no-pictures",
        status: 0,
        contains: &["Contact presses under given displacements: force on the target 29.8"],
        lacks: &["without a load", "contact at the edge of a body"],
    },
    // The same where the corner of the punch is held along the contact.
    Case {
        input: "",
        command: "plane-contact scene mesh punch --out p >log; \
                  sed -i 's/{\"on\":\"outer\"/{\"node\":411,\"fix\":[\"x\"]},&/' p/scene.json; plane-contact solve p --no-pictures",
        status: 0,
        contains: &["; unbounded under refinement (contact at the edge of a body)"],
        lacks: &[],
    },
    // A contact group ends in contact where the cylinder and the block go on: the peak there is the group's.
    Case {
        input: "",
        command: "plane-contact scene mesh hertz --size 4 --out h >log; \
                  sed -i 's/\"cnt\":\"contact\"/\"cnt\":[69,68,67,66,65]/' h/scene.json; plane-contact solve h --no-pictures",
        status: 0,
        contains: &[
            "NOTE: contact reaches the end of a contact group though the bodies go on, at node 65: ",
        ],
        lacks: &["edge of a body"],
    },
    Case {
        input: "",
        command: "plane-contact scene mesh hertz --size 4 --out h >log; \
                  sed -i 's/\"cnt\":\"contact\"/\"cnt\":[69,68,67,66]/' h/scene.json; plane-contact solve h --no-pictures",
        status: 4,
        contains: &[
            "; unbounded under refinement (the end of a contact group on a surface that goes on)",
        ],
        lacks: &["edge of a body"],
    },
    // Bodies that touch in one point, before any load: their arcs have four edges on the half width of contact, then one.
    Case {
        input: "",
        command: "plane-contact scene mesh hertz --size 4 --out h >log; plane-contact solve h --no-pictures",
        status: 0,
        contains: &["In contact at the end: nodes 69, 68, 67, 66, 65\n"],
        lacks: &["facets", "contact group"],
    },
    Case {
        input: "",
        command: "plane-contact scene mesh hertz --size 4 --out h >log; sed -i 's/-17500.0/-1000.0/' h/scene.json; \
                  plane-contact solve h --no-pictures",
        status: 0,
        contains: &["NOTE: the edges of a curved surface in contact are facets, up to "],
        lacks: &[],
    },
    // Bonded blocks with flush sides: of one material nothing is singular, of two their free corner is.
    Case {
        input: "",
        command: "plane-contact scene mesh blocks --out b >log; sed -i 's/\"friction\":0/\"friction\":\"stick\"/' b/scene.json; \
                  plane-contact solve b --no-pictures",
        status: 0,
        contains: &["Peak contact pressure 6.3"],
        lacks: &["the end of the sticking zone", "edge of a body", "contact group", "facets"],
    },
    Case {
        input: "",
        command: "plane-contact scene mesh blocks --out b >log; \
                  sed -i 's/\"friction\":0/\"friction\":\"stick\"/; s/\"upper\":{\"E\":30000.0/\"upper\":{\"E\":210000.0/' b/scene.json; \
                  plane-contact solve b --no-pictures",
        status: 0,
        contains: &["the end of the sticking zone"],
        lacks: &[],
    },
    Case {
        input: "ring",
        command: "plane-contact solve scene.json",
        status: 0,
        contains: &["Found on springs", "Equilibrium: "],
        lacks: &["there is no equilibrium"],
    },
    // One node carries a body that turns; an own solution of the step (a fixed point on the bounds of friction) has
    // the same force.
    Case {
        input: "rough",
        command: "plane-contact solve scene.json --csv t; cat t/contact-surface.csv",
        status: 0,
        contains: &[
            "In contact at the end: nodes 85\n",
            "one node alone is in contact",
            "\n85,3.29614598",
            ",2.1692196",
            ",1.1630403",
            ",-0.2045947",
            ",0.1759136",
        ],
        lacks: &["Found on springs"],
    },
    // The node in the corner of the groove rests on both of its sides; mortar averages their normals.
    Case {
        input: "wedge",
        command: "plane-contact solve scene.json --csv t; cat t/contact-surface.csv",
        status: 0,
        contains: &[
            "In contact at the end: nodes 22, 23, 24, 25, 26\n",
            "\n24,1.41421356",
            ",0.8462173",
            ",1.1967320",
            ",slip",
            "energy norm of the difference: 2.0 %",
        ],
        lacks: &["no equilibrium"],
    },
    // The load lifts the arm: every node open is the only equilibrium.
    Case {
        input: "open",
        command: "plane-contact solve scene.json --load-steps 1",
        status: 0,
        contains: &[
            "trying all other contact states (4096, 1 step of the load)",
            "In contact at the end: no node",
        ],
        lacks: &[],
    },
    // Nodes stand inside at the start, and without friction nothing holds the body: friction does in one contact
    // state alone. With 1024 steps, and none for the start, |u| is 0.00408 too; with 16 it was 0.00403.
    Case {
        input: "overlap",
        command: "plane-contact solve scene.json; plane-contact solve scene.json --load-steps 64",
        status: 0,
        contains: &[
            "trying all other contact states (17408, 17 steps of the load) gives no other equilibrium",
            "the only contact state of all in which friction holds the bodies",
            "16 steps a stage\n",
            "64 steps a stage\n",
        ],
        lacks: &["0.00403", "= 0.00 %"],
    },
    // The same in units of stress that are 1e10 times smaller.
    Case {
        input: "units",
        command: "plane-contact solve scene.json | grep 'Mesh error' > one; \
                  plane-contact solve scene-1e10.json | grep 'Mesh error' > other; \
                  cat one; diff one other",
        status: 0,
        contains: &["Mesh error "],
        lacks: &[">"],
    },
    Case {
        input: "balanced",
        command: "plane-contact solve scene.json",
        status: 4,
        contains: &[
            "NOT THE ONLY ONE: node",
            "can move without work",
            "there are several equilibria",
        ],
        lacks: &["no equilibrium"],
    },
    Case {
        input: "locking",
        command: "plane-contact scene plan scene.json; plane-contact solve scene.json",
        status: 0,
        contains: &[
            "NOTE: body 1: Poisson's ratio 0.4999 in plane strain is nearly incompressible: linear triangles lock",
            "Result\n  NOTE: Poisson's ratio 0.4999",
            "Mesh error unknown: the triangles lock",
        ],
        lacks: &["probably more"],
    },
    Case {
        input: "locking",
        command: "sed 's/0.4999/0.45/' scene.json > less.json; plane-contact solve less.json --json; \
                  sed 's/0.4999/0.451/' scene.json > more.json; plane-contact solve more.json --json | grep -c '\"locking\"'",
        status: 0,
        contains: &["\n1\n"],
        lacks: &["\"locking\""],
    },
    Case {
        input: "",
        command: "plane-contact solve two-blocks --variant unilateral --load-factor 20000",
        status: 4,
        contains: &["the model leaves its range: triangle", "is turned inside out under about 0."],
        lacks: &[],
    },
    Case {
        input: "",
        command: "plane-contact solve two-blocks --variant unilateral --load-factor 20000 --json",
        status: 4,
        contains: &["\"kind\":\"equilibrium\",\"cause\":\"out-of-range\",\"what\":\"triangle"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "plane-contact solve two-blocks --variant tied --load-factor 20000",
        status: 0,
        contains: &["triangles are turned inside out; linear elements are for strains below 0.1"],
        lacks: &[],
    },
];
