//! What is said of bodies that neither contact nor restraints hold.

use nalgebra::DVector;

use super::problem::{Configuration, Problem, StateSearch};
use super::rigid::{self, BALANCED, Release};
use crate::contact::{Pairing, Status};
use crate::elimination::Constraint;
use crate::error::{Cause, NoEquilibrium};
use crate::range::{beyond_range, inside_out};
use crate::solution::Start;
use base::error::InputError;
use base::plain::six_digits;
use problem::element::Plane;
use problem::model::{BEND, Dof, NodeId};
use problem::modelling::Coupling;

/// The ratio of moduli beyond which they, and not the units, make a held matrix singular.
const FAR_APART: f64 = 1e6;

/// How often bodies that overlap are moved apart as rigid ones: in the current geometry normals turn with
/// them.
const RELEASES: usize = 20;

impl Problem<'_> {
    /// Says that nothing opposes a motion of a body as a rigid one.
    pub(super) fn escapes(&self, dof: Dof) -> NoEquilibrium {
        let (node, direction) = (self.named(dof.node()), dof.axis());
        let gaps = self.initial_gaps().into_iter().flatten();
        let least = gaps.reduce(f64::min).filter(|least| *least > self.closed);
        let apart = least.map_or(String::new(), |least| {
            format!(", whose surfaces are at least {} apart,", six_digits(least))
        });
        let what = format!(
            "the load moves {node} in {direction} with the whole body, and neither restraints nor \
             contact{apart} oppose that motion; restrain it"
        );
        NoEquilibrium { cause: self.cause(), what }
    }

    /// Returns what a motion that nothing opposes shows: in the current geometry it may be opposed in
    /// another shape.
    fn cause(&self) -> Cause {
        if self.is_current() { Cause::NotFound } else { Cause::NoneExists }
    }

    /// Checks a step of the path between two loads: in the current geometry contact has no meaning at a
    /// triangle that is turned inside out.
    ///
    /// # Errors
    /// Names the triangle that is turned inside out first, and under which load.
    pub(super) fn in_range(
        &self,
        [before, after]: [&DVector<f64>; 2],
        [from, to]: [f64; 2],
    ) -> Result<(), NoEquilibrium> {
        if !self.is_current() {
            return Ok(());
        }
        let moved = after - before;
        let shape = |part: f64| self.model.shape(&(before + &moved * part));
        let first = |part: f64| inside_out(self.model, &shape(part)).next();
        if first(1.0).is_none() {
            return Ok(());
        }
        let [_, part] = bisected([0.0, 1.0], |part| first(part).is_none());
        let triangle = first(part).expect("it was at the end of the range");
        let stages = self.stages();
        let what = format!(
            "triangle {triangle} is turned inside out under about {}, where its displacements between \
             two steps are taken to grow with the load{}",
            part_of_load(from + part * (to - from), stages),
            self.strained(after)
        );
        Err(NoEquilibrium { cause: Cause::OutOfRange, what })
    }

    /// Returns the degree of freedom that moves most where contact in a place does not oppose a motion of
    /// the bodies as rigid ones under a load; None where there is no such motion.
    pub(super) fn escape(
        &self,
        config: &Configuration,
        load: &DVector<f64>,
        friction: f64,
    ) -> Option<Dof> {
        let shape = if self.is_current() { &*config.shape } else { &self.model.nodes };
        let friction =
            |pairing: &Pairing| if self.transmits_shear(pairing) { friction } else { 0.0 };
        rigid::escape((self.model, shape), &config.pairings, friction, load)
    }

    /// Says of a step of the path between two loads that friction does not hold the bodies as rigid ones:
    /// from where on, and which coefficient would. None where it can, and where that is not known.
    pub(super) fn slides(&self, u: &DVector<f64>, [from, to]: [f64; 2]) -> Option<NoEquilibrium> {
        let config = self.configuration(u);
        let free =
            |part: f64, friction: f64| self.escape(&config, &self.model.load_after(part), friction);
        let dof = free(to, self.friction)?;
        let stages = self.model.stages.len();
        let [last, _] = bisected([from, to], |part| free(part, self.friction).is_none());
        let when = if last > 0.0 {
            format!("from {} on", part_of_load(last, stages))
        } else {
            "under any part of the load".into()
        };
        if free(to, f64::INFINITY).is_some() {
            let NoEquilibrium { cause, what } = self.escapes(dof);
            return Some(NoEquilibrium { cause, what: format!("{what} ({when})") });
        }
        // What holds the loads at both ends of a stage holds those between them.
        let ends: Vec<f64> = (to.ceil() as usize..=stages).map(|stage| stage as f64).collect();
        let holds = |friction: f64| ends.iter().all(|end| free(*end, friction).is_none());
        let larger = (0..60).map(|k| self.friction * 2_f64.powi(k));
        let more = larger.take_while(|more| more.is_finite()).find(|more| holds(*more));
        let needed = more.map_or(String::new(), |more| {
            let [_, least] = bisected([more, more / 2.0], holds);
            // Rounded up, but for what bisection leaves open.
            let least = (1000.0 * least * (1.0 - 2e-6)).ceil() / 1000.0;
            format!("; it needs a coefficient of {least}")
        });
        let body = self.model.body_of(dof.node());
        let body = body.map_or("a body".into(), |body| format!("body {:?}", body.name));
        let what =
            format!("friction cannot hold the load: {body} slides as a whole {when}{needed}");
        Some(NoEquilibrium { cause: self.cause(), what })
    }

    /// Returns the displacements with which bodies that overlap, and that contact alone keeps in place, come
    /// to touch as rigid ones, before any load, and how; None where restraints or other contacts press them
    /// together.
    ///
    /// # Errors
    /// They come apart in several ways, the load presses them together in none, and friction counts from there.
    pub(super) fn released(&self) -> Result<Option<(Start, DVector<f64>)>, NoEquilibrium> {
        let (mut start, mut u) = (Start::Released, DVector::zeros(self.model.dofs()));
        // Beyond the shortest edge a node faces another one.
        let lengths =
            self.surfaces.edges(&self.model.nodes).into_iter().map(|(_, _, length)| length);
        let reach = lengths.fold(f64::INFINITY, f64::min);
        for _ in 0..RELEASES {
            let config = self.configuration(&u);
            let gaps = self.gaps(&config.pairings, &u);
            let facing = config.pairings.iter().zip(gaps);
            let facing: Vec<_> = facing.filter_map(|(p, gap)| p.as_ref().zip(gap)).collect();
            if facing.iter().all(|(_, gap)| *gap >= -self.closed) {
                return Ok(Some((start, u)));
            }
            let shape = if self.is_current() { &*config.shape } else { &self.model.nodes };
            match rigid::release(
                (self.model, shape),
                &facing,
                &self.load(1.0),
                [self.closed, reach],
            ) {
                None => return Ok(None),
                Some(Release::There(more)) => u += more,
                Some(Release::Unslipped(more)) => (start, u) = (Start::Unslipped, u + more),
                Some(Release::Anywhere(motion)) => return Err(self.starts_anywhere(&motion)),
            }
        }
        Ok(None)
    }

    fn starts_anywhere(&self, motion: &DVector<f64>) -> NoEquilibrium {
        let what = format!(
            "the start is not determined: before any load bodies overlap that contact alone holds, as at {}; \
             they come apart in many ways, in none the load holds them without friction or all that overlap touch \
             without slip, nor is one known to be the only one in which friction holds them, and friction counts from \
             there; restrain the body until one motion at most is free, or move it until it touches",
            self.model
                .all_dofs()
                .nth(motion.iamax())
                .map_or(String::new(), |dof| self.named(dof.node()))
        );
        NoEquilibrium { cause: Cause::Several, what }
    }

    /// Checks that without friction no round body turns in its place.
    ///
    /// # Errors
    /// Names the body, and the place about which it turns.
    pub(super) fn turns_nowhere(&self) -> Result<(), InputError> {
        if self.friction > 0.0 {
            return Ok(());
        }
        let Some((body, [x, y])) =
            rigid::turns(self.model, &self.surfaces.edges(&self.model.nodes))
        else {
            return Ok(());
        };
        let Some(how) = self.turned(body, [x, y]) else {
            return Ok(());
        };
        let what = format!(
            "body {:?} can turn about ({}, {}): its contact surface is round and slides along itself \
             without friction, and {how}",
            self.model.bodies[body].name,
            six_digits(x),
            six_digits(y)
        );
        let fix = "restrain that motion, as at a second node, or let the surfaces rub or stick \
                   (\"friction\": \"stick\")";
        Err(InputError::new("restraints, contact.friction", what, fix))
    }

    /// Returns why a body that can turn about a place does not stay there: the whole load, which keeps its
    /// direction, turns it by its moment, or topples it, as it does more work the further the body turns; or
    /// restraints hold one node at most: several hold a body that has turned by a finite angle. None where
    /// none of these is so, to rounding.
    fn turned(&self, body: usize, centre: [f64; 2]) -> Option<&'static str> {
        let (load, body) = (self.load(1.0), &self.model.bodies[body]);
        let (mut moment, mut outwards, mut forces, mut farthest) = (0.0, 0.0, 0.0, 0.0_f64);
        let mut held = 0;
        for node in self.model.node_ids().filter(|node| body.has(*node)) {
            let ([x, y], [fx, fy]) = (self.model.coordinates(node), node.components(&load));
            let [rx, ry] = [x - centre[0], y - centre[1]];
            moment += rx * fy - ry * fx;
            outwards += rx * fx + ry * fy;
            forces += fx.hypot(fy);
            farthest = farthest.max(rx.hypot(ry));
            held += usize::from(!self.model.holds.of(node).is_empty());
        }
        let rounding = forces * farthest * BALANCED;
        if moment.abs() > rounding {
            Some("the load turns it")
        } else if outwards < -rounding {
            Some("the load topples it")
        } else if held <= 1 {
            Some("restraints hold one of its nodes at most")
        } else {
            None
        }
    }

    /// Says of two shapes between which the search goes to and fro which node makes it: one that faces edges
    /// at a corner in turn, faces the target in one of them alone, or else moves most; and what helps.
    pub(super) fn torn(&self, before: &Configuration, after: &Configuration) -> String {
        let pairs = before.pairings.iter().zip(&*after.pairings);
        let turn = |(a, b): (&Option<Pairing>, &Option<Pairing>)| {
            let (a, b) = (a.as_ref()?, b.as_ref()?);
            Some((a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1], a.node))
        };
        let sharpest = pairs.clone().filter_map(turn).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((cosine, node)) = sharpest.filter(|(cosine, _)| *cosine < BEND) else {
            let mut in_one = pairs.filter_map(|(a, b)| a.as_ref().xor(b.as_ref()));
            let moved = |node: &NodeId| {
                let [[ax, ay], [bx, by]] = [before, after].map(|c| c.shape[node.index()]);
                (ax - bx).hypot(ay - by)
            };
            let (node, why) = match in_one.next() {
                Some(pairing) => {
                    (Some(pairing.node), "faces the target in one of the last two shapes alone")
                }
                None => {
                    let most = self.model.node_ids().max_by(|a, b| moved(a).total_cmp(&moved(b)));
                    (most, "moves most between the last two shapes")
                }
            };
            let node = node.map_or(String::new(), |node| self.named(node));
            return format!("; {node} {why}; geometry initial measures contact once");
        };
        let remedy = match self.request.contact.coupling {
            Coupling::Nts => "; coupling mortar averages them, or geometry initial keeps one",
            Coupling::Mortar => "; geometry initial keeps one of them",
        };
        format!(
            "; {} faces two sides of a corner in turn, whose normals are {:.0} degrees apart, and has one \
             normal at a time{remedy}",
            self.named(node),
            cosine.clamp(-1.0, 1.0).acos().to_degrees()
        )
    }

    /// Says that displacements strain the bodies beyond small strains; no text where they do not.
    pub(super) fn strained(&self, u: &DVector<f64>) -> String {
        let words = beyond_range(self.model, &self.stiffness.states(u), u);
        words.map_or(String::new(), |words| format!("; {words}"))
    }

    /// Returns the words for a node and its body.
    fn named(&self, node: NodeId) -> String {
        let body = self.model.body_of(node);
        format!("node {node}{}", body.map_or(String::new(), |b| format!(" of body {:?}", b.name)))
    }

    pub(super) fn unrestrained(
        &self,
        pairings: &[Option<Pairing>],
        constraints: &[Constraint],
        dof: Dof,
    ) -> InputError {
        if pairings.iter().all(Option::is_none) {
            let nodes = &self.model.nodes;
            let before = self.surfaces.pairings(self.request.contact.coupling, nodes);
            let [what, fix] = match before.iter().all(Option::is_none) {
                true => [
                    "no contact node faces the target, and nothing else restrains the bodies",
                    "name surfaces that face each other; list cnt in order along its surface",
                ],
                false => [
                    "the bodies move so far that no contact node faces the target any more, and nothing else restrains \
                     them",
                    "check the units of E and of the load",
                ],
            };
            return InputError::new("contact.cnt, contact.trg", what, fix);
        }
        let (node, direction) = (dof.node(), dof.axis());
        if rigid::holds(self.model, constraints) {
            let moduli = self.model.triangles.iter().map(|triangle| triangle.material.e);
            let (least, most) =
                moduli.fold((f64::MAX, 0.0), |(l, m): (f64, f64), e| (l.min(e), m.max(e)));
            let apart = most / least;
            let ratio =
                if apart.is_finite() { format!("{apart:.0e}") } else { "more than 1e308".into() };
            let ratios = self.model.triangles.iter().map(|triangle| triangle.material.nu);
            let nu = ratios.fold(-1.0, f64::max);
            let (place, cause, fix) =
                if self.model.plane == Plane::Strain && 1.0 / (1.0 - 2.0 * nu) > FAR_APART {
                    ("materials", format!("nu = {nu} is too near 0.5"), "choose a smaller nu")
                } else {
                    let fix = "choose moduli that are closer, or restrain the stiff body itself";
                    let (place, fix) = match apart > FAR_APART {
                        true => ("materials", fix),
                        false => ("mesh, materials", "choose other units"),
                    };
                    (place, format!("the moduli are {ratio} apart"), fix)
                };
            let what = format!(
                "restraints and contact hold the bodies, but in f64 the matrix is singular at node \
                 {node}, direction {direction}; {cause}"
            );
            return InputError::new(place, what, fix);
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

impl StateSearch<'_> {
    /// Returns a node that statuses leave free to move; None where they restrain the bodies.
    pub(super) fn unrestrained_node(&self, statuses: &[Status]) -> Option<NodeId> {
        self.whole(&self.constraints(statuses)).err().map(|unheld| unheld.dof.node())
    }
}

/// Names a part of the path, to three decimals: 1.5 of two stages is half of the second.
pub(super) fn part_of_load(part: f64, stages: usize) -> String {
    let stage = part.ceil().max(1.0);
    let of_stage = (1000.0 * (part - (stage - 1.0))).floor() / 1000.0;
    match stages {
        1 => format!("{of_stage} of the load"),
        _ if of_stage == 1.0 => format!("the end of stage {stage}"),
        _ => format!("{of_stage} of stage {stage}"),
    }
}

/// Narrows a range down to 1e-6 of it, so that `holds` at the first end and does not at the second.
fn bisected([mut held, mut free]: [f64; 2], holds: impl Fn(f64) -> bool) -> [f64; 2] {
    let least = 1e-6 * (free - held).abs();
    while (free - held).abs() > least {
        let middle = (held + free) / 2.0;
        if holds(middle) { held = middle } else { free = middle }
    }
    [held, free]
}
