//! The scenes that are part of the program, the findings' own, and the generators.

use super::model::{Report, Table};
use problem::scene::Scene;

/// Reports the scenes by name; then findings by name and title, and generators by name and what each
/// makes.
pub fn report(
    scenes: &[(&str, Scene)],
    findings: &[(&str, &str)],
    generators: &[(String, String)],
) -> Report {
    let scenes = Table::from_rows(scenes)
        .column("scene", |(name, _)| *name)
        .column("nodes", |(_, scene)| scene.model.nodes.len())
        .column("triangles", |(_, scene)| scene.model.triangles.len())
        .column("title", |(_, scene)| scene.title.clone());
    let findings = Table::from_rows(findings)
        .column("finding", |(id, _)| *id)
        .column("what its scene shows", |(_, title)| *title);
    let generators = Table::from_rows(generators)
        .column("generator", |(name, _)| name.clone())
        .column("what it makes", |(_, about)| about.clone());
    Report::default()
        .table("Scenes: plane-contact solve NAME", scenes)
        .table("Findings: plane-contact audit --finding ID; the scene is findings/ID", findings)
        .table("Generators: plane-contact scene mesh KIND", generators)
}
