//! `plane-contact listing`.

mod evaluate;
mod run;

commands::group! {
    /// Run a listing of the paper, or evaluate a program in its notation.
    #[command(after_help = "\
Examples:
  plane-contact listing run c_cnt fig1
  plane-contact listing run Km fig1 --coupled-by none
  plane-contact listing evaluate sum.txt --call \"sum(10)\"")]
    Command {
        #[command(subcommand)]
        Run(run::Command): run::run,
        Evaluate(evaluate::Args): evaluate::run,
    }
}
