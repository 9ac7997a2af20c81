//! From the mesh's coordinates (y upwards, any unit) to pixels (y downwards).

use super::svg::Pixel;
pub use problem::model::Bounds;

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
    /// Where it is drawn.
    pub frame: Frame,
    /// Pixels per unit of length.
    pub scale: f64,
    /// Whether it shows a part larger than the whole is shown.
    pub enlarged: bool,
    /// The point of the mesh in the middle of the frame, length.
    pub centre: [f64; 2],
}

impl View {
    /// Returns the view of the whole mesh, or of a part of it that is `enlarged`.
    pub fn new(bounds: &Bounds, frame: Frame, enlarged: bool) -> Self {
        let size = bounds.size();
        let scale = (frame.size[0] / size[0]).min(frame.size[1] / size[1]);
        Self { frame, scale, enlarged, centre: bounds.centre() }
    }

    /// Returns where a point of the mesh is drawn.
    pub fn pixel(&self, point: [f64; 2]) -> Pixel {
        let away = [0, 1].map(|axis| (point[axis] - self.centre[axis]) * self.scale);
        let middle = [0, 1].map(|axis| self.frame.corner[axis] + self.frame.size[axis] / 2.0);
        [middle[0] + away[0], middle[1] - away[1]]
    }

    /// Returns where each of `points` is drawn.
    pub fn all(&self, points: &[[f64; 2]]) -> Vec<Pixel> {
        points.iter().map(|&point| self.pixel(point)).collect()
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
