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

/// The scene of `golden/findings/<id>/`.
macro_rules! finding {
    ($id:literal) => {
        Embedded {
            name: concat!("findings/", $id),
            scene: include_bytes!(concat!("../../../golden/findings/", $id, "/scene.json")),
            files: &[],
        }
    };
}

/// The scenes of the command line.
pub const SCENES: &[Embedded] = &[
    Embedded {
        name: "strand",
        scene: include_bytes!("../../../golden/strand/scene.json"),
        files: &[("strand.msh", include_bytes!("../../../golden/strand/strand.msh"))],
    },
    Embedded { name: "fig1", scene: include_bytes!("../../../golden/fig1/scene.json"), files: &[] },
    Embedded {
        name: "two-blocks",
        scene: include_bytes!("../../../golden/two-blocks/scene.json"),
        files: &[],
    },
];

/// The smallest scene of each finding.
pub const FINDING_SCENES: &[Embedded] = &[
    finding!("C1"),
    finding!("C2"),
    finding!("C3"),
    finding!("C4"),
    finding!("C5"),
    finding!("C6"),
    finding!("C7"),
    finding!("C8"),
    finding!("C9"),
    finding!("C10"),
    finding!("C11"),
    finding!("C12"),
    finding!("C13"),
    finding!("C14"),
    finding!("C15"),
    finding!("K1"),
    finding!("K2"),
    finding!("K3"),
    finding!("K4"),
    finding!("K5"),
    finding!("K6"),
    finding!("K7"),
    finding!("K8"),
    finding!("K9"),
];
