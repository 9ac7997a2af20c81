//! A run of edited listings beside that of the printed ones.

use super::layout::listed;
use super::model::{Cell, Report, Table};
use super::numbers::{percent, quantity, short, with_unit};
use engine::{Solution, max_displacement, summaries};

/// Reports what two runs of one scene came to, and the largest change of a displacement.
pub fn report(printed: &Solution, edited: &Solution) -> Report {
    let units = &edited.request.scene.units;
    let row =
        |what: String, of: &dyn Fn(&Solution) -> Cell| vec![what.into(), of(printed), of(edited)];
    let nodes = |run: &Solution| match run.last().contact_set(&run.model) {
        nodes if nodes.is_empty() => "none".into(),
        nodes => listed(nodes).into(),
    };
    let mut rows = vec![
        row("in contact at the end".into(), &nodes),
        row(quantity("largest |u|", &units.length), &|run| max_displacement(&run.u).into()),
        row(quantity("force on target", &units.force), &|run| run.target_force().into()),
    ];
    for (a, b) in summaries(printed).into_iter().zip(summaries(edited)) {
        let what = format!("largest von Mises stress of {}", a.name);
        let [a, b] = [a, b].map(|body| body.max_von_mises_stress.into());
        rows.push(vec![quantity(&what, &units.stress).into(), a, b]);
    }
    let change = max_displacement(&(&edited.u - &printed.u));
    let size = max_displacement(&printed.u);
    let part = if size > 0.0 { format!(" = {}", percent(change / size)) } else { String::new() };
    Report::default()
        .table("What the edited listings change", Table::new(["", "as printed", "edited"], rows))
        .note(format!(
            "displacements change by at most {}{part}",
            with_unit(&short(change), &units.length)
        ))
}
