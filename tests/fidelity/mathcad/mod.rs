//! The paper's listings in the interpreter, and as worksheets. The tests of the interpreter itself stand in its
//! package, `src/mathcad/tests`.

mod paper;
#[path = "../../../src/mathcad/tests/spelled.rs"]
mod spelled;
mod worksheets;

/// An embedded scene as a worksheet, as `export --to mathcad` writes it.
pub fn exported(scene: &str) -> String {
    let out = crate::common::program::run(
        std::path::Path::new("."),
        &["mathcad", "export", scene, "--to", "mathcad"],
    );
    String::from_utf8(out.stdout).expect("UTF-8")
}
