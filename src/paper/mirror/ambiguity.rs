//! A row of the table of readings ([`READINGS`]), and a [`Reading`] by its names.

use std::fmt;
use std::str::FromStr;

use super::reading::{READINGS, Reading, Schedule};
use mathcad::Settings;
use problem::element::Plane;

/// Declares the values of a reading: name, words, and the edit of the text, a file in
/// `listings/readings/`, where it is one.
macro_rules! values {
    ($(#[$doc:meta])* $type:ident {
        $($variant:ident = $name:literal, $words:literal $(, edit $file:literal)?;)+
    }) => {
        choices! { $(#[$doc])* $type { $(#[doc = $words] $variant = $name),+ } }

        impl $type {
            const VALUES: &[Value] = &[$(Value::new($name, $words, values!(change $($file)?))),+];
        }
    };
    (change) => { Change::None };
    (change $file:literal) => {
        Change::Text(include_str!(concat!("../listings/readings/", $file)))
    };
}
pub(super) use values;

/// Something that the print leaves open: a row of [`READINGS`].
pub struct Ambiguity {
    /// `R1`, `R2`, ...
    pub id: &'static str,
    /// The listing and its printed lines; `-` where nothing of it is printed.
    pub lines: &'static str,
    /// What is open.
    pub what: &'static str,
    /// The values; the first is the default where no scene and no variant sets one.
    pub values: &'static [Value],
    /// Where the default comes from.
    pub default: DefaultFrom,
    /// Why this is the default.
    pub why: &'static str,
    /// The value that `audit` tries beside the default.
    pub trial: Trial,
    /// Its field of a [`Reading`]; nothing where `--reading` does not offer it.
    pub(super) field: Option<Field>,
}

/// A value of an ambiguity.
pub struct Value {
    /// Its name, as in `R5=node_n`.
    pub name: &'static str,
    /// What it means.
    pub words: &'static str,
    /// How the text of the listing changes.
    pub change: Change,
}

impl Value {
    pub(super) const fn new(name: &'static str, words: &'static str, change: Change) -> Self {
        Value { name, words, change }
    }
}

/// What a value changes where the listings are executed as text.
#[derive(Clone, Copy)]
pub enum Change {
    /// Nothing.
    None,
    /// The text of a listing: an edit.
    Text(&'static str),
    /// The settings of the worksheet.
    Settings(fn(&mut Settings)),
}

impl Change {
    /// Changes the settings of a worksheet.
    pub fn set(self, settings: &mut Settings) {
        match self {
            Change::Settings(set) => set(settings),
            Change::Text(_) | Change::None => (),
        }
    }
}

/// What sets the value of an ambiguity where no reading does.
pub enum DefaultFrom {
    /// The table: the first of the values.
    First,
    /// The scene, by its `plane`.
    Scene,
    /// The variant.
    Variant,
}

/// What `audit` runs to see what another value changes.
#[derive(Clone, Copy)]
pub enum Trial {
    /// `c_cnt` and `Km` at the initial shape, and the scene's variant of the paper.
    OwnVariant,
    /// The same and `printed`, the variant that solves with `Km` of the contact pairs.
    Printed,
    /// `c_cnt` at every shape of the scene's variant of the paper: the value can only make it fail,
    /// or leave everything as it is.
    EveryShape,
    /// The listings as text, once at the initial shape.
    Worksheet,
    /// The strains at the end of the scene's variant of the paper.
    Strains,
}

/// How a field of a [`Reading`] is read and written by name.
pub(super) struct Field {
    /// The name of its value; nothing for the default.
    pub(super) get: fn(&Reading) -> Option<&'static str>,
    pub(super) set: fn(&mut Reading, &str) -> Result<(), String>,
}

macro_rules! field {
    ($field:ident) => {
        Some($crate::mirror::ambiguity::Field {
            get: |reading| {
                let own = reading.$field;
                (own != Reading::default().$field).then(|| own.name())
            },
            set: |reading, value| value.parse().map(|value| reading.$field = value),
        })
    };
    (optional $field:ident) => {
        Some($crate::mirror::ambiguity::Field {
            get: |reading| reading.$field.map(|own| own.name()),
            set: |reading, value| value.parse().map(|value| reading.$field = Some(value)),
        })
    };
}
pub(super) use field;

impl Ambiguity {
    /// Returns whether `--reading` offers it.
    pub fn is_option(&self) -> bool {
        self.field.is_some()
    }

    /// Returns a value's name with that of the ambiguity, such as `R1 = inside` or `R9: ORIGIN = 0`.
    pub fn label(&self, value: &Value) -> String {
        match self.field {
            Some(_) => format!("{} = {}", self.id, value.name),
            None => format!("{}: {}", self.id, value.name),
        }
    }

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

    /// Sets this ambiguity in a reading to one of its values, where `--reading` offers it.
    pub fn set(&self, reading: &mut Reading, value: &Value) {
        if let Some(field) = &self.field {
            (field.set)(reading, value.name).expect("a name of the table");
        }
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
        let field = READINGS.iter().find(|row| row.id == id).and_then(|row| row.field.as_ref());
        let field = field.ok_or_else(|| {
            let offered = READINGS.iter().filter(|row| row.is_option()).map(|row| row.id);
            let offered: Vec<&str> = offered.collect();
            format!("no such reading; there are {}", offered.join(", "))
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
