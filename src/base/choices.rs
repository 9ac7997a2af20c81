//! Closed sets of choices, such as readings and variants.

/// Returns a sentence as a part of one.
pub fn phrase(sentence: &str) -> String {
    let sentence = sentence.trim().trim_end_matches('.');
    let is_word = sentence.chars().nth(1).is_some_and(|c| !c.is_uppercase());
    let (first, rest) = sentence.split_at(usize::from(is_word));
    (first.to_lowercase() + rest).replace('`', "")
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
                match text {
                    $($text => Ok($name::$variant),)+
                    _ => {
                        let near = $crate::suggestion::did_you_mean(text, [$($text),+]);
                        Err(format!("{near}{text:?} is none of {}", [$($text),+].join(", ")))
                    }
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}
