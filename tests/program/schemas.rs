//! JSON Schemas: every file and every document that `--json` prints has one, is valid by it, and no
//! schema lets through what it should not.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use plane_contact::files::json as reader;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::file;
use plane_contact::studies::lesson::exercise::{ANSWERS, Answers, Exercise};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::golden_file::assert_file;
use crate::common::program::run;
use crate::common::tools::is_there;
use crate::undefined::scene;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Prints what the program prints, whatever its exit status is, and that.
fn ran(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let output = run(folder, args);
    (output.status.code(), String::from_utf8(output.stdout).expect("UTF-8"))
}

/// The names of the schemas, each with the commands that print such documents under `--json`.
fn schemas() -> Vec<(String, Vec<String>)> {
    let (status, list) = ran(Path::new(ROOT), &["schema"]);
    assert_eq!(status, Some(0));
    let line = |line: &str| {
        let mut words = line.split(", ");
        let name = words.next().and_then(|start| start.split_whitespace().next()).expect("a name");
        let commands = words.filter_map(|word| word.strip_suffix(" --json")).map(String::from);
        (name.to_string(), commands.collect())
    };
    list.lines().map(line).collect()
}

#[test]
fn golden_schemas_are_those_that_the_program_prints() {
    let golden = Path::new(ROOT).join("golden/schema");
    let mut files = BTreeSet::from(["open.txt".to_string()]);
    for (name, commands) in schemas() {
        let (status, schema) = ran(Path::new(ROOT), &["schema", &name]);
        assert_eq!(status, Some(0), "{name}");
        assert_file(&golden.join(format!("{name}.schema.json")), &schema);
        for command in commands {
            assert_eq!(ran(Path::new(ROOT), &["schema", &command]).1, schema, "{command}");
        }
        files.insert(format!("{name}.schema.json"));
    }
    let there = std::fs::read_dir(&golden)
        .expect("a folder")
        .map(|file| file.expect("a file").file_name().into_string().expect("UTF-8"));
    assert_eq!(there.collect::<BTreeSet<String>>(), files);
    let (status, _) = ran(Path::new(ROOT), &["schema", "nothing"]);
    assert_eq!(status, Some(2));
}

/// The commands that have the option `--json`, by their pages of help.
fn commands_with_json() -> BTreeSet<String> {
    let pages = std::fs::read_dir(Path::new(ROOT).join("golden/help")).expect("a folder");
    let with_json = |file: std::fs::DirEntry| {
        let page = std::fs::read_to_string(file.path()).expect("text");
        let is_option = |line: &str| line.starts_with("      --json");
        let name = file.file_name().into_string().expect("UTF-8");
        page.lines().any(is_option).then(|| name.trim_end_matches(".snap").replace('-', " "))
    };
    pages.filter_map(|file| with_json(file.expect("a file"))).collect()
}

#[test]
fn no_command_with_json_lacks_a_schema() {
    let named: Vec<String> = schemas().into_iter().flat_map(|(_, commands)| commands).collect();
    assert_eq!(named.iter().cloned().collect::<BTreeSet<_>>(), commands_with_json());
    let each_once: BTreeSet<&String> = named.iter().collect();
    assert_eq!(each_once.len(), named.len());
}

/// Documents, each with the name of its schema, in a folder.
struct Documents {
    folder: TempDir,
    list: Vec<(String, PathBuf)>,
}

impl Documents {
    fn new() -> Self {
        Documents { folder: TempDir::new().expect("a folder"), list: Vec::new() }
    }

    fn at(&self) -> &Path {
        self.folder.path()
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.at().join(name), text).expect("written");
    }

    /// Adds a file that is there.
    fn file(&mut self, schema: &str, path: impl AsRef<Path>) {
        self.list.push((schema.into(), self.at().join(path)));
    }

    fn text(&mut self, schema: &str, text: &str) {
        let name = format!("document-{}.json", self.list.len());
        self.write(&name, text);
        self.file(schema, name);
    }

    /// Adds what a command prints under `--json`: one document with its head. Returns it.
    #[track_caller]
    fn printed(&mut self, schema: &str, status: i32, command: &str) -> Value {
        let args: Vec<&str> = command.split_whitespace().chain(["--json"]).collect();
        let (exit, text) = ran(self.at(), &args);
        assert_eq!(exit, Some(status), "{command}: {text}");
        let document: Value = serde_json::from_str(&text).expect("one document");
        assert_eq!(document["format"], 1, "{command}");
        assert_eq!(document["version"], env!("CARGO_PKG_VERSION"), "{command}");
        self.text(schema, &text);
        document
    }

    /// Validates all, and returns what the schemas leave open.
    fn validate(&self) -> String {
        let line = |(schema, document): &(String, PathBuf)| {
            json!([format!("{schema}.schema.json"), document])
        };
        python(
            "validate.py",
            &Value::from(self.list.iter().map(line).collect::<Vec<_>>()).to_string(),
        )
    }
}

/// Runs a script of `tests/program/schemas/` in the folder of the golden schemas, and returns what it
/// prints.
fn python(script: &str, input: &str) -> String {
    let mut python = Command::new("python3")
        .arg(Path::new(ROOT).join("tests/program/schemas").join(script))
        .current_dir(Path::new(ROOT).join("golden/schema"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("python");
    let mut pipe = python.stdin.take().expect("it is piped");
    pipe.write_all(input.as_bytes()).expect("it reads");
    drop(pipe);
    let output = python.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{script} fails: see standard error");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Documents of every command, of every shape.
fn succeeding(documents: &mut Documents) {
    for variant in Variant::ALL {
        documents.printed("result", 0, &format!("solve fig1 --variant {variant}"));
    }
    documents.printed("result", 0, "solve two-blocks --scalar exact --probe 0.5,0.5");
    documents.printed("result", 0, "solve fig1 --scalar f64x2-bounded --no-error-estimate");
    documents.printed("result", 0, "solve strand --variant unilateral --friction 0.3");
    documents.printed("audit", 0, "audit fig1");
    documents.printed("audit", 0, "audit two-blocks");
    documents.printed("finding", 0, "audit --finding C4");
    documents.printed("finding", 0, "audit fig1 --finding K1");
    documents.printed("prices", 0, "audit fig1 --prices --repairs");
    documents.printed("claim", 0, "audit fig1 --claim P12");
    documents.printed("c_cnt", 0, "listing run c_cnt fig1");
    documents.printed("extremes", 0, "extremes tolerance surfaces");
    documents.printed("plan", 0, "scene plan fig1");
    documents.printed("plan", 0, "scene plan strand --variant unilateral");
    documents.printed("statuses", 0, "audit --statuses --scenes 2");
    documents.printed("trace", 0, "listing trace fig1");
    documents.printed("trace", 0, "listing trace fig1 --listing Km --node 7");
    documents.printed("trade", 0, "trade fig1 --runs 1");
    documents.printed("compare", 0, "compare fig1 --with calculix --variant tied");
    documents.printed(
        "compare",
        0,
        "compare fig1 --with calculix --contact pair --variant unilateral",
    );
}

/// Documents of snapshots that agree and differ, of worksheets and programs, and of failures.
fn differing(documents: &mut Documents) {
    documents.write("sum.txt", "f(n) :=\n  n + 1\n");
    documents.printed("evaluate", 0, "listing evaluate sum.txt --call f(2)");
    documents.printed("evaluate", 2, "listing evaluate sum.txt --call f(1/0)");
    let at = documents.folder.path().to_path_buf();
    let done = |command: &str| {
        let args: Vec<&str> = command.split_whitespace().collect();
        assert_eq!(ran(&at, &args).0, Some(0), "{command}");
    };
    done("mathcad export fig1 --to mathcad --out fig1.xmcd");
    // Mathcad has saved nothing in it yet.
    documents.printed("mathcad", 1, "mathcad run fig1.xmcd");
    done("snapshot record fig1 --variant printed,tied,stepped,unilateral --out s.json");
    done("snapshot record fig1 --reading R4=eager --out failing.json");
    documents.file("snapshot", "s.json");
    documents.file("snapshot", "failing.json");
    documents.printed("verify", 0, "snapshot verify s.json failing.json");
    let text = std::fs::read_to_string(at.join("s.json")).expect("a snapshot");
    let mut changed: Value = serde_json::from_str(&text).expect("JSON");
    let run = &mut changed["runs"]["tied"];
    run["facts"]["iteration 3 dy"] = json!([1, 1, 1, 1, 1]);
    run["facts"].as_object_mut().expect("facts").remove("iteration 4 dy");
    run["facts"]["iteration 99 dy"] = json!([]);
    run["numbers"]["u"]["values"].as_array_mut().expect("rows").remove(3);
    run["numbers"]["stress"]["values"][0][1] = json!(7.0);
    run["numbers"]["gap"]["tolerance"] = json!({ "relative": 1e-6 });
    run["expected"] = json!([{
        "entry": "u", "row": 1, "value": 7.0, "tolerance": { "ulps": 4.0 },
        "origin": { "other-code": { "name": "a code", "version": "1" } }, "reason": "measured"
    }]);
    documents.text("snapshot", &changed.to_string());
    documents.write("changed.json", &changed.to_string());
    documents.printed("verify", 1, "snapshot verify changed.json");
    documents.printed("verify", 1, "snapshot explain changed.json");
    documents.printed("verify", 1, "snapshot diff strand --variant stepped,tied");
    done("snapshot accept s.json --scene two-blocks --reason another");
    documents.file("snapshot", "s.json");
}

/// What `--json` prints where there is no document, of every command that has it and of each cause.
fn failing(documents: &mut Documents) {
    for command in commands_with_json() {
        let place = if command == "snapshot diff" { "nowhere nowhere" } else { "nowhere" };
        // To verify, a file that cannot be read is a result among others.
        let schema = if command == "snapshot verify" { "verify" } else { "failure" };
        documents.printed(schema, 2, &format!("{command} {place}"));
        // What the command line does not know is an error of the input too.
        documents.printed("failure", 2, &format!("{command} --nothing"));
    }
    documents.printed("failure", 3, "solve fig1 --reading R4=left-to-right");
    documents.printed("failure", 3, "listing run c_cnt fig1 --reading R4=left-to-right");
    documents.printed("trace", 3, "listing trace fig1 --reading R4=left-to-right");
    let listing =
        std::fs::read_to_string(Path::new(ROOT).join("listings/c_cnt.txt")).expect("text");
    documents.write("edited.txt", &listing.replace("if dy[i1] = 1", "if dy[i1+9] = 1"));
    documents.printed("trace", 2, "listing trace fig1 --listing edited.txt");
    let hostile = Path::new(ROOT).join("tests/program/hostile");
    let two_answers = hostile.join("rocking-two-answers-a.json");
    documents.printed("result", 4, &format!("solve {} --geometry initial", two_answers.display()));
    let none = hostile.join("stick-penetrates.json");
    documents.printed("failure", 4, &format!("solve {}", none.display()));
    // A stamp that nothing holds at first.
    let mut scene = scene(-0.2, 0.25);
    let both = json!(["x", "y"]);
    scene["restraints"] = json!([{ "node": 3, "fix": both }, { "node": 4, "fix": both }]);
    documents.write("free.json", &scene.to_string());
    documents.printed("failure", 3, "solve free.json --variant tied");
}

/// Scenes, sweeps and their rows.
fn inputs(documents: &mut Documents) {
    let golden = Path::new(ROOT).join("golden");
    let findings = std::fs::read_dir(golden.join("findings")).expect("a folder");
    let findings = findings.map(|finding| finding.expect("a folder").path());
    let own = ["fig1", "two-blocks", "strand"].map(|name| golden.join(name));
    for folder in own.into_iter().chain(findings.filter(|path| path.is_dir())) {
        documents.file("scene", folder.join("scene.json"));
        if folder.join("snapshot.json").exists() {
            documents.file("snapshot", folder.join("snapshot.json"));
        }
    }
    for sweep in [
        json!({"format": 1, "scene": "fig1", "options": {"scalar": "f64x2"},
            "list": [{"/scene/contact/c_tll": 0.001}, {"/scene/contact/c_tll": -1}],
            "grid": {"/options/variant": ["tied", "stepped"]}}),
        json!({"format": 1, "generate": {"kind": "cook"},
            "grid": {"/generate/n": {"from": 2, "to": 4, "count": 2, "log": true}}}),
    ] {
        documents.text("sweep", &sweep.to_string());
        documents.write("sweep.json", &sweep.to_string());
        assert_eq!(ran(documents.at(), &["sweep", "sweep.json", "--out", "r.jsonl"]).0, Some(0));
        let rows = std::fs::read_to_string(documents.at().join("r.jsonl")).expect("rows");
        rows.lines().for_each(|row| documents.text("row", row));
    }
    let answer = |[node, ct, dy, k1]: [f64; 4]| json!({ "node": node as usize, "ct": ct, "dy": dy, "k1": (100.0 * k1).round() / 100.0 });
    let found = Exercise { exercise: 7, seed: 2026 }.found().into_iter().map(answer);
    let answers = json!({ "kind": ANSWERS, "exercise": 7, "seed": 2026, "student": "A. Student",
        "answers": found.collect::<Vec<_>>() });
    documents.text("answers", &answers.to_string());
    documents.write("answers.json", &answers.to_string());
    documents.printed("marks", 0, "snapshot verify answers.json");
}

const ANSWERS_FILE: reader::Kind =
    reader::Kind { name: "answers", fix: "give answers", has_values: false };

/// What stands in place of each value of a document in turn.
const VALUES: &str = r#"["words", "1e9", "0.5", "stick", "x", -0.5, 2.5, 3, -1, true, null, {},
    {"x": 1}, [], [3], [[]], [1, 2], [1, 0, 0, 0]]"#;

/// Returns the JSON pointers of a document; of a list only those of its first item.
fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    found.push(at.into());
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, item)| pointers(item, &format!("{at}/{name}"), found));
        }
        Value::Array(items) => {
            items.iter().take(1).for_each(|item| pointers(item, &format!("{at}/0"), found));
        }
        _ => (),
    }
}

/// Returns copies of a document, in each another value in the place of one, or without one.
fn edits(document: &Value) -> Vec<(String, Value)> {
    let values: Vec<Value> = serde_json::from_str(VALUES).expect("a list");
    let mut all = Vec::new();
    pointers(document, "", &mut all);
    let mut edited = Vec::new();
    for pointer in all {
        for value in &values {
            let mut copy = document.clone();
            *copy.pointer_mut(&pointer).expect("it is there") = value.clone();
            edited.push((format!("{pointer} = {value}"), copy));
        }
        let mut copy = document.clone();
        let (parent, name) = pointer.rsplit_once('/').unwrap_or_default();
        if let Some(fields) = copy.pointer_mut(parent).and_then(Value::as_object_mut) {
            fields.remove(name);
            edited.push((format!("{pointer} is left out"), copy));
        }
    }
    edited
}

/// A reader takes what its schema takes, and no more: whatever stands in place of a value.
#[test]
fn readers_take_what_their_schemas_take() {
    let mut package = Command::new("python3");
    package.args(["-c", "import jsonschema_rs"]);
    if !is_there(package, "REQUIRE_JSONSCHEMA") {
        return;
    }
    let scene = json!({
        "title": "all fields", "plane": "strain", "thickness": 1.5, "mesh": "a.msh",
        "units": { "length": "mm", "stress": "MPa", "force": "N" },
        "node": [[1, 0, 0, 0]], "elem": [[1, 2, 2, 7, 7, 1, 2, 3]],
        "materials": { "7": { "E": 3e4, "nu": 0.2 } },
        "restraints": [{ "on": 1, "node": 1, "fix": ["x", "y"] }],
        "loads": [{ "on": "top", "pressure": 1.5, "stage": 1 },
            { "on": "top", "traction": [0.5, 1] }, { "node": 3, "force": [0.5, -2.5] }],
        "contact": { "cnt": [1, 2], "trg": "target", "c_tll": 0.001, "coupling": "nts",
            "friction": 0.25, "geometry": "initial", "load_steps": 2, "status": "signs" },
        "iterations": 20, "variant": "tied", "drop_orphans": false
    });
    let answers = json!({ "kind": ANSWERS, "exercise": 7, "seed": 2026, "student": "A. Student",
        "answers": [{ "node": 5, "ct": 1.5, "dy": 1, "k1": 0.25 }] });
    type Read = fn(&[u8]) -> bool;
    let readers: [(&str, Value, Read); 2] = [
        ("scene", scene, |text| file::parse(text).is_ok()),
        ("answers", answers, |text| reader::read::<Answers>(text, &ANSWERS_FILE).is_ok()),
    ];
    for (schema, document, read) in readers {
        assert!(read(document.to_string().as_bytes()), "{schema}");
        let edited = edits(&document);
        let documents: Vec<&Value> = edited.iter().map(|(_, copy)| copy).collect();
        let schema = Path::new(ROOT).join(format!("golden/schema/{schema}.schema.json"));
        let allowed: Vec<bool> =
            serde_json::from_str(&python("verdicts.py", &json!([schema, documents]).to_string()))
                .expect("a list");
        let differing: Vec<&String> = edited
            .iter()
            .zip(allowed)
            .filter(|((_, copy), allowed)| read(copy.to_string().as_bytes()) != *allowed)
            .map(|((edit, _), _)| edit)
            .collect();
        assert!(differing.is_empty(), "{}: {differing:#?}", schema.display());
    }
}

/// Every document is valid by its schema, and `golden/schema/open.txt` shows what the schemas leave
/// open: fields that need not be there, names that are free, values of any type.
#[test]
fn every_document_is_valid_and_schemas_refuse_what_is_not() {
    let mut package = Command::new("python3");
    package.args(["-c", "import jsonschema_rs"]);
    let mut ccx = Command::new("sh");
    ccx.args(["-c", "command -v ccx"]);
    if !is_there(package, "REQUIRE_JSONSCHEMA") || !is_there(ccx, "REQUIRE_CCX") {
        return;
    }
    let mut documents = Documents::new();
    succeeding(&mut documents);
    differing(&mut documents);
    failing(&mut documents);
    inputs(&mut documents);
    let used: BTreeSet<&String> = documents.list.iter().map(|(schema, _)| schema).collect();
    schemas().iter().for_each(|(name, _)| assert!(used.contains(name), "{name} is not used"));
    assert_file(&Path::new(ROOT).join("golden/schema/open.txt"), &documents.validate());
}
