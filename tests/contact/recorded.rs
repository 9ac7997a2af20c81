//! What random scenes give, recorded: every field of `result.json` of their runs, under every
//! variant, model of contact, reading and arithmetic. No closed form judges these numbers, as other
//! tests do; this one notices when any of them changes.

use std::collections::BTreeMap;
use std::fmt::Write;

use fastrand::Rng;
use plane_contact::Error;
use plane_contact::answer::{Assessment, Request, solve};
use plane_contact::numbers::solve::{Arithmetic, Inputs, ScalarName, Solver};
use plane_contact::paper::mirror::{NodeTable, Reading, Schedule};
use plane_contact::problem::modelling::{
    ContactModel, Coupling, Friction, Geometry, StatusRule, Variant,
};
use plane_contact::report::ResultFile;
use serde_json::Value;

use crate::common::recorded::assert_recorded;
use crate::corners::Writing;
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

fn one_of<T: Copy>(rng: &mut Rng, from: &[T]) -> T {
    from[rng.usize(..from.len())]
}

fn model(rng: &mut Rng) -> ContactModel {
    ContactModel {
        coupling: one_of(rng, Coupling::ALL),
        friction: Friction::new(one_of(rng, &[0.0, 0.1, 0.3, 1.0, f64::INFINITY])).unwrap(),
        geometry: one_of(rng, Geometry::ALL),
        load_steps: one_of(rng, &[1, 3, 4]),
        status: one_of(rng, StatusRule::ALL),
    }
}

fn reading(rng: &mut Rng) -> Reading {
    if rng.bool() {
        return Reading::default();
    }
    Reading {
        r5: one_of(rng, NodeTable::ALL),
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
    let asked = Some(one_of(rng, Solver::ALL)).filter(|_| rng.bool());
    let of = |solver| Arithmetic { scalar, solver, inputs: Inputs::default(), tol: None };
    let is_offered = variant != Variant::Unilateral && of(asked).check().is_ok();
    Arithmetic { inputs: one_of(rng, Inputs::ALL), ..of(asked.filter(|_| is_offered)) }
}

/// Draws a request of a scene of a kind, and what it asks for in words.
fn request(rng: &mut Rng, kind: Kind) -> (Request, String) {
    use Variant::{Printed, Stepped, Tied, Unilateral};
    let bodies = draw(rng, kind).bodies;
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
fn run(rng: &mut Rng, kind: Kind) -> String {
    let (request, mut text) = request(rng, kind);
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
    let mut groups: BTreeMap<String, String> = BTreeMap::new();
    for (name, field) in folded {
        let (group, short) = name.rsplit_once('.').unwrap_or(("", &name));
        *groups.entry(group.to_owned()).or_default() += &format!(" {short}={}", field.text(&name));
    }
    Ok(groups)
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

fn record(kind: Kind) {
    let mut rng = Rng::with_seed(kind as u64);
    let runs: String = (0..RUNS).map(|_| run(&mut rng, kind)).collect();
    assert_recorded(&format!("{kind:?}").to_lowercase(), &runs);
}

macro_rules! recorded {
    ($($name:ident $kind:ident)+) => {
        $(
            #[test]
            fn $name() {
                record(Kind::$kind);
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
