//! The plan of a run, for people and for machines.

use serde::Serialize;

use super::tables::{aligned, short};
use crate::studies::plan::{BodyPlan, ContactPlan, MARGIN, Plan};

/// The plan in one line: the same on every machine.
pub fn line(plan: &Plan) -> String {
    let contact = match &plan.contact {
        None => "no contact".into(),
        Some(contact) => format!(
            "{} contact candidates of {}",
            contact.candidates.pairs,
            contact.candidates.all()
        ),
    };
    let mut text = format!(
        "plan: {} free equations of {}, {contact}, {} {} in {}; about {} MB, {} operations",
        plan.equations.free,
        plan.equations.all,
        plan.storage,
        plan.solver,
        plan.scalar,
        megabytes(plan.cost.bytes.total()),
        operations(plan.cost.operations),
    );
    if plan.half.is_some() {
        text += if plan.half_would_do() {
            "; symmetric, half of it would do"
        } else {
            "; symmetric, but c_cnt as printed is not"
        };
    }
    if plan.equations.idle > 0 {
        text += &format!("; nothing moves {} of the free equations", plan.equations.idle);
    }
    text
}

/// The plan as tables; `free` is the memory that is free, bytes.
pub fn text(plan: &Plan, free: Option<u128>) -> String {
    let refused = plan.check_memory(free).err().map_or(String::new(), |why| format!("\n{why}\n"));
    format!(
        "{}\n\nWhat is built\n{}\nBodies\n{}\nWhat it takes\n{}{refused}\nWhat is left out, or could be\n{}",
        line(plan),
        built(plan),
        bodies(&plan.bodies),
        cost(plan),
        left_out(plan)
    )
}

/// The plan as JSON.
pub fn json(plan: &Plan) -> String {
    #[derive(Serialize)]
    struct Document<'a> {
        #[serde(flatten)]
        plan: &'a Plan,
        bytes: f64,
    }
    let document = Document { plan, bytes: plan.cost.bytes.total() };
    serde_json::to_string(&document).expect("string keys only") + "\n"
}

fn table(rows: Vec<[String; 3]>) -> String {
    aligned(&rows.into_iter().map(Vec::from).collect::<Vec<_>>())
}

fn row(name: &str, value: impl ToString, why: impl ToString) -> [String; 3] {
    [name.into(), value.to_string(), why.to_string()]
}

fn built(plan: &Plan) -> String {
    let equations = plan.equations;
    let mut rows = vec![
        row("", "", "why"),
        row("equations", equations.all, "two a node"),
        row("free", equations.free, "not restrained"),
        row("solved", equations.solved, solved(plan)),
    ];
    match &plan.contact {
        None => rows.push(row("contact", "none", "the scene names no contact surfaces")),
        Some(contact) => rows.extend(of_contact(contact)),
    }
    rows.push(row("rung", format!("{} in {}", plan.solver, plan.scalar), "--solver, --scalar"));
    rows.push(row(
        "matrix",
        plan.storage,
        format!("{} numbers in its factors", plan.factors.nonzeros),
    ));
    table(rows)
}

fn solved(plan: &Plan) -> &'static str {
    if plan.equations.solved == plan.equations.all {
        "Km as printed keeps restrained ones, with 1 on the diagonal"
    } else {
        "at most: a node in contact takes its own out"
    }
}

fn of_contact(contact: &ContactPlan) -> Vec<[String; 3]> {
    let found = &contact.candidates;
    let margin = format!(
        "of {}: nodes in the box of an edge, grown by c_tll + {MARGIN} of its length",
        found.all(),
    );
    vec![
        row("coupling", contact.coupling, "contact.coupling"),
        row("contact candidates", found.pairs, margin),
        row("contact nodes near", found.near, format!("of {}", found.nodes)),
    ]
}

fn bodies(bodies: &[BodyPlan]) -> String {
    let head =
        ["body", "nodes", "triangles", "free equations", "contact", "moved"].map(String::from);
    let rows = bodies.iter().map(|body| {
        vec![
            body.name.clone(),
            body.nodes.to_string(),
            body.triangles.to_string(),
            body.free.to_string(),
            if body.in_contact { "yes" } else { "no" }.into(),
            body.idle.map_or("yes".into(), |idle| format!("no: {idle}")),
        ]
    });
    aligned(&std::iter::once(head.to_vec()).chain(rows).collect::<Vec<_>>())
}

fn cost(plan: &Plan) -> String {
    let (cost, bytes) = (plan.cost, plan.cost.bytes);
    let reference = match cost.reference_states {
        0 => String::new(),
        states => format!(", {states} of the converged answer beside it"),
    };
    table(vec![
        row("", "", "of that"),
        row(
            "memory, MB",
            megabytes(bytes.total()),
            format!(
                "program {}, mesh and files {}, matrices {}, iterations {}",
                megabytes(bytes.program),
                megabytes(bytes.mesh),
                megabytes(bytes.matrices),
                megabytes(bytes.iterations)
            ),
        ),
        row(
            "factorisations",
            cost.states + cost.reference_states,
            format!("{} likely{reference}", cost.states),
        ),
        row("operations", operations(cost.operations), "of the factorisations"),
    ])
}

fn left_out(plan: &Plan) -> String {
    let mut rows = vec![
        row("", "", "why"),
        row("orphan nodes", plan.orphans, "in no triangle: dropped"),
        row("restrained equations", plan.equations.restrained, "known to be 0"),
    ];
    if let Some(contact) = &plan.contact {
        let apart = contact.candidates.all() - contact.candidates.pairs;
        rows.push(row("pairs too far apart", apart, "c_cnt as printed walks them all the same"));
    }
    let idle = plan.bodies.iter().filter_map(|body| Some((body, body.idle?)));
    rows.extend(idle.map(|(body, why)| {
        row(&format!("equations of body {:?}", body.name), body.free, format!("0: {why}"))
    }));
    let half = if plan.half_would_do() {
        "half of it would do"
    } else {
        "but half of it has another answer, for c_cnt as printed is not symmetric"
    };
    rows.extend(plan.half.map(|found| {
        row(
            "nodes of the other half",
            plan.nodes - found.nodes,
            format!("the scene is its own mirror image about x = {}: {half}", short(found.at)),
        )
    }));
    table(rows)
}

fn megabytes(bytes: f64) -> String {
    format!("{:.0}", bytes / 1e6)
}

fn operations(count: f64) -> String {
    format!("{count:.1e}")
}
