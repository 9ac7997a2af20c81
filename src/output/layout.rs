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

/// Fills lines of at most `width` characters with items, one behind the other: the first line begins
/// with `start`, the others with `hang` blanks. An item longer than a line has one of its own.
pub fn filled(
    start: &str,
    hang: usize,
    width: usize,
    items: impl IntoIterator<Item = impl Display>,
    separator: &str,
) -> String {
    let (mut text, mut line) = (String::new(), start.to_string());
    for (k, item) in items.into_iter().enumerate() {
        let item = item.to_string();
        let length = [&line, separator, &item, separator.trim_end()].map(|s| s.chars().count());
        if k > 0 && length.iter().sum::<usize>() > width {
            text += &format!("{}\n", (line + separator).trim_end());
            line = " ".repeat(hang);
        } else if k > 0 {
            line += separator;
        }
        line += &item;
    }
    text + &line + "\n"
}
