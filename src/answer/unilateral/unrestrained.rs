//! What is said of bodies that neither contact nor restraints hold.

use super::problem::{Place, Problem, Setting};
use super::rigid;
use crate::answer::contact::{Pairing, Status};
use crate::answer::elimination::{Constraint, Elimination};
use crate::answer::error::NoEquilibrium;
use crate::error::InputError;
use crate::numbers::solve::SparseCholesky;
use crate::problem::model::{Dof, NodeId};

/// The ratio of moduli beyond which they, and not the units, make a held matrix singular.
const FAR_APART: f64 = 1e6;

impl Problem<'_> {
    pub(super) fn escapes(&self, dof: Dof) -> NoEquilibrium {
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

    pub(super) fn unrestrained(
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
}
