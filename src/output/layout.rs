//! Lists of words.

use std::fmt::Display;

/// Writes a number of things: `1 matrix`, `2 matrices`.
pub fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Writes items one behind the other, with a comma between two.
pub fn listed(items: impl IntoIterator<Item = impl Display>) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(", ")
}

/// Returns the first line of a text.
pub fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}

/// Fills lines of at most `width` characters with words: the first line begins with `start`, the others with `hang`
/// blanks. A word longer than a line has one of its own.
pub fn filled(start: &str, hang: usize, width: usize, words: &str) -> String {
    let (mut text, mut line) = (String::new(), start.to_string());
    for (k, word) in words.split(' ').enumerate() {
        if k > 0 && line.chars().count() + 1 + word.chars().count() > width {
            text += &format!("{}\n", line.trim_end());
            line = " ".repeat(hang);
        } else if k > 0 {
            line += " ";
        }
        line += word;
    }
    text + &line + "\n"
}
