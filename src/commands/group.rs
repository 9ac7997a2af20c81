//! Groups of commands.

/// Declares a group of commands, a row for each: its arguments, and the function that runs it, which returns the
/// exit status, or nothing where that is 0.
#[macro_export]
macro_rules! group {
    ($(#[$group:meta])* Command {
        $($(#[$of:meta])* $name:ident($args:ty): $run:path,)+
    }) => {
        #[derive(clap::Subcommand)]
        $(#[$group])*
        pub enum Command { $($(#[$of])* $name($args)),+ }

        /// Runs a command; returns the exit status.
        ///
        /// # Errors
        /// Those of the command.
        pub fn run(command: &Command) -> engine::error::Result<base::exit::ExitStatus> {
            match command { $(Command::$name(args) => $run(args).map(Into::into)),+ }
        }
    };
}
