//! The table of messages: nothing that the lesson says in English is missing in it, and it has nothing that the
//! lesson does not say.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use plane_contact::output::page::INTERPRETER;
use plane_contact::paper::corrected::FAULTS;
use plane_contact::paper::listings::Which;
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::element::Plane;
use plane_contact::problem::scene::{SCENES, Scene};
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::findings::{FINDINGS, Finding, Repair};
use plane_contact::studies::audit::prices::price_tables::ORDER;
use plane_contact::studies::lesson::language::{messages, of_interpreter};
use plane_contact::studies::lesson::page::{ITERATE, LOWERED, meanings};
use plane_contact::studies::lesson::{Switch, chapter, switches};

/// The files of the lesson whose names end so.
fn texts(ending: &str) -> Vec<String> {
    let lesson = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/studies/lesson");
    let (mut folders, mut own) = (vec![lesson.join("page")], vec![lesson.join("page.rs")]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() { &mut folders } else { &mut own }.push(path);
        }
    }
    let own = own.iter().filter(|path| path.to_string_lossy().ends_with(ending));
    own.map(|path| std::fs::read_to_string(path).expect("UTF-8")).collect()
}

/// What code says: the text in every call such as `t("...")`.
fn in_calls(ending: &str, call: &str) -> BTreeSet<String> {
    let said = |text: &String| -> Vec<String> {
        let calls = text.match_indices(call);
        let calls = calls.filter(|(at, _)| !text[..*at].ends_with(|c: char| c.is_alphanumeric()));
        let rest = calls.map(|(at, _)| text[at + call.len()..].trim_start());
        let literals = rest.filter_map(|rest| rest.strip_prefix('"')?.split('"').next());
        literals.map(str::to_string).collect()
    };
    texts(ending).iter().flat_map(said).collect()
}

/// What the page's body says: between tags, and in attributes that are read.
fn in_body() -> BTreeSet<String> {
    let mut said = BTreeSet::new();
    for body in texts("body.html") {
        for piece in body.split('<') {
            let (tag, text) = piece.split_once('>').unwrap_or(("", piece));
            said.insert(text.split_whitespace().collect::<Vec<_>>().join(" "));
            for name in [" title=\"", " aria-label=\""] {
                let texts = tag.split(name).skip(1).filter_map(|rest| rest.split('"').next());
                said.extend(texts.map(str::to_string));
            }
        }
    }
    said.retain(|text| text.contains(char::is_alphabetic));
    // A name, and the other language in its own words.
    said.retain(|text| !["c_tll", "Русский"].contains(&text.as_str()));
    said
}

/// What the registers say: scenes, readings and other switches, findings, faults.
fn in_registers() -> BTreeSet<String> {
    let open = |name| Scene::open(name).expect("an embedded scene");
    let mut scenes: Vec<Scene> = SCENES.iter().map(|scene| open(scene.name)).collect();
    let mut plate = scenes[0].clone();
    Arc::make_mut(&mut plate.model).plane = Plane::Stress;
    scenes.push(plate);
    let edited = Switch::edited(Which::CCnt, Which::CCnt.under(&Reading::default()));
    let switches = scenes.iter().flat_map(switches).chain(FINDINGS.iter().flat_map(chapter));
    let switches = switches.chain([edited]).flat_map(of_switch);
    let names = FAULTS.iter().map(|fault| fault.name()).filter(|name| name.contains(' '));
    let faults = FAULTS.iter().map(|fault| fault.words()).chain(names);
    let titles =
        scenes.iter().map(|scene| scene.title.clone()).chain([ORDER.into(), LOWERED.into()]);
    let findings = FINDINGS.iter().flat_map(of_finding);
    let meanings = meanings().map(|[.., meaning]| meaning.to_string());
    let named = titles.chain(meanings);
    switches.chain(faults).chain(named).chain(findings).collect()
}

/// What a switch says but names, such as `R1 = inside` and `c_cnt 14`.
fn of_switch(switch: Switch) -> Vec<String> {
    let is_name = switch.name.contains(" = ");
    let about = switch.about.into_iter().map(str::to_string);
    let place = (switch.lines == "both").then(|| "both".to_string());
    about.chain(place).chain((!is_name).then_some(switch.name)).collect()
}

/// What a finding says, but for the interpreter's words.
fn of_finding(finding: &Finding) -> Vec<String> {
    let Finding { title, why, repair, .. } = *finding;
    let case = Case::new(finding.scene());
    let detail = finding.measure(&case).detail;
    let detail = (!detail.starts_with("c_cnt, line")).then_some(detail);
    let reason = match finding.edit {
        Repair::None { reason } => Some(reason),
        Repair::Edit { .. } => None,
    };
    let texts = [title, why, repair, &case.scene.title].into_iter().chain(reason);
    texts.map(str::to_string).chain(detail).collect()
}

#[test]
fn the_table_has_what_the_lesson_says_and_nothing_else() {
    let calls = [in_calls(".js", "t("), in_calls(".rs", "fill(")];
    let said = calls.into_iter().chain([in_body(), in_registers()]).flatten();
    let said: BTreeSet<String> = said.collect();
    let table: BTreeSet<String> = messages().map(|(english, _)| english.to_string()).collect();
    let missing: Vec<_> = said.difference(&table).collect();
    assert!(missing.is_empty(), "without Russian in src/studies/lesson/messages.tsv: {missing:#?}");
    let unused: Vec<_> = table.difference(&said).collect();
    assert!(
        unused.is_empty(),
        "in src/studies/lesson/messages.tsv, yet not of the lesson: {unused:#?}"
    );
}

#[test]
fn a_message_stands_once_and_has_the_values_of_its_english() {
    let mut seen = BTreeSet::new();
    for (english, russian) in messages().chain(of_interpreter()) {
        assert!(seen.insert(english), "twice: {english}");
        assert!(!russian.trim().is_empty(), "without Russian: {english}");
        let values = |text: &'static str| -> BTreeSet<&str> {
            let names = text.split('{').skip(1).filter_map(|rest| rest.split_once('}'));
            names.map(|(name, _)| name).collect()
        };
        assert_eq!(values(english), values(russian), "{english}");
    }
}

/// Every text between the values of the interpreter's sentences stands in its scripts, or in the mirror's failures.
#[test]
fn the_interpreter_says_the_sentences_of_its_table() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let failures =
        std::fs::read_to_string(root.join("src/paper/mirror/failure.rs")).expect("UTF-8");
    let scripts = [INTERPRETER.concat(), ITERATE.concat(), failures].concat().replace('\\', "");
    for (english, _) in of_interpreter() {
        let texts =
            english.split('{').map(|part| part.split_once('}').map_or(part, |(_, text)| text));
        let words = texts.map(|text| text.trim_matches(|c: char| !c.is_alphanumeric()));
        for text in words.filter(|text| text.len() > 3) {
            assert!(scripts.contains(text), "`{text}` of: {english}");
        }
    }
}
