//! What a worksheet defines above a program: values and functions.

use std::collections::BTreeMap;
use std::f64::consts::{E, PI};
use std::rc::Rc;

use super::function::Function;
use super::listing::Listing;
use super::value::Value;

/// The names of a worksheet. Mathcad's own constants are there from the start: `π`, `e`, and the
/// angles `deg` and `rad`, which are numbers.
#[derive(Clone, Debug)]
pub struct Sheet {
    values: BTreeMap<String, Value>,
    programs: BTreeMap<String, Rc<Listing>>,
    ranges: BTreeMap<String, Numbers>,
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

    /// Defines the function that a listing's first line names.
    pub fn define_program(&mut self, program: Rc<Listing>) -> &mut Self {
        self.programs.insert(program.function().into(), program);
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

    pub fn value(&self, name: &str) -> Option<Value> {
        self.values.get(name).cloned()
    }

    pub fn range(&self, name: &str) -> Option<Numbers> {
        self.ranges.get(name).copied()
    }

    pub fn program(&self, name: &str) -> Option<&Rc<Listing>> {
        self.programs.get(name)
    }

    /// Returns the function that a name stands for: the worksheet's, or else Mathcad's own.
    pub(super) fn function<'l>(&self, name: &str) -> Option<Function<'l>> {
        let program = self.programs.get(name).map(|program| Function::Program(program.clone()));
        program.or_else(|| Function::builtin(name))
    }
}
