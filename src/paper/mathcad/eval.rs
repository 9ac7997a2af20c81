//! Evaluating expressions, reading entries and writing them.

use std::rc::Rc;

use super::arithmetic::{calculate, compare, cost, kind, negative, operate, transpose};
use super::failure::{Cause, Failure, Subscripts};
use super::observe::{Observer, Operand};
use super::run::{Fallible, Run};
use super::settings::Conjunction;
use super::syntax::{Expr, Kind, Operation, Reference, Span};
use super::value::{Array, Value};

impl<'r, O: Observer> Run<'r, '_, O> {
    /// The value of an expression.
    pub(super) fn eval(&mut self, expr: &'r Expr) -> Fallible<Value> {
        match &expr.kind {
            Kind::Number(x) => Ok(Value::Number(*x)),
            Kind::Read(reference) => self.read(reference),
            Kind::Group(x) => self.eval(x),
            Kind::Row(elements) => self.row(elements),
            Kind::Magnitude(x) => Ok(Value::Number(self.number(x)?.abs())),
            Kind::Negative(x) => self.change(x, &expr.span, negative),
            Kind::Transpose(x) => self.change(x, &expr.span, transpose),
            Kind::Arithmetic(operation, x, y) => self.arithmetic(*operation, x, y, &expr.span),
            Kind::Compare(comparison, x, y) => {
                let (x, y) = (self.number(x)?, self.number(y)?);
                Ok(truth_value(compare(*comparison, x, y, self.settings)))
            }
            Kind::All(operands) => Ok(truth_value(self.all(operands, &expr.span)?)),
            Kind::Call(name, arguments) => self.call(*name, arguments, &expr.span),
        }
    }

    /// The value of an expression that must be a number.
    pub(super) fn number(&mut self, expr: &'r Expr) -> Fallible<f64> {
        match self.eval(expr)? {
            Value::Number(x) => Ok(x),
            other => Err(self.fail(&expr.span, kind("a number", &other))),
        }
    }

    /// Whether an expression holds: whether it is not 0.
    pub(super) fn truth(&mut self, expr: &'r Expr) -> Fallible<bool> {
        Ok(self.number(expr)? != 0.0)
    }

    fn arithmetic(
        &mut self,
        operation: Operation,
        x: &'r Expr,
        y: &'r Expr,
        span: &Span,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        // The left operand counts as held while the right one is evaluated.
        self.held += x.len();
        let y = self.eval(y);
        self.held -= x.len();
        let y = y?;
        let result = if let (Value::Number(x), Value::Number(y)) = (&x, &y) {
            calculate(operation, *x, *y, self.settings).map(Value::Number)
        } else {
            let (steps, entries) = cost(operation, &x, &y);
            self.room(entries)?;
            self.spend(steps)?;
            operate(operation, x, y, self.settings)
        };
        result.map_err(|cause| self.fail(span, cause))
    }

    fn change(
        &mut self,
        x: &'r Expr,
        span: &Span,
        by: fn(Value) -> Result<Value, Cause>,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        self.afford(x.len())?;
        by(x).map_err(|cause| self.fail(span, cause))
    }

    fn row(&mut self, elements: &'r [Expr]) -> Fallible<Value> {
        let elements =
            elements.iter().map(|element| self.number(element)).collect::<Fallible<_>>()?;
        Ok(Array::row(elements).into())
    }

    /// An `∧`, under the worksheet's way of evaluating it.
    fn all(&mut self, operands: &'r [Expr], span: &Span) -> Fallible<bool> {
        let way = self.settings.conjunction;
        let (mut all, mut failure, mut seen) = (true, None, vec![]);
        for operand in operands {
            if way == Conjunction::LeftToRight && !all {
                break;
            }
            let held = match self.truth(operand) {
                Ok(held) => Some(held),
                Err(error) if way != Conjunction::Guarded || error.is_limit() => return Err(error),
                Err(error) => {
                    failure.get_or_insert(error);
                    None
                }
            };
            all &= held != Some(false);
            if O::ACTIVE {
                seen.push(held);
            }
        }
        if O::ACTIVE {
            self.tell_conjunction(operands, &seen, span);
        }
        failure.filter(|_| all).map_or(Ok(all), Err)
    }

    fn tell_conjunction(&mut self, operands: &'r [Expr], seen: &[Option<bool>], span: &Span) {
        let seen = seen.iter().copied().chain(std::iter::repeat(None));
        let operand = |(x, held): (&Expr, _)| Operand { text: self.place(&x.span).text, held };
        let operands: Vec<_> = operands.iter().zip(seen).map(operand).collect();
        self.observer.conjunction(self.place(span), &operands);
    }

    /// The value of a name or entry.
    fn read(&mut self, reference: &'r Reference) -> Fallible<Value> {
        let subscripts = self.subscripts(reference)?;
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
        Cause::IndexOutside {
            name: self.listing.names.name(reference.name).into(),
            subscripts,
            rows,
            cols,
        }
    }

    fn subscripts(&mut self, reference: &'r Reference) -> Fallible<Option<Subscripts>> {
        let Some(row) = &reference.row else {
            return Ok(None);
        };
        let row = self.number(row)?;
        let col = reference.col.as_ref().map(|col| self.number(col)).transpose()?;
        Ok(Some(Subscripts { row, col }))
    }

    /// Row and column from 0; the column of a lone subscript is the first.
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

    /// Writes a value to a name or entry. The value of the statement is what was written.
    pub(super) fn assign(&mut self, target: &'r Reference, value: Value) -> Fallible<()> {
        // Lets go of an array first: shared with the value of the last statement, it would be copied.
        self.last = None;
        match (self.subscripts(target)?, &value) {
            (None, _) => self.store(target.name, value.clone())?,
            (Some(subscripts), Value::Number(x)) => self.write(target, subscripts, *x)?,
            (Some(_), other) => {
                return Err(self.fail(&target.span, kind("a number for an entry", other)));
            }
        }
        self.last = Some(value);
        Ok(())
    }

    fn write(&mut self, target: &'r Reference, subscripts: Subscripts, x: f64) -> Fallible<()> {
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

    /// Sees to it that the entry can be written: that there is an array, and that it may grow so far.
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
        self.held += more;
        self.spend((copied + moved + more) as u64)
    }

    /// Takes a step for each number of a new value, if there is room for them.
    pub(super) fn afford(&mut self, entries: usize) -> Fallible<()> {
        self.room(entries)?;
        self.spend(entries as u64)
    }
}

fn truth_value(held: bool) -> Value {
    Value::Number(if held { 1.0 } else { 0.0 })
}

/// Subscripts as whole numbers, and how many there are.
fn whole_subscripts(subscripts: Option<Subscripts>) -> ([i64; 2], usize) {
    match subscripts {
        None => ([0, 0], 0),
        Some(Subscripts { row, col: None }) => ([row as i64, 0], 1),
        Some(Subscripts { row, col: Some(col) }) => ([row as i64, col as i64], 2),
    }
}

impl Failure {
    /// Whether a limit was reached: no way of evaluating `∧` passes over that.
    fn is_limit(&self) -> bool {
        matches!(self.cause, Cause::Limit { .. })
    }
}
