//! Matrix Market coordinate format (R. F. Boisvert, R. Pozo, K. A. Remington, NISTIR 5935).

use base::files::PER_CENT;
use base::plain::on_a_line;
use numbers::square::SparseSquare;

/// Writes the entries of `matrix` that are not zero, row by row, with 17 significant digits;
/// `comment` becomes one line.
pub fn matrix_market(matrix: &SparseSquare, comment: &str) -> String {
    let n = matrix.size();
    let mut entries: Vec<_> = matrix.entries().collect();
    entries.sort_by_key(|(i, j, _)| (*i, *j));
    let lines = entries.iter().map(|(i, j, value)| format!("{} {} {value:.16e}\n", i + 1, j + 1));
    let comment = on_a_line(comment);
    format!(
        "%%MatrixMarket matrix coordinate real general\n{PER_CENT}{comment}\n{n} {n} {}\n{}",
        entries.len(),
        lines.collect::<String>()
    )
}
