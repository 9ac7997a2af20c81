//! Watching a run: what each statement reads and writes, and which conditions decide.

use super::listing::Line;
use super::value::Value;

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
    /// The operands of its `∧`, in order, each as the listing writes it, and whether it was true; `None`
    /// if it failed or was not evaluated.
    pub operands: Vec<(String, Option<bool>)>,
    /// Everything that was read, in order.
    pub reads: Vec<Named>,
    /// Everything that was written, in order; a loop variable is in each turn.
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

/// Hands every statement to a function once it is done.
///
/// A `for` line is handed over once for each turn. A statement is done when the next begins, and
/// the last one when the recorder is dropped.
pub struct Recorder<'f> {
    hand_over: Box<dyn FnMut(&Executed) + 'f>,
    current: Option<Executed>,
}

impl<'f> Recorder<'f> {
    /// Makes a recorder that hands statements to `hand_over`.
    pub fn new(hand_over: impl FnMut(&Executed) + 'f) -> Self {
        Recorder { hand_over: Box::new(hand_over), current: None }
    }

    /// Hands over the statement that is done and begins the next.
    pub(super) fn begin(&mut self, line: &Line) {
        let next = Executed { line: line.printed, in_file: line.in_file, ..Executed::default() };
        if let Some(done) = self.current.replace(next) {
            (self.hand_over)(&done);
        }
    }

    /// Returns the current statement, a new one when a loop's line comes round again.
    pub(super) fn on(&mut self, line: &Line) -> &mut Executed {
        if self.current.as_ref().is_none_or(|current| current.line != line.printed) {
            self.begin(line);
        }
        self.current.as_mut().expect("a statement has begun")
    }
}

impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        if let Some(done) = &self.current {
            (self.hand_over)(done);
        }
    }
}
