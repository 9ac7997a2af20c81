//! The architecture, held to what README.md says of it: no import runs upwards, none runs in a
//! circle, and the paper's names stay in the paper's room.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rooms of `src/`, each of which may import those before it: the folders that the listing of
/// `src/` shows, from the bottom up.
const LAYERS: &[&[&str]] = &[
    &["choices", "error", "files", "memory", "plain", "suggestion", "xml"],
    &["numbers"],
    &["problem"],
    &["paper"],
    &["answer"],
    &["studies"],
    &["report"],
    &["lib"],
    &["commands", "main"],
];

/// What takes the place of a part of the listings, or evaluates their conditions.
const STAND_INS: &[&str] = &["answer::decisions", "answer::fast::listings"];

/// The names that the top level may have.
const TOP: &[&str] = &[
    ".ci",
    ".gitignore",
    "CHANGELOG.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "SECURITY.md",
    "benches",
    "deny.toml",
    "examples",
    "fuzz",
    "golden",
    "listings",
    "rustfmt.toml",
    "src",
    "tests",
];

/// A source file: its module path and what it imports, in the words of the file.
struct Source {
    path: PathBuf,
    module: Vec<String>,
    text: String,
}

/// The library and the program: every file of `src/`.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    walk(&root, &mut files);
    files.sort();
    let source = |path: PathBuf| {
        let inside = path.strip_prefix(&root).expect("a file of src").with_extension("");
        let mut module: Vec<String> =
            inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if module.last().is_some_and(|last| last == "mod") {
            module.pop();
        }
        let text = std::fs::read_to_string(&path).expect("a source file is text");
        Source { path, module, text: code(&text) }
    };
    files.into_iter().map(source).collect()
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of src") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            walk(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The text without comments and without what stands in quotes.
fn code(text: &str) -> String {
    let mut rest = text;
    let mut kept = String::new();
    while let Some(next) = rest.chars().next() {
        let (skipped, in_place) = match rest {
            _ if rest.starts_with("//") => (rest.find('\n').unwrap_or(rest.len()), ""),
            _ if rest.starts_with('"') => (quoted(rest), "\"\""),
            _ if !kept.ends_with(is_word) && raw(rest).is_some() => {
                (raw(rest).expect("it was found"), "\"\"")
            }
            _ if rest.starts_with('\'') => (character(rest), "'"),
            _ => (0, ""),
        };
        if skipped == 0 {
            kept.push(next);
            rest = &rest[next.len_utf8()..];
        } else {
            kept += in_place;
            rest = &rest[skipped..];
        }
    }
    kept
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The length of the string that `text` begins with.
fn quoted(text: &str) -> usize {
    let mut escaped = false;
    let end = text[1..].find(|c| {
        let ends = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        ends
    });
    end.map_or(text.len(), |at| at + 2)
}

/// The length of the raw string that `text` begins with.
fn raw(text: &str) -> Option<usize> {
    let after_r = text.strip_prefix('r').or_else(|| text.strip_prefix("br"))?;
    let inside = after_r.trim_start_matches('#');
    let close = format!("\"{}", "#".repeat(after_r.len() - inside.len()));
    let end = inside.strip_prefix('"')?.find(&close)?;
    Some(text.len() - inside.len() + 1 + end + close.len())
}

/// The length of the character that `text` begins with; of a lifetime that of its apostrophe.
fn character(text: &str) -> usize {
    let inside: Vec<char> = text.chars().skip(1).take(2).collect();
    match inside[..] {
        ['\\', escaped] => {
            let from = 2 + escaped.len_utf8();
            text[from..].find('\'').map_or(text.len(), |at| from + at + 1)
        }
        [one, '\''] => 2 + one.len_utf8(),
        _ => 1,
    }
}

/// The paths that a file imports, braces opened: `use a::{b, c::d};` is a::b and a::c::d.
fn imports(source: &Source) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for statement in source.text.split(';') {
        let Some(at) = statement.rfind("use ") else { continue };
        let before = statement[..at].trim_end();
        let is_statement =
            before.is_empty() || before.ends_with(['}', '{', ']', ')']) || before.ends_with("pub");
        if is_statement {
            open(&[], &statement[at + 4..], &mut found);
        }
    }
    // Paths that stand in the code itself. One that ends in `::` is the head of braces, opened
    // above.
    let words = source.text.split(|c: char| !(is_word(c) || c == ':'));
    for word in words.filter(|word| word.contains("::") && !word.ends_with("::")) {
        found.push(word.split("::").filter(|part| !part.is_empty()).map(String::from).collect());
    }
    found
}

/// Opens the braces of an import behind `prefix`.
fn open(prefix: &[String], text: &str, found: &mut Vec<Vec<String>>) {
    let text = text.trim();
    if let Some((head, inside)) = text.split_once('{') {
        let mut prefix = prefix.to_vec();
        prefix.extend(head.split("::").map(str::trim).filter(|p| !p.is_empty()).map(String::from));
        let inside = inside.rsplit_once('}').map_or(inside, |(inside, _)| inside);
        split_outside_braces(inside).into_iter().for_each(|part| open(&prefix, part, found));
        return;
    }
    let name = text.split(" as ").next().unwrap_or_default();
    let mut path = prefix.to_vec();
    path.extend(name.split("::").map(str::trim).filter(|p| !p.is_empty()).map(String::from));
    found.push(path);
}

fn split_outside_braces(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => (),
        }
    }
    parts.push(&text[start..]);
    parts
}

/// Which file each file imports. A name that a folder's `mod.rs` passes on from one of its files
/// counts as that file's.
struct Graph {
    files: BTreeMap<Vec<String>, usize>,
    passed_on: BTreeMap<(Vec<String>, String), Vec<String>>,
}

impl Graph {
    fn new(sources: &[Source]) -> Self {
        let files: BTreeMap<Vec<String>, usize> =
            sources.iter().enumerate().map(|(k, source)| (source.module.clone(), k)).collect();
        let mut passed_on = BTreeMap::new();
        for source in sources {
            for path in passed_on_by(source) {
                let absolute = absolute(&source.module, &path, &files);
                if let Some(name) = path.last() {
                    passed_on.insert((source.module.clone(), name.clone()), absolute);
                }
            }
        }
        Graph { files, passed_on }
    }

    /// The file that an imported path stands in.
    fn file(&self, path: &[String]) -> Option<usize> {
        let at = (0..=path.len()).rev().find(|n| self.files.contains_key(&path[..*n]))?;
        let module = path[..at].to_vec();
        if let Some(name) = path.get(at)
            && let Some(elsewhere) = self.passed_on.get(&(module.clone(), name.clone()))
            && elsewhere != path
        {
            return self.file(elsewhere);
        }
        self.files.get(&module).copied()
    }
}

/// The paths that a file passes on: `pub use`.
fn passed_on_by(source: &Source) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for statement in source.text.split(';') {
        let statement = statement.trim();
        if let Some(at) = statement.rfind("pub use ").or_else(|| statement.rfind("pub(super) use "))
        {
            let path = statement[at..].split_once("use ").expect("it was found").1;
            open(&[], path, &mut found);
        }
    }
    found
}

/// An imported path from the root of the library on; empty for what is no file of it.
fn absolute(
    module: &[String],
    path: &[String],
    files: &BTreeMap<Vec<String>, usize>,
) -> Vec<String> {
    let rest = |n: usize| path[n..].to_vec();
    match path.first().map(String::as_str) {
        Some("crate") if module.first().is_some_and(|m| m == "commands" || m == "main") => {
            [vec!["main".to_string()], rest(1)].concat()
        }
        Some("crate" | "plane_contact") => rest(1),
        Some("self") => [module.to_vec(), rest(1)].concat(),
        Some("super") => {
            let ups = path.iter().take_while(|part| *part == "super").count();
            [module[..module.len().saturating_sub(ups)].to_vec(), rest(ups)].concat()
        }
        Some(first) => {
            let own = [module.to_vec(), vec![first.to_string()]].concat();
            let is_own = files.contains_key(&own);
            if is_own { [module.to_vec(), rest(0)].concat() } else { Vec::new() }
        }
        None => Vec::new(),
    }
}

/// For each file the files that it imports.
fn arrows(sources: &[Source]) -> Vec<BTreeSet<usize>> {
    let graph = Graph::new(sources);
    sources
        .iter()
        .enumerate()
        .map(|(k, source)| {
            let passed_on: BTreeSet<Vec<String>> = passed_on_by(source).into_iter().collect();
            let paths = imports(source).into_iter().filter(|path| !passed_on.contains(path));
            let absolute = paths.map(|path| absolute(&source.module, &path, &graph.files));
            let files = absolute.filter(|path| !path.is_empty()).filter_map(|p| graph.file(&p));
            files.filter(|file| *file != k).collect()
        })
        .collect()
}

fn layer(source: &Source) -> usize {
    let room = source.module.first().expect("a file has a place");
    let found = LAYERS.iter().position(|layer| layer.contains(&room.as_str()));
    found.unwrap_or_else(|| panic!("{room} of src/ is in no layer of tests/fidelity"))
}

fn name(source: &Source) -> String {
    source.module.join("::")
}

#[test]
fn no_import_runs_upwards() {
    let sources = sources();
    let mut wrong = Vec::new();
    for (source, imported) in sources.iter().zip(arrows(&sources)) {
        for other in imported.into_iter().map(|k| &sources[k]) {
            if layer(other) > layer(source) {
                wrong.push(format!("{} imports {}", name(source), name(other)));
            }
        }
    }
    assert!(wrong.is_empty(), "imports that run upwards:\n{}", wrong.join("\n"));
}

#[test]
fn no_import_runs_in_a_circle() {
    let sources = sources();
    let arrows = arrows(&sources);
    let mut circles = BTreeSet::new();
    for start in 0..sources.len() {
        if let Some(circle) = way_back(start, &arrows) {
            let first = circle.iter().min().copied().expect("a circle has a file");
            if first == start {
                let names: Vec<String> = circle.iter().map(|k| name(&sources[*k])).collect();
                circles.insert(names.join(" -> "));
            }
        }
    }
    assert!(circles.is_empty(), "imports in a circle:\n{}", Vec::from_iter(circles).join("\n"));
}

/// The shortest way from a file along its imports back to itself.
fn way_back(start: usize, arrows: &[BTreeSet<usize>]) -> Option<Vec<usize>> {
    let mut from: BTreeMap<usize, usize> = BTreeMap::new();
    let mut next = vec![start];
    while !next.is_empty() {
        let mut beyond = Vec::new();
        for &file in &next {
            for &other in &arrows[file] {
                if other == start {
                    let mut way = vec![file];
                    while way.last() != Some(&start) {
                        way.push(from[way.last().expect("it has a file")]);
                    }
                    way.reverse();
                    return Some(way);
                }
                if let std::collections::btree_map::Entry::Vacant(entry) = from.entry(other) {
                    entry.insert(file);
                    beyond.push(other);
                }
            }
        }
        next = beyond;
    }
    None
}

/// Cargo.toml builds no unit tests of the library and the program: they would not be run.
#[test]
fn every_test_stands_in_the_tests_folder() {
    let sources = sources();
    let own = sources.iter().filter(|s| s.text.contains("#[test]") || s.text.contains("cfg(test)"));
    assert_eq!(own.map(name).collect::<Vec<_>>(), [""; 0]);
}

/// The paper's arrays and its arithmetic of equation numbers stand in the paper's room alone, and in what
/// takes the place of a part of its listings or evaluates its conditions.
#[test]
fn the_papers_names_stay_in_the_papers_room() {
    let forbidden: &[&[&str]] = &[
        &["EL"],
        &["ind_1"],
        &[".", "S", "["],
        &[".", "S", "."],
        &[".", "cnt"],
        &[".", "trg"],
        &[".", "elem"],
        &["2", "*", "n", "-"],
        &["2", "*", "node", "-"],
        &["2", "*", "mate", "-"],
    ];
    let mut wrong = Vec::new();
    for source in sources().iter().filter(|source| {
        source.module[0] != "paper" && !STAND_INS.contains(&source.module.join("::").as_str())
    }) {
        for (number, line) in source.text.lines().enumerate() {
            let tokens = tokens(line);
            let has = |pattern: &&[&str]| tokens.windows(pattern.len()).any(|w| w == *pattern);
            if let Some(pattern) = forbidden.iter().find(|pattern| has(pattern)) {
                let path = source.path.display();
                wrong.push(format!("{path}:{}: {}: {line}", number + 1, pattern.concat()));
            }
        }
    }
    assert!(wrong.is_empty(), "the paper's names outside src/paper:\n{}", wrong.join("\n"));
}

/// Words and single signs.
fn tokens(line: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = line.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        tokens.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    tokens
}

/// The checks above see what they are to see.
#[test]
fn braces_circles_and_names_are_found() {
    let mut found = Vec::new();
    open(&[], "a::{b, c::{d as e, f}}", &mut found);
    let joined: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    assert_eq!(joined, ["a::b", "a::c::d", "a::c::f"]);
    let arrows = [vec![1], vec![2], vec![0], vec![0]].map(BTreeSet::from_iter);
    assert_eq!(way_back(0, &arrows), Some(vec![0, 1, 2]));
    assert_eq!(way_back(3, &arrows), None);
    assert_eq!(tokens("x.S[2*n - 1]"), ["x", ".", "S", "[", "2", "*", "n", "-", "1", "]"]);
    assert_eq!(code("a // .S[\n\"EL\" b"), "a \n\"\" b");
    let quotes = r##"a("//b", '"', '\'', r"\", r#"c"d"#, "\"e"): &'f g"##;
    assert_eq!(code(quotes), r#"a("", ', ', "", "", ""): &'f g"#);
}

/// What stands at the top: what the project is made of, and what Cargo and git conventions call for.
#[test]
fn the_top_level_has_what_belongs_there() {
    let output = std::process::Command::new("git")
        .args(["ls-files", "-z"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    // Without git, or outside a repository, nothing tells a file of the project from a result.
    let Some(output) = output.ok().filter(|output| output.status.success()) else { return };
    let files = String::from_utf8(output.stdout).expect("names are UTF-8");
    let top = |file: &str| file.split('/').next().expect("a name").to_string();
    let found: BTreeSet<String> = files.split_terminator('\0').map(top).collect();
    let known: BTreeSet<String> = TOP.iter().map(ToString::to_string).collect();
    let unknown: Vec<&String> = found.difference(&known).collect();
    assert!(unknown.is_empty(), "{unknown:?} do not belong at the top level");
}
