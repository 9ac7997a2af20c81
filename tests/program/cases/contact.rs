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
            "Contact force on the target -0.1695, -12.7959",
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
    // What lies behind a jump of the target, as the bottom of a slot, its slanted walls, or a stair under a corner that
    // hangs over, changes nothing: the same as where it is in no group.
    Case {
        input: "slot",
        command: "for s in slot walls stair; do for g in initial current; do \
                  plane-contact -q solve $s.json --geometry $g --no-pictures --no-assessment --out a | grep -E 'Largest|Peak' >a.txt; \
                  plane-contact -q solve $s-without.json --geometry $g --no-pictures --no-assessment --out b | grep -E 'Largest|Peak' >b.txt; \
                  cmp a.txt b.txt && test -s a.txt && echo $s $g: same; done; done",
        status: 0,
        contains: &[
            "slot initial: same",
            "slot current: same",
            "walls initial: same",
            "walls current: same",
            "stair initial: same",
            "stair current: same",
        ],
        lacks: &["differ"],
    },
    // Three bodies: the force on the target is that on the body that rests on no other one.
    Case {
        input: "stack",
        command: "plane-contact -q solve stack.json --no-pictures --no-assessment --out a; \
                  plane-contact -q solve two-on-one.json --no-pictures --no-assessment --out b",
        status: 0,
        contains: &[
            "Contact transmits the whole load: force on the target 8",
            "2 on 1, 3.0 along the surface, from node 66 to node 74: 0.00156, -8.00000, along a line through",
            "3 on 2, 1.6 along the surface, from node 102 to node 107: ",
            "Contact transmits the whole load: force on the target 6",
            "2 on 1, 2.0 along the surface, from node 106 to node 111: 0.00000, -2.00000, along a line through",
            "3 on 1, 2.0 along the surface, from node 130 to node 135: 0.00000, -4.00000, along a line through",
        ],
        lacks: &["Contact width"],
    },
    // The air between two feet is no part of the contact.
    Case {
        input: "two-feet",
        command: "plane-contact -q solve two-feet.json --no-pictures --no-assessment --out a",
        status: 0,
        contains: &[
            "Contact in 2 stretches:",
            "2 on 1, 0.50 along the surface, from node 206 to node 207: -1.02874, -2.50022",
        ],
        lacks: &["Contact width"],
    },
    // Hertz's theory is of one contact: none where two carry the load.
    Case {
        input: "two-rollers",
        command: "plane-contact solve two-rollers.json --no-assessment --json",
        status: 0,
        contains: &["\"hertz\": null", "\"stretches\": ["],
        lacks: &[],
    },
    // Loads that cancel each other leave a rounding error, which decides neither sign nor share.
    Case {
        input: "cancelling",
        command: "for s in a b plain with-nothing; do \
                  plane-contact -q solve $s.json --variant tied --no-pictures --no-assessment --out $s | grep 'force on the target'; done",
        status: 0,
        contains: &[
            "Contact presses: force on the target 0.130536, down\n  Contact force on the target -0.033175, -0.126250, along a line \
             through 1.5083, 0.0000\n  Contact presses: force on the target 0.130536, down\n",
            "Contact transmits the whole load: force on the target 2\n  Contact force on the target 0.06408, -2.00000, along a \
             line through 1.5320, 0.0000\n  Contact transmits the whole load: force on the target 2\n",
        ],
        lacks: &[],
    },
    // A body that touches is not pressed by the rounding of a motion that strains nothing.
    Case {
        input: "touching",
        command: "plane-contact -q solve scene.json --no-pictures --no-assessment --out o",
        status: 0,
        contains: &["Nothing pressed: the bodies touch without a force"],
        lacks: &["Contact presses", "Peak contact"],
    },
    // Contact in the current shape is not convex: the tip may come to rest on the other flank.
    Case {
        input: "peak-of-a-roof",
        command: "plane-contact -q solve scene.json --no-pictures --no-assessment --out o",
        status: 0,
        contains: &["unknown: contact in the current shape is not convex"],
        lacks: &["the only one in the shape reached"],
    },
    // Two rings that fit exactly: the facets alone keep them apart.
    Case {
        input: "fitted",
        command: "plane-contact -q solve scene.json --no-pictures --no-assessment --out o",
        status: 0,
        contains: &["Nothing transmitted", "the facets alone may keep the bodies apart"],
        lacks: &[],
    },
    // Bodies that lie in each other before any load, or far apart; of steel, with an overlap of 0.02: E 0.02 / 2.
    Case {
        input: "apart",
        command: "for s in inside touching apart; do plane-contact -q scene plan $s.json | grep NOTE; \
                  plane-contact -q solve $s.json --no-pictures --no-assessment --out o | grep -E 'NOTE|force on'; done",
        status: 0,
        contains: &[
            "NOTE: before any load 2 contact nodes lie inside the target, the deepest 0.0200 mm at node 5: an interference fit",
            "force on the target 2000 N",
            "NOTE: before any load the bodies lie far apart: the smallest gap is 0.250 mm, at node 5",
        ],
        lacks: &[],
    },
    // A node beside a corner lies behind the line of a side that it looks past, and inside no body.
    Case {
        input: "overhang",
        command: "for s in scene without; do \
                  plane-contact -q solve $s.json --no-pictures --no-assessment --out $s | grep 'Largest |u|'; done",
        status: 0,
        contains: &[
            "Largest |u| 0.0179 at node 123: 1.1000, 1.5000\n  Largest |u| 0.0179 at node 123",
        ],
        lacks: &["inside the target"],
    },
    // A node in a concave corner of the target that rests on one of its edges alone.
    Case {
        input: "corner-node",
        command: "for f in 0.05 0.1 0.3; do \
                  plane-contact -q solve scene.json --friction $f --no-pictures --no-assessment --out o | grep 'Largest |u|'; done",
        status: 0,
        contains: &[
            "Largest |u| 0.0129 at node 158: 1.5000, 1.5000\n  Largest |u| 0.0128 at node 158: 1.5000, 1.5000\n  \
             Largest |u| 0.0128 at node 158",
        ],
        lacks: &["no equilibrium"],
    },
    // Half of a press fit: at the end of the target on the line of symmetry the normal is along that line, as in the whole,
    // whose forces balance all round.
    Case {
        input: "half",
        command: "for s in half whole; do plane-contact -q solve $s.json --no-assessment --no-pictures --out $s; done",
        status: 0,
        contains: &[
            "Peak contact pressure 14.0 at node 56: 1.0707, 1.8544",
            "Largest |u| 0.0422 at node 2: 0.8188, 1.9769\n",
            "Contact presses: its forces balance, and sum to",
            "Peak contact pressure 14.0 at node 111: -1.0707, 1.8544 (1 other as large)",
            "Largest |u| 0.0422 at node 2: 0.8188, 1.9769 (1 other as large)",
        ],
        lacks: &["force on the target 0\n"],
    },
    // A closed contact surface given as a list, refined, has the midpoint of its closing edge too.
    Case {
        input: "closed-list",
        command: "for s in group list; do plane-contact trade $s.json --only mesh --runs 1 --out $s --json \
                  | grep -o '\"in_contact\":[0-9]*' | tr '\\n' ' '; done",
        status: 0,
        contains: &[
            "\"in_contact\":16 \"in_contact\":32 \"in_contact\":64 \"in_contact\":128 \"in_contact\":256 \
             \"in_contact\":16 \"in_contact\":32 \"in_contact\":64 \"in_contact\":128 \"in_contact\":256",
        ],
        lacks: &[],
    },
];
