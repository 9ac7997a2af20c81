//! Solves a scene that is built in code: a stamp of two cells pressed on a block of three.
//!
//! ```text
//!      +-----+-----+     pressure 6.3 MPa
//!      |   stamp   |
//!      +-----+-----+     the contact surface, 0.01 mm above the target
//!      +---+---+---+
//!      |   block   |
//!      +---+---+---+     restrained
//! ```

use plane_contact::input::{Axis, Contact, Friction, MeshBuilder, Plane};
use plane_contact::{Error, Request, SceneBuilder, solve};

/// The stamp on the block, lengths in mm, stresses in MPa.
fn stamp_on_block() -> SceneBuilder {
    let row = |cells: usize, y: f64| (0..=cells).map(move |k| [30.0 * k as f64 / cells as f64, y]);
    let mut mesh = MeshBuilder::default();
    let (bottom, target) = (mesh.row(row(3, 0.0)), mesh.row(row(3, 10.0)));
    let (contact, top) = (mesh.row(row(2, 10.01)), mesh.row(row(2, 20.01)));
    mesh.join("block", &bottom, &target);
    mesh.join("stamp", &contact, &top);
    mesh.edges("bottom", &bottom);
    mesh.edges("target", &target);
    mesh.edges("top", &top);
    let middle = top[1];
    let mut surfaces = Contact::new(contact, "target", 0.001);
    surfaces.friction = Some(Friction::NONE);
    SceneBuilder::new("stamp-on-block", mesh.finish(), Plane::Strain)
        .units("mm", "MPa", "N")
        .material("block", 30000.0, 0.2)
        .material("stamp", 210000.0, 0.3)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .restrain_node(middle, &[Axis::X])
        .pressure("top", 6.3)
        .contact(surfaces)
}

/// Solves it and prints the contact surface.
pub fn main() -> Result<(), Error> {
    let scene = stamp_on_block().build()?;
    let solution = solve(&Request::new(&scene), &mut |step| {
        println!("iteration {}: {} nodes in contact", step.k, step.in_contact);
    })?;
    for node in solution.in_contact() {
        let pressure = node.pressure.expect("no restraint leaves it open");
        println!("node {} presses with {pressure:.3} MPa", node.node);
    }
    let load: f64 = solution.in_contact().filter_map(|node| node.force).sum();
    println!("all of them with {load:.1} N of the {:.1} N applied", 6.3 * 30.0);
    Ok(())
}
