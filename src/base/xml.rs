//! XML, an element on each line.

use crate::plain::is_hidden;

/// An element of XML, written as far as it is known.
pub struct Element {
    name: &'static str,
    attributes: String,
    inside: Option<String>,
}

impl Element {
    /// Makes an element with nothing in it yet.
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: String::new(), inside: None }
    }

    /// Starts an element that contains `text` alone, which is escaped.
    pub fn with_text(name: &'static str, text: &str) -> Self {
        Self { inside: Some(escape(text)), ..Self::new(name) }
    }

    /// Returns the element with one more attribute, whose value is escaped.
    #[must_use]
    pub fn set(mut self, name: &str, value: impl AsRef<str>) -> Self {
        self.attributes.extend([" ", name, "=\"", &escape(value.as_ref()), "\""]);
        self
    }

    /// Returns the element with one more child.
    #[must_use]
    pub fn with(mut self, child: Element) -> Self {
        self.push(child);
        self
    }

    /// Returns the element with more children, in their order.
    #[must_use]
    pub fn with_all(mut self, children: impl IntoIterator<Item = Element>) -> Self {
        children.into_iter().for_each(|child| self.push(child));
        self
    }

    /// Adds a child behind those that are there.
    pub fn push(&mut self, child: Element) {
        child.write(self.inside.get_or_insert_with(|| "\n".into()));
    }

    /// Writes the whole document: the declaration, then this element.
    pub fn document(&self) -> String {
        String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") + &self.text()
    }

    /// Returns the element as it stands in a document.
    pub fn text(&self) -> String {
        let mut out = String::new();
        self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) {
        let Self { name, attributes, inside } = self;
        out.extend(["<", name, attributes]);
        match inside {
            None => out.push_str("/>\n"),
            Some(inside) => out.extend([">", inside, "</", name, ">\n"]),
        }
    }
}

/// Returns `text` for a place between tags or quotes. What XML 1.0 forbids becomes U+FFFD.
pub fn escape(text: &str) -> String {
    let is_plain = |byte: u8| matches!(byte, b' '..=b'~') && !b"&<>\"".contains(&byte);
    if text.bytes().all(is_plain) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(c),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if is_hidden(c) => out.push_str(&format!("&#{};", c as u32)),
            _ => out.push(c),
        }
    }
    out
}
