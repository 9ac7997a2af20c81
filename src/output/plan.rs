//! The plan of a run, for people and for machines.

use super::model::{Cell, Report, Table};
use super::numbers::{quantity, six_digits};
use super::tables::equilibrium;
use engine::plan::{ContactPlan, MARGIN, Plan, Storage};
use problem::scene::Scene;

/// Writes the plan on one line, which is the same on every machine.
pub fn line(plan: &Plan) -> String {
    let contact = plan.contact.as_ref().map(|contact| &contact.candidates);
    let contact = contact.map_or("no contact".into(), |found| {
        format!("{} contact candidates of {}", found.pairs, found.all())
    });
    let mut text = format!(
        "plan: {} free equations of {}, {contact}, {}{} in {}",
        plan.equations.free,
        plan.equations.all,
        if plan.storage == Storage::Dense { "dense matrices, " } else { "" },
        plan.solver,
        plan.scalar,
    );
    text += match (&plan.half, plan.half_would_do()) {
        (None, _) => "",
        (Some(_), true) => "; symmetric, half the model suffices",
        (Some(_), false) => "; symmetric, but c_cnt as printed is not",
    };
    text
}

/// Reports the plan of a scene, with what is to be said of that.
pub fn report(plan: &Plan, scene: &Scene) -> Report {
    let units = &scene.units;
    let (equations, contact) = (plan.equations, plan.contact.as_ref());
    let solved = match equations.solved == equations.all {
        true => "Km as printed keeps restrained ones, with 1 on the diagonal",
        false => "at most: each node in contact removes its equations",
    };
    let mut built = vec![
        row("equations", equations.all, "two a node"),
        row("free", equations.free, "not restrained"),
        row("solved", equations.solved, solved),
    ];
    match contact {
        None => built.push(row("contact", "none", "the scene names no contact surfaces")),
        Some(ContactPlan { coupling, candidates: found, .. }) => {
            let margin = format!(
                "of {}: nodes in the box of an edge, grown by c_tll + {MARGIN} of its length",
                found.all(),
            );
            built.push(row("coupling", coupling.to_string(), "contact.coupling"));
            built.push(row("contact candidates", found.pairs, margin));
            built.push(row("contact nodes near", found.near, format!("of {}", found.nodes)));
        }
    }
    built.push(row("solver", format!("{} in {}", plan.solver, plan.scalar), "--solver, --scalar"));
    let why = if plan.storage == Storage::Dense { "every entry" } else { "entries that are not 0" };
    built.push(row("matrix", plan.storage.to_string(), why));

    let bodies = Table::from_rows(&plan.bodies)
        .column("body", |body| body.name.clone())
        .column(quantity("size", &units.length), |body| body.size.map(six_digits).join(" x "))
        .column("nodes", |body| body.nodes)
        .column("triangles", |body| body.triangles)
        .column("free equations", |body| body.free)
        .column("contact", |body| if body.in_contact { "yes" } else { "no" })
        .column("moves", |body| body.idle.map_or("yes".into(), |idle| format!("no: {idle}")));
    let locking = plan.bodies.iter().filter_map(|body| {
        let why = body.locking.as_ref()?;
        Some(format!("NOTE: body {}: {why}; the error of the mesh is not estimated", body.name))
    });

    let total = format!("{} along x and y", quantity("sum of the loads", &units.force));
    let mut load = vec![row(&total, plan.load.map(six_digits).join(", "), "with their signs")];
    load.extend(plan.nominal_strain.map(|strain| {
        let why =
            "largest of a body: its loads, without signs, / (width or height x thickness x E)";
        row("nominal strain", six_digits(strain), why)
    }));

    let mut left_out = vec![
        row("orphan nodes", plan.orphans, "in no triangle: dropped"),
        row("restrained equations", equations.restrained, "known to be 0"),
    ];
    left_out.extend(contact.map(|contact| {
        let apart = contact.candidates.all() - contact.candidates.pairs;
        row("pairs too far apart", apart, "c_cnt as printed walks them all the same")
    }));
    left_out.extend(plan.bodies.iter().filter_map(|body| {
        let name = format!("equations of body {:?}", body.name);
        Some(row(&name, body.free, format!("0: {}", body.idle?)))
    }));
    left_out.extend(plan.half.map(|found| {
        let half = match plan.half_would_do() {
            true => "half the model suffices",
            false => "but half of it has another answer, for c_cnt as printed is not symmetric",
        };
        let at = six_digits(found.at);
        let why = format!("the scene is its own mirror image about x = {at}: {half}");
        row("nodes of the other half", plan.nodes - found.nodes, why)
    }));

    Report::default()
        .line(line(plan))
        .notes(scene.adapted().to_vec())
        .notes(equilibrium::initial_gaps(&scene.model, units))
        .table("What is built", Table::new(["", "", "why"], built))
        .table("Bodies", bodies)
        .notes(locking)
        .table("Load", Table::new(["", "", "of that"], load))
        .table("What is left out, or could be", Table::new(["", "", "why"], left_out))
}

fn row(name: &str, value: impl Into<Cell>, why: impl Into<Cell>) -> Vec<Cell> {
    vec![name.into(), value.into(), why.into()]
}
