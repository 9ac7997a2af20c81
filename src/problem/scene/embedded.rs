//! The scenes that are part of the program, by name.

/// A scene from `golden/<name>/`.
pub struct Embedded {
    /// The name by which the scene is opened.
    pub name: &'static str,
    /// The text of the scene file.
    pub scene: &'static [u8],
    /// The names and the bytes of the files beside it.
    pub files: &'static [(&'static str, &'static [u8])],
}

/// Lists the scenes of `golden/findings/<id>/`.
macro_rules! findings {
    ($($id:literal),+) => {
        &[$(Embedded {
            name: concat!("findings/", $id),
            scene: include_bytes!(concat!("../golden/findings/", $id, "/scene.json")),
            files: &[],
        }),+]
    };
}

/// The paper's example and two small scenes.
pub const SCENES: &[Embedded] = &[
    Embedded {
        name: "strand",
        scene: include_bytes!("../golden/strand/scene.json"),
        files: &[("strand.msh", include_bytes!("../golden/strand/strand.msh"))],
    },
    Embedded { name: "fig1", scene: include_bytes!("../golden/fig1/scene.json"), files: &[] },
    Embedded {
        name: "two-blocks",
        scene: include_bytes!("../golden/two-blocks/scene.json"),
        files: &[],
    },
];

/// The smallest scene of each finding.
#[rustfmt::skip]
pub const FINDING_SCENES: &[Embedded] = findings![
    "C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8", "C9", "C10", "C11", "C12", "C13", "C14", "C15",
    "K1", "K2", "K3", "K4", "K5", "K6", "K7", "K8", "K9"
];
