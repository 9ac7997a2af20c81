//! Boxes with sides along the axes.

/// A box with sides along the axes: its lowest and its highest coordinates, length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest x and y, length.
    pub low: [f64; 2],
    /// The largest x and y, length.
    pub high: [f64; 2],
}

impl Bounds {
    /// Returns the smallest box around `points`, at least one.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> Self {
        let nothing = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        points.into_iter().fold(nothing, |bounds, point| Self {
            low: [0, 1].map(|axis| bounds.low[axis].min(point[axis])),
            high: [0, 1].map(|axis| bounds.high[axis].max(point[axis])),
        })
    }

    /// Returns width and height, length.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    /// Returns the larger of width and height, length.
    pub fn larger_side(&self) -> f64 {
        let [width, height] = self.size();
        width.max(height)
    }

    /// Returns its centre, length.
    pub fn centre(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.low[axis] + self.size()[axis] / 2.0)
    }

    /// Returns the box with `margin` more on each side.
    pub fn padded(&self, margin: f64) -> Self {
        Self { low: self.low.map(|x| x - margin), high: self.high.map(|x| x + margin) }
    }

    /// Returns whether the two have a point in common.
    pub fn meets(&self, other: Bounds) -> bool {
        (0..2).all(|d| self.low[d] <= other.high[d] && other.low[d] <= self.high[d])
    }

    /// Returns whether a point lies in it or on its border.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }
}
