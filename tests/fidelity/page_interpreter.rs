//! The interpreter of the pages (JavaScript, run by node) has the bits of `mathcad`: on random scenes under
//! readings, repairs and settings, on the corrected programs, and on listings with one character changed, each
//! statement reads, decides and writes the same, and what fails does so at the same place in the same words.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::rc::Rc;
use std::sync::Arc;

use fastrand::Rng;
use plane_contact::mathcad::array::Table;
use plane_contact::mathcad::observe::{Executed, Named};
use plane_contact::mathcad::{
    Array, Cause, Conjunction, Failure, Limits, Listing, ParseError, Recorder, Settings, Sheet,
    Value, unsupported,
};
use plane_contact::output::page::INTERPRETER;
use plane_contact::paper::corrected::{Bound, FAULTS, Program, program};
use plane_contact::paper::door;
use plane_contact::paper::listings::{self, Which, edited, elasticity, settings, tables};
use plane_contact::paper::mirror::{Reading, Worksheet};
use plane_contact::problem::model::Model;
use plane_contact::problem::scene::Scene;
use plane_contact::studies::audit::Case as Audited;
use plane_contact::studies::audit::findings::{FINDINGS, Repair};
use plane_contact::studies::lesson::language::Language;
use plane_contact::studies::lesson::page::{self as lesson, Chapter};
use plane_contact::studies::lesson::{Switch, chapter, reference, switches};
use proptest::strategy::{Strategy, ValueTree};
use serde_json::{Value as Json, json};
use tempfile::TempDir;

use crate::common::draws::one_of;
use crate::common::random::fixed;
use crate::common::tools::{browser, has_node};
use testing::worksheets::{draw, initial, reading, worksheet};

const SCENES: usize = 300;
const EDITED: usize = 250;
/// How many situations of a page are compared, with some 17 steps in each.
const MOVED: usize = 200;

/// An execution of a listing.
struct Case {
    listing: Listing,
    around: Around,
    settings: Settings,
    arguments: Vec<Value>,
}

/// What is defined around a listing.
#[derive(Clone)]
enum Around {
    /// The tables of a scene and `D`: the listing is one of the paper's two.
    Scene(Rc<Worksheet<f64>>),
    /// These values, and the programs of the sheet, which has the values too.
    Sheet(Vec<(&'static str, Value)>, Rc<Sheet>),
}

/// What a case ends with: its value, and what `trace` wrote.
type End = Result<(Value, Vec<String>), Box<Failure>>;

impl Case {
    /// Executes the listing and hands over each statement.
    fn execute(&self, each: impl FnMut(&Executed)) -> End {
        let mut recorder = Recorder::new(each);
        let Case { listing, around, settings, arguments } = self;
        match around {
            Around::Sheet(_, sheet) => listing
                .runner(
                    sheet,
                    settings,
                    &Limits { steps: 1 << 22, entries: 1 << 20, ..Limits::default() },
                )
                .call_recorded(arguments, Some(&mut recorder))
                .map(|outcome| (outcome.value, outcome.trace_output)),
            Around::Scene(sheet) => {
                let argument = (&arguments[0]).try_into().expect("a table");
                match listing.name().parse().expect("one of the two") {
                    Which::CCnt => {
                        listings::c_cnt(listing, settings, sheet, &argument, Some(&mut recorder))
                            .map(|(pairs, output)| (Value::from(&pairs.k_cnt), output))
                    }
                    Which::Km => {
                        listings::km(listing, settings, sheet, &argument, Some(&mut recorder))
                            .map(|(matrix, output)| (Value::Array(matrix), output))
                    }
                }
            }
        }
    }

    /// Writes the case and what it ends with, each statement by its digest.
    fn json(&self) -> Json {
        let mut steps = vec![];
        let end = self.execute(|done| steps.push(Digest::default().executed(done).0));
        let (values, programs, plane) = match &self.around {
            Around::Scene(sheet) => (tables(sheet), vec![], Some(sheet.plane)),
            Around::Sheet(values, sheet) => {
                let names = Program::ALL.iter().map(|program| program.name()).chain(["D"]);
                let programs = names.filter_map(|name| Some((name, lines(sheet.program(name)?))));
                (values.clone(), programs.collect(), None)
            }
        };
        let is_limit =
            end.as_ref().is_err_and(|failure| matches!(failure.cause, Cause::Limit { .. }));
        json!({
            "name": self.listing.name(),
            "lines": lines(&self.listing),
            "tables": values.iter().map(|(name, value)| json!([name, spelled(value)])).collect::<Json>(),
            "programs": programs,
            "plane": plane,
            "settings": self.settings,
            "arguments": self.arguments.iter().map(spelled).collect::<Vec<_>>(),
            "steps": steps,
            "is_limit": is_limit,
            "failure": end.as_ref().err().map(ToString::to_string),
            "value": end.as_ref().ok().map(|(value, _)| Digest::default().value(value).0),
            "output": end.as_ref().ok().map(|(_, output)| output),
        })
    }
}

/// A digest of words of 32 bits: two that differ in one word differ.
#[derive(Default)]
struct Digest(u32);

impl Digest {
    fn word(self, word: u32) -> Self {
        Digest((self.0 ^ word).wrapping_mul(0x0100_0193))
    }

    fn text(self, text: &str) -> Self {
        let units = text.encode_utf16();
        units.fold(self.word(text.encode_utf16().count() as u32), |digest, unit| {
            digest.word(unit.into())
        })
    }

    fn value(self, value: &Value) -> Self {
        match value {
            Value::Number(x) => {
                let bits = if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
                self.word((bits >> 32) as u32).word(bits as u32)
            }
            Value::Text(text) => self.text(text),
            array => {
                let (rows, cols) = array.size();
                let entries = (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j)));
                let entries = entries.filter_map(|(i, j)| array.entry(i, j));
                entries.fold(self.word(rows as u32).word(cols as u32), |digest, entry| {
                    digest.value(&entry)
                })
            }
        }
    }

    fn named(self, list: &[Named]) -> Self {
        list.iter().fold(
            self.word(list.len() as u32),
            |digest, Named { name, subscripts, value }| {
                let name = digest.text(name).word(subscripts.len() as u32);
                subscripts.iter().fold(name, |digest, k| digest.word(*k as u32)).value(value)
            },
        )
    }

    fn executed(self, done: &Executed) -> Self {
        let truth = |held: Option<bool>| held.map_or(2, u32::from);
        let head = self.word(done.line as u32).word(done.in_file as u32).word(truth(done.held));
        let operands = done.operands.iter();
        let decided =
            operands.fold(head, |digest, (text, held)| digest.text(text).word(truth(*held)));
        decided.named(&done.reads).named(&done.writes)
    }
}

fn lines(listing: &Listing) -> Json {
    let lines = listing.lines().iter();
    lines.map(|line| json!([line.printed, line.in_file, line.level, line.text])).collect()
}

/// A value as a number, a list of rows, or, where JSON has no such number, its name.
fn spelled(value: &Value) -> Json {
    match value {
        Value::Number(x) if x.is_finite() => json!(x),
        Value::Number(x) => json!(x.to_string()),
        array => {
            let (rows, cols) = array.size();
            let entry = |i, j| spelled(&array.entry(i, j).expect("an entry"));
            (0..rows).map(|i| (0..cols).map(|j| entry(i, j)).collect::<Json>()).collect()
        }
    }
}

/// Both listings on a random scene: under a reading, or under the repair of a finding, and under the
/// reading's settings or others.
fn drawn(runner: &mut proptest::test_runner::TestRunner, rng: &mut Rng) -> [Case; 2] {
    let (draw, reading) = (draw(), reading()).new_tree(runner).expect("a scene").current();
    let (sheet, node_n) = worksheet(&draw);
    let sheet = Rc::new(sheet);
    let repair = rng.bool().then(|| one_of(rng, &repairs()));
    let text = |which: Which| match repair {
        Some(edit) if Which::from_text(edit) == Some(which) => {
            edited(&which.under(&Reading::default()), edit)
        }
        _ => which.under(&reading),
    };
    let settings = if rng.u8(..4) == 0 { any_settings(rng) } else { settings(&reading) };
    let case = |which: Which, argument: Value| Case {
        listing: text(which),
        around: Around::Scene(sheet.clone()),
        settings: settings.clone(),
        arguments: vec![argument],
    };
    let c_cnt = case(Which::CCnt, Value::from(&node_n));
    let none = || Value::from(&Table::filled(sheet.R(), 4, 0.0));
    let pairs = c_cnt.execute(|_| ()).map_or_else(|_| none(), |(k_cnt, _)| k_cnt);
    [c_cnt, case(Which::Km, pairs)]
}

fn any_settings(rng: &mut Rng) -> Settings {
    Settings {
        origin: one_of(rng, &[1, 1, 0]),
        zero_over_zero_is_zero: rng.bool(),
        exact_boolean: rng.bool(),
        tiny_is_zero: rng.bool(),
        conjunction: one_of(rng, Conjunction::ALL),
        descending_is_empty: rng.bool(),
        last_if_is_zero: rng.bool(),
    }
}

/// Both listings under each switch that a lesson offers, on the paper's figure, on the two blocks and on the scene of
/// each finding: every reading, setting, tolerance and repair.
fn offered() -> Vec<Case> {
    let own = ["fig1", "two-blocks"].map(|name| Scene::open(name).expect("an embedded scene"));
    let own = own.into_iter().map(|scene| (switches(&scene), scene));
    let of_findings =
        FINDINGS.iter().map(|finding| (chapter(finding), Audited::new(finding.scene()).scene));
    let all = own.chain(of_findings).flat_map(|(switches, scene)| {
        let models = switches.into_iter();
        // A reading that does not allow the model has no run (R6).
        models.filter_map(move |switch| Some((switch.model(&scene).ok()?, switch)))
    });
    all.flat_map(|(model, switch)| {
        let sheet = Rc::new(door::worksheet(&model, |x| x));
        let case = |which: Which, argument: Value| Case {
            listing: switch.listing(which),
            around: Around::Scene(sheet.clone()),
            settings: switch.settings(),
            arguments: vec![argument],
        };
        let c_cnt = model.has_contact().then(|| case(Which::CCnt, Value::from(&sheet.node)));
        let none = || Value::from(&Table::filled(sheet.R(), 4, 0.0));
        let pairs = c_cnt.as_ref().and_then(|c_cnt| c_cnt.execute(|_| ()).ok());
        let km = case(Which::Km, pairs.map_or_else(none, |(k_cnt, _)| k_cnt));
        c_cnt.into_iter().chain([km])
    })
    .collect()
}

/// The listings that fuzzing has kept.
fn corpus() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus/listing");
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let texts = paths.iter().filter_map(|path| std::fs::read_to_string(path).ok());
    texts.filter(|text| !text.contains('\0')).collect()
}

/// A sheet of Mathcad's own constants and these values, and all of them.
fn defined(
    values: impl IntoIterator<Item = (&'static str, Value)>,
) -> (Vec<(&'static str, Value)>, Sheet) {
    let mut sheet = Sheet::default();
    let constants =
        ["π", "e", "deg", "rad"].map(|name| (name, sheet.value(name).expect("a constant")));
    let values: Vec<_> = values.into_iter().chain(constants).collect();
    for (name, value) in &values {
        sheet.define(name, value.clone());
    }
    (values, sheet)
}

/// Programs of x: those of Mathcad's rules, and what stands in quotation marks in the tests of the notation, most of it
/// no program.
fn rules() -> Vec<String> {
    let (mut programs, mut lines) = (vec![], String::new());
    let text = include_str!("../../src/mathcad/tests/rules.txt").lines();
    for line in text.filter(|line| !line.starts_with("# ") && !line.starts_with("under ")) {
        let (own, ends) = line.rsplit_once(" ⇒ ").map_or((line, false), |(own, _)| (own, true));
        lines += &format!("\n{own}");
        if ends {
            programs.push(std::mem::take(&mut lines).trim_start().to_owned());
        }
    }
    let notation = include_str!("../../src/mathcad/tests/notation.rs");
    programs.extend(notation.split('"').skip(1).step_by(2).map(|text| text.replace("\\n", "\n")));
    let rows = include_str!("../../src/mathcad/tests/notation.txt").lines();
    let rows = rows.filter(|row| !row.starts_with("  ") && !row.starts_with("# "));
    programs.extend(rows.map(|row| row.trim_start_matches("raw: ").replace('⏎', "\n")));
    programs.push("y ← 1 if x = 5\ny ← 2 if x = 4\ny ← 3 otherwise\ny".into());
    let program = |text: String| format!("f(x) :=\n  {}", text.replace('\n', "\n  "));
    programs.into_iter().map(program).collect()
}

/// The repairs of findings that are edits of a listing.
fn repairs() -> Vec<&'static str> {
    let edit = |repair: &Repair| match repair {
        Repair::Edit { text } => Some(*text),
        Repair::None { .. } => None,
    };
    FINDINGS.iter().filter_map(|finding| edit(&finding.edit)).collect()
}

/// The corrected programs on a scene, as they are and with each fault: the iterations, and each program
/// that they call.
fn corrected(scene: &str) -> Vec<Case> {
    let sheet = initial(scene);
    let mut cases = vec![];
    for edit in [None].into_iter().chain(FAULTS.iter().map(|fault| Some(fault.edit))) {
        let text = |of: Program| program(of, edit.as_slice());
        let load = (0..2 * sheet.R()).map(|k| k as f64 - 3.5).collect();
        let own = [("F", Array::column(load).into()), ("both", Bound::Normal.both().into())];
        let (values, mut programs) = defined(tables(&sheet).into_iter().chain(own));
        let others = Program::ALL.iter().map(|program| text(*program));
        for listing in
            others.chain([Listing::parse("D", elasticity(sheet.plane)).expect("it is sound")])
        {
            programs.define_program(Rc::new(listing));
        }
        let around = Around::Sheet(values, Rc::new(programs));
        let case = |program, arguments| Case {
            listing: text(program),
            around: around.clone(),
            settings: Settings::default(),
            arguments,
        };
        let forces = Array::column(vec![1.0; sheet.cnt.rows()]).into();
        let normals = case(Program::Normals, vec![Value::from(&sheet.node)]);
        let normals = normals.execute(|_| ()).expect("it has edges").0;
        let c_cnt = case(Program::CCnt, vec![Value::from(&sheet.node), forces, normals]);
        let pairs = c_cnt.execute(|_| ()).expect("it finds pairs").0;
        cases.push(case(Program::Normals, vec![Value::from(&sheet.node)]));
        cases.push(case(Program::Km, vec![pairs.clone()]));
        cases.push(case(Program::Fm, vec![pairs]));
        cases.push(case(Program::Iterate, vec![Value::Number(3.0)]));
        cases.push(c_cnt);
    }
    cases
}

/// What single characters are changed to.
const CHARACTERS: &str =
    "aiknxyRMVWcS_'0123456789.eE+-−·*/^=≠<>≤≥∧∨¬←∈ᵀ|,;:()[]{}⟨⟩×→\"#    \n\t&°√∑éπ😀";

/// A text with one character taken away, put in or replaced.
fn changed(text: &str, rng: &mut Rng) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    let at = rng.usize(..characters.len());
    let other = one_of(rng, &CHARACTERS.chars().collect::<Vec<_>>());
    match rng.u8(..3) {
        0 => drop(characters.remove(at)),
        1 => characters.insert(at, other),
        _ => characters[at] = other,
    }
    characters.into_iter().collect()
}

fn parse_error(error: &ParseError) -> Json {
    let ParseError { line, file_line, column, message, .. } = error;
    json!({ "line": line, "fileLine": file_line, "column": column, "message": message })
}

/// Writes JSON to a file of the folder.
fn written(folder: &Path, name: &str, json: &Json) -> String {
    let path = folder.join(name).to_string_lossy().into_owned();
    std::fs::write(&path, json.to_string()).expect("a file");
    path
}

#[test]
fn the_page_s_interpreter_has_the_bits_of_this_one() {
    if !has_node() {
        eprintln!("node is not installed: the page's interpreter is not run");
        return;
    }
    let mut runner = proptest::test_runner::TestRunner::new(fixed(1));
    let mut rng = Rng::with_seed(46);
    let mut cases: Vec<Case> = (0..SCENES).flat_map(|_| drawn(&mut runner, &mut rng)).collect();
    cases.extend(["fig1", "two-blocks"].into_iter().flat_map(corrected));
    cases.extend(offered());
    let mut texts = vec![];
    let mut read = |name: &str, text: &str| {
        let read = Listing::parse(name, text);
        texts.push(
            json!({ "name": name, "text": text, "error": read.as_ref().err().map(parse_error) }),
        );
        read.ok()
    };
    for _ in 0..EDITED {
        let which = one_of(&mut rng, Which::ALL);
        let text = changed(which.text(), &mut rng);
        let [c_cnt, km] = drawn(&mut runner, &mut rng);
        let scene = match which {
            Which::CCnt => c_cnt,
            Which::Km => km,
        };
        let listing = read(which.name(), &text);
        cases.extend(listing.map(|listing| Case {
            listing,
            settings: Settings::default(),
            ..scene
        }));
        let program = one_of(&mut rng, Program::ALL);
        read(program.name(), &changed(program.text(), &mut rng));
    }
    let matrix = Array::from_fn(2, 2, |i, j| (2 * i + j + 1) as f64);
    let (values, sheet) =
        defined([("v", Array::column(vec![1.0, 2.0, 3.0]).into()), ("m", matrix.into())]);
    let around = Around::Sheet(values, Rc::new(sheet));
    for text in rules().into_iter().chain(corpus()) {
        read("f", &changed(&text, &mut rng));
        let Some(listing) = read("f", &text) else { continue };
        for settings in [Settings::default(), any_settings(&mut rng)] {
            let (listing, around, arguments) =
                (listing.clone(), around.clone(), vec![Value::Number(5.0)]);
            cases.push(Case { listing, around, settings, arguments });
        }
    }
    let folder = TempDir::new().expect("a folder");
    let known = json!({ "functions": unsupported::FUNCTIONS, "units": unsupported::UNITS });
    let path = folder.path();
    let files = [
        written(path, "interpreter", &json!(INTERPRETER.join("\n"))),
        written(path, "known", &known),
        written(path, "cases", &cases.iter().map(Case::json).collect()),
        written(path, "texts", &json!(texts)),
    ];
    let in_node = compared(&cases, &files, None);
    if let Some(modules) = browser() {
        assert_eq!(compared(&cases, &files, Some(&modules)), in_node, "in a browser as in node");
    }
}

/// Compares the cases and the texts in node, or in the browser that these modules drive; returns the counts.
fn compared(cases: &[Case], files: &[String], browser: Option<&Path>) -> Json {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fidelity/page_interpreter.cjs");
    let mut node = Command::new("node");
    node.arg(script).args(files);
    node.envs(browser.map(|modules| ("BROWSER_MODULES", modules)));
    let output = node.output().expect("node starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let said: Json = serde_json::from_str(&said).expect("JSON");
    if let Some([case, step]) = said["differs"]
        .as_array()
        .map(|at| [0, 1].map(|k| at[k].as_u64().expect("a number") as usize))
    {
        panic!("{}", difference(&cases[case], step, &said));
    }
    println!("{said}");
    let count = |name: &str| said[name].as_u64().expect("a number");
    assert_eq!(said["texts"], json!([]), "texts that are not read alike");
    assert!(count("same") > SCENES as u64 && count("failed") > SCENES as u64, "{said}");
    assert!(count("refused") > EDITED as u64 && count("limited") < 20, "{said}");
    // The functions and powers that the page does not have.
    assert!(count("beyond") < 120, "{said}");
    said
}

/// What a page of `fig1` shows: a run, nodes that were dragged, a tolerance over the run's, listings that
/// were edited.
#[derive(Clone)]
struct Situation {
    run: usize,
    moved: BTreeMap<usize, [f64; 2]>,
    factor: f64,
    edits: BTreeMap<&'static str, String>,
}

impl Situation {
    const FIRST: Situation =
        Situation { run: 0, moved: BTreeMap::new(), factor: 1.0, edits: BTreeMap::new() };

    /// Drags a node, switches the run, moves the tolerance, or edits a listing by one character.
    fn change(&mut self, rng: &mut Rng, runs: usize, nodes: &[[f64; 2]]) {
        match rng.u8(..10) {
            0..4 => {
                let n = rng.usize(..nodes.len());
                let mut near = |x: f64, by: f64| x + by * (rng.f64() - 0.5);
                let [x, y] = nodes[n];
                self.moved.insert(n + 1, [near(x, 1.0), near(y, 0.1)]);
            }
            4..6 => self.run = rng.usize(..runs),
            6 => self.factor = one_of(rng, &[0.1, 0.5, 1.0, 3.0, 30.0]),
            7..9 => {
                let which = one_of(rng, Which::ALL);
                let text = changed(which.text(), rng);
                if Listing::parse(which.name(), &text).is_ok() {
                    self.edits.insert(which.name(), text);
                }
            }
            _ => *self = Situation::FIRST,
        }
    }

    /// Writes the situation, and what both listings do in it.
    fn json(&self, runs: &[(Switch, Arc<Model>)]) -> Json {
        let (switch, model) = &runs[self.run];
        let mut model = Model::clone(model);
        self.moved.iter().for_each(|(n, at)| model.nodes[n - 1] = *at);
        model.contact.tolerance *= self.factor;
        let sheet = Rc::new(door::worksheet(&model, |x| x));
        let case = |which: Which, argument: Value| Case {
            listing: match self.edits.get(which.name()) {
                Some(text) => Listing::parse(which.name(), text).expect("it was read"),
                None => switch.listing(which),
            },
            around: Around::Scene(sheet.clone()),
            settings: switch.settings(),
            arguments: vec![argument],
        };
        let c_cnt = case(Which::CCnt, Value::from(&sheet.node));
        let km = c_cnt.execute(|_| ()).ok().map(|(pairs, _)| case(Which::Km, pairs).json());
        let moved: Vec<_> = self.moved.iter().collect();
        json!({ "run": self.run, "moved": moved, "factor": self.factor, "edits": self.edits,
            "c_cnt": c_cnt.json(), "km": km })
    }
}

/// Over 3,000 moves in the page's own scripts: nodes are dragged, listings edited, readings switched, and steps
/// taken in both listings; every statement is that of this interpreter, and stepping forwards and backwards
/// leads to the same values.
#[test]
fn three_thousand_moves_leave_the_page_where_this_interpreter_is() {
    if !has_node() {
        return;
    }
    let scene = Scene::open("fig1").expect("an embedded scene");
    let models = switches(&scene).into_iter();
    let models = models.filter_map(|switch| Some((switch.clone(), switch.model(&scene).ok()?)));
    let runs: Vec<(Switch, Arc<Model>)> = models.collect();
    let mut rng = Rng::with_seed(46);
    let mut now = Situation::FIRST;
    let mut situations = vec![];
    for _ in 0..MOVED {
        now.change(&mut rng, runs.len(), &scene.model.nodes);
        situations.push(now.json(&runs));
    }
    let reference = reference(&scene, &runs[0].1);
    let (finding, repairs) = (None, None);
    let chapter =
        Chapter { scene: scene.clone(), runs, nodes: vec![], finding, repairs, reference };
    let folder = TempDir::new().expect("a folder");
    let page = folder.path().join("lesson.html");
    std::fs::write(&page, lesson::html(&[chapter], Language::En)).expect("a file");
    let situations = written(folder.path(), "situations", &json!(situations));
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fidelity/page_moves.cjs");
    let output =
        Command::new("node").arg(script).arg(page).arg(situations).output().expect("node starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let counts: Json = serde_json::from_str(&said).expect("JSON");
    assert_eq!(counts["differs"], Json::Null, "{said}");
    println!("{said}");
    let count = |name: &str| counts[name].as_u64().expect("a number");
    assert!(count("moves") > 3_000 && count("failed") > 5 && count("limited") < 50, "{said}");
}

/// Says where the page's interpreter differs, and what this one has there.
fn difference(case: &Case, step: usize, said: &Json) -> String {
    let mut ours = vec![];
    let end = case.execute(|done| ours.push(done.clone()));
    let mut words = String::new();
    writeln!(words, "{} under {:?}, step {step}", case.listing.name(), case.settings)
        .expect("a text");
    writeln!(words, "{}", case.listing).expect("a text");
    writeln!(words, "here: {:?}", ours.get(step)).expect("a text");
    let end = end.map(|(value, _)| value.kind()).map_err(|failure| failure.to_string());
    writeln!(words, "it ends with {end:?}").expect("a text");
    writeln!(words, "in the page: {}", said["page"].as_str().unwrap_or_default()).expect("a text");
    words
}
