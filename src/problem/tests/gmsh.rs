//! Gmsh's mesh files: one mesh in every encoding, against what meshio reads; faulty files; random
//! damage.

use std::fs;

use problem::scene::gmsh::{read, write};
use problem::scene::{Element, Mesh, Node, PhysicalName, SceneBuilder};
use proptest::prelude::*;
use proptest::sample::Index;
use testing::golden_file::assert_rows;
use testing::random::fixed;

/// `tests/gmsh/blocks.geo` as Gmsh saves it.
const BLOCKS: [&str; 4] =
    ["blocks-2.2-ascii", "blocks-2.2-binary", "blocks-4.1-ascii", "blocks-4.1-binary"];

/// One triangle, one of whose edges is in a physical group with a reversed orientation.
const SMALL_2: &str = include_str!("gmsh/small-2.2-ascii.msh");

/// The same mesh.
const SMALL_4: &str = include_str!("gmsh/small-4.1-ascii.msh");

/// Both in binary.
const BINARY: [&[u8]; 2] =
    [include_bytes!("gmsh/small-2.2-binary.msh"), include_bytes!("gmsh/small-4.1-binary.msh")];

fn bytes(path: &str) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn blocks(name: &str) -> Vec<u8> {
    bytes(&format!("tests/gmsh/{name}.msh"))
}

/// The mesh of [`SMALL_2`]; in version 4.1 it has no element 5.
fn small() -> Mesh {
    let node = |number, x, y| Node { number, xyz: [x, y, 0.0] };
    let element = |number, kind, physical: &[usize], geometric, nodes: &[usize]| Element {
        number,
        kind,
        physical: physical.into(),
        geometric,
        nodes: nodes.into(),
    };
    let name = |dim, tag, name: &str| PhysicalName { dim, tag, name: name.to_owned() };
    Mesh {
        nodes: vec![node(10, 0.0, 0.0), node(20, 1.0, 0.0), node(30, 0.0, 1.0)],
        elements: vec![
            element(5, 15, &[], 0, &[10]),
            element(8, 1, &[7], 3, &[20, 10]),
            element(9, 2, &[1], 4, &[10, 20, 30]),
        ],
        names: vec![name(1, 7, "base"), name(2, 1, "the body")],
        ..Mesh::default()
    }
}

fn small_4() -> Mesh {
    let mut mesh = small();
    mesh.elements.remove(0);
    mesh
}

/// The text that `tests/gmsh/oracle.py` prints of a mesh.
fn canonical(mesh: &Mesh) -> String {
    let row = |number| 1 + mesh.nodes.binary_search_by_key(&number, |node| node.number).unwrap();
    let mut lines: Vec<String> = mesh
        .nodes
        .iter()
        .map(|Node { number, xyz: [x, y, z] }| {
            format!("node {} {x:.12} {y:.12} {z:.12}", row(*number))
        })
        .collect();
    for element in &mesh.elements {
        let (dim, kind) = match element.kind {
            15 => (0, "vertex"),
            1 => (1, "line"),
            _ => (2, "triangle"),
        };
        let rows: Vec<String> = element.nodes.iter().map(|&node| row(node).to_string()).collect();
        for name in &mesh.names {
            if name.dim == dim && element.physical.contains(&name.tag) {
                lines.push(format!("{}: {kind} {}", name.name, rows.join(" ")));
            }
        }
    }
    lines.sort();
    lines.join("\n")
}

#[test]
fn all_encodings_are_read_as_meshio_reads_them() {
    let expected = String::from_utf8(bytes("tests/gmsh/expected.txt")).unwrap();
    let files: Vec<_> = expected.split("\nfile ").skip(1).collect();
    assert_eq!(files.len(), BLOCKS.len());
    for (name, expected) in BLOCKS.iter().zip(files) {
        let (file, expected) = expected.split_once('\n').unwrap();
        assert_eq!(file, format!("{name}.msh"));
        assert_eq!(canonical(&read(&blocks(name)).unwrap()), expected.trim_end(), "{file}");
    }
}

#[test]
fn text_and_binary_are_the_same_mesh() {
    for [text, binary] in [[BLOCKS[0], BLOCKS[1]], [BLOCKS[2], BLOCKS[3]]] {
        let (text, binary) = (read(&blocks(text)).unwrap(), read(&blocks(binary)).unwrap());
        assert_eq!((&text.elements, &text.names), (&binary.elements, &binary.names));
        for (a, b) in text.nodes.iter().zip(&binary.nodes) {
            assert_eq!(a.number, b.number);
            // Gmsh writes 16 digits, which may miss the double by some units of the last one.
            a.xyz.iter().zip(b.xyz).for_each(|(a, b)| {
                approx::assert_relative_eq!(*a, b, epsilon = 1e-15, max_relative = 1e-15);
            });
        }
    }
}

#[test]
fn the_shared_group_of_4_1_stands_beside_each_blocks_own() {
    let mesh = read(&blocks("blocks-4.1-ascii")).unwrap();
    let of_kind = |kind| mesh.elements.iter().filter(move |element| element.kind == kind);
    assert!(of_kind(2).all(|e| e.physical[..] == [1, 3] || e.physical[..] == [2, 3]));
    assert!(of_kind(1).all(|e| e.physical.len() == 1));
}

#[test]
fn numbers_ascend_and_signs_are_dropped() {
    assert_eq!(read(SMALL_2.as_bytes()), Ok(small()));
    assert_eq!(read(SMALL_4.as_bytes()), Ok(small_4()));
}

#[test]
fn windows_line_ends_and_a_missing_last_one_are_read() {
    assert_eq!(read(SMALL_2.replace('\n', "\r\n").as_bytes()), Ok(small()));
    assert_eq!(read(SMALL_4.replace('\n', "\r\n").as_bytes()), Ok(small_4()));
    assert_eq!(read(SMALL_2.trim_end().as_bytes()), Ok(small()));
}

#[test]
fn other_sections_are_skipped() {
    for name in BLOCKS {
        let plain = blocks(name);
        let at = plain.windows(7).position(|window| window == b"$Nodes\n").unwrap();
        let periodic = b"$Periodic\n\x00\xff\n$End\x80\n$EndPeriodic\n";
        let longer = [&plain[..at], periodic, &plain[at..]].concat();
        assert_eq!(read(&longer), read(&plain), "{name}");
    }
}

#[test]
fn what_other_programs_write_before_the_format_is_skipped() {
    for before in
        ["\u{feff}", "\n\n", "$Comments\n$Nodes\n$EndComments\n", "\u{feff}$A\n$EndA\n$B\n$EndB\n"]
    {
        for (text, mesh) in [(SMALL_2, small()), (SMALL_4, small_4())] {
            assert_eq!(read(format!("{before}{text}").as_bytes()), Ok(mesh), "{before:?}");
        }
        for name in BLOCKS {
            let file = [before.as_bytes(), &blocks(name)].concat();
            assert_eq!(read(&file), read(&blocks(name)), "{name}, {before:?}");
        }
    }
    let wide: Vec<u8> = SMALL_2.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let error = read(&[&[0xFF, 0xFE], &wide[..]].concat()).expect_err("UTF-16").to_string();
    assert!(error.contains("found a file in UTF-16"), "{error}");
}

#[test]
fn names_that_are_not_in_utf_8_are_called_so() {
    for text in [SMALL_2, SMALL_4] {
        let latin: Vec<u8> = text.replace("base", "b\u{e4}se").chars().map(|c| c as u8).collect();
        let error = read(&latin).expect_err("Latin-1").to_string();
        assert!(error.starts_with("line 7: found \"b"), "{error}");
        assert!(error.contains("not in UTF-8 (as Latin-1 is not)"), "{error}");
    }
}

/// Physical groups and nodes of the triangles.
fn triangles(mesh: &Mesh) -> Vec<(Vec<usize>, Vec<usize>)> {
    let of = |element: &Element| (element.physical.to_vec(), element.nodes.to_vec());
    mesh.of_dimension(2).map(of).collect()
}

#[test]
fn binary_files_are_read() {
    assert_eq!(BINARY.map(read), [Ok(small()), Ok(small_4())]);
}

/// As a machine writes that stores the most significant byte first.
#[test]
fn the_other_byte_order_is_refused_by_name() {
    for file in BINARY {
        let mut file = file.to_vec();
        let at = file.iter().position(|byte| *byte == 1).expect("the number 1");
        file[at..at + 4].reverse();
        let error = read(&file).expect_err("the other order").to_string();
        assert!(error.contains("save the mesh again on this machine, or as text"), "{error}");
    }
}

/// Each row of the file: a version and what is changed.
#[test]
fn changed_files_are_read_or_refused() {
    assert_rows("tests/gmsh/changes.txt", |row| {
        let mut parts = row.split(" | ");
        let (text, whole) = match parts.next() {
            Some("2.2") => (SMALL_2, small()),
            _ => (SMALL_4, small_4()),
        };
        let changed = parts.fold(text.to_owned(), |text, change| {
            let (from, to) = change.split_once(" → ").expect("a change");
            let [from, to] = [from, to].map(|text| text.replace('⏎', "\n"));
            assert!(text.contains(&from), "{row}");
            text.replacen(&from, &to, 1)
        });
        match read(changed.as_bytes()) {
            Err(why) => why.to_string(),
            Ok(mesh) if mesh == whole => "the same mesh".into(),
            Ok(mesh) => {
                let nodes: Vec<_> = mesh.nodes.iter().map(|node| node.number).collect();
                let names = mesh.names.iter().map(|name| (name.dim, name.tag, &name.name));
                let names = names.collect::<Vec<_>>();
                let elements =
                    mesh.elements.iter().map(|e| (e.kind, &e.physical[..], &e.nodes[..]));
                let elements = elements.collect::<Vec<_>>();
                format!("nodes {nodes:?}, elements {elements:?}, names {names:?}")
            }
        }
    });
}

#[test]
fn a_binary_fault_is_named_with_its_byte() {
    let mut file = BINARY[0].to_vec();
    let at = file.windows(7).position(|window| window == b"$Nodes\n").unwrap() + 9;
    file[at..at + 4].fill(0);
    let error = read(&file).unwrap_err().to_string();
    assert_eq!(error, format!("byte {at}: found 0, expected a node's number, 1 or more"));
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    for name in BLOCKS {
        let file = blocks(name);
        // The last byte is the last line's end, which may be missing.
        for length in 0..file.len() - 1 {
            assert!(read(&file[..length]).is_err(), "{name}, the first {length} bytes");
        }
    }
}

#[test]
fn the_strand_is_read() {
    let mesh = read(&bytes("../../golden/strand/strand.msh")).unwrap();
    let of_group = |wanted: &str| {
        let name = mesh.names.iter().find(|name| name.name == wanted).unwrap();
        let kind = name.dim; // edges are of type 1, triangles of type 2
        let inside = |e: &&Element| e.kind == kind && e.physical.contains(&name.tag);
        mesh.elements.iter().filter(inside).count()
    };
    assert_eq!(mesh.nodes.len(), 1111);
    assert_eq!([of_group("block"), of_group("stamp")], [1396, 618]);
    assert_eq!([of_group("duct_wall"), of_group("stamp_arc")], [78, 54]);
}

/// A scene on a mesh file that restrains `node` and the group "base", and loads nothing.
fn scene_on(mesh: &[u8], node: usize) -> base::error::Result<SceneBuilder> {
    let scene = format!(
        "{{\"mesh\": \"m.msh\", \"plane\": \"strain\", \"materials\": {{\"the body\": {{\"E\": 1, \
         \"nu\": 0}}}}, \"restraints\": [{{\"on\": \"base\", \"fix\": [\"x\", \"y\"]}}, {{\"node\": {node}, \
         \"fix\": [\"x\"]}}]}}"
    );
    SceneBuilder::read("small", scene.as_bytes(), |_| Ok(mesh.to_vec()))
}

/// Both versions, text and binary, number their nodes 10, 20, 30.
#[test]
fn node_numbers_with_gaps_are_closed_in_every_encoding() {
    for file in [SMALL_2.as_bytes(), SMALL_4.as_bytes()].into_iter().chain(BINARY) {
        let scene = scene_on(file, 30).expect("it is read");
        assert_eq!(scene.mesh.nodes.iter().map(|n| n.number).collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!(triangles(&scene.mesh), [(vec![1], vec![1, 2, 3])]);
        assert_eq!(scene.description.restraints[1].node, Some(3));
        assert!(scene.mesh.adapted[0].contains("node 10 of the file is node 1"));
        assert!(scene.build().is_ok());
        let why = scene_on(file, 3).expect_err("the file has no node 3");
        assert_eq!(why.what, "the mesh file has no node 3");
    }
}

#[test]
fn triangles_that_run_clockwise_are_turned() {
    let turned = SMALL_2.replace("4 10 20 30", "4 10 30 20");
    let scene = scene_on(turned.as_bytes(), 30).expect("it is read");
    assert_eq!(triangles(&scene.mesh), [(vec![1], vec![1, 2, 3])]);
    assert!(
        scene.mesh.adapted[1].contains("1 of 1 triangles run clockwise, the first 9 (surface 4")
    );
    // One of two that share the side 20-30, and of two that lie over the same side 10-20.
    let both = |other: &str| {
        let more = turned.replace("$Elements\n3\n", &format!("$Elements\n4\n7 2 2 1 4 {other}\n"));
        let more = more.replace("$Nodes\n3\n", "$Nodes\n4\n40 1 1 0\n");
        scene_on(more.as_bytes(), 30).expect("it is read").build()
    };
    assert!(both("20 40 30").is_ok() && both("20 30 40").is_ok());
    for folded in ["10 20 40", "20 10 40"] {
        let why = both(folded).expect_err("it folds").what;
        assert_eq!(why, "triangles 7 and 9 lie over each other");
    }
}

#[test]
fn what_no_group_holds_is_named_with_what_gmsh_adds() {
    let no_group =
        SMALL_2.replace("9 2 2 1 4", "9 2 2 0 4").replace("2 1 \"the body\"", "2 6 \"x\"");
    let why = scene_on(no_group.as_bytes(), 30).expect("it is read").build().expect_err("no group");
    assert!(why.fix.contains("triangles of surface 4 are in none"), "{}", why.fix);
    assert!(why.fix.contains("Physical Surface(\"the body\") = {4};"), "{}", why.fix);
}

proptest! {
    #![proptest_config(fixed(64))]

    /// Whatever numbers ascend in place of 1, 2, ..., the scene has the same mesh.
    #[test]
    fn any_gaps_close(
        nodes in prop::collection::vec(1..9_usize, 2000),
        elements in prop::collection::vec(1..900_usize, 4000),
    ) {
        let numbers = |steps: &[usize]| -> Vec<usize> {
            steps.iter().scan(0, |n, step| { *n += step; Some(*n) }).collect()
        };
        let (nodes, elements) = (numbers(&nodes), numbers(&elements));
        let whole = read(&bytes("../../golden/strand/strand.msh")).expect("a mesh");
        let mut mesh = whole.clone();
        mesh.nodes.iter_mut().for_each(|node| node.number = nodes[node.number]);
        for (place, element) in mesh.elements.iter_mut().enumerate() {
            element.number = elements[place];
            element.nodes.iter_mut().for_each(|n| *n = nodes[*n]);
        }
        let scene = scene_on(write(&mesh).as_bytes(), nodes[7]).expect("it is read");
        prop_assert_eq!(&scene.mesh.nodes, &whole.nodes);
        let content = |mesh: &Mesh| -> Vec<_> {
            mesh.elements.iter().map(|e| (e.nodes.clone(), e.physical.clone())).collect()
        };
        prop_assert!(content(&scene.mesh) == content(&whole));
        prop_assert_eq!(scene.description.restraints[1].node, Some(7));
    }
}

proptest! {
    #![proptest_config(fixed(256))]

    /// A damaged file is read or refused, without a panic and without an end.
    #[test]
    fn damage_does_no_harm(
        name in prop::sample::select(&BLOCKS[..]),
        damage in prop::collection::vec((any::<Index>(), any::<u8>()), 1..8),
        length in any::<Index>(),
    ) {
        let mut file = blocks(name);
        for (at, byte) in damage {
            let at = at.index(file.len());
            file[at] = byte;
        }
        let _ = read(&file);
        file.truncate(length.index(file.len()));
        let _ = read(&file);
    }
}
