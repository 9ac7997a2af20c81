//! The equilibrium under one load: statuses are imposed, and the next ones follow from the forces.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::forces::{self, Contact, Force, forces, tangent};
use super::reduced::{Elastic, Last, OnSurface, Reduced, Responds};
use super::rigid;
use super::status::{Memory, first_closed, nearest_open, next_closed};
use crate::answer::condensation::Bodies;
use crate::answer::contact::{Pairing, Sense, Status, Surfaces};
use crate::answer::elimination::{Constraint, Elimination, Motion};
use crate::answer::error::{Error, NoEquilibrium};
use crate::answer::factors::LastFactors;
use crate::answer::request::Request;
use crate::answer::solution::Cycle;
use crate::answer::stiffness::Stiffness;
use crate::answer::support::supports_of_target;
use crate::error::InputError;
use crate::numbers::solve::{Singular, SparseCholesky, SparseSymmetric};
use crate::problem::model::{Dof, Model, NodeId};
use crate::problem::modelling::{Coupling, Geometry};

/// The gap over the size of the scene below which it is closed.
const CLOSED: f64 = 5e-13;

/// The size of the scene over its distance from the origin below which gaps have fewer digits than
/// [`CLOSED`] asks for: four units in the last place of a coordinate over [`CLOSED`].
const RESOLVED: f64 = 4.0 * f64::EPSILON / CLOSED;

/// A first set of few nodes presses them far beyond the later contact: of the nodes outside it, the
/// second set takes those that penetrate by more than this part of the deepest penetration.
pub const FIRST_GROWTH: f64 = 0.9;

/// The stiffness, over the diagonal, of the springs that show how an unrestrained body moves.
const SOFT: f64 = 1e-8;

/// The number of iterations beyond one for each contact node after which the search ends.
pub const PATIENCE: usize = 100;

/// The change of the displacements, over the largest, below which a shape agrees with the one in
/// which its contact was measured.
const SETTLED: f64 = 1e-12;

/// The same where rounding lets the change shrink no further.
const STALLED: f64 = 1e-8;

/// The number of shapes in which contact is measured before the search ends.
const SHAPES: usize = 60;

/// The ratio of moduli beyond which they, and not the units, make a held matrix singular.
const FAR_APART: f64 = 1e6;

/// How much of |q| over μ p is rounding.
const CONE: f64 = 1e-12;

/// The depth of a target node inside the contact surface, over the model's size, that is reported;
/// where curved surfaces lie on each other, their nodes stand inside by the sagitta of an edge.
const UNSEEN: f64 = 1e-3;

/// The part of the largest force below which a pull is rounding.
const PULL: f64 = 1e-11;

/// The scene, its stiffness, and its surfaces.
pub(super) struct Problem<'a> {
    pub(super) request: &'a Request,
    pub(super) model: &'a Arc<Model>,
    pub(super) stiffness: Stiffness,
    pub(super) surfaces: Surfaces,
    /// The gap below which a node is closed, length.
    pub(super) closed: f64,
    /// Whether each degree of freedom is a restrained one of the target.
    pub(super) supports: Vec<bool>,
    /// Coulomb's coefficient.
    friction: f64,
    /// The friction of sliding nodes where none slides against it, by degree of freedom: 0, force.
    no_friction: Arc<DVector<f64>>,
    bodies: Bodies,
    last: Last,
}

/// What a step of the load starts from, and the load at its end.
pub(super) struct Setting<'a> {
    /// The load by degree of freedom, restrained ones included, force.
    pub(super) load: DVector<f64>,
    /// The displacements from which slips count, length.
    pub(super) before: &'a DVector<f64>,
    /// The statuses from which the search starts; none at the beginning of the path.
    pub(super) statuses: Option<&'a [Status]>,
    /// Whether equations are solved, and residuals taken, on the whole bodies.
    pub(super) whole: bool,
}

/// A shape and the target that each contact node faces in it.
pub(super) struct Place {
    /// The coordinates of each node, length.
    pub(super) shape: Arc<Vec<[f64; 2]>>,
    /// The pairing of each entry of the contact surface.
    pub(super) pairings: Vec<Option<Pairing>>,
}

/// An iteration: the statuses that were imposed, and what came of them.
pub(super) struct Iteration {
    pub(super) statuses: Vec<Status>,
    /// The constraints that imposed them.
    pub(super) constraints: Vec<Constraint>,
    /// The earlier iterations with these statuses; None where they are new.
    pub(super) cycle: Option<Cycle>,
    /// What the statuses lead to.
    pub(super) moved: Moved,
    /// The gap of each entry afterwards, length; None where it faces nothing.
    pub(super) gaps: Vec<Option<f64>>,
    /// The largest gap of a closed node or penetration of another one afterwards, length.
    pub(super) violation: f64,
}

/// The displacements and forces under imposed statuses.
pub(super) struct Moved {
    /// The displacements by degree of freedom, length.
    pub(super) u: DVector<f64>,
    /// The forces on each entry of the contact surface, force.
    pub(super) forces: Vec<Force>,
    /// The friction of sliding nodes by degree of freedom, force.
    pub(super) friction: Arc<DVector<f64>>,
    /// The largest change of a sliding node's friction over that of μ times the normal forces which
    /// causes it, as friction changes these forces in turn; 0 where no node slides against friction.
    pub(super) feedback: f64,
    /// K u − F on the equations that contact can bind, force: the forces of contact.
    pub(super) reaction: DVector<f64>,
    /// The relative residual of the equations that were solved.
    pub(super) residual: f64,
    /// Whether these were the equations of the whole bodies.
    pub(super) whole: bool,
}

/// The equilibrium under a load.
pub(super) struct Equilibrium {
    pub(super) place: Place,
    pub(super) last: Iteration,
    /// The part of the step after which the first node closes that closed in it; None where none did.
    pub(super) closing: Option<f64>,
    /// What is left of the change of shape: that of the displacements at the last measurement of
    /// contact, length; 0 in the initial geometry.
    pub(super) shape_change: f64,
}

/// The result of an attempt to solve.
pub(super) enum Solved {
    Moved(Moved),
    /// A degree of freedom without restraint, and the motion under the load on soft springs.
    Free {
        dof: Dof,
        motion: Option<DVector<f64>>,
    },
}

/// Sees each iteration, and the place in which its contact was measured.
pub(super) type Watch<'w> = dyn FnMut(&Place, &Iteration) + 'w;

impl<'a> Problem<'a> {
    pub(super) fn new(request: &'a Request, model: &'a Arc<Model>) -> Result<Self, InputError> {
        let surfaces = Surfaces::new(model)?;
        surfaces.check_initial_penetration(model)?;
        let initial = surfaces.pairings(request.contact.coupling, &model.nodes);
        Ok(Problem {
            request,
            model,
            stiffness: Stiffness::new(model, |x| x),
            surfaces,
            closed: CLOSED * size(model),
            supports: supports_of_target(model),
            friction: request.contact.friction.coefficient(),
            no_friction: Arc::new(DVector::zeros(model.dofs())),
            bodies: Bodies::new(model, &request.shared).expecting(&initial),
            last: Last::default(),
        })
    }

    /// Returns whether contact is measured in the current shape.
    pub(super) fn is_current(&self) -> bool {
        self.request.contact.geometry == Geometry::Current
    }

    /// Finds the equilibrium of a setting.
    pub(super) fn equilibrium(
        &self,
        setting: &Setting,
        watch: &mut Watch,
    ) -> Result<Equilibrium, Error> {
        let mut gaps = Vec::new();
        let mut first: Option<(Vec<Status>, Vec<Option<f64>>)> = None;
        let mut keep_first = |place: &Place, iteration: &Iteration| {
            first.get_or_insert_with(|| (iteration.statuses.clone(), iteration.gaps.clone()));
            watch(place, iteration);
        };
        let mut start = setting.statuses.map(<[Status]>::to_vec);
        let mut before: Option<(DVector<f64>, f64)> = None;
        let mut memory = Memory::default();
        for _ in 0..SHAPES {
            memory.move_on();
            let place = self.place(before.as_ref().map_or(setting.before, |(u, _)| u));
            if before.is_none() {
                gaps = self.gaps(&place, setting.before);
            }
            let last = self.settle(&place, start, setting, &mut memory, &mut keep_first)?;
            let change = match &before {
                _ if !self.is_current() => 0.0,
                Some((u, _)) => (&last.moved.u - u).amax(),
                None => f64::INFINITY,
            };
            let scale = last.moved.u.amax();
            let stalled = before.as_ref().is_some_and(|(_, old)| change > old / 2.0);
            if change <= SETTLED * scale || (stalled && change <= STALLED * scale) {
                let closing = first.and_then(|first| self.first_closing(&gaps, first, &last));
                return Ok(Equilibrium { place, last, closing, shape_change: change });
            }
            before = Some((last.moved.u, change));
            start = Some(last.statuses);
        }
        let what =
            format!("the shape did not settle when contact was measured in it {SHAPES} times");
        Err(NoEquilibrium { what }.into())
    }

    /// Solves the last contact state of an equilibrium again, on the whole bodies, unless it was
    /// solved there; where that asks for other statuses, searches on from it there.
    pub(super) fn confirmed(
        &self,
        found: Equilibrium,
        setting: &Setting,
        watch: &mut Watch,
    ) -> Result<Equilibrium, Error> {
        if found.last.moved.whole {
            return Ok(found);
        }
        let Equilibrium { place, last, closing, shape_change } = found;
        let Iteration { statuses, constraints, cycle, .. } = last;
        if let Solved::Moved(moved) = self.solve(&place, &statuses, &constraints, setting)? {
            let gaps = self.gaps(&place, &moved.u);
            let violation = violation(&gaps, &statuses);
            let last = Iteration { statuses, constraints, cycle, moved, gaps, violation };
            if self.wanted(&place, &last, setting, false) == last.statuses {
                return Ok(Equilibrium { place, last, closing, shape_change });
            }
            let setting =
                Setting { load: setting.load.clone(), statuses: Some(&last.statuses), ..*setting };
            return self.equilibrium(&setting, watch);
        }
        self.equilibrium(setting, watch)
    }

    /// Returns the part of a step after which the first node closes that closed in it, from its gaps
    /// before the step and those that the statuses before the step led to.
    fn first_closing(
        &self,
        before: &[Option<f64>],
        (statuses, after): (Vec<Status>, Vec<Option<f64>>),
        last: &Iteration,
    ) -> Option<f64> {
        let part = |i: usize| {
            let closed = statuses[i] == Status::Open && last.statuses[i].is_closed();
            let (from, to) = (before[i]?, after[i]?);
            (closed && from > self.closed && to < -self.closed).then(|| from / (from - to))
        };
        (0..statuses.len()).filter_map(part).reduce(f64::min)
    }

    /// Finds the statuses that agree with their own forces, gaps and slips in one place: by the active
    /// set, and where that finds none, by Lemke's method.
    fn settle(
        &self,
        place: &Place,
        start: Option<Vec<Status>>,
        setting: &Setting,
        memory: &mut Memory,
        watch: &mut Watch,
    ) -> Result<Iteration, Error> {
        let found = self.active_set(place, start, setting, memory, watch);
        let Err(Error::Equilibrium(NoEquilibrium { what })) = found else { return found };
        if self.friction == 0.0
            && let Some(dof) = rigid::escape(self.model, &place.pairings, &setting.load)
        {
            return Err(self.escapes(dof).into());
        }
        let Some(statuses) = self.complementary(place, setting) else {
            return Err(NoEquilibrium { what }.into());
        };
        memory.move_on();
        self.active_set(place, Some(statuses), setting, memory, watch)
    }

    /// Goes from statuses to those that they ask for, until they ask for themselves.
    fn active_set(
        &self,
        place: &Place,
        start: Option<Vec<Status>>,
        setting: &Setting,
        memory: &mut Memory,
        watch: &mut Watch,
    ) -> Result<Iteration, Error> {
        let mut statuses = start.unwrap_or_else(|| self.first(place, setting.before));
        let limit = PATIENCE + self.model.contact.nodes.len();
        for _ in 0..limit {
            let iteration = self.iteration(place, statuses, setting, memory)?;
            watch(place, &iteration);
            let wanted = self.wanted(place, &iteration, setting, memory.iterations == 1);
            if wanted == iteration.statuses {
                return Ok(iteration);
            }
            statuses = memory.next(&iteration.statuses, wanted);
        }
        let never_slides = match self.friction.is_infinite() {
            true => "; where no node may slide there may be none: give a finite coefficient",
            false => "",
        };
        let what = format!(
            "no contact state in equilibrium was found in {limit} iterations{}{never_slides}",
            memory.returned()
        );
        Err(NoEquilibrium { what }.into())
    }

    /// Returns the target that each contact node faces: in the shape that displacements `u` lead to,
    /// or in the initial shape.
    fn place(&self, u: &DVector<f64>) -> Place {
        let shape = self.model.shape(u);
        let measured = if self.is_current() { &shape } else { &self.model.nodes };
        let pairings = self.surfaces.pairings(self.request.contact.coupling, measured);
        Place { shape: Arc::new(shape), pairings }
    }

    /// Returns the gap of each entry after displacements `u`, along the normals of a place, length.
    pub(super) fn gaps(&self, place: &Place, u: &DVector<f64>) -> Vec<Option<f64>> {
        let gap = |p: &Pairing| p.opening(|n| self.model.at(n)) + p.opening(|n| n.of(u));
        place.pairings.iter().map(|p| p.as_ref().map(gap)).collect()
    }

    fn first(&self, place: &Place, u: &DVector<f64>) -> Vec<Status> {
        let closed = first_closed(&self.gaps(place, u), self.closed);
        let status = |i: usize| if closed[i] { self.closing(place, i) } else { Status::Open };
        (0..closed.len()).map(status).collect()
    }

    /// Returns the status with which an entry closes.
    pub(super) fn closing(&self, place: &Place, i: usize) -> Status {
        let transmits = place.pairings[i].as_ref().is_some_and(|p| self.transmits_shear(p));
        if transmits { Status::Stick } else { Status::Slip(Sense::Free) }
    }

    /// Returns whether friction acts on a pairing. On a line of symmetry, which restrains the node
    /// and a node of its target across the normal, it does not.
    fn transmits_shear(&self, pairing: &Pairing) -> bool {
        let across = [0, 1].map(|d| pairing.normal[1 - d].abs() > 1.0 - CONE);
        let on_line = |d: usize| {
            let restrained = |node| self.model.restraints_of(node)[d];
            across[d]
                && restrained(pairing.node)
                && pairing.masters.iter().any(|(master, _)| restrained(*master))
        };
        self.friction > 0.0 && !(0..2).any(on_line)
    }

    /// Returns the statuses that the forces, gaps and slips of an iteration ask for.
    fn wanted(
        &self,
        place: &Place,
        iteration: &Iteration,
        setting: &Setting,
        first: bool,
    ) -> Vec<Status> {
        let growth = first && setting.statuses.is_none();
        let deep = if growth { FIRST_GROWTH * iteration.violation } else { 0.0 }.max(self.closed);
        let rounding = CONE * iteration.moved.u.amax();
        let largest = iteration.moved.forces.iter().map(|f| f.normal).fold(0.0, f64::max);
        let status = |i: usize| {
            let (Some(pairing), Some(gap)) = (&place.pairings[i], iteration.gaps[i]) else {
                return Status::Open;
            };
            let Force { normal, tangent, undetermined } = iteration.moved.forces[i];
            match iteration.statuses[i] {
                Status::Open if gap < -deep => self.closing(place, i),
                Status::Open => Status::Open,
                _ if normal < -PULL * largest => Status::Open,
                _ if undetermined && gap > self.closed => Status::Open,
                Status::Stick if tangent.abs() > self.friction * normal * (1.0 + CONE) => {
                    Status::Slip(if tangent > 0.0 { Sense::Backward } else { Sense::Forward })
                }
                Status::Slip(sense)
                    if sense.sign() * self.slip(pairing, iteration, setting) < -rounding =>
                {
                    Status::Stick
                }
                kept => kept,
            }
        };
        (0..iteration.statuses.len()).map(status).collect()
    }

    /// Returns the least force of a node in contact, and the least friction that one that sticks has
    /// left, over the largest force; infinite where nothing is in contact.
    pub(super) fn margin(&self, iteration: &Iteration) -> f64 {
        let pairs = || iteration.statuses.iter().zip(&iteration.moved.forces);
        let largest = pairs().map(|(_, force)| force.normal.abs()).fold(0.0, f64::max);
        let left = |(status, force): (&Status, &Force)| match status {
            Status::Open => f64::INFINITY,
            Status::Stick if self.friction.is_finite() => {
                force.normal.abs().min((self.friction * force.normal - force.tangent.abs()).abs())
            }
            _ => force.normal.abs(),
        };
        pairs().map(left).fold(f64::INFINITY, f64::min) / largest
    }

    /// Returns how far a node slipped along the tangent in a step of the load, length.
    fn slip(&self, pairing: &Pairing, iteration: &Iteration, setting: &Setting) -> f64 {
        let [ux, uy] = pairing.motion(|n| n.of(&iteration.moved.u));
        let [bx, by] = pairing.motion(|n| n.of(setting.before));
        let [tx, ty] = tangent(pairing);
        tx * (ux - bx) + ty * (uy - by)
    }

    /// Imposes `statuses`, or more closed nodes where they do not restrain the bodies.
    fn iteration(
        &self,
        place: &Place,
        mut statuses: Vec<Status>,
        setting: &Setting,
        memory: &mut Memory,
    ) -> Result<Iteration, Error> {
        for (status, pairing) in statuses.iter_mut().zip(&place.pairings) {
            if pairing.is_none() {
                *status = Status::Open;
            }
        }
        let (constraints, moved) = loop {
            let constraints = self.constraints(place, &statuses, setting);
            match self.solve(place, &statuses, &constraints, setting)? {
                Solved::Moved(moved) => break (constraints, moved),
                Solved::Free { dof, motion } => {
                    if !self.restrain_more(place, &mut statuses, setting, motion) {
                        return Err(self.unrestrained(&place.pairings, &constraints, dof).into());
                    }
                }
            }
        };
        let gaps = self.gaps(place, &moved.u);
        let cycle = memory.keep(&statuses);
        let violation = violation(&gaps, &statuses);
        Ok(Iteration { statuses, constraints, cycle, moved, gaps, violation })
    }

    /// Closes more nodes, or lets one stick; false where there is none.
    fn restrain_more(
        &self,
        place: &Place,
        statuses: &mut [Status],
        setting: &Setting,
        motion: Option<DVector<f64>>,
    ) -> bool {
        let gaps = self.gaps(place, setting.before);
        let first = motion.and_then(|u| next_closed(statuses, &gaps, &place.pairings, &u));
        let more = first.map_or_else(|| nearest_open(statuses, &gaps), |i| vec![i]);
        more.iter().for_each(|&i| statuses[i] = self.closing(place, i));
        if !more.is_empty() {
            return true;
        }
        let slides = |status: &&mut Status| matches!(status, Status::Slip(s) if s.sign() != 0.0);
        statuses.iter_mut().find(slides).map(|status| *status = Status::Stick).is_some()
    }

    /// Solves for the displacements and forces under imposed statuses.
    pub(super) fn solve(
        &self,
        place: &Place,
        statuses: &[Status],
        constraints: &[Constraint],
        setting: &Setting,
    ) -> Result<Solved, Error> {
        let load = &setting.load;
        if !setting.whole
            && let Some(surface) = OnSurface::new(self.elastic(), constraints)
            && let Ok(solved) = surface.displacements(load)
        {
            return self.moved(place, statuses, load, solved, &surface);
        }
        let t = Elimination::closing(&self.model.restrained, constraints);
        let reduced = match Reduced::new(self.elastic(), &t, constraints, statuses) {
            Ok(reduced) => reduced,
            Err(singular) => return Ok(self.free(&t, singular, load)),
        };
        match reduced.displacements(load) {
            Ok(solved) => self.moved(place, statuses, load, solved, &reduced),
            Err(singular) => Ok(self.free(&t, singular, load)),
        }
    }

    /// Adds the forces of contact, and what friction does, to the displacements.
    fn moved(
        &self,
        place: &Place,
        statuses: &[Status],
        load: &DVector<f64>,
        (u, residual): (DVector<f64>, f64),
        bodies: &dyn Responds,
    ) -> Result<Solved, Error> {
        let reaction = bodies.reaction(&u, load);
        let forces = self.forces(place, statuses, &reaction);
        let friction = Arc::clone(&self.no_friction);
        let whole = bodies.are_whole();
        let mut moved = Moved { u, forces, friction, feedback: 0.0, reaction, residual, whole };
        self.slide(place, statuses, &mut moved, bodies)?;
        Ok(Solved::Moved(moved))
    }

    /// Returns the factors that were made last.
    pub(super) fn last_factors(&self) -> LastFactors {
        match (self.last.made(), self.bodies.last()) {
            (Some(whole), _) => LastFactors::Whole(whole),
            (None, Some(condensed)) => LastFactors::Condensed(condensed),
            (None, None) => LastFactors::Unknown,
        }
    }

    fn elastic(&self) -> Elastic<'_> {
        let Problem { model, stiffness, bodies, last, .. } = self;
        Elastic { model, stiffness, bodies, last }
    }

    fn free(&self, t: &Elimination, singular: Singular, load: &DVector<f64>) -> Solved {
        let motion = free_motion(t, &self.stiffness.reduced(t), &self.model.free_part(load));
        Solved::Free { dof: t.dof(singular.column), motion }
    }

    /// Adds the friction of sliding nodes, whose size is μ times the normal forces that it leads to.
    ///
    /// # Errors
    /// No size of the friction agrees with its normal forces.
    fn slide(
        &self,
        place: &Place,
        statuses: &[Status],
        moved: &mut Moved,
        bodies: &dyn Responds,
    ) -> Result<(), NoEquilibrium> {
        let sliding: Vec<(usize, f64, &Pairing)> = (0..statuses.len())
            .filter_map(|i| match statuses[i] {
                Status::Slip(sense) if sense.sign() != 0.0 => {
                    Some((i, sense.sign(), place.pairings[i].as_ref()?))
                }
                _ => None,
            })
            .collect();
        if sliding.is_empty() {
            return Ok(());
        }
        let unit = Force { tangent: 1.0, ..Force::default() };
        let response = |(_, _, pairing): &(usize, f64, &Pairing)| {
            let mut load = DVector::zeros(moved.u.len());
            forces::add(pairing, unit, 1.0, &mut load);
            let reaction = bodies.response(&load)?;
            Ok((load, reaction))
        };
        let responses: Result<Vec<_>, Singular> = sliding.iter().map(response).collect();
        let responses = responses.map_err(|_| jammed())?;
        let n = sliding.len();
        let mut matrix = DMatrix::identity(n, n);
        for (column, (_, reaction)) in responses.iter().enumerate() {
            let forces = self.forces(place, statuses, reaction);
            for (row, (i, sign, _)) in sliding.iter().enumerate() {
                matrix[(row, column)] += sign * self.friction * forces[*i].normal;
            }
        }
        let right = DVector::from_fn(n, |row, _| {
            let (i, sign, _) = sliding[row];
            -sign * self.friction * moved.forces[i].normal
        });
        let matrix = matrix.lu();
        let sizes = matrix.solve(&right).filter(|sizes| sizes.iter().all(|x| x.is_finite()));
        let sizes = sizes.ok_or_else(jammed)?;
        let rows = matrix.try_inverse().ok_or_else(jammed)?;
        moved.feedback = rows.row_iter().map(|row| row.lp_norm(1)).fold(0.0, f64::max);
        let mut friction = DVector::zeros(moved.u.len());
        for ((load, _), size) in responses.iter().zip(&sizes) {
            friction.axpy(*size, load, 1.0);
        }
        moved.friction = Arc::new(friction);
        let [u, force] = bodies.under(&moved.friction).map_err(|_| jammed())?;
        moved.reaction += force;
        moved.u += u;
        moved.forces = self.forces(place, statuses, &(&moved.reaction - &*moved.friction));
        for ((i, _, _), size) in sliding.iter().zip(&sizes) {
            moved.forces[*i].tangent = *size;
        }
        Ok(())
    }

    /// Returns the forces of all entries; 0 where an entry is open.
    fn forces(&self, place: &Place, statuses: &[Status], reaction: &DVector<f64>) -> Vec<Force> {
        let closed: Vec<usize> = (0..statuses.len())
            .filter(|&i| statuses[i].is_closed() && place.pairings[i].is_some())
            .collect();
        let contact = |i: &usize| Contact {
            pairing: place.pairings[*i].as_ref().expect("closed entries face the target"),
            sticks: statuses[*i] == Status::Stick,
        };
        let contacts: Vec<Contact> = closed.iter().map(contact).collect();
        let mut all = vec![Force::default(); statuses.len()];
        for (i, force) in closed.into_iter().zip(forces(self.model, &contacts, reaction)) {
            all[i] = force;
        }
        all
    }

    /// Returns whether restraints leave the forces of each entry undetermined, with the open nodes
    /// that touch counted as closed: they could carry a part as well.
    pub(super) fn undetermined(&self, place: &Place, last: &Iteration) -> Vec<bool> {
        let touching = |i: usize| match (last.statuses[i], last.gaps[i]) {
            (Status::Open, Some(gap)) if gap <= self.closed => Status::Slip(Sense::Free),
            (status, _) => status,
        };
        let statuses: Vec<Status> = (0..last.statuses.len()).map(touching).collect();
        let reaction = &last.moved.reaction - &*last.moved.friction;
        let forces = self.forces(place, &statuses, &reaction);
        forces.iter().map(|force| force.undetermined).collect()
    }

    /// Returns the target node that lies deepest inside the contact surface under node to segment;
    /// None where none lies deeper than [`UNSEEN`].
    pub(super) fn unseen(&self, last: &Iteration) -> Option<(NodeId, f64)> {
        if self.request.contact.coupling != Coupling::Nts {
            return None;
        }
        let deepest = self.surfaces.deepest_target_node(&self.model.shape(&last.moved.u))?;
        (deepest.1 > UNSEEN * size(self.model)).then_some(deepest)
    }

    /// Returns the constraints that impose statuses.
    pub(super) fn constraints(
        &self,
        place: &Place,
        statuses: &[Status],
        setting: &Setting,
    ) -> Vec<Constraint> {
        let constraint = |(pairing, status): (&Option<Pairing>, &Status)| {
            let pairing = pairing.as_ref().filter(|_| status.is_closed())?;
            let closing = -pairing.opening(|n| self.model.at(n));
            let motion = match status {
                Status::Stick => {
                    let ([tx, ty], [bx, by]) =
                        (tangent(pairing), pairing.motion(|n| n.of(setting.before)));
                    let kept = tx * bx + ty * by;
                    let [nx, ny] = pairing.normal;
                    Motion::Both([closing * nx + kept * tx, closing * ny + kept * ty])
                }
                _ => Motion::Along(pairing.normal, closing),
            };
            Some(Constraint { node: pairing.node, masters: pairing.masters.clone(), motion })
        };
        place.pairings.iter().zip(statuses).filter_map(constraint).collect()
    }

    /// Imposes statuses once, to see whether they are in equilibrium too; None where they are not.
    pub(super) fn try_statuses(
        &self,
        place: &Place,
        statuses: &[Status],
        setting: &Setting,
    ) -> Option<Moved> {
        let constraints = self.constraints(place, statuses, setting);
        let Ok(Solved::Moved(moved)) = self.solve(place, statuses, &constraints, setting) else {
            return None;
        };
        let gaps = self.gaps(place, &moved.u);
        let violation = violation(&gaps, statuses);
        let statuses = statuses.to_vec();
        let iteration = Iteration { statuses, constraints, cycle: None, moved, gaps, violation };
        let wanted = self.wanted(place, &iteration, setting, false);
        (wanted == iteration.statuses).then_some(iteration.moved)
    }

    /// Returns a node that statuses leave free to move; None where they restrain the bodies.
    pub(super) fn unrestrained_node(
        &self,
        place: &Place,
        statuses: &[Status],
        setting: &Setting,
    ) -> Option<NodeId> {
        let constraints = self.constraints(place, statuses, setting);
        let t = Elimination::closing(&self.model.restrained, &constraints);
        let singular = SparseCholesky::new(self.stiffness.reduced(&t)).err()?;
        Some(t.dof(singular.column).node())
    }

    /// Returns Coulomb's coefficient, infinite where nodes stick.
    pub(super) fn friction(&self) -> f64 {
        self.friction
    }

    fn escapes(&self, dof: Dof) -> NoEquilibrium {
        let (node, direction) = (self.named(dof.node()), dof.axis());
        let what = format!(
            "there is no equilibrium: the load moves {node} in {direction} with the whole body, \
             and neither restraints nor contact oppose that motion; restrain it"
        );
        NoEquilibrium { what }
    }

    /// Returns the words for a node and its body.
    fn named(&self, node: NodeId) -> String {
        let body = self.model.body_of(node);
        format!("node {node}{}", body.map_or(String::new(), |b| format!(" of body {:?}", b.name)))
    }

    fn unrestrained(
        &self,
        pairings: &[Option<Pairing>],
        constraints: &[Constraint],
        dof: Dof,
    ) -> InputError {
        if pairings.iter().all(Option::is_none) {
            let what = "no contact node faces the target, and nothing else restrains the bodies";
            let fix = "name surfaces that face each other; list cnt in order along its surface";
            return InputError::new("contact.cnt, contact.trg", what, fix);
        }
        let (node, direction) = (dof.node(), dof.axis());
        if rigid::holds(self.model, constraints) {
            let moduli = self.model.triangles.iter().map(|triangle| triangle.material.e);
            let (least, most) =
                moduli.fold((f64::MAX, 0.0), |(l, m): (f64, f64), e| (l.min(e), m.max(e)));
            let apart = most / least;
            let ratio = match apart.is_finite() {
                true => format!("{apart:.0e}"),
                false => "more than 1e308".into(),
            };
            let what = format!(
                "restraints and contact hold the bodies, but in f64 the matrix is singular at node \
                 {node}, direction {direction}; the moduli are {ratio} apart"
            );
            let fix = "choose moduli that are closer, or restrain the stiff body itself";
            return match apart > FAR_APART {
                true => InputError::new("materials", what, fix),
                false => InputError::new("mesh, materials", what, "choose other units"),
            };
        }
        let what = format!(
            "{} can move in {direction} with every contact node in contact",
            self.named(node)
        );
        let fix =
            "restrain that motion, or let the surfaces rub or stick (\"friction\": \"stick\")";
        InputError::new("restraints, contact.friction", what, fix)
    }
}

fn jammed() -> NoEquilibrium {
    let what = "the sliding nodes jam: no friction agrees with its own normal forces".into();
    NoEquilibrium { what }
}

/// Returns the largest gap of a closed node or penetration of another one, length.
fn violation(gaps: &[Option<f64>], statuses: &[Status]) -> f64 {
    let of_entry = |(gap, status): (&Option<f64>, &Status)| match gap {
        Some(gap) if status.is_closed() => gap.abs(),
        Some(gap) => (-gap).max(0.0),
        None => 0.0,
    };
    gaps.iter().zip(statuses).map(of_entry).fold(0.0, f64::max)
}

/// Returns the motion that constraints leave free where only soft springs oppose the load.
fn free_motion(t: &Elimination, k: &SparseSymmetric, load: &DVector<f64>) -> Option<DVector<f64>> {
    let q = SparseCholesky::new(k.with_diagonal(SOFT)).ok()?.solve(&t.load(load));
    Some(t.expand(&q) - t.shift())
}

/// Returns the larger extent of the model, or what its coordinates can resolve of it, length.
fn size(model: &Model) -> f64 {
    let [width, height] = [0, 1].map(|axis| {
        let values = model.nodes.iter().map(|xy| xy[axis]);
        let (least, most) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), x| (l.min(x), m.max(x)));
        most - least
    });
    // A gap in the current shape is a difference of coordinates and has no digits below theirs.
    let farthest = model.nodes.as_flattened().iter().map(|x| x.abs());
    width.max(height).max(RESOLVED * farthest.fold(0.0, f64::max))
}
