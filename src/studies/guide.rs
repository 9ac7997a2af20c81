//! `plane-contact guide`: the guide, and the pages and tables that it and messages name, where the program
//! is.

use base::exit::ExitStatus;
use clap::builder::PossibleValuesParser;
use engine::error::Result;
use engine::linear::{Inputs, ScalarName, Solver};
use paper::mirror::Reading;
use problem::modelling::{Coupling, Geometry, StatusRule, Variant};

use commands::print_fitted;

/// A page, which stands in a file of the repository; its text names others by their files.
struct Page {
    name: &'static str,
    path: &'static str,
    text: &'static str,
}

macro_rules! pages {
    ($($name:literal $path:literal),+ $(,)?) => {
        [$(Page { name: $name, path: $path, text: include_str!(concat!("../../", $path)) }),+]
    };
}

const PAGES: [Page; 26] = pages! {
    "scenes" "src/guide/scenes.md",
    "auditing" "src/guide/auditing.md",
    "accuracy" "src/guide/accuracy.md",
    "benchmarks" "src/guide/benchmarks.md",
    "snapshots" "src/guide/snapshots.md",
    "sweeps" "src/guide/sweeps.md",
    "mathcad" "src/guide/mathcad.md",
    "teaching" "src/guide/teaching.md",
    "glossary" "src/guide/glossary.md",
    "notation" "listings/README.md",
    "reading" "listings/READING.md",
    "edits" "listings/readings/README.md",
    "corrected" "listings/corrected/README.md",
    "interpreter" "src/mathcad/README.md",
    "security" "SECURITY.md",
    "quantities" "golden/quantities.md",
    "variants" "golden/tables/variants.md",
    "claims" "golden/tables/claims.md",
    "range" "golden/tables/range.md",
    "prices" "golden/tables/prices.md",
    "calculix" "golden/tables/calculix.md",
    "trade" "golden/tables/trade.md",
    "limit" "golden/tables/limit.md",
    "statuses" "golden/tables/statuses.md",
    "mesh-errors" "golden/tables/mesh_errors.md",
    "published" "golden/tables/benchmarks.md",
};

/// The front page, with whose answer the list of pages begins.
const FRONT: Page = Page { name: "", path: "README.md", text: include_str!("../../README.md") };

/// The page that is made from the program's own tables.
const OPTIONS: &str = "options";

/// Print a page of the guide, or the list of pages.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact guide
  plane-contact guide scenes
  plane-contact guide glossary")]
pub struct Args {
    /// A page [default: the list of pages].
    #[arg(value_name = "PAGE", value_parser = PossibleValuesParser::new(names()))]
    page: Option<String>,
}

pub fn run(args: &Args) -> Result<()> {
    let Some(name) = &args.page else { return print_fitted(&(answer() + &list())) };
    match PAGES.iter().find(|page| page.name == name) {
        Some(page) => print_fitted(&page.shown()),
        None => print_fitted(&options()),
    }
}

fn names() -> impl Iterator<Item = &'static str> {
    PAGES.iter().map(|page| page.name).chain([OPTIONS])
}

/// Returns what the front page says of the paper.
fn answer() -> String {
    let front = FRONT.shown();
    let (_, answer) = front.split_once("## The answer\n\n").expect("the front page has an answer");
    answer.split_once("\n## ").expect("and goes on").0.to_owned() + "\n"
}

/// Returns each page's name with its heading.
fn list() -> String {
    let row = |(name, title): (&str, &str)| format!("  {name:<11}  {title}\n");
    let pages = PAGES.iter().map(|page| (page.name, page.title()));
    let rows: String = pages.chain([(OPTIONS, "The values of options")]).map(row).collect();
    format!(
        "Pages of the guide, printed by plane-contact guide PAGE. Files that they name, such as \
         src/engine, are the program's source.\n\n{rows}"
    )
}

impl Page {
    /// Returns the heading; of a table the first sentence of its title.
    fn title(&self) -> &str {
        let line = self.text.lines().next().unwrap_or_default().trim_start_matches(['#', '*', ' ']);
        let end = line.find(". ").or_else(|| line.find(".**")).unwrap_or(line.len());
        line[..end].trim_end_matches('*')
    }

    /// Returns the text with the commands that print what it names in place of files and links.
    fn shown(&self) -> String {
        let mut pieces = self.text.split("](");
        let mut text = pieces.next().unwrap_or_default().to_string();
        for piece in pieces {
            let (link, rest) = piece.split_once(')').unwrap_or((piece, ""));
            if let Some(start) = text.rfind('[') {
                text.remove(start);
            }
            text += &format!(" ({}){rest}", self.target(link));
        }
        for page in &PAGES {
            let command = format!("`plane-contact guide {}`", page.name);
            let named = text.replace(&format!("`{}`", page.path), &command);
            let named = named.replace(page.path, command.trim_matches('`'));
            // A link whose words were the path.
            let named = named.replace(&format!("{command} ({command})"), &command);
            text = named.replace(&format!("[{}]", page.name), &command);
        }
        text
    }

    /// Returns what a link leads to: a path from the root of the repository, an address, or the command that
    /// explains a finding.
    fn target(&self, link: &str) -> String {
        if link.contains("://") {
            return link.into();
        }
        let mut way: Vec<&str> = self.path.split('/').collect();
        way.pop();
        for part in link.split('/') {
            match part {
                ".." => drop(way.pop()),
                part => way.push(part),
            }
        }
        match way[..] {
            ["golden", "findings", id, _] => format!("`plane-contact audit --finding {id}`"),
            _ => format!("`{}`", way.join("/")),
        }
    }
}

/// Returns the values of the options that have a closed set of them, from the sets themselves.
fn options() -> String {
    let text = [
        values("--variant", Variant::ALL, Variant::name, Variant::explained),
        values("--coupling", Coupling::ALL, Coupling::name, Coupling::explained),
        values("--geometry", Geometry::ALL, Geometry::name, Geometry::explained),
        values("--status", StatusRule::ALL, StatusRule::name, StatusRule::explained),
        values("--scalar", ScalarName::ALL, ScalarName::name, ScalarName::explained),
        values("--solver", Solver::ALL, Solver::name, Solver::explained),
        values("--inputs", Inputs::ALL, Inputs::name, Inputs::explained),
        values("Ends of the program", ExitStatus::ALL, ExitStatus::name, ExitStatus::explained),
    ];
    format!(
        "# The values of options\n\n{}## --reading\n\n{}\n\n## Options of every command\n\n- `-q`, `--quiet`: no \
         progress and no notes on standard error, errors alone\n- `-v`, `--verbose`: each stage on standard error, \
         with its time\n",
        text.concat(),
        Reading::help()
    )
}

fn values<T: Copy>(
    heading: &str,
    all: &[T],
    name: fn(T) -> &'static str,
    explained: fn(T) -> String,
) -> String {
    let row = |value: &T| format!("- `{}`: {}\n", name(*value), explained(*value));
    format!("## {heading}\n\n{}\n", all.iter().map(row).collect::<String>())
}
