//! The units of length: how large each is, by its name.

/// The units of length that are known, in m. Others are named as unknown.
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
