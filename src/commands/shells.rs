//! What shells and `man` have from the program: completions and man pages.

use std::path::Path;

use clap::Command;
use clap_complete::CompleteEnv;
use clap_complete::env::Shells;

use crate::printing::{print, report_written};
use base::files;
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

/// Writes the man pages of a command and of those in it to a folder.
///
/// # Errors
/// The folder cannot be written.
pub fn write_man_pages(grammar: &Command, folder: &Path) -> Result<()> {
    files::write_all(folder, &man_pages(grammar))?;
    report_written(folder);
    Ok(())
}

/// Returns the man pages of a command and of those in it, each with the name of its file.
fn man_pages(command: &Command) -> Vec<(String, Vec<u8>)> {
    let inner = command.get_subcommands().filter(|command| command.get_name() != "help");
    let mut pages: Vec<_> = inner.flat_map(man_pages).collect();
    let (page, mut text) = (clap_mangen::Man::new(command.clone()), Vec::new());
    page.render(&mut text).expect("memory can be written");
    pages.push((page.get_filename(), text));
    pages
}
