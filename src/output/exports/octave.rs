//! The program for Octave and MATLAB: a script, its listings translated from the syntax tree. The
//! functions come first, as Octave wants them, so that it runs from any folder under any name.
//!
//! Operations keep their order. Matrix products are sums of outer products, k = 1, 2, ..., so that
//! no library reorders them. Where a false operand of `∧` is to decide though another fails (R4),
//! operands that cannot fail come first.

use super::{CorrectedExport, Export, ITERATED, MOVED, listing};
use ::mathcad::syntax::{
    Comparison, Expr, Kind, Operation, Operator, Range, Slot, Statement, Step,
};
use ::mathcad::xmcd::write::number;
use ::mathcad::{Array, Conjunction, Listing, Value};
use base::files::PER_CENT;
use base::plain::on_a_line;
use paper::corrected::{self, Bound, Program, STEPS};
use paper::listings::{Which, elasticity, tables};

const HELPERS: &str = "
function c = over(a, b)
  if any(b(:) == 0)
    error('Division by zero.');
  end
  c = a / b;
end

function c = ordered(a, b)
  if isscalar(a) || isscalar(b)
    c = a * b;
    return
  end
  c = a(:,1) * b(1,:);
  for k = 2:size(a, 2)
    c = c + a(:,k) * b(k,:);
  end
end

function r = upto(a, b)
  if a <= b
    r = a:b;
  else
    r = a:-1:b;
  end
end

function n = rows(v)
  n = size(v, 1);
end

function m = identity(n)
  m = eye(n);
end

function x = trace(x)
end

function show(name, x)
  fprintf('%s %d %d', name, size(x, 1), size(x, 2));
  fprintf(' %.17g', x);
  fprintf('\\n');
end

function beside(name, x, ours)
  show(name, x);
  show(['ours_' name], ours);
  show(['difference_' name], max(abs(x(:) - ours(:))));
end

function x = lsolve(a, b)
  x = a \\ b;
end
";

/// Writes the program of an export.
pub fn program(export: &Export) -> String {
    let force = export.run.as_ref().map(|run| ("F", column(&run.force)));
    let globals = Globals(tables(export.sheet).into_iter().chain(force).collect());
    let readings = match export.reading.to_string() {
        given if given.is_empty() => "all by default".into(),
        given => given,
    };
    let about = format!(
        "The listings of A. M. Filipov and M. V. Khomenko as printed. Readings: {readings}."
    );
    let mut text = head(export.title, &about);
    for which in Which::ALL {
        let more = match which {
            Which::CCnt => ", ct, yt, dy",
            Which::Km => "",
        };
        text += &function(&which.under(export.reading), more, export.reading.r4, &globals);
    }
    let mut added = vec![elasticity(export.sheet.plane)];
    if export.run.is_some() {
        added.extend([MOVED, ITERATED]);
    }
    text += &own(&added, &globals);
    text += &globals.definitions();
    text += &format!("  node_n = {};\n", literal(&Value::from(export.node_n)));
    text += "  [k_cnt, ct, yt, dy] = c_cnt(node_n);\n";
    match &export.run {
        None => {
            for name in ["ct", "yt", "dy", "k_cnt"] {
                text += &format!("  show('{name}', {name});\n");
            }
        }
        Some(run) => {
            text += &beside("ct", Value::from(&run.pairs.ct));
            text += &beside("yt", Value::from(&run.pairs.yt));
            text += &beside("dy", Value::from(&run.pairs.dy));
            text += &beside("k_cnt", Value::from(&run.pairs.k_cnt));
        }
    }
    text += "  show('MJS', Km(k_cnt));\n";
    if let Some(run) = &export.run {
        text += &format!("  U = iterated({});\n", run.iterations);
        text += &beside("U", column(&run.u));
    }
    text
}

/// Writes the program of the corrected algorithm.
pub fn corrected(export: &CorrectedExport) -> String {
    let more = [("F", column(&export.force)), ("both", Bound::Normal.both().into())];
    let globals = Globals(tables(export.sheet).into_iter().chain(more).collect());
    let mut text = head(export.title, "The corrected algorithm of plane-contact.");
    for own in Program::ALL {
        text += &function(&corrected::program(*own, &[]), "", Conjunction::Guarded, &globals);
    }
    text += &own(&[elasticity(export.sheet.plane)], &globals);
    text += &globals.definitions();
    text += &format!("  U = iterate({STEPS});\n  U = U(1:{});\n", export.u.len());
    text + &beside("U", column(&export.u))
}

/// Begins a script: its title on one line, whatever it holds, and a statement, because a file that
/// begins with a function is no script.
fn head(title: &str, about: &str) -> String {
    let title: String = on_a_line(title).chars().take(100).collect();
    format!(
        "% {title}\n% {about}\n{PER_CENT}run octave FILE.m, or in MATLAB from R2024a: run FILE.m\n1;\n"
    )
}

/// Translates listings that the paper does not print, and adds the functions that Octave has under other
/// names.
fn own(texts: &[&str], globals: &Globals) -> String {
    let translated = |text: &&str| function(&listing(text), "", Conjunction::Guarded, globals);
    texts.iter().map(translated).collect::<String>() + HELPERS
}

fn column(entries: &[f64]) -> Value {
    Array::column(entries.to_vec()).into()
}

/// Writes the statement that prints a result by its name, and what this program has for it beside.
fn beside(name: &str, ours: Value) -> String {
    format!("  beside('{name}', {name}, {});\n", literal(&ours))
}

/// The names of the worksheet, and what they stand for.
struct Globals(Vec<(&'static str, Value)>);

impl Globals {
    fn value(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(global, _)| *global == name).map(|(_, value)| value)
    }

    /// Declares those of some names that are the worksheet's.
    fn declaration<'a>(&self, names: impl IntoIterator<Item = &'a str>) -> String {
        let own = names.into_iter().filter(|name| self.value(name).is_some());
        let own: Vec<_> = own.map(ascii).collect();
        if own.is_empty() { String::new() } else { format!("  global {}\n", own.join(" ")) }
    }

    /// Declares and defines all of them.
    fn definitions(&self) -> String {
        let mut text = "\n".to_string() + &self.declaration(self.0.iter().map(|(name, _)| *name));
        for (name, value) in &self.0 {
            text += &format!("  {} = {};\n", ascii(name), literal(value));
        }
        text
    }
}

/// Spells a name in ASCII.
fn ascii(name: &str) -> String {
    name.replace('ν', "nu").replace('ξ', "xi").replace('√', "sqrt")
}

fn literal(value: &Value) -> String {
    match value {
        Value::Number(x) => number(*x),
        Value::Array(a) => {
            let row = |i| (0..a.cols()).map(|j| number(*a.at(i, j))).collect::<Vec<_>>().join(", ");
            format!(
                "[ ...\n    {}]",
                (0..a.rows()).map(row).collect::<Vec<_>>().join("; ...\n    ")
            )
        }
        Value::Nested(v) => {
            let entries: Vec<_> = v.grid().entries().map(literal).collect();
            format!("{{ ...\n    {}}}", entries.join("; ...\n    "))
        }
        Value::Text(_) => unreachable!("no table is a string"),
    }
}

/// Translates a listing, whose results are its value and `more` of its names.
fn function(listing: &Listing, more: &str, conjunction: Conjunction, globals: &Globals) -> String {
    let translator = Translator { listing, globals, conjunction };
    let parameters: Vec<_> =
        listing.parameters.iter().map(|slot| ascii(listing.names.name(*slot))).collect();
    let mut text =
        format!("\nfunction [value{more}] = {}({})\n", listing.function(), parameters.join(", "));
    text += &globals.declaration(listing.free_names());
    translator.block(&listing.program, 1, &mut text);
    text + "end\n"
}

struct Translator<'a> {
    listing: &'a Listing,
    globals: &'a Globals,
    conjunction: Conjunction,
}

impl Translator<'_> {
    fn name(&self, slot: Slot) -> String {
        ascii(self.listing.names.name(slot))
    }

    /// Returns whether an expression is known to be a number, whatever the names of the listing hold.
    fn is_scalar(&self, expr: &Expr) -> bool {
        use Operator::*;
        let parts = expr.parts.as_slice();
        match &expr.kind {
            Kind::Apply(Magnitude) => true,
            Kind::Literal(value) => value.number().is_some(),
            Kind::Name(_) => matches!(self.global(expr), Some(Value::Number(_))),
            Kind::Apply(Entry) => !matches!(self.global(&parts[0]), Some(Value::Nested(_))),
            Kind::Group | Kind::Apply(Negative | Calculate(_)) => {
                parts.iter().all(|part| self.is_scalar(part))
            }
            // Operations on arrays serve numbers too.
            _ => false,
        }
    }

    /// Returns what a name of the worksheet stands for.
    fn global(&self, expr: &Expr) -> Option<&Value> {
        self.globals.value(self.listing.names.name(expr.name()?))
    }

    fn block(&self, block: &[Statement], level: usize, text: &mut String) {
        for statement in block {
            let line = &self.listing.lines()[statement.line];
            *text += &format!("{:1$}% {2}: {3}\n", "", 2 * level, line.printed, line.text);
            self.statement(statement, level, text);
        }
    }

    fn statement(&self, statement: &Statement, level: usize, text: &mut String) {
        let mut put = |level: usize, line: &str| {
            *text += &format!("{:1$}{line}\n", "", 2 * level);
        };
        let mut inner = level;
        if let Some(guard) = &statement.guard {
            put(level, &format!("if {}", self.expr(guard)));
            inner += 1;
        }
        match &statement.step {
            Step::For { name, range: Range { values, to: Some(to) } } => {
                let (values, to) = (self.list(values), self.expr(to));
                put(inner, &format!("for {} = upto({values}, {to})", self.name(*name)));
                inner += 1;
            }
            Step::Block => {}
            Step::Assign { target, value } => {
                let place = match target.parts.as_slice() {
                    [name, row] => format!("{}({}, 1)", self.expr(name), self.expr(row)),
                    _ => self.expr(target),
                };
                put(inner, &format!("{place} = {};", self.expr(value)));
            }
            Step::Evaluate { value } => put(inner, &format!("value = {};", self.expr(value))),
            Step::Return { value, .. } => {
                put(inner, &format!("value = {};", self.expr(value)));
                put(inner, "return");
            }
            other => unreachable!("the listings have no {other:?}"),
        }
        statement.blocks.iter().for_each(|block| self.block(block, inner, text));
        for level in (level..inner).rev() {
            *text += &format!("{:1$}end\n", "", 2 * level);
        }
    }

    fn expr(&self, expr: &Expr) -> String {
        let parts = expr.parts.as_slice();
        match &expr.kind {
            Kind::Literal(value) => literal(value),
            Kind::Name(name) => self.name(*name),
            Kind::Group => format!("({})", self.expr(&parts[0])),
            Kind::Array { cols } => {
                let rows: Vec<_> = parts.chunks(*cols).map(|row| self.list(row)).collect();
                format!("[{}]", rows.join("; "))
            }
            Kind::Apply(operator) => self.applied(*operator, parts),
            Kind::Call(name) => format!("{}({})", self.name(*name), self.list(parts)),
            other => unreachable!("the listings have no {other:?}"),
        }
    }

    fn applied(&self, operator: Operator, operands: &[Expr]) -> String {
        let x = self.expr(&operands[0]);
        let y = || self.expr(&operands[1]);
        let is_scalar = |k: usize| self.is_scalar(&operands[k]);
        let sign = match operator {
            Operator::Magnitude if is_scalar(0) => return format!("abs({x})"),
            Operator::Magnitude => return format!("norm({x})"),
            Operator::Negative => return format!("-{x}"),
            Operator::Transpose => return format!("{x}.'"),
            Operator::Column => return format!("{x}(:, {})", y()),
            Operator::Entry => {
                let subscripts = self.list(&operands[1..]);
                return match self.global(&operands[0]) {
                    Some(Value::Nested(_)) => format!("{x}{{{subscripts}}}"),
                    _ => format!("{x}({subscripts})"),
                };
            }
            Operator::All => return self.all(operands),
            Operator::Calculate(Operation::Divide) => return format!("over({x}, {})", y()),
            Operator::Calculate(Operation::Multiply) if !is_scalar(0) && !is_scalar(1) => {
                return format!("ordered({x}, {})", y());
            }
            Operator::Compare(Comparison::Equal) => "==",
            Operator::Compare(Comparison::Unequal) => "~=",
            Operator::Compare(_) | Operator::Calculate(_) | Operator::Power => {
                operator.spelling().typed
            }
            Operator::Any | Operator::Not => unreachable!("the listings have no {operator:?}"),
        };
        format!("{x} {sign} {}", y())
    }

    /// Writes a conjunction; where a false operand decides though another fails, those that cannot fail come
    /// first.
    fn all(&self, operands: &[Expr]) -> String {
        let mut operands: Vec<&Expr> = operands.iter().collect();
        match self.conjunction {
            Conjunction::Eager => return format!("all([{}])", self.list(operands)),
            Conjunction::Guarded => operands.sort_by_key(|x| self.can_fail(x)),
            Conjunction::LeftToRight => {}
        }
        operands.into_iter().map(|x| self.expr(x)).collect::<Vec<_>>().join(" && ")
    }

    fn list<'a>(&self, exprs: impl IntoIterator<Item = &'a Expr>) -> String {
        exprs.into_iter().map(|x| self.expr(x)).collect::<Vec<_>>().join(", ")
    }

    /// Returns whether an expression has subscripts or divides.
    fn can_fail(&self, expr: &Expr) -> bool {
        use Operator::*;
        let own = matches!(expr.kind, Kind::Apply(Entry | Column | Calculate(Operation::Divide)));
        own || expr.parts.iter().any(|part| self.can_fail(part))
    }
}
