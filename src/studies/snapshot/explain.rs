//! Why two runs differ: the first difference along the order of computation, and its cause.

use serde::Serialize;
use serde_json::Value;

use super::compare::{Difference, Kind, compare};
use super::flip::{Flip, flip};
use super::input::Input;
use super::options::Options;
use super::place::{iteration, place};
use super::record::{Bounds, record};
use super::{Run, VERSION};
use base::choices;
use engine::Decision;
use numbers::solve::{ScalarName, cost};
use problem::modelling::Variant;
use problem::scene::{Element, Mesh, PhysicalName};

choices! {
    /// A kind of cause.
    Class {
        /// The scene or its mesh is another one.
        Input = "input",
        /// The reading of the print is another one.
        Reading = "reading",
        /// Another option is another one.
        Option = "option",
        /// The numbers or the solver are others.
        Solver = "solver or precision",
        /// The version of the program is another one.
        Version = "version of the program",
        /// Rounding decided who is in contact.
        Rounding = "decided by rounding",
        /// None of these: the program or the snapshot is at fault.
        Defect = "defect",
    }
}

/// One side of a comparison.
#[derive(Clone, Copy)]
pub struct Side<'a> {
    /// The version of the program that recorded it.
    pub version: &'a str,
    /// What was given to it.
    pub input: &'a Input,
    /// What was recorded.
    pub run: &'a Run,
}

/// A difference of what went into two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cause {
    /// What kind of cause it is.
    pub class: Class,
    /// The field: `scene materials.block.E`, `mesh node 7 x`, `reading R2`.
    pub place: String,
    /// What it was in the old run.
    pub was: String,
    /// What it is in the new run.
    pub is: String,
}

/// The reason why two runs differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// What kind of cause comes first.
    pub class: Class,
    /// The first cause.
    pub cause: String,
    /// How that is known.
    pub known_by: String,
    /// All that differs in what went in, in the order of computation.
    pub causes: Vec<Cause>,
    /// The first entry of the runs that differs; None where the runs agree.
    pub first: Option<String>,
    /// Where the two first go different ways; None where they do not.
    pub flip: Option<Flip>,
    /// The number of entries of later iterations and of the end that differ.
    pub later: usize,
}

/// Explains why two runs differ, whose `differences` are known; None where neither what both have nor
/// what went into them differs.
pub fn explain(old: Side, new: Side, differences: &[Difference]) -> Option<Explanation> {
    let causes = causes(old, new);
    let in_both = differences.iter().filter(|difference| difference.is_in_both());
    let differences: &[Difference] = &in_both.cloned().collect::<Vec<_>>();
    if causes.is_empty() && differences.is_empty() {
        return None;
    }
    let flip = flip(old.run, new.run, differences);
    let first = differences.first().map(|difference| difference.entry.clone());
    let (class, cause, known_by) = match causes.first() {
        Some(cause) => {
            let words = format!("{}: {}, was {}", cause.place, cause.is, cause.was);
            let rounding = match cause.class == Class::Solver {
                true => left_to_rounding(old, new, flip.as_ref()),
                false => None,
            };
            let rounding = rounding.map_or(String::new(), |(what, why)| format!("; {what}{why}"));
            (cause.class, words, replayed(old, differences) + &rounding)
        }
        None => without_change(old, new, differences, flip.as_ref()),
    };
    let after = flip.as_ref().map_or(0, |flip| flip.iteration);
    let later = differences.iter().filter(|d| place(&d.entry).iteration > after).count();
    Some(Explanation { class, cause, known_by, causes, first, flip, later })
}

/// Returns what differs in what went into two runs, in the order of computation.
fn causes(old: Side, new: Side) -> Vec<Cause> {
    let mut causes = Vec::new();
    if old.input.scene_sha256 != new.input.scene_sha256 {
        let [was, is] = [old, new].map(|side| {
            serde_json::to_value(&side.input.scene).expect("a description is an object")
        });
        fields(&mut causes, Class::Input, "scene", &was, &is);
    }
    if old.input.mesh_sha256 != new.input.mesh_sha256 {
        mesh(&mut causes, &old.input.mesh, &new.input.mesh);
    }
    options(&mut causes, &old.run.options, &new.run.options);
    causes
}

/// Collects the fields in which two documents differ; a list of objects is compared one by one.
fn fields(causes: &mut Vec<Cause>, class: Class, path: &str, was: &Value, is: &Value) {
    if was == is {
        return;
    }
    match (was, is) {
        (Value::Object(old), Value::Object(new)) => {
            let separator = if path.contains(' ') { '.' } else { ' ' };
            let added = new.keys().filter(|name| !old.contains_key(*name));
            for name in old.keys().chain(added) {
                let [was, is] = [old, new].map(|side| side.get(name).unwrap_or(&Value::Null));
                fields(causes, class, &format!("{path}{separator}{name}"), was, is);
            }
        }
        (Value::Array(old), Value::Array(new))
            if old.iter().any(Value::is_object) && old.len() == new.len() =>
        {
            for (k, (was, is)) in old.iter().zip(new).enumerate() {
                fields(causes, class, &format!("{path}[{k}]"), was, is);
            }
        }
        _ => {
            let [was, is] = [was, is].map(|value| match value {
                Value::Null => "the default".into(),
                value => value.to_string(),
            });
            causes.push(Cause { class, place: path.into(), was, is });
        }
    }
}

/// Collects the differences of two meshes: groups, then nodes, then elements.
fn mesh(causes: &mut Vec<Cause>, old: &Mesh, new: &Mesh) {
    let mut add = |place: String, was: String, is: String| {
        causes.push(Cause { class: Class::Input, place, was, is });
    };
    if old.names != new.names {
        let [was, is] = [old, new].map(|mesh| {
            let name = |n: &PhysicalName| (n.dim, n.tag, n.name.clone());
            format!("{:?}", mesh.names.iter().map(name).collect::<Vec<_>>())
        });
        add("mesh groups".into(), was, is);
    }
    if old.nodes.len() != new.nodes.len() {
        add("mesh nodes".into(), old.nodes.len().to_string(), new.nodes.len().to_string());
    }
    for (was, is) in old.nodes.iter().zip(&new.nodes).filter(|(was, is)| was != is) {
        let axis = |k: usize| (["x", "y", "z"][k], was.xyz[k], is.xyz[k]);
        let numbers = ("number", was.number as f64, is.number as f64);
        let axes = std::iter::once(numbers).chain((0..3).map(axis));
        for (axis, a, b) in axes.filter(|(_, a, b)| a != b) {
            add(format!("mesh node {} {axis}", was.number), a.to_string(), b.to_string());
        }
    }
    if old.elements.len() != new.elements.len() {
        add("mesh elements".into(), old.elements.len().to_string(), new.elements.len().to_string());
    }
    for (was, is) in old.elements.iter().zip(&new.elements).filter(|(was, is)| was != is) {
        let turned = was.nodes.iter().rev().eq(&is.nodes) && was.nodes.len() == 2;
        let row =
            |e: &Element| format!("{:?} of type {}, groups {:?}", e.nodes, e.kind, e.physical);
        let word = if turned { " (reversed)" } else { "" };
        add(format!("mesh elem {}", was.number), row(was), row(is) + word);
    }
}

/// Collects the differences of two sets of options, last what only changes how numbers are computed.
fn options(causes: &mut Vec<Cause>, old: &Options, new: &Options) {
    let [was, is] = [old, new].map(|options| {
        let mut document = serde_json::to_value(options).expect("options have string keys");
        document["reading"] =
            serde_json::to_value(options.reading).expect("a reading has string keys");
        document
    });
    let mut found = Vec::new();
    fields(&mut found, Class::Option, "option", &was, &is);
    for cause in &mut found {
        if let Some(id) = cause.place.strip_prefix("option reading.") {
            (cause.class, cause.place) = (Class::Reading, format!("reading {id}"));
        } else if ["scalar", "solver", "inputs"].contains(&&cause.place["option ".len()..]) {
            cause.class = Class::Solver;
        }
    }
    found.sort_by_key(|cause| cause.class == Class::Solver);
    causes.append(&mut found);
}

/// Runs what was recorded again and says what that shows.
fn replayed(old: Side, differences: &[Difference]) -> String {
    let effect = if differences.is_empty() { "; the two runs agree all the same" } else { "" };
    let again = old
        .input
        .build()
        .ok()
        .and_then(|scene| record(&old.run.options.request(&scene), Bounds::Computed).ok());
    match again {
        None => format!("what went in differs, and the old input does not run any more{effect}"),
        Some(again) if compare(old.run, &again).0.is_empty() => {
            format!("from the old input this program gives the old run{effect}")
        }
        Some(_) => format!(
            "what went in differs; from the old input, too, this program (version {VERSION}) gives \
             another run than version {}{effect}",
            old.version
        ),
    }
}

/// Returns class, cause and how they are known of two runs of the same input and options.
fn without_change(
    old: Side,
    new: Side,
    differences: &[Difference],
    flip: Option<&Flip>,
) -> (Class, String, String) {
    let same = "scene, mesh, reading, options and solver are the same";
    if let Some((cause, margin)) = left_to_rounding(old, new, flip) {
        return (Class::Rounding, cause, format!("{same}{margin}"));
    }
    let exact =
        arbitrated(old, new, differences).map_or(String::new(), |words| format!("; {words}"));
    if old.version != new.version {
        let cause = format!("version {} of the program, was {}", new.version, old.version);
        return (Class::Version, cause, format!("{same}{exact}"));
    }
    let cause = match differences.iter().any(|d| !matches!(d.kind, Kind::Expected { .. })) {
        true => "the program, the machine or the snapshot is at fault",
        false => "the run misses a number that is expected of it",
    };
    let known = format!(
        "{same}, and so is the version ({}); the differences are beyond what rounding may do{exact}",
        old.version
    );
    (Class::Defect, cause.into(), known)
}

/// Returns the first decision up to a flip that rounding may have taken in either run, and its margin.
fn left_to_rounding(old: Side, new: Side, flip: Option<&Flip>) -> Option<(String, String)> {
    let decisions = old.run.decided_by_rounding.iter().chain(&new.run.decided_by_rounding);
    let before =
        |decision: &&Decision| flip.is_some_and(|flip| decision.iteration <= flip.iteration);
    let decision = decisions.filter(before).min_by_key(|decision| decision.iteration)?;
    let margin = match (decision.margin, decision.bound) {
        (Some(margin), Some(bound)) => format!(
            ": its sides differ by {margin:.1e}, and rounding may change that by {bound:.1e}"
        ),
        _ => String::new(),
    };
    let what = format!(
        "rounding decided at iteration {}, node {}: {}",
        decision.iteration, decision.node, decision.condition
    );
    Some((what, margin))
}

/// Says which side exact numbers agree with at the first difference, where the scene is small.
fn arbitrated(old: Side, new: Side, differences: &[Difference]) -> Option<String> {
    /// The free equations whose exact solutions end in a moment.
    const FEW: usize = 50;
    let first = differences.first()?;
    let request = new.run.options.request(&new.input.build().ok()?);
    let growing = request.reading.r5.follows_the_shape();
    let most = cost::most_equations(growing, request.iterations).min(FEW);
    let is_small = request.scene.model.free_dofs() <= most;
    (request.variant != Variant::Unilateral && is_small).then_some(())?;
    let mut options = new.run.options.clone();
    (options.scalar, options.solver) = (Some(ScalarName::Exact), None);
    let exact = record(&options.request(&request.scene), Bounds::Computed).ok()?;
    let agrees = |run: &Run| {
        let (found, _) = compare(&exact, run);
        !found.iter().any(|difference| place(&difference.entry) <= place(&first.entry))
    };
    let words = match (agrees(old.run), agrees(new.run)) {
        (true, false) => "the old one is right",
        (false, true) => "the new one is right",
        (true, true) => "both are within their bounds of it",
        (false, false) => "neither is right",
    };
    let place = match iteration(&first.entry) {
        Some((k, quantity)) => format!("{quantity} of iteration {k}"),
        None => first.entry.clone(),
    };
    Some(format!("in exact numbers, {place}: {words}"))
}
