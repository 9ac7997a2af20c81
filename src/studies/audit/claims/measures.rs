//! How claims are measured.

use std::num::ParseFloatError;

use super::{Evidence, Outcome, Verdict};
use crate::audit::Case;
use crate::audit::evidence::beyond_noise;
use crate::audit::findings::FINDINGS;
use crate::audit::variants::{Penetration, apart};
use engine::contact::pulling;
use engine::estimates::moves;
use engine::{Solution, distance, max_displacement, over};
use paper::door::Call;
use problem::modelling::Variant;
use report::numbers::percent;

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// What a test measured of the status rules on random scenes whose contact is known.
const STATUSES: &str = include_str!("../../../../golden/tables/statuses.md");

/// What a test measured of the estimate of the error of the mesh.
const MESH_ERRORS: &str = include_str!("../../../../golden/tables/mesh_errors.md");

/// Returns the cells of the rows of a table, its head the first.
fn rows(table: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let rows = table.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.map(|row| row.split(" | ").collect())
}

/// Says how the estimate of the error of the mesh compares with the error.
pub(super) fn how_good_is_the_estimate() -> String {
    let last = |cells: Vec<&str>| cells.last().and_then(|cell| cell.parse().ok());
    let mut quotients: Vec<f64> = rows(MESH_ERRORS).filter_map(last).collect();
    quotients.sort_by(f64::total_cmp);
    format!(
        "Beside a mesh 64 times finer it was below the error in {} of {} runs, at the median {:.2} of it \
         (plane-contact guide mesh-errors)",
        quotients.iter().filter(|quotient| **quotient < 1.0).count(),
        quotients.len(),
        quotients[quotients.len() / 2]
    )
}

fn measured(verdict: Verdict, number: f64, detail: impl Into<String>) -> Outcome<'static> {
    Ok(Evidence::new(verdict, number, detail))
}

fn true_if(is_true: bool) -> Verdict {
    if is_true { Verdict::True } else { Verdict::False }
}

/// The largest penetration of a contact node at the end of the scene's variant of the paper, over the
/// largest displacement of the target.
pub(super) fn penetrates(case: &Case) -> Outcome<'_> {
    let variant = case.published_variant();
    let solution = case.run(variant)?;
    let Penetration { node, in_contact, depth, relative } =
        Penetration::of(solution).ok_or("no contact node faces the target")?;
    let pulling = pulling(&solution.contact, solution.model.load.amax());
    let verdict = true_if(relative < NOTICEABLE && pulling.is_empty());
    let pulls = match pulling.len() {
        0 => "no node in contact pulls".to_string(),
        1 => "1 node in contact pulls".into(),
        n => format!("{n} nodes in contact pull"),
    };
    let status = if in_contact { "in contact" } else { "not in contact" };
    let tolerance = solution.model.contact.tolerance;
    let beside = if depth < tolerance { "below" } else { "not below" };
    let inside = match depth == 0.0 {
        true => "nothing penetrates".into(),
        false => format!(
            "node {node}, {status}, ends {depth:.1e} inside the target, {beside} c_tol ({tolerance:.1e})"
        ),
    };
    let measured = Evidence::new(verdict, relative, format!("{variant}: {inside}; {pulls}"));
    Ok(Evidence { variant: Some(variant), ..measured }.on([(variant.name(), solution)]))
}

/// Whether eq. (1) ties what friction would: the largest coefficient that a node in contact needs on the path
/// of the load, where all nodes stick.
pub(super) fn friction_needed(case: &Case) -> Outcome<'_> {
    let sticking = case.sticking()?;
    let needed = case.friction_needed().ok_or("no node is in contact")?;
    let measured = Evidence::new(Verdict::TrueOnlyIf, beyond_noise(needed), "friction");
    Ok(measured.on([("unilateral, sticking", sticking)]))
}

/// Leaves the number out where runs with a little more and a little less friction do not confirm it.
pub(super) fn confirmed(case: &Case, measured: Evidence) -> Evidence {
    if measured.number.is_none() || case.is_least_friction() {
        return measured;
    }
    let detail = "runs with a little more and a little less friction do not confirm the value";
    Evidence { verdict: Verdict::NotCheckable, number: None, detail: detail.into(), ..measured }
}

/// The contact nodes of C7's scene that find another edge where both bodies are moved far away together.
pub(super) fn searches_current(case: &Case) -> Outcome<'_> {
    let finding =
        FINDINGS.iter().find(|finding| finding.id == "C7").expect("an id of the register");
    let own = Case::new(finding.scene()).under(*case.reading())?;
    let model = own.model();
    // A power of two, as coordinates keep their digits best by it.
    let far = model.bounds().larger_side().log2().ceil().exp2();
    let moved: Vec<[f64; 2]> = model.nodes.iter().map(|[x, y]| [x + far, y + far]).collect();
    let edges =
        |shape: &[[f64; 2]]| Call::c_cnt(model, own.reading(), shape).map(|call| call.pairs.ct);
    let (before, after) = (edges(&model.nodes)?, edges(&moved)?);
    if before.iter().all(|edge| *edge == 0) {
        return Err("no node finds an edge".into());
    }
    let others = before.iter().zip(after.iter()).filter(|(before, after)| before != after).count();
    measured(true_if(others == 0), others as f64, "lines 5 to 7 take node_n")
}

/// The share of the nodes in contact that the sign rule misses where the stamp jumped to twice c_tll.
pub(super) fn signs_go_wrong(_: &Case) -> Outcome<'_> {
    let rows: Vec<_> = rows(STATUSES).filter(|cells| cells[0].starts_with('2')).collect();
    let [below, above] = &rows[..] else { return Err("no such depth".into()) };
    let share =
        |row: &[&str]| Ok::<_, ParseFloatError>(row[3].parse::<f64>()? / row[2].parse::<f64>()?);
    let sample = |row: &[&str]| format!("target {}: {} of {} missed", row[1], row[3], row[2]);
    let (share_below, share_above) = (share(below)?, share(above)?);
    let detail = format!("{}, {}", sample(below), sample(above));
    measured(true_if(share_below.max(share_above) < NOTICEABLE), share_below, detail)
}

/// Operations of the intersection over those of the sign rule.
pub(super) fn fewer_operations(_: &Case) -> Outcome<'_> {
    let rows = rows(STATUSES).filter(|cells| cells[0].starts_with("operations"));
    let row = rows.last().ok_or("no such row")?;
    let quotient: f64 = row[5].parse()?;
    measured(true_if(quotient > 1.0), quotient, row[0])
}

/// The largest difference of a node's displacement between c_tll and a thousandth of it, over the largest
/// displacement, under the scene's variant of the paper.
pub(super) fn tolerance(case: &Case) -> Outcome<'_> {
    case.model().target().ok_or("the scene has no contact")?;
    let variant = case.published_variant();
    let (own, least) = (case.run(variant)?, case.finer()?);
    let [tolerance, finer] = [own, least].map(|run| run.model.contact.tolerance);
    let change = distance(least, own).displacement_relative;
    let [own_largest, least_largest] = [own, least].map(|run| max_displacement(&run.u));
    let detail = format!(
        "{variant}, from {tolerance:e} to {finer:e}; the largest displacement is then {} of what it was",
        percent(over(least_largest, own_largest))
    );
    let measured = Evidence::new(true_if(change < NOTICEABLE), change, detail);
    Ok(measured.on([(variant.name(), own), ("with a thousandth of c_tol", least)]))
}

/// The final period of the contact state of `tied`, iterations; 1 = settled, 0 = none yet.
pub(super) fn settles(case: &Case) -> Outcome<'_> {
    let tied = case.run(Variant::Tied)?;
    let length = tied.last().cycle.as_ref().map_or(0, |cycle| cycle.length);
    let detail = match length {
        0 => "the contact state is new in the last iteration",
        1 => "the contact state has settled",
        _ => "the contact state repeats in a cycle",
    };
    let measured = Evidence::new(true_if(length == 1), length as f64, detail);
    Ok(measured.on([(Variant::Tied.name(), tied)]))
}

/// The smallest distance in the energy norm of the paper's variants from the equilibrium under the
/// scene's own friction on the same mesh.
pub(super) fn error_of_the_reading(case: &Case) -> Outcome<'_> {
    let equilibrium = case.equilibrium().ok_or("there is no equilibrium to compare with")?;
    let runs = Variant::OF_THE_PAPER.iter().filter_map(|variant| case.run(*variant).ok());
    let distances: Vec<(f64, &Solution)> =
        runs.map(|run| (apart(run, equilibrium).energy_relative, run)).collect();
    let nearest = nearest(&distances).ok_or("no variant of the paper runs")?;
    let least = distances[nearest[0]].0;
    let runs = nearest.iter().map(|k| (distances[*k].1.request.variant.name(), distances[*k].1));
    let names: Vec<&str> = runs.clone().map(|(name, _)| name).collect();
    let detail = match names[..] {
        [variant] => format!("{variant} is the nearest variant"),
        _ => format!("{} are equally near", names.join(" and ")),
    };
    let measured = Evidence::new(true_if(least < NOTICEABLE), least, detail);
    let variant = Some(distances[nearest[0]].1.request.variant);
    let measured = Evidence { variant, ..measured };
    Ok(measured.on(runs.chain([("equilibrium", equilibrium)])))
}

/// The places of the least of distances: several where they are equally near.
pub(in crate::audit) fn nearest<T>(distances: &[(f64, T)]) -> Option<Vec<usize>> {
    let finite = |k: &usize| distances[*k].0.is_finite();
    let least = (0..distances.len()).filter(finite).map(|k| distances[k].0).reduce(f64::min)?;
    let is_least = |k: &usize| !moves(Some(distances[*k].0), Some(least), 1.0);
    Some((0..distances.len()).filter(is_least).collect())
}
