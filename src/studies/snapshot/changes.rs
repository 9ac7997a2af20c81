//! What went into two runs and differs: fields of the scene, parts of the mesh, options, the version.

use serde::Serialize;
use serde_json::Value;

use super::input::Input;
use super::{Run, Snapshot};
use problem::scene::{Element, Mesh, Node};

/// One side of a comparison.
#[derive(Clone, Copy)]
pub struct Side<'a> {
    /// The version of the program that recorded it.
    pub version: &'a str,
    /// What was given to it.
    pub input: &'a Input,
    /// What was recorded.
    pub run: &'a Run,
}

impl<'a> Side<'a> {
    /// Returns the side that a run of a snapshot is.
    pub fn new(snapshot: &'a Snapshot, run: &'a Run) -> Self {
        Side { version: &snapshot.version, input: &snapshot.input, run }
    }
}

/// A difference of what went into two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// The field: `scene materials.block.E`, `mesh node 7`, `option solver`.
    pub place: String,
    /// What it was in the old run.
    pub was: String,
    /// What it is in the new run.
    pub is: String,
}

/// Returns what differs in what went into two runs, in the order of computation.
pub fn changes(old: Side, new: Side) -> Vec<Change> {
    let mut changes = Vec::new();
    if old.input.scene_sha256 != new.input.scene_sha256 {
        let [was, is] = [old, new].map(|side| {
            serde_json::to_value(&side.input.scene).expect("a description is an object")
        });
        fields(&mut changes, "scene", &was, &is);
    }
    if old.input.mesh_sha256 != new.input.mesh_sha256 {
        mesh(&mut changes, &old.input.mesh, &new.input.mesh);
    }
    let [was, is] = [old, new]
        .map(|side| serde_json::to_value(&side.run.options).expect("options have string keys"));
    fields(&mut changes, "option", &was, &is);
    add(&mut changes, "version of the program".into(), [old, new].map(|side| side.version.into()));
    changes
}

/// Adds a change where the two sides differ.
fn add(changes: &mut Vec<Change>, place: String, [was, is]: [String; 2]) {
    if was != is {
        changes.push(Change { place, was, is });
    }
}

/// Collects the fields in which two documents differ; a list of objects is compared one by one.
fn fields(changes: &mut Vec<Change>, path: &str, was: &Value, is: &Value) {
    match (was, is) {
        (Value::Object(old), Value::Object(new)) => {
            let separator = if path.contains(' ') { '.' } else { ' ' };
            let added = new.keys().filter(|name| !old.contains_key(*name));
            for name in old.keys().chain(added) {
                let [was, is] = [old, new].map(|side| side.get(name).unwrap_or(&Value::Null));
                fields(changes, &format!("{path}{separator}{name}"), was, is);
            }
        }
        (Value::Array(old), Value::Array(new))
            if old.iter().any(Value::is_object) && old.len() == new.len() =>
        {
            for (k, (was, is)) in old.iter().zip(new).enumerate() {
                fields(changes, &format!("{path}[{k}]"), was, is);
            }
        }
        _ => {
            let words = |value: &Value| match value {
                Value::Null => "the default".into(),
                value => value.to_string(),
            };
            add(changes, path.into(), [words(was), words(is)]);
        }
    }
}

/// Collects the differences of two meshes: groups, then nodes, then elements.
fn mesh(changes: &mut Vec<Change>, old: &Mesh, new: &Mesh) {
    let sides = [old, new];
    add(changes, "mesh groups".into(), sides.map(|mesh| format!("{:?}", mesh.names)));
    add(changes, "mesh nodes".into(), sides.map(|mesh| mesh.nodes.len().to_string()));
    for (was, is) in old.nodes.iter().zip(&new.nodes).filter(|(was, is)| was != is) {
        let row = |node: &Node| format!("{} at {:?}", node.number, node.xyz);
        add(changes, format!("mesh node {}", was.number), [was, is].map(row));
    }
    add(changes, "mesh elements".into(), sides.map(|mesh| mesh.elements.len().to_string()));
    for (was, is) in old.elements.iter().zip(&new.elements).filter(|(was, is)| was != is) {
        let row =
            |e: &Element| format!("{:?} of type {}, groups {:?}", e.nodes, e.kind, e.physical);
        add(changes, format!("mesh elem {}", was.number), [was, is].map(row));
    }
}
