//! Meshes, scenes and every reader of JSON.

use super::{Case, check};

#[test]
fn meshes() {
    check("meshes", CASES);
}

/// Writes `sed`'s edit of the scene to edited.json and plans it.
macro_rules! edited {
    ($edit:literal, $status:literal, $contains:expr) => {
        Case {
            input: "json",
            command: concat!(
                "sed '",
                $edit,
                "' scene.json >edited.json; plane-contact scene plan edited.json"
            ),
            status: $status,
            contains: $contains,
            lacks: &[],
        }
    };
}

/// Plans the scene on `sed`'s edit of its mesh; no suggestion is what was given.
macro_rules! mesh_edited {
    ($edit:literal, $status:literal, $contains:expr) => {
        Case {
            input: "gmsh",
            command: concat!(
                "sed -i '",
                $edit,
                "' square.msh; plane-contact scene plan scene.json"
            ),
            status: $status,
            contains: $contains,
            lacks: &["did you mean \"low\""],
        }
    };
}

const CASES: &[Case] = &[
    Case {
        input: "",
        command: "plane-contact scene mesh punch --out p >log; rm p/scene.json; plane-contact solve p; \
                  plane-contact solve p/punch.msh; plane-contact scene new p/punch.msh; \
                  plane-contact scene new p/punch.msh; plane-contact scene new p/punch.msh --out q/s.json; \
                  plane-contact scene new p/none.msh --out p/punch.json; \
                  plane-contact solve p/punch.json",
        status: 2,
        contains: &[
            "; plane-contact scene new p/punch.msh writes a first one",
            "this is a Gmsh mesh, not a scene file: a scene is",
            "Guessed from the groups of the mesh",
            "Written to p/punch.json",
            "it exists already",
            "the mesh cannot be read",
            "name a file in the mesh's folder",
            "values to be chosen",
            "contact.friction",
        ],
        lacks: &["panicked"],
    },
    edited!(
        "s/-2.5/NaN/",
        2,
        &["NaN where a finite number is expected", "field loads[0].force[1]"]
    ),
    edited!("s/-2.5/-Infinity/", 2, &["-Infinity where a finite number is expected"]),
    edited!("s/-2.5/1e999/", 2, &["1e999 is a number out of range", "field loads[0].force[1]"]),
    edited!("s/-2.5/null/", 2, &["null where a number is expected"]),
    edited!("s/-2.5/\"-2.5\"/", 2, &["the text \"-2.5\" where a number is expected"]),
    edited!("s/-2.5/-0/", 0, &["plan:"]),
    edited!(
        "s/\"7\"/\"7\": {\"E\": 1, \"nu\": 0}, \"7\"/",
        2,
        &["\"7\" is given twice", "materials"]
    ),
    edited!("s/\"force\"/\"node\": 3, \"force\"/", 2, &["\"node\" is given twice", "loads[0]"]),
    edited!(
        "s/\"E\": 3e4, \"nu\": 0.2/\"E\": \"\\\\ud800\"/",
        2,
        &["stands for no character", "materials.7.E"]
    ),
    edited!(
        "s/{\"node\": 1, \"fix\"/[1, 2, 3], {\"node\": 1, \"fix\"/",
        2,
        &["a list where an object"]
    ),
    edited!("1s/^/\\xEF\\xBB\\xBF/", 0, &["plan:"]),
    edited!("s/$/\\r/", 0, &["plan:"]),
    edited!("s/strain/str\\xE9in/", 2, &["line 2 is not in UTF-8", "save it as UTF-8"]),
    Case {
        input: "json",
        command: "iconv -t UTF-16 scene.json >edited.json; plane-contact scene plan edited.json",
        status: 2,
        contains: &["the file is in UTF-16", "save it as UTF-8"],
        lacks: &[],
    },
    Case {
        input: "json",
        command: "plane-contact snapshot record scene.json --out s.json; iconv -t UTF-16LE s.json >u.json; \
                  plane-contact snapshot verify u.json",
        status: 2,
        contains: &["the file is in UTF-16"],
        lacks: &[],
    },
    Case {
        input: "json",
        command: "plane-contact snapshot record scene.json --out s.json; sed '1s/^/\\xEF\\xBB\\xBF/' s.json \
                  >b.json; plane-contact snapshot verify b.json && plane-contact snapshot diff b.json s.json",
        status: 0,
        contains: &["b.json: same"],
        lacks: &[],
    },
    Case {
        input: "json",
        command: "(printf '{\"title\": '; head -c 100000 /dev/zero | tr '\\0' '[') >deep.json; \
                  plane-contact scene plan deep.json",
        status: 2,
        contains: &["a list where text is expected", "field title"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "printf 'f(x) :=\\n  x\\n' >f.txt; plane-contact listing evaluate f.txt --inputs \
                  '{\"x\": 1, \"x\": 2}'",
        status: 2,
        contains: &["\"x\" is given twice", "--inputs"],
        lacks: &[],
    },
    // 60 MB of small values, which take a hundred times as much.
    Case {
        input: "",
        command: "(printf '{\"materials\": {}, \"elem\": [[]'; head -c 20000000 /dev/zero | \
                  sed 's/\\x00/,[]/g'; echo ']}') >big.json; ulimit -v 1000000; \
                  plane-contact scene plan big.json",
        status: 2,
        contains: &["big.json: the scene file", "values in one file are more than 15000000"],
        lacks: &[],
    },
    Case {
        input: "",
        command: "(printf '{\"format\": 1, \"runs\": {\"a\": {\"facts\": {\"b\": [0'; \
                  head -c 20000000 /dev/zero | sed 's/\\x00/,0/g'; echo ']}}}}') >big.json; \
                  ulimit -v 1000000; plane-contact snapshot verify big.json",
        status: 2,
        contains: &["big.json: the snapshot", "values in one file are more than 15000000"],
        lacks: &[],
    },
    // What is not linear takes minutes for these.
    Case {
        input: "",
        command: "python3 -c 'import json; n = 100000
json.dump({\"plane\": \"strain\", \"node\": [[1, 0, 0, 0], [2, 1, 0, 0], [3, 0, 1, 0]],
    \"elem\": [[1, 2, 2, 1, 1, 1, 2, 3]],
    \"materials\": {str(i): {\"E\": 1, \"nu\": 0} for i in range(1, n + 1)}}, open(\"m.json\", \"w\"))' && \
                  timeout 20 plane-contact scene plan m.json",
        status: 2,
        contains: &["there is no physical group \"2\" of triangles"],
        lacks: &[],
    },
    Case {
        input: "gmsh",
        command: "plane-contact solve scene.json --no-pictures",
        status: 0,
        contains: &["low"],
        lacks: &["same nodes"],
    },
    Case {
        input: "gmsh",
        command: "plane-contact scene plan scene.json",
        status: 0,
        contains: &["size, mm", "1 x 1", "sum of the loads, N", "0, -2.5", "nominal strain", "0.0025"],
        lacks: &[],
    },
    Case {
        input: "gmsh",
        command: "sed -i 's/1000/1/' scene.json; plane-contact scene plan scene.json",
        status: 0,
        contains: &["nominal strain                     2.5"],
        lacks: &[],
    },
    mesh_edited!("s/^3 1 1 0/3 1 1 1.1e-16/", 0, &["plan:"]),
    mesh_edited!(
        "s/^3 1 1 0/3 1 1 0.0000000000000123456789/",
        0,
        &["plan:"]
    ),
    mesh_edited!(
        "s/^3 1 1 0/3 1 1 0.00000123456789/",
        2,
        &["node 3 has z = 1.23457e-6, node 1 z = 0, a difference of 1.23457e-6 in a mesh of the size 1"]
    ),
    mesh_edited!("1s/^/$Comments\\nof $Nodes\\n$EndComments\\n/", 0, &["plan:"]),
    mesh_edited!("1s/^/\\xEF\\xBB\\xBF/", 0, &["plan:"]),
    mesh_edited!("s/$/\\r/", 0, &["plan:"]),
    mesh_edited!("s/bottom/b\\xF6den/", 2, &["line 6: found \"b", "not in UTF-8 (as Latin-1 is not)"]),
    mesh_edited!(
        "s/^3 1 1 0/3000000000 1 1 0/",
        2,
        &["found \"3000000000\", beyond the largest number 2147483647"]
    ),
    mesh_edited!("s/^6 2 2 8 1/6 2 2 8 2/", 2, &["triangles 5 and 6 have the same nodes 1, 3, 4"]),
    // Gmsh's Mesh.SaveAll = 1 in MSH 2.2.
    mesh_edited!(
        "s/ 2 [5-8] / 2 0 /; /^[46] 2 2 0/d; s/^6$/4/",
        2,
        &["\"low\" has no element among the mesh's triangles", "in Gmsh set Mesh.SaveAll = 0"]
    ),
    mesh_edited!("/^[46] 2 2 8/d; s/^6$/4/; s/ 2 7 / 2 8 /", 2, &["\"low\" has no element", "groups of triangles are \"all\" (8)"]),
    edited!("s/\"loads\"/\"contact\": {\"cnt\": [3], \"trg\": [1], \"c_tll\": 0, \"friction\": \"1e9\"}, \"loads\"/",
        2, &["friction \"1e9\" is neither a number of 0 or more nor \"stick\""]),
    mesh_edited!(
        "/Nodes/,/EndNodes/s/^4$/5/; s/^4 0 1 0/&\\n99 5 5 0/",
        2,
        &["node 99 (5 here) belongs to no triangle"]
    ),
];
