//! Matrix Market coordinate format (R. F. Boisvert, R. Pozo, K. A. Remington, NISTIR 5935).

use std::fmt::Write as _;

use nalgebra::DMatrix;

/// The non-zero entries of `matrix`, row by row, with 17 significant digits; `comment` is one line.
pub fn matrix_market(matrix: &DMatrix<f64>, comment: &str) -> String {
    let (rows, columns) = matrix.shape();
    let count = matrix.iter().filter(|x| **x != 0.0).count();
    let mut text = format!("%%MatrixMarket matrix coordinate real general\n% {comment}\n");
    writeln!(text, "{rows} {columns} {count}").expect("a String takes any text");
    for i in 0..rows {
        for j in 0..columns {
            let value = matrix[(i, j)];
            if value != 0.0 {
                writeln!(text, "{} {} {value:.16e}", i + 1, j + 1)
                    .expect("a String takes any text");
            }
        }
    }
    text
}
