//! What random scenes give, recorded: every field of `result.json` of their runs, under every
//! variant, model of contact, reading and arithmetic. No closed form judges these numbers, as other
//! tests do; this one notices when any of them changes.

use std::collections::BTreeMap;
use std::fmt::Write;

use fastrand::Rng;
use plane_contact::Error;
use plane_contact::engine::contact::Pairing;
use plane_contact::engine::estimates::arithmetic::rounding;
use plane_contact::engine::estimates::singular;
use plane_contact::engine::{Assessment, Detail, Published, Request, Solution, solve};
use plane_contact::numbers::solve::{Arithmetic, Inputs, ScalarName, Solver};
use plane_contact::paper::mirror::{Reading, Schedule};
use plane_contact::problem::modelling::{ContactModel, Friction, Variant};
use plane_contact::problem::scene::Axis;
use plane_contact::report::ResultFile;
use serde_json::{Value, json};

use crate::common::draws::one_of;
use crate::common::recorded::{
    RECORDED_COUPLINGS, RECORDED_GEOMETRIES, RECORDED_INPUTS, RECORDED_NODE_TABLES, RECORDED_RULES,
    RECORDED_SOLVERS, assert_recorded,
};
use crate::corners::{Bodies, Writing, grid};
use crate::drawn::{Kind, draw};

/// The number of runs of each kind of scenes.
const RUNS: usize = 40;

/// What is not recorded: what is known beforehand, and what is noise.
const LEFT_OUT: [&str; 19] = [
    "format",
    "version",
    "scene_sha256",
    "mesh_sha256",
    "scene",
    "title",
    "variant",
    "reading",
    "arithmetic.scalar",
    "arithmetic.inputs",
    "coupling",
    "friction",
    "geometry",
    "status",
    "load_steps",
    "nodes",
    "bodies.name",
    "materials",
    "iterations.solve_residual",
];

/// The ends of the names of bounds on rounding, which is known to a digit or two.
const BOUNDS: [&str; 2] = ["arithmetic", "bound"];

/// Two blocks on a grid of whole numbers: nodes stand over nodes, ends over ends, as far apart as the
/// tolerance or not at all, and many comparisons are ties.
pub fn regular(rng: &mut Rng) -> Bodies {
    let (below, above) = (rng.usize(3..8), rng.usize(2..6));
    let (from, step) = (one_of(rng, &[0.0, 1.0, 0.5]), one_of(rng, &[1.0, 0.5, 1.5]));
    let gap = one_of(rng, &[0.0, 0.0, 0.0, 0.001, -0.001, 0.01]);
    let rise = one_of(rng, &[0.0, 0.0, 0.0, 0.5, -0.5]);
    let lower = |y: f64, rise: f64| {
        (0..below).map(move |k| [k as f64, y + if k % 2 == 1 { rise } else { 0.0 }])
    };
    let upper = |y: f64| (0..above).map(move |k| [from + step * k as f64, y]);
    let top = f64::max(rise, 0.0) + gap;
    let mut nodes: Vec<[f64; 2]> = lower(-2.0, 0.0).chain(lower(-1.0, 0.0)).collect();
    nodes.extend(lower(0.0, rise));
    let first = nodes.len();
    nodes.extend(upper(top).chain(upper(top + 1.0)));
    let mut target: Vec<[usize; 2]> =
        (0..below - 1).map(|k| [2 * below + k, 2 * below + k + 1]).collect();
    if rng.bool() {
        // Its sides too.
        target.extend([[below, 2 * below], [2 * below - 1, 3 * below - 1]]);
    }
    let both = vec![Axis::X, Axis::Y];
    let mut restrained: Vec<_> = (0..below).map(|n| (n, both.clone())).collect();
    let on_top = first + above;
    match rng.u8(..4) {
        0 => restrained.push((on_top, vec![Axis::X])),
        1 => restrained.extend([on_top, on_top + above - 1].map(|n| (n, both.clone()))),
        _ => restrained.extend([on_top, on_top + above - 1].map(|n| (n, vec![Axis::X]))),
    }
    let side = one_of(rng, &[0.0, 0.0, 1.0, -3.0]);
    let loads = (0..above).map(|k| (on_top + k, [side, -10.0])).collect();
    Bodies {
        nodes,
        triangles: [grid(0, below, 3), grid(first, above, 2)],
        moduli: one_of(rng, &[[(1e4, 0.25); 2], [(1e4, 0.0), (2e4, 0.0)]]),
        contact: (first..first + above).collect(),
        target,
        restrained,
        loads,
    }
}

fn model(rng: &mut Rng) -> ContactModel {
    ContactModel {
        coupling: one_of(rng, &RECORDED_COUPLINGS),
        friction: Friction::new(one_of(rng, &[0.0, 0.1, 0.3, 1.0, f64::INFINITY])).unwrap(),
        geometry: one_of(rng, &RECORDED_GEOMETRIES),
        load_steps: one_of(rng, &[1, 3, 4]),
        status: one_of(rng, &RECORDED_RULES),
    }
}

fn reading(rng: &mut Rng) -> Reading {
    if rng.bool() {
        return Reading::default();
    }
    Reading {
        r5: one_of(rng, &RECORDED_NODE_TABLES),
        r7: one_of(rng, &[None, Some(Schedule::Total), Some(Schedule::Stepped)]),
        ..Reading::default()
    }
}

/// Draws numbers in which a variant runs, and a solver that they offer.
fn arithmetic(rng: &mut Rng, variant: Variant) -> Arithmetic {
    use ScalarName::{Bounded, BoundedDouble, Exact, F64, F64x2};
    let scalar = match variant {
        Variant::Unilateral => F64,
        _ => one_of(rng, &[F64, F64, F64, F64x2, Bounded, BoundedDouble, Exact]),
    };
    let asked = Some(one_of(rng, &RECORDED_SOLVERS)).filter(|_| rng.bool());
    let of = |solver| Arithmetic { scalar, solver, inputs: Inputs::default() };
    let is_offered = variant != Variant::Unilateral && of(asked).check().is_ok();
    Arithmetic { inputs: one_of(rng, &RECORDED_INPUTS), ..of(asked.filter(|_| is_offered)) }
}

/// Draws a request of a scene, and what it asks for in words.
fn request(rng: &mut Rng, bodies: &Bodies) -> (Request, String) {
    use Variant::{Printed, Stepped, Tied, Unilateral};
    let contact = model(rng);
    let (node, [_, force]) = bodies.loads[bodies.loads.len() - 1];
    let scene = bodies
        .modelled(&Writing::default(), contact)
        .force(node + 1, [one_of(rng, &[0.0, 0.5, -2.0]) * force, 0.0])
        .in_stage(one_of(rng, &[1, 2]))
        .iterations(4)
        .build();
    let variant = one_of(rng, &[Unilateral, Unilateral, Unilateral, Tied, Stepped, Printed]);
    let request = Request::new(&scene.expect("a sound scene"))
        .variant(variant)
        .reading(reading(rng))
        .arithmetic(arithmetic(rng, variant));
    let ContactModel { coupling, friction, geometry, load_steps, status } = contact;
    let Request { reading, arithmetic, .. } = &request;
    let Arithmetic { scalar, solver, inputs, .. } = arithmetic;
    let solver = solver.map_or("", Solver::name);
    let words = format!(
        "{variant} {coupling} {friction} {geometry} {load_steps} {status} {scalar} {inputs} \
         {solver} {reading}"
    );
    (request, words)
}

/// Returns what a run of a random scene gives: what was asked, and its fields.
fn run(rng: &mut Rng, bodies: &Bodies) -> String {
    let (request, mut text) = request(rng, bodies);
    match fields(&request) {
        Ok(fields) => fields.into_iter().for_each(|(group, fields)| {
            write!(text, "\n  {group}{fields}").expect("a text has room");
        }),
        Err(why) => write!(text, "\n  exit status {}: {why}", why.exit_status()).expect("room"),
    }
    text.trim_end().to_owned() + "\n"
}

/// Returns every field of the result, its array folded into a number, by the objects that they are
/// fields of.
fn fields(request: &Request) -> Result<BTreeMap<String, String>, Error> {
    let solution = solve(request, &mut |_| ())?;
    let mut assessment = Assessment::new(&solution);
    let nodes = &solution.model.nodes;
    assessment.probe(&solution, &[nodes[0], nodes[nodes.len() - 1]])?;
    let result = ResultFile::new(&solution, &assessment, None);
    let document = serde_json::to_value(&result).expect("a result is JSON");
    let mut folded = BTreeMap::new();
    fold("", &document, &mut folded);
    fold("beside", &beside(&solution, &assessment), &mut folded);
    Ok(by_group(folded))
}

fn by_group(folded: BTreeMap<String, Folded>) -> BTreeMap<String, String> {
    let mut groups: BTreeMap<String, String> = BTreeMap::new();
    for (name, field) in folded {
        let (group, short) = name.rsplit_once('.').unwrap_or(("", &name));
        *groups.entry(group.to_owned()).or_default() += &format!(" {short}={}", field.text(&name));
    }
    groups
}

/// Returns a line of every field of an object without objects in it, arrays folded into a number.
pub fn folded(document: &Value) -> String {
    let mut folded = BTreeMap::new();
    fold("", document, &mut folded);
    by_group(folded).remove("").unwrap_or_default()
}

/// Returns what a run knows beside its result: how its contact states and its estimates came about.
fn beside(solution: &Solution, assessment: &Assessment) -> Value {
    let steps = solution.steps.iter().map(|step| match &step.detail {
        Detail::Published(Published { pairs, .. }) => json!({
            "bound": step.constraints.len(),
            "ct": pairs.ct.as_slice(),
            "weights": pairs.k_cnt().as_matrix().as_slice(),
            "yt": pairs.yt.as_slice(),
        }),
        Detail::Unilateral(own) => json!({
            "faces": own.pairings.iter().flatten().map(facing).collect::<Vec<_>>(),
            "feedback": own.feedback,
            "friction": own.friction(solution.u.len()).as_slice(),
            "margin": own.margin,
            "undetermined": own.undetermined,
        }),
    });
    let rounding = rounding(solution);
    let steps_bounds = rounding.steps.iter().flatten();
    let bounds =
        steps_bounds.map(|b| json!({ "yt_bound": b.yt, "u_bound": b.u, "w_bound": b.weights }));
    let estimates = assessment.estimates.as_ref().expect("they were asked for");
    let recovered =
        estimates.mesh.recovered.iter().flatten().flat_map(|stress| stress.iter().copied());
    let singular = singular(solution).into_iter().map(|point| {
        let triangles = point.triangles.iter().map(|t| t.index()).collect::<Vec<_>>();
        let cause = point.cause.to_string();
        json!({ "node": point.node.index(), "cause": cause, "triangles": triangles })
    });
    json!({
        "energy_norm": estimates.mesh.energy_norm,
        "indicators": estimates.mesh.indicators,
        "recovered": recovered.collect::<Vec<_>>(),
        "rounding": bounds.collect::<Vec<_>>(),
        "singular": singular.collect::<Vec<_>>(),
        "steps": steps.collect::<Vec<_>>(),
        "stress_errors": estimates.mesh.stress_errors,
        "unrecovered": estimates.mesh.unrecovered.len(),
    })
}

pub fn facing(pairing: &Pairing) -> Value {
    let Pairing { masters, normal, gap, length, edge, .. } = pairing;
    let masters = masters.iter().map(|(node, weight)| (node.index(), *weight));
    let (nodes, weights): (Vec<usize>, Vec<f64>) = masters.unzip();
    json!({
        "edge": edge.index(),
        "gap": gap,
        "length": length,
        "nodes": nodes,
        "normal": normal,
        "weights": weights,
    })
}

/// The values of a field, over all elements of its arrays: a sum of numbers of which each has a weight
/// of its own, so that their order matters, and words.
#[derive(Default)]
struct Folded {
    count: u32,
    floats: Option<f64>,
    integers: Option<i64>,
    words: BTreeMap<String, i64>,
}

impl Folded {
    fn add(&mut self, value: &Value) {
        self.count += 1;
        let place = i64::from(self.count % 97);
        match value {
            Value::Number(number) if number.is_f64() => {
                // Between 1 and 2, and no two alike.
                let weight = 1.0 + (0.618_033_988_749_895 * f64::from(self.count)).fract();
                let number = number.as_f64().unwrap_or_default();
                *self.floats.get_or_insert_default() += weight * number;
            }
            Value::Number(number) => {
                *self.integers.get_or_insert_default() +=
                    place * number.as_i64().unwrap_or_default();
            }
            Value::String(text) if text.parse::<f64>().is_ok() => {
                self.add(&Value::from(text.parse::<f64>().unwrap()));
            }
            other => *self.words.entry(other.to_string()).or_default() += place,
        }
    }

    fn text(&self, name: &str) -> String {
        let is_bound = BOUNDS.iter().any(|bound| name.ends_with(bound));
        let float = self.floats.map(|sum| match is_bound {
            true => format!("~{sum:.2e}"),
            false => format!("{sum:.8e}"),
        });
        let integer = self.integers.map(|sum| sum.to_string());
        let words = self.words.iter().map(|(word, sum)| format!("{word}*{sum}"));
        float.into_iter().chain(integer).chain(words).collect::<Vec<_>>().join(",")
    }
}

fn fold(name: &str, value: &Value, folded: &mut BTreeMap<String, Folded>) {
    match value {
        _ if LEFT_OUT.contains(&name) => {}
        Value::Object(fields) => fields.iter().for_each(|(field, value)| {
            let name = if name.is_empty() { field.clone() } else { format!("{name}.{field}") };
            fold(&name, value, folded);
        }),
        Value::Array(values) => values.iter().for_each(|value| fold(name, value, folded)),
        _ => folded.entry(name.to_owned()).or_default().add(value),
    }
}

fn record(name: &str, seed: u64, bodies: impl Fn(&mut Rng) -> Bodies) {
    let mut rng = Rng::with_seed(seed);
    let mut one = || {
        let bodies = bodies(&mut rng);
        run(&mut rng, &bodies)
    };
    assert_recorded(name, &(0..RUNS).map(|_| one()).collect::<String>());
}

#[test]
fn regular_blocks() {
    record("regular-1", 31, regular);
}

#[test]
fn more_regular_blocks() {
    record("regular-2", 32, regular);
}

macro_rules! recorded {
    ($($name:ident $kind:ident)+) => {
        $(
            #[test]
            fn $name() {
                let draw = |rng: &mut Rng| draw(rng, Kind::$kind).bodies;
                record(&stringify!($kind).to_lowercase(), Kind::$kind as u64, draw);
            }
        )+
    };
}

recorded! {
    flat Flat
    bent Bent
    wavy Wavy
    roofs Roof
    narrow Narrow
    grooves Groove
    plates Plate
    held Held
}
