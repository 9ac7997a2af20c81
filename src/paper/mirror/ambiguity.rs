//! What a row of the table of readings is.

use mathcad::Settings;

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

/// Something that the print leaves open: a row of the table of readings, each of which is an `R`.
pub struct Ambiguity<R: 'static> {
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
    /// Its field of a reading; nothing where `--reading` does not offer it.
    pub(super) field: Option<Field<R>>,
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

/// How a field of a reading is read and written by name.
pub(super) struct Field<R> {
    /// The name of its value; nothing for the default.
    pub(super) get: fn(&R) -> Option<&'static str>,
    pub(super) set: fn(&mut R, &str) -> Result<(), String>,
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

impl<R> Ambiguity<R> {
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

    /// Sets this ambiguity in a reading to one of its values, where `--reading` offers it.
    pub fn set(&self, reading: &mut R, value: &Value) {
        if let Some(field) = &self.field {
            (field.set)(reading, value.name).expect("a name of the table");
        }
    }
}
