//! Running a listing in the worksheet around it.

use std::cell::Cell;
use std::error::Error;

use super::failure::Fallible;
use super::function::Function;
use super::listing::Listing;
use super::observe::Recorder;
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::state::{Ended, Run, Variable};
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
    Ok(listing.runner(&Settings::default(), &Limits::default()).call(&[])?.value)
}

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
        let Runner { listing, sheet, settings, limits, values, functions, spent } = self;
        spent.set(0);
        let cells = values.iter().map(|value| Variable { value: value.clone(), local: false });
        let run = Run {
            listing,
            sheet: *sheet,
            settings,
            limits,
            cells: cells.collect(),
            functions,
            recorder,
            line: 0,
            spent,
            stored: 0,
            depth: listing.depth,
            last: None,
            trace: vec![],
        };
        run.run(arguments)
    }

    /// Returns the steps that the last call took.
    pub fn steps(&self) -> u64 {
        self.spent.get()
    }
}
