//! A worksheet's file: its settings and regions, with the results that Mathcad saved.

use roxmltree::{Document as Xml, Node, ParsingOptions};

use super::parentheses::Operand;
use super::read::{self, Math};
use super::{Unsupported, scan};
use crate::settings::Settings;
use crate::value::{Array, Grid, Value};
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
        _ => "what stands there does not follow the rules of XML".into(),
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
    let origin = find("builtInVariables", "array-origin").and_then(|origin| origin.parse().ok());
    Settings {
        origin: origin.unwrap_or(0),
        zero_over_zero_is_zero: find("calculationBehavior", "zero-over-zero") == Some("0"),
        exact_boolean: find("calculationBehavior", "exact-boolean") != Some("false"),
        ..Settings::default()
    }
}

/// Collects the regions below a node, those of areas in the area's place, from top to bottom and
/// from left to right.
fn collect(list: Node<'_, '_>, found: &mut Vec<Region>) {
    let is_region = |node: &Node<'_, '_>| node.tag_name().name() == "region";
    let mut placed: Vec<_> = list.children().filter(is_region).collect();
    placed.sort_by(|a, b| {
        let number = |node: &Node<'_, '_>, name: &str| node.attribute(name)?.parse::<f64>().ok();
        let top = |node| number(node, "align-y").or(number(node, "top")).unwrap_or(0.0);
        let left = |node| number(node, "left").unwrap_or(0.0);
        top(a).total_cmp(&top(b)).then(left(a).total_cmp(&left(b)))
    });
    for node in placed {
        match child(node, "area") {
            Some(area) if area.ancestors().count() < 64 => collect(area, found),
            _ => {
                found.push(region(node));
                // Text has regions of its own within its lines.
                let text = child(node, "text").into_iter().flat_map(|text| text.descendants());
                found.extend(text.filter(is_region).map(region));
            }
        }
    }
}

fn region(node: Node<'_, '_>) -> Region {
    let attribute = |name| node.attribute(name).unwrap_or_default().to_string();
    let (id, tag) = (attribute("region-id"), attribute("tag"));
    let Some(math) = child(node, "math") else {
        let others = ["plot", "component", "picture", "ole"];
        let content = match others.iter().find_map(|name| Some((name, child(node, name)?))) {
            Some((name, other)) => {
                let outputs = child(other, "outputs").map(|all| targets(Math::new(all).parts()));
                let construct =
                    if *name == "ole" { "an embedded object".into() } else { format!("a {name}") };
                Content::Unsupported { names: outputs.unwrap_or_default(), construct }
            }
            None => Content::Silent,
        };
        return Region { id, tag, content, saved: None };
    };
    let content = match math.children().find(Node::is_element).map(Math::new) {
        Some(shown) if math.attribute("disable-calc") != Some("true") => {
            // A definition whose result is shown, as `x := 3 =`, is the definition.
            let inside = shown.part(0).ok().filter(|part| shown.tag() == "eval" && part.defines());
            let inside = inside.unwrap_or(shown);
            let content = read::check_depth(math).and_then(|()| content(inside));
            content.unwrap_or_else(|Unsupported(construct)| {
                let names = targets(inside.parts().take(usize::from(inside.defines())));
                Content::Unsupported { names, construct }
            })
        }
        Some(_) | None => Content::Silent,
    };
    let find = |name: &str| math.descendants().find(|node| node.tag_name().name() == name);
    let saved = if let Some(error) = math.descendants().find_map(|node| node.attribute("error")) {
        Some(Saved::Error(error.into()))
    } else if let (Some(_), Some(unit)) = (find("result"), find("unitOverride")) {
        Some(Saved::Unsupported(read::shown_in(Math::new(unit))))
    } else {
        find("result").and_then(|result| result.children().find(Node::is_element)).map(|saved| {
            match read::check_depth(saved).and_then(|()| saved_value(Math::new(saved))) {
                Ok(value) => Saved::Value(value),
                Err(Unsupported(construct)) => Saved::Unsupported(construct),
            }
        })
    };
    Region { id, tag, content, saved }
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

fn content(node: Math<'_, '_>) -> Result<Content, Unsupported> {
    match node.tag() {
        "eval" => return node.part(0).and_then(read::expression).map(Content::Evaluation),
        "id" if node.text() == "Given" => return Err(Unsupported("a solve block".into())),
        "symEval" => return Err(read::unsupported(node)),
        _ if node.defines() => {}
        // An equation that nothing evaluates, such as a condition of a solve block.
        _ => return Ok(Content::Silent),
    }
    let (mut left, mut right) = (node.part(0)?, node.part(1)?);
    while let Some(inside) = left.inside() {
        left = inside;
    }
    let global = node.tag() == "globalDefine";
    if right.tag() == "eval" {
        right = right.part(0)?;
    }
    match left.tag() {
        "function" => {
            let name = read::name(left.part(0)?)?;
            let parameters = left.part(1)?.parts().map(read::name);
            let parameters = parameters.collect::<Result<Vec<_>, _>>()?.join(", ");
            let lines = read::lines(right, 1)?.join("\n");
            Ok(Content::Function { text: format!("{name}({parameters}) :=\n{lines}\n"), name })
        }
        "id" => {
            let name = read::name(left)?;
            if right.tag() == "range" {
                return Ok(Content::Range { name, range: read::range(right)? });
            }
            match saved_value(right) {
                // An array of numbers that are spelled out.
                Ok(value @ Value::Array(_)) if !global => Ok(Content::Table { name, value }),
                _ => {
                    let lines = read::lines(right, 0)?;
                    Ok(Content::Definition { name, entry: None, lines, global })
                }
            }
        }
        "apply" if left.part(0)?.tag() == "id" => {
            let function = left.part(0)?.text();
            let writes = function.starts_with("WRITE") || function.starts_with("APPEND");
            let what = if writes { "a file that is written" } else { "a definition of a call" };
            Err(Unsupported(format!("{what} ({function})")))
        }
        "apply" if right.tag() == "program" => {
            Err(Unsupported("a program that defines entries of an array".into()))
        }
        "apply" => {
            let (name, entry) = (read::name(left.part(1)?)?, Some(read::target(left)?));
            Ok(Content::Definition { name, entry, lines: read::lines(right, 0)?, global })
        }
        "matrix" if left.parts().all(|part| part.tag() == "id") => {
            let (names, cols) = read::entries(left)?;
            let names = names.into_iter().map(read::name).collect::<Result<Vec<_>, _>>()?;
            Ok(Content::Names { names, cols, lines: read::lines(right, 0)?, global })
        }
        "matrix" => Err(Unsupported("a definition of several entries at once".into())),
        _ => Err(read::unsupported(left)),
    }
}

fn saved_value(node: Math<'_, '_>) -> Result<Value, Unsupported> {
    match node.tag() {
        "real" => read::real(node.text()).map(Value::Number),
        "str" => Ok(Value::Text(node.text().into())),
        "matrix" if ["rows", "cols"].iter().any(|size| node.attribute(size) == Some("0")) => {
            Ok(Array::default().into())
        }
        "matrix" => {
            let (entries, cols) = read::entries(node)?;
            let entries = entries.into_iter().map(saved_value).collect::<Result<Vec<_>, _>>()?;
            Ok(Value::grid(Grid::from_rows(cols, entries)))
        }
        _ => Err(read::unsupported(node)),
    }
}
