//! Mutation testing by one build that holds every mutant: `.ci/mutants/run` says how it is used.
#![forbid(unsafe_code)]

mod grade;
mod kept;
mod mutant;
mod prepare;
mod processes;
mod render;
mod select;
mod sites;
mod table;
mod tests;
mod workers;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub type Failure = Box<dyn Error>;

/// The folder in which all of this stands.
pub struct Work(PathBuf);

impl Work {
    /// The rewritten copy of the tree.
    pub fn tree(&self) -> PathBuf {
        self.0.join("tree")
    }

    pub fn target(&self) -> PathBuf {
        self.0.join("target")
    }

    pub fn mutants(&self) -> PathBuf {
        self.0.join("mutants.json")
    }

    /// The tests, how long each takes and what it reaches.
    pub fn tests(&self) -> PathBuf {
        self.0.join("tests.jsonl")
    }

    pub fn results(&self) -> PathBuf {
        self.0.join("results.jsonl")
    }

    /// The temporary files of one worker.
    pub fn temporary(&self, worker: usize) -> PathBuf {
        self.0.join("tmp").join(worker.to_string())
    }
}

fn run(arguments: &[String]) -> Result<(), Failure> {
    let [command, work, rest @ ..] = arguments else {
        return Err("usage: prepare|reach|take|grade|keep|table WORK [OPTIONS]".into());
    };
    let work = Work(std::path::absolute(work)?);
    match (command.as_str(), rest) {
        ("prepare", [list]) => prepare::prepare(&work, Path::new(list)),
        ("reach", [left_out]) => tests::reach(&work, Path::new(left_out)),
        ("take", [kept]) => kept::take(&work, Path::new(kept)),
        ("keep", [kept]) => kept::keep(&work, Path::new(kept)),
        ("grade", options) => grade::grade(&work, &select::Options::read(options)?),
        ("table", [reviewed]) => table::print(&work, Path::new(reviewed)),
        _ => Err(format!("{command}: unknown, or with other arguments").into()),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}
