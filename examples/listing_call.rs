//! Runs one call of the paper's listing `c_cnt` on its figure 1: as text, executed with Mathcad's
//! semantics, and as the Rust that mirrors it line by line. Both give the same bits.

use plane_contact::input::Reading;
use plane_contact::paper::door::Call;
use plane_contact::paper::listings::{self, Which};
use plane_contact::{Error, Scene};

/// Calls the listing at the initial shape and prints what it finds.
pub fn main() -> Result<(), Error> {
    let (scene, reading) = (Scene::open("fig1")?, Reading::default());
    let mirror = Call::c_cnt(&scene.model, &reading, &scene.model.nodes)?;
    let (sheet, listing) = (&mirror.sheet, Which::CCnt.under(&reading));
    let settings = listings::settings(&reading);
    let (text, _) = listings::c_cnt(&listing, &settings, sheet, &sheet.node, None)?;
    assert_eq!(text, mirror.pairs, "the text and its mirror agree to the last bit");
    for status in &mirror.statuses {
        let edge = status.edge.map_or(0, |edge| scene.model.edge(edge).number);
        let dy = u8::from(status.in_contact);
        println!("node {}: ct {edge}, yt {:.6}, dy {dy}", status.node, status.distance);
    }
    Ok(())
}
