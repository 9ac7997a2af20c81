//! A mesh as the text of a Gmsh file.

use std::fmt::Write;

use crate::problem::scene::mesh::Mesh;

/// Returns the mesh as a Gmsh file: MSH 2.2, text. Each coordinate is written as the shortest
/// number that reads back to the same bits. The format stores one physical group: the first of each
/// element, or 0.
pub fn write(mesh: &Mesh) -> String {
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
        let (number, kind, geometric) = (element.number, element.kind, element.geometric);
        let physical = element.physical.first().copied().unwrap_or(0);
        let nodes: Vec<String> = element.nodes.iter().map(usize::to_string).collect();
        writeln!(out, "{number} {kind} 2 {physical} {geometric} {}", nodes.join(" "))
    });
    out
}

/// Writes a section: its count, then a line for each of `rows`.
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
