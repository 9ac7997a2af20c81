//! Solvers and equilibria: what is singular, what does not fit in memory, what slides, what lies inside.

use super::{Case, check};

#[test]
fn solvers() {
    check("solvers", CASES);
}

const CASES: &[Case] = &[
    Case {
        input: "free-body",
        command: "plane-contact solve scene.json --variant tied --coupling nts",
        status: 3,
        contains: &[
            "the matrix is singular at node",
            "of body \"2\"",
            "f64 rounds: --scalar exact",
        ],
        lacks: &["panicked"],
    },
    Case {
        input: "free-later",
        command: "plane-contact solve scene.json --variant tied --coupling nts",
        status: 3,
        contains: &["the matrix is singular at node"],
        lacks: &["panicked"],
    },
    // A step takes 82 kB.
    Case {
        input: "load-steps",
        command: "ulimit -v 8000000; plane-contact solve scene.json --friction 1e-12 --json",
        status: 2,
        contains: &["contact.load_steps", "on 26 nodes are more than 39682", "ask for fewer"],
        lacks: &["memory allocation"],
    },
    Case {
        input: "listed-inside",
        command: "plane-contact solve scene.json --variant unilateral --friction 1",
        status: 4,
        contains: &["triangle 11 is turned inside out"],
        lacks: &["panicked"],
    },
    Case {
        input: "listed-inside",
        command: "plane-contact solve scene.json --variant unilateral --friction 1 --load-factor 0.95",
        status: 4,
        contains: &[
            "BODIES LIE IN EACH OTHER outside the groups of contact: node 21",
            "no equilibrium was found: bodies lie in each other",
        ],
        lacks: &["panicked"],
    },
    // The contact group leaves out node 13, which is pressed into the lower block.
    Case {
        input: "short-group",
        command: "plane-contact compare scene.json --with u.csv; plane-contact solve scene.json",
        status: 4,
        contains: &[
            "Result\n  BODIES LIE IN EACH OTHER outside the groups of contact: node 13: 2.7500, 1.0000 mm, the deepest of 2",
            "extend the groups of contact beyond where the bodies meet",
            "Equilibrium: whether it is the only one is unknown: contact in the current shape is not convex",
        ],
        lacks: &["the only one in the shape reached"],
    },
    Case {
        input: "short-group",
        command: "plane-contact compare scene.json --with u.csv --rtol 10 | grep LIE; \
                  plane-contact audit scene.json | grep LIE; plane-contact solve scene.json --json | grep -A 2 '\"overlap\"'",
        status: 0,
        contains: &[
            "  BODIES LIE IN EACH OTHER",
            "Of the equilibrium that runs are compared with: BODIES LIE IN EACH OTHER",
            "\"overlap\": {\n    \"nodes\": 2,\n    \"node\": 13,",
        ],
        lacks: &[],
    },
    Case {
        input: "short-group",
        command: "sed 's/\"cnt\": \\[11, 12\\]/\"cnt\": [11, 12, 13]/' scene.json > whole.json; plane-contact solve whole.json",
        status: 0,
        contains: &[
            "Equilibrium: whether it is the only one is unknown: contact in the current shape is not convex",
        ],
        lacks: &["LIE IN EACH OTHER"],
    },
    Case {
        input: "short-group",
        command: "sed 's/0.01/0.001/; s/\"length\": \"mm\"/\"length\": \"cm\"/' scene.json > cm.json; \
                  sed 's/0.01/0.001/; s/\"length\": \"mm\"/\"length\": \"\"/' scene.json > none.json; \
                  for s in cm none; do plane-contact solve $s.json --variant stepped --coupling nts --reading R8=m; done",
        status: 0,
        contains: &[
            "NOTE: R8 = m takes c_tll in metres, which is 0.1 cm here: the scene is measured in cm, the paper's example in mm",
            "NOTE: R8 = m takes c_tll in metres, which is 1 here: the scene names no unit of length, and mm is assumed",
        ],
        lacks: &[],
    },
    Case {
        input: "short-group",
        command: "sed 's/0.01/0.001/' scene.json > mm.json; \
                  plane-contact solve mm.json --variant stepped --coupling nts --reading R8=m",
        status: 0,
        contains: &["Contact transmits"],
        lacks: &["R8 = m"],
    },
    // The target group ends short of contact node 11.
    Case {
        input: "short-group",
        command: "sed 's/\"cnt\": \\[11, 12\\]/\"cnt\": [11, 12, 13]/; s/\\[1, 1, 2, 2, 2, 6, 7\\], //' scene.json > target.json; \
                  plane-contact solve target.json",
        status: 4,
        contains: &["LIE IN EACH OTHER outside the groups of contact: node 11"],
        lacks: &["INSIDE THE TARGET"],
    },
    Case {
        input: "mean-gap",
        command: "plane-contact solve scene.json --coupling mortar",
        status: 0,
        contains: &["averaged gap", "INSIDE THE TARGET", "mortar closes the averaged gap"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact solve fig1 --variant tied --check-rounding",
        status: 0,
        contains: &[
            "rounding: a run in f64x2 and 3 with inputs changed in the last digit change no contact state",
        ],
        lacks: &["not checked"],
    },
    Case {
        input: "",
        command: "plane-contact solve strand --variant unilateral --coupling mortar --friction 0 \
                  --geometry initial --check-rounding",
        status: 0,
        contains: &[
            "rounding: inputs changed in the last digit (3 runs) change no contact state, displacements by",
        ],
        lacks: &["not checked", "unknown", "+- "],
    },
    Case {
        input: "",
        command: "plane-contact solve strand --variant unilateral",
        status: 0,
        contains: &[
            "rounding: not checked; solve --check-rounding",
            "Mesh error 15 %, probably more",
        ],
        lacks: &["+- "],
    },
    Case {
        input: "",
        command: "plane-contact solve strand --variant unilateral --accuracy 1e-3",
        status: 2,
        contains: &["unilateral runs in f64 only", "--check-rounding"],
        lacks: &["Written to"],
    },
    Case {
        input: "",
        command: "plane-contact solve strand --variant unilateral --load-steps 99999 --scalar f64x2",
        status: 2,
        contains: &["unilateral does not run in f64x2"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --variant tied,unilateral --scalar f64x2",
        status: 2,
        contains: &["unilateral does not run in f64x2"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "mkdir o && plane-contact report strand --out o",
        status: 2,
        contains: &["the file cannot be written: it is a folder", "where: o"],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: "plane-contact compare strand --with calculix --ccx ./none",
        status: 2,
        contains: &["./none cannot be started"],
        lacks: &["panicked"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact solve scene.json --no-pictures --no-error-estimate",
        status: 4,
        contains: &[
            "friction cannot hold the load",
            "slides as a whole from 0.857 of stage 2 on",
            "it needs a coefficient of 0.35",
        ],
        lacks: &["no contact state", "times the load"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact solve scene.json --no-pictures --friction 0.2 --geometry initial --coupling mortar",
        status: 4,
        contains: &["slides as a whole from 0.571 of stage 2 on", "a coefficient of 0.35"],
        lacks: &["no contact state", "times the load"],
    },
    Case {
        input: "gross-sliding",
        command: "sed -i 's/\\[3.5, 0.0\\]/[-3.5, 0.0]/' scene.json && \
                  plane-contact solve scene.json --no-pictures --geometry current",
        status: 4,
        contains: &[
            "slides as a whole from 0.87",
            "of stage 2 on",
            "it needs a coefficient of 0.34",
        ],
        lacks: &["no contact state", "times the load"],
    },
    // Both loads at once.
    Case {
        input: "gross-sliding",
        command: "sed -i 's/, \"stage\": [12]//g' scene.json && plane-contact solve scene.json --no-pictures",
        status: 4,
        contains: &["slides as a whole under any part of the load", "a coefficient of 0.35"],
        lacks: &["no contact state", "times the load"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact trade scene.json --only c_tll --runs 1",
        status: 0,
        contains: &[
            "No error against the equilibrium is known: there is no equilibrium: friction cannot hold the load",
        ],
        lacks: &["panicked"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact audit scene.json --full",
        status: 0,
        contains: &[
            "no equilibrium under the scene's own friction to compare with: there is no equilibrium: friction",
            "no reference solution to compare with: node 114 of body \"2\" can move in x",
        ],
        lacks: &["panicked"],
    },
    // Turned by half a radian.
    Case {
        input: "gross-sliding",
        command: "python3 -c 'import json, math; s = json.load(open(\"scene.json\")); c, d = math.cos(0.5), math.sin(0.5); \
                  s[\"node\"] = [[n, c * x - d * y, d * x + c * y, z] for n, x, y, z in s[\"node\"]]; \
                  s[\"loads\"][1][\"traction\"] = [3.5 * c, 3.5 * d]; json.dump(s, open(\"scene.json\", \"w\"))' && \
                  plane-contact solve scene.json --no-pictures",
        status: 4,
        contains: &["slides as a whole from 0.857 of stage 2 on", "a coefficient of 0.35"],
        lacks: &["no contact state", "times the load"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact solve scene.json --no-pictures --no-error-estimate --friction 0.36",
        status: 0,
        contains: &["Equilibrium"],
        lacks: &["cannot hold"],
    },
    Case {
        input: "gross-sliding",
        command: "plane-contact solve scene.json --no-pictures --friction 0",
        status: 2,
        contains: &["can move in x with every contact node in contact"],
        lacks: &["panicked"],
    },
    Case {
        input: "units",
        command: "plane-contact solve scene.json --no-pictures",
        status: 0,
        contains: &["the von Mises strain reaches 0.33", "check the units of E and of the load"],
        lacks: &["panicked"],
    },
    // The same in steel ends, and one a tenth as stiff says how large its strains are.
    Case {
        input: "units",
        command: "sed -i 's/\"E\": 30,/\"E\": 30000,/; s/\"E\": 210,/\"E\": 210000,/' scene.json && \
                  plane-contact solve scene.json --no-pictures",
        status: 0,
        contains: &["Equilibrium"],
        lacks: &["check the units"],
    },
    Case {
        input: "units",
        command: "sed -i 's/\"E\": 30,/\"E\": 100,/; s/\"E\": 210,/\"E\": 1000,/; s/\"pressure\": 10/\"pressure\": 20/' scene.json && \
                  plane-contact solve scene.json --no-pictures --geometry initial",
        status: 0,
        contains: &["the von Mises strain reaches 0.", "check the units of E and of the load"],
        lacks: &["panicked"],
    },
];
