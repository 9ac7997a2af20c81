//! `plane-contact snapshot`.

mod accept;
mod diff;
mod given_files;
mod record;
mod verify;

commands::group! {
    /// Record, verify, diff, or accept what a scene gives.
    #[command(after_help = "\
Examples:
  plane-contact snapshot record fig1
  plane-contact snapshot verify out/fig1.snapshot.json
  plane-contact snapshot diff fig1 --variant tied,stepped
  plane-contact snapshot accept my/snapshot.json")]
    Command {
        Record(record::Args): record::run,
        Verify(verify::Args): verify::run,
        Diff(diff::Args): diff::run,
        Accept(accept::Args): accept::run,
    }
}
