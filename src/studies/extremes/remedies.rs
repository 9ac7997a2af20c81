//! Well-known remedies, applied to a scene from outside: the mirror keeps the printed formulas.

use serde_json::{Value, json};

use super::answer::{Quantity, solve};
use super::ladder::{SceneOf, carried};
use super::sweep::Way;
use super::verdict::Verdict;
use crate::numbers::solve::ScalarName;
use crate::problem::modelling::Variant;

/// The power of two at or below |x|, which divides without rounding; 1 of what has none.
pub fn power_of_two(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        1.0
    } else {
        2f64.powi(x.abs().log2().floor().clamp(-1000.0, 1000.0) as i32)
    }
}

/// `tied` with the first node moved to the origin, in f64, before anything is rounded to the scalar.
pub fn shifted(scalar: ScalarName, scene: SceneOf) -> Way {
    Way::new(format!("tied {scalar}, origin shifted"), carried(scalar), move |x| {
        let json = scene(x);
        let mut moved = json.clone();
        let first = [1, 2].map(|d| number(&json["node"][0][d]));
        change(&mut moved, |d, x| x - first[d]);
        run(&moved, 1.0, &json, scalar)
    })
}

/// `tied` with lengths in a unit of their own size, and displacements turned back.
pub fn length_scaled(scalar: ScalarName, scene: SceneOf) -> Way {
    Way::new(format!("tied {scalar}, lengths scaled"), carried(scalar), move |x| {
        let json = scene(x);
        let mut scaled = json.clone();
        let unit = power_of_two(number(&json["node"][1][1]));
        change(&mut scaled, |_, x| x / unit);
        scaled["contact"]["c_tll"] = json!(number(&json["contact"]["c_tll"]) / unit);
        run(&scaled, unit, &json, scalar)
    })
}

/// `tied` with the load in a unit of its own size, and displacements turned back: what one iteration computes is linear.
pub fn load_scaled(scalar: ScalarName, scene: SceneOf) -> Way {
    Way::new(format!("tied {scalar}, loads scaled"), carried(scalar), move |x| {
        let json = scene(x);
        let mut scaled = json.clone();
        let pressure = number(&json["loads"][0]["pressure"]);
        let unit = power_of_two(pressure);
        scaled["loads"][0]["pressure"] = json!(pressure / unit);
        run(&scaled, unit, &json, scalar)
    })
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number of a scene")
}

/// Replaces the coordinates by what `of` makes of the direction and each.
fn change(json: &mut Value, of: impl Fn(usize, f64) -> f64) {
    for node in json["node"].as_array_mut().expect("a table of nodes") {
        for d in [0, 1] {
            node[d + 1] = json!(of(d, number(&node[d + 1])));
        }
    }
}

/// Displacements of `changed`, times `unit`, against the exact ones of `json`.
fn run(changed: &Value, unit: f64, json: &Value, scalar: ScalarName) -> Verdict {
    match solve(changed, Variant::Tied, scalar, None) {
        Err(error) => error.into(),
        Ok(answer) => {
            let exact = |json: &Value| solve(json, Variant::Tied, ScalarName::Exact, None);
            // The scene itself is refused where its areas leave the range of f64; the changed one has the same exact answer.
            match exact(json).or_else(|_| exact(changed).map(|exact| exact.times(unit))) {
                Ok(exact) => answer.times(unit).against(&exact, Quantity::Displacement),
                Err(error) => error.into(),
            }
        }
    }
}
