//! The grammar of one line.
//!
//! From the loosest to the tightest: `∨`, `∧`, `¬`, comparisons, `+ −`, `· /`, the sign `−x`,
//! one power, and behind an operand `xᵀ`, `x[i]`, `x⟨j⟩`. Operators of one level group from the
//! left, but for a chain of comparisons, `a < b < c`, which is `a < b ∧ b < c`.
//!
//! No alternative reads a bracket a second time: nested ones would take twice as long a level.

use std::collections::BTreeSet;

use chumsky::error::{RichPattern, RichReason};
use chumsky::input::MappedInput;
use chumsky::pratt::{infix, left};
use chumsky::prelude::*;

use super::lexer::{ARROW, Complaint, Spanned, Token};
use super::syntax::{Comparison, Expr, Kind, Operation, Range, Reference, Slot, Statement, Step};

type Tokens<'t> = MappedInput<'t, Token, SimpleSpan, &'t [Spanned]>;
type Extra<'t> = extra::Err<Rich<'t, Token>>;
type Grammar<'t, T> = Boxed<'t, 't, Tokens<'t>, T, Extra<'t>>;

/// Reads the first line of a listing, `name(parameters) :=`, and returns the parameters.
pub fn header(tokens: &[Spanned]) -> Result<Vec<Slot>, Complaint> {
    parse(header_grammar(), tokens)
}

/// Reads a line of a program, `line` being its place in the listing from 0. Blocks below it are
/// left empty; that of `x otherwise` is `x`.
pub fn statement(tokens: &[Spanned], line: usize) -> Result<Statement, Complaint> {
    Ok(Statement { line, step: parse(step_grammar(line), tokens)? })
}

fn parse<'t, T>(grammar: Grammar<'t, T>, tokens: &'t [Spanned]) -> Result<T, Complaint> {
    let end = tokens.last().map_or(0, |(_, span)| span.end);
    let input = tokens.split_token_span((end..end).into());
    grammar.parse(input).into_result().map_err(|errors| complaint(&errors))
}

fn complaint(errors: &[Rich<'_, Token>]) -> Complaint {
    let error = &errors[0];
    if error.found() == Some(&Token::Sign("<-")) {
        return (error.span().start, format!("found {ARROW}"));
    }
    if let RichReason::Custom(message) = error.reason() {
        return (error.span().start, format!("found {message}"));
    }
    let expected: BTreeSet<_> = error.expected().map(pattern).collect();
    let expected = expected.into_iter().collect::<Vec<_>>().join(" or ");
    (error.span().start, format!("found {}, expected {expected}", found(error.found())))
}

fn pattern(pattern: &RichPattern<'_, Token>) -> String {
    match pattern {
        RichPattern::Token(token) => found(Some(token)),
        RichPattern::Label(label) => label.to_string(),
        _ => found(None),
    }
}

fn found(token: Option<&Token>) -> String {
    match token {
        Some(words @ (Token::Name(_) | Token::Function(_) | Token::Gap)) => words.to_string(),
        Some(token) => format!("`{token}`"),
        None => "the end of the line".into(),
    }
}

fn sign<'t>(text: &'static str) -> Grammar<'t, ()> {
    just(Token::Sign(text)).ignored().boxed()
}

fn name<'t>() -> Grammar<'t, Slot> {
    select! { Token::Name(slot) => slot }.labelled("a name").boxed()
}

fn function<'t>() -> Grammar<'t, Slot> {
    select! { Token::Function(slot) => slot }.labelled("a function").boxed()
}

fn header_grammar<'t>() -> Grammar<'t, Vec<Slot>> {
    let parameters = name().separated_by(sign(",")).collect().delimited_by(sign("("), sign(")"));
    function().ignore_then(parameters).then_ignore(sign(":=")).boxed()
}

fn step_grammar<'t>(line: usize) -> Grammar<'t, Step> {
    let guard = sign("if").ignore_then(expression()).or_not().boxed();
    let every = sign("for").ignore_then(name()).then_ignore(sign("∈")).then(range());
    let every = every.then(guard.clone()).map(|((name, range), guard)| Step::For {
        name,
        range,
        guard,
        body: vec![],
    });
    let when =
        sign("if").ignore_then(expression()).map(|condition| Step::If { condition, body: vec![] });
    let while_ = sign("while").ignore_then(expression());
    let while_ = while_.map(|condition| Step::While { condition, body: vec![] });
    let otherwise = sign("otherwise").map(|()| Step::Otherwise { body: vec![] });
    let attempt = sign("try").map(|()| Step::Try { body: vec![], fallback: vec![] });
    let result = sign("return").ignore_then(expression()).then(guard.clone());
    let result = result.map(|(value, guard)| Step::Return { value, guard });
    let leave = sign("break").ignore_then(guard.clone()).map(|guard| Step::Break { guard });
    let next = sign("continue").ignore_then(guard.clone()).map(|guard| Step::Continue { guard });
    let arrow = select! { Token::Sign("←" | "<-" | ":=") => () }.labelled("`←`");
    let assign = reference(expression()).then_ignore(arrow).then(expression()).then(guard.clone());
    let assign = assign.map(|((target, value), guard)| Step::Assign { target, value, guard });
    let evaluate = expression().then(guard).map(|(value, guard)| Step::Evaluate { value, guard });
    let words = choice((while_, otherwise, attempt));
    let alone = choice((result, leave, next, assign, evaluate)).then(sign("otherwise").or_not());
    let alone = alone.try_map(move |(step, otherwise), span| match otherwise {
        None => Ok(step),
        Some(()) if step.condition().is_some() => {
            Err(Rich::custom(span, "`if` and `otherwise` on one line"))
        }
        Some(()) => Ok(Step::Otherwise { body: vec![Statement { line, step }] }),
    });
    choice((every, when, words, alone)).boxed()
}

/// Reads `from .. to`, `from, second .. to`, or values one after another.
fn range<'t>() -> Grammar<'t, Range> {
    let values = expression().separated_by(sign(",")).at_least(1).collect::<Vec<_>>();
    let end = sign("..").ignore_then(expression()).or_not();
    let range = values.then(end).try_map(|(mut values, end), _| match (end, values.len()) {
        (None, _) => Ok(Range::Over(values)),
        (Some(to), 1 | 2) => {
            let from = values.remove(0);
            Ok(Range::Span { from, second: values.pop(), to })
        }
        (Some(to), _) => {
            let span = values[0].span.start..to.span.end;
            Err(Rich::custom(span.into(), "a range within a list"))
        }
    });
    range.boxed()
}

fn expression<'t>() -> Grammar<'t, Expr> {
    let expression = recursive(|expression| {
        let comparison = comparison(operand(expression.boxed()));
        let opposite = sign("¬").repeated().count().then(comparison);
        let opposite = opposite.map_with(|(times, x), e| {
            (0..times).fold(x, |x, _| node(Kind::Not(Box::new(x)), e.span()))
        });
        let all = opposite.separated_by(sign("∧")).at_least(1).collect();
        let all = all.map(|operands| joined(operands, Kind::All));
        let any = all.separated_by(sign("∨")).at_least(1).collect();
        any.map(|operands| joined(operands, Kind::Any))
    });
    expression.boxed()
}

fn comparison<'t>(operand: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let arithmetic = |operations: [Operation; 2]| {
        let known = move |sign| operations.into_iter().find(|operation| operation.sign() == sign);
        select! { Token::Sign(sign) if known(sign).is_some() => known(sign) }
            .unwrapped()
            .labelled("an operator")
    };
    let known = |sign| Comparison::ALL.into_iter().find(|comparison| comparison.sign() == sign);
    let compare = select! { Token::Sign(sign) if known(sign).is_some() => known(sign) };
    let compare = compare.unwrapped().labelled("a comparison");
    let levels = (
        infix(left(3), arithmetic([Operation::Multiply, Operation::Divide]), |l, o, r, _| {
            calculation(o, l, r)
        }),
        infix(left(2), arithmetic([Operation::Add, Operation::Subtract]), |l, o, r, _| {
            calculation(o, l, r)
        }),
    );
    let sum = operand.pratt(levels).boxed();
    let chain = sum.clone().then(compare.then(sum).repeated().collect::<Vec<_>>());
    chain.map(|(first, rest)| chained(first, rest)).boxed()
}

fn operand<'t>(expression: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let tight = behind(atom(expression.clone()), expression);
    let negative = |x: Grammar<'t, Expr>| {
        let negative = sign("−").ignore_then(x.clone());
        negative.map_with(|x, e| node(Kind::Negative(Box::new(x)), e.span())).or(x).boxed()
    };
    let power = tight.clone().then(sign("^").ignore_then(negative(tight)).or_not());
    let power = power.map_with(|(x, exponent), e| match exponent {
        Some(y) => node(Kind::Power(Box::new(x), Box::new(y)), e.span()),
        None => x,
    });
    negative(power.boxed()).labelled("an operand").boxed()
}

/// What may stand behind an operand.
enum Behind {
    Transpose,
    Subscripts(Vec<Expr>),
    Column(Expr),
}

fn behind<'t>(atom: Grammar<'t, Expr>, expression: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let subscripts = expression.clone().separated_by(sign(",")).at_least(1).at_most(2).collect();
    let behind = choice((
        sign("ᵀ").map(|()| Behind::Transpose),
        subscripts.delimited_by(sign("["), sign("]")).map(Behind::Subscripts),
        expression.delimited_by(sign("⟨"), sign("⟩")).map(Behind::Column),
    ));
    let whole = atom.foldl_with(behind.repeated(), |x, behind, e| {
        let of = Box::new(x);
        let kind = match behind {
            Behind::Transpose => Kind::Transpose(of),
            Behind::Subscripts(subscripts) if is_name(&of) => entry(*of, subscripts, e.span()),
            Behind::Subscripts(subscripts) => Kind::Entry { of, subscripts },
            Behind::Column(column) => Kind::Column(of, Box::new(column)),
        };
        node(kind, e.span())
    });
    whole.boxed()
}

fn is_name(expr: &Expr) -> bool {
    matches!(&expr.kind, Kind::Read(reference) if reference.row.is_none())
}

/// Makes the entry of a name.
fn entry(name: Expr, subscripts: Vec<Expr>, span: SimpleSpan) -> Kind {
    let mut subscripts = subscripts.into_iter().map(Box::new);
    let (row, col) = (subscripts.next(), subscripts.next());
    match name.kind {
        Kind::Read(reference) => {
            Kind::Read(Reference { row, col, span: span.into_range(), ..reference })
        }
        other => other,
    }
}

fn atom<'t>(expression: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let plain = select! {
        Token::Number(x) => Kind::Number(x),
        Token::Text(text) => Kind::Text(text),
    };
    let range = name().then_ignore(sign("∈")).then(expression.clone()).then_ignore(sign(".."));
    let series = range.then(expression.clone()).then_ignore(sign(",")).then(expression.clone());
    let series = function().then(series.delimited_by(sign("("), sign(")")));
    let series = series.map(|(function, (((name, from), to), term))| Kind::Series {
        function,
        name,
        parts: Box::new([from, to, term]),
    });
    let arguments =
        expression.clone().separated_by(sign(",")).collect().delimited_by(sign("("), sign(")"));
    let call = function().then(arguments).map(|(name, arguments)| Kind::Call(name, arguments));
    let parts = [(); 2].map(|()| sign(",").ignore_then(expression.clone()));
    let [then, other] = parts;
    let parts = expression.clone().then(then).then(other).delimited_by(sign("("), sign(")"));
    let choice_of = sign("if").ignore_then(parts);
    let choice_of = choice_of.map(|((condition, x), y)| Kind::If(Box::new([condition, x, y])));
    let read = name().map_with(|name, e| {
        let span = e.span().into_range();
        Kind::Read(Reference { name, row: None, col: None, span })
    });
    let row = expression.clone().separated_by(just(Token::Gap)).at_least(1).collect::<Vec<_>>();
    let rows = row.separated_by(sign(";")).at_least(1).collect::<Vec<_>>();
    let rows = rows.delimited_by(sign("("), sign(")")).try_map(|rows, span| {
        bracketed(rows).ok_or_else(|| Rich::custom(span, "rows of different lengths"))
    });
    let magnitude = expression
        .delimited_by(sign("|"), just(Token::ClosingBar))
        .map(|x| Kind::Magnitude(Box::new(x)));
    let transpose = sign("transpose").ignore_then(rows.clone());
    let transpose = transpose.map_with(|rows, e| match rows {
        Kind::Group(x) => Kind::Transpose(x),
        array => Kind::Transpose(Box::new(node(array, e.span()))),
    });
    choice((plain, series, call, choice_of, read, rows, magnitude, transpose))
        .map_with(|kind, e| node(kind, e.span()))
        .boxed()
}

fn reference<'t>(expression: Grammar<'t, Expr>) -> Grammar<'t, Reference> {
    let column = sign(",").ignore_then(expression.clone()).or_not();
    let subscripts = expression.then(column).delimited_by(sign("["), sign("]")).or_not();
    let reference = name().then(subscripts).map_with(|(name, subscripts), e| {
        let (row, col) =
            subscripts.map_or((None, None), |(row, col)| (Some(Box::new(row)), col.map(Box::new)));
        Reference { name, row, col, span: e.span().into_range() }
    });
    reference.boxed()
}

fn node(kind: Kind, span: SimpleSpan) -> Expr {
    Expr { kind, span: span.into_range() }
}

fn calculation(operation: Operation, l: Expr, r: Expr) -> Expr {
    let span = l.span.start..r.span.end;
    Expr { kind: Kind::Arithmetic(operation, Box::new(l), Box::new(r)), span }
}

/// Compares each operand with the next; one alone is itself.
fn chained(first: Expr, mut rest: Vec<(Comparison, Expr)>) -> Expr {
    let Some((_, last)) = rest.last() else { return first };
    let (span, first) = (first.span.start..last.span.end, Box::new(first));
    let kind = if rest.len() == 1 {
        let (comparison, second) = rest.remove(0);
        Kind::Compare(comparison, first, Box::new(second))
    } else {
        Kind::Chain(first, rest)
    };
    Expr { kind, span }
}

/// Joins operands, at least one; one alone is itself.
fn joined(mut operands: Vec<Expr>, by: fn(Vec<Expr>) -> Kind) -> Expr {
    if operands.len() == 1 {
        return operands.remove(0);
    }
    let span = operands[0].span.start..operands[operands.len() - 1].span.end;
    Expr { kind: by(operands), span }
}

/// Makes what stands between round brackets: one expression is that expression, several are an
/// array, if its rows are of one length.
fn bracketed(mut rows: Vec<Vec<Expr>>) -> Option<Kind> {
    let cols = rows[0].len();
    if rows.len() == 1 && cols == 1 {
        return Some(Kind::Group(Box::new(rows.remove(0).remove(0))));
    }
    let even = rows.iter().all(|row| row.len() == cols);
    even.then(|| Kind::Array { entries: rows.into_iter().flatten().collect(), cols })
}
