//! Spells a syntax tree out: the listing's own text again, but for spaces.

use std::fmt::{self, Display, Formatter};

use crate::paper::mathcad::Listing;
use crate::paper::mathcad::syntax::{Expr, Kind, Reference, Slot, Statement, Step};

impl Listing {
    /// Returns the listing as its syntax tree spells it: what was understood, for comparison with
    /// what was printed.
    pub(super) fn spelled(&self) -> String {
        let parameters: Vec<_> =
            self.parameters.iter().map(|&slot| self.names.name(slot)).collect();
        // The function's name is the first that a listing writes.
        let mut text = format!("{}({}) :=\n", self.names.name(0), parameters.join(", "));
        self.block(&self.program, 1, &mut text);
        text
    }

    fn block(&self, block: &[Statement], level: usize, text: &mut String) {
        for Statement { step, .. } in block {
            text.push_str(&format!("{:1$}{2}\n", "", 2 * level, self.show(step)));
            if let Step::For { body, .. } | Step::If { body, .. } = step {
                self.block(body, level + 1, text);
            }
        }
    }

    fn show<'a, T>(&'a self, item: &'a T) -> Spelled<'a, T> {
        Spelled { listing: self, item }
    }

    fn join(&self, items: &[Expr], between: &str) -> String {
        items.iter().map(|item| self.show(item).to_string()).collect::<Vec<_>>().join(between)
    }
}

struct Spelled<'a, T> {
    listing: &'a Listing,
    item: &'a T,
}

impl Display for Spelled<'_, Step> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let show = |expr| self.listing.show(expr);
        let guard = match self.item {
            Step::For { name, from, to, guard, .. } => {
                write!(f, "for {} ∈ {} .. {}", self.listing.show(name), show(from), show(to))?;
                guard
            }
            Step::If { condition, .. } => return write!(f, "if {}", show(condition)),
            Step::Assign { target, value, guard } => {
                write!(f, "{} ← {}", self.listing.show(target), show(value))?;
                guard
            }
            Step::Evaluate { value, guard } => {
                write!(f, "{}", show(value))?;
                guard
            }
        };
        guard.iter().try_for_each(|guard| write!(f, " if {}", show(guard)))
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
        let show = |expr| self.listing.show::<Expr>(expr);
        match (row, col) {
            (Some(row), Some(col)) => {
                write!(f, "{}[{},{}]", self.listing.show(name), show(row), show(col))
            }
            (Some(row), None) => write!(f, "{}[{}]", self.listing.show(name), show(row)),
            _ => write!(f, "{}", self.listing.show(name)),
        }
    }
}

impl Display for Spelled<'_, Expr> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let show = |expr| self.listing.show::<Expr>(expr);
        let join = |items, between| self.listing.join(items, between);
        match &self.item.kind {
            Kind::Number(x) => write!(f, "{x}"),
            Kind::Read(reference) => write!(f, "{}", self.listing.show(reference)),
            Kind::Group(x) => write!(f, "({})", show(x)),
            Kind::Row(elements) => write!(f, "({})", join(elements, "   ")),
            Kind::Magnitude(x) => write!(f, "|{}|", show(x)),
            Kind::Negative(x) => write!(f, "−{}", show(x)),
            Kind::Transpose(x) => write!(f, "{}ᵀ", show(x)),
            Kind::Arithmetic(o, x, y) => write!(f, "{} {} {}", show(x), o.sign(), show(y)),
            Kind::Compare(c, x, y) => write!(f, "{} {} {}", show(x), c.sign(), show(y)),
            Kind::All(operands) => f.write_str(&join(operands, " ∧ ")),
            Kind::Call(name, arguments) => {
                write!(f, "{}({})", self.listing.show(name), join(arguments, ", "))
            }
        }
    }
}
