//! How the program ends: each of its exit statuses, with number, name and meaning. Help lists them.

use std::process::ExitCode;

crate::choices! {
    /// How the program ends.
    ExitStatus {
        /// Done, also with 'nothing transmitted': a result of the audit, which the output names.
        Done = "done",
        /// What was compared differs, or nothing could be compared.
        Differs = "differs",
        /// The input is at fault; the message says what, where, and how to fix it.
        Input = "input",
        /// The published algorithm fails as printed: a result of the audit, no fault of the program.
        Algorithm = "algorithm",
        /// No equilibrium was found, or more than one.
        Equilibrium = "equilibrium",
        /// A fault of the program, a panic: please report it.
        Panic = "panic",
    }
}

impl ExitStatus {
    /// Returns the status of a comparison.
    pub const fn compared(is_same: bool) -> Self {
        if is_same { ExitStatus::Done } else { ExitStatus::Differs }
    }

    /// Returns the number that the system gets.
    pub const fn number(self) -> u8 {
        match self {
            ExitStatus::Done => 0,
            ExitStatus::Differs => 1,
            ExitStatus::Input => 2,
            ExitStatus::Algorithm => 3,
            ExitStatus::Equilibrium => 4,
            // That of Rust's own runtime.
            ExitStatus::Panic => 101,
        }
    }
}

/// What is done without a status of its own.
impl From<()> for ExitStatus {
    fn from((): ()) -> Self {
        ExitStatus::Done
    }
}

impl From<ExitStatus> for ExitCode {
    fn from(status: ExitStatus) -> Self {
        status.number().into()
    }
}
