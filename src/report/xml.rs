//! XML, an element on each line.

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

    /// Makes an element that holds text.
    pub fn with_text(name: &'static str, text: &str) -> Self {
        Self { inside: Some(escape(text)), ..Self::new(name) }
    }

    /// Adds an attribute to the element.
    #[must_use]
    pub fn set(mut self, name: &str, value: impl AsRef<str>) -> Self {
        self.attributes.extend([" ", name, "=\"", &escape(value.as_ref()), "\""]);
        self
    }

    /// Adds an element inside this one.
    #[must_use]
    pub fn with(mut self, child: Element) -> Self {
        self.push(child);
        self
    }

    /// Adds elements inside this one.
    #[must_use]
    pub fn with_all(mut self, children: impl IntoIterator<Item = Element>) -> Self {
        children.into_iter().for_each(|child| self.push(child));
        self
    }

    /// Adds an element inside this one.
    pub fn push(&mut self, child: Element) {
        child.write(self.inside.get_or_insert_with(|| "\n".into()));
    }

    /// Writes the whole document: the declaration, then this element.
    pub fn document(&self) -> String {
        let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
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

/// Returns `text` for a place between tags or quotes. A character that XML 1.0 forbids becomes
/// U+FFFD.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(c),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_reads_back() {
        let text = "a < b & \"c\" > 'd' · 10⁻³";
        let written =
            Element::new("r").set("a", text).with(Element::with_text("t", text)).document();
        let read = roxmltree::Document::parse(&written).unwrap();
        assert_eq!(read.root_element().attribute("a"), Some(text));
        assert_eq!(read.root_element().first_element_child().unwrap().text(), Some(text));
    }

    #[test]
    fn forbidden_characters_are_replaced() {
        assert_eq!(escape("a\0b\u{1b}c\u{ffff}"), "a\u{fffd}b\u{fffd}c\u{fffd}");
    }
}
