//! Command lines that the grammar refuses.

use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::printing::{print_failure, print_stderr, report_failure};
use base::error::InputError;
use base::exit::ExitStatus;
use base::plain::is_hidden;
use engine::error::Error;

/// Prints to standard error what is wrong with the command line, and where `json` asks for it to standard
/// output too; returns its exit status.
pub fn report_usage(mut why: clap::Error, grammar: &clap::Command, json: bool) -> ExitStatus {
    if why.kind() == ErrorKind::InvalidUtf8 {
        return report_failure(&not_utf8(), json);
    }
    name_subcommands(&mut why, grammar);
    escape(&mut why);
    print_failure(&fault(&why), json);
    print_stderr(&rendered(&why));
    ExitStatus::Input
}

/// Adds to the error about a command that is not there the names of those that are, where none of
/// them is similar.
fn name_subcommands(why: &mut clap::Error, grammar: &clap::Command) {
    let is_unlike = why.kind() == ErrorKind::InvalidSubcommand
        && why.get(ContextKind::SuggestedSubcommand).is_none();
    if !is_unlike {
        return;
    }
    let group = std::env::args_os()
        .skip(1)
        // `help` is no group: the words behind it name one.
        .filter(|word| word != "help")
        .fold(grammar, |group, word| group.find_subcommand(&word).unwrap_or(group));
    let names = group.get_subcommands().map(clap::Command::get_name);
    let names: Vec<&str> = names.filter(|name| *name != "help").collect();
    let tip = format!("there are {}", names.join(", "));
    why.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
}

/// Writes what controls a terminal, or breaks a line, in the words of the user that an error repeats as
/// escapes.
fn escape(why: &mut clap::Error) {
    let escaped = |text: &String| text.escape_debug().to_string();
    let is_unsafe = |text: &String| text.contains(is_hidden);
    let context = why.context().filter_map(|(kind, value)| match value {
        ContextValue::String(text) if is_unsafe(text) => {
            Some((kind, ContextValue::String(escaped(text))))
        }
        _ => None,
    });
    for (kind, value) in context.collect::<Vec<_>>() {
        why.remove(ContextKind::Suggested);
        why.insert(kind, value);
    }
}

/// Returns what is wrong with the command line, with plain words in place of those that Rust has for numbers.
fn rendered(why: &clap::Error) -> String {
    const WORDS: [(&str, &str); 5] = [
        ("invalid float literal", "it is no number"),
        ("cannot parse float from empty string", "it is empty"),
        ("invalid digit found in string", "it is no whole number of 0 or more"),
        ("cannot parse integer from empty string", "it is empty"),
        ("number too large to fit in target type", "it is too large"),
    ];
    let text = why.render().to_string();
    WORDS
        .iter()
        .fold(text, |text, (rust, plain)| text.replace(&format!(": {rust}"), &format!(": {plain}")))
}

/// Returns the fault of an argument that is no text.
fn not_utf8() -> Error {
    let arg = std::env::args_os().find(|arg| arg.to_str().is_none()).unwrap_or_default();
    let what = format!("the argument {arg:?} is not in UTF-8");
    InputError::new("the command line", what, "rename the file, or type a value in UTF-8").into()
}

/// Returns the fault of a command line that the grammar refuses.
fn fault(why: &clap::Error) -> Error {
    let text = rendered(why);
    let start = text.lines().take_while(|line| !line.is_empty()).map(str::trim);
    let start = start.collect::<Vec<_>>().join(" ");
    InputError::new("the command line", start.trim_start_matches("error: "), "see --help").into()
}
