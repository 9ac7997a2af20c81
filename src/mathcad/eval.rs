//! Running a program: its statements, their expressions, and the functions that they call.
//!
//! What fails has the place of the innermost expression that could not be evaluated; a limit has that of
//! the line.

use super::arithmetic::{calculate, compare, cost, kind, map, negative, operate, power, transpose};
use super::failure::{Cause, Fallible, Subscripts};
use super::function::{Builtin, FUNCTION, Function, Meaning, elementary};
use super::matrices;
use super::settings::Conjunction;
use super::sheet::{Defined, Numbers};
use super::state::{Ended, Execution};
use super::syntax::{
    Comparison, Expr, Kind, Operation, Operator, Range, Slot, Span, Statement, Step,
};
use super::value::{Array, Grid, Value};

/// The largest power of a matrix: numbers up to it are whole or not.
const LARGEST_POWER: f64 = 9_007_199_254_740_992.0;

/// What part of a step a range may pass its end by: rounding's. At least 1.1e-13 is Mathcad's (see
/// README.md).
const RANGE_END: f64 = 1e-12;

/// Where a program goes on after a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flow {
    Next,
    Break,
    Continue,
    Return,
}

/// The values that a loop or a series gives its variable.
enum Turns {
    /// From the first number by the step, up or down to `end`.
    Span {
        from: f64,
        step: f64,
        end: f64,
    },
    Over(Value),
}

impl Turns {
    fn value(&self, turn: usize) -> Option<Value> {
        match self {
            Turns::Span { from, step, end } => {
                let x = from + step * turn as f64;
                (if *step > 0.0 { x <= *end } else { x >= *end }).then_some(Value::Number(x))
            }
            Turns::Over(value @ (Value::Number(_) | Value::Text(_))) => {
                (turn == 0).then(|| value.clone())
            }
            Turns::Over(array) => {
                let rows = array.size().0.max(1);
                array.entry(turn % rows, turn / rows)
            }
        }
    }
}

impl Execution<'_, '_> {
    /// Runs the program to its end, and returns what it leaves behind.
    pub fn run(mut self, arguments: &[Value]) -> Fallible<Ended> {
        let (expected, found) = (self.listing.parameters.len(), arguments.len());
        if expected != found {
            return Err(self.fail_line(Cause::Arguments { expected, found }));
        }
        for (&slot, argument) in self.listing.parameters.iter().zip(arguments) {
            self.cells[slot].value = Some(argument.clone());
        }
        let values = self.cells.iter().filter_map(|cell| cell.value.as_ref());
        self.stored += values.map(Value::count).sum::<usize>();
        self.room(0)?;
        if let Flow::Break | Flow::Continue = self.block(&self.listing.program)? {
            return Err(self.fail_line(Cause::OutsideLoop));
        }
        let Some(value) = self.last.take() else {
            return Err(self.fail_line(Cause::NoValue));
        };
        let names = self.listing.names.all().zip(self.cells);
        let locals = names.filter(|(_, cell)| cell.local);
        let locals = locals.filter_map(|(name, cell)| Some((name.into(), cell.value?))).collect();
        Ok(Ended { value, locals, trace_output: self.trace })
    }

    /// Returns the value of a program within an expression, whose names are those of the program around
    /// it.
    fn inner(&mut self, block: &[Statement]) -> Fallible<Value> {
        let outer = self.last.take();
        let flow = self.block(block);
        let value = std::mem::replace(&mut self.last, outer);
        match (flow?, value) {
            (Flow::Next, Some(value)) => Ok(value),
            (Flow::Next, None) => Err(Cause::NoValue.into()),
            (Flow::Break | Flow::Continue | Flow::Return, _) => {
                let construct = "break, continue or return in a program within an expression";
                Err(Cause::Unsupported { construct: construct.into() }.into())
            }
        }
    }

    fn block(&mut self, block: &[Statement]) -> Fallible<Flow> {
        // Whether an `if` was true since the block's last `otherwise`.
        let mut held = false;
        for statement in block {
            let flow = self.statement(statement, &mut held)?;
            if flow != Flow::Next {
                return Ok(flow);
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &Statement, held: &mut bool) -> Fallible<Flow> {
        self.line = statement.line;
        if let Some(recorder) = &mut self.recorder {
            recorder.begin(&self.listing.lines[self.line]);
        }
        self.spend(1)?;
        let blocks = &statement.blocks;
        match &statement.step {
            Step::While { condition } => return self.repeat_while(condition, &blocks[0]),
            Step::Otherwise => {
                return if std::mem::take(held) { Ok(Flow::Next) } else { self.block(&blocks[0]) };
            }
            Step::Try => {
                return match self.block(&blocks[0]) {
                    Err(failure) if !failure.is_limit() => {
                        self.spend_on(&failure)?;
                        self.block(&blocks[1])
                    }
                    outcome => outcome,
                };
            }
            _ if !self.admits(statement, held)? => return Ok(Flow::Next),
            Step::For { name, range } => return self.repeat(*name, range, &blocks[0]),
            Step::Block => return self.block(&blocks[0]),
            Step::Break => return Ok(Flow::Break),
            Step::Continue => return Ok(Flow::Continue),
            Step::Assign { target, value } => {
                let span = &value.span;
                let value = self.eval(value)?;
                // Lets go of an array first: shared with the value of the last statement, it would be
                // copied.
                self.last = None;
                self.assign(target, &value, span)?;
                self.last = Some(value);
            }
            Step::Evaluate { value } => self.last = Some(self.eval(value)?),
            Step::Return { value } => {
                self.last = Some(self.eval(value)?);
                return Ok(Flow::Return);
            }
        }
        Ok(Flow::Next)
    }

    /// Returns whether the statement's condition is true; one without a condition always runs.
    fn admits(&mut self, statement: &Statement, held: &mut bool) -> Fallible<bool> {
        let Some(condition) = &statement.guard else { return Ok(true) };
        let truth = self.condition(condition)?;
        *held |= truth;
        if !truth && self.settings.last_if_is_zero {
            self.last = Some(Value::Number(0.0));
        }
        Ok(truth)
    }

    fn condition(&mut self, condition: &Expr) -> Fallible<bool> {
        let truth = self.truth(condition)?;
        if let Some(recorder) = &mut self.recorder {
            recorder.on(&self.listing.lines[self.line]).held = Some(truth);
        }
        Ok(truth)
    }

    fn repeat_while(&mut self, condition: &Expr, body: &[Statement]) -> Fallible<Flow> {
        let line = self.line;
        while self.condition(condition)? {
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => break,
                Flow::Return => return Ok(Flow::Return),
            }
            self.line = line;
            self.spend(1)?;
        }
        Ok(Flow::Next)
    }

    /// Runs the body for each number of the range, which is fixed on entry.
    fn repeat(&mut self, name: Slot, range: &Range, body: &[Statement]) -> Fallible<Flow> {
        let line = self.line;
        let turns = self.turns(range)?;
        let mut turn = 0;
        while let Some(value) = turns.value(turn) {
            self.line = line;
            self.spend(1)?;
            self.store(name, value)?;
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => break,
                Flow::Return => return Ok(Flow::Return),
            }
            turn += 1;
        }
        Ok(Flow::Next)
    }

    /// Returns the values of a loop's variable.
    fn turns(&mut self, range: &Range) -> Fallible<Turns> {
        let Some(to) = &range.to else {
            return match self.range_variable(&range.values) {
                Some(numbers) => self.span(numbers),
                None => self.values(&range.values).map(Turns::Over),
            };
        };
        let from = self.number(&range.values[0])?;
        let second = range.values.get(1).map(|second| self.number(second)).transpose()?;
        let to = self.number(to)?;
        self.span((from, second, to))
    }

    /// Returns the numbers of a range.
    ///
    /// # Errors
    /// Its step leads away from its end.
    ///
    /// ```
    /// assert_eq!(plane_contact_mathcad::evaluate("for i ∈ 0, 0.5 .. 1.7\n  a[2·i+1] ← i\na").unwrap().to_string(), "0; 0.5; 1; 1.5");
    /// assert_eq!(plane_contact_mathcad::evaluate("for i ∈ 3 .. 1\n  a[4−i] ← i\na").unwrap().to_string(), "3; 2; 1");
    /// ```
    fn span(&self, (from, second, to): Numbers) -> Fallible<Turns> {
        let step = match second {
            Some(second) => second - from,
            None if from <= to || self.settings.descending_is_empty => 1.0,
            None => -1.0,
        };
        if second.is_none() || (to - from) * step > 0.0 || to == from && step != 0.0 {
            return Ok(Turns::Span { from, step, end: to + RANGE_END * step });
        }
        Err(self.fail_line(Cause::Range { from, second: second.unwrap_or(from), to }))
    }

    /// Returns the numbers of the worksheet's range variable, if a loop runs over one.
    fn range_variable(&self, values: &[Expr]) -> Option<Numbers> {
        let [value] = values else { return None };
        let name = value.name()?;
        match self.cells[name].value {
            Some(_) => None,
            None => self.sheet.range(self.listing.names.name(name)),
        }
    }

    /// Returns what a loop runs over: a value, or the entries of several as one column.
    fn values(&mut self, values: &[Expr]) -> Fallible<Value> {
        let mut entries = self.held(values, Self::eval)?;
        let count = entries.iter().map(Value::count).sum();
        self.afford(count)?;
        if entries.len() == 1 {
            return Ok(entries.remove(0));
        }
        self.spend(FUNCTION * count as u64)?;
        let entries = entries.into_iter().map(Turns::Over);
        let entries = entries.flat_map(|turns| (0..).map_while(move |turn| turns.value(turn)));
        let entries: Vec<Value> = entries.collect();
        self.check_nesting(entries.iter().map(Value::depth).max().unwrap_or(0))?;
        Ok(Value::grid(Grid::column(entries)))
    }

    /// Assigns a value to a name or to an entry; or its entries to names that stand as they do, or to a
    /// column of an array. It is that of an expression at `span`.
    fn assign(&mut self, target: &Expr, value: &Value, span: &Span) -> Fallible<()> {
        match target.kind {
            Kind::Name(name) => self.store(name, value.clone()),
            Kind::Array { cols } => {
                let rows = target.parts.len() / cols;
                let entries = self.spread(value, (rows, cols), span)?;
                let names = target.parts.iter().filter_map(Expr::name);
                names.zip(entries).try_for_each(|(name, entry)| self.store(name, entry))
            }
            Kind::Apply(Operator::Column) => self.assign_column(target, value, span),
            // The parser lets nothing else be assigned to than these and an entry.
            _ => {
                let subscripts = self.subscripts(target)?;
                self.write_to(target, subscripts, value.clone())
            }
        }
    }

    fn assign_column(&mut self, target: &Expr, value: &Value, span: &Span) -> Fallible<()> {
        let held = target.parts[0].name().and_then(|name| self.cells[name].value.as_ref());
        let held = held.filter(|held| !matches!(held, Value::Number(_) | Value::Text(_)));
        let rows = held.unwrap_or(value).size().0;
        let entries = self.spread(value, (rows, 1), span)?;
        let col = Some(self.number(&target.parts[1])?);
        let origin = f64::from(self.settings.origin);
        entries.into_iter().enumerate().try_for_each(|(k, entry)| {
            self.write_to(target, Subscripts { row: origin + k as f64, col }, entry)
        })
    }

    fn write_to(&mut self, target: &Expr, subscripts: Subscripts, value: Value) -> Fallible<()> {
        let name = target.parts[0].name().expect("an entry that is assigned to has a name");
        let written = self.write(name, subscripts, value);
        written.map_err(|failure| self.placed(failure, &target.span))
    }

    /// Returns the entries of a value that has so many rows and columns.
    fn spread(
        &self,
        value: &Value,
        (rows, cols): (usize, usize),
        span: &Span,
    ) -> Fallible<Vec<Value>> {
        let entries = matrices::spread(value, rows, cols).map_err(|why| self.fail(span, why))?;
        self.afford(value.count())?;
        Ok(entries)
    }

    fn eval(&mut self, expr: &Expr) -> Fallible<Value> {
        self.spend(1)?;
        self.value_of(expr).map_err(|failure| self.placed(failure, &expr.span))
    }

    fn value_of(&mut self, expr: &Expr) -> Fallible<Value> {
        let parts = expr.parts.as_slice();
        match &expr.kind {
            // By itself: to clone a value asks whether it is shared.
            Kind::Literal(Value::Number(x)) => Ok(Value::Number(*x)),
            Kind::Literal(value) => Ok(value.clone()),
            Kind::Name(name) => self.read(*name, None),
            Kind::Group => self.eval(&parts[0]),
            Kind::Array { cols } => self.array(parts, *cols),
            Kind::Apply(operator) => self.applied(*operator, expr),
            Kind::Chain(comparisons) => self.compared(comparisons, parts).map(truth_value),
            Kind::Call(name) => match (&self.functions[*name], parts) {
                (None, _) => Err(self.undefined(*name, true).into()),
                (Some(Function::Builtin(Builtin { meaning: Meaning::Vectorize, .. })), [x]) => {
                    self.vectorized(x)
                }
                (Some(_), arguments) => {
                    let arguments = self.held(arguments, Self::eval)?;
                    self.spend(FUNCTION)?;
                    self.call(*name, &arguments)
                }
            },
            Kind::If => {
                let chosen = if self.truth(&parts[0])? { &parts[1] } else { &parts[2] };
                self.eval(chosen)
            }
            Kind::Series { function, name } => self.series(*function, *name, parts),
            Kind::Program(block) => self.inner(block),
        }
    }

    /// Returns what an operator makes of its operands.
    #[inline]
    fn applied(&mut self, operator: Operator, expr: &Expr) -> Fallible<Value> {
        let operands = expr.parts.as_slice();
        match operator {
            Operator::All => self.decide(operands, false),
            Operator::Any => self.decide(operands, true),
            Operator::Not => Ok(truth_value(!self.truth(&operands[0])?)),
            Operator::Compare(comparison) => {
                self.compared(&[comparison], operands).map(truth_value)
            }
            Operator::Calculate(operation) => {
                let x = self.eval(&operands[0])?;
                // The left operand counts as stored while the right one is evaluated.
                self.stored += x.count();
                let y = self.eval(&operands[1]);
                self.stored -= x.count();
                self.operate(operation, x, y?)
            }
            Operator::Negative => {
                let x = self.eval(&operands[0])?;
                self.afford(x.count())?;
                Ok(negative(x)?)
            }
            Operator::Power => {
                let (x, y) = (self.eval(&operands[0])?, self.number(&operands[1])?);
                self.raised(x, y)
            }
            Operator::Transpose => {
                let x = self.eval(&operands[0])?;
                self.afford(x.count())?;
                Ok(transpose(x)?)
            }
            Operator::Entry => {
                if let Some(name) = operands[0].name() {
                    let subscripts = self.subscripts(expr)?;
                    return self.read(name, Some(subscripts));
                }
                let (value, subscripts) = (self.eval(&operands[0])?, self.subscripts(expr)?);
                let name = || self.text(&operands[0].span).into();
                Ok(matrices::entry(&value, subscripts, self.settings.origin, &name)?)
            }
            Operator::Column => {
                let (x, j) = (self.eval(&operands[0])?, self.number(&operands[1])?);
                self.afford(x.count())?;
                Ok(matrices::column(&x, j, self.settings.origin)?)
            }
            Operator::Magnitude => {
                let x = self.eval(&operands[0])?;
                self.spend(matrices::steps(&x))?;
                Ok(matrices::magnitude(&x)?)
            }
        }
    }

    /// Returns a value to a power.
    fn raised(&mut self, x: Value, y: f64) -> Fallible<Value> {
        self.spend(FUNCTION)?;
        Ok(match x {
            Value::Number(x) => Value::Number(power(x, y)?),
            matrix if y == -1.0 => {
                self.afford(matrix.count())?;
                // The elimination, and twice as much for the unit columns.
                self.spend(3 * matrices::steps(&matrix))?;
                matrices::inverse(&matrix)?
            }
            Value::Array(column) if column.cols() == 1 => {
                self.afford(column.rows())?;
                self.spend(FUNCTION * column.rows() as u64)?;
                map(column, |x| power(x, y))?
            }
            matrix if (1.0..=LARGEST_POWER).contains(&y) && y.fract() == 0.0 => {
                self.repeated(matrix, y)?
            }
            other => {
                let expected = "a number, a column, or a matrix to a power of −1, 1, 2, ...";
                return Err(kind(expected, &other).into());
            }
        })
    }

    fn number(&mut self, expr: &Expr) -> Fallible<f64> {
        match self.eval(expr)? {
            Value::Number(x) => Ok(x),
            other => Err(self.fail(&expr.span, kind("a number", &other))),
        }
    }

    /// Returns whether the comparisons of each operand with the next are all true; after a false one the rest
    /// is evaluated only if `∧` evaluates everything. A number is compared with a number, a string with a
    /// string by the codes of their characters.
    fn compared(&mut self, comparisons: &[Comparison], operands: &[Expr]) -> Fallible<bool> {
        let (mut left, mut all) = (self.eval(&operands[0])?, true);
        for (comparison, pair) in comparisons.iter().zip(operands.windows(2)) {
            if !all && self.settings.conjunction != Conjunction::Eager {
                break;
            }
            let expected = match &left {
                Value::Number(_) => "a number",
                Value::Text(_) => "a string",
                other => return Err(self.fail(&pair[0].span, kind("a number", other))),
            };
            let right = self.eval(&pair[1])?;
            all &= match (&left, &right) {
                (Value::Number(x), Value::Number(y)) => compare(*comparison, *x, *y, self.settings),
                (Value::Text(x), Value::Text(y)) => {
                    self.spend(left.count() as u64)?;
                    comparison.is_true_of(x.cmp(y))
                }
                _ => return Err(self.fail(&pair[1].span, kind(expected, &right))),
            };
            left = right;
        }
        Ok(all)
    }

    /// Returns whether an expression is true: everything but 0 is.
    fn truth(&mut self, expr: &Expr) -> Fallible<bool> {
        Ok(self.number(expr)? != 0.0)
    }

    /// Returns the subscripts of an entry.
    fn subscripts(&mut self, entry: &Expr) -> Fallible<Subscripts> {
        let row = self.number(&entry.parts[1])?;
        let col = entry.parts.get(2).map(|col| self.number(col)).transpose()?;
        Ok(Subscripts { row, col })
    }

    /// Returns the values of expressions; each counts as stored while the next is evaluated.
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

    fn operate(&mut self, operation: Operation, x: Value, y: Value) -> Fallible<Value> {
        if let (Value::Number(x), Value::Number(y)) = (&x, &y) {
            return Ok(Value::Number(calculate(operation, *x, *y, self.settings)?));
        }
        let (steps, entries) = cost(operation, &x, &y);
        self.room(entries)?;
        self.spend(steps)?;
        Ok(operate(operation, x, y, self.settings)?)
    }

    fn array(&mut self, entries: &[Expr], cols: usize) -> Fallible<Value> {
        // Numbers are gathered as such: a literal of 400 takes a quarter of the time that values take.
        let mut numbers = Vec::with_capacity(entries.len());
        for (k, entry) in entries.iter().enumerate() {
            match self.eval(entry)? {
                Value::Number(x) => numbers.push(x),
                other => {
                    let mut values: Vec<_> = numbers.into_iter().map(Value::Number).collect();
                    values.push(other);
                    values.extend(self.held(&entries[k + 1..], Self::eval)?);
                    self.afford(values.iter().map(Value::count).sum())?;
                    let depth = values.iter().map(Value::depth).max().unwrap_or(0);
                    self.check_nesting(depth)?;
                    return Ok(Value::grid(Grid::from_rows(cols, values)));
                }
            }
        }
        Ok(Array::from_rows(cols, numbers).into())
    }

    /// Returns a matrix to a whole power by repeated squaring, the smallest square on the right.
    /// ```
    /// assert_eq!(plane_contact_mathcad::evaluate("(1 1; 0 1)^5").unwrap().to_string(), "1 5; 0 1");
    /// ```
    fn repeated(&mut self, matrix: Value, power: f64) -> Fallible<Value> {
        let (mut rest, mut square, mut product) = (power as u64, matrix, None);
        loop {
            if rest % 2 == 1 {
                product = Some(match product {
                    None => square.clone(),
                    Some(product) => self.operate(Operation::Multiply, square.clone(), product)?,
                });
            }
            rest /= 2;
            match product {
                Some(product) if rest == 0 => return Ok(product),
                _ => square = self.operate(Operation::Multiply, square.clone(), square)?,
            }
        }
    }

    /// Returns a sum or product of terms, added or multiplied one after another from the first; the
    /// variable is the series' own.
    /// ```
    /// assert_eq!(plane_contact_mathcad::evaluate("∑(i ∈ 1 .. 4, i^2)").unwrap().to_string(), "30");
    /// ```
    fn series(&mut self, function: Slot, name: Slot, parts: &[Expr]) -> Fallible<Value> {
        let operation = match &self.functions[function] {
            Some(Function::Builtin(Builtin { name: "∑", .. })) => Operation::Add,
            Some(Function::Builtin(Builtin { name: "∏", .. })) => Operation::Multiply,
            _ => return Err(self.undefined(function, true).into()),
        };
        let (range, term) = parts.split_at(parts.len() - 1);
        let turns = match (range, self.range_variable(range)) {
            ([from, to], _) => {
                Turns::Span { from: self.number(from)?, step: 1.0, end: self.number(to)? }
            }
            (_, Some(numbers)) => self.span(numbers)?,
            (_, None) => {
                let construct = "a series over what is no range variable".into();
                return Err(Cause::Unsupported { construct }.into());
            }
        };
        let outer = self.cells[name].value.take();
        let series = self.terms(operation, name, &turns, &term[0]);
        self.cells[name].value = outer;
        series.map(Value::Number)
    }

    fn terms(
        &mut self,
        operation: Operation,
        name: Slot,
        turns: &Turns,
        term: &Expr,
    ) -> Fallible<f64> {
        let mut result = None;
        for number in (0..).map_while(|turn| turns.value(turn)) {
            self.spend(1)?;
            self.cells[name].value = Some(number);
            let term = self.number(term)?;
            result = Some(match result {
                None => term,
                Some(result) => calculate(operation, result, term, self.settings)?,
            });
        }
        Ok(result.unwrap_or(if operation == Operation::Add { 0.0 } else { 1.0 }))
    }

    /// Returns an expression's value where each operation and function takes its arrays entry by entry;
    /// they must be of one size.
    /// ```
    /// assert_eq!(plane_contact_mathcad::evaluate("→((1; 2)·(3; 4))").unwrap().to_string(), "3; 8");
    /// ```
    fn vectorized(&mut self, expr: &Expr) -> Fallible<Value> {
        self.spend(1)?;
        self.entry_by_entry(expr).map_err(|failure| self.placed(failure, &expr.span))
    }

    fn entry_by_entry(&mut self, expr: &Expr) -> Fallible<Value> {
        use Operator::*;
        match &expr.kind {
            Kind::Group => return self.vectorized(&expr.parts[0]),
            Kind::Literal(_) | Kind::Name(_) | Kind::Array { .. } | Kind::Apply(Entry | Column) => {
                return self.eval(expr);
            }
            Kind::Call(name) if self.functions[*name].is_none() => {
                return Err(self.undefined(*name, true).into());
            }
            Kind::Apply(Magnitude | Negative | Power | Calculate(_) | Compare(_))
            | Kind::Call(_) => {}
            Kind::Apply(Not | Transpose | All | Any)
            | Kind::Chain(_)
            | Kind::If
            | Kind::Series { .. }
            | Kind::Program(_) => {
                let construct = format!("vectorize of `{}`", self.text(&expr.span));
                return Err(Cause::Unsupported { construct }.into());
            }
        }
        let operands = self.held(&expr.parts, Self::vectorized)?;
        let mut arrays = operands.iter().filter(|operand| operand.number().is_none());
        let Some(first) = arrays.next() else { return self.at(expr, &operands, (0, 0)) };
        if let Some(other) = arrays.find(|other| other.size() != first.size()) {
            return Err(Cause::sizes("→", first.size(), other.size()).into());
        }
        let (rows, cols) = first.size();
        self.afford(rows * cols)?;
        let mut entries = Vec::with_capacity(rows * cols);
        for (i, j) in (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j))) {
            entries.push(self.at(expr, &operands, (i, j))?);
        }
        Ok(Value::grid(Grid::from_rows(cols.max(1), entries)))
    }

    /// Evaluates an operation or function that [`Self::vectorized`] takes, of an entry of each operand.
    fn at(&mut self, expr: &Expr, operands: &[Value], (i, j): (usize, usize)) -> Fallible<Value> {
        self.spend(FUNCTION)?;
        let parts = expr.parts.iter().zip(operands).map(|(part, operand)| {
            let entry = operand.entry(i, j).unwrap_or_else(|| operand.clone());
            Expr { kind: Kind::Literal(entry), parts: vec![], span: part.span.clone() }
        });
        let parts = parts.collect();
        self.eval(&Expr { kind: expr.kind.clone(), parts, span: expr.span.clone() })
    }

    /// Returns what the operands of an `∧` or `∨` decide together, by the worksheet's method of
    /// evaluating `∧`: one that is `decisive` decides alone.
    /// ```
    /// use plane_contact_mathcad::{Conjunction, Limits, Listing, Settings, Sheet};
    /// let listing = Listing::parse("f", "f(v) :=\n  v[1] > 1 ∧ v[0] > 1").unwrap();
    /// let v = plane_contact_mathcad::evaluate("(1; 2)").unwrap();
    /// let under = |conjunction| {
    ///     let settings = Settings { conjunction, ..Settings::default() };
    ///     let sheet = Sheet::default();
    ///     listing.runner(&sheet, &settings, &Limits::default()).call(&[v.clone()]).is_ok()
    /// };
    /// // The first operand is false, and v has no entry 0.
    /// let methods = [Conjunction::Guarded, Conjunction::LeftToRight, Conjunction::Eager];
    /// assert_eq!(methods.map(under), [true, true, false]);
    /// ```
    fn decide(&mut self, operands: &[Expr], decisive: bool) -> Fallible<Value> {
        let method = self.settings.conjunction;
        let (mut decided, mut failure, mut seen) = (false, None, vec![]);
        for operand in operands {
            match method {
                Conjunction::LeftToRight if decided => break,
                Conjunction::LeftToRight | Conjunction::Guarded | Conjunction::Eager => (),
            }
            let truth = match (self.truth(operand), method) {
                (Ok(truth), _) => Some(truth),
                (Err(error), Conjunction::Guarded) if !error.is_limit() => {
                    self.spend_on(&error)?;
                    failure.get_or_insert(error);
                    None
                }
                (
                    Err(error),
                    Conjunction::LeftToRight | Conjunction::Guarded | Conjunction::Eager,
                ) => return Err(error),
            };
            decided |= truth == Some(decisive);
            if self.recorder.is_some() {
                seen.push(truth);
            }
        }
        let line = &self.listing.lines[self.line];
        if let (Some(recorder), false) = (&mut self.recorder, decisive) {
            let seen = seen.into_iter().chain(std::iter::repeat(None));
            let operands = operands.iter().map(|x| line.text[x.span.clone()].into());
            recorder.on(line).operands = operands.zip(seen).collect();
        }
        match failure {
            Some(failure) if !decided => Err(failure),
            _ => Ok(truth_value(decided == decisive)),
        }
    }

    /// Returns the value of the function that the name `slot` stands for.
    fn call(&mut self, slot: Slot, arguments: &[Value]) -> Fallible<Value> {
        let builtin = match &self.functions[slot] {
            None => return Err(self.undefined(slot, true).into()),
            Some(Function::Program(program)) => {
                return self.call_program(&program.clone(), arguments);
            }
            Some(Function::Outside(function)) => {
                let name = self.listing.names.name(slot);
                let value = function(arguments);
                return Ok(value.map_err(|message| Cause::Function { name: name.into(), message })?);
            }
            Some(Function::Builtin(builtin)) => *builtin,
        };
        if !builtin.arguments.contains(&arguments.len()) {
            let (expected, found) = (*builtin.arguments.end(), arguments.len());
            return Err(Cause::Arguments { expected, found }.into());
        }
        let (numbers, steps) = (builtin.cost)(arguments);
        self.room(numbers)?;
        self.spend(steps)?;
        Ok(match builtin.meaning {
            Meaning::Elementary(function, pole) => {
                elementary(&arguments[0], function, pole, builtin.name)?
            }
            Meaning::Values(function) => function(arguments, self.settings.origin)?,
            Meaning::Vectorize => unreachable!("its argument is no value but an expression"),
            Meaning::Trace => {
                let line = arguments.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
                let value = Value::Text(line.as_str().into());
                self.stored += value.count();
                self.trace.push(line);
                value
            }
        })
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
        let sheet = defined.above.as_deref().unwrap_or(self.sheet);
        let mut run = Execution::new(program, sheet, self.settings, self.limits, self.spent);
        (run.stored, run.depth) = (self.stored, depth);
        // Its own name, the first, is itself where nothing above it has that name.
        run.functions[0].get_or_insert_with(|| Function::Program(defined.clone()));
        let outcome = run.run(arguments)?;
        self.trace.extend(outcome.trace_output);
        Ok(outcome.value)
    }
}

fn truth_value(truth: bool) -> Value {
    Value::Number(if truth { 1.0 } else { 0.0 })
}
