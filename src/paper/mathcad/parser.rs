//! The grammar of one line.
//!
//! From the loosest to the tightest: `∧`, one comparison, `+ −`, `· /`, the sign `−x`, `xᵀ`.
//! Operators of one level group from the left.

use std::collections::BTreeSet;

use chumsky::error::RichPattern;
use chumsky::input::MappedInput;
use chumsky::pratt::{infix, left, none};
use chumsky::prelude::*;

use super::lexer::{Complaint, Spanned, Token};
use super::syntax::{Comparison, Expr, Kind, Operation, Reference, Slot, Statement, Step};

type Tokens<'t> = MappedInput<'t, Token, SimpleSpan, &'t [Spanned]>;
type Extra<'t> = extra::Err<Rich<'t, Token>>;
type Grammar<'t, T> = Boxed<'t, 't, Tokens<'t>, T, Extra<'t>>;

/// Reads the first line of a listing, `name(parameters) :=`, and returns the parameters.
pub fn header(tokens: &[Spanned]) -> Result<Vec<Slot>, Complaint> {
    parse(header_grammar(), tokens)
}

/// Reads a line of a program, `line` being its place in the listing from 0. The bodies of `for` and
/// `if` are left empty.
pub fn statement(tokens: &[Spanned], line: usize) -> Result<Statement, Complaint> {
    Ok(Statement { line, step: parse(step_grammar(), tokens)? })
}

fn parse<'t, T>(grammar: Grammar<'t, T>, tokens: &'t [Spanned]) -> Result<T, Complaint> {
    let end = tokens.last().map_or(0, |(_, span)| span.end);
    let input = tokens.split_token_span((end..end).into());
    grammar.parse(input).into_result().map_err(|errors| complaint(&errors))
}

fn complaint(errors: &[Rich<'_, Token>]) -> Complaint {
    let error = &errors[0];
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

fn step_grammar<'t>() -> Grammar<'t, Step> {
    let guard = sign("if").ignore_then(expression()).or_not().boxed();
    let range = expression().then_ignore(sign("..")).then(expression());
    let every = sign("for")
        .ignore_then(name())
        .then_ignore(sign("∈"))
        .then(range)
        .then(guard.clone())
        .map(|((name, (from, to)), guard)| Step::For { name, from, to, guard, body: vec![] });
    let when =
        sign("if").ignore_then(expression()).map(|condition| Step::If { condition, body: vec![] });
    let assign =
        reference(expression()).then_ignore(sign("←")).then(expression()).then(guard.clone());
    let assign = assign.map(|((target, value), guard)| Step::Assign { target, value, guard });
    let evaluate = expression().then(guard).map(|(value, guard)| Step::Evaluate { value, guard });
    choice((every, when, assign, evaluate)).boxed()
}

fn expression<'t>() -> Grammar<'t, Expr> {
    let expression = recursive(|expression| {
        let comparison = comparison(operand(expression.boxed()));
        comparison.separated_by(sign("∧")).at_least(1).collect().map(all)
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
        infix(none(1), compare, |l, c, r, _| comparing(c, l, r)),
    );
    operand.pratt(levels).boxed()
}

fn operand<'t>(expression: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let transposed = atom(expression).then(sign("ᵀ").repeated().count());
    let transposed = transposed.map_with(|(x, times), e| {
        (0..times).fold(x, |x, _| node(Kind::Transpose(Box::new(x)), e.span()))
    });
    let negative = sign("−").ignore_then(transposed.clone());
    let negative = negative.map_with(|x, e| node(Kind::Negative(Box::new(x)), e.span()));
    negative.or(transposed).labelled("an operand").boxed()
}

fn atom<'t>(expression: Grammar<'t, Expr>) -> Grammar<'t, Expr> {
    let number = select! { Token::Number(x) => Kind::Number(x) };
    let arguments =
        expression.clone().separated_by(sign(",")).collect().delimited_by(sign("("), sign(")"));
    let call = function().then(arguments).map(|(name, arguments)| Kind::Call(name, arguments));
    let read = reference(expression.clone()).map(Kind::Read);
    let elements = expression.clone().separated_by(just(Token::Gap)).at_least(1).collect();
    let row = elements.delimited_by(sign("("), sign(")")).map(bracketed);
    let magnitude = expression
        .delimited_by(sign("|"), just(Token::ClosingBar))
        .map(|x| Kind::Magnitude(Box::new(x)));
    choice((number, call, read, row, magnitude)).map_with(|kind, e| node(kind, e.span())).boxed()
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

fn comparing(comparison: Comparison, l: Expr, r: Expr) -> Expr {
    let span = l.span.start..r.span.end;
    Expr { kind: Kind::Compare(comparison, Box::new(l), Box::new(r)), span }
}

/// Joins operands by `∧`, at least one; one alone is itself.
fn all(mut operands: Vec<Expr>) -> Expr {
    if operands.len() == 1 {
        return operands.remove(0);
    }
    let span = operands[0].span.start..operands[operands.len() - 1].span.end;
    Expr { kind: Kind::All(operands), span }
}

/// Makes what stands between round brackets: one expression is that expression, several are a row.
fn bracketed(mut elements: Vec<Expr>) -> Kind {
    if elements.len() == 1 {
        Kind::Group(Box::new(elements.remove(0)))
    } else {
        Kind::Row(elements)
    }
}
