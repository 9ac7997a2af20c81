//! From the syntax tree to XMCD.

use super::FUNCTIONS;
use super::parentheses::{Operand, in_exponent, in_fraction, in_transpose};
use crate::lexer::Names;
use crate::listing::Listing;
use crate::syntax::{Expr, Kind, Level, Operation, Operator, Statement, Step};
use crate::value::Value;
use base::xml::Element;

/// Writes the definition of a listing's function, or of a name where it has no parameters.
pub fn definition(listing: &Listing) -> Element {
    let writer = Writer { names: &listing.names };
    let name = id(listing.function());
    let left = match listing.parameters.as_slice() {
        [] => name,
        parameters => {
            let parameters = parameters.iter().map(|slot| id(listing.names.name(*slot)));
            let parameters = Element::new("ml:boundVars").with_all(parameters);
            Element::new("ml:function").with(name).with(parameters)
        }
    };
    let body = writer.block(&listing.program);
    let is_line = listing.parameters.is_empty() && listing.program.len() == 1;
    // Without parameters a line alone would be the definition of a value.
    let body = if is_line { Element::new("ml:program").with(body) } else { body };
    element("ml:define", [left, body])
}

/// Writes an expression, the only line of a listing.
/// Panics if the listing is anything else.
pub fn expression(listing: &Listing) -> Element {
    match listing.program.as_slice() {
        [Statement { step: Step::Evaluate { value }, guard: None, .. }] => {
            Writer { names: &listing.names }.expr(value)
        }
        _ => panic!("{} is no expression", listing.name()),
    }
}

/// Writes a name; a full stop in it begins Mathcad's literal subscript.
pub fn id(name: &str) -> Element {
    let (name, subscript) = name.split_once('.').unwrap_or((name, ""));
    let id = Element::with_text("ml:id", name).set("xml:space", "preserve");
    if subscript.is_empty() { id } else { id.set("subscript", subscript) }
}

/// Writes entries, given row by row, column by column.
fn by_columns<T>(entries: &[T], cols: usize, write: impl Fn(&T) -> Element) -> Element {
    let rows = entries.len() / cols.max(1);
    let places = (0..cols).flat_map(|j| (0..rows).map(move |i| i * cols + j));
    Element::new("ml:matrix")
        .set("rows", rows.to_string())
        .set("cols", cols.to_string())
        .with_all(places.map(|k| write(&entries[k])))
}

/// Writes a value: a number, a string or an array.
pub fn literal(value: &Value) -> Element {
    match value {
        Value::Number(x) => real(*x),
        Value::Text(text) => Element::with_text("ml:str", text).set("xml:space", "preserve"),
        Value::Array(array) => {
            by_columns(&array.entries().collect::<Vec<_>>(), array.cols(), |x| real(**x))
        }
        Value::Nested(nested) => {
            let entries: Vec<_> = nested.grid().entries().collect();
            by_columns(&entries, nested.grid().cols(), |value| literal(value))
        }
    }
}

/// Makes the element of a real number.
fn real(x: f64) -> Element {
    Element::with_text("ml:real", &number(x))
}

/// Spells a number as Mathcad saves it: 15 digits where they read back to the same number, else 17.
pub fn number(x: f64) -> String {
    let fifteen = format!("{x:.14e}");
    let text = if fifteen.parse() == Ok(x) { fifteen } else { format!("{x:.16e}") };
    let (mantissa, exponent) = text.split_once('e').expect("scientific notation");
    let exponent: i32 = exponent.parse().expect("a whole exponent");
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |m| ("-", m));
    let digits = mantissa.replace('.', "");
    let digits = digits.trim_end_matches('0');
    let digits = if digits.is_empty() { "0" } else { digits };
    let point = |at: usize| match digits.len() <= at {
        true => format!("{digits:0<at$}"),
        false => format!("{}.{}", &digits[..at], &digits[at..]),
    };
    match exponent {
        0..15 => format!("{sign}{}", point(exponent as usize + 1)),
        -4..0 => format!("{sign}0.{:0>1$}{digits}", "", (-exponent - 1) as usize),
        _ => {
            let side = if exponent < 0 { '-' } else { '+' };
            format!("{sign}{}E{side}{:02}", point(1), exponent.abs())
        }
    }
}

/// Makes the element of an expression in brackets.
fn parens(x: Element) -> Element {
    Element::new("ml:parens").with(x)
}

/// Writes an operator before its operands.
fn apply(operator: &'static str, operands: impl IntoIterator<Item = Element>) -> Element {
    Element::new("ml:apply").with(Element::new(operator)).with_all(operands)
}

fn element(name: &'static str, inside: impl IntoIterator<Item = Element>) -> Element {
    Element::new(name).with_all(inside)
}

struct Writer<'a> {
    names: &'a Names,
}

impl Writer<'_> {
    /// Writes the lines of a block: one stands bare, several are a program.
    fn block(&self, block: &[Statement]) -> Element {
        match block {
            [one] => self.statement(one),
            several => element("ml:program", several.iter().map(|line| self.statement(line))),
        }
    }

    fn statement(&self, statement: &Statement) -> Element {
        let mut blocks = statement.blocks.iter().map(|block| self.block(block));
        let line = match &statement.step {
            Step::Block => blocks.next().expect("the block below `if`"),
            Step::While { condition } => {
                element("ml:while", [self.expr(condition)].into_iter().chain(blocks))
            }
            Step::Otherwise => element("ml:otherwise", blocks),
            Step::Try => element("ml:tryCatch", blocks),
            Step::For { name, range } => {
                let start = self.sequence(&range.values);
                let range = match &range.to {
                    Some(to) => element("ml:range", [start, self.expr(to)]),
                    None => start,
                };
                let head = [id(self.names.name(*name)), range];
                element("ml:for", head.into_iter().chain(blocks))
            }
            Step::Assign { target, value } => {
                element("ml:localDefine", [self.expr(target), self.expr(value)])
            }
            Step::Evaluate { value } => self.expr(value),
            Step::Return { value } => element("ml:return", [self.expr(value)]),
            Step::Break => Element::new("ml:break"),
            Step::Continue => Element::new("ml:continue"),
        };
        match &statement.guard {
            Some(guard) => element("ml:ifThen", [self.expr(guard), line]),
            None => line,
        }
    }

    /// Writes expressions as a sequence; one alone is itself.
    fn sequence(&self, exprs: &[Expr]) -> Element {
        let mut elements: Vec<_> = exprs.iter().map(|x| self.expr(x)).collect();
        match elements.len() {
            1 => elements.remove(0),
            _ => element("ml:sequence", elements),
        }
    }

    fn expr(&self, expr: &Expr) -> Element {
        let parts = expr.parts.as_slice();
        match &expr.kind {
            Kind::Literal(value) => literal(value),
            Kind::Name(name) => id(self.names.name(*name)),
            Kind::Group => parens(self.expr(&parts[0])),
            Kind::Array { cols } => by_columns(parts, *cols, |x| self.expr(x)),
            Kind::Apply(operator) => self.applied(*operator, parts),
            Kind::Chain(comparisons) => {
                self.folded(comparisons.iter().map(|sign| Operator::Compare(*sign)), parts)
            }
            Kind::Call(name) => {
                let name = self.names.name(*name);
                match FUNCTIONS.iter().find(|(_, f, n)| *f == name && *n == parts.len()) {
                    Some((element, ..)) => {
                        let mut written: Vec<_> = parts.iter().map(|x| self.expr(x)).collect();
                        if name == "log" {
                            written.reverse();
                        }
                        apply(element, written)
                    }
                    None => element("ml:apply", [id(name), self.sequence(parts)]),
                }
            }
            Kind::Program(block) => match block.as_slice() {
                [_] => Element::new("ml:program").with(self.block(block)),
                several => self.block(several),
            },
            Kind::If => element("ml:apply", [id("if"), self.sequence(parts)]),
            Kind::Series { function, name } => {
                let (term, range) = parts.split_last().expect("a series has a term");
                let product = self.names.name(*function) == "∏";
                let bound = element("ml:boundVars", [id(self.names.name(*name))]);
                let lambda = element("ml:lambda", [bound, self.expr(term)]);
                // Over a range variable there are none.
                let bounds = (range.len() == 2)
                    .then(|| element("ml:bounds", range.iter().map(|x| self.expr(x))));
                let series = if product { "ml:product" } else { "ml:summation" };
                apply(series, [lambda].into_iter().chain(bounds))
            }
        }
    }

    /// Writes an operator before its operands, with the parentheses that Mathcad's places need.
    fn applied(&self, operator: Operator, operands: &[Expr]) -> Element {
        let x = &operands[0];
        let written = match operator {
            Operator::Any | Operator::All => {
                return self.folded(operands[1..].iter().map(|_| operator), operands);
            }
            Operator::Negative => match x.kind {
                Kind::Literal(Value::Number(x)) => return real(-x),
                _ => vec![self.expr(x)],
            },
            Operator::Not
            | Operator::Magnitude
            | Operator::Compare(_)
            | Operator::Calculate(Operation::Add | Operation::Subtract | Operation::Multiply) => {
                operands.iter().map(|x| self.expr(x)).collect()
            }
            Operator::Calculate(Operation::Divide) => vec![
                self.without(x, |x| in_fraction(x, Level::Product)),
                self.without(&operands[1], |y| in_fraction(y, Level::Negative)),
            ],
            Operator::Power => vec![self.expr(x), self.without(&operands[1], in_exponent)],
            Operator::Transpose if in_transpose(x) => vec![parens(self.expr(x))],
            Operator::Transpose => vec![self.behind(x)],
            Operator::Entry | Operator::Column => {
                vec![self.behind(x), self.sequence(&operands[1..])]
            }
        };
        apply(operator.spelling().element, written)
    }

    /// Writes each operator between what stands before it and the next operand.
    fn folded(&self, operators: impl Iterator<Item = Operator>, operands: &[Expr]) -> Element {
        operators.zip(&operands[1..]).fold(self.expr(&operands[0]), |left, (operator, x)| {
            apply(operator.spelling().element, [left, self.expr(x)])
        })
    }

    /// Writes an operand, without its parentheses where they stand for Mathcad's own place.
    fn without<'e>(&self, x: &'e Expr, placed: impl Fn(&'e Expr) -> bool) -> Element {
        match x.inside().filter(|inside| placed(inside)) {
            Some(inside) => self.expr(inside),
            None => self.expr(x),
        }
    }

    /// Writes what something stands behind, in parentheses unless it is a name or has them.
    fn behind(&self, x: &Expr) -> Element {
        let inside = self.expr(x);
        if x.level() < Level::Atom || x.is_entry() { parens(inside) } else { inside }
    }
}

impl Operand for &Expr {
    fn level(self) -> Level {
        Expr::level(self)
    }

    fn inside(self) -> Option<Self> {
        matches!(self.kind, Kind::Group).then(|| &self.parts[0])
    }

    fn is_plain_opposite(self) -> bool {
        matches!(self.kind, Kind::Apply(Operator::Negative))
            && self.parts[0].level() >= Level::Behind
    }

    fn is_entry(self) -> bool {
        Expr::is_entry(self)
    }
}
