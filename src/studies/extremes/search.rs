//! The search of `c_cnt` alone: one contact node and one target edge, in a shape that displacements
//! led to.

use nalgebra::DVector;

use super::kept::Kept;
use engine::error::Error;
use numbers::scalar::{Exact, Scalar, scope};
use paper::door;
use paper::mirror::{Reading, c_cnt};
use problem::element::Plane;
use problem::model::NodeId;
use problem::modelling::Variant;
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

impl Search {
    /// A node beside an edge of height 1 at `angle` (its tangent) from the vertical, nearer to it than the
    /// paper's c_tol. All move by a thousandth, and the edge widens by another: it keeps its angle, but not
    /// the bits of its x difference.
    pub fn at_angle(angle: f64) -> Search {
        const GAP: f64 = 7e-4;
        let a = [1.0 / 3.0, 1.0 / 7.0];
        let n = [a[0] + 0.4 * angle - GAP, a[1] + 0.4 + GAP * angle];
        let moved = [0.0, 0.37e-3, 0.148e-3].map(|part| [1.1e-3 + part * angle, -2.3e-3]);
        Search { a, b: [a[0] + angle, a[1] + 1.0], n, moved, c_tll: 10.0 }
    }

    /// A node above a sloping edge, its gap longer than the tolerance by `excess` of it.
    pub fn at_tolerance(excess: f64) -> Search {
        let c_tll = 1e-3;
        let n = [0.7, 0.7 / 3.0 + c_tll * (1.0 + excess)];
        Search { a: [0.0, 0.0], b: [3.0, 1.0], n, moved: [[0.0; 2]; 3], c_tll }
    }

    /// What `c_cnt` finds of the node: `yt`, and whether it is in contact.
    fn printed<T: Scalar>(&self) -> Result<(T, bool), Error> {
        let scene = self.scene().build()?;
        let sheet = door::worksheet(&scene.model, T::from_f64);
        let mut u = DVector::from_element(scene.model.dofs(), T::zero());
        for (moved, node) in self.moved.into_iter().zip([1, 2, 4]) {
            for (dof, moved) in NodeId::from_number(node).dofs().into_iter().zip(moved) {
                u[dof.index()] = T::from_f64(moved);
            }
        }
        let pairs = c_cnt(&sheet, &Reading::default(), &door::displaced_nodes(&sheet, &u))?;
        Ok((pairs.yt[1], pairs.dy[1] == 1))
    }

    /// The remedy: the distance along the normal, over the edge length.
    fn normal_gap<T: Scalar>(&self) -> T {
        let at = |p: [f64; 2], u: [f64; 2]| [0, 1].map(|d| T::from_f64(p[d]) + T::from_f64(u[d]));
        let [ua, ub, un] = self.moved;
        let (a, b, n) = (at(self.a, ua), at(self.b, ub), at(self.n, un));
        let [[ex, ey], [rx, ry]] = [b, n].map(|[x, y]| [x - a[0], y - a[1]]);
        // The cross product over the edge length is the gap; over it once more, the gap in edge
        // lengths.
        (ry * ex - rx * ey) / (ex * ex + ey * ey)
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
            .variant(Variant::Stepped)
            .material("lower", 4.0, 0.0)
            .material("upper", 4.0, 0.0)
            .restrain("lower", both)
            .restrain_node(5, both)
            .restrain_node(6, both)
            .contact(Contact::new(vec![4], vec![1], self.c_tll))
    }
}

/// What is compared of a search.
#[derive(Clone, Copy, Debug)]
pub enum Quantity {
    /// The vertical distance, as printed.
    Yt,
    /// The distance along the normal, which would do in its place.
    NormalGap,
    /// The status, as printed.
    Status,
}

impl Quantity {
    /// Its name in the tables.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Yt => "yt",
            Quantity::NormalGap => "normal gap",
            Quantity::Status => "status",
        }
    }

    /// Finds it in `T`, and compares with exact numbers; a status on both sides of the tolerance.
    pub fn judge<T: Scalar>(self, search: Search) -> Result<Kept, Error> {
        let refused = Kept::Wrong("exact refuses");
        scope(|| match self {
            Quantity::NormalGap => Ok(error::<T>(search.normal_gap(), search.normal_gap())),
            Quantity::Yt => {
                let (found, _) = search.printed::<T>()?;
                Ok(search.printed().map_or(refused, |(exact, _)| error(found, exact)))
            }
            Quantity::Status => {
                let mut right = true;
                // The same with a gap as far below the tolerance as this one is above it.
                let ([ax, ay], [bx, by], [nx, ny]) = (search.a, search.b, search.n);
                let line = ay + (nx - ax) * (by - ay) / (bx - ax);
                let below = Search { n: [nx, 2.0 * (line + search.c_tll) - ny], ..search };
                for search in [&search, &below] {
                    let (_, found) = search.printed::<T>()?;
                    let Ok((_, exact)) = search.printed::<Exact>() else { return Ok(refused) };
                    right &= found == exact;
                }
                Ok(Kept::of_status(right))
            }
        })
    }
}

/// What is kept of a length, without its unit.
fn error<T: Scalar>(found: T, exact: Exact) -> Kept {
    match found.to_rational().zip(exact.to_rational()) {
        Some((found, exact)) => Kept::of_error((found - exact).to_f64().value().abs()),
        None => Kept::of_error(f64::NAN),
    }
}
