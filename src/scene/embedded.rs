//! The scenes that the program carries, by name.

/// A scene of `golden/<name>/`.
pub struct Embedded {
    /// Name on the command line.
    pub name: &'static str,
    /// The scene file.
    pub scene: &'static [u8],
    /// The files beside it that it names.
    pub files: &'static [(&'static str, &'static [u8])],
}

/// All of them.
pub const SCENES: &[Embedded] = &[
    Embedded {
        name: "strand",
        scene: include_bytes!("../../golden/strand/scene.json"),
        files: &[("strand.msh", include_bytes!("../../golden/strand/strand.msh"))],
    },
    Embedded { name: "fig1", scene: include_bytes!("../../golden/fig1/scene.json"), files: &[] },
    Embedded {
        name: "two-blocks",
        scene: include_bytes!("../../golden/two-blocks/scene.json"),
        files: &[],
    },
];
