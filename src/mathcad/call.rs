//! Calling a function on the values of its arguments.

use super::arithmetic::{finite, fold, identity, kind, map, sum};
use super::eval::FUNCTION;
use super::failure::{Cause, Fallible};
use super::function::Function;
use super::matrices;
use super::observe::Observer;
use super::sheet::Defined;
use super::state::{Run, Variable};
use super::syntax::{Slot, Span};
use super::value::{Array, Value};
use numbers::scalar::Scalar;

impl<O: Observer> Run<'_, '_, O> {
    /// Returns the value of the function that the name `slot` stands for.
    pub fn call(&mut self, slot: Slot, arguments: &[Value], span: &Span) -> Fallible<Value> {
        let listing = self.listing;
        let name = || listing.names.name(slot).into();
        let result = match &mut self.functions[slot] {
            None => return Err(self.undefined(slot, true, span)),
            Some(Function::Program(program)) => {
                let program = program.clone();
                return self.call_program(&program, arguments);
            }
            Some(Function::Identity) => return self.identity(arguments, span),
            Some(Function::Rows) => one(arguments).map(|x| extent(x).0.into()),
            Some(Function::Cols) => one(arguments).map(|x| extent(x).1.into()),
            Some(Function::Length) => one(arguments).map(|x| extent(x).0.into()),
            Some(Function::Last) => one(arguments).and_then(|v| last(v, self.settings.origin)),
            Some(Function::Mean) => {
                self.spend(size(arguments) as u64)?;
                mean(arguments)
            }
            Some(Function::Sort) => {
                // A comparison for each halving.
                let size = size(arguments) as u64;
                self.room(size as usize)?;
                self.spend(size.saturating_mul(1 + u64::from(size.max(1).ilog2())))?;
                one(arguments).and_then(sort)
            }
            Some(Function::Round) => {
                self.afford(size(arguments))?;
                self.spend(size(arguments) as u64)?;
                round(arguments)
            }
            Some(Function::Min) => return self.extreme(arguments, <f64 as Scalar>::min, span),
            Some(Function::Max) => return self.extreme(arguments, <f64 as Scalar>::max, span),
            Some(Function::Trace) => return self.write_trace(arguments),
            Some(Function::Elementary(function)) => {
                let function = *function;
                self.afford(size(arguments))?;
                self.spend(FUNCTION * size(arguments) as u64)?;
                one(arguments).and_then(|x| each(x, |x| real(function(x), x, &name)))
            }
            Some(Function::Root) => root(arguments, &name).map(Value::Number),
            Some(Function::Log) => log(arguments, &name).map(Value::Number),
            Some(Function::Mod) => {
                numbers(arguments).and_then(|[x, y]| real(x % y, y, &name)).map(Value::Number)
            }
            Some(Function::Factorial) => {
                // So many products, at most.
                self.spend(50)?;
                numbers(arguments).and_then(|[n]| factorial(n, &name)).map(Value::Number)
            }
            Some(Function::Outside(function)) => {
                function(arguments).map_err(|message| Cause::Function { name: name(), message })
            }
            Some(_) => return self.matrices(slot, arguments, span),
        };
        result.map_err(|cause| self.fail(span, cause))
    }

    /// Calls one of the functions of matrices, once there is room and time for it.
    fn matrices(&mut self, slot: Slot, arguments: &[Value], span: &Span) -> Fallible<Value> {
        // Each number is read and written.
        self.afford(size(arguments))?;
        self.spend(size(arguments) as u64)?;
        if let Some(matrix @ Value::Array(_)) = arguments.first() {
            let cubic =
                matches!(self.functions[slot], Some(Function::Lsolve | Function::Determinant));
            self.spend(if cubic { matrices::steps(matrix) } else { 0 })?;
        }
        let result = match &self.functions[slot] {
            Some(Function::Augment) => matrices::join(arguments, false),
            Some(Function::Stack) => matrices::join(arguments, true),
            Some(Function::Lsolve) => two(arguments).and_then(|(a, b)| matrices::lsolve(a, b)),
            Some(Function::Determinant) => one(arguments).and_then(matrices::determinant),
            Some(Function::Submatrix) => submatrix(arguments, self.settings.origin),
            Some(Function::Sum) => one(arguments).and_then(total),
            // ∏ alone.
            _ => Err(Cause::Function {
                name: self.listing.names.name(slot).into(),
                message: "it multiplies over a range, as ∏(i ∈ 1 .. 3, v[i])".into(),
            }),
        };
        result.map_err(|cause| self.fail(span, cause))
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
        let (value, trace) = run.run(arguments)?.into_value()?;
        self.trace.extend(trace);
        Ok(value)
    }

    fn identity(&mut self, arguments: &[Value], span: &Span) -> Fallible<Value> {
        let n = one(arguments).and_then(whole).map_err(|cause| self.fail(span, cause))?;
        self.afford(n.saturating_mul(n))?;
        Ok(identity(n))
    }

    fn extreme(
        &mut self,
        arguments: &[Value],
        choose: fn(f64, f64) -> f64,
        span: &Span,
    ) -> Fallible<Value> {
        self.spend(size(arguments) as u64)?;
        fold(arguments, choose).map_err(|cause| self.fail(span, cause))
    }

    fn write_trace(&mut self, arguments: &[Value]) -> Fallible<Value> {
        // The line is kept twice, as output and as a value; a number takes eight bytes.
        let characters = arguments.iter().map(characters).fold(0, usize::saturating_add);
        self.afford(characters.saturating_mul(2).div_ceil(8))?;
        self.spend(characters as u64)?;
        let line = arguments.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
        let value = Value::Text(line.as_str().into());
        self.stored += value.count();
        self.trace.push(line);
        Ok(value)
    }
}

/// Returns the characters that a value is written in, or more.
fn characters(value: &Value) -> usize {
    // All 17 digits and as many zeros as the exponent asks for.
    let of_number = |x: f64| 24 + Scalar::abs(x).max(f64::MIN_POSITIVE).log10().abs() as usize;
    match value {
        Value::Array(array) => array.entries().iter().map(|x| of_number(*x)).sum(),
        Value::Number(x) => of_number(*x),
        other => 8 * other.count(),
    }
}

fn size(values: &[Value]) -> usize {
    values.iter().map(Value::count).sum()
}

fn one(arguments: &[Value]) -> Result<&Value, Cause> {
    match arguments {
        [argument] => Ok(argument),
        _ => Err(Cause::Arguments { expected: 1, found: arguments.len() }),
    }
}

fn whole(value: &Value) -> Result<usize, Cause> {
    match value {
        Value::Number(n) if *n >= 0.0 && n.fract() == 0.0 => Ok(*n as usize),
        _ => Err(kind("a whole number", value)),
    }
}

fn two(arguments: &[Value]) -> Result<(&Value, &Value), Cause> {
    match arguments {
        [x, y] => Ok((x, y)),
        _ => Err(Cause::Arguments { expected: 2, found: arguments.len() }),
    }
}

/// Returns the arguments, which must be numbers.
fn numbers<const N: usize>(arguments: &[Value]) -> Result<[f64; N], Cause> {
    if arguments.len() != N {
        return Err(Cause::Arguments { expected: N, found: arguments.len() });
    }
    let mut numbers = [0.0; N];
    for (number, argument) in numbers.iter_mut().zip(arguments) {
        *number = argument.number().ok_or_else(|| kind("a number", argument))?;
    }
    Ok(numbers)
}

/// Returns a function's value of a number, or of each number of an array.
fn each(value: &Value, function: impl Fn(f64) -> Result<f64, Cause>) -> Result<Value, Cause> {
    match value {
        Value::Number(x) => function(*x).map(Value::Number),
        Value::Array(array) => map(array.clone(), function),
        other => Err(kind("a number or an array of numbers", other)),
    }
}

/// Returns a function's result, if it is a number that is real.
fn real(result: f64, argument: f64, name: &dyn Fn() -> String) -> Result<f64, Cause> {
    if result.is_nan() {
        Err(Cause::Complex { name: name() })
    } else if result.is_infinite() && name() == "exp" {
        Err(Cause::Overflow { result })
    } else if result.is_infinite() {
        Err(Cause::Domain { name: name(), argument })
    } else {
        Ok(result)
    }
}

/// Returns the number of rows and columns: none of what is no array.
fn extent(value: &Value) -> (usize, usize) {
    match value {
        Value::Array(_) | Value::Nested(_) => value.size(),
        Value::Number(_) | Value::Text(_) => (0, 0),
    }
}

/// Returns the subscript of a column's last entry.
fn last(value: &Value, origin: i32) -> Result<Value, Cause> {
    match (value, value.size()) {
        (Value::Array(_) | Value::Nested(_), (rows, 1)) if rows > 0 => {
            Ok(Value::Number(f64::from(origin) + rows as f64 - 1.0))
        }
        _ => Err(kind("a column", value)),
    }
}

/// Returns the mean of all numbers of all arguments, which are added one after another.
fn mean(arguments: &[Value]) -> Result<Value, Cause> {
    let total = fold(arguments, |sum, x| sum + x)?;
    let mean = total.number().map(|total| total / size(arguments) as f64);
    mean.map_or(Ok(total), |mean| finite(mean).map(Value::Number))
}

fn sort(value: &Value) -> Result<Value, Cause> {
    match value {
        Value::Array(column) if column.cols() == 1 => {
            let mut entries = column.entries().to_vec();
            entries.sort_by(f64::total_cmp);
            Ok(Array::column(entries).into())
        }
        _ => Err(kind("a column of numbers", value)),
    }
}

/// Rounds a number, or each number of an array, halves away from 0, to so many decimal places.
fn round(arguments: &[Value]) -> Result<Value, Cause> {
    let (x, places) = match arguments {
        [x] => (x, 0.0),
        _ => {
            let (x, places) = two(arguments)?;
            let [places] = numbers(std::slice::from_ref(places))?;
            (x, places)
        }
    };
    let scale = 10_f64.powf(places);
    each(x, |x| finite((x * scale).round() / scale))
}

fn root(arguments: &[Value], name: &dyn Fn() -> String) -> Result<f64, Cause> {
    if arguments.len() == 1 {
        return numbers(arguments).and_then(|[x]| real(x.sqrt(), x, name));
    }
    let [n, x] = numbers(arguments)?;
    let root = match x < 0.0 && n % 2.0 != 0.0 && n.fract() == 0.0 {
        true => -(-x).powf(1.0 / n),
        false => x.powf(1.0 / n),
    };
    // The nearest whole number, where it is the root.
    let whole = root.round();
    real(if whole.powf(n) == x { whole } else { root }, x, name)
}

fn log(arguments: &[Value], name: &dyn Fn() -> String) -> Result<f64, Cause> {
    if arguments.len() == 1 {
        return numbers(arguments).and_then(|[x]| real(x.log10(), x, name));
    }
    let [x, base] = numbers(arguments)?;
    let log = x.ln() / base.ln();
    // The nearest whole number, where it is the logarithm.
    let whole = log.round();
    real(if base.powf(whole) == x { whole } else { log }, x, name)
}

fn factorial(n: f64, name: &dyn Fn() -> String) -> Result<f64, Cause> {
    if n < 0.0 || n.fract() != 0.0 {
        return Err(Cause::Domain { name: name(), argument: n });
    }
    finite((1..=n.min(200.0) as u32).fold(1.0, |product, k| product * f64::from(k)))
}

fn submatrix(arguments: &[Value], origin: i32) -> Result<Value, Cause> {
    let Some((array, places)) = arguments.split_first() else {
        return Err(Cause::Arguments { expected: 5, found: 0 });
    };
    matrices::part(array, numbers(places)?, origin)
}

fn total(value: &Value) -> Result<Value, Cause> {
    match value {
        Value::Array(a) => finite(sum(a.entries().iter().copied())).map(Value::Number),
        other => Err(kind("an array of numbers", other)),
    }
}
