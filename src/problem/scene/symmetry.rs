//! Half of a scene that is its own mirror image about a vertical line.
//!
//! Mesh, materials, restraints, loads and contact surfaces must be symmetric, and no triangle may
//! lie across the line. Then the solution is symmetric too, the line moves only along itself, and
//! the half right of it, restrained in x on the line, has the same solution.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use nalgebra::DVector;

use super::Scene;
use crate::model::{
    Body, ContactSurfaces, Dof, Edge, EdgeId, Element, Force, Hold, Model, NodeId, Restraint, Row,
    Sides, Support, Triangle, TriangleId, unordered,
};

/// The largest distance of a node from its image, over the scene's size: meshes are rounded.
const PLACE: f64 = 1e-9;

/// The largest difference of a load from its image, over the largest load.
const LOAD: f64 = 1e-9;

/// The left half of a scene that is its own mirror image.
#[derive(Clone, Debug)]
pub struct Half {
    /// The half as a scene.
    pub scene: Scene,
    /// The whole scene's node for each node of the half.
    pub nodes: Vec<NodeId>,
    /// The whole scene's triangle for each triangle of the half.
    pub triangles: Vec<TriangleId>,
    /// The x coordinate of the line, length.
    pub at: f64,
}

/// Returns half of `scene`; None where it is not symmetric about a vertical line.
pub fn half(scene: &Scene) -> Option<Half> {
    let model = &scene.model;
    let (mirror, _) = symmetric(model)?;
    let right =
        |id: &TriangleId| model.triangle(*id).nodes.into_iter().all(|node| mirror.side(node) >= 0);
    let triangles: Vec<TriangleId> = model.triangle_ids().filter(right).collect();
    let nodes: BTreeSet<NodeId> =
        triangles.iter().flat_map(|id| model.triangle(*id).nodes).collect();
    let nodes: Vec<NodeId> = nodes.into_iter().collect();
    let model = Restriction::new(&mirror, &nodes, &triangles).model();
    let scene = Scene {
        name: scene.name.clone(),
        word: scene.word.clone(),
        title: scene.title.clone(),
        units: scene.units.clone(),
        model: Arc::new(model),
        iterations: scene.iterations,
        variant: scene.variant,
        contact: scene.contact,
        friction_is_missing: scene.friction_is_missing,
        coupling_is_missing: scene.coupling_is_missing,
        source: None,
    };
    Some(Half { scene, nodes, triangles, at: mirror.at })
}

/// Returns the mirror image of each node; None where the model is not symmetric about a vertical line.
pub fn images(model: &Model) -> Option<Vec<NodeId>> {
    symmetric(model).map(|(_, Images(images))| images)
}

fn symmetric(model: &Model) -> Option<(Mirror<'_>, Images)> {
    let mirror = Mirror::new(model)?;
    let images = mirror.images()?;
    let is_symmetric =
        mirror.triangles(&images) && mirror.surfaces(&images) && mirror.conditions(&images);
    is_symmetric.then_some((mirror, images))
}

/// The line about which a model may be symmetric.
struct Mirror<'a> {
    model: &'a Model,
    /// The x coordinate of the line, length.
    at: f64,
    /// The distance below which two places are the same, length.
    place: f64,
}

struct Images(Vec<NodeId>);

impl Images {
    fn image(&self, node: NodeId) -> NodeId {
        self.0[node.index()]
    }
}

impl<'a> Mirror<'a> {
    /// Finds the only possible line; None where a triangle lies across it.
    fn new(model: &'a Model) -> Option<Self> {
        let all = model.bounds();
        let mirror = Mirror { model, at: all.centre()[0], place: PLACE * all.larger_side() };
        let across = |triangle: &Triangle| {
            let sides = triangle.nodes.map(|node| mirror.side(node));
            sides.contains(&1) && sides.contains(&-1)
        };
        (!model.triangles.iter().any(across)).then_some(mirror)
    }

    /// Returns -1 for a node left of the line, 0 on it, 1 right of it.
    fn side(&self, node: NodeId) -> i32 {
        let x = self.model.coordinates(node)[0] - self.at;
        if x.abs() <= self.place { 0 } else { x.signum() as i32 }
    }

    /// Returns the distance of node `m` from the place of the image of node `n`, length.
    fn distance(&self, n: NodeId, m: NodeId) -> f64 {
        let ([nx, ny], [mx, my]) = (self.model.coordinates(n), self.model.coordinates(m));
        (2.0 * self.at - nx - mx).hypot(ny - my)
    }

    /// Returns the image of each node; None where a node has none.
    fn images(&self) -> Option<Images> {
        let cell = |x: f64| (x / (4.0 * self.place)).round() as i64;
        let mut cells: HashMap<[i64; 2], Vec<NodeId>> = HashMap::new();
        for n in self.model.node_ids().filter(|n| !self.model.is_dropped(*n)) {
            cells.entry(self.model.coordinates(n).map(cell)).or_default().push(n);
        }
        let body = |n: NodeId| self.model.bodies.iter().position(|b| b.has(n));
        let image = |n: NodeId| {
            if self.model.is_dropped(n) {
                return Some(n);
            }
            let [x, y] = self.model.coordinates(n);
            let [x, y] = [cell(2.0 * self.at - x), cell(y)];
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x + i, y + j]));
            let near = around.filter_map(|at| cells.get(&at)).flatten().copied();
            let found: Vec<NodeId> = near.filter(|&m| self.distance(n, m) <= self.place).collect();
            // Where bodies touch, two nodes are at one place: a body on the line is its own image.
            match found.as_slice() {
                [one] => Some(*one),
                several => several.iter().copied().find(|&m| body(m) == body(n)),
            }
        };
        let images = Images(self.model.node_ids().map(image).collect::<Option<_>>()?);
        let returns = |n: NodeId| images.image(images.image(n)) == n;
        self.model.node_ids().all(returns).then_some(images)
    }

    fn triangles(&self, images: &Images) -> bool {
        let key = |mut nodes: [NodeId; 3], triangle: &Triangle| {
            nodes.sort_unstable();
            (nodes, triangle.material.e.to_bits(), triangle.material.nu.to_bits())
        };
        let triangles = || self.model.triangles.iter();
        let all: HashSet<_> = triangles().map(|t| key(t.nodes, t)).collect();
        triangles().all(|t| all.contains(&key(t.nodes.map(|n| images.image(n)), t)))
    }

    fn surfaces(&self, images: &Images) -> bool {
        let contact: HashSet<NodeId> = self.model.contact.nodes.iter().copied().collect();
        let target: HashSet<[NodeId; 2]> =
            self.model.target_edges().map(|edge| unordered(edge.nodes)).collect();
        contact.iter().all(|n| contact.contains(&images.image(*n)))
            && target.iter().all(|edge| target.contains(&unordered(edge.map(|n| images.image(n)))))
    }

    fn conditions(&self, images: &Images) -> bool {
        let model = self.model;
        let same_load = |load: &DVector<f64>| {
            let near = LOAD * load.amax();
            model.node_ids().all(|n| {
                let ([nx, ny], [mx, my]) = (n.components(load), images.image(n).components(load));
                (nx + mx).abs() <= near && (ny - my).abs() <= near
            })
        };
        let of = |dof: Dof| model.restraints[dof.index()];
        let same_restraints = |n: NodeId| {
            let mut pairs = n.dofs().into_iter().zip(images.image(n).dofs());
            pairs.all(|(one, other)| match (of(one), of(other)) {
                (Restraint::Free, Restraint::Free) | (Restraint::Fixed, Restraint::Fixed) => true,
                (Restraint::Free, Restraint::Fixed) | (Restraint::Fixed, Restraint::Free) => false,
            })
        };
        model.oblique().next().is_none()
            && model.node_ids().all(same_restraints)
            && model.stages.iter().all(same_load)
    }
}

/// A half of a model, with nodes on the line restrained in x and with half of their load.
struct Restriction<'a> {
    mirror: &'a Mirror<'a>,
    nodes: &'a [NodeId],
    triangles: &'a [TriangleId],
    edges: Vec<EdgeId>,
    /// The number in the half of each node of the whole model.
    number: HashMap<NodeId, NodeId>,
}

impl<'a> Restriction<'a> {
    fn new(mirror: &'a Mirror<'a>, nodes: &'a [NodeId], triangles: &'a [TriangleId]) -> Self {
        let number: HashMap<NodeId, NodeId> =
            nodes.iter().copied().zip(NodeId::all(nodes.len())).collect();
        let whole = mirror.model;
        let inside = |id: &EdgeId| whole.edge(*id).nodes.iter().all(|n| number.contains_key(n));
        let edges = EdgeId::all(whole.edges.len()).filter(inside).collect();
        Restriction { mirror, nodes, triangles, edges, number }
    }

    fn model(&self) -> Model {
        let whole = self.mirror.model;
        let triangles: Vec<Triangle> = self.triangles.iter().map(|id| self.triangle(*id)).collect();
        let edges = whole.edges.iter().filter_map(|edge| {
            Some(Edge { nodes: self.renumbered(edge.nodes)?, number: edge.number })
        });
        let bodies = whole.bodies.iter().map(|body| self.body(body));
        let load = self.load(&whole.load);
        let force = |node: NodeId| Force::Node(node, node.components(&load));
        Model {
            nodes: self.nodes.iter().map(|n| whole.coordinates(*n)).collect(),
            sides: Sides::new(triangles.iter().map(|triangle| triangle.nodes)),
            triangles,
            edges: edges.collect(),
            restraints: self.dofs().map(|dof| self.restraint(dof)).collect(),
            supports: whole.supports.iter().map(|support| self.support(support)).collect(),
            forces: NodeId::all(self.nodes.len()).map(force).collect(),
            load,
            stages: whole.stages.iter().map(|stage| self.load(stage)).collect(),
            bodies: bodies.filter(|body| !body.triangles.is_empty()).collect(),
            contact: self.contact(),
            rows: whole.rows.iter().filter_map(|row| self.row(row)).collect(),
            dropped: Vec::new(),
            plane: whole.plane,
            thickness: whole.thickness,
            z: whole.z,
        }
    }

    fn dofs(&self) -> impl Iterator<Item = Dof> {
        self.nodes.iter().flat_map(|n| n.dofs())
    }

    fn on_line(&self, dof: Dof) -> bool {
        self.mirror.side(dof.node()) == 0
    }

    fn restraint(&self, dof: Dof) -> Restraint {
        match self.mirror.model.restraints[dof.index()] {
            Restraint::Free if dof.direction() == 0 && self.on_line(dof) => Restraint::Fixed,
            own => own,
        }
    }

    fn support(&self, whole: &Support) -> Support {
        let own = |hold: &Hold| Some(Hold { node: *self.number.get(&hold.node)?, ..*hold });
        let holds = whole.holds.iter().filter_map(own).collect();
        Support { name: whole.name.clone(), holds }
    }

    /// Returns the half of a load: of a force on the line half along it and none across it, force.
    fn load(&self, whole: &DVector<f64>) -> DVector<f64> {
        let half = |dof: Dof| match (self.on_line(dof), dof.direction()) {
            (true, 0) => 0.0,
            (true, _) => 0.5 * whole[dof.index()],
            (false, _) => whole[dof.index()],
        };
        DVector::from_iterator(2 * self.nodes.len(), self.dofs().map(half))
    }

    /// Returns nodes under their new numbers; None where one is not in the half.
    fn renumbered<const N: usize>(&self, nodes: [NodeId; N]) -> Option<[NodeId; N]> {
        let inside = nodes.iter().all(|n| self.number.contains_key(n));
        inside.then(|| nodes.map(|n| self.number[&n]))
    }

    fn triangle(&self, id: TriangleId) -> Triangle {
        let triangle = self.mirror.model.triangle(id);
        let nodes = self.renumbered(triangle.nodes).expect("the half has its triangles' nodes");
        Triangle { nodes, ..*triangle }
    }

    /// Returns a row of the mesh file in the half's numbers; None where it is outside.
    fn row(&self, row: &Row) -> Option<Row> {
        let element = match row.element {
            Element::Point(node) => Element::Point(*self.number.get(&node)?),
            Element::Edge(id) => Element::Edge(self.edge(id)?),
            Element::Triangle(id) => {
                Element::Triangle(TriangleId::new(self.triangles.binary_search(&id).ok()?))
            }
        };
        Some(Row { element, ..*row })
    }

    fn edge(&self, id: EdgeId) -> Option<EdgeId> {
        self.edges.binary_search(&id).ok().map(EdgeId::new)
    }

    fn body(&self, body: &Body) -> Body {
        let triangles = TriangleId::all(self.triangles.len()).zip(self.triangles);
        Body {
            name: body.name.clone(),
            triangles: triangles
                .filter(|(_, whole)| body.triangles.binary_search(whole).is_ok())
                .map(|(half, _)| half)
                .collect(),
            nodes: body.nodes.iter().filter_map(|n| self.number.get(n).copied()).collect(),
        }
    }

    fn contact(&self) -> ContactSurfaces {
        let whole = &self.mirror.model.contact;
        ContactSurfaces {
            nodes: whole.nodes.iter().filter_map(|n| self.number.get(n).copied()).collect(),
            target: whole.target.iter().filter_map(|id| self.edge(*id)).collect(),
            tolerance: whole.tolerance,
        }
    }
}
