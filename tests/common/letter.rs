//! The letter of a contact node's status in rows of tests.

use engine::contact::{Sense, Status};

pub fn letter(status: &Status) -> char {
    match status {
        Status::Open => 'o',
        Status::Stick => 's',
        Status::Slip(Sense::Forward) => 'f',
        Status::Slip(Sense::Backward) => 'b',
        Status::Slip(Sense::Free) => 'c',
    }
}
