//! Running a listing: the worksheet around it, and its statements.

use std::collections::BTreeMap;

use super::arithmetic::kind;
use super::failure::{Cause, Fallible};
use super::function::Function;
use super::listing::Listing;
use super::observe::Observer;
use super::settings::{Limits, Settings};
use super::state::{Cell, Run};
use super::syntax::{Expr, Reference, Slot, Statement, Step};
use super::value::Value;

/// A listing in a worksheet: what is defined above it, and the settings.
pub struct Runner<'l> {
    listing: &'l Listing,
    settings: Settings,
    limits: Limits,
    values: Vec<Option<Value>>,
    functions: Vec<Option<Function<'l>>>,
}

/// What a run leaves behind.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The program's value: that of the last statement evaluated.
    pub value: Value,
    /// The names that the program wrote to, with their last values.
    pub locals: BTreeMap<String, Value>,
    /// What `trace` was given, a line for each call.
    pub trace_output: Vec<String>,
}

impl Listing {
    /// Returns a worksheet for the listing, in which only Mathcad's own functions are defined.
    pub fn runner(&self, settings: &Settings, limits: &Limits) -> Runner<'_> {
        Runner {
            listing: self,
            settings: settings.clone(),
            limits: limits.clone(),
            values: vec![None; self.names.len()],
            functions: self.names.all().map(Function::builtin).collect(),
        }
    }
}

impl<'l> Runner<'l> {
    /// Defines a name above the listing. A name that the listing does not use is passed over.
    pub fn define(&mut self, name: &str, value: impl Into<Value>) -> &mut Self {
        if let Some(slot) = self.listing.names.find(name) {
            self.values[slot] = Some(value.into());
        }
        self
    }

    /// Defines a function above the listing; it replaces a built-in one of that name.
    pub fn define_function(
        &mut self,
        name: &str,
        function: impl FnMut(&[Value]) -> Result<Value, String> + 'l,
    ) -> &mut Self {
        if let Some(slot) = self.listing.names.find(name) {
            self.functions[slot] = Some(Function::Outside(Box::new(function)));
        }
        self
    }

    /// Calls the listing's function.
    pub fn call(&mut self, arguments: &[Value]) -> Fallible<Outcome> {
        self.call_observed(arguments, &mut ())
    }

    /// Calls the listing's function under the eyes of an observer.
    /// Errors: returns the failure that stopped the program; the observer has then seen all that
    /// came before.
    pub fn call_observed<O: Observer>(
        &mut self,
        arguments: &[Value],
        observer: &mut O,
    ) -> Fallible<Outcome> {
        let Runner { listing, settings, limits, values, functions } = self;
        let cell = |value: &Option<Value>| Cell { value: value.clone(), local: false };
        let mut run = Run {
            listing,
            settings,
            limits,
            cells: values.iter().map(cell).collect(),
            functions,
            observer,
            line: 0,
            steps: 0,
            stored: 0,
            last: None,
            trace: vec![],
        };
        run.bind(arguments)?;
        run.block(&listing.program)?;
        run.outcome()
    }
}

impl<O: Observer> Run<'_, '_, O> {
    fn bind(&mut self, arguments: &[Value]) -> Fallible<()> {
        let (expected, found) = (self.listing.parameters.len(), arguments.len());
        if expected != found {
            return Err(self.fail_line(Cause::Arguments { expected, found }));
        }
        for (&slot, argument) in self.listing.parameters.iter().zip(arguments) {
            self.cells[slot].value = Some(argument.clone());
        }
        self.stored =
            self.cells.iter().filter_map(|cell| cell.value.as_ref()).map(Value::count).sum();
        self.room(0)
    }

    fn outcome(self) -> Fallible<Outcome> {
        let Some(value) = self.last else {
            return Err(self.fail_line(Cause::NoValue));
        };
        let names = self.listing.names.all().zip(self.cells);
        let locals = names.filter(|(_, cell)| cell.local);
        let locals = locals.filter_map(|(name, cell)| Some((name.into(), cell.value?))).collect();
        Ok(Outcome { value, locals, trace_output: self.trace })
    }

    fn block(&mut self, block: &[Statement]) -> Fallible<()> {
        block.iter().try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &Statement) -> Fallible<()> {
        self.line = statement.line;
        if O::ACTIVE {
            self.observer.statement(&self.listing.lines[self.line]);
        }
        self.spend(1)?;
        if !self.admits(&statement.step)? {
            return Ok(());
        }
        match &statement.step {
            Step::For { name, from, to, body, .. } => self.repeat(*name, from, to, body),
            Step::If { body, .. } => self.block(body),
            Step::Assign { target, value, .. } => {
                let value = self.eval(value)?;
                self.assign(target, value)
            }
            Step::Evaluate { value, .. } => {
                self.last = Some(self.eval(value)?);
                Ok(())
            }
        }
    }

    /// Returns whether the statement's condition is true; one without a condition always runs.
    fn admits(&mut self, step: &Step) -> Fallible<bool> {
        let Some(condition) = step.condition() else {
            return Ok(true);
        };
        let truth = self.truth(condition)?;
        if O::ACTIVE {
            let place = self.place(&condition.span);
            self.observer.condition(place, truth);
        }
        if !truth && self.settings.last_if_is_zero {
            self.last = Some(Value::Number(0.0));
        }
        Ok(truth)
    }

    /// Runs the body for each number of the range, which is fixed on entry.
    fn repeat(&mut self, name: Slot, from: &Expr, to: &Expr, body: &[Statement]) -> Fallible<()> {
        let line = self.line;
        let (from, to) = (self.number(from)?, self.number(to)?);
        if from > to && self.settings.descending_is_empty {
            return Ok(());
        }
        let step = if from > to { -1.0 } else { 1.0 };
        for turn in 0..=(to - from).abs().floor() as u64 {
            self.line = line;
            self.spend(1)?;
            self.store(name, Value::Number(from + step * turn as f64))?;
            self.block(body)?;
        }
        Ok(())
    }

    /// Writes a value to a name or entry. The value of the statement is what was written.
    fn assign(&mut self, target: &Reference, value: Value) -> Fallible<()> {
        // Lets go of an array first: shared with the value of the last statement, it would be
        // copied.
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
}
