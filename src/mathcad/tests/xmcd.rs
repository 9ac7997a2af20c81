//! The second notation: listings to XMCD and back, worksheets executed, hostile files.

use super::{limits::words, one_of, worksheet};
use fastrand::Rng;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use mathcad::worksheet::{Agreement, ExecutedRegion, execute};
use mathcad::xmcd::document::{self, Content};
use mathcad::xmcd::write;
use mathcad::{Array, Cause, Limits, Listing, Settings, Sheet, Value};

/// Writes a listing as a worksheet, and reads it back as text.
pub fn there_and_back(listing: &Listing) -> Result<String, String> {
    let sheet = worksheet(std::slice::from_ref(listing));
    let sheet = document::read(&sheet, "sheet").map_err(|error| error.to_string())?;
    match &sheet.regions[0].content {
        Content::Function { text, .. } => Ok(text.clone()),
        Content::Definition { name, entry: None, lines, .. } => {
            Ok(format!("{name}() :=\n  {}\n", lines.join("\n  ")))
        }
        other => Err(format!("{other:?}")),
    }
}

#[test]
fn parentheses_stand_where_each_notation_needs_them() {
    for body in [
        "(a + b) / (c − d)",
        "(a·b) / c",
        "((a + b)) / (x)",
        "((a / b)) · (c + 1)",
        "a^(b + 1) + a^−1 + a^b + (a + b)^2 + (−2)^2",
        "a^((b + 1))",
        "a^(−b) + a^−b",
        "(A[1])ᵀ + A[1,2]ᵀ + (Aᵀ)[1,2] + (Aᵀ)⟨1⟩",
        "−(a + b)·c − −2",
        "¬(a > 0) ∧ (b = 1 ∨ c ≠ 2) ∨ a ≤ b",
        "(1 2; 3 4) · (a   −b)ᵀ",
        "∑(i ∈ 1 .. 3, i^2) + ∏(i ∈ 1 .. 2, A[i]) + √(a) + √(3,a)",
        "trace(\"{0}\",a·b) + φ.12",
        "1E-09 + 0.1 + 1.2345678901234568E+20",
        "(a;) + ((a;) b)",
        "×(a,b)·→(a·b) + ∑(i ∈ i, A[i])",
        "2·{x ← 1; for i ∈ 1 .. 3 {x ← 2·x; x ← 1 if x > 3}; try {1 / x} {0}}",
        "{b if a > 0; otherwise {1}} + ({while a > b {a ← 1}})",
        "(b c) ← (a 1)",
        "A⟨1⟩ ← A⟨2⟩ if a > 1",
    ] {
        let text = format!("f(a, A) :=\n  {body}\n");
        let listing = Listing::parse("f", &text).unwrap();
        assert_eq!(there_and_back(&listing), Ok(text));
    }
}

#[test]
fn numbers_are_spelled_as_mathcad_saves_them() {
    let pairs = [
        (1.2246063538223773e-16, "1.2246063538223773E-16"),
        (-6.608847361681053e-7, "-6.6088473616810534E-07"),
        (0.00005, "5E-05"),
        (0.0125, "0.0125"),
        (300.0, "300"),
        (0.1 + 0.2, "0.30000000000000004"),
        (1.0115481183896306e100, "1.0115481183896306E+100"),
        (0.0, "0"),
    ];
    for (x, text) in pairs {
        assert_eq!(write::number(x), text);
        assert_eq!(text.parse(), Ok(x));
    }
}

/// Any program that the text notation reads means the same once it has been a worksheet; what
/// comes back is as short as it gets.
#[test]
fn any_program_comes_back() {
    let mut rng = Rng::with_seed(2026);
    for _ in 0..1_000 {
        if let Ok(listing) = Listing::parse("f", &format!("f(x) :=\n  {}", words(&mut rng))) {
            let once = there_and_back(&listing).unwrap();
            // Parentheses that Mathcad needs may lead beyond the depth that is read.
            if let Ok(again) = Listing::parse("f", &once) {
                assert_eq!(there_and_back(&again), Ok(once));
                assert_eq!(run(&again), run(&listing));
            }
        }
    }
}

/// A worksheet with bytes changed, parts left out or repeated is read or refused; what is read
/// is executed within its limits.
#[test]
fn damaged_worksheets_end() {
    let mut rng = Rng::with_seed(2026);
    let plain = "f(x) :=\n  y ← 0\n  for i ∈ 1 .. rows(v)\n    y ← y + v[i] if v[i] > 1\n  y";
    for _ in 0..1_000 {
        let listing = Listing::parse("f", &format!("f(x) :=\n  {}", words(&mut rng)));
        let listing = listing.unwrap_or_else(|_| Listing::parse("f", plain).unwrap());
        let mut text = worksheet(&[listing]);
        for _ in 0..rng.usize(1..6) {
            let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
            let (start, length) = (one_of(&mut rng, &places), rng.usize(..60));
            let end = places.iter().copied().find(|p| *p >= start + length).unwrap_or(start);
            let part = text[start..end].to_string();
            match rng.u8(..4) {
                0 => text.replace_range(start..end, ""),
                1 => text.insert_str(start, &part),
                2 => text = text.replacen("<ml:id", "<ml:program", 1 + length % 3),
                _ => text = text.replacen("1", "999999999", 1 + length % 3),
            }
        }
        if let Ok(sheet) = document::read(&text, "sheet") {
            execute(&sheet, &Limits { steps: 10_000, entries: 10_000, ..Limits::default() });
        }
    }
}

/// The value of a program, or the kind of its failure, with little to spend.
fn run(listing: &Listing) -> Result<String, std::mem::Discriminant<Cause>> {
    let limits = Limits { steps: 10_000, entries: 10_000, ..Limits::default() };
    let mut worksheet = Sheet::empty();
    worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
    let outcome =
        listing.runner(&worksheet, &Settings::default(), &limits).call(&[Value::Number(5.0)]);
    let kind = outcome.map_err(|failure| std::mem::discriminant(&failure.cause));
    kind.map(|outcome| outcome.value.to_string())
}

#[test]
fn what_is_no_worksheet_is_refused() {
    for text in ["", "<", "<html/>", "<!DOCTYPE a [<!ENTITY b \"c\">]><worksheet>&b;</worksheet>"] {
        assert!(document::read(text, "sheet").is_err(), "{text}");
    }
    let deep = format!(
        "<worksheet><regions><region><math><define><id>a</id>{}1{}</define></math></region></regions>\
         </worksheet>",
        "<parens>".repeat(5_000),
        "</parens>".repeat(5_000)
    );
    let checked = document::read(&deep, "deep").map(|s| execute(&s, &Limits::default()));
    let refused = |c: &[ExecutedRegion]| {
        c.iter().all(|c| matches!(c.agreement, Agreement::Unsupported { .. }))
    };
    assert!(checked.is_err() || checked.is_ok_and(|checked| refused(&checked)));
}

/// Collects the worksheets below a folder.
fn worksheets(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.extension() {
            _ if path.is_dir() => worksheets(&path, found),
            Some(extension) if extension == "xmcd" => found.push(path),
            _ => {}
        }
    }
}

/// How many results came out how of the twenty worksheets that the source distribution of PyPI `xmcd` 0.4.0
/// (MIT) has, which Mathcad 14.1.5 calculated and saved. `XMCD_SOURCE` names its folder; `.ci/run` gets it.
/// Without it nothing is compared.
#[test]
fn mathcad_s_own_worksheets() {
    let Some(source) = std::env::var_os("XMCD_SOURCE").map(PathBuf::from) else {
        return eprintln!("XMCD_SOURCE is not set: the worksheets of PyPI xmcd are not executed");
    };
    let mut files = vec![];
    worksheets(&source.join("tests").join("fixtures"), &mut files);
    assert_eq!(files.len(), 20);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a worksheet");
        let sheet = document::read(&text, "worksheet").expect("a worksheet");
        for region in execute(&sheet, &Limits::default()) {
            let kind = match region.agreement {
                Agreement::NothingSaved => continue,
                Agreement::Same => "same",
                Agreement::Digits { .. } => "digits",
                Agreement::SameFailure { .. } => "failure",
                Agreement::Differs { .. } | Agreement::Fails { .. } => {
                    panic!("{}, {}: {:?}", file.display(), region.id, region.agreement)
                }
                Agreement::Unsupported { .. } => "unsupported",
            };
            *counts.entry(kind).or_default() += 1;
        }
    }
    println!("{counts:?}");
    assert_eq!([counts["same"], counts["digits"], counts["failure"]], [84, 6, 6]);
}
