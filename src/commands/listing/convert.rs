//! `plane-contact listing convert`.

use std::path::{Path, PathBuf};

use plane_contact::engine::error::Result;
use plane_contact::error::InputError;
use plane_contact::mathcad::xmcd::document::{self, Content};
use plane_contact::mathcad::xmcd::page;
use plane_contact::mathcad::{Limits, Listing, file};
use plane_contact::paper::listings::Which;

use crate::commands::mathcad::run as worksheet;
use crate::commands::{LARGEST_LISTING, write_or_print};

plane_contact::choices! {
    /// A notation of listings.
    Notation {
        /// The notation of listings/README.md.
        Text = "text",
        /// A worksheet of Mathcad 14 and 15.
        Xmcd = "xmcd",
    }
}

/// Write a listing in the other notation: as text, or as a worksheet of Mathcad.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact listing convert c_cnt --to xmcd --out c_cnt.xmcd
  plane-contact listing convert worksheet.xmcd --to text
  plane-contact listing convert my-program.txt --to xmcd")]
pub struct Args {
    /// c_cnt, Km, a file of listings, or a worksheet, whose functions and programs are taken.
    #[arg(value_name = "LISTING")]
    listing: String,
    /// The notation.
    #[arg(long, value_name = "NOTATION")]
    to: Notation,
    /// Write to a file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<()> {
    let listings = read(&args.listing)?;
    let text = match args.to {
        Notation::Text => listings.iter().map(Listing::to_string).collect::<Vec<_>>().join("\n"),
        Notation::Xmcd => page::listings(&listings),
    };
    write_or_print(&args.out, &text)
}

fn read(name: &str) -> Result<Vec<Listing>> {
    if let Ok(which) = name.parse::<Which>() {
        return Ok(vec![which.under(&Default::default())]);
    }
    let wrong = |what: String| {
        InputError::new(name, what, "give c_cnt, Km, a file of listings or a worksheet")
    };
    let text = worksheet::read_text(Path::new(name))
        .map_err(|why| wrong(format!("the listing cannot be read: {why}")))?;
    if !text.trim_start_matches('\u{feff}').starts_with('<') {
        if text.len() as u64 > LARGEST_LISTING {
            return Err(wrong(format!("it has more than {LARGEST_LISTING} bytes")).into());
        }
        let listings = file::listings(name, &text, &Limits::default());
        return Ok(listings.map_err(|error| wrong(error.to_string()))?);
    }
    let mut listings = Vec::new();
    for region in document::read(&text, name)?.regions {
        let text = match (region.listing(), region.content) {
            (Some(text), _) => text,
            (None, Content::Unsupported { names, construct }) if !names.is_empty() => {
                let names = names.join(", ");
                let what = format!("region {}, {names}: unsupported: {construct}", region.id);
                return Err(wrong(what).into());
            }
            _ => continue,
        };
        let listing = Listing::parse_within(&region.id, &text, &worksheet::limits());
        listings.push(listing.map_err(|error| wrong(error.to_string()))?);
    }
    match listings.is_empty() {
        true => Err(wrong("the worksheet has no function and no program".into()).into()),
        false => Ok(listings),
    }
}
