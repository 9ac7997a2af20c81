//! Executing a worksheet region by region, beside the results that Mathcad saved.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use serde::Serialize;

use super::failure::Cause;
use super::function::Function;
use super::listing::Listing;
use super::matrices;
use super::settings::{Limits, Settings};
use super::sheet::Sheet;
use super::unsupported::{construct, is_function};
use super::value::{Array, Value};
use super::words;
use super::xmcd::document::{Content, Region, Saved, Worksheet};

/// Fewer digits than these in common are a difference.
pub const LEAST_DIGITS: u32 = 10;

/// The name whose definition sets the subscript of first entries from there on.
const ORIGIN: &str = "ORIGIN";

/// A region as it was executed.
#[derive(Clone, Debug, Serialize)]
pub struct ExecutedRegion {
    /// The region's identifier in the file.
    #[serde(rename = "region")]
    pub id: String,
    /// The region's tag, which its author gave it; may be empty.
    pub tag: String,
    /// The region in the text notation.
    pub text: String,
    /// How it compares with what Mathcad saved.
    #[serde(flatten)]
    pub agreement: Agreement,
    /// The regions whose saved results went into this one in place of what the interpreter does not
    /// have.
    pub inputs: BTreeSet<String>,
    /// The region's value, if the interpreter has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
}

/// How a region compares with what Mathcad saved.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "lowercase")]
#[expect(missing_docs, reason = "what is said of each names its fields")]
pub enum Agreement {
    /// It saved nothing: a definition, or a file that Mathcad did not calculate.
    #[serde(rename = "nothing saved")]
    NothingSaved,
    /// Every number has the saved bits; a string is the same.
    Same,
    /// The numbers agree to so many digits, at least [`LEAST_DIGITS`].
    Digits { digits: u32 },
    /// Both fail of the same cause; the words that Mathcad saved, and ours.
    #[serde(rename = "failure")]
    SameFailure { saved: String, ours: String },
    /// Ours fails where nothing is saved; why.
    Fails { ours: String },
    /// They differ: what Mathcad saved, and ours.
    Differs { saved: String, ours: String },
    /// The interpreter does not have this construct, or what the region rests on.
    Unsupported { construct: String },
}

impl Agreement {
    /// Returns whether what Mathcad saved agrees with what is computed here.
    pub fn agrees(&self) -> bool {
        matches!(self, Agreement::Same | Agreement::Digits { .. } | Agreement::SameFailure { .. })
    }
}

/// Executes a worksheet's regions in order under `limits`. The steps are those of all regions
/// together; one region may take half of those that are left, so that an endless one leaves some.
pub fn execute(worksheet: &Worksheet, limits: &Limits) -> Vec<ExecutedRegion> {
    execute_watched(worksheet, limits, &mut |_, _| ())
}

/// Executes a worksheet as [`execute`] does; `watch` receives the number of regions done, and of all.
pub fn execute_watched(
    worksheet: &Worksheet,
    limits: &Limits,
    watch: &mut dyn FnMut(usize, usize),
) -> Vec<ExecutedRegion> {
    let mut run = Execution {
        settings: worksheet.settings.clone(),
        limits,
        steps: Cell::new(limits.steps),
        eigen: Cell::new(false),
        sheet: Sheet::default(),
        unsupported: BTreeMap::new(),
        inputs: BTreeMap::new(),
    };
    run.sheet.define(ORIGIN, f64::from(run.settings.origin));
    let is_global = |region: &&Region| {
        let content = &region.content;
        matches!(content, Content::Definition { global: true, .. })
            || matches!(content, Content::Names { global: true, .. })
    };
    for region in worksheet.regions.iter().filter(is_global) {
        run.region(region);
    }
    let is_silent = |region: &&Region| matches!(region.content, Content::Silent);
    let regions: Vec<_> = worksheet.regions.iter().filter(|region| !is_silent(region)).collect();
    let mut checked = Vec::new();
    for region in &regions {
        watch(checked.len(), regions.len());
        checked.push(run.region(region));
    }
    checked
}

struct Execution<'a> {
    settings: Settings,
    limits: &'a Limits,
    /// The steps that are left.
    steps: Cell<u64>,
    /// Whether eigenvalues were computed, whose order is Mathcad's own.
    eigen: Cell<bool>,
    sheet: Sheet,
    /// Names that the interpreter cannot know, and why.
    unsupported: BTreeMap<String, String>,
    /// The saved results that a name's value rests on.
    inputs: BTreeMap<String, BTreeSet<String>>,
}

/// What a region came to: a value, none of a function or a range variable, or why it has none.
type Computed = Result<Option<Value>, Cause>;

impl Execution<'_> {
    fn region(&mut self, region: &Region) -> ExecutedRegion {
        let mut inputs = BTreeSet::new();
        let (text, mut computed) = match &region.content {
            Content::Silent => (String::new(), Ok(None)),
            Content::Unsupported { names, construct } => {
                names.iter().for_each(|name| self.lose(name, construct));
                let text = names.iter().map(|name| format!("{name} := ...")).collect::<Vec<_>>();
                (text.join(", "), Err(unsupported(construct.clone())))
            }
            Content::Table { name, value } => {
                self.keep(name, value.clone(), BTreeSet::new());
                (format!("{name} := {}", value.kind()), Ok(Some(value.clone())))
            }
            Content::Function { name, text } => {
                (text.clone(), self.function(name, text, &mut inputs))
            }
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
            Content::Names { names, cols, lines, .. } => {
                let rows: Vec<_> = names.chunks(*cols).map(|row| row.join("   ")).collect();
                let text = format!("({}) := {}", rows.join("; "), lines.join("; "));
                let value = self.run(&indented(lines), &mut inputs);
                (text, self.define_all(names, *cols, value, &inputs))
            }
            Content::Evaluation(expression) => {
                let value = self.evaluation(expression, &mut inputs);
                (format!("{expression} ="), value.map(Some))
            }
        };
        // What Mathcad shows and saves of an entry's definition is the entry.
        if let Content::Definition { entry: Some(target), .. } = &region.content
            && let (Some(_), Ok(_)) = (&region.saved, &computed)
        {
            computed = self.evaluation(target, &mut inputs).map(Some);
        }
        let mut agreement = agreement(&computed, region.saved.as_ref());
        if let (Agreement::Differs { .. }, true) = (&agreement, self.eigen.get())
            && let (Ok(Some(ours)), Some(Saved::Value(saved))) = (&computed, &region.saved)
            && agree_unordered(saved, ours)
        {
            let construct =
                "Mathcad's order of eigenvalues and its signs of eigenvectors; the numbers agree";
            agreement = Agreement::Unsupported { construct: construct.into() };
        }
        if let (false, Some(Saved::Value(value))) = (agreement == Agreement::Same, &region.saved) {
            self.take_saved(region, value);
        }
        let (id, tag) = (region.id.clone(), region.tag.clone());
        ExecutedRegion { id, tag, text, agreement, inputs, value: computed.ok().flatten() }
    }

    /// Lets the saved value of a name go on as input, so that what follows is judged for itself.
    fn take_saved(&mut self, region: &Region, value: &Value) {
        if let Content::Names { names, cols, .. } = &region.content {
            let inputs = BTreeSet::from([region.id.clone()]);
            let _ = self.define_all(names, *cols, Ok(value.clone()), &inputs);
            return;
        }
        let name = match &region.content {
            Content::Evaluation(name)
                if self.unsupported.contains_key(name) || self.sheet.value(name).is_some() =>
            {
                name.clone()
            }
            Content::Definition { name, entry: None, .. } => name.clone(),
            Content::Unsupported { names, .. } if names.len() == 1 => names[0].clone(),
            _ => return,
        };
        self.keep(&name, value.clone(), BTreeSet::from([region.id.clone()]));
    }

    /// Gives each name its entry of a value that stands as they do.
    fn define_all(
        &mut self,
        names: &[String],
        cols: usize,
        value: Result<Value, Cause>,
        inputs: &BTreeSet<String>,
    ) -> Computed {
        let entries = value
            .and_then(|value| Ok((matrices::spread(&value, names.len() / cols, cols)?, value)));
        match entries {
            Ok((entries, value)) => {
                for (name, entry) in names.iter().zip(entries) {
                    self.keep(name, entry, inputs.clone());
                }
                Ok(Some(value))
            }
            Err(cause) => {
                names.iter().for_each(|name| self.lose_by(name, &cause));
                Err(cause)
            }
        }
    }

    /// Defines a name, whatever it was before.
    fn keep(&mut self, name: &str, value: Value, inputs: BTreeSet<String>) {
        self.forget(name);
        self.sheet.define(name, value);
        self.inputs.insert(name.into(), inputs);
    }

    fn lose(&mut self, name: &str, construct: &str) {
        self.forget(name);
        self.unsupported.insert(name.into(), construct.into());
    }

    fn forget(&mut self, name: &str) {
        self.sheet.remove(name);
        self.unsupported.remove(name);
        self.inputs.remove(name);
    }

    fn parse(&self, text: &str) -> Result<Listing, Cause> {
        self.eigen.set(self.eigen.get() || text.contains("eigenv"));
        let listing = Listing::parse_within("region", text, self.limits);
        listing.map_err(|error| unsupported(format!("its size or form: {}", error.message)))
    }

    /// Defines a function, whose names are those above it.
    fn function(&mut self, name: &str, text: &str, inputs: &mut BTreeSet<String>) -> Computed {
        let program = self.parse(text).inspect_err(|_| {
            self.lose(name, "a function that cannot be read");
        })?;
        if let Err(cause) = self.known_names(name, &program, inputs) {
            self.lose_by(name, &cause);
            return Err(cause);
        }
        self.unsupported.remove(name);
        self.sheet.define_below(Rc::new(program));
        self.inputs.insert(name.into(), inputs.clone());
        Ok(None)
    }

    /// Checks that every name which a function takes from the worksheet stands for something there.
    fn known_names(
        &self,
        name: &str,
        program: &Listing,
        inputs: &mut BTreeSet<String>,
    ) -> Result<(), Cause> {
        self.trace_names(program, inputs)?;
        let unknown =
            |of: &&str| *of != name && !self.sheet.has(of) && Function::builtin(of).is_none();
        let Some(of) = program.free_names().into_iter().find(unknown) else { return Ok(()) };
        // A unit is no function.
        let construct = construct(of).filter(|_| is_function(of) || !program.calls(of));
        Err(construct.map_or_else(|| Cause::Undefined { name: of.into() }, unsupported))
    }

    /// Keeps a range variable: its numbers, as a loop spells them.
    fn range(&mut self, name: &str, range: &str, inputs: &mut BTreeSet<String>) -> Computed {
        let (start, end) = range.split_once(" .. ").unwrap_or((range, range));
        let numbers = match start.split_once(", ") {
            Some((first, second)) => format!("({first}; {second}; {end})"),
            None => format!("({start}; {end})"),
        };
        let numbers = match self.run(&[format!("  {numbers}")], inputs) {
            Ok(Value::Array(numbers)) => Ok(numbers),
            Ok(other) => Err(unsupported(format!("a range of {}", other.kind()))),
            Err(cause) => Err(cause),
        };
        let numbers = numbers.inspect_err(|cause| self.lose_by(name, cause))?;
        let numbers = match *numbers.entries().copied().collect::<Vec<_>>() {
            [from, second, to] => (from, Some(second), to),
            ref ends => (ends[0], None, ends[1]),
        };
        self.forget(name);
        self.sheet.define_range(name, numbers);
        self.inputs.insert(name.into(), inputs.clone());
        Ok(None)
    }

    /// Takes a name's value away, for which there is no other.
    fn lose_by(&mut self, name: &str, cause: &Cause) {
        match cause {
            Cause::Unsupported { construct } => self.lose(name, construct),
            cause => self.lose(name, &format!("an error: {cause}")),
        }
    }

    fn definition(
        &mut self,
        name: &str,
        entry: Option<&str>,
        lines: &[String],
        inputs: &mut BTreeSet<String>,
    ) -> Computed {
        let value = match entry {
            None => self.run(&indented(lines), inputs),
            Some(target) => {
                // The entries that are not assigned stay unknown.
                self.check_known(name)?;
                let value = lines.first().map(String::as_str).unwrap_or_default();
                let line = format!("{target} ← {value}");
                let (mut program, level) = self.loops(&line);
                program.push(format!("{:1$}{line}", "", 2 * level));
                program.push(format!("  {name}"));
                self.run(&program, inputs)
            }
        };
        match &value {
            Ok(value) => self.keep(name, value.clone(), inputs.clone()),
            Err(cause) => self.lose_by(name, cause),
        }
        match (name, &value) {
            (ORIGIN, Ok(Value::Number(x))) if *x == f64::from(*x as i32) => {
                self.settings.origin = *x as i32;
            }
            (ORIGIN, _) => return Err(unsupported("an ORIGIN that is no whole number".into())),
            _ => {}
        }
        value.map(Some)
    }

    /// Evaluates an expression: over range variables, for each of their numbers, those of the last named
    /// changing first.
    fn evaluation(
        &mut self,
        expression: &str,
        inputs: &mut BTreeSet<String>,
    ) -> Result<Value, Cause> {
        let (mut program, level) = self.loops(expression);
        if level == 1 {
            return self.run(&[format!("  {expression}")], inputs);
        }
        let origin = self.settings.origin;
        program.insert(0, format!("  _k ← {}", origin.saturating_sub(1)).replace('-', "−"));
        program.push(format!("{:1$}_k ← _k + 1", "", 2 * level));
        program.push(format!("{:1$}_values[_k] ← {expression}", "", 2 * level));
        program.push("  _values".into());
        self.run(&program, inputs)
    }

    /// Returns the loops over the range variables of a line, and how deep they leave it.
    fn loops(&self, line: &str) -> (Vec<String>, usize) {
        let Ok(listing) = self.parse(&format!("_() :=\n  {line}")) else {
            return (vec![], 1);
        };
        let names = listing.free_names();
        let ranges = names.iter().filter_map(|name| Some((name, self.sheet.range(name)?)));
        let spelled = |x: f64| super::xmcd::write::number(x).replace('-', "−");
        let loops = ranges.enumerate().map(|(k, (name, (from, second, to)))| {
            let second = second.map(|second| format!(", {}", spelled(second))).unwrap_or_default();
            let range = format!("{}{second} .. {}", spelled(from), spelled(to));
            format!("{:1$}for {name} ∈ {range}", "", 2 * (k + 1))
        });
        let loops: Vec<_> = loops.collect();
        let level = loops.len() + 1;
        (loops, level)
    }

    /// Runs the lines of a program without parameters.
    fn run(&self, lines: &[String], inputs: &mut BTreeSet<String>) -> Result<Value, Cause> {
        let program = self.parse(&format!("_() :=\n{}", lines.join("\n")))?;
        self.trace_names(&program, inputs)?;
        let limits = Limits { steps: self.steps.get() / 2, ..self.limits.clone() };
        let mut runner = program.runner(&self.sheet, &self.settings, &limits);
        let ended = runner.call(&[]);
        self.steps.set(self.steps.get().saturating_sub(runner.steps()));
        ended.map(|ended| ended.value).map_err(|failure| match failure.cause {
            Cause::Complex { .. } => unsupported("complex numbers".into()),
            Cause::Limit { limit, of } => {
                unsupported(format!("more than {limit} {of}, the limit of this region"))
            }
            cause => cause,
        })
    }

    /// Checks that a name does not rest on what is unsupported.
    fn check_known(&self, name: &str) -> Result<(), Cause> {
        let Some(construct) = self.unsupported.get(name) else { return Ok(()) };
        let follows = construct.contains("(it rests on ");
        let rests = || format!("{construct} (it rests on {name})");
        Err(unsupported(if follows { construct.clone() } else { rests() }))
    }

    /// Collects the saved results that a program rests on, and checks that no name which it reads rests on
    /// what is unsupported.
    fn trace_names(&self, program: &Listing, inputs: &mut BTreeSet<String>) -> Result<(), Cause> {
        let names = program.free_names();
        for name in &names {
            inputs.extend(self.inputs.get(*name).into_iter().flatten().cloned());
        }
        names.into_iter().try_for_each(|name| self.check_known(name))
    }
}

fn unsupported(construct: String) -> Cause {
    Cause::Unsupported { construct }
}

fn indented(lines: &[String]) -> Vec<String> {
    lines.iter().map(|line| format!("  {line}")).collect()
}

fn agreement(computed: &Computed, saved: Option<&Saved>) -> Agreement {
    match (computed, saved) {
        (Err(Cause::Unsupported { construct }), Some(Saved::Error(words))) => {
            Agreement::Unsupported {
                construct: format!("{construct}; Mathcad saved an error: «{words}»"),
            }
        }
        (Err(Cause::Unsupported { construct }), _) => {
            Agreement::Unsupported { construct: construct.clone() }
        }
        (Ok(None), _) | (Ok(_), None) => Agreement::NothingSaved,
        (_, Some(Saved::Unsupported(construct))) => {
            Agreement::Unsupported { construct: construct.clone() }
        }
        (Err(cause), Some(Saved::Error(words))) => {
            let (saved, ours) = (words.clone(), cause.to_string());
            match words::is_of(words, cause) {
                Some(true) => Agreement::SameFailure { saved, ours },
                Some(false) => Agreement::Differs { saved: format!("«{saved}»"), ours },
                None => Agreement::Unsupported {
                    construct: format!("Mathcad's error «{saved}»; here: {ours}"),
                },
            }
        }
        // Mathcad may know it from elsewhere.
        (Err(Cause::Undefined { name }), _) => {
            Agreement::Unsupported { construct: format!("`{name}`, which nothing above defines") }
        }
        (Err(Cause::Arguments { expected, found }), _) if found < expected => {
            Agreement::Unsupported {
                construct: "a call with fewer arguments, which is a function".into(),
            }
        }
        (Err(cause), None) => Agreement::Fails { ours: cause.to_string() },
        (Err(cause), Some(saved)) => {
            Agreement::Differs { saved: spelled(saved), ours: cause.to_string() }
        }
        (Ok(Some(ours)), Some(Saved::Value(saved))) => match digits(saved, ours) {
            Some(u32::MAX) => Agreement::Same,
            Some(digits) if digits >= LEAST_DIGITS => Agreement::Digits { digits },
            _ => {
                let [saved, ours] = match (saved.to_string(), ours.to_string()) {
                    // Numbers look like arrays of one entry, and like strings.
                    (a, b) if a == b => [saved, ours].map(|value| match value {
                        Value::Number(_) => format!("{a}, a number"),
                        other => format!("{a}, {}", other.kind()),
                    }),
                    (a, b) => [a, b],
                };
                Agreement::Differs { saved, ours }
            }
        },
        (Ok(Some(ours)), Some(saved @ Saved::Error(_))) => {
            Agreement::Differs { saved: spelled(saved), ours: ours.to_string() }
        }
    }
}

fn spelled(saved: &Saved) -> String {
    match saved {
        Saved::Value(value) => value.to_string(),
        Saved::Error(words) => format!("«{words}»"),
        Saved::Unsupported(construct) => construct.clone(),
    }
}

/// Returns whether arrays agree but for what Mathcad chooses of eigenvectors: the order and the signs of the
/// columns, or of one column the order of its entries. Each is paired with the nearest that is left.
fn agree_unordered(saved: &Value, ours: &Value) -> bool {
    let (Value::Array(saved), Value::Array(ours)) = (saved, ours) else { return false };
    let (rows, cols) = saved.size();
    if ours.size() != (rows, cols) {
        return false;
    }
    let columns = |array: &Array| -> Vec<Vec<f64>> {
        let column = |j| (0..rows).map(|i| *array.at(i, j)).collect();
        if cols == 1 {
            array.entries().map(|x| vec![*x]).collect()
        } else {
            (0..cols).map(column).collect()
        }
    };
    let signs: &[f64] = if cols == 1 { &[1.0] } else { &[1.0, -1.0] };
    let distance = |a: &[f64], b: &[f64]| {
        let of =
            |sign: f64| a.iter().zip(b).fold(0.0, |d: f64, (x, y)| d.max((x - sign * y).abs()));
        signs.iter().map(|sign| of(*sign)).fold(f64::INFINITY, f64::min)
    };
    let largest = saved.entries().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let mut left = columns(ours);
    columns(saved).iter().all(|column| {
        let by_distance = |a: &usize, b: &usize| {
            distance(column, &left[*a]).total_cmp(&distance(column, &left[*b]))
        };
        let nearest = (0..left.len()).min_by(by_distance).expect("one is left for each");
        distance(column, &left.swap_remove(nearest)) <= largest * 0.1_f64.powi(LEAST_DIGITS as i32)
    })
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
