//! Whether the units that a scene names fit each other. They are names: no number is converted.

use std::ops::RangeInclusive;

use super::Scene;
use super::description::{LoadKind, Units};
use crate::model::Material;
use crate::units::{LENGTHS, in_si};
use base::plain::six_digits;

/// The units of stress and of force that are known, in Pa and N.
const SI: [(&str, f64); 4] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];
const STRESSES: [(&str, f64); 7] = [
    SI[0],
    SI[1],
    SI[2],
    SI[3],
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

/// Returns the size of a unit of stress: one of its own, or a force per area, as N/mm², N/mm^2, kN/cm2 and
/// lbf/in**2.
fn stress_in_si(name: &str) -> Option<f64> {
    let plain = name.replace('²', "2").replace([' ', '^', '*', '(', ')'], "");
    let quotient = || {
        let (force, area) = plain.split_once('/')?;
        let length = in_si(&LENGTHS, area.strip_suffix('2')?)?;
        Some(in_si(&FORCES, force)? / (length * length))
    };
    in_si(&STRESSES, &plain).or_else(quotient)
}

/// Says that a stress times the square of a length is no force in the unit that the scene names, or which
/// unit is not known; None where it is, or the scene does not name all three.
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

/// Young's moduli of what bodies are made of, Pa: from soft rubber to diamond; and of what strains little.
const MODULI: RangeInclusive<f64> = 1e5..=1.3e12;
const STIFF: RangeInclusive<f64> = 1e9..=1.3e12;

/// The strain under a pressure that is no slip of units.
const STRAIN: f64 = 0.01;

impl Scene {
    /// Asks of moduli, and of pressures where the bodies are strained much, whether they are in another unit of stress
    /// than the scene's.
    pub fn doubtful_units(&self, is_strained: bool) -> Vec<String> {
        let (source, unit) = (&self.source.description, &self.units.stress);
        let Some(own) = stress_in_si(unit) else { return Vec::new() };
        let other = |what: String, is_likely: &dyn Fn(f64) -> bool| {
            let mut sizes = SI.iter().rev().filter(|(_, size)| *size != own);
            let (name, _) = sizes.find(|(_, size)| is_likely(*size))?;
            Some(format!("{what} {unit}: in {name}?"))
        };
        let usual = if is_strained { STIFF } else { MODULI };
        let moduli = source.materials.0.iter().filter(|(_, of)| !usual.contains(&(of.e * own)));
        let moduli = moduli.filter_map(|(group, Material { e, .. })| {
            let what = format!("E of {}, {}", group.text(), six_digits(*e));
            other(what, &|size| STIFF.contains(&(e * size)))
        });
        let least = source.materials.0.iter().map(|(_, of)| of.e * own).fold(f64::MAX, f64::min);
        let pressures = source.loads.iter().filter_map(|load| match load.kind {
            LoadKind::Pressure { pressure, .. }
                if is_strained && pressure * own > STRAIN * least =>
            {
                let what = format!("pressure {}", six_digits(pressure));
                other(what, &|size| size < own && pressure * size <= STRAIN * least)
            }
            LoadKind::Pressure { .. }
            | LoadKind::Traction { .. }
            | LoadKind::Force { .. }
            | LoadKind::Weight { .. } => None,
        });
        moduli.chain(pressures).collect()
    }
}
