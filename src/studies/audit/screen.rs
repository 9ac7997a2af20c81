//! The first screen of an audit: a verdict to quote, the runs beside the equilibrium, the statements by how far
//! their verdicts reach, the faults by what they cost, what was assumed, and where more stands.

use crate::audit::claims::table as claims;
use crate::audit::claims::{JudgedClaim, Scope, Verdict};
use crate::audit::conclusion::words as conclusion;
use crate::audit::conclusion::{Conclusion, Coupled, NearRun, of_the_paper};
use crate::audit::prices::table as prices;
use crate::audit::prices::{Price, Weight};
use crate::audit::range::is_example;
use crate::audit::variants::{End, VariantRow};
use crate::audit::{Assumption, Audit, Compared};
use crate::calculix::RECORDED;
use engine::BodySummary;
use problem::scene::Scene;
use report::layout::{counted, first_line, listed};
use report::model::{Cell, Report, Table};
use report::numbers::{or_dash, percent, significant, with_unit};
use report::tables::UNDERESTIMATE;

/// The most columns of the screen.
pub const WIDTH: usize = 100;

/// What is judged, and what is not.
pub const JUDGED: [&str; 2] = [
    "Judged: the listings c_cnt and Km as printed, and eq. (1) as the text has it.",
    "Not judged: the worksheet that the authors ran, which is not public, and misprints.",
];

/// What a mark at a claim says.
pub const OURS: &str =
    "*: the threshold, or a part of the statement, is this audit's; the paper gives none.";

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
    /// What is to be said of the runs.
    pub notes: Vec<String>,
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
        let contact = conclusion.coupled.as_ref().map(|_| OfContact {
            runs: runs(audit, scene),
            notes: error_of_the_mesh(conclusion).into_iter().chain(inside(audit, scene)).collect(),
            statements: statements(&audit.claims),
            faults: faults(&audit.prices),
            assumed: &audit.assumptions,
        });
        Screen { verdict: verdict(audit, conclusion), contact }
    }
}

/// Reports the first screen.
pub fn report(audit: &Audit, conclusion: &Conclusion, scene: &Scene) -> Report {
    let under = claims::under(&conclusion.reading);
    let Screen { verdict, contact } = Screen::new(audit, conclusion, scene);
    let report = Report::titled(format!(
        "Audit of Filipov & Khomenko, \"Plane contact by the finite element method\", on scene {}{under}",
        scene.name
    ))
    .line(JUDGED.join(" "))
    .heading("Verdict")
    .notes(verdict);
    let Some(OfContact { runs, notes, statements, faults, assumed }) = contact else {
        return report.line(more(scene));
    };
    report
        .table(RUNS, runs)
        .notes(notes)
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
            "Assumed, as the paper is silent: {}.",
            assumed.iter().map(Assumption::to_string).collect::<Vec<_>>().join("; ")
        ))
        .line(more(scene))
}

/// Says in sentences to quote whether the print couples the bodies, and how far its nearest run is off.
fn verdict(audit: &Audit, conclusion: &Conclusion) -> Vec<String> {
    let coupled = match &conclusion.coupled {
        Some(Coupled { joins: Some(0), share: Some(share), .. }) => format!(
            "As printed, Km adds no entry that joins the two bodies (K1): {} of the load reaches the target.",
            percent(*share, 0)
        ),
        other => conclusion::coupling(other.as_ref()),
    };
    let nearest = conclusion.nearest.as_ref().map(|nearest| {
        let runs = &nearest.runs;
        format!(
            "Of {} {} {} nearest to the equilibrium: {} from it in the energy norm, on the same mesh.",
            counted(nearest.tried, "run of the paper's algorithm", "runs of the paper's algorithm"),
            listed(runs.iter().map(short_name)),
            if runs.len() == 1 { "is" } else { "are equally" },
            percent(runs[0].energy, 0)
        )
    });
    let other_code = audit.claims.iter().find(|judged| judged.claim.id == "P13");
    let other_code = other_code.filter(|judged| judged.measured.verdict == Verdict::NotCheckable);
    let other_code =
        other_code.map(|_| "Agreement with the commercial code cannot be checked (P13).".into());
    std::iter::once(coupled).chain(nearest).chain(other_code).collect()
}

/// Names a run, with its reading where that is not the default.
fn short_name(NearRun { variant, reading, .. }: &NearRun) -> String {
    reading.as_ref().map_or(variant.to_string(), |reading| format!("{variant} ({reading})"))
}

/// The paper's variants, and the equilibrium.
fn runs(audit: &Audit, scene: &Scene) -> Table {
    let bodies: Vec<&str> = scene.model.bodies.iter().map(|body| body.name.as_str()).collect();
    let stress =
        format!("{}: {}", with_unit("von Mises,", &scene.units.stress), bodies.join(" / "));
    let rows = of_the_paper(&audit.variants)
        .map(|(_, row)| run(row))
        .chain(audit.equilibrium.as_ref().map(equilibrium))
        .chain(is_example(scene).then(calculix));
    Table::new(["run", "load passed on", "nodes in contact", &stress, "error in energy"], rows)
}

fn run(row: &VariantRow) -> Vec<Cell> {
    let name = row.variant.to_string().into();
    match &row.end {
        End::Failure { failure } => vec![name, Cell::Empty, failure.in_short().into()],
        End::Result { in_contact, target_share, cycle, bodies, distance, .. } => {
            let nodes = match cycle {
                Some(cycle) if cycle.length > 1 => {
                    let mut counts: Vec<usize> =
                        cycle.members.iter().map(|k| in_contact[k - 1]).collect();
                    counts.sort_unstable();
                    counts.dedup();
                    format!("alternates, {}", listed(counts))
                }
                _ => in_contact.last().map_or("-".into(), usize::to_string),
            };
            let error = distance.as_ref().map(|from| Cell::percent(from.energy_relative, 0));
            vec![
                name,
                Cell::percent(*target_share, 0),
                nodes.into(),
                stresses(bodies).into(),
                error.into(),
            ]
        }
    }
}

fn equilibrium(found: &Compared) -> Vec<Cell> {
    let nodes = found.in_contact.to_string();
    vec![
        "equilibrium".into(),
        Cell::percent(found.target_share, 0),
        nodes.into(),
        stresses(&found.bodies).into(),
        Cell::Empty,
    ]
}

/// CalculiX's recorded figures.
fn calculix() -> Vec<Cell> {
    let stresses = RECORDED.map(|(_, stress)| significant(stress, 3)).join(" / ");
    vec!["CalculiX, recorded".into(), Cell::Empty, Cell::Empty, stresses.into()]
}

fn stresses(bodies: &[BodySummary]) -> String {
    let each = bodies.iter().map(|body| significant(body.max_von_mises_stress, 3));
    each.collect::<Vec<_>>().join(" / ")
}

fn error_of_the_mesh(conclusion: &Conclusion) -> Option<String> {
    let error = conclusion.fields.as_ref()?.errors.mesh_energy_relative?;
    Some(format!("Error of the mesh in the equilibrium: {}, {UNDERESTIMATE}.", percent(error, 0)))
}

/// Says which node ends deepest inside the target, and how many in contact pull, under the paper's variants that
/// pass a load on.
fn inside(audit: &Audit, scene: &Scene) -> Vec<String> {
    let said = |row: &VariantRow| match &row.end {
        End::Result { penetration: Some(found), pulling, transmits_nothing: false, .. }
            if found.depth > 0.0 =>
        {
            let depth = with_unit(&significant(found.depth, 2), &scene.units.length);
            let status = if found.in_contact { "in contact" } else { "not in contact" };
            let pulls = match pulling.len() {
                0 => String::new(),
                n => format!("; {}", counted(n, "node in contact pulls", "nodes in contact pull")),
            };
            Some(format!(
                "{}: node {}, {status}, ends {depth} inside the target{pulls}.",
                row.variant, found.node
            ))
        }
        End::Result { .. } | End::Failure { .. } => None,
    };
    of_the_paper(&audit.variants).filter_map(|(_, row)| said(row)).collect()
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
    let scopes =
        Scope::ALL.iter().filter(|scope| judged.iter().any(|judged| judged.scope == **scope));
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
        let far = or_dash(price.outcome.from_equilibrium(), |far| percent(far, 0));
        (if price.outcome.is_settled() { far } else { format!("{far}, does not settle") }, price)
    });
    let rounding = of(Weight::Rounding).map(|price| (Weight::Rounding.to_string(), price));
    let own = or_dash(prices[0].outcome.from_equilibrium(), |own| percent(own, 0));
    let free = prices::of_weight(prices, Weight::Free);
    let none = prices::of_weight(prices, Weight::NoFault);
    let free =
        [own, listed(free), "no more than the corrected algorithm, which has no friction".into()];
    let none = (!none.is_empty())
        .then(|| ["none".into(), listed(none), "no fault here, as no node slides".into()]);
    Ok(Faults {
        dear: fatal.chain(shifts).chain(rounding).collect(),
        others: std::iter::once(free).chain(none).collect(),
    })
}

fn more(scene: &Scene) -> String {
    let name = &scene.word;
    format!(
        "More: audit {name} --full | audit {name} --claim P12 | audit {name} --finding K1 | audit --range | report {name}"
    )
}
