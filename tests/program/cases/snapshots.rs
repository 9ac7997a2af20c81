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
        contains: &["the bound on a rounding error is -1", "numbers.u.bound"],
        lacks: &[],
    },
    // What is no finite number.
    Case {
        input: "overflow",
        command: "plane-contact snapshot record scene.json --variant tied --coupling mortar --status projection \
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
    // Through a pipe.
    Case {
        input: "",
        command: recorded!("cat s.json | plane-contact snapshot verify /dev/stdin"),
        status: 0,
        contains: &["same, 1 run"],
        lacks: &[],
    },
];
