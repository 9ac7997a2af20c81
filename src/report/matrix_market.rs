//! Matrix Market coordinate format (R. F. Boisvert, R. Pozo, K. A. Remington, NISTIR 5935).

use nalgebra::DMatrix;

/// Writes the entries of `matrix` that are not zero, row by row, with 17 significant digits;
/// `comment` becomes one line.
pub fn matrix_market(matrix: &DMatrix<f64>, comment: &str) -> String {
    let (rows, columns) = matrix.shape();
    let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let entries = places.map(|(i, j)| (i + 1, j + 1, matrix[(i, j)]));
    let entries: Vec<_> = entries.filter(|(_, _, value)| *value != 0.0).collect();
    let lines = entries.iter().map(|(i, j, value)| format!("{i} {j} {value:.16e}\n"));
    let comment = comment.replace(char::is_control, " ");
    format!(
        "%%MatrixMarket matrix coordinate real general\n% {comment}\n{rows} {columns} {}\n{}",
        entries.len(),
        lines.collect::<String>()
    )
}
