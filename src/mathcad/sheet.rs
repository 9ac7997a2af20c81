//! What a worksheet defines above a program: values and functions.

use std::collections::BTreeMap;
use std::f64::consts::{E, PI};
use std::rc::Rc;

use super::function::Function;
use super::listing::Listing;
use super::value::Value;

/// The names of a worksheet. By default it has Mathcad's own constants: `π`, `e`, and the angles `deg` and
/// `rad`, which are numbers.
#[derive(Clone)]
pub struct Sheet {
    names: BTreeMap<String, Meanings>,
}

/// What a name stands for: a call tells a function from a value.
#[derive(Clone, Default)]
struct Meanings {
    value: Option<Value>,
    function: Option<Function>,
    range: Option<Numbers>,
}

/// A function of a worksheet.
#[derive(Clone)]
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
        let mut sheet = Sheet::empty();
        for (name, x) in constants {
            sheet.define(name, x);
        }
        sheet
    }
}

impl Sheet {
    /// Makes a worksheet without names, Mathcad's constants among them.
    pub fn empty() -> Self {
        Sheet { names: BTreeMap::new() }
    }

    fn meanings(&mut self, name: &str) -> &mut Meanings {
        self.names.entry(name.into()).or_default()
    }

    /// Defines a name as a value. A function of that name stays.
    pub fn define(&mut self, name: &str, value: impl Into<Value>) -> &mut Self {
        self.meanings(name).value = Some(value.into());
        self
    }

    /// Defines the function that a listing's first line names, in a file of functions: its names are
    /// those at the call, wherever they stand.
    pub fn define_program(&mut self, program: Rc<Listing>) -> &mut Self {
        let name = program.function().to_string();
        self.meanings(&name).function = Some(Function::Program(Defined { program, above: None }));
        self
    }

    /// Defines a function from outside.
    pub fn define_function(
        &mut self,
        name: &str,
        function: impl Fn(&[Value]) -> Result<Value, String> + 'static,
    ) -> &mut Self {
        self.meanings(name).function = Some(Function::Outside(Rc::new(function)));
        self
    }

    /// Defines the function that a listing's first line names, as a region of a worksheet does: its
    /// names are those above, its own name too where a function of that name stands there.
    pub fn define_below(&mut self, program: Rc<Listing>) -> &mut Self {
        let above = program.names.all().filter_map(|name| self.names.get_key_value(name));
        let above = Sheet { names: above.map(|(k, v)| (k.clone(), v.clone())).collect() };
        let name = program.function().to_string();
        let function = Some(Function::Program(Defined { program, above: Some(above.into()) }));
        self.names.insert(name, Meanings { function, ..Meanings::default() });
        self
    }

    /// Defines a range variable.
    pub fn define_range(&mut self, name: &str, numbers: Numbers) -> &mut Self {
        self.meanings(name).range = Some(numbers);
        self
    }

    /// Forgets what a name stands for.
    pub fn remove(&mut self, name: &str) {
        self.names.remove(name);
    }

    /// Returns the value of a name; None where it is not defined or is a range or a program.
    pub fn value(&self, name: &str) -> Option<Value> {
        self.names.get(name)?.value.clone()
    }

    /// Returns the numbers of a range variable; None where the name is none.
    pub fn range(&self, name: &str) -> Option<Numbers> {
        self.names.get(name)?.range
    }

    /// Returns the program of a function; None where the name is none.
    pub fn program(&self, name: &str) -> Option<&Rc<Listing>> {
        match self.function(name)? {
            Function::Program(defined) => Some(&defined.program),
            Function::Builtin(_) | Function::Outside(_) => None,
        }
    }

    pub(super) fn function(&self, name: &str) -> Option<&Function> {
        self.names.get(name)?.function.as_ref()
    }

    /// Returns whether a name has a value, a function or a range.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }
}
