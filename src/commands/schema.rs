//! `plane-contact schema`.

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::report::schema::SCHEMAS;

use super::{print, print_fitted};

/// Print the JSON Schema of a file, or of what a command prints under --json.
#[derive(clap::Args)]
#[command(after_help = "\
A document of a command with --json has the schema that bears the command's name or that the list
gives it; where the command ends without one, what it prints has the schema failure. What a schema
does not name is not allowed.

Examples:
  plane-contact schema                       the list
  plane-contact schema result
  plane-contact schema listing trace
  plane-contact schema scene > scene.schema.json")]
pub struct Args {
    /// The name of a schema, or of a command [default: the list of them].
    #[arg(value_name = "NAME")]
    name: Vec<String>,
}

pub fn run(args: &Args) -> Result<()> {
    if args.name.is_empty() {
        let line = |schema: &plane_contact::report::schema::Named| {
            let commands: String =
                schema.commands.iter().map(|c| format!(", {c} --json")).collect();
            format!("{:<10}{}{commands}\n", schema.name, schema.of)
        };
        return print_fitted(&SCHEMAS.iter().map(line).collect::<String>());
    }
    let name = args.name.join(" ");
    let asked = |commands: &[&str]| commands.contains(&name.as_str());
    let schema = SCHEMAS.iter().find(|schema| schema.name == name || asked(schema.commands));
    let schema = schema.ok_or_else(|| {
        let names: Vec<&str> = SCHEMAS.iter().map(|schema| schema.name).collect();
        let fix = format!("the schemas are {}", names.join(", "));
        InputError::new("NAME", format!("there is no schema {name:?}"), fix)
    })?;
    print(&schema.text())
}
