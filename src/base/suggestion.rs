//! The name that a mistyped one was meant to be.

/// How alike two names are that may be taken for each other: 1 is the same.
const ALIKE: f64 = 0.75;

/// Returns `did you mean "name"? ` with the known name that is most like `typed` and not the same;
/// nothing where none is alike.
pub fn did_you_mean<'a>(typed: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let others = known.into_iter().filter(|name| *name != typed);
    let typed = typed.to_lowercase();
    let alike = |name: &&str| strsim::jaro_winkler(&typed, &name.to_lowercase());
    let best = others.max_by(|a, b| alike(a).total_cmp(&alike(b)));
    let best = best.filter(|name| alike(name) >= ALIKE);
    best.map_or(String::new(), |name| format!("did you mean {name:?}? "))
}
