//! A file rewritten so that it holds its mutants. Comments mark which mutant each piece of text
//! belongs to, `/*<12*/ … /*>*/`, and which place, `/*<@12*/ … /*>*/`: by them an error of the
//! compiler is traced to what it is about.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::mutant::Mutant;
use crate::sites::{Form, Site};

/// A file and what is in the build of it.
pub struct Page<'a> {
    pub text: &'a str,
    pub sites: &'a [Site],
    pub mutants: &'a [Mutant],
    /// The mutants that are left out.
    pub dead: &'a BTreeSet<usize>,
}

impl Page<'_> {
    pub fn render(&self) -> String {
        self.piece(0..self.text.len(), 0)
    }

    /// Returns a part of the file, with the sites in it from the one numbered `from`.
    fn piece(&self, part: Range<usize>, from: usize) -> String {
        let mut out = String::new();
        let mut at = part.start;
        for (k, site) in self.sites.iter().enumerate().skip(from) {
            let inside = site.range.start >= at && site.range.end <= part.end;
            if inside && self.live(site).next().is_some() {
                out += &self.text[at..site.range.start];
                out += &self.site(site, k + 1);
                at = site.range.end;
            }
        }
        out + &self.text[at..part.end]
    }

    fn live(&self, site: &Site) -> impl Iterator<Item = usize> {
        (site.first..site.first + site.count).filter(|id| !self.dead.contains(id))
    }

    /// Returns the text of a site, whose own inner sites begin at `next`.
    fn site(&self, site: &Site, next: usize) -> String {
        let piece = |range: &Range<usize>| self.piece(range.clone(), next);
        let op = &site.original;
        let text = match &site.form {
            Form::Body => " ".to_owned() + &self.choice(site, "()", |new| format!("return {new}")),
            Form::Iterator => {
                let original =
                    format!("crate::mutants::Items::Original({{ {} }})", piece(&site.range));
                self.choice(site, &original, |new| {
                    let items = format!("Iterator::collect::<Vec<_>>({new}).into_iter()");
                    format!("crate::mutants::Items::Mutant({items})")
                })
            }
            Form::Arithmetic(left, right) => {
                let choice =
                    self.choice(site, &format!("l__ {op} r__"), |new| format!("l__ {new} r__"));
                let (left, right) = (piece(left), piece(right));
                format!("(match ({left}, {right}) {{ (l__, r__) => {choice} }})")
            }
            Form::Comparison(left, right) => {
                let choice =
                    self.choice(site, &format!("*l__ {op} *r__"), |new| format!("*l__ {new} *r__"));
                let (left, right) = (piece(left), piece(right));
                format!("(match (&({left}), &({right})) {{ (l__, r__) => {choice} }})")
            }
            // `&&` ends early where its left side is false, its mutant where it is true.
            Form::Logical(left, right, is_and) => {
                let unlike = if *is_and { "==" } else { "!=" };
                let (left, right, on) = (piece(left), piece(right), self.is_on(site));
                let chosen = format!("if l__ {unlike} {on} {{ l__ }} else {{ {right} }}");
                format!("({{ let l__: bool = {left}; {chosen} }})")
            }
            Form::Assignment(left, right) => {
                let (left, right) = (piece(left), piece(right));
                let choice = self
                    .choice(site, &format!("{left} {op} r__"), |new| format!("{left} {new} r__"));
                format!("(match ({right}) {{ r__ => {choice} }})")
            }
            Form::Unary(operand) => {
                let choice = self.choice(site, &format!("{op}x__"), |_| "x__".to_owned());
                format!("(match ({}) {{ x__ => {choice} }})", piece(operand))
            }
            Form::Arm => format!(" if !{}", self.is_on(site)),
            Form::GuardedArm(true) => format!("!{} && {}", self.is_on(site), piece(&site.range)),
            Form::GuardedArm(false) => {
                format!("!{} && ({})", self.is_on(site), piece(&site.range))
            }
            Form::Guard => {
                let guard = piece(&site.range);
                format!("({})", self.choice(site, &guard, str::to_owned))
            }
            Form::Field { path, base, value, is_short } => {
                let field = &self.text[site.range.clone()];
                let name = if *is_short { field } else { field.split(':').next().unwrap_or("") };
                let other = format!("({path} {{ ..{} }}).{}", piece(base), name.trim());
                let choice = self.choice(site, &piece(value), |_| other.clone());
                format!("{name}: {choice}")
            }
        };
        format!("/*<@{}*/{text}/*>*/", site.first)
    }

    fn is_on(&self, site: &Site) -> String {
        format!("(crate::mutants::at({}) == 0)", site.first)
    }

    /// Returns the choice between what stands at a site and its mutants, made of each replacement.
    fn choice(&self, site: &Site, original: &str, made: impl Fn(&str) -> String) -> String {
        let (first, count) = (site.first, site.count);
        let mut pattern = format!("{count}..");
        let mut arms = String::new();
        for id in first..first + count {
            if self.dead.contains(&id) {
                pattern += &format!(" | {}", id - first);
            } else {
                let text = made(&self.mutants[id].replacement);
                arms += &format!(", {} => /*<{id}*/{text}/*>*/", id - first);
            }
        }
        format!("match crate::mutants::at({first}) {{ {pattern} => {original}{arms} }}")
    }
}

/// What a byte of a rewritten file belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    Mutant(usize),
    Site(usize),
}

/// Returns the innermost owner of the byte at `offset`.
pub fn owner(text: &str, offset: usize) -> Option<Owner> {
    let mut open = Vec::new();
    let mut at = 0;
    while let Some(next) = text[at..].find("/*").map(|n| at + n).filter(|n| *n <= offset) {
        at = next + 2;
        let rest = &text[at..];
        let number = |text: &str| text.split("*/").next().and_then(|n| n.parse().ok());
        if rest.starts_with(">*/") {
            open.pop();
        } else if let Some(id) = rest.strip_prefix("<@").and_then(number) {
            open.push(Owner::Site(id));
        } else if let Some(id) = rest.strip_prefix('<').and_then(number) {
            open.push(Owner::Mutant(id));
        }
    }
    open.pop()
}
