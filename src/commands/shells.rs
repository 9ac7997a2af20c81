//! What shells have from the program: completions.

use clap::Command;
use clap_complete::CompleteEnv;
use clap_complete::env::Shells;

use crate::printing::print;
use engine::error::Result;

/// The shells that completions are for.
pub const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

/// The variable of the environment by which a shell asks what completes a command line.
const COMPLETE: &str = "PLANE_CONTACT_COMPLETE";

/// Answers a shell that asks what completes a command line, and ends the process then.
pub fn complete(grammar: fn() -> Command) {
    CompleteEnv::with_factory(grammar).var(COMPLETE).complete();
}

/// Prints what a shell, one of [`SHELLS`], runs at its start to complete command lines.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_completions(shell: &str) -> Result<()> {
    let (shells, mut script) = (Shells::builtins(), Vec::new());
    let completer = shells.completer(shell).expect("clap knows the values of the option");
    let [name, program] = ["plane_contact", "plane-contact"];
    completer
        .write_registration(COMPLETE, name, program, program, &mut script)
        .expect("memory can be written");
    print(&String::from_utf8(script).expect("it is UTF-8"))
}
