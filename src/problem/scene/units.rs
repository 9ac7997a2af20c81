//! Whether the units that a scene names fit each other. They are names: no number is converted.

use super::description::Units;
use base::plain::six_digits;

/// The units that are known, in m, Pa and N. A name that is not among them is not judged.
const LENGTHS: [(&str, f64); 8] = [
    ("m", 1.0),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("µm", 1e-6),
    ("in", 0.0254),
    ("inch", 0.0254),
    ("ft", 0.3048),
];
const STRESSES: [(&str, f64); 9] = [
    ("Pa", 1.0),
    ("kPa", 1e3),
    ("MPa", 1e6),
    ("N/mm²", 1e6),
    ("N/mm^2", 1e6),
    ("GPa", 1e9),
    ("bar", 1e5),
    ("psi", POUND / (0.0254 * 0.0254)),
    ("ksi", 1000.0 * POUND / (0.0254 * 0.0254)),
];
const FORCES: [(&str, f64); 8] = [
    ("N", 1.0),
    ("mN", 1e-3),
    ("kN", 1e3),
    ("MN", 1e6),
    ("lbf", POUND),
    ("lb", POUND),
    ("kip", 1000.0 * POUND),
    ("kgf", 9.80665),
];

/// A pound-force in N.
const POUND: f64 = 4.4482216152605;

/// How far two units may be apart that are one, over the larger.
const SAME: f64 = 1e-6;

impl Units {
    /// Returns whether a name is that of the scene's unit of length, or the scene names none.
    pub fn measure_lengths_in(&self, name: &str) -> bool {
        let own = &*self.length;
        let known = in_si(&LENGTHS, own).is_some_and(|size| in_si(&LENGTHS, name) == Some(size));
        own.is_empty() || own == name || known
    }
}

/// Says that a stress times the square of a length is no force in the unit that the scene names; None where it is, or
/// a unit is not known.
pub fn misfit(units: &Units) -> Option<String> {
    let Units { length, stress, force } = units;
    let [in_length, in_stress, in_force] =
        [in_si(&LENGTHS, length)?, in_si(&STRESSES, stress)?, in_si(&FORCES, force)?];
    let fits = in_stress * in_length * in_length;
    let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * a.max(b);
    let named = FORCES.iter().find(|(_, size)| is_same(*size, fits));
    let fix = named.map_or("units that fit".into(), |(name, _)| format!("\"force\": {name:?}"));
    (!is_same(in_force, fits)).then(|| {
        format!(
            "The units do not fit each other: {stress} times {length}² is {} {force}. No number is converted, so that \
             the scene's forces are taken, and all forces are shown, in that unit, though {force} is written beside \
             them: name {fix}, and give forces in it",
            six_digits(fits / in_force)
        )
    })
}

fn in_si(units: &[(&str, f64)], name: &str) -> Option<f64> {
    units.iter().find_map(|(known, size)| (*known == name).then_some(*size))
}
