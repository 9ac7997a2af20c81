//! The condensed bodies in terms of the gaps and slips of contact nodes: what no contact state holds is
//! eliminated once, and a state is a small matrix on the gaps and slips that it leaves free.
//!
//! ```text
//!   u_i = g n + s t + Σ w_ij u_j     at a contact node i that faces the nodes j
//!   u = M y                          y: all else, then gaps g, and with friction slips s
//!   Tᵀ S T                           Mᵀ S M without what a state holds; T the columns of M that are left
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::schur::{Condensation, holds};
use super::state::{Row, Rows};
use crate::contact::{Pairing, STEEP};
use crate::elimination::{Constraint, Motion};
use numbers::solve::{DenseCholesky, DenseCondensed, Factors};
use problem::model::{Dof, NodeId};

/// The condensed bodies in terms of gaps and slips.
pub struct Gaps {
    candidates: BTreeMap<NodeId, Candidate>,
    /// M, a row for each kept equation.
    m: Rows,
    /// Mᵀ S M condensed to the gaps and slips.
    condensed: DenseCondensed,
    /// The diagonal of Mᵀ S M at the gaps and slips.
    diagonal: DVector<f64>,
}

/// A contact node whose gap, or gap and slip, a state may hold.
struct Candidate {
    pairing: Pairing,
    /// Their columns of M; None of a slip that no state holds.
    gap: usize,
    slip: Option<usize>,
}

/// A state: the columns of M that it leaves free, and the rest of the displacements.
pub struct FactoredGaps {
    /// The columns of M that are free.
    pub(super) t: Rows,
    /// The displacements of the kept equations where all that is free is 0, length.
    pub(super) shift: DVector<f64>,
    pub(super) factors: FreeGaps,
}

/// The factors of Mᵀ S M without what a state holds.
pub(super) struct FreeGaps {
    gaps: Arc<Gaps>,
    /// The places of those that are free among the gaps and slips.
    free: Vec<usize>,
    factors: DenseCholesky,
}

/// The motions of a contact node that its gap and slip make: both, or the gap alone, by its one free
/// degree of freedom.
#[derive(Clone, Copy)]
enum OwnMotion {
    Both,
    Along(Dof),
}

impl Gaps {
    /// Takes as unknowns the gaps of `pairings`, and where they may `stick` also their slips; None where
    /// what is left is singular or nearly so, and where a node that faces others is faced itself.
    pub fn new(
        condensation: &Condensation,
        pairings: &[Option<Pairing>],
        stick: bool,
    ) -> Option<Self> {
        let facing = candidates(condensation, pairings)?;
        let nodes: BTreeSet<NodeId> = facing.iter().map(|(pairing, _)| pairing.node).collect();
        let others = condensation.kept.iter().filter(|dof| !nodes.contains(&dof.node()));
        let column: BTreeMap<Dof, usize> = others.copied().zip(0..).collect();
        let mut columns = column.len()..;
        let mut slips = |may_be: bool| -> Vec<Option<usize>> {
            let of = |(_, own): &(_, OwnMotion)| may_be && matches!(own, OwnMotion::Both);
            facing.iter().map(|candidate| of(candidate).then(|| columns.next()).flatten()).collect()
        };
        // Slips that no state holds come before all that some state holds.
        let (loose, held) = (slips(!stick), slips(stick));
        let gaps: Vec<usize> = columns.by_ref().take(facing.len()).collect();
        let first = column.len() + loose.iter().flatten().count();
        let mut rows: BTreeMap<Dof, Vec<(usize, f64)>> =
            column.iter().map(|(dof, column)| (*dof, vec![(*column, 1.0)])).collect();
        let mut candidates = BTreeMap::new();
        for (k, (pairing, own)) in facing.into_iter().enumerate() {
            let (pairing, gap, slip) = (pairing.clone(), gaps[k], held[k]);
            rows.extend(pairing_rows(&pairing, own, gap, slip.or(loose[k]), &column));
            candidates.insert(pairing.node, Candidate { pairing, gap, slip });
        }
        let columns = first + held.iter().flatten().count() + gaps.len();
        let m = Rows { rows: rows.into_values().map(Row::from_vec).collect(), columns };
        let matrix = m.reduced(condensation.schur());
        let condensed = DenseCondensed::new(&matrix, first)?;
        let diagonal = matrix.diagonal();
        holds(condensed.first(), &diagonal.rows(0, first).into_owned()).then_some(Gaps {
            candidates,
            m,
            condensed,
            diagonal: diagonal.rows(first, columns - first).into_owned(),
        })
    }

    /// Returns the number of columns before those of gaps and slips.
    fn first(&self) -> usize {
        self.m.columns - self.diagonal.len()
    }

    /// Factors the state that `constraints` impose; None where it is singular or nearly so, and where
    /// it holds something else.
    pub fn factor(self: &Arc<Self>, constraints: &[Constraint]) -> Option<FactoredGaps> {
        let mut values = vec![None; self.m.columns];
        for constraint in constraints {
            let Candidate { pairing, gap, slip } = self.candidates.get(&constraint.node)?;
            let [nx, ny] = pairing.normal;
            if pairing.masters != constraint.masters {
                return None;
            }
            match constraint.motion {
                Motion::Along(normal, _) if normal != pairing.normal => return None,
                Motion::Along(_, shift) => values[*gap] = Some(shift),
                Motion::Both([x, y]) => {
                    values[(*slip)?] = Some(nx * y - ny * x);
                    values[*gap] = Some(nx * x + ny * y);
                }
            }
        }
        let shift = DVector::from_iterator(values.len(), values.iter().map(|v| v.unwrap_or(0.0)));
        let first = self.first();
        let free: Vec<usize> =
            (0..self.diagonal.len()).filter(|k| values[first + k].is_none()).collect();
        let mut place: Vec<Option<usize>> = (0..first).map(Some).collect();
        place.resize(values.len(), None);
        free.iter().enumerate().for_each(|(new, k)| place[first + k] = Some(first + new));
        let t = self.m.left(&place, first + free.len());
        let factors = FreeGaps::new(Arc::clone(self), free)?;
        Some(FactoredGaps { t, shift: self.m.expand(&shift), factors })
    }
}

impl FreeGaps {
    fn new(gaps: Arc<Gaps>, free: Vec<usize>) -> Option<Self> {
        let (n, schur) = (free.len(), gaps.condensed.schur());
        let matrix = DMatrix::from_fn(n, n, |i, j| schur[(free[i], free[j])]);
        let factors = DenseCholesky::new(&matrix).ok()?;
        let is_held = holds(&factors, &gaps.diagonal.select_rows(&free));
        is_held.then_some(FreeGaps { gaps, free, factors })
    }
}

impl Factors<f64> for FreeGaps {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let first = self.gaps.first();
        let mut last = DVector::zeros(self.gaps.diagonal.len());
        self.free.iter().zip(b.iter().skip(first)).for_each(|(k, b)| last[*k] = *b);
        let [z, left] = self.gaps.condensed.eliminate(b.rows(0, first).into_owned(), last.clone());
        let free = self.factors.solve(&left.select_rows(&self.free));
        last.fill(0.0);
        self.free.iter().zip(&free).for_each(|(k, x)| last[*k] = *x);
        let x = self.gaps.condensed.expand(z, &last);
        DVector::from_iterator(b.len(), x.iter().chain(&free).copied())
    }
}

/// Returns the pairings whose nodes' gaps can be unknowns; None where a node that faces others is faced
/// itself.
fn candidates<'a>(
    condensation: &Condensation,
    pairings: &'a [Option<Pairing>],
) -> Option<Vec<(&'a Pairing, OwnMotion)>> {
    let is_free = |dof: Dof| condensation.kept.binary_search(&dof).is_ok();
    let masters = |p: &'a Pairing| p.masters.iter().map(|(master, _)| *master);
    let is_kept = |p: &&Pairing| p.nodes().all(|n| condensation.keeps(n));
    let kept = pairings.iter().flatten().filter(is_kept);
    let own = |p: &'a Pairing| Some((p, own(p, p.node.dofs().map(is_free))?));
    let found: Vec<(&Pairing, OwnMotion)> = kept.filter_map(own).collect();
    let nodes: BTreeSet<NodeId> = found.iter().map(|(pairing, _)| pairing.node).collect();
    let is_faced = found.iter().any(|(p, _)| masters(p).any(|master| nodes.contains(&master)));
    (!is_faced).then_some(found)
}

/// Returns what the gap and slip of a pairing move, of whose node each degree of freedom is `free` or
/// not; None where that does not make every gap.
fn own(pairing: &Pairing, free: [bool; 2]) -> Option<OwnMotion> {
    let [x, y] = pairing.node.dofs();
    match free {
        [true, true] => Some(OwnMotion::Both),
        [true, false] if pairing.normal[0].abs() >= STEEP => Some(OwnMotion::Along(x)),
        [false, true] if pairing.normal[1].abs() >= STEEP => Some(OwnMotion::Along(y)),
        _ => None,
    }
}

/// Returns the rows of M of a pairing's node: its gap, its slip, and the motion of what it faces,
/// whose free degrees of freedom have a `column`.
fn pairing_rows(
    pairing: &Pairing,
    own: OwnMotion,
    gap: usize,
    slip: Option<usize>,
    column: &BTreeMap<Dof, usize>,
) -> Vec<(Dof, Vec<(usize, f64)>)> {
    let [nx, ny] = pairing.normal;
    let target = |weight_of: &dyn Fn(Dof) -> f64| -> Vec<(usize, f64)> {
        let dofs = pairing.masters.iter().flat_map(|(m, w)| m.dofs().map(|dof| (dof, *w)));
        dofs.filter_map(|(dof, w)| Some((*column.get(&dof)?, w * weight_of(dof))))
            .filter(|(_, w)| *w != 0.0)
            .collect()
    };
    match own {
        OwnMotion::Both => {
            let along = pairing.node.dofs().into_iter().zip([[nx, -ny], [ny, nx]]);
            along
                .map(|(dof, [n, t])| {
                    let own = [Some((gap, n)), slip.map(|slip| (slip, t))];
                    let of_dof = |other: Dof| f64::from(other.direction() == dof.direction());
                    (dof, own.into_iter().flatten().chain(target(&of_dof)).collect())
                })
                .collect()
        }
        OwnMotion::Along(dof) => {
            let n = pairing.normal[dof.direction()];
            let along = |other: Dof| pairing.normal[other.direction()] / n;
            vec![(dof, std::iter::once((gap, 1.0 / n)).chain(target(&along)).collect())]
        }
    }
}
