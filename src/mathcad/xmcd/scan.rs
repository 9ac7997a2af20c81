//! What the XML reader would need too long for, found before it reads.

/// The attributes of an element at most: the reader compares each with all others. A worksheet has
/// none of 50.
const ATTRIBUTES: usize = 64;
/// The declarations of namespaces at most that an element stands under: the reader copies them for
/// each element that has one of its own. A worksheet has 10.
const NAMESPACES: usize = 64;

/// Checks what every element has.
///
/// # Errors
/// The first element that has too many attributes, or stands under too many namespaces.
pub fn check(xml: &str) -> Result<(), String> {
    let mut open: Vec<usize> = vec![];
    let mut namespaces = 0;
    let mut rest = xml;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let no_element = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = no_element.iter().find(|(start, _)| rest.starts_with(start)) {
            rest = rest.find(end).map_or("", |at| &rest[at..]);
            continue;
        }
        let (attributes, declared, length) = counts(rest);
        let line = || 1 + xml[..xml.len() - rest.len()].matches('\n').count();
        if attributes > ATTRIBUTES {
            let line = line();
            return Err(format!("line {line} has an element of more than {ATTRIBUTES} attributes"));
        }
        let tag = &rest[..length];
        if tag.starts_with("</") {
            namespaces -= open.pop().unwrap_or(0);
        } else if !tag.ends_with("/>") {
            open.push(declared);
            namespaces += declared;
        }
        if namespaces > NAMESPACES {
            let line = line();
            return Err(format!("line {line} stands under more than {NAMESPACES} namespaces"));
        }
        rest = &rest[length..];
    }
    Ok(())
}

/// Returns how many attributes the tag at the start has, how many of them declare namespaces, and
/// how many bytes it takes.
fn counts(tag: &str) -> (usize, usize, usize) {
    let (mut attributes, mut declared, mut quote) = (0, 0, None);
    for (at, byte) in tag.bytes().enumerate() {
        match (quote, byte) {
            (Some(open), byte) if byte == open => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (None, b'x') if tag[at..].starts_with("xmlns") => declared += 1,
            (None, b'>') => return (attributes, declared, at + 1),
            _ => {}
        }
    }
    (attributes, declared, tag.len())
}
