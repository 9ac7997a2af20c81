//! The values of expressions.

use super::arithmetic::{calculate, compare, cost, kind, map, negative, operate, power, transpose};
use super::entry::entry_of;
use super::failure::{Cause, Fallible, Subscripts};
use super::function::{Builtin, FUNCTION, Function, Meaning};
use super::matrices;
use super::observe::{Observer, Operand};
use super::settings::Conjunction;
use super::state::Run;
use super::syntax::{Comparison, Expr, Kind, Operation, Range, Reference, Slot, Span};
use super::value::{Array, Grid, Value};

/// The largest power of a matrix: numbers up to it are whole or not.
const LARGEST_POWER: f64 = 9_007_199_254_740_992.0;

impl<O: Observer> Run<'_, '_, O> {
    pub fn eval(&mut self, expr: &Expr) -> Fallible<Value> {
        self.spend(1)?;
        match &expr.kind {
            Kind::Number(x) => Ok(Value::Number(*x)),
            Kind::Text(text) => Ok(Value::Text(text.clone())),
            Kind::Read(reference) => {
                let subscripts = self.subscripts(reference)?;
                self.read(reference, subscripts)
            }
            Kind::Group(x) => self.eval(x),
            Kind::Entry { of, subscripts } => self.entry_of(of, subscripts, &expr.span),
            Kind::Array { entries, cols } => self.array(entries, *cols),
            Kind::Magnitude(x) => {
                let x = self.eval(x)?;
                self.spend(matrices::steps(&x))?;
                matrices::magnitude(&x).map_err(|cause| self.fail(&expr.span, cause))
            }
            Kind::Not(x) => Ok(truth_value(!self.truth(x)?)),
            Kind::Power(x, y) => {
                let (x, y) = (self.eval(x)?, self.number(y)?);
                self.spend(FUNCTION)?;
                let power = match x {
                    Value::Number(x) => power(x, y).map(Value::Number),
                    matrix if y == -1.0 => {
                        self.afford(matrix.count())?;
                        // The elimination, and twice as much for the unit columns.
                        self.spend(3 * matrices::steps(&matrix))?;
                        matrices::inverse(&matrix)
                    }
                    Value::Array(column) if column.cols() == 1 => {
                        self.afford(column.rows())?;
                        self.spend(FUNCTION * column.rows() as u64)?;
                        map(column, |x| power(x, y))
                    }
                    matrix if (1.0..=LARGEST_POWER).contains(&y) && y.fract() == 0.0 => {
                        return self.repeated(matrix, y, &expr.span);
                    }
                    other => Err(kind(
                        "a number, a column, or a matrix to a power of −1, 1, 2, ...",
                        &other,
                    )),
                };
                power.map_err(|cause| self.fail(&expr.span, cause))
            }
            Kind::Column(x, j) => {
                let (x, j) = (self.eval(x)?, self.number(j)?);
                self.afford(x.count())?;
                let column = matrices::column(&x, j, self.settings.origin);
                column.map_err(|cause| self.fail(&expr.span, cause))
            }
            Kind::Series { function, name, parts } => {
                self.series(*function, *name, parts, &expr.span)
            }
            Kind::Negative(x) => self.change(x, &expr.span, negative),
            Kind::Transpose(x) => self.change(x, &expr.span, transpose),
            Kind::Arithmetic(operation, x, y) => self.arithmetic(*operation, x, y, &expr.span),
            Kind::Compare(comparison, x, y) => {
                let left = self.eval(x)?;
                self.compared(*comparison, (x, &left), y).map(|(truth, _)| truth_value(truth))
            }
            Kind::Chain(x, rest) => self.chain(x, rest).map(truth_value),
            Kind::All(operands) => self.decide(operands, false, Some(&expr.span)),
            Kind::Any(operands) => self.decide(operands, true, None),
            Kind::Call(name, _) if self.functions[*name].is_none() => {
                Err(self.undefined(*name, true, &expr.span))
            }
            Kind::Call(name, arguments) if self.is_vectorize(*name) && arguments.len() == 1 => {
                self.vectorized(&arguments[0])
            }
            Kind::Program(block) => self.inner(block, &expr.span),
            Kind::Call(name, arguments) => {
                let arguments = self.arguments(arguments)?;
                self.spend(FUNCTION)?;
                self.call(*name, &arguments, &expr.span)
            }
            Kind::If(parts) => {
                let [condition, x, y] = &**parts;
                if self.truth(condition)? { self.eval(x) } else { self.eval(y) }
            }
        }
    }

    pub fn number(&mut self, expr: &Expr) -> Fallible<f64> {
        match self.eval(expr)? {
            Value::Number(x) => Ok(x),
            other => Err(self.fail(&expr.span, kind("a number", &other))),
        }
    }

    /// Compares a value with that of an expression: a number with a number, a string with a string by
    /// the codes of their characters. Returns the other value too.
    fn compared(
        &mut self,
        comparison: Comparison,
        (at, left): (&Expr, &Value),
        right: &Expr,
    ) -> Fallible<(bool, Value)> {
        let expected = match left {
            Value::Number(_) => "a number",
            Value::Text(_) => "a string",
            other => return Err(self.fail(&at.span, kind("a number", other))),
        };
        let other = self.eval(right)?;
        let truth = match (left, &other) {
            (Value::Number(x), Value::Number(y)) => compare(comparison, *x, *y, self.settings),
            (Value::Text(x), Value::Text(y)) => {
                self.spend(left.count() as u64)?;
                comparison.is_true_of(x.cmp(y))
            }
            _ => return Err(self.fail(&right.span, kind(expected, &other))),
        };
        Ok((truth, other))
    }

    /// Returns whether all comparisons of a chain are true; after a false one the rest is evaluated
    /// only if `∧` evaluates everything.
    fn chain(&mut self, first: &Expr, rest: &[(Comparison, Expr)]) -> Fallible<bool> {
        let (mut at, mut left, mut all) = (first, self.eval(first)?, true);
        for (comparison, right) in rest {
            if !all && self.settings.conjunction != Conjunction::Eager {
                break;
            }
            let (truth, value) = self.compared(*comparison, (at, &left), right)?;
            (at, left, all) = (right, value, all && truth);
        }
        Ok(all)
    }

    /// Returns whether an expression is true: everything but 0 is.
    pub fn truth(&mut self, expr: &Expr) -> Fallible<bool> {
        Ok(self.number(expr)? != 0.0)
    }

    /// Returns the subscripts of a name, or nothing where it has none.
    pub fn subscripts(&mut self, reference: &Reference) -> Fallible<Option<Subscripts>> {
        let Some(row) = &reference.row else {
            return Ok(None);
        };
        let row = self.number(row)?;
        let col = reference.col.as_ref().map(|col| self.number(col)).transpose()?;
        Ok(Some(Subscripts { row, col }))
    }

    /// Checks that an array may hold what goes `depth` deep.
    pub fn check_nesting(&self, depth: usize) -> Fallible<()> {
        if depth < self.limits.depth {
            return Ok(());
        }
        let limit = self.limits.depth as u64;
        Err(self.fail_line(Cause::Limit { limit, of: "arrays within arrays" }))
    }

    /// Returns the values of arguments; each counts as stored while the next is evaluated.
    pub fn arguments(&mut self, arguments: &[Expr]) -> Fallible<Vec<Value>> {
        self.held(arguments, Self::eval)
    }

    fn held<'e>(
        &mut self,
        exprs: impl IntoIterator<Item = &'e Expr>,
        eval: fn(&mut Self, &Expr) -> Fallible<Value>,
    ) -> Fallible<Vec<Value>> {
        let stored = self.stored;
        let values = exprs.into_iter().map(|expr| {
            let value = eval(self, expr)?;
            self.room(value.count())?;
            self.stored += value.count();
            Ok(value)
        });
        let values = values.collect();
        self.stored = stored;
        values
    }

    fn arithmetic(
        &mut self,
        operation: Operation,
        x: &Expr,
        y: &Expr,
        span: &Span,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        // The left operand counts as stored while the right one is evaluated.
        self.stored += x.count();
        let y = self.eval(y);
        self.stored -= x.count();
        self.operate(operation, x, y?, span)
    }

    fn operate(
        &mut self,
        operation: Operation,
        x: Value,
        y: Value,
        span: &Span,
    ) -> Fallible<Value> {
        let result = if let (Value::Number(x), Value::Number(y)) = (&x, &y) {
            calculate(operation, *x, *y, self.settings).map(Value::Number)
        } else {
            let (steps, entries) = cost(operation, &x, &y);
            self.room(entries)?;
            self.spend(steps)?;
            operate(operation, x, y, self.settings)
        };
        result.map_err(|cause| self.fail(span, cause))
    }

    fn change(
        &mut self,
        x: &Expr,
        span: &Span,
        by: fn(Value) -> Result<Value, Cause>,
    ) -> Fallible<Value> {
        let x = self.eval(x)?;
        self.afford(x.count())?;
        by(x).map_err(|cause| self.fail(span, cause))
    }

    fn array(&mut self, entries: &[Expr], cols: usize) -> Fallible<Value> {
        let rows = entries.len() / cols;
        let mut numbers = Vec::with_capacity(entries.len());
        for (k, entry) in entries.iter().enumerate() {
            match self.eval(entry)? {
                Value::Number(x) => numbers.push(x),
                other => {
                    let mut values: Vec<_> = numbers.into_iter().map(Value::Number).collect();
                    values.push(other);
                    values.extend(self.arguments(&entries[k + 1..])?);
                    self.afford(values.iter().map(Value::count).sum())?;
                    let depth = values.iter().map(Value::depth).max().unwrap_or(0);
                    self.check_nesting(depth)?;
                    return Ok(Value::grid(Grid::from_fn(rows, cols, |i, j| {
                        values[i * cols + j].clone()
                    })));
                }
            }
        }
        Ok(Array::from_rows(cols, numbers).into())
    }

    fn entry_of(&mut self, of: &Expr, subscripts: &[Expr], span: &Span) -> Fallible<Value> {
        let value = self.eval(of)?;
        let row = self.number(&subscripts[0])?;
        let col = subscripts.get(1).map(|col| self.number(col)).transpose()?;
        let name = || self.place(&of.span).text.into();
        let entry = entry_of(&value, Subscripts { row, col }, self.settings.origin, &name);
        entry.map_err(|cause| self.fail(span, cause))
    }

    /// Returns a matrix to a whole power by repeated squaring, the smallest square on the right.
    fn repeated(&mut self, matrix: Value, power: f64, span: &Span) -> Fallible<Value> {
        let (mut rest, mut square, mut product) = (power as u64, matrix, None);
        loop {
            if rest % 2 == 1 {
                product = Some(match product {
                    None => square.clone(),
                    Some(product) => {
                        self.operate(Operation::Multiply, square.clone(), product, span)?
                    }
                });
            }
            rest /= 2;
            match product {
                Some(product) if rest == 0 => return Ok(product),
                _ => {
                    square = self.operate(Operation::Multiply, square.clone(), square, span)?;
                }
            }
        }
    }

    /// Returns a sum or product of terms, added or multiplied one after another from the first; the
    /// variable is the series' own.
    fn series(
        &mut self,
        function: Slot,
        name: Slot,
        parts: &[Expr],
        span: &Span,
    ) -> Fallible<Value> {
        let operation = match &self.functions[function] {
            Some(Function::Builtin(Builtin { name: "∑", .. })) => Operation::Add,
            Some(Function::Builtin(Builtin { name: "∏", .. })) => Operation::Multiply,
            _ => return Err(self.undefined(function, true, span)),
        };
        let numbers: Box<dyn Fn(usize) -> Option<Value>> = match parts {
            [from, to, _] => {
                let (from, to) = (self.number(from)?, self.number(to)?);
                let number = move |turn: usize| from + turn as f64;
                Box::new(move |turn| (number(turn) <= to).then(|| Value::Number(number(turn))))
            }
            [range, _] if self.range_variable(std::slice::from_ref(range)).is_some() => {
                let turns = self.turns(&Range::Over(vec![range.clone()]))?;
                Box::new(move |turn| turns.value(turn))
            }
            _ => {
                let construct = "a series over what is no range variable".into();
                return Err(self.fail(span, Cause::Unsupported { construct }));
            }
        };
        let term = parts.last().expect("a series has a term");
        let outer = self.cells[name].value.take();
        let series = self.terms(operation, name, &*numbers, term, span);
        self.cells[name].value = outer;
        series.map(Value::Number)
    }

    fn terms(
        &mut self,
        operation: Operation,
        name: Slot,
        numbers: &dyn Fn(usize) -> Option<Value>,
        term: &Expr,
        span: &Span,
    ) -> Fallible<f64> {
        let mut result = None;
        let mut turn = 0;
        while let Some(number) = numbers(turn) {
            self.spend(1)?;
            self.cells[name].value = Some(number);
            let term = self.number(term)?;
            let next = match result {
                None => Ok(term),
                Some(result) => calculate(operation, result, term, self.settings),
            };
            result = Some(next.map_err(|cause| self.fail(span, cause))?);
            turn += 1;
        }
        Ok(result.unwrap_or(if operation == Operation::Add { 0.0 } else { 1.0 }))
    }

    fn is_vectorize(&self, name: Slot) -> bool {
        let function = self.functions[name].as_ref();
        matches!(function, Some(Function::Builtin(Builtin { meaning: Meaning::Vectorize, .. })))
    }

    /// Returns an expression's value where each operation and function takes its arrays entry by entry;
    /// they must be of one size.
    fn vectorized(&mut self, expr: &Expr) -> Fallible<Value> {
        self.spend(1)?;
        match &expr.kind {
            Kind::Group(x) => return self.vectorized(x),
            Kind::Number(_)
            | Kind::Text(_)
            | Kind::Read(_)
            | Kind::Entry { .. }
            | Kind::Array { .. }
            | Kind::Column(..) => return self.eval(expr),
            Kind::Call(name, _) if self.functions[*name].is_none() => {
                return Err(self.undefined(*name, true, &expr.span));
            }
            Kind::Magnitude(_)
            | Kind::Negative(_)
            | Kind::Power(..)
            | Kind::Arithmetic(..)
            | Kind::Compare(..)
            | Kind::Call(..) => {}
            Kind::Not(_)
            | Kind::Transpose(_)
            | Kind::Chain(..)
            | Kind::All(_)
            | Kind::Any(_)
            | Kind::If(_)
            | Kind::Series { .. }
            | Kind::Program(_) => {
                let construct = format!("vectorize of `{}`", self.place(&expr.span).text);
                return Err(self.fail(&expr.span, Cause::Unsupported { construct }));
            }
        }
        let operands = self.held(expr.parts(), Self::vectorized)?;
        let mut arrays = operands.iter().filter(|operand| operand.number().is_none());
        let Some(first) = arrays.next() else { return self.applied(expr, &operands) };
        if let Some(other) = arrays.find(|other| other.size() != first.size()) {
            let size = |a: &Value| format!("{} x {}", a.size().0, a.size().1);
            let (left, right) = (size(first), size(other));
            return Err(self.fail(&expr.span, Cause::Sizes { operation: "→", left, right }));
        }
        let (rows, cols) = first.size();
        self.afford(rows * cols)?;
        let mut entries = Vec::with_capacity(rows * cols);
        for (i, j) in (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j))) {
            let at = operands.iter().map(|x| x.entry(i, j).unwrap_or_else(|| x.clone()));
            let at: Vec<Value> = at.collect();
            entries.push(self.applied(expr, &at)?);
        }
        Ok(Value::grid(Grid::from_rows(cols.max(1), entries)))
    }

    /// Returns what an operation or function that [`Self::vectorized`] takes makes of numbers.
    fn applied(&mut self, expr: &Expr, operands: &[Value]) -> Fallible<Value> {
        self.spend(FUNCTION)?;
        let numbers: Option<Vec<f64>> = operands.iter().map(Value::number).collect();
        let result = match (&expr.kind, numbers.as_deref()) {
            (Kind::Call(name, _), _) => return self.call(*name, operands, &expr.span),
            (Kind::Magnitude(_), Some([x])) => Ok(x.abs()),
            (Kind::Negative(_), Some([x])) => Ok(-x),
            (Kind::Power(..), Some([x, y])) => power(*x, *y),
            (Kind::Arithmetic(operation, ..), Some([x, y])) => {
                calculate(*operation, *x, *y, self.settings)
            }
            (Kind::Compare(comparison, ..), Some([x, y])) => {
                return Ok(truth_value(compare(*comparison, *x, *y, self.settings)));
            }
            (_, _) => Err(kind("a number or an array of numbers", &operands[0])),
        };
        result.map(Value::Number).map_err(|cause| self.fail(&expr.span, cause))
    }

    /// Returns what the operands of an `∧` or `∨` decide together, by the worksheet's method of
    /// evaluating `∧`: one that is `decisive` decides alone. An `∧` has its `span` for the observer.
    fn decide(
        &mut self,
        operands: &[Expr],
        decisive: bool,
        span: Option<&Span>,
    ) -> Fallible<Value> {
        let method = self.settings.conjunction;
        let (mut decided, mut failure, mut seen) = (false, None, vec![]);
        for operand in operands {
            if method == Conjunction::LeftToRight && decided {
                break;
            }
            let truth = match self.truth(operand) {
                Ok(truth) => Some(truth),
                Err(error) if method != Conjunction::Guarded || error.is_limit() => {
                    return Err(error);
                }
                Err(error) => {
                    self.spend_on(&error)?;
                    failure.get_or_insert(error);
                    None
                }
            };
            decided |= truth == Some(decisive);
            if O::ACTIVE {
                seen.push(truth);
            }
        }
        if O::ACTIVE
            && let Some(span) = span
        {
            self.report_conjunction(operands, &seen, span);
        }
        match failure {
            Some(failure) if !decided => Err(failure),
            _ => Ok(truth_value(decided == decisive)),
        }
    }

    fn report_conjunction(&mut self, operands: &[Expr], seen: &[Option<bool>], span: &Span) {
        let seen = seen.iter().copied().chain(std::iter::repeat(None));
        let operand = |(x, held): (&Expr, _)| Operand { text: self.place(&x.span).text, held };
        let operands: Vec<_> = operands.iter().zip(seen).map(operand).collect();
        self.observer.conjunction(self.place(span), &operands);
    }
}

fn truth_value(truth: bool) -> Value {
    Value::Number(if truth { 1.0 } else { 0.0 })
}
