//! Calling a function on the values of its arguments.

use super::failure::{Cause, Fallible};
use super::function::{Builtin, Function, Meaning, each, real};
use super::observe::Observer;
use super::sheet::Defined;
use super::state::{Run, Variable};
use super::syntax::{Slot, Span};
use super::value::Value;

impl<O: Observer> Run<'_, '_, O> {
    /// Returns the value of the function that the name `slot` stands for.
    pub fn call(&mut self, slot: Slot, arguments: &[Value], span: &Span) -> Fallible<Value> {
        let result = match &mut self.functions[slot] {
            None => return Err(self.undefined(slot, true, span)),
            Some(Function::Program(program)) => {
                let program = program.clone();
                return self.call_program(&program, arguments);
            }
            Some(Function::Builtin(builtin)) => {
                let builtin = *builtin;
                let (numbers, steps) = (builtin.cost)(arguments);
                self.room(numbers)?;
                self.spend(steps)?;
                self.call_builtin(builtin, arguments)
            }
            Some(Function::Outside(function)) => function(arguments).map_err(|message| {
                Cause::Function { name: self.listing.names.name(slot).into(), message }
            }),
        };
        result.map_err(|cause| self.fail(span, cause))
    }

    fn call_builtin(
        &mut self,
        builtin: &'static Builtin,
        arguments: &[Value],
    ) -> Result<Value, Cause> {
        let name = builtin.name;
        match builtin.meaning {
            Meaning::Elementary(function) => each(arguments, |x| real(function(x), x, name)),
            Meaning::Numbers(function) => function(arguments, name).map(Value::Number),
            Meaning::Values(function) => function(arguments),
            Meaning::Subscripts(function) => function(arguments, self.settings.origin),
            Meaning::Vectorize => Err(Cause::Arguments { expected: 1, found: arguments.len() }),
            Meaning::Trace => {
                let line = arguments.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
                let value = Value::Text(line.as_str().into());
                self.stored += value.count();
                self.trace.push(line);
                Ok(value)
            }
        }
    }

    /// Runs a function of the worksheet; its steps and numbers count with those of the caller.
    fn call_program(&mut self, defined: &Defined, arguments: &[Value]) -> Fallible<Value> {
        let program = &*defined.program;
        let depth = self.depth + program.depth;
        if depth > self.limits.calls {
            let limit = self.limits.calls as u64;
            return Err(self.fail_line(Cause::Limit { limit, of: "levels of calls" }));
        }
        // Each name is looked up in the worksheet.
        self.spend(16 + 8 * program.names.len() as u64)?;
        let names = || program.names.all();
        let sheet = defined.above.as_deref().or(self.sheet);
        let value = |name| sheet.and_then(|sheet| sheet.value(name));
        // Its own name is itself where nothing above it has that name.
        let itself =
            |name| (name == program.function()).then(|| Function::Program(defined.clone()));
        let function = |name| Function::named(sheet, name).or_else(|| itself(name));
        let cells = names().map(|name| Variable { value: value(name), local: false }).collect();
        let mut functions: Vec<_> = names().map(function).collect();
        let run = Run {
            listing: program,
            sheet,
            settings: self.settings,
            limits: self.limits,
            cells,
            functions: &mut functions,
            observer: &mut (),
            line: 0,
            spent: self.spent,
            stored: self.stored,
            depth,
            last: None,
            trace: vec![],
        };
        let outcome = run.run(arguments)?.outcome()?;
        self.trace.extend(outcome.trace_output);
        Ok(outcome.value)
    }
}
