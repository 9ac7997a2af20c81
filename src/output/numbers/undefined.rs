//! Numbers that have no value: `-` in tables and null in files, each with its reason.

/// Why a number has no value, by the names of its fields in the files.
const REASONS: &[(&str, &str)] = &[
    ("relative", "the value compared with is 0"),
    ("displacement_relative", "nothing moves in the solution compared with"),
    ("equilibrium_error", "there is no equilibrium, or the reading has no run of its own"),
    ("coupled", "the scene has no contact"),
    ("joins", "no node comes in contact"),
    ("share", "printed stops, or no load acts"),
    ("nearest", "there is no equilibrium, or no variant of the paper runs"),
    ("fields", "there is no equilibrium, or the scene has no contact"),
    ("reading", "the default of every reading"),
    ("variant", "no run measures it"),
    ("reason", "it is measured, or there is nothing to measure"),
    ("number", "the verdict rests on no number, or the target does not move"),
    ("penetration", "no contact node faces the target"),
    ("energy_relative energy", "the solution compared with has no energy"),
    ("displacement", "nothing moves in what is compared with, or nothing could be compared"),
    ("von_mises", "the stress compared with is 0"),
    ("differences", "the quantity is 0 on the finest mesh"),
    ("contact", "nothing presses on this mesh, or the axis is not the mesh"),
    ("force_error peak_pressure_error", "that of the finest mesh is 0"),
    ("order", "the differences between meshes do not fall on a line, or are fewer than two"),
    ("scatter", "there is no order, or a line through two differences only"),
    ("errors", "there is no order of convergence"),
    ("certainty", "the run failed, or the parameter has no verdict"),
    ("cycle", "the contact state is new"),
    (
        "target_share",
        "no load acts on one of the two bodies alone, or contact carries more than it",
    ),
    ("nominal_strain", "no load acts"),
    ("hertz", "Hertz's theory does not apply: it takes two curved bodies pressed by a known force"),
    ("pressure shear force", "restraints leave the force undetermined"),
    ("friction_needed", "the node is not pressed beyond rounding, or its force is not determined"),
    ("status", "the variant knows no statuses, or the node is not in contact"),
    (
        "mesh_energy_relative",
        "a Poisson's ratio near 0.5 locks the triangles, or a body has too few of them",
    ),
    ("bound", "what rounding does was not measured, or it changes who is in contact"),
    ("stress", "no run with changed inputs ended"),
    ("distance", "it was left out, there is no such solution, or the scene has no contact"),
    (
        "distance_from_equilibrium",
        "it was left out, there is none, or it is the reference solution",
    ),
    ("equilibrium reference", "there is none, or the scene has no contact"),
    ("change", "the scene stands at none of the places tried, meshes differ, or the run failed"),
    ("error", "the run failed, or what it is measured against did"),
    ("failure", "the run did not fail"),
    ("in_contact", "the run failed"),
    ("seconds", "the run failed, or is not timed"),
    ("solver", "the scalar's own solver"),
];

/// Returns why a field has no value.
pub fn reason(field: &str) -> &'static str {
    let mut rows = REASONS.iter();
    let found = rows.find(|(fields, _)| fields.split(' ').any(|name| name == field));
    found.map_or("there is none", |(_, reason)| reason)
}
