//! Displacements in a table of comma-separated values, as this program, spreadsheets and ParaView write it.

use super::{HOW, Row, Rows, is_number, plain};
use base::error::{InputError, Result};
use base::{files, limits};

/// The names of the columns, as [`plain`] leaves them: x, y, and the displacements along x, y and, where
/// there are any, z.
const COLUMNS: [&[&str]; 5] = [
    &["x", "coordx", "points0"],
    &["y", "coordy", "points1"],
    &["ux", "u1", "dx", "dispx", "displacementx", "displacementux", "displacement0"],
    &["uy", "u2", "dy", "dispy", "displacementy", "displacementuy", "displacement1"],
    &["uz", "u3", "dz", "dispz", "displacementz", "displacementuz", "displacement2"],
];

/// The most characters of the first line that an error shows.
const MOST_SHOWN: usize = 300;

/// Reads a table: its first line names the columns, which commas, semicolons or tabs separate.
///
/// # Errors
/// A column is missing or there twice, a line has another number of cells, or a cell is no number.
pub fn read(bytes: Vec<u8>, place: &str) -> Result<Rows> {
    let wrong = |what: String| InputError::new(place, what, HOW);
    let text =
        files::text(bytes).map_err(|why| wrong(format!("the field cannot be read: {why}")))?;
    let separators = text.bytes().filter(|byte| b",;\t\n".contains(byte)).count();
    limits::CELLS.check(separators, place)?;
    let mut lines = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let (_, heading) = lines.next().ok_or_else(|| wrong("the file is empty".into()))?;
    let separator = [';', '\t'].into_iter().find(|c| heading.contains(*c)).unwrap_or(',');
    let headings = cells(heading, separator);
    let column = |is_named: &dyn Fn(&str) -> bool| {
        let found: Vec<usize> = (0..headings.len()).filter(|k| is_named(&headings[*k])).collect();
        match found[..] {
            [] => Ok(None),
            [k] => Ok(Some(k)),
            [k, other, ..] => Err(wrong(format!(
                "the columns {:?} and {:?} mean the same",
                headings[k], headings[other]
            ))),
        }
    };
    let number = column(&is_number)?;
    let mut columns = [None; 5];
    for (place, names) in columns.iter_mut().zip(COLUMNS) {
        *place = column(&|name| names.contains(&&*plain(name)))?;
    }
    let ([x, y, Some(ux), Some(uy), uz], true) =
        (columns, number.is_some() || columns[0].is_some() && columns[1].is_some())
    else {
        let named: String = headings.join(" | ").chars().take(MOST_SHOWN).collect();
        return Err(wrong(format!(
            "the first line names the columns {named:?}, which do not say what is where"
        )));
    };
    let row = |(line, text): (usize, &str)| {
        let cells = cells(text, separator);
        if cells.len() != headings.len() {
            let (found, expected) = (cells.len(), headings.len());
            let what = format!("line {line} has {found} cells, the first line {expected}");
            let is_split = separator == ',' && found > expected;
            let why =
                if is_split { "; a decimal comma would separate cells: write a point" } else { "" };
            return Err(wrong(what + why));
        }
        let float = |column: usize| {
            cells[column].parse::<f64>().map_err(|_| {
                let (cell, heading) = (&cells[column], &headings[column]);
                let why = match cell.replacen(',', ".", 1).parse::<f64>() {
                    Ok(_) => "has a decimal comma: write a point",
                    Err(_) => "is no number, such as 1.5e-3",
                };
                wrong(format!("line {line}, column {heading:?}: {cell:?} {why}"))
            })
        };
        let number = match number {
            None => None,
            Some(column) => Some(float(column)?).map(|n| match n.fract() == 0.0 && n >= 1.0 {
                true => Ok(n as usize),
                false => Err(wrong(format!(
                    "line {line}: {n} is no number of a node, which count from 1"
                ))),
            }),
        };
        let at = match (x, y) {
            (Some(x), Some(y)) => Some([float(x)?, float(y)?]),
            (Some(_) | None, None) | (None, Some(_)) => None,
        };
        let u = [float(ux)?, float(uy)?, uz.map_or(Ok(0.0), float)?];
        Ok(Row { line, number: number.transpose()?, at, u })
    };
    let rows = lines.filter(|(_, text)| !text.trim().is_empty()).map(row).collect::<Result<_>>()?;
    let named = |places: &[Option<usize>]| -> Vec<String> {
        places.iter().flatten().map(|k| headings[*k].clone()).collect()
    };
    Ok(Rows {
        place: place.into(),
        names: named(&columns),
        taken: format!("columns {}", [named(&[number]), named(&columns)].concat().join(" | ")),
        rows,
    })
}

/// Returns the cells of a line; a separator between quotation marks separates none.
fn cells(line: &str, separator: char) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            c if c == separator && !is_quoted => cells.push(String::new()),
            c => cells.last_mut().expect("there is a first cell").push(c),
        }
    }
    cells.iter().map(|cell| cell.trim().to_string()).collect()
}
