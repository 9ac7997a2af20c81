//! What an edited listing changes of what the printed one computes.

use super::layout::counted;
use super::model::Report;
use super::numbers::six_digits;
use mathcad::array::Table;
use paper::mirror::Pairs;
use problem::model::Model;
use studies::audit::trace::Product;

/// The most changed entries of a matrix that are listed.
const MOST_LISTED: usize = 20;

/// The part of an array's largest number up to which a difference is one of rounding: another order
/// of the operations changes a few units in the last place, which is 2e-16.
const ROUNDING: f64 = 1e-13;

/// Numbers of an array as printed and as edited, with their names.
#[derive(Default)]
struct Compared {
    entries: Vec<(String, Option<f64>, Option<f64>)>,
}

impl Compared {
    fn add(&mut self, name: String, printed: Option<f64>, edited: Option<f64>) {
        if printed.map(f64::to_bits) != edited.map(f64::to_bits) {
            self.entries.push((name, printed, edited));
        }
    }

    /// Splits the entries in those that change, and the differences of those that only round
    /// otherwise.
    fn split(self, largest: f64) -> (Vec<String>, Vec<f64>) {
        let (mut changed, mut rounded) = (Vec::new(), Vec::new());
        for (name, printed, edited) in self.entries {
            let difference = printed.zip(edited).map(|(a, b)| (a - b).abs());
            match difference.filter(|difference| *difference <= ROUNDING * largest) {
                Some(difference) => rounded.push(difference),
                None => {
                    let [a, b] = [printed, edited].map(|x| x.map_or("none".into(), six_digits));
                    changed.push(format!("{name}: {a} as printed, {b} edited"));
                }
            }
        }
        (changed, rounded)
    }
}

/// Reports what an edited listing changes against the listing as printed; rounding is no change.
pub fn report(printed: &Product, edited: &Product, model: &Model) -> Report {
    let (lines, rounded) = match (printed, edited) {
        (Product::Pairs(a), Product::Pairs(b)) => of_pairs(a, b, model),
        (Product::Matrix(a), Product::Matrix(b))
            if (a.rows(), a.cols()) == (b.rows(), b.cols()) =>
        {
            of_matrix(a, b)
        }
        _ => (vec!["the shape of the result".into()], vec![]),
    };
    let report = match lines.is_empty() {
        true => Report::default().line("The edit changes nothing on this scene."),
        false => Report::default().line("The edit changes:").notes(lines),
    };
    if rounded.is_empty() {
        return report;
    }
    let (numbers, most) = (counted(rounded.len(), "number", "numbers"), largest(&rounded));
    report.line(format!("The edit changes the rounding of {numbers}, by at most {most:.1e}."))
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

fn of_matrix(a: &Table<f64>, b: &Table<f64>) -> (Vec<String>, Vec<f64>) {
    let mut compared = Compared::default();
    for i in 1..=a.rows() {
        for j in 1..=a.cols() {
            compared.add(format!("MJS[{i},{j}]"), Some(a[(i, j)]), Some(b[(i, j)]));
        }
    }
    let (mut lines, rounded) = compared.split(largest(a.as_matrix().as_slice()));
    let n = lines.len();
    if n > MOST_LISTED {
        lines.truncate(MOST_LISTED);
        lines.push(format!("and {} more", n - MOST_LISTED));
    }
    if n > 0 {
        lines.insert(0, format!("{} of MJS", counted(n, "entry", "entries")));
    }
    (lines, rounded)
}

fn of_pairs(a: &Pairs<f64>, b: &Pairs<f64>, model: &Model) -> (Vec<String>, Vec<f64>) {
    let (mut whole, mut distances, mut weights) =
        (Compared::default(), Compared::default(), Compared::default());
    for (i1, node) in (1..).zip(&model.contact.nodes) {
        let number = |n: Option<&usize>| n.map(|n| *n as f64);
        whole.add(format!("ct[{i1}] (node {node})"), number(a.ct.get(i1)), number(b.ct.get(i1)));
        whole.add(format!("dy[{i1}] (node {node})"), number(a.dy.get(i1)), number(b.dy.get(i1)));
        let [at, bt] = [a, b].map(|pairs| pairs.yt.get(i1).copied());
        distances.add(format!("yt[{i1}] (node {node})"), at, bt);
    }
    for n in 1..=model.nodes.len() {
        for j in 1..=4 {
            let [at, bt] = [a, b].map(|pairs| pairs.k_cnt.get(n, j).copied());
            let of = if j % 2 == 0 { &mut weights } else { &mut whole };
            of.add(format!("k_cnt[{n},{j}]"), at, bt);
        }
    }
    // A weight is of the size of 1, and a distance is a difference of coordinates.
    let size = largest(model.nodes.as_flattened());
    let all = [whole.split(0.0), distances.split(size), weights.split(1.0)];
    let (mut lines, mut rounded) = (Vec::new(), Vec::new());
    for (changed, only_rounded) in all {
        lines.extend(changed);
        rounded.extend(only_rounded);
    }
    (lines, rounded)
}
