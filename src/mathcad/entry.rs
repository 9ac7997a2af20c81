//! Reading and writing names and the entries of arrays.

use std::rc::Rc;

use super::arithmetic::kind;
use super::failure::{Cause, Fallible, Subscripts};
use super::listing::Listing;
use super::observe::{Access, Observer};
use super::state::{Run, Variable};
use super::syntax::{Reference, Slot};
use super::value::{Array, Grid, Nested, Value};

impl<'r, O: Observer> Run<'r, '_, O> {
    /// Returns the value of a name or, with `subscripts`, of its entry.
    pub fn read(
        &mut self,
        reference: &Reference,
        subscripts: Option<Subscripts>,
    ) -> Fallible<Value> {
        let value = match (&self.cells[reference.name].value, subscripts) {
            (Some(value), None) => Ok(value.clone()),
            (Some(value), Some(subscripts)) => self.entry(reference.name, value, subscripts),
            // A local name without a value is 0.
            (None, None) if self.listing.assigned[reference.name] => Ok(Value::default()),
            (None, Some(_)) if self.listing.assigned[reference.name] => {
                Err(kind("an array", &Value::default()))
            }
            (None, _) => return Err(self.undefined(reference.name, false, &reference.span)),
        };
        let value = value.map_err(|cause| self.fail(&reference.span, cause))?;
        if O::ACTIVE {
            let subscripts = whole_subscripts(subscripts);
            self.observer.read(self.access(reference.name, &subscripts, &value));
        }
        Ok(value)
    }

    fn entry(&self, name: Slot, value: &Value, subscripts: Subscripts) -> Result<Value, Cause> {
        let name = || self.listing.names.name(name).into();
        entry_of(value, subscripts, self.settings.origin, &name)
    }

    /// Writes `value` to a name.
    pub fn store(&mut self, slot: Slot, value: Value) -> Fallible<()> {
        self.stored -= self.cells[slot].value.as_ref().map_or(0, Value::count);
        self.room(value.count())?;
        self.stored += value.count();
        if O::ACTIVE {
            self.observer.write(self.access(slot, &[], &value));
        }
        self.cells[slot] = Variable { value: Some(value), local: true };
        Ok(())
    }

    /// Writes a value to an entry, and makes the array larger where it does not reach so far. By a
    /// value that is no number an array of numbers becomes one of arrays.
    pub fn write(
        &mut self,
        target: &Reference,
        subscripts: Subscripts,
        value: Value,
    ) -> Fallible<()> {
        self.check_nesting(value.depth())?;
        let name = || self.listing.names.name(target.name).into();
        let (i, j) = offsets(subscripts, self.settings.origin, &name)
            .map_err(|cause| self.fail(&target.span, cause))?;
        self.prepare(target, subscripts, (i, j), value.count())?;
        let cell = &mut self.cells[target.name];
        cell.local = true;
        if let (Some(Value::Array(array)), Value::Number(x)) = (&mut cell.value, &value) {
            let array = Rc::make_mut(array);
            if array.get(i, j).is_none() {
                array.grow(i, j);
            }
            array.set(i, j, *x);
        } else {
            self.write_nested(target.name, i, j, value.clone());
        }
        if O::ACTIVE {
            let subscripts = whole_subscripts(Some(subscripts));
            self.observer.write(self.access(target.name, &subscripts, &value));
        }
        Ok(())
    }

    /// Writes to an entry that was prepared, of an array that is or becomes one of arrays.
    fn write_nested(&mut self, slot: Slot, i: usize, j: usize, value: Value) {
        let cell = &mut self.cells[slot].value;
        if let Some(Value::Array(array)) = cell {
            let entry = |i, j| Value::Number(array.entries()[i * array.cols() + j]);
            let grid = Grid::from_fn(array.rows(), array.cols(), entry);
            *cell = Some(Value::Nested(Rc::new(Nested::new(grid))));
        }
        if let Some(Value::Nested(nested)) = cell {
            let nested = Rc::make_mut(nested);
            self.stored -= nested.count() + nested.grid().missing(i, j);
            nested.write(i, j, value);
            self.stored += nested.count();
        }
    }

    /// Checks that an entry can be written, of `count` numbers. A name that holds no array becomes
    /// an empty one.
    fn prepare(
        &mut self,
        target: &Reference,
        subscripts: Subscripts,
        (i, j): (usize, usize),
        count: usize,
    ) -> Fallible<()> {
        let cell = &mut self.cells[target.name].value;
        let value = cell.get_or_insert_with(|| Array::default().into());
        if let Value::Number(_) | Value::Text(_) = value {
            self.stored -= value.count();
            *value = Array::default().into();
        }
        let (rows, cols) = value.size();
        if subscripts.col.is_none() && cols > 1 {
            let name = self.listing.names.name(target.name).into();
            let cause = Cause::IndexOutside { name, subscripts, rows, cols };
            return Err(self.fail(&target.span, cause));
        }
        let (more, shared) = match value {
            Value::Array(array) => (array.missing(i, j), Rc::strong_count(array) > 1),
            Value::Nested(nested) => (nested.grid().missing(i, j), true),
            _ => unreachable!("no array but these"),
        };
        let held = rows * cols;
        let copied = if shared { held } else { 0 };
        let moved = if more > 0 && j >= cols { held } else { 0 };
        self.room(more.saturating_add(count - 1))?;
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

fn whole_subscripts(subscripts: Option<Subscripts>) -> Vec<i64> {
    let numbers = subscripts.into_iter().flat_map(|s| [Some(s.row), s.col]);
    numbers.flatten().map(|x| x as i64).collect()
}

/// Returns the entry of a value, which messages call `name`.
pub fn entry_of(
    value: &Value,
    subscripts: Subscripts,
    origin: i32,
    name: &dyn Fn() -> String,
) -> Result<Value, Cause> {
    let (i, j) = offsets(subscripts, origin, name)?;
    let both = subscripts.col.is_some();
    let entry = match value {
        Value::Array(a) if both || a.cols() == 1 => a.get(i, j).map(|x| Value::Number(*x)),
        Value::Nested(v) if both || v.grid().cols() == 1 => v.grid().get(i, j).cloned(),
        Value::Array(_) | Value::Nested(_) => None,
        other => return Err(kind("an array", other)),
    };
    let (rows, cols) = value.size();
    entry.ok_or_else(|| Cause::IndexOutside { name: name(), subscripts, rows, cols })
}

/// Returns row and column from 0; the column of a lone subscript is the first.
pub fn offsets(
    subscripts: Subscripts,
    origin: i32,
    name: &dyn Fn() -> String,
) -> Result<(usize, usize), Cause> {
    let offset = |x: f64| {
        let whole = x as i64;
        if whole as f64 == x && whole >= i64::from(origin) {
            Ok((whole - i64::from(origin)) as usize)
        } else if x.fract() != 0.0 {
            Err(Cause::IndexNotWhole { name: name(), subscripts })
        } else if x < f64::from(origin) {
            Err(Cause::IndexBelowOrigin { name: name(), subscripts, origin })
        } else {
            Ok((x - f64::from(origin)) as usize)
        }
    };
    Ok((offset(subscripts.row)?, subscripts.col.map_or(Ok(0), offset)?))
}

/// Returns the place from 0 that a lone subscript names.
pub fn offset(x: f64, origin: i32, name: &dyn Fn() -> String) -> Result<usize, Cause> {
    offsets(Subscripts { row: x, col: None }, origin, name).map(|(i, _)| i)
}
