//! The conclusion of an audit in words: five answers, each with its number and the command that prints
//! it.

use std::fmt::Display;

use serde::Serialize;

use crate::audit::Audit;
use crate::audit::conclusion::{Conclusion, Coupled, Fields, NearRun, Nearest, Spread};
use crate::audit::evidence::{BY_ROUNDING, NoFigures};
use crate::audit::prices::table as prices;
use crate::audit::prices::{Price, Weight};
use crate::audit::range::{self, Recorded, is_example};
use engine::BodySummary;
use paper::mirror::Reading;
use problem::scene::Scene;
use report::layout::{counted, first_line, listed};
use report::model::Report;
use report::numbers::{coordinates, figure, or_dash, percent, short, with_unit};

/// A relative difference that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// Where the clearance comes from.
const CLEARANCE: &str = " The clearance of 0.1 mm is ours: with it contact spans several nodes, as in figure 1. \
    Real ducts are wider.";

/// What holds in wider ducts under the default reading, as golden/tables/range.md has it.
pub const WIDER: &str = " From a clearance of 0.9 mm on neither P10 nor P11 is false (true, or decided by rounding); from 5 mm on both are true \
     (plane-contact guide range).";

/// An answer of the conclusion.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// One of the five questions.
    pub question: &'static str,
    /// The answer, in sentences.
    pub answer: String,
    /// The number that the answer turns on; nothing where there is none.
    pub value: Option<f64>,
    /// What the value is.
    pub of: &'static str,
    /// The command that prints it.
    pub command: String,
    /// Where it stands there: a JSON pointer; nothing where there is no value.
    pub at: Option<String>,
}

/// Answers the five questions.
pub fn answers(audit: &Audit, conclusion: &Conclusion, scene: &Scene) -> [Answer; 5] {
    let answers = [
        coupled(conclusion.coupled.as_ref(), scene),
        nearest(conclusion, scene),
        fields(conclusion, scene),
        costs(&audit.prices, &conclusion.unpriced, scene),
        open(conclusion, scene),
    ];
    if conclusion.reading == Reading::default() {
        return answers;
    }
    answers.map(|answer| Answer {
        command: format!("{} --reading {}", answer.command, conclusion.reading),
        ..answer
    })
}

/// Reports the answers.
pub fn report(answers: &[Answer]) -> Report {
    answers.iter().fold(Report::default().heading("Conclusion"), |report, answer| {
        let Answer { value, of, command, at, .. } = answer;
        let number = match (value, at) {
            (Some(value), Some(at)) => {
                format!("{} = {of}; printed by: plane-contact {command}, at {at}", short(*value))
            }
            _ => format!("printed by: plane-contact {command}"),
        };
        report.note(answer.question).detail(&answer.answer).detail(number)
    })
}

/// Says whether the print couples the bodies, and what passes between them.
pub fn coupling(coupled: Option<&Coupled>) -> String {
    match coupled {
        None => "The scene has no contact: there is nothing to couple.".into(),
        Some(Coupled { joins, share, failure }) => {
            let entries = match joins {
                None => "Not decided here: no node comes in contact".to_string(),
                Some(0) => "No: Km adds no entry that joins the two bodies (finding K1)".into(),
                Some(n) => format!("Yes: {n} entries of MJS join the two bodies"),
            };
            match (share, failure) {
                (Some(share), _) => {
                    let share = percent(*share);
                    format!("{entries}, and under printed {share} of the load reaches the target.")
                }
                (None, Some(NoFigures::Rounding)) => {
                    format!("{entries}; printed is {BY_ROUNDING}.")
                }
                (None, Some(why)) => {
                    let why = why.in_short().trim_end_matches('.');
                    format!("{entries}; printed stops: {why}.")
                }
                (None, None) => format!("{entries}."),
            }
        }
    }
}

fn coupled(coupled: Option<&Coupled>, scene: &Scene) -> Answer {
    let joins = coupled.and_then(|coupled| coupled.joins);
    Answer {
        question: "Does the printed algorithm couple the bodies?",
        answer: coupling(coupled),
        value: joins.map(|joins| joins as f64),
        of: "entries of MJS that join the two bodies",
        command: format!("audit {} --finding K1 --json", scene.word),
        at: joins.map(|_| "/number".into()),
    }
}

fn nearest(conclusion: &Conclusion, scene: &Scene) -> Answer {
    let nearest = conclusion.nearest.as_ref();
    let answer = match nearest {
        None if conclusion.coupled.is_none() => "The scene has no contact to be read.".into(),
        None if conclusion.fields.is_none() => {
            "Not decided here: there is no equilibrium to compare with.".into()
        }
        None => "Not decided here: no variant of the paper has a result.".into(),
        Some(Nearest { runs, tried, failed, by_rounding, apart }) => {
            let word = if runs[0].energy < NOTICEABLE { "Yes, within 1 %" } else { "No" };
            let stop = match failed {
                0 => String::new(),
                n => format!("; {}", counted(*n, "stops", "stop")),
            };
            let decided = match by_rounding {
                0 => String::new(),
                n => format!("; {} decided by rounding", counted(*n, "is", "are")),
            };
            let tie = if runs.len() == 1 { "" } else { ", all equally near" };
            let others = if *by_rounding == 0 { "" } else { " of the others" };
            let apart = apart.iter().map(|run| {
                let far = percent(run.energy);
                format!(" Apart: {}, {far} from the equilibrium of that plane problem.", named(run))
            });
            format!(
                "{word}. There are {} (variants, and readings that have a run; equal ones count once){stop}{decided}. \
                 The nearest{others} is {}{tie}: {} from the equilibrium under the scene's own friction, in the energy \
                 norm, on the same mesh.{}",
                counted(*tried, "run", "runs"),
                listed(runs.iter().map(named)),
                percent(runs[0].energy),
                apart.collect::<String>()
            )
        }
    };
    Answer {
        question: "Does any reading of it reach the equilibrium?",
        answer,
        value: nearest.map(|nearest| nearest.runs[0].energy),
        of: "distance from the equilibrium under the scene's own friction, in the energy norm, relative",
        command: format!("audit {} --json", scene.word),
        at: nearest.map(|nearest| nearest.runs[0].at.clone()),
    }
}

/// Names a run.
fn named(NearRun { variant, reading, unsettled, .. }: &NearRun) -> String {
    let unsettled = if *unsettled { " (unsettled: it alternates)" } else { "" };
    let reading = reading.as_ref().map_or("default reading".into(), |r| format!("reading {r}"));
    format!("{variant} under the {reading}{unsettled}")
}

fn fields(Conclusion { fields, .. }: &Conclusion, scene: &Scene) -> Answer {
    let difference = fields.as_ref().and_then(|fields| fields.difference);
    let answer = match (fields, difference) {
        (None, _) => {
            "Not decided here: there is no contact, or no equilibrium to compare with.".into()
        }
        (Some(fields), None) => {
            let own = in_its_place(fields, scene);
            format!("Not decided here: no variant of the paper has a result. {own}")
        }
        (Some(fields), Some(difference)) => {
            let word = if difference < NOTICEABLE { "Yes, within 1 %" } else { "No" };
            let variants = match &fields.variants[..] {
                [variant] if fields.by_rounding => {
                    format!("{variant}, the nearest variant on which rounding does not decide,")
                }
                [variant] => format!("{variant}, the nearest variant,"),
                all => format!("{} ({} are equally near)", all[0], listed(all)),
            };
            let stresses = fields.theirs.iter().map(|body| {
                let error = fields.errors.mesh_energy_relative;
                let stress = figure(body.max_von_mises_stress, error);
                format!("{} in body {}", with_unit(&stress, &scene.units.stress), body.name)
            });
            let unsettled = match fields.unsettled {
                true => " The run is unsettled: its contact state alternates.",
                false => "",
            };
            format!(
                "{word}. Under {variants} the largest von Mises stress is {}. The largest von Mises strain is {}. \
                 One of these values differs by {} from that of the equilibrium on the same mesh.{unsettled} {}",
                listed(stresses),
                listed(fields.theirs.iter().map(|body| strain(body, fields))),
                percent(difference),
                in_its_place(fields, scene)
            )
        }
    };
    Answer {
        question: "May its fields of von Mises stress and strain be trusted?",
        answer,
        value: difference,
        of: "largest relative difference of a body's largest von Mises stress or strain between the \
             nearest variant and the equilibrium",
        command: format!("audit {} --json", scene.word),
        at: difference.map(|_| "/conclusion/fields/difference".into()),
    }
}

/// Says what the equilibrium shows.
fn in_its_place(fields: &Fields, scene: &Scene) -> String {
    // Three digits of the size of the bodies.
    let size = scene.model.bounds().larger_side();
    let decimals = (3.0 - size.log10()).ceil().max(0.0) as usize;
    let errors = fields.own.iter().zip(&fields.errors.bodies);
    let stresses = errors.map(|(body, error)| {
        let stress = with_unit(
            &figure(body.max_von_mises_stress, fields.errors.mesh_energy_relative),
            &scene.units.stress,
        );
        // 0 added to −0 is 0.
        let scale = 10f64.powi(decimals as i32);
        let centre = body.centre.map(|x| (x * scale).round() / scale + 0.0);
        let at = with_unit(&coordinates(centre, decimals), &scene.units.length);
        let diverges = match error.no_limit.as_ref().filter(|point| point.is_largest) {
            Some(point) => format!(" (it diverges under refinement, at node {})", point.node),
            None => String::new(),
        };
        format!("{stress} in body {} at {at}{diverges}", body.name)
    });
    let limit = match is_example(scene) {
        true => " `plane-contact guide limit` says what finer meshes with true arcs lead to.",
        false => "",
    };
    format!(
        "In the equilibrium (solve {} --variant unilateral --coupling mortar) the largest von Mises stress is {}. \
         The largest von Mises strain is {}.{limit}",
        scene.word,
        listed(stresses),
        listed(fields.own.iter().map(|body| strain(body, fields)))
    )
}

fn strain(body: &BodySummary, fields: &Fields) -> String {
    let strain = figure(body.max_von_mises_strain, fields.errors.mesh_energy_relative);
    format!("{strain} in body {}", body.name)
}

fn costs(prices: &Result<Vec<Price>, String>, unpriced: &[&str], scene: &Scene) -> Answer {
    let known = match prices.as_ref().map(|prices| (prices, prices::unsound(prices))) {
        Ok((prices, None)) => Ok(prices),
        Ok((_, Some(why))) => Err(format!("Not decided here: {why}.")),
        Err(why) => Err(format!("Not measured here: {}", first_line(why))),
    };
    let answer = match &known {
        Err(why) => why.clone(),
        Ok(prices) => {
            let own = prices[0].outcome.from_equilibrium().map_or(
                "cannot be compared, as there is no equilibrium under the scene's friction".into(),
                |own| format!("is {} from the equilibrium", percent(own)),
            );
            let none = prices::of_weight(prices, Weight::NoFault);
            let no_fault = if none.is_empty() {
                String::new()
            } else {
                format!(" No fault here, as no node slides in the equilibrium: {}.", listed(none))
            };
            format!(
                "{} printed faults were put back, each alone, into the corrected algorithm (plane-contact guide corrected), which \
                 has no friction and {own}. Fatal (the run stops, or no load passes): {}. \
                 Farther or nearer, each with its distance from the equilibrium: {}. Decided by rounding: {}. Without \
                 effect: {}.{no_fault} Present, but not put back: {}. A finding that the print's \
                 own run does not trigger can cost something here, as the corrected algorithm comes to other \
                 shapes.",
                prices.len() - 1,
                or_none(prices::of_weight(prices, Weight::Fatal)),
                or_none(shifts(prices).into_iter().map(|k| {
                    let Price { name, outcome, .. } = &prices[k];
                    let name = name.as_deref().expect("the corrected algorithm shifts nothing");
                    let settles = if outcome.is_settled() { "" } else { " (does not settle)" };
                    format!("{name} {}{settles}", or_dash(outcome.from_equilibrium(), percent))
                })),
                or_none(prices::of_weight(prices, Weight::Rounding)),
                or_none(prices::of_weight(prices, Weight::Free)),
                or_none(unpriced)
            )
        }
    };
    let largest = known.ok().and_then(|prices| {
        let k = *shifts(prices).first()?;
        Some((k, prices[k].outcome.from_equilibrium()?))
    });
    Answer {
        question: "Which findings matter here?",
        answer,
        value: largest.map(|(_, error)| error),
        of: "largest distance from the equilibrium under the scene's own friction, in the energy norm, \
             relative, that a fault leaves which is put back alone",
        command: format!("audit {} --prices --json", scene.word),
        at: largest.map(|(k, _)| format!("/prices/{k}/equilibrium_relative")),
    }
}

/// Returns the places of the prices that shift the solution, the farthest first.
pub fn shifts(prices: &[Price]) -> Vec<usize> {
    let mut shifting: Vec<usize> =
        (0..prices.len()).filter(|k| prices[*k].weight == Weight::Shifts).collect();
    let distance = |k: &usize| prices[*k].outcome.from_equilibrium().unwrap_or(0.0);
    shifting.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
    shifting
}

/// Lists words, or says that there are none.
fn or_none(words: impl IntoIterator<Item = impl Display>) -> String {
    let words = listed(words);
    if words.is_empty() { "none".into() } else { words }
}

/// The last question, and its value.
const OPEN: &str = "What does the paper not give, and how far could that move the verdict?";
const MOST: &str = "largest distance of the nearest variant from the equilibrium over the range, in the energy norm, relative";

/// Says how far the nearest run is from the equilibrium on other geometries of the paper's example.
pub fn recorded() -> String {
    let Recorded { places, error: [least, most], by_rounding } = range::recorded();
    let rounding = match by_rounding {
        0 => String::new(),
        n => format!("; at {n} more rounding decides"),
    };
    format!(
        "At {places} other choices of what the paper leaves open (clearance, radius, mesh, stamp, c_tol) the nearest run \
         is {} to {} from it{rounding}.",
        percent(least),
        percent(most)
    )
}

fn open(conclusion: &Conclusion, scene: &Scene) -> Answer {
    let Conclusion { open, range, .. } = conclusion;
    let given = match open.len() {
        0 => "The scene has no contact that could stand for the paper's.".to_string(),
        n => format!("{n} things: {}.", listed(open)),
    };
    if !is_example(scene) && range.is_none() {
        return Answer {
            question: OPEN,
            answer: "The scene is not the paper's example: what the paper leaves open is here as the scene has it. \
                     audit strand judges the example."
                .into(),
            value: None,
            of: MOST,
            command: format!("audit {} --json", scene.word),
            at: None,
        };
    }
    let moved = match range {
        None => {
            format!(
                "{} `plane-contact guide range` has what else that moves; audit --range makes it again.",
                recorded()
            )
        }
        Some(Spread { places, error: [least, most], changes, true_from }) => {
            let verdicts = match changes.len() {
                0 => "no verdict changes".to_string(),
                _ => format!("the verdicts that change are those on {}", listed(changes)),
            };
            let from = true_from.iter().map(|(id, value)| {
                format!(" {id} is true at each clearance tried from {value} mm on.")
            });
            format!(
                "At {places} places of the range the nearest variant, under the readings of this audit, is {} to {} \
                 from the equilibrium; {verdicts}.{}",
                percent(*least),
                percent(*most),
                from.collect::<String>()
            )
        }
    };
    let is_default = conclusion.reading == Reading::default();
    let clearance = if is_example(scene) { CLEARANCE } else { "" };
    let wider = if is_example(scene) && is_default { WIDER } else { "" };
    let most = range.as_ref().map(|range| range.error[1]);
    let command = match range {
        None => format!("audit {} --json", scene.word),
        Some(_) => "audit --range --json".into(),
    };
    Answer {
        question: OPEN,
        answer: format!("{given}{clearance}{wider} {moved}"),
        value: most,
        of: MOST,
        command,
        at: most.map(|_| "/conclusion/range/error/1".into()),
    }
}
