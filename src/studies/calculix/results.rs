//! What `ccx` printed to its `.dat` file.

use super::fields::Fields;
use base::error::{InputError, Result};

#[derive(Clone, Copy)]
enum Block {
    /// Node, u_x, u_y, u_z.
    Displacements,
    /// Element, integration point, the six stresses.
    Stresses,
    Other,
}

/// The time at the end of a deck's step, as it is printed.
const END: f64 = 1.0;

/// Reads the displacements of `nodes` nodes and the stresses of `triangles` triangles at the end of the step.
///
/// A plane triangle has two integration points across the thickness: its stress is their mean.
///
/// # Errors
/// A node or a triangle is missing, as where the file is cut; something is no number.
pub fn parse(text: &str, nodes: usize, triangles: usize) -> Result<Fields> {
    if !text.ends_with('\n') {
        return Err(cut("its last line has no end".into()));
    }
    let mut u = vec![None; nodes];
    let mut points: Vec<Vec<[f64; 6]>> = vec![Vec::new(); triangles];
    let mut block = Block::Other;
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let words = line.trim_start();
        if words.starts_with(|c: char| c.is_ascii_alphabetic()) {
            let is_last = words.split_whitespace().last().and_then(float) == Some(END);
            block = match words {
                words if is_last && words.starts_with("displacements") => {
                    // An increment begins: what an earlier one had is no part of it.
                    u.fill(None);
                    points.iter_mut().for_each(Vec::clear);
                    Block::Displacements
                }
                words if is_last && words.starts_with("stresses") => Block::Stresses,
                _ => Block::Other,
            };
            continue;
        }
        match block {
            Block::Displacements => {
                let ([node], [x, y, _]) = row(line)?;
                *entry(&mut u, node, line)? = Some([x, y]);
            }
            Block::Stresses => {
                let ([triangle, point], stress) = row(line)?;
                let points = entry(&mut points, triangle, line)?;
                match point == points.len() + 1 {
                    true => points.push(stress),
                    false => return Err(not_understood(line)),
                }
            }
            Block::Other => {}
        }
    }
    let u = u.into_iter().enumerate().map(|(k, u)| u.ok_or_else(|| missing("node", k + 1)));
    // All triangles have as many points, of which the last one may have lost some.
    let most = points.iter().map(Vec::len).max().unwrap_or_default();
    let stresses = points.iter().enumerate();
    let stresses = stresses.map(|(k, points)| {
        let sum = |c: usize| points.iter().map(|point| point[c]).sum::<f64>();
        let mean = std::array::from_fn(|c| sum(c) / points.len() as f64);
        let is_whole = points.len() == most && most > 0;
        is_whole.then_some(mean).ok_or_else(|| missing("element", k + 1))
    });
    Ok(Fields { u: u.collect::<Result<_, _>>()?, sigma: stresses.collect::<Result<_, _>>()? })
}

fn entry<'a, T>(of: &'a mut [T], number: usize, line: &str) -> Result<&'a mut T> {
    number.checked_sub(1).and_then(|k| of.get_mut(k)).ok_or_else(|| not_understood(line))
}

/// `I` numbers, then `V` values.
fn row<const I: usize, const V: usize>(line: &str) -> Result<([usize; I], [f64; V])> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let parsed = || -> Option<([usize; I], [f64; V])> {
        let (numbers, values) = words.split_at_checked(I)?;
        let numbers: Option<Vec<usize>> = numbers.iter().map(|word| word.parse().ok()).collect();
        let values: Option<Vec<f64>> = values.iter().map(|word| float(word)).collect();
        Some((numbers?.try_into().ok()?, values?.try_into().ok()?))
    };
    parsed().ok_or_else(|| not_understood(line))
}

/// The largest number of results: squares of stresses and their sums stay finite.
const LARGEST: f64 = 1e150;

/// A number as Fortran prints it: `1.0E-01`, and `1.0-101` where the exponent is long; none beyond
/// the largest.
pub fn float(word: &str) -> Option<f64> {
    let plain = word.parse::<f64>().ok();
    let short = || {
        let sign = word.rfind(['+', '-']).filter(|&at| at > 0)?;
        format!("{}e{}", &word[..sign], &word[sign..]).parse().ok()
    };
    plain.or_else(short).filter(|x| x.abs() <= LARGEST)
}

fn not_understood(line: &str) -> InputError {
    let what = format!("the line {:?} is not understood", line.trim());
    InputError::new("the results of ccx", what, "use CalculiX 2.20, which this was written for")
}

fn missing(what: &str, number: usize) -> InputError {
    cut(format!("{what} {number} is not in them at time {END}, the end of the step"))
}

fn cut(what: String) -> InputError {
    let fix =
        "see whether the disk of TMPDIR is full; else export the deck and see what ccx says of it";
    InputError::new("the results of ccx", what, fix)
}
