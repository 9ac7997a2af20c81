//! Triangles as pixels: a mesh too fine for a shape per triangle, as an image inside the SVG.
//!
//! Two panels of bytes fill at most 1.4 million pixels, so that a picture stays below two megabytes
//! however little they can be compressed.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter};

use super::svg::{Pixel, image};
use super::view::Frame;
use base::xml::Element;

/// Pixels of the image for each of the page, along either axis.
const FINENESS: f64 = 1.5;

/// What is to be said of an image.
pub const CAPTION: &str =
    "A fine mesh: each pixel has the colour of the triangle at its middle, and edges are left out.";

/// Colours by number, the first at the upper left corner, row by row.
pub struct Raster {
    frame: Frame,
    size: [usize; 2],
    colours: Vec<u8>,
}

/// Quicker than the usual compression, for a file that is up to a half larger; and what a picture of few
/// pixels has, of which a page has several.
const QUICK: DeflateCompression = DeflateCompression::Level(1);
const SMALL: DeflateCompression = DeflateCompression::Level(9);

/// The most pixels of a picture that is made as small as it can be, in some 20 ms.
const FEW: usize = 1 << 18;

/// The number of no colour: the page shows.
const CLEAR: u8 = u8::MAX;

impl Raster {
    /// Makes a clear image that fills `frame`.
    pub fn new(frame: Frame) -> Self {
        let size = frame.size.map(|side| (side * FINENESS).ceil().max(1.0) as usize);
        Self { frame, size, colours: vec![CLEAR; size[0] * size[1]] }
    }

    /// Fills the pixels whose middle lies in the triangle with a colour, by its number. Triangles
    /// that share an edge leave no pixel between them.
    pub fn triangle(&mut self, corners: [Pixel; 3], colour: u8) {
        let (Frame { corner, size }, count) = (self.frame, self.size);
        let scale = [0, 1].map(|axis| count[axis] as f64 / size[axis]);
        let [a, b, c] =
            corners.map(|at| [0, 1].map(|axis| (at[axis] - corner[axis]) * scale[axis]));
        let low = a[1].min(b[1]).min(c[1]);
        let high = a[1].max(b[1]).max(c[1]);
        for row in middles(low, high, self.size[1]) {
            let y = row as f64 + 0.5;
            // Where the sides cross the row; the direction of a side makes no difference.
            let [mut from, mut to] = [f64::INFINITY, f64::NEG_INFINITY];
            for [a, b] in [[a, b], [b, c], [c, a]] {
                let [low, high] = if a[1] <= b[1] { [a, b] } else { [b, a] };
                if low[1] <= y && y < high[1] {
                    let x = low[0] + (y - low[1]) * ((high[0] - low[0]) / (high[1] - low[1]));
                    (from, to) = (from.min(x), to.max(x));
                }
            }
            let start = row * self.size[0];
            let columns = middles(from, to, self.size[0]);
            self.colours[start + columns.start..start + columns.end].fill(colour);
        }
    }

    /// Returns the image; colour number k is `palette[k]`, red, green and blue.
    ///
    /// # Panics
    ///
    /// If the palette has 256 colours or more, or lacks one that was drawn.
    pub fn image(&self, palette: &[[u8; 3]]) -> Element {
        let clear = u8::try_from(palette.len()).expect("at most 255 colours");
        // The clear one comes last, and is the only one that is not opaque.
        let number = |&colour: &u8| if colour == CLEAR { clear } else { colour };
        let numbers: Vec<u8> = self.colours.iter().map(number).collect();
        let [width, height] = self.size.map(|side| side as u32);
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, width, height);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_palette([palette.as_flattened(), &[255; 3]].concat());
        encoder.set_trns([vec![255; palette.len()], vec![0]].concat());
        encoder.set_filter(Filter::NoFilter);
        encoder.set_deflate_compression(if numbers.len() <= FEW { SMALL } else { QUICK });
        let mut writer = encoder.write_header().expect("memory takes any bytes");
        writer.write_image_data(&numbers).expect("a byte for each pixel");
        writer.finish().expect("memory takes any bytes");
        let source = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(file));
        image(self.frame.corner, self.frame.size, &source)
    }
}

/// Returns the pixels whose middles lie between two places, of those that there are.
fn middles(from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
    let first = |place: f64| ((place - 0.5).ceil() as usize).min(count);
    first(from)..first(to).max(first(from))
}

/// Returns red, green and blue of a colour written as `#rrggbb`.
pub fn rgb(colour: &str) -> [u8; 3] {
    let part = |at| u8::from_str_radix(&colour[at..at + 2], 16).expect("a colour as #rrggbb");
    [1, 3, 5].map(part)
}
