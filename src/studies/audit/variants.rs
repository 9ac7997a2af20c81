//! The variants side by side.

use rayon::prelude::*;
use serde::Serialize;

use super::case::Case;
use super::evidence::{Outcome, beyond_noise, confirmed, flat};
use engine::contact::pulling;
use engine::estimates::discretisation::Discretisation;
use engine::{
    BodySummary, Cycle, Distance, Solution, distance, max_displacement, over, share_of_load,
    summaries,
};
use numbers::finite;
use problem::model::NodeId;
use problem::modelling::Variant;
use problem::scene::symmetry::images;

/// A variant and what came of its run.
#[derive(Clone, Debug, Serialize)]
pub struct VariantRow {
    /// The variant.
    pub variant: Variant,
    /// What came of it.
    #[serde(flatten, serialize_with = "flat")]
    pub outcome: Outcome<VariantRun>,
}

/// The end of the run of a variant.
#[derive(Clone, Debug, Serialize)]
pub struct VariantRun {
    /// Number of contact nodes with dy = 1, by iteration.
    pub in_contact: Vec<usize>,
    /// The contact nodes themselves at the last one.
    pub contact_set: Vec<NodeId>,
    /// The force that contact passes on at the end over the size of the whole load; 0 without a
    /// load.
    pub target_share: Option<f64>,
    /// Whether contact passes no load on at the end, beyond rounding, though there is a load.
    pub transmits_nothing: bool,
    /// Residual of eq. (1) at the end, total displacements, length.
    pub eq1_residual: f64,
    /// Where the last contact state came before.
    pub cycle: Option<Cycle>,
    /// The largest displacement and stress of each body.
    pub bodies: Vec<BodySummary>,
    /// How far this is from the equilibrium under the scene's own friction; nothing where there is
    /// none.
    pub distance: Option<Distance>,
    /// The largest friction coefficient that a node in contact would need not to slide.
    pub friction_needed: Option<f64>,
    /// The nodes in contact that the target pulls.
    pub pulling: Vec<NodeId>,
    /// The deepest contact node at the end; nothing where none faces the target.
    pub penetration: Option<Penetration>,
    /// The node that is pressed hardest across an open gap at the end; nothing where none is.
    pub across: Option<PressedAcross>,
    /// Of a scene that is its own mirror image, the largest difference of a displacement from that of the
    /// mirrored node, over the largest displacement; nothing of another scene.
    pub asymmetry: Option<f64>,
    /// The error of the mesh in the energy norm, relative; nothing where it is not known.
    pub mesh_error: Option<f64>,
}

impl VariantRun {
    /// Returns whether its contact state alternates, so that its figures are those of one of several states.
    pub fn is_unsettled(&self) -> bool {
        self.cycle.as_ref().is_some_and(|cycle| cycle.length > 1)
    }

    /// Returns the figures at its end, each over the scale of its kind.
    fn figures(&self) -> Vec<Option<f64>> {
        let mut figures = vec![
            self.in_contact.last().map(|n| *n as f64),
            Some(self.pulling.len() as f64),
            self.target_share,
            self.distance.as_ref().map(|from| from.energy_relative),
            self.friction_needed,
            self.penetration.as_ref().map(|found| found.relative),
            self.cycle.as_ref().map(|cycle| cycle.length as f64),
        ];
        let sizes: [fn(&BodySummary) -> f64; 3] = [
            |body| body.max_displacement,
            |body| body.max_von_mises_stress,
            |body| body.max_von_mises_strain,
        ];
        for size in sizes {
            let largest = self.bodies.iter().map(size).fold(0.0, f64::max);
            figures.extend(self.bodies.iter().map(|body| Some(over(size(body), largest))));
        }
        figures
    }
}

/// How deep the deepest contact node is inside the target at the end of a run.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Penetration {
    /// The node.
    pub node: NodeId,
    /// Whether it is in contact.
    pub in_contact: bool,
    /// Length; 0 where none is inside by more than rounding, or a hundredth of c_tll.
    pub depth: f64,
    /// The depth over the largest displacement of the target.
    pub relative: f64,
}

impl Penetration {
    /// Depths over the largest displacement that are rounding.
    const ROUNDING: f64 = 1e-9;

    /// Depths over c_tll that are no penetration.
    const NONE: f64 = 0.01;

    /// Finds the deepest contact node; nothing where none faces the target.
    pub fn of(solution: &Solution) -> Option<Self> {
        let deepest = solution.contact.iter().min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        let target = &solution.model.target()?.name;
        let target = summaries(solution).into_iter().find(|body| body.name == *target)?;
        let rounding = Self::ROUNDING * max_displacement(&solution.u);
        let none = rounding.max(Self::NONE * solution.model.contact.tolerance);
        let depth = if -deepest.gap <= none { 0.0 } else { -deepest.gap };
        let relative = over(depth, target.max_displacement);
        let (node, in_contact) = (deepest.node, deepest.in_contact);
        Some(Penetration { node, in_contact, depth, relative })
    }
}

/// A node that is pressed though it does not touch the target.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct PressedAcross {
    /// The node.
    pub node: NodeId,
    /// The pressure, stress.
    pub pressure: f64,
    /// The distance from the target, length.
    pub gap: f64,
}

impl PressedAcross {
    /// Finds the node under the largest pressure among those that are apart from the target.
    fn of(solution: &Solution) -> Option<Self> {
        let apart = solution.in_contact().filter(|contact| solution.is_apart(contact));
        let pressed = apart.filter_map(|contact| {
            let pressure = contact.pressure.filter(|pressure| *pressure > 0.0)?;
            Some(PressedAcross { node: contact.node, pressure, gap: contact.gap })
        });
        pressed.max_by(|a, b| a.pressure.total_cmp(&b.pressure))
    }
}

/// Returns how far the displacements are from their mirror image, over the largest; nothing where the scene
/// is not its own mirror image.
fn asymmetry(solution: &Solution) -> Option<f64> {
    let images = images(&solution.model)?;
    let u = solution.displacements();
    let apart = u.iter().zip(images).map(|([x, y], image)| {
        let [other_x, other_y] = u[image.index()];
        (x + other_x).hypot(y - other_y)
    });
    Some(beyond_noise(over(apart.fold(0.0, f64::max), max_displacement(&solution.u))))
}

/// Every variant on a scene, in the order of `Variant::ALL`.
pub fn side_by_side(case: &Case) -> Vec<VariantRow> {
    let row = |variant: &Variant| {
        let others = case.equivalents().iter().map(|case| end(case, *variant));
        let outcome = confirmed(end(case, *variant), others, VariantRun::figures);
        VariantRow { variant: *variant, outcome }
    };
    Variant::ALL.par_iter().map(row).collect()
}

/// Returns how far a run is from the equilibrium; what is rounding alone is 0.
pub(super) fn apart(solution: &Solution, equilibrium: &Solution) -> Distance {
    let distance = distance(solution, equilibrium);
    Distance {
        displacement_relative: beyond_noise(distance.displacement_relative),
        energy_relative: beyond_noise(distance.energy_relative),
        ..distance
    }
}

/// Returns the force that contact passes on at the end over the size of the whole load; None where that says
/// nothing.
pub(super) fn target_share(solution: &Solution) -> Option<f64> {
    share_of_load(&solution.model, solution.target_force())
}

/// Returns the error of the mesh in the energy norm, relative; nothing where it is not known.
pub(super) fn mesh_error(solution: &Solution) -> Option<f64> {
    finite(Discretisation::new(&solution.model, &solution.elements).relative())
}

fn end(case: &Case, variant: Variant) -> Outcome<VariantRun> {
    let solution = case.run(variant)?;
    let (model, last) = (&*solution.model, solution.last());
    let needed = solution.contact.iter().filter_map(|c| c.friction_needed);
    Ok(VariantRun {
        in_contact: solution.steps.iter().map(|step| step.in_contact).collect(),
        contact_set: last.contact_set(model),
        target_share: target_share(solution),
        transmits_nothing: solution.transmits_nothing(),
        eq1_residual: last.contact_residual,
        cycle: last.cycle.clone(),
        bodies: summaries(solution),
        distance: case.from_equilibrium(solution),
        friction_needed: needed.reduce(f64::max),
        pulling: pulling(&solution.contact, solution.model.load.amax()),
        penetration: Penetration::of(solution),
        across: PressedAcross::of(solution),
        asymmetry: asymmetry(solution),
        mesh_error: mesh_error(solution),
    })
}
