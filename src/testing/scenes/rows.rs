//! Rows that change a scene of a file.

use std::path::Path;

use base::error::InputError;
use problem::scene::Scene;
use serde_json::{Value, json};

/// Returns the scene `FOLDER/NAME.json` of a row `NAME CHANGES`. A change is `key=value` of its contact or `/place=value` at
/// a JSON pointer, of which `-` is behind the last, `null` for none; `shift=x,y` moves all nodes, `turn=degrees` turns them with all forces,
/// and with restraints along an axis where the angle is right.
///
/// # Errors
/// The scene is at fault.
pub fn scene_of(folder: &str, row: &str) -> Result<Scene, InputError> {
    let mut words = row.split(' ');
    let name = words.next().expect("a scene");
    let text = std::fs::read(format!("{folder}/{name}.json")).expect(name);
    let mut scene: Value = serde_json::from_slice(&text).expect(name);
    for change in words {
        let (place, value) = change.split_once('=').expect("a change");
        let json = serde_json::from_str(value).unwrap_or_else(|_| value.into());
        match place {
            "shift" | "turn" => moved(&mut scene, place, value),
            _ if place.starts_with('/') => set(&mut scene, place, json),
            _ => set(&mut scene, &format!("/contact/{place}"), json),
        }
    }
    let beside = |file: &str| {
        let path = Path::new(folder).join(name).with_file_name(file);
        std::fs::read(path).map_err(|why| why.to_string())
    };
    Scene::build("test", scene.to_string().as_bytes(), beside)
}

/// Returns the words of a row: two, then the scene.
#[track_caller]
pub fn two_and_scene(row: &str) -> [&str; 3] {
    row.splitn(3, ' ').collect::<Vec<_>>().try_into().expect("two words and a scene")
}

fn set(scene: &mut Value, place: &str, value: Value) {
    let (parent, key) = place.rsplit_once('/').expect("a place");
    match scene.pointer_mut(parent).expect(place) {
        Value::Array(all) if key == "-" => all.push(value),
        Value::Array(all) => all[key.parse::<usize>().expect(place)] = value,
        Value::Object(all) if value.is_null() => drop(all.remove(key)),
        other => other[key] = value,
    }
}

/// Moves or turns all nodes and the forces on them; a right angle turns restraints too.
fn moved(scene: &mut Value, how: &str, by: &str) {
    let by: Vec<f64> = by.split(',').map(|x| x.parse().expect("a number")).collect();
    let number = |x: &Value| x.as_f64().expect("a number");
    let turned = |x: f64, y: f64| {
        let (s, c) = by[0].to_radians().sin_cos();
        let [s, c] = if by[0] % 90.0 == 0.0 { [s, c].map(f64::round) } else { [s, c] };
        [c * x - s * y, s * x + c * y]
    };
    for node in scene["node"].as_array_mut().expect("nodes") {
        let [x, y] = [number(&node[1]), number(&node[2])];
        let [x, y] = if how == "turn" { turned(x, y) } else { [x + by[0], y + by[1]] };
        (node[1], node[2]) = (x.into(), y.into());
    }
    for load in scene["loads"].as_array_mut().expect("loads").iter_mut().filter(|_| how == "turn") {
        load["force"] = json!(turned(number(&load["force"][0]), number(&load["force"][1])));
    }
    let fixed = scene["restraints"].as_array_mut().expect("restraints").iter_mut();
    for fix in fixed.filter(|_| how == "turn" && by[0] % 180.0 == 90.0).map(|held| &mut held["fix"])
    {
        *fix = fix
            .as_array()
            .expect("axes")
            .iter()
            .map(|axis| if axis == "x" { "y" } else { "x" })
            .collect();
    }
}
