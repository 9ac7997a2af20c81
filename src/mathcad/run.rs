//! Running a listing in the worksheet around it.

use std::cell::Cell;
use std::error::Error;

use super::failure::Fallible;
use super::listing::Listing;
use super::observe::Recorder;
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::state::{Ended, Execution};
use super::value::Value;

/// Returns the value of an expression, or of the lines of a program, under the default settings.
///
/// ```
/// assert_eq!(plane_contact_mathcad::evaluate("2·3 + 1").unwrap().to_string(), "7");
/// ```
///
/// # Errors
/// The text cannot be read, or fails as it runs.
pub fn evaluate(lines: &str) -> Result<Value, Box<dyn Error>> {
    let lines: Vec<String> = lines.lines().map(|line| format!("  {line}")).collect();
    let listing = Listing::parse("_", &format!("_() :=\n{}", lines.join("\n")))?;
    let sheet = Sheet::empty();
    Ok(listing.runner(&sheet, &Settings::default(), &Limits::default()).call(&[])?.value)
}

/// A listing in a worksheet: what is defined above it, and the settings.
pub struct Runner<'l> {
    listing: &'l Listing,
    sheet: &'l Sheet,
    settings: Settings,
    limits: Limits,
    spent: Cell<u64>,
}

impl Listing {
    /// Returns a runner of the listing in the worksheet `sheet`.
    pub fn runner<'l>(
        &'l self,
        sheet: &'l Sheet,
        settings: &Settings,
        limits: &Limits,
    ) -> Runner<'l> {
        let (settings, limits) = (settings.clone(), limits.clone());
        Runner { listing: self, sheet, settings, limits, spent: Cell::default() }
    }
}

impl Runner<'_> {
    /// Calls the listing's function.
    ///
    /// # Errors
    /// The listing fails: says in which line and why.
    pub fn call(&mut self, arguments: &[Value]) -> Fallible<Ended> {
        self.call_recorded(arguments, None)
    }

    /// Calls the listing's function; each statement goes to the recorder, those before a failure too.
    ///
    /// # Errors
    /// The listing fails: says in which line and why.
    pub fn call_recorded(
        &mut self,
        arguments: &[Value],
        recorder: Option<&mut Recorder<'_>>,
    ) -> Fallible<Ended> {
        self.spent.set(0);
        let Runner { listing, sheet, settings, limits, spent } = self;
        let mut run = Execution::new(listing, sheet, settings, limits, spent);
        run.recorder = recorder;
        run.run(arguments)
    }

    /// Returns the steps that the last call took.
    pub fn steps(&self) -> u64 {
        self.spent.get()
    }
}
