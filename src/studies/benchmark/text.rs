//! The two files of a benchmark as text.

use std::fmt::Write;

use serde_json::Value;

use crate::problem::scene::Mesh;

/// The mesh as Gmsh MSH 2.2, text. Each float is the shortest that reads back to the same bits.
pub fn msh(mesh: &Mesh) -> String {
    let mut out = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    section(&mut out, "PhysicalNames", &mesh.names, |out, group| {
        let (dim, tag, name) = (group.dim, group.tag, &group.name);
        writeln!(out, "{dim} {tag} \"{name}\"")
    });
    section(&mut out, "Nodes", &mesh.nodes, |out, node| {
        let [x, y, z] = node.xyz;
        writeln!(out, "{} {x} {y} {z}", node.number)
    });
    section(&mut out, "Elements", &mesh.elements, |out, element| {
        let (number, kind, tag) = (element.number, element.kind, element.physical[0]);
        let nodes: Vec<String> = element.nodes.iter().map(usize::to_string).collect();
        writeln!(out, "{number} {kind} 2 {tag} {} {}", element.geometric, nodes.join(" "))
    });
    out
}

/// A section: its count, then a line for each of `rows`.
fn section<T>(
    out: &mut String,
    name: &str,
    rows: &[T],
    line: impl Fn(&mut String, &T) -> std::fmt::Result,
) {
    out.push_str(&format!("${name}\n{}\n", rows.len()));
    for row in rows {
        line(out, row).expect("a string takes any text");
    }
    out.push_str(&format!("$End{name}\n"));
}

/// The scene file: `scene` and the name of its mesh, a line for each field and for each item of a list.
pub fn scene(name: &str, scene: Value) -> String {
    let mut fields = vec![];
    for (key, value) in scene.as_object().expect("a scene is an object") {
        fields.push(format!("  {}: {}", Value::from(key.as_str()), items(value)));
        if key == "title" {
            fields.push(format!("  \"mesh\": \"{name}.msh\""));
        }
    }
    format!("{{\n{}\n}}\n", fields.join(",\n"))
}

fn items(value: &Value) -> String {
    match value.as_array() {
        Some(list) if list.len() > 1 => {
            let lines: Vec<String> = list.iter().map(|item| format!("    {item}")).collect();
            format!("[\n{}\n  ]", lines.join(",\n"))
        }
        _ => value.to_string(),
    }
}
