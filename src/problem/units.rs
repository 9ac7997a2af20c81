//! The table of units: how large each is, by its name.

/// The units that are known, in m, Pa and N, and how they are shown. Others are named as unknown.
pub(crate) const LENGTHS: [(&str, f64); 9] = [
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
#[cfg(feature = "scenes")]
pub(crate) const SI: [(&str, f64); 4] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];
#[cfg(feature = "scenes")]
const STRESSES: [(&str, f64); 7] = [
    SI[0],
    SI[1],
    SI[2],
    SI[3],
    ("bar", 1e5),
    ("psi", POUND / (0.0254 * 0.0254)),
    ("ksi", 1000.0 * POUND / (0.0254 * 0.0254)),
];
#[cfg(feature = "scenes")]
pub(crate) const FORCES: [(&str, f64); 9] = [
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
#[cfg(feature = "scenes")]
const POUND: f64 = 4.4482216152605;

/// Returns the length of a unit in metres, by its name; None where it is not known.
pub fn length_in_metres(name: &str) -> Option<f64> {
    in_si(&LENGTHS, name)
}

/// Returns the size of a unit by its name, which may have capitals elsewhere where that leaves one: mN and MN
/// are two, MM and mpa are mm and MPa, but mPa and Mm, with m for milli and M for mega, are neither.
pub(crate) fn in_si(units: &[(&str, f64)], name: &str) -> Option<f64> {
    let exact = units.iter().find(|(known, _)| *known == name);
    let is_mixed = name != name.to_uppercase() && name != name.to_lowercase();
    let other_prefix = |known: &str| known.starts_with('m') != name.starts_with('m');
    let is_alike =
        |known: &str| known.eq_ignore_ascii_case(name) && !(is_mixed && other_prefix(known));
    let mut alike = units.iter().filter(|(known, _)| is_alike(known));
    let only = alike.next().filter(|_| alike.next().is_none());
    exact.or(only).map(|(_, size)| *size)
}

/// Returns the size of a unit of stress: one of its own, or a force per area, as N/mm², N/mm^2, kN/cm2 and
/// lbf/in**2.
#[cfg(feature = "scenes")]
pub(crate) fn stress_in_si(name: &str) -> Option<f64> {
    let plain = name.replace('²', "2").replace([' ', '^', '*', '(', ')'], "");
    let quotient = || {
        let (force, area) = plain.split_once('/')?;
        let length = in_si(&LENGTHS, area.strip_suffix('2')?)?;
        Some(in_si(&FORCES, force)? / (length * length))
    };
    in_si(&STRESSES, &plain).or_else(quotient)
}
