//! `plane-contact mathcad`.

mod export;
mod run;

commands::group! {
    /// Run a worksheet of Mathcad, or export a scene to one.
    #[command(after_help = "\
Examples:
  plane-contact mathcad run worksheet.xmcd
  plane-contact mathcad export fig1 --out fig1.xmcd")]
    Command {
        Run(run::Args): run::run,
        Export(export::Args): export::run,
    }
}
