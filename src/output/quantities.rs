//! The quantities of a result as columns of a table and as arrays of numbers.

use super::model::{Cell, Table};
use super::numbers::{Digits, decimals_of_places, quantity as with_its_unit};
use engine::quantities::{ContactNode, NodeFields, Quantity, TriangleValues, Unit, Value};
use problem::scene::Units;

/// The values of a quantity at all places: its name and unit, the number of components, and all
/// components of the first place, then of the second, and so on. Nine are a tensor in space.
pub struct Array {
    /// Its name in the file.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// How many numbers each value has.
    pub components: usize,
    /// The numbers, value by value.
    pub values: Vec<f64>,
}

impl Array {
    /// Collects the values of a quantity.
    pub fn new(name: &str, unit: &str, components: usize, values: Vec<f64>) -> Self {
        Array { name: name.into(), unit: unit.into(), components, values }
    }
}

/// Returns a table of `rows` with a column for each component of each of `quantities` that has a title and is
/// known in some row; a column has the digits that the part `error` of its largest number leaves, and places
/// in the undeformed shape four digits of the farthest.
pub fn table<'r, 'q, T: 'static>(
    rows: &'r [T],
    quantities: impl IntoIterator<Item = &'q Quantity<T>>,
    units: &Units,
    error: Option<f64>,
) -> Table<Vec<&'r T>> {
    let is_known =
        |quantity: &Quantity<T>| rows.iter().any(|row| (quantity.value)(row) != Value::Unknown);
    let mut table = Table::from_rows(rows);
    for quantity in quantities.into_iter().filter(|q| !q.title.is_empty() && is_known(q)) {
        for k in 0..quantity.symbols.len().max(1) {
            let title = match quantity.symbols {
                [] | [_] => quantity.title.to_string(),
                symbols => format!("{} {}", quantity.title, symbols[k]),
            };
            let numbers = rows.iter().filter_map(|row| (quantity.value)(row).numbers());
            let largest = numbers.map(|numbers| numbers[k].abs()).fold(0.0, f64::max);
            let digits = Digits::of(largest, error);
            let number = |x: f64| match quantity.is_place() {
                true => Cell::decimals(x, decimals_of_places(largest)),
                false => Cell::of_digits(x, digits),
            };
            let heading = with_its_unit(&title, quantity.unit.in_scene(units));
            table = table.column(heading, |row| match (quantity.value)(row) {
                Value::Unknown => Cell::Missing(None),
                Value::Count(n) => n.into(),
                Value::Number(part) if quantity.unit == Unit::Share => Cell::percent(part),
                Value::Number(x) => number(x),
                Value::Components(x) => number(x[k]),
                Value::State(_, words) | Value::Words(words) => words.into(),
            });
        }
    }
    table
}

/// Returns a table of the nodes, with a column for each component of their quantities.
pub fn nodes(fields: &NodeFields, units: &Units) -> Table<Vec<usize>> {
    let mut table = Table::from_rows(0..fields.nodes.len()).column("node", |n| n + 1);
    for quantity in NodeFields::QUANTITIES {
        let numbers = (quantity.value)(fields).numbers().unwrap_or_default();
        for (k, symbol) in quantity.symbols.iter().enumerate() {
            let heading = with_its_unit(symbol, quantity.unit.in_scene(units));
            table = table.column(heading, |n| numbers[quantity.symbols.len() * n + k]);
        }
    }
    table
}

/// Returns the array of a quantity of the triangles; None where it is not known in all of them.
pub fn triangle_array(
    quantity: &Quantity<TriangleValues>,
    triangles: &[TriangleValues],
    units: &Units,
) -> Option<Array> {
    let numbers: Option<Vec<_>> =
        triangles.iter().map(|row| (quantity.value)(row).numbers()).collect();
    Some(array(quantity, numbers?.concat(), units))
}

/// Returns the array of a quantity of the contact nodes at all `count` nodes; None where it is
/// nowhere known. Off the contact surface, and where no force acts, a number is 0; NaN where the force itself is
/// not known. A state is -1 where it is not known.
pub fn contact_array(
    quantity: &Quantity<ContactNode>,
    contact: &[ContactNode],
    count: usize,
    units: &Units,
) -> Option<Array> {
    let is_state = matches!((quantity.value)(contact.first()?), Value::State(..));
    let unknown = if is_state { -1.0 } else { 0.0 };
    let mut values = vec![unknown; count];
    let mut is_known = false;
    for node in contact {
        values[node.node.index()] = match (quantity.value)(node).numbers() {
            Some(numbers) => {
                is_known = true;
                numbers[0]
            }
            None if node.force.is_none() && !is_state => f64::NAN,
            None => unknown,
        };
    }
    is_known.then(|| array(quantity, values, units))
}

/// Returns the array of a quantity with these numbers; a tensor has nine components, by rows.
pub fn array<T>(quantity: &Quantity<T>, values: Vec<f64>, units: &Units) -> Array {
    let unit = match quantity.unit {
        Unit::One => "1",
        unit => unit.in_scene(units),
    };
    let (components, values) = match quantity.symbols {
        [_, _, shear, _] => {
            // The tensor has half of an engineering strain.
            let part = if shear.starts_with('γ') { 0.5 } else { 1.0 };
            let in_space = |&[x, y, xy, z]: &[f64; 4]| {
                let xy = part * xy;
                [x, xy, 0.0, xy, y, 0.0, 0.0, 0.0, z]
            };
            (9, values.as_chunks().0.iter().flat_map(in_space).collect())
        }
        symbols => (symbols.len().max(1), values),
    };
    Array::new(&quantity.array(), unit, components, values)
}
