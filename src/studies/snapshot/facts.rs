//! The discrete facts of a run, as JSON Schema has them: what each is by its name.

use schemars::{Schema, SchemaGenerator, json_schema};

/// Returns the schema of the facts of a run.
pub fn schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "object",
        "required": ["cnt", "trg", "restrained", "exit status", "failure"],
        "properties": {
            "cnt": { "type": "array", "items": { "type": "integer", "minimum": 1 } },
            "trg": { "type": "array", "items": { "type": "integer", "minimum": 1 } },
            "restrained": { "type": "array", "items": { "type": "string", "pattern": "^[0-9]+[xy]$" } },
            "exit status": { "enum": [0, 3, 4] },
            "failure": { "type": ["null", "string", "object"] },
            "iterations": { "type": "integer", "minimum": 0 }
        },
        "patternProperties": {
            "^iteration [1-9][0-9]* (ct|dy|in contact)$":
                { "type": "array", "items": { "type": "integer", "minimum": 0 } },
            "^iteration [1-9][0-9]* (mates|statuses)$":
                { "type": "array", "items": { "type": "string" } },
            "^iteration [1-9][0-9]* cycle$":
                { "type": ["array", "null"], "items": { "type": "integer", "minimum": 1 } }
        },
        "additionalProperties": false
    })
}
