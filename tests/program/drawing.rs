//! Pictures of meshes, fields and series, and what they are drawn with.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plane_contact::output::picture::{
    Axis, Contact, Drawing, MOST_SHAPES, Series, Style, chart, field, mesh,
};
use roxmltree::Document;

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
        held: Vec::new(),
        loaded: Vec::new(),
    }
}

fn touching(nodes: &[usize], edge: [usize; 2]) -> Drawing {
    let contact = Contact { nodes: nodes.to_vec(), edges: vec![edge] };
    Drawing { contact: Some(contact), ..square() }
}

fn stress(drawing: &Drawing, values: &[f64], displacement: &[[f64; 2]]) -> String {
    field(drawing, "stress", "MPa", values, displacement)
}

#[test]
fn what_holds_and_what_loads_a_mesh_is_drawn() {
    let drawn = |drawing: &Drawing| attributes(&mesh(drawing), "g", "stroke");
    let held = Drawing { held: vec![(0, [1.0, 0.0]), (0, [0.0, 1.0])], ..square() };
    let loaded = Drawing { loaded: vec![(2, [0.0, -5.0])], ..square() };
    assert!(texts(&mesh(&held)).contains("restraints (1 node)"));
    assert!(texts(&mesh(&loaded)).contains("loads (1 node)"));
    assert!(!texts(&mesh(&square())).contains("loads"));
    // The arrow ends at the node from above, and has room there.
    let heads = attributes(&mesh(&loaded), "polygon", "points");
    assert_eq!(heads.len(), 1 + attributes(&mesh(&square()), "polygon", "points").len());
    assert_eq!(drawn(&held).len(), drawn(&square()).len());
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
fn extreme_numbers() {
    for (unit, size) in [(1e300, 1e300), (1e300, 1e-300), (1e-300, 1e300), (1e-300, 1e-300)] {
        let points = SQUARE.map(|point| point.map(|x| x / 10.0 * unit)).to_vec();
        let drawing = Drawing { points, ..square() };
        let picture = stress(&drawing, &[-size, size], &[[size, size]; 4]);
        assert_eq!(attributes(&picture, "polygon", "fill"), ["#440154", "#fde725"]);
        let corners = attributes(&picture, "polygon", "points").join(" ");
        let places = corners.split([' ', ',']).map(|x| x.parse::<f64>().unwrap());
        assert!(places.into_iter().all(|x| (0.0..=1100.0).contains(&x)), "{corners}");
    }
}

#[test]
#[should_panic(expected = "finite numbers")]
fn infinite_value_is_refused() {
    stress(&square(), &[1.0, f64::INFINITY], &[[0.0; 2]; 4]);
}

fn drawn(logarithmic: bool, points: Vec<[f64; 2]>) -> String {
    let axis = |label| Axis { label, logarithmic };
    let series = [Series { name: "s".into(), points, style: Style::Line }];
    chart("t", [axis("x"), axis("y")], &series, &[])
}

#[test]
fn a_logarithmic_axis_leaves_out_what_it_cannot_show() {
    let text = drawn(true, vec![[1e-3, 1e-16], [10.0, 0.0]]);
    assert!(text.contains("10⁻³") && text.contains("10⁻¹⁶"), "{text}");
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}

/// A square of `side` by `side` squares of two triangles each; the block below, the stamp above.
fn grid(side: usize) -> Drawing {
    let at = |k: usize| 10.0 * k as f64 / side as f64;
    let squares = (0..side * side).map(|k| k + k / side);
    let triangles = squares.flat_map(|a| {
        let c = a + side + 2;
        [[a, a + 1, c], [a, c, c - 1]]
    });
    let triangles: Vec<_> = triangles.collect();
    Drawing {
        points: (0..=side).flat_map(|y| (0..=side).map(move |x| [at(x), at(y)])).collect(),
        region: (0..triangles.len()).map(|k| usize::from(2 * k >= triangles.len())).collect(),
        triangles,
        ..square()
    }
}

/// Reads the images of a picture: the width of each, and the colour of each pixel, None where clear.
fn images(picture: &str) -> Vec<(usize, Vec<Option<[u8; 3]>>)> {
    let read = |source: String| {
        let text = source.strip_prefix("data:image/png;base64,").unwrap();
        let bytes = std::io::Cursor::new(BASE64_STANDARD.decode(text).unwrap());
        let mut decoder = png::Decoder::new(bytes);
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let colour = |&[r, g, b, alpha]: &[u8; 4]| (alpha > 0).then_some([r, g, b]);
        (info.width as usize, pixels.as_chunks().0.iter().map(colour).collect())
    };
    attributes(picture, "image", "href").into_iter().map(read).collect()
}

/// The middle of the lower and of the upper half.
fn halves((width, pixels): &(usize, Vec<Option<[u8; 3]>>)) -> [Option<[u8; 3]>; 2] {
    let height = pixels.len() / width;
    [3, 1].map(|quarter| pixels[height * quarter / 4 * width + width / 2])
}

#[test]
fn up_to_the_limit_each_triangle_is_a_shape() {
    let drawing = grid(100);
    assert_eq!(drawing.triangles.len(), MOST_SHAPES);
    let picture = mesh(&drawing);
    assert_eq!(attributes(&picture, "path", "d").concat().matches('Z').count(), MOST_SHAPES);
    assert!(images(&picture).is_empty());
}

#[test]
fn a_fine_mesh_is_an_image_with_a_vector_outline() {
    let picture = mesh(&grid(400));
    assert!(!attributes(&picture, "path", "d").concat().contains('Z'));
    let images = images(&picture);
    assert_eq!(images.len(), 1);
    assert_eq!(halves(&images[0]), [Some([0x9c, 0xcb, 0x9a]), Some([0xf4, 0xd3, 0x5e])]);
    assert!(images[0].1.iter().all(Option::is_some), "no pixel between triangles is left out");
    let outline = attributes(&picture, "path", "d").concat();
    assert_eq!(outline.matches('M').count(), 4 * 400);
    assert!(texts(&picture).contains("block (160000 triangles)"));
    assert_eq!(picture, mesh(&grid(400)), "the same bytes each time");
}

#[test]
fn pixels_of_a_field_have_the_colours_of_the_bar() {
    let drawing = grid(150);
    let values: Vec<f64> = drawing.region.iter().map(|&region| region as f64).collect();
    let still = vec![[0.0; 2]; drawing.points.len()];
    let picture = stress(&drawing, &values, &still);
    let near = |at: Option<[u8; 3]>, expected: [u8; 3]| {
        at.unwrap().into_iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 3)
    };
    let [low, high] = halves(&images(&picture)[0]);
    assert!(near(low, [0x44, 0x01, 0x54]) && near(high, [0xfd, 0xe7, 0x25]), "{low:?} {high:?}");
    assert!(texts(&picture).contains("A fine mesh: each pixel has the colour"));
}

#[test]
fn a_picture_of_noise_is_below_two_megabytes() {
    let drawing = Drawing { contact: touching(&[5], [5, 6]).contact, ..grid(700) };
    let values: Vec<f64> =
        (0..drawing.triangles.len() as u64).map(|k| (k * k % 1009) as f64).collect();
    let still = vec![[0.0; 2]; drawing.points.len()];
    let size = stress(&drawing, &values, &still).len();
    assert!(size < 2_000_000, "{size}");
}
