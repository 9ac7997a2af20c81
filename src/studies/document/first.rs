//! The first screen of a report as HTML: the parts of the audit's screen beside two pictures. An id links to its
//! place below and names its meaning; printed, a key names it.

use std::collections::BTreeSet;

use super::{Contents, Picture, pictures};
use crate::audit::claims::{CLAIMS, Claim, table as claims};
use crate::audit::conclusion::Conclusion;
use crate::audit::findings::FINDINGS;
use crate::audit::screen::{FAULTS, Faults, JUDGED, OURS, OfContact, RUNS, Screen, assumed_in};
use crate::audit::{Assumption, Audit};
use base::xml::escape;
use paper::mirror::READINGS;
use report::html::{anchor, prose};
use report::layout::counted;
use report::model::{Cell, Report, Table};

/// Returns the head of the page and its first screen.
pub fn html(contents: &Contents, menu: &str) -> String {
    let scene = contents.scene;
    let on = format!(" On scene {} ({})", scene.name, scene.title);
    let (title, parts) = match contents.audit {
        Some((audit, conclusion)) => {
            let on = on + &claims::under(&conclusion.reading) + ".";
            let judged = [JUDGED[0].to_string() + &on, JUDGED[1].to_string()];
            let judged = judged.map(|words| format!("<p>{}</p>", escape(&words))).concat();
            (PAPER.to_string() + &judged, audited(audit, conclusion, contents))
        }
        None => (format!("<h1>{}</h1>", escape(&runs_title(contents))), String::new()),
    };
    let pictures: String = pictures(contents).iter().map(Picture::html).collect();
    let again =
        format!("<p class=\"again\">Make it again: <code>{}</code></p>", escape(&contents.command));
    format!(
        "<header><div>{title}</div>{menu}</header>\n<section id=\"first\" aria-label=\"Verdict and evidence\">\n{parts}<div class=\"pictures\">{pictures}</div>\n\
         {again}</section>\n"
    )
}

/// Returns the title of a report without an audit.
pub fn runs_title(contents: &Contents) -> String {
    format!("Runs of scene {} ({})", contents.scene.name, contents.scene.title)
}

/// Who is judged.
const PAPER: &str = "<h1>Audit of A. M. Filipov, M. V. Khomenko, <cite lang=\"ru\">«Решение плоской контактной задачи методом \
    конечных элементов»</cite> (plane contact by the finite element method), <span lang=\"ru\">Инженерный вестник \
    Дона</span></h1>\n";

/// Returns the verdict and the tables.
fn audited(audit: &Audit, conclusion: &Conclusion, contents: &Contents) -> String {
    let Screen { verdict, contact } = Screen::new(audit, conclusion, contents.scene);
    let verdict = linked(&prose(&verdict.join(" ")));
    let verdict = format!("<div class=\"verdict\"><h2>Verdict</h2><p>{verdict}</p></div>\n");
    let Some(OfContact { runs, mesh_error, others: _, statements, faults, assumed }) = contact
    else {
        return verdict;
    };
    let statements = Report::default()
        .table(format!("The paper's {}", claims::counts()), statements)
        .line(OURS)
        .html();
    let others =
        faults.as_ref().map_or(String::new(), |faults| faults.others.as_flattened().join(" "));
    let faults = faults_table(faults).html();
    let assumed = assumed.iter().map(|Assumption { what, set_to }| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>", escape(what), escape(set_to))
    });
    let assumed: String = assumed.collect();
    let runs = Report::default().table(RUNS, runs).notes(mesh_error).html();
    format!(
        "{verdict}<div class=\"runs\">{}</div>\n<div class=\"statements\">{}</div>\n<div class=\"faults\">{}</div>\n{}\
         <div class=\"assumed\"><h2>{}</h2><dl>{assumed}</dl></div>\n",
        linked(&runs),
        linked(&statements),
        linked(&faults),
        key(&(statements.clone() + &others)),
        assumed_in(contents.scene),
    )
}

fn faults_table(faults: Result<Faults<'_>, String>) -> Report {
    match faults {
        Ok(Faults { dear, others }) => {
            let rows = dear.into_iter().map(|(cost, price)| {
                vec![
                    Cell::from(cost),
                    Cell::from(price.name.as_deref().unwrap_or("-")),
                    Cell::from(price.fault.clone()),
                ]
            });
            let others = others.into_iter().map(|row| row.map(Cell::from).to_vec());
            Report::default()
                .table(FAULTS, Table::new(["cost", "finding", "fault"], rows.chain(others)))
        }
        Err(why) => Report::default().table(FAULTS, Table::new(["cost"], [])).line(why),
    }
}

/// Returns what an id means, and the place of the page that says more; nothing of a word that is none.
fn meaning(word: &str) -> Option<(&'static str, String)> {
    let claim = CLAIMS.iter().find(|claim| claim.id == word).map(|claim| claim.judged);
    let finding = FINDINGS.iter().find(|finding| finding.id == word).map(|finding| finding.title);
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
    let claims = CLAIMS.iter().map(|Claim { id, judged, .. }| (*id, *judged));
    let ids = claims.chain(FINDINGS.iter().map(|finding| (finding.id, finding.title)));
    let ids = ids.filter(|(id, _)| words.contains(id));
    let items: String =
        ids.map(|(id, words)| format!("<li><b>{id}</b> {}</li>", escape(words))).collect();
    format!("<ul class=\"key\">{items}</ul>\n")
}

/// Returns the menu of a report's sections, and of the fields, which a script shows.
pub fn menu(parts: &Report) -> String {
    let link = |(place, words): (String, &str)| {
        format!("<li><a href=\"#{place}\">{}</a></li>", prose(words))
    };
    let sections: Vec<String> = parts.sections().map(link).collect();
    let count = counted(sections.len(), "part", "parts");
    format!(
        "<nav aria-label=\"Contents\"><details id=\"menu\"><summary>Contents <span class=\"muted\">{count}</span></summary><ul>{}\
         <li id=\"to-fields\" hidden><a href=\"#fields\">Fields of every run</a></li></ul></details></nav>",
        sections.concat()
    )
}
