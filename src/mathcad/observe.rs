//! Watching a run: what each statement reads and writes, and which conditions decide.

use super::listing::Line;
use super::value::Value;

/// What watches a run of a listing: each method is called when its event happens. `()` watches
/// nothing and costs nothing.
pub trait Observer {
    /// Where this is false, the run does not even prepare its reports.
    const ACTIVE: bool = true;

    /// The statement of a line begins.
    fn statement(&mut self, _line: &Line) {}

    /// A name or an entry was read.
    fn read(&mut self, _access: Access<'_>) {}

    /// A name or an entry was written to; a loop variable is in each turn.
    fn write(&mut self, _access: Access<'_>) {}

    /// A statement's condition was evaluated: whether it was true.
    fn condition(&mut self, _place: Place<'_>, _held: bool) {}

    /// An `∧` was evaluated: its operands, each as the listing writes it, and whether it was true; `None`
    /// if it failed or was not evaluated.
    fn conjunction(&mut self, _place: Place<'_>, _operands: &[(&str, Option<bool>)]) {}

    /// The run ended after so many steps.
    fn end(&mut self, _steps: u64) {}
}

impl Observer for () {
    const ACTIVE: bool = false;
}

/// A name or entry that a line reads or writes, and its value.
#[derive(Clone, Copy, Debug)]
pub struct Access<'a> {
    /// The line that is executed.
    pub line: &'a Line,
    /// The name, without subscripts.
    pub name: &'a str,
    /// No, one or two subscripts, from the worksheet's `ORIGIN`.
    pub subscripts: &'a [i64],
    /// The value that was read or written.
    pub value: &'a Value,
}

/// An expression and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The line it belongs to.
    pub line: &'a Line,
    /// Where the expression starts in the line, in bytes.
    pub start: usize,
    /// The expression as the listing writes it.
    pub text: &'a str,
}

/// A statement executed: what it read, what decided it, and what it wrote.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Executed {
    /// The number of the printed line, from 1.
    pub line: usize,
    /// The number of the line in the file, from 1; of a line that an edit moves or repeats, in the
    /// edit's.
    pub in_file: usize,
    /// Whether its condition was true; `None` without a condition, and where it failed.
    pub held: Option<bool>,
    /// The operands of its `∧`, in order: text, and truth as [`Observer::conjunction`] has it.
    pub operands: Vec<(String, Option<bool>)>,
    /// Everything that was read, in order.
    pub reads: Vec<Named>,
    /// Everything that was written, in order.
    pub writes: Vec<Named>,
}

/// A name or entry with its value, kept beyond the statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The name, without subscripts.
    pub name: String,
    /// No, one or two subscripts, from the worksheet's `ORIGIN`.
    pub subscripts: Vec<i64>,
    /// Its value then.
    pub value: Value,
}

impl From<Access<'_>> for Named {
    fn from(access: Access<'_>) -> Self {
        Named {
            name: access.name.into(),
            subscripts: access.subscripts.into(),
            value: access.value.clone(),
        }
    }
}

/// Hands every statement to a function once it is done.
///
/// A `for` line is handed over once for each turn. A statement is done when the next begins, and
/// the last one when the recorder is dropped.
pub struct Recorder<F: FnMut(&Executed)> {
    hand_over: F,
    current: Option<Executed>,
}

impl<F: FnMut(&Executed)> Recorder<F> {
    /// Makes a recorder that hands statements to `hand_over`.
    pub fn new(hand_over: F) -> Self {
        Recorder { hand_over, current: None }
    }

    /// Hands over the statement that is done and begins the next.
    fn begin(&mut self, line: &Line) {
        let next = Executed { line: line.printed, in_file: line.in_file, ..Executed::default() };
        if let Some(done) = self.current.replace(next) {
            (self.hand_over)(&done);
        }
    }

    /// Returns the current statement, a new one when a loop's line comes round again.
    fn on(&mut self, line: &Line) -> &mut Executed {
        if self.current.as_ref().is_none_or(|current| current.line != line.printed) {
            self.begin(line);
        }
        self.current.as_mut().expect("a statement has begun")
    }
}

impl<F: FnMut(&Executed)> Observer for Recorder<F> {
    fn statement(&mut self, line: &Line) {
        self.begin(line);
    }

    fn read(&mut self, access: Access<'_>) {
        self.on(access.line).reads.push(access.into());
    }

    fn write(&mut self, access: Access<'_>) {
        self.on(access.line).writes.push(access.into());
    }

    fn condition(&mut self, place: Place<'_>, held: bool) {
        self.on(place.line).held = Some(held);
    }

    fn conjunction(&mut self, place: Place<'_>, operands: &[(&str, Option<bool>)]) {
        let operands = operands.iter().map(|(text, held)| ((*text).into(), *held));
        self.on(place.line).operands = operands.collect();
    }
}

impl<F: FnMut(&Executed)> Drop for Recorder<F> {
    fn drop(&mut self) {
        if let Some(done) = &self.current {
            (self.hand_over)(done);
        }
    }
}
