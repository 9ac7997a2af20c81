//! The input deck of `ccx`.

use super::problem::{Contact, Equation, Pair, Problem};
use base::error::{InputError, Result};
use base::files::DECK;
use base::plain::on_a_line;
use engine::support_constraints;
use problem::element::Plane;
use problem::model::{Dof, Material, Model, NodeId, Restraint, unordered};
use problem::modelling::Friction;

/// ccx reads no more characters of a field.
const WIDTH: usize = 20;
/// ccx takes no more terms on a line of an equation.
const TERMS_ON_A_LINE: usize = 4;
/// Coefficient of friction that nothing overcomes.
const STICKING: f64 = 1000.0;
/// Stick slope over penalty: the manual advises about a tenth.
const STICK_SLOPE: f64 = 0.1;

/// The deck of a problem: plane triangles, the whole load in one static step; displacements and
/// stresses go to the `.dat` file, where ccx prints seven digits (`.frd`: six).
///
/// # Errors
/// The surfaces of a pair bound no triangle.
pub fn deck(problem: &Problem) -> Result<String> {
    let model = problem.model;
    let own = Equation::of_constraints(model, &support_constraints(model, 1.0));
    let contact = match problem.contact {
        Contact::Equations(equations, _) => equation_cards(model, &[&own[..], equations].concat()),
        Contact::Pair(_) if !model.has_contact() => equation_cards(model, &own),
        Contact::Pair(pair) => equation_cards(model, &own) + &pair_cards(model, pair)?,
    };
    // Comment lines: what wrote it, the scene's title, the plane problem, and how the bodies touch.
    let title: String = on_a_line(&problem.scene.title).chars().take(100).collect();
    let touch = match problem.contact {
        Contact::Equations(equations, _) => format!("{} equations", equations.len()),
        Contact::Pair(Pair { penalty, friction }) => {
            format!("contact pair, penalty {penalty:e} stress/length, friction {friction}")
        }
    };
    let mut text = format!("{DECK}** {title}\n** plane {}; contact: {touch}\n", model.plane);
    text += "*NODE, NSET=NODES\n";
    for node in model.node_ids() {
        let [x, y] = model.coordinates(node).map(field);
        text += &format!("{node},{x},{y}\n");
    }
    text += &(elements(model) + &contact + "*BOUNDARY\n");
    for (dof, restraint) in model.all_dofs().zip(model.restraints()) {
        match restraint {
            Restraint::Free => (),
            Restraint::Fixed => {
                text += &format!("{},{}\n", node_and_direction(dof), dof.direction() + 1);
            }
        }
    }
    Ok(text + &step(problem))
}

/// The triangles of each material, in the order in which the materials come.
fn elements(model: &Model) -> String {
    let kind = match model.plane {
        Plane::Strain => "CPE3",
        Plane::Stress => "CPS3",
    };
    let mut text = String::new();
    for (k, material) in materials(model).into_iter().enumerate() {
        let name = format!("MATERIAL{}", k + 1);
        text += &format!("*ELEMENT, TYPE={kind}, ELSET={name}\n");
        let all = model.triangle_ids().zip(&model.triangles);
        for (id, triangle) in all.filter(|(_, triangle)| triangle.material == material) {
            let [a, b, c] = triangle.nodes;
            text += &format!("{id},{a},{b},{c}\n");
        }
        let [e, nu] = [material.e, material.nu].map(field);
        text += &format!("*MATERIAL, NAME={name}\n*ELASTIC\n{e},{nu}\n");
        text += &format!("*SOLID SECTION, ELSET={name}, MATERIAL={name}\n");
        text += &(field(model.thickness) + "\n");
    }
    text
}

/// The distinct materials in order of appearance.
fn materials(model: &Model) -> Vec<Material> {
    let mut found = Vec::new();
    for material in model.triangles.iter().map(|triangle| triangle.material) {
        if !found.contains(&material) {
            found.push(material);
        }
    }
    found
}

/// The equations. ccx knows homogeneous ones only: a constant is the prescribed displacement, in x,
/// of a node of its own.
fn equation_cards(model: &Model, equations: &[Equation]) -> String {
    let mut text = String::new();
    let mut nodes = model.nodes.len();
    for Equation { terms, constant } in equations {
        let mut terms = terms.clone();
        if *constant != 0.0 {
            let own = NodeId::new(nodes);
            nodes += 1;
            text += &format!("*NODE\n{own},0,0\n*BOUNDARY\n{own},1,1,{}\n", field(-constant));
            terms.push((own.x(), 1.0));
        }
        text += &format!("*EQUATION\n{}\n", terms.len());
        for some in terms.chunks(TERMS_ON_A_LINE) {
            let some =
                some.iter().map(|(dof, x)| format!("{},{}", node_and_direction(*dof), field(*x)));
            text += &(some.collect::<Vec<_>>().join(",") + "\n");
        }
    }
    text
}

/// The node and the direction by which ccx knows a degree of freedom: 1 for x, 2 for y.
fn node_and_direction(dof: Dof) -> String {
    format!("{},{}", dof.node(), dof.direction() + 1)
}

/// The two surfaces and the pair. Both surfaces are made of element faces: with a slave surface of
/// nodes ccx knows no area for a node.
fn pair_cards(model: &Model, pair: &Pair) -> Result<String> {
    let slave =
        surface(model, "SLAVE", |side| side.iter().all(|node| model.contact.nodes.contains(node)))?;
    let master = surface(model, "MASTER", |side| {
        model.target_edges().any(|edge| unordered(edge.nodes) == unordered(side))
    })?;
    let mut text = slave + &master + "*SURFACE INTERACTION, NAME=CONTACT\n";
    text += "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n";
    text += &(field(pair.penalty) + "\n");
    if pair.friction != Friction::NONE {
        let slope = field(STICK_SLOPE * pair.penalty);
        let coefficient = pair.friction.coefficient().min(STICKING);
        text += &format!("*FRICTION\n{},{slope}\n", field(coefficient));
    }
    Ok(text + "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=NODE TO SURFACE\nSLAVE,MASTER\n")
}

/// The faces of triangles whose sides `wanted` takes, as a surface.
fn surface(model: &Model, name: &str, wanted: impl Fn([NodeId; 2]) -> bool) -> Result<String> {
    let mut text = format!("*SURFACE, NAME={name}, TYPE=ELEMENT\n");
    let mut faces = 0;
    for (id, triangle) in model.triangle_ids().zip(&model.triangles) {
        let corners = triangle.nodes;
        for k in (0..3).filter(|&k| wanted([corners[k], corners[(k + 1) % 3]])) {
            text += &format!("{id},S{}\n", k + 1);
            faces += 1;
        }
    }
    if faces == 0 {
        let what = format!("the {} surface bounds no triangle", name.to_lowercase());
        return Err(InputError::new("contact", what, "name edges of the bodies"));
    }
    Ok(text)
}

/// One static step with the loads on the displacements that are not restrained.
fn step(problem: &Problem) -> String {
    let mut text = String::from("*STEP\n*STATIC\n");
    if let Contact::Pair(_) = problem.contact {
        // A tenth of the load first: from the whole of it at once ccx may settle on another contact
        // zone.
        text += "0.1,1\n";
    }
    let model = problem.model;
    let load = match problem.contact {
        Contact::Equations(_, Some(friction)) => &model.load + friction,
        Contact::Equations(_, None) | Contact::Pair(_) => model.load.clone(),
    };
    for (dof, force) in model.all_dofs().zip(load.iter()) {
        if *force != 0.0 && !model.is_restrained(dof) {
            text += &format!("*CLOAD\n{},{}\n", node_and_direction(dof), field(*force));
        }
    }
    text += "*NODE PRINT, NSET=NODES\nU\n";
    for k in 1..=materials(model).len() {
        text += &format!("*EL PRINT, ELSET=MATERIAL{k}\nS\n");
    }
    text + "*END STEP\n"
}

/// `x` in at most 20 characters, with as many of its digits as fit: all, or at least 13.
pub fn field(x: f64) -> String {
    let exact = [format!("{x}"), format!("{x:e}")];
    let rounded = (0..WIDTH).rev().map(|digits| format!("{x:.digits$e}"));
    let mut written = exact.into_iter().chain(rounded);
    written.find(|text| text.len() <= WIDTH).expect("one digit and an exponent fit")
}
