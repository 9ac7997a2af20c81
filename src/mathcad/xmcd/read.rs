//! From XMCD to the text notation.

use std::cmp::Ordering;

use roxmltree::Node;

use super::parentheses::{Operand, in_exponent, in_fraction, in_transpose};
use super::{FUNCTIONS, Unsupported, tag};
use crate::lexer::{keyword, name_length};
use crate::listing::ON_ERROR;
use crate::syntax::{Level, OPERATORS, Operation, Operator, Spelling};
use crate::unsupported::{is_function, is_unit};

type Read<T> = Result<T, Unsupported>;

/// How deep the elements of a region may stand within each other.
const DEPTH: usize = 300;

/// An element without Mathcad's notes on where it came from.
#[derive(Clone, Copy)]
pub struct Math<'a, 'i>(Node<'a, 'i>);

impl<'a, 'i> Math<'a, 'i> {
    /// Makes it of an element of the file, without the brackets and wrappers around it.
    pub fn new(mut node: Node<'a, 'i>) -> Self {
        while node.tag_name().name() == "provenance"
            && let Some(last) = node.children().rfind(Node::is_element)
        {
            node = last;
        }
        Math(node)
    }

    /// Returns the element's name, without its namespace.
    pub fn tag(self) -> &'a str {
        self.0.tag_name().name()
    }

    /// Returns the elements inside it, in their order.
    pub fn parts(self) -> impl Iterator<Item = Math<'a, 'i>> {
        self.0.children().filter(Node::is_element).map(Math::new)
    }

    /// Returns the element inside it at place `k`, from 0.
    ///
    /// # Errors
    /// There is no such element.
    pub fn part(self, k: usize) -> Read<Math<'a, 'i>> {
        self.parts().nth(k).ok_or_else(|| Unsupported(format!("an incomplete `{}`", self.tag())))
    }

    /// Returns the text inside it; empty where there is none.
    pub fn text(self) -> &'a str {
        self.0.text().unwrap_or_default()
    }

    /// Returns the value of an attribute.
    pub fn attribute(self, name: &str) -> Option<&'a str> {
        self.0.attribute(name)
    }

    /// Returns whether it defines something, as `x := 3` does.
    pub fn defines(self) -> bool {
        matches!(self.tag(), "define" | "globalDefine")
    }

    /// Returns the element of the operator of an `apply`.
    fn operator(self) -> &'a str {
        if self.tag() == "apply" { self.parts().next().map_or("", Math::tag) } else { "" }
    }

    /// Returns its operator, if it is one of [`OPERATORS`].
    fn spelling(self) -> Option<&'static Spelling> {
        OPERATORS.iter().find(|row| tag(row.element) == self.operator())
    }
}

/// Refuses a region that is nested too deeply.
///
/// # Errors
/// The elements are nested too deeply.
pub fn check_depth(node: Node<'_, '_>) -> Read<()> {
    // Counted by steps upwards, not by recursion, and no further than the limit.
    let depth = |inside: Node<'_, '_>| {
        inside.ancestors().take(DEPTH + 1).take_while(|above| *above != node).count()
    };
    match node.descendants().any(|inside| depth(inside) >= DEPTH) {
        true => Err(Unsupported("an expression nested too deeply".into())),
        false => Ok(()),
    }
}

/// Reads a name.
///
/// # Errors
/// The notation has no such name.
pub fn name(id: Math<'_, '_>) -> Read<String> {
    if id.tag() != "id" {
        return Err(unsupported(id));
    }
    let mut name = id.text().to_string();
    if let Some(subscript) = id.attribute("subscript") {
        // An empty one makes a name of its own too: a variable `m` beside the unit.
        let subscript = if subscript.is_empty() { "_" } else { subscript };
        name = format!("{name}.{subscript}");
    }
    let starts = name.starts_with(|c: char| !c.is_numeric() && c != '\'' && c != '.');
    match starts && name_length(&name) == name.len() && keyword(&name).is_none() {
        true => Ok(name),
        false if is_unit(&name) => Err(Unsupported(format!("units: {name}"))),
        false => Err(Unsupported(format!("the name {name:?}"))),
    }
}

/// Reads the lines of a program or the one line of an expression, indented `level` deep.
///
/// # Errors
/// The notation lacks a construct of the program.
pub fn lines(node: Math<'_, '_>, level: usize) -> Read<Vec<String>> {
    // A line, and the lines of the block below it.
    let block = |head: &str, body: Option<Math<'_, '_>>| -> Read<Vec<String>> {
        let below = body.map(|body| lines(body, level + 1)).transpose()?.unwrap_or_default();
        Ok([format!("{:1$}{head}", "", 2 * level)].into_iter().chain(below).collect())
    };
    let is_attempt = |node: Math<'_, '_>| -> Read<bool> {
        Ok(node.tag() == "localDefine" && node.part(1)?.tag() == "tryCatch")
    };
    match node.tag() {
        "program" => {
            let statements = node.parts().map(|statement| lines(statement, level));
            Ok(statements.collect::<Read<Vec<_>>>()?.concat())
        }
        "for" | "while" | "otherwise" => block(&head(node)?, node.parts().last()),
        "tryCatch" => {
            Ok([block("try", Some(node.part(0)?))?, block(ON_ERROR, Some(node.part(1)?))?].concat())
        }
        "ifThen" => {
            let (condition, body) = (expression(node.part(0)?)?, node.part(1)?);
            match body.tag() {
                "for" => block(&format!("{} if {condition}", head(body)?), body.parts().last()),
                "program" | "ifThen" | "otherwise" | "while" | "tryCatch" => {
                    block(&format!("if {condition}"), Some(body))
                }
                _ if is_attempt(body)? => block(&format!("if {condition}"), Some(body)),
                _ => block(&format!("{} if {condition}", head(body)?), None),
            }
        }
        _ if is_attempt(node)? => {
            let (target, attempt) = (target(node.part(0)?)?, node.part(1)?);
            let [value, other] = [0, 1].map(|k| attempt.part(k).and_then(expression));
            let assigned = |value: String| block(&format!("  {target} ← {value}"), None);
            Ok([block("try", None)?, assigned(value?)?, block(ON_ERROR, None)?, assigned(other?)?]
                .concat())
        }
        _ => block(&head(node)?, None),
    }
}

/// Reads a statement's own line.
fn head(node: Math<'_, '_>) -> Read<String> {
    Ok(match node.tag() {
        "for" => format!("for {} ∈ {}", name(node.part(0)?)?, range(node.part(1)?)?),
        "while" => format!("while {}", expression(node.part(0)?)?),
        "otherwise" | "break" | "continue" => node.tag().into(),
        "return" => format!("return {}", expression(node.part(0)?)?),
        "localDefine" => {
            format!("{} ← {}", target(node.part(0)?)?, expression(node.part(1)?)?)
        }
        _ => expression(node)?,
    })
}

/// Reads what is assigned to: a name, or an entry of a name.
///
/// # Errors
/// The notation lacks a construct of the target.
pub fn target(node: Math<'_, '_>) -> Read<String> {
    let of_name = node.parts().nth(1).is_some_and(|x| x.tag() == "id");
    let what = match (node.tag(), node.operator()) {
        ("id", _) => return name(node),
        ("matrix", _) if node.parts().all(|part| part.tag() == "id") => return matrix(node),
        ("matrix", _) => "several entries at once",
        (_, "indexer" | "matcol") if of_name => return expression(node),
        _ => "an entry of an expression",
    };
    Err(Unsupported(format!("an assignment to {what}")))
}

/// Reads what a loop runs over.
///
/// # Errors
/// The notation lacks a construct of the range.
pub fn range(node: Math<'_, '_>) -> Read<String> {
    match node.tag() {
        "range" => {
            let end = expression(node.part(1)?)?;
            Ok(format!("{} .. {end}", joined(node.part(0)?, ", ", expression)?))
        }
        "sequence" if node.parts().any(|part| part.tag() == "range") => {
            Err(Unsupported("a range within a list".into()))
        }
        _ => joined(node, ", ", expression),
    }
}

/// Spells the elements of a sequence with `between` between them, or the one element that is none.
fn joined(
    node: Math<'_, '_>,
    between: &str,
    spell: impl Fn(Math<'_, '_>) -> Read<String>,
) -> Read<String> {
    match node.tag() {
        "sequence" => Ok(node.parts().map(spell).collect::<Read<Vec<_>>>()?.join(between)),
        _ => spell(node),
    }
}

/// Writes the lines of a program on one line: blocks in braces, and `;` between statements.
fn inline(lines: &[String]) -> String {
    let (mut text, mut level) = (String::from("{"), 0);
    for (k, line) in lines.iter().enumerate() {
        let words = line.trim_start_matches(' ');
        let own = (line.len() - words.len()) / 2;
        match own.cmp(&level) {
            Ordering::Greater => text += " {",
            Ordering::Less | Ordering::Equal => text += &"}".repeat(level - own),
        }
        // The second block of `try` follows the first.
        if words != ON_ERROR {
            text += if k > 0 && own <= level { "; " } else { "" };
            text += words;
        }
        level = own;
    }
    text + &"}".repeat(level + 1)
}

/// Returns an expression of the file in the text notation.
///
/// # Errors
/// The notation lacks a construct of the expression.
pub fn expression(node: Math<'_, '_>) -> Read<String> {
    text(node, false)
}

/// Spells an expression that binds at least as tightly as `least`, in parentheses if it does not.
fn operand(node: Math<'_, '_>, least: Level, subscript: bool) -> Read<String> {
    wrapped(node, node.level() < least, subscript)
}

fn wrapped(node: Math<'_, '_>, parentheses: bool, subscript: bool) -> Read<String> {
    let text = text(node, subscript)?;
    Ok(if parentheses { format!("({text})") } else { text })
}

/// Spells an expression; within subscripts, sums of plain names stand close.
fn text(node: Math<'_, '_>, subscript: bool) -> Read<String> {
    Ok(match node.tag() {
        "real" => {
            let x = real(node.text())?;
            let spelled = super::write::number(x.abs());
            if x.is_sign_negative() { format!("−{spelled}") } else { spelled }
        }
        "str" if !node.text().contains(['"', '\n', '\r']) => format!("\"{}\"", node.text()),
        "id" => name(node)?,
        "parens" => format!("({})", text(node.part(0)?, subscript)?),
        "matrix" => matrix(node)?,
        "program" => inline(&lines(node, 0)?),
        "apply" => apply(node, subscript)?,
        _ => return Err(unsupported(node)),
    })
}

/// Reads a number.
///
/// # Errors
/// It is none that is finite.
pub fn real(text: &str) -> Read<f64> {
    let x = text.parse().ok().filter(|x: &f64| x.is_finite());
    x.ok_or_else(|| Unsupported(format!("the number {text:?}")))
}

/// Returns the entries of a matrix row by row, and how many columns they stand in.
///
/// # Errors
/// It is not full.
pub fn entries<'a, 'i>(node: Math<'a, 'i>) -> Read<(Vec<Math<'a, 'i>>, usize)> {
    let size = |name| node.attribute(name).and_then(|n| n.parse::<usize>().ok());
    let (Some(rows), Some(cols)) = (size("rows"), size("cols")) else {
        return Err(Unsupported("a matrix without its size".into()));
    };
    let entries: Vec<_> = node.parts().collect();
    if entries.is_empty() || rows.checked_mul(cols) != Some(entries.len()) {
        return Err(Unsupported("a matrix that is not full".into()));
    }
    let places = (0..rows).flat_map(|i| (0..cols).map(move |j| j * rows + i));
    Ok((places.map(|k| entries[k]).collect(), cols))
}

fn matrix(node: Math<'_, '_>) -> Read<String> {
    let (entries, cols) = entries(node)?;
    if let [one] = *entries {
        return Ok(format!("({};)", expression(one)?));
    }
    let plain = entries.iter().all(|entry| entry.level() == Level::Atom);
    let between = if plain { " " } else { "   " };
    let entries = entries.into_iter().map(expression).collect::<Read<Vec<_>>>()?;
    let rows: Vec<_> = entries.chunks(cols).map(|row| row.join(between)).collect();
    Ok(format!("({})", rows.join("; ")))
}

fn apply(node: Math<'_, '_>, subscript: bool) -> Read<String> {
    let operator = node.part(0)?;
    if operator.tag() == "id" {
        let function = if operator.text() == "if" { "if".into() } else { name(operator)? };
        let several = node.parts().skip(1).map(|part| joined(part, ",", expression));
        // Where there are no arguments, it is incomplete.
        node.part(1)?;
        return Ok(format!("{function}({})", several.collect::<Read<Vec<_>>>()?.join(",")));
    }
    if let Some((_, function, n)) = FUNCTIONS.iter().find(|(o, _, _)| tag(o) == operator.tag()) {
        let operands = (1..=*n).map(|k| node.part(k).and_then(expression));
        let mut operands = operands.collect::<Read<Vec<_>>>()?;
        if operator.tag() == "log" {
            operands.reverse();
        }
        return Ok(format!("{function}({})", operands.join(",")));
    }
    let x = node.part(1)?;
    let part = |k| node.part(k);
    let behind = |x| operand(x, Level::Behind, subscript);
    let Some(row) = node.spelling() else { return series(operator, x, node) };
    let sign = row.sign;
    match row.operator {
        Operator::Any | Operator::All | Operator::Compare(_) | Operator::Calculate(_) => {
            between(row, x, part(2)?, subscript)
        }
        Operator::Not => Ok(format!("{sign}{}", operand(x, row.level, subscript)?)),
        Operator::Negative => Ok(format!("{sign}{}", operand(x, Level::Power, subscript)?)),
        Operator::Power => {
            let y = part(2)?;
            Ok(format!("{}{sign}{}", behind(x)?, wrapped(y, in_exponent(y), subscript)?))
        }
        Operator::Magnitude => Ok(format!("|{}|", text(x, subscript)?)),
        Operator::Transpose => {
            let inside = x.inside().filter(|inside| in_transpose(*inside)).unwrap_or(x);
            Ok(format!("{}{sign}", behind(inside)?))
        }
        Operator::Entry => {
            let subscripts = joined(part(2)?, ",", |part| text(part, true))?;
            Ok(format!("{}[{subscripts}]", behind(x)?))
        }
        Operator::Column => Ok(format!("{}⟨{}⟩", behind(x)?, text(part(2)?, true)?)),
    }
}

/// Spells a sum or product of a function of its variable.
fn series(operator: Math<'_, '_>, x: Math<'_, '_>, node: Math<'_, '_>) -> Read<String> {
    let sign = match operator.tag() {
        "summation" if x.tag() == "lambda" => "∑",
        "product" if x.tag() == "lambda" => "∏",
        _ => return Err(unsupported(operator)),
    };
    let (variable, term) = (name(x.part(0)?.part(0)?)?, expression(x.part(1)?)?);
    let range = match node.part(2) {
        Ok(bounds) => {
            format!("{} .. {}", expression(bounds.part(0)?)?, expression(bounds.part(1)?)?)
        }
        // Over the range variable of that name.
        Err(_) => variable.clone(),
    };
    Ok(format!("{sign}({variable} ∈ {range}, {term})"))
}

/// Spells an operator between two operands. The left one needs no parentheses where it is of the operator's
/// level: a comparison within another is a chain.
fn between(row: &Spelling, x: Math<'_, '_>, y: Math<'_, '_>, subscript: bool) -> Read<String> {
    let sign = row.sign;
    if row.operator == Operator::Calculate(Operation::Divide) {
        let above = wrapped(x, in_fraction(x, Level::Product), subscript)?;
        let below = wrapped(y, in_fraction(y, Level::Negative), subscript)?;
        return Ok(format!("{above} {sign} {below}"));
    }
    let left = operand(x, row.level, subscript)?;
    let right = wrapped(y, y.level() <= row.level, subscript)?;
    let is_close = match row.level {
        Level::Sum => subscript && !left.contains('[') && !right.contains('['),
        Level::Product => !(left.ends_with(')') && right.starts_with('(')),
        _ => false,
    };
    Ok(if is_close { format!("{left}{sign}{right}") } else { format!("{left} {sign} {right}") })
}

/// Names the construct that an element is.
pub fn unsupported(node: Math<'_, '_>) -> Unsupported {
    let words = match node.tag() {
        "apply" => match node.parts().next() {
            Some(operator) => return unsupported(operator),
            None => "an empty place",
        },
        "imag" | "complex" | "conjugate" => "complex numbers",
        "unitedValue" | "unitMonomial" | "unitReference" => {
            let names = node.0.descendants().filter_map(|unit| unit.attribute("unit"));
            let names = names.collect::<Vec<_>>().join("·");
            return Unsupported(["units", &*names].join(if names.is_empty() { "" } else { ": " }));
        }
        "symEval" | "symResult" => "symbolics",
        "derivative" => "a derivative",
        "integral" => "an integral",
        "Find" | "Minerr" | "Minimize" | "Maximize" | "Odesolve" => "a solve block",
        "range" => "a range in an expression",
        "placeholder" => "an empty place",
        "str" => "a string with quotation marks or several lines",
        tag if is_function(tag) => return Unsupported(format!("the function {tag}")),
        tag => return Unsupported(format!("the operator {tag}")),
    };
    Unsupported(words.into())
}

/// Names the unit in which a result is shown, of which the saved number is a multiple.
pub fn shown_in(unit: Math<'_, '_>) -> String {
    let names = unit.0.descendants().filter(|node| node.tag_name().name() == "id");
    let names: Vec<_> = names.filter_map(|id| id.text()).collect();
    format!("units: {}", names.join("·"))
}

impl Operand for Math<'_, '_> {
    fn level(self) -> Level {
        if self.tag() == "real" {
            let negative = self.text().starts_with('-');
            return if negative { Level::Negative } else { Level::Atom };
        }
        match self.spelling() {
            Some(_) if self.is_entry() => Level::Atom,
            Some(row) => row.level,
            None => Level::Atom,
        }
    }

    fn inside(self) -> Option<Self> {
        if self.tag() == "parens" { self.parts().next() } else { None }
    }

    fn is_plain_opposite(self) -> bool {
        match self.operator() {
            "neg" => self.parts().nth(1).is_some_and(|x| x.level() >= Level::Behind),
            _ => self.tag() == "real" && self.level() == Level::Negative,
        }
    }

    fn is_entry(self) -> bool {
        self.operator() == "indexer" && self.parts().nth(1).is_some_and(|x| x.tag() == "id")
    }
}
