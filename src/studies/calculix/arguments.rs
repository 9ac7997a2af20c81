//! What `plane-contact compare` and `plane-contact scene export` share.

use crate::calculix::{Contact, ContactKind, Pair, Part};
use engine::error::Result;
use engine::options::Options;
use engine::{self, Request, Solution};
use problem::modelling::{Coupling, Variant};
use problem::scene::Scene;

use commands::{ModelArgs, ReadingArg, offered, waiting};

/// How CalculiX has contact.
#[derive(clap::Args)]
pub struct DeckArgs {
    /// equation: the constraints of the last iteration; pair: the other code's own contact, by
    /// penalty.
    #[arg(long, default_value_t = ContactKind::Equation, value_parser = offered::<ContactKind>(ContactKind::ALL))]
    pub contact: ContactKind,
    /// tied, stepped or unilateral; with --contact pair also printed [default: the scene's; beside a field,
    /// unilateral].
    #[arg(long, value_parser = offered::<Variant>(Variant::ALL))]
    variant: Option<Variant>,
    #[command(flatten)]
    reading: ReadingArg,
    /// Pressure over penetration of a pair, stress/length [default: 10 times the largest E over the
    /// target's mean edge].
    #[arg(long, value_name = "K", value_parser = penalty)]
    pub penalty: Option<f64>,
    #[command(flatten)]
    model: ModelArgs,
}

fn penalty(text: &str) -> Result<f64, String> {
    let penalty: f64 = text.parse().map_err(|_| "it is no number".to_string())?;
    let positive = Some(penalty).filter(|x| *x > 0.0 && x.is_finite());
    positive.ok_or_else(|| "it is not positive".into())
}

impl DeckArgs {
    /// The run whose contact a deck has.
    pub fn solve(&self, scene: &Scene) -> Result<Solution> {
        let request = self.model.options(self.variant, &self.reading).request(scene)?;
        if self.contact == ContactKind::Equation {
            Contact::check_equations(request.variant)?;
        }
        waiting("solving", || engine::solve(&request, &mut |_| ()))
    }

    /// The run that a field is compared with: that of the variant that is asked for, else the equilibrium.
    pub fn reference(&self, scene: &Scene) -> Result<Request> {
        let own = self.model.options(self.variant, &self.reading);
        let asked = match self.variant {
            Some(_) => own,
            None => {
                let coupling = own.coupling.or(Some(Coupling::Mortar));
                Options { variant: Some(Variant::Unilateral), coupling, ..own }
            }
        };
        Ok(asked.request(scene)?)
    }

    /// The problems whose sum is the run; the last iteration's comes last.
    pub fn parts(&self, solution: &Solution) -> Result<Vec<Part>> {
        match self.contact {
            ContactKind::Equation => Ok(Contact::parts(solution)?),
            ContactKind::Pair => {
                let friction = solution.request.contact.friction;
                Ok(vec![Pair::new(&solution.model, self.penalty, friction).into()])
            }
        }
    }
}
