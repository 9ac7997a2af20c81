//! What users read, under snapshot: the texts of commands on fixed scenes, and every page of help.
//!
//! Words are exact. A number may differ by one in its last printed digit, and is not compared where
//! it is rounding itself (below 1e-9): residuals and what rounding does to a displacement.

use std::path::{Path, PathBuf};

use plane_contact::problem::modelling::Variant;
use tempfile::TempDir;

use crate::claims::STRAND;
use crate::common::golden_file::assert_text;
use crate::common::program::run;
use crate::common::same_text::same_text;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Prints what the program prints, without the folder that it was run in.
pub fn printed(args: &[&str]) -> String {
    let folder = TempDir::new().expect("a temporary folder");
    let output = run(folder.path(), args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn assert_printed(folder: &str, name: &str, args: &[&str]) {
    assert_text(format!("golden/{folder}/{name}.snap"), &printed(args), same_text);
}

#[test]
fn texts_differ_by_words_and_by_more_than_a_digit() {
    assert!(same_text("a 0.123  5e-17", "a 0.124  0"));
    assert!(!same_text("a 0.123", "a 0.125"));
    assert!(!same_text("a 0.123", "a 0.12"));
    assert!(!same_text("a 3", "a 4"));
    assert!(!same_text("a 0", "a 0.9"));
    assert!(!same_text("a 1.5e-3", "a 1.7e-3"));
    assert!(!same_text("nodes 5, 6", "nodes 5, 7"));
    assert!(!same_text("30 %", "30"));
    assert!(!same_text("(no load) 5", "no load 5"));
    assert!(!same_text("a   1.5", "a 1.5"));
    assert!(!same_text("---  ----\n1", "----  ---\n1"));
}

/// Without a per cent sign, a bracket or a column of blanks no golden text is the same.
#[test]
fn no_golden_text_can_lose_a_sign() {
    let golden = Path::new(ROOT).join("golden");
    for name in ["fig1/audit", "fig1/report", "strand/audit", "strand/solve-tied", "help"] {
        let text = std::fs::read_to_string(golden.join(format!("{name}.snap"))).expect("a text");
        for sign in ["%", "(", ")", ",", "  "] {
            assert!(
                !text.contains(sign) || !same_text(&text, &text.replacen(sign, "", 1)),
                "{name} {sign:?}"
            );
        }
    }
}

const SCENES: [&str; 3] = ["fig1", "two-blocks", "strand"];

#[test]
fn solve() {
    for scene in SCENES {
        for variant in Variant::ALL.iter().map(|variant| variant.name()) {
            let args = ["solve", scene, "--variant", variant, "--out", "out"];
            assert_printed(scene, &format!("solve-{variant}"), &args);
        }
    }
}

#[test]
fn audit() {
    for scene in SCENES {
        let screen = match scene {
            "strand" => STRAND.screen.clone(),
            other => printed(&["audit", other]),
        };
        assert_text(format!("golden/{scene}/audit.snap"), &screen, same_text);
        assert!(screen.split_whitespace().count() <= 350, "{screen}");
        let verdict = screen.split("\n\n").nth(1).expect("a verdict");
        assert!(verdict.starts_with("No. "), "{verdict}");
        assert!(verdict.split_whitespace().count() <= 12 + 3 * 25, "{verdict}");
        assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
    }
    assert_printed("fig1", "audit-full", &["audit", "fig1", "--full"]);
    assert_printed("findings/C4", "audit", &["audit", "--finding", "C4"]);
    assert_printed("fig1", "claim", &["audit", "fig1", "--claim", "P12"]);
}

#[test]
fn plan() {
    for scene in SCENES {
        assert_printed(scene, "plan", &["scene", "plan", scene]);
    }
}

#[test]
fn c_cnt() {
    for scene in SCENES {
        assert_printed(scene, "c_cnt", &["listing", "run", "c_cnt", scene]);
    }
}

/// Returns the names of all commands, such as `listing run`, by the lists on the pages of help.
pub fn commands() -> Vec<String> {
    let mut commands = inner(&[]);
    let mut k = 0;
    while let Some(command) = commands.get(k) {
        let more = inner(&command.split(' ').collect::<Vec<_>>());
        commands.extend(more);
        k += 1;
    }
    commands
}

/// Returns the names of the commands on the page of help of a group: the rows before the options.
fn inner(group: &[&str]) -> Vec<String> {
    let page = run(Path::new("."), &[group, &["--help"]].concat()).stdout;
    let page = String::from_utf8(page).expect("UTF-8");
    let rows = page.lines().skip_while(|line| !line.starts_with("Usage:"));
    let rows = rows.take_while(|line| !line.starts_with("Options:"));
    let is_row = |line: &&str| line.starts_with("  ") && line[2..].starts_with(char::is_alphabetic);
    let names = rows.filter(is_row).filter_map(|line| line.split_whitespace().next());
    let names = names.filter(|name| *name != "help");
    names.map(|name| [group, &[name]].concat().join(" ")).collect()
}

/// Every page of help but those of the generators: two screens at most, with examples.
#[test]
fn help() {
    let pages = commands().into_iter().filter(|command| !command.starts_with("scene mesh "));
    let pages: Vec<String> = std::iter::once(String::new()).chain(pages).collect();
    let mut all = String::new();
    for page in &pages {
        let args: Vec<&str> = page.split_whitespace().chain(["--help"]).collect();
        let text = printed(&args);
        assert!(text.lines().count() <= 100, "{page}: {} lines", text.lines().count());
        assert!(text.contains("Examples:"), "{page}");
        // The terminal alone breaks a sentence: the next word would not fit.
        let mut pairs = text.lines().zip(text.lines().skip(1));
        let goes_on = |line: &str| line.starts_with(char::is_lowercase);
        let fits = |line: &str, next: &str| {
            let word = next.split(' ').next().unwrap_or_default();
            line.chars().count() + 1 + word.chars().count() <= 100
        };
        let broken = pairs.find(|(line, next)| {
            line.contains(' ') && !line.starts_with(' ') && goes_on(next) && fits(line, next)
        });
        assert_eq!(broken, None, "{page}");
        all += &format!("# plane-contact {}\n\n{text}\n", args.join(" "));
    }
    assert_text("golden/help.snap", &all, same_text);
}

/// The commands that a text names: what follows the name of the program.
fn named(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let is_word = |word: &&str| {
        !word.starts_with('-') && word.chars().all(|c| c.is_ascii_alphabetic() || "_-".contains(c))
    };
    text.split("plane-contact ").skip(1).map(move |rest| {
        let words = rest.split([' ', '\n', '`', '"', '\'', ',', '.', ':', ';', ')', '|', '\\']);
        words.take_while(|word| !word.is_empty() && is_word(word)).take(3).collect()
    })
}

/// Files with texts for people below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut files = Vec::new();
    for path in entries.map(|entry| entry.path()) {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if path.is_dir() {
            files.extend(self::files(&path));
        } else if ["rs", "md", "snap", "txt"].contains(&ending) {
            files.push(path);
        }
    }
    files
}

/// No text names a command that does not exist: sources with messages and help, pages, documents. No message, help or
/// output cites a page by its file, which who installed the program does not have.
#[test]
fn every_command_that_a_text_names_exists() {
    let commands = commands();
    let root = Path::new(ROOT);
    let folders = ["src", "golden", "listings", "examples", "benches", "tests/cases"];
    let mut texts: Vec<_> = folders.iter().flat_map(|name| files(&root.join(name))).collect();
    texts.extend([".ci/run", "README.md"].map(|name| root.join(name)));
    let mut found = 0;
    for file in texts {
        let text = std::fs::read_to_string(&file).expect("text");
        if file.extension().is_some_and(|ending| ending == "snap" || ending == "txt") {
            for page in
                ["src/guide/", "golden/tables/", "listings/README.md", "src/mathcad/README.md"]
            {
                assert!(!text.contains(page), "{} cites {page}", file.display());
            }
        }
        if file.starts_with(root.join("tests")) {
            continue;
        }
        for words in named(&text).filter(|words| !words.is_empty()) {
            let is_group = |command: &String| command.starts_with(&format!("{} ", words[0]));
            let in_group = commands.iter().any(is_group);
            let name = words.iter().take(1 + usize::from(in_group)).copied().collect::<Vec<_>>();
            let exists = commands.contains(&name.join(" ")) || words == ["help"];
            assert!(exists, "{}: plane-contact {}", file.display(), name.join(" "));
            found += 1;
        }
    }
    assert!(found > 100, "{found} commands are named");
}

/// Every page of the guide prints, and what it names instead of a link is there: a page, a command, a file of the
/// repository.
#[test]
fn every_link_of_the_guide_leads_somewhere() {
    let list = printed(&["guide"]);
    let names = list.lines().filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    let names: Vec<&str> = names.collect();
    let (mut commands, mut links) = (0, 0);
    for page in &names {
        let text = printed(&["guide", page]);
        assert!(!text.contains("]("), "{page}");
        for named in text.split("plane-contact guide ").skip(1) {
            let end = named.find(|c: char| !c.is_ascii_alphabetic() && c != '-');
            let named = &named[..end.unwrap_or(named.len())];
            assert!(names.contains(&named), "{page}: {named:?}");
            commands += 1;
        }
        for link in text.split(" (`").skip(1).filter_map(|rest| rest.split_once("`)")) {
            match link.0.strip_prefix("plane-contact ") {
                Some(command) if command.starts_with("audit") => {
                    let explained = printed(&command.split(' ').collect::<Vec<_>>());
                    assert!(!explained.is_empty(), "{page}: {command}");
                }
                Some(_) => (),
                None if link.0.contains('/') => {
                    assert!(Path::new(ROOT).join(link.0).exists(), "{page}: {}", link.0);
                }
                None => continue,
            }
            links += 1;
        }
        let open: Vec<_> =
            names.iter().filter(|name| text.contains(&format!("[{name}]"))).collect();
        assert!(open.is_empty(), "{page}: {open:?}");
    }
    assert!(commands > 30 && links > 30, "{commands} commands, {links} links");
    for values in ["`unilateral`: ", "`f64x2`: ", "R2 ", "`mortar`: "] {
        assert!(printed(&["guide", "options"]).contains(values), "{values}");
    }
}
