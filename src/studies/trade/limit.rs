//! The limit of a scene that a generator makes: its arcs are true on every mesh, no corner of a polygon
//! presses, and stresses converge.

use rayon::prelude::*;
use serde::Serialize;

use super::Varied;
use super::order::limit;
use super::trials::{Setting, Trial, trials};
use crate::benchmark::{ClosedForm, Strand};
use engine::{Request, Solution, over, solve, summaries};
use problem::scene::Units;

/// What meshes with true arcs tend to, and what the scene's own mesh misses of it.
#[derive(Clone, Debug, Serialize)]
pub struct Limit {
    /// The radii of the stamp's arc and of the duct's wall, length.
    pub radii: [f64; 2],
    /// The length of the edges on the duct's lower wall of each mesh, length, the longest first.
    pub sizes: Vec<f64>,
    /// Pressure, half width and von Mises stresses, the peak pressure first.
    pub quantities: Vec<Approach>,
    /// What a reader computes by hand; nothing where the load does not press.
    pub closed_forms: Vec<ClosedForm>,
    /// The units of the scene.
    #[serde(skip)]
    pub units: Units,
}

/// How a quantity approaches its limit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Approach {
    /// What approaches its limit.
    pub quantity: String,
    /// The unit of its values; empty where the scene names none.
    pub unit: String,
    /// On the scene's own mesh; nothing of a half width where pressures do not fall from the middle.
    pub own: f64,
    /// On each mesh with true arcs, as on the own one.
    pub values: Vec<f64>,
    /// p, where differences fall as 2^-p from mesh to mesh; nothing where they do not.
    pub order: Option<f64>,
    /// Where they lead to; nothing without an order.
    pub limit: Option<f64>,
    /// By how much the own mesh misses the limit, or without one the finest mesh, over that.
    pub missed: f64,
}

impl Approach {
    /// The limit, or without one the value on the finest mesh.
    pub fn best(&self) -> f64 {
        self.limit.unwrap_or(self.values[self.values.len() - 1])
    }
}

impl Limit {
    /// Solves the scene of `request` without friction, and on meshes with true arcs down to edges of
    /// `finest`, length; nothing where no generator makes the scene, and where a mesh does not run.
    pub fn solved(request: &Request, finest: f64) -> Option<Self> {
        let strand = Strand::from_scene(&request.scene)?;
        let trials = trials(request, Varied::Mesh, finest);
        let run = |trial: &Trial| solve(&trial.request(request).ok()?, &mut |_| ()).ok();
        let solutions = trials.par_iter().map(run).collect::<Option<Vec<Solution>>>()?;
        let solutions: Vec<&Solution> = solutions.iter().collect();
        let (own, finer) = solutions.split_first()?;
        Some(Limit::new(&strand, &request.scene.units, sizes(&trials), own, finer))
    }

    /// From the solutions on the scene's own mesh and on those of `sizes`, at least one.
    pub(super) fn new(
        strand: &Strand,
        units: &Units,
        sizes: Vec<f64>,
        own: &Solution,
        finer: &[&Solution],
    ) -> Self {
        let finer: Vec<_> = finer.iter().map(|solution| quantities(solution, units)).collect();
        let approach = |(quantity, unit, own): (String, &String, f64)| {
            let of_mesh = |values: &Vec<(String, &String, f64)>| {
                values.iter().find(|(name, ..)| *name == quantity).map(|(_, _, value)| *value)
            };
            let values: Vec<f64> = finer.iter().filter_map(of_mesh).collect();
            let (order, limit) = limit(&values).unzip();
            let unit = unit.clone();
            let mut approach = Approach { quantity, unit, own, values, order, limit, missed: 0.0 };
            approach.missed = over(own - approach.best(), approach.best());
            approach
        };
        let conforming = strand.conforming(&own.model);
        let forms = conforming.map(|c| c.hertz().into_iter().chain([c.persson()]).collect());
        Limit {
            radii: [strand.strand, strand.duct],
            sizes,
            quantities: quantities(own, units).into_iter().map(approach).collect(),
            closed_forms: forms.unwrap_or_default(),
            units: units.clone(),
        }
    }
}

/// The edges of the meshes with true arcs among trials, length.
pub(super) fn sizes(trials: &[Trial]) -> Vec<f64> {
    let size = |trial: &Trial| match trial.setting {
        Setting::Size(size) => Some(size),
        Setting::Own
        | Setting::Tolerance(_)
        | Setting::Iterations(_)
        | Setting::Status(_)
        | Setting::Coupling(_)
        | Setting::Refined(_)
        | Setting::Half => None,
    };
    trials.iter().filter_map(size).collect()
}

/// Peak and half width of the pressure, the largest pressure of a node, and the largest von Mises stress of
/// each body, each with its unit.
fn quantities<'u>(solution: &Solution, units: &'u Units) -> Vec<(String, &'u String, f64)> {
    let Units { length, stress, .. } = units;
    let [peak, half_width] = parabola(solution);
    let largest = solution.contact.iter().filter_map(|node| node.pressure).fold(0.0, f64::max);
    let bodies = summaries(solution).into_iter().map(|body| {
        let name = format!("largest von Mises stress in {}", body.name);
        (name, stress, body.max_von_mises_stress)
    });
    let of_contact = [
        ("peak pressure".into(), stress, peak),
        ("half width".into(), length, half_width),
        ("largest pressure of a node".into(), stress, largest),
    ];
    of_contact.into_iter().chain(bodies).collect()
}

/// Peak p0 and half width a of p² = p0² (1 − (s/a)²) through the pressures of nodes by least squares, for a
/// node's alone scatter: beside the axis, about which the mesh is mirrored, by 3 % at any edge length down
/// to 0.05 mm. The last tenth is left out, where the contact ends between two nodes.
fn parabola(solution: &Solution) -> [f64; 2] {
    const INNER: f64 = 0.9;
    let pressing = solution
        .contact
        .iter()
        .filter_map(|node| Some((node.arc, node.pressure.filter(|pressure| *pressure > 0.0)?)));
    let pressing: Vec<(f64, f64)> = pressing.collect();
    let (Some((start, _)), Some((end, _))) = (pressing.first(), pressing.last()) else {
        return [0.0; 2];
    };
    let (middle, reach) = ((start + end) / 2.0, INNER * (end - start) / 2.0);
    let inner = pressing.iter().filter(|(arc, _)| (arc - middle).abs() <= reach);
    let points: Vec<[f64; 2]> =
        inner.map(|(arc, pressure)| [(arc - middle).powi(2), pressure * pressure]).collect();
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let above: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let slope = over(above, points.iter().map(|p| (p[0] - x).powi(2)).sum());
    let square = y - slope * x;
    [square.sqrt(), (-square / slope).sqrt()]
}
