//! The only conversion between the finite element model, which counts from 0 by types of its own,
//! and the paper's tables, which count from 1.
//!
//! ```text
//!   Model ------- worksheet -----> node, elem, EL, trg, cnt, S, ... --> c_cnt, Km
//!   Shape ------- node_n --------> node_n
//!   ContactStatus, NodeToSegment <---- statuses, linked, on_edges ----- Pairs (ct, yt, dy, k_cnt)
//! ```
#![allow(non_snake_case, reason = "the paper's own names")]

use std::ops::IndexMut;
use std::sync::Arc;

use nalgebra::DVector;

use super::mirror::{self, Failure, Km, Pairs, Reading, ToleranceUnit, Worksheet, c_cnt};
use base::error::InputError;
use base::plain::six_digits;
use mathcad::array::{Column, Table};
use numbers::scalar::Scalar;
use numbers::square::SparseSquare;
use problem::element;
use problem::model::{EdgeId, Element, Model, NodeId, TriangleId};
use problem::units::length_in_metres;

/// The column of `EL` and `elem` where the nodes start.
const IND_1: usize = 6;

/// Returns `model`, whose lengths are in `unit`, under a reading: R6 sets the plane problem, R8 the unit of
/// the tolerance. A model that the reading changes is no longer shared.
///
/// # Errors
/// The plane problem of R6 does not allow a Poisson's ratio; or R8 asks for metres, and what a metre is in
/// the unit is not known.
pub fn under(
    mut model: Arc<Model>,
    unit: &str,
    reading: &Reading,
) -> Result<Arc<Model>, InputError> {
    if let Some(plane) = reading.r6 {
        Arc::make_mut(&mut model).plane = plane;
        for triangle in &model.triangles {
            plane.check_poisson(triangle.material.nu, "reading R6")?;
        }
    }
    match reading.r8 {
        ToleranceUnit::Millimetre => (),
        ToleranceUnit::Metre => {
            Arc::make_mut(&mut model).contact.tolerance *= units_of_a_metre(unit)?;
        }
    }
    Ok(model)
}

/// Returns how many units of length are a metre, by the unit's name; without one it is mm, as in the paper's
/// example.
fn units_of_a_metre(unit: &str) -> Result<f64, InputError> {
    let metres = length_in_metres(if unit.is_empty() { "mm" } else { unit });
    metres.map(f64::recip).ok_or_else(|| {
        let what = format!("what a metre is in the unit of length, {unit:?}, is not known");
        InputError::new("reading R8", what, "give units.length of the scene as m, cm, mm, um or in")
    })
}

/// Checks that the paper's S can say what holds a model: along an axis, at 0.
///
/// # Errors
/// Names a restraint that holds a node along another direction, or displaces it.
pub fn check_restraints(model: &Model) -> Result<(), InputError> {
    let mut others = model.holds.iter().filter(|hold| hold.dof().is_none());
    let Some(hold) = others.next() else { return Ok(()) };
    let ([x, y], by) = (hold.direction.map(six_digits), six_digits(hold.displacement));
    let what = format!(
        "restraint {:?} holds node {} along [{x}, {y}] at {by}; Km restrains by S, which is 1 or 0 for x and \
         for y (lines 7 and 8), so that it holds nodes along these at 0 alone",
        model.restraint_of(hold),
        hold.node
    );
    let fix = "ask for unilateral, or restrain x and y";
    Err(InputError::new("restraints", what, fix))
}

/// Returns the paper's tables of a model. Each number passes through `number`; `Ae` and `B` are
/// computed from the coordinates in T.
pub fn worksheet<T: Scalar>(model: &Model, number: impl Fn(f64) -> T) -> Worksheet<T> {
    let elem = elem(model);
    let triangles = model.rows.iter().filter(|row| matches!(row.element, Element::Triangle(_)));
    let triangles: Vec<usize> = triangles.map(|row| row.number).collect();
    let thickness = number(model.thickness);
    let corners: Vec<element::Corners<T>> =
        model.triangle_ids().map(|id| model.corners(id).map(|p| p.map(&number))).collect();
    let target = model.target_edges().map(|edge| edge.number);
    let contact = model.contact.nodes.iter().map(|node| node.number());
    let of = |f: &dyn Fn(TriangleId) -> f64| {
        Column::from_vec(model.triangle_ids().map(|id| number(f(id))).collect())
    };
    Worksheet {
        node: node_n(model, &model.nodes).map(&number),
        EL: Table::from_fn(triangles.len(), 8, |n, j| elem[(triangles[n - 1], j)]),
        elem,
        trg: Column::from_vec(target.collect()),
        cnt: Column::from_vec(contact.collect()),
        c_tll: number(model.contact.tolerance),
        ind_1: IND_1,
        S: Column::from_vec(model.all_dofs().map(|dof| model.is_restrained(dof).into()).collect()),
        Ae: Column::from_vec(corners.iter().map(|p| element::area(p) * thickness).collect()),
        B: Column::from_vec(corners.iter().map(element::B).collect()),
        E: of(&|id| model.triangle(id).material.e),
        nu: of(&|id| model.triangle(id).material.nu),
        plane: model.plane,
    }
}

/// Returns `elem`: number, type, number of tags, physical tag, geometric tag, nodes, then zeros.
fn elem(model: &Model) -> Table<usize> {
    let last = model.rows.last().map_or(0, |row| row.number);
    let mut elem = Table::filled(last, 8, 0);
    for row in &model.rows {
        let (kind, nodes) = match &row.element {
            Element::Point(node) => (15, std::slice::from_ref(node)),
            Element::Edge(id) => (1, &model.edge(*id).nodes[..]),
            Element::Triangle(id) => (2, &model.triangle(*id).nodes[..]),
        };
        let head = [row.number, kind, 2, row.physical, row.geometric];
        let nodes = nodes.iter().map(|node| node.number());
        for (j, value) in head.into_iter().chain(nodes).enumerate() {
            elem[(row.number, j + 1)] = value;
        }
    }
    elem
}

/// Returns the node table of a shape, the coordinates of each node: number, x, y, z; R x 4.
pub fn node_n(model: &Model, shape: &[[f64; 2]]) -> Table<f64> {
    Table::from_fn(shape.len(), 4, |i, j| match j {
        1 => i as f64,
        2 | 3 => shape[i - 1][j - 2],
        _ => model.z,
    })
}

/// Returns node_n = node + U, R x 4, length, for displacements `u` by degree of freedom.
pub fn displaced_nodes<T: Scalar>(sheet: &Worksheet<T>, u: &DVector<T>) -> Table<T> {
    let mut node_n = sheet.node.clone();
    for node in NodeId::all(sheet.R()) {
        let [x, y] = node.components(u);
        node_n[(node.number(), 2)] += x;
        node_n[(node.number(), 3)] += y;
    }
    node_n
}

/// Returns the coordinates of a node in the shape of a node table, length.
pub fn coordinates<T: Scalar>(node_n: &Table<T>, node: NodeId) -> [T; 2] {
    [2, 3].map(|column| node_n[(node.number(), column)])
}

/// Returns the coordinates of each node in the shape of a node table, length.
pub fn shape<T: Scalar>(node_n: &Table<T>) -> Vec<[T; 2]> {
    NodeId::all(node_n.rows()).map(|node| coordinates(node_n, node)).collect()
}

/// Returns `Km` without contact and without restraints, 2R x 2R, force/length.
///
/// # Errors
/// An entry of the matrix overflows.
pub fn free_stiffness<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
) -> Result<Table<T>, Failure> {
    let free = Worksheet { S: Column::filled(2 * sheet.R(), 0), ..sheet.clone() };
    Ok(Km(&free, reading, &Table::filled(sheet.R(), 4, T::zero()))?.to_table())
}

/// Returns the matrix of `Km` with 1 on the diagonal of the equations of dropped nodes, which have no
/// entry there (finding K4): as `Km` does with the equations of restrained nodes.
pub fn holding_dropped<T: Scalar, M>(model: &Model, mut matrix: M) -> M
where
    M: IndexMut<(usize, usize), Output = T>,
{
    for dof in model.dropped.iter().flat_map(|node| node.dofs()) {
        matrix[(dof.index(), dof.index())] = T::one();
    }
    matrix
}

/// The status of a contact node, as `c_cnt` finds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactStatus<T = f64> {
    /// The contact node.
    pub node: NodeId,
    /// The target edge of the node; None where the search found none.
    pub edge: Option<EdgeId>,
    /// The vertical distance from the contact node to the target line, > 0 where the line is above
    /// the node, length; 0 without a target edge.
    pub distance: T,
    /// Whether it is in contact: the listing's `dy` is 1.
    pub in_contact: bool,
}

/// Returns the statuses in `pairs`, in the order of the contact surface.
pub fn statuses<T: Scalar>(model: &Model, pairs: &Pairs<T>) -> Vec<ContactStatus<T>> {
    let place = |number: usize| {
        let at = model.edges.binary_search_by_key(&number, |edge| edge.number);
        EdgeId::new(at.expect("ct names an edge of the mesh"))
    };
    let status = |(k, node): (usize, &NodeId)| ContactStatus {
        node: *node,
        edge: Some(pairs.ct[k + 1]).filter(|number| *number > 0).map(place),
        distance: pairs.yt[k + 1],
        in_contact: pairs.dy[k + 1] == 1,
    };
    model.contact.nodes.iter().enumerate().map(status).collect()
}

/// Returns statuses that another rule than the listing's decided as pairs in the listing's arrays,
/// with the weights of its lines 11 to 31.
///
/// # Errors
/// Those lines fail as printed: the weights of a vertical edge.
pub fn pairs<T: Scalar>(
    model: &Model,
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    statuses: &[ContactStatus<T>],
) -> Result<Pairs<T>, Failure> {
    let number = |status: &ContactStatus<T>| status.edge.map_or(0, |edge| model.edge(edge).number);
    let ct = Column::from_vec(statuses.iter().map(number).collect());
    let yt = Column::from_vec(statuses.iter().map(|status| status.distance).collect());
    let decided = |i1: usize| Ok(usize::from(statuses[i1 - 1].in_contact));
    let (dy, k_cnt) = mirror::weights(sheet, reading, node_n, &ct, &decided)?;
    Ok(Pairs { ct, yt, dy, k_cnt })
}

/// A contact node and the point of the target to which it is bound, on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeToSegment<T = f64> {
    /// The contact node.
    pub node: NodeId,
    /// The master nodes, which are the target edge's nodes, and their weights.
    pub masters: [(NodeId, T); 2],
}

/// Returns the contact nodes with dy = 1, each once, with columns 1 to 4 of their rows of k_cnt.
pub fn linked<T: Scalar>(sheet: &Worksheet<T>, pairs: &Pairs<T>) -> Vec<NodeToSegment<T>> {
    let mut found: Vec<NodeToSegment<T>> = Vec::new();
    for i1 in (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1) {
        let n = sheet.cnt[i1];
        let node = NodeId::from_number(n);
        if found.iter().all(|other| other.node != node) {
            let master = |column: usize| {
                let number = pairs.k_cnt[(n, column)].index();
                (NodeId::from_number(number), pairs.k_cnt[(n, column + 1)])
            };
            found.push(NodeToSegment { node, masters: [master(1), master(3)] });
        }
    }
    found
}

/// Returns the contact nodes with dy = 1 on their target edges, with the weights that lines 22 and
/// 23 of `c_cnt` compute. These are not yet added up in k_cnt, so that they sum to 1 under any
/// reading.
///
/// # Errors
/// Those of lines 22 and 23.
pub fn on_edges<T: Scalar>(
    sheet: &Worksheet<T>,
    pairs: &Pairs<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Vec<NodeToSegment<T>>, Failure> {
    let on_edge = |i1: usize| {
        let node = NodeId::from_number(sheet.cnt[i1]);
        let [a, b] = [6, 7].map(|j| NodeId::from_number(sheet.elem[(pairs.ct[i1], j)]));
        let [k1, k2] = mirror::own_weights(sheet, reading, node_n, &pairs.ct, i1)?;
        Ok(NodeToSegment { node, masters: [(a, k1), (b, k2)] })
    };
    (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1).map(on_edge).collect()
}

/// A call of `c_cnt` on a model in a shape: its arguments and its results.
pub struct Call {
    /// The worksheet on which `c_cnt` was called.
    pub sheet: Worksheet<f64>,
    /// What `c_cnt` returned.
    pub pairs: Pairs<f64>,
    /// The status of each contact node, in the order of `cnt`.
    pub statuses: Vec<ContactStatus>,
}

impl Call {
    /// Calls `c_cnt` under `reading` in a shape, given as the coordinates of each node, length.
    ///
    /// # Errors
    /// The listing fails: says in which line.
    pub fn c_cnt(model: &Model, reading: &Reading, shape: &[[f64; 2]]) -> Result<Self, Failure> {
        let sheet = worksheet(model, |x| x);
        let pairs = c_cnt(&sheet, reading, &node_n(model, shape))?;
        let statuses = statuses(model, &pairs);
        Ok(Call { sheet, pairs, statuses })
    }

    /// Returns the call that found these pairs, as an edited listing may.
    pub fn of_pairs(model: &Model, pairs: Pairs<f64>) -> Self {
        Call { sheet: worksheet(model, |x| x), statuses: statuses(model, &pairs), pairs }
    }

    /// Returns a call without any pair, with which `Km` builds the matrix without contact.
    pub fn without_contact(model: &Model) -> Self {
        let pairs = Pairs::none(model.nodes.len());
        Call { sheet: worksheet(model, |x| x), pairs, statuses: Vec::new() }
    }

    /// Calls `Km` with the pairs of `c_cnt`. Returns `MJS`, with a row and a column for each degree
    /// of freedom, force/length.
    ///
    /// # Errors
    /// An entry of the matrix overflows.
    pub fn km(&self, reading: &Reading) -> Result<SparseSquare, Failure> {
        Ok(Km(&self.sheet, reading, &self.pairs.k_cnt)?.into_sparse())
    }

    /// Returns the row of `k_cnt` of a node: mate, weight, mate, weight.
    pub fn row(&self, node: NodeId) -> [f64; 4] {
        self.pairs.row(node.number())
    }
}
