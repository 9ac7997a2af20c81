//! `plane-contact listing trace`.

use plane_contact::engine::Request;
use plane_contact::engine::error::{Error, Result};
use plane_contact::error::InputError;
use plane_contact::mathcad::{Failure, Listing};
use plane_contact::paper::door::Call;
use plane_contact::paper::edited::Edited;
use plane_contact::paper::listings::{Which, settings};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::model::{Model, NodeId};
use plane_contact::problem::scene::Scene;
use plane_contact::report::changes;
use plane_contact::report::model::Report;
use plane_contact::report::trace::{self as report, TraceOptions, TraceWriter, Traced};
use plane_contact::studies::audit::trace::{self, Product, Step};

use crate::commands::{ReadingArg, print, print_by, read_listing, report_error, width};

/// Execute a listing and show, line by line, what each statement read and wrote.
#[derive(clap::Args)]
#[command(after_help = "\
c_cnt is executed on the initial shape and shown by contact node; Km on the pairs that c_cnt found
there, and shown by element: those that have a linked node, or those of --node. --listing FILE
executes an edited listing on the same scene, and reports what the edit changes (notation:
listings/README.md).

Examples:
  plane-contact listing trace fig1
  plane-contact listing trace fig1 --node 7
  plane-contact listing trace fig1 --summary                      a line for each decision
  plane-contact listing trace fig1 --lines 16-18 --exact
  plane-contact listing trace fig1 --listing Km --node 7
  plane-contact listing trace fig1 --reading R4=left-to-right     the listing stops: exit status 3
  plane-contact listing trace strand --listing my-c_cnt.txt --node 113
  plane-contact listing trace fig1 --json")]
pub struct Args {
    /// Path of a scene, or the name of an embedded one.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// c_cnt, Km, or the file of an edited listing.
    #[arg(long, value_name = "LISTING", default_value = "c_cnt")]
    listing: String,
    /// Only this contact node (c_cnt), or the elements of this node (Km).
    #[arg(long, value_name = "N")]
    node: Option<usize>,
    /// Only these printed lines, such as 16-18, or 7.
    #[arg(long, value_name = "LINES", value_parser = lines)]
    lines: Option<[usize; 2]>,
    /// Only what the conditions decided, a line for each.
    #[arg(long)]
    summary: bool,
    /// Show numbers with all their digits; otherwise with six.
    #[arg(long)]
    exact: bool,
    #[command(flatten)]
    reading: ReadingArg,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// What is executed: one of the paper's listings, or an edit of it.
struct Chosen {
    which: Which,
    listing: Listing,
    edited: bool,
}

/// Executes a listing and shows its trace; returns the exit status.
pub fn run(args: &Args) -> Result<u8> {
    let reading = args.reading.reading;
    let scene = Scene::open(&args.scene)?;
    let model = Request::new(&scene).reading(reading).model()?;
    let chosen = choose(&args.listing, &reading)?;
    let call = linked(&model, &reading, chosen.which)?;
    let turns = turns(chosen.which, &model, &call, args.node)?;
    let wanted = |turn: usize| turns.contains(&turn);
    let settings = settings(&reading);
    let of = Traced { which: chosen.which, listing: &chosen.listing, scene: &scene, model: &model };
    let execute = |each: &mut dyn FnMut(Step)| {
        trace::follow(chosen.which, &chosen.listing, &settings, &call, wanted, each)
    };
    if args.json {
        let mut outcome = None;
        print_by(|out| {
            let mut document = report::JsonTrace::new(out, &of)?;
            let executed = execute(&mut |step| document.step(&step));
            let executed = executed.map_err(|failure| chosen.blame(&failure, &args.listing));
            document.finish(outcome.insert(executed).as_ref())
        })?;
        // The failure stands in the document: no other one follows.
        let failure = outcome.and_then(Result::err);
        return Ok(failure.map_or(0, |error| report_error(&error)));
    }
    let lines = args.lines.unwrap_or([1, usize::MAX]);
    let shown = TraceOptions { summary: args.summary, lines, exact: args.exact, width: width() };
    let mut outcome = None;
    print_by(|out| {
        let mut telling = TraceWriter::new(out, of, &shown);
        let executed = outcome.insert(execute(&mut |step| telling.step(step)));
        telling.finish(executed.as_ref().map_or(&[], |(_, output)| output))
    })?;
    let (product, _) = outcome
        .expect("it is executed")
        .map_err(|failure| chosen.blame(&failure, &args.listing))?;
    if chosen.edited {
        let report = edited(&product, chosen.which, args, &model, &call);
        print(&format!("\n{}", report.text(width())))?;
    }
    Ok(0)
}

impl Chosen {
    /// Returns who is to blame that the listing stopped.
    fn blame(&self, failure: &Failure, name: &str) -> Error {
        match self.edited {
            true => InputError::new(name, failure.to_string(), "correct the edited listing").into(),
            false => Box::new(failure.clone()).into(),
        }
    }
}

/// Tells what an edit changes of what its listing computes.
fn edited(product: &Product, which: Which, args: &Args, model: &Model, call: &Call) -> Report {
    let reading = &args.reading.reading;
    match trace::run(which, &which.under(reading), &settings(reading), call, &mut ()) {
        Ok((printed, _)) => changes::report(&printed, product, model),
        Err(why) => {
            Report::default().line(format!("The edited listing runs; as printed it fails: {why}"))
        }
    }
}

/// Reads the first and the last of some lines.
fn lines(text: &str) -> Result<[usize; 2], String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if 0 < first && first <= last => Ok([first, last]),
        _ => Err("give a line, or the first and the last, such as 16-18".into()),
    }
}

/// One of the paper's listings by name, or the edited listing in a file.
fn choose(name: &str, reading: &Reading) -> Result<Chosen> {
    if let Ok(which) = name.parse::<Which>() {
        return Ok(Chosen { which, listing: which.under(reading), edited: false });
    }
    let edited = Edited::new(name, &read_listing(name)?)?;
    Ok(Chosen { which: edited.which, listing: edited.listing(), edited: true })
}

/// The contact pairs that Km receives: those of c_cnt at the initial shape.
fn linked(model: &Model, reading: &Reading, which: Which) -> Result<Call> {
    match which {
        Which::CCnt => Ok(Call::without_contact(model)),
        Which::Km => Ok(Call::c_cnt(model, reading, &model.nodes)?),
    }
}

/// The turns that are shown: of `c_cnt` over the contact nodes, of `Km` over the triangles.
fn turns(which: Which, model: &Model, call: &Call, node: Option<usize>) -> Result<Vec<usize>> {
    let entries = |is: &dyn Fn(NodeId) -> bool| -> Vec<usize> {
        let nodes = model.contact.nodes.iter().zip(1..);
        nodes.filter(|(node, _)| is(**node)).map(|(_, i1)| i1).collect()
    };
    let triangles = |is: &dyn Fn(NodeId) -> bool| -> Vec<usize> {
        let with = model.triangle_ids().filter(|id| model.triangle(*id).nodes.into_iter().any(is));
        with.map(|id| id.number()).collect()
    };
    let (turns, place, what, fix) = match (which, node) {
        (Which::CCnt, Some(node)) => {
            let what = format!("node {node} is no contact node");
            (entries(&|n| n.number() == node), "--node", what, "name a contact node, or none")
        }
        (Which::Km, Some(node)) => {
            let what = format!("node {node} is in no triangle");
            (triangles(&|n| n.number() == node), "--node", what, "name another node")
        }
        (Which::CCnt, None) => {
            let what = "the scene has no contact, so c_cnt is not called".into();
            (entries(&|_| true), "SCENE", what, "trace Km instead")
        }
        (Which::Km, None) => {
            let linked = triangles(&|n| call.row(n).iter().any(|x| *x != 0.0));
            (linked, "SCENE", "no element has a linked node".into(), "name a node with --node")
        }
    };
    if !turns.is_empty() {
        return Ok(turns);
    }
    Err(InputError::new(place, what, fix).into())
}
