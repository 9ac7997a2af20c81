//! Spells a syntax tree out: the listing's own text again, but for spaces.

use std::fmt::{self, Display, Formatter};

use mathcad::Listing;
use mathcad::syntax::{Expr, Kind, Range, Reference, Slot, Spread, Statement, Step};

/// Returns the listing as its syntax tree spells it: what was understood, for comparison with what
/// was printed.
pub fn spelled(listing: &Listing) -> String {
    let name = |slot: &Slot| listing.names.name(*slot);
    let parameters: Vec<_> = listing.parameters.iter().map(name).collect();
    // The function's name is the first that a listing writes.
    let mut text = format!("{}({}) :=\n", name(&0), parameters.join(", "));
    block(listing, &listing.program, 1, &mut text);
    text
}

fn block(listing: &Listing, statements: &[Statement], level: usize, text: &mut String) {
    for statement in statements {
        text.push_str(&format!("{:1$}{2}\n", "", 2 * level, spell(listing, statement)));
        for (k, below) in statement.step.blocks().into_iter().enumerate() {
            if k > 0 {
                text.push_str(&format!("{:1$}on error\n", "", 2 * level));
            }
            block(listing, below, level + 1, text);
        }
    }
}

/// Spells a program within an expression behind its bracket, up to the bracket that closes it.
fn inline(listing: &Listing, statements: &[Statement], f: &mut Formatter<'_>) -> fmt::Result {
    for (k, statement) in statements.iter().enumerate() {
        write!(f, "{}{}", if k > 0 { "; " } else { "" }, spell(listing, statement))?;
        for below in statement.step.blocks() {
            f.write_str(" {")?;
            inline(listing, below, f)?;
        }
    }
    f.write_str("}")
}

fn spell<'a, T>(listing: &'a Listing, item: &'a T) -> Spelled<'a, T> {
    Spelled { listing, item }
}

fn join(listing: &Listing, items: &[Expr], between: &str) -> String {
    items.iter().map(|item| spell(listing, item).to_string()).collect::<Vec<_>>().join(between)
}

struct Spelled<'a, T> {
    listing: &'a Listing,
    item: &'a T,
}

impl Display for Spelled<'_, Statement> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let show = |expr| spell(self.listing, expr);
        match &self.item.step {
            Step::For { name, range, .. } => {
                write!(f, "for {} ∈ ", spell(self.listing, name))?;
                match range {
                    Range::Span { from, second, to } => {
                        let second = second.iter().map(|x| format!(", {}", show(x)));
                        let second: String = second.collect();
                        write!(f, "{}{second} .. {}", show(from), show(to))?;
                    }
                    Range::Over(values) => f.write_str(&join(self.listing, values, ", "))?,
                }
            }
            Step::If { condition, .. } => write!(f, "if {}", show(condition))?,
            Step::While { condition, .. } => write!(f, "while {}", show(condition))?,
            Step::Otherwise { .. } => f.write_str("otherwise")?,
            Step::Try { .. } => f.write_str("try")?,
            Step::Assign { target, value, .. } => {
                write!(f, "{} ← {}", spell(self.listing, target), show(value))?;
            }
            Step::Spread { to: Spread::Names { names, cols }, value, .. } => {
                let name = |name: &Slot| spell(self.listing, name).to_string();
                let row = |row: &[Slot]| row.iter().map(name).collect::<Vec<_>>().join("   ");
                let rows: Vec<_> = names.chunks(*cols).map(row).collect();
                write!(f, "({}) ← {}", rows.join("; "), show(value))?
            }
            Step::Spread { to: Spread::Column { name, column, .. }, value, .. } => {
                let name = spell(self.listing, name);
                write!(f, "{name}⟨{}⟩ ← {}", show(column), show(value))?
            }
            Step::Evaluate { value } => write!(f, "{}", show(value))?,
            Step::Return { value } => write!(f, "return {}", show(value))?,
            Step::Break => f.write_str("break")?,
            Step::Continue => f.write_str("continue")?,
        }
        self.item.guard.iter().try_for_each(|guard| write!(f, " if {}", show(guard)))
    }
}

impl Display for Spelled<'_, Slot> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.listing.names.name(*self.item))
    }
}

impl Display for Spelled<'_, Reference> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Reference { name, row, col, .. } = self.item;
        let show = |expr| spell::<Expr>(self.listing, expr);
        match (row, col) {
            (Some(row), Some(col)) => {
                write!(f, "{}[{},{}]", spell(self.listing, name), show(row), show(col))
            }
            (Some(row), None) => write!(f, "{}[{}]", spell(self.listing, name), show(row)),
            _ => write!(f, "{}", spell(self.listing, name)),
        }
    }
}

impl Display for Spelled<'_, Expr> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let show = |expr| spell::<Expr>(self.listing, expr);
        let join = |items, between| join(self.listing, items, between);
        match &self.item.kind {
            Kind::Number(x) => write!(f, "{x}"),
            Kind::Text(text) => write!(f, "\"{text}\""),
            Kind::Read(reference) => write!(f, "{}", spell(self.listing, reference)),
            Kind::Entry { of, subscripts } => write!(f, "{}[{}]", show(of), join(subscripts, ",")),
            Kind::Group(x) => write!(f, "({})", show(x)),
            Kind::Array { entries, cols } => {
                let rows: Vec<_> = entries.chunks(*cols).map(|row| join(row, "   ")).collect();
                write!(f, "({}{})", rows.join("; "), if entries.len() == 1 { ";" } else { "" })
            }
            Kind::Magnitude(x) => write!(f, "|{}|", show(x)),
            Kind::Negative(x) => write!(f, "−{}", show(x)),
            Kind::Not(x) => write!(f, "¬{}", show(x)),
            Kind::Transpose(x) => write!(f, "{}ᵀ", show(x)),
            Kind::Column(x, j) => write!(f, "{}⟨{}⟩", show(x), show(j)),
            Kind::Power(x, y) => write!(f, "{}^{}", show(x), show(y)),
            Kind::Arithmetic(o, x, y) => write!(f, "{} {} {}", show(x), o.sign(), show(y)),
            Kind::Compare(c, x, y) => write!(f, "{} {} {}", show(x), c.sign(), show(y)),
            Kind::Chain(x, rest) => {
                write!(f, "{}", show(x))?;
                rest.iter().try_for_each(|(c, y)| write!(f, " {} {}", c.sign(), show(y)))
            }
            Kind::If(parts) => write!(f, "if({})", join(&**parts, ", ")),
            Kind::All(operands) => f.write_str(&join(operands, " ∧ ")),
            Kind::Any(operands) => f.write_str(&join(operands, " ∨ ")),
            Kind::Call(name, arguments) => {
                write!(f, "{}({})", spell(self.listing, name), join(arguments, ", "))
            }
            Kind::Series { function, name, parts } => {
                let (function, name) = (spell(self.listing, function), spell(self.listing, name));
                let (term, range) = parts.split_last().expect("a term");
                write!(f, "{function}({name} ∈ {}, {})", join(range, " .. "), show(term))
            }
            Kind::Program(block) => {
                f.write_str("{")?;
                inline(self.listing, block, f)
            }
        }
    }
}
