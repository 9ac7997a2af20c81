//! The state of a run: the values of its names, its current line, and how much of the limits it has
//! used.

use std::cell::Cell;

use super::failure::{Cause, Failure, Fallible};
use super::function::Function;
use super::listing::Listing;
use super::observe::Place;
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::syntax::{Slot, Span};
use super::unsupported;
use super::value::Value;

/// A name's value, and whether the program wrote it.
pub struct Variable {
    pub value: Option<Value>,
    pub local: bool,
}

pub struct Run<'r, 'l, O> {
    pub listing: &'r Listing,
    /// The worksheet in which the functions that are called stand, if it defines any.
    pub sheet: Option<&'r Sheet>,
    pub settings: &'r Settings,
    pub limits: &'r Limits,
    pub cells: Vec<Variable>,
    pub functions: &'r mut [Option<Function<'l>>],
    pub observer: &'r mut O,
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

impl<'r, 'l, O> Run<'r, 'l, O> {
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

    /// Returns where an expression of the current line stands.
    pub fn place(&self, span: &Span) -> Place<'r> {
        let line = &self.listing.lines[self.line];
        Place { line, start: span.start, text: &line.text[span.clone()] }
    }

    pub fn fail(&self, span: &Span, cause: Cause) -> Box<Failure> {
        let Place { line, start, text } = self.place(span);
        Box::new(Failure {
            listing: self.listing.name.clone(),
            line: line.printed,
            column: line.text[..start].chars().count() + 1,
            text: text.into(),
            statement: line.text.clone(),
            cause,
        })
    }

    pub fn fail_line(&self, cause: Cause) -> Box<Failure> {
        self.fail(&(0..self.listing.lines[self.line].text.len()), cause)
    }

    /// Returns the failure of a name that has no value, or, where it is `called`, is no function.
    pub fn undefined(&self, slot: Slot, called: bool, span: &Span) -> Box<Failure> {
        let name = self.listing.names.name(slot);
        let of_sheet =
            |has: fn(&Sheet, &str) -> bool| self.sheet.is_some_and(|sheet| has(sheet, name));
        let construct = if called && unsupported::is_function(name) {
            format!("the function {name}")
        } else if of_sheet(|sheet, name| sheet.range(name).is_some()) {
            format!("a range variable in an expression ({name})")
        } else if called {
            return self.fail(span, Cause::Undefined { name: name.into() });
        } else if unsupported::is_unit(name)
            && !of_sheet(|sheet, name| sheet.program(name).is_some())
        {
            format!("units: {name}")
        } else if self.functions[slot].is_some() {
            format!("a function as a value ({name})")
        } else {
            return self.fail(span, Cause::Undefined { name: name.into() });
        };
        self.fail(span, Cause::Unsupported { construct })
    }
}
