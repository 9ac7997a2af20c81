//! Sparse symmetric matrices.

use std::ops::Range;
use std::sync::Arc;

use faer::sparse::SymbolicSparseColMatRef;
use nalgebra::DVector;

use super::factors::backward_error;
use numbers::scalar::Scalar;

/// The places of the entries in the lower triangle of a symmetric matrix.
#[derive(Debug)]
pub struct Pattern {
    /// Where each column starts, and where the last one ends.
    starts: Vec<usize>,
    /// The rows of each column, ascending.
    rows: Vec<usize>,
}

impl Pattern {
    /// Collects the places (row, column) in an n x n matrix that `places` visits, those above the
    /// diagonal left out. It is called twice.
    pub fn new(n: usize, places: impl Fn(&mut dyn FnMut(usize, usize))) -> Self {
        let mut ends = vec![0; n + 1];
        places(&mut |i, j| ends[j + 1] += usize::from(i >= j));
        (0..n).for_each(|j| ends[j + 1] += ends[j]);
        let mut all = vec![0_u32; ends[n]];
        places(&mut |i, j| {
            if i >= j {
                all[ends[j]] = u32::try_from(i).expect("a row of a matrix that fits in memory");
                ends[j] += 1;
            }
        });
        let (mut starts, mut rows) = (Vec::with_capacity(n + 1), Vec::new());
        let mut from = 0;
        for end in &ends[..n] {
            let column = &mut all[from..*end];
            column.sort_unstable();
            starts.push(rows.len());
            rows.extend(column.chunk_by(|a, b| a == b).map(|same| same[0] as usize));
            from = *end;
        }
        starts.push(rows.len());
        Pattern { starts, rows }
    }

    /// Collects the places in the matrix of `n` equations that triangles make of their matrices: each joins
    /// every equation of its nodes, of which there are `nodes`. `equations` returns those of a node.
    pub fn of_triangles<E: Iterator<Item = usize> + Clone>(
        n: usize,
        nodes: usize,
        triangles: impl Iterator<Item = [usize; 3]> + Clone,
        equations: impl Fn(usize) -> E,
    ) -> Self {
        let of_nodes = Pattern::new(nodes, |visit| {
            for [a, b, c] in triangles.clone() {
                [a, b, c].iter().for_each(|node| visit(*node, *node));
                [[a, b], [b, c], [c, a]].iter().for_each(|[p, q]| visit(*p.max(q), *p.min(q)));
            }
        });
        Pattern::new(n, |visit| {
            for q in 0..nodes {
                let columns = equations(q);
                for p in of_nodes.column(q) {
                    for i in equations(p) {
                        columns.clone().for_each(|j| visit(i.max(j), i.min(j)));
                    }
                }
            }
        })
    }

    /// Returns the number of rows, which is that of the columns.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns where the values of a column stand.
    fn values(&self, j: usize) -> Range<usize> {
        self.starts[j]..self.starts[j + 1]
    }

    /// Returns the rows of the entries of a column of the lower triangle.
    pub(super) fn column(&self, j: usize) -> impl Iterator<Item = usize> {
        self.rows[self.values(j)].iter().copied()
    }

    /// Returns the pattern as faer takes it.
    pub(super) fn view(&self) -> SymbolicSparseColMatRef<'_, usize> {
        let n = self.size();
        SymbolicSparseColMatRef::new_checked(n, n, &self.starts, None, &self.rows)
    }
}

/// A symmetric matrix: the entries of its lower triangle, column by column, rows ascending.
#[derive(Clone, Debug)]
pub struct SparseSymmetric<T = f64> {
    pattern: Arc<Pattern>,
    values: Vec<T>,
}

impl<T: Scalar> SparseSymmetric<T> {
    /// Sums `entries` (row, column, value) into an n x n matrix, in their order and without those
    /// above the diagonal. They are gone through three times.
    pub fn new(n: usize, entries: impl Iterator<Item = (usize, usize, T)> + Clone) -> Self {
        let pattern = Pattern::new(n, |visit| entries.clone().for_each(|(i, j, _)| visit(i, j)));
        let lower = entries.filter(|(i, j, _)| i >= j);
        SparseSymmetric::summed(pattern, |visit| {
            lower.clone().for_each(|(i, j, value)| visit(i, j, value));
        })
    }

    /// Sums the entries of the lower triangle that `entries` visits, in their order; each stands at a
    /// place of the pattern.
    pub fn summed(pattern: Pattern, entries: impl FnOnce(&mut dyn FnMut(usize, usize, T))) -> Self {
        let mut values = vec![T::zero(); pattern.rows.len()];
        let mut begun = vec![false; values.len()];
        entries(&mut |i, j, value| {
            let column = pattern.values(j);
            let at = column.start + pattern.rows[column].partition_point(|row| *row < i);
            // The first is no sum: of some numbers 0 + x is not quite x.
            match std::mem::replace(&mut begun[at], true) {
                true => values[at] += value,
                false => values[at] = value,
            }
        });
        SparseSymmetric { pattern: Arc::new(pattern), values }
    }
}

impl<T: Clone> SparseSymmetric<T> {
    /// Returns the number of rows, which is that of the columns.
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// Returns the entries of the lower triangle: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, T)> {
        (0..self.size()).flat_map(move |j| self.column(j).map(move |(i, value)| (i, j, value)))
    }

    /// Returns the entries of a column of the lower triangle: row, value.
    pub(super) fn column(&self, j: usize) -> impl Iterator<Item = (usize, T)> {
        let at = self.pattern.values(j);
        let (rows, values) = (&self.pattern.rows[at.clone()], &self.values[at]);
        rows.iter().copied().zip(values.iter().cloned())
    }

    /// Returns the matrix of what `f` makes of each entry.
    pub fn map<U>(&self, f: impl Fn(&T) -> U) -> SparseSymmetric<U> {
        let values = self.values.iter().map(f).collect();
        SparseSymmetric { pattern: Arc::clone(&self.pattern), values }
    }

    /// Returns the values of the entries, column by column.
    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    /// Returns the pattern as faer takes it.
    pub(super) fn pattern(&self) -> SymbolicSparseColMatRef<'_, usize> {
        self.pattern.view()
    }
}

impl<T: Scalar> SparseSymmetric<T> {
    /// Returns the product with a vector.
    pub fn times(&self, x: &DVector<T>) -> DVector<T> {
        let mut product = DVector::from_element(x.len(), T::zero());
        for j in 0..self.size() {
            let (of_column, mut own) = (x[j], product[j]);
            for (i, value) in self.column(j) {
                if i == j {
                    own += value * of_column;
                } else {
                    product[i] += value * of_column;
                    own += value * x[i];
                }
            }
            product[j] = own;
        }
        product
    }

    /// Returns the entries of the diagonal.
    pub fn diagonal(&self) -> DVector<T> {
        let of_column = |j: usize| {
            let first = self.column(j).next();
            first.filter(|(i, _)| *i == j).map(|(_, value)| value)
        };
        DVector::from_fn(self.size(), |j, _| of_column(j).unwrap_or(T::zero()))
    }

    /// Returns the matrix with springs so soft that they show how a singular one moves.
    pub fn softly_held(&self) -> Self {
        /// The stiffness of a spring over that of its equation.
        const SOFT: f64 = 1e-10;
        self.clone().map_diagonal(|_, a| a * T::from_f64(1.0 + SOFT))
    }

    /// Returns the matrix with `f` of each row's diagonal entry.
    pub(super) fn map_diagonal(mut self, f: impl Fn(usize, T) -> T) -> Self {
        for j in 0..self.size() {
            let at = self.pattern.starts[j];
            if at < self.pattern.starts[j + 1] && self.pattern.rows[at] == j {
                self.values[at] = f(j, self.values[at]);
            }
        }
        self
    }

    /// Returns the largest row sum of |A|.
    pub fn norm(&self) -> f64 {
        let mut sums = vec![0.0_f64; self.size()];
        for j in 0..self.size() {
            for (i, value) in self.column(j) {
                let size = Scalar::abs(value).to_f64();
                sums[i] += size;
                if i != j {
                    sums[j] += size;
                }
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// Returns the relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of
    /// vectors, 0 when x and b are 0.
    pub fn residual(&self, x: &DVector<T>, b: &DVector<T>) -> f64 {
        backward_error(&(self.times(x) - b), self.norm(), x, b)
    }
}
