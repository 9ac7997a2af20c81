//! `plane-contact report`.

use std::io;
use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::engine::{Assessment, Solution};
use plane_contact::error::InputError;
use plane_contact::files::{self, Folder};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use plane_contact::report::page::report::{self as page, Report};
use plane_contact::studies::audit::conclusion::Conclusion;
use plane_contact::studies::audit::{Case, audit};
use plane_contact::studies::calculix::{self, Comparison, Contact, Fields, Pair, Part};

use super::{report_written, waiting};

/// The most bytes of a chart of `trade`; one has some 30,000.
const CHART: u64 = 1 << 24;

/// Write an audit report as a page: conclusion, claims, readings, findings, fields.
#[derive(clap::Args)]
#[command(after_help = "\
The page is one file that opens offline. Fields are shown under the pointer and at probes, on the
undeformed shape or with displacements magnified; every table copies as CSV. It takes 60 to 120 times
as long as solve, and 3 times with --no-audit.

Examples:
  plane-contact report
  plane-contact report fig1 --out fig1.html
  plane-contact report --ccx                               CalculiX beside it
  plane-contact report --charts out/strand-geometry        with the charts that trade wrote there
  plane-contact report my/scene.json --variant unilateral --no-audit")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE", default_value = "strand")]
    scene: String,
    /// The variants whose fields are shown [default: all; one that fails is left out].
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    variant: Vec<Variant>,
    /// Leave out claims, readings and findings, and the runs that they are measured against.
    #[arg(long)]
    no_audit: bool,
    /// Run CalculiX too, by its own contact, beside unilateral.
    #[arg(long, value_name = "PROGRAM", num_args = 0..=1, default_missing_value = "ccx")]
    ccx: Option<String>,
    /// A folder whose charts, *.svg, are shown.
    #[arg(long, value_name = "DIR")]
    charts: Option<PathBuf>,
    /// The file of the page.
    #[arg(long, value_name = "FILE", default_value = "out/report.html")]
    out: PathBuf,
}

pub fn run(args: &Args) -> Result<()> {
    files::check_file(&args.out)?;
    args.ccx.as_deref().map_or(Ok(()), calculix::check)?;
    let scene = Scene::open(&args.scene)?;
    let case = if args.no_audit {
        Case::new(scene)
    } else {
        Case::within_memory(&scene, Reading::default())?
    };
    let charts = args.charts.as_deref().map_or(Ok(Vec::new()), charts)?;
    let html = waiting("auditing", || page_of(args, &case, charts))?;
    files::write(&args.out, &html)?;
    report_written(&args.out, true);
    Ok(())
}

fn page_of(args: &Args, case: &Case, charts: Vec<(String, String)>) -> Result<String> {
    let audited = (!args.no_audit).then(|| {
        let found = audit(case, &Vec::new(), &|| ());
        let conclusion = Conclusion::new(case, &found);
        (found, conclusion)
    });
    let wanted = |variant: &&Variant| args.variant.is_empty() || args.variant.contains(variant);
    let ran = Variant::ALL.iter().filter(wanted).filter_map(|v| case.certain(*v).ok());
    let others = match args.no_audit {
        true => [None, None],
        false => [case.reference(), case.equilibrium()],
    };
    let runs = ran.map(|(solution, _)| solution).chain(others.into_iter().flatten());
    let assessed = |solution| page::Run {
        solution,
        assessment: Assessment::against(solution, case.session(), others),
    };
    let beside = args.ccx.as_deref().map(|program| calculix(program, case)).transpose()?;
    Ok(page::html(&Report {
        scene: &case.scene,
        what: what(args, &case.scene),
        audit: audited.as_ref().map(|(found, conclusion)| (found, conclusion)),
        runs: runs.map(assessed).collect(),
        calculix: beside.as_ref().map(|(comparison, heading)| (comparison, heading.clone())),
        charts,
    }))
}

/// Says what was asked, without the place of any file.
fn what<'a>(args: &Args, scene: &Scene) -> Vec<(&'a str, String)> {
    let model = &scene.model;
    let variants = match args.variant.as_slice() {
        [] => "all".to_string(),
        some => some.iter().map(Variant::to_string).collect::<Vec<_>>().join(", "),
    };
    let size = format!("{} nodes, {} triangles", model.nodes.len(), model.triangles.len());
    vec![
        ("program", format!("plane-contact {}", env!("CARGO_PKG_VERSION"))),
        ("scene", format!("{} ({})", scene.name, scene.title)),
        ("mesh", size),
        ("plane problem", model.plane.to_string()),
        ("variants", variants),
        ("readings", "the default of each".into()),
        ("iterations of the paper's variants", scene.iterations.to_string()),
        ("contact", format!("{}, friction {}", scene.contact.coupling, scene.contact.friction)),
        ("c_tll", model.contact.tolerance.to_string()),
    ]
}

/// Runs CalculiX's own contact beside `unilateral`.
fn calculix(program: &str, case: &Case) -> Result<(Comparison, String)> {
    let (solution, _): &(Solution, _) = case.certain(Variant::Unilateral).map_err(|why| {
        let what = format!("unilateral, which stands beside CalculiX, does not run: {why}");
        InputError::new("--ccx", what, "leave --ccx out")
    })?;
    let model = &solution.model;
    let pair = Pair::new(model, None, solution.request.contact.friction);
    let parts = [Part { contact: Contact::Pair(pair), share: 1.0 }];
    let ran = calculix::run(program, &case.scene, model, &parts)?;
    let heading =
        format!("CalculiX {}, its contact pair by penalty, beside unilateral", ran.version);
    Ok((Comparison::new(model, Fields::from_solution(solution), ran.fields), heading))
}

/// Reads the charts of a folder, by name.
fn charts(folder: &Path) -> Result<Vec<(String, String)>> {
    let fault = |why: io::Error| {
        let what = format!("the charts cannot be read: {why}");
        InputError::new(folder.display().to_string(), what, "give a folder that trade wrote")
    };
    let charts = Folder::open(folder).map_err(fault)?;
    let read = |name: String| {
        let text = charts.read(&name, CHART).and_then(files::text);
        let text = text.map_err(|why| fault(io::Error::other(format!("{name}: {why}"))))?;
        Ok((name.trim_end_matches(".svg").into(), text))
    };
    charts.names("svg").map_err(fault)?.into_iter().map(read).collect()
}
