//! Executing a worksheet region by region, beside the results that Mathcad saved.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::failure::{Cause, Fallible};
use super::listing::Listing;
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::value::Value;
use super::xmcd::document::{Content, Region, Saved, Worksheet};

/// Fewer digits than these in common are a difference.
pub const LEAST_DIGITS: u32 = 10;

/// The name whose definition sets the subscript of first entries from there on.
const ORIGIN: &str = "ORIGIN";

/// A region as it was executed.
#[derive(Clone, Debug)]
pub struct Checked {
    pub id: String,
    pub tag: String,
    /// The region in the text notation.
    pub text: String,
    pub verdict: Verdict,
    /// The regions whose saved results went into this one in place of what the interpreter does not
    /// have.
    pub inputs: BTreeSet<String>,
    /// The region's value, if the interpreter has one.
    pub value: Option<Value>,
}

/// How a region compares with what Mathcad saved.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It saved nothing: a definition, or a file that Mathcad did not calculate.
    NothingSaved,
    /// Every number has the saved bits; a string is the same.
    Same,
    /// The numbers agree to so many digits, at least [`LEAST_DIGITS`].
    Digits(u32),
    /// Both fail; the words that Mathcad saved, and ours.
    SameFailure { saved: String, ours: String },
    /// Ours fails where nothing is saved; why.
    Fails(String),
    /// They differ: what Mathcad saved, and ours.
    Differs { saved: String, ours: String },
    /// The interpreter does not have this construct, or what it rests on.
    Beyond(String),
}

/// Executes a worksheet's regions in order, each under `limits`.
pub fn execute(worksheet: &Worksheet, limits: &Limits) -> Vec<Checked> {
    let mut run = Execution {
        settings: worksheet.settings.clone(),
        limits,
        sheet: Sheet::default(),
        ranges: BTreeMap::new(),
        beyond: BTreeMap::new(),
        inputs: BTreeMap::new(),
    };
    run.sheet.define(ORIGIN, f64::from(run.settings.origin));
    let is_global =
        |region: &&Region| matches!(region.content, Content::Definition { global: true, .. });
    for region in worksheet.regions.iter().filter(is_global) {
        run.region(region);
    }
    let regions = worksheet.regions.iter();
    let checked = regions.filter(|region| !matches!(region.content, Content::Silent));
    checked.map(|region| run.region(region)).collect()
}

struct Execution<'a> {
    settings: Settings,
    limits: &'a Limits,
    sheet: Sheet,
    /// Range variables, as the text of a loop has their numbers.
    ranges: BTreeMap<String, String>,
    /// Names that are beyond the interpreter, and why.
    beyond: BTreeMap<String, String>,
    /// The saved results that a name's value rests on.
    inputs: BTreeMap<String, BTreeSet<String>>,
}

/// What a region came to.
enum Outcome {
    Defined,
    Value(Value),
    Failed(Cause),
    Beyond(String),
}

impl Execution<'_> {
    fn region(&mut self, region: &Region) -> Checked {
        let mut inputs = BTreeSet::new();
        let (text, outcome) = match &region.content {
            Content::Silent => (String::new(), Outcome::Defined),
            Content::Beyond { names, construct } => {
                names.iter().for_each(|name| self.lose(name, construct));
                let text = names.iter().map(|name| format!("{name} := ...")).collect::<Vec<_>>();
                (text.join(", "), Outcome::Beyond(construct.clone()))
            }
            Content::Table { name, value } => {
                self.keep(name, value.clone(), BTreeSet::new());
                (format!("{name} := {}", value.kind()), Outcome::Value(value.clone()))
            }
            Content::Function { name, text } => (text.clone(), self.function(name, text)),
            Content::Range { name, range } => {
                (format!("{name} := {range}"), self.range(name, range, &mut inputs))
            }
            Content::Definition { name, entry, lines, .. } => {
                let target = entry.as_ref().unwrap_or(name);
                let text = match lines.as_slice() {
                    [line] => format!("{target} := {line}"),
                    lines => format!("{target} :=\n  {}", lines.join("\n  ")),
                };
                (text, self.definition(name, entry.as_deref(), lines, &mut inputs))
            }
            Content::Evaluation(expression) => {
                let outcome = self.evaluation(expression, &mut inputs);
                (format!("{expression} ="), outcome)
            }
        };
        let outcome = match (&region.content, &region.saved, outcome) {
            // What Mathcad shows and saves is the entry.
            (Content::Definition { entry: Some(target), .. }, Some(_), Outcome::Value(_)) => {
                self.evaluation(target, &mut inputs)
            }
            (_, _, outcome) => outcome,
        };
        let verdict = verdict(&outcome, region.saved.as_ref());
        if let (false, Some(Saved::Value(value))) = (verdict == Verdict::Same, &region.saved) {
            self.take_saved(region, value);
        }
        let value = match outcome {
            Outcome::Value(value) => Some(value),
            _ => None,
        };
        Checked { id: region.id.clone(), tag: region.tag.clone(), text, verdict, inputs, value }
    }

    /// Lets the saved value of a name go on as input, so that what follows is judged for itself.
    fn take_saved(&mut self, region: &Region, value: &Value) {
        let is_known = |name: &String| self.sheet.value(name).is_some();
        let name = match &region.content {
            Content::Evaluation(name) if self.beyond.contains_key(name) || is_known(name) => {
                name.clone()
            }
            Content::Definition { name, entry: None, .. } => name.clone(),
            Content::Beyond { names, .. } if names.len() == 1 => names[0].clone(),
            _ => return,
        };
        self.keep(&name, value.clone(), BTreeSet::from([region.id.clone()]));
    }

    /// Defines a name, whatever it was before.
    fn keep(&mut self, name: &str, value: Value, inputs: BTreeSet<String>) {
        self.forget(name);
        self.sheet.define(name, value);
        self.inputs.insert(name.into(), inputs);
    }

    fn lose(&mut self, name: &str, construct: &str) {
        self.forget(name);
        self.beyond.insert(name.into(), construct.into());
    }

    fn forget(&mut self, name: &str) {
        self.sheet.remove(name);
        self.ranges.remove(name);
        self.beyond.remove(name);
        self.inputs.remove(name);
    }

    fn parse(&self, text: &str) -> Result<Listing, Outcome> {
        let listing = Listing::parse_within("region", text, self.limits);
        listing.map_err(|error| Outcome::Beyond(format!("its size or form: {}", error.message)))
    }

    fn function(&mut self, name: &str, text: &str) -> Outcome {
        match self.parse(text) {
            Ok(program) => {
                self.forget(name);
                self.sheet.define_program(Rc::new(program));
                Outcome::Defined
            }
            Err(outcome) => {
                self.lose(name, "a function that cannot be read");
                outcome
            }
        }
    }

    /// Keeps a range variable: its numbers, as a loop spells them.
    fn range(&mut self, name: &str, range: &str, inputs: &mut BTreeSet<String>) -> Outcome {
        let (start, end) = range.split_once(" .. ").unwrap_or((range, range));
        let numbers = match start.split_once(", ") {
            Some((first, second)) => format!("({first}; {second}; {end})"),
            None => format!("({start}; {end})"),
        };
        match self.run(&[format!("  {numbers}")], inputs) {
            Outcome::Value(Value::Array(numbers)) => {
                let spelled = |x: &f64| super::xmcd::write::number(*x).replace('-', "−");
                let numbers: Vec<_> = numbers.entries().iter().map(spelled).collect();
                let (last, start) = numbers.split_last().expect("two numbers or three");
                self.forget(name);
                self.ranges.insert(name.into(), format!("{} .. {last}", start.join(", ")));
                self.inputs.insert(name.into(), inputs.clone());
                Outcome::Defined
            }
            Outcome::Value(other) => Outcome::Beyond(format!("a range of {}", other.kind())),
            outcome => {
                self.lose(name, "a range");
                outcome
            }
        }
    }

    fn definition(
        &mut self,
        name: &str,
        entry: Option<&str>,
        lines: &[String],
        inputs: &mut BTreeSet<String>,
    ) -> Outcome {
        // The entries that are not assigned stay unknown.
        if entry.is_some()
            && let Some(construct) = self.rests_on(name)
        {
            return Outcome::Beyond(construct);
        }
        let outcome = match entry {
            None => self.run(&indented(lines, 1), inputs),
            Some(target) => {
                let value = lines.first().map(String::as_str).unwrap_or_default();
                let line = format!("{target} ← {value}");
                let (mut program, level) = self.loops(&line);
                program.push(format!("{:1$}{line}", "", 2 * level));
                program.push(format!("  {name}"));
                self.run(&program, inputs)
            }
        };
        match &outcome {
            Outcome::Value(value) => self.keep(name, value.clone(), inputs.clone()),
            Outcome::Beyond(construct) => self.lose(name, construct),
            Outcome::Failed(cause) => self.lose(name, &format!("an error: {cause}")),
            Outcome::Defined => {}
        }
        match (name, &outcome) {
            (ORIGIN, Outcome::Value(Value::Number(x))) if *x == f64::from(*x as i32) => {
                self.settings.origin = *x as i32;
                outcome
            }
            (ORIGIN, _) => Outcome::Beyond("an ORIGIN that is no whole number".into()),
            _ => outcome,
        }
    }

    /// Evaluates an expression: over a range variable, for each of its numbers.
    fn evaluation(&mut self, expression: &str, inputs: &mut BTreeSet<String>) -> Outcome {
        let (mut program, level) = self.loops(expression);
        match level {
            1 => self.run(&[format!("  {expression}")], inputs),
            2 => {
                let origin = self.settings.origin;
                program.insert(0, format!("  _k ← {}", origin.saturating_sub(1)).replace('-', "−"));
                program.push("    _k ← _k + 1".into());
                program.push(format!("    _values[_k] ← {expression}"));
                program.push("  _values".into());
                self.run(&program, inputs)
            }
            _ => Outcome::Beyond("a table over several range variables".into()),
        }
    }

    /// Returns the loops over the range variables of a line, and how deep they leave it.
    fn loops(&self, line: &str) -> (Vec<String>, usize) {
        let Ok(listing) = self.parse(&format!("_() :=\n  {line}")) else {
            return (vec![], 1);
        };
        let names = listing.free_names();
        let ranges = names.iter().filter_map(|name| Some((name, self.ranges.get(*name)?)));
        let line = |(k, (name, range))| format!("{:1$}for {name} ∈ {range}", "", 2 * (k + 1));
        let loops: Vec<_> = ranges.enumerate().map(line).collect();
        let level = loops.len() + 1;
        (loops, level)
    }

    /// Runs the lines of a program without parameters.
    fn run(&self, lines: &[String], inputs: &mut BTreeSet<String>) -> Outcome {
        let program = match self.parse(&format!("_() :=\n{}", lines.join("\n"))) {
            Ok(program) => program,
            Err(outcome) => return outcome,
        };
        let mut seen = BTreeSet::new();
        if let Some(construct) = self.trace_names(&program, &mut seen, inputs) {
            return Outcome::Beyond(construct);
        }
        let outcome: Fallible<_> =
            program.runner_in(&self.sheet, &self.settings, self.limits).call(&[]);
        match outcome.map_err(|failure| failure.cause) {
            Ok(outcome) => Outcome::Value(outcome.value),
            Err(Cause::Complex { .. }) => Outcome::Beyond("complex numbers".into()),
            Err(limit @ Cause::Limit { .. }) => Outcome::Beyond(limit.to_string()),
            Err(cause) => Outcome::Failed(cause),
        }
    }

    /// Returns why what reads a name is beyond the interpreter, if the name is.
    fn rests_on(&self, name: &str) -> Option<String> {
        let construct = self.beyond.get(name)?;
        let follows = construct.contains("rests on");
        Some(if follows { construct.clone() } else { format!("it rests on {name}: {construct}") })
    }

    /// Collects the saved results that a program rests on, its functions' included. Returns why it
    /// is beyond the interpreter, if a name that it reads is.
    fn trace_names(
        &self,
        program: &Listing,
        seen: &mut BTreeSet<String>,
        inputs: &mut BTreeSet<String>,
    ) -> Option<String> {
        for name in program.free_names() {
            if !seen.insert(name.into()) {
                continue;
            }
            if let Some(construct) = self.rests_on(name) {
                return Some(construct);
            }
            inputs.extend(self.inputs.get(name).into_iter().flatten().cloned());
            if let Some(program) = self.sheet.program(name).cloned()
                && let Some(construct) = self.trace_names(&program, seen, inputs)
            {
                return Some(construct);
            }
        }
        None
    }
}

fn indented(lines: &[String], level: usize) -> Vec<String> {
    lines.iter().map(|line| format!("{:1$}{line}", "", 2 * level)).collect()
}

fn verdict(outcome: &Outcome, saved: Option<&Saved>) -> Verdict {
    match (outcome, saved) {
        (Outcome::Beyond(construct), _) => Verdict::Beyond(construct.clone()),
        (Outcome::Defined, _) => Verdict::NothingSaved,
        (_, Some(Saved::Beyond(construct))) => Verdict::Beyond(construct.clone()),
        (Outcome::Failed(cause), Some(Saved::Error(words))) => {
            Verdict::SameFailure { saved: words.clone(), ours: cause.to_string() }
        }
        // A function of Mathcad's that the interpreter does not have.
        (Outcome::Failed(Cause::Undefined { name }), _) => Verdict::Beyond(format!("`{name}`")),
        (Outcome::Failed(Cause::Arguments { expected, found }), _) if found < expected => {
            Verdict::Beyond("a call with fewer arguments, which is a function".into())
        }
        (Outcome::Failed(cause), None) => Verdict::Fails(cause.to_string()),
        (Outcome::Failed(cause), Some(saved)) => {
            Verdict::Differs { saved: spelled(saved), ours: cause.to_string() }
        }
        (Outcome::Value(_), None) => Verdict::NothingSaved,
        (Outcome::Value(ours), Some(Saved::Value(saved))) => compare(saved, ours),
        (Outcome::Value(ours), Some(saved @ Saved::Error(_))) => {
            Verdict::Differs { saved: spelled(saved), ours: ours.to_string() }
        }
    }
}

fn spelled(saved: &Saved) -> String {
    match saved {
        Saved::Value(value) => value.to_string(),
        Saved::Error(words) => format!("«{words}»"),
        Saved::Beyond(construct) => construct.clone(),
    }
}

/// Compares a saved value with ours, number by number.
fn compare(saved: &Value, ours: &Value) -> Verdict {
    let digits = digits(saved, ours);
    match digits {
        Some(u32::MAX) => Verdict::Same,
        Some(digits) if digits >= LEAST_DIGITS => Verdict::Digits(digits),
        _ => Verdict::Differs { saved: saved.to_string(), ours: ours.to_string() },
    }
}

/// Returns how many digits the values have in common, `u32::MAX` for the same bits; none if they
/// are no values of one kind.
fn digits(saved: &Value, ours: &Value) -> Option<u32> {
    match (saved, ours) {
        (Value::Number(x), Value::Number(y)) if x == y => Some(u32::MAX),
        (Value::Number(x), Value::Number(y)) => {
            let error = ((x - y) / x).abs();
            let digits = if error < 1.0 { -error.log10() } else { 0.0 };
            Some((digits.floor() as u32).min(16))
        }
        (Value::Text(x), Value::Text(y)) => (x == y).then_some(u32::MAX),
        (Value::Number(_) | Value::Text(_), _) | (_, Value::Number(_) | Value::Text(_)) => None,
        (saved, ours) if saved.size() == ours.size() => {
            let (rows, cols) = saved.size();
            let entry = |value: &Value, i, j| value.entry(i, j).unwrap_or_default();
            let places = (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j)));
            let each = places.map(|(i, j)| digits(&entry(saved, i, j), &entry(ours, i, j)));
            each.reduce(|least, next| Some(least?.min(next?))).unwrap_or(Some(u32::MAX))
        }
        _ => None,
    }
}
