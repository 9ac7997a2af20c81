//! The iterations of a run, or the steps of its load.

use crate::layout::counted;
use crate::model::{Report, Table};
use crate::numbers::{percent, quantity, short, with_unit};
use crate::quantities;
use engine::contact::Status;
use engine::{
    Assessment, IterationRow, Path, Solution, Start, Step, last_under_each_load, max_displacement,
};

/// The change of displacements, over the largest, below which a path of half as many steps gives
/// the same: where nodes change their status within steps, both may miss when.
const UNCHANGED: f64 = 1e-6;

/// The most iterations that are listed; of more, as many at the start and at the end.
const LISTED: usize = 24;

/// Lists the iterations, where they are many the first and the last; of those of a shape that was reached on
/// springs, the last.
pub fn iterations(solution: &Solution) -> Report {
    let springs = |step: &Step| step.unilateral().map_or(0.0, |own| own.springs);
    let is_shown = |k: usize| {
        let own = springs(&solution.steps[k]);
        own == 0.0 || solution.steps.get(k + 1).is_none_or(|next| springs(next) != own)
    };
    let rows = IterationRow::all(solution).into_iter().enumerate();
    let mut rows: Vec<_> = rows.filter(|(k, _)| is_shown(*k)).map(|(_, row)| row).collect();
    let found = rows.len();
    if found > LISTED {
        rows.drain(LISTED / 2..found - LISTED / 2);
    }
    let units = &solution.request.scene.units;
    let table = quantities::table(&rows, IterationRow::QUANTITIES, units);
    let left_out = (found > LISTED).then(|| {
        format!(
            "{found} iterations, of which the first and the last {} are listed; result.json has all",
            LISTED / 2
        )
    });
    let report = Report::default().table("Iterations", table).notes(left_out);
    let [fx, fy] = solution.model.total_load();
    match fx.hypot(fy) {
        0.0 => report,
        load => report.note(format!("the whole load is {}", with_unit(&short(load), &units.force))),
    }
}

/// Lists the last iteration under each load of a path.
pub fn load_steps(solution: &Solution, path: &Path, assessment: &Assessment) -> Report {
    let units = &solution.request.scene.units;
    let last = last_under_each_load(&solution.steps);
    let step = |row: &usize| &solution.steps[last[*row]];
    let own = |row: &usize| step(row).unilateral().expect("a path is of unilateral contact");
    let first = |row: &usize| row.checked_sub(1).map_or(0, |before| last[before] + 1);
    let count = |row: &usize, is_counted: fn(&Status) -> bool| {
        own(row).statuses.iter().filter(|status| is_counted(status)).count()
    };
    let table = Table::from_rows(0..last.len())
        .column("load", |row| own(row).load)
        .column("iterations", |row| last[*row] + 1 - first(row))
        .column("stick", |row| count(row, |status| *status == Status::Stick))
        .column("slip", |row| count(row, |status| matches!(status, Status::Slip(_))))
        .column(quantity("largest |u|", &units.length), |row| step(row).max_displacement)
        .column(quantity("gap or overlap left", &units.length), |row| step(row).contact_residual())
        .column(quantity("force on target", &units.force), |row| step(row).target_force);
    let halved = match path.halved {
        0 => String::new(),
        n => format!(", {n} halved because no equilibrium was found"),
    };
    Report::default()
        .table("Path of the load", table)
        .note(format!("{} steps a stage{halved}", path.steps))
        .notes(released(path.start))
        .note(match &assessment.path_change {
            Some(Ok(change)) => step_error(solution, path, *change),
            Some(Err(why)) => {
                format!("The error of the size of the steps is unknown: in half as many, {why}")
            }
            None => {
                format!("The error of the size of the steps is {}", why_unknown(path))
            }
        })
}

/// Says where bodies that overlapped start from, where contact alone holds them.
fn released(start: Start) -> Option<String> {
    let place = match start {
        Start::Held | Start::Closed | Start::Loose | Start::Overlapping => return None,
        Start::Released => "to where a vanishing load holds them without friction",
        Start::Unslipped => "so that all nodes that overlapped touch and none slipped",
        Start::Pressed => {
            return Some(
                "The start is not determined by the overlap: it is the only contact state of all in which friction \
                 holds the bodies under the first thousandth of the load; friction counts from there"
                    .into(),
            );
        }
    };
    Some(format!(
        "The start is not determined by the overlap: before any load the bodies were moved apart as rigid \
         ones, {place}; friction counts from there"
    ))
}

/// Says what half as many steps of the load change.
fn step_error(solution: &Solution, path: &Path, change: f64) -> String {
    let largest = max_displacement(&solution.u);
    let part = if largest > 0.0 { change / largest } else { 0.0 };
    let words = format!(
        "Half as many steps change a displacement component by at most {} = {} of the largest |u|",
        with_unit(&short(change), &solution.request.scene.units.length),
        percent(part, 2)
    );
    if path.changes == 0 || change > UNCHANGED * largest {
        return words;
    }
    let steps = counted(path.changes, "step", "steps");
    format!("{words}; not conclusive, as nodes come to stick, to slide or to open in {steps}")
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
