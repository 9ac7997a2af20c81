//! The command line.
#![forbid(unsafe_code)]

/// Keeps the pages of one dense matrix for the next.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

mod commands;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Audited reimplementation of a published plane contact algorithm (Filipov & Khomenko): finite
/// elements, contact pairs by the listing c_cnt, stiffness by the listing Km.
#[derive(Parser)]
#[command(
    version,
    after_help = "\
Exit status: 0 done; 2 the input is at fault; 3 the published algorithm fails as printed (an audit
result); 4 no equilibrium was found, or more than one.

Examples:
  plane-contact solve                        the paper's example
  plane-contact solve fig1 --variant printed
  plane-contact audit                        every ambiguity and finding, on the paper's example
  plane-contact c-cnt fig1
  plane-contact km fig1 --coupled-by none"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Solve(commands::solve::Args),
    Audit(commands::audit::Args),
    CCnt(commands::c_cnt::Args),
    Km(commands::km::Args),
    Mesh(commands::mesh::Args),
    Plan(commands::plan::Args),
    Statuses(commands::statuses::Args),
    Trace(commands::trace::Args),
    Trade(commands::trade::Args),
    Export(commands::export::Args),
    Compare(commands::compare::Args),
    Extremes(commands::extremes::Args),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Solve(args) => commands::solve::run(&args),
        Command::Audit(args) => commands::audit::run(&args),
        Command::CCnt(args) => commands::c_cnt::run(&args),
        Command::Km(args) => commands::km::run(&args),
        Command::Mesh(args) => commands::mesh::run(&args),
        Command::Plan(args) => commands::plan::run(&args),
        Command::Statuses(args) => commands::statuses::run(&args),
        Command::Trace(args) => commands::trace::run(&args),
        Command::Trade(args) => commands::trade::run(&args),
        Command::Export(args) => commands::export::run(&args),
        Command::Compare(args) => commands::compare::run(&args),
        Command::Extremes(args) => commands::extremes::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_status())
        }
    }
}
