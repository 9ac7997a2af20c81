//! Listing `Km` (fig. 3): the global stiffness matrix (`listings/READING.md`, section 3).
//!
//! ```text
//!            V[1]  V[2]   ...   V[6]     MJS is 2R x 2R. Equation 2n−1 is the x displacement
//!     V[1] [  x     x            x   ]   of node n, 2n its y displacement. K is added at (V, V),
//!     V[2] [  x     x            x   ]   and again, scaled by a weight, at (W, W), the equations
//!      ... [                         ]   of the mates (column 1 or 3 of c_cnt), but never at
//!     V[6] [  x     x            x   ]   (V, W) (finding K1).
//! ```

use super::failure::{Cause, Failure};
use super::reading::Reading;
use super::worksheet::Worksheet;
use mathcad::array::{Column, Square, Table};
use numbers::scalar::Scalar;
use problem::element;

/// Assembles `MJS` (2R x 2R, force/length) from the contact pairs `c_cnt` (R x 4, as `k_cnt`).
///
/// # Errors
/// An entry overflows; the error names element and line.
pub fn Km<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    c_cnt: &Table<T>,
) -> Result<Square<T>, Failure> {
    let Worksheet { EL, ind_1, S, Ae, B, E, nu, .. } = sheet;
    let (ind_1, zero, one) = (*ind_1, T::zero(), T::one());
    let D = |E: T, nu: T| element::D(sheet.plane, E, nu);
    let mut V = Column::filled(6, 0);
    let mut cx = Column::filled(6, zero);
    let mut fl;
    let mut W;

    //#  1 Km(c_cnt) :=
    //#  2 MJS ← identity(2·R)·0
    let mut MJS = Square::zeros(2 * sheet.R());
    //#  3 for n ∈ 1 .. M
    for n in 1..=sheet.M() {
        //#  4 for i1 ∈ 1 .. 3
        for i1 in 1..=3 {
            //#  5 V[2·i1−1] ← 2·EL[n,i1+ind_1−1] − 1
            V[2 * i1 - 1] = 2 * EL[(n, i1 + ind_1 - 1)] - 1;
            //#  6 V[2·i1] ← 2·EL[n,i1+ind_1−1]
            V[2 * i1] = 2 * EL[(n, i1 + ind_1 - 1)];
            // AMBIGUOUS R2: the index of the x restraint, or, as the scan prints it, that of line
            // 8.
            let odd = if reading.r2.takes_y_for_x() { 0 } else { 1 };
            //#  7 cx[2·i1−1] ← |S[2·EL[n,i1+ind_1−1] − 1] − 1|
            cx[2 * i1 - 1] = (T::from_number(S[2 * EL[(n, i1 + ind_1 - 1)] - odd]) - one).abs();
            //#  8 cx[2·i1] ← |S[2·EL[n,i1+ind_1−1]] − 1|
            cx[2 * i1] = (T::from_number(S[2 * EL[(n, i1 + ind_1 - 1)]]) - one).abs();
        }
        //#  9 K ← Ae[n]·B[n]ᵀ·D(E[n],ν[n])·B[n]
        let K = B[n].transpose() * Ae[n] * D(E[n], nu[n]) * B[n];
        for value in K.iter() {
            finite(9, n, *value)?;
        }
        let K = |i: usize, j: usize| K[(i - 1, j - 1)];
        //# 10 for i ∈ 1 .. 6
        for i in 1..=6 {
            //# 11 for j ∈ 1 .. 6
            for j in 1..=6 {
                //# 12 MJS[V[i],V[j]] ← MJS[V[i],V[j]] + K[i,j]·cx[i]·cx[j]
                MJS[(V[i], V[j])] = finite(12, n, MJS[(V[i], V[j])] + K(i, j) * cx[i] * cx[j])?;
                //# 13 MJS[V[i],V[j]] ← 1 if cx[i] = 0 ∧ cx[j] = 0 ∧ i = j
                if cx[i] == zero && cx[j] == zero && i == j {
                    MJS[(V[i], V[j])] = one;
                }
            }
        }
        //# 14 fl ← 0
        fl = zero;
        //# 15 W ← (0 0 0 0 0 0)ᵀ
        W = Column::filled(6, 0);
        //# 16 for i1 ∈ 1 .. 3
        for i1 in 1..=3 {
            //# 17 if c_cnt[EL[n,i1+ind_1−1],1] > 0
            if c_cnt[(EL[(n, i1 + ind_1 - 1)], 1)] > zero {
                //# 18 W[2·i1−1] ← 2·c_cnt[EL[n,i1+ind_1−1],1] − 1 if S[2·c_cnt[EL[n,i1+ind_1−1],1] − 1] = 0
                if S[2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 1)].index() - 1] == 0 {
                    W[2 * i1 - 1] = 2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 1)].index() - 1;
                }
                //# 19 W[2·i1] ← 2·c_cnt[EL[n,i1+ind_1−1],1] if S[2·c_cnt[EL[n,i1+ind_1−1],1]] = 0
                if S[2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 1)].index()] == 0 {
                    W[2 * i1] = 2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 1)].index();
                }
                //# 20 fl ← c_cnt[EL[n,i1+ind_1−1],2]
                fl = c_cnt[(EL[(n, i1 + ind_1 - 1)], 2)];
            }
            // AMBIGUOUS R3: collect leaves the loop here until all three nodes are in W; the others
            // add node by node.
            if reading.r3.adds_all_at_once() && i1 < 3 {
                continue;
            }
            //# 21 for i ∈ 1 .. 6 if fl ≠ 0
            for i in (1..=6).filter(|_| fl != zero) {
                //# 22 for j ∈ 1 .. 6
                for j in 1..=6 {
                    //# 23 MJS[W[i],W[j]] ← MJS[W[i],W[j]] + K[i,j]·fl if W[i] ≠ 0 ∧ W[j] ≠ 0
                    if W[i] != 0 && W[j] != 0 {
                        MJS[(W[i], W[j])] = finite(23, n, MJS[(W[i], W[j])] + K(i, j) * fl)?;
                    }
                }
            }
            //# 24 fl ← 0
            fl = zero;
            //# 25 W ← (0 0 0 0 0 0)ᵀ
            W = Column::filled(6, 0);
            // AMBIGUOUS R3: only nested runs lines 26-33 for each node of the first pair.
            if reading.r3.adds_each_alone() && i1 < 3 {
                continue;
            }
            //# 26 for i1 ∈ 1 .. 3
            for i1 in 1..=3 {
                //# 27 if c_cnt[EL[n,i1+ind_1−1],3] > 0
                if c_cnt[(EL[(n, i1 + ind_1 - 1)], 3)] > zero {
                    //# 28 W[2·i1−1] ← 2·c_cnt[EL[n,i1+ind_1−1],3] − 1 if S[2·c_cnt[EL[n,i1+ind_1−1],3] − 1] = 0
                    if S[2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 3)].index() - 1] == 0 {
                        W[2 * i1 - 1] = 2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 3)].index() - 1;
                    }
                    //# 29 W[2·i1] ← 2·c_cnt[EL[n,i1+ind_1−1],3] if S[2·c_cnt[EL[n,i1+ind_1−1],3]] = 0
                    if S[2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 3)].index()] == 0 {
                        W[2 * i1] = 2 * c_cnt[(EL[(n, i1 + ind_1 - 1)], 3)].index();
                    }
                    //# 30 fl ← c_cnt[EL[n,i1+ind_1−1],4]
                    fl = c_cnt[(EL[(n, i1 + ind_1 - 1)], 4)];
                }
                // AMBIGUOUS R3: as above.
                if reading.r3.adds_all_at_once() && i1 < 3 {
                    continue;
                }
                //# 31 for i ∈ 1 .. 6 if fl ≠ 0
                for i in (1..=6).filter(|_| fl != zero) {
                    //# 32 for j ∈ 1 .. 6
                    for j in 1..=6 {
                        //# 33 MJS[W[i],W[j]] ← MJS[W[i],W[j]] + K[i,j]·fl if W[i] ≠ 0 ∧ W[j] ≠ 0
                        if W[i] != 0 && W[j] != 0 {
                            MJS[(W[i], W[j])] = finite(33, n, MJS[(W[i], W[j])] + K(i, j) * fl)?;
                        }
                    }
                }
                // AMBIGUOUS R3: the print clears nothing here; per node and nested clear after each
                // node, as in lines 24 and 25. Under collect the element is done.
                fl = zero;
                W = Column::filled(6, 0);
            }
        }
    }
    //# 34 MJS
    Ok(MJS)
}

/// Returns `value`, unless it overflowed while element `n` was added.
fn finite<T: Scalar>(line: usize, n: usize, value: T) -> Result<T, Failure> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Failure::new("Km", line, Cause::Overflow, &[("n", &n), ("value", &value)]))
}
