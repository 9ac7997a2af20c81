//! The search of `c_cnt` alone: one contact node and one target edge, in a shape that displacements
//! led to.

use nalgebra::DVector;

use super::sweep::Method;
use super::verdict::Verdict;
use engine::error::Error;
use numbers::scalar::{Exact, F64x2, Scalar, scope};
use numbers::solve::ScalarName;
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

struct Difference<T> {
    /// Its gap to the edge: as printed a length, projected in edge lengths.
    gap: T,
    /// Its weight at the edge's first node.
    weight: T,
    /// Its status: 1 in contact, 0 apart.
    dy: usize,
}

impl Search {
    /// As printed: c_cnt under R5 = node_n, which takes weights from the current shape too.
    fn printed<T: Scalar>(&self) -> Result<Difference<T>, Error> {
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
        Ok(Difference { gap: pairs.yt[1], weight: pairs.k_cnt[(4, 2)], dy: pairs.dy[1] })
    }

    /// The remedy: distance along the normal and weight by projection, over the edge length, from
    /// coordinates about `origin`.
    fn projected<T: Scalar>(&self, origin: [f64; 2]) -> Difference<T> {
        let at = |p: [f64; 2], u: [f64; 2]| {
            [0, 1].map(|d| T::from_f64(p[d] - origin[d]) + T::from_f64(u[d]))
        };
        let [ua, ub, un] = self.moved;
        let (a, b, n) = (at(self.a, ua), at(self.b, ub), at(self.n, un));
        let ([ex, ey], [rx, ry]) = (minus(b, a), minus(n, a));
        let square = ex * ex + ey * ey;
        // The cross product over the edge length is the gap; over it once more, the gap in edge
        // lengths.
        let gap = (ry * ex - rx * ey) / square;
        let weight = T::one() - (rx * ex + ry * ey) / square;
        Difference { gap, weight, dy: usize::from(Scalar::abs(gap) < T::from_f64(self.c_tll)) }
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

#[derive(Clone, Copy)]
pub enum Quantity {
    Gap,
    /// The weight, where the status is right.
    Weight,
    /// The status, 1 in contact and 0 apart.
    Status,
}

pub type SearchOf = fn(f64) -> Search;

/// A search by the printed formulas in f32, f64 and f64x2.
pub fn printed(name: &str, of: Quantity, search: SearchOf) -> Vec<Method> {
    vec![
        method::<f32>(name, ScalarName::F32, of, search, None),
        method::<f64>(name, ScalarName::F64, of, search, None),
        method::<F64x2>(name, ScalarName::F64x2, of, search, None),
    ]
}

/// The same by the remedy, projection on the edge about an origin, in f32 and f64.
pub fn projected(name: &str, of: Quantity, search: SearchOf, origin: Origin) -> Vec<Method> {
    vec![
        method::<f32>(name, ScalarName::F32, of, search, Some(origin)),
        method::<f64>(name, ScalarName::F64, of, search, Some(origin)),
    ]
}

/// The origin of the coordinates of a search, length.
type Origin = fn(&Search) -> [f64; 2];

/// The printed formulas in `T`, or the projected ones about an origin, against exact ones.
fn method<T: Scalar>(
    name: &str,
    scalar: ScalarName,
    of: Quantity,
    search: SearchOf,
    origin: Option<Origin>,
) -> Method {
    Method::new(format!("{name} {scalar}"), scalar, move |x, _| {
        let search = search(x);
        scope(|| {
            let (found, exact) = match origin {
                Some(origin) => {
                    (search.projected::<T>(origin(&search)), Ok(search.projected([0.0, 0.0])))
                }
                None => (search.printed::<T>()?, search.printed::<Exact>()),
            };
            Ok(exact.map_or(Verdict::Wrong("exact refuses"), |exact| found.against(&exact, of)))
        })
    })
}

impl<T: Scalar> Difference<T> {
    fn against(&self, exact: &Difference<Exact>, of: Quantity) -> Verdict {
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
