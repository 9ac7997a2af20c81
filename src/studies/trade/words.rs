//! What the tables say, in sentences. No time stands in them: the same on every run.

use super::Varied;
use super::errors::Errors;
use super::limit::{Approach, Limit};
use super::order::Order;
use super::rows::{Ladder, Row, Section};
use super::trials::sparse;
use crate::benchmark::{ClosedForm, Strand};
use engine::estimates::Certainty;
use numbers::solve::ScalarName;
use problem::modelling::Variant;
use problem::scene::{Scene, Units};

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// What errors are measured against, in words.
pub fn against(parameter: Varied, arcs_are_true: bool) -> &'static str {
    match parameter {
        Varied::Mesh if arcs_are_true => "the limit of meshes with true arcs",
        Varied::Arithmetic => "the last row that ran",
        Varied::Solver => "f64x2",
        Varied::Mesh => "the reference solution on the finest mesh that ran",
        Varied::Symmetry => "the whole scene under the same variant",
        Varied::Tolerance
        | Varied::Iterations
        | Varied::Status
        | Varied::Coupling
        | Varied::Geometry => {
            "the equilibrium under the scene's own friction on the same mesh (unilateral, mortar)"
        }
    }
}

/// What a section's numbers say, a sentence for each question; its own `answers` do not count.
pub fn answers(scene: &Scene, section: &Section) -> Vec<String> {
    let Section { parameter, rows, exact_seconds, asymmetry, .. } = section;
    match parameter {
        Varied::Symmetry if rows.is_empty() => {
            vec!["The scene is not symmetric about a vertical line: it has no half.".into()]
        }
        _ if rows.is_empty() => vec!["The scene has no contact: there is nothing to vary.".into()],
        Varied::Arithmetic => arithmetic(rows, *exact_seconds),
        Varied::Solver => solver(rows),
        Varied::Mesh if Strand::from_scene(scene).is_some() => true_arcs(section.limit.as_ref()),
        Varied::Mesh => mesh(scene, section),
        Varied::Tolerance => by_variant(scene, rows, tolerance),
        Varied::Iterations => by_variant(scene, rows, iterations),
        Varied::Status | Varied::Coupling => by_variant(scene, rows, nearest),
        Varied::Symmetry => halves(scene, rows, asymmetry.unwrap_or(0.0)),
        Varied::Geometry => unreachable!("its section has words of its own"),
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

fn arithmetic(rows: &[Row], exact_seconds: Option<f64>) -> Vec<String> {
    let error = |scalar: ScalarName| {
        let row = rows.iter().find(|row| row.arithmetic == sparse(scalar))?;
        row.error.map(|e| e.displacement)
    };
    // What has more digits is what the others are measured against.
    let has_more = [ScalarName::F64x2, ScalarName::Exact].map(error).iter().any(Option::is_some);
    let rounding = error(ScalarName::F32).zip(error(ScalarName::F64)).filter(|_| has_more);
    let mut sentences = Vec::new();
    if let Some((single, double)) = rounding {
        sentences.push(format!(
            "Rounding changes displacements by {single:.0e} of the largest in f32, by {double:.0e} \
             in f64; below 1e-16 nothing shows, for rows are compared in f64."
        ));
    }
    sentences.extend(exact_seconds.map(|seconds| {
        format!("Exact numbers were left out: they may take {seconds:.0e} s here.")
    }));
    sentences
}

fn solver(rows: &[Row]) -> Vec<String> {
    let ran = |row: &Row| row.failure.is_none();
    // The row in f64x2 is what the others are measured against.
    if !rows.iter().any(|row| row.arithmetic.scalar == ScalarName::F64x2 && ran(row)) {
        return Vec::new();
    }
    let direct = rows.iter().filter(|row| row.arithmetic.scalar == ScalarName::F64);
    let direct = direct.filter_map(|row| row.error.map(|e| e.displacement)).reduce(f64::max);
    let direct = direct.map(|direct| {
        format!(
            "Solvers in f64 differ from f64x2 by {direct:.0e} of the largest displacement \
             at most."
        )
    });
    direct.into_iter().collect()
}

fn true_arcs(limit: Option<&Limit>) -> Vec<String> {
    let Some(Limit { radii: [disc, hole], quantities, closed_forms, units, .. }) = limit else {
        return vec!["No limit is known: not every mesh with true arcs ran.".into()];
    };
    let rule = format!(
        "The arcs are true on every mesh but the scene's own, for mesh strand makes the scene: both contact \
         surfaces lie on its circles, of radius {disc} and {hole} {}, and the block's sides, the groups and \
         what they restrain and load are its own. Refined as it is, the scene's own mesh would stay a \
         polygon, whose corners press: their stress has no limit.",
        units.length
    );
    let peak = quantities[0].best();
    let by_hand = closed_forms.iter().map(|form| closed_form(form, peak, units));
    let fitted = "Peak pressure and half width are those of Hertz's parabola for p² through the pressures of the \
                  nodes: a node's alone scatters, most beside the axis, about which the mesh is mirrored.";
    let assumed = "Hertz takes both bodies for half planes; Persson takes a disc loaded at its centre, in a \
                   hole of an unbounded plane, and neglects Dundurs' second constant. The scene is a block \
                   of finite size and a part of a disc loaded on its top.";
    let approaches = quantities.iter().map(approach);
    let by_hand = by_hand.chain((!closed_forms.is_empty()).then(|| assumed.into()));
    [rule, fitted.into()].into_iter().chain(approaches).chain(by_hand).collect()
}

/// Where a quantity leads to, and what the scene's own mesh misses of that.
fn approach(of: &Approach) -> String {
    let (Approach { quantity, unit, own, values, missed, .. }, best) = (of, of.best());
    let leads = match of.order {
        Some(order) => format!("converges with order {order:.2} to {best:.3} {unit}"),
        None => {
            let last = &values[values.len().saturating_sub(3)..];
            let [least, most] = [f64::min, f64::max].map(|f| last.iter().copied().reduce(f));
            let spread = most.zip(least).map_or(0.0, |(most, least)| (most - least) / best);
            let (spread, count) = (percent(spread), last.len());
            format!(
                "shows no order of convergence, differs by {spread} over the last {count} meshes, and is on \
                 the finest {best:.3} {unit}"
            )
        }
    };
    let side = if *missed < 0.0 { "below" } else { "above" };
    let missed = percent(missed.abs());
    format!(
        "The {quantity} {leads}; the scene's own mesh gives {own:.3} {unit}, {missed} {side} that."
    )
}

/// What a reader computes by hand, beside the peak pressure that finer meshes lead to.
fn closed_form(form: &ClosedForm, peak: f64, Units { length, stress, .. }: &Units) -> String {
    let ClosedForm { author, half_width, peak_pressure } = form;
    let side = if *peak_pressure < peak { "below" } else { "above" };
    let far = percent((peak_pressure / peak - 1.0).abs());
    format!(
        "By hand ({author}): half width {half_width:.3} {length}, peak pressure {peak_pressure:.2} {stress}, \
         {far} {side} that of finer meshes."
    )
}

fn mesh(scene: &Scene, section: &Section) -> Vec<String> {
    let Section { rows, orders, ladder, .. } = section;
    let mut sentences: Vec<String> = orders.iter().map(order).collect();
    let has_finer = rows.iter().skip(1).any(|row| row.failure.is_none());
    let own = rows.first().and_then(|row| row.error).filter(|_| has_finer);
    sentences.push(match own {
        Some(Errors { displacement, energy, von_mises }) => {
            let [displacement, energy, stress] = [displacement, energy, von_mises].map(percent);
            format!(
                "From the finest mesh that ran the scene's own differs by {displacement} of the \
                 largest displacement, {energy} in the energy norm, and in a body's largest von \
                 Mises stress by {stress} of it."
            )
        }
        None => "No finer mesh ran to compare the scene's own with.".into(),
    });
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

/// Says how far the displacements of rows are from the equilibrium.
fn from_the_reference(rows: &[&Row]) -> String {
    let far = |row: &&Row| {
        let far = row.error.map_or("-".into(), |e| percent(e.displacement));
        format!("{far} at {}", row.label)
    };
    let mut listed: Vec<String> = rows.iter().map(far).collect();
    listed.dedup();
    format!("From the equilibrium under the scene's own friction: {}.", listed.join(", "))
}

fn tolerance(scene: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
    let at = rows.iter().position(|row| row.own)?;
    let own = rows[at];
    let changed = |rows: &[&'_ Row]| -> Vec<(String, Errors)> {
        rows.iter().filter_map(|row| Some((row.label.clone(), row.change?))).collect()
    };
    let (smaller, larger) = (changed(&rows[..at]), changed(&rows[at + 1..]));
    let value = format!("{} {}", own.label, scene.units.length);
    let mut text = format!("{variant}: c_tll = {}", value.trim_end());
    match smaller.iter().max_by(|(_, a), (_, b)| seen(a).total_cmp(&seen(b))) {
        Some(most) => {
            let verdict = if seen(&most.1) < NOTICEABLE { "is" } else { "is not" };
            let (least, change) = &smaller[0];
            text +=
                &format!(" {verdict} small enough: going down to {least} moves {}", both(change));
            if both(&most.1) != both(change) {
                text += &format!("; of the smaller ones {} moves most: {}", most.0, both(&most.1));
            }
        }
        None => text += " is the smallest that ran",
    }
    let lowest = rows.iter().find(|row| row.change.is_some())?;
    text += &format!(". {}", from_the_reference(&[own, lowest]));
    if let Some((largest, change)) = larger.last() {
        text += &format!(" Going up to {largest} moves {}.", both(change));
    }
    Some(text)
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
        from_the_reference(&[own, last])
    ))
}

fn nearest(_: &Scene, variant: Variant, rows: &[&Row]) -> Option<String> {
    let errors = rows.iter().filter_map(|row| Some((&row.label, row.error?.displacement)));
    let errors: Vec<(&String, f64)> = errors.collect();
    let least = errors.iter().map(|(_, error)| *error).min_by(f64::total_cmp)?;
    let best = errors.iter().filter(|(_, error)| *error == least).map(|(label, _)| label.as_str());
    let best: Vec<&str> = best.collect();
    let verdict = match best[..] {
        _ if best.len() == errors.len() => "all the same".into(),
        [one] => format!("{one} is nearest"),
        _ => format!("{} are nearest", best.join(" and ")),
    };
    let listed = errors.iter().map(|(label, error)| format!("{label} {}", percent(*error)));
    Some(format!(
        "{variant}: {verdict} ({} from the equilibrium under the scene's own friction).",
        listed.collect::<Vec<_>>().join(", ")
    ))
}

fn halves(scene: &Scene, rows: &[Row], asymmetry: f64) -> Vec<String> {
    let mut sentences = vec![format!(
        "The mesh is symmetric within {}; half of it has {} of {} equations.",
        format!("{asymmetry:.0e} {}", scene.units.length).trim_end(),
        rows[1].equations,
        rows[0].equations
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
