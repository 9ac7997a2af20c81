//! The scene: what the user gives, checked, and turned into the paper's arrays.
//!
//! ```text
//!  scene.json --file--> SceneFile --+
//!                                   +--> Scene (checked) --> Worksheet (the paper's arrays)
//!  strand.msh --gmsh--> Mesh -------+
//! ```

mod body;
mod embedded;
mod file;
pub mod gmsh;
mod groups;
mod load;
mod mesh;
mod surface;

use std::path::Path;

use nalgebra::DVector;

pub use body::Body;
pub use embedded::{Embedded, FINDING_SCENES, SCENES};
pub use file::{SceneFile, Units};
pub use mesh::{Element, Mesh, Node, PhysicalName};

use crate::contact::Variant;
use crate::element;
use crate::error::InputError;
use crate::mathcad::array::{Column, Table};
use crate::mirror::{Plane, Reading, ToleranceUnit, Worksheet};
use file::{Axis, Material, Surface};

/// A scene that is known to be sound.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name for folders and reports.
    pub name: String,
    /// A line for people.
    pub title: String,
    /// Unit names.
    pub units: Units,
    /// Number of iterations.
    pub iterations: usize,
    /// What is run unless the command line says otherwise.
    pub variant: Variant,
    /// Thickness across the plane, length.
    pub thickness: f64,
    /// Load on all 2R equations, restrained ones included, force.
    pub load: DVector<f64>,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// Numbers, in the mesh file, of the nodes that were dropped because they belong to no triangle.
    pub dropped: Vec<usize>,
    /// The paper's arrays under the scene's own plane problem and length unit.
    sheet: Worksheet<f64>,
}

impl Scene {
    /// Opens a scene by embedded name, or by the path of its file or folder.
    ///
    /// # Errors
    /// Anything wrong with the scene file, the mesh file, or what they say together.
    pub fn open(name_or_path: &str) -> Result<Self, InputError> {
        let mut embedded = SCENES.iter().chain(FINDING_SCENES);
        if let Some(embedded) = embedded.find(|s| s.name == name_or_path) {
            let beside = |file: &str| {
                let found = embedded.files.iter().find(|(name, _)| *name == file);
                found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "not embedded".to_string())
            };
            return Scene::build(embedded.name, embedded.scene, beside);
        }
        let path = Path::new(name_or_path);
        let path = if path.is_dir() { path.join("scene.json") } else { path.to_path_buf() };
        let text = std::fs::read(&path).map_err(|why| {
            let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
            InputError::new(
                path.display().to_string(),
                format!("the scene file cannot be read: {why}"),
                format!("give a path, or one of the scenes {}", names.join(", ")),
            )
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let beside = |file: &str| std::fs::read(folder.join(file)).map_err(|why| why.to_string());
        Scene::build(&name_of(&path), &text, beside)
            .map_err(|error| error.within(&path.display().to_string()))
    }

    /// Builds a scene from the text of its file; `beside` reads a file that lies beside it.
    ///
    /// # Errors
    /// Anything wrong with the scene file, the mesh file, or what they say together.
    pub fn build(
        name: &str,
        text: &[u8],
        beside: impl Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, InputError> {
        let mut file = SceneFile::parse(text)?;
        let mesh = read_mesh(&file, beside)?;
        mesh.check()?;
        let dropped = mesh.orphans();
        let mesh = drop_orphans(mesh, &dropped, &mut file)?;
        Scene::assemble(name, file, &mesh, dropped)
    }

    fn assemble(
        name: &str,
        file: SceneFile,
        mesh: &Mesh,
        dropped: Vec<usize>,
    ) -> Result<Self, InputError> {
        let numbers = Numbers::check(&file)?;
        let (materials, material_names) = materials(mesh, &file)?;
        let restraints = restraints(mesh, &file)?;
        let bodies = body::find(mesh, &material_names);
        let (cnt, trg, c_tll) = contact(mesh, &file)?;
        let sheet = worksheet(mesh, numbers, &materials, restraints, (cnt, trg, c_tll));
        check_held(mesh, &bodies, &sheet)?;
        Ok(Scene {
            name: name.into(),
            load: load::vector(mesh, &file.loads, file.thickness)?,
            title: file.title,
            units: file.units,
            iterations: file.iterations,
            variant: file.variant,
            thickness: file.thickness,
            bodies,
            dropped,
            sheet,
        })
    }

    /// The paper's arrays under `reading`: R6 sets the plane problem, R8 the unit of c_tol.
    ///
    /// # Errors
    /// A Poisson's ratio that the plane problem of R6 does not allow.
    pub fn worksheet(&self, reading: &Reading) -> Result<Worksheet<f64>, InputError> {
        let mut sheet = self.sheet.clone();
        if let Some(plane) = reading.r6 {
            sheet.plane = plane;
            for nu in sheet.nu.iter() {
                check_poisson(*nu, plane, "--reading R6")?;
            }
        }
        if reading.r8 == ToleranceUnit::Metre {
            sheet.c_tll *= 1000.0;
        }
        Ok(sheet)
    }

    /// Sum of the loads, force.
    pub fn total_load(&self) -> [f64; 2] {
        [0, 1].map(|direction| self.load.iter().skip(direction).step_by(2).sum())
    }

    /// The body that carries the target surface; none without contact.
    pub fn target(&self) -> Option<&Body> {
        let trg = self.sheet.trg.iter().next()?;
        let node = self.sheet.elem[(*trg, 6)];
        self.bodies.iter().find(|body| body.nodes.binary_search(&node).is_ok())
    }
}

/// `golden/strand/scene.json` is the scene `strand`, `my/plate.json` the scene `plate`.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned());
    if stem == "scene" { folder.unwrap_or(stem) } else { stem }
}

fn read_mesh(
    file: &SceneFile,
    beside: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Mesh, InputError> {
    match (&file.mesh, &file.node, &file.elem) {
        (Some(name), None, None) => {
            let bytes = beside(name).map_err(|why| {
                let what = format!("the mesh file {name:?} cannot be read: {why}");
                InputError::new("field mesh", what, "the path is resolved beside the scene file")
            })?;
            gmsh::read(&bytes).map_err(|error| {
                InputError::new(
                    format!("mesh {name:?}"),
                    error.to_string(),
                    "save the mesh again from Gmsh",
                )
            })
        }
        (None, Some(node), Some(elem)) => Mesh::from_tables(node, elem),
        _ => Err(InputError::new(
            "fields mesh, node, elem",
            "the scene needs either mesh, or node and elem",
            "give \"mesh\": \"file.msh\", or the two tables",
        )),
    }
}

/// Drops the nodes that belong to no triangle where the scene says so, else refuses them; the scene's node numbers follow.
fn drop_orphans(mesh: Mesh, dropped: &[usize], file: &mut SceneFile) -> Result<Mesh, InputError> {
    if dropped.is_empty() {
        return Ok(mesh);
    }
    if !file.drop_orphans {
        let what = format!(
            "nodes {} belong to no triangle (finding K4: Km would be singular)",
            short_list(dropped)
        );
        let mend = "remove them, or set \"drop_orphans\": true";
        return Err(InputError::new("the mesh's nodes", what, mend));
    }
    let renumber = |n: &mut usize, place: &str| {
        mesh.check_node(*n, place)?;
        if dropped.binary_search(n).is_ok() {
            let what = format!("node {n} belongs to no triangle and was dropped");
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
        *n = mesh::new_number(*n, dropped);
        Ok(())
    };
    for (k, restraint) in file.restraints.iter_mut().enumerate() {
        restraint
            .node
            .as_mut()
            .map_or(Ok(()), |n| renumber(n, &format!("restraints[{k}].node")))?;
    }
    for (k, load) in file.loads.iter_mut().enumerate() {
        load.node.as_mut().map_or(Ok(()), |n| renumber(n, &format!("loads[{k}].node")))?;
    }
    if let Some(Surface::Numbers(numbers)) = file.contact.as_mut().map(|c| &mut c.cnt) {
        numbers.iter_mut().try_for_each(|n| renumber(n, "contact.cnt"))?;
    }
    Ok(mesh.without(dropped))
}

/// At most ten numbers of a list, and how many more there are.
fn short_list(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(10).map(usize::to_string).collect();
    let more = numbers.len().saturating_sub(10);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &rest
}

/// The scene's plain numbers, checked.
struct Numbers {
    plane: Plane,
    thickness: f64,
}

impl Numbers {
    fn check(file: &SceneFile) -> Result<Self, InputError> {
        if !(file.thickness > 0.0 && file.thickness.is_finite()) {
            let what = format!("the thickness {} is not positive", file.thickness);
            return Err(InputError::new("field thickness", what, "the paper's is 1"));
        }
        if file.iterations == 0 {
            let what = "0 iterations give no result";
            return Err(InputError::new("field iterations", what, "the paper's number is 20"));
        }
        Ok(Numbers { plane: file.plane, thickness: file.thickness })
    }
}

/// Each triangle's material and the name of its group, in the order of `EL`.
fn materials(mesh: &Mesh, file: &SceneFile) -> Result<(Vec<Material>, Vec<String>), InputError> {
    let mut of_element = std::collections::HashMap::new();
    for (group, material) in &file.materials.0 {
        let place = format!("materials.{}", group.text());
        if !(material.e > 0.0 && material.e.is_finite()) {
            let what = format!("E = {} is not positive", material.e);
            return Err(InputError::new(
                format!("{place}.E"),
                what,
                "give an elastic modulus above 0",
            ));
        }
        check_poisson(material.nu, file.plane, &format!("{place}.nu"))?;
        for triangle in groups::members(mesh, 2, group, &place)? {
            if let Some((_, other)) = of_element.insert(triangle.number, (*material, group.text()))
            {
                let what = format!(
                    "triangle {} has two materials, {other} and {}",
                    triangle.number,
                    group.text()
                );
                return Err(InputError::new(place, what, "give each triangle one material"));
            }
        }
    }
    let found = mesh.of_dimension(2).map(|triangle| {
        of_element.remove(&triangle.number).ok_or_else(|| {
            let what = format!(
                "triangle {} has no material (its physical groups: {:?})",
                triangle.number, triangle.physical
            );
            InputError::new("materials", what, "give each physical group of triangles a material")
        })
    });
    Ok(found.collect::<Result<Vec<_>, _>>()?.into_iter().unzip())
}

fn check_poisson(nu: f64, plane: Plane, place: &str) -> Result<(), InputError> {
    let (below, name) = match plane {
        Plane::Strain => (0.5, "plane strain"),
        Plane::Stress => (1.0, "plane stress"),
    };
    if nu > -1.0 && nu < below {
        return Ok(());
    }
    let what = format!("nu = {nu} is outside (-1, {below}) in {name}");
    Err(InputError::new(place, what, "give a Poisson's ratio inside"))
}

/// The paper's `S`: 1 where a direction of a node is held.
fn restraints(mesh: &Mesh, file: &SceneFile) -> Result<Column<usize>, InputError> {
    let mut fixed = Column::filled(2 * mesh.nodes.len(), 0);
    for (k, restraint) in file.restraints.iter().enumerate() {
        let place = format!("restraints[{k}]");
        let nodes = match (&restraint.on, restraint.node) {
            (Some(on), None) => groups::nodes(mesh, on, &format!("{place}.on"))?,
            (None, Some(n)) => {
                mesh.check_node(n, &format!("{place}.node"))?;
                vec![n]
            }
            _ => {
                let what = "a restraint is {on, fix} or {node, fix}";
                return Err(InputError::new(place, what, "give exactly one of on and node"));
            }
        };
        for n in nodes {
            for axis in &restraint.fix {
                fixed[2 * n - if *axis == Axis::X { 1 } else { 0 }] = 1;
            }
        }
    }
    Ok(fixed)
}

/// `cnt`, `trg` and `c_tll`; empty where the scene has no contact.
fn contact(mesh: &Mesh, file: &SceneFile) -> Result<(Vec<usize>, Vec<usize>, f64), InputError> {
    let Some(contact) = &file.contact else { return Ok((vec![], vec![], 0.0)) };
    if !(contact.c_tll >= 0.0 && contact.c_tll.is_finite()) {
        let what = format!("c_tll = {} is negative", contact.c_tll);
        return Err(InputError::new("contact.c_tll", what, "the paper's is 0.001"));
    }
    let cnt = surface::contact_nodes(mesh, &contact.cnt)?;
    let trg = surface::target_edges(mesh, &contact.trg)?;
    for edge in mesh.of_dimension(1).filter(|e| trg.contains(&e.number)) {
        if let Some(n) = edge.nodes.iter().find(|n| cnt.contains(n)) {
            let what = format!("contact node {n} is also on the target edge {}", edge.number);
            return Err(InputError::new("contact", what, "let the two bodies share no node"));
        }
    }
    Ok((cnt, trg, contact.c_tll))
}

#[allow(non_snake_case, reason = "the paper's own names")]
fn worksheet(
    mesh: &Mesh,
    numbers: Numbers,
    materials: &[Material],
    S: Column<usize>,
    (cnt, trg, c_tll): (Vec<usize>, Vec<usize>, f64),
) -> Worksheet<f64> {
    let triangles: Vec<&Element> = mesh.of_dimension(2).collect();
    let corners: Vec<_> = triangles.iter().map(|t| mesh.corners(t)).collect();
    let last = mesh.elements.last().map_or(0, |e| e.number);
    let mut elem = Table::filled(last, 8, 0);
    for element in &mesh.elements {
        for (j, value) in row(element).enumerate() {
            elem[(element.number, j + 1)] = value;
        }
    }
    Worksheet {
        node: Table::from_fn(mesh.nodes.len(), 4, |i, j| match j {
            1 => i as f64,
            _ => mesh.nodes[i - 1].xyz[j - 2],
        }),
        EL: Table::from_fn(triangles.len(), 8, |n, j| elem[(triangles[n - 1].number, j)]),
        elem,
        trg: Column::from_vec(trg),
        cnt: Column::from_vec(cnt),
        c_tll,
        ind_1: 6,
        S,
        Ae: Column::from_vec(
            corners.iter().map(|p| element::area(p) * numbers.thickness).collect(),
        ),
        B: Column::from_vec(corners.iter().map(element::B).collect()),
        E: Column::from_vec(materials.iter().map(|m| m.e).collect()),
        nu: Column::from_vec(materials.iter().map(|m| m.nu).collect()),
        plane: numbers.plane,
    }
}

/// A row of `elem`: number, type, number of tags, physical tag, geometric tag, nodes.
fn row(element: &Element) -> impl Iterator<Item = usize> {
    let physical = element.physical.first().copied().unwrap_or(0);
    let head = [element.number, element.kind, 2, physical, element.geometric];
    head.into_iter().chain(element.nodes.iter().copied())
}

/// That restraints hold each body that no contact surface touches.
fn check_held(mesh: &Mesh, bodies: &[Body], sheet: &Worksheet<f64>) -> Result<(), InputError> {
    let target_nodes = sheet.trg.iter().map(|&e| sheet.elem[(e, 6)]);
    let in_contact: Vec<usize> = sheet.cnt.iter().copied().chain(target_nodes).collect();
    let fixed = |n: usize| [sheet.S[2 * n - 1] == 1, sheet.S[2 * n] == 1];
    for body in bodies {
        let touched = in_contact.iter().any(|n| body.nodes.binary_search(n).is_ok());
        if let Some(freedom) = body::freedom(mesh, body, fixed).filter(|_| !touched) {
            let what =
                format!("body {:?} is held by no contact and can still {freedom}", body.name);
            return Err(InputError::new(
                "restraints",
                what,
                "hold it, or give it a contact surface",
            ));
        }
    }
    Ok(())
}
