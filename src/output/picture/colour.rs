//! Values to colours, and the colour bar.
//!
//! The map is Viridis: equal steps of the value look like equal steps, its lightness only rises, so
//! that it survives grey printing and colour blindness, and it draws no bands that are not in the
//! numbers. Rainbow maps (Turbo, and those of the commercial codes) are dark at both ends: in grey
//! the largest and the smallest value look the same.

use super::svg::{Anchor, Coloured, DARK, Pixel, group, line, rect, text};
use crate::numbers::{self, common_exponent, power_of_ten, shifted, significant, ticks};
use base::xml::Element;

/// A range below this part of the largest magnitude is round-off, not a difference.
const UNIFORM: f64 = 1e-9;

/// How many colours the pixels of a fine mesh have: as many as a PNG with 256 entries takes beside the
/// transparent one.
pub const COLOURS: u8 = 255;

/// How many colours a field has on a page: enough for the eye, and few enough for a small picture.
pub const SHADES: u8 = 64;

/// The height of the bar without its ticks, pixels.
const BAR_HEIGHT: f64 = 16.0;

/// How many strips of one colour make the bar.
const BAR_STEPS: u32 = 128;

/// The colours of a range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourScale {
    low: f64,
    high: f64,
}

impl ColourScale {
    /// The height that [`bar`](Self::bar) takes with its ticks, pixels.
    pub const HEIGHT: f64 = 42.0;

    /// Spans the colours from the smallest to the largest of finite `values`, at least one.
    pub fn from_values(values: &[f64]) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { low, high }
    }

    /// Returns whether all values are the same but for round-off; they then have one colour.
    pub fn is_uniform(&self) -> bool {
        self.high - self.low <= UNIFORM * self.largest()
    }

    /// Returns the colour of a value, as `#rrggbb`.
    pub fn colour(&self, value: f64) -> String {
        shade(self.fraction(value))
    }

    /// Returns in which of `count` equal parts of the range a value lies, from 0.
    pub fn part(&self, value: f64, count: u8) -> u8 {
        ((self.fraction(value) * f64::from(count)) as u8).min(count - 1)
    }

    /// Writes quantity and unit over the bar, with the power of ten that its numbers leave out.
    pub fn heading(&self, quantity: &str, unit: &str) -> String {
        let exponent = self.exponent();
        let power = if exponent == 0 { String::new() } else { power_of_ten(exponent) };
        let unit = match unit {
            "" => "unit of the scene",
            "1" => "",
            unit => unit,
        };
        numbers::quantity(quantity, format!("{power} {unit}").trim())
    }

    /// Writes a value with its unit, with the bar's power of ten where that makes a handy number.
    pub fn value_in_words(&self, value: f64, unit: &str) -> String {
        let handy = shifted(value, -self.exponent());
        if self.exponent() == 0 || handy.abs() < 1e-3 {
            return with_unit(&significant(value, 4), unit);
        }
        let power = power_of_ten(self.exponent());
        with_unit(&format!("{}·{power}", significant(handy, 4)), unit)
    }

    /// Draws the bar with its ticks, `width` pixels wide, from its upper left corner.
    pub fn bar(&self, [x, y]: Pixel, width: f64) -> Element {
        let mut bar = group();
        for step in 0..BAR_STEPS {
            let start = f64::from(step) / f64::from(BAR_STEPS);
            let middle = start + 0.5 / f64::from(BAR_STEPS);
            // Each strip reaches under the next: no seam between them.
            let reach = (2.0 / f64::from(BAR_STEPS)).min(1.0 - start);
            let strip = rect([x + start * width, y], [reach * width, BAR_HEIGHT]);
            bar.push(strip.fill(&shade(if self.is_uniform() { 0.5 } else { middle })));
        }
        let [low, high] = [self.low, self.high].map(|value| shifted(value, -self.exponent()));
        let ticks = match self.is_uniform() {
            true => vec![(0.5, significant(high, 4))],
            false => ticks(low, high)
                .into_iter()
                .map(|(value, label)| ((value - low) / (high - low), label))
                .collect(),
        };
        for (part, label) in ticks {
            let [x, y] = [x + part * width, y + BAR_HEIGHT];
            let mark = line([x, y - 5.0], [x, y + 5.0]).stroke(DARK, 1.0);
            bar.push(group().with(mark).with(text([x, y + 20.0], Anchor::Middle, &label)));
        }
        bar
    }

    /// Returns the power of ten that the bar's numbers leave out.
    fn exponent(&self) -> i32 {
        common_exponent(self.largest())
    }

    fn fraction(&self, value: f64) -> f64 {
        if self.is_uniform() { 0.5 } else { (value - self.low) / (self.high - self.low) }
    }

    fn largest(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }
}

/// Returns the colour in the middle of each of `count` equal parts of any range.
pub fn parts(count: u8) -> Vec<[u8; 3]> {
    let middle = |part| (f64::from(part) + 0.5) / f64::from(count);
    let colour = |part| colorous::VIRIDIS.eval_continuous(middle(part)).as_array();
    (0..count).map(colour).collect()
}

/// Writes a number with its unit, which may be `""` or `"1"`: then the number alone.
pub fn with_unit(number: &str, unit: &str) -> String {
    numbers::with_unit(number, if unit == "1" { "" } else { unit })
}

fn shade(fraction: f64) -> String {
    format!("#{:x}", colorous::VIRIDIS.eval_continuous(fraction.clamp(0.0, 1.0)))
}
