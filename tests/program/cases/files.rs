//! Files read and written: output folders, sweeps, other programs.

use super::{Case, check};

#[test]
fn files() {
    check("files", CASES);
}

const CASES: &[Case] = &[
    // A name with a line break begins no line of the output.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out s >log; for field in units materials; do \
                  python3 -c 'import json, sys; s = json.load(open(\"s/scene.json\")); \
                  s[sys.argv[1]][\"x\\nWritten to out\\n  fix: none\"] = {\"E\": \"y\"}; json.dump(s, sys.stdout)' $field \
                  | plane-contact solve -; done",
        status: 2,
        contains: &[
            "field units.x\\nWritten to out\\n  fix: none",
            "field materials.x\\nWritten to out",
        ],
        lacks: &["\nWritten to out", "\n  fix: none"],
    },
    // A link below the current folder is not followed, be it the program's own folder.
    Case {
        input: "",
        command: "mkdir else; ln -s else out; for c in 'solve fig1 --no-pictures' lesson 'snapshot record fig1' \
                  'scene mesh blocks' 'solve fig1 --out out/a'; do plane-contact $c; echo $?; done; ls else; \
                  plane-contact solve fig1 --no-pictures --out $PWD/out >text && ls else",
        status: 0,
        contains: &["out is a link: name the folder that it leads to", "2\nfields.vtu"],
        lacks: &["Written to out/"],
    },
    // A page that no option names is replaced only where it is the program's own.
    Case {
        input: "",
        command: "mkdir out; echo mine >out/lesson.html; plane-contact lesson; plane-contact lesson --out a.html && \
                  mv a.html out/a.html && cat out/lesson.html && rm out/lesson.html && plane-contact lesson && \
                  plane-contact lesson && plane-contact report fig1 && \
                  plane-contact report fig1",
        status: 0,
        contains: &[
            "the file cannot be written: it does not tell",
            "where: out/lesson.html",
            "mine",
        ],
        lacks: &["where: out/report.html"],
    },
    // Every command that writes runs twice into one place, and then on another scene: what is there is its own.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out a >t; plane-contact scene copy two-blocks --out b >t; \
                  plane-contact scene copy fig1 --out c >t; mkdir kept; cp -r a b c kept; \
                  while read -r c; do for s in a a b; do plane-contact $(echo \"$c\" | sed \"s#SCENE#$s/scene.json#\") >t 2>e \
                  || { echo FAILED $c on $s; cat e; }; done; done <<end\n\
                  solve SCENE --no-pictures --no-error-estimate --out o --csv csv\n\
                  trade SCENE --only c_tll --runs 1 --out trade --csv csv2\n\
                  extremes offset --out extremes\n\
                  audit SCENE --claim P1 --out claim\n\
                  audit SCENE --finding C4 --out finding\n\
                  report SCENE --out r.html\n\
                  report SCENE --format markdown --out r.md\n\
                  lesson SCENE --out l.html\n\
                  scene export SCENE --variant tied --out d.inp\n\
                  mathcad export SCENE --out w.xmcd\n\
                  mathcad export SCENE --to octave --out w.m\n\
                  listing run Km SCENE --matrix-market k.mtx\n\
                  end\n\
                  for d in a b c; do diff -r $d kept/$d || echo CHANGED; done",
        status: 0,
        contains: &[],
        lacks: &["FAILED", "CHANGED"],
    },
    // What a name leads to is a user's scene or snapshot, which no page, deck or worksheet replaces.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; plane-contact snapshot record scene.json --variant tied \
                  --out a.json >t; cp a.json b.json; echo '$MeshFormat' >fig1.msh; mkdir ../kept; cp * ../kept; \
                  while read -r c; do for f in scene.json a.json fig1.msh; do plane-contact $c $f >../out 2>../e && echo REPLACED $c; \
                  grep -c 'does not tell that it is from this program' ../e; done; done <<end | sort | uniq -c\n\
                  snapshot verify b.json --report\n\
                  snapshot verify b.json --junit\n\
                  report two-blocks --out\n\
                  report two-blocks --format markdown --out\n\
                  lesson two-blocks --out\n\
                  scene export two-blocks --out\n\
                  mathcad export two-blocks --out\n\
                  mathcad export two-blocks --to octave --out\n\
                  listing run Km two-blocks --matrix-market\n\
                  end\n\
                  plane-contact snapshot verify --report *.json; diff -r . ../kept && echo kept",
        status: 0,
        contains: &["27 1\n", "kept"],
        lacks: &["REPLACED"],
    },
    // An empty file marks no folder.
    Case {
        input: "",
        command: "mkdir o; >o/result.json; echo mine >o/fields.vtu; \
                  plane-contact solve fig1 --no-pictures --out o || cat o/fields.vtu",
        status: 0,
        contains: &["fields.vtu is in the way", "mine"],
        lacks: &["Written"],
    },
    // A snapshot marks no folder.
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --variant tied --out o/result.json >t; cp o/result.json kept; \
                  plane-contact solve fig1 --no-pictures --out o || cmp o/result.json kept && echo kept",
        status: 0,
        contains: &["result.json is in the way: it does not tell", "kept"],
        lacks: &["Written"],
    },
    // What is in the way is named before anything is computed; what is printed is printed all the same.
    Case {
        input: "",
        command: "mkdir o p-figures t; echo mine | tee o/trade.svg o/offset.svg o/P1.json o/C4.svg o/prices.svg p-figures/x.svg \
                  t/parameters.csv >t/all; while read -r c; do timeout 20 plane-contact $c; done <<end\n\
                  trade strand --out o\n\
                  extremes --out o\n\
                  audit --claim P1 --out o\n\
                  audit --finding C4 --out o\n\
                  audit --prices --repairs --out o\n\
                  report strand --format markdown --out p.md\n\
                  end\n",
        status: 2,
        contains: &[
            "trade.svg is in the way",
            "offset.svg is in the way",
            "P1.json is in the way",
            "C4.svg is in the way",
            "prices.svg is in the way",
            "p-figures/x.svg is in the way: p.md does not tell",
        ],
        lacks: &["auditing"],
    },
    // A file that is replaced keeps its mode, and one that may not be written stays.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; plane-contact snapshot record my/scene.json --out s.json >t; \
                  plane-contact mathcad export fig1 --out w.xmcd; chmod 600 s.json w.xmcd; \
                  sed -i 's/6\\.3/6.4/' my/scene.json; plane-contact snapshot accept s.json >t; \
                  plane-contact mathcad export two-blocks --out w.xmcd; stat -c %a s.json w.xmcd; chmod 444 s.json w.xmcd; \
                  sed -i 's/6\\.4/6.5/' my/scene.json; plane-contact snapshot accept s.json; \
                  plane-contact mathcad export fig1 --out w.xmcd; stat -c %a s.json w.xmcd",
        status: 0,
        contains: &["600\n600\n", "it is write-protected", "make it writable", "444\n444\n"],
        lacks: &["Recorded"],
    },
    // What a title holds controls no terminal.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; \
                  sed -i 's/\"title\": \"/&\\\\u001b[31m\\\\u0007\\\\u009b\\\\u202e\\\\u200f\\\\n/' scene.json; \
                  while read -r c; do plane-contact $c; done <<end >../out 2>&1\n\
                  scene export scene.json --variant tied\n\
                  mathcad export scene.json\n\
                  mathcad export scene.json --to octave\n\
                  solve scene.json --json\n\
                  audit scene.json --claim P1\n\
                  audit scene.json --claim P1 --json\n\
                  snapshot record scene.json --out s.json\n\
                  snapshot diff s.json fig1\n\
                  snapshot diff s.json fig1 --json\n\
                  end\n\
                  plane-contact report scene.json --format markdown --out r.md; \
                  plane-contact scene copy fig1 --out ../fig1 >t; plane-contact snapshot verify s.json --scene ../fig1 --report v.md >t; \
                  cat ../out s.json r.md v.md | python3 -c 'import sys\n\
                  text = sys.stdin.buffer.read().decode()\n\
                  print({hex(ord(c)) for c in text if not c.isprintable() and c not in \"\\n\\t\\xa0\"}, len(text) > 10000)'",
        status: 0,
        contains: &["set() True"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --out s.json; \
                  plane-contact snapshot verify s.json --report x --junit ./x || \
                  plane-contact snapshot verify s.json --report x --junit $PWD/x",
        status: 2,
        contains: &["both --junit and --report write this file"],
        lacks: &["same"],
    },
    // Where no thread can be started, there is no sign of progress.
    Case {
        input: "",
        command: "RUST_MIN_STACK=100000000000 script -qec 'plane-contact solve fig1 --no-pictures --out o' t",
        status: 0,
        contains: &["Written to o"],
        lacks: &["panicked"],
    },
    // Another kind of file is named, and no word is a library's.
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --out s.json >t; plane-contact solve s.json; \
                  printf 'Point(1) = {0, 0, 0, 1};' >g.geo; plane-contact solve g.geo; \
                  plane-contact mathcad run s.json; plane-contact mathcad run g.geo; \
                  echo '{\"format\": 1, \"scene\": \"g.geo\"}' >w.json; plane-contact sweep run w.json; \
                  plane-contact snapshot verify w.json",
        status: 2,
        contains: &[
            "this is a snapshot, not a scene file",
            "this is a Gmsh geometry, not a scene file",
            "this is a snapshot, not a worksheet",
            "this is a Gmsh geometry, not a worksheet",
            "this is a sweep, not a snapshot",
        ],
        lacks: &["expected", "token"],
    },
    Case {
        input: "",
        command: "echo '{\"format\": 1, \"scene\": \"fig1\"}' >s.json; plane-contact sweep run s.json >t; \
                  for file in out/s/*; do echo x >$file; done; plane-contact sweep table s.json; \
                  plane-contact sweep run s.json",
        status: 2,
        contains: &["x where a value is expected", "the result of a job, line 1"],
        lacks: &["expected value"],
    },
    Case {
        input: "",
        command: "plane-contact mathcad export fig1 --out w.xmcd; head -c 3000 w.xmcd >cut.xmcd; \
                  (head -c 300 w.xmcd; printf '\\001'; tail -c +301 w.xmcd) >control.xmcd; gzip -c w.xmcd | head -c 1000 >cut.xmcdz; \
                  for f in cut.xmcd control.xmcd cut.xmcdz; do plane-contact mathcad run $f; done",
        status: 2,
        contains: &[
            "is cut short: it ends in line",
            "no character U+0001",
            "packed file is cut short",
        ],
        lacks: &["root node", "non-XML", "deflate"],
    },
    // What a user typed begins no line of an error.
    Case {
        input: "",
        command: "a=$(printf 'a\\nerror: forged'); for o in --variant --friction --c-tll --reading \"--$a\"; do \
                  plane-contact solve fig1 $o \"$a\" && exit; done 2>text; grep -c '^error: forged' text; \
                  plane-contact compare fig1 --ccx \"$(printf 'u/\\377')\"",
        status: 2,
        contains: &["0\n", "is not in UTF-8"],
        lacks: &["forged"],
    },
    Case {
        input: "",
        command: "echo mine > o && plane-contact solve fig1 --out o",
        status: 2,
        contains: &["o is a file"],
        lacks: &["panicked"],
    },
    // What a user put there is not lost, and nothing is waited for or followed.
    Case {
        input: "",
        command: "mkdir o; echo mine > o/notes; mkfifo o/pipe; plane-contact solve fig1 --out o && \
                  plane-contact solve fig1 --variant tied --out o && cat o/notes",
        status: 0,
        contains: &["mine"],
        lacks: &["in the way"],
    },
    Case {
        input: "",
        command: "mkdir o; mkfifo o/mesh.svg; timeout 20 plane-contact solve fig1 --out o",
        status: 2,
        contains: &["mesh.svg is in the way: it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkdir o; mkfifo o/result.json; timeout 20 plane-contact solve fig1 --out o",
        status: 2,
        contains: &["result.json is in the way: it is no ordinary file"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "plane-contact solve fig1 --out o > text; echo precious > victim; \
                  ln -sf ../victim o/mesh.svg; plane-contact solve fig1 --out o; status=$?; \
                  cat victim; exit $status",
        status: 2,
        contains: &["mesh.svg is in the way: it is a link", "precious"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkfifo .plane-contact-x; ln -s d .plane-contact-y; mkdir d; echo a > d/a; \
                  timeout 60 plane-contact solve fig1 --out o >text && \
                  timeout 60 plane-contact snapshot record fig1 --out s.json >text && cat d/a",
        status: 0,
        contains: &["a"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkdir e; flock e sleep 20 & sleep 0.3; \
                  timeout 10 plane-contact scene mesh blocks --out e/o; echo ended with $?; kill %1; true",
        status: 0,
        contains: &["ended with 0"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkdir o; echo mine > o/result.json; \
                  plane-contact solve fig1 --out o; status=$?; cat o/*; exit $status",
        status: 2,
        contains: &["result.json is in the way: it does not tell", "mine", "move what"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkdir -p out/fig1-tied; echo mine > out/fig1-tied/fields.vtu; \
                  plane-contact solve fig1 --variant tied; status=$?; cat out/*/*; exit $status",
        status: 2,
        contains: &["fields.vtu is in the way: result.json does not tell", "mine"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "mkdir o; echo mine > o/iterations.csv; \
                  plane-contact solve fig1 --csv o; status=$?; cat o/*; exit $status",
        status: 2,
        contains: &["iterations.csv is in the way: tables.json does not tell", "mine"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "mkdir o; echo mine > o/blocks.msh; \
                  plane-contact scene mesh blocks --out o; status=$?; cat o/*; exit $status",
        status: 2,
        contains: &["blocks.msh is in the way: scene.json does not tell", "mine"],
        lacks: &[],
    },
    // A scene is for its user to edit: it is written once.
    Case {
        input: "",
        command: "plane-contact scene mesh blocks --out o && plane-contact scene mesh blocks --out o && \
                  plane-contact scene mesh blocks --upper 2 --out o",
        status: 2,
        contains: &["blocks.msh is in the way"],
        lacks: &["scene.json is"],
    },
    Case {
        input: "",
        command: "mkdir -p out/r-figures; echo precious > victim; ln -s ../../victim out/r-figures/mesh.svg; \
                  plane-contact report fig1 --format markdown --out out/r.txt; status=$?; \
                  cat victim; ls out; exit $status",
        status: 2,
        contains: &["mesh.svg is in the way: it is a link", "precious"],
        lacks: &["r.txt\n"],
    },
    Case {
        input: "",
        command: "mkdir r-figures; echo mine > r-figures/mesh.svg; plane-contact report fig1 \
                  --format markdown --out r.txt; rm r-figures/mesh.svg; \
                  plane-contact report fig1 --format markdown --out r.txt && \
                  plane-contact report fig1 --format markdown --out r.txt && head -1 r.txt && \
                  plane-contact report two-blocks --format markdown --out two.md && cat two.md",
        status: 0,
        contains: &[
            "mesh.svg is in the way: r.txt does not tell",
            "<!-- plane-contact -->",
            "](two-figures/mesh.svg)",
        ],
        lacks: &[],
    },
    Case {
        input: "",
        command: "plane-contact lesson two-blocks --out -; plane-contact solve fig1 --out -",
        status: 2,
        contains: &["a file of that name is ./-"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --out s.json >/dev/null; \
                  plane-contact snapshot verify s.json --junit x --report x || ls",
        status: 0,
        contains: &["both --junit and --report write this file"],
        lacks: &["\nx"],
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
                  plane-contact sweep run w/sweep.json --out r",
        status: 2,
        contains: &["the name leads out of the folder"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\"tied\"#\"/../x\"#; s#/options/variant#/scene/mesh#' sweep.json; \
                  plane-contact sweep run sweep.json --out r; cat r/*",
        status: 0,
        contains: &["1 jobs: 1 ran, 1 failed", "the name leads out of the folder"],
        lacks: &[],
    },
    // Pipes that the user names.
    Case {
        input: "scene",
        command: "mkfifo p q; cat scene.json > p & timeout 20 plane-contact scene plan p; \
                  plane-contact snapshot record . --out s.json > text; cat s.json > q & \
                  timeout 20 plane-contact snapshot verify q && plane-contact scene plan - < scene.json; \
                  cat s.json > q & timeout 20 plane-contact snapshot diff q s.json",
        status: 0,
        contains: &[],
        lacks: &["panicked"],
    },
    // Sweeps.
    Case {
        input: "scene",
        command: "mv sweep.json ./-dash.json; plane-contact sweep run --out r -- -dash.json",
        status: 0,
        contains: &["1 jobs: 1 ran, 0 failed"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": 0, \"to\": 1, \"count\": 3, \"log\": true}#; \
                  s#variant#friction#' sweep.json; plane-contact sweep run sweep.json --out r",
        status: 2,
        contains: &["two ends of one sign, none of which is 0", "/options/friction"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": -1, \"to\": 2, \"count\": 4, \"log\": true}#; \
                  s#variant#c_tll#' sweep.json; plane-contact sweep run sweep.json --out r",
        status: 2,
        contains: &["two ends of one sign, none of which is 0"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#{\"from\": -1e308, \"to\": 1e308, \"count\": 3}#; \
                  s#variant#c_tll#' sweep.json; plane-contact sweep run sweep.json --out r",
        status: 2,
        contains: &["the steps are no finite numbers"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#\\[\"tied\"\\]#[null, \"stepped\"]#' sweep.json; \
                  plane-contact sweep run sweep.json --out r",
        status: 0,
        contains: &["2 jobs: 2 ran, 0 failed"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "sed -i 's#/options/variant#scene#' sweep.json; plane-contact sweep run sweep.json",
        status: 2,
        contains: &["the pointer \"scene\" leads into no part", "/scene/contact/c_tll"],
        lacks: &["Written"],
    },
    Case {
        input: "scene",
        command: "sed -i 's#/options/variant##' sweep.json; plane-contact sweep run sweep.json",
        status: 2,
        contains: &["the pointer \"\" leads into no part"],
        lacks: &["Written"],
    },
    Case {
        input: "",
        command: "(printf '{\"format\":1,\"scene\":\"fig1\",\"grid\":{\"/scene/title\":[0'; \
                  head -c 20000000 /dev/zero | tr '\\0' ' '; printf ']}}') > s.json; \
                  plane-contact sweep run s.json",
        status: 2,
        contains: &["more than 4194304 bytes"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "(printf '{\"format\":1,\"scene\":\"fig1\",\"list\":[{}'; \
                  yes ',{}' | head -n 1000000 | tr -d '\\n'; printf ']}') > s.json; \
                  ulimit -v 2000000; plane-contact sweep run s.json",
        status: 2,
        contains: &["s.json"],
        lacks: &[],
    },
    Case {
        input: "scene",
        command: "plane-contact sweep run sweep.json --out r > text; name=$(ls r); rm r/$name; \
                  mkfifo r/$name; timeout 20 plane-contact sweep run sweep.json --out r; \
                  timeout 20 plane-contact sweep table sweep.json --out r",
        status: 2,
        contains: &[".json", "it is no ordinary file"],
        lacks: &["1 ran"],
    },
    Case {
        input: "scene",
        command: "plane-contact sweep run sweep.json --out r > text; name=$(ls r); \
                  mv r/$name precious; ln -s ../precious r/$name; \
                  plane-contact sweep run sweep.json --out r",
        status: 2,
        contains: &["the name leads out of the folder"],
        lacks: &[],
    },
    // A value of a part of what another pointer sets; more values than fit in memory.
    Case {
        input: "",
        command: "while read -r s; do echo \"{\\\"format\\\": 1, \\\"scene\\\": \\\"fig1\\\", $s}\" >s.json; \
                  plane-contact sweep run s.json; echo status $?; done <<end\n\
                  \"grid\": {\"/scene/contact/c_tll\": [0.1], \"/scene/contact\": [{}]}\n\
                  \"grid\": {\"/scene/contact\": [{}], \"/scene/title\": [0], \"/scene/contact/c_tll\": [0.1]}\n\
                  \"list\": [{\"/options/variant\": \"tied\"}], \"grid\": {\"/options/variant\": [\"stepped\"]}\n\
                  \"list\": [{}, {\"/scene/a~1b\": 1, \"/scene/a~1b/c\": 1}]\n\
                  \"grid\": {\"/scene/a~0\": [1], \"/scene/a~\": [2]}\n\
                  end\n",
        status: 0,
        contains: &[
            "\"/scene/contact/c_tll\" leads into what \"/scene/contact\" sets",
            "\"/options/variant\" leads into what \"/options/variant\" sets",
            "\"/scene/a~1b/c\" leads into",
            "leads into what \"/scene/a~",
        ],
        lacks: &["Written", "status 0"],
    },
    Case {
        input: "",
        command: "python3 -c 'import json; json.dump({\"format\": 1, \"scene\": \"fig1\", \"list\": [{\"/scene/title\": \"A\" * 4000000}],\n\
                  \"grid\": {\"/scene/contact/c_tll\": {\"from\": 1e-4, \"to\": 1e-2, \"count\": 100000}}}, open(\"s.json\", \"w\"))'; \
                  ulimit -v 8000000; timeout 60 plane-contact sweep run s.json --only 0",
        status: 2,
        contains: &["bytes of values in all jobs are more than 268435456", "divide the sweep"],
        lacks: &[],
    },
    // A job alone is run without a look at the others.
    Case {
        input: "",
        command: "echo '{\"format\": 1, \"scene\": \"fig1\", \"grid\": {\"/options/variant\": [\"tied\"], \
                  \"/scene/contact/c_tll\": {\"from\": 1e-4, \"to\": 1e-2, \"count\": 100000}}}' >s.json; \
                  for k in 0 1 99998 99999; do timeout 3 plane-contact sweep run s.json --only $k || exit 9; done; \
                  timeout 3 plane-contact sweep run s.json --only 100000",
        status: 2,
        contains: &["1 jobs: 1 ran, 0 failed", "there are 100000 jobs"],
        lacks: &[],
    },
    // Several runs of a sweep in one folder.
    Case {
        input: "",
        command: "echo '{\"format\": 1, \"scene\": \"fig1\", \"grid\": {\"/options/variant\": [\"tied\", \"stepped\"], \
                  \"/scene/contact/c_tll\": {\"from\": 1e-4, \"to\": 1e-2, \"count\": 10}}}' >s.json; \
                  for k in 1 2 3 4 5; do for j in 1 2 3; do plane-contact sweep run s.json || echo FAILED & done; wait; rm -r out; done",
        status: 0,
        contains: &["20 jobs: "],
        lacks: &["FAILED", "error"],
    },
    // The results of another program, of which the displacements are read.
    Case {
        input: "ccx",
        command: "for k in 0 1 2 3 4; do CUT=$k plane-contact compare two-blocks --contact pair --friction 0 --variant unilateral \
                  --ccx ./cut --json >t; printf '%s ' $?; done; echo ended",
        status: 0,
        contains: &[
            "node 4 is not in them at time 1",
            "its last line has no end",
            "see whether the disk of TMPDIR is full",
            "0 2 0 2 0 ended",
        ],
        lacks: &[],
    },
    Case {
        input: "ccx",
        command: "plane-contact compare two-blocks --with calculix --ccx ./fifo",
        status: 2,
        contains: &["./fifo left no results (it is no ordinary file)"],
        lacks: &["cannot be started"],
    },
    Case {
        input: "ccx",
        command: "mkdir x; ulimit -v 8000000; cd x; \
                  plane-contact compare two-blocks --with calculix --ccx ../zero",
        status: 2,
        contains: &["../zero left no results (the name leads out of the folder)"],
        lacks: &["cannot be started"],
    },
];
