//! The stiffness condensed to the nodes that contact can bind. The bodies are factored once; each
//! contact state Tᵀ K T is solved on these nodes alone.
//!
//! ```text
//!   K --Factored--> S on the surfaces --Condensation--> S on the kept nodes --T of a state--> Tᵀ S T, dense
//! ```
//!
//! Kept are all nodes of small surfaces, else those that a state binds and their neighbours; when a
//! state binds others, the bodies are condensed anew ([`Bodies`]): small ones from their surfaces, for which
//! they are factored once, large ones from the whole. Where none of it can be done or trusted, a state has
//! no such factors: its whole matrix is to be factored.
//!
//! The search for a contact state goes on with S alone ([`KeptState`]), where it can be in terms of gaps and
//! slips, of which a state holds some: then all else is eliminated once ([`Gaps`]). Where every digit
//! counts, the factors of Tᵀ S T serve to refine the solution of the whole equations ([`WholeFactors`]).

mod gaps;
mod schur;
mod state;

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;

use nalgebra::DVector;

use crate::contact::Pairing;
use crate::elimination::{Constraint, Elimination};
use crate::session::Session;
use crate::stiffness::Stiffness;
pub use gaps::Gaps;
use problem::model::{Model, NodeId};
use schur::surfaces;
pub use schur::{Condensation, Eliminated, Factored, few_surfaces};
pub(crate) use state::refined;
pub use state::{Interior, KeptState, WholeFactors, refine};

/// The number of nodes of both surfaces up to which all are kept.
const SMALL: usize = 64;

/// The number of kept nodes beyond which a dense matrix of them takes longer, and more memory, than
/// the whole sparse matrix of a state: this many, or on fine meshes so much of the square root of the
/// number of equations, which is what a line across the mesh has.
const MOST: (f64, f64) = (600.0, 2.0);

/// The number of contact nodes of larger surfaces that are expected to come into contact, over the
/// square root of the number of equations; of fewer equations than these, those that the first contact
/// state binds.
const EXPECTED: (f64, usize) = (0.85, 10_000);

/// The number of neighbours that are kept on either side of a bound node of a larger surface, and
/// the part of the number of bound nodes that comes on top.
const MARGIN: (usize, f64) = (8, 0.1);

/// The bodies of a run, condensed when a contact state first needs it.
pub struct Bodies {
    model: Arc<Model>,
    session: Session,
    /// The contact surface and the nodes of the target surface, each in its order.
    surfaces: [Vec<NodeId>; 2],
    current: RefCell<Option<Arc<Condensation>>>,
    /// What each contact node faces in every state, and whether states hold slips too; None where that
    /// is not known.
    facing: Option<(Vec<Option<Pairing>>, bool)>,
    /// The condensed bodies in terms of gaps and slips, once that was tried; None where they cannot be.
    gaps: RefCell<Option<Option<Arc<Gaps>>>>,
    /// The load that was eliminated last.
    loaded: RefCell<Option<Loaded>>,
    /// The nodes to keep for the first contact state of large surfaces, beside those that it binds, the
    /// nearest first; none afterwards.
    expected: RefCell<Vec<NodeId>>,
    /// Whether they cannot be, or need not, as there is no contact.
    impossible: Cell<bool>,
}

/// A load by degree of freedom, force, and what is left of it on the kept equations.
struct Loaded {
    condensation: Arc<Condensation>,
    load: DVector<f64>,
    eliminated: Rc<Eliminated>,
}

/// Returns the number of equations to which the bodies are condensed where `near` contact nodes come
/// to the target: an estimate where the surfaces are large.
pub fn kept_equations(model: &Model, near: usize) -> usize {
    let surfaces = surfaces(model).concat();
    let nodes: BTreeSet<NodeId> = surfaces.iter().copied().collect();
    let free = |node: &NodeId| model.restraints_of(*node).iter().filter(|held| !**held).count();
    let all = nodes.iter().map(free).sum();
    let (neighbours, part) = MARGIN;
    let bound = (near as f64 * (1.0 + part)) as usize + 2 * neighbours;
    if surfaces.len() <= SMALL { all } else { all.min(4 * bound) }
}

impl Bodies {
    /// Takes the bodies of `model`, of which `session` may have factors.
    pub fn new(model: &Arc<Model>, session: &Session) -> Self {
        Bodies {
            model: Arc::clone(model),
            session: session.clone(),
            surfaces: surfaces(model),
            current: RefCell::default(),
            facing: None,
            gaps: RefCell::default(),
            loaded: RefCell::default(),
            expected: RefCell::default(),
            impossible: Cell::new(!model.has_contact()),
        }
    }

    /// Expects that the entries of the contact surface with the least gaps come into contact; of few
    /// equations, those that the first state binds.
    pub fn expecting(self, pairings: &[Option<Pairing>]) -> Self {
        let (part, least) = EXPECTED;
        let equations = self.model.free_dofs();
        if equations < least {
            return self;
        }
        let mut nearest: Vec<&Pairing> = pairings.iter().flatten().collect();
        nearest.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        let most = part * (equations as f64).sqrt();
        let nearest = nearest.into_iter().take(most as usize);
        self.expected.replace(nearest.flat_map(Pairing::nodes).collect());
        self
    }

    /// Takes it that in every state the contact nodes face what they do in `pairings`; whether states
    /// hold slips too.
    pub fn with_gaps(self, pairings: &[Option<Pairing>], stick: bool) -> Self {
        Bodies { facing: Some((pairings.to_vec(), stick)), ..self }
    }

    /// Factors the contact state that `constraints` impose on the condensed bodies; None where the
    /// whole matrix is to be factored.
    pub fn state(&self, stiffness: &Stiffness, constraints: &[Constraint]) -> Option<KeptState> {
        let condensation = self.condensed(stiffness, constraints)?;
        let gaps = self.facing.as_ref().and_then(|(pairings, stick)| {
            let make = || Gaps::new(&condensation, pairings, *stick).map(Arc::new);
            self.gaps.borrow_mut().get_or_insert_with(make).clone()
        });
        if let Some(held) = gaps.and_then(|gaps| gaps.factor(constraints)) {
            return Some(KeptState::holding(condensation, held));
        }
        KeptState::new(condensation, constraints)
    }

    /// Factors the contact state T of the whole bodies that `constraints` impose; None where the whole
    /// matrix is to be factored.
    pub(crate) fn whole_factors(
        &self,
        stiffness: &Stiffness,
        t: &Elimination,
        constraints: &[Constraint],
    ) -> Option<WholeFactors> {
        let factors = WholeFactors::new(self.condensed(stiffness, constraints)?, t)?;
        // They are large, and the search for the state is over.
        self.gaps.take();
        Some(factors)
    }

    /// Returns the bodies condensed to the nodes of `constraints` and others; None where the whole
    /// matrix is to be factored.
    pub fn condensed(
        &self,
        stiffness: &Stiffness,
        constraints: &[Constraint],
    ) -> Option<Arc<Condensation>> {
        if self.impossible.get() {
            return None;
        }
        let current = self.current.borrow().clone().filter(|c| c.has(constraints));
        if current.is_some() {
            return current;
        }
        let mut expected = self.expected.take();
        let mut nodes = self.nodes(constraints, &expected);
        let most = MOST.0.max(MOST.1 * (self.model.free_dofs() as f64).sqrt()) as usize;
        while nodes.len() > most {
            if expected.is_empty() {
                return None;
            }
            // The nearer half.
            expected.truncate(expected.len() / 2);
            nodes = self.nodes(constraints, &expected);
        }
        self.loaded.take();
        self.gaps.take();
        self.current.take();
        let made = self.session.condensed(stiffness, &self.model, nodes);
        self.impossible.set(made.is_none());
        self.current.replace(made.clone());
        made
    }

    /// Returns what is left of a load by degree of freedom on the kept equations of a state.
    pub fn eliminated(&self, state: &KeptState, load: &DVector<f64>) -> Rc<Eliminated> {
        let condensation = &state.condensation;
        let mut last = self.loaded.borrow_mut();
        let known = last
            .take()
            .filter(|last| Arc::ptr_eq(&last.condensation, condensation) && last.load == *load);
        let loaded = known.unwrap_or_else(|| Loaded {
            condensation: Arc::clone(condensation),
            load: load.clone(),
            eliminated: Rc::new(condensation.eliminated(load)),
        });
        Rc::clone(&last.insert(loaded).eliminated)
    }

    /// Returns the nodes to which the bodies were condensed last; None where they were not.
    pub(crate) fn kept(&self) -> Option<BTreeSet<NodeId>> {
        Some(self.last()?.nodes().iter().copied().collect())
    }

    /// Returns the condensed bodies that served last; None where there are none.
    pub fn last(&self) -> Option<Arc<Condensation>> {
        self.current.borrow().clone()
    }

    /// Returns the nodes to be kept for `constraints` and for what is expected.
    fn nodes(&self, constraints: &[Constraint], expected: &[NodeId]) -> BTreeSet<NodeId> {
        let all = self.surfaces.iter().flatten().copied();
        if all.clone().count() <= SMALL {
            return all.collect();
        }
        let bound: BTreeSet<NodeId> = constraints
            .iter()
            .flat_map(Constraint::nodes)
            .chain(expected.iter().copied())
            .collect();
        let mut nodes = bound.clone();
        for surface in &self.surfaces {
            let at: Vec<usize> =
                (0..surface.len()).filter(|i| bound.contains(&surface[*i])).collect();
            let margin = MARGIN.0 + (MARGIN.1 * at.len() as f64) as usize;
            let mut done = 0;
            for i in at {
                let end = (i + margin + 1).min(surface.len());
                nodes.extend(&surface[i.saturating_sub(margin).max(done)..end]);
                done = end;
            }
        }
        nodes
    }
}
