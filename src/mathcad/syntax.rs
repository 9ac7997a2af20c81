//! The syntax tree of a listing, whichever notation it was written in.
//!
//! Names are numbered as they are read: a [`Slot`] indexes the listing's names, and a run keeps
//! each name's value at that place.

use std::cmp::Ordering;

use super::value::Value;

/// The number of a name, counted from 0 in the order of first appearance.
pub type Slot = usize;

/// A statement and the line it stands on, counted from 0 through the listing's lines.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The line, from 0.
    pub line: usize,
    /// What it does.
    pub step: Step,
    /// As many blocks as [`Step::blocks`] says.
    pub blocks: Vec<Vec<Statement>>,
    /// The condition that decides whether it is executed, behind `if`; that of a loop stands for the whole loop.
    pub guard: Option<Expr>,
}

/// The kinds of statements, and what each is made of.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "each form is written above it, in the words of its fields")]
pub enum Step {
    /// `for name ∈ range` and a block; the variable keeps its last value.
    For { name: Slot, range: Range },
    /// `while condition` and a block.
    While { condition: Expr },
    /// The block below `if condition`.
    Block,
    /// `otherwise` and a block, which runs if no `if` above it in its block was true.
    Otherwise,
    /// `try` and a block, then `on error` and a block, which runs if the first one fails.
    Try,
    /// `target ← value`; the target has [`Expr::targets`].
    Assign { target: Expr, value: Expr },
    /// An expression alone.
    Evaluate { value: Expr },
    /// `return value`, which ends the program.
    Return { value: Expr },
    /// `break`, which ends the loop.
    Break,
    /// `continue`, which ends the turn of the loop.
    Continue,
}

/// What a loop runs over.
#[derive(Clone, Debug)]
pub struct Range {
    /// `from` or `from, second` of a range; else the values one after another, of an array its entries,
    /// column by column: `v`, or `1, 5, 9`.
    pub values: Vec<Expr>,
    /// The end of a range, `.. to`.
    pub to: Option<Expr>,
}

/// A part of a line, in bytes of its text.
pub type Span = std::ops::Range<usize>;

/// An expression, what it is made of, and its place in its line.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: Kind,
    /// The expressions directly inside, in their order; those of a program stand in its statements.
    pub parts: Vec<Expr>,
    /// Where it stands in its line.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A number, or a string, `"x"`. Under `→` an entry of an operand, which may be an array.
    Literal(Value),
    /// A name.
    Name(Slot),
    /// An expression in round brackets, `(x)`.
    Group,
    /// An array, `(x   y; z   w)`: its entries row by row, and how many columns it has.
    #[expect(missing_docs, reason = "it is named above")]
    Array { cols: usize },
    /// An operator and its operands.
    Apply(Operator),
    /// Comparisons of each operand with the next, `x < y ≤ z`, of three operands or more.
    Chain(Vec<Comparison>),
    /// A call of a function, `name(x, y)`.
    Call(Slot),
    /// Mathcad's function `if(condition, x, y)`, which evaluates one of the two.
    If,
    /// A sum or product over a range, `∑(i ∈ from .. to, term)` or `∑(i ∈ range, term)`.
    #[expect(missing_docs, reason = "the function, and the variable")]
    Series { function: Slot, name: Slot },
    /// A program within an expression, `{x ← 1; if c {x ← 2}; x}`.
    Program(Vec<Statement>),
}

/// The four operations of arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the name says it")]
pub enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// The six comparisons of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the name says it")]
pub enum Comparison {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// What makes one value of one or more, its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the name says it")]
pub enum Operator {
    /// A disjunction `x ∨ y ∨ z` of two operands or more.
    Any,
    /// A conjunction `x ∧ y ∧ z` of two operands or more.
    All,
    /// Whether a number is 0, `¬x`.
    Not,
    Compare(Comparison),
    Calculate(Operation),
    /// The opposite of a value, `−x`.
    Negative,
    /// A power, `x^y`.
    Power,
    /// The transpose of a value, `xᵀ`.
    Transpose,
    /// A value, and one subscript or two: its entry, `x[i,j]`.
    Entry,
    /// A column of an array, `x⟨j⟩`.
    Column,
    /// The magnitude of a number, the length of a column, the determinant of a matrix, `|x|`.
    Magnitude,
}

/// How tightly an expression binds, from the loosest to the tightest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the name says it")]
pub enum Level {
    Any,
    All,
    Not,
    Comparison,
    Sum,
    Product,
    Negative,
    Power,
    /// With a transpose, subscripts or a column behind it.
    Behind,
    Atom,
}

/// The spelling of an operator in the notations.
#[derive(Debug)]
pub struct Spelling {
    /// The operator.
    pub operator: Operator,
    /// How tightly it binds.
    pub level: Level,
    /// As printed; the first one of brackets.
    pub sign: &'static str,
    /// As typed in ASCII.
    pub typed: &'static str,
    /// The element of XMCD.
    pub element: &'static str,
}

/// All operators, each of which is known by this table alone.
pub const OPERATORS: [Spelling; 19] = {
    use Comparison::*;
    use Operation::*;
    use Operator::*;
    const fn row(
        operator: Operator,
        level: Level,
        [sign, typed, element]: [&'static str; 3],
    ) -> Spelling {
        Spelling { operator, level, sign, typed, element }
    }
    [
        row(Any, Level::Any, ["∨", "or", "ml:or"]),
        row(All, Level::All, ["∧", "and", "ml:and"]),
        row(Not, Level::Not, ["¬", "not", "ml:not"]),
        row(Compare(Equal), Level::Comparison, ["=", "=", "ml:equal"]),
        row(Compare(Unequal), Level::Comparison, ["≠", "!=", "ml:notEqual"]),
        row(Compare(Less), Level::Comparison, ["<", "<", "ml:lessThan"]),
        row(Compare(LessOrEqual), Level::Comparison, ["≤", "<=", "ml:lessOrEqual"]),
        row(Compare(Greater), Level::Comparison, [">", ">", "ml:greaterThan"]),
        row(Compare(GreaterOrEqual), Level::Comparison, ["≥", ">=", "ml:greaterOrEqual"]),
        row(Calculate(Add), Level::Sum, ["+", "+", "ml:plus"]),
        row(Calculate(Subtract), Level::Sum, ["−", "-", "ml:minus"]),
        row(Calculate(Multiply), Level::Product, ["·", "*", "ml:mult"]),
        row(Calculate(Divide), Level::Product, ["/", "/", "ml:div"]),
        row(Negative, Level::Negative, ["−", "-", "ml:neg"]),
        row(Power, Level::Power, ["^", "^", "ml:pow"]),
        row(Transpose, Level::Behind, ["ᵀ", "ᵀ", "ml:transpose"]),
        row(Entry, Level::Behind, ["[", "[", "ml:indexer"]),
        row(Column, Level::Behind, ["⟨", "⟨", "ml:matcol"]),
        row(Magnitude, Level::Atom, ["|", "|", "ml:absval"]),
    ]
};

impl Statement {
    /// Returns the expressions on the statement's own line, in the order of the text, and of what is assigned
    /// to the subscripts.
    pub fn on_line(&self) -> Vec<&Expr> {
        let own: Vec<&Expr> = match &self.step {
            Step::For { range, .. } => range.values.iter().chain(&range.to).collect(),
            Step::While { condition } => vec![condition],
            Step::Assign { target, value } => target.subscripts().iter().chain([value]).collect(),
            Step::Evaluate { value } | Step::Return { value } => vec![value],
            Step::Block | Step::Otherwise | Step::Try | Step::Break | Step::Continue => vec![],
        };
        own.into_iter().chain(&self.guard).collect()
    }

    /// Returns how deep statements and expressions stand within each other, at most `limit`.
    pub fn depth(&self, limit: usize) -> usize {
        if limit == 0 {
            return 0;
        }
        let own = self.on_line().into_iter().map(|expr| expr.depth(limit - 1));
        let below = self.blocks.iter().flatten().map(|below| below.depth(limit - 1));
        1 + own.chain(below).max().unwrap_or(0)
    }
}

impl Step {
    /// Returns how many blocks stand below it.
    pub fn blocks(&self) -> usize {
        match self {
            Step::For { .. } | Step::While { .. } | Step::Block | Step::Otherwise => 1,
            Step::Try => 2,
            Step::Assign { .. } | Step::Evaluate { .. } | Step::Return { .. } => 0,
            Step::Break | Step::Continue => 0,
        }
    }

    /// Returns the names that the statement itself writes to.
    pub fn written(&self) -> Vec<Slot> {
        match self {
            Step::For { name, .. } => vec![*name],
            Step::Assign { target, .. } => target.targets().unwrap_or_default(),
            Step::While { .. } | Step::Block | Step::Otherwise | Step::Try => vec![],
            Step::Evaluate { .. } | Step::Return { .. } | Step::Break | Step::Continue => vec![],
        }
    }
}

impl Operator {
    /// Returns the operator's row of [`OPERATORS`].
    pub fn spelling(self) -> &'static Spelling {
        OPERATORS.iter().find(|row| row.operator == self).expect("every operator has a row")
    }
}

impl Operation {
    /// Returns the sign by which the listing writes it.
    pub fn sign(self) -> &'static str {
        Operator::Calculate(self).spelling().sign
    }
}

impl Comparison {
    /// Returns whether the comparison is true of two values in that order.
    pub fn is_true_of(self, order: Ordering) -> bool {
        match self {
            Comparison::Equal => order.is_eq(),
            Comparison::Unequal => order.is_ne(),
            Comparison::Less => order.is_lt(),
            Comparison::LessOrEqual => order.is_le(),
            Comparison::Greater => order.is_gt(),
            Comparison::GreaterOrEqual => order.is_ge(),
        }
    }
}

impl Expr {
    /// Returns the names that an assignment to it writes to: of `x`, `x[i,j]` and `x⟨j⟩` one, of `(x   y)`
    /// those of its entries; nothing of what cannot be assigned to.
    pub fn targets(&self) -> Option<Vec<Slot>> {
        match self.kind {
            Kind::Name(slot) => Some(vec![slot]),
            Kind::Array { .. } => self.parts.iter().map(Expr::name).collect(),
            Kind::Apply(Operator::Entry | Operator::Column) => Some(vec![self.parts[0].name()?]),
            _ => None,
        }
    }

    /// Returns the name, if it is one alone.
    pub fn name(&self) -> Option<Slot> {
        if let Kind::Name(slot) = self.kind { Some(slot) } else { None }
    }

    /// Returns the subscripts of an entry, and the one of a column.
    pub fn subscripts(&self) -> &[Expr] {
        match self.kind {
            Kind::Apply(Operator::Entry | Operator::Column) => &self.parts[1..],
            _ => &[],
        }
    }

    /// Returns whether it is a name with subscripts.
    pub fn is_entry(&self) -> bool {
        matches!(self.kind, Kind::Apply(Operator::Entry)) && self.parts[0].name().is_some()
    }

    /// Returns how tightly it binds.
    pub fn level(&self) -> Level {
        match &self.kind {
            Kind::Apply(_) if self.is_entry() => Level::Atom,
            Kind::Apply(operator) => operator.spelling().level,
            Kind::Chain(_) => Level::Comparison,
            Kind::Literal(_)
            | Kind::Name(_)
            | Kind::Group
            | Kind::Array { .. }
            | Kind::Call(_)
            | Kind::If
            | Kind::Series { .. }
            | Kind::Program(_) => Level::Atom,
        }
    }

    /// Returns how deep expressions and statements stand within each other, at most `limit`.
    pub fn depth(&self, limit: usize) -> usize {
        if limit == 0 {
            return 0;
        }
        let program: &[Statement] = if let Kind::Program(block) = &self.kind { block } else { &[] };
        let inside = self.parts.iter().map(|part| part.depth(limit - 1));
        let inside = inside.chain(program.iter().map(|statement| statement.depth(limit - 1)));
        1 + inside.max().unwrap_or(0)
    }
}
