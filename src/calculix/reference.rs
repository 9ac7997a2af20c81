//! The same model by this program.

use nalgebra::{DVector, SVector};

use super::model::ContactKind;
use crate::contact::{Elimination, Outcome, free_stiffness};
use crate::element::State;
use crate::error::{Error, InputError};
use crate::mirror::Worksheet;
use crate::scene::Scene;
use crate::solve::DenseLu;

/// Displacements and stresses.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// x and y of each node, length.
    pub u: Vec<[f64; 2]>,
    /// sigma_x, sigma_y, tau_xy of each triangle, stress.
    pub sigma: Vec<[f64; 3]>,
    /// Von Mises stress of each triangle.
    pub von_mises: Vec<f64>,
}

/// What this program has beside a deck. Equations: one linear solve of the whole load with the ties of the last iteration; under
/// `tied` that is the variant's own result, under `stepped`, whose ties change from step to step, it is not. A pair: the variant's
/// own result.
///
/// # Errors
/// An overflow; a singular matrix.
pub fn reference(scene: &Scene, outcome: &Outcome, kind: ContactKind) -> Result<Fields, Error> {
    match kind {
        ContactKind::Pair => Ok(Fields::new(&outcome.sheet, &outcome.u)),
        ContactKind::Equation => Ok(Fields::new(&outcome.sheet, &with_last_ties(scene, outcome)?)),
    }
}

/// u = T (Tᵀ K T)⁻¹ Tᵀ F, T of the last iteration.
fn with_last_ties(scene: &Scene, outcome: &Outcome) -> Result<DVector<f64>, Error> {
    let last = outcome.iterations.last().expect("a run has an iteration");
    let t = Elimination::new(&outcome.sheet, &last.pairs);
    let k = free_stiffness(&outcome.sheet, &outcome.reading)?;
    let lu = DenseLu::new(t.matrix(k.as_matrix())).map_err(|singular| {
        let node = t.equation(singular.column) / 2 + 1;
        let what = format!("with the last iteration's ties the matrix is singular at node {node}");
        InputError::new("--contact equation", what, "choose --contact pair")
    })?;
    Ok(t.expand(&lu.solve(&t.load(&scene.load))))
}

impl Fields {
    /// Displacements `u` of the 2R equations and the stresses that follow from them.
    pub fn new(sheet: &Worksheet<f64>, u: &DVector<f64>) -> Self {
        let states: Vec<State> = (1..=sheet.M()).map(|n| state(sheet, u, n)).collect();
        Fields {
            u: u.as_slice().chunks(2).map(|u| [u[0], u[1]]).collect(),
            sigma: states.iter().map(|s| s.sigma.into()).collect(),
            von_mises: states.iter().map(|s| s.von_mises_stress).collect(),
        }
    }
}

fn state(sheet: &Worksheet<f64>, u: &DVector<f64>, n: usize) -> State {
    let of_element =
        SVector::<f64, 6>::from_fn(|k, _| u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2]);
    State::new(sheet.plane, sheet.E[n], sheet.nu[n], &sheet.B[n], &of_element)
}
