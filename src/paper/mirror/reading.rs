//! The ambiguities R1 to R8 of the print, each a switch with a default.

use std::str::FromStr;

use crate::choices;
use crate::problem::element::Plane;

choices! {
    /// R1, c_cnt 14: where the weights loop stands.
    LoopPlace {
        /// Beside the zeroing loop.
        Beside = "beside",
        /// Inside it, as the scan indents it: every weight is added again for each row still to be
        /// zeroed.
        Inside = "inside",
    }
}
choices! {
    /// R2, Km 7: the index under which the x restraint is read.
    RestraintIndex {
        /// `S[2·EL−1]`, the x restraint.
        Odd = "odd",
        /// `S[2·EL]`, as the scan prints it: the y restraint, which line 8 reads too.
        Printed = "printed",
    }
}
choices! {
    /// R3, Km 16-33: where the adding loops stand.
    Wedge {
        /// All three nodes fill `W`, then one adding loop.
        Collect = "collect",
        /// The adding loop runs for each node, `W` and `fl` cleared after each.
        PerNode = "per-node",
        /// As the scan indents it: per node, and lines 26-33 inside the first loop too, so that
        /// they run three times.
        Nested = "nested",
    }
}
choices! {
    /// R4, c_cnt 17 and 18: how `∧` is evaluated.
    Order {
        /// A false operand decides, whatever the others do.
        Guarded = "guarded",
        /// Stops at the first false operand.
        LeftToRight = "left-to-right",
        /// Evaluates all operands.
        Eager = "eager",
    }
}
choices! {
    /// R5, c_cnt 22 and 23: the coordinates under the weights.
    NodeTable {
        /// Initial coordinates, as printed.
        Node = "node",
        /// Current coordinates.
        NodeN = "node_n",
    }
}
choices! {
    /// R7, not printed: what load an iteration carries.
    Schedule {
        /// The whole load from the initial shape.
        Total = "total",
        /// An equal share of it from the last shape.
        Stepped = "stepped",
    }
}
choices! {
    /// R8, not printed: the unit of c_tol, in a scene measured in millimetres.
    ToleranceUnit {
        /// The scene's own length unit (mm in the paper's example).
        Millimetre = "mm",
        /// Metres: 1,000 times as much.
        Metre = "m",
    }
}

/// One choice for each ambiguity of the print (`listings/READING.md`, section 4). R6 and R7 are
/// what the scene and the variant say, unless given here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// R1: weights loop beside the zeroing loop, or inside it.
    pub r1: LoopPlace,
    /// R2: index of the x restraint.
    pub r2: RestraintIndex,
    /// R3: where the adding loops of `Km` stand.
    pub r3: Wedge,
    /// R4: how `∧` is evaluated.
    pub r4: Order,
    /// R5: coordinates under the weights.
    pub r5: NodeTable,
    /// R6: overrides the scene's `plane`.
    pub r6: Option<Plane>,
    /// R7: overrides the variant's load.
    pub r7: Option<Schedule>,
    /// R8: the unit of c_tol.
    pub r8: ToleranceUnit,
}

impl Default for Reading {
    fn default() -> Self {
        Reading {
            r1: LoopPlace::Beside,
            r2: RestraintIndex::Odd,
            r3: Wedge::Collect,
            r4: Order::Guarded,
            r5: NodeTable::Node,
            r6: None,
            r7: None,
            r8: ToleranceUnit::Millimetre,
        }
    }
}

impl FromStr for Reading {
    type Err = String;

    /// Reads `R2=printed,R5=node_n`; what is not named keeps its default.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut reading, mut named) = (Reading::default(), Vec::new());
        for item in text.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let (id, value) = item
                .split_once('=')
                .ok_or_else(|| format!("{item:?} is not of the form R2=printed"))?;
            if named.contains(&id.trim()) {
                return Err(format!("{} is given twice", id.trim()));
            }
            named.push(id.trim());
            reading.set(id.trim(), value.trim()).map_err(|why| format!("{id}: {why}"))?;
        }
        Ok(reading)
    }
}

impl Reading {
    fn set(&mut self, id: &str, value: &str) -> Result<(), String> {
        match id {
            "R1" => self.r1 = value.parse()?,
            "R2" => self.r2 = value.parse()?,
            "R3" => self.r3 = value.parse()?,
            "R4" => self.r4 = value.parse()?,
            "R5" => self.r5 = value.parse()?,
            "R6" => self.r6 = Some(value.parse()?),
            "R7" => self.r7 = Some(value.parse()?),
            "R8" => self.r8 = value.parse()?,
            _ => return Err("no such reading; there are R1 to R8".into()),
        }
        Ok(())
    }
}
