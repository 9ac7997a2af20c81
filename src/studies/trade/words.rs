//! What the tables say, in sentences. No time stands in them: the same on every run.

use super::Knob;
use super::errors::Errors;
use super::order::Order;
use super::rows::{Ladder, Row};
use super::trials::{cg, exact_seconds, sparse};
use crate::answer::Request;
use crate::answer::estimates::Certainty;
use crate::numbers::solve::{ScalarName, Solver};
use crate::problem::modelling::Variant;
use crate::problem::scene::{Scene, symmetry};

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// What errors are measured against, in words.
pub fn against(knob: Knob) -> &'static str {
    match knob {
        Knob::Arithmetic => "the last row that ran",
        Knob::Solver => "f64x2",
        Knob::Mesh => "the reference solution on the finest mesh that ran",
        Knob::Symmetry => "the whole scene under the same variant",
        _ => "the equilibrium under the scene's own friction on the same mesh (unilateral, mortar)",
    }
}

/// What the rows of a knob say, a sentence for each question.
pub fn answers(
    request: &Request,
    knob: Knob,
    rows: &[Row],
    orders: &[Order],
    ladder: Option<&Ladder>,
) -> Vec<String> {
    let scene = &request.scene;
    match knob {
        Knob::Symmetry if rows.is_empty() => {
            vec!["The scene is not symmetric about a vertical line: it has no half.".into()]
        }
        _ if rows.is_empty() => vec!["The scene has no contact: there is nothing to turn.".into()],
        Knob::Arithmetic => arithmetic(request, rows),
        Knob::Solver => solver(rows),
        Knob::Mesh => mesh(scene, rows, orders, ladder),
        Knob::Tolerance => by_variant(scene, rows, tolerance),
        Knob::Iterations => by_variant(scene, rows, iterations),
        Knob::Status | Knob::Coupling => by_variant(scene, rows, nearest),
        Knob::Symmetry => halves(scene, rows),
        Knob::Geometry => unreachable!("its section has words of its own"),
    }
}

fn by_variant(
    scene: &Scene,
    rows: &[Row],
    sentence: fn(&Scene, Variant, &[&Row]) -> Option<String>,
) -> Vec<String> {
    let of = |variant: &Variant| {
        let rows: Vec<&Row> = rows.iter().filter(|row| row.variant == *variant).collect();
        let said = sentence(scene, *variant, &rows)?;
        Some(said + &by_rounding(&rows))
    };
    Variant::ALL.iter().filter_map(of).collect()
}

/// Says at which settings rounding decides who is in contact, and in which numbers it does not.
pub fn by_rounding(rows: &[&Row]) -> String {
    let at = |certainty: Certainty| {
        let rows = rows.iter().filter(|row| row.certainty == Some(certainty));
        rows.map(|row| row.label.as_str()).collect::<Vec<_>>().join(", ")
    };
    let (repeated, unknown) = (at(Certainty::InDoubleDouble), at(Certainty::Unknown));
    let mut text = String::new();
    if !repeated.is_empty() {
        text += &format!(
            " At {repeated} rounding in f64 may decide who is in contact: what is said of these is of \
             the same run in double-doubles, where it decides nothing."
        );
    }
    if !unknown.is_empty() {
        text +=
            &format!(" At {unknown} it is not known whether rounding decides who is in contact.");
    }
    text
}

/// A share in percent: `0.12 %`, or a power of ten where that is shorter; in words where it is a
/// share of nothing.
fn percent(x: f64) -> String {
    match 100.0 * x {
        p if !p.is_finite() => "an undefined share (of 0)".into(),
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
    let [displacement, stress] = [errors.displacement, errors.von_mises].map(percent);
    format!("displacements by {displacement}, von Mises stresses by {stress}")
}

fn arithmetic(request: &Request, rows: &[Row]) -> Vec<String> {
    let error = |scalar: ScalarName| {
        let row = rows.iter().find(|row| row.arithmetic == sparse(scalar))?;
        row.error.map(|e| e.displacement)
    };
    let mut sentences = Vec::new();
    if let (Some(single), Some(double)) = (error(ScalarName::F32), error(ScalarName::F64)) {
        sentences.push(format!(
            "Rounding changes displacements by {single:.0e} of the largest in f32, by {double:.0e} \
             in f64; below 1e-16 nothing shows, for rows are compared in f64."
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
        row.arithmetic.scalar == ScalarName::F64 && row.arithmetic.solver != Some(Solver::Cg)
    });
    let direct = direct.filter_map(|row| row.error.map(|e| e.displacement)).fold(0.0, f64::max);
    let loose = rows.iter().find(|row| row.arithmetic == cg(1e-4)).and_then(|row| row.error);
    let mut sentences =
        vec![format!("Direct solvers differ by {direct:.0e} of the largest displacement at most.")];
    sentences.extend(loose.map(|loose| {
        format!(
            "A residual is no error: conjugate gradients stopped at a relative residual of 1e-4 \
             are wrong by {:.0e}.",
            loose.displacement
        )
    }));
    sentences
}

fn mesh(scene: &Scene, rows: &[Row], orders: &[Order], ladder: Option<&Ladder>) -> Vec<String> {
    let mut sentences: Vec<String> = orders.iter().map(order).collect();
    sentences.extend(rows.first().and_then(|row| row.error).map(|error| {
        let [displacement, energy, stress] =
            [error.displacement, error.energy, error.von_mises].map(percent);
        format!(
            "The scene's own mesh is {displacement} of the largest displacement from the finest \
             one, {energy} in the energy norm, {stress} of the largest von Mises stress."
        )
    }));
    if let (Some(energy), Some(ladder)) = (orders.first(), ladder) {
        sentences.extend(pythagoras(scene, ladder));
        sentences.extend(estimate(energy, ladder));
    }
    let corners = match scene.model.target() {
        None => "",
        Some(_) => " Where its corners press, the stress has no limit.",
    };
    sentences.push(format!(
        "The outline is the polygon of the scene's own mesh on every mesh: what a curved surface \
         loses to its chords is not in these numbers.{corners}"
    ));
    sentences
}

/// Why squares add in the energy norm, and how nearly they do.
fn pythagoras(scene: &Scene, ladder: &Ladder) -> Option<String> {
    let departure = percent(ladder.departure?);
    let why = match scene.model.target() {
        None => {
            "because each mesh is nested in the next and the load is the same; \
                 what they miss by is rounding"
        }
        Some(_) => {
            "because each mesh is nested in the next and the load is the same; with \
             contact only nearly, for the surfaces meet otherwise on each mesh"
        }
    };
    Some(format!(
        "In the energy norm the squares of the differences add, {why}: over three meshes in turn \
         they miss the square of the whole by {departure} at most."
    ))
}

/// What `solve` estimates beside what the ladder measures.
fn estimate(energy: &Order, ladder: &Ladder) -> Option<String> {
    let errors = energy.errors.as_ref()?;
    let pairs = errors.iter().zip(&ladder.estimates).filter(|(_, estimate)| estimate.is_finite());
    let listed: Vec<String> = pairs
        .map(|(error, estimate)| format!("{} for {}", percent(*estimate), percent(*error)))
        .collect();
    Some(format!(
        "What solve estimates of these meshes, each from itself alone: {}. The ladder has the last \
         word: the estimate is too low where the stress is singular.",
        listed.join(", ")
    ))
}

fn order(order: &Order) -> String {
    let Order { quantity, differences, order, scatter, errors } = order;
    if differences.iter().any(|d| !d.is_finite()) {
        return format!("The {quantity} has no order of convergence: on the finest mesh it is 0.");
    }
    let listed: Vec<String> = differences.iter().map(|d| format!("{d:.1e}")).collect();
    let listed = listed.join(", ");
    let (Some(p), Some([own, .., finest])) = (order, errors.as_deref()) else {
        return format!(
            "The {quantity} shows no order of convergence on these meshes (differences {listed})."
        );
    };
    let scatter = scatter.map_or("two differences only".into(), |s| {
        format!("the differences leave the fitted line by a factor of {s:.2} at most")
    });
    format!(
        "The {quantity} converges with order {p:.2} (differences from mesh to mesh {listed}; \
         {scatter}); the finest mesh is about {} from the limit, the scene's own {}.",
        percent(*finest),
        percent(*own)
    )
}

fn from_the_reference([a, b]: [&Row; 2]) -> String {
    let far = |row: &Row| row.error.map_or("-".into(), |e| percent(e.displacement));
    format!(
        "From the equilibrium under the scene's own friction: {} at {}, {} at {}.",
        far(a),
        a.label,
        far(b),
        b.label
    )
}

fn tolerance(scene: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
    let own = rows.iter().find(|row| row.own)?;
    let below = rows.iter().take_while(|row| !row.own);
    let most = below.filter_map(|row| row.change).max_by(|a, b| seen(a).total_cmp(&seen(b)))?;
    let verdict = if seen(&most) < NOTICEABLE { "is" } else { "is not" };
    let above = rows.iter().rev().find(|row| !row.own).and_then(|row| row.change);
    let above = above.map_or(String::new(), |change| {
        format!(" The largest c_tll tried moves {}.", both(&change))
    });
    Some(format!(
        "{variant}: c_tll = {} {} {verdict} small enough: going down to {} moves {}. {}{above}",
        own.label,
        scene.units.length,
        rows[0].label,
        both(&most),
        from_the_reference([own, rows[0]])
    ))
}

fn iterations(_: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
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
    Some(format!(
        "{variant}: {} iterations {verdict}: {state}; one more moves {}; {} of them move {}. {}",
        own.label,
        both(&next),
        last.label,
        both(&change),
        from_the_reference([own, last])
    ))
}

fn nearest(_: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
    let errors = rows.iter().filter_map(|row| Some((row, row.error?.displacement)));
    let (best, least) = errors.clone().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let all_same = errors.clone().all(|(_, error)| error == least);
    let listed = errors.map(|(row, error)| format!("{} {}", row.label, percent(error)));
    let verdict =
        if all_same { "all the same".into() } else { format!("{} is nearest", best.label) };
    let listed = listed.collect::<Vec<_>>().join(", ");
    Some(format!(
        "{variant}: {verdict} ({listed} from the equilibrium under the scene's own friction)."
    ))
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
            "{}: the half differs from the whole by {:.0e} of the largest displacement ({} nodes \
             in contact, {} in the half).",
            half.variant,
            error.displacement,
            count(whole),
            count(half)
        ));
    }
    sentences
}
