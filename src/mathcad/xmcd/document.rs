//! A worksheet's file: its settings and regions, with the results that Mathcad saved.

use roxmltree::{Document as Xml, Node, ParsingOptions};

use super::parentheses::Operand;
use super::read::{self, Math};
use super::{Unsupported, scan};
use crate::settings::Settings;
use crate::value::{Grid, Value};
use base::error::{InputError, Result};
use base::files::{is_json, kind_of};

/// The most bytes of a file that is read: its regions become text and then trees.
pub const LARGEST: usize = 1 << 26;

/// The most regions, each of which may rest on all others; the largest of 266 public worksheets has
/// 631.
const REGIONS: usize = 5_000;

/// A worksheet as its file has it.
#[derive(Clone, Debug)]
pub struct Worksheet {
    /// The settings of the worksheet's calculation.
    pub settings: Settings,
    /// The regions in the order in which Mathcad evaluates them.
    pub regions: Vec<Region>,
}

/// A region of the worksheet.
#[derive(Clone, Debug)]
pub struct Region {
    /// Its identifier in the file.
    pub id: String,
    /// Its tag, which its author gave it; may be empty.
    pub tag: String,
    /// What it says.
    pub content: Content,
    /// What Mathcad saved of the region's evaluation.
    pub saved: Option<Saved>,
}

/// What a region says, in the text notation.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "what is said of each names its fields")]
pub enum Content {
    /// Nothing to execute: words, a page break, a region that is switched off.
    Silent,
    /// `name(parameters) :=` and a program.
    Function { name: String, text: String },
    /// `target := value`: the name, the target if it has subscripts, and the lines of the value, which
    /// may be a program.
    Definition { name: String, entry: Option<String>, lines: Vec<String>, global: bool },
    /// `(a   b) := value`: the names row by row, how many columns they stand in, and the lines of the
    /// value.
    Names { names: Vec<String>, cols: usize, lines: Vec<String>, global: bool },
    /// `name :=` an array of numbers.
    Table { name: String, value: Value },
    /// `name := from, second .. to`.
    Range { name: String, range: String },
    /// `expression =`.
    Evaluation(String),
    /// A construct that the interpreter does not have; the names that the region would define.
    Unsupported { names: Vec<String>, construct: String },
}

/// A result that Mathcad saved.
#[derive(Clone, Debug, PartialEq)]
pub enum Saved {
    /// A number, an array or a string.
    Value(Value),
    /// The words of the error.
    Error(String),
    /// A result that is no real number, array or string.
    Unsupported(String),
}

/// Refuses a file of another Mathcad by its first bytes: Prime's package, or what Mathcad 11 and older
/// ones saved.
///
/// # Errors
/// It is one of them.
pub fn check_kind(bytes: &[u8], place: &str) -> Result<()> {
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(prime(place));
    }
    if bytes.starts_with(b".MCAD") {
        let what = "this is a worksheet of Mathcad 11 or an older one (.mcd)";
        let fix = "open it in Mathcad 12 to 15, and save it as .xmcd";
        return Err(InputError::new(place, what, fix));
    }
    Ok(())
}

fn prime(place: &str) -> InputError {
    let what = "this is a worksheet of Mathcad Prime (.mcdx)";
    let fix = "Prime saves no .xmcd: give the .xmcd file from which it was converted, or write it anew in \
               Mathcad 15";
    InputError::new(place, what, fix)
}

/// Reads a worksheet.
///
/// # Errors
/// The text is no XML, or no worksheet of Mathcad 13 to 15.
pub fn read(text: &str, place: &str) -> Result<Worksheet> {
    let wrong = |what: String| {
        let fix = "give an .xmcd or .xmcdz file that Mathcad 13, 14 or 15 saved";
        InputError::new(place, what, fix)
    };
    if text.len() > LARGEST {
        return Err(wrong(format!(
            "the file has {} bytes, at most {LARGEST} are read",
            text.len()
        )));
    }
    scan::check(text).map_err(|why| wrong(format!("the file is refused: {why}")))?;
    let options = ParsingOptions { nodes_limit: 1 << 24, ..ParsingOptions::default() };
    let xml = Xml::parse_with_options(text.trim_start_matches('\u{feff}'), options)
        .map_err(|why| wrong(not_xml(text, &why)))?;
    let root = xml.root_element();
    if root.tag_name().name() != "worksheet" {
        return Err(wrong(format!("the file is no worksheet but <{}>", root.tag_name().name())));
    }
    // Its XML is that of the package; up to Mathcad 15 it is worksheet30 or less.
    if root.tag_name().namespace().is_some_and(|name| name.contains("worksheet5")) {
        return Err(prime(place));
    }
    let mut regions = Vec::new();
    if let Some(list) = child(root, "regions") {
        collect(list, &mut regions);
    }
    if regions.len() > REGIONS {
        return Err(wrong(format!("the file has more than {REGIONS} regions")));
    }
    Ok(Worksheet { settings: settings(root), regions })
}

/// Says why a text is no XML of a worksheet, in the words of neither the reader nor its grammar.
fn not_xml(text: &str, why: &roxmltree::Error) -> String {
    use roxmltree::Error;
    let is_xml = text.trim_start_matches('\u{feff}').trim_start().starts_with('<');
    let found = kind_of(text.as_bytes()).filter(|_| !is_xml);
    if let Some(found) = found.or(is_json(text.as_bytes()).then_some("JSON")) {
        return format!("this is {found}, not a worksheet");
    }
    if !is_xml {
        return "the file is no XML, and no worksheet: it does not begin with `<`".into();
    }
    let lines = text.lines().count();
    let what = match why {
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            return format!(
                "the worksheet is cut short: it ends in line {lines}, before its last element is closed"
            );
        }
        Error::UnexpectedCloseTag(expected, found, _) => {
            format!("</{found}> stands where </{expected}> is expected")
        }
        Error::NonXmlChar(c, _) => format!("XML has no character U+{:04X}", u32::from(*c)),
        Error::UnknownNamespace(name, _) => format!("the prefix {name:?} is not declared"),
        Error::UnknownEntityReference(name, _) => format!("the entity {name:?} is not declared"),
        Error::MalformedEntityReference(_) => "`&` begins no entity; a plain one is `&amp;`".into(),
        Error::DuplicatedAttribute(name, _) => format!("the attribute {name:?} is given twice"),
        Error::DuplicatedNamespace(name, _) => format!("the prefix {name:?} is declared twice"),
        Error::InvalidAttributeValue(_) => "`<` stands in the value of an attribute".into(),
        Error::InvalidComment(_) => "`--` stands in a comment".into(),
        Error::InvalidCharacterData(_) => "`]]>` stands in a text".into(),
        Error::UnexpectedDeclaration(_) => "an XML declaration stands behind the beginning".into(),
        Error::DtdDetected => return "the file has a DTD, which no worksheet has".into(),
        Error::NodesLimitReached
        | Error::AttributesLimitReached
        | Error::NamespacesLimitReached => return "the file has too many elements".into(),
        Error::InvalidXmlPrefixUri(_)
        | Error::UnexpectedXmlUri(_)
        | Error::UnexpectedXmlnsUri(_)
        | Error::InvalidElementNamePrefix(_)
        | Error::UnexpectedEntityCloseTag(_)
        | Error::EntityReferenceLoop(_)
        | Error::InvalidName(_)
        | Error::InvalidChar(..)
        | Error::InvalidChar2(..)
        | Error::InvalidString(..)
        | Error::InvalidExternalID(_)
        | Error::EntityResolver(..)
        | Error::UnknownToken(_) => "what stands there does not follow the rules of XML".into(),
    };
    let place = why.pos();
    format!("the file is no XML: line {}, column {}: {what}", place.row, place.col)
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.tag_name().name() == name)
}

fn settings(root: Node<'_, '_>) -> Settings {
    let find = |name: &str, attribute: &str| {
        let node = root.descendants().find(|node| node.tag_name().name() == name)?;
        node.attribute(attribute)
    };
    let plain = Settings::default();
    let origin = find("builtInVariables", "array-origin").and_then(|origin| origin.parse().ok());
    Settings {
        origin: origin.unwrap_or(0),
        zero_over_zero_is_zero: find("calculationBehavior", "zero-over-zero") == Some("0"),
        exact_boolean: find("calculationBehavior", "exact-boolean") != Some("false"),
        ..plain
    }
}

/// Collects the regions below a node, those of areas in the area's place, from top to bottom and
/// from left to right.
fn collect(list: Node<'_, '_>, found: &mut Vec<Region>) {
    let regions = list.children().filter(|node| node.tag_name().name() == "region");
    let mut placed: Vec<_> = regions.map(|node| (page_position(node), node)).collect();
    placed.sort_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for (_, node) in placed {
        match child(node, "area") {
            Some(area) if area.ancestors().count() < 64 => collect(area, found),
            _ => {
                found.push(region(node));
                // Text has regions of its own within its lines.
                let text = child(node, "text").into_iter().flat_map(|text| text.descendants());
                let within = text.filter(|node| node.tag_name().name() == "region");
                found.extend(within.map(region));
            }
        }
    }
}

fn page_position(node: Node<'_, '_>) -> (f64, f64) {
    let number = |name| node.attribute(name).and_then(|x| x.parse::<f64>().ok());
    (number("align-y").or(number("top")).unwrap_or(0.0), number("left").unwrap_or(0.0))
}

fn region(node: Node<'_, '_>) -> Region {
    let attribute = |name| node.attribute(name).unwrap_or_default().to_string();
    let (id, tag) = (attribute("region-id"), attribute("tag"));
    let Some(math) = child(node, "math") else {
        let construct = ["plot", "component", "picture", "ole"];
        let other = construct.into_iter().find_map(|name| child(node, name));
        let content = match other.map(|other| (other.tag_name().name(), other)) {
            Some((name, other)) => {
                let outputs = child(other, "outputs").map(Math::new);
                let words = match name {
                    "ole" => "an embedded object".into(),
                    name => format!("a {name}"),
                };
                unsupported(outputs.map(|all| targets(all.parts())).unwrap_or_default(), &words)
            }
            None => Content::Silent,
        };
        return Region { id, tag, content, saved: None };
    };
    let inside = math.children().find(Node::is_element).map(Math::new).map(shown_definition);
    let content = match inside {
        Some(_) if math.attribute("disable-calc") == Some("true") => Content::Silent,
        Some(inside) => match read::check_depth(math) {
            Ok(()) => content(inside),
            Err(Unsupported(construct)) => unsupported(names(inside), &construct),
        },
        None => Content::Silent,
    };
    let error = math.descendants().find_map(|node| node.attribute("error"));
    let result = math.descendants().find(|node| node.tag_name().name() == "result");
    let shown_in = math.descendants().find(|node| node.tag_name().name() == "unitOverride");
    let saved = match (error, result, shown_in) {
        (Some(error), ..) => Some(Saved::Error(error.into())),
        (None, Some(_), Some(unit)) => Some(Saved::Unsupported(read::shown_in(Math::new(unit)))),
        (None, Some(result), None) => result.children().find(Node::is_element).map(saved),
        (None, None, _) => None,
    };
    Region { id, tag, content, saved }
}

/// Returns the definition that a region shows the result of, as `x := 3 =`; else the region.
fn shown_definition<'a, 'i>(node: Math<'a, 'i>) -> Math<'a, 'i> {
    let first = node.part(0).ok().filter(|_| node.tag() == "eval");
    first.filter(|part| matches!(part.tag(), "define" | "globalDefine")).unwrap_or(node)
}

fn unsupported(names: Vec<String>, construct: &str) -> Content {
    Content::Unsupported { names, construct: construct.into() }
}

/// The names that a region defines, whatever it says of them.
fn names(node: Math<'_, '_>) -> Vec<String> {
    let defines = matches!(node.tag(), "define" | "globalDefine");
    targets(node.parts().take(usize::from(defines)))
}

/// The names that left sides define, in their order, whatever else stands in them.
fn targets<'a, 'i: 'a>(left: impl Iterator<Item = Math<'a, 'i>>) -> Vec<String> {
    let mut open: Vec<_> = left.collect();
    let mut names = Vec::new();
    while let Some(left) = open.pop() {
        match left.tag() {
            "id" => names.extend(read::name(left)),
            "function" => open.extend(left.parts().take(1)),
            // The array of an entry.
            "apply" => open.extend(left.parts().skip(1).take(1)),
            "parens" | "matrix" => open.extend(left.parts()),
            _ => {}
        }
    }
    names.reverse();
    names
}

fn content(node: Math<'_, '_>) -> Content {
    let content = match node.tag() {
        "define" | "globalDefine" => definition(node),
        "eval" => node.part(0).and_then(evaluation),
        "id" if node.text() == "Given" => Err(Unsupported("a solve block".into())),
        "symEval" => Err(read::unsupported(node)),
        // An equation that nothing evaluates, such as a condition of a solve block.
        _ => Ok(Content::Silent),
    };
    content.unwrap_or_else(|Unsupported(construct)| unsupported(names(node), &construct))
}

fn evaluation(node: Math<'_, '_>) -> Result<Content, Unsupported> {
    read::expression(node).map(Content::Evaluation)
}

fn definition(node: Math<'_, '_>) -> Result<Content, Unsupported> {
    let (mut left, mut right) = (node.part(0)?, node.part(1)?);
    while let Some(inside) = left.inside() {
        left = inside;
    }
    let global = node.tag() == "globalDefine";
    if right.tag() == "eval" {
        right = right.part(0)?;
    }
    let lines = |level| read::lines(right, level);
    match left.tag() {
        "function" => {
            let name = read::name(left.part(0)?)?;
            let parameters = left.part(1)?.parts().map(read::name);
            let parameters = parameters.collect::<Result<Vec<_>, _>>()?.join(", ");
            let text = format!("{name}({parameters}) :=\n{}\n", lines(1)?.join("\n"));
            Ok(Content::Function { name, text })
        }
        "id" => {
            let name = read::name(left)?;
            if right.tag() == "range" {
                return Ok(Content::Range { name, range: read::range(right)? });
            }
            if let Some(value) = table(right).filter(|_| !global) {
                return Ok(Content::Table { name, value });
            }
            Ok(Content::Definition { name, entry: None, lines: lines(0)?, global })
        }
        "apply" if left.part(0)?.tag() == "id" => {
            let function = left.part(0)?.text();
            Err(Unsupported(
                match function.starts_with("WRITE") || function.starts_with("APPEND") {
                    true => format!("a file that is written ({function})"),
                    false => format!("a definition of a call ({function})"),
                },
            ))
        }
        "apply" => {
            if right.tag() == "program" {
                return Err(Unsupported("a program that defines entries of an array".into()));
            }
            let name = read::name(left.part(1)?)?;
            let entry = Some(read::target(left)?);
            Ok(Content::Definition { name, entry, lines: lines(0)?, global })
        }
        "matrix" if left.parts().all(|part| part.tag() == "id") => {
            let size = |name| left.attribute(name).and_then(|n| n.parse::<usize>().ok());
            let names = left.parts().map(read::name).collect::<Result<Vec<_>, _>>()?;
            match (size("rows"), size("cols")) {
                (Some(rows), Some(cols))
                    if rows > 0 && rows.checked_mul(cols) == Some(names.len()) =>
                {
                    let places = (0..rows).flat_map(|i| (0..cols).map(move |j| j * rows + i));
                    let names = places.map(|k| names[k].clone()).collect();
                    Ok(Content::Names { names, cols, lines: lines(0)?, global })
                }
                _ => Err(Unsupported("a matrix that is not full".into())),
            }
        }
        "matrix" => Err(Unsupported("a definition of several entries at once".into())),
        _ => Err(read::unsupported(left)),
    }
}

/// Reads an array of numbers that are spelled out.
fn table(node: Math<'_, '_>) -> Option<Value> {
    saved_value(node).ok().filter(|value| matches!(value, Value::Array(_)))
}

fn saved(node: Node<'_, '_>) -> Saved {
    let depth = read::check_depth(node);
    match depth.and_then(|()| saved_value(Math::new(node))) {
        Ok(value) => Saved::Value(value),
        Err(Unsupported(construct)) => Saved::Unsupported(construct),
    }
}

fn saved_value(node: Math<'_, '_>) -> Result<Value, Unsupported> {
    match node.tag() {
        "real" => {
            let x = node.text().parse().ok().filter(|x: &f64| x.is_finite());
            x.map(Value::Number).ok_or_else(|| Unsupported(format!("the number {:?}", node.text())))
        }
        "str" => Ok(Value::Text(node.text().into())),
        "matrix" => {
            let size = |name| node.attribute(name).and_then(|n| n.parse::<usize>().ok());
            let entries =
                node.parts().map(saved_value).collect::<Result<Vec<Value>, Unsupported>>()?;
            match (size("rows"), size("cols")) {
                (Some(rows), Some(cols)) if rows.checked_mul(cols) == Some(entries.len()) => {
                    let grid = Grid::from_fn(rows, cols, |i, j| entries[j * rows + i].clone());
                    Ok(Value::grid(grid))
                }
                _ => Err(Unsupported("a matrix that is not full".into())),
            }
        }
        _ => Err(read::unsupported(node)),
    }
}
