//! `result.json`: everything that a machine needs of a run.

use serde::Serialize;

use super::json;
use super::plan;
use engine::contact::ContactNode;
use engine::estimates::{ErrorEstimates, Perturbed};
use engine::linear::Arithmetic;
use engine::plan::Plan;
use engine::{
    Assessment, BodySummary, Distance, Equilibrium, Hertz, IterationRow, NodeFields, Overlap,
    Resultant, Solution, Stretch, SupportForce, TriangleValues,
    contact::{InitialGaps, Surfaces},
};
use numbers::scalar::rational;
use paper::listings::Which;
use paper::mirror::Reading;
use problem::model::{Material, NodeId, Triangle};
use problem::modelling::{ContactModel, Variant};
use problem::scene::{Scene, sha256};

/// The most triangles whose mesh has its `u` and `elements` in `result.json` without being asked.
pub const MOST_TRIANGLES: usize = 20_000;

/// The content of `result.json`. Lengths, stresses and forces are in the units of the scene. Every
/// float reads back to the same bits; one that is not finite is null.
#[derive(Clone, Debug, Serialize)]
pub struct ResultFile<'a> {
    #[serde(skip)]
    of: &'a Scene,
    /// Whether contact passes no load on at the end, beyond rounding, though there is a load: an audit
    /// result; absent where it is not so.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub transmits_nothing: bool,
    /// Whether no node is in contact at the end, though the scene has contact; absent where it is not so.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub nothing_in_contact: bool,
    /// Where bodies lie in each other though no group of contact keeps them apart: extend the groups; absent
    /// where they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<&'a Overlap>,
    /// Why it is not the equilibrium of the scene, in words, and the exit status is 4; absent where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// Why linear triangles lock, in words; absent where they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locking: Option<String>,
    /// The name of the scene.
    pub scene: &'a str,
    /// The scene's line for people, which may be empty.
    pub title: &'a str,
    /// The variant that was run.
    pub variant: Variant,
    /// The reading of the print that was in force, with the plane problem (R6) and the load of an
    /// iteration (R7) that the scene and the variant set where the reading did not.
    pub reading: Reading,
    /// The edited listings that were executed, each with the SHA-256 of its text.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edited: Vec<EditedListing>,
    /// How contact was modelled: `coupling`, `friction`, `geometry` and `status`.
    #[serde(flatten)]
    pub modelled: ContactModel,
    /// The scalar and the solver that were used.
    pub arithmetic: Arithmetic,
    /// The thickness across the plane, length.
    pub thickness: f64,
    /// The tolerance of the contact search, length; absent without contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c_tll: Option<f64>,
    /// The materials that triangles have, each once.
    pub materials: Vec<Material>,
    /// What was built and what not, in one line; absent where no plan was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plan: Option<String>,
    /// The sum of all loads along x and y, force.
    pub load: [f64; 2],
    /// The numbers, in the mesh file, of the nodes that belong to no triangle and were dropped.
    pub dropped: &'a [NodeId],
    /// What the mesh file has in another form, such as node numbers with gaps, in sentences.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    pub adapted: &'a [String],
    /// The results of each iteration, in order.
    pub iterations: Vec<IterationRow>,
    /// The largest values of each body.
    pub bodies: &'a [BodySummary],
    /// What each restraint carries, in the order of the scene file.
    pub reactions: Vec<SupportForce>,
    /// What is unusual about the gaps before any load; absent where the surfaces touch or nearly do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial_gaps: Option<InitialGaps>,
    /// What contact passes to the target; absent without contact between two bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resultant: Option<Resultant>,
    /// The unbroken stretches of contact, in order along the contact surface.
    pub stretches: Vec<Stretch>,
    /// The contact nodes that face the target at the end, in order along the contact surface.
    pub contact: &'a [ContactNode],
    /// Hertz's contact, where his theory applies.
    pub hertz: Option<Hertz>,
    /// How far the numbers may be from the truth; absent where that was left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_estimates: Option<&'a ErrorEstimates>,
    /// What changes of the input in the last digits do to the run; absent where that was not measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounding: Option<&'a Perturbed>,
    /// What `unilateral` knows of its equilibrium: the path of the load, and whether there are
    /// others; absent under the other variants.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equilibrium: Option<&'a Equilibrium>,
    /// The largest difference of a displacement component from a run with half as many steps of the
    /// load, length; absent without a path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path_change: Option<f64>,
    /// How far the run is from the reference solution (no friction, initial geometry, mortar),
    /// where there is one.
    pub distance: Option<&'a Distance>,
    /// How far the run is from the equilibrium under the scene's own friction and geometry; nothing
    /// where that is the reference solution, or there is none.
    pub distance_from_equilibrium: Option<&'a Distance>,
    /// The file beside this one that has `u` and `elements`, where they are absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fields_in: Option<&'static str>,
    /// The values at the nodes.
    #[serde(flatten)]
    pub nodes: Option<NodeFields>,
    /// The displacements in decimal with all digits, where the scalar has more than an `f64`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub u_digits: Option<Vec<[String; 2]>>,
    /// The stresses and strains of each triangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<Vec<ElementRow>>,
}

/// A listing that stood in place of one of the paper's.
#[derive(Clone, Debug, Serialize)]
pub struct EditedListing {
    pub listing: Which,
    pub sha256: String,
}

/// The stresses and strains of a triangle.
#[derive(Clone, Debug, Serialize)]
pub struct ElementRow {
    /// Its number, from 1: its row of `EL`.
    pub n: usize,
    /// The numbers of its nodes.
    pub nodes: [NodeId; 3],
    /// The place of its material in `materials`, from 1.
    pub material: usize,
    /// The quantities of the triangle.
    #[serde(flatten)]
    pub values: TriangleValues,
}

impl<'a> ResultFile<'a> {
    /// Gathers what there is to say of a run that followed `plan`. The fields of a mesh of more than
    /// [`MOST_TRIANGLES`] are left to `fields.vtu` unless `all_fields` asks for them.
    pub fn new(
        solution: &'a Solution,
        assessment: &'a Assessment,
        plan: Option<&Plan>,
        all_fields: bool,
    ) -> Self {
        let request = &solution.request;
        let scene = &request.scene;
        // One digit more than the scalar keeps, so that it reads back; of exact numbers forty.
        let digits = request.arithmetic.scalar.properties().digits.map_or(40, |digits| digits + 1);
        let decimal = |u| rational::decimal(u, digits as usize);
        let edited = request
            .edited
            .iter()
            .map(|edited| EditedListing { listing: edited.which, sha256: sha256(&edited.text) });
        let has_fields = all_fields || solution.elements.len() <= MOST_TRIANGLES;
        let pairs = solution.digits.as_ref().map(|digits| digits.as_chunks().0.iter());
        let materials = solution.model.materials();
        ResultFile {
            of: scene,
            transmits_nothing: solution.transmits_nothing(),
            nothing_in_contact: solution.touches_nothing(),
            overlap: solution.overlap.as_ref(),
            doubt: solution.doubt().map(|doubt| doubt.what),
            locking: engine::locking_of(&solution.model),
            scene: &scene.name,
            title: &scene.title,
            variant: request.variant,
            reading: Reading {
                r6: Some(solution.model.plane),
                r7: Some(request.schedule()),
                ..request.reading
            },
            modelled: request.contact,
            edited: edited.collect(),
            arithmetic: Arithmetic { solver: Some(request.solver()), ..request.arithmetic },
            thickness: solution.model.thickness,
            c_tll: solution.model.has_contact().then_some(solution.model.contact.tolerance),
            plan: plan.map(plan::line),
            load: solution.model.total_load(),
            dropped: &solution.model.dropped,
            adapted: scene.adapted(),
            iterations: IterationRow::all(solution),
            bodies: &assessment.bodies,
            reactions: SupportForce::all(solution),
            initial_gaps: Surfaces::new(&solution.model)
                .ok()
                .and_then(|found| found.initial_gaps(&solution.model)),
            resultant: engine::resultant(solution),
            stretches: engine::stretches(solution),
            contact: &solution.contact,
            hertz: assessment.hertz,
            error_estimates: assessment.estimates.as_ref().map(|found| &found.errors),
            rounding: assessment.rounding.as_ref(),
            equilibrium: solution.equilibrium.as_ref(),
            path_change: assessment.path_change.as_ref().and_then(|it| it.as_ref().ok().copied()),
            distance: assessment.measure().map(|measured| &measured.distance),
            distance_from_equilibrium: match &assessment.equilibrium {
                Some(Ok(measured)) => Some(&measured.distance),
                _ => None,
            },
            fields_in: (!has_fields).then_some("fields.vtu"),
            nodes: has_fields.then(|| NodeFields::new(solution)),
            u_digits: pairs.map(|pairs| pairs.map(|[x, y]| [decimal(x), decimal(y)]).collect()),
            elements: has_fields.then(|| rows(solution, assessment, &materials)),
            materials,
        }
    }

    /// Writes the content of the file, over several lines.
    pub fn to_json(&self) -> String {
        json::pretty(&json::document(Some(self.of), self))
    }
}

/// Returns the values of each triangle of a solution that has these materials.
fn rows(solution: &Solution, assessment: &Assessment, materials: &[Material]) -> Vec<ElementRow> {
    let values = TriangleValues::all(solution, assessment.mesh_error().as_deref());
    let rows = values.into_iter().zip(&solution.model.triangles).zip(1..);
    let row = |((values, triangle), n): ((TriangleValues, &Triangle), usize)| {
        let own = |other: &Material| *other == triangle.material;
        let material = materials.iter().position(own).expect("every triangle has one of them") + 1;
        ElementRow { n, nodes: triangle.nodes, material, values }
    };
    rows.map(row).collect()
}
