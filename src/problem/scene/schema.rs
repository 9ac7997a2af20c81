//! The JSON Schema of a scene file, for the editors in which people write one.

use schemars::generate::SchemaSettings;

use super::description::Description;

/// Returns the JSON Schema (draft 2020-12) of a scene file: what has a default may be left out.
pub fn schema() -> String {
    let settings = SchemaSettings::draft2020_12().for_deserialize();
    let mut schema = settings.into_generator().into_root_schema_for::<Description>();
    schema.insert("title".into(), "a scene file".into());
    serde_json::to_string_pretty(&schema).expect("a schema has string keys") + "\n"
}
