//! The search of `c_cnt` alone: one contact node and one target edge, in a shape that displacements
//! led to.

use nalgebra::DVector;

use super::verdict::Verdict;
use engine::error::Error;
use numbers::scalar::{Exact, Scalar, scope};
use paper::door;
use paper::mirror::{Reading, c_cnt};
use problem::element::Plane;
use problem::model::NodeId;
use problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};

/// A target edge, a contact node, and how far each has moved.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Where the edge begins, length.
    pub a: [f64; 2],
    /// Where the edge ends, length.
    pub b: [f64; 2],
    /// Where the contact node stands, length.
    pub n: [f64; 2],
    /// Displacements of `a`, `b` and `n`, length.
    pub moved: [[f64; 2]; 3],
    /// Tolerance of the search, length.
    pub c_tll: f64,
}

/// What a search found.
struct Found<T> {
    /// Its gap to the edge: as printed a length, projected in edge lengths.
    gap: T,
    /// Its weight at the edge's first node.
    weight: T,
    /// Its status: 1 in contact, 0 apart.
    dy: usize,
}

impl Search {
    /// A node beside an edge of height 1 at `angle` (its tangent) from the vertical, nearer to it than the
    /// paper's c_tol. All move by a thousandth, and the edge widens by another: it keeps its angle, but not
    /// the bits of its x difference.
    pub fn at_angle(angle: f64) -> Search {
        const GAP: f64 = 7e-4;
        let a = [1.0 / 3.0, 1.0 / 7.0];
        let n = [a[0] + 0.4 * angle - GAP, a[1] + 0.4 + GAP * angle];
        let moved = [0.0, 0.37e-3, 0.148e-3].map(|part| [1.1e-3 + part * angle, -2.3e-3]);
        // A tolerance of 10 edges keeps the node in contact: its status would hide its weights.
        Search { a, b: [a[0] + angle, a[1] + 1.0], n, moved, c_tll: 10.0 }
    }

    /// A node above a level edge, then a sloping one, by the tolerance or by the next number to it.
    pub fn at_tolerance(case: f64) -> Search {
        let (case, c_tll) = (case as usize, 1e-3);
        let (b, height) = if case < 3 { ([2.0, 0.0], 0.0) } else { ([3.0, 1.0], 0.7 / 3.0) };
        let y: f64 = height + c_tll;
        let y = [y.next_down(), y, y.next_up()][case % 3];
        Search { a: [0.0, 0.0], b, n: [0.7, y], moved: [[0.0; 2]; 3], c_tll }
    }

    /// As printed: c_cnt under R5 = node_n, which takes weights from the current shape too.
    fn printed<T: Scalar>(&self) -> Result<Found<T>, Error> {
        let scene = self.scene().build()?;
        let reading: Reading = "R5=node_n".parse().expect("a reading");
        let sheet = door::worksheet(&scene.model, T::from_f64);
        let mut u = DVector::from_element(scene.model.dofs(), T::zero());
        for (moved, node) in self.moved.into_iter().zip([1, 2, 4]) {
            for (dof, moved) in NodeId::from_number(node).dofs().into_iter().zip(moved) {
                u[dof.index()] = T::from_f64(moved);
            }
        }
        let pairs = c_cnt(&sheet, &reading, &door::displaced_nodes(&sheet, &u))?;
        Ok(Found { gap: pairs.yt[1], weight: pairs.k_cnt[(4, 2)], dy: pairs.dy[1] })
    }

    /// The remedy: distance along the normal and weight by projection, over the edge length.
    fn projected<T: Scalar>(&self) -> Found<T> {
        let at = |p: [f64; 2], u: [f64; 2]| [0, 1].map(|d| T::from_f64(p[d]) + T::from_f64(u[d]));
        let [ua, ub, un] = self.moved;
        let (a, b, n) = (at(self.a, ua), at(self.b, ub), at(self.n, un));
        let ([ex, ey], [rx, ry]) = (minus(b, a), minus(n, a));
        let square = ex * ex + ey * ey;
        // The cross product over the edge length is the gap; over it once more, the gap in edge
        // lengths.
        let gap = (ry * ex - rx * ey) / square;
        let weight = T::one() - (rx * ex + ry * ey) / square;
        Found { gap, weight, dy: usize::from(Scalar::abs(gap) < T::from_f64(self.c_tll)) }
    }

    /// A triangle below the edge, and one above the contact node. Nodes 1, 2, 4 are a, b, n.
    fn scene(&self) -> SceneBuilder {
        let ([ax, ay], [bx, by], [nx, ny]) = (self.a, self.b, self.n);
        let (ex, ey) = (bx - ax, by - ay);
        let mut mesh = MeshBuilder::default();
        mesh.row([self.a, self.b, [ax + ex + ey, ay + ey - ex]]);
        mesh.row([self.n, [nx + ex - ey, ny + ey + ex], [nx - ex - ey, ny - ey + ex]]);
        mesh.edges("target", &[1, 2]);
        mesh.triangles("lower", [[1, 3, 2]]);
        mesh.triangles("upper", [[4, 5, 6]]);
        let both = &[Axis::X, Axis::Y];
        SceneBuilder::new("extreme", mesh.finish(), Plane::Strain)
            .material("lower", 4.0, 0.0)
            .material("upper", 4.0, 0.0)
            .restrain("lower", both)
            .restrain_node(5, both)
            .restrain_node(6, both)
            .contact(Contact::new(vec![4], vec![1], self.c_tll))
    }
}

fn minus<T: Scalar>([ax, ay]: [T; 2], [bx, by]: [T; 2]) -> [T; 2] {
    [ax - bx, ay - by]
}

/// What is compared of a search.
#[derive(Clone, Copy)]
pub enum Quantity {
    Gap,
    /// The weight, where the status is right.
    Weight,
    /// The status, 1 in contact and 0 apart.
    Status,
}

/// How a search is made.
#[derive(Clone, Copy, PartialEq)]
pub enum Formulas {
    /// Those of `c_cnt`.
    Printed,
    /// Projection on the edge.
    Projected,
}

/// The formulas that find a quantity, each with what they call it; the remedy has no status of its own.
pub fn formulas(of: Quantity) -> Vec<(Formulas, &'static str)> {
    match of {
        Quantity::Gap => vec![(Formulas::Printed, "yt"), (Formulas::Projected, "normal gap")],
        Quantity::Weight => {
            vec![(Formulas::Printed, "weight"), (Formulas::Projected, "projected weight")]
        }
        Quantity::Status => vec![(Formulas::Printed, "status")],
    }
}

/// Searches in `T`, and compares with the same formulas in exact numbers.
pub fn judge<T: Scalar>(search: Search, by: Formulas, of: Quantity) -> Result<Verdict, Error> {
    scope(|| {
        let (found, exact) = match by {
            Formulas::Printed => (search.printed::<T>()?, search.printed::<Exact>()),
            Formulas::Projected => (search.projected::<T>(), Ok(search.projected())),
        };
        Ok(exact.map_or(Verdict::Wrong("exact refuses"), |exact| found.against(&exact, of)))
    })
}

impl<T: Scalar> Found<T> {
    fn against(&self, exact: &Found<Exact>, of: Quantity) -> Verdict {
        let error = |x: T, y: Exact| match (x.to_rational(), y.to_rational()) {
            (Some(x), Some(y)) => Verdict::of_error((x - y).to_f64().value().abs()),
            _ => Verdict::of_error(f64::NAN),
        };
        match of {
            Quantity::Gap => error(self.gap, exact.gap),
            Quantity::Weight if self.dy == exact.dy => error(self.weight, exact.weight),
            Quantity::Weight | Quantity::Status => Verdict::of_status(self.dy == exact.dy),
        }
    }
}
