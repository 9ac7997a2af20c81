//! Running a listing: the worksheet around it, its statements and its limits.

use std::collections::BTreeMap;

use super::failure::{Cause, Failure};
use super::function::Function;
use super::listing::Listing;
use super::observe::{Access, Observer, Place};
use super::settings::{Descending, LastIf, Limits, Settings};
use super::syntax::{Expr, Slot, Span, Statement, Step};
use super::value::Value;

/// A result, or the listing's failure.
pub type Fallible<T> = Result<T, Box<Failure>>;

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
    /// A worksheet for the listing, with nothing defined yet.
    pub fn runner(&self, settings: &Settings, limits: &Limits) -> Runner<'_> {
        Runner {
            listing: self,
            settings: settings.clone(),
            limits: limits.clone(),
            values: vec![None; self.names.len()],
            functions: (0..self.names.len())
                .map(|slot| Function::builtin(self.names.name(slot)))
                .collect(),
        }
    }
}

impl<'l> Runner<'l> {
    /// Defines a name above the listing. A name that the listing does not use is none of its business.
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
    ///
    /// # Errors
    ///
    /// The failure that stopped the program.
    pub fn call(&mut self, arguments: &[Value]) -> Fallible<Outcome> {
        self.call_observed(arguments, &mut ())
    }

    /// Calls the listing's function under the eyes of an observer.
    ///
    /// # Errors
    ///
    /// As [`Runner::call`]. The observer has then seen all that came before.
    pub fn call_observed<O: Observer>(
        &mut self,
        arguments: &[Value],
        observer: &mut O,
    ) -> Fallible<Outcome> {
        let mut run = Run {
            listing: self.listing,
            settings: &self.settings,
            limits: &self.limits,
            cells: self
                .values
                .iter()
                .map(|value| Cell { value: value.clone(), local: false })
                .collect(),
            functions: &mut self.functions,
            observer,
            line: 0,
            steps: 0,
            held: 0,
            last: None,
            trace: vec![],
        };
        run.bind(arguments)?;
        run.block(&run.listing.program)?;
        run.outcome()
    }
}

/// A name's value, and whether the program wrote it.
pub(super) struct Cell {
    pub(super) value: Option<Value>,
    pub(super) local: bool,
}

/// A run: the state of one call.
pub(super) struct Run<'r, 'l, O> {
    pub(super) listing: &'r Listing,
    pub(super) settings: &'r Settings,
    pub(super) limits: &'r Limits,
    pub(super) cells: Vec<Cell>,
    pub(super) functions: &'r mut [Option<Function<'l>>],
    pub(super) observer: &'r mut O,
    /// The current line, from 0.
    pub(super) line: usize,
    /// Steps taken, for the limit.
    steps: u64,
    /// Numbers held by all names and trace lines, for the limit.
    pub(super) held: usize,
    /// The value of the last statement evaluated.
    pub(super) last: Option<Value>,
    pub(super) trace: Vec<String>,
}

impl<'r, O: Observer> Run<'r, '_, O> {
    /// Gives the parameters their values.
    fn bind(&mut self, arguments: &[Value]) -> Fallible<()> {
        let (expected, found) = (self.listing.header.parameters.len(), arguments.len());
        if expected != found {
            return Err(self.fail_line(Cause::Arguments { expected, found }));
        }
        for (&slot, argument) in self.listing.header.parameters.iter().zip(arguments) {
            self.cells[slot].value = Some(argument.clone());
        }
        self.held = self.cells.iter().filter_map(|cell| cell.value.as_ref()).map(Value::len).sum();
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

    fn block(&mut self, block: &'r [Statement]) -> Fallible<()> {
        block.iter().try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &'r Statement) -> Fallible<()> {
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

    /// Whether the statement's condition holds; a statement without one is always admitted.
    fn admits(&mut self, step: &'r Step) -> Fallible<bool> {
        let Some(condition) = step.condition() else {
            return Ok(true);
        };
        let held = self.truth(condition)?;
        if O::ACTIVE {
            let place = self.place(&condition.span);
            self.observer.condition(place, held);
        }
        if !held && self.settings.last_if == LastIf::Zero {
            self.last = Some(Value::Number(0.0));
        }
        Ok(held)
    }

    /// Runs the body for each number of the range, which is fixed on entry.
    fn repeat(
        &mut self,
        name: Slot,
        from: &'r Expr,
        to: &'r Expr,
        body: &'r [Statement],
    ) -> Fallible<()> {
        let line = self.line;
        let (from, to) = (self.number(from)?, self.number(to)?);
        let step = match self.settings.descending {
            _ if from <= to => 1.0,
            Descending::CountsDown => -1.0,
            Descending::Empty => return Ok(()),
        };
        for turn in 0..=(to - from).abs().floor() as u64 {
            self.line = line;
            self.spend(1)?;
            self.store(name, Value::Number(from + step * turn as f64))?;
            self.block(body)?;
        }
        Ok(())
    }

    /// Gives a name a value.
    pub(super) fn store(&mut self, slot: Slot, value: Value) -> Fallible<()> {
        let old = self.cells[slot].value.as_ref().map_or(0, Value::len);
        self.held -= old;
        self.room(value.len())?;
        self.held += value.len();
        if O::ACTIVE {
            self.observer.write(self.access(slot, &[], &value));
        }
        self.cells[slot] = Cell { value: Some(value), local: true };
        Ok(())
    }

    /// Counts steps against the limit.
    pub(super) fn spend(&mut self, steps: u64) -> Fallible<()> {
        self.steps = self.steps.saturating_add(steps);
        if self.steps > self.limits.steps {
            return Err(self.fail_line(Cause::Limit { limit: self.limits.steps, of: "steps" }));
        }
        Ok(())
    }

    /// Refuses to hold more numbers than the limit allows.
    pub(super) fn room(&self, more: usize) -> Fallible<()> {
        if self.held.saturating_add(more) > self.limits.entries {
            let limit = self.limits.entries as u64;
            return Err(self.fail_line(Cause::Limit { limit, of: "numbers held at once" }));
        }
        Ok(())
    }

    /// What to tell an observer of a name or entry.
    pub(super) fn access<'a>(
        &self,
        slot: Slot,
        subscripts: &'a [i64],
        value: &'a Value,
    ) -> Access<'a>
    where
        'r: 'a,
    {
        let listing = self.listing;
        Access {
            line: &listing.lines[self.line],
            name: listing.names.name(slot),
            subscripts,
            value,
        }
    }

    /// An expression of the current line.
    pub(super) fn place(&self, span: &Span) -> Place<'r> {
        let line = &self.listing.lines[self.line];
        Place { line, start: span.start, text: &line.text[span.clone()] }
    }

    /// The failure of an expression of the current line.
    pub(super) fn fail(&self, span: &Span, cause: Cause) -> Box<Failure> {
        let line = &self.listing.lines[self.line];
        Box::new(Failure {
            listing: self.listing.name.clone(),
            line: line.printed,
            column: line.text[..span.start].chars().count() + 1,
            text: line.text[span.clone()].into(),
            statement: line.text.clone(),
            cause,
        })
    }

    /// The failure of the current line as a whole.
    fn fail_line(&self, cause: Cause) -> Box<Failure> {
        self.fail(&(0..self.listing.lines[self.line].text.len()), cause)
    }
}
