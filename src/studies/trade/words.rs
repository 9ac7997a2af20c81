//! What the tables say, in sentences. No time stands in them: the same on every run.

use super::Knob;
use super::errors::Errors;
use super::order::Order;
use super::rows::Row;
use super::trials::{cg, exact_seconds, sparse};
use crate::answer::Request;
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::modelling::Variant;
use crate::problem::scene::{Scene, symmetry};

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// The answers to a knob's questions.
pub fn answers(request: &Request, knob: Knob, rows: &[Row], orders: &[Order]) -> Vec<String> {
    let scene = &request.scene;
    if rows.is_empty() {
        return vec![nothing(knob).into()];
    }
    match knob {
        Knob::Arithmetic => arithmetic(request, rows),
        Knob::Solver => solver(rows),
        Knob::Mesh => mesh(rows, orders),
        Knob::Tolerance => by_variant(rows, |variant, rows| tolerance(scene, variant, rows)),
        Knob::Iterations => by_variant(rows, iterations),
        Knob::Status | Knob::Coupling => by_variant(rows, nearest),
        Knob::Symmetry => halves(scene, rows),
    }
}

fn nothing(knob: Knob) -> &'static str {
    match knob {
        Knob::Symmetry => "The scene is not symmetric about a vertical line: it has no half.",
        _ => "The scene has no contact: there is nothing to turn.",
    }
}

fn by_variant(rows: &[Row], of: impl Fn(Variant, &[&Row]) -> Option<String>) -> Vec<String> {
    let rows_of =
        |variant: Variant| -> Vec<&Row> { rows.iter().filter(|r| r.variant == variant).collect() };
    let sentence = |variant: &Variant| of(*variant, &rows_of(*variant));
    Variant::ALL.iter().filter_map(sentence).collect()
}

/// A share in percent: `0.12 %`, or a power of ten where that is shorter.
fn percent(x: f64) -> String {
    match 100.0 * x {
        0.0 => "0 %".into(),
        p if p >= 0.01 => format!("{p:.2} %"),
        p => format!("{p:.0e} %"),
    }
}

/// The larger of what a reader looks at: displacement and von Mises stress.
fn seen(errors: &Errors) -> f64 {
    errors.displacement.max(errors.von_mises)
}

fn both(errors: &Errors) -> String {
    format!(
        "displacements by {}, von Mises stresses by {}",
        percent(errors.displacement),
        percent(errors.von_mises)
    )
}

fn arithmetic(request: &Request, rows: &[Row]) -> Vec<String> {
    let error = |scalar: ScalarName| {
        let row = rows.iter().find(|row| row.arithmetic == sparse(scalar))?;
        row.error.map(|e| e.displacement)
    };
    let mut sentences = Vec::new();
    if let (Some(single), Some(double)) = (error(ScalarName::F32), error(ScalarName::F64)) {
        sentences.push(format!(
            "Rounding moves displacements by {single:.0e} of the largest in f32, by {double:.0e} in f64; below 1e-16 nothing shows, for \
             rows are compared in f64."
        ));
    }
    if error(ScalarName::Exact).is_none() {
        let seconds = exact_seconds(request);
        sentences.push(format!("Exact numbers were left out: they may take {seconds:.0e} s here."));
    }
    sentences
}

fn solver(rows: &[Row]) -> Vec<String> {
    // The row in f64x2 is what the others are measured against.
    let direct = rows.iter().filter(|row| {
        row.arithmetic.scalar == ScalarName::F64 && row.arithmetic.solver() != Solver::Cg
    });
    let direct = direct.filter_map(|row| row.error.map(|e| e.displacement)).fold(0.0, f64::max);
    let loose = rows.iter().find(|row| row.arithmetic == cg(1e-4)).and_then(|row| row.error);
    let mut sentences =
        vec![format!("Direct solvers differ by {direct:.0e} of the largest displacement at most.")];
    if let Some(loose) = loose {
        sentences.push(format!(
            "A residual is no error: conjugate gradients stopped at a relative residual of 1e-4 are wrong by {:.0e}.",
            loose.displacement
        ));
    }
    sentences
}

fn mesh(rows: &[Row], orders: &[Order]) -> Vec<String> {
    let mut sentences: Vec<String> = orders.iter().map(order).collect();
    if let Some(error) = rows.first().and_then(|row| row.error) {
        let [displacement, energy, stress] =
            [error.displacement, error.energy, error.von_mises].map(percent);
        sentences.push(format!(
            "The scene's own mesh is {displacement} of the largest displacement from the finest one, {energy} in the energy norm, {stress} of \
             the largest von Mises stress."
        ));
    }
    sentences.push(
        "The outline is the polygon of the scene's own mesh on every rung: what a curved surface loses to its chords is not in these numbers."
            .into(),
    );
    sentences
}

fn order(order: &Order) -> String {
    let listed: Vec<String> = order.differences.iter().map(|d| format!("{d:.1e}")).collect();
    let listed = listed.join(", ");
    match (order.order, order.left) {
        (Some(p), Some(left)) => {
            let scatter = order.scatter.map_or("two differences only".into(), |s| {
                format!("the differences are off the fitted line by a factor of {s:.2} at most")
            });
            format!(
                "The {} converges with order {p:.2} (differences from mesh to mesh {listed}; {scatter}); the finest mesh is about {} from the limit.",
                order.quantity,
                percent(left)
            )
        }
        _ => format!(
            "The {} shows no order of convergence on these meshes (differences {listed}).",
            order.quantity
        ),
    }
}

fn tolerance(scene: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
    let own = rows.iter().find(|row| row.own)?;
    let below = rows.iter().take_while(|row| !row.own);
    let most = below.filter_map(|row| row.change).max_by(|a, b| seen(a).total_cmp(&seen(b)))?;
    let verdict = if seen(&most) < NOTICEABLE { "is" } else { "is not" };
    let from = |row: &Row| row.error.map_or("-".into(), |e| percent(e.displacement));
    let far = format!(
        " From the converged answer: {} at {}, {} at {}.",
        from(own),
        own.label,
        from(rows[0]),
        rows[0].label
    );
    let unit = &scene.units.length;
    let above = rows.iter().rev().find(|row| !row.own).and_then(|row| row.change);
    let above = above.map_or(String::new(), |change| {
        format!(" The largest c_tll tried moves {}.", both(&change))
    });
    Some(format!(
        "{variant}: c_tll = {} {unit} {verdict} small enough: going down to {} moves {}.{far}{above}",
        own.label,
        rows[0].label,
        both(&most)
    ))
}

fn iterations(variant: Variant, rows: &[&Row]) -> Option<String> {
    let (at, last) = (rows.iter().position(|row| row.own)?, rows.last()?);
    let own = rows[at];
    let (next, change) = (rows.get(at + 1)?.change?, last.change?);
    let enough = seen(&change).max(seen(&next)) < NOTICEABLE;
    let verdict = if enough { "are enough" } else { "are not enough" };
    let state = match own.cycle {
        Some(1) => "the contact state has settled".into(),
        Some(length) => format!("contact states repeat in a cycle of {length}, for ever"),
        None => "the contact state still changes".into(),
    };
    let far = |row: &Row| row.error.map_or("-".into(), |e| percent(e.displacement));
    Some(format!(
        "{variant}: {} iterations {verdict}: {state}; one more moves {}; {} of them move {}. From the converged answer: {} at {}, {} at {}.",
        own.label,
        both(&next),
        last.label,
        both(&change),
        far(own),
        own.label,
        far(last),
        last.label
    ))
}

fn nearest(variant: Variant, rows: &[&Row]) -> Option<String> {
    let error = |row: &Row| row.error.map(|e| e.displacement);
    let ran = rows.iter().filter(|row| error(row).is_some());
    let best = ran.min_by(|a, b| error(a).unwrap_or(0.0).total_cmp(&error(b).unwrap_or(0.0)))?;
    let listed: Vec<String> = rows
        .iter()
        .filter_map(|row| error(row).map(|e| format!("{} {}", row.label, percent(e))))
        .collect();
    let all_same = rows.iter().filter_map(|row| error(row)).all(|e| Some(e) == error(best));
    let verdict =
        if all_same { "all the same".into() } else { format!("{} is nearest", best.label) };
    Some(format!("{variant}: {verdict} ({} from the converged answer).", listed.join(", ")))
}

fn halves(scene: &Scene, rows: &[Row]) -> Vec<String> {
    let departure = symmetry::half(scene).map_or(0.0, |half| half.departure);
    let mut sentences = vec![format!(
        "The mesh is symmetric within {departure:.0e} {}; half of it has {} of {} equations.",
        scene.units.length, rows[1].equations, rows[0].equations
    )];
    for pair in rows.chunks(2) {
        let [whole, half] = pair else { continue };
        let Some(error) = half.error else { continue };
        let count = |row: &Row| row.in_contact.map_or("-".into(), |n| n.to_string());
        sentences.push(format!(
            "{}: the half differs from the whole by {:.0e} of the largest displacement ({} nodes in contact, {} in the half).",
            half.variant,
            error.displacement,
            count(whole),
            count(half)
        ));
    }
    sentences
}
