//! The text of tables in files.

/// Lays out a table as RFC 4180 has it: the line `head`, then a line for each of `rows`.
pub fn csv(head: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let quoted = |cell: &String| match cell.contains([',', '"', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    };
    let line = |row: Vec<String>| row.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n";
    format!("{head}\n") + &rows.into_iter().map(line).collect::<String>()
}
