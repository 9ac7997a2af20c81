//! A [`Reading`] by its names: `R2=printed,R5=node_n`.

use std::fmt;
use std::str::FromStr;

use super::ambiguity::{Change, DefaultFrom, Value};
use super::reading::{Ambiguity, READINGS, Reading, Schedule};
use problem::element::Plane;

impl Ambiguity {
    /// Returns the values but the one of `base`, which for R6 is by default the scene's and for R7 the
    /// variant's; each with `base` changed to it, where `--reading` offers it.
    pub fn others(
        &self,
        base: Reading,
        plane: Plane,
        schedule: Schedule,
    ) -> impl Iterator<Item = (&'static Value, Reading)> {
        let default = match self.default {
            DefaultFrom::First => self.values[0].name,
            DefaultFrom::Scene => plane.name(),
            DefaultFrom::Variant => schedule.name(),
        };
        let own = self.field.as_ref().and_then(|field| (field.get)(&base)).unwrap_or(default);
        self.values.iter().filter(move |value| value.name != own).map(move |value| {
            let mut reading = base;
            self.set(&mut reading, value);
            (value, reading)
        })
    }
}

impl Reading {
    /// Returns the values that differ from the default, each with its ambiguity, from R8 to R1: an
    /// edit of R1 moves lines that others rewrite, so it follows them.
    fn chosen(&self) -> impl Iterator<Item = (&'static Ambiguity, &'static Value)> {
        READINGS.iter().rev().filter_map(|row| {
            let name = (row.field.as_ref()?.get)(self)?;
            Some((row, row.values.iter().find(|value| value.name == name)?))
        })
    }

    /// Returns what the reading changes where the listings are executed as text, in the order in
    /// which it is to be applied.
    pub fn changes(&self) -> impl Iterator<Item = Change> {
        self.chosen().map(|(_, value)| value.change)
    }

    /// Returns the help of `--reading`.
    pub fn help() -> String {
        let mut help =
            "Readings of the print that differ from the default, such as R2=printed,R5=node_n.\n"
                .to_string();
        for row in READINGS.iter().filter(|row| row.is_option()) {
            let names: Vec<&str> = row.values.iter().map(|value| value.name).collect();
            let default = match row.default {
                DefaultFrom::First => "",
                DefaultFrom::Scene => " (default: the scene's)",
                DefaultFrom::Variant => " (default: the variant's)",
            };
            help += &format!("\n{} {}: {}{default}", row.id, names.join("|"), row.what);
        }
        help
    }

    fn set(&mut self, id: &str, value: &str) -> Result<(), String> {
        let offered = || {
            let offered = READINGS.iter().filter(|row| row.is_option()).map(|row| row.id);
            offered.collect::<Vec<_>>().join(", ")
        };
        let row = READINGS.iter().find(|row| row.id == id);
        let row = row.ok_or_else(|| format!("no such reading; there are {}", offered()))?;
        let field = row.field.as_ref().ok_or_else(|| {
            format!(
                "a reading of {}, which no run takes: audit tries its values; runs take {}",
                row.what,
                offered()
            )
        })?;
        (field.set)(self, value)
    }
}

impl FromStr for Reading {
    type Err = String;

    /// Reads a list such as `R2=printed,R5=node_n`; other readings keep their default.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut reading, mut named) = (Reading::default(), Vec::new());
        for item in text.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let (id, value) = item
                .split_once('=')
                .ok_or_else(|| format!("{item:?} is not of the form R2=printed"))?;
            if named.contains(&id.trim()) {
                return Err(format!("{} is given twice", id.trim()));
            }
            named.push(id.trim());
            reading.set(id.trim(), value.trim()).map_err(|why| format!("{id}: {why}"))?;
        }
        Ok(reading)
    }
}

impl fmt::Display for Reading {
    /// Writes the readings that differ from the default, as `R2=printed,R5=node_n`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut chosen: Vec<String> =
            self.chosen().map(|(row, value)| format!("{}={}", row.id, value.name)).collect();
        chosen.reverse();
        f.write_str(&chosen.join(","))
    }
}
