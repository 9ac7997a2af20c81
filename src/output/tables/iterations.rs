//! The iterations of a run, or the steps of its load.

use crate::layout::counted;
use crate::model::{Cell, Report, Table};
use crate::numbers::{Digits, percent, quantity, short, six_digits, with_unit};
use crate::quantities;
use engine::contact::Status;
use engine::{
    Assessment, IterationRow, Path, Solution, Start, Step, last_under_each_load, max_displacement,
};

/// The change of displacements, over the largest, below which a path of half as many steps gives
/// the same: where nodes change their status within steps, both may miss when.
const UNCHANGED: f64 = 5e-5;

/// The most rows of a table of iterations, unless all are asked for.
const LISTED: usize = 25;

/// Lists the iterations; of those of a shape that was reached on springs, the last. Where there are many, the
/// first, those with a new contact state, and the last, unless `all` are asked for.
pub fn iterations(solution: &Solution, assessment: &Assessment, all: bool) -> Report {
    let springs = |step: &Step| step.unilateral().map_or(0.0, |own| own.springs);
    let is_shown = |k: usize| {
        let own = springs(&solution.steps[k]);
        own == 0.0 || solution.steps.get(k + 1).is_none_or(|next| springs(next) != own)
    };
    let rows = IterationRow::all(solution).into_iter().enumerate();
    let rows: Vec<_> = rows.filter(|(k, _)| is_shown(*k)).map(|(_, row)| row).collect();
    let (rows, left_out) = shortened(rows, all, |row| row.cycle.is_none());
    // The whole load stands below.
    let is_column =
        |name| name != "target_force" || rows.iter().any(|row| row.target_share.is_none());
    let columns = IterationRow::QUANTITIES.iter().filter(|quantity| is_column(quantity.name));
    let units = &solution.request.scene.units;
    let table = quantities::table(&rows, columns, units, super::error_of_mesh(assessment));
    let report = Report::default().table("Iterations", table).notes(left_out);
    let [fx, fy] = solution.model.total_load();
    match fx.hypot(fy) {
        0.0 => report,
        load => {
            report.note(format!("the whole load is {}", with_unit(&six_digits(load), &units.force)))
        }
    }
}

/// Leaves of many rows the first, the changes and the last; where these are many too, the first and the last
/// of them. Says how many there are.
fn shortened<R>(
    rows: Vec<R>,
    all: bool,
    is_change: impl Fn(&R) -> bool,
) -> (Vec<R>, Option<String>) {
    let found = rows.len();
    if all || found <= LISTED {
        return (rows, None);
    }
    let rows = rows.into_iter().enumerate();
    let rows = rows.filter(|(k, row)| *k == 0 || k + 1 == found || is_change(row));
    let mut rows: Vec<R> = rows.map(|(_, row)| row).collect();
    let changes = rows.len();
    let words = match changes > LISTED {
        true => {
            rows.drain(LISTED / 2..changes - LISTED / 2);
            format!("the first and the last {} changes of the contact state are", LISTED / 2)
        }
        false => "the first, those with a new contact state, and the last are".into(),
    };
    let words = format!("of {found} {words} listed; --iterations prints all, result.json has them");
    (rows, Some(words))
}

/// Lists the last iteration under each load of a path.
pub fn load_steps(solution: &Solution, path: &Path, assessment: &Assessment, all: bool) -> Report {
    let units = &solution.request.scene.units;
    let last = last_under_each_load(&solution.steps);
    let step = |row: &usize| &solution.steps[last[*row]];
    let own = |row: &usize| step(row).unilateral().expect("a path is of unilateral contact");
    let first = |row: &usize| row.checked_sub(1).map_or(0, |before| last[before] + 1);
    let count = |row: &usize, is_counted: fn(&Status) -> bool| {
        step(row).statuses.iter().filter(|status| is_counted(status)).count()
    };
    let error = super::error_of_mesh(assessment);
    let statuses = |row: &usize| &step(row).statuses;
    let is_change = |row: &usize| row.checked_sub(1).is_none_or(|k| statuses(&k) != statuses(row));
    let (rows, left_out) = shortened((0..last.len()).collect(), all, is_change);
    let digits = |value: fn(&Step) -> f64| {
        let largest = rows.iter().map(|row| value(step(row)).abs()).fold(0.0, f64::max);
        Digits::of(largest, error)
    };
    let [u, gap] = [digits(|step| step.max_displacement), digits(|step| step.contact_residual)];
    let table = Table::from_rows(rows)
        .column("load", |row| own(row).load)
        .column("iterations", |row| last[*row] + 1 - first(row))
        .column("stick", |row| count(row, |status| *status == Status::Stick))
        .column("slip", |row| count(row, |status| matches!(status, Status::Slip(_))))
        .column(quantity("largest |u|", &units.length), |row| {
            Cell::of_digits(step(row).max_displacement, u)
        })
        .column(quantity("gap or overlap left", &units.length), |row| {
            Cell::of_digits(step(row).contact_residual, gap)
        })
        .column(quantity("force on target", &units.force), |row| {
            Cell::of_digits(step(row).target_force, Digits::of(step(row).target_force, Some(0.0)))
        });
    let halved = match path.halved {
        0 => String::new(),
        n => format!(", {n} halved because no equilibrium was found"),
    };
    let change = match &assessment.path_change {
        Some(Ok(change)) => step_error(solution, path, *change),
        Some(Err(why)) => {
            Some(format!("The error of the size of the steps is unknown: in half as many, {why}"))
        }
        None => Some(format!("The error of the size of the steps is {}", why_unknown(path))),
    };
    Report::default()
        .table("Path of the load", table)
        .notes(left_out)
        .note(format!("{} steps a stage{halved}", path.steps))
        .notes(released(path.start))
        .notes(change)
}

/// Says where bodies that overlapped start from, where contact alone holds them.
fn released(start: Start) -> Option<String> {
    let found = match start {
        Start::Held | Start::Closed | Start::Loose | Start::Overlapping => return None,
        Start::Released => {
            "before any load the bodies were moved apart as rigid ones, to where a vanishing load holds them without \
             friction"
        }
        Start::Unslipped => {
            "before any load the bodies were moved apart as rigid ones, so that all nodes that overlapped touch and \
             none slipped"
        }
        Start::Pressed => {
            "it is the only contact state of all in which friction holds the bodies under the first thousandth of the \
             load"
        }
    };
    Some(format!("The start is not determined by the overlap: {found}; friction counts from there"))
}

/// Says what half as many steps of the load change; nothing where that is nothing.
fn step_error(solution: &Solution, path: &Path, change: f64) -> Option<String> {
    let largest = max_displacement(&solution.u);
    if change > UNCHANGED * largest {
        return Some(format!(
            "Half as many steps change a displacement component by at most {} = {} of the largest |u|",
            with_unit(&short(change), &solution.request.scene.units.length),
            percent(change / largest)
        ));
    }
    let steps = counted(path.changes, "step", "steps");
    (path.changes > 0).then(|| {
        format!(
            "Half as many steps change nothing, which is not conclusive, as nodes come to stick, to slide or to open \
             in {steps}"
        )
    })
}

/// Says why it is not known what the size of the steps changes.
fn why_unknown(path: &Path) -> &'static str {
    match path.start {
        Start::Loose => {
            "unknown: nothing holds the bodies before the first step, which brings them into contact"
        }
        Start::Overlapping => {
            "unknown: nodes that overlap the target close with the first step, as no equilibrium was \
             found without load"
        }
        Start::Held | Start::Closed | Start::Released | Start::Unslipped | Start::Pressed => {
            match path.steps % 2 {
                1 => "unknown: it takes an even number of steps",
                _ => "not asked for",
            }
        }
    }
}
