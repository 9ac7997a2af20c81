//! How far a solution of Tᵀ K T q = f may be from the true one, K, T and f themselves being known
//! within bounds: what it leaves of f is summed triangle by triangle, without the matrix.

use std::ops::Range;

use nalgebra::DVector;

use super::elimination::Elimination;
use super::stiffness::Stiffness;
use numbers::scalar::{BoundedDouble, Rounded, SumOfProducts, WithBound};
use numbers::solve::{Factors, error_of_rest};
use problem::model::Dof;

/// Returns a bound on the largest error of an entry of `q`, infinite where Tᵀ K T cannot be told from
/// a singular matrix. `factors` are those of that matrix rounded to `f64`.
pub(super) fn error_of_solution<V: Rounded + Send + Sync>(
    (stiffness, t): (&Stiffness<WithBound<V>>, &Elimination<WithBound<V>>),
    factors: &dyn Factors,
    f: &DVector<WithBound<V>>,
    q: &DVector<V>,
) -> f64 {
    let zero = BoundedDouble::new(V::ZERO.double(), 0.0);
    let rows: Vec<_> = (0..t.shift().len()).map(|e| t.row(Dof::new(e))).collect();
    let of_row = |row: &&[(usize, WithBound<V>)]| TransformedRow {
        u: row.iter().fold(zero, |sum, (p, w)| sum + w.in_double() * exact(q[*p]).in_double()),
        size: row.iter().map(|(_, w)| size(*w) + w.off()).sum(),
        off: row.iter().map(|(_, w)| w.off()).sum(),
    };
    let moved: Vec<TransformedRow> = rows.iter().map(of_row).collect();
    // K T q, and of each row of K T the sum of its entries' sizes, and of what they may be off.
    let of_triangles = |triangles: Range<usize>| {
        let none = Force { u: SumOfProducts::ZERO, size: 0.0, off: 0.0 };
        let mut force = vec![none; rows.len()];
        stiffness.visit(triangles, |dofs, k| {
            // Row by row within a column: sums that follow each other need not wait for each other.
            for (j, column) in dofs.iter().enumerate() {
                let moved = &moved[column.index()];
                for (i, row) in dofs.iter().enumerate() {
                    let (k, force) = (k[(i, j)], &mut force[row.index()]);
                    force.u.add(k.in_double(), moved.u);
                    force.size += size(k) * moved.size;
                    force.off += k.off() * moved.size + size(k) * moved.off;
                }
            }
        });
        force
    };
    let (all, half) = (stiffness.triangles(), stiffness.triangles() / 2);
    let (mut force, other) = rayon::join(|| of_triangles(0..half), || of_triangles(half..all));
    for (force, other) in force.iter_mut().zip(other) {
        force.u.join(&other.u);
        force.size += other.size;
        force.off += other.off;
    }
    let mut rest = f.map(WithBound::in_double);
    let mut spread = DVector::zeros(q.len());
    for (row, force) in rows.iter().zip(&force) {
        for (p, w) in row.iter() {
            rest[*p] -= w.in_double() * force.u.total();
            spread[*p] += size(*w) * force.off + w.off() * (force.size + force.off);
        }
    }
    // They are large, and the factors take their time.
    drop((rows, moved, force));
    error_of_rest(factors, &rest, &spread)
}

/// A row of T.
#[derive(Clone)]
struct TransformedRow {
    /// Its product with q.
    u: BoundedDouble,
    /// The sum of the sizes of its entries.
    size: f64,
    /// The sum of what its entries may be off.
    off: f64,
}

/// A row of K T: the same.
#[derive(Clone)]
struct Force {
    u: SumOfProducts,
    size: f64,
    off: f64,
}

fn exact<V: Rounded>(x: V) -> WithBound<V> {
    WithBound::new(x, 0.0)
}

fn size<V: Rounded>(x: WithBound<V>) -> f64 {
    x.value().to_f64().abs()
}
