//! The quantities of a result. Each is declared once, below; its field in `result.json` and in the
//! schema, its column in tables, CSV and pages, its array in `fields.vtu`, its picture, its place
//! in `compare`, and its line in `golden/quantities.md` follow.
//!
//! ```text
//! struct          lives on               one value of the struct for
//! IterationRow    an iteration           each iteration
//! BodySummary     a body                 each body, at the end
//! SupportForce    a restraint            each restraint of the scene, at the end
//! NodeFields      a node                 all nodes, at the end
//! TriangleValues  a triangle             each triangle, at the end
//! ContactNode     a contact node         each contact node that faces the target, at the end
//! ```
//!
//! An entry is `field: type = value, "title" [symbols] unit, "what it is"`. The title heads
//! columns; without one the quantity is in `result.json` only. A vector or a tensor has a symbol for each
//! component.

mod places;
mod value;

use serde::{Serialize, Serializer};

use crate::contact::{ContactPlace, Status};
use crate::solution::{Cycle, Solution};
use base::choices;
pub use places::summaries;
use places::{BodyPlace, IterationPlace, SupportPlace, TrianglePlace};
use problem::model::{NodeId, TriangleId};
use problem::scene::Units;
pub use value::Value;

/// A quantity of the places whose values `T` has.
pub struct Quantity<T> {
    /// Its field in files.
    pub name: &'static str,
    /// Its name in words, the heading of a column; empty where only files have it.
    pub title: &'static str,
    /// Its symbol, of a vector or a tensor that of each component; none where it has none.
    pub symbols: &'static [&'static str],
    /// What it is measured in.
    pub unit: Unit,
    /// What it is, in a sentence.
    pub meaning: &'static str,
    /// Returns its value.
    pub value: fn(&T) -> Value,
}

choices! {
    /// What a quantity is measured in.
    Unit {
        /// It is no measured number: a count, a status, a name.
        None = "",
        /// It has no unit.
        One = "1",
        /// It is a part of a whole.
        Share = "share",
        /// That of lengths in the scene.
        Length = "length",
        /// That of stresses in the scene.
        Stress = "stress",
        /// That of forces in the scene.
        Force = "force",
    }
}

macro_rules! quantities {
    (
        $(#[$doc:meta])*
        $name:ident from $source:ident: $Source:ty {
            $($(#[$meta:meta])*
            $field:ident $(in files $file:literal)?: $type:ty = $value:expr,
                $title:literal $symbols:tt $unit:ident, $meaning:literal;)+
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Serialize)]
        pub struct $name {
            $(#[doc = $meaning] $(#[serde(rename = $file)])? $(#[$meta])* pub $field: $type),+
        }

        impl $name {
            /// Its quantities, in order.
            pub const QUANTITIES: &'static [Quantity<$name>] = &[$(Quantity {
                name: [$($file,)? stringify!($field)][0],
                title: $title,
                symbols: &$symbols,
                unit: Unit::$unit,
                meaning: $meaning,
                value: |values| Value::from(&values.$field),
            }),+];

            pub(crate) fn compute($source: $Source) -> Self {
                $name { $($field: $value),+ }
            }
        }
    };
}

quantities! {
    /// The results of an iteration.
    IterationRow from at: &IterationPlace<'_> {
        k: usize = at.step.k, "k" ["k"] None, "The number of the iteration, from 1.";
        in_contact: usize = at.step.in_contact, "in contact" [] None,
            "The number of contact nodes in contact.";
        dy: Vec<u8> = at.step.closed().map(u8::from).collect(), "" ["dy"] None,
            "Which entries of the contact surface are in contact: 1 or 0 for each.";
        #[serde(skip_serializing_if = "Option::is_none")]
        load: Option<f64> = at.step.unilateral().map(|own| own.load), "load" [] One,
            "Under `unilateral`, the part of the path of the load that is applied; whole numbers \
             end stages.";
        #[serde(skip_serializing_if = "Option::is_none")]
        statuses: Option<Vec<Status>> = at.step.unilateral().map(|_| at.step.statuses.clone()),
            "" [] None,
            "Under `unilateral`, the status of each entry of the contact surface.";
        max_displacement: f64 = at.step.max_displacement, "largest |u|" ["max |u|"] Length,
            "The largest total displacement of a node.";
        cycle: Option<Cycle> = at.step.cycle.clone(), "contact state" [] None,
            "The earlier iterations with this contact state; null where it is new.";
        eq1_residual: f64 = at.step.contact_residual, "residual of contact" [] Length,
            "The residual of the contact condition: of eq. (1) in total displacements, or the \
             largest gap or overlap left under `unilateral`.";
        eq1_residual_step: f64 = at.step.contact_residual_step, "" [] Length,
            "The same in the displacements solved for: the increment where the load is stepped.";
        target_force: f64 = at.step.target_force, "force on target" [] Force,
            "The force that contact passes from one body to the other: along the load where that \
             acts on one of the two bodies alone, else its size. 0 without contact.";
        target_share: Option<f64> = at.target_share(),
            "share of the load" [] Share,
            "That force over the size of the whole load, along it; null where that says nothing: without a load, where \
             it acts on another body too or cancels, and where a lever makes the force larger than the load.";
        solve_residual: f64 = at.step.solve_residual, "residual" [] One,
            "The relative residual |A x − b| / (|A| |x| + |b|) of the equations.";
    }
}

quantities! {
    /// The largest values of a body.
    BodySummary from at: &BodyPlace<'_> {
        name: String = at.body.name.clone(), "body" [] None, "The name of the body.";
        nodes: usize = at.body.nodes.len(), "nodes" [] None, "The number of its nodes.";
        triangles: usize = at.body.triangles.len(), "triangles" [] None,
            "The number of its triangles.";
        max_displacement: f64 = at.max_displacement(), "largest |u|" ["max |u|"] Length,
            "The largest displacement of a node.";
        max_von_mises_stress: f64 = at.state(at.largest()).von_mises_stress,
            "largest von Mises stress" ["max σ_v"] Stress,
            "The largest von Mises stress of its triangles.";
        at: TriangleId = at.largest(), "" [] None,
            "The triangle with that stress, the first of those that have it.";
        as_large: usize = at.most_stressed.others, "triangles as large" [] None,
            "The number of other triangles with the same stress to 1e-9 of it, as mirror images \
             have: only rounding tells which is the largest.";
        centre: [f64; 2] = at.centre(), "at" ["x", "y"] Length, "The centre of that triangle.";
        max_von_mises_strain: f64 = at.max_von_mises_strain(),
            "largest von Mises strain" ["max ε_v"] One,
            "The largest von Mises strain of its triangles.";
    }
}

quantities! {
    /// What a restraint of the scene carries.
    SupportForce from at: &SupportPlace<'_> {
        restraint: String = at.name.to_owned(), "restraint" [] None,
            "What it holds, as the scene says: the name of a group, or a node.";
        nodes: usize = at.nodes, "nodes" [] None,
            "The number of nodes that it holds along a direction along which none before it does.";
        reaction: [f64; 2] = at.force, "reaction" ["R_x", "R_y"] Force,
            "The sum of its forces on these nodes along x and y.";
    }
}

quantities! {
    /// The values at the nodes, in order.
    NodeFields from solution: &Solution {
        nodes: Vec<[f64; 2]> = solution.model.nodes.clone(), "" ["x", "y"] Length,
            "The coordinates of each node in the undeformed shape.";
        u: Vec<[f64; 2]> = solution.displacements(), "displacement" ["u_x", "u_y"] Length,
            "The displacement of each node along x and y.";
        reaction: Vec<[f64; 2]> = solution.by_node(&solution.reactions),
            "reaction" ["R_x", "R_y"] Force,
            "The force of the restraints on each node along x and y, 0 where nothing holds it.";
    }
}

quantities! {
    /// The stresses and strains of a triangle.
    TriangleValues from at: &TrianglePlace<'_> {
        sigma: [f64; 4] = at.sigma(), "stress" ["σ_x", "σ_y", "τ_xy", "σ_z"] Stress,
            "The stresses sigma_x, sigma_y, tau_xy, sigma_z.";
        epsilon: [f64; 4] = at.epsilon(), "strain" ["ε_x", "ε_y", "γ_xy", "ε_z"] One,
            "The strains e_xx, e_yy, g_xy, e_zz; the shear strain is the engineering one.";
        von_mises_stress: f64 = at.state.von_mises_stress, "von Mises stress" ["σ_v"] Stress,
            "The von Mises stress.";
        von_mises_strain: f64 = at.state.von_mises_strain, "von Mises strain" ["ε_v"] One,
            "The von Mises strain.";
        #[serde(skip_serializing_if = "Option::is_none")]
        mesh_error: Option<f64> = at.mesh_error, "mesh error" [] One,
            "The estimated error that the mesh causes, in the energy norm, over that norm for a \
             mean triangle; absent where errors are not estimated.";
    }
}

quantities! {
    /// A contact node at the end of a run.
    ContactNode from at: &ContactPlace<'_> {
        node: NodeId = at.pairing.node, "node" [] None, "The node of the contact surface.";
        arc: f64 = at.arc, "arc" ["s"] Length,
            "The distance from the first contact node along the undeformed contact surface.";
        #[serde(serialize_with = "as_number")]
        in_contact in files "dy": bool = at.end.in_contact, "in contact" ["dy"] None,
            "Whether it is in contact by the variant's own rule: 1 or 0.";
        gap: f64 = at.end.gap, "gap" ["g"] Length,
            "The distance from the target along its normal, < 0 where the node penetrates; under \
             mortar its weighted mean over the surface around the node.";
        force: Option<f64> = at.force(0), "contact force" [] Force,
            "The force on the node along the normal, < 0 where it pulls; null where restraints of \
             the node leave it undetermined.";
        pressure: Option<f64> = at.traction(0), "contact pressure" ["p"] Stress,
            "That force over the undeformed surface of the node; null for a node that bounds no \
             contact edge.";
        shear: Option<f64> = at.traction(1), "contact shear" ["τ"] Stress,
            "The traction along the tangent, which is the normal turned left.";
        friction_needed: Option<f64> = at.friction_needed(), "friction needed" ["|τ|/p"] One,
            "The coefficient of friction that keeps the node from sliding; null where the force \
             does not press by more than rounding.";
        #[serde(skip_serializing_if = "Option::is_none")]
        status: Option<Status> = at.end.status, "contact status" [] None,
            "Open, stick or slip, under `unilateral`.";
    }
}

/// Writes `dy` as 1 or 0.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it so")]
fn as_number<S: Serializer>(value: &bool, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_u8(u8::from(*value))
}

impl<T> Quantity<T> {
    /// Returns whether it is a place in the undeformed shape, which no error of a solution moves.
    pub fn is_place(&self) -> bool {
        matches!(self.symbols, ["s"] | ["x", "y"])
    }

    /// Returns the name of each component in ASCII, such as sigma_x; the field's name where there
    /// is only one.
    pub fn components(&self) -> Vec<String> {
        let ascii = |symbol: &str| {
            [('σ', "sigma"), ('τ', "tau"), ('ε', "epsilon"), ('γ', "gamma")]
                .into_iter()
                .fold(symbol.to_string(), |name, (letter, spelt)| name.replace(letter, spelt))
        };
        match self.symbols {
            [] | [_] => vec![self.name.to_string()],
            components => components.iter().map(|symbol| ascii(symbol)).collect(),
        }
    }

    /// Returns the name of its array in a file for viewers, made of its title.
    pub fn array(&self) -> String {
        self.title.to_lowercase().replace(' ', "_")
    }
}

impl Unit {
    /// Returns the unit in a scene; empty where it has none.
    pub fn in_scene(self, units: &Units) -> &str {
        match self {
            Unit::None | Unit::One | Unit::Share => "",
            Unit::Length => &units.length,
            Unit::Stress => &units.stress,
            Unit::Force => &units.force,
        }
    }
}
