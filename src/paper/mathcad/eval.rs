//! The values of expressions.

use super::arithmetic::{calculate, compare, cost, kind, negative, operate, transpose};
use super::failure::{Cause, Fallible, Subscripts};
use super::observe::{Observer, Operand};
use super::settings::Conjunction;
use super::state::Run;
use super::syntax::{Expr, Kind, Operation, Reference, Span};
use super::value::{Array, Value};

impl<O: Observer> Run<'_, '_, O> {
    pub fn eval(&mut self, expr: &Expr) -> Fallible<Value> {
        match &expr.kind {
            Kind::Number(x) => Ok(Value::Number(*x)),
            Kind::Read(reference) => {
                let subscripts = self.subscripts(reference)?;
                self.read(reference, subscripts)
            }
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
            Kind::Call(name, arguments) => {
                let arguments = self.arguments(arguments)?;
                self.call(*name, &arguments, &expr.span)
            }
        }
    }

    pub fn number(&mut self, expr: &Expr) -> Fallible<f64> {
        match self.eval(expr)? {
            Value::Number(x) => Ok(x),
            other => Err(self.fail(&expr.span, kind("a number", &other))),
        }
    }

    /// Returns whether an expression is true: everything but 0 is.
    pub fn truth(&mut self, expr: &Expr) -> Fallible<bool> {
        Ok(self.number(expr)? != 0.0)
    }

    /// Returns the subscripts of a name, or nothing where it has none.
    pub fn subscripts(&mut self, reference: &Reference) -> Fallible<Option<Subscripts>> {
        let Some(row) = &reference.row else {
            return Ok(None);
        };
        let row = self.number(row)?;
        let col = reference.col.as_ref().map(|col| self.number(col)).transpose()?;
        Ok(Some(Subscripts { row, col }))
    }

    /// Returns the values of arguments; each counts as stored while the next is evaluated.
    fn arguments(&mut self, arguments: &[Expr]) -> Fallible<Vec<Value>> {
        let stored = self.stored;
        let values = arguments.iter().map(|argument| {
            let value = self.eval(argument)?;
            self.room(value.count())?;
            self.stored += value.count();
            Ok(value)
        });
        let values = values.collect();
        self.stored = stored;
        values
    }

    fn arithmetic(
        &mut self,
        operation: Operation,
        x: &Expr,
        y: &Expr,
        span: &Span,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        // The left operand counts as stored while the right one is evaluated.
        self.stored += x.count();
        let y = self.eval(y);
        self.stored -= x.count();
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
        x: &Expr,
        span: &Span,
        by: fn(Value) -> Result<Value, Cause>,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        self.afford(x.count())?;
        by(x).map_err(|cause| self.fail(span, cause))
    }

    fn row(&mut self, elements: &[Expr]) -> Fallible<Value> {
        let elements =
            elements.iter().map(|element| self.number(element)).collect::<Fallible<_>>()?;
        Ok(Array::row(elements).into())
    }

    /// Returns whether an `∧` is true, by the worksheet's method of evaluating it.
    fn all(&mut self, operands: &[Expr], span: &Span) -> Fallible<bool> {
        let method = self.settings.conjunction;
        let (mut all, mut failure, mut seen) = (true, None, vec![]);
        for operand in operands {
            if method == Conjunction::LeftToRight && !all {
                break;
            }
            let truth = match self.truth(operand) {
                Ok(truth) => Some(truth),
                Err(error) if method != Conjunction::Guarded || error.is_limit() => {
                    return Err(error);
                }
                Err(error) => {
                    failure.get_or_insert(error);
                    None
                }
            };
            all &= truth != Some(false);
            if O::ACTIVE {
                seen.push(truth);
            }
        }
        if O::ACTIVE {
            self.tell_conjunction(operands, &seen, span);
        }
        failure.filter(|_| all).map_or(Ok(all), Err)
    }

    fn tell_conjunction(&mut self, operands: &[Expr], seen: &[Option<bool>], span: &Span) {
        let seen = seen.iter().copied().chain(std::iter::repeat(None));
        let operand = |(x, held): (&Expr, _)| Operand { text: self.place(&x.span).text, held };
        let operands: Vec<_> = operands.iter().zip(seen).map(operand).collect();
        self.observer.conjunction(self.place(span), &operands);
    }
}

fn truth_value(truth: bool) -> Value {
    Value::Number(if truth { 1.0 } else { 0.0 })
}
