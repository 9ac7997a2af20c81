//! Reading and writing names and the entries of arrays.

use std::rc::Rc;

use super::arithmetic::kind;
use super::failure::{Cause, Fallible, Subscripts};
use super::listing::Listing;
use super::observe::{Access, Observer};
use super::state::{Cell, Run};
use super::syntax::{Reference, Slot};
use super::value::{Array, Value};

impl<'r, O: Observer> Run<'r, '_, O> {
    /// Returns the value of a name or, with `subscripts`, of its entry.
    pub fn read(
        &mut self,
        reference: &Reference,
        subscripts: Option<Subscripts>,
    ) -> Fallible<Value> {
        let value = match (&self.cells[reference.name].value, subscripts) {
            (None, _) => return Err(self.undefined(reference.name, &reference.span)),
            (Some(value), None) => Ok(value.clone()),
            (Some(value), Some(subscripts)) => self.entry(reference, value, subscripts),
        };
        let value = value.map_err(|cause| self.fail(&reference.span, cause))?;
        if O::ACTIVE {
            let (whole, count) = whole_subscripts(subscripts);
            self.observer.read(self.access(reference.name, &whole[..count], &value));
        }
        Ok(value)
    }

    fn entry(
        &self,
        reference: &Reference,
        value: &Value,
        subscripts: Subscripts,
    ) -> Result<Value, Cause> {
        let (i, j) = self.offsets(reference, subscripts)?;
        let entry = match value {
            Value::Array(a) if a.cols() == 1 || subscripts.col.is_some() => {
                a.get(i, j).map(Value::Number)
            }
            Value::Nested(v) if j == 0 => v.get(i).cloned(),
            Value::Array(_) | Value::Nested(_) => None,
            other => return Err(kind("an array", other)),
        };
        entry.ok_or_else(|| self.outside(reference, subscripts, value.size()))
    }

    fn outside(
        &self,
        reference: &Reference,
        subscripts: Subscripts,
        (rows, cols): (usize, usize),
    ) -> Cause {
        let name = self.listing.names.name(reference.name).into();
        Cause::IndexOutside { name, subscripts, rows, cols }
    }

    /// Returns row and column from 0; the column of a lone subscript is the first.
    fn offsets(
        &self,
        reference: &Reference,
        subscripts: Subscripts,
    ) -> Result<(usize, usize), Cause> {
        let origin = self.settings.origin;
        let offset = |x: f64| {
            let name = || self.listing.names.name(reference.name).into();
            if x.fract() != 0.0 {
                Err(Cause::IndexNotWhole { name: name(), subscripts })
            } else if x < f64::from(origin) {
                Err(Cause::IndexBelowOrigin { name: name(), subscripts, origin })
            } else {
                Ok((x - f64::from(origin)) as usize)
            }
        };
        Ok((offset(subscripts.row)?, subscripts.col.map_or(Ok(0), offset)?))
    }

    /// Writes `value` to a name.
    pub fn store(&mut self, slot: Slot, value: Value) -> Fallible<()> {
        self.stored -= self.cells[slot].value.as_ref().map_or(0, Value::count);
        self.room(value.count())?;
        self.stored += value.count();
        if O::ACTIVE {
            self.observer.write(self.access(slot, &[], &value));
        }
        self.cells[slot] = Cell { value: Some(value), local: true };
        Ok(())
    }

    /// Writes `x` to an entry, and makes the array larger where it does not reach so far.
    pub fn write(&mut self, target: &Reference, subscripts: Subscripts, x: f64) -> Fallible<()> {
        let (i, j) =
            self.offsets(target, subscripts).map_err(|cause| self.fail(&target.span, cause))?;
        self.prepare(target, subscripts, i, j)?;
        let cell = &mut self.cells[target.name];
        cell.local = true;
        if let Some(Value::Array(array)) = &mut cell.value {
            let array = Rc::make_mut(array);
            if i >= array.rows() || j >= array.cols() {
                array.grow(i, j);
            }
            array.set(i, j, x);
        }
        if O::ACTIVE {
            let (whole, count) = whole_subscripts(Some(subscripts));
            self.observer.write(self.access(target.name, &whole[..count], &Value::Number(x)));
        }
        Ok(())
    }

    /// Checks that the entry can be written: that there is an array, and that it may grow so far.
    fn prepare(
        &mut self,
        target: &Reference,
        subscripts: Subscripts,
        i: usize,
        j: usize,
    ) -> Fallible<()> {
        let value = self.cells[target.name].value.get_or_insert_with(|| Array::default().into());
        let Value::Array(array) = value else {
            let cause = kind("an array", value);
            return Err(self.fail(&target.span, cause));
        };
        if subscripts.col.is_none() && array.cols() > 1 {
            let size = (array.rows(), array.cols());
            let cause = self.outside(target, subscripts, size);
            return Err(self.fail(&target.span, cause));
        }
        let copied = if Rc::strong_count(array) > 1 { array.entries().len() } else { 0 };
        let more = array.missing(i, j);
        let moved = if more > 0 && j >= array.cols() { array.entries().len() } else { 0 };
        self.room(more)?;
        self.stored += more;
        self.spend((copied + moved + more) as u64)
    }

    fn access<'a>(&self, slot: Slot, subscripts: &'a [i64], value: &'a Value) -> Access<'a>
    where
        'r: 'a,
    {
        let Listing { lines, names, .. } = self.listing;
        Access { line: &lines[self.line], name: names.name(slot), subscripts, value }
    }
}

fn whole_subscripts(subscripts: Option<Subscripts>) -> ([i64; 2], usize) {
    match subscripts {
        None => ([0, 0], 0),
        Some(Subscripts { row, col: None }) => ([row as i64, 0], 1),
        Some(Subscripts { row, col: Some(col) }) => ([row as i64, col as i64], 2),
    }
}
