//! A run of edited listings beside that of the printed ones.

use super::layout::{Table, listed};
use super::numbers::{percent, quantity, short, with_unit};
use engine::{Solution, max_displacement, summaries};

/// Lays out what two runs of one scene came to, and the largest change of a displacement.
pub fn beside(printed: &Solution, edited: &Solution) -> String {
    let units = &edited.request.scene.units;
    let nodes = |run: &Solution| match run.last().contact_set(&run.model) {
        nodes if nodes.is_empty() => "none".into(),
        nodes => listed(nodes),
    };
    let largest = |run: &Solution| short(max_displacement(&run.u));
    let force = |run: &Solution| short(run.target_force());
    let mut rows = vec![
        ("in contact at the end".to_string(), nodes(printed), nodes(edited)),
        (quantity("largest |u|", &units.length), largest(printed), largest(edited)),
        (quantity("force on target", &units.force), force(printed), force(edited)),
    ];
    for (a, b) in summaries(printed).into_iter().zip(summaries(edited)) {
        let what = format!("largest von Mises stress of {}", a.name);
        rows.push((
            quantity(&what, &units.stress),
            short(a.max_von_mises_stress),
            short(b.max_von_mises_stress),
        ));
    }
    let table = Table::of(rows)
        .column("", |row| row.0.clone())
        .column("as printed", |row| row.1.clone())
        .column("edited", |row| row.2.clone())
        .text();
    let change = max_displacement(&(&edited.u - &printed.u));
    let size = max_displacement(&printed.u);
    let part = if size > 0.0 { format!(" = {}", percent(change / size, 1)) } else { String::new() };
    format!(
        "\nWhat the edited listings change\n{table}  displacements change by at most {}{part}\n",
        with_unit(&short(change), &units.length)
    )
}
