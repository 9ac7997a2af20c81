//! How claims are measured.

use super::{Evidence, Verdict};
use crate::audit::Case;
use crate::audit::evidence::{Outcome, beyond_noise};
use crate::audit::findings::{Finding, FindingId};
use crate::audit::variants::{Penetration, apart};
use engine::contact::pulling;
use engine::estimates::moves;
use engine::{Solution, distance, max_displacement, over};
use output::layout::counted;
use output::numbers::percent;
use paper::door::Call;
use problem::modelling::Variant;

/// A relative change that shows in a picture: one part in a hundred.
pub(in crate::audit) const NOTICEABLE: f64 = 0.01;

/// Where the target lies in random scenes in which the stamp jumped to twice c_tll, the nodes in contact,
/// and those of them that the sign rule missed, as `golden/tables/statuses.md` has them.
const JUMPS: [(&str, f64, f64); 2] = [("below", 232.0, 215.0), ("above", 239.0, 130.0)];

/// Operations of the intersection over those of the sign rule, on the largest surfaces of the same table.
const OPERATIONS: f64 = 4.60;

fn true_if(is_true: bool) -> Verdict {
    if is_true { Verdict::True } else { Verdict::False }
}

/// The largest penetration of a contact node at the end of the scene's variant of the paper, over the
/// largest displacement of the target.
pub(super) fn penetrates(case: &Case) -> Outcome<Evidence> {
    let variant = case.published_variant();
    let solution = case.run(variant)?;
    let Penetration { node, in_contact, depth, relative } =
        Penetration::of(solution).ok_or("no contact node faces the target")?;
    let pulling = pulling(&solution.contact, solution.model.load.amax());
    let verdict = true_if(relative < NOTICEABLE && pulling.is_empty());
    let pulls = match pulling.len() {
        0 => "no node in contact pulls".into(),
        n => counted(n, "node in contact pulls", "nodes in contact pull"),
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
pub(super) fn friction_needed(case: &Case) -> Outcome<Evidence> {
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
pub(super) fn searches_current(case: &Case) -> Outcome<Evidence> {
    let own = Case::new(Finding::of(FindingId::C7).scene()).under(*case.reading())?;
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
    Ok(Evidence::new(true_if(others == 0), others as f64, "lines 5 to 7 take node_n"))
}

/// The share of the nodes in contact that the sign rule misses where the stamp jumped to twice c_tll.
pub(super) fn signs_go_wrong(_: &Case) -> Outcome<Evidence> {
    let [below, above] = JUMPS.map(|(_, in_contact, missed)| missed / in_contact);
    let samples = JUMPS.map(|(target, in_contact, missed)| {
        format!("target {target}: {missed} of {in_contact} missed")
    });
    Ok(Evidence::new(true_if(below.max(above) < NOTICEABLE), below, samples.join(", ")))
}

/// Operations of the intersection over those of the sign rule.
pub(super) fn fewer_operations(_: &Case) -> Outcome<Evidence> {
    let detail = "operations on 256 target edges, over those of `signs`";
    Ok(Evidence::new(true_if(OPERATIONS > 1.0), OPERATIONS, detail))
}

/// The largest difference of a node's displacement between c_tll and a thousandth of it, over the largest
/// displacement, under the scene's variant of the paper.
pub(super) fn tolerance(case: &Case) -> Outcome<Evidence> {
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
pub(super) fn settles(case: &Case) -> Outcome<Evidence> {
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
pub(super) fn error_of_the_reading(case: &Case) -> Outcome<Evidence> {
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
