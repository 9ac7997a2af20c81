//! Closed sets of choices, such as readings and variants.

use crate::suggestion::did_you_mean;

/// Returns a sentence as a part of one.
pub fn phrase(sentence: &str) -> String {
    let sentence = sentence.trim().trim_end_matches('.');
    let is_word = sentence.chars().nth(1).is_some_and(|c| !c.is_uppercase());
    let (first, rest) = sentence.split_at(usize::from(is_word));
    (first.to_lowercase() + rest).replace('`', "")
}

/// Returns the member of a closed set, or the row of a table, that has a name.
///
/// # Errors
/// None has: says which name it may be meant for, and all names.
pub fn named<T>(
    text: &str,
    all: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> &'static str,
) -> Result<T, String> {
    let mut names = Vec::new();
    for one in all {
        match name(&one) {
            found if found == text => return Ok(one),
            other => names.push(other),
        }
    }
    let near = did_you_mean(text, names.iter().copied());
    Err(format!("{near}{text:?} is none of {}", names.join(", ")))
}

/// Declares a closed set of choices with their names on the command line and in files. Doc comments say
/// what each means, also in help.
#[macro_export]
macro_rules! choices {
    ($(#[$doc:meta])* $name:ident {
        $($(#[doc = $vdoc:literal])* $variant:ident = $text:literal),+ $(,)?
    }) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        $(#[$doc])*
        pub enum $name { $($(#[doc = $vdoc])* #[serde(rename = $text)] $variant),+ }

        impl $name {
            /// All of them, with the default first.
            pub const ALL: &'static [$name] = &[$($name::$variant),+];

            /// Returns the name on the command line.
            pub const fn name(self) -> &'static str {
                match self { $($name::$variant => $text),+ }
            }

            /// Returns what it means, its doc comment, as a part of a sentence.
            pub fn explained(self) -> String {
                $crate::choices::phrase(match self { $($name::$variant => concat!($($vdoc),*)),+ })
            }

            /// Returns each name with what it means, for help.
            pub fn help() -> String {
                let choices = Self::ALL.iter().map(|choice| format!("{choice}: {}", choice.explained()));
                choices.collect::<Vec<_>>().join("; ")
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self::ALL[0]
            }
        }

        impl std::str::FromStr for $name {
            type Err = String;
            fn from_str(text: &str) -> Result<Self, String> {
                $crate::choices::named(text, Self::ALL.iter().copied(), |choice| choice.name())
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}
