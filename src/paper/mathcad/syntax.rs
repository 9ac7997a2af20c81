//! The syntax tree of a listing.
//!
//! Names are numbered as they are read: a [`Slot`] indexes the listing's names, and a run keeps each name's value at
//! that place.

use std::ops::Range;

/// The number of a name.
pub type Slot = usize;

/// A statement and the line it stands on, counted from 0 through the listing's lines.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Which line.
    pub line: usize,
    /// What it does.
    pub step: Step,
}

/// What a statement does.
#[derive(Clone, Debug)]
pub enum Step {
    /// `for name ∈ from .. to`, and `if guard` for the whole loop.
    For {
        /// The loop variable.
        name: Slot,
        /// The range's start.
        from: Expr,
        /// The range's end.
        to: Expr,
        /// The condition under which the loop runs at all.
        guard: Option<Expr>,
        /// The indented lines.
        body: Vec<Statement>,
    },
    /// `if condition` and a block.
    If {
        /// The condition.
        condition: Expr,
        /// The indented lines.
        body: Vec<Statement>,
    },
    /// `target ← value if guard`.
    Assign {
        /// The name or entry written to.
        target: Reference,
        /// Its new value.
        value: Expr,
        /// The condition.
        guard: Option<Expr>,
    },
    /// An expression alone, `if guard`.
    Evaluate {
        /// The expression.
        value: Expr,
        /// The condition.
        guard: Option<Expr>,
    },
}

/// A name, or an entry of the array of that name.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The name.
    pub name: Slot,
    /// The first subscript.
    pub row: Option<Box<Expr>>,
    /// The second subscript.
    pub col: Option<Box<Expr>>,
    /// Where it stands in its line, in bytes.
    pub span: Span,
}

/// A part of a line, in bytes.
pub type Span = Range<usize>;

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: Kind,
    /// Where it stands in its line, in bytes.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A number.
    Number(f64),
    /// A name or an entry.
    Read(Reference),
    /// `(x)`.
    Group(Box<Expr>),
    /// `(x   y   z)`: a row.
    Row(Vec<Expr>),
    /// `|x|`.
    Magnitude(Box<Expr>),
    /// `−x`.
    Negative(Box<Expr>),
    /// `xᵀ`.
    Transpose(Box<Expr>),
    /// `x + y` and its kin.
    Arithmetic(Operation, Box<Expr>, Box<Expr>),
    /// `x < y` and its kin.
    Compare(Comparison, Box<Expr>, Box<Expr>),
    /// `x ∧ y ∧ z`.
    All(Vec<Expr>),
    /// `name(x, y)`.
    Call(Slot, Vec<Expr>),
}

/// The four operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// `+`
    Add,
    /// `−`
    Subtract,
    /// `·`
    Multiply,
    /// `/`
    Divide,
}

/// The six comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `=`
    Equal,
    /// `≠`
    Unequal,
    /// `<`
    Less,
    /// `≤`
    LessOrEqual,
    /// `>`
    Greater,
    /// `≥`
    GreaterOrEqual,
}

impl Step {
    /// The expressions on the statement's own line, in the order of the text.
    pub fn expressions(&self) -> Vec<&Expr> {
        match self {
            Step::For { from, to, guard, .. } => [from, to].into_iter().chain(guard).collect(),
            Step::If { condition, .. } => vec![condition],
            Step::Assign { target, value, guard } => {
                target.subscripts().chain([value]).chain(guard).collect()
            }
            Step::Evaluate { value, guard } => [value].into_iter().chain(guard).collect(),
        }
    }

    /// The condition of the statement, if it has one.
    pub fn condition(&self) -> Option<&Expr> {
        match self {
            Step::If { condition, .. } => Some(condition),
            Step::For { guard, .. } | Step::Assign { guard, .. } | Step::Evaluate { guard, .. } => {
                guard.as_ref()
            }
        }
    }
}

impl Reference {
    /// The subscripts: none, one or two.
    pub fn subscripts(&self) -> impl Iterator<Item = &Expr> {
        [&self.row, &self.col].into_iter().flatten().map(Box::as_ref)
    }
}

impl Operation {
    /// How the listing writes it.
    pub fn sign(self) -> &'static str {
        match self {
            Operation::Add => "+",
            Operation::Subtract => "−",
            Operation::Multiply => "·",
            Operation::Divide => "/",
        }
    }
}

impl Comparison {
    /// All of them.
    pub const ALL: [Comparison; 6] = [
        Comparison::Equal,
        Comparison::Unequal,
        Comparison::Less,
        Comparison::LessOrEqual,
        Comparison::Greater,
        Comparison::GreaterOrEqual,
    ];

    /// How the listing writes it.
    pub fn sign(self) -> &'static str {
        match self {
            Comparison::Equal => "=",
            Comparison::Unequal => "≠",
            Comparison::Less => "<",
            Comparison::LessOrEqual => "≤",
            Comparison::Greater => ">",
            Comparison::GreaterOrEqual => "≥",
        }
    }
}

impl Expr {
    /// The expressions directly inside.
    pub fn parts(&self) -> Vec<&Expr> {
        match &self.kind {
            Kind::Number(_) => vec![],
            Kind::Read(r) => r.subscripts().collect(),
            Kind::Group(x) | Kind::Magnitude(x) | Kind::Negative(x) | Kind::Transpose(x) => vec![x],
            Kind::Arithmetic(_, x, y) | Kind::Compare(_, x, y) => vec![x, y],
            Kind::Row(xs) | Kind::All(xs) | Kind::Call(_, xs) => xs.iter().collect(),
        }
    }

    /// True when expressions stand within each other more than `limit` deep.
    pub fn deeper_than(&self, limit: usize) -> bool {
        limit == 0 || self.parts().into_iter().any(|part| part.deeper_than(limit - 1))
    }
}
