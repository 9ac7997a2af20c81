//! Pages of HTML: each one file that opens offline, with nothing from outside.
//!
//! A page is a shell (title, style, script) and its data as JSON, which the script shows by
//! `textContent` alone: nothing that a scene or a listing says is ever read as HTML. The script is
//! the files of a folder one behind the other, in one scope.

pub mod lesson;
pub mod report;

use serde_json::Value;

use crate::language::Language;
use base::xml::escape;

/// The style and the script that all pages share.
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The interpreter of the listings' notation that a page executes, which has the bits of `mathcad`: its
/// files, each using those above it.
pub const INTERPRETER: [&str; 6] = [
    include_str!("interpreter/values.js"),
    include_str!("interpreter/lexer.js"),
    include_str!("interpreter/parser.js"),
    include_str!("interpreter/arithmetic.js"),
    include_str!("interpreter/evaluator.js"),
    include_str!("interpreter/programs.js"),
];

/// A page's own parts.
struct Page<'a> {
    language: Language,
    title: &'a str,
    /// The content of `body`.
    body: &'a str,
    style: &'static str,
    script: &'a [&'static str],
    data: Value,
}

impl Page<'_> {
    fn html(mut self) -> String {
        let script = [&[SCRIPT], self.script].concat().join("\n");
        if let Some(messages) = self.language.messages_of(&script) {
            self.data["messages"] = messages;
        }
        format!(
            "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\">\n\
             <link rel=\"icon\" href=\"data:,\">\n\
             <title>{}</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n{}\
             <script type=\"application/json\" id=\"data\">{}</script>\n\
             <script type=\"module\">\n\"use strict\";\n{script}</script>\n</body>\n</html>\n",
            self.language,
            escape(self.title),
            self.style,
            self.body,
            in_script(&self.data),
        )
    }
}

/// Returns JSON for a place within `<script>`, which `</script>` or `<!--` in a text would end.
fn in_script(data: &Value) -> String {
    data.to_string().replace('<', "\\u003c")
}
