//! Pictures as SVG: the mesh (the paper's fig. 4), a field on the deformed mesh (fig. 5), curves in a chart.
//!
//! | module          | what it holds                                |
//! |-----------------|----------------------------------------------|
//! | `bodies`      | what the mesh's panels and legend show       |
//! | `fields`      | what a field's panels and captions show      |
//! | `deformation` | the deformed mesh and its outline            |
//! | `chart`       | curves over one axis                         |
//! | `page`        | layout: title, panels, legend, captions      |
//! | `colour`      | values to colours, and the colour bar        |
//! | `view`        | the mesh's coordinates to pixels             |
//! | `numbers`     | round numbers and how numbers are written    |
//! | `svg`         | shapes, on top of the XML writer                    |

mod bodies;
mod chart;
mod colour;
mod deformation;
mod fields;
mod numbers;
mod page;
mod svg;
mod view;

pub use self::chart::{Axis, Series, Style, chart};

use self::bodies::{draw_bodies, legend};
use self::deformation::{deformed, magnification};
use self::fields::FieldPicture;
use self::page::{Page, Panels};
use self::view::Bounds;

/// Beside a contact zone that fills this part of the picture there is nothing to enlarge.
const ENLARGED_UP_TO: f64 = 0.8;

/// What every picture draws on. Points and triangles count from 0; all coordinates are finite.
pub struct Drawing<'a> {
    /// What is calculated.
    pub title: &'a str,
    /// x and y of each node, y upwards.
    pub points: &'a [[f64; 2]],
    /// The corners of each triangle, as indices of points.
    pub triangles: &'a [[usize; 3]],
    /// Per triangle: 0 = block (target), 1 = stamp, 2 and more = other bodies.
    pub region: &'a [usize],
    /// The name of each region.
    pub region_names: &'a [String],
    /// `""` for a scene that does not name it.
    pub length_unit: &'a str,
    /// Where the bodies may touch.
    pub contact: Option<Contact<'a>>,
}

/// The contact pair.
pub struct Contact<'a> {
    /// The nodes of the contact surface (the stamp's) in order, as indices of points.
    pub nodes: &'a [usize],
    /// The edges of the target surface (the block's), as pairs of indices of points.
    pub edges: &'a [[usize; 2]],
}

/// One value per triangle, and the displacement.
pub struct Field<'a> {
    /// Its name: "von Mises stress".
    pub quantity: &'a str,
    /// `""` for a scene that does not name it, `"1"` for a quantity without dimension.
    pub unit: &'a str,
    /// Per triangle; finite.
    pub values: &'a [f64],
    /// Per point; finite.
    pub displacement: &'a [[f64; 2]],
}

/// The mesh: its bodies, the contact nodes and the target edges.
pub fn mesh(drawing: &Drawing) -> String {
    let mut page = Page::new(drawing.title);
    page.panels(&panels(drawing, drawing.points), |view| draw_bodies(drawing, view));
    page.legend(&legend(drawing));
    page.finish()
}

/// A field on the deformed mesh, one flat colour per triangle.
///
/// # Panics
///
/// If there is not one value per triangle and one displacement per point, all finite.
pub fn field(drawing: &Drawing, field: &Field) -> String {
    check(drawing, field);
    let magnification = magnification(drawing.points, field.displacement);
    let deformed = deformed(drawing.points, field.displacement, magnification);
    let picture = FieldPicture::new(drawing, field, &deformed);
    let mut page = Page::new(&format!("{}: {}", drawing.title, field.quantity));
    page.panels(&panels(drawing, &deformed), |view| picture.draw(view));
    page.colour_bar(&picture.scale, field.quantity, field.unit);
    for words in picture.captions(magnification) {
        page.paragraph(&words);
    }
    page.finish()
}

/// What the panels show when the points are drawn at `drawn`; the points themselves stay in sight.
fn panels<'a>(drawing: &Drawing<'a>, drawn: &[[f64; 2]]) -> Panels<'a> {
    let whole = Bounds::of(drawing.points.iter().chain(drawn));
    let zone =
        drawing.contact.as_ref().and_then(|contact| contact_zone(drawing, contact, drawn, &whole));
    Panels {
        whole,
        part: zone.map(|zone| (zone, "contact zone")),
        length_unit: drawing.length_unit,
    }
}

/// The box of the contact surface with a margin, unless it is about as large as the whole.
fn contact_zone(
    drawing: &Drawing,
    contact: &Contact,
    drawn: &[[f64; 2]],
    whole: &Bounds,
) -> Option<Bounds> {
    if contact.nodes.is_empty() {
        return None;
    }
    let surface = contact.nodes.iter().flat_map(|&node| [&drawing.points[node], &drawn[node]]);
    let tight = Bounds::of(surface);
    let side = whole.larger_side();
    let zone = tight.padded(0.12 * tight.larger_side().max(0.1 * side));
    (zone.larger_side() < ENLARGED_UP_TO * side).then_some(zone)
}

fn check(drawing: &Drawing, field: &Field) {
    assert_eq!(field.values.len(), drawing.triangles.len(), "one value per triangle");
    assert_eq!(field.displacement.len(), drawing.points.len(), "one displacement per point");
    let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
    assert!(
        finite(field.values) && finite(field.displacement.as_flattened()),
        "a picture needs finite numbers"
    );
}

#[cfg(test)]
mod tests {
    use roxmltree::Document;

    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    const HALVES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    fn square<'a>(names: &'a [String]) -> Drawing<'a> {
        Drawing {
            title: "a < b & \"c\"",
            points: &SQUARE,
            triangles: &HALVES,
            region: &[0, 1],
            region_names: names,
            length_unit: "mm",
            contact: None,
        }
    }

    fn names() -> [String; 2] {
        ["block", "stamp"].map(String::from)
    }

    fn stress<'a>(values: &'a [f64], displacement: &'a [[f64; 2]]) -> Field<'a> {
        Field { quantity: "stress", unit: "MPa", values, displacement }
    }

    /// The attribute of every element of this name.
    fn attributes(picture: &str, element: &str, attribute: &str) -> Vec<String> {
        let document = Document::parse(picture).unwrap();
        let found = document.descendants().filter(|node| node.has_tag_name(element));
        found.filter_map(|node| node.attribute(attribute)).map(String::from).collect()
    }

    fn texts(picture: &str) -> String {
        let document = Document::parse(picture).unwrap();
        let found = document.descendants().filter(|node| node.has_tag_name("text"));
        found.filter_map(|node| node.text()).collect::<Vec<_>>().join("|")
    }

    #[test]
    fn mesh_has_a_polygon_per_triangle() {
        let picture = mesh(&square(&names()));
        assert_eq!(attributes(&picture, "polygon", "points").len(), 2);
        let words = texts(&picture);
        for expected in ["a < b & \"c\"", "block (1 triangle)", "stamp (1 triangle)", "2 mm"] {
            assert!(words.contains(expected), "{expected} in {words}");
        }
    }

    #[test]
    fn field_has_the_end_colours() {
        let picture = field(&square(&names()), &stress(&[1.0, 3.0], &[[0.0; 2]; 4]));
        assert_eq!(attributes(&picture, "polygon", "fill"), ["#440154", "#fde725"]);
        let words = texts(&picture);
        assert!(
            words.contains("Largest value 3 MPa at x\u{a0}=\u{a0}3.333, y\u{a0}=\u{a0}6.667 mm"),
            "{words}"
        );
        assert!(
            words.contains("smallest value 1 MPa at x\u{a0}=\u{a0}6.667, y\u{a0}=\u{a0}3.333 mm"),
            "{words}"
        );
        assert!(words.contains("Deformation × 1 "), "{words}");
    }

    #[test]
    fn equal_values_have_no_marker() {
        let picture = field(&square(&names()), &stress(&[2.0, 2.0], &[[0.0; 2]; 4]));
        assert!(attributes(&picture, "circle", "r").is_empty());
        assert!(texts(&picture).contains("The value is the same in every triangle: 2 MPa."));
    }

    #[test]
    fn stamp_is_drawn_over_the_block() {
        let names = names();
        let drawing = Drawing { region: &[1, 0], ..square(&names) };
        let picture = field(&drawing, &stress(&[1.0, 3.0], &[[0.0; 2]; 4]));
        assert_eq!(attributes(&picture, "polygon", "fill"), ["#fde725", "#440154"]);
    }

    #[test]
    fn contact_brings_an_enlargement() {
        let names = names();
        let contact = Contact { nodes: &[1], edges: &[[1, 2]] };
        let drawing = Drawing { contact: Some(contact), ..square(&names) };
        for picture in [mesh(&drawing), field(&drawing, &stress(&[1.0, 3.0], &[[0.0; 2]; 4]))] {
            assert_eq!(attributes(&picture, "clipPath", "id").len(), 1);
            assert!(texts(&picture).contains("b: contact zone, enlarged"));
        }
    }

    #[test]
    fn wide_contact_is_not_enlarged() {
        let names = names();
        let contact = Contact { nodes: &[0, 1], edges: &[[0, 1]] };
        let picture = mesh(&Drawing { contact: Some(contact), ..square(&names) });
        assert!(attributes(&picture, "clipPath", "id").is_empty());
        assert!(texts(&picture).contains("contact nodes (2)"));
    }

    #[test]
    fn extreme_numbers() {
        let names = names();
        for (unit, size) in [(1e300, 1e300), (1e300, 1e-300), (1e-300, 1e300), (1e-300, 1e-300)] {
            let points = SQUARE.map(|point| point.map(|x| x / 10.0 * unit));
            let drawing = Drawing { points: &points, ..square(&names) };
            let picture = field(&drawing, &stress(&[-size, size], &[[size, size]; 4]));
            assert_eq!(attributes(&picture, "polygon", "fill"), ["#440154", "#fde725"]);
            let corners = attributes(&picture, "polygon", "points").join(" ");
            let places = corners.split([' ', ',']).map(|x| x.parse::<f64>().unwrap());
            assert!(places.into_iter().all(|x| (0.0..=1100.0).contains(&x)), "{corners}");
        }
    }

    #[test]
    fn same_input_same_bytes() {
        let names = names();
        let displacement = [[0.1, 0.0], [0.0, 0.2], [0.0, 0.0], [0.0, 0.0]];
        let draw = || field(&square(&names), &stress(&[1.0, 3.0], &displacement));
        assert_eq!(draw(), draw());
        assert_eq!(mesh(&square(&names)), mesh(&square(&names)));
    }

    #[test]
    #[should_panic(expected = "finite numbers")]
    fn infinite_value_is_refused() {
        field(&square(&names()), &stress(&[1.0, f64::INFINITY], &[[0.0; 2]; 4]));
    }
}
