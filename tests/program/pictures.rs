//! The pictures that the repository ships are those that the program draws.
//!
//! Words and the order of everything are exact; a coordinate may differ by a tenth of a pixel.

use tempfile::TempDir;

use crate::common::golden_file::assert_file_by;
use crate::common::program::run;

/// A tenth of a pixel: pictures are for the eye.
const PIXEL: f64 = 0.1;

fn same_picture(expected: &str, value: &str) -> bool {
    let (expected, value) = (pieces(expected), pieces(value));
    let same = |(e, v): (&&str, &&str)| match (e.parse::<f64>(), v.parse::<f64>()) {
        (Ok(e), Ok(v)) => (e - v).abs() <= PIXEL,
        _ => e == v,
    };
    expected.len() == value.len() && expected.iter().zip(&value).all(same)
}

/// Numbers, and what stands between them.
fn pieces(text: &str) -> Vec<&str> {
    text.split_inclusive(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .flat_map(|piece| {
            let end = piece.len() - piece.chars().last().map_or(0, char::len_utf8);
            let is_open = piece.ends_with(|c: char| c.is_ascii_digit() || c == '.' || c == '-');
            if is_open { [piece, ""] } else { [&piece[..end], &piece[end..]] }
        })
        .filter(|piece| !piece.is_empty())
        .collect()
}

/// A chart and a mesh.
#[test]
fn shipped_pictures_are_drawn_anew() {
    let folder = TempDir::new().expect("a temporary folder");
    for (scene, picture) in [("fig1", "pressure.svg"), ("findings/C4", "mesh.svg")] {
        let out = scene.replace('/', "-");
        assert!(run(folder.path(), &["solve", scene, "--out", &out]).status.success(), "{scene}");
        let drawn = folder.path().join(out).join(picture);
        let drawn = std::fs::read_to_string(drawn).expect("it was drawn");
        assert_file_by(format!("golden/{scene}/{picture}"), &drawn, same_picture);
    }
}
