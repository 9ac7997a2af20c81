//! `plane-contact lesson`.

use std::iter;
use std::path::PathBuf;
use std::sync::Arc;

use crate::audit::Case;
use crate::audit::findings::{FINDINGS, Finding};
use crate::audit::prices::{self, Price};
use crate::lesson::language::Language;
use crate::lesson::page::{self as page, Chapter, Measured};
use crate::lesson::{self as study, MOST_SOLVED, Repairs, Switch, reference, switches};
use base::files::{self, HTML};
use base::plain::shown;
use engine::error::Result;
use paper::corrected::{FAULTS, Fault};
use paper::door::check_restraints;
use paper::edited::Edited;
use paper::findings::FindingId;
use problem::model::Model;
use problem::scene::Scene;

use commands::{folder, offered, read_listing, report_written, waiting};

/// Write a lesson: both listings, stepped forwards and backwards on a scene.
#[derive(clap::Args)]
#[command(after_help = "\
The page is one file that opens offline. It shows the listing as printed with the current line lit,
the scene with its gaps magnified, and every array as it is filled; each reading, the tolerance and
the worksheet's settings can be switched. A chapter for each finding shows it on its smallest scene;
one goes from the print to the right answer, a repair at a time.

Examples:
  plane-contact lesson
  plane-contact lesson two-blocks --out two-blocks.html
  plane-contact lesson strand --nodes 113,114
  plane-contact lesson fig1 --listing my-c_cnt.txt       an edited listing beside the printed one
  plane-contact lesson --lang ru                         in Russian")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one [default: fig1].
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Show the turns of these contact nodes only, and the triangles at them.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    nodes: Vec<usize>,
    /// An edited listing, offered beside the printed one.
    #[arg(long, value_name = "FILE")]
    listing: Option<PathBuf>,
    /// The language with which the page opens: en, ru.
    #[arg(long, default_value_t, value_parser = offered::<Language>(Language::ALL))]
    lang: Language,
    /// The file of the page [default: out/lesson.html].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let out = folder(&args.out, "lesson.html".into());
    files::check_file(&out, HTML)?;
    files::write(&out, &lesson(args)?)?;
    report_written(&out);
    Ok(())
}

fn lesson(args: &Args) -> Result<String> {
    let path = args.scene.as_deref().unwrap_or(FIG1.as_ref());
    let (scene, is_fig1) = (Scene::open(path)?, path == FIG1);
    check_restraints(&scene.model)?;
    let mut asked = vec![Switch::as_printed()];
    if let Some(file) = &args.listing {
        let edited = Edited::new(&shown(file), &read_listing(file)?)?;
        asked.push(Switch::edited(edited.which, edited.listing()));
    }
    let chapters = waiting("executing the listings", || -> Result<Vec<_>> {
        // Refuses what a page cannot show.
        for switch in &asked {
            study::check(&scene, switch, &args.nodes)?;
        }
        let switches = asked.into_iter().chain(switches(&scene).into_iter().skip(1));
        // A reading that does not allow the model has no run (R6).
        let runs = switches.filter_map(|switch| Some((switch.clone(), switch.model(&scene).ok()?)));
        let own = opened(scene.clone(), runs.collect(), args.nodes.clone(), None);
        let priced = |scene: &Scene| Priced::new(scene.clone(), FAULTS.iter().collect());
        let fig1 = Scene::open(FIG1)?;
        let others = [priced(&fig1), priced(&lowered(fig1))];
        let is_iterated = scene.model.nodes.len() <= MOST_SOLVED;
        let other = (!is_fig1 && is_iterated).then(|| priced(&scene));
        let way = if is_fig1 { Some(&others[0]) } else { other.as_ref() };
        let chapters = [Ok(own), repairs(way, &others[0], args.nodes.clone())].into_iter();
        let findings = FINDINGS.iter().map(|finding| chapter(finding, &others));
        chapters.chain(findings).collect()
    })?;
    Ok(page::html(&chapters, args.lang))
}

/// The scene whose way to the right answer stands in for that of a scene that has none.
const FIG1: &str = "fig1";

/// A case, and what faults cost on it one at a time, behind what no fault does; nothing where the corrected algorithm
/// itself has no result.
struct Priced {
    case: Case,
    faults: Vec<&'static Fault>,
    prices: Vec<Price>,
}

impl Priced {
    fn new(scene: Scene, faults: Vec<&'static Fault>) -> Self {
        let case = Case::new(scene);
        let prices = (!faults.is_empty()).then(|| prices::of_faults(&case, &faults, &|| ()).ok());
        Priced { case, faults, prices: prices.flatten().unwrap_or_default() }
    }

    /// Returns the prices of a finding's faults, each with the name of the scene.
    fn of(&self, finding: FindingId) -> impl Iterator<Item = (String, Price)> {
        let prices = self.faults.iter().zip(self.prices.iter().skip(1));
        let own = prices.filter(move |(fault, _)| fault.is_of(finding));
        own.map(|(_, price)| (self.case.scene.name.clone(), price.clone()))
    }
}

/// Returns the chapter that goes from the print to the right answer, on fig. 1 where the scene has no such
/// way.
fn repairs(own: Option<&Priced>, fig1: &Priced, nodes: Vec<usize>) -> Result<Chapter> {
    let of = |priced: &Priced| Repairs::new(&priced.case, &priced.prices);
    let (priced, nodes, (repairs, u)) = match own.and_then(|own| Some((own, nodes, of(own)?))) {
        Some(found) => found,
        None => (fig1, vec![], of(fig1).expect("the corrected algorithm solves fig. 1")),
    };
    let scene = priced.case.scene.clone();
    let printed = Switch::as_printed();
    let model = printed.model(&scene)?;
    let runs = vec![(printed, model)];
    let repairs = Some(repairs);
    Ok(Chapter { scene, runs, nodes, finding: None, repairs, reference: Some(u) })
}

/// Returns a scene whose contact nodes stand deeper by ten tolerances: the search of the print loses them.
fn lowered(mut scene: Scene) -> Scene {
    let model = Arc::make_mut(&mut scene.model);
    for node in &model.contact.nodes {
        model.nodes[node.index()][1] -= 10.0 * model.contact.tolerance;
    }
    scene.name = page::LOWERED.into();
    scene
}

/// Returns the chapter of a finding, on the smallest scene that shows it; its faults have prices there and on
/// other scenes, by name.
fn chapter(finding: &'static Finding, others: &[Priced]) -> Result<Chapter> {
    let faults = FAULTS.iter().filter(|fault| fault.is_of(finding.id)).collect();
    let own = Priced::new(finding.scene(), faults);
    let case = &own.case;
    let model = |switch: Switch| Ok((switch.clone(), switch.model(&case.scene)?));
    let runs = study::chapter(finding).into_iter().map(model).collect::<Result<_>>()?;
    let evidence = finding.measure(case);
    let prices = iter::once(&own).chain(others).flat_map(|priced| priced.of(finding.id)).collect();
    let measured = Measured { finding, evidence, prices };
    Ok(opened(own.case.scene, runs, vec![], Some(measured)))
}

/// Returns a chapter with its reference solution, on the model of its first run.
fn opened(
    scene: Scene,
    runs: Vec<(Switch, Arc<Model>)>,
    nodes: Vec<usize>,
    finding: Option<Measured>,
) -> Chapter {
    let reference = reference(&scene, &runs[0].1);
    Chapter { scene, runs, nodes, finding, repairs: None, reference }
}
