//! Pages of HTML: each one file that opens offline, with nothing from outside.
//!
//! A page is a shell (title, style, script; its content policy names both by their hashes) and its data as
//! JSON, which the script shows by `textContent` alone: nothing that a scene or a listing says is ever read
//! as HTML. The script is the files of a folder one behind the other, in one scope.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;
use sha2::{Digest, Sha256};

use base::files::HTML;
use base::xml::escape;

/// The style and the script that all pages share.
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The script of tables that copy as CSV.
pub const TABLE: &str = include_str!("table.js");

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
pub struct Page<'a> {
    /// Its title.
    pub title: &'a str,
    /// The content of `body`.
    pub body: &'a str,
    /// Its own style.
    pub style: &'static str,
    /// Its own script, file by file.
    pub script: &'a [&'static str],
    /// What the script shows.
    pub data: Value,
}

impl Page<'_> {
    /// Returns the page as one file.
    pub fn html(self) -> String {
        let script = [&[SCRIPT], self.script].concat().join("\n");
        let script = format!("\n\"use strict\";\n{script}");
        let style = format!("\n{STYLE}{}", self.style);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{HTML}\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; form-action 'none'\">\n\
             <link rel=\"icon\" href=\"data:,\">\n\
             <title>{}</title>\n<style>{style}</style>\n</head>\n<body>\n{}\
             <script type=\"application/json\" id=\"data\">{}</script>\n\
             <script type=\"module\">{script}</script>\n</body>\n</html>\n",
            hash(&script),
            hash(&style),
            escape(self.title),
            self.body,
            // `</script>` or `<!--` in a text would end the place.
            self.data.to_string().replace('<', "\\u003c"),
        )
    }
}

/// Returns the source of a content policy that allows this script or style alone, by its hash (CSP level 3,
/// 2.3.1).
fn hash(text: &str) -> String {
    format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)))
}
