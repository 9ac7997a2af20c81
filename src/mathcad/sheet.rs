//! What a worksheet defines above a program: values and functions.

use std::collections::BTreeMap;
use std::f64::consts::{E, PI};
use std::rc::Rc;

use super::listing::Listing;
use super::value::Value;

/// The names of a worksheet. Mathcad's own constants are there from the start: `π`, `e`, and the
/// angles `deg` and `rad`, which are numbers.
#[derive(Clone, Debug)]
pub struct Sheet {
    values: BTreeMap<String, Value>,
    programs: BTreeMap<String, Defined>,
    ranges: BTreeMap<String, Numbers>,
}

/// A function of a worksheet.
#[derive(Clone, Debug)]
pub struct Defined {
    /// The function's program.
    pub program: Rc<Listing>,
    /// What its names are, where its definition decides that; else what they are at the call.
    pub(super) above: Option<Rc<Sheet>>,
}

/// The numbers of a range: the first, the second if it is given, and the last.
pub type Numbers = (f64, Option<f64>, f64);

impl Default for Sheet {
    fn default() -> Self {
        let constants = [("π", PI), ("e", E), ("deg", PI / 180.0), ("rad", 1.0)];
        let values = constants.map(|(name, x)| (name.into(), x.into())).into();
        Sheet { values, programs: BTreeMap::new(), ranges: BTreeMap::new() }
    }
}

impl Sheet {
    /// Defines a name as a value. A function of that name stays: a call tells one from the other.
    pub fn define(&mut self, name: &str, value: impl Into<Value>) -> &mut Self {
        self.values.insert(name.into(), value.into());
        self
    }

    /// Defines the function that a listing's first line names, in a file of functions: its names are
    /// those at the call, wherever they stand.
    pub fn define_program(&mut self, program: Rc<Listing>) -> &mut Self {
        self.programs.insert(program.function().into(), Defined { program, above: None });
        self
    }

    /// Defines the function that a listing's first line names, as a region of a worksheet does: its
    /// names are those above, its own name too where a function of that name stands there.
    pub fn define_below(&mut self, program: Rc<Listing>) -> &mut Self {
        let names: Vec<&str> = program.names.all().collect();
        let above = Sheet {
            values: entries(&self.values, &names),
            programs: entries(&self.programs, &names),
            ranges: entries(&self.ranges, &names),
        };
        let name = program.function().to_string();
        self.remove(&name);
        self.programs.insert(name, Defined { program, above: Some(above.into()) });
        self
    }

    /// Defines a range variable.
    pub fn define_range(&mut self, name: &str, numbers: Numbers) -> &mut Self {
        self.ranges.insert(name.into(), numbers);
        self
    }

    /// Forgets what a name stands for.
    pub fn remove(&mut self, name: &str) {
        self.values.remove(name);
        self.programs.remove(name);
        self.ranges.remove(name);
    }

    /// Returns the value of a name; None where it is not defined or is a range or a program.
    pub fn value(&self, name: &str) -> Option<Value> {
        self.values.get(name).cloned()
    }

    /// Returns the numbers of a range variable; None where the name is none.
    pub fn range(&self, name: &str) -> Option<Numbers> {
        self.ranges.get(name).copied()
    }

    /// Returns the program of a function; None where the name is none.
    pub fn program(&self, name: &str) -> Option<&Rc<Listing>> {
        self.programs.get(name).map(|defined| &defined.program)
    }

    pub(super) fn defined(&self, name: &str) -> Option<&Defined> {
        self.programs.get(name)
    }

    /// Returns whether a name has a value, a function or a range.
    pub fn has(&self, name: &str) -> bool {
        let [values, ranges] = [self.values.contains_key(name), self.ranges.contains_key(name)];
        values || ranges || self.programs.contains_key(name)
    }
}

/// Returns the entries that have one of the names.
fn entries<T: Clone>(all: &BTreeMap<String, T>, names: &[&str]) -> BTreeMap<String, T> {
    names
        .iter()
        .filter_map(|name| all.get_key_value(*name))
        .map(|(k, v)| (k.clone(), v.clone()))
        .collect()
}
