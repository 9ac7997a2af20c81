//! The readings: what the print leaves open, each with its values and a default.
//!
//! [`READINGS`] is the one table of them. `--reading` with its help, the listings' text under a
//! reading, the worksheet's settings, the trials of `audit`, the switches of `lesson` and
//! `listings/READING.md`, section 4 all follow from it.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use base::choices;
use mathcad::{Conjunction, Settings};
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
        Change::Text(include_str!(concat!("../../../listings/readings/", $file)))
    };
}

values! {
    /// R1, c_cnt 14: the place of the weights loop.
    LoopPlace {
        Beside = "beside", "the weights loop stands beside the zeroing loop";
        Inside = "inside", "it stands inside, as the scan indents it", edit "R1-inside.edit";
    }
}
values! {
    /// R2, Km 7: the index under which the x restraint is read.
    RestraintIndex {
        Odd = "odd", "the index of the x restraint, 2·EL − 1";
        Printed = "printed", "that of line 8, 2·EL, as the scan prints it", edit "R2-printed.edit";
    }
}
values! {
    /// R3, Km 16-33: the place of the adding loops.
    Wedge {
        Collect = "collect", "the three nodes fill `W`, then one adding loop runs";
        PerNode = "per-node", "the adding loop runs after each node, with the node's own weight",
            edit "R3-per-node.edit";
        Nested = "nested", "as per-node, and the second pair within the first, as the scan indents it",
            edit "R3-nested.edit";
    }
}
values! {
    /// R5, c_cnt 22 and 23: the coordinates from which weights are computed.
    NodeTable {
        Node = "node", "weights from initial coordinates, as printed";
        NodeN = "node_n", "from current ones, which in a first call are the initial ones",
            edit "R5-node_n.edit";
    }
}

impl NodeTable {
    /// Returns whether weights follow the shape, so that they may grow from iteration to iteration.
    pub fn follows_the_shape(self) -> bool {
        match self {
            NodeTable::Node => false,
            NodeTable::NodeN => true,
        }
    }
}

values! {
    /// R7, not printed: the load of an iteration.
    Schedule {
        Total = "total", "the whole load, from the initial shape";
        Stepped = "stepped", "an equal share of the load, from the last shape";
    }
}
values! {
    /// R8, not printed: the unit of c_tol, in a scene measured in millimetres.
    ToleranceUnit {
        Millimetre = "mm", "c_tol in the scene's own unit, mm in the paper's example";
        Metre = "m", "in metres, in a scene in mm: 1,000 times as much";
    }
}

/// The values of R4, which are rules of Mathcad.
const CONJUNCTIONS: [Value; Conjunction::ALL.len()] = [
    Value::new(
        Conjunction::Guarded.name(),
        "a false operand of ∧ decides even if another fails",
        Change::None,
    ),
    Value::new(
        Conjunction::LeftToRight.name(),
        "operands of ∧ up to the first false one",
        Change::Settings(|settings| settings.conjunction = Conjunction::LeftToRight),
    ),
    Value::new(
        Conjunction::Eager.name(),
        "all operands of ∧, and a failure stands",
        Change::Settings(|settings| settings.conjunction = Conjunction::Eager),
    ),
];

const PLANES: [Value; Plane::ALL.len()] = [
    Value::new(Plane::Strain.name(), "`D` of plane strain", Change::None),
    Value::new(Plane::Stress.name(), "`D` of plane stress", Change::None),
];

/// The values of R9: a blank worksheet, three options that a worksheet stores, three rules of
/// Mathcad itself.
const WORKSHEETS: [Value; 7] = [
    Value::new("blank", "a blank Mathcad 14 worksheet, but for ORIGIN = 1", Change::None),
    Value::new("ORIGIN = 0", "subscripts from 0", Change::Settings(|s| s.origin = 0)),
    Value::new(
        "0/0 = 0",
        "no error (c_cnt 10, 22, 23)",
        Change::Settings(|s| s.zero_over_zero_is_zero = true),
    ),
    Value::new("comparisons to 1e-12", "not exact", Change::Settings(|s| s.exact_boolean = false)),
    Value::new("below 1e-307 is 0", "in comparisons", Change::Settings(|s| s.tiny_is_zero = true)),
    Value::new(
        "1 .. 0 is empty",
        "a range does not count down",
        Change::Settings(|s| s.descending_is_empty = true),
    ),
    Value::new(
        "a failed last if is 0",
        "not the value of the statement before",
        Change::Settings(|s| s.last_if_is_zero = true),
    ),
];

/// The values of R10; e is the strain's deviator.
const STRAIN_FORMULAS: [Value; 2] = [
    Value::new("deviator", "von Mises strain sqrt(2/3 e:e)", Change::None),
    Value::new(
        "stress formula / (1 + nu)",
        "the formula of the von Mises stress on strains, over 1 + ν",
        Change::None,
    ),
];

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
    field: Option<Field>,
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
    const fn new(name: &'static str, words: &'static str, change: Change) -> Self {
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
struct Field {
    /// The name of its value; nothing for the default.
    get: fn(&Reading) -> Option<&'static str>,
    set: fn(&mut Reading, &str) -> Result<(), String>,
}

macro_rules! field {
    ($field:ident) => {
        Some(Field {
            get: |reading| {
                let own = reading.$field;
                (own != Reading::default().$field).then(|| own.name())
            },
            set: |reading, value| value.parse().map(|value| reading.$field = value),
        })
    };
    (optional $field:ident) => {
        Some(Field {
            get: |reading| reading.$field.map(|own| own.name()),
            set: |reading, value| value.parse().map(|value| reading.$field = Some(value)),
        })
    };
}

/// All ambiguities of the print, in the order of their ids.
pub const READINGS: [Ambiguity; 10] = [
    Ambiguity {
        id: "R1",
        lines: "c_cnt 14",
        what: "the place of the weights loop",
        values: LoopPlace::VALUES,
        default: DefaultFrom::First,
        why: "inside, every one of the R turns adds all weights anew, and row r keeps what came \
              since its own zeroing: R + 1 − r times its weights",
        trial: Trial::OwnVariant,
        field: field!(r1),
    },
    Ambiguity {
        id: "R2",
        lines: "Km 7",
        what: "the index of the x restraint",
        values: RestraintIndex::VALUES,
        default: DefaultFrom::First,
        why: "`printed` ignores a restraint of x and takes one of y for both, against the text's \
              \"in the corresponding direction\"",
        trial: Trial::Printed,
        field: field!(r2),
    },
    Ambiguity {
        id: "R3",
        lines: "Km 16-33",
        what: "the place of the adding loops",
        values: Wedge::VALUES,
        default: DefaultFrom::First,
        why: "the scan's indentation cannot be meant as a whole: it has all that follows line 4 \
              inside it, where line 12 reads `V[3]` on the first turn, before it exists. That `W` \
              and `fl` are cleared after each node of the second pair too is ours",
        trial: Trial::Printed,
        field: field!(r3),
    },
    Ambiguity {
        id: "R4",
        lines: "c_cnt 17, 18",
        what: "how `∧` is evaluated",
        values: &CONJUNCTIONS,
        default: DefaultFrom::First,
        why: "how Mathcad evaluates `∧` is not known to us. `eager` stops on every scene with \
              contact, so it cannot be if the listing ran as printed; `left-to-right` stops where \
              `yt[1]` < 0 (C10); `guarded` never",
        trial: Trial::EveryShape,
        field: field!(r4),
    },
    Ambiguity {
        id: "R5",
        lines: "c_cnt 22, 23",
        what: "the coordinates from which weights are computed",
        values: NodeTable::VALUES,
        default: DefaultFrom::First,
        why: "as printed",
        trial: Trial::OwnVariant,
        field: field!(r5),
    },
    Ambiguity {
        id: "R6",
        lines: "Km 9",
        what: "the plane problem",
        values: &PLANES,
        default: DefaultFrom::Scene,
        why: "the strand runs along its duct. The keywords say \"plane stress and strain state\", \
              which settles nothing",
        trial: Trial::OwnVariant,
        field: field!(optional r6),
    },
    Ambiguity {
        id: "R7",
        lines: "-",
        what: "the load of an iteration",
        values: Schedule::VALUES,
        default: DefaultFrom::Variant,
        why: "the text has 20 iterations with links renewed after each and does not say what load \
              one carries: both are variants (section 6)",
        trial: Trial::OwnVariant,
        field: field!(optional r7),
    },
    Ambiguity {
        id: "R8",
        lines: "c_cnt 5-7, 16",
        what: "the unit of c_tol in a scene in mm",
        values: ToleranceUnit::VALUES,
        default: DefaultFrom::First,
        why: "the text has \"0.001\" without a unit, beside 50 x 50 mm and MPa",
        trial: Trial::OwnVariant,
        field: field!(r8),
    },
    Ambiguity {
        id: "R9",
        lines: "both",
        what: "what the worksheet, or Mathcad itself, does around the listings",
        values: &WORKSHEETS,
        default: DefaultFrom::First,
        why: "ORIGIN = 1 since every loop of the listings begins at 1; the rest is Mathcad's own \
              default, see below",
        trial: Trial::Worksheet,
        field: None,
    },
    Ambiguity {
        id: "R10",
        lines: "-",
        what: "the formula of the von Mises strain",
        values: &STRAIN_FORMULAS,
        default: DefaultFrom::First,
        why: "the paper prints neither; the first is the von Mises stress over 3G and does with it \
              the work of the deviators, the second is the stress over E",
        trial: Trial::Strains,
        field: None,
    },
];

/// A choice for each ambiguity of the print (`listings/READING.md`, section 4). The scene and the
/// variant set R6 and R7 unless the reading does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub struct Reading {
    /// R1: the place of the weights loop.
    pub r1: LoopPlace,
    /// R2: the index of the x restraint.
    pub r2: RestraintIndex,
    /// R3: the place of the adding loops of `Km`.
    pub r3: Wedge,
    /// R4: the evaluation of `∧`.
    pub r4: Conjunction,
    /// R5: the coordinates from which weights are computed.
    pub r5: NodeTable,
    /// R6: the plane problem in place of the scene's `plane`.
    pub r6: Option<Plane>,
    /// R7: the load of an iteration in place of the variant's.
    pub r7: Option<Schedule>,
    /// R8: the unit of c_tol.
    pub r8: ToleranceUnit,
}

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
