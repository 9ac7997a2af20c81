//! The table of messages: nothing that pages and reports say in English is missing in it, and it has
//! nothing that they do not say.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use plane_contact::report::language::messages;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The files below a folder whose names end so.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(Path::new(ROOT).join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let below = |path: PathBuf| match path.is_dir() {
        true => files(&path.to_string_lossy(), ending),
        false if path.to_string_lossy().ends_with(ending) => vec![path],
        false => vec![],
    };
    paths.flat_map(below).collect()
}

fn texts(folder: &str, ending: &str) -> Vec<String> {
    let read = |path: &PathBuf| std::fs::read_to_string(path).expect("UTF-8");
    files(folder, ending).iter().map(read).collect()
}

/// What the scripts of the pages say: the first argument of every `t("...")`.
fn in_scripts() -> BTreeSet<String> {
    let said = |text: &String| -> Vec<String> {
        let calls = text.match_indices("t(\"");
        let calls = calls.filter(|(at, _)| !text[..*at].ends_with(|c: char| c.is_alphanumeric()));
        let said = calls.map(|(at, call)| text[at + call.len()..].split('"').next());
        said.map(|words| words.expect("a text").to_string()).collect()
    };
    texts("src/report/page", ".js").iter().flat_map(said).collect()
}

/// What the bodies of the pages say: between tags, and in attributes that are read.
fn in_bodies() -> BTreeSet<String> {
    let mut said = BTreeSet::new();
    for body in texts("src/report/page", "body.html") {
        for piece in body.split('<') {
            let (tag, text) = piece.split_once('>').unwrap_or(("", piece));
            said.insert(text.split_whitespace().collect::<Vec<_>>().join(" "));
            for name in [" title=\"", " alt=\"", " aria-label=\""] {
                said.extend(
                    tag.split(name)
                        .skip(1)
                        .map(|rest| rest.split('"').next().unwrap_or("").to_string()),
                );
            }
        }
    }
    let has_words = |text: &String| text.contains(char::is_alphabetic) && text != "DOCUMENT";
    said.into_iter().filter(has_words).collect()
}

#[test]
fn every_word_of_a_page_is_in_the_table_of_messages() {
    let table: BTreeSet<&str> = messages().map(|(english, _)| english).collect();
    let said: BTreeSet<String> = in_scripts().union(&in_bodies()).cloned().collect();
    let missing: Vec<&String> = said.iter().filter(|text| !table.contains(text.as_str())).collect();
    assert!(missing.is_empty(), "without Russian in src/report/messages.tsv: {missing:#?}");
}

#[test]
fn a_message_stands_once_and_has_the_values_of_its_english() {
    let mut seen = BTreeSet::new();
    for (english, russian) in messages() {
        assert!(seen.insert(english), "twice: {english}");
        assert!(!russian.trim().is_empty(), "without Russian: {english}");
        let values = |text: &str| -> BTreeSet<String> {
            let names = text.split('{').skip(1).filter_map(|rest| rest.split_once('}'));
            names.map(|(name, _)| name.trim_end_matches('!').to_string()).collect()
        };
        assert_eq!(values(english), values(russian), "{english}");
    }
}
