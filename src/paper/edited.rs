//! Edited listings, executed in a run in place of the mirror.

use super::door;
use super::listings::{self, Traced, Which, settings};
use super::mirror::{Pairs, Reading, Worksheet};
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use base::error::{InputError, Result};
use mathcad::array::{Column, Table};
use mathcad::{Ended, Listing, Settings};
use numbers::scalar::Scalar;
use problem::model::Model;
use serde::Serialize;

const NOTATION: &str = "see `plane-contact guide notation`";

/// The text of a listing that stands in place of one of the paper's; it can be read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Edited {
    /// Which listing it replaces.
    pub which: Which,
    /// The file, for messages.
    pub place: String,
    /// Its text.
    pub text: String,
}

impl Edited {
    /// Checks the text of a listing.
    ///
    /// # Errors
    /// It begins with neither of the paper's headers, or cannot be read.
    pub fn new(place: &str, text: &str) -> Result<Self> {
        let text = text.trim_start_matches('\u{feff}');
        let which = Which::from_text(text).ok_or_else(|| {
            let what = "the file begins with neither c_cnt nor Km";
            InputError::new(place, what, "keep the listing's first line")
        })?;
        let read = Listing::parse(which.name(), text);
        read.map_err(|error| InputError::new(place, error.to_string(), NOTATION))?;
        Ok(Edited { which, place: place.into(), text: text.into() })
    }

    /// Returns the listing that the text is.
    pub fn listing(&self) -> Listing {
        Listing::parse(self.which.name(), &self.text).expect("it was read before")
    }
}

/// The worksheet of a run with its edited listings.
pub struct Interpreter {
    sheet: Worksheet<f64>,
    settings: Settings,
    listings: Vec<(Edited, Listing)>,
    /// The steps that the executions of the run took.
    steps: AtomicU64,
}

/// How often the limit of one execution all executions of a run may take: some 8 s on small meshes.
const EXECUTIONS: u64 = 8;

impl Interpreter {
    /// Returns the interpreter of `edited` on the tables of a model.
    pub fn new(model: &Model, reading: &Reading, edited: &[Edited]) -> Self {
        let listings = edited.iter().map(|edited| (edited.clone(), edited.listing())).collect();
        Interpreter {
            sheet: door::worksheet(model, |x| x),
            settings: settings(reading),
            listings,
            steps: AtomicU64::new(0),
        }
    }

    /// Executes the edited `c_cnt` on a shape; None where it is not edited.
    ///
    /// # Errors
    /// The listing fails, or ends with what are no contact pairs.
    pub fn c_cnt<T: Scalar>(&self, node_n: &Table<T>) -> Option<Result<Pairs<T>>> {
        let node_n = Table::from_fn(node_n.rows(), 4, |i, j| node_n[(i, j)].to_f64());
        let executed = self.execute(Which::CCnt, &self.sheet, &node_n, listings::pairs)?;
        Some(executed.and_then(|(edited, pairs)| {
            self.check(&pairs).map_err(|what| wrong(edited, what))?;
            Ok(pairs.map(T::from_f64))
        }))
    }

    /// Executes the edited `Km` on contact pairs; None where it is not edited.
    ///
    /// # Errors
    /// The listing fails, or its value is no matrix of 2R rows and columns.
    pub fn km<T: Scalar>(&self, k_cnt: &Table<T>) -> Option<Result<Table<T>>> {
        self.km_on(&self.sheet, k_cnt)
    }

    /// Does the same without contact and without restraints.
    pub fn free_stiffness<T: Scalar>(&self) -> Option<Result<Table<T>>> {
        let n = self.sheet.R();
        let free = Worksheet { S: Column::filled(2 * n, 0), ..self.sheet.clone() };
        self.km_on(&free, &Table::filled(n, 4, T::zero()))
    }

    fn km_on<T: Scalar>(
        &self,
        sheet: &Worksheet<f64>,
        k_cnt: &Table<T>,
    ) -> Option<Result<Table<T>>> {
        let k_cnt = Table::from_fn(k_cnt.rows(), 4, |i, j| k_cnt[(i, j)].to_f64());
        let executed = self.execute(Which::Km, sheet, &k_cnt, listings::matrix)?;
        Some(executed.and_then(|(edited, matrix)| {
            let (n, (rows, cols)) = (2 * sheet.R(), matrix.size());
            if (rows, cols) != (n, n) {
                return Err(wrong(edited, format!("MJS is {rows} x {cols}, not {n} x {n}")));
            }
            Ok(Table::from_fn(n, n, |i, j| T::from_f64(*matrix.at(i - 1, j - 1))))
        }))
    }

    /// Executes a listing, if it is edited, within the steps that all executions of the run may take.
    fn execute<R>(
        &self,
        which: Which,
        sheet: &Worksheet<f64>,
        argument: &Table<f64>,
        result: fn(&Listing, Ended) -> Traced<R>,
    ) -> Option<Result<(&Edited, R)>> {
        let (edited, listing) = self.listings.iter().find(|(edited, _)| edited.which == which)?;
        let (outcome, steps) =
            listings::execute(listing, &self.settings, sheet, argument.into(), None);
        let steps = steps + self.steps.fetch_add(steps, Relaxed);
        let most = EXECUTIONS * listings::steps(&self.sheet);
        Some(if steps > most {
            let what = format!("it takes more than {most} steps in all iterations");
            let fix = "ask for fewer iterations, or a shorter listing";
            Err(InputError::new(&edited.place, what, fix))
        } else {
            match outcome.and_then(|outcome| result(listing, outcome)) {
                Ok((result, _)) => Ok((edited, result)),
                Err(failure) => Err(wrong(edited, failure.to_string())),
            }
        })
    }

    /// Checks that what an edited `c_cnt` leaves are contact pairs.
    fn check(&self, pairs: &Pairs<f64>) -> Result<(), String> {
        let Worksheet { cnt, trg, .. } = &self.sheet;
        let Pairs { ct, yt, dy, k_cnt } = pairs;
        let (n, r) = (cnt.rows(), self.sheet.R());
        let is_node = |mate: f64| mate.fract() == 0.0 && (1.0..=r as f64).contains(&mate);
        for (name, rows) in [("ct", ct.rows()), ("yt", yt.rows()), ("dy", dy.rows())] {
            if rows != n {
                return Err(format!(
                    "{name} has {rows} entries, not one for each of {n} contact nodes"
                ));
            }
        }
        let (rows, cols) = (k_cnt.rows(), k_cnt.cols());
        if (rows, cols) != (r, 4) {
            return Err(format!("k_cnt is {rows} x {cols}, not {r} x 4"));
        }
        for i1 in 1..=n {
            let (ct, dy) = (ct[i1], dy[i1]);
            if ct != 0 && !trg.iter().any(|number| *number == ct) {
                return Err(format!(
                    "ct[{i1}] = {ct} is neither 0 nor the number of a target edge"
                ));
            }
            if dy > 1 || dy == 1 && ct == 0 {
                return Err(format!(
                    "dy[{i1}] = {dy}, but it is 1 or 0, and 1 only beside a target edge"
                ));
            }
            for column in [1, 3].into_iter().filter(|_| dy == 1) {
                let mate = k_cnt[(cnt[i1], column)];
                if !is_node(mate) {
                    return Err(format!("k_cnt[{},{column}] = {mate} is no node", cnt[i1]));
                }
            }
        }
        // `Km` reads them of every node, where they are > 0.
        for (node, column) in (1..=r).flat_map(|node| [(node, 1), (node, 3)]) {
            let mate = k_cnt[(node, column)];
            if mate > 0.0 && !is_node(mate) {
                return Err(format!("k_cnt[{node},{column}] = {mate} is no node"));
            }
        }
        Ok(())
    }
}

fn wrong(edited: &Edited, what: String) -> InputError {
    InputError::new(&edited.place, what, "correct the edited listing")
}
