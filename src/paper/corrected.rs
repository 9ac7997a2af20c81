//! The corrected algorithm: the programs of `listings/corrected/`, executed by the interpreter.

use std::collections::HashSet;
use std::ops::RangeInclusive;
use std::rc::Rc;

use super::door;
use super::findings::FindingId;
use super::listings::{elasticity, tables};
use base::choices;
use base::error::InputError;
use mathcad::array::{Column, Table};
use mathcad::value::Array;
use mathcad::{Edit, Failure, Limits, Line, Listing, Settings, Sheet, Value};
use problem::model::{Model, NodeId};

/// The most iterations, as many as the paper's.
pub const STEPS: usize = 20;

choices! {
    /// The programs of the corrected algorithm.
    Program {
        /// The normals at the ends of the target edges.
        Normals = "normals",
        /// The contact pairs (fig. 2).
        CCnt = "c_cnt",
        /// The stiffness matrix (fig. 3), bordered by the equations of contact.
        Km = "Km",
        /// The load, and the gaps that are to close.
        Fm = "Fm",
        /// The iterations.
        Iterate = "iterate",
    }
}

impl Program {
    /// Returns the text of record.
    pub fn text(self) -> &'static str {
        match self {
            Program::Normals => include_str!("listings/corrected/normals.txt"),
            Program::CCnt => include_str!("listings/corrected/c_cnt.txt"),
            Program::Km => include_str!("listings/corrected/Km.txt"),
            Program::Fm => include_str!("listings/corrected/Fm.txt"),
            Program::Iterate => include_str!("listings/corrected/iterate.txt"),
        }
    }
}

choices! {
    /// The components of displacement that a node in contact shares with its target.
    Bound {
        /// Those along the normal: the node slides freely.
        Normal = "normal",
        /// Both, as eq. (1) says.
        Both = "both",
    }
}

choices! {
    /// Which of the faults that one finding describes.
    Part {
        /// Nothing releases a node that pulls.
        Release = "release",
        /// Nothing lets a node slide.
        Sliding = "sliding",
    }
}

/// A printed fault that is reintroduced into the corrected programs.
pub struct Fault {
    /// The finding that describes it.
    pub finding: FindingId,
    /// The other findings that do.
    pub others: &'static [FindingId],
    /// Which of the finding's faults it is; nothing where that has one.
    pub part: Option<Part>,
    /// The edit of the programs, in the format of `listings/readings/README.md`; its reason says what
    /// the fault is.
    pub edit: &'static str,
}

/// A fault: the finding and the file of the edit, the other findings, the part.
macro_rules! fault {
    ($finding:ident $file:literal, [$($other:ident),*], $part:expr) => {
        Fault {
            finding: FindingId::$finding,
            others: &[$(FindingId::$other),*],
            part: $part,
            edit: include_str!(concat!("listings/corrected/faults/", $file, ".edit")),
        }
    };
}

/// The faults that can be reintroduced: one at a time, or several, applied from the last to the first. C1
/// and C2 make the box of C9 their own. With all of them the programs are the print, but that edges are
/// of the initial shape (C6).
pub const FAULTS: &[Fault] = &[
    fault!(C1 "C1", [C14], None),
    fault!(C2 "C2", [], None),
    fault!(C3 "C3", [], None),
    fault!(C5 "C5", [C4], None),
    fault!(C7 "C7", [C13], None),
    fault!(C9 "C9", [], None),
    fault!(C12 "C12", [], None),
    fault!(K1 "K1", [], None),
    fault!(K2 "K2", [], None),
    fault!(K4 "K4", [], None),
    fault!(K5 "K5", [], None),
    fault!(K8 "K8", [], None),
    fault!(K9 "K9", [], Some(Part::Release)),
    fault!(K9 "K9-both", [], Some(Part::Sliding)),
];

impl Fault {
    /// Returns its name: the findings that describe it, and which fault of one it is.
    pub fn name(&self) -> String {
        let mut findings = [&[self.finding], self.others].concat();
        findings.sort();
        let names: Vec<&str> = findings.into_iter().map(FindingId::name).collect();
        let part = self.part.map_or(String::new(), |part| format!(" ({part})"));
        names.join(" and ") + &part
    }

    /// Says what the fault is, in a sentence: the reason of its edit, behind its name.
    pub fn words(&self) -> String {
        let reason = self.parsed().reason;
        let (_, words) = reason.split_once(": ").expect("it begins with its name");
        words.trim_end().trim_end_matches('.').into()
    }

    /// Returns whether a finding describes it.
    pub fn is_of(&self, finding: FindingId) -> bool {
        self.finding == finding || self.others.contains(&finding)
    }

    /// Returns the lines of the corrected programs that it replaces, such as `c_cnt 14-15`.
    pub fn places(&self) -> Vec<String> {
        self.parsed().places()
    }

    fn parsed(&self) -> Edit {
        Edit::parse(self.edit).expect("the edits in listings are sound")
    }
}

impl Bound {
    /// Returns the value of the programs' name `both`.
    pub fn both(self) -> f64 {
        match self {
            Bound::Normal => 0.0,
            Bound::Both => 1.0,
        }
    }
}

/// What the iterations end with.
#[derive(Clone, Debug)]
pub struct Ending {
    /// The displacements, x and y of each node in turn, length.
    pub u: Vec<f64>,
    /// The nodes in contact in the last iteration, each with the force that presses it, force.
    pub in_contact: Vec<(NodeId, f64)>,
    /// The number of iterations.
    pub iterations: usize,
    /// The iterations after which the contact pairs come back: 1 where they stay, more where they
    /// alternate for ever. Nothing where none came back.
    pub period: Option<usize>,
    /// Whether the last iteration asked for the contact pairs that it was given, with displacements
    /// below the size of the model: rounding turns a body that is free to turn by more.
    pub is_settled: bool,
}

/// Checks that the programs can be asked for a model.
///
/// # Errors
/// It has no contact surfaces, a contact node is listed twice, or S cannot say what holds it.
pub fn check(model: &Model) -> Result<(), InputError> {
    door::check_restraints(model)?;
    let nodes = &model.contact.nodes;
    if nodes.is_empty() {
        let fix = "name a scene with contact";
        return Err(InputError::new("contact", "the scene has no contact surfaces", fix));
    }
    let mut listed = HashSet::new();
    match nodes.iter().find(|node| !listed.insert(**node)) {
        Some(node) => {
            let what = format!("the corrected algorithm takes each node once, {node} stands twice");
            Err(InputError::new("contact.cnt", what, "list the node once"))
        }
        None => Ok(()),
    }
}

/// Lines of a program that read nothing which iterations change: their value is computed once.
///
/// Each in turn saved of the CPU time of `audit strand`: the bodies 31 of 79 s, the search 9 of 48 s, and on a
/// machine with other work the normals 5.2 of 31.2 s.
struct Once {
    program: Program,
    /// What their value is called.
    name: &'static str,
    /// Their printed numbers.
    lines: RangeInclusive<usize>,
    /// The edit by which they are a program of their own.
    alone: &'static str,
    /// The edit by which their value stands in their place.
    replaced: &'static str,
}

const ONCE: [Once; 3] = [
    Once {
        program: Program::CCnt,
        name: "found",
        lines: 2..=19,
        alone: "c_cnt line 1:\n 1  found() :=\nc_cnt lines 20-46:\n20    (ct   kt   at)\n",
        replaced: "c_cnt lines 2-19:\n 2    (ct   kt   at) ← found\n",
    },
    Once {
        program: Program::Km,
        name: "bodies",
        lines: 2..=13,
        alone: "Km line 1:\n 1  bodies() :=\nKm lines 14-28:\n",
        replaced: "Km lines 2-13:\n 2    MJS ← bodies\n",
    },
    Once {
        program: Program::Iterate,
        name: "turned",
        lines: 4..=4,
        alone: "iterate lines 1-3:\n 1  turned() :=\niterate lines 5-18:\n",
        replaced: "iterate line 4:\n 4    nt ← turned\n",
    },
];

impl Once {
    fn lines_of<'l>(&self, lines: &'l [Line]) -> Vec<&'l Line> {
        lines.iter().filter(|line| self.lines.contains(&line.printed)).collect()
    }

    /// Returns the lines' value; None where they fail, as the whole program does then and says why, or read
    /// what iterations change.
    fn value(&self, edits: &[&str], sheet: &Sheet) -> Option<Value> {
        let alone = edited(self.program, &[&[self.alone], edits].concat())?;
        let mut runner = alone.runner(sheet, &Settings::default(), &limits());
        let mut value = runner.call(&[]).ok()?.value;
        if let Value::Array(array) = &mut value {
            Rc::make_mut(array).share_zeros();
        }
        Some(value)
    }

    /// Returns the program with the value in place of the lines; None where it reads what else they compute.
    fn program(&self, edits: &[&str], whole: &Listing) -> Option<Listing> {
        let replaced = edited(self.program, &[&[self.replaced], edits].concat())?;
        let reads = replaced.free_names();
        let is_known = |name: &&str| *name == self.name || whole.free_names().contains(name);
        reads.iter().all(is_known).then_some(replaced)
    }
}

/// A model as the programs read it.
pub struct Worksheet<'m> {
    model: &'m Model,
    sheet: Sheet,
}

impl<'m> Worksheet<'m> {
    /// Makes the worksheet above the programs: the scene's tables, its load, and D.
    pub fn new(model: &'m Model, bound: Bound) -> Self {
        let mut sheet = Sheet::default();
        for (name, value) in tables(&door::worksheet(model, |x| x)) {
            sheet.define(name, value);
        }
        let load = model.load_in(|x| x);
        sheet.define("F", Array::column(load.iter().copied().collect()));
        sheet.define("both", bound.both());
        let d = Listing::parse("D", elasticity(model.plane)).expect("the text is sound");
        sheet.define_program(Rc::new(d));
        Program::ALL.iter().for_each(|program| define(*program, &[], true, &mut sheet));
        Worksheet { model, sheet }
    }

    /// Executes the iterations, at most `steps`, on the initial shape and the whole load.
    ///
    /// `edits` change the programs, in the format of `listings/readings/README.md`, the last of them first:
    /// none for the texts of record.
    ///
    /// # Errors
    /// A program fails: the matrix is singular where contact and restraints leave a body free to move.
    pub fn iterate(&self, edits: &[&str], steps: usize) -> Result<Ending, Box<Failure>> {
        let mut sheet = self.sheet.clone();
        let is_edited = |program: &&Program| lines(**program, edits) != lines(**program, &[]);
        let are_turned = is_edited(&&Program::Normals);
        // Reading all five for each run took half of the CPU time of `lesson`.
        for program in Program::ALL.iter().filter(|own| are_turned || is_edited(own)) {
            define(*program, edits, are_turned, &mut sheet);
        }
        let main = sheet.program(Program::Iterate.name()).expect("it is defined");
        ending(self.model, &sheet, main, steps)
    }
}

/// Defines a program with what concerns it of the edits, in which values stand in place of what is computed once; those
/// that edits change, or that read normals which edits change, are computed anew, by the programs that the worksheet
/// has.
fn define(own: Program, edits: &[&str], are_turned: bool, sheet: &mut Sheet) {
    let mut listing = program(own, edits);
    for once in ONCE.iter().filter(|once| once.program == own) {
        let printed = lines(own, &[]).expect("nothing is edited");
        if are_turned || once.lines_of(listing.lines()) != once.lines_of(&printed) {
            let Some(value) = once.value(edits, sheet) else { continue };
            sheet.define(once.name, value);
        }
        let shorter = once.program(edits, &listing).filter(|_| sheet.has(once.name));
        listing = shorter.unwrap_or(listing);
    }
    sheet.define_program(Rc::new(listing));
}

fn limits() -> Limits {
    Limits { steps: u64::MAX, entries: 1 << 28, ..Limits::default() }
}

fn ending(
    model: &Model,
    sheet: &Sheet,
    main: &Listing,
    steps: usize,
) -> Result<Ending, Box<Failure>> {
    let mut runner = main.runner(sheet, &Settings::default(), &limits());
    let outcome = runner.call(&[Value::from(steps)])?;
    let local = |name: &str| &outcome.locals[name];
    let column = |value| Column::<f64>::try_from(value).expect("a column");
    let table = |name| Table::<f64>::try_from(local(name)).expect("an array");
    let [pairs, seen] = ["k_cnt", "seen"].map(table);
    let iterations = seen.cols();
    let rows = || 1..=pairs.rows();
    let comes_back = |k: &usize| rows().all(|n| pairs[(n, 1)] == seen[(n, *k)]);
    let period = (1..=iterations).find(comes_back).map(|first| 1 + iterations - first);
    let forces = column(local("p"));
    let nodes = model.contact.nodes.iter().copied().zip(forces.as_slice().iter().copied());
    let u = column(&outcome.value).as_slice()[..model.dofs()].to_vec();
    let size = model.bounds().larger_side();
    Ok(Ending {
        in_contact: nodes.filter(|(node, _)| seen[(node.number(), iterations)] > 0.0).collect(),
        iterations,
        period,
        is_settled: period == Some(1) && u.iter().all(|x| x.abs() < size),
        u,
    })
}

/// Returns a program with what concerns it of the edits.
pub fn program(program: Program, edits: &[&str]) -> Listing {
    edited(program, edits).expect("the edits fit the texts")
}

/// Returns the same; None where an edit does not fit what those behind it leave.
fn edited(program: Program, edits: &[&str]) -> Option<Listing> {
    Listing::from_lines(program.name(), lines(program, edits)?, &Limits::default()).ok()
}

/// Returns the lines of the same.
fn lines(program: Program, edits: &[&str]) -> Option<Vec<Line>> {
    let parse = |edit: &&str| Edit::parse(edit).expect("the edits in listings are sound");
    let mut own = edits.iter().rev().map(|edit| parse(edit).of(program.name()));
    let printed = Line::all(&program.text().lines().collect::<Vec<_>>(), 0);
    own.try_fold(printed, |lines, edit| edit.applied(program.name(), lines).ok())
}
