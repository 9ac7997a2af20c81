//! A mesh as the text of a Gmsh file.

use std::fmt::Write;

use crate::scene::mesh::{Element, Mesh};

/// Returns the mesh as a Gmsh file: MSH 2.2, text. Each coordinate is written as the shortest
/// number that reads back to the same bits. A row has one physical group, or 0: an element of several
/// has a row for each, the further ones behind all elements under numbers of their own.
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
    let group = |element: &Element| element.physical.first().copied().unwrap_or(0);
    let first = mesh.elements.iter().map(|element| (element.number, element, group(element)));
    let largest = mesh.elements.iter().map(|element| element.number).max().unwrap_or(0);
    let further = mesh.elements.iter().flat_map(|element| {
        element.physical.iter().skip(1).map(move |physical| (element, *physical))
    });
    let further =
        (largest + 1..).zip(further).map(|(number, (element, tag))| (number, element, tag));
    let rows: Vec<_> = first.chain(further).collect();
    section(&mut out, "Elements", &rows, |out, (number, element, physical)| {
        let nodes: Vec<String> = element.nodes.iter().map(usize::to_string).collect();
        let (kind, geometric) = (element.kind, element.geometric);
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
