//! The first page of a report as HTML: the parts of the audit's first page beside two pictures. An id links
//! to its place below and names its meaning; printed, a key names it.

use std::collections::BTreeSet;

use super::{Contents, pictures};
use crate::audit::Audit;
use crate::audit::claims::{CLAIMS, Claim, claim_tables as claims};
use crate::audit::findings::{FINDINGS, Finding};
use crate::audit::words::{Depth, JUDGED, Section, sections};
use base::xml::escape;
use output::html::{anchor, figure, prose};
use output::layout::counted;
use output::model::Report;
use paper::mirror::READINGS;

/// Returns the head of the page and its first screen.
pub fn html(contents: &Contents, menu: &str) -> String {
    let scene = &contents.audit.scene;
    let under = claims::under(&contents.audit.conclusion.reading);
    let on = format!(" On scene {} ({}){under}.", scene.name, scene.title);
    let judged = format!("<p>{}</p>", escape(&(JUDGED.to_string() + &on)));
    let parts = audited(contents.audit);
    let pictures: String =
        pictures(contents).iter().map(|(title, svg)| figure(title, svg)).collect();
    let again =
        format!("<p class=\"again\">Make it again: <code>{}</code></p>", escape(&contents.command));
    format!(
        "<header><div>{PAPER}{judged}</div>{menu}</header>\n<section id=\"first\" aria-label=\"Verdict and evidence\">\n{parts}<div class=\"pictures\">{pictures}</div>\n\
         {again}</section>\n"
    )
}

/// Who is judged.
const PAPER: &str = "<h1>Audit of A. M. Filipov, M. V. Khomenko, <cite lang=\"ru\">«Решение плоской контактной задачи методом \
    конечных элементов»</cite> (plane contact by the finite element method), <span lang=\"ru\">Инженерный вестник \
    Дона</span></h1>\n";

/// Returns the parts of the audit's first page, each in a box, and the meanings of the ids that none of them
/// explains.
fn audited(audit: &Audit) -> String {
    let mut unexplained = String::new();
    let boxes =
        sections(audit, Depth::Screen).into_iter().map(|Section { name, heading, content }| {
            let heading = heading.map(|words| format!("<h2>{}</h2>", escape(words)));
            let content = content.html();
            if name == "claims" {
                unexplained += &content;
            }
            format!(
                "<div class=\"{name}\">{}{}</div>\n",
                heading.unwrap_or_default(),
                linked(&content)
            )
        });
    let boxes: String = boxes.collect();
    boxes + &key(&unexplained)
}

/// Returns what an id means, and the place of the page that says more; nothing of a word that is none.
fn meaning(word: &str) -> Option<(&'static str, String)> {
    let claim = word.parse().ok().map(|id| Claim::of(id).judged);
    let finding = word.parse().ok().map(|id| Finding::of(id).title);
    let reading =
        READINGS.iter().find(|row| row.id == word).map(|row| (row.what, "readings".into()));
    claim.or(finding).map(|words| (words, anchor(word))).or(reading)
}

/// Links the ids in the texts of HTML to their places, with their meanings.
fn linked(html: &str) -> String {
    let word = |word: &str| {
        let (id, rest) = word.split_at(word.trim_end_matches(is_apart).len());
        match meaning(id) {
            Some((words, place)) => {
                format!("<a href=\"#{place}\" title=\"{}\">{id}</a>{rest}", escape(words))
            }
            None => word.to_string(),
        }
    };
    let part = |part: &str| {
        let (text, tag) = part.split_at(part.find('<').unwrap_or(part.len()));
        text.split_inclusive(is_apart).map(word).collect::<String>() + tag
    };
    html.split_inclusive('>').map(part).collect()
}

fn is_apart(c: char) -> bool {
    !c.is_ascii_alphanumeric()
}

/// Returns the meanings of the ids in a text, which are shown in print.
fn key(html: &str) -> String {
    let words: BTreeSet<&str> = html.split(is_apart).collect();
    let claims = CLAIMS.iter().map(|Claim { id, judged, .. }| (id.name(), *judged));
    let ids = claims.chain(FINDINGS.iter().map(|finding| (finding.id.name(), finding.title)));
    let ids = ids.filter(|(id, _)| words.contains(id));
    let items: String =
        ids.map(|(id, words)| format!("<li><b>{id}</b> {}</li>", escape(words))).collect();
    format!("<ul class=\"key\">{items}</ul>\n")
}

/// Returns the menu of a report's sections.
pub fn menu(parts: &Report) -> String {
    let link = |(place, words): (String, &str)| {
        format!("<li><a href=\"#{place}\">{}</a></li>", prose(words))
    };
    let sections: Vec<String> = parts.sections().map(link).collect();
    let count = counted(sections.len(), "part", "parts");
    format!(
        "<nav aria-label=\"Contents\"><details id=\"menu\"><summary>Contents <span class=\"muted\">{count}</span></summary><ul>{}</ul></details></nav>",
        sections.concat()
    )
}
