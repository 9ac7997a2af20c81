//! A field on the deformed mesh, and what is said under it.

use super::colour::{COLOURS, ColourScale, parts, with_unit};
use super::deformation::{boundary_edges, deformed, largest_displacement, magnification};
use super::drawing::{Drawing, Field};
use super::raster::{CAPTION, Raster};
use super::svg::{Coloured, Pixel, circle, group, path, polygon, segments};
use super::view::{Bounds, View};
use crate::numbers::{Decimal, significant};
use base::xml::Element;
use numbers::largest::{Largest, largest};

const OUTLINE: &str = "#111111";

const UNDEFORMED_OUTLINE: &str = "#b5b5b5";

pub struct FieldPicture<'a> {
    pub scale: ColourScale,
    /// The points of the mesh, displaced `magnification` times.
    pub deformed: Vec<[f64; 2]>,
    magnification: Decimal,
    drawing: &'a Drawing,
    field: &'a Field<'a>,
    boundary: Vec<[usize; 2]>,
    smallest: Largest,
    largest: Largest,
}

impl<'a> FieldPicture<'a> {
    /// Prepares a picture of `field`.
    pub fn new(drawing: &'a Drawing, field: &'a Field<'a>) -> Self {
        let [smallest, largest] = extremes(field.values);
        let scale = ColourScale::from_values(field.values);
        let magnification = magnification(&drawing.points, field.displacement);
        let deformed = deformed(&drawing.points, field.displacement, magnification);
        let boundary = boundary_edges(&drawing.triangles);
        Self { scale, deformed, magnification, drawing, field, boundary, smallest, largest }
    }

    /// Draws the content of a panel: triangles, outlines, the marker of the largest value.
    pub fn draw(&self, view: &View) -> Element {
        let [before, after] = [&self.drawing.points, &self.deformed].map(|points| view.all(points));
        let width = if view.enlarged { 1.6 } else { 1.1 };
        let largest = self.largest_of(&after);
        let fine = self.drawing.is_fine();
        let triangles = if fine { Self::raster } else { Self::triangles };
        group()
            .with(triangles(self, view, &after))
            .with_all((view.enlarged && !fine).then(|| self.grid(view, &after)))
            .with(segments(&self.boundary, &before).stroke(UNDEFORMED_OUTLINE, 0.8))
            .with(segments(&self.boundary, &after).stroke(OUTLINE, width))
            .with_all((!self.scale.is_uniform()).then(|| marker(largest)))
    }

    pub fn captions(&self) -> Vec<String> {
        let overlap = "Displacements are magnified, gaps are not: \
                       bodies that overlap here need not do so in the calculation.";
        let flat = "One flat colour per triangle: the value is constant within an element, \
                    and nothing is smoothed.";
        let touching = self.drawing.contact.is_some() && self.magnification != Decimal::ONE;
        [self.range_in_words(), self.deformation_in_words()]
            .into_iter()
            .chain(touching.then(|| overlap.into()))
            .chain([flat.into()])
            .chain(self.drawing.is_fine().then(|| CAPTION.into()))
            .collect()
    }

    /// Draws each triangle in its colour, also along its edges so that no white shows between two.
    fn triangles(&self, view: &View, pixels: &[Pixel]) -> Element {
        let shape = |(triangle, corners): (usize, [Pixel; 3])| {
            let colour = self.scale.colour(self.field.values[triangle]);
            polygon(&corners).fill(&colour).set("stroke", colour)
        };
        let group = group().set("stroke-width", "0.8").set("stroke-linejoin", "round");
        group.with_all(self.seen(view, pixels).map(shape))
    }

    /// Draws the triangles as pixels.
    fn raster(&self, view: &View, pixels: &[Pixel]) -> Element {
        let mut raster = Raster::new(view.frame);
        for (triangle, corners) in self.seen(view, pixels) {
            raster.triangle(corners, self.scale.part(self.field.values[triangle], COLOURS));
        }
        raster.image(&parts(COLOURS))
    }

    /// Returns the triangles that can be seen, with their corners; the stamp's after the block's.
    fn seen(&self, view: &View, pixels: &[Pixel]) -> impl Iterator<Item = (usize, [Pixel; 3])> {
        let mut order: Vec<_> = (0..self.drawing.triangles.len()).collect();
        order.sort_by_key(|&triangle| self.drawing.region[triangle]);
        let corners = |triangle: usize| {
            (triangle, self.drawing.triangles[triangle].map(|point| pixels[point]))
        };
        order.into_iter().map(corners).filter(|(_, corners)| view.shows(corners))
    }

    /// Draws the edges of the triangles, faint.
    fn grid(&self, view: &View, pixels: &[Pixel]) -> Element {
        let ring = |&[a, b, c]: &[usize; 3]| [a, b, c, a].map(|point| pixels[point]);
        let rings = self.drawing.triangles.iter().map(ring);
        let seen: Vec<_> = rings.filter(|ring| view.shows(ring)).collect();
        let grid = path(seen.iter().map(<[Pixel; 4]>::as_slice));
        grid.stroke("#000000", 0.5).set("stroke-opacity", "0.25")
    }

    fn range_in_words(&self) -> String {
        let value = |triangle: usize| self.field.values[triangle];
        let [smallest, largest] = [self.smallest, self.largest]
            .map(|one| self.scale.value_in_words(value(one.first), self.field.unit));
        if self.scale.is_uniform() {
            return format!("The value is the same in every triangle: {largest}.");
        }
        let points = &self.drawing.points;
        let [low, high] = [self.middle_of(self.smallest.first, points), self.largest_of(points)]
            .map(|place| self.place_in_words(place));
        // A largest value at a point is that of every triangle about it.
        let others_as_large = if self.field.largest_at.is_some() { 0 } else { self.largest.others };
        let [low_too, high_too] =
            [self.smallest.others, others_as_large].map(|others| match others {
                0 => String::new(),
                1 => " and in 1 other triangle".into(),
                _ => format!(" and in {others} other triangles"),
            });
        format!(
            "Largest value {largest} at {high} (red circle){high_too}; \
             smallest value {smallest} at {low}{low_too}."
        )
    }

    /// Returns where the largest value is, `points` being the places of the mesh's points.
    fn largest_of(&self, points: &[[f64; 2]]) -> [f64; 2] {
        let at = self.field.largest_at;
        at.map_or_else(|| self.middle_of(self.largest.first, points), |point| points[point])
    }

    fn middle_of(&self, triangle: usize, points: &[[f64; 2]]) -> [f64; 2] {
        middle(self.drawing.triangles[triangle].map(|point| points[point]))
    }

    /// Writes a place of the mesh before the deformation.
    fn place_in_words(&self, place: [f64; 2]) -> String {
        let round_off = Bounds::around(&self.drawing.points).larger_side() * 1e-6;
        let [x, y] = place.map(|x| significant(if x.abs() < round_off { 0.0 } else { x }, 4));
        // No-break spaces: a line must not end with the sign.
        format!("x\u{a0}=\u{a0}{x}, y\u{a0}=\u{a0}{}", with_unit(&y, &self.drawing.length_unit))
    }

    fn deformation_in_words(&self) -> String {
        let largest = significant(largest_displacement(self.field.displacement), 4);
        format!(
            "Deformation × {} (largest displacement {}). \
             Dark line: deformed outline; thin light line: undeformed outline.",
            significant(self.magnification.value(), 1),
            with_unit(&largest, &self.drawing.length_unit)
        )
    }
}

/// Draws a ring that stands out from any colour.
fn marker(at: Pixel) -> Element {
    let ring = |colour, width| circle(at, 7.0).fill("none").stroke(colour, width);
    group().with(ring("#ffffff", 4.5)).with(ring("#d4001a", 2.2))
}

/// Returns the triangles with the smallest and the largest value.
fn extremes(values: &[f64]) -> [Largest; 2] {
    let smallest = largest(values.iter().map(|x| -x));
    [smallest, largest(values.iter().copied())].map(|one| one.expect("at least one triangle"))
}

fn middle(corners: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|axis| corners.iter().map(|corner| corner[axis] / 3.0).sum())
}
