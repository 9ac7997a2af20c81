//! A tree of XML elements and its text.

/// An element with its attributes and what stands inside it.
#[derive(Clone, Debug)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    inside: Inside,
}

#[derive(Clone, Debug)]
enum Inside {
    Elements(Vec<Element>),
    Text(String),
}

impl Element {
    /// An element with nothing in it yet.
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), inside: Inside::Elements(Vec::new()) }
    }

    /// An element that holds text.
    pub fn with_text(name: &'static str, text: impl Into<String>) -> Self {
        Self { name, attributes: Vec::new(), inside: Inside::Text(text.into()) }
    }

    /// The element with one attribute more.
    #[must_use]
    pub fn set(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// The element with one more element inside.
    #[must_use]
    pub fn with(mut self, child: Element) -> Self {
        self.push(child);
        self
    }

    /// The element with more elements inside.
    #[must_use]
    pub fn with_all(mut self, children: impl IntoIterator<Item = Element>) -> Self {
        children.into_iter().for_each(|child| self.push(child));
        self
    }

    /// Puts one more element inside.
    ///
    /// # Panics
    ///
    /// If the element holds text: mixed content is not needed here.
    pub fn push(&mut self, child: Element) {
        match &mut self.inside {
            Inside::Elements(elements) => elements.push(child),
            Inside::Text(_) => panic!("<{}> holds text and can hold no element", self.name),
        }
    }

    /// The whole document: the declaration, then this element, one line per element.
    pub fn document(&self) -> String {
        let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) {
        self.write_start(out);
        match &self.inside {
            Inside::Elements(elements) if elements.is_empty() => {
                out.push_str("/>\n");
                return;
            }
            Inside::Elements(elements) => {
                out.push_str(">\n");
                elements.iter().for_each(|element| element.write(out));
            }
            Inside::Text(text) => {
                out.push('>');
                out.push_str(&escape(text));
            }
        }
        out.extend(["</", self.name, ">\n"]);
    }

    /// `<name a="b"`, without the closing bracket.
    fn write_start(&self, out: &mut String) {
        out.extend(["<", self.name]);
        for (name, value) in &self.attributes {
            out.extend([" ", name, "=\"", &escape(value), "\""]);
        }
    }
}

/// `text` for a place between tags or quotes. A character that XML 1.0 forbids becomes U+FFFD.
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
