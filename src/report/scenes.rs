//! The scenes that are part of the program, the findings' own, and the generators.

use super::layout::Table;
use problem::scene::Scene;

/// Lays out the scenes by name; then findings by name and title, and generators by name and what
/// each makes.
pub fn text(
    scenes: &[(&str, Scene)],
    findings: &[(&str, &str)],
    generators: &[(String, String)],
) -> String {
    let scenes = Table::of(scenes)
        .column("scene", |(name, _)| name)
        .column("nodes", |(_, scene)| scene.model.nodes.len())
        .column("triangles", |(_, scene)| scene.model.triangles.len())
        .column("title", |(_, scene)| scene.title.clone())
        .text();
    let findings = Table::of(findings)
        .column("finding", |(id, _)| id)
        .column("what its scene shows", |(_, title)| title)
        .text();
    let generators = Table::of(generators)
        .column("generator", |(name, _)| name.clone())
        .column("what it makes", |(_, about)| about.clone())
        .text();
    format!(
        "Scenes: plane-contact solve NAME\n{scenes}\n\
         Findings: plane-contact audit --finding ID; the scene is findings/ID\n{findings}\n\
         Generators: plane-contact scene mesh KIND\n{generators}"
    )
}
