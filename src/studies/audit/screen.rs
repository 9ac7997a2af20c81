//! The first screen of an audit: a verdict to quote, the runs beside the equilibrium, the statements by how far
//! their verdicts reach, the faults by what they cost, what was assumed, and where more stands.

use crate::audit::claims::table as claims;
use crate::audit::claims::{JudgedClaim, Scope, Verdict};
use crate::audit::conclusion::words as conclusion;
use crate::audit::conclusion::{Conclusion, Coupled, NearRun, of_the_paper};
use crate::audit::prices::table as prices;
use crate::audit::prices::{Price, Weight};
use crate::audit::range::is_example;
use crate::audit::variants::{End, PressedAcross, VariantRow};
use crate::audit::{Assumption, Audit};
use crate::calculix::RECORDED;
use engine::BodySummary;
use paper::mirror::Reading;
use problem::modelling::Variant;
use problem::scene::Scene;
use report::layout::{counted, first_line, listed};
use report::model::{Cell, Report, Table};
use report::numbers::{figure, or_dash, percent, with_unit};
use report::tables::UNDERESTIMATE;

/// The most columns of the screen.
pub const WIDTH: usize = 100;

/// What is judged, and what is not.
pub const JUDGED: [&str; 2] = [
    "Judged: listings c_cnt and Km as printed, eq. (1) as the text has it.",
    "Not judged: the authors' unpublished worksheet; whether a line is a misprint.",
];

/// What a mark at a claim says.
pub const OURS: &str = "*: the threshold or the wording is this audit's; the paper gives none.";

/// What the runs of the table are.
pub const RUNS: &str =
    "Runs of the paper's algorithm, and the equilibrium under the scene's own friction";

/// What the faults are, and what stands beside each.
pub const FAULTS: &str = "Faults, each put back alone into the corrected algorithm, with the distance from the equilibrium";

/// The parts of the first screen, of which the terminal and the page are renderings.
pub struct Screen<'a> {
    /// The sentences to quote.
    pub verdict: Vec<String>,
    /// What contact leads to; nothing where the scene has none.
    pub contact: Option<OfContact<'a>>,
}

/// What the first screen shows of a scene with contact.
pub struct OfContact<'a> {
    /// The runs beside the equilibrium.
    pub runs: Table,
    /// The error of the mesh in the equilibrium.
    pub mesh_error: Option<String>,
    /// What is wrong with the runs that are not the nearest, whose faults stand in the verdict.
    pub others: Vec<String>,
    /// The ids of the claims by verdict, in a row for each scope.
    pub statements: Table,
    /// What each fault costs, the dearest first; or why that is not known.
    pub faults: Result<Faults<'a>, String>,
    /// What the paper leaves open.
    pub assumed: &'a [Assumption],
}

/// The faults by what they cost.
pub struct Faults<'a> {
    /// The cost of each that costs something.
    pub dear: Vec<(String, &'a Price)>,
    /// Those that cost nothing, and those that are none here: the distance, their names, and what is said of them.
    pub others: Vec<[String; 3]>,
}

impl<'a> Screen<'a> {
    /// Collects the parts.
    pub fn new(audit: &'a Audit, conclusion: &Conclusion, scene: &Scene) -> Self {
        let others = of_the_paper(&audit.variants).filter(|(_, row)| !is_nearest(conclusion, row));
        let error = conclusion.fields.as_ref().and_then(|of| of.errors.mesh_energy_relative);
        let contact = conclusion.coupled.as_ref().map(|_| OfContact {
            runs: runs(audit, scene),
            mesh_error: error.map(|error| {
                format!(
                    "Error of the mesh in the energy norm: {}, {UNDERESTIMATE}.",
                    percent(error)
                )
            }),
            others: others.filter_map(|(_, row)| evidence(row, scene)).collect(),
            statements: statements(&audit.claims),
            faults: faults(&audit.prices),
            assumed: &audit.assumptions,
        });
        Screen { verdict: verdict(audit, conclusion, scene), contact }
    }
}

/// Reports the first screen.
pub fn report(audit: &Audit, conclusion: &Conclusion, scene: &Scene) -> Report {
    let under = claims::under(&conclusion.reading);
    let name = &scene.word;
    let more = format!(
        "More: audit {name} --full | audit {name} --claim P12 | audit {name} --finding K1 | audit --range | report {name}"
    );
    let Screen { verdict, contact } = Screen::new(audit, conclusion, scene);
    let report = Report::titled(format!(
        "Audit of Filipov & Khomenko, \"Plane contact by the finite element method\", on scene {}{under}",
        scene.name
    ))
    .line(JUDGED.join(" "))
    .heading("Verdict")
    .notes(verdict);
    let Some(OfContact { runs, mesh_error, others, statements, faults, assumed }) = contact else {
        return report.line(more);
    };
    report
        .table(RUNS, runs)
        .notes(mesh_error)
        .notes(others)
        .table(format!("The paper's {}", claims::counts()), statements)
        .note(format!("{OURS} audit --claim P12 explains one."))
        .heading(FAULTS)
        .notes(match faults {
            Ok(Faults { dear, others }) => {
                let dear = dear.iter().map(|(cost, price)| format!("{cost}: {}", price));
                dear.chain(others.into_iter().map(|row| row.join(": "))).collect()
            }
            Err(why) => vec![why],
        })
        .line(format!(
            "{}: {}.",
            assumed_in(scene),
            assumed.iter().map(Assumption::to_string).collect::<Vec<_>>().join("; ")
        ))
        .line(more)
}

/// Says in sentences to quote whether the print couples the bodies, and how far its nearest run is off.
fn verdict(audit: &Audit, conclusion: &Conclusion, scene: &Scene) -> Vec<String> {
    let coupled = match &conclusion.coupled {
        Some(Coupled { joins: Some(0), share: Some(share), .. }) => format!(
            "As printed, Km adds no entry that joins the two bodies (K1): {} of the load reaches the target.",
            percent(*share)
        ),
        other => conclusion::coupling(other.as_ref()),
    };
    let nearest = match &conclusion.nearest {
        Some(nearest) => Some(format!(
            "The nearest of {}, {}, {} {} from the equilibrium (energy norm, same mesh).",
            counted(nearest.tried, "run", "runs"),
            listed(nearest.runs.iter().map(described)),
            if nearest.runs.len() == 1 { "is" } else { "are" },
            percent(nearest.runs[0].energy)
        )),
        None if conclusion.coupled.is_none() => None,
        None if conclusion.fields.is_none() => Some(
            "There is no equilibrium to compare with: no run, fault or statement is judged by its distance from one."
                .into(),
        ),
        None => Some("No run of the paper's algorithm ends with a result.".into()),
    };
    let is_example = is_example(scene);
    let range = (is_example && conclusion.reading == Reading::default()).then(conclusion::recorded);
    let strongest = of_the_paper(&audit.variants).filter(|(_, row)| is_nearest(conclusion, row));
    let strongest = strongest.filter_map(|(_, row)| Some((row.variant, evidence(row, scene)?)));
    let strongest = strongest.enumerate().map(|(k, (variant, words))| match variant {
        Variant::Tied | Variant::Stepped if k == 0 => {
            format!("Eq. (1) gets contact wrong here. {words}")
        }
        Variant::Tied | Variant::Stepped | Variant::Printed | Variant::Unilateral => words,
    });
    let is_unknown = |judged: &JudgedClaim| {
        judged.claim.id == "P13" && judged.measured.verdict == Verdict::NotCheckable
    };
    let other_code = (is_example && audit.claims.iter().any(is_unknown))
        .then(|| "Agreement with the commercial code cannot be checked (P13).".into());
    let overlap = audit.equilibrium.iter().filter_map(|found| found.overlap.as_ref());
    overlap
        .map(|what| format!("Of the equilibrium that runs are compared with: {what}"))
        .chain([coupled])
        .chain(nearest)
        .chain(range)
        .chain(strongest)
        .chain(other_code)
        .collect()
}

/// Whether a variant is one of the nearest, whose evidence stands in the verdict.
fn is_nearest(conclusion: &Conclusion, row: &VariantRow) -> bool {
    let mut runs = conclusion.nearest.iter().flat_map(|nearest| &nearest.runs);
    runs.any(|run| run.reading.is_none() && run.variant == row.variant)
}

/// Names a run and says what it is, with its reading where that is not the default.
fn described(NearRun { variant, reading, unsettled, .. }: &NearRun) -> String {
    let what = match variant {
        Variant::Stepped => "eq. (1) in load steps",
        Variant::Tied => "eq. (1) under the whole load",
        Variant::Printed => "Km as printed",
        Variant::Unilateral => "the contact solution",
    };
    let reading = reading.as_ref().map_or(String::new(), |reading| format!(", {reading}"));
    let unsettled = if *unsettled { ", unsettled" } else { "" };
    format!("\"{variant}\" ({what}{reading}{unsettled})")
}

/// The paper's variants, and the equilibrium.
fn runs(audit: &Audit, scene: &Scene) -> Table {
    let bodies: Vec<&str> = scene.model.bodies.iter().map(|body| body.name.as_str()).collect();
    let stress =
        format!("{}: {}", with_unit("von Mises,", &scene.units.stress), bodies.join(" / "));
    let equilibrium = audit.equilibrium.as_ref().map(|found| {
        let share = found.target_share.map(Cell::percent).into();
        let stresses = stresses(&found.bodies, found.mesh_error).into();
        vec![
            "equilibrium".into(),
            share,
            found.in_contact.to_string().into(),
            stresses,
            Cell::Empty,
        ]
    });
    // CalculiX's recorded figures, which no run of this audit makes.
    let calculix = is_example(scene).then(|| {
        let stresses = RECORDED.map(|(_, stress)| stress.to_string()).join(" / ");
        vec!["CalculiX".into(), Cell::Empty, Cell::Empty, stresses.into()]
    });
    let of_the_paper = of_the_paper(&audit.variants).map(|(_, row)| run(row));
    let rows = of_the_paper.chain(equilibrium).chain(calculix);
    Table::new(["run", "load passed on", "nodes in contact", &stress, "error, energy norm"], rows)
}

fn run(row: &VariantRow) -> Vec<Cell> {
    let name = row.variant.to_string().into();
    match &row.end {
        End::Failure { failure } => vec![name, Cell::Empty, failure.in_short().into()],
        End::Result { in_contact, target_share, cycle, bodies, distance, mesh_error, .. } => {
            let nodes = match cycle {
                Some(cycle) if cycle.length > 1 => {
                    let mut counts: Vec<usize> =
                        cycle.members.iter().map(|k| in_contact[k - 1]).collect();
                    counts.sort_unstable();
                    counts.dedup();
                    format!("unsettled: {}", listed(counts))
                }
                _ => in_contact.last().map_or("-".into(), usize::to_string),
            };
            let error = distance.as_ref().map(|from| Cell::percent(from.energy_relative));
            vec![
                name,
                target_share.map(Cell::percent).into(),
                nodes.into(),
                stresses(bodies, *mesh_error).into(),
                error.into(),
            ]
        }
    }
}

fn stresses(bodies: &[BodySummary], error: Option<f64>) -> String {
    let each = bodies.iter().map(|body| figure(body.max_von_mises_stress, error));
    each.collect::<Vec<_>>().join(" / ")
}

/// Says what is wrong with a run that passes a load on: which node is pressed across an open gap, which ends inside
/// the target, how many pull, and how far a symmetric scene answers unsymmetrically.
fn evidence(row: &VariantRow, scene: &Scene) -> Option<String> {
    let End::Result {
        penetration,
        pulling,
        transmits_nothing: false,
        across,
        asymmetry,
        mesh_error,
        ..
    } = &row.end
    else {
        return None;
    };
    let length = |x: f64| with_unit(&figure(x, *mesh_error), &scene.units.length);
    let across = across.map(|PressedAcross { node, pressure, gap }| {
        let pressure = with_unit(&figure(pressure, *mesh_error), &scene.units.stress);
        let (gap, c_tol) = (length(gap), scene.model.contact.tolerance);
        format!(
            "node {node} is pressed with {pressure} across an open gap of {gap} (c_tol {c_tol})"
        )
    });
    let inside = penetration.filter(|found| found.depth > 0.0).map(|found| {
        let status = if found.in_contact { "though in contact" } else { "carries nothing" };
        format!("node {}, {} inside the target, {status}", found.node, length(found.depth))
    });
    let pulls = (!pulling.is_empty())
        .then(|| counted(pulling.len(), "node in contact pulls", "nodes in contact pull"));
    let mirrored = asymmetry.filter(|part| *part > 0.0).map(percent).map(|part| {
        format!("the symmetric scene answers unsymmetrically, by {part} of the largest |u|")
    });
    let faults: Vec<String> = [across, inside, pulls, mirrored].into_iter().flatten().collect();
    let unsettled = if row.end.is_unsettled() { " (unsettled)" } else { "" };
    (!faults.is_empty()).then(|| format!("Under {}{unsettled} {}.", row.variant, faults.join("; ")))
}

/// The statements by verdict, in a row for each scope.
fn statements(judged: &[JudgedClaim]) -> Table {
    let of = |scope: Scope, verdict: Verdict| {
        let found = judged.iter().filter(|judged| judged.scope == scope);
        let found = found.filter(|judged| judged.measured.verdict == verdict);
        let mark = |is_ours| if is_ours { "*" } else { "" };
        let ids = found.map(|judged| format!("{}{}", judged.claim.id, mark(judged.claim.is_ours)));
        Cell::from(ids.collect::<Vec<_>>().join(" "))
    };
    let scopes = Scope::ALL.iter().filter(|scope| judged.iter().any(|own| own.scope == **scope));
    let rows = scopes.map(|scope| {
        let cells = Verdict::ALL.iter().map(|verdict| of(*scope, *verdict));
        std::iter::once(scope.to_string().into()).chain(cells).collect()
    });
    let headings = Verdict::ALL.iter().map(|verdict| verdict.name());
    Table::new(std::iter::once("verdict holds on").chain(headings), rows)
}

/// Returns what each fault costs, the dearest first.
fn faults(prices: &Result<Vec<Price>, String>) -> Result<Faults<'_>, String> {
    let prices =
        prices.as_ref().map_err(|why| format!("Not measured here: {}", first_line(why)))?;
    if let Some(why) = prices::unsound(prices) {
        return Err(format!("{why}: no fault is priced."));
    }
    let of = |weight| prices.iter().filter(move |price| price.weight == weight);
    let fatal = of(Weight::Fatal).map(|price| ("fatal".to_string(), price));
    let shifts = conclusion::shifts(prices).into_iter().map(|k| {
        let price = &prices[k];
        let far = or_dash(price.outcome.from_equilibrium(), percent);
        (if price.outcome.is_settled() { far } else { format!("{far}, does not settle") }, price)
    });
    let rounding = of(Weight::Rounding).map(|price| (Weight::Rounding.to_string(), price));
    let own = prices[0].outcome.from_equilibrium();
    let own = own.map_or("no equilibrium to compare with".into(), percent);
    let as_far = "these cost nothing: the corrected algorithm is as far, without friction";
    let mut others = vec![[own, listed(prices::of_weight(prices, Weight::Free)), as_far.into()]];
    let none = prices::of_weight(prices, Weight::NoFault);
    if !none.is_empty() {
        others.push(["none".into(), listed(none), "no fault here, as no node slides".into()]);
    }
    Ok(Faults { dear: fatal.chain(shifts).chain(rounding).collect(), others })
}

/// Says what stands before the assumptions.
pub fn assumed_in(scene: &Scene) -> &'static str {
    if is_example(scene) { "Assumed, as the paper is silent" } else { "The scene" }
}
