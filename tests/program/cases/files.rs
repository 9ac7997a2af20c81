//! Files read and written: output folders, sweeps, other programs.

use super::{Case, check};

#[test]
fn files() {
    check("files", CASES);
}

/// Lines of the shell after `listed FILE NAME`, which writes a list with that name as this program does,
/// and `solve`.
macro_rules! listed {
    ($($line:literal),*) => {
        concat!(
            "listed() { printf '# plane-contact solve\n%s  %s\n' ",
            "\"$(sha256sum < \"$1\" | cut -c1-64)\" \"$2\" > o/SHA256SUMS; }\n",
            "solve() { timeout 60 plane-contact solve fig1 --out o; echo ended with $?; }\n",
            "mkdir o d; echo precious > d/victim; echo mine > o/notes\n",
            $($line, "\n"),*
        )
    };
}

const CASES: &[Case] = &[
    Case {
        input: "",
        command: "echo mine > o && plane-contact solve fig1 --out o",
        status: 2,
        contains: &["o is a file"],
        lacks: &["panicked"],
    },
    // What a list names outside its folder stays, and so does what one names that is not as written.
    Case {
        input: "",
        command: listed!("listed d/victim ../d/victim", "solve; cat d/victim o/notes"),
        status: 0,
        contains: &["ended with 0", "precious", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!("listed d/victim \"$PWD/d/victim\"", "solve; cat d/victim o/notes"),
        status: 0,
        contains: &["ended with 0", "precious", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!(
            "ln -s ../d o/sub; listed d/victim sub/victim; solve; cat d/victim o/notes"
        ),
        status: 0,
        contains: &["ended with 0", "precious", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!(
            "listed o/notes notes; sed -i 's#notes#./notes#' o/SHA256SUMS; solve; cat o/notes"
        ),
        status: 0,
        contains: &["ended with 0", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!(
            "listed o/notes notes; echo 'a line of the user' >> o/SHA256SUMS; solve; cat o/notes"
        ),
        status: 0,
        contains: &["ended with 0", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!("sha256sum o/notes > o/SHA256SUMS; solve; cat o/notes o/SHA256SUMS"),
        status: 0,
        contains: &["ended with 2", "SHA256SUMS is in the way: it is no list of this", "o/notes"],
        lacks: &["Written"],
    },
    // What is no ordinary file is not waited for, and not read without end.
    Case {
        input: "",
        command: "mkdir o; mkfifo o/SHA256SUMS; timeout 20 plane-contact solve fig1 --out o",
        status: 2,
        contains: &["SHA256SUMS is in the way: it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!("mkfifo o/pipe; listed o/notes pipe; solve"),
        status: 0,
        contains: &["ended with 2", "pipe is in the way: it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "",
        command: listed!("ln -s /dev/zero o/x; listed o/notes x; solve"),
        status: 0,
        contains: &["ended with 2", "x is in the way: it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkfifo .plane-contact-staged-x; ln -s d .plane-contact-staged-y; mkdir d; echo a > d/a; \
                  timeout 60 plane-contact solve fig1 --out o >text && \
                  timeout 60 plane-contact snapshot record fig1 --out s.json >text && cat d/a",
        status: 0,
        contains: &["a"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkdir e; flock e sleep 20 & sleep 0.3; timeout -s TERM 1 \
                  plane-contact scene mesh blocks --out e/o; echo ended with $?; kill %1; ls -A e",
        status: 0,
        contains: &["ended with 124"],
        lacks: &["staged"],
    },
    // What a user changed or put there is not lost.
    Case {
        input: "",
        command: "plane-contact solve fig1 --out o > text; echo '<!-- mine -->' >> o/mesh.svg; \
                  plane-contact solve fig1 --out o; status=$?; tail -1 o/mesh.svg; exit $status",
        status: 2,
        contains: &["mesh.svg is in the way: it was changed since it was written", "<!-- mine -->"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkdir o; echo mine > o/result.json; \
                  plane-contact solve fig1 --out o; status=$?; cat o/*; exit $status",
        status: 2,
        contains: &["result.json is in the way: it is not from this program", "mine", "move what"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkdir -p out/fig1-tied; echo mine > out/fig1-tied/fields.vtu; \
                  plane-contact solve fig1 --variant tied; status=$?; cat out/*/*; exit $status",
        status: 2,
        contains: &["fields.vtu is in the way: it is not from this program", "mine"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkdir o; echo mine > o/cook.msh; \
                  plane-contact scene mesh cook --n 2 --out o; status=$?; cat o/*; exit $status",
        status: 2,
        contains: &["cook.msh is in the way: it is not from this program", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "for i in 1 2 3 4 5; do \
                  plane-contact snapshot record fig1 --variant tied --out s.json >/dev/null 2>&1 & \
                  plane-contact snapshot record fig1 --variant printed --out s.json >/dev/null 2>&1; \
                  first=$?; wait $!; echo sum $(($? + first)); rm s.json; done",
        status: 0,
        contains: &["sum 2"],
        lacks: &["sum 0", "sum 4"],
    },
    // The mesh of a scene lies in its folder.
    Case {
        input: "scene",
        command: "mkdir s; mv scene.json cook.msh s; sed -i 's#cook.msh#../secret#' s/scene.json; \
                  echo 'root:*:20228' > secret; plane-contact solve s --json",
        status: 2,
        contains: &["the name leads out of the folder", "in its folder or below"],
        lacks: &["root:"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#cook.msh#/proc/self/environ#' scene.json; SECRET=1 plane-contact scene plan .",
        status: 2,
        contains: &["the name leads out of the folder"],
        lacks: &["SECRET"],
    },
    Case {
        input: "scene",
        command: "mkdir s; mv scene.json s; ln -s ../cook.msh s/cook.msh; plane-contact scene plan s",
        status: 2,
        contains: &["the name leads out of the folder"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "echo 'root:*:20228' > cook.msh; plane-contact scene plan .",
        status: 2,
        contains: &["it is no mesh of Gmsh", "$MeshFormat"],
        lacks: &["root:"],
    },
    Case {
        input: "scene",
        command: "rm cook.msh; mkfifo cook.msh; timeout 20 plane-contact scene plan .",
        status: 2,
        contains: &["cook.msh", "it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "mkdir m; mv cook.msh m; sed -i 's#cook.msh#m/cook.msh#' scene.json; \
                  plane-contact scene plan .",
        status: 0,
        contains: &["12 free equations"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "mkdir s; mv *.json cook.msh s; mkdir w; cat > w/sweep.json <<end\n\
                  {\"format\": 1, \"scene\": \"../s\", \"grid\": {\"/options/variant\": [\"tied\"]}}\n\
                  end\n\
                  plane-contact sweep w/sweep.json --out r.jsonl",
        status: 2,
        contains: &["the name leads out of the folder"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\"tied\"#\"/../x\"#; s#/options/variant#/scene/mesh#' sweep.json; \
                  plane-contact sweep sweep.json --out r.jsonl; cat r.jsonl",
        status: 0,
        contains: &["1 cases: 1 ran, 1 failed", "the name leads out of the folder"],
        lacks: &[],
    },
    // Pipes that the user names.
    Case {
        input: "scene",
        command: "mkfifo p q; cat scene.json > p & plane-contact scene key p; \
                  plane-contact snapshot record . --out s.json > text; cat s.json > q & \
                  plane-contact snapshot verify q && plane-contact scene key - < scene.json",
        status: 0,
        contains: &[],
        lacks: &["error"],
    },
    Case {
        input: "scene",
        command: "cat sweep.json | timeout 20 plane-contact sweep /dev/stdin --out r.jsonl",
        status: 2,
        contains: &["no ordinary file", "write the sweep to a file"],
        lacks: &[],
    },
    // Sweeps.
    Case {
        input: "scene",
        command: "mv sweep.json ./-dash.json; plane-contact sweep --out r.jsonl -- -dash.json",
        status: 0,
        contains: &["1 cases: 1 ran, 0 failed"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": 0, \"to\": 1, \"count\": 3, \"log\": true}#; \
                  s#variant#friction#' sweep.json; plane-contact sweep sweep.json --out r.jsonl",
        status: 2,
        contains: &["two ends of one sign, none of which is 0", "/options/friction"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": -1, \"to\": 2, \"count\": 4, \"log\": true}#; \
                  s#variant#c_tll#' sweep.json; plane-contact sweep sweep.json --out r.jsonl",
        status: 2,
        contains: &["two ends of one sign, none of which is 0"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": -1e308, \"to\": 1e308, \"count\": 3}#; \
                  s#variant#c_tll#' sweep.json; plane-contact sweep sweep.json --out r.jsonl",
        status: 2,
        contains: &["the steps are no finite numbers"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#[null, \"stepped\"]#' sweep.json; \
                  plane-contact sweep sweep.json --out r.jsonl",
        status: 0,
        contains: &["2 cases: 2 ran, 0 failed"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#/options/variant#scene#' sweep.json; plane-contact sweep sweep.json",
        status: 2,
        contains: &["the pointer \"scene\" leads into no part", "/scene/contact/c_tll"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#/options/variant##' sweep.json; plane-contact sweep sweep.json",
        status: 2,
        contains: &["the pointer \"\" leads into no part"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "(printf '{\"format\":1,\"scene\":\"fig1\",\"grid\":{\"/scene/title\":[0'; \
                  head -c 20000000 /dev/zero | tr '\\0' ' '; printf ']}}') > s.json; \
                  plane-contact sweep s.json",
        status: 2,
        contains: &["more than 16777216 bytes"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "(printf '{\"format\":1,\"scene\":\"fig1\",\"list\":[{}'; \
                  yes ',{}' | head -n 4000000 | tr -d '\\n'; printf ']}') > s.json; \
                  ulimit -v 600000; plane-contact sweep s.json",
        status: 2,
        contains: &["are free"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "echo mine > precious; ln -s precious r.jsonl.journal; \
                  plane-contact sweep sweep.json --out r.jsonl; status=$?; cat precious; exit $status",
        status: 2,
        contains: &["r.jsonl.journal", "it is no ordinary file", "mine"],
        lacks: &["exit_status"],
    },
    Case {
        input: "scene",
        command: "mkdir rows; mkfifo rows/0.json; \
                  timeout 20 plane-contact sweep sweep.json --rows rows --out r.jsonl",
        status: 2,
        contains: &["rows/0.json", "it is no ordinary file"],
        lacks: &[],
    },
    // The results of another program.
    Case {
        input: "ccx",
        command: "plane-contact compare two-blocks --with calculix --ccx ./fifo --out o",
        status: 2,
        contains: &["./fifo left no results (it is no ordinary file)"],
        lacks: &["cannot be started"],
    },
    Case {
        input: "ccx",
        command: "mkdir x; ulimit -v 8000000; cd x; \
                  plane-contact compare two-blocks --with calculix --ccx ../zero --out o",
        status: 2,
        contains: &["../zero left no results (the name leads out of the folder)"],
        lacks: &["cannot be started"],
    },
];
