//! From the syntax tree to XMCD.

use super::FUNCTIONS;
use super::parentheses::{Operand, in_exponent, in_fraction, in_transpose};
use crate::lexer::Names;
use crate::listing::Listing;
use crate::syntax::{
    Expr, Kind, Level, Operation, Operator, Range, Reference, Slot, Spread, Statement, Step,
};
use crate::value::Array;
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

/// Writes an array of numbers.
pub fn matrix(array: &Array) -> Element {
    let entries: Vec<f64> = array.entries().copied().collect();
    by_columns(&entries, array.cols(), |x| real(*x))
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

/// Makes the element of a real number.
pub fn real(x: f64) -> Element {
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
pub fn parens(x: Element) -> Element {
    Element::new("ml:parens").with(x)
}

/// Writes an operator before its operands.
pub fn apply(operator: &'static str, operands: impl IntoIterator<Item = Element>) -> Element {
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
        let line = match &statement.step {
            Step::If { condition, body } => {
                element("ml:ifThen", [self.expr(condition), self.block(body)])
            }
            Step::While { condition, body } => {
                element("ml:while", [self.expr(condition), self.block(body)])
            }
            Step::Otherwise { body } => element("ml:otherwise", [self.block(body)]),
            Step::Try { body, fallback } => {
                element("ml:tryCatch", [self.block(body), self.block(fallback)])
            }
            Step::For { name, range, body } => {
                let range = match range {
                    Range::Over(values) => self.sequence(values),
                    Range::Span { from, second, to } => {
                        let start = self.sequence([from].into_iter().chain(second));
                        element("ml:range", [start, self.expr(to)])
                    }
                };
                element("ml:for", [id(self.names.name(*name)), range, self.block(body)])
            }
            Step::Assign { target, value } => {
                element("ml:localDefine", [self.reference(target), self.expr(value)])
            }
            Step::Spread { to, value } => {
                let name = |slot: &Slot| id(self.names.name(*slot));
                let to = match to {
                    Spread::Names { names, cols } => by_columns(names, *cols, name),
                    Spread::Column { name: array, column, .. } => {
                        apply("ml:matcol", [name(array), self.expr(column)])
                    }
                };
                element("ml:localDefine", [to, self.expr(value)])
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
    fn sequence<'e>(&self, exprs: impl IntoIterator<Item = &'e Expr>) -> Element {
        let mut elements: Vec<_> = exprs.into_iter().map(|x| self.expr(x)).collect();
        match elements.len() {
            1 => elements.remove(0),
            _ => element("ml:sequence", elements),
        }
    }

    fn reference(&self, reference: &Reference) -> Element {
        let name = id(self.names.name(reference.name));
        match reference.row {
            None => name,
            Some(_) => apply("ml:indexer", [name, self.sequence(reference.subscripts())]),
        }
    }

    fn expr(&self, expr: &Expr) -> Element {
        match &expr.kind {
            Kind::Number(x) => real(*x),
            Kind::Text(text) => Element::with_text("ml:str", text).set("xml:space", "preserve"),
            Kind::Read(reference) => self.reference(reference),
            Kind::Entry { of, subscripts } => {
                apply("ml:indexer", [self.behind(of), self.sequence(subscripts)])
            }
            Kind::Group(x) => parens(self.expr(x)),
            Kind::Array { entries, cols } => by_columns(entries, *cols, |x| self.expr(x)),
            Kind::Magnitude(x) => apply("ml:absval", [self.expr(x)]),
            Kind::Negative(x) => match x.kind {
                Kind::Number(x) => real(-x),
                _ => apply("ml:neg", [self.expr(x)]),
            },
            Kind::Not(x) => apply("ml:not", [self.expr(x)]),
            Kind::Transpose(x) => {
                let inside = if in_transpose(&**x) { parens(self.expr(x)) } else { self.behind(x) };
                apply("ml:transpose", [inside])
            }
            Kind::Column(x, j) => apply("ml:matcol", [self.behind(x), self.expr(j)]),
            Kind::Power(x, y) => apply("ml:pow", [self.expr(x), self.without(y, in_exponent)]),
            Kind::Arithmetic(Operation::Divide, x, y) => {
                let above = self.without(x, |x| in_fraction(x, Level::Product));
                let below = self.without(y, |y| in_fraction(y, Level::Negative));
                apply("ml:div", [above, below])
            }
            Kind::Arithmetic(operation, x, y) => {
                self.operated(Operator::Calculate(*operation), self.expr(x), y)
            }
            Kind::Compare(comparison, x, y) => {
                self.operated(Operator::Compare(*comparison), self.expr(x), y)
            }
            Kind::Chain(first, rest) => rest.iter().fold(self.expr(first), |left, (sign, x)| {
                self.operated(Operator::Compare(*sign), left, x)
            }),
            Kind::All(operands) | Kind::Any(operands) => {
                let all = matches!(expr.kind, Kind::All(_));
                let operator = if all { Operator::All } else { Operator::Any };
                let (first, rest) = operands.split_first().expect("two operands or more");
                rest.iter().fold(self.expr(first), |left, x| self.operated(operator, left, x))
            }
            Kind::Call(name, arguments) => {
                let name = self.names.name(*name);
                match FUNCTIONS.iter().find(|(_, f, n)| *f == name && *n == arguments.len()) {
                    Some((element, ..)) => {
                        let mut written: Vec<_> = arguments.iter().map(|x| self.expr(x)).collect();
                        if name == "log" {
                            written.reverse();
                        }
                        apply(element, written)
                    }
                    None => element("ml:apply", [id(name), self.sequence(arguments)]),
                }
            }
            Kind::Program(block) => match block.as_slice() {
                [_] => Element::new("ml:program").with(self.block(block)),
                several => self.block(several),
            },
            Kind::If(parts) => element("ml:apply", [id("if"), self.sequence(&**parts)]),
            Kind::Series { function, name, parts } => {
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

    fn operated(&self, operator: Operator, left: Element, right: &Expr) -> Element {
        apply(operator.spelling().element, [left, self.expr(right)])
    }
}

impl Operand for &Expr {
    fn level(self) -> Level {
        match &self.kind {
            Kind::Any(_) => Level::Any,
            Kind::All(_) => Level::All,
            Kind::Not(_) => Level::Not,
            Kind::Compare(..) | Kind::Chain(..) => Level::Comparison,
            Kind::Arithmetic(operation, ..) => Operator::Calculate(*operation).spelling().level,
            Kind::Negative(_) => Level::Negative,
            Kind::Power(..) => Level::Power,
            Kind::Transpose(_) | Kind::Column(..) | Kind::Entry { .. } => Level::Behind,
            Kind::Number(_)
            | Kind::Text(_)
            | Kind::Read(_)
            | Kind::Group(_)
            | Kind::Array { .. }
            | Kind::Magnitude(_)
            | Kind::Call(..)
            | Kind::If(_)
            | Kind::Program(_)
            | Kind::Series { .. } => Level::Atom,
        }
    }

    fn inside(self) -> Option<Self> {
        match &self.kind {
            Kind::Group(x) => Some(x),
            _ => None,
        }
    }

    fn is_plain_opposite(self) -> bool {
        matches!(&self.kind, Kind::Negative(x) if x.level() >= Level::Behind)
    }

    fn is_entry(self) -> bool {
        matches!(&self.kind, Kind::Read(reference) if reference.row.is_some())
    }
}
