//! The grammar of one line, read by descent with one token of foresight.
//!
//! From the loosest to the tightest: `∨`, `∧`, `¬`, comparisons, `+ −`, `· /`, the sign `−x`,
//! one power, and behind an operand `xᵀ`, `x[i]`, `x⟨j⟩`. Operators of one level group from the
//! left, but for a chain of comparisons, `a < b < c`, which is `a < b ∧ b < c`.
//!
//! The lexer bounds how deep brackets stand, and with it how deep the descent goes.

use std::collections::BTreeSet;

use super::lexer::{ARROW, Complaint, Spanned, Token};
use super::syntax::{Expr, Kind, Level, OPERATORS, Operator, Range, Slot, Span, Statement, Step};
use super::value::Value;

type Parsed<T> = Result<T, Complaint>;

/// Reads the first line of a listing, `name(parameters) :=`, and returns the parameters.
///
/// # Errors
/// The first token that does not belong there, and what may stand there.
pub fn header(tokens: &[Spanned]) -> Parsed<Vec<Slot>> {
    let mut parser = Parser { tokens, line: 0, next: 0, expected: vec![] };
    parser.function()?;
    let parameters = parser.in_brackets(Parser::name)?;
    parser.need(":=")?;
    parser.end()?;
    Ok(parameters)
}

/// Reads a line of a program, `line` being its place in the listing from 0. Blocks below it are
/// left empty; that of `x otherwise` is `x`.
///
/// # Errors
/// The first token that does not belong there, and what may stand there.
pub fn statement(tokens: &[Spanned], line: usize) -> Parsed<Statement> {
    let mut parser = Parser { tokens, line, next: 0, expected: vec![] };
    let statement = parser.statement()?;
    parser.end()?;
    Ok(statement)
}

struct Parser<'t> {
    tokens: &'t [Spanned],
    /// The line's place in the listing, from 0.
    line: usize,
    /// The place of the next token.
    next: usize,
    /// What has been looked for, and at which place.
    expected: Vec<(usize, Token)>,
}

impl<'t> Parser<'t> {
    fn token(&self) -> Option<&'t Token> {
        self.tokens.get(self.next).map(|(token, _)| token)
    }

    /// Returns where the next token starts, in bytes.
    fn start(&self) -> usize {
        let end = self.tokens.last().map_or(0, |(_, span)| span.end);
        self.tokens.get(self.next).map_or(end, |(_, span)| span.start)
    }

    /// Returns the span from `start` to the end of the last token taken.
    fn span(&self, start: usize) -> Span {
        start..self.tokens[self.next - 1].1.end
    }

    fn expr(&self, kind: Kind, parts: Vec<Expr>, start: usize) -> Expr {
        Expr { kind, parts, span: self.span(start) }
    }

    fn apply(&self, operator: Operator, operands: Vec<Expr>, start: usize) -> Expr {
        self.expr(Kind::Apply(operator), operands, start)
    }

    fn expect(&mut self, token: Token) {
        self.expected.push((self.next, token));
    }

    /// Takes the next token if it is this one.
    fn takes_token(&mut self, token: Token) -> bool {
        let is_next = self.token() == Some(&token);
        self.expect(token);
        self.next += usize::from(is_next);
        is_next
    }

    /// Takes the next token if it is this sign or keyword.
    fn takes(&mut self, sign: &'static str) -> bool {
        self.takes_token(Token::Sign(sign))
    }

    fn need(&mut self, sign: &'static str) -> Parsed<()> {
        if self.takes(sign) { Ok(()) } else { self.refuse() }
    }

    fn end(&self) -> Parsed<()> {
        if self.token().is_none() { Ok(()) } else { self.refuse() }
    }

    /// Refuses the next token.
    fn refuse<T>(&self) -> Parsed<T> {
        if self.token() == Some(&Token::Sign("<-")) {
            return Err((self.start(), format!("found {ARROW}")));
        }
        let expected = self.expected.iter().filter(|(place, _)| *place == self.next);
        let expected: BTreeSet<String> = expected.map(|(_, token)| token.to_string()).collect();
        let expected = expected.into_iter().collect::<Vec<_>>().join(" or ");
        let found = self.token().map_or("the end of the line".into(), Token::to_string);
        Err((self.start(), format!("found {found}, expected {expected}")))
    }

    fn name(&mut self) -> Parsed<Slot> {
        self.expect(Token::Words("a name"));
        let Some(Token::Name(slot)) = self.token() else { return self.refuse() };
        self.next += 1;
        Ok(*slot)
    }

    fn function(&mut self) -> Parsed<Slot> {
        self.expect(Token::Words("a function"));
        let Some(Token::Function(slot)) = self.token() else { return self.refuse() };
        self.next += 1;
        Ok(*slot)
    }

    fn statement(&mut self) -> Parsed<Statement> {
        let (start, line) = (self.start(), self.line);
        let word = match self.token() {
            Some(Token::Sign(word)) if !self.is_choice() => *word,
            _ => "",
        };
        self.next += 1;
        let step = match word {
            "for" => {
                let name = self.name()?;
                self.need("∈")?;
                Step::For { name, range: self.range()? }
            }
            "while" => Step::While { condition: self.expression()? },
            "if" => Step::Block,
            "otherwise" => Step::Otherwise,
            "try" => Step::Try,
            "return" => Step::Return { value: self.expression()? },
            "break" => Step::Break,
            "continue" => Step::Continue,
            _ => {
                self.next -= 1;
                self.assignment()?
            }
        };
        let blocks = vec![vec![]; step.blocks()];
        let is_guarded = match step {
            Step::Block => true,
            Step::While { .. } | Step::Otherwise | Step::Try => false,
            Step::For { .. }
            | Step::Assign { .. }
            | Step::Evaluate { .. }
            | Step::Return { .. }
            | Step::Break
            | Step::Continue => self.takes("if"),
        };
        let guard = if is_guarded { Some(self.expression()?) } else { None };
        let statement = Statement { line, step, blocks, guard };
        if !statement.blocks.is_empty() || !self.takes("otherwise") {
            return Ok(statement);
        }
        if statement.guard.is_some() {
            return Err((start, "found `if` and `otherwise` on one line".into()));
        }
        let blocks = vec![vec![statement]];
        Ok(Statement { line, step: Step::Otherwise, blocks, guard: None })
    }

    /// Reads an assignment, or a value alone.
    fn assignment(&mut self) -> Parsed<Step> {
        let value = self.expression()?;
        if value.targets().is_none() {
            return Ok(Step::Evaluate { value });
        }
        self.expect(Token::Sign("←"));
        if !matches!(self.token(), Some(Token::Sign("←" | "<-" | ":="))) {
            return Ok(Step::Evaluate { value });
        }
        self.next += 1;
        Ok(Step::Assign { target: value, value: self.expression()? })
    }

    /// Reads a program within an expression, the bracket of which is taken.
    fn program(&mut self) -> Parsed<Vec<Statement>> {
        let mut block = vec![];
        loop {
            let mut statement = self.statement()?;
            for body in statement.blocks.iter_mut().filter(|body| body.is_empty()) {
                *body = self.inner()?;
            }
            block.push(statement);
            if self.takes("}") {
                return Ok(block);
            }
            self.need(";")?;
        }
    }

    fn inner(&mut self) -> Parsed<Vec<Statement>> {
        self.need("{")?;
        self.program()
    }

    /// Returns whether the function `if` comes next: the brackets behind it have a comma.
    fn is_choice(&self) -> bool {
        let mut depth = 0;
        let behind = self.tokens[self.next..].iter().skip(1).map(|(token, _)| {
            match token {
                Token::Sign("(" | "[" | "⟨" | "{") => depth += 1,
                Token::Sign(")" | "]" | "⟩" | "}") => depth -= 1,
                _ => {}
            }
            (token, depth)
        });
        let mut inside = behind.take_while(|(_, depth)| *depth > 0);
        self.token() == Some(&Token::Sign("if")) && inside.any(|at| at == (&Token::Sign(","), 1))
    }

    /// Reads `from .. to`, `from, second .. to`, or values one after another.
    fn range(&mut self) -> Parsed<Range> {
        let start = self.start();
        let values = self.list(Self::expression)?;
        let to = if self.takes("..") { Some(self.expression()?) } else { None };
        if to.is_some() && values.len() > 2 {
            return Err((start, "found a range within a list".into()));
        }
        Ok(Range { values, to })
    }

    /// Reads items, at least one, with commas between them.
    fn list<T>(&mut self, item: fn(&mut Self) -> Parsed<T>) -> Parsed<Vec<T>> {
        let mut list = vec![item(self)?];
        while self.takes(",") {
            list.push(item(self)?);
        }
        Ok(list)
    }

    /// Reads round brackets with items between commas, or with nothing.
    fn in_brackets<T>(&mut self, item: fn(&mut Self) -> Parsed<T>) -> Parsed<Vec<T>> {
        self.need("(")?;
        if self.takes(")") {
            return Ok(vec![]);
        }
        let list = self.list(item)?;
        self.need(")")?;
        Ok(list)
    }

    fn expression(&mut self) -> Parsed<Expr> {
        self.joined(Operator::Any, |parser| parser.joined(Operator::All, Self::not))
    }

    /// Reads operands with a sign between them; one alone is itself.
    fn joined(
        &mut self,
        operator: Operator,
        operand: fn(&mut Self) -> Parsed<Expr>,
    ) -> Parsed<Expr> {
        let start = self.start();
        let mut operands = vec![operand(self)?];
        while self.takes(operator.spelling().sign) {
            operands.push(operand(self)?);
        }
        if operands.len() == 1 {
            Ok(operands.remove(0))
        } else {
            Ok(self.apply(operator, operands, start))
        }
    }

    fn not(&mut self) -> Parsed<Expr> {
        let (start, first) = (self.start(), self.next);
        while self.takes("¬") {}
        let signs = self.next - first;
        let value = self.comparison()?;
        Ok((0..signs).fold(value, |value, _| self.apply(Operator::Not, vec![value], start)))
    }

    fn comparison(&mut self) -> Parsed<Expr> {
        let start = self.start();
        let mut operands = vec![self.calculation(Level::Sum)?];
        let mut comparisons = vec![];
        while let Some(Operator::Compare(comparison)) = self.operator(Level::Comparison) {
            comparisons.push(comparison);
            operands.push(self.calculation(Level::Sum)?);
        }
        Ok(match *comparisons {
            [] => operands.remove(0),
            [one] => self.apply(Operator::Compare(one), operands, start),
            _ => self.expr(Kind::Chain(comparisons), operands, start),
        })
    }

    /// Reads a sum, or a product.
    fn calculation(&mut self, level: Level) -> Parsed<Expr> {
        let tighter = |parser: &mut Self| {
            if level == Level::Sum { parser.calculation(Level::Product) } else { parser.operand() }
        };
        let start = self.start();
        let mut value = tighter(self)?;
        while let Some(operator) = self.operator(level) {
            let operands = vec![value, tighter(self)?];
            value = self.apply(operator, operands, start);
        }
        Ok(value)
    }

    /// Takes an operator of a level, if one comes next.
    fn operator(&mut self, level: Level) -> Option<Operator> {
        let compares = level == Level::Comparison;
        self.expect(Token::Words(if compares { "a comparison" } else { "an operator" }));
        let mut rows = OPERATORS.iter().filter(|row| row.level == level);
        let found = rows.find(|row| self.token() == Some(&Token::Sign(row.sign)))?;
        self.next += 1;
        Some(found.operator)
    }

    /// Reads a power, or its opposite.
    fn operand(&mut self) -> Parsed<Expr> {
        self.signed(|parser| {
            let start = parser.start();
            let base = parser.tight()?;
            if !parser.takes("^") {
                return Ok(base);
            }
            let exponent = parser.signed(Self::tight)?;
            Ok(parser.apply(Operator::Power, vec![base, exponent], start))
        })
    }

    /// Reads a value, or its opposite.
    fn signed(&mut self, value: fn(&mut Self) -> Parsed<Expr>) -> Parsed<Expr> {
        let start = self.start();
        if self.token() != Some(&Token::Sign("−")) {
            return value(self);
        }
        self.next += 1;
        let value = value(self)?;
        Ok(self.apply(Operator::Negative, vec![value], start))
    }

    /// Reads an atom and what stands behind it: transposes, subscripts and columns.
    fn tight(&mut self) -> Parsed<Expr> {
        let start = self.start();
        let mut value = self.atom()?;
        loop {
            value = if self.takes("ᵀ") {
                self.apply(Operator::Transpose, vec![value], start)
            } else if self.takes("[") {
                let mut parts = vec![value, self.expression()?];
                if self.takes(",") {
                    parts.push(self.expression()?);
                }
                self.need("]")?;
                self.apply(Operator::Entry, parts, start)
            } else if self.takes("⟨") {
                let parts = vec![value, self.expression()?];
                self.need("⟩")?;
                self.apply(Operator::Column, parts, start)
            } else {
                return Ok(value);
            };
        }
    }

    fn atom(&mut self) -> Parsed<Expr> {
        let (start, token) = (self.start(), self.token());
        self.expect(Token::Words("an operand"));
        self.next += 1;
        let (kind, parts) = match token {
            Some(Token::Number(x)) => (Kind::Literal(Value::Number(*x)), vec![]),
            Some(Token::Text(text)) => (Kind::Literal(Value::Text(text.clone())), vec![]),
            Some(Token::Name(name)) => (Kind::Name(*name), vec![]),
            Some(Token::Function(function)) => self.call(*function)?,
            Some(Token::Sign("if")) => {
                let parts = self.in_brackets(Self::expression)?;
                if parts.len() != 3 {
                    return Err((start, "found `if` without three arguments".into()));
                }
                (Kind::If, parts)
            }
            Some(Token::Sign("transpose")) => {
                let start = self.start();
                self.need("(")?;
                let inside = match self.rows()? {
                    (Kind::Group, inside) => inside,
                    (array, entries) => vec![self.expr(array, entries, start)],
                };
                (Kind::Apply(Operator::Transpose), inside)
            }
            Some(Token::Sign("(")) => self.rows()?,
            Some(Token::Sign("{")) => (Kind::Program(self.program()?), vec![]),
            Some(Token::Sign("|")) => {
                let inside = self.expression()?;
                if !self.takes_token(Token::ClosingBar) {
                    return self.refuse();
                }
                (Kind::Apply(Operator::Magnitude), vec![inside])
            }
            _ => {
                self.next -= 1;
                return self.refuse();
            }
        };
        Ok(self.expr(kind, parts, start))
    }

    /// Reads the arguments of a function, or the range and the term of a series.
    fn call(&mut self, function: Slot) -> Parsed<(Kind, Vec<Expr>)> {
        let is_series = matches!(self.tokens.get(self.next + 2), Some((Token::Sign("∈"), _)));
        if !is_series {
            return Ok((Kind::Call(function), self.in_brackets(Self::expression)?));
        }
        self.need("(")?;
        let name = self.name()?;
        self.need("∈")?;
        let mut parts = vec![self.expression()?];
        if self.takes("..") {
            parts.push(self.expression()?);
        }
        self.need(",")?;
        parts.push(self.expression()?);
        self.need(")")?;
        Ok((Kind::Series { function, name }, parts))
    }

    /// Reads what stands in round brackets, the first of which is taken: one expression is that
    /// expression, several are an array, and so is one with `;` behind it.
    fn rows(&mut self) -> Parsed<(Kind, Vec<Expr>)> {
        let start = self.tokens[self.next - 1].1.start;
        let mut entries = vec![self.expression()?];
        // How many entries there are up to the end of each row.
        let mut ends = vec![];
        while !self.takes(")") {
            if !self.takes_token(Token::Gap) {
                self.need(";")?;
                ends.push(entries.len());
                if entries.len() == 1 && self.takes(")") {
                    return Ok((Kind::Array { cols: 1 }, entries));
                }
            }
            entries.push(self.expression()?);
        }
        ends.push(entries.len());
        let cols = ends[0];
        if (1..).zip(&ends).any(|(row, end)| *end != row * cols) {
            return Err((start, "found rows of different lengths".into()));
        }
        let kind = if entries.len() == 1 { Kind::Group } else { Kind::Array { cols } };
        Ok((kind, entries))
    }
}
