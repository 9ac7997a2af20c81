//! The ambiguities R1 to R8 of the print, each a switch with a default.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use base::choices;
use mathcad::Conjunction;
use problem::element::Plane;

choices! {
    /// R1, c_cnt 14: the place of the weights loop.
    LoopPlace {
        /// The weights loop is beside the zeroing loop.
        Beside = "beside",
        /// The weights loop is inside it, as the scan indents it: every weight is added again for
        /// each row still to be zeroed.
        Inside = "inside",
    }
}
choices! {
    /// R2, Km 7: the index under which the x restraint is read.
    RestraintIndex {
        /// The index is that of `S[2·EL−1]`, the x restraint.
        Odd = "odd",
        /// The index is that of `S[2·EL]`, as the scan prints it: the y restraint of line 8.
        Printed = "printed",
    }
}
choices! {
    /// R3, Km 16-33: the place of the adding loops.
    Wedge {
        /// All three nodes fill `W`, then one adding loop.
        Collect = "collect",
        /// The adding loop runs for each node, `W` and `fl` cleared after each.
        PerNode = "per-node",
        /// As the scan indents it: per node, and lines 26-33 run inside the first loop too.
        Nested = "nested",
    }
}
choices! {
    /// R5, c_cnt 22 and 23: the coordinates from which weights are computed.
    NodeTable {
        /// The initial coordinates, as printed.
        Node = "node",
        /// The current coordinates of each iteration.
        NodeN = "node_n",
    }
}
choices! {
    /// R7, not printed: the load of an iteration.
    Schedule {
        /// The whole load, from the initial shape.
        Total = "total",
        /// An equal share of the load, from the last shape.
        Stepped = "stepped",
    }
}
choices! {
    /// R8, not printed: the unit of c_tol, in a scene measured in millimetres.
    ToleranceUnit {
        /// The scene's own length unit (mm in the paper's example).
        Millimetre = "mm",
        /// Metres, which are 1,000 times as large.
        Metre = "m",
    }
}

/// A choice for each ambiguity of the print (`listings/READING.md`, section 4). The scene and the
/// variant set R6 and R7 unless the reading does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub struct Reading {
    /// R1: the weights loop beside the zeroing loop, or inside it.
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

impl FromStr for Reading {
    type Err = String;

    /// Reads a list such as `R2=printed,R5=node_n`; other readings keep their default.
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

impl fmt::Display for Reading {
    /// Writes the readings that differ from the default, as `R2=printed,R5=node_n`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let plain = Reading::default();
        let r6 = self.r6.map(|r6| r6.name());
        let r7 = self.r7.map(|r7| r7.name());
        let all = [
            ("R1", Some(self.r1.name()).filter(|_| self.r1 != plain.r1)),
            ("R2", Some(self.r2.name()).filter(|_| self.r2 != plain.r2)),
            ("R3", Some(self.r3.name()).filter(|_| self.r3 != plain.r3)),
            ("R4", Some(self.r4.name()).filter(|_| self.r4 != plain.r4)),
            ("R5", Some(self.r5.name()).filter(|_| self.r5 != plain.r5)),
            ("R6", r6),
            ("R7", r7),
            ("R8", Some(self.r8.name()).filter(|_| self.r8 != plain.r8)),
        ];
        let given = all.iter().filter_map(|(id, value)| Some(format!("{id}={}", (*value)?)));
        f.write_str(&given.collect::<Vec<_>>().join(","))
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
