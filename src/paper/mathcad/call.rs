//! Calling a function on the values of its arguments.

use super::arithmetic::{fold, identity, kind};
use super::failure::{Cause, Fallible};
use super::function::Function;
use super::state::Run;
use super::syntax::{Slot, Span};
use super::value::Value;
use crate::numbers::scalar::Scalar;

impl<O> Run<'_, '_, O> {
    /// Returns the value of the function that the name `slot` stands for.
    pub fn call(&mut self, slot: Slot, arguments: &[Value], span: &Span) -> Fallible<Value> {
        match &mut self.functions[slot] {
            None => Err(self.undefined(slot, span)),
            Some(Function::Identity) => self.identity(arguments, span),
            Some(Function::Rows) => rows(arguments).map_err(|cause| self.fail(span, cause)),
            Some(Function::Min) => self.extreme(arguments, <f64 as Scalar>::min, span),
            Some(Function::Max) => self.extreme(arguments, <f64 as Scalar>::max, span),
            Some(Function::Trace) => self.write_trace(arguments),
            Some(Function::Outside(function)) => function(arguments).map_err(|message| {
                let name = self.listing.names.name(slot).into();
                self.fail(span, Cause::Function { name, message })
            }),
        }
    }

    fn identity(&mut self, arguments: &[Value], span: &Span) -> Fallible<Value> {
        let n = one(arguments).and_then(whole).map_err(|cause| self.fail(span, cause))?;
        self.afford(n.saturating_mul(n))?;
        Ok(identity(n))
    }

    fn extreme(
        &mut self,
        arguments: &[Value],
        choose: fn(f64, f64) -> f64,
        span: &Span,
    ) -> Fallible<Value> {
        self.spend(size(arguments) as u64)?;
        fold(arguments, choose).map_err(|cause| self.fail(span, cause))
    }

    fn write_trace(&mut self, arguments: &[Value]) -> Fallible<Value> {
        // A number of 17 digits and its exponent fill three times the eight bytes of a number.
        self.afford(size(arguments).saturating_mul(4))?;
        let line = arguments.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
        let value = Value::Text(line.as_str().into());
        self.stored += value.count();
        self.trace.push(line);
        Ok(value)
    }
}

fn size(values: &[Value]) -> usize {
    values.iter().map(Value::count).sum()
}

fn one(arguments: &[Value]) -> Result<&Value, Cause> {
    match arguments {
        [argument] => Ok(argument),
        _ => Err(Cause::Arguments { expected: 1, found: arguments.len() }),
    }
}

fn whole(value: &Value) -> Result<usize, Cause> {
    match value {
        Value::Number(n) if *n >= 0.0 && n.fract() == 0.0 => Ok(*n as usize),
        _ => Err(kind("a whole number", value)),
    }
}

fn rows(arguments: &[Value]) -> Result<Value, Cause> {
    match one(arguments)? {
        Value::Array(a) => Ok(a.rows().into()),
        Value::Nested(v) => Ok(v.len().into()),
        other => Err(kind("an array", other)),
    }
}
