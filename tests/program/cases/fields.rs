//! Displacements from elsewhere beside the reference solution. Those of `fig1` are its own without friction, written
//! by hand.

use super::{Case, check};

#[test]
fn fields() {
    check("fields", CASES);
}

const CASES: &[Case] = &[
    Case {
        input: "fig1",
        command: "for file in numbers.csv places.csv; do \
                  plane-contact compare fig1 --friction 0 --with $file || exit; done",
        status: 0,
        contains: &["Same within --rtol 0.001", "by number", "by coordinates"],
        lacks: &["Differs", "NOTE"],
    },
    Case {
        input: "",
        command: "plane-contact solve fig1 --variant unilateral --coupling mortar --friction 0 --no-pictures \
                  --out o --csv csv >log && \
                  plane-contact compare fig1 --friction 0 --rtol 0 --with csv/nodes.csv",
        status: 0,
        contains: &["Same within --rtol 0 (energy norm 0 %)"],
        lacks: &["Differs", "NOTE", "The worst nodes"],
    },
    // The distance is the one that solve prints.
    Case {
        input: "",
        command: "plane-contact solve fig1 --variant stepped --friction 0 --no-pictures --out o --csv csv >log && \
                  plane-contact compare fig1 --friction 0 --with csv/nodes.csv >other; status=$?; \
                  tail -n +2 other; \
                  far=$(sed -n 's/.*energy norm of the difference: //p' log | tail -1) && \
                  grep -q \"(energy norm $far)\" other && echo \"as solve says\"; exit $status",
        status: 1,
        contains: &[
            "Differs by more than --rtol 0.001",
            "as solve says",
            "deepest penetration",
            "The worst nodes",
        ],
        lacks: &["(energy norm 0 %)"],
    },
    Case {
        input: "fig1",
        command: "awk -F, -v OFS=, -v CONVFMT=%.17g 'NR>1{$2*=1.01;$3*=1.01}1' numbers.csv >more.csv; \
                  plane-contact compare fig1 --friction 0 --with more.csv --rtol 0.0101 && \
                  plane-contact compare fig1 --friction 0 --with more.csv",
        status: 1,
        contains: &["Same within --rtol 0.0101", "(energy norm 1.0", "1.00 % of the largest"],
        lacks: &["panicked"],
    },
    Case {
        input: "fig1",
        command: "plane-contact compare fig1 --friction 0 --with numbers.csv --json",
        status: 0,
        contains: &[
            "\"is_same\":true",
            "\"energy_relative\":",
            "\"contact\":{\"field\":{\"force\"",
        ],
        lacks: &["Result"],
    },
    Case {
        input: "fig1",
        command: "sed 3d numbers.csv >few.csv; sed '4s/.*/4,nan,0/' numbers.csv >nan.csv; \
                  sed 's/U1/V/' numbers.csv >names.csv; sed 's/^3,/2,/' numbers.csv >twice.csv; \
                  sed 's/^3,/14,/' numbers.csv >more.csv; sed '2s/;/x;/' places.csv >words.csv; \
                  sed '5s/^/1/' places.csv >moved.csv; cp numbers.csv field.vtu; \
                  for file in few.csv nan.csv names.csv twice.csv more.csv words.csv moved.csv none.csv field.vtu \
                  none.vtk; do \
                  plane-contact compare fig1 --friction 0 --with $file; echo \"$file $?\"; done; \
                  plane-contact compare fig1 --with numbers.csv --friction 0 --penalty 1",
        status: 2,
        contains: &[
            "1 of the scene's 13 nodes have no displacement, the first node 2",
            "line 4 (node 4) has no finite displacement",
            "\"Node | V | U2\"",
            "node 2 is that of line 3 and of line 4",
            "line 4: the mesh has no node 14",
            "is no number, such as",
            "is at no node of the scene",
            "No such file",
            "the file is no .csv",
            "meshio.read(FIELD)",
            "few.csv 2",
            "field.vtu 2",
            "none.vtk 2",
            "belong to --with calculix",
        ],
        lacks: &["panicked", ".csv 0", ".vtu 0", ".csv 1"],
    },
    // What means displacement, in which unit, at which nodes.
    Case {
        input: "fig1",
        command: "sed '1s/U1/ux [furlong]/' numbers.csv >unit.csv; sed 's/,/;/g; s/\\./,/g' numbers.csv >comma.csv; \
                  sed '2s/$/,1/' numbers.csv >cells.csv; sed '1s/$/,uz/; 2,$s/$/,1/' numbers.csv >z.csv; \
                  for file in unit.csv comma.csv cells.csv z.csv; do \
                  plane-contact compare fig1 --friction 0 --with $file; echo \"$file $?\"; done; \
                  plane-contact compare fig1 --with numbers.csv --reading R4=eager --variant printed",
        status: 2,
        contains: &[
            "\"ux [furlong]\" is in furlong, the scene in",
            "has a decimal comma: write a point",
            "a decimal comma would separate cells",
            "moves along z by 1",
            "the run of printed does not finish",
        ],
        lacks: &["panicked", ".csv 0", ".vtu 0", ".csv 1"],
    },
    // The numbers of a mesh with a node in no triangle; and numbers of another mesh beside right places.
    Case {
        input: "",
        command: "plane-contact scene copy strand --out s >log; \
                  sed -i 's/\"mesh\"/\"drop_orphans\": true, \"mesh\"/' s/scene.json; \
                  awk '/\\$EndNodes/ {print n + 1, 7, 99, 0} c == 2 {c = 0; n = $1; $1 = n + 1} /\\$Nodes/ {c = 2} 1' \
                  s/strand.msh >m && mv m s/strand.msh; \
                  plane-contact solve s --friction 0 --variant unilateral --coupling mortar --no-pictures \
                  --no-assessment --out o --csv csv >log; \
                  plane-contact compare s --friction 0 --with csv/nodes.csv --rtol 0",
        status: 0,
        contains: &["found by number", "Same within --rtol 0 ("],
        lacks: &["panicked"],
    },
    Case {
        input: "fig1",
        command: "sed '1s/^/id;/; 2,$s/^/7;/' places.csv >others.csv; \
                  plane-contact compare fig1 --friction 0 --with others.csv",
        status: 2,
        contains: &["line 2 has node 7 at 2.8, 1; in the scene it is at"],
        lacks: &["panicked"],
    },
    // A table of more cells than memory should hold.
    Case {
        input: "",
        command: "head -c 50000000 /dev/zero | tr '\\0' ',' >wide.csv; (echo node,ux,uy; yes 1,1,1 | head -c 90000000) >long.csv; \
                  ulimit -v 4000000; for file in wide long; do \
                  timeout 20 plane-contact compare fig1 --friction 0 --with $file.csv; echo $?; done; \
                  (echo node; head -c 1000000 /dev/zero | tr '\\0' x) | tr '\\n' , >names.csv; \
                  plane-contact compare fig1 --friction 0 --with names.csv",
        status: 2,
        contains: &[
            "50000000 cells in one table are more than",
            "cells in one table are more than",
            "the first line names",
        ],
        lacks: &["panicked", "124\n", "134\n"],
    },
    // Bodies that touch have two nodes at one place.
    Case {
        input: "",
        command: "plane-contact solve strand --variant unilateral --coupling mortar --friction 0 --no-pictures \
                  --no-assessment --out o --csv csv >log; \
                  (echo x,y,ux,uy; tail -n +2 csv/nodes.csv | tac | cut -d, -f2-5) >places.csv; \
                  plane-contact compare strand --friction 0 --with places.csv",
        status: 2,
        contains: &["is that of node 35 and of node 113", "add a column node"],
        lacks: &["panicked"],
    },
];
