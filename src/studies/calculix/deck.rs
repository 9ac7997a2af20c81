//! The input deck of `ccx`.

use std::fmt::Write as _;

use super::equation::{Equation, Term};
use super::number::field;
use super::problem::{Contact, Pair, Problem};
use crate::error::InputError;
use crate::paper::mirror::Worksheet;
use crate::problem::element::Plane;
use crate::problem::modelling::Friction;

/// ccx takes no more terms on a line of an equation.
const TERMS_ON_A_LINE: usize = 4;
/// Coefficient of friction that nothing overcomes.
const STICKING: f64 = 1000.0;
/// Stick slope over penalty: the manual advises about a tenth.
const STICK_SLOPE: f64 = 0.1;

/// The deck of a problem: plane triangles, the whole load in one static step; displacements and stresses go to the `.dat` file, where
/// ccx prints seven digits (`.frd`: six).
///
/// # Errors
/// A pair whose surfaces bound no triangle.
pub fn deck(problem: &Problem) -> Result<String, InputError> {
    let mut text = heading(problem);
    text += &nodes(problem.sheet);
    text += &elements(problem);
    match problem.contact {
        Contact::Equations(equations) => text += &equation_cards(problem.sheet, equations),
        Contact::Pair(_) if problem.sheet.cnt.rows() == 0 => {}
        Contact::Pair(pair) => text += &pair_cards(problem.sheet, pair)?,
    }
    text += &restraints(problem);
    text += &step(problem);
    Ok(text)
}

/// Comment lines: what the deck is.
fn heading(problem: &Problem) -> String {
    let title: Vec<&str> = problem.scene.title.split_whitespace().collect();
    let title: String = title.join(" ").chars().take(100).collect();
    let contact = match problem.contact {
        Contact::Equations(equations) => format!("{} equations", equations.len()),
        Contact::Pair(Pair { penalty, friction }) => {
            format!("contact pair, penalty {penalty:e} stress/length, friction {friction}")
        }
    };
    format!("** {title}\n** plane {}; contact: {contact}\n", problem.sheet.plane)
}

fn nodes(sheet: &Worksheet<f64>) -> String {
    let mut text = String::from("*NODE, NSET=NODES\n");
    for n in 1..=sheet.R() {
        let [x, y] = [2, 3].map(|axis| field(sheet.node[(n, axis)]));
        line(&mut text, format!("{n},{x},{y}"));
    }
    text
}

/// The triangles of each material, in the order in which the materials come.
fn elements(problem: &Problem) -> String {
    let sheet = problem.sheet;
    let kind = match sheet.plane {
        Plane::Strain => "CPE3",
        Plane::Stress => "CPS3",
    };
    let mut text = String::new();
    for (k, (e, nu)) in materials(sheet).into_iter().enumerate() {
        let name = format!("MATERIAL{}", k + 1);
        line(&mut text, format!("*ELEMENT, TYPE={kind}, ELSET={name}"));
        for n in (1..=sheet.M()).filter(|&n| (sheet.E[n], sheet.nu[n]) == (e, nu)) {
            let [a, b, c] = corners(sheet, n);
            line(&mut text, format!("{n},{a},{b},{c}"));
        }
        line(&mut text, format!("*MATERIAL, NAME={name}\n*ELASTIC\n{},{}", field(e), field(nu)));
        line(&mut text, format!("*SOLID SECTION, ELSET={name}, MATERIAL={name}"));
        line(&mut text, field(problem.scene.thickness));
    }
    text
}

/// The distinct materials in order of appearance.
fn materials(sheet: &Worksheet<f64>) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for material in sheet.E.iter().copied().zip(sheet.nu.iter().copied()) {
        if !found.contains(&material) {
            found.push(material);
        }
    }
    found
}

fn corners(sheet: &Worksheet<f64>, n: usize) -> [usize; 3] {
    [0, 1, 2].map(|k| sheet.EL[(n, sheet.ind_1 + k)])
}

/// The equations. ccx knows homogeneous ones only: a constant is the held displacement of a node of its own, in x.
fn equation_cards(sheet: &Worksheet<f64>, equations: &[Equation]) -> String {
    let mut text = String::new();
    let mut own = sheet.R();
    for Equation { terms, constant } in equations {
        let mut terms = terms.clone();
        if *constant != 0.0 {
            own += 1;
            line(&mut text, format!("*NODE\n{own},0,0\n*BOUNDARY\n{own},1,1,{}", field(-constant)));
            terms.push(Term { node: own, direction: 0, coefficient: 1.0 });
        }
        line(&mut text, format!("*EQUATION\n{}", terms.len()));
        for some in terms.chunks(TERMS_ON_A_LINE) {
            let some: Vec<String> = some.iter().map(term).collect();
            line(&mut text, some.join(","));
        }
    }
    text
}

fn term(term: &Term) -> String {
    format!("{},{},{}", term.node, term.direction + 1, field(term.coefficient))
}

/// The two surfaces and the pair. Both surfaces are made of element faces: with a slave surface of nodes ccx knows no area for a
/// node.
fn pair_cards(sheet: &Worksheet<f64>, pair: &Pair) -> Result<String, InputError> {
    let slave = surface(sheet, "SLAVE", |[a, b]| {
        let on = |n: usize| sheet.cnt.iter().any(|c| *c == n);
        on(a) && on(b)
    })?;
    let master = surface(sheet, "MASTER", |edge| {
        let ends = |e: &usize| [sheet.elem[(*e, 6)], sheet.elem[(*e, 7)]];
        sheet.trg.iter().map(ends).any(|[a, b]| edge == [a, b] || edge == [b, a])
    })?;
    let mut text = slave + &master + "*SURFACE INTERACTION, NAME=CONTACT\n";
    line(&mut text, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR".into());
    line(&mut text, field(pair.penalty));
    if pair.friction == Friction::Stick {
        let slope = field(STICK_SLOPE * pair.penalty);
        line(&mut text, format!("*FRICTION\n{},{slope}", field(STICKING)));
    }
    line(&mut text, "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=NODE TO SURFACE".into());
    line(&mut text, "SLAVE,MASTER".into());
    Ok(text)
}

/// The faces of triangles whose edges `wanted` takes, as a surface.
fn surface(
    sheet: &Worksheet<f64>,
    name: &str,
    wanted: impl Fn([usize; 2]) -> bool,
) -> Result<String, InputError> {
    let mut text = format!("*SURFACE, NAME={name}, TYPE=ELEMENT\n");
    let mut faces = 0;
    for n in 1..=sheet.M() {
        let corners = corners(sheet, n);
        for k in (0..3).filter(|&k| wanted([corners[k], corners[(k + 1) % 3]])) {
            line(&mut text, format!("{n},S{}", k + 1));
            faces += 1;
        }
    }
    if faces == 0 {
        let what = format!("the {} surface bounds no triangle", name.to_lowercase());
        return Err(InputError::new("contact", what, "name edges of the bodies"));
    }
    Ok(text)
}

/// The displacements that S holds.
fn restraints(problem: &Problem) -> String {
    let mut text = String::from("*BOUNDARY\n");
    for e in (0..problem.sheet.S.rows()).filter(|&e| problem.sheet.S[e + 1] == 1) {
        let (node, direction) = (e / 2 + 1, e % 2 + 1);
        line(&mut text, format!("{node},{direction},{direction}"));
    }
    text
}

/// One static step with the loads on the equations that S leaves free.
fn step(problem: &Problem) -> String {
    let mut text = String::from("*STEP\n*STATIC\n");
    if let Contact::Pair(_) = problem.contact {
        // A tenth of the load first: from the whole of it at once ccx may settle on another contact zone.
        line(&mut text, "0.1,1".into());
    }
    for (e, force) in problem.scene.load.iter().enumerate() {
        if *force != 0.0 && problem.sheet.S[e + 1] == 0 {
            line(&mut text, format!("*CLOAD\n{},{},{}", e / 2 + 1, e % 2 + 1, field(*force)));
        }
    }
    line(&mut text, "*NODE PRINT, NSET=NODES\nU".into());
    for k in 1..=materials(problem.sheet).len() {
        line(&mut text, format!("*EL PRINT, ELSET=MATERIAL{k}\nS"));
    }
    text + "*END STEP\n"
}

fn line(text: &mut String, line: String) {
    writeln!(text, "{line}").expect("a String takes any text");
}
