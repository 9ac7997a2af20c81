//! The commands of the program, each of which stands in the folder of what it does.

use clap::Subcommand;

use crate::{
    audit, compare, extremes, guide, lesson, listing, mathcad, report, scene, snapshot, solve,
    sweep, trade,
};
use base::exit::ExitStatus;
use engine::error::Result;

/// A command, with what it is asked for; help has the words of what each asks for.
#[allow(missing_docs)]
#[derive(Subcommand)]
pub enum Command {
    Solve(solve::Args),
    Extremes(extremes::command::Args),
    Trade(trade::command::Args),
    #[command(subcommand)]
    Sweep(sweep::command::Command),
    Audit(audit::command::Args),
    Report(report::command::Args),
    Lesson(lesson::command::Args),
    Compare(compare::command::Args),
    #[command(subcommand)]
    Listing(listing::Command),
    #[command(subcommand)]
    Mathcad(mathcad::Command),
    #[command(subcommand)]
    Snapshot(snapshot::command::Command),
    #[command(subcommand)]
    Scene(scene::Command),
    Guide(guide::Args),
}

impl Command {
    /// Runs the command; returns the exit status.
    ///
    /// # Errors
    /// Those of the command.
    pub fn run(self) -> Result<ExitStatus> {
        let done = |()| ExitStatus::Done;
        match self {
            Command::Solve(args) => solve::run(&args),
            Command::Extremes(args) => extremes::command::run(&args).map(done),
            Command::Trade(args) => trade::command::run(&args).map(done),
            Command::Sweep(command) => sweep::command::run(&command).map(done),
            Command::Audit(args) => audit::command::run(&args).map(done),
            Command::Report(args) => report::command::run(&args).map(done),
            Command::Lesson(args) => lesson::command::run(&args).map(done),
            Command::Compare(args) => compare::command::run(&args),
            Command::Listing(command) => listing::run(&command),
            Command::Mathcad(command) => mathcad::run(&command),
            Command::Snapshot(command) => snapshot::command::run(&command),
            Command::Scene(command) => scene::run(&command).map(done),
            Command::Guide(args) => guide::run(&args).map(done),
        }
    }
}

/// The commands as the first page of help groups them.
const GROUPS: [(&str, &[&str]); 6] = [
    ("Compute", &["solve", "compare", "trade", "extremes", "sweep"]),
    ("Audit and teach", &["audit", "report", "lesson"]),
    ("Listings and Mathcad", &["listing", "mathcad"]),
    ("Snapshots", &["snapshot"]),
    ("Scenes", &["scene"]),
    ("Guide", &["guide"]),
];

/// Returns the list of the commands by group, each with what it does.
pub fn grouped(grammar: &clap::Command) -> String {
    let row = |name: &&str| {
        let command = grammar.find_subcommand(name).expect("a group has commands that exist");
        let about = command.get_about().expect("a command says what it does");
        format!("  {name:<9} {about}\n")
    };
    let group = |(heading, names): &(&str, &[&str])| {
        format!("{heading}:\n{}", names.iter().map(row).collect::<String>())
    };
    GROUPS.iter().map(group).collect::<Vec<_>>().join("\n").trim_end().to_string()
}
