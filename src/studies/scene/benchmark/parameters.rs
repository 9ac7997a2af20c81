//! The parameters of a benchmark: options of the command line, each with its default.

/// Declares a benchmark with its parameters. Its documentation is its page of help.
macro_rules! parameters {
    ($(#[$attribute:meta])* $name:ident {
        $($(#[$doc:meta])* $parameter:ident: $type:ty = $default:expr,)+
    }) => {
        #[derive(Clone, Debug, PartialEq, clap::Args)]
        $(#[$attribute])*
        pub struct $name {
            $($(#[$doc])* #[arg(long, default_value_t = $default)] pub $parameter: $type,)+
        }

        impl Default for $name {
            fn default() -> Self {
                $name { $($parameter: $default),+ }
            }
        }
    };
}
pub(super) use parameters;
