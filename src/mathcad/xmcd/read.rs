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

    /// Returns the operator of an `apply`, if it is one of [`OPERATORS`].
    fn spelling(self) -> Option<&'static Spelling> {
        OPERATORS.iter().find(|row| tag(row.element) == self.operator())
    }

    /// Returns whether this is a column of a name.
    fn is_column(self) -> bool {
        self.operator() == "matcol" && self.parts().nth(1).is_some_and(|x| x.tag() == "id")
    }

    /// Returns the element of the operator of an `apply`.
    fn operator(self) -> &'a str {
        match self.tag() {
            "apply" => self.parts().next().map_or("", Math::tag),
            _ => "",
        }
    }
}

/// Refuses a region that is nested too deeply.
///
/// # Errors
/// The elements are nested too deeply.
pub fn check_depth(node: Node<'_, '_>) -> Read<()> {
    let mut deepest = 0;
    for descendant in node.descendants() {
        // Counted by steps upwards, not by recursion, and no further than the limit.
        let above = descendant.ancestors().take(DEPTH + 1);
        deepest = deepest.max(above.take_while(|above| *above != node).count());
    }
    if deepest < DEPTH {
        Ok(())
    } else {
        Err(Unsupported("an expression nested too deeply".into()))
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
    let mut lines = vec![];
    match node.tag() {
        "program" => {
            for statement in node.parts() {
                lines.extend(self::lines(statement, level)?);
            }
        }
        _ => statement(node, level, &mut lines)?,
    }
    Ok(lines)
}

fn statement(node: Math<'_, '_>, level: usize, lines: &mut Vec<String>) -> Read<()> {
    let mut block = |head: String, body: Option<Math<'_, '_>>| -> Read<()> {
        lines.push(format!("{:1$}{head}", "", 2 * level));
        if let Some(body) = body {
            lines.extend(self::lines(body, level + 1)?);
        }
        Ok(())
    };
    match node.tag() {
        "for" | "while" | "otherwise" => {
            let body = node.parts().last();
            block(head(node)?, body)
        }
        "tryCatch" => {
            block("try".into(), Some(node.part(0)?))?;
            block("on error".into(), Some(node.part(1)?))
        }
        "ifThen" => {
            let (condition, body) = (expression(node.part(0)?)?, node.part(1)?);
            match body.tag() {
                "for" => block(format!("{} if {condition}", head(body)?), body.parts().last()),
                "localDefine" if body.part(1)?.tag() == "tryCatch" => {
                    block(format!("if {condition}"), Some(body))
                }
                "program" | "ifThen" | "otherwise" | "while" | "tryCatch" => {
                    block(format!("if {condition}"), Some(body))
                }
                _ => block(format!("{} if {condition}", head(body)?), None),
            }
        }
        "localDefine" if node.part(1)?.tag() == "tryCatch" => {
            let (target, attempt) = (target(node.part(0)?)?, node.part(1)?);
            for (word, k) in [("try", 0), ("on error", 1)] {
                block(word.into(), None)?;
                block(format!("  {target} ← {}", expression(attempt.part(k)?)?), None)?;
            }
            Ok(())
        }
        _ => block(head(node)?, None),
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
    let what = match node.tag() {
        "id" => return name(node),
        "matrix" if node.parts().all(|part| part.tag() == "id") => return matrix(node),
        "matrix" => "several entries at once",
        _ if node.is_entry() || node.is_column() => return expression(node),
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
        "range" => {}
        "sequence" if node.parts().any(|part| part.tag() == "range") => {
            return Err(Unsupported("a range within a list".into()));
        }
        "sequence" => {
            return Ok(node.parts().map(expression).collect::<Read<Vec<_>>>()?.join(", "));
        }
        _ => return expression(node),
    }
    let (start, end) = (node.part(0)?, expression(node.part(1)?)?);
    let start = match start.tag() {
        "sequence" => {
            format!("{}, {}", expression(start.part(0)?)?, expression(start.part(1)?)?)
        }
        _ => expression(start)?,
    };
    Ok(format!("{start} .. {end}"))
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
        "real" => number(node.text())?,
        "str" if !node.text().contains(['"', '\n', '\r']) => format!("\"{}\"", node.text()),
        "id" => name(node)?,
        "parens" => format!("({})", text(node.part(0)?, subscript)?),
        "matrix" => matrix(node)?,
        "program" => inline(&lines(node, 0)?),
        "apply" => apply(node, subscript)?,
        _ => return Err(unsupported(node)),
    })
}

/// Spells a number as the text does: Mathcad's own spelling where the text reads it.
fn number(text: &str) -> Read<String> {
    let x = text.parse().ok().filter(|x: &f64| x.is_finite());
    let x = x.ok_or_else(|| Unsupported(format!("the number {text:?}")))?;
    let spelled = super::write::number(x.abs());
    Ok(if x.is_sign_negative() { format!("−{spelled}") } else { spelled })
}

fn matrix(node: Math<'_, '_>) -> Read<String> {
    let size = |name| node.attribute(name).and_then(|n| n.parse::<usize>().ok());
    let entries: Vec<_> = node.parts().collect();
    let (Some(rows), Some(cols)) = (size("rows"), size("cols")) else {
        return Err(Unsupported("a matrix without its size".into()));
    };
    if entries.is_empty() || rows.checked_mul(cols) != Some(entries.len()) {
        return Err(Unsupported("a matrix that is not full".into()));
    }
    let plain = entries.iter().all(|entry| entry.level() == Level::Atom);
    let between = if plain { " " } else { "   " };
    if entries.len() == 1 {
        return Ok(format!("({};)", expression(entries[0])?));
    }
    let row = |i: usize| -> Read<String> {
        let row = (0..cols).map(|j| expression(entries[j * rows + i]));
        Ok(row.collect::<Read<Vec<_>>>()?.join(between))
    };
    Ok(format!("({})", (0..rows).map(row).collect::<Read<Vec<_>>>()?.join("; ")))
}

fn apply(node: Math<'_, '_>, subscript: bool) -> Read<String> {
    let operator = node.part(0)?;
    if operator.tag() == "id" && operator.text() == "if" {
        return Ok(format!("if({})", list(node, 1)?));
    }
    if operator.tag() == "id" {
        return Ok(format!("{}({})", name(operator)?, list(node, 1)?));
    }
    if let Some((_, function, n)) = FUNCTIONS.iter().find(|(o, _, _)| tag(o) == operator.tag()) {
        let mut operands = Vec::new();
        for k in 1..=*n {
            operands.push(expression(node.part(k)?)?);
        }
        if operator.tag() == "log" {
            operands.reverse();
        }
        return Ok(format!("{function}({})", operands.join(",")));
    }
    if let Some(row) = node.spelling() {
        return between(row, node, subscript);
    }
    let x = node.part(1)?;
    let y = || node.part(2);
    match operator.tag() {
        "neg" => Ok(format!("−{}", operand(x, Level::Power, subscript)?)),
        "pow" => {
            let y = y()?;
            let exponent = wrapped(y, in_exponent(y), subscript)?;
            Ok(format!("{}^{exponent}", operand(x, Level::Behind, subscript)?))
        }
        "absval" => Ok(format!("|{}|", text(x, subscript)?)),
        "transpose" => {
            let inside = x.inside().filter(|inside| in_transpose(*inside)).unwrap_or(x);
            Ok(format!("{}ᵀ", operand(inside, Level::Behind, subscript)?))
        }
        "indexer" => {
            let array = operand(x, Level::Behind, subscript)?;
            Ok(format!("{array}[{}]", subscripts(y()?)?))
        }
        "matcol" => {
            let array = operand(x, Level::Behind, subscript)?;
            Ok(format!("{array}⟨{}⟩", text(y()?, true)?))
        }
        "summation" | "product" if x.tag() == "lambda" => {
            let sign = if operator.tag() == "product" { "∏" } else { "∑" };
            let (variable, term) = (name(x.part(0)?.part(0)?)?, expression(x.part(1)?)?);
            let range = match y() {
                Ok(bounds) => {
                    format!("{} .. {}", expression(bounds.part(0)?)?, expression(bounds.part(1)?)?)
                }
                // Over the range variable of that name.
                Err(_) => variable.clone(),
            };
            Ok(format!("{sign}({variable} ∈ {range}, {term})"))
        }
        _ => Err(unsupported(operator)),
    }
}

/// Spells an operator of [`OPERATORS`] with its operands. The left one needs no parentheses where it
/// is of the operator's level: a comparison within another is a chain.
fn between(row: &Spelling, node: Math<'_, '_>, subscript: bool) -> Read<String> {
    let (sign, level, x) = (row.sign, row.level, node.part(1)?);
    let right = |least: Level| operand(node.part(2)?, least, subscript);
    if row.operator == Operator::Calculate(Operation::Divide) {
        let y = node.part(2)?;
        let above = wrapped(x, in_fraction(x, Level::Product), subscript)?;
        return Ok(format!(
            "{above} / {}",
            wrapped(y, in_fraction(y, Level::Negative), subscript)?
        ));
    }
    let left = operand(x, level, subscript)?;
    Ok(match row.operator {
        Operator::Any => format!("{left} {sign} {}", right(Level::All)?),
        Operator::All => format!("{left} {sign} {}", right(Level::Not)?),
        Operator::Not => format!("{sign}{left}"),
        Operator::Compare(_) => format!("{left} {sign} {}", right(Level::Sum)?),
        Operator::Calculate(Operation::Add | Operation::Subtract) => {
            let right = right(Level::Product)?;
            let close = subscript && !left.contains('[') && !right.contains('[');
            if close { format!("{left}{sign}{right}") } else { format!("{left} {sign} {right}") }
        }
        Operator::Calculate(Operation::Multiply | Operation::Divide) => {
            let right = right(Level::Negative)?;
            let groups = left.ends_with(')') && right.starts_with('(');
            if groups { format!("{left} {sign} {right}") } else { format!("{left}{sign}{right}") }
        }
    })
}

/// Spells arguments, from part `k` on.
fn list(node: Math<'_, '_>, k: usize) -> Read<String> {
    let first = node.part(k)?;
    let all: Vec<_> = match first.tag() {
        "sequence" => first.parts().collect(),
        _ => node.parts().skip(k).collect(),
    };
    Ok(all.into_iter().map(expression).collect::<Read<Vec<_>>>()?.join(","))
}

fn subscripts(node: Math<'_, '_>) -> Read<String> {
    match node.tag() {
        "sequence" => {
            let all = node.parts().map(|part| text(part, true));
            Ok(all.collect::<Read<Vec<_>>>()?.join(","))
        }
        _ => text(node, true),
    }
}

/// Names the construct that an element is.
pub fn unsupported(node: Math<'_, '_>) -> Unsupported {
    let words = match node.tag() {
        "apply" => match node.parts().next() {
            Some(operator) => return unsupported(operator),
            None => "an empty place",
        },
        "imag" | "complex" | "conjugate" => "complex numbers",
        "unitedValue" | "unitMonomial" | "unitReference" => return units(node),
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

/// Names the units of a result.
fn units(node: Math<'_, '_>) -> Unsupported {
    let inside = node.0.descendants();
    let names: Vec<_> = inside.filter_map(|unit| unit.attribute("unit")).collect();
    Unsupported(if names.is_empty() {
        "units".into()
    } else {
        format!("units: {}", names.join("·"))
    })
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
        if let Some(row) = self.spelling() {
            return row.level;
        }
        match self.operator() {
            "neg" => Level::Negative,
            "pow" => Level::Power,
            "transpose" | "matcol" => Level::Behind,
            "indexer" if !self.is_entry() => Level::Behind,
            _ => Level::Atom,
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
