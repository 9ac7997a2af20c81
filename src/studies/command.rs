//! The commands of the program, each of which stands in the folder of what it does.

use crate::{
    audit, compare, extremes, guide, lesson, listing, mathcad, report, scene, snapshot, solve,
    sweep, trade,
};

commands::group! {
    /// A command, with what it is asked for; help has the words of what each asks for.
    #[allow(missing_docs)]
    Command {
        Solve(solve::Args): solve::run,
        Extremes(extremes::command::Args): extremes::command::run,
        Trade(trade::command::Args): trade::command::run,
        #[command(subcommand)]
        Sweep(sweep::command::Command): sweep::command::run,
        Audit(audit::command::Args): audit::command::run,
        Report(report::command::Args): report::command::run,
        Lesson(lesson::command::Args): lesson::command::run,
        Compare(compare::command::Args): compare::command::run,
        #[command(subcommand)]
        Listing(listing::Command): listing::run,
        #[command(subcommand)]
        Mathcad(mathcad::Command): mathcad::run,
        #[command(subcommand)]
        Snapshot(snapshot::command::Command): snapshot::command::run,
        #[command(subcommand)]
        Scene(scene::Command): scene::run,
        Guide(guide::Args): guide::run,
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
