//! Triangles in a polygon: a constrained Delaunay triangulation (crate `spade`) whose inner nodes
//! are placed first by size, then by angle.
//!
//! ```text
//!   .--------.        .--------.        .--------.     1. the corners alone
//!   |\     / |        |\  |   /|        |\ .|.  /|     2. circumcentres of triangles that are
//!   |  \ /   |  -->   | --o--- |  -->   | o-o--o |        larger than the size asked for
//!   | /  \   |        |/  |   \|        |/ '|'  \|     3. circumcentres of triangles with an
//!   '--------'        '--------'        '--------'        angle below ANGLE
//! ```
//!
//! References: L. P. Chew, Guaranteed-quality triangular meshes, Cornell TR 89-983, 1989;
//! J. Ruppert, J. Algorithms 18 (1995) 548-585.

use std::collections::HashSet;

use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};

use engine::contact::search::is_inside;

/// Nodes and triangles that fill a polygon.
pub struct Patch {
    /// The corners of the polygon in their order, then the nodes inside it, length.
    pub nodes: Vec<[f64; 2]>,
    /// Places of three nodes, from 0, counter-clockwise.
    pub triangles: Vec<[usize; 3]>,
}

/// The angle asked of every triangle, degrees. The method is proven to end up to 20.7, and ends in
/// practice up to 30. It is missed where a node would come too near to a side.
const ANGLE: f64 = 28.0;

/// Circumradius over target edge length above which a triangle is too large; 0.58 is that of an
/// equilateral triangle of the target edge length.
const CIRCUMRADIUS: f64 = 0.7;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Fills a polygon whose corners run counter-clockwise. Its sides are edges of the triangles; none
/// is split. `size` is the target edge length at a place, length.
///
/// # Panics
/// Sides cross, two corners are one, or a coordinate is not finite.
pub fn triangulate(polygon: &[[f64; 2]], size: impl Fn([f64; 2]) -> f64) -> Patch {
    let n = polygon.len();
    let corners = polygon.iter().map(|&[x, y]| Point2::new(x, y)).collect();
    let sides = (0..n).map(|k| [k, (k + 1) % n]).collect();
    let mut cdt = Cdt::bulk_load_cdt(corners, sides).expect("a simple polygon");
    refine_by_size(&mut cdt, polygon, size);
    let by_angle = RefinementParameters::new()
        .with_angle_limit(AngleLimit::from_deg(ANGLE))
        .with_max_additional_vertices(10 * cdt.num_vertices())
        .keep_constraint_edges()
        .exclude_outer_faces(true);
    let outside = cdt.refine(by_angle).excluded_faces;
    patch(&cdt, n, outside.iter().map(|face| face.index()).collect())
}

/// Puts a node at the circumcentre of each triangle that is too large, until there is none left
/// whose circumcentre a node may stand at.
fn refine_by_size(cdt: &mut Cdt, polygon: &[[f64; 2]], size: impl Fn([f64; 2]) -> f64) {
    let mut before = 0;
    while before < cdt.num_vertices() {
        before = cdt.num_vertices();
        let faces: Vec<_> = cdt.fixed_inner_faces().collect();
        for face in faces {
            let (centre, square) = cdt.face(face).circumcircle();
            let middle = xy(cdt.face(face).center());
            let too_large = square.sqrt() > CIRCUMRADIUS * size(middle);
            if too_large && contains(polygon, middle) && may_stand(polygon, xy(centre)) {
                cdt.insert(centre).expect("a point in the polygon");
            }
        }
    }
}

fn xy(point: Point2<f64>) -> [f64; 2] {
    [point.x, point.y]
}

/// Whether a node may stand at `p`: inside the polygon, outside the circle over each of its sides.
fn may_stand(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let in_circle =
        |[a, b]: [[f64; 2]; 2]| (a[0] - x) * (b[0] - x) + (a[1] - y) * (b[1] - y) <= 0.0;
    !sides(polygon).any(in_circle) && contains(polygon, [x, y])
}

/// Whether a point lies inside a polygon.
pub fn contains(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    is_inside(sides(polygon), p)
}

fn sides(polygon: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let n = polygon.len();
    (0..n).map(move |k| [polygon[k], polygon[(k + 1) % n]])
}

/// Returns the triangles that are not `outside`, without the nodes that only those outside have:
/// refinement may put some on the hull.
fn patch(cdt: &Cdt, corners: usize, outside: HashSet<usize>) -> Patch {
    let inside = cdt.inner_faces().filter(|face| !outside.contains(&face.fix().index()));
    let mut triangles: Vec<[usize; 3]> =
        inside.map(|face| face.vertices().map(|vertex| vertex.fix().index())).collect();
    let mut kept: Vec<usize> = (0..corners).chain(triangles.iter().flatten().copied()).collect();
    kept.sort_unstable();
    kept.dedup();
    let place = |vertex: &usize| kept.binary_search(vertex).expect("it is kept");
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = place(vertex));
    let all: Vec<[f64; 2]> = cdt.vertices().map(|vertex| xy(vertex.position())).collect();
    Patch { nodes: kept.iter().map(|&vertex| all[vertex]).collect(), triangles }
}
