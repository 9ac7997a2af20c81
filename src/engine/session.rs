//! What runs on the same bodies share: a session.
//!
//! # What it keeps
//! - the stiffness of the bodies;
//! - the bodies factored for some nodes ([`Factored`]), and condensed to some of those
//!   ([`Condensation`]);
//! - how much memory was found free.
//!
//! Each is looked up by everything on which it depends, so that no result depends on what else ran in
//! the session, or in which order. Of each model the last is kept, as factors of large bodies take much
//! memory.
//!
//! # How long
//! Until [`Session::release`], or until the last clone of the session is dropped. A run by
//! [`solve`](super::solve) has a session of its own.
//!
//! # Why it cannot deadlock
//! A lock is held to look something up or to store it, never while something is made, and nobody waits
//! for what another thread makes: two runs that need the same at once both make it.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::fast::condensation::{Condensation, Factored, few_surfaces};
use super::stiffness::Stiffness;
use base::error::InputError;
use base::memory;
use problem::model::{Model, NodeId};

type Nodes = BTreeSet<NodeId>;

/// What runs on the same bodies share. A clone is the same session.
#[derive(Clone, Default)]
pub struct Session(Arc<Shared>);

#[derive(Default)]
struct Shared {
    stiffness: Kept<(), Stiffness>,
    /// By the nodes for which they are factored.
    factored: Kept<Nodes, Factored>,
    /// By the same, and the kept nodes.
    condensed: Kept<[Nodes; 2], Condensation>,
    /// The most bytes that were asked for and free.
    room: Mutex<f64>,
}

/// What was made of the bodies of some models, for some nodes.
struct Kept<N, T>(Mutex<Vec<Entry<N, T>>>);

/// The model, the nodes, and what was made.
type Entry<N, T> = (Arc<Model>, N, Arc<T>);

impl<N, T> Default for Kept<N, T> {
    fn default() -> Self {
        Kept(Mutex::default())
    }
}

impl<N: PartialEq, T> Kept<N, T> {
    /// Returns what is kept of the bodies of `model` for `nodes`, or what `make` makes of them; None
    /// where that cannot be made.
    fn get_or_make(
        &self,
        model: &Arc<Model>,
        nodes: N,
        make: impl FnOnce() -> Option<T>,
    ) -> Option<Arc<T>> {
        let is_of = |kept: &Arc<Model>| Arc::ptr_eq(kept, model) || kept.has_bodies_of(model);
        let known = |all: &[Entry<N, T>]| {
            let found = all.iter().find(|kept| kept.1 == nodes && is_of(&kept.0));
            found.map(|kept| Arc::clone(&kept.2))
        };
        if let Some(known) = known(&lock(&self.0)) {
            return Some(known);
        }
        let made = Arc::new(make()?);
        let mut all = lock(&self.0);
        all.retain(|kept| !is_of(&kept.0));
        all.push((Arc::clone(model), nodes, Arc::clone(&made)));
        Some(made)
    }
}

impl Session {
    /// Releases all that is kept: the largest part of a session's memory.
    pub fn release(&self) {
        lock(&self.0.stiffness.0).clear();
        lock(&self.0.factored.0).clear();
        lock(&self.0.condensed.0).clear();
    }

    /// Checks that the mesh of `whose` equations has the `needed` bytes, unless as many were free before:
    /// what is no longer free may be what the session keeps.
    ///
    /// # Errors
    /// Says how much it needs where that is not free.
    pub(super) fn check_room(&self, needed: f64, whose: &str) -> Result<(), InputError> {
        let mut room = lock(&self.0.room);
        if needed > *room {
            memory::check_bytes(needed, "the mesh", whose, memory::FIX)?;
            *room = needed;
        }
        Ok(())
    }

    /// Returns the stiffness of the bodies of `model`.
    pub(super) fn stiffness(&self, model: &Arc<Model>) -> Arc<Stiffness> {
        let make = || Some(Stiffness::new(model, |x| x));
        self.0.stiffness.get_or_make(model, (), make).expect("it can be made of all")
    }

    /// Returns the bodies of `model` condensed to `nodes`; None where they cannot be.
    pub(super) fn condensed(
        &self,
        stiffness: &Stiffness,
        model: &Arc<Model>,
        nodes: Nodes,
    ) -> Option<Arc<Condensation>> {
        // An edited listing may bind others.
        let for_all = few_surfaces(model).filter(|surfaces| surfaces.is_superset(&nodes));
        let wide = for_all.unwrap_or_else(|| nodes.clone());
        self.0.condensed.get_or_make(model, [wide.clone(), nodes.clone()], || {
            Condensation::new(&self.factored(stiffness, model, wide)?, &nodes)
        })
    }

    /// Returns the bodies of `model` factored for `nodes`; None where they cannot be.
    fn factored(
        &self,
        stiffness: &Stiffness,
        model: &Arc<Model>,
        nodes: Nodes,
    ) -> Option<Arc<Factored>> {
        self.0
            .factored
            .get_or_make(model, nodes.clone(), || Factored::new(stiffness, model, &nodes))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
