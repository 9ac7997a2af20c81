//! Values of an argument that a shell offers when it completes a command line.

use std::error::Error;
use std::ffi::OsStr;
use std::fmt::Display;
use std::marker::PhantomData;
use std::str::FromStr;

use clap::builder::{PossibleValue, TypedValueParser};
use paper::mirror::READINGS;

/// Reads a value as its type does, whose messages say more than those of clap, and names the values there
/// are.
#[derive(Clone)]
pub struct Offered<T> {
    values: Vec<PossibleValue>,
    is: PhantomData<fn() -> T>,
}

/// Offers values, such as those of a closed set: `offered::<Variant>(Variant::ALL)`.
pub fn offered<T>(names: impl IntoIterator<Item = impl Display>) -> Offered<T> {
    let values = names.into_iter().map(|name| PossibleValue::new(name.to_string())).collect();
    Offered { values, is: PhantomData }
}

/// Offers the readings of the print, each under each of its values: `R1=inside`.
pub fn offered_readings() -> Offered<paper::mirror::Reading> {
    let rows = READINGS.iter().filter(|row| row.is_option());
    offered(
        rows.flat_map(|row| row.values.iter().map(|value| format!("{}={}", row.id, value.name))),
    )
}

impl<T> TypedValueParser for Offered<T>
where
    T: FromStr<Err: Into<Box<dyn Error + Send + Sync>>> + Clone + Send + Sync + 'static,
{
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        T::from_str.parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.values.iter().cloned()))
    }
}
