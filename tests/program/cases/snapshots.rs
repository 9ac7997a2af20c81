use super::{Case, check};

#[test]
fn snapshots() {
    check("snapshots", CASES);
}

/// Records `s.json`.
macro_rules! recorded {
    ($($then:tt)*) => {
        concat!("plane-contact snapshot record fig1 --variant tied --out s.json >record.txt; ", $($then)*)
    };
}

/// Records `s.json` and writes `t.json`, changed by Python, whose `d` is the document and `r` its run.
macro_rules! changed {
    ($change:literal, $then:literal) => {
        recorded!(concat!(
            "python3 -c 'import json; d = json.load(open(\"s.json\")); r = d[\"runs\"][\"tied\"]\n",
            $change,
            "\njson.dump(d, open(\"t.json\", \"w\"))'; ",
            $then
        ))
    };
}

const CASES: &[Case] = &[
    // A broken snapshot is an error among the results, and both reports are written.
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"values\"][2][1] = float(\"nan\")",
            "mkdir folder; cp t.json \"a|b<c>&\\`d\\`.json\"; plane-contact snapshot verify s.json t.json folder none.json \
             \"a|b<c>&\\`d\\`.json\" s.json --junit j.xml --report r.txt; status=$?; cat j.xml r.txt; exit $status"
        ),
        status: 2,
        contains: &[
            "s.json: same, 1 run",
            "t.json: error, it cannot be verified",
            "error: NaN where a finite number is expected",
            "where: none.json",
            "error: the snapshot cannot be read",
            "where: folder",
            "<testsuite name=\"t.json\" tests=\"1\" failures=\"0\" errors=\"1\">",
            "<error message=\"NaN where",
            "a\\|b&lt;c>&amp;\\`d\\`.json: error, it cannot be verified",
            "- tied: same, ",
        ],
        lacks: &["panicked"],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"format\"] = 1",
            "plane-contact snapshot verify s.json t.json --json > v.json; plane-contact schema verify > schema.json; \
             python3 -c 'import json; v = json.load(open(\"v.json\"))[\"files\"]; print(v[0][\"same\"], v[1][\"failure\"][\"kind\"])'"
        ),
        status: 0,
        contains: &["True input"],
        lacks: &[],
    },
    // A scene is its content, whatever the order of keys, line ends and a byte order mark.
    Case {
        input: "",
        command: recorded!(
            "python3 -c 'import json; d = json.load(open(\"s.json\"))\n\
             t = json.dumps(d, sort_keys=True, indent=3).replace(\"\\n\", \"\\r\\n\")\n\
             open(\"t.json\", \"wb\").write(b\"\\xef\\xbb\\xbf\" + t.encode())'; plane-contact snapshot verify t.json"
        ),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "m = d[\"input\"][\"scene\"][\"materials\"]; d[\"input\"][\"scene\"][\"materials\"] = dict(reversed(m.items()))",
            "plane-contact snapshot verify t.json"
        ),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "d[\"input\"][\"scene\"][\"thickness\"] = 2",
            "plane-contact snapshot verify t.json"
        ),
        status: 2,
        contains: &["scene was changed after it was recorded"],
        lacks: &[],
    },
    // Units are facts.
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"load\"][\"unit\"] = \"kN\"; del r[\"numbers\"][\"u\"][\"unit\"]",
            "plane-contact snapshot verify t.json"
        ),
        status: 1,
        contains: &["unit of load: N, was kN", "unit of u: mm, was none"],
        lacks: &[],
    },
    Case {
        input: "units",
        command: "plane-contact snapshot diff scene.json kN.json",
        status: 1,
        contains: &["changed: scene units.force: \"kN\", was \"N\"", "unit of load: kN, was N"],
        lacks: &["same, "],
    },
    // Tolerances.
    Case {
        input: "",
        command: changed!(
            "u = r[\"numbers\"][\"u\"]; u[\"values\"][4][2] *= 1.001; u[\"tolerance\"] = {\"absolute\": 1e-20, \"relative\": 0.01}",
            "plane-contact snapshot verify t.json"
        ),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "y = r[\"numbers\"][\"iteration 1 yt\"]; y[\"values\"] = [1e-18 if x == 0 else x for x in y[\"values\"]]; y[\"tolerance\"] = {\"relative\": 0}",
            "plane-contact snapshot verify t.json"
        ),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"tolerance\"] = {\"absolute\": 1, \"relative\": -0.5}",
            "plane-contact snapshot verify t.json"
        ),
        status: 2,
        contains: &[
            "`relative` is -0.5: a tolerance is `absolute`, `relative` or `ulps`",
            "field runs.tied.numbers.u.tolerance",
        ],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"tolerance\"] = \"1e-3\"",
            "plane-contact snapshot verify t.json"
        ),
        status: 2,
        contains: &["the text \"1e-3\" where an object with `absolute`, `relative` or `ulps`"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"tolerance\"] = {}",
            "plane-contact snapshot verify t.json"
        ),
        status: 2,
        contains: &["it is empty: a tolerance is `absolute`, `relative` or `ulps`"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"bound\"] = -1",
            "plane-contact snapshot verify t.json"
        ),
        status: 2,
        contains: &["what rounding does, the bound, is -1", "numbers.u.bound"],
        lacks: &[],
    },
    // What is no finite number.
    Case {
        input: "overflow",
        command: "plane-contact snapshot record scene.json --variant tied --coupling mortar --status intersection \
                  --solver sparse-lu --out s.json && grep -q null s.json && plane-contact snapshot verify s.json",
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"values\"][2][1] = None",
            "plane-contact snapshot verify t.json"
        ),
        status: 1,
        contains: &["u: 1 of 26 numbers differ", "was no finite number"],
        lacks: &["NaN"],
    },
    // What one side alone has.
    Case {
        input: "",
        command: changed!(
            "del r[\"numbers\"][\"stress\"]; r[\"facts\"][\"statuses\"] = 1",
            "plane-contact snapshot verify t.json"
        ),
        status: 1,
        contains: &["stress: new", "statuses: missing"],
        lacks: &["changed"],
    },
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --variant tied,stepped --out a.json >record.txt; \
                  plane-contact snapshot record fig1 --variant tied,printed --out b.json >record.txt; \
                  plane-contact snapshot diff a.json b.json",
        status: 1,
        contains: &[
            "2 of 3 runs differ",
            "stepped: missing: the old side",
            "printed: new: the old side",
        ],
        lacks: &["changed", "nothing and"],
    },
    // Part of the numbers.
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --variant tied --only u,pressure --out s.json && grep -c iteration s.json; \
                  plane-contact snapshot verify s.json && plane-contact snapshot diff s.json fig1 --variant tied",
        status: 0,
        contains: &["5 facts, ", "s.json: same", "s.json and fig1: same"],
        lacks: &["missing", "new"],
    },
    Case {
        input: "",
        command: "plane-contact snapshot record fig1 --only presure",
        status: 2,
        contains: &["presure", "pressure"],
        lacks: &[],
    },
    // What is accepted.
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"values\"][4][2] = 1",
            "plane-contact snapshot accept t.json && plane-contact snapshot verify t.json"
        ),
        status: 0,
        contains: &["first difference: u, node 5", "t.json: same"],
        lacks: &[],
    },
    // Numbers that a user expects are no longer read, and are not passed over in silence.
    Case {
        input: "",
        command: changed!("r[\"expected\"] = []", "plane-contact snapshot verify t.json"),
        status: 2,
        contains: &["expected"],
        lacks: &[],
    },
    // Time is linear in what a snapshot holds: 100,000 steps took more than half an hour.
    Case {
        input: "steps",
        command: "timeout 300 plane-contact snapshot record scene.json --out s.json && timeout 300 plane-contact snapshot diff s.json s.json",
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    // A change of all stresses by a thousandth, of a scene whose stresses are small beside its displacements.
    Case {
        input: "floor",
        command: "plane-contact snapshot record scene.json --out s.json >t; for k in 1.000001 1.001; do python3 -c 'import json, sys\n\
                  s = json.load(open(\"scene.json\"))\n\
                  for m in s[\"materials\"].values(): m[\"E\"] *= float(sys.argv[1])\n\
                  json.dump(s, open(\"scene.json\", \"w\"))' $k; plane-contact snapshot verify s.json; echo status $?; done",
        status: 0,
        contains: &["status 1", "stress: ", "reactions: ", "pressure: "],
        lacks: &["status 0", "same"],
    },
    // Moduli far apart: what rounding may do at most is more than the numbers, and no limit.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; for r in 1e6 1e8 1e10; do for k in 1.001 1.1 1000; do \
                  python3 -c 'import json, sys\n\
                  s = json.load(open(\"scene.json\")); r, k = map(float, sys.argv[1:]); m = s[\"materials\"]\n\
                  m[\"2\"][\"E\"] = r * m[\"1\"][\"E\"]; json.dump(s, open(\"r.json\", \"w\"))' $r $k; rm -f a.json; \
                  plane-contact snapshot record r.json --variant tied --only stress,pressure,reactions --out a.json >t || echo FAILED; \
                  python3 -c 'import json, sys\n\
                  a = json.load(open(\"a.json\"))\n\
                  for run in a[\"runs\"].values():\n\
                  \x20 for name in (\"stress\", \"pressure\", \"reactions\"):\n\
                  \x20   for row in run[\"numbers\"][name][\"values\"]: row[1:] = [x and float(sys.argv[1]) * x for x in row[1:]]\n\
                  json.dump(a, open(\"b.json\", \"w\"))' $k; \
                  plane-contact snapshot verify a.json >t || echo FAILED; plane-contact snapshot verify b.json >t && echo SAME; done; done",
        status: 1,
        contains: &[],
        lacks: &["FAILED", "SAME", "Error"],
    },
    // What a file says of rounding lets nothing pass: it is measured again. Nor do units that are not those of the scene.
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"stress\"][\"bound\"] = 1e308; r[\"numbers\"][\"stress\"][\"floor\"] = 1e308\n\
             for row in r[\"numbers\"][\"stress\"][\"values\"]: row[1] *= 1.1",
            "plane-contact snapshot verify t.json"
        ),
        status: 1,
        contains: &["stress: 9 of 27 numbers differ"],
        lacks: &["same"],
    },
    // Nor does what one of two files says.
    Case {
        input: "",
        command: changed!(
            "r[\"numbers\"][\"u\"][\"bound\"] = 1e9; r[\"numbers\"][\"u\"][\"values\"][8][2] *= 1.001",
            "plane-contact snapshot diff s.json t.json >t; echo status $?; plane-contact snapshot diff t.json s.json >t; echo status $?"
        ),
        status: 0,
        contains: &["status 1\nstatus 1"],
        lacks: &[],
    },
    // Moduli 1e8 apart, in plane stress, by two solvers: what rounding does to each iteration is known.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; python3 -c 'import json\n\
                  s = json.load(open(\"scene.json\")); s[\"plane\"] = \"stress\"; s[\"materials\"][\"2\"][\"E\"] = 3e12\n\
                  json.dump(s, open(\"r.json\", \"w\"))'; \
                  plane-contact snapshot diff r.json --variant tied --solver dense-lu,sparse-lu",
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
    Case {
        input: "",
        command: changed!("del d[\"units\"][\"stress\"]", "plane-contact snapshot verify t.json"),
        status: 2,
        contains: &["the units are not those of the scene", "field units"],
        lacks: &["same"],
    },
    // What solve refuses is neither verified nor recorded.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; sed -i 's/\"variant\": \"[a-z]*\"/\"variant\": \"unilateral\"/' scene.json; \
                  python3 -c 'import json\n\
                  s = json.load(open(\"scene.json\")); s[\"contact\"].pop(\"friction\", None); json.dump(s, open(\"none.json\", \"w\"))\n\
                  s[\"contact\"][\"friction\"] = 0; json.dump(s, open(\"scene.json\", \"w\"))'; \
                  plane-contact snapshot record scene.json --only u --out s.json >t; cp s.json kept; mv none.json scene.json; \
                  for c in 'verify s.json' 'accept s.json' 'diff s.json scene.json' 'record scene.json --out n.json' \
                  'accept kept --scene scene.json'; do plane-contact snapshot $c; echo status $?; done; cmp s.json kept && ls n.json",
        status: 2,
        contains: &["status 2\n", "nothing is said of friction"],
        lacks: &["status 0", "status 1", "changed", "differ:"],
    },
    // Several are accepted: a scene among them is skipped, and what cannot be read hinders no other.
    Case {
        input: "",
        command: "plane-contact scene copy fig1 --out my >t; cd my; for v in tied stepped; do \
                  plane-contact snapshot record scene.json --variant $v --out $v.json >t; done; echo x >bad.json; \
                  sed -i 's/6\\.3/6.4/' scene.json; plane-contact snapshot accept *.json; echo status $?; \
                  plane-contact snapshot verify stepped.json tied.json",
        status: 0,
        contains: &[
            "scene.json is a scene, and skipped",
            "Recorded again: stepped.json",
            "Recorded again: tied.json",
            "status 2",
            "where: bad.json",
            "tied.json: same",
        ],
        lacks: &["differ:"],
    },
    // A snapshot's scene is a scene near it, and of nothing else a word is told.
    Case {
        input: "",
        command: "mkdir project secret; echo TOKEN >secret/token; echo '{\"TOKEN\": 1}' >secret/keys; plane-contact scene copy fig1 --out project >t; \
                  plane-contact scene copy fig1 --out other >t; sed -i 's/6\\.3/6.4/' other/scene.json; cd project; \
                  plane-contact snapshot record scene.json --variant tied --out a.json >t; ln -s ../secret/token link.json; ln -s ../other/scene.json to.json; \
                  for name in ../secret/token ../secret/keys $PWD/../secret/token link.json to.json $PWD/scene.json ../secret ../nowhere \
                  ../other/scene.json; do sed \"s#\\\"scene_file\\\": \\\"[^\\\"]*\\\"#\\\"scene_file\\\": \\\"$name\\\"#\" a.json >b.json; \
                  for c in 'verify --report v.md --junit j.xml' accept; do plane-contact snapshot $c b.json; echo \"status $?\"; done; cat v.md j.xml; done",
        status: 0,
        contains: &[
            "it is no scene file",
            "the name is absolute",
            "the name leads through a link",
            "it is no ordinary file",
            "scene file ../nowhere is not there",
            "changed: scene loads[0].pressure: 6.4, was 6.3",
        ],
        lacks: &["TOKEN"],
    },
    // Two sides that are one are read once.
    Case {
        input: "units",
        command: "plane-contact snapshot diff - --variant tied,stepped <scene.json; plane-contact snapshot diff - - <scene.json",
        status: 0,
        contains: &["- and -: same"],
        lacks: &["error"],
    },
    // The remedy stands on a line of its own.
    Case {
        input: "",
        command: recorded!("plane-contact snapshot record fig1 --variant printed --out s.json"),
        status: 2,
        contains: &["take new values by `plane-contact snapshot accept`, or delete the file"],
        lacks: &[],
    },
    // A failure is said once.
    Case {
        input: "",
        command: "echo x >bad.json; plane-contact snapshot verify bad.json --junit j.xml; cat j.xml",
        status: 0,
        contains: &[
            "<error message=\"x where a value is expected\">  where: bad.json: the snapshot, line 1",
        ],
        lacks: &[
            "x where a value is expected\n  where: bad.json: the snapshot, line 1, column 1\n  fix:   give a snapshot as `plane-contact snapshot record` writes it\nerror",
        ],
    },
    // Through a pipe.
    Case {
        input: "",
        command: recorded!("cat s.json | plane-contact snapshot verify /dev/stdin"),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
];
