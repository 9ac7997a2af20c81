//! The syntax tree of a listing.
//!
//! Names are numbered as they are read: a [`Slot`] indexes the listing's names, and a run keeps
//! each name's value at that place.

use std::ops::Range;

/// The number of a name, counted from 0 in the order of first appearance.
pub type Slot = usize;

/// A statement and the line it stands on, counted from 0 through the listing's lines.
#[derive(Clone, Debug)]
pub struct Statement {
    pub line: usize,
    pub step: Step,
}

/// The kinds of statements, and what each is made of.
#[derive(Clone, Debug)]
pub enum Step {
    /// `for name ∈ from .. to`, and `if guard` for the whole loop.
    For {
        /// The loop variable, which keeps its last value.
        name: Slot,
        from: Expr,
        to: Expr,
        /// The condition under which the loop runs at all.
        guard: Option<Expr>,
        body: Vec<Statement>,
    },
    /// `if condition` and a block.
    If { condition: Expr, body: Vec<Statement> },
    /// `target ← value if guard`.
    Assign { target: Reference, value: Expr, guard: Option<Expr> },
    /// An expression alone, `if guard`.
    Evaluate { value: Expr, guard: Option<Expr> },
}

/// A name, or an entry of the array of that name.
#[derive(Clone, Debug)]
pub struct Reference {
    pub name: Slot,
    /// The first subscript, if there is one.
    pub row: Option<Box<Expr>>,
    /// The second subscript, if there is one.
    pub col: Option<Box<Expr>>,
    pub span: Span,
}

/// A part of a line, in bytes of its text.
pub type Span = Range<usize>;

/// An expression and its place in its line.
#[derive(Clone, Debug)]
pub struct Expr {
    pub kind: Kind,
    pub span: Span,
}

/// The kinds of expressions, and what each is made of.
#[derive(Clone, Debug)]
pub enum Kind {
    Number(f64),
    Read(Reference),
    /// An expression in round brackets, `(x)`.
    Group(Box<Expr>),
    /// A row of numbers, `(x   y   z)`.
    Row(Vec<Expr>),
    /// The magnitude of a number, `|x|`.
    Magnitude(Box<Expr>),
    /// The opposite of a value, `−x`.
    Negative(Box<Expr>),
    /// The transpose of a value, `xᵀ`.
    Transpose(Box<Expr>),
    /// A sum `x + y`, or its kin.
    Arithmetic(Operation, Box<Expr>, Box<Expr>),
    /// A comparison `x < y`, or its kin.
    Compare(Comparison, Box<Expr>, Box<Expr>),
    /// A conjunction `x ∧ y ∧ z` of two operands or more.
    All(Vec<Expr>),
    /// A call of a function, `name(x, y)`.
    Call(Slot, Vec<Expr>),
}

/// The four operations of arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// The six comparisons of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Step {
    /// Returns the expressions on the statement's own line, in the order of the text.
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

    /// Returns the condition of the statement, if it has one.
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
    /// Returns the subscripts: none, one or two.
    pub fn subscripts(&self) -> impl Iterator<Item = &Expr> {
        [&self.row, &self.col].into_iter().flatten().map(Box::as_ref)
    }
}

impl Operation {
    /// Returns the sign by which the listing writes it.
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
    pub const ALL: [Comparison; 6] = [
        Comparison::Equal,
        Comparison::Unequal,
        Comparison::Less,
        Comparison::LessOrEqual,
        Comparison::Greater,
        Comparison::GreaterOrEqual,
    ];

    /// Returns the sign by which the listing writes it.
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
    /// Returns the expressions directly inside.
    pub fn parts(&self) -> Vec<&Expr> {
        match &self.kind {
            Kind::Number(_) => vec![],
            Kind::Read(r) => r.subscripts().collect(),
            Kind::Group(x) | Kind::Magnitude(x) | Kind::Negative(x) | Kind::Transpose(x) => vec![x],
            Kind::Arithmetic(_, x, y) | Kind::Compare(_, x, y) => vec![x, y],
            Kind::Row(xs) | Kind::All(xs) | Kind::Call(_, xs) => xs.iter().collect(),
        }
    }

    /// Returns whether expressions stand within each other more than `limit` deep.
    pub fn deeper_than(&self, limit: usize) -> bool {
        limit == 0 || self.parts().into_iter().any(|part| part.deeper_than(limit - 1))
    }
}
