//! Pictures as SVG: the mesh (the paper's fig. 4), a field on the deformed mesh (fig. 5), charts.
//!
//! | module        | what it holds                                      |
//! |---------------|----------------------------------------------------|
//! | `drawing`     | what the pictures of a mesh draw on                |
//! | `bodies`      | what the mesh's panels and legend show             |
//! | `fields`      | what a field's panels and captions show            |
//! | `deformation` | the deformed mesh and its outline                  |
//! | `chart`       | curves over one axis                               |
//! | `page`        | layout: title, panels, legend, captions            |
//! | `colour`      | values to colours, and the colour bar              |
//! | `view`        | the mesh's coordinates to pixels                   |
//! | `svg`         | shapes, on top of the XML writer                   |

mod bodies;
mod chart;
mod colour;
mod deformation;
mod drawing;
mod fields;
mod page;
mod svg;
mod view;

pub use self::chart::{Axis, Series, Style, chart};
pub use self::drawing::{Contact, Drawing, Field};

use self::bodies::{draw_bodies, legend};
use self::fields::FieldPicture;
use self::page::Page;
use self::view::{Bounds, View};
use super::xml::Element;

/// A contact zone that fills this part of the picture is not enlarged beside it.
const ENLARGED_UP_TO: f64 = 0.8;

/// Draws the mesh: its bodies, the contact nodes and the target edges.
pub fn mesh(drawing: &Drawing) -> String {
    let mut page = Page::new(&drawing.title);
    put_panels(&mut page, drawing, &drawing.points, |view| draw_bodies(drawing, view));
    page.legend(&legend(drawing));
    page.finish()
}

/// Draws a field on the deformed mesh, one flat colour per triangle.
///
/// # Panics
///
/// If there is not one value per triangle and one displacement per point, all finite.
pub fn field(drawing: &Drawing, field: &Field) -> String {
    check(drawing, field);
    let picture = FieldPicture::new(drawing, field);
    let mut page = Page::new(&format!("{}: {}", drawing.title, field.quantity));
    put_panels(&mut page, drawing, &picture.deformed, |view| picture.draw(view));
    page.colour_bar(&picture.scale, field.quantity, field.unit);
    picture.captions().iter().for_each(|words| page.paragraph(words));
    page.finish()
}

/// Puts the panels of a mesh whose points are drawn at `drawn`; where they were stays in sight.
fn put_panels(
    page: &mut Page,
    drawing: &Drawing,
    drawn: &[[f64; 2]],
    draw: impl Fn(&View) -> Element,
) {
    let whole = Bounds::of(drawing.points.iter().chain(drawn));
    let contact = drawing.contact.as_ref().filter(|contact| !contact.nodes.is_empty());
    let zone = contact.map(|contact| {
        let nodes = contact.nodes.iter();
        let tight = Bounds::of(nodes.flat_map(|&node| [&drawing.points[node], &drawn[node]]));
        tight.padded(0.12 * tight.larger_side().max(0.1 * whole.larger_side()))
    });
    let zone = zone.filter(|zone| zone.larger_side() < ENLARGED_UP_TO * whole.larger_side());
    page.panels(&whole, zone.as_ref(), &drawing.length_unit, draw);
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

    fn square() -> Drawing {
        Drawing {
            title: "a < b & \"c\"".into(),
            points: SQUARE.to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            region: vec![0, 1],
            region_names: ["block", "stamp"].map(String::from).to_vec(),
            length_unit: "mm".into(),
            contact: None,
        }
    }

    fn touching(nodes: &[usize], edge: [usize; 2]) -> Drawing {
        let contact = Contact { nodes: nodes.to_vec(), edges: vec![edge] };
        Drawing { contact: Some(contact), ..square() }
    }

    fn stress<'a>(values: &'a [f64], displacement: &'a [[f64; 2]]) -> Field<'a> {
        Field { quantity: "stress", unit: "MPa", values, displacement }
    }

    /// Returns an attribute of every element of this name.
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
        let picture = mesh(&square());
        assert_eq!(attributes(&picture, "polygon", "points").len(), 2);
        let words = texts(&picture);
        for expected in ["a < b & \"c\"", "block (1 triangle)", "stamp (1 triangle)", "2 mm"] {
            assert!(words.contains(expected), "{expected} in {words}");
        }
    }

    #[test]
    fn field_has_the_end_colours() {
        let picture = field(&square(), &stress(&[1.0, 3.0], &[[0.0; 2]; 4]));
        assert_eq!(attributes(&picture, "polygon", "fill"), ["#440154", "#fde725"]);
        let words = texts(&picture);
        for expected in [
            "Largest value 3 MPa at x\u{a0}=\u{a0}3.333, y\u{a0}=\u{a0}6.667 mm",
            "smallest value 1 MPa at x\u{a0}=\u{a0}6.667, y\u{a0}=\u{a0}3.333 mm",
            "Deformation × 1 ",
        ] {
            assert!(words.contains(expected), "{expected} in {words}");
        }
    }

    #[test]
    fn equal_values_have_no_marker() {
        let picture = field(&square(), &stress(&[2.0, 2.0], &[[0.0; 2]; 4]));
        assert!(attributes(&picture, "circle", "r").is_empty());
        assert!(texts(&picture).contains("The value is the same in every triangle: 2 MPa."));
    }

    #[test]
    fn stamp_is_drawn_over_the_block() {
        let drawing = Drawing { region: vec![1, 0], ..square() };
        let picture = field(&drawing, &stress(&[1.0, 3.0], &[[0.0; 2]; 4]));
        assert_eq!(attributes(&picture, "polygon", "fill"), ["#fde725", "#440154"]);
    }

    #[test]
    fn contact_brings_an_enlargement() {
        let drawing = touching(&[1], [1, 2]);
        for picture in [mesh(&drawing), field(&drawing, &stress(&[1.0, 3.0], &[[0.0; 2]; 4]))] {
            assert_eq!(attributes(&picture, "clipPath", "id").len(), 1);
            assert!(texts(&picture).contains("b: contact zone, enlarged"));
        }
    }

    #[test]
    fn wide_contact_is_not_enlarged() {
        let picture = mesh(&touching(&[0, 1], [0, 1]));
        assert!(attributes(&picture, "clipPath", "id").is_empty());
        assert!(texts(&picture).contains("contact nodes (2)"));
    }

    #[test]
    fn extreme_numbers() {
        for (unit, size) in [(1e300, 1e300), (1e300, 1e-300), (1e-300, 1e300), (1e-300, 1e-300)] {
            let points = SQUARE.map(|point| point.map(|x| x / 10.0 * unit)).to_vec();
            let drawing = Drawing { points, ..square() };
            let picture = field(&drawing, &stress(&[-size, size], &[[size, size]; 4]));
            assert_eq!(attributes(&picture, "polygon", "fill"), ["#440154", "#fde725"]);
            let corners = attributes(&picture, "polygon", "points").join(" ");
            let places = corners.split([' ', ',']).map(|x| x.parse::<f64>().unwrap());
            assert!(places.into_iter().all(|x| (0.0..=1100.0).contains(&x)), "{corners}");
        }
    }

    #[test]
    #[should_panic(expected = "finite numbers")]
    fn infinite_value_is_refused() {
        field(&square(), &stress(&[1.0, f64::INFINITY], &[[0.0; 2]; 4]));
    }
}
