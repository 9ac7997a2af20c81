//! Whether the units that a scene names fit each other. They are names: no number is converted.

use super::description::Units;
use base::plain::six_digits;

/// The units that are known, in m, Pa and N, and how they are shown. Others are named as unknown.
const LENGTHS: [(&str, f64); 9] = [
    ("m", 1.0),
    ("km", 1e3),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("µm", 1e-6),
    ("in", 0.0254),
    ("inch", 0.0254),
    ("ft", 0.3048),
];
const STRESSES: [(&str, f64); 7] = [
    ("Pa", 1.0),
    ("kPa", 1e3),
    ("MPa", 1e6),
    ("GPa", 1e9),
    ("bar", 1e5),
    ("psi", POUND / (0.0254 * 0.0254)),
    ("ksi", 1000.0 * POUND / (0.0254 * 0.0254)),
];
const FORCES: [(&str, f64); 9] = [
    ("N", 1.0),
    ("mN", 1e-3),
    ("daN", 10.0),
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

/// Says that a stress times the square of a length is no force in the unit that the scene names, or which unit is not
/// known; None where it is, or the scene does not name all three.
pub fn misfit(units: &Units) -> Option<String> {
    let Units { length, stress, force } = units;
    if [length, stress, force].iter().any(|name| name.is_empty()) {
        return None;
    }
    let sizes = [in_si(&LENGTHS, length), stress_in_si(stress), in_si(&FORCES, force)];
    let [Some(in_length), Some(in_stress), Some(in_force)] = sizes else {
        let named = [("length", length), ("stress", stress), ("force", force)];
        let unknown = named.iter().zip(sizes).filter(|(_, size)| size.is_none());
        let unknown: Vec<String> =
            unknown.map(|((what, name), _)| format!("the {what} {name:?}")).collect();
        return Some(format!(
            "Whether the units fit each other is not checked, as it is not known what {} is; known are mm, MPa, N and \
             others, as kN/cm2, psi and lbf",
            unknown.join(" and ")
        ));
    };
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

/// Returns the length of a unit in metres, by its name; None where it is not known.
pub fn length_in_metres(name: &str) -> Option<f64> {
    in_si(&LENGTHS, name)
}

/// Returns the size of a unit by its name, which may have capitals elsewhere where that leaves one: mN and MN are two,
/// MM and mpa are mm and MPa, but mPa and Mm, with m for milli and M for mega, are neither.
fn in_si(units: &[(&str, f64)], name: &str) -> Option<f64> {
    let exact = units.iter().find(|(known, _)| *known == name);
    let is_mixed = name != name.to_uppercase() && name != name.to_lowercase();
    let other_prefix = |known: &str| known.starts_with('m') != name.starts_with('m');
    let is_alike =
        |known: &str| known.eq_ignore_ascii_case(name) && !(is_mixed && other_prefix(known));
    let mut alike = units.iter().filter(|(known, _)| is_alike(known));
    let only = alike.next().filter(|_| alike.next().is_none());
    exact.or(only).map(|(_, size)| *size)
}

/// Returns the size of a unit of stress: one of its own, or a force per area, as N/mm², N/mm^2, kN/cm2 and lbf/in**2.
fn stress_in_si(name: &str) -> Option<f64> {
    let plain = name.replace('²', "2").replace([' ', '^', '*', '(', ')'], "");
    let quotient = || {
        let (force, area) = plain.split_once('/')?;
        let length = in_si(&LENGTHS, area.strip_suffix('2')?)?;
        Some(in_si(&FORCES, force)? / (length * length))
    };
    in_si(&STRESSES, &plain).or_else(quotient)
}
