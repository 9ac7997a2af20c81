//! The estimates of the mesh's error.

use engine::estimates::Estimates;
use engine::{Request, solve};
use problem::modelling::Variant;
use testing::embedded::scene_json;
use testing::json::build;

/// Lengths, stresses and thickness in other units: what is estimated comes out in these units, and
/// what has no unit stays.
#[test]
fn estimates_have_their_units() {
    for variant in [Variant::Tied, Variant::Unilateral] {
        let estimates = |length: f64, stress: f64, thickness: f64| {
            let mut json = scene_json("two-blocks");
            for node in json["node"].as_array_mut().unwrap() {
                for k in [1, 2] {
                    node[k] = (length * node[k].as_f64().unwrap()).into();
                }
            }
            for material in json["materials"].as_object_mut().unwrap().values_mut() {
                material["E"] = (stress * material["E"].as_f64().unwrap()).into();
            }
            let pressure = &mut json["loads"][0]["pressure"];
            *pressure = (stress * pressure.as_f64().unwrap()).into();
            json["thickness"] = thickness.into();
            let tolerance = &mut json["contact"]["c_tll"];
            *tolerance = (length * tolerance.as_f64().unwrap()).into();
            let scene = build(&json).expect("a sound scene");
            let solution = solve(&Request::new(&scene).variant(variant), &mut |_| ()).unwrap();
            Estimates::new(&solution)
        };
        let plain = estimates(1.0, 1.0, 1.0);
        assert!(plain.mesh.total() > 0.0, "{variant}");
        for [length, stress, thickness] in [[2.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]] {
            let other = estimates(length, stress, thickness);
            let what = format!("{variant}, {length} {stress} {thickness}");
            let same = |a: f64, b: f64| {
                assert!(a == b || (a - b).abs() <= 1e-9 * b.abs(), "{what}: {a:e} {b:e}");
            };
            same(other.mesh.relative(), plain.mesh.relative());
            // The root of an energy: stress · length² · thickness.
            let root = (stress * length * length * thickness).sqrt();
            same(other.mesh.total(), root * plain.mesh.total());
            same(other.mesh.energy_norm, root * plain.mesh.energy_norm);
            for (a, b) in other.errors.bodies.iter().zip(&plain.errors.bodies) {
                same(a.von_mises_stress, stress * b.von_mises_stress);
            }
            let maps = [&other, &plain].map(|estimates| estimates.mesh.error_map());
            maps[0].iter().zip(&maps[1]).for_each(|(a, b)| same(*a, *b));
            let mean = maps[1].iter().map(|x| x * x).sum::<f64>() / maps[1].len() as f64;
            same(mean.sqrt(), plain.mesh.relative());
        }
    }
}

/// Nothing loads the blocks: there is no error, and no division by nothing.
#[test]
fn what_is_not_loaded_has_no_error() {
    let mut json = scene_json("two-blocks");
    json["loads"] = serde_json::json!([]);
    let scene = build(&json).expect("a sound scene");
    let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
    let found = Estimates::new(&solution);
    assert_eq!(
        (found.mesh.total(), found.mesh.relative(), found.mesh.energy_norm),
        (0.0, 0.0, 0.0)
    );
    assert!(found.mesh.error_map().iter().all(|part| *part == 0.0));
    let errors = found.errors;
    assert_eq!(errors.displacement_no_limit, None);
    for body in &errors.bodies {
        assert_eq!((body.von_mises_stress, &body.no_limit), (0.0, &None));
    }
}
