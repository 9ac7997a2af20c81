//! The problem of contact under one load: the scene, where its nodes face the target, and what statuses
//! impose.

use std::cell::LazyCell;
use std::sync::Arc;

use nalgebra::DVector;

use super::rigid;
use super::status::History;
use crate::contact::{
    ContactForce, InsideNode, Pairing, Sense, Status, Surfaces, Watched, contact_forces,
};
use crate::elimination::{Constraint, Motion};
use crate::linear::EliminatedLoad;
use crate::range::inside_out;
use crate::reactions::supports;
use crate::reduction::Reduction;
use crate::request::Request;
use crate::solution::{APART, Cycle, max_displacement};
use crate::stiffness::Stiffness;
use base::error::InputError;
use problem::model::{Dof, Model, NodeId};
use problem::modelling::{Coupling, Geometry};

/// The gap over the size of the scene below which it is closed.
const CLOSED: f64 = 5e-13;

/// The size of the scene over its distance from the origin below which gaps have fewer digits than
/// [`CLOSED`] asks for: four units in the last place of a coordinate over [`CLOSED`].
const RESOLVED: f64 = 4.0 * f64::EPSILON / CLOSED;

/// How much of |q| over μ p is rounding.
pub(super) const CONE: f64 = 1e-12;

/// The depth inside the other body, over the model's size, from which a node that contact watches is
/// reported: mortar closes averaged gaps, and where curved surfaces lie on each other their nodes stand
/// inside by the height of an arc.
const UNSEEN: f64 = 1e-3;

/// How deep bodies that fit exactly lie in each other where coordinates are written with six significant
/// digits, over the farthest coordinate: half a unit of the sixth digit, 5e-6, of both bodies, along both
/// axes.
const WRITTEN: f64 = 2.0 * std::f64::consts::SQRT_2 * 5e-6;

/// The height of an arc over its edge, over the span of the gaps that contact closes, beyond which pressures
/// may be far off. Errors measured of the peak pressure, over that of Hertz, Lamé, and Ciavarella, Hills and
/// Monno (1998):
///
/// | height over span | up to 0.02 | 0.04 | 0.06 | 0.10 | 0.14 | 0.25      | 0.43 | 0.83  | more        |
/// |------------------|------------|------|------|------|------|-----------|------|-------|-------------|
/// | roller on a flat | 2 %        | 1 %  | 3 %  |      | 4 %  |           |      |       |             |
/// | press fit        | 7 %        |      |      | 12 % |      |           | 43 % | 183 % |             |
/// | rounded punch    |            |      | 18 % |      |      | 5 to 28 % |      |       | 5 to 69 %   |
///
/// A roller has 0.05 with four to five edges on its whole width of contact, a punch with two on the part of
/// its rounding that is in contact. Flat surfaces have no arcs; a press fit whose nodes lie on each other has
/// no such error.
const COARSE: f64 = 0.05;

/// The coefficient of friction beyond which a node slides at a pressure that is rounding: it sticks.
const STICKS: f64 = 1e9;

/// The height of an arc over its edge, over the smallest gap, beyond which arcs on both sides may close it.
const BOTH: f64 = 0.5;

/// The scene, its stiffness, and its surfaces.
pub(super) struct Problem<'a> {
    pub(super) request: &'a Request,
    pub(super) model: &'a Arc<Model>,
    pub(super) stiffness: Stiffness,
    pub(super) surfaces: Arc<Surfaces>,
    /// The gap below which a node is closed, length.
    pub(super) closed: f64,
    /// The triangles at a restraint of the body to which contact passes its force.
    pub(super) supports: Vec<usize>,
    /// The stiffness on the contact surfaces, on which statuses are looked for; None where they are not.
    pub(super) reduction: Option<Reduction>,
    /// Coulomb's coefficient, infinite where nodes stick.
    pub(super) friction: f64,
    /// The target that each contact node faces in the initial shape.
    initial: Arc<Vec<Option<Pairing>>>,
}

/// What a step of the load starts from, and the load at its end.
pub(super) struct Setting<'a> {
    /// The load by degree of freedom, restrained ones included, force.
    pub(super) load: DVector<f64>,
    /// The part of the path that is applied; whole numbers end stages.
    pub(super) part: f64,
    /// The load on the contact surfaces; None where states are not looked for on these.
    pub(super) reduced: Option<EliminatedLoad>,
    /// Whether the equations of the whole bodies are solved, also by the factors of those on the surfaces.
    pub(super) whole: bool,
    /// The displacements from which slips count, length.
    pub(super) before: &'a DVector<f64>,
    /// The statuses from which the search starts; none at the beginning of the path.
    pub(super) statuses: Option<&'a [Status]>,
}

/// The search for a contact state in one configuration and one setting.
#[derive(Clone, Copy)]
pub(super) struct StateSearch<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) config: &'a Configuration,
    pub(super) setting: &'a Setting<'a>,
}

/// A shape and the target that each contact node faces in it.
#[derive(Clone)]
pub(super) struct Configuration {
    /// The coordinates of each node, length.
    pub(super) shape: Arc<Vec<[f64; 2]>>,
    /// The pairing of each entry of the contact surface.
    pub(super) pairings: Arc<Vec<Option<Pairing>>>,
}

/// An iteration: the statuses that were imposed, and what came of them.
#[derive(Clone)]
pub(super) struct Iteration {
    pub(super) statuses: Vec<Status>,
    /// The constraints that imposed them.
    pub(super) constraints: Vec<Constraint>,
    /// The earlier iterations with these statuses; None where they are new.
    pub(super) cycle: Option<Cycle>,
    /// What the statuses lead to.
    pub(super) solution: StateSolution,
    /// The gap of each entry afterwards, length; None where it faces nothing.
    pub(super) gaps: Vec<Option<f64>>,
    /// The largest gap of a closed node or penetration of another one afterwards, length.
    pub(super) violation: f64,
    /// Whether it was not solved for, as its contact state was solved in the same place before.
    pub(super) returned: bool,
    /// The stiffness of the springs on which the nodes stood, over that of the bodies.
    pub(super) springs: f64,
}

impl Iteration {
    /// Returns the next iteration, to which the statuses of this one return.
    pub(super) fn repeated(&self, history: &mut History) -> Self {
        let cycle = history.keep(&self.statuses);
        Iteration { cycle, returned: true, ..self.clone() }
    }
}

/// The displacements and forces under imposed statuses.
#[derive(Clone)]
pub(super) struct StateSolution {
    /// The displacements by degree of freedom, length.
    pub(super) u: DVector<f64>,
    /// The forces on each entry of the contact surface, force.
    pub(super) forces: Vec<ContactForce>,
    /// The friction of sliding nodes, force, on each degree of freedom on which it acts.
    pub(super) friction: Vec<(Dof, f64)>,
    /// K u − F on the equations that contact can bind, force: the forces of contact.
    pub(super) reaction: DVector<f64>,
    /// The relative residual of the equations that were solved.
    pub(super) residual: f64,
}

/// The equilibrium under a load.
pub(super) struct Equilibrium {
    pub(super) config: Configuration,
    pub(super) last: Iteration,
    /// The part of the step after which the first node closes that closed in it; None where none did.
    pub(super) closing: Option<f64>,
    /// What is left of the change of shape: that of the displacements at the last measurement of
    /// contact, length; 0 in the initial geometry.
    pub(super) shape_change: f64,
    /// The largest force of the springs on which it was found, over the largest of the loads and of those
    /// of contact; None where it was found without springs.
    pub(super) springs: Option<f64>,
}

/// Sees each iteration, and the place in which its contact was measured.
pub(super) type Watch<'w> = dyn FnMut(&Configuration, &Iteration) + 'w;

impl<'a> Problem<'a> {
    pub(super) fn new(request: &'a Request, model: &'a Arc<Model>) -> Result<Self, InputError> {
        let surfaces = Arc::new(Surfaces::new(model)?);
        surfaces.check_initial_penetration(model)?;
        let mut initial = surfaces.pairings(request.contact.coupling, &model.nodes);
        // Where normals stay as they are, a node in a corner has one.
        initial.iter_mut().flatten().for_each(|pairing| pairing.corner = 0.0);
        let initial = Arc::new(initial);
        let stiffness = Stiffness::new(model, |x| x);
        Ok(Problem {
            request,
            model,
            surfaces,
            closed: CLOSED * size(model),
            supports: stiffness.about(&supports(model)),
            reduction: Reduction::new(&stiffness, model, &initial),
            stiffness,
            friction: match request.contact.friction.coefficient() {
                _ if !model.has_contact() => 0.0,
                mu if mu > STICKS => f64::INFINITY,
                mu => mu,
            },
            initial,
        })
    }

    /// Returns the same problem with every node on springs of a stiffness over that of the bodies.
    pub(super) fn with_springs(&self, stiffness: f64) -> Problem<'a> {
        Problem {
            surfaces: Arc::clone(&self.surfaces),
            supports: self.supports.clone(),
            reduction: None,
            stiffness: Stiffness::on_springs(self.model, stiffness),
            initial: Arc::clone(&self.initial),
            ..*self
        }
    }

    /// Returns the load at a part of the path, restrained degrees of freedom included, force.
    pub(super) fn load(&self, part: f64) -> DVector<f64> {
        // Without friction the path is the whole load.
        if self.friction > 0.0 { self.model.load_after(part) } else { &self.model.load * part }
    }

    /// Returns the setting of a search on the contact surfaces at a part of the path.
    pub(super) fn setting<'s>(
        &self,
        part: f64,
        before: &'s DVector<f64>,
        statuses: Option<&'s [Status]>,
    ) -> Setting<'s> {
        let load = self.load(part);
        let reduced = self.reduction.as_ref().map(|reduction| reduction.eliminated(&load));
        Setting { load, part, reduced, whole: false, before, statuses }
    }

    pub(super) fn search<'s>(
        &'s self,
        config: &'s Configuration,
        setting: &'s Setting<'s>,
    ) -> StateSearch<'s> {
        StateSearch { problem: self, config, setting }
    }

    /// Returns whether contact is measured in the current shape.
    pub(super) fn is_current(&self) -> bool {
        self.request.contact.geometry.is_current()
    }

    /// Returns the target that each contact node faces: in the shape that displacements `u` lead to,
    /// or in the initial shape.
    pub(super) fn configuration(&self, u: &DVector<f64>) -> Configuration {
        let shape = self.model.shape(u);
        let pairings = match self.request.contact.geometry {
            Geometry::Current => {
                Arc::new(self.surfaces.pairings(self.request.contact.coupling, &shape))
            }
            Geometry::Initial => Arc::clone(&self.initial),
        };
        Configuration { shape: Arc::new(shape), pairings }
    }

    /// Returns the target that each contact node faces before any load.
    pub(super) fn at_rest(&self) -> Configuration {
        self.configuration(&DVector::zeros(self.model.dofs()))
    }

    /// Returns the number of stages of the path: without friction only the whole load counts.
    pub(super) fn stages(&self) -> usize {
        if self.friction > 0.0 { self.model.stages.len() } else { 1 }
    }

    /// Returns the gap of each entry after displacements `u`, along the normals of a place, length.
    pub(super) fn gaps(&self, pairings: &[Option<Pairing>], u: &DVector<f64>) -> Vec<Option<f64>> {
        pairings.iter().map(|p| Some(p.as_ref()?.gap_after(self.model, u))).collect()
    }

    /// Returns the gap of each entry before any load, length.
    pub(super) fn initial_gaps(&self) -> Vec<Option<f64>> {
        self.gaps(&self.initial, &DVector::zeros(self.model.dofs()))
    }

    /// Returns the status with which an entry closes.
    pub(super) fn closing(&self, config: &Configuration, i: usize) -> Status {
        let holds = config.pairings[i].as_ref().is_some_and(|p| self.holding(p) > 0.0);
        if holds { Status::Stick } else { Status::Slip(Sense::Free) }
    }

    /// Returns the statuses that close each entry whose gap is at most `most`, length.
    pub(super) fn closed_within(
        &self,
        config: &Configuration,
        gaps: &[Option<f64>],
        most: f64,
    ) -> Vec<Status> {
        let status = |(i, gap): (usize, &Option<f64>)| match gap {
            Some(gap) if *gap <= most => self.closing(config, i),
            Some(_) | None => Status::Open,
        };
        gaps.iter().enumerate().map(status).collect()
    }

    /// Returns the tangential over the normal force up to which a node does not slide: that of friction,
    /// whose cone in a concave corner is widened by the angle to the normals of both edges.
    pub(super) fn holding(&self, pairing: &Pairing) -> f64 {
        let friction = if self.transmits_shear(pairing) { self.friction } else { 0.0 };
        // tan (a + b), without end from a right angle on.
        let less = 1.0 - friction * pairing.corner;
        if pairing.corner == 0.0 {
            friction
        } else if less > 0.0 {
            (friction + pairing.corner) / less
        } else {
            f64::INFINITY
        }
    }

    /// Turns the normal of each node that rests in a corner to its force, as far as the normals of the edges;
    /// without friction its force has no other direction.
    pub(super) fn along_forces(&self, config: &mut Configuration, last: &mut Iteration) {
        for i in 0..last.statuses.len() {
            let force = &mut last.solution.forces[i];
            let rests = |p: &&Pairing| p.corner > 0.0 && last.statuses[i] == Status::Stick;
            let Some(pairing) = config.pairings[i].as_ref().filter(rests) else { continue };
            let (n, t, ends) = (pairing.normal, pairing.tangent(), pairing.corner);
            let slope = (force.tangent / force.normal).clamp(-ends, ends);
            let [cos, sin] = [1.0, slope].map(|x| x / slope.hypot(1.0));
            let normal = [0, 1].map(|d| cos * n[d] + sin * t[d]);
            let [p, q] = [force.normal, force.tangent];
            (force.normal, force.tangent) = (cos * p + sin * q, cos * q - sin * p);
            if !self.transmits_shear(pairing) {
                (last.statuses[i], force.tangent) = (Status::Slip(Sense::Free), 0.0);
            }
            let pairings = Arc::make_mut(&mut config.pairings);
            pairings[i].iter_mut().for_each(|pairing| pairing.normal = normal);
        }
    }

    /// Returns whether friction acts on a pairing. On a line of symmetry, which restrains the node and a node
    /// of its target along the same axis, more along the surface than across it, it does not: the normal of
    /// an end of the surface is that of its last edge, and may be inclined to that line.
    pub(super) fn transmits_shear(&self, pairing: &Pairing) -> bool {
        let across = [0, 1].map(|d| pairing.normal[1 - d].abs() > pairing.normal[d].abs());
        let on_line = |d: usize| {
            let restrained = |node| self.model.restraints_of(node)[d];
            across[d]
                && restrained(pairing.node)
                && pairing.masters.iter().any(|(master, _)| restrained(*master))
        };
        self.friction > 0.0 && !(0..2).any(on_line)
    }

    /// Returns whether restraints leave the forces of each entry undetermined, with the open nodes
    /// that touch counted as closed: they could carry a part as well.
    pub(super) fn undetermined(&self, config: &Configuration, last: &Iteration) -> Vec<bool> {
        let touching = |i: usize| match (last.statuses[i], last.gaps[i]) {
            (Status::Open, Some(gap)) if gap <= self.closed => Status::Slip(Sense::Free),
            (status, _) => status,
        };
        let statuses: Vec<Status> = (0..last.statuses.len()).map(touching).collect();
        // Whether they are determined does not depend on how large they are.
        let forces =
            contact_forces(self.model, &config.pairings, &statuses, &last.solution.reaction);
        forces.iter().map(|force| force.undetermined).collect()
    }

    /// Returns whether a node stands inside the target before any load.
    pub(super) fn overlaps(&self) -> bool {
        self.initial_gaps().iter().flatten().any(|gap| *gap < -self.closed)
    }

    /// Returns whether restraints, and the nodes that touch the target before any load, hold the bodies.
    pub(super) fn is_held_initially(&self, config: &Configuration) -> bool {
        let statuses = self.closed_within(config, &self.initial_gaps(), self.closed);
        let before = DVector::zeros(self.model.dofs());
        let setting = self.setting(0.0, &before, None);
        rigid::holds(self.model, &self.search(config, &setting).constraints(&statuses))
    }

    /// Returns the height of the arcs over the edges of curved surfaces at the nodes in contact, and how far
    /// the gaps there differ before any load, from each other and overlaps from none, length, where the one
    /// is more than [`COARSE`] of the other; where no node is in contact the height at those that face the
    /// target and the smallest gap left, where arcs on both sides may close it. None where edges meet at less
    /// than the largest strain, rad, which irons them out.
    pub(super) fn coarse_facets(&self, last: &Iteration, strain: f64) -> Option<[f64; 2]> {
        let is_apart = !last.statuses.iter().any(|status| status.is_closed());
        let gaps = if is_apart { last.gaps.clone() } else { self.initial_gaps() };
        let pairs = self.initial.iter().zip(gaps).zip(&last.statuses);
        let pairs = pairs.filter(|(_, status)| is_apart || status.is_closed());
        let (pairings, gaps): (Vec<&Pairing>, Vec<f64>) =
            pairs.filter_map(|((pairing, gap), _)| Some((pairing.as_ref()?, gap?))).unzip();
        let masters = pairings.iter().flat_map(|p| p.masters.iter().map(|(node, _)| *node));
        let nodes: Vec<NodeId> = pairings.iter().map(|p| p.node).chain(masters).collect();
        let height = self.surfaces.facet_height(&nodes, strain);
        let [least, most] = [f64::min, f64::max].map(|of| gaps.iter().copied().reduce(of));
        let (compared, part) = match is_apart {
            true => (least?, BOTH),
            false => (most?.max(0.0) - least?, COARSE),
        };
        (height > part * compared).then_some([height, compared])
    }

    /// Returns the nodes that lie inside another body in the shape reached, the deepest first: those that
    /// contact does not watch deeper than rounding and the facets of curved surfaces, the others deeper than
    /// [`UNSEEN`].
    pub(super) fn inside(&self, config: &Configuration, last: &Iteration) -> Vec<InsideNode> {
        let facing = config.pairings.iter().zip(&last.statuses);
        let facing = facing.filter_map(|(p, status)| Some((p.as_ref()?.node, status.is_closed())));
        let u = &last.solution.u;
        let shape = self.model.shape(u);
        // Displacements of the initial geometry may be too large to be drawn as a shape: a note of its own
        // says so.
        if inside_out(self.model, &shape).next().is_some() {
            return Vec::new();
        }
        let mut found = self.surfaces.inside(self.model, &shape, &facing.collect());
        let sees_target = match self.request.contact.coupling {
            Coupling::Nts => false,
            Coupling::Mortar => true,
        };
        let rounding = self.closed.max(APART * max_displacement(u));
        let written = LazyCell::new(|| self.written());
        found.retain(|inside| match inside.watched {
            Watched::Contact => inside.depth > UNSEEN * size(self.model),
            Watched::Target => !sees_target && inside.depth > UNSEEN * size(self.model),
            Watched::Not => {
                let beyond = inside.depth - inside.height - rounding;
                beyond > 0.0 && beyond > *written
            }
        });
        found
    }

    /// Returns how deep nodes lie inside other bodies in the undeformed shape as the digits of their
    /// coordinates have it, length: the deepest of those within [`WRITTEN`]. 0 where all coordinates have all
    /// their digits: no part of what the load does is taken for rounding.
    fn written(&self) -> f64 {
        let facing = self.initial.iter().flatten().map(|pairing| (pairing.node, false)).collect();
        let mut at_rest = self.surfaces.inside(self.model, &self.model.nodes, &facing);
        let within = WRITTEN * farthest(self.model);
        at_rest.retain(|inside| inside.watched == Watched::Not && inside.depth <= within);
        at_rest.first().map_or(0.0, |inside| inside.depth)
    }
}

impl StateSearch<'_> {
    /// Returns the constraints that impose statuses.
    pub(super) fn constraints(&self, statuses: &[Status]) -> Vec<Constraint> {
        let StateSearch { problem, config, setting } = self;
        let constraint = |(pairing, status): (&Option<Pairing>, &Status)| {
            let pairing = pairing.as_ref().filter(|_| status.is_closed())?;
            let closing = -pairing.opening(|n| problem.model.coordinates(n));
            let motion = match status {
                Status::Stick => {
                    let ([tx, ty], [bx, by]) =
                        (pairing.tangent(), pairing.motion(|n| n.components(setting.before)));
                    let [bx, by] = if pairing.corner > 0.0 {
                        pairing.motion(|n| problem.model.coordinates(n)).map(|x| -x)
                    } else {
                        [bx, by]
                    };
                    let kept = tx * bx + ty * by;
                    let [nx, ny] = pairing.normal;
                    Motion::Both([closing * nx + kept * tx, closing * ny + kept * ty])
                }
                Status::Open | Status::Slip(_) => Motion::Along(pairing.normal, closing),
            };
            Some(Constraint { node: pairing.node, masters: pairing.masters.clone(), motion })
        };
        config.pairings.iter().zip(statuses).filter_map(constraint).collect()
    }
}

/// Says why no equilibrium was found, and then what was tried.
pub(super) fn cause_first(cause: &str, tried: String) -> String {
    match cause.trim_start_matches("; ") {
        "" => tried,
        cause => format!("{cause}; {tried}"),
    }
}

/// Returns the larger extent of the model, or what its coordinates can resolve of it, length.
fn size(model: &Model) -> f64 {
    // A gap in the current shape is a difference of coordinates and has no digits below theirs.
    model.bounds().larger_side().max(RESOLVED * farthest(model))
}

/// Returns the coordinate that is farthest from 0, length.
fn farthest(model: &Model) -> f64 {
    let bounds = model.bounds();
    [bounds.low, bounds.high].as_flattened().iter().map(|x| x.abs()).fold(0.0, f64::max)
}
