//! The values of a listing: numbers, arrays, arrays of arrays and strings.

use std::fmt;
use std::rc::Rc;

use super::array::{Column, Table};
use super::failure::Cause;
use numbers::scalar::Scalar;
use numbers::square::SparseSquare;

/// A value of a listing. Copying one is cheap: arrays are shared until a copy is written to.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A real number.
    Number(f64),
    /// An array of one column or several, shared until it is written.
    Array(Rc<Array>),
    /// An array with entries that are arrays or strings, such as the element matrices `B`.
    Nested(Rc<Nested>),
    /// A string, such as `trace` returns.
    Text(Rc<str>),
}

/// A matrix, a column when `cols` is 1. Its entries stand row by row in blocks, each shared until it is
/// written to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid<T> {
    rows: usize,
    cols: usize,
    /// Every block but the last has [`BLOCK`] entries, and none is empty.
    blocks: Vec<Rc<Vec<T>>>,
}

/// The entries of a block. Each iteration writes some thousand entries to a copy of a stiffness matrix of 5
/// million: `audit strand --prices` takes 24 s of CPU time in place of the 31 s of whole copies.
const BLOCK: usize = 512;

/// A matrix of numbers.
pub type Array = Grid<f64>;

impl<T: Clone + Default> Grid<T> {
    /// Makes the array whose entry in row `i` and column `j`, from 0, is `entry(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> T) -> Self {
        let mut entries = Vec::with_capacity(rows * cols);
        (0..rows).for_each(|i| entries.extend((0..cols).map(|j| entry(i, j))));
        Grid { rows, cols, blocks: blocks(entries) }
    }

    /// Makes a grid of one column.
    pub fn column(entries: Vec<T>) -> Self {
        Grid { rows: entries.len(), cols: 1, blocks: blocks(entries) }
    }

    /// Makes an array of `cols` columns, at least one, from its entries row by row.
    pub fn from_rows(cols: usize, entries: Vec<T>) -> Self {
        Grid { rows: entries.len() / cols, cols, blocks: blocks(entries) }
    }

    /// Returns the numbers of rows and columns.
    pub fn size(&self) -> (usize, usize) {
        (self.rows, self.cols)
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Returns the number of entries.
    pub fn count(&self) -> usize {
        self.rows * self.cols
    }

    /// Returns the entries row by row.
    pub fn entries(&self) -> impl Iterator<Item = &T> {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// Returns the entries row by row, to be changed in place.
    pub fn entries_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.blocks.iter_mut().flat_map(|block| Rc::make_mut(block).iter_mut())
    }

    /// Returns the entry in row `i` and column `j`, from 0, if there is one.
    pub fn get(&self, i: usize, j: usize) -> Option<&T> {
        (i < self.rows && j < self.cols).then(|| self.at(i, j))
    }

    /// Returns the entry in row `i` and column `j`, from 0, which is there.
    pub fn at(&self, i: usize, j: usize) -> &T {
        let k = i * self.cols + j;
        &self.blocks[k / BLOCK][k % BLOCK]
    }

    /// Writes an entry, and makes the array larger where it does not reach so far; returns the old one.
    pub fn write(&mut self, i: usize, j: usize, value: T) -> T {
        if self.get(i, j).is_none() {
            self.grow(i, j);
        }
        let k = i * self.cols + j;
        std::mem::replace(&mut Rc::make_mut(&mut self.blocks[k / BLOCK])[k % BLOCK], value)
    }

    /// Returns how many entries [`Grid::write`] would add.
    pub fn missing(&self, i: usize, j: usize) -> usize {
        if i < self.rows && j < self.cols {
            return 0;
        }
        let (rows, cols) = (self.rows.max(i.saturating_add(1)), self.cols.max(j.saturating_add(1)));
        rows.saturating_mul(cols) - self.count()
    }

    /// Makes room for row `i` and column `j`, from 0; new entries are 0.
    fn grow(&mut self, i: usize, j: usize) {
        let (rows, cols) = (self.rows.max(i + 1), self.cols.max(j + 1));
        if cols != self.cols {
            let entry = |i, j| self.get(i, j).cloned().unwrap_or_default();
            *self = Grid::from_fn(self.rows, cols, entry);
        }
        let mut missing = (rows - self.rows) * cols;
        if let Some(last) = self.blocks.last_mut().filter(|last| last.len() < BLOCK) {
            let more = missing.min(BLOCK - last.len());
            let long = last.len() + more;
            Rc::make_mut(last).resize(long, T::default());
            missing -= more;
        }
        self.blocks.extend(blocks(vec![T::default(); missing]));
        self.rows = rows;
    }

    /// Makes a row a column, or a column a row.
    pub fn turn(&mut self) {
        std::mem::swap(&mut self.rows, &mut self.cols);
    }

    /// Returns the array with rows and columns exchanged.
    pub fn transposed(&self) -> Self {
        Grid::from_fn(self.cols, self.rows, |i, j| self.at(j, i).clone())
    }
}

impl Array {
    /// Takes the entries of a square array, zeros left out.
    pub fn sparse(&self) -> SparseSquare {
        /// So many entries are compared at once: of the CPU time of `audit strand` 2.2 s in place of 3.0 go
        /// into this.
        const AT_ONCE: usize = 16;
        assert_eq!(self.rows(), self.cols(), "a square array");
        let mut matrix = SparseSquare::zeros(self.rows());
        // The block that was zeros last: where one is shared, it is read once.
        let mut zeros: Option<&Rc<Vec<f64>>> = None;
        let is_filled = |part: &[f64]| part.iter().fold(false, |any, x| any | (*x != 0.0));
        let filled = self.blocks.iter().enumerate().filter(|(_, block)| {
            let is_read = !zeros.is_some_and(|zeros| Rc::ptr_eq(zeros, block)) && is_filled(block);
            zeros = if is_read { zeros } else { Some(block) };
            is_read
        });
        let parts =
            filled.flat_map(|(k, block)| (k * BLOCK..).step_by(AT_ONCE).zip(block.chunks(AT_ONCE)));
        let parts = parts.filter(|(_, part)| is_filled(part));
        let entries = parts.flat_map(|(k, part)| (k..).zip(part.iter().copied()));
        for (k, value) in entries.filter(|(_, x)| *x != 0.0) {
            matrix[(k / self.cols, k % self.cols)] = value;
        }
        matrix
    }

    /// Lets all blocks of zeros be one, which is read once for all: of the 10,621 of the matrix of `audit strand` 6,049 are.
    pub fn share_zeros(&mut self) {
        let is_zero = |block: &&mut Rc<Vec<f64>>| {
            block.len() == BLOCK && block.iter().all(|x| x.to_bits() == 0)
        };
        let zeros = Rc::new(vec![0.0; BLOCK]);
        self.blocks.iter_mut().filter(is_zero).for_each(|block| *block = Rc::clone(&zeros));
    }
}

fn blocks<T: Clone>(entries: Vec<T>) -> Vec<Rc<Vec<T>>> {
    match entries.len() {
        1..=BLOCK => vec![Rc::new(entries)],
        _ => entries.chunks(BLOCK).map(|block| Rc::new(block.to_vec())).collect(),
    }
}

/// An array of values, with what it stores and how deep it goes, counted as it is written to:
/// arrays that hold one another many times over would take too long to count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nested {
    grid: Grid<Value>,
    count: usize,
    depth: usize,
}

impl Nested {
    /// Makes an array of a grid of values.
    pub fn new(grid: Grid<Value>) -> Self {
        let count = grid.entries().map(Value::count).sum();
        let depth = 1 + grid.entries().map(Value::depth).max().unwrap_or(0);
        Nested { grid, count, depth }
    }

    /// Returns the entries by row and column.
    pub fn grid(&self) -> &Grid<Value> {
        &self.grid
    }

    /// Returns how many numbers all its entries store.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Writes an entry, and makes the array larger where it does not reach so far.
    pub fn write(&mut self, i: usize, j: usize, value: Value) {
        self.count += self.grid.missing(i, j);
        self.depth = self.depth.max(1 + value.depth());
        let new = value.count();
        let old = self.grid.write(i, j, value);
        self.count = self.count + new - old.count();
    }
}

impl Default for Value {
    fn default() -> Self {
        Value::Number(0.0)
    }
}

impl Value {
    /// Returns how many numbers the value stores, eight bytes of text counting as one.
    pub fn count(&self) -> usize {
        match self {
            Value::Number(_) => 1,
            Value::Array(a) => a.count(),
            Value::Nested(v) => v.count,
            Value::Text(t) => t.len() / size_of::<f64>() + 1,
        }
    }

    /// Returns how deep arrays stand within each other.
    pub fn depth(&self) -> usize {
        match self {
            Value::Nested(v) => v.depth,
            Value::Number(_) | Value::Array(_) | Value::Text(_) => 0,
        }
    }

    /// Returns the numbers of rows and columns.
    pub fn size(&self) -> (usize, usize) {
        match self {
            Value::Array(a) => a.size(),
            Value::Nested(v) => v.grid.size(),
            Value::Number(_) | Value::Text(_) => (1, 1),
        }
    }

    /// Returns the entry in row `i` and column `j`, from 0, of an array that has it.
    pub fn entry(&self, i: usize, j: usize) -> Option<Value> {
        match self {
            Value::Array(a) => a.get(i, j).copied().map(Value::Number),
            Value::Nested(v) => v.grid.get(i, j).cloned(),
            Value::Number(_) | Value::Text(_) => None,
        }
    }

    /// Writes an entry of an array, and makes it larger where it does not reach so far. By a value that is no
    /// number an array of numbers becomes one of arrays.
    pub fn write(&mut self, i: usize, j: usize, value: Value) {
        match (self, value) {
            (Value::Array(array), Value::Number(x)) => drop(Rc::make_mut(array).write(i, j, x)),
            (Value::Nested(nested), value) => Rc::make_mut(nested).write(i, j, value),
            (held @ Value::Array(_), value) => {
                let (rows, cols) = held.size();
                let entry = |i, j| held.entry(i, j).unwrap_or_default();
                let mut nested = Nested::new(Grid::from_fn(rows, cols, entry));
                nested.write(i, j, value);
                *held = Value::Nested(Rc::new(nested));
            }
            (Value::Number(_) | Value::Text(_), _) => unreachable!("no array"),
        }
    }

    /// Returns the number; None of an array or a string.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(x) => Some(*x),
            Value::Array(_) | Value::Nested(_) | Value::Text(_) => None,
        }
    }

    /// Returns what it is, in words for a message.
    pub fn kind(&self) -> String {
        match self {
            Value::Number(x) => format!("the number {x}"),
            Value::Array(a) => format!("a {} x {} array", a.rows, a.cols),
            Value::Nested(v) if v.grid.cols == 1 => format!("a column of {} arrays", v.grid.rows),
            Value::Nested(v) => format!("a {} x {} array of arrays", v.grid.rows, v.grid.cols),
            Value::Text(_) => "a string".into(),
        }
    }

    /// Makes an array of entries: of numbers, if all are numbers.
    pub fn grid(grid: Grid<Value>) -> Self {
        match grid.entries().map(Value::number).collect() {
            Some(entries) => {
                Array { rows: grid.rows, cols: grid.cols, blocks: blocks(entries) }.into()
            }
            None => Value::Nested(Rc::new(Nested::new(grid))),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(x) => write!(f, "{x}"),
            Value::Text(t) => f.write_str(t),
            Value::Nested(_) => f.write_str(&self.kind()),
            Value::Array(a) => {
                for i in 0..a.rows {
                    let row: Vec<_> = (0..a.cols).map(|j| a.at(i, j).to_string()).collect();
                    write!(f, "{}{}", if i == 0 { "" } else { "; " }, row.join(" "))?;
                }
                Ok(())
            }
        }
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Value::Number(x)
    }
}

impl From<usize> for Value {
    fn from(n: usize) -> Self {
        Value::Number(n as f64)
    }
}

impl From<Array> for Value {
    fn from(a: Array) -> Self {
        Value::Array(Rc::new(a))
    }
}

impl From<&Table<f64>> for Value {
    fn from(table: &Table<f64>) -> Self {
        let m = table.as_matrix();
        Array::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)].to_f64()).into()
    }
}

impl From<&Table<usize>> for Value {
    fn from(table: &Table<usize>) -> Self {
        Value::from(&table.map(|n| n as f64))
    }
}

impl From<&Column<f64>> for Value {
    fn from(column: &Column<f64>) -> Self {
        Array::column(column.iter().map(|x| x.to_f64()).collect()).into()
    }
}

impl From<&Column<usize>> for Value {
    fn from(column: &Column<usize>) -> Self {
        Value::from(&column.map(|n| n as f64))
    }
}

impl FromIterator<Value> for Value {
    fn from_iter<I: IntoIterator<Item = Value>>(values: I) -> Self {
        let column = Grid::column(values.into_iter().collect());
        Value::Nested(Rc::new(Nested::new(column)))
    }
}

impl<T: Scalar> TryFrom<&Value> for Table<T> {
    type Error = Cause;
    fn try_from(value: &Value) -> Result<Self, Cause> {
        let Value::Array(a) = value else {
            return Err(Cause::Kind { expected: "an array", found: value.kind() });
        };
        Ok(Table::from_fn(a.rows, a.cols, |i, j| T::from_f64(*a.at(i - 1, j - 1))))
    }
}

impl<T: Scalar> TryFrom<&Value> for Column<T> {
    type Error = Cause;
    fn try_from(value: &Value) -> Result<Self, Cause> {
        match value {
            Value::Array(a) if a.cols == 1 => {
                Ok(Column::from_vec(a.entries().map(|&x| T::from_f64(x)).collect()))
            }
            _ => Err(Cause::Kind { expected: "a column", found: value.kind() }),
        }
    }
}
