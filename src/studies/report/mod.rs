//! The audit report that a referee hands in.

pub(crate) mod command;
mod first;
mod glossary;
pub mod page;

use crate::audit::claims::claim_tables::in_full;
use crate::audit::prices::Price;
use crate::audit::range::is_example;
use crate::audit::tables::explanation;
use crate::audit::words::evidence;
use crate::audit::{Audit, relative_radius};
use crate::compare::{Compared, comparison};
use engine::{Assessment, Hertz, Quantity, Solution, TriangleValues};
use output::layout::listed;
use output::model::{Report, Table};
use output::picture::{self, Drawing};
use output::quantities::triangle_array;
use output::{pressure, tables};
use paper::listings::Which;
use problem::modelling::Variant;
use problem::scene::{Scene, sha256_of};

/// What an audit report is made of.
pub struct Contents<'a> {
    /// The command that makes the report again.
    pub command: String,
    /// What was asked, in words: what, and what it was set to.
    pub asked: Vec<(&'static str, String)>,
    /// The audit.
    pub audit: &'a Audit,
    /// The print, repaired one finding at a time; empty where that was not asked for.
    pub repairs: Vec<Price>,
    /// The runs: of the variants, then the reference solution and the equilibrium where these are known.
    pub runs: Vec<&'a Solution>,
    /// What is said of the errors of the last of them; nothing without one.
    pub assessment: Option<Assessment<'a>>,
    /// The run beside CalculiX.
    pub calculix: Option<Compared<'a>>,
}

/// A picture with its title.
type Picture = (String, String);

/// Returns what the first screen rests on, and what makes it again.
fn parts(contents: &Contents) -> Report {
    what_was_audited()
        .then(audited(contents.audit, &contents.repairs))
        .then(figures(contents))
        .then(other_codes(contents))
        .then(glossary::report())
        .then(origin(contents))
}

fn audited(found: &Audit, repairs: &[Price]) -> Report {
    let findings =
        Report::default().heading("Each finding in full (`audit --finding C4` explains one)");
    let findings = found.findings.iter().fold(findings, |report, (finding, measured)| {
        let (id, scene) = (finding.id, finding.scene());
        let picture = picture::small_mesh(&Drawing::new(&scene, &format!("{id}: {}", scene.title)));
        report
            .then(explanation(finding, measured, &found.scene, &found.conclusion.reading).deeper(2))
            .figure(format!("The smallest scene that shows {id}"), picture)
    });
    evidence(found, repairs).then(in_full(&found.claims)).then(findings)
}

/// Says what the paper does, and what stands beside it.
fn what_was_audited() -> Report {
    Report::default()
        .heading("What was audited")
        .line(
            "The paper: A. M. Filipov, M. V. Khomenko, «Решение плоской контактной задачи методом конечных \
             элементов» (plane contact by the finite element method), Инженерный вестник Дона. It meshes two \
             elastic bodies with three-node triangles, finds which nodes of the stamp touch which edges of the \
             block, ties them together by its eq. (1), and solves. It prints two listings for Mathcad: `c_cnt` \
             (fig. 2) finds the contact, `Km` (fig. 3) assembles the stiffness matrix. Figure 4 is its mesh, \
             figure 5 its von Mises stress and strain.",
        )
        .line(
            "This program executes both listings as printed. Beside their results stands a \
             solution of the same scene on the same mesh that fulfils the contact conditions: the equilibrium \
             under friction, and without friction the reference solution. The method is run in these variants:",
        )
        .notes(Variant::help().split("; "))
        .line("Every term is defined in the glossary at the end.")
}

/// Returns the runs of the pictures under short names: the paper's, then the equilibrium.
fn named<'a>(contents: &Contents<'a>) -> Vec<(String, &'a Solution)> {
    let equilibrium = contents.audit.equilibrium.as_ref().map(|_| contents.runs.len() - 1);
    let name = |k: usize, run: &Solution| {
        let variant = run.request.variant;
        match equilibrium == Some(k) {
            true => Some("equilibrium".into()),
            false => Variant::OF_THE_PAPER.contains(&variant).then(|| variant.to_string()),
        }
    };
    let runs = contents.runs.iter().enumerate();
    runs.filter_map(|(k, run)| Some((name(k, run)?, *run))).collect()
}

/// Returns the nearest of the paper's runs and the equilibrium; the first run and the last where that is not
/// known.
fn two<'a>(contents: &Contents<'a>) -> Vec<(String, &'a Solution)> {
    let fields = contents.audit.conclusion.fields.as_ref();
    let nearest = fields.and_then(|fields| fields.variants.first());
    let mut runs = named(contents);
    let first = runs.iter().position(|(_, run)| Some(&run.request.variant) == nearest);
    if runs.len() > 2 {
        runs = vec![runs[first.unwrap_or(0)].clone(), runs[runs.len() - 1].clone()];
    }
    runs
}

/// Returns the pictures of the first screen: the pressure of the runs, and the stress of two.
fn pictures(contents: &Contents) -> Vec<Picture> {
    let scene = &contents.audit.scene;
    let runs = named(contents);
    let of_example =
        relative_radius(scene).and_then(|radius| Hertz::of_radius(runs.last()?.1, radius));
    let hertz =
        of_example.or_else(|| runs.iter().rev().find_map(|(_, run)| Hertz::from_solution(run)));
    // The pressures of `printed` stay in the contact body: none of the load passes.
    let passing: Vec<_> =
        runs.into_iter().filter(|(_, run)| run.request.variant != Variant::Printed).collect();
    let pressure = passing.iter().any(|(_, run)| !run.contact.is_empty()).then(|| {
        let svg = pressure::small_picture(scene, &passing, hertz.as_ref());
        ("Contact pressure along the contact surface".into(), svg)
    });
    pressure.into_iter().chain(beside(scene, &two(contents), "von_mises_stress")).collect()
}

/// Draws a field of the triangles in some runs side by side; nothing without a run.
fn beside(scene: &Scene, runs: &[(String, &Solution)], field: &str) -> Option<Picture> {
    let quantity = TriangleValues::QUANTITIES.iter().find(|quantity| quantity.name == field);
    let quantity: &Quantity<TriangleValues> = quantity.expect("it is declared");
    let array = |run| triangle_array(quantity, &TriangleValues::all(run, None), &scene.units);
    let arrays: Vec<_> =
        runs.iter().filter_map(|(name, run)| Some((name.clone(), array(run)?))).collect();
    let unit = arrays.first()?.1.unit.clone();
    let names = listed(arrays.iter().map(|(name, _)| name));
    let title = format!("{}, undeformed: {names}", quantity.title);
    let fields: Vec<_> =
        arrays.iter().map(|(name, array)| (name.clone(), array.values.clone())).collect();
    let svg = picture::beside(&Drawing::new(scene, ""), quantity.title, &unit, &fields);
    Some((title, svg))
}

/// Shows the mesh, the strain, then stress, pressure, shear and gap of all runs.
fn figures(contents: &Contents) -> Report {
    let (Some(solution), Some(assessment)) = (contents.runs.last(), &contents.assessment) else {
        return Report::default();
    };
    let scene = &contents.audit.scene;
    let [heading, mesh, strain] = match is_example(scene) {
        true => ["This project's own figures 4 and 5", "Figure 4: the mesh", "Figure 5b: "],
        false => ["Mesh and strain", "Mesh", ""],
    };
    let report = Report::default()
        .heading(heading)
        .figure(mesh, picture::mesh(&Drawing::new(scene, &scene.title)));
    let calculix = contents.calculix.as_ref().map(|own| ("CalculiX".into(), &own.beside.field));
    let every: Vec<_> = named(contents).into_iter().chain(calculix).collect();
    let fields = [
        (strain, beside(scene, &two(contents), "von_mises_strain")),
        ("", beside(scene, &every, "von_mises_stress")),
    ];
    let fields = fields.into_iter().filter_map(|(name, picture)| Some((name, picture?)));
    let report = fields
        .fold(report, |report, (name, (title, svg))| report.figure(format!("{name}{title}"), svg));
    let surface = if solution.contact.is_empty() { Report::default() } else { surface(contents) };
    report.then(tables::error_estimates(solution, assessment)).then(surface)
}

/// Shows pressure, shear and gap along the contact surface, a curve of each run.
fn surface(contents: &Contents) -> Report {
    let (scene, runs) = (&contents.audit.scene, &contents.runs);
    let hertz = runs.iter().rev().find_map(|run| Hertz::from_solution(run));
    let picture = pressure::picture(scene, runs, hertz.as_ref());
    let [shear, gap] = pressure::shear_and_gap(scene, runs);
    Report::default()
        .heading("Contact surface")
        .figure("Contact pressure of every run", picture)
        .figure("Contact shear of every run", shear)
        .figure("Gap of every run, below 0 where a node penetrates", gap)
}

/// Reports the differences from CalculiX, or how they are found.
fn other_codes(contents: &Contents) -> Report {
    let report = Report::default().heading("Differences from another code");
    match &contents.calculix {
        Some(compared) => report.then(comparison::report(compared).deeper(2)),
        None => {
            let recorded = is_example(&contents.audit.scene).then(|| {
                "What was recorded of CalculiX is in `plane-contact guide calculix`.".into()
            });
            let again = format!(
                "This report ran no other code. `plane-contact report {} --ccx` runs CalculiX by its own contact \
                 beside the variant unilateral.",
                contents.audit.scene.word
            );
            recorded.into_iter().chain([again]).fold(report, Report::line)
        }
    }
}

/// Reports what makes the report again: the command, and what it starts from.
fn origin(contents: &Contents) -> Report {
    let Contents { audit: Audit { scene, .. }, command, asked, .. } = contents;
    let asked = asked.iter().map(|(what, value)| (what.to_string(), value.clone()));
    let own = ["scene", "mesh"].map(String::from).into_iter().zip(scene.hashes().iter().cloned());
    let listings = Which::ALL.iter().map(|which| (format!("listing {which}"), hash(which.text())));
    let hashes = own.chain(listings).map(|(what, hash)| (what + ", SHA-256", hash));
    let table = Table::from_rows(asked.chain(hashes).collect::<Vec<_>>())
        .column("what", |(what, _)| what.clone())
        .column("set to", |(_, value)| value.clone());
    Report::default()
        .heading("How to make this report again")
        .line("One command computes every number and draws every figure:")
        .code(command)
        .table("Program, scene and options", table)
}

fn hash(text: &str) -> String {
    sha256_of(text.as_bytes()).expect("memory can be read")
}
