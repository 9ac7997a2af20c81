//! What an audit says: a verdict, the runs beside the equilibrium, the claims by how far their
//! verdicts reach, the faults by what they cost, what was assumed; and behind that, in full, what it rests
//! on.

use crate::audit::claims::claim_tables as claims;
use crate::audit::claims::{JudgedClaim, NOTICEABLE, Scope, Verdict};
use crate::audit::conclusion::{Coupled, Fields, Nearest, of_the_paper};
use crate::audit::evidence::{BY_ROUNDING, NoFigures};
use crate::audit::prices::Price;
use crate::audit::prices::price_tables as prices;
use crate::audit::range::{self, is_example};
use crate::audit::variants::{PressedAcross, VariantRow, VariantRun};
use crate::audit::{Assumption, Audit, tables};
use crate::calculix::RECORDED;
use engine::BodySummary;
use output::layout::{counted, listed};
use output::model::{Cell, Report, Table};
use output::numbers::{figure, percent, with_unit};
use output::tables::PROBABLY_MORE;
use paper::mirror::Reading;
use problem::modelling::Variant;
use problem::scene::Scene;

/// The most columns of the first screen.
pub const WIDTH: usize = 100;

/// What is judged.
pub const JUDGED: &str = "Judged: listings c_cnt and Km as printed, eq. (1) as the text has it.";

/// What no run decides.
const NOT_CHECKED: &str = "What cannot be checked: the authors' unpublished worksheet, agreement with the commercial code, whether a \
     line is a misprint (P13).";

/// What a mark at a claim says.
const OURS: &str = "*: threshold or wording is this audit's. audit --claim P12 explains one.";

/// What the runs of the table are.
const RUNS: &str = "Runs of the paper's algorithm beside the equilibrium";

/// Where all faults stand.
const ALL_FAULTS: &str = "All: table \"Each fault alone\".";

/// How many faults the first screen has.
const DEAREST: usize = 3;

/// Where the clearance comes from.
const CLEARANCE: &str = "The clearance of 0.1 mm is ours: with it contact spans several nodes, as in figure 1. Real ducts are wider.";

/// What holds in wider ducts under the default reading, as golden/tables/range.md has it.
pub const WIDER: &str = "From a clearance of 0.9 mm on neither P10 nor P11 is false (true, or decided by rounding); from 5 mm on both are true \
     (plane-contact guide range).";

/// How much of an audit is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// The first screen of `audit`, and the first page of `report`.
    Screen,
    /// All, as `audit --full` prints it.
    Full,
}

/// A part of the first screen.
pub struct Section {
    /// Its name: on the page its class.
    pub name: &'static str,
    /// Its heading; nothing where its table has a title.
    pub heading: Option<&'static str>,
    /// What it says.
    pub content: Report,
}

impl Section {
    fn new(name: &'static str, heading: impl Into<Option<&'static str>>, content: Report) -> Self {
        Section { name, heading: heading.into(), content }
    }

    fn report(self) -> Report {
        self.heading.into_iter().fold(Report::default(), Report::heading).then(self.content)
    }
}

/// Reports an audit.
pub fn report(audit: &Audit, depth: Depth) -> Report {
    let Audit { scene, conclusion, .. } = audit;
    let (name, under) = (&scene.word, claims::under(&conclusion.reading));
    let first = Report::titled(format!(
        "Audit of Filipov & Khomenko, \"Plane contact by the finite element method\", on scene {}{under}",
        scene.name
    ))
    .line(JUDGED);
    let sections = sections(audit, depth).into_iter().map(Section::report);
    let first = sections.fold(first, Report::then);
    match depth {
        Depth::Full => first.then(evidence(audit, &[])),
        Depth::Screen => first.line(format!(
            "More: audit {name} --full | audit {name} --finding K1 | audit --range | report {name}"
        )),
    }
}

/// Returns the parts of the first screen: of a scene without contact the verdict alone.
pub fn sections(audit: &Audit, depth: Depth) -> Vec<Section> {
    let verdict = Report::default().notes(verdict(audit));
    let mut sections = vec![Section::new("verdict", answer(audit), verdict)];
    if audit.conclusion.coupled.is_none() {
        return sections;
    }
    let recorded = is_example(&audit.scene).then_some("CalculiX: a recorded run (guide calculix).");
    let runs = Report::default().table(RUNS, runs(audit)).notes(recorded);
    let runs = runs.notes(mesh_error(audit));
    sections.push(Section::new("runs", None, runs));
    // In full, the tables of claims and prices have these.
    if depth != Depth::Full {
        let judged = Report::default()
            .table(format!("The paper's {}", claims::counts()), by_scope(&audit.claims))
            .note(OURS);
        let names = audit.assumptions.iter().map(|own| own.what.split(" (").next());
        let names = names.flatten().collect::<Vec<_>>().join("; ");
        let assumed = Report::default().line(format!("{}: {names}.", assumed(&audit.scene)));
        sections.extend([
            Section::new("claims", None, judged),
            faults(audit),
            Section::new("assumed", None, assumed),
        ]);
    }
    sections
}

/// Reports what the first screen rests on: what the verdict leaves out, the claims, what the printed faults
/// cost and the way of `repairs` where that was asked for, readings, findings, variants.
pub fn evidence(audit: &Audit, repairs: &[Price]) -> Report {
    let Audit { scene, conclusion, claims, by_reading, prices, .. } = audit;
    let beside = beside(audit);
    let heading = (!beside.is_empty()).then_some("Beside the verdict");
    let open = audit.assumptions.iter().map(Assumption::to_string);
    let open = Report::default().notes(open);
    let title = (!audit.assumptions.is_empty()).then(|| assumed(scene));
    Section::new("assumed", title, open)
        .report()
        .then(Section::new("beside", heading, Report::default().notes(beside)).report())
        .then(claims::report(claims, by_reading))
        .then(prices::section(conclusion.reading, prices, repairs, scene))
        .then(tables::evidence(audit))
}

/// Says in three sentences what joins the bodies, how far the nearest run is off, and what is not checked.
fn verdict(audit: &Audit) -> Vec<String> {
    let Audit { conclusion, .. } = audit;
    let Some(coupled) = &conclusion.coupled else {
        return vec!["The scene has no contact: there is nothing to couple.".into()];
    };
    let nearest = match &conclusion.nearest {
        Some(Nearest { runs, tried, .. }) => {
            let tried = counted(*tried, "run", "runs");
            let nearest = match &runs[..] {
                [run] => format!("The nearest of {tried}, {run}, is"),
                runs => format!("The {} nearest of {tried} are", in_words(runs.len())),
            };
            format!("{nearest} {} from the equilibrium (energy norm).", percent(runs[0].energy))
        }
        None if conclusion.fields.is_none() => {
            "There is no equilibrium to compare with: no run, fault or claim is judged by its distance from one."
                .into()
        }
        None => "No run of the paper's algorithm ends with a result.".into(),
    };
    let overlap = audit.equilibrium.iter().filter_map(|found| found.overlap.as_ref());
    overlap
        .map(|what| format!("Of the equilibrium that runs are compared with: {what}"))
        .chain([coupling(coupled), nearest, NOT_CHECKED.into()])
        .collect()
}

/// Answers whether the print solves the scene.
fn answer(audit: &Audit) -> &'static str {
    let Some(coupled) = &audit.conclusion.coupled else { return "Verdict" };
    let mut rows = audit.variants.iter().filter(|row| row.variant == Variant::Printed);
    let printed = rows.find_map(|row| row.outcome.as_ref().ok()?.distance.as_ref());
    match (printed, coupled) {
        (Some(from), _) if from.energy_relative <= NOTICEABLE => {
            "Yes. As printed the algorithm solves this contact problem, within 1 %."
        }
        (Some(_), _)
        | (
            None,
            Coupled { joins: Some(0), .. } | Coupled { failure: Some(NoFigures::Fails(_)), .. },
        ) => "No. As printed the algorithm does not solve this contact problem.",
        (None, _) => "Not decided: the print has no result here, or there is none to compare with.",
    }
}

/// Writes a small number as a word.
fn in_words(n: usize) -> String {
    let words = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    words.get(n).map_or(n.to_string(), |word| word.to_string())
}

/// Says whether the print couples the bodies.
fn coupling(Coupled { joins, share, failure }: &Coupled) -> String {
    let (joins, id) = match joins {
        None => ("No node comes in contact".to_string(), ""),
        Some(0) => ("Nothing joins the two bodies".into(), " (K1)"),
        Some(n) => (format!("{n} entries of the matrix join the two bodies"), " (K1)"),
    };
    match (share, failure) {
        (Some(share), _) => {
            format!("{joins}: {} of the load reaches the target{id}.", percent(*share))
        }
        (None, Some(NoFigures::Rounding)) => format!("{joins}{id}; the print is {BY_ROUNDING}."),
        (None, Some(why @ NoFigures::Refused(_))) => format!(
            "The paper's variants cannot be asked for this scene: {}.",
            why.in_short().trim_end_matches('.')
        ),
        (None, Some(NoFigures::Fails(_))) => {
            format!("{joins}{id}, and the print stops.")
        }
        (None, None) => format!("{joins}{id}."),
    }
}

/// Says what the verdict leaves out: what is wrong with the other runs, those that have no result or solve
/// another problem, the fields of the nearest, the findings without a price, and what the paper leaves open.
fn beside(audit: &Audit) -> Vec<String> {
    let Audit { scene, conclusion, .. } = audit;
    let wrong = of_the_paper(&audit.variants).filter_map(|row| wrong_with(row, scene));
    let mut said: Vec<String> = wrong.collect();
    if let Some(Nearest { failed, by_rounding, apart, .. }) = &conclusion.nearest {
        let stop = counted(*failed, "run stops", "runs stop");
        said.extend((*failed > 0).then(|| format!("{stop} without a result.")));
        let decided = counted(*by_rounding, "run is", "runs are");
        said.extend((*by_rounding > 0).then(|| format!("{decided} {BY_ROUNDING}.")));
        said.extend(apart.iter().map(|run| {
            let far = percent(run.energy);
            format!("Of another plane problem, {run}, is {far} from that problem's equilibrium.")
        }));
    }
    said.extend(conclusion.fields.iter().flat_map(|found| fields(scene, found)));
    let unpriced = listed(&conclusion.unpriced);
    said.extend(
        (!unpriced.is_empty()).then(|| format!("Present, but not reintroduced: {unpriced}.")),
    );
    if is_example(scene) {
        said.push(CLEARANCE.into());
        if conclusion.reading == Reading::default() {
            said.extend([range::RECORDED.to_string(), WIDER.into()]);
        }
    }
    said
}

/// Says how far the largest stress and strain of the nearest run are off.
fn fields(scene: &Scene, Fields { variants, difference, .. }: &Fields) -> Vec<String> {
    let off = difference.map(|difference| {
        format!(
            "The largest von Mises stress and strain of a body under {} differ by up to {} from the equilibrium's.",
            listed(variants),
            percent(difference)
        )
    });
    let limit = is_example(scene).then(|| {
        "`plane-contact guide limit` says what stress finer meshes with true arcs lead to.".into()
    });
    off.into_iter().chain(limit).collect()
}

/// Says what is wrong with a run that transmits a load: which node presses although its gap is open, which
/// ends inside the target, how many pull, and how far a symmetric scene answers unsymmetrically.
fn wrong_with(row: &VariantRow, scene: &Scene) -> Option<String> {
    let run = row.outcome.as_ref().ok().filter(|run| !run.transmits_nothing)?;
    let VariantRun { penetration, pulling, across, asymmetry, mesh_error, .. } = run;
    let length = |x: f64| with_unit(&figure(x, *mesh_error), &scene.units.length);
    let across = across.map(|PressedAcross { node, pressure, gap }| {
        let pressure = with_unit(&figure(pressure, *mesh_error), &scene.units.stress);
        let (gap, c_tol) = (length(gap), scene.model.contact.tolerance);
        format!(
            "node {node} presses with {pressure} although the gap is open, {gap} (c_tol {c_tol})"
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
    let unsettled = if run.is_unsettled() { " (does not settle)" } else { "" };
    (!faults.is_empty()).then(|| format!("Under {}{unsettled} {}.", row.variant, faults.join("; ")))
}

/// The paper's variants, and the equilibrium.
fn runs(audit: &Audit) -> Table {
    let equilibrium = audit.equilibrium.as_ref().map(|found| {
        let nodes = found.in_contact.to_string();
        run("equilibrium", found.target_share, nodes, &found.bodies, found.mesh_error)
    });
    let calculix = is_example(&audit.scene).then(|| {
        let stresses = RECORDED.map(|(_, stress)| stress.to_string()).join(" / ");
        vec!["CalculiX".into(), "recorded".into(), "own contact, stick".into(), stresses.into()]
    });
    let rows = of_the_paper(&audit.variants).map(variant).chain(equilibrium).chain(calculix);
    Table::new(columns(&audit.scene), rows)
}

/// The columns of a table of runs.
pub(super) fn columns(scene: &Scene) -> [String; 5] {
    let bodies: Vec<&str> = scene.model.bodies.iter().map(|body| body.name.as_str()).collect();
    let stress =
        format!("{}: {}", with_unit("von Mises,", &scene.units.stress), bodies.join(" / "));
    ["run", "load transmitted", "nodes in contact", &stress, "error, energy norm"].map(String::from)
}

/// Returns the cells of a variant; of one that failed its name and why.
pub(super) fn variant(row: &VariantRow) -> Vec<Cell> {
    let name = row.variant.name();
    match &row.outcome {
        Err(NoFigures::Refused(_)) => vec![name.into(), Cell::Empty, "not run".into()],
        Err(why) => vec![name.into(), Cell::Empty, why.in_short().into()],
        Ok(VariantRun {
            in_contact, target_share, cycle, bodies, distance, mesh_error, ..
        }) => {
            let nodes = match cycle {
                Some(cycle) if cycle.length > 1 => {
                    let mut counts: Vec<usize> =
                        cycle.members.iter().map(|k| in_contact[k - 1]).collect();
                    counts.sort_unstable();
                    counts.dedup();
                    format!("{}, does not settle", listed(counts))
                }
                _ => in_contact.last().map_or("-".into(), usize::to_string),
            };
            let error = distance.as_ref().map(|from| Cell::percent(from.energy_relative));
            let mut cells = run(name, *target_share, nodes, bodies, *mesh_error);
            cells.push(error.into());
            cells
        }
    }
}

/// Returns the cells of a run, up to its error.
fn run(
    name: &str,
    share: Option<f64>,
    nodes: String,
    bodies: &[BodySummary],
    mesh_error: Option<f64>,
) -> Vec<Cell> {
    let stresses = stresses(bodies, mesh_error);
    vec![name.into(), share.map(Cell::percent).into(), nodes.into(), stresses.into()]
}

/// Writes the largest von Mises stress of each body, in the order of the table's heading.
pub(super) fn stresses(bodies: &[BodySummary], mesh_error: Option<f64>) -> String {
    let stresses = bodies.iter().map(|body| figure(body.max_von_mises_stress, mesh_error));
    stresses.collect::<Vec<_>>().join(" / ")
}

fn mesh_error(audit: &Audit) -> Option<String> {
    let error = audit.conclusion.fields.as_ref()?.errors.mesh_energy_relative?;
    Some(format!("Mesh error {}, {PROBABLY_MORE}.", percent(error)))
}

/// The claims by verdict, in a row for each scope.
fn by_scope(judged: &[JudgedClaim]) -> Table {
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

/// The faults that cost most.
fn faults(audit: &Audit) -> Section {
    let said = match prices::by_cost(&audit.prices) {
        Ok(costs) => Report::default().notes(costs.into_iter().take(DEAREST)).note(ALL_FAULTS),
        Err(why) => Report::default().note(why),
    };
    Section::new("faults", "Dearest faults, by their error in energy without friction", said)
}

/// Heads what the paper leaves open.
fn assumed(scene: &Scene) -> &'static str {
    if is_example(scene) { "Assumed, as the paper is silent" } else { "The scene" }
}
