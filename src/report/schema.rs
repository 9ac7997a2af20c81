//! JSON Schema (draft 2020-12) of every file, and of every document that `--json` prints, made of the
//! types that are written and read.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

use super::failure::Failed;
use super::json::{Document, Found};
use super::{
    ResultFile, answers, audit, claims, comparison, evaluation, extremes, plan, prices, snapshot,
    trace, worksheet,
};
use problem::scene::Description;
use studies::audit::statuses::Measurement;
use studies::lesson::exercise::Answers;
use studies::snapshot::Snapshot;
use studies::sweep::{self, Sweep};
use studies::trade::Trade;

/// The schema of a kind of document.
pub struct Named {
    /// The name of the schema.
    pub name: &'static str,
    /// What the documents are.
    pub of: &'static str,
    /// The commands whose option `--json` prints such a document.
    pub commands: &'static [&'static str],
    make: fn() -> Schema,
}

/// All schemas: files, then documents that commands print.
pub const SCHEMAS: &[Named] = &[
    Named { name: "scene", of: "a scene file", commands: &[], make: read::<Description> },
    Named { name: "sweep", of: "the file of a sweep", commands: &[], make: read::<Sweep> },
    Named { name: "answers", of: "answers to an exercise", commands: &[], make: read::<Answers> },
    Named {
        name: "marks",
        of: "what snapshot verify prints of answers",
        commands: &[],
        make: printed::<Document<answers::Document>>,
    },
    Named { name: "row", of: "a row of a sweep", commands: &[], make: sweep::row_schema },
    Named { name: "snapshot", of: "a snapshot", commands: &[], make: read::<Snapshot> },
    Named { name: "result", of: "result.json", commands: &["solve"], make: printed::<ResultFile> },
    Named {
        name: "failure",
        of: "what --json prints where there is nothing else",
        commands: &[],
        make: printed::<Document<Failed>>,
    },
    Named {
        name: "audit",
        of: "audit.json",
        commands: &["audit"],
        make: printed::<Document<audit::Document>>,
    },
    Named {
        name: "finding",
        of: "audit --finding",
        commands: &[],
        make: printed::<Document<audit::FindingRow>>,
    },
    Named {
        name: "claim",
        of: "audit --claim",
        commands: &[],
        make: printed::<Document<claims::Document>>,
    },
    Named {
        name: "prices",
        of: "audit --prices",
        commands: &[],
        make: printed::<Document<prices::Document>>,
    },
    Named {
        name: "c_cnt",
        of: "a call of c_cnt",
        commands: &["listing run c_cnt"],
        make: printed::<Document<Found>>,
    },
    Named {
        name: "compare",
        of: "compare.json",
        commands: &["compare"],
        make: printed::<Document<comparison::Document>>,
    },
    Named {
        name: "evaluate",
        of: "a program's value or failure",
        commands: &["listing evaluate"],
        make: printed::<Document<evaluation::Document>>,
    },
    Named {
        name: "extremes",
        of: "extremes.json",
        commands: &["extremes"],
        make: printed::<Document<extremes::Document>>,
    },
    Named {
        name: "mathcad",
        of: "a worksheet, executed",
        commands: &["mathcad run"],
        make: printed::<Document<worksheet::Document>>,
    },
    Named {
        name: "plan",
        of: "the plan of a run",
        commands: &["scene plan"],
        make: printed::<Document<plan::Document>>,
    },
    Named {
        name: "statuses",
        of: "audit --statuses",
        commands: &[],
        make: printed::<Document<Measurement>>,
    },
    Named {
        name: "trace",
        of: "a listing executed",
        commands: &["listing trace"],
        make: printed::<Document<trace::Document>>,
    },
    Named {
        name: "trade",
        of: "trade.json",
        commands: &["trade"],
        make: printed::<Document<Trade>>,
    },
    Named {
        name: "verify",
        of: "what differs between runs",
        commands: &["snapshot verify", "snapshot explain", "snapshot diff"],
        make: printed::<Document<snapshot::Document>>,
    },
];

impl Named {
    /// Returns the schema, over several lines.
    pub fn text(&self) -> String {
        let mut schema = (self.make)().to_value();
        schema["title"] = self.of.into();
        close(&mut schema, false);
        serde_json::to_string_pretty(&schema).expect("a schema has string keys") + "\n"
    }
}

/// Returns the schema of a file as it is read: what has a default may be left out.
fn read<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_deserialize();
    settings.into_generator().into_root_schema_for::<T>()
}

/// Returns the schema of a document as it is written, with what says at its end why fields are null.
fn printed<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    let properties = schema.ensure_object().entry("properties").or_insert_with(|| json!({}));
    properties["nulls"] = json!({
        "description": "Why fields are null, by their names; absent where none is.",
        "type": "object",
        "additionalProperties": { "type": "string" }
    });
    schema
}

/// Allows no property that a schema does not name, in it and in all that stand in it. What is
/// `composed` is a part of another one's properties.
fn close(schema: &mut Value, composed: bool) {
    const PARTS: [&str; 3] = ["allOf", "anyOf", "oneOf"];
    let Value::Object(fields) = schema else { return };
    let has_properties = fields.contains_key("properties");
    let is_open = !fields.contains_key("additionalProperties");
    if has_properties && is_open && !composed {
        let is_composed = PARTS.iter().any(|part| fields.contains_key(*part));
        let others = if is_composed { "unevaluatedProperties" } else { "additionalProperties" };
        fields.insert(others.into(), false.into());
    }
    let named = |fields: &mut Map<String, Value>| {
        fields.values_mut().for_each(|schema| close(schema, false));
    };
    for (keyword, value) in fields.iter_mut() {
        match (keyword.as_str(), value) {
            (part, Value::Array(parts)) if PARTS.contains(&part) => {
                parts.iter_mut().for_each(|part| close(part, composed || has_properties));
            }
            ("properties" | "patternProperties" | "$defs", Value::Object(fields)) => named(fields),
            ("prefixItems", Value::Array(items)) => {
                items.iter_mut().for_each(|item| close(item, false));
            }
            ("items" | "additionalProperties", schema) => close(schema, false),
            _ => (),
        }
    }
}
