//! The document of a case: the scene's fields, a generator's parameters and options, in which JSON
//! pointers set values; and its key.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use clap::{Command, FromArgMatches, Subcommand};
use serde_json::{Map, Value, json};

use crate::benchmark::Kind;
use crate::snapshot::{Options, VERSION};
use base::error::{InputError, Result};
use base::files;
use engine::Request;
use problem::scene::{SceneBuilder, SceneFile, file, sha256};

/// Files of sweeps.
pub(super) const SWEEP: files::json::Kind =
    files::json::Kind { name: "sweep", fix: "see `plane-contact sweep --help`", has_values: true };

/// What a case runs.
#[derive(Clone)]
pub struct Document {
    /// `scene` and `options`, or `generate`, `scene` and `options`.
    fields: Value,
    /// Where the scene is from; None of a generator.
    source: Option<Arc<Source>>,
}

/// A scene file and what is beside it.
struct Source {
    file: SceneFile,
    /// The SHA-256 of each mesh file that a case names, or why it cannot be read: thousands of cases
    /// have the same mesh, which is read once.
    meshes: Mutex<HashMap<String, Result<String, String>>>,
}

impl Source {
    fn mesh_sha256(&self, name: &str) -> Result<String, String> {
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        let read = || {
            let file = self.file.beside(name)?;
            files::sum_of(&file[..]).map_err(|why| why.to_string())
        };
        meshes.entry(name.into()).or_insert_with(read).clone()
    }
}

impl Document {
    /// Returns the document of which every case of a sweep is a copy with other values: of a scene, or
    /// of what a generator makes of its parameters.
    ///
    /// # Errors
    /// Neither or both of a scene and a generator are given, or the scene is no JSON.
    pub fn new(
        scene: Option<SceneFile>,
        generate: &Map<String, Value>,
        options: &Map<String, Value>,
    ) -> Result<Self> {
        match (scene, generate.is_empty()) {
            (Some(file), true) => {
                let fix = "see src/guide/scenes.md";
                let kind = files::json::Kind { name: "scene file", fix, has_values: true };
                let fields: Value = files::json::read(&file.text, &kind)
                    .map_err(|error| error.within(&file.name))?;
                let source = Source { file, meshes: Mutex::default() };
                if let Some(mesh) = fields.get("mesh").and_then(Value::as_str) {
                    source.mesh_sha256(mesh).map_err(|why| {
                        let what = format!("the mesh file cannot be read: {why}");
                        let fix = "the mesh lies beside the scene file or below";
                        InputError::new("field mesh", what, fix)
                    })?;
                }
                let fields = json!({"scene": fields, "options": options});
                Ok(Document { fields, source: Some(Arc::new(source)) })
            }
            (None, false) => {
                let fields = json!({"generate": generate, "scene": {}, "options": options});
                Ok(Document { fields, source: None })
            }
            _ => {
                let what = "the sweep needs either scene or generate";
                let fix = "give \"scene\": \"fig1\", or \"generate\": {\"kind\": \"hertz\"}";
                Err(InputError::new("fields scene, generate", what, fix))
            }
        }
    }

    /// Returns the same document with other values, by pointer.
    ///
    /// # Errors
    /// A pointer leads nowhere.
    pub fn with(&self, values: &Map<String, Value>) -> Result<Self> {
        let mut document = self.clone();
        for (pointer, value) in values {
            set(&mut document.fields, pointer, value).ok_or_else(|| {
                let what = format!("the pointer {pointer:?} leads nowhere");
                let fix = "point into /scene, /options or /generate, such as /scene/contact/c_tll";
                InputError::new("grid and list", what, fix)
            })?;
        }
        Ok(document)
    }

    /// Returns the request that the document stands for.
    ///
    /// # Errors
    /// The scene, the generator's parameters or the options are at fault.
    pub fn request(&self) -> Result<Request> {
        let scene = self.fields["scene"].to_string();
        let scene = match &self.source {
            Some(source) => {
                let file = &source.file;
                let beside = |name: &str| file.beside(name);
                SceneBuilder::read(&file.name, scene.as_bytes(), beside)?.build()?
            }
            None => self.generated()?.build()?,
        };
        let options: Options = files::json::read_field(&self.fields["options"], &SWEEP, "options")?;
        Ok(options.request(&scene))
    }

    /// Returns the scene of the generator, with the fields of `scene` over its own.
    fn generated(&self) -> Result<SceneBuilder> {
        let mut builder = kind(&self.fields["generate"])?.generate()?;
        let own = serde_json::to_value(&builder.description).expect("a description is an object");
        let merged = over(own, &self.fields["scene"]);
        builder.description = file::parse(merged.to_string().as_bytes())?;
        Ok(builder)
    }

    /// Returns the key of the case: the SHA-256 of all that it reads, and of the program's version.
    pub fn key(&self) -> String {
        let mesh = self.fields["scene"]["mesh"].as_str().zip(self.source.as_ref());
        let parts = json!({
            "document": sorted(&self.fields),
            "mesh_sha256": mesh.map(|(name, source)| source.mesh_sha256(name)),
            "version": VERSION,
        });
        sha256(&parts)
    }
}

/// Returns the key of a scene under options.
///
/// # Errors
/// The scene is no JSON.
pub fn key_of(scene: SceneFile, options: &Options) -> Result<String> {
    let options = serde_json::to_value(options).expect("options have string keys");
    let options = options.as_object().cloned().expect("options are an object");
    Ok(Document::new(Some(scene), &Map::new(), &options)?.key())
}

/// The most levels of a pointer; a case's document has fewer.
const DEEPEST: usize = 32;

/// Sets the value that a pointer names; of an object a new field too. None where it leads nowhere.
fn set(fields: &mut Value, pointer: &str, value: &Value) -> Option<()> {
    if pointer.split('/').count() > DEEPEST {
        return None;
    }
    if let Some(there) = fields.pointer_mut(pointer) {
        *there = value.clone();
        return Some(());
    }
    let (parent, name) = pointer.rsplit_once('/')?;
    // A field of a generated scene is known once it is generated.
    if fields.get("generate").is_some() && fields.pointer(parent).is_none() {
        set(fields, parent, &json!({}))?;
    }
    let parent = fields.pointer_mut(parent)?.as_object_mut()?;
    parent.insert(name.replace("~1", "/").replace("~0", "~"), value.clone());
    Some(())
}

/// Returns `value` with the fields of `other` over its own, those of objects one by one.
fn over(value: Value, other: &Value) -> Value {
    match (value, other) {
        (Value::Object(mut fields), Value::Object(other)) => {
            for (name, other) in other {
                let own = fields.get(name).cloned().unwrap_or(Value::Null);
                fields.insert(name.clone(), over(own, other));
            }
            Value::Object(fields)
        }
        (_, other) => other.clone(),
    }
}

/// Returns a document with the fields of every object in the order of their names.
fn sorted(value: &Value) -> Value {
    match value {
        Value::Object(fields) => {
            let mut fields: Vec<_> = fields.iter().map(|(k, v)| (k.clone(), sorted(v))).collect();
            fields.sort_by(|a, b| a.0.cmp(&b.0));
            Value::Object(fields.into_iter().collect())
        }
        Value::Array(items) => items.iter().map(sorted).collect(),
        scalar => scalar.clone(),
    }
}

/// Returns the generator that `parameters` name: its `kind`, and its options of the command line.
fn kind(parameters: &Value) -> Result<Kind> {
    let fault =
        |what: String| InputError::new("generate", what, "see `plane-contact scene mesh --help`");
    let fields = parameters.as_object().ok_or_else(|| fault("it is no object".into()))?;
    let name = fields.get("kind").and_then(Value::as_str);
    let name = name.ok_or_else(|| fault("it names no kind".into()))?;
    let text = |value: &Value| value.as_str().map_or(value.to_string(), String::from);
    let options = fields.iter().filter(|(option, _)| *option != "kind");
    let options = options.map(|(option, value)| format!("--{option}={}", text(value)));
    let arguments = ["mesh".to_string(), name.to_string()].into_iter().chain(options);
    let command = Kind::augment_subcommands(Command::new("mesh"));
    let matches = command.try_get_matches_from(arguments).map_err(|why| fault(words(&why)))?;
    Kind::from_arg_matches(&matches).map_err(|why| fault(words(&why)))
}

/// Returns the first line of a fault of the command line.
fn words(why: &clap::Error) -> String {
    let text = why.render().to_string();
    text.lines().next().unwrap_or_default().trim_start_matches("error: ").into()
}
