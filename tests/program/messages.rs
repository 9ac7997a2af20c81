//! The table of messages: nothing that pages and reports say in English is missing in it, and it has
//! nothing that they do not say.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use plane_contact::paper::mirror::READINGS;
use plane_contact::problem::modelling::Variant;
use plane_contact::report::language::{Language, messages};
use plane_contact::studies::audit::claims::CLAIMS;
use plane_contact::studies::audit::findings::{FINDINGS, Preparation, Repair};

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

/// Every text of the registers, and of the glossary.
fn in_registers() -> Vec<String> {
    let findings = FINDINGS.iter().flat_map(|finding| {
        let before = match finding.before {
            Preparation::AsPrinted => None,
            Preparation::Reading(words, _) | Preparation::Model(words, _) => Some(words),
        };
        let reason = match finding.edit {
            Repair::None { reason } => Some(reason),
            Repair::Edit { .. } => None,
        };
        let texts = [finding.title, finding.why, finding.repair, finding.number];
        texts.into_iter().chain(before).chain(reason).map(str::to_string).collect::<Vec<_>>()
    });
    let claims = CLAIMS.iter().flat_map(|claim| {
        [claim.place, claim.says, claim.condition, claim.threshold, claim.number]
            .map(str::to_string)
    });
    let readings = READINGS.iter().flat_map(|reading| {
        reading.values.iter().map(|value| value.words.to_string()).chain([reading.what.to_string()])
    });
    let glossary = include_str!("../../src/guide/glossary.md").lines();
    let rows = glossary.filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")).skip(1);
    let glossary = rows.flat_map(|row| row.split(" | ").map(str::to_string).collect::<Vec<_>>());
    let scenes = texts("golden", "scene.json").into_iter().filter_map(|scene| {
        let (_, rest) = scene.split_once("\"title\": \"")?;
        Some(rest.split('"').next()?.to_string())
    });
    findings.chain(claims).chain(readings).chain(glossary).chain(scenes).collect()
}

#[test]
fn every_text_of_the_registers_is_in_the_table_of_messages() {
    let is_russian = |text: &str| text.contains(|c: char| ('а'..='я').contains(&c));
    let is_name = |text: &str| !text.contains(' ');
    let missing: Vec<String> = in_registers()
        .into_iter()
        .filter(|text| !is_name(text) && !is_russian(&Language::Ru.say(text)))
        .collect();
    assert!(missing.is_empty(), "without Russian in src/report/messages.tsv: {missing:#?}");
}

/// The texts of the program on one line, without what joins the lines of one text.
fn sources() -> String {
    let folders = [
        ("src", ".rs"),
        ("src", ".js"),
        ("src", ".html"),
        ("src", ".md"),
        ("golden", "scene.json"),
        ("listings", ".edit"),
    ];
    let all = folders.iter().flat_map(|(folder, ending)| texts(folder, ending));
    let joined =
        all.map(|text| text.replace("\\\n", " ").replace("\\\"", "\"").replace("\n#", " "));
    let joined = joined.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
    // A variant is explained by its doc comment.
    joined.chain([Variant::help()]).collect()
}

#[test]
fn every_message_is_said_somewhere() {
    let sources = sources();
    let is_said = |english: &str| {
        let pieces =
            english.split('{').map(|piece| piece.split_once('}').map_or(piece, |(_, text)| text));
        pieces
            .map(str::trim)
            .filter(|piece| piece.contains(char::is_alphabetic))
            .all(|piece| sources.contains(piece))
    };
    let unused: Vec<&str> =
        messages().map(|(english, _)| english).filter(|english| !is_said(english)).collect();
    assert!(unused.is_empty(), "said nowhere, yet in src/report/messages.tsv: {unused:#?}");
}
