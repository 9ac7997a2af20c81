//! Generated benchmarks: sound scenes, exact sizes, complete groups, files that read back to the
//! same mesh.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::common::tolerances::{STRAIGHT, assert_near};
use plane_contact::problem::element;
use plane_contact::problem::scene::{Mesh, SceneBuilder};
use plane_contact::studies::benchmark::{Blocks, Hertz, Kind, Punch, Strand};
use tempfile::TempDir;

testing::tolerances! {
    /// Areas and lengths of generated meshes with curved sides, relative to the exact ones.
    CHORDS = 0.02, "chords of at most 15 degrees cut off 1.2 % of the sector, and half as much again at the ends";
}

/// Of each kind the area of its two bodies, then lengths of groups of edges; `3π` is three times π.
const SIZES: [&str; 4] = [
    "lower 1250, upper 1250, bottom 50, target 50, contact 50, top 50, lower_left 25, upper_left 25",
    "block 20000, cylinder 1250π, bottom 100, block_axis 200, cylinder_axis 100",
    "foundation 100π, punch 1, outer 10π, foundation_axis 20, contact 1, top 1, punch_axis 1",
    "block 2313.734888, stamp 28.88π, bottom 50, right 50, top 50, left 50, duct_wall 15.4π, stamp_arc 7.6π, \
     stamp_top 15.2, stamp_axis 7.6",
];

/// Each kind by its defaults, made.
fn made() -> impl Iterator<Item = (Kind, SceneBuilder)> {
    let made = |kind: Kind| (kind.clone(), kind.generate().expect("the defaults are in range"));
    let kinds = [
        Kind::Blocks(Blocks::default()),
        Kind::Hertz(Hertz::default()),
        Kind::Punch(Punch::default()),
        Kind::Strand(Strand::default()),
    ];
    kinds.into_iter().map(made)
}

/// Area of each body and length of each group of edges, by name.
fn sizes(mesh: &Mesh) -> BTreeMap<String, f64> {
    let mut sizes = BTreeMap::new();
    for element in &mesh.elements {
        let name = mesh.names.iter().find(|n| n.tag == element.physical[0]).expect("a named group");
        let size = match element.kind {
            2 => element::area(&mesh.corners(element)),
            _ => {
                let [a, b] = [0, 1].map(|k| mesh.xy(element.nodes[k]));
                (b[0] - a[0]).hypot(b[1] - a[1])
            }
        };
        *sizes.entry(name.name.clone()).or_insert(0.0) += size;
    }
    sizes
}

#[test]
fn every_kind_has_its_bodies_and_its_complete_groups() {
    let exact = |size: &str| match size.strip_suffix('π') {
        Some(part) => PI * part.parse::<f64>().expect("a number"),
        None => size.parse().expect("a number"),
    };
    for ((_, benchmark), exactly) in made().zip(SIZES) {
        let sizes = sizes(&benchmark.mesh);
        let tolerance = if benchmark.name == "blocks" { &STRAIGHT } else { &CHORDS };
        for (group, size) in exactly.split(", ").map(|size| size.split_once(' ').expect("a size")) {
            let (what, exact) = (format!("{} {group}", benchmark.name), exact(size));
            assert_near(&what, sizes[group], exact, exact, tolerance);
        }
    }
}

#[test]
fn every_kind_is_a_sound_scene() {
    for (_, benchmark) in made() {
        let scene = benchmark.build().unwrap_or_else(|why| panic!("{}: {why}", benchmark.name));
        assert_eq!(scene.model.bodies.len(), 2);
        assert!(scene.model.dropped.is_empty());
        assert!(scene.model.total_load().iter().any(|f| *f != 0.0));
    }
}

#[test]
fn the_files_read_back_to_the_same_mesh_and_description() {
    for (kind, benchmark) in made() {
        let folder = TempDir::new().unwrap();
        benchmark.write(folder.path()).expect("the folder can be written to");
        let beside =
            |file: &str| std::fs::read(folder.path().join(file)).map_err(|e| e.to_string());
        let text = beside("scene.json").unwrap();
        let read = SceneBuilder::read(&benchmark.name, &text, beside).expect("the files are sound");
        assert_eq!(read, benchmark);
        assert_eq!(kind.generate().unwrap(), benchmark, "the same every time");
    }
}

#[test]
fn extreme_parameters_make_sound_scenes() {
    let kinds = [
        Kind::Blocks(Blocks { upper: 1, lower: 1 }),
        Kind::Hertz(Hertz { size: 4, ..Hertz::default() }),
        Kind::Hertz(Hertz { size: 7, load: 10.0, ..Hertz::default() }),
        Kind::Hertz(Hertz { radius: 1.0, load: 1500.0, ..Hertz::default() }),
        Kind::Punch(Punch { punch: 5, foundation: 4, outer: 2.0 }),
        Kind::Punch(Punch { outer: 1e4, ..Punch::default() }),
    ];
    for kind in kinds {
        let made = kind.generate().and_then(|benchmark| benchmark.build());
        assert!(made.is_ok(), "{kind:?}: {}", made.unwrap_err());
    }
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let refused = [
        (Kind::Blocks(Blocks { upper: 0, lower: 1 }), "upper"),
        (Kind::Blocks(Blocks { upper: 1, lower: 2001 }), "lower"),
        (Kind::Hertz(Hertz { size: 3, ..Hertz::default() }), "size"),
        (Kind::Hertz(Hertz { radius: -1.0, ..Hertz::default() }), "radius"),
        (Kind::Hertz(Hertz { load: f64::NAN, ..Hertz::default() }), "load"),
        (Kind::Hertz(Hertz { load: 1e6, ..Hertz::default() }), "load"),
        (Kind::Punch(Punch { punch: 3, ..Punch::default() }), "punch"),
        (Kind::Punch(Punch { foundation: 3, ..Punch::default() }), "foundation"),
        (Kind::Punch(Punch { outer: 1.0, ..Punch::default() }), "outer"),
        (Kind::Strand(Strand { duct: 22.5, ..Strand::default() }), "duct"),
        (Kind::Strand(Strand { duct: f64::NAN, ..Strand::default() }), "duct"),
        (Kind::Strand(Strand { strand: 7.71, ..Strand::default() }), "strand"),
        (Kind::Strand(Strand { strand: 2.0, ..Strand::default() }), "strand"),
        (Kind::Strand(Strand { size: 0.012, ..Strand::default() }), "size"),
        (Kind::Strand(Strand { size: 1.3, ..Strand::default() }), "size"),
        (Kind::Strand(Strand { top: 0.29, ..Strand::default() }), "top"),
        (Kind::Strand(Strand { top: 1.71, ..Strand::default() }), "top"),
    ];
    for (kind, option) in refused {
        let error = kind.generate().map(|scene| scene.name).expect_err("out of range");
        assert_eq!(error.place, option, "{error}");
    }
}

/// Smallest angle of a triangle, degrees.
pub fn least_angle(mesh: &Mesh) -> f64 {
    let angles = mesh.of_dimension(2).flat_map(|triangle| {
        let p = mesh.corners(triangle);
        [0, 1, 2].map(|k| {
            let [a, b] = [1, 2].map(|s| [0, 1].map(|axis| p[(k + s) % 3][axis] - p[k][axis]));
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).to_degrees()
        })
    });
    angles.fold(180.0, f64::min)
}

#[test]
fn hertz_has_well_shaped_triangles_at_both_sizes() {
    for (size, equations) in [(20, 3500..4500), (59, 28000..32000)] {
        let SceneBuilder { mesh, .. } = Hertz { size, ..Hertz::default() }.generate().unwrap();
        assert!(equations.contains(&(2 * mesh.nodes.len())), "{}", 2 * mesh.nodes.len());
        assert!(least_angle(&mesh) > 14.0, "{}", least_angle(&mesh));
    }
}
