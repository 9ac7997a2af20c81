//! The displacements that another code computed on the mesh of a scene, beside a solution of it.
//!
//! ```text
//!  FIELD.csv --csv--> Rows --on_mesh--> u --+
//!  deck --------------ccx-------------> u --+--implied--> Solution --+
//!  SCENE ----------------------solve--------------> reference -------+--> Beside --> tables, JSON
//! ```

mod beside;
mod by_calculix;
pub(crate) mod command;
pub mod comparison;
mod csv;

pub use beside::{AtNode, Beside, BodyDifference, ContactValues};
pub use by_calculix::ByCalculix;
pub use comparison::Compared;

use std::path::Path;

use nalgebra::DVector;

use base::error::{InputError, Result};
use base::files as disk;
use base::plain::{shown, six_digits};
use problem::model::{Model, NodeId};
use problem::scene::{Scene, Units};

/// How far a place of the file may be from its node, over the larger side of the mesh.
const NEAR: f64 = 1e-6;

/// How a file that cannot be read is written.
const HOW: &str = "write it as CSV with the columns node, ux, uy or x, y, ux, uy; in Python, \
                   plane_contact.compare(SCENE, meshio.read(FIELD).point_data[NAME]) takes all that meshio reads";

/// The displacements in a file.
pub struct Rows {
    /// The path of the file.
    pub place: String,
    /// The names of what was taken for places and displacements, which may have a unit.
    names: Vec<String>,
    /// What was taken for the displacements.
    pub taken: String,
    rows: Vec<Row>,
}

/// The displacement of a node.
struct Row {
    /// The number of its line in the file.
    line: usize,
    /// The number of the node.
    number: Option<usize>,
    /// Its place in the undeformed shape, length.
    at: Option<[f64; 2]>,
    /// The displacement along x, y and z, length; 0 along z where the file has none.
    u: [f64; 3],
}

impl Rows {
    /// Reads a file of displacements by the extension of its name.
    ///
    /// # Errors
    /// It cannot be read, or has no displacements.
    pub fn read(path: &Path) -> Result<Self> {
        let place = shown(path);
        if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("csv")) {
            return Err(InputError::new(
                place,
                "the file is no .csv, the only kind that is read",
                HOW,
            ));
        }
        let bytes = disk::read(path).map_err(|why| {
            let what = format!("the field cannot be read: {why}");
            InputError::new(&place, what, "give the path of a .csv file")
        })?;
        csv::read(bytes, &place)
    }

    /// Returns the displacements by degree of freedom of the scene's model, and how their nodes were found,
    /// in words.
    ///
    /// # Errors
    /// A row belongs to no node or to several, a node has no row or several, or a displacement is no number.
    pub fn on_mesh(&self, scene: &Scene, model: &Model) -> Result<(DVector<f64>, String)> {
        self.check_units(&scene.units)?;
        let (nodes, how) = self.nodes(scene, model)?;
        let size =
            self.rows.iter().flat_map(|row| row.u).fold(0.0, |size: f64, u| size.max(u.abs()));
        let mut found: Vec<Option<&Row>> = vec![None; model.nodes.len()];
        for (node, row) in nodes.into_iter().zip(&self.rows) {
            if model.is_dropped(node) {
                continue;
            }
            if let Some(before) = found[node.index()].replace(row) {
                let what =
                    format!("node {node} is that of line {} and of line {}", before.line, row.line);
                return Err(self.wrong(what, "give each node one row"));
            }
            if !row.u.iter().all(|u| u.is_finite()) {
                let what = format!("line {} (node {node}) has no finite displacement", row.line);
                return Err(self.wrong(what, "give a number for each node of the mesh"));
            }
            if row.u[2].abs() > NEAR * size {
                let what = format!(
                    "line {} (node {node}) moves along z by {}, and the scene is plane",
                    row.line,
                    six_digits(row.u[2])
                );
                return Err(self.wrong(what, "give the field of a plane problem"));
            }
        }
        let is_missing = |node: &NodeId| found[node.index()].is_none() && !model.is_dropped(*node);
        let missing: Vec<NodeId> = model.node_ids().filter(is_missing).collect();
        if let Some(first) = missing.first() {
            let [x, y] = model.coordinates(*first).map(six_digits);
            let what = format!(
                "{} of the scene's {} nodes have no displacement, the first node {first} at {x}, {y}",
                missing.len(),
                model.nodes.len()
            );
            return Err(
                self.wrong(what, "give the field of the scene's own mesh, at all of its nodes")
            );
        }
        let u = |node: NodeId| found[node.index()].map_or([0.0; 2], |row| [row.u[0], row.u[1]]);
        let u: Vec<[f64; 2]> = model.node_ids().map(u).collect();
        Ok((DVector::from_column_slice(u.as_flattened()), how))
    }

    /// Returns the node of each row: by number where the rows have one, else by coordinates.
    fn nodes(&self, scene: &Scene, model: &Model) -> Result<(Vec<NodeId>, String)> {
        let near = NEAR * model.bounds().larger_side();
        let is_at = |row: &Row, node: NodeId| {
            let [nx, ny] = model.coordinates(node);
            row.at.is_none_or(|[x, y]| (x - nx).hypot(y - ny) <= near)
        };
        match self.rows.iter().all(|row| row.number.is_some()) {
            true => self.by_its_numbers(scene, model, is_at),
            false => Ok((self.by_coordinates(model, near, is_at)?, "by coordinates".into())),
        }
    }

    /// Returns the node of each row by its number in the mesh file, or here, whichever fits.
    fn by_its_numbers(
        &self,
        scene: &Scene,
        model: &Model,
        is_at: impl Fn(&Row, NodeId) -> bool + Copy,
    ) -> Result<(Vec<NodeId>, String)> {
        let in_file = &scene.source().1.in_file;
        let here = self.by_number(model, |n| n.checked_sub(1), is_at);
        if in_file.is_empty() {
            return Ok((here?, "by number".into()));
        }
        let in_file = self.by_number(model, |n| in_file.binary_search(&n).ok(), is_at);
        match (in_file, here) {
            (Ok(nodes), Err(_)) => Ok((nodes, "by the numbers of the mesh file".into())),
            (Err(_), Ok(nodes)) => Ok((nodes, "by number, as they are numbered here".into())),
            (Err(why), Err(_)) => Err(why),
            (Ok(_), Ok(_)) => {
                let what = "the node numbers may be those of the mesh file, which have gaps, or those here";
                Err(self.wrong(what, "give the columns x and y too"))
            }
        }
    }

    /// Returns the node of each row by its number, whose place among the nodes is `index`.
    fn by_number(
        &self,
        model: &Model,
        index: impl Fn(usize) -> Option<usize>,
        is_at: impl Fn(&Row, NodeId) -> bool,
    ) -> Result<Vec<NodeId>> {
        let node = |row: &Row| {
            let number = row.number.unwrap_or_default();
            let node = index(number).filter(|index| *index < model.nodes.len()).map(NodeId::new);
            let node = node.ok_or_else(|| {
                let what = format!("line {}: the mesh has no node {number}", row.line);
                self.wrong(what, "give the field of the scene's own mesh, whose nodes count from 1")
            })?;
            if !is_at(row, node) {
                let [x, y] = row.at.unwrap_or_default().map(six_digits);
                let [nx, ny] = model.coordinates(node).map(six_digits);
                let what = format!(
                    "line {} has node {number} at {x}, {y}; in the scene it is at {nx}, {ny}",
                    row.line
                );
                let fix = "give the field of the scene's own mesh, with undeformed coordinates in its unit";
                return Err(self.wrong(what, fix));
            }
            Ok(node)
        };
        self.rows.iter().map(node).collect()
    }

    /// Returns the only node that is at each row's place, within `near`.
    fn by_coordinates(
        &self,
        model: &Model,
        near: f64,
        is_at: impl Fn(&Row, NodeId) -> bool,
    ) -> Result<Vec<NodeId>> {
        let mut sorted: Vec<NodeId> = model.node_ids().collect();
        sorted.sort_by(|a, b| model.coordinates(*a)[0].total_cmp(&model.coordinates(*b)[0]));
        let node = |row: &Row| {
            let [x, y] = row.at.unwrap_or_default();
            let from = sorted.partition_point(|n| model.coordinates(*n)[0] < x - near);
            let column =
                sorted[from..].iter().take_while(|n| model.coordinates(**n)[0] <= x + near);
            let mut all: Vec<NodeId> = column.copied().filter(|n| is_at(row, *n)).collect();
            if all.len() > 1 {
                all.retain(|node| !model.is_dropped(*node));
            }
            let place = format!("line {} at {}, {}", row.line, six_digits(x), six_digits(y));
            match all[..] {
                [node] => Ok(node),
                [a, b, ..] => {
                    let what = format!("{place} is that of node {a} and of node {b}");
                    Err(self.wrong(what, "add a column node with their numbers"))
                }
                [] => {
                    let what = format!("{place} is at no node of the scene");
                    let fix = "give the field of the scene's own mesh, with undeformed coordinates in its unit";
                    Err(self.wrong(what, fix))
                }
            }
        };
        self.rows.iter().map(node).collect()
    }

    /// Checks that what was taken names no other unit of length than the scene's.
    fn check_units(&self, units: &Units) -> Result<()> {
        let other = self.names.iter().find_map(|name| {
            let unit = unit(name).filter(|unit| !units.measure_lengths_in(unit))?;
            Some((name, unit))
        });
        other.map_or(Ok(()), |(name, unit)| {
            let what = format!("{name:?} is in {unit}, the scene in {}", units.length);
            let fix = "give places and displacements in the scene's unit of length; no number is converted";
            Err(self.wrong(what, fix))
        })
    }

    fn wrong(&self, what: impl Into<String>, fix: &str) -> InputError {
        InputError::new(&self.place, what, fix)
    }
}

/// Returns the unit in a name: `mm` of `u_x, mm`, `ux [mm]` and `ux (mm)`.
fn unit(name: &str) -> Option<&str> {
    let (_, unit) = name.split_once([',', '(', '['])?;
    Some(unit.trim_matches([' ', ')', ']'])).filter(|unit| !unit.is_empty())
}

/// Returns whether a name is that of a column of node numbers.
fn is_number(name: &str) -> bool {
    const NAMES: [&str; 9] =
        ["node", "n", "id", "ids", "nodeid", "nodeids", "nodenumber", "nodelabel", "globalnodeid"];
    NAMES.contains(&&*plain(name))
}

/// Returns a name without units, blanks and signs, in lower case: `u_x, mm` is `ux`.
fn plain(name: &str) -> String {
    let name = name.split([',', '(', '[']).next().unwrap_or_default();
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
