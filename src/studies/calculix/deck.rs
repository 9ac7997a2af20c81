//! The input deck of `ccx`.

use nalgebra::DVector;

use super::contact::{Contact, Equation, Pair};
use base::error::{InputError, Result};
use base::files::DECK;
use base::plain::on_a_line;
use problem::element::Plane;
use problem::model::{Dof, Model, NodeId, unordered};
use problem::modelling::Friction;

/// ccx reads no more characters of a field.
const WIDTH: usize = 20;
/// ccx takes no more terms on a line of an equation.
const TERMS_ON_A_LINE: usize = 4;
/// Coefficient of friction that nothing overcomes.
const STICKING: f64 = 1000.0;
/// Stick slope over penalty: the manual advises about a tenth.
const STICK_SLOPE: f64 = 0.1;

/// The deck of a model under a title: plane triangles, the whole load in one static step; displacements and
/// stresses go to the `.dat` file, where ccx prints seven digits (`.frd`: six).
///
/// # Errors
/// The surfaces of a pair bound no triangle.
pub fn deck(title: &str, model: &Model, contact: &Contact) -> Result<String> {
    let held: Vec<Equation> = oblique(model).collect();
    let (touch, cards, step) = match contact {
        Contact::Equations(equations, friction) => {
            let load = friction.iter().fold(model.load.clone(), |load, friction| load + friction);
            let cards = equation_cards(model, &[&held[..], equations].concat());
            (format!("{} equations", equations.len()), cards, step(model, &load, ""))
        }
        Contact::Pair(pair @ Pair { penalty, friction }) => {
            let touch =
                format!("contact pair, penalty {penalty:e} stress/length, friction {friction}");
            let surfaces =
                if model.has_contact() { pair_cards(model, pair)? } else { String::new() };
            // A tenth of the load first: from the whole of it at once ccx may settle on another contact zone.
            (touch, equation_cards(model, &held) + &surfaces, step(model, &model.load, "0.1,1\n"))
        }
    };
    let title: String = on_a_line(title).chars().take(100).collect();
    let comments = format!("{DECK}** {title}\n** plane {}; contact: {touch}\n", model.plane);
    Ok([comments, nodes(model), elements(model), cards, boundary(model), step].concat())
}

fn nodes(model: &Model) -> String {
    let node = |node: NodeId| {
        let [x, y] = model.coordinates(node).map(field);
        format!("{node},{x},{y}\n")
    };
    String::from("*NODE, NSET=NODES\n") + &model.node_ids().map(node).collect::<String>()
}

/// The restrained degrees of freedom.
fn boundary(model: &Model) -> String {
    let at = |u: f64| if u == 0.0 { String::new() } else { format!(",{}", field(u)) };
    let line = |dof: Dof| {
        let given = model.holds.given(dof)?;
        Some(format!("{},{}{}\n", node_and_direction(dof), dof.direction() + 1, at(given)))
    };
    String::from("*BOUNDARY\n") + &model.all_dofs().filter_map(line).collect::<String>()
}

/// The equations of nodes that are held along a direction that is no axis.
fn oblique(model: &Model) -> impl Iterator<Item = Equation> {
    let holds = model.node_ids().filter_map(|node| model.holds.oblique(node));
    holds.flat_map(|hold| Equation::of_constraint(model, &hold.into()))
}

/// The triangles of each material, in the order in which the materials come.
fn elements(model: &Model) -> String {
    let kind = match model.plane {
        Plane::Strain => "CPE3",
        Plane::Stress => "CPS3",
    };
    let mut text = String::new();
    for (k, material) in model.materials().into_iter().enumerate() {
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
        for (_, k) in triangle.sides().into_iter().zip(1..).filter(|(side, _)| wanted(*side)) {
            text += &format!("{id},S{k}\n");
            faces += 1;
        }
    }
    if faces == 0 {
        let what = format!("the {} surface bounds no triangle", name.to_lowercase());
        return Err(InputError::new("contact", what, "name edges of the bodies"));
    }
    Ok(text)
}

/// One static step, with these increments, and the loads on the displacements that are not restrained.
fn step(model: &Model, load: &DVector<f64>, increments: &str) -> String {
    let loads = model.all_dofs().zip(load.iter());
    let loads = loads.filter(|(dof, force)| **force != 0.0 && !model.is_restrained(*dof));
    let loads = loads
        .map(|(dof, force)| format!("*CLOAD\n{},{}\n", node_and_direction(dof), field(*force)));
    let stresses =
        (1..=model.materials().len()).map(|k| format!("*EL PRINT, ELSET=MATERIAL{k}\nS\n"));
    format!(
        "*STEP\n*STATIC\n{increments}{}*NODE PRINT, NSET=NODES\nU\n{}*END STEP\n",
        loads.collect::<String>(),
        stresses.collect::<String>()
    )
}

/// `x` in at most 20 characters, with as many of its digits as fit: all, or at least 13.
pub fn field(x: f64) -> String {
    let exact = [format!("{x}"), format!("{x:e}")];
    let rounded = (0..WIDTH).rev().map(|digits| format!("{x:.digits$e}"));
    let mut written = exact.into_iter().chain(rounded);
    written.find(|text| text.len() <= WIDTH).expect("one digit and an exponent fit")
}
