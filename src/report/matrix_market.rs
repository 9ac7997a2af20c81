//! Matrix Market coordinate format (R. F. Boisvert, R. Pozo, K. A. Remington, NISTIR 5935).

use mathcad::SparseSquare;

/// Writes the entries of `matrix` that are not zero, row by row, with 17 significant digits;
/// `comment` becomes one line.
pub fn matrix_market(matrix: &SparseSquare, comment: &str) -> String {
    let n = matrix.size();
    let mut entries: Vec<_> = matrix.entries().collect();
    entries.sort_by_key(|(i, j, _)| (*i, *j));
    let lines = entries.iter().map(|(i, j, value)| format!("{} {} {value:.16e}\n", i + 1, j + 1));
    let comment = comment.replace(char::is_control, " ");
    format!(
        "%%MatrixMarket matrix coordinate real general\n% {comment}\n{n} {n} {}\n{}",
        entries.len(),
        lines.collect::<String>()
    )
}
