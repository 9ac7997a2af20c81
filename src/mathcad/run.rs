//! Running a listing: the worksheet around it, and its statements.

use std::cell::Cell;
use std::collections::BTreeMap;

use super::failure::{Cause, Fallible, Subscripts};
use super::function::{FUNCTION, Function};
use super::listing::Listing;
use super::matrices;
use super::observe::Observer;
use super::settings::{Limits, Settings};
use super::sheet::{Numbers, Sheet};
use super::state::{Run, Variable};
use super::syntax::{Expr, Kind, Range, Reference, Slot, Span, Spread, Statement, Step};
use super::value::{Grid, Value};

/// A listing in a worksheet: what is defined above it, and the settings.
pub struct Runner<'l> {
    listing: &'l Listing,
    sheet: Option<&'l Sheet>,
    settings: Settings,
    limits: Limits,
    values: Vec<Option<Value>>,
    functions: Vec<Option<Function<'l>>>,
    spent: Cell<u64>,
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
    /// Returns a runner of the listing where only Mathcad's own functions are defined.
    pub fn runner(&self, settings: &Settings, limits: &Limits) -> Runner<'_> {
        Runner::new(self, None, settings, limits)
    }

    /// Returns a runner of the listing in the worksheet `sheet`.
    pub fn runner_in<'l>(
        &'l self,
        sheet: &'l Sheet,
        settings: &Settings,
        limits: &Limits,
    ) -> Runner<'l> {
        Runner::new(self, Some(sheet), settings, limits)
    }
}

impl<'l> Runner<'l> {
    fn new(
        listing: &'l Listing,
        sheet: Option<&'l Sheet>,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        let names = || listing.names.all();
        Runner {
            listing,
            sheet,
            settings: settings.clone(),
            limits: limits.clone(),
            values: names().map(|name| sheet?.value(name)).collect(),
            functions: names().map(|name| Function::named(sheet, name)).collect(),
            spent: Cell::default(),
        }
    }

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
    ///
    /// # Errors
    /// The listing fails: says in which line and why.
    pub fn call(&mut self, arguments: &[Value]) -> Fallible<Outcome> {
        self.call_observed(arguments, &mut ())
    }

    /// Returns the steps that the last call took.
    pub fn steps(&self) -> u64 {
        self.spent.get()
    }

    /// Calls the listing's function under the eyes of an observer.
    ///
    /// # Errors
    /// Returns the failure that stopped the program; the observer has then seen all that
    /// came before.
    pub fn call_observed<O: Observer>(
        &mut self,
        arguments: &[Value],
        observer: &mut O,
    ) -> Fallible<Outcome> {
        let Runner { listing, sheet, settings, limits, values, functions, spent } = self;
        let cell = |value: &Option<Value>| Variable { value: value.clone(), local: false };
        spent.set(0);
        let run = Run {
            listing,
            sheet: *sheet,
            settings,
            limits,
            cells: values.iter().map(cell).collect(),
            functions,
            observer: &mut *observer,
            line: 0,
            spent,
            stored: 0,
            depth: listing.depth,
            last: None,
            trace: vec![],
        };
        let outcome = run.run(arguments).and_then(Run::outcome);
        observer.end(spent.get());
        outcome
    }
}

/// Where a program goes on after a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flow {
    Next,
    Break,
    Continue,
    Return,
}

/// The values that a loop gives its variable.
pub(super) enum Turns {
    /// From the first number by the step, up or down to the last.
    Span {
        from: f64,
        step: f64,
        to: f64,
    },
    Over(Value),
}

/// What part of a step a range may pass its end by: rounding's. At least 1.1e-13 is Mathcad's (see
/// README.md).
const RANGE_END: f64 = 1e-12;

impl Turns {
    pub(super) fn value(&self, turn: usize) -> Option<Value> {
        match self {
            Turns::Span { from, step, to } => {
                let x = from + step * turn as f64;
                let end = to + RANGE_END * step;
                (if *step > 0.0 { x <= end } else { x >= end }).then_some(Value::Number(x))
            }
            Turns::Over(value @ (Value::Number(_) | Value::Text(_))) => {
                (turn == 0).then(|| value.clone())
            }
            Turns::Over(array) => {
                let rows = array.size().0.max(1);
                array.entry(turn % rows, turn / rows)
            }
        }
    }
}

impl<O: Observer> Run<'_, '_, O> {
    /// Runs the program to its end.
    pub fn run(mut self, arguments: &[Value]) -> Fallible<Self> {
        self.bind(arguments)?;
        match self.block(&self.listing.program)? {
            Flow::Next | Flow::Return => Ok(self),
            Flow::Break | Flow::Continue => Err(self.fail_line(Cause::OutsideLoop)),
        }
    }

    fn bind(&mut self, arguments: &[Value]) -> Fallible<()> {
        let (expected, found) = (self.listing.parameters.len(), arguments.len());
        if expected != found {
            return Err(self.fail_line(Cause::Arguments { expected, found }));
        }
        for (&slot, argument) in self.listing.parameters.iter().zip(arguments) {
            self.cells[slot].value = Some(argument.clone());
        }
        let values = self.cells.iter().filter_map(|cell| cell.value.as_ref());
        self.stored += values.map(Value::count).sum::<usize>();
        self.room(0)
    }

    /// Returns what a program that has run leaves behind.
    pub fn outcome(mut self) -> Fallible<Outcome> {
        let Some(value) = self.last.take() else {
            return Err(self.fail_line(Cause::NoValue));
        };
        let names = self.listing.names.all().zip(self.cells);
        let locals = names.filter(|(_, cell)| cell.local);
        let locals = locals.filter_map(|(name, cell)| Some((name.into(), cell.value?))).collect();
        Ok(Outcome { value, locals, trace_output: self.trace })
    }

    /// Returns the value of a program within an expression, whose names are those of the program around
    /// it.
    pub fn inner(&mut self, block: &[Statement], span: &Span) -> Fallible<Value> {
        let outer = self.last.take();
        let flow = self.block(block);
        let value = std::mem::replace(&mut self.last, outer);
        match (flow?, value) {
            (Flow::Next, Some(value)) => Ok(value),
            (Flow::Next, None) => Err(self.fail(span, Cause::NoValue)),
            (Flow::Break | Flow::Continue | Flow::Return, _) => {
                let construct = "break, continue or return in a program within an expression";
                Err(self.fail(span, Cause::Unsupported { construct: construct.into() }))
            }
        }
    }

    fn block(&mut self, block: &[Statement]) -> Fallible<Flow> {
        // Whether an `if` was true since the block's last `otherwise`.
        let mut held = false;
        for statement in block {
            let flow = self.statement(statement, &mut held)?;
            if flow != Flow::Next {
                return Ok(flow);
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &Statement, held: &mut bool) -> Fallible<Flow> {
        self.line = statement.line;
        if O::ACTIVE {
            self.observer.statement(&self.listing.lines[self.line]);
        }
        self.spend(1)?;
        match &statement.step {
            Step::While { condition, body } => return self.repeat_while(condition, body),
            Step::Otherwise { body } => {
                return if std::mem::take(held) { Ok(Flow::Next) } else { self.block(body) };
            }
            Step::Try { body, fallback } => return self.attempt(body, fallback),
            step if !self.admits(step, held)? => return Ok(Flow::Next),
            Step::For { name, range, body, .. } => return self.repeat(*name, range, body),
            Step::If { body, .. } => return self.block(body),
            Step::Break { .. } => return Ok(Flow::Break),
            Step::Continue { .. } => return Ok(Flow::Continue),
            Step::Assign { target, value, .. } => {
                let value = self.eval(value)?;
                self.assign(target, value)?;
            }
            Step::Spread { to, value, .. } => {
                let span = value.span.clone();
                let value = self.eval(value)?;
                self.spread(to, &value, &span)?;
                self.last = Some(value);
            }
            Step::Evaluate { value, .. } => self.last = Some(self.eval(value)?),
            Step::Return { value, .. } => {
                self.last = Some(self.eval(value)?);
                return Ok(Flow::Return);
            }
        }
        Ok(Flow::Next)
    }

    /// Returns whether the statement's condition is true; one without a condition always runs.
    fn admits(&mut self, step: &Step, held: &mut bool) -> Fallible<bool> {
        let Some(condition) = step.condition() else {
            return Ok(true);
        };
        let truth = self.condition(condition)?;
        *held |= truth;
        if !truth && self.settings.last_if_is_zero {
            self.last = Some(Value::Number(0.0));
        }
        Ok(truth)
    }

    fn condition(&mut self, condition: &Expr) -> Fallible<bool> {
        let truth = self.truth(condition)?;
        if O::ACTIVE {
            let place = self.place(&condition.span);
            self.observer.condition(place, truth);
        }
        Ok(truth)
    }

    fn attempt(&mut self, body: &[Statement], fallback: &[Statement]) -> Fallible<Flow> {
        match self.block(body) {
            Err(failure) if !failure.is_limit() => {
                self.spend_on(&failure)?;
                self.block(fallback)
            }
            outcome => outcome,
        }
    }

    fn repeat_while(&mut self, condition: &Expr, body: &[Statement]) -> Fallible<Flow> {
        let line = self.line;
        while self.condition(condition)? {
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => break,
                Flow::Return => return Ok(Flow::Return),
            }
            self.line = line;
            self.spend(1)?;
        }
        Ok(Flow::Next)
    }

    /// Runs the body for each number of the range, which is fixed on entry.
    fn repeat(&mut self, name: Slot, range: &Range, body: &[Statement]) -> Fallible<Flow> {
        let line = self.line;
        let turns = self.turns(range)?;
        let mut turn = 0;
        while let Some(value) = turns.value(turn) {
            self.line = line;
            self.spend(1)?;
            self.store(name, value)?;
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => break,
                Flow::Return => return Ok(Flow::Return),
            }
            turn += 1;
        }
        Ok(Flow::Next)
    }

    /// Returns the values of a loop's variable.
    ///
    /// # Errors
    /// The step of a range leads away from its end.
    pub(super) fn turns(&mut self, range: &Range) -> Fallible<Turns> {
        let (from, second, to) = match range {
            Range::Over(values) => match self.range_variable(values) {
                Some(numbers) => numbers,
                None => return self.values(values).map(Turns::Over),
            },
            Range::Span { from, second, to } => {
                let from = self.number(from)?;
                let second = second.as_ref().map(|second| self.number(second)).transpose()?;
                (from, second, self.number(to)?)
            }
        };
        let step = match second {
            Some(second) => second - from,
            None if from <= to || self.settings.descending_is_empty => 1.0,
            None => -1.0,
        };
        if second.is_none() || (to - from) * step > 0.0 || to == from && step != 0.0 {
            return Ok(Turns::Span { from, step, to });
        }
        Err(self.fail_line(Cause::Range { from, second: second.unwrap_or(from), to }))
    }

    /// Returns the numbers of the worksheet's range variable, if a loop runs over one.
    pub fn range_variable(&self, values: &[Expr]) -> Option<Numbers> {
        let [Expr { kind: Kind::Read(Reference { name, row: None, .. }), .. }] = values else {
            return None;
        };
        let has_value = self.cells[*name].value.is_some();
        self.sheet.filter(|_| !has_value)?.range(self.listing.names.name(*name))
    }

    /// Returns what a loop runs over: a value, or the entries of several as one column.
    fn values(&mut self, values: &[Expr]) -> Fallible<Value> {
        let mut entries = self.arguments(values)?;
        let count = entries.iter().map(Value::count).sum();
        self.afford(count)?;
        if entries.len() == 1 {
            return Ok(entries.remove(0));
        }
        self.spend(FUNCTION * count as u64)?;
        let entries = entries.into_iter().map(Turns::Over);
        let entries = entries.flat_map(|turns| (0..).map_while(move |turn| turns.value(turn)));
        let entries: Vec<Value> = entries.collect();
        self.check_nesting(entries.iter().map(Value::depth).max().unwrap_or(0))?;
        Ok(Value::grid(Grid::column(entries)))
    }

    /// Assigns the entries of a value to names that stand as they do, or to a column of an array.
    fn spread(&mut self, to: &Spread, value: &Value, span: &Span) -> Fallible<()> {
        self.last = None;
        let rows = match to {
            Spread::Names { names, cols } => names.len() / cols,
            Spread::Column { name, .. } => {
                let held = self.cells[*name].value.as_ref();
                held.filter(|held| !matches!(held, Value::Number(_) | Value::Text(_)))
                    .map_or(value.size().0, |held| held.size().0)
            }
        };
        let cols = if let Spread::Names { cols, .. } = to { *cols } else { 1 };
        let entries = matrices::spread(value, rows, cols).map_err(|why| self.fail(span, why))?;
        self.afford(value.count())?;
        match to {
            Spread::Names { names, .. } => {
                names.iter().zip(entries).try_for_each(|(name, entry)| self.store(*name, entry))
            }
            Spread::Column { name, span, column } => {
                let col = Some(self.number(column)?);
                let target = Reference { name: *name, row: None, col: None, span: span.clone() };
                let origin = f64::from(self.settings.origin);
                entries.into_iter().enumerate().try_for_each(|(k, entry)| {
                    self.write(&target, Subscripts { row: origin + k as f64, col }, entry)
                })
            }
        }
    }

    /// Writes a value to a name or entry. The value of the statement is what was written.
    fn assign(&mut self, target: &Reference, value: Value) -> Fallible<()> {
        // Lets go of an array first: shared with the value of the last statement, it would be
        // copied.
        self.last = None;
        match self.subscripts(target)? {
            None => self.store(target.name, value.clone())?,
            Some(subscripts) => self.write(target, subscripts, value.clone())?,
        }
        self.last = Some(value);
        Ok(())
    }
}
