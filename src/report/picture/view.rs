//! From the mesh's coordinates (y upwards, any unit) to pixels (y downwards).

use super::svg::Pixel;

/// A box in the mesh's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    /// Returns the smallest box around `points`, at least one.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> Self {
        let nothing = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        points.into_iter().fold(nothing, |bounds, point| Self {
            low: [0, 1].map(|axis| bounds.low[axis].min(point[axis])),
            high: [0, 1].map(|axis| bounds.high[axis].max(point[axis])),
        })
    }

    /// Returns width and height.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    /// Returns the larger of width and height.
    pub fn larger_side(&self) -> f64 {
        let [width, height] = self.size();
        width.max(height)
    }

    /// Returns the middle of the box.
    pub fn centre(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.low[axis] + self.size()[axis] / 2.0)
    }

    /// Returns the box with `margin` more on each side.
    pub fn padded(&self, margin: f64) -> Self {
        Self { low: self.low.map(|x| x - margin), high: self.high.map(|x| x + margin) }
    }

    /// Returns the box grown about its centre until width : height is `ratio`.
    pub fn with_ratio(&self, ratio: f64) -> Self {
        let [width, height] = self.size();
        let size = [width.max(height * ratio), height.max(width / ratio)];
        let centre = self.centre();
        Self {
            low: [0, 1].map(|axis| centre[axis] - size[axis] / 2.0),
            high: [0, 1].map(|axis| centre[axis] + size[axis] / 2.0),
        }
    }
}

/// A rectangle of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The upper left corner, pixels.
    pub corner: Pixel,
    /// The width and the height, pixels.
    pub size: [f64; 2],
}

/// A box of the mesh in the middle of a frame, as large as it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The frame, a part of the picture.
    pub frame: Frame,
    /// Pixels per unit of length.
    pub scale: f64,
    /// Whether this is the enlargement beside the whole picture.
    pub enlarged: bool,
    /// The point of the mesh in the middle of the frame.
    pub centre: [f64; 2],
}

impl View {
    /// Shows the whole in a frame.
    pub fn whole(bounds: &Bounds, frame: Frame) -> Self {
        let size = bounds.size();
        let scale = (frame.size[0] / size[0]).min(frame.size[1] / size[1]);
        Self { frame, scale, enlarged: false, centre: bounds.centre() }
    }

    /// Shows a part in a frame.
    pub fn enlarged(bounds: &Bounds, frame: Frame) -> Self {
        Self { enlarged: true, ..Self::whole(bounds, frame) }
    }

    /// Returns where a point of the mesh is drawn.
    pub fn at(&self, point: [f64; 2]) -> Pixel {
        let away = [0, 1].map(|axis| (point[axis] - self.centre[axis]) * self.scale);
        let middle = [0, 1].map(|axis| self.frame.corner[axis] + self.frame.size[axis] / 2.0);
        [middle[0] + away[0], middle[1] - away[1]]
    }

    /// Returns where each of `points` is drawn.
    pub fn all(&self, points: &[[f64; 2]]) -> Vec<Pixel> {
        points.iter().map(|&point| self.at(point)).collect()
    }

    /// Returns whether a shape with these corners can be seen: whether its box overlaps the frame.
    pub fn shows(&self, corners: &[Pixel]) -> bool {
        [0, 1].into_iter().all(|axis| {
            let start = self.frame.corner[axis];
            let along = || corners.iter().map(|corner| corner[axis]);
            along().any(|x| x >= start) && along().any(|x| x <= start + self.frame.size[axis])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { corner: [100.0, 50.0], size: [200.0, 100.0] };

    #[test]
    fn view_keeps_the_shape_and_turns_y() {
        let view = View::whole(&Bounds::of(&[[0.0, 0.0], [10.0, 10.0]]), FRAME);
        assert_eq!(view.scale, 10.0);
        assert_eq!(view.at([0.0, 0.0]), [150.0, 150.0]);
        assert_eq!(view.at([10.0, 10.0]), [250.0, 50.0]);
    }

    #[test]
    fn flat_box_grows_to_the_ratio() {
        let grown = Bounds::of(&[[0.0, 3.0], [4.0, 3.0]]).with_ratio(2.0);
        assert_eq!([grown.low, grown.high], [[0.0, 2.0], [4.0, 4.0]]);
    }

    #[test]
    fn shows_what_overlaps() {
        let view = View::enlarged(&Bounds::of(&[[0.0, 0.0], [2.0, 1.0]]), FRAME);
        assert!(view.shows(&[[0.0, 60.0], [400.0, 70.0]]), "across");
        assert!(!view.shows(&[[0.0, 60.0], [99.0, 70.0]]), "left of it");
    }
}
