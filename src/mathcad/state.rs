//! The state of a run: the values of its names, its current line, and how much of the limits it has
//! used.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::arithmetic::kind;
use super::failure::{Cause, Failure, Fallible, Subscripts};
use super::function::Function;
use super::listing::Listing;
use super::matrices;
use super::observe::{Named, Recorder};
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::syntax::{Slot, Span};
use super::unsupported;
use super::value::{Array, Value};

/// A name's value, and whether the program wrote it.
pub struct Variable {
    pub value: Option<Value>,
    pub local: bool,
}

/// What a run leaves behind.
#[derive(Clone, Debug)]
pub struct Ended {
    /// The program's value: that of the last statement evaluated.
    pub value: Value,
    /// The names that the program wrote to, with their last values.
    pub locals: BTreeMap<String, Value>,
    /// What `trace` was given, a line for each call.
    pub trace_output: Vec<String>,
}

pub struct Execution<'r, 'f> {
    pub listing: &'r Listing,
    /// The worksheet in which the functions that are called stand.
    pub sheet: &'r Sheet,
    pub settings: &'r Settings,
    pub limits: &'r Limits,
    pub cells: Vec<Variable>,
    pub functions: Vec<Option<Function>>,
    pub recorder: Option<&'r mut Recorder<'f>>,
    /// The current line, counted from 0 through the listing's lines.
    pub line: usize,
    /// The steps taken, those of the functions that were called too; `limits.steps` bounds them.
    pub spent: &'r Cell<u64>,
    /// Numbers stored by all names and trace lines, which `limits.entries` bounds.
    pub stored: usize,
    /// How deep blocks and expressions stand within each other, the calls that led here included;
    /// `limits.calls` bounds it.
    pub depth: usize,
    pub last: Option<Value>,
    /// What `trace` wrote, a line for each call.
    pub trace: Vec<String>,
}

impl<'r> Execution<'r, '_> {
    /// Makes the run of a listing, whose names are those of the sheet.
    pub fn new(
        listing: &'r Listing,
        sheet: &'r Sheet,
        settings: &'r Settings,
        limits: &'r Limits,
        spent: &'r Cell<u64>,
    ) -> Self {
        let names = || listing.names.all();
        Execution {
            listing,
            sheet,
            settings,
            limits,
            cells: names()
                .map(|name| Variable { value: sheet.value(name), local: false })
                .collect(),
            functions: names().map(|name| Function::named(sheet, name)).collect(),
            recorder: None,
            line: 0,
            spent,
            stored: 0,
            depth: listing.depth,
            last: None,
            trace: vec![],
        }
    }

    /// Counts `steps` against the limit.
    pub fn spend(&self, steps: u64) -> Fallible<()> {
        let spent = self.spent.get().saturating_add(steps);
        self.spent.set(spent);
        if spent > self.limits.steps {
            return Err(self.fail_line(Cause::Limit { limit: self.limits.steps, of: "steps" }));
        }
        Ok(())
    }

    /// Counts a failure that does not end the program: its message takes the time of its line.
    pub fn spend_on(&self, failure: &Failure) -> Fallible<()> {
        self.spend(16 + failure.statement.len() as u64 / 4)
    }

    /// Checks that `more` numbers can be stored within the limit.
    pub fn room(&self, more: usize) -> Fallible<()> {
        if self.stored.saturating_add(more) > self.limits.entries {
            let limit = self.limits.entries as u64;
            return Err(self.fail_line(Cause::Limit { limit, of: "numbers held at once" }));
        }
        Ok(())
    }

    /// Checks that there is room for the numbers of a new value, and takes a step for each.
    pub fn afford(&self, numbers: usize) -> Fallible<()> {
        self.room(numbers)?;
        self.spend(numbers as u64)
    }

    /// Checks that an array may hold what goes `depth` deep.
    pub fn check_nesting(&self, depth: usize) -> Fallible<()> {
        if depth < self.limits.depth {
            return Ok(());
        }
        let limit = self.limits.depth as u64;
        Err(self.fail_line(Cause::Limit { limit, of: "arrays within arrays" }))
    }

    /// Returns an expression of the current line as the listing writes it.
    pub fn text(&self, span: &Span) -> &'r str {
        &self.listing.lines[self.line].text[span.clone()]
    }

    /// Gives a failure its place, unless it has one from further inside.
    pub fn placed(&self, mut failure: Box<Failure>, span: &Span) -> Box<Failure> {
        if failure.line == 0 {
            let line = &self.listing.lines[self.line];
            failure.listing = self.listing.name.clone();
            failure.line = line.printed;
            failure.column = line.text[..span.start].chars().count() + 1;
            failure.text = self.text(span).into();
            failure.statement = line.text.clone();
        }
        failure
    }

    pub fn fail(&self, span: &Span, cause: Cause) -> Box<Failure> {
        self.placed(cause.into(), span)
    }

    pub fn fail_line(&self, cause: Cause) -> Box<Failure> {
        self.fail(&(0..self.listing.lines[self.line].text.len()), cause)
    }

    /// Returns why a name has no value, or, where it is `called`, is no function.
    pub fn undefined(&self, slot: Slot, called: bool) -> Cause {
        let name = self.listing.names.name(slot);
        let construct = if called && unsupported::is_function(name) {
            format!("the function {name}")
        } else if self.sheet.range(name).is_some() {
            format!("a range variable in an expression ({name})")
        } else if called {
            return Cause::Undefined { name: name.into() };
        } else if unsupported::is_unit(name) && self.sheet.program(name).is_none() {
            format!("units: {name}")
        } else if self.functions[slot].is_some() {
            format!("a function as a value ({name})")
        } else {
            return Cause::Undefined { name: name.into() };
        };
        Cause::Unsupported { construct }
    }

    /// Returns the value of a name or, with `subscripts`, of its entry.
    pub fn read(&mut self, slot: Slot, subscripts: Option<Subscripts>) -> Fallible<Value> {
        let value = match (&self.cells[slot].value, subscripts) {
            (Some(value), None) => value.clone(),
            (Some(value), Some(subscripts)) => {
                let name = || self.listing.names.name(slot).into();
                matrices::entry(value, subscripts, self.settings.origin, &name)?
            }
            // A local name without a value is 0.
            (None, None) if self.listing.used[slot].written => Value::default(),
            (None, Some(_)) if self.listing.used[slot].written => {
                return Err(kind("an array", &Value::default()).into());
            }
            (None, _) => return Err(self.undefined(slot, false).into()),
        };
        let line = &self.listing.lines[self.line];
        if let Some(recorder) = &mut self.recorder {
            let named = named(self.listing, slot, subscripts, &value);
            recorder.on(line).reads.push(named);
        }
        Ok(value)
    }

    /// Writes `value` to a name.
    pub fn store(&mut self, slot: Slot, value: Value) -> Fallible<()> {
        self.stored -= self.cells[slot].value.as_ref().map_or(0, Value::count);
        self.room(value.count())?;
        self.stored += value.count();
        self.record_write(slot, None, &value);
        self.cells[slot] = Variable { value: Some(value), local: true };
        Ok(())
    }

    /// Writes a value to an entry, as [`Value::write`]. A name that holds no array becomes an empty one.
    pub fn write(&mut self, target: Slot, subscripts: Subscripts, value: Value) -> Fallible<()> {
        self.check_nesting(value.depth())?;
        let name = || self.listing.names.name(target).into();
        let (i, j) = matrices::offsets(subscripts, self.settings.origin, &name)?;
        let cell = &mut self.cells[target].value;
        let held = cell.get_or_insert_with(|| Array::default().into());
        if let Value::Number(_) | Value::Text(_) = held {
            self.stored -= held.count();
            *held = Array::default().into();
        }
        let (rows, cols) = held.size();
        if subscripts.col.is_none() && cols > 1 {
            let name = self.listing.names.name(target).into();
            return Err(Cause::IndexOutside { name, subscripts, rows, cols }.into());
        }
        let (more, shared) = match held {
            Value::Array(array) => (array.missing(i, j), Rc::strong_count(array) > 1),
            Value::Nested(nested) => (nested.grid().missing(i, j), true),
            Value::Number(_) | Value::Text(_) => unreachable!("it became an array above"),
        };
        let copied = if shared { rows * cols } else { 0 };
        let moved = if more > 0 && j >= cols { rows * cols } else { 0 };
        self.room(more.saturating_add(value.count()).saturating_sub(1))?;
        self.spend((copied + moved + more) as u64)?;
        self.record_write(target, Some(subscripts), &value);
        let cell = &mut self.cells[target];
        cell.local = true;
        if let Some(held) = &mut cell.value {
            self.stored -= held.count();
            held.write(i, j, value);
            self.stored += held.count();
        }
        Ok(())
    }

    fn record_write(&mut self, slot: Slot, subscripts: Option<Subscripts>, value: &Value) {
        if let Some(recorder) = &mut self.recorder {
            let written = named(self.listing, slot, subscripts, value);
            recorder.on(&self.listing.lines[self.line]).writes.push(written);
        }
    }
}

fn named(listing: &Listing, slot: Slot, subscripts: Option<Subscripts>, value: &Value) -> Named {
    let numbers = subscripts.into_iter().flat_map(|s| [Some(s.row), s.col]).flatten();
    let subscripts = numbers.map(|x| x as i64).collect();
    Named { name: listing.names.name(slot).into(), subscripts, value: value.clone() }
}
