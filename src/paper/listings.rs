//! The paper's listings, executed as printed on the arrays of a scene.

use std::rc::Rc;

use crate::mirror::{Change, Pairs, Reading, Worksheet};
use base::choices;
use mathcad::array::{Column, Table};
use mathcad::failure::Fallible;
use mathcad::{
    Array, Cause, Edit, Ended, Failure, Limits, Listing, Recorder, Settings, Sheet, Value,
    name_length,
};
use problem::element::{self, Plane};

choices! {
    /// One of the paper's two listings.
    Which {
        /// The listing of fig. 2, which finds the contact pairs.
        CCnt = "c_cnt",
        /// The listing of fig. 3, which assembles the stiffness matrix.
        Km = "Km",
    }
}

/// Returns the most steps of an execution: 67 million, and the demand of arrays of the size of MJS (a
/// step for each entry, and its operations).
pub(crate) fn steps(sheet: &Worksheet<f64>) -> u64 {
    let matrix = 4 * sheet.R() as u64 * sheet.R() as u64;
    (1 << 26) + 32 * matrix
}

/// The result of an execution: its values, and the lines that `trace` wrote.
pub type Traced<T> = Fallible<(T, Vec<String>)>;

impl Which {
    /// Returns the text of record.
    pub fn text(self) -> &'static str {
        match self {
            Which::CCnt => include_str!("listings/c_cnt.txt"),
            Which::Km => include_str!("listings/Km.txt"),
        }
    }

    /// Returns the listing that a text, or an edit of a listing, begins with.
    pub fn from_text(text: &str) -> Option<Which> {
        let mut lines = text.lines().map(str::trim_start);
        let header = lines.find(|line| !line.starts_with('#') && !line.is_empty())?;
        header[..name_length(header)].parse().ok()
    }

    /// Returns the listing under a reading: the text of record with the reading's edits.
    pub fn under(self, reading: &Reading) -> Listing {
        let listing =
            Listing::parse(self.name(), self.text()).expect("the text of record is sound");
        reading.changes().fold(listing, |listing, change| match change {
            Change::Text(edit) if Which::from_text(edit) == Some(self) => edited(&listing, edit),
            Change::Text(_) | Change::Settings(_) | Change::None => listing,
        })
    }
}

/// Returns a listing with an edit of its text, one of `listings/readings/` or `listings/repairs/`.
pub fn edited(listing: &Listing, edit: &str) -> Listing {
    let edit = Edit::parse(edit).expect("the edits in listings are sound");
    edit.apply(listing).expect("the edits in listings fit the text of record")
}

/// Returns the worksheet's settings under a reading.
pub fn settings(reading: &Reading) -> Settings {
    let mut settings = Settings::default();
    reading.changes().for_each(|change| change.set(&mut settings));
    settings
}

/// Executes `c_cnt` on the shape `node_n`; each statement goes to the recorder.
///
/// # Errors
/// The listing fails, or ends without contact pairs.
pub fn c_cnt(
    listing: &Listing,
    settings: &Settings,
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    recorder: Option<&mut Recorder<'_>>,
) -> Traced<Pairs<f64>> {
    let (outcome, _) = execute(listing, settings, sheet, node_n.into(), recorder);
    pairs(listing, outcome?)
}

/// Executes `Km` on the contact pairs `k_cnt`; each statement goes to the recorder.
///
/// # Errors
/// The listing fails, or its value is no array.
pub fn km(
    listing: &Listing,
    settings: &Settings,
    sheet: &Worksheet<f64>,
    k_cnt: &Table<f64>,
    recorder: Option<&mut Recorder<'_>>,
) -> Traced<Rc<Array>> {
    let (outcome, _) = execute(listing, settings, sheet, k_cnt.into(), recorder);
    matrix(listing, outcome?)
}

/// Executes a listing on its argument; returns the steps that it took too.
pub(crate) fn execute(
    listing: &Listing,
    settings: &Settings,
    sheet: &Worksheet<f64>,
    argument: Value,
    recorder: Option<&mut Recorder<'_>>,
) -> (Fallible<Ended>, u64) {
    let limits = Limits { steps: steps(sheet), entries: 1 << 27, ..Limits::default() };
    let mut above = Sheet::empty();
    for (name, value) in tables(sheet) {
        above.define(name, value);
    }
    // ν, where a listing is typed in ASCII.
    above.define("nu", Value::from(&sheet.nu));
    let plane = sheet.plane;
    above.define_function("D", move |arguments| match arguments {
        [Value::Number(e), Value::Number(nu)] => {
            let d = element::D(plane, *e, *nu);
            Ok(Array::from_fn(3, 3, |i, j| d[(i, j)]).into())
        }
        _ => Err("D takes an elastic modulus and a Poisson's ratio".into()),
    });
    let mut runner = listing.runner(&above, settings, &limits);
    let outcome = runner.call_recorded(&[argument], recorder);
    (outcome, runner.steps())
}

/// Returns the contact pairs that an execution of `c_cnt` ended with.
pub(crate) fn pairs(listing: &Listing, outcome: Ended) -> Traced<Pairs<f64>> {
    let column = |name: &'static str| -> Fallible<Column<f64>> {
        let local = outcome.locals.get(name).and_then(|value| Column::try_from(value).ok());
        local.ok_or_else(|| unexpected(listing, "a column", name))
    };
    let whole = |name: &'static str| -> Fallible<Column<usize>> {
        let column = column(name)?;
        if column.iter().any(|x| *x < 0.0 || x.fract() != 0.0) {
            return Err(unexpected(listing, "whole numbers", name));
        }
        Ok(column.map(|x| x as usize))
    };
    let pairs = Pairs {
        ct: whole("ct")?,
        yt: column("yt")?,
        dy: whole("dy")?,
        k_cnt: Table::try_from(&outcome.value)
            .map_err(|_| unexpected(listing, "an array", "value of the program"))?,
    };
    Ok((pairs, outcome.trace_output))
}

/// Returns the matrix that an execution of `Km` ended with.
pub(crate) fn matrix(listing: &Listing, outcome: Ended) -> Traced<Rc<Array>> {
    let Value::Array(matrix) = outcome.value else {
        return Err(unexpected(listing, "an array", "value of the program"));
    };
    Ok((matrix, outcome.trace_output))
}

/// Returns the failure of an edited listing that ends without the results of the paper's listing.
fn unexpected(listing: &Listing, expected: &'static str, name: &str) -> Box<Failure> {
    let last = listing.lines().last();
    Box::new(Failure {
        listing: listing.name().into(),
        line: last.map_or(1, |line| line.printed),
        column: 1,
        text: name.into(),
        statement: last.map_or(String::new(), |line| line.text.clone()),
        cause: Cause::Kind { expected, found: format!("something else in {name}") },
    })
}

/// Returns the tables and variables that are above the listings on the worksheet, by name.
pub fn tables(sheet: &Worksheet<f64>) -> Vec<(&'static str, Value)> {
    let gradients = sheet.B.iter().map(|b| Value::from(Array::from_fn(3, 6, |i, j| b[(i, j)])));
    vec![
        ("node", Value::from(&sheet.node)),
        ("elem", Value::from(&sheet.elem)),
        ("EL", Value::from(&sheet.EL)),
        ("trg", Value::from(&sheet.trg)),
        ("cnt", Value::from(&sheet.cnt)),
        ("c_tll", sheet.c_tll.into()),
        ("ind_1", sheet.ind_1.into()),
        ("R", sheet.R().into()),
        ("M", sheet.M().into()),
        ("S", Value::from(&sheet.S)),
        ("Ae", Value::from(&sheet.Ae)),
        ("B", gradients.collect::<Value>()),
        ("E", Value::from(&sheet.E)),
        ("ν", Value::from(&sheet.nu)),
    ]
}

const STRAIN: &str = "D(Ey,nu) :=
  f ← Ey / ((1 + nu)·(1 − 2·nu))
  (f·(1 − nu)   f·nu   0; f·nu   f·(1 − nu)   0; 0   0   f·((1 − 2·nu) / 2))
";

const STRESS: &str = "D(Ey,nu) :=
  f ← Ey / (1 − nu·nu)
  (f   f·nu   0; f·nu   f   0; 0   0   f·((1 − nu) / 2))
";

/// Returns a listing of `D`, which the paper does not print.
pub fn elasticity(plane: Plane) -> &'static str {
    match plane {
        Plane::Strain => STRAIN,
        Plane::Stress => STRESS,
    }
}
