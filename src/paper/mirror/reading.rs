//! The readings: what the print leaves open, each with its values and a default.
//!
//! [`READINGS`] is the one table of them. `--reading` with its help, the listings' text under a
//! reading, the worksheet's settings, the trials of `audit`, the switches of `lesson` and
//! `listings/READING.md`, section 4 all follow from it.

use serde::{Deserialize, Serialize};

use super::ambiguity::{self, Change, DefaultFrom, Trial, Value, field, values};
use base::choices;
use mathcad::Conjunction;
use problem::element::Plane;

values! {
    /// R1, c_cnt 14: the place of the weights loop.
    LoopPlace {
        Beside = "beside", "the weights loop stands beside the zeroing loop";
        Inside = "inside", "it stands inside, as the scan indents it", edit "R1-inside.edit";
    }
}
values! {
    /// R2, Km 7: the index under which the x restraint is read.
    RestraintIndex {
        Odd = "odd", "the index of the x restraint, 2·EL − 1";
        Printed = "printed", "that of line 8, 2·EL, as the scan prints it", edit "R2-printed.edit";
    }
}
values! {
    /// R3, Km 16-33: the place of the adding loops.
    Wedge {
        Collect = "collect", "the three nodes fill `W`, then one adding loop runs";
        PerNode = "per-node", "the adding loop runs after each node, with the node's own weight",
            edit "R3-per-node.edit";
        Nested = "nested", "as per-node, and the second pair within the first, as the scan indents it",
            edit "R3-nested.edit";
    }
}
values! {
    /// R5, c_cnt 22 and 23: the coordinates from which weights are computed.
    NodeTable {
        Node = "node", "weights from initial coordinates, as printed";
        NodeN = "node_n", "from current ones, which in a first call are the initial ones",
            edit "R5-node_n.edit";
    }
}

impl LoopPlace {
    /// Returns whether the weights loop stands beside the zeroing loop.
    pub fn is_beside(self) -> bool {
        match self {
            LoopPlace::Beside => true,
            LoopPlace::Inside => false,
        }
    }
}

impl RestraintIndex {
    /// Returns whether the restraint of y is read in place of that of x.
    pub fn takes_y_for_x(self) -> bool {
        match self {
            RestraintIndex::Odd => false,
            RestraintIndex::Printed => true,
        }
    }
}

impl Wedge {
    /// Returns whether an adding loop runs once three nodes fill `W`.
    pub fn adds_all_at_once(self) -> bool {
        match self {
            Wedge::Collect => true,
            Wedge::PerNode | Wedge::Nested => false,
        }
    }

    /// Returns whether the second pair's loop waits for the last node of the first pair.
    pub fn adds_each_alone(self) -> bool {
        match self {
            Wedge::PerNode => true,
            Wedge::Collect | Wedge::Nested => false,
        }
    }
}

impl NodeTable {
    /// Returns whether weights follow the shape, so that they may grow from iteration to iteration.
    pub fn follows_the_shape(self) -> bool {
        match self {
            NodeTable::Node => false,
            NodeTable::NodeN => true,
        }
    }
}

values! {
    /// R7, not printed: the load of an iteration.
    Schedule {
        Total = "total", "the whole load, from the initial shape";
        Stepped = "stepped", "an equal share of the load, from the last shape";
    }
}
values! {
    /// R8, not printed: the unit of c_tol, in a scene measured in millimetres.
    ToleranceUnit {
        Millimetre = "mm", "c_tol in the scene's own unit, mm in the paper's example";
        Metre = "m", "in metres, in a scene in mm: 1,000 times as much";
    }
}

/// The values of R4, which are rules of Mathcad.
const CONJUNCTIONS: [Value; Conjunction::ALL.len()] = [
    Value::new(
        Conjunction::Guarded.name(),
        "a false operand of ∧ decides even if another fails",
        Change::None,
    ),
    Value::new(
        Conjunction::LeftToRight.name(),
        "operands of ∧ up to the first false one",
        Change::Settings(|settings| settings.conjunction = Conjunction::LeftToRight),
    ),
    Value::new(
        Conjunction::Eager.name(),
        "all operands of ∧, and a failure stands",
        Change::Settings(|settings| settings.conjunction = Conjunction::Eager),
    ),
];

const PLANES: [Value; Plane::ALL.len()] = [
    Value::new(Plane::Strain.name(), "`D` of plane strain", Change::None),
    Value::new(Plane::Stress.name(), "`D` of plane stress", Change::None),
];

/// The values of R9: a blank worksheet, three options that a worksheet stores, three rules of
/// Mathcad itself.
const WORKSHEETS: [Value; 7] = [
    Value::new("blank", "a blank Mathcad 14 worksheet, but for ORIGIN = 1", Change::None),
    Value::new("ORIGIN = 0", "subscripts from 0", Change::Settings(|s| s.origin = 0)),
    Value::new(
        "0/0 = 0",
        "no error (c_cnt 10, 22, 23)",
        Change::Settings(|s| s.zero_over_zero_is_zero = true),
    ),
    Value::new("comparisons to 1e-12", "not exact", Change::Settings(|s| s.exact_boolean = false)),
    Value::new("below 1e-307 is 0", "in comparisons", Change::Settings(|s| s.tiny_is_zero = true)),
    Value::new(
        "1 .. 0 is empty",
        "a range does not count down",
        Change::Settings(|s| s.descending_is_empty = true),
    ),
    Value::new(
        "a failed last if is 0",
        "not the value of the statement before",
        Change::Settings(|s| s.last_if_is_zero = true),
    ),
];

/// The values of R10; e is the strain's deviator.
const STRAIN_FORMULAS: [Value; 2] = [
    Value::new("deviator", "von Mises strain sqrt(2/3 e:e)", Change::None),
    Value::new(
        "stress formula / (1 + nu)",
        "the formula of the von Mises stress on strains, over 1 + ν",
        Change::None,
    ),
];

/// Something that the print leaves open: a row of [`READINGS`].
pub type Ambiguity = ambiguity::Ambiguity<Reading>;

/// All ambiguities of the print, in the order of their ids.
pub const READINGS: [Ambiguity; 10] = [
    Ambiguity {
        id: "R1",
        lines: "c_cnt 14",
        what: "the place of the weights loop",
        values: LoopPlace::VALUES,
        default: DefaultFrom::First,
        why: "inside, every one of the R turns adds all weights anew, and row r keeps what came \
              since its own zeroing: R + 1 − r times its weights",
        trial: Trial::OwnVariant,
        field: field!(r1),
    },
    Ambiguity {
        id: "R2",
        lines: "Km 7",
        what: "the index of the x restraint",
        values: RestraintIndex::VALUES,
        default: DefaultFrom::First,
        why: "`printed` ignores a restraint of x and takes one of y for both, against the text's \
              \"in the corresponding direction\"",
        trial: Trial::Printed,
        field: field!(r2),
    },
    Ambiguity {
        id: "R3",
        lines: "Km 16-33",
        what: "the place of the adding loops",
        values: Wedge::VALUES,
        default: DefaultFrom::First,
        why: "the scan's indentation cannot be meant as a whole: it has all that follows line 4 \
              inside it, where line 12 reads `V[3]` on the first turn, before it exists. That `W` \
              and `fl` are cleared after each node of the second pair too is ours",
        trial: Trial::Printed,
        field: field!(r3),
    },
    Ambiguity {
        id: "R4",
        lines: "c_cnt 17, 18",
        what: "how `∧` is evaluated",
        values: &CONJUNCTIONS,
        default: DefaultFrom::First,
        why: "how Mathcad evaluates `∧` is not known to us. `eager` stops on every scene with \
              contact, so it cannot be if the listing ran as printed; `left-to-right` stops where \
              `yt[1]` < 0 (C10); `guarded` never",
        trial: Trial::EveryShape,
        field: field!(r4),
    },
    Ambiguity {
        id: "R5",
        lines: "c_cnt 22, 23",
        what: "the coordinates from which weights are computed",
        values: NodeTable::VALUES,
        default: DefaultFrom::First,
        why: "as printed",
        trial: Trial::OwnVariant,
        field: field!(r5),
    },
    Ambiguity {
        id: "R6",
        lines: "Km 9",
        what: "the plane problem",
        values: &PLANES,
        default: DefaultFrom::Scene,
        why: "the strand runs along its duct. The keywords say \"plane stress and strain state\", \
              which settles nothing",
        trial: Trial::OwnVariant,
        field: field!(optional r6),
    },
    Ambiguity {
        id: "R7",
        lines: "-",
        what: "the load of an iteration",
        values: Schedule::VALUES,
        default: DefaultFrom::Variant,
        why: "the text has 20 iterations with links renewed after each and does not say what load \
              one carries: both are variants (section 6)",
        trial: Trial::OwnVariant,
        field: field!(optional r7),
    },
    Ambiguity {
        id: "R8",
        lines: "c_cnt 5-7, 16",
        what: "the unit of c_tol in a scene in mm",
        values: ToleranceUnit::VALUES,
        default: DefaultFrom::First,
        why: "the text has \"0.001\" without a unit, beside 50 x 50 mm and MPa",
        trial: Trial::OwnVariant,
        field: field!(r8),
    },
    Ambiguity {
        id: "R9",
        lines: "both",
        what: "what the worksheet, or Mathcad itself, does around the listings",
        values: &WORKSHEETS,
        default: DefaultFrom::First,
        why: "ORIGIN = 1 since every loop of the listings begins at 1; the rest is Mathcad's own \
              default, see below",
        trial: Trial::Worksheet,
        field: None,
    },
    Ambiguity {
        id: "R10",
        lines: "-",
        what: "the formula of the von Mises strain",
        values: &STRAIN_FORMULAS,
        default: DefaultFrom::First,
        why: "the paper prints neither; the first is the von Mises stress over 3G and does with it \
              the work of the deviators, the second is the stress over E",
        trial: Trial::Strains,
        field: None,
    },
];

/// A choice for each ambiguity of the print (`listings/READING.md`, section 4). The scene and the
/// variant set R6 and R7 unless the reading does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub struct Reading {
    /// R1: the place of the weights loop.
    pub r1: LoopPlace,
    /// R2: the index of the x restraint.
    pub r2: RestraintIndex,
    /// R3: the place of the adding loops of `Km`.
    pub r3: Wedge,
    /// R4: the evaluation of `∧`.
    pub r4: Conjunction,
    /// R5: the coordinates from which weights are computed.
    pub r5: NodeTable,
    /// R6: the plane problem in place of the scene's `plane`.
    pub r6: Option<Plane>,
    /// R7: the load of an iteration in place of the variant's.
    pub r7: Option<Schedule>,
    /// R8: the unit of c_tol.
    pub r8: ToleranceUnit,
}
