//! What went into two runs and differs: fields of the scene, parts of the mesh, options, the version.

use std::collections::HashMap;

use serde::Serialize;
use serde_json::{Value, json};

use super::{Entry, Numbers, Run, Snapshot};
use problem::scene::{Element, Mesh, Node};

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

/// Returns what differs in what went into two runs, each of a snapshot, in the order of computation.
pub fn changes(old: (&Snapshot, &Run), new: (&Snapshot, &Run)) -> Vec<Change> {
    let mut changes = Vec::new();
    let [was, is] = [old, new].map(|(snapshot, _)| &snapshot.input);
    if was.scene_sha256 != is.scene_sha256 {
        let [was, is] = [was, is]
            .map(|input| serde_json::to_value(&input.scene).expect("a description is an object"));
        fields(&mut changes, "scene", &was, &is);
    }
    if was.mesh_sha256 != is.mesh_sha256 {
        mesh(&mut changes, &was.mesh, &is.mesh);
    }
    let [was, is] = [old, new]
        .map(|(_, run)| serde_json::to_value(&run.options).expect("options have string keys"));
    fields(&mut changes, "option", &was, &is);
    let tolerances = [old, new].map(|(_, run)| {
        let of =
            |(entry, own): (&Entry, &Numbers)| Some((entry.to_string(), json!(own.tolerance?)));
        let all = run.tolerance.map(|all| ("of all".to_string(), json!(all)));
        Value::from_iter(all.into_iter().chain(run.numbers.iter().filter_map(of)))
    });
    fields(&mut changes, "tolerance", &tolerances[0], &tolerances[1]);
    let versions = [old, new].map(|(snapshot, _)| snapshot.version.clone());
    add(&mut changes, "version of the program".into(), versions);
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
    if old != new && by_place(old) == by_place(new) {
        let words =
            |mesh: &Mesh| format!("{} nodes, {} elements", mesh.nodes.len(), mesh.elements.len());
        let is = "the same nodes and elements under other numbers".into();
        return add(changes, "mesh, renumbered".into(), [words(old), is]);
    }
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

/// What a mesh is without its numbers: its groups, and each node by its place and the elements that have it, by
/// the places of their nodes.
fn by_place(mesh: &Mesh) -> (Vec<String>, Vec<String>) {
    let place = |node: &Node| format!("{:?}", node.xyz);
    let places: HashMap<usize, String> =
        mesh.nodes.iter().map(|node| (node.number, place(node))).collect();
    let mut elements: HashMap<usize, Vec<String>> = HashMap::new();
    for Element { nodes, kind, physical, geometric, .. } in &mesh.elements {
        let corners: Vec<Option<&String>> = nodes.iter().map(|node| places.get(node)).collect();
        let own = format!("{kind} {physical:?} {geometric} {corners:?}");
        nodes.iter().for_each(|node| elements.entry(*node).or_default().push(own.clone()));
    }
    let node = |node: &Node| {
        let mut own = elements.remove(&node.number).unwrap_or_default();
        own.sort();
        format!("{} {own:?}", place(node))
    };
    let mut nodes: Vec<String> = mesh.nodes.iter().map(node).collect();
    nodes.sort();
    (vec![format!("{:?}", mesh.names)], nodes)
}
