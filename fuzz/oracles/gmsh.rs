//! A mesh file, text or binary: it is refused at its fault, or by the checks of a
//! mesh, or what is written of it reads back the same.

use plane_contact::problem::scene::gmsh::{read, write};

use super::sound;

pub fn hold(data: &[u8]) {
    let mut mesh = match read(data) {
        Ok(mesh) => mesh,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    if let Err(error) = mesh.check() {
        return sound::input_error(&error);
    }
    // The format that is written stores one physical group.
    mesh.elements.iter_mut().for_each(|element| element.physical.truncate(1));
    let written = write(&mesh);
    let again = read(written.as_bytes());
    assert_eq!(again.as_ref(), Ok(&mesh));
}
