//! Options. Each line of a text is tried as every kind of option, and its words as the command lines
//! of arithmetic and of a generator: it is refused with words, or what was read is written and reads
//! back the same.

use std::fmt::{Debug, Display};
use std::str::FromStr;

use clap::{Command, FromArgMatches, Subcommand};
use plane_contact::input::{
    Arithmetic, Coupling, Friction, Geometry, Inputs, Plane, Reading, ScalarName, Solver,
    StatusRule, Variant,
};
use plane_contact::mathcad::Settings;
use plane_contact::studies::benchmark::Kind;

use super::sound;

pub fn hold(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    text.lines().take(20).for_each(|line| {
        reads_back::<Reading>(line);
        reads_back::<Variant>(line);
        reads_back::<Coupling>(line);
        reads_back::<Friction>(line);
        reads_back::<Geometry>(line);
        reads_back::<StatusRule>(line);
        reads_back::<Plane>(line);
        reads_back::<ScalarName>(line);
        reads_back::<Solver>(line);
        reads_back::<Inputs>(line);
        if let Err(why) = line.parse::<Settings>() {
            assert!(!why.is_empty());
        }
        if line.contains("--") {
            arithmetic(line);
            generator(line);
        }
    });
}

fn reads_back<T: FromStr<Err = String> + Display + Debug + PartialEq>(line: &str) {
    match line.parse::<T>() {
        Ok(value) => assert_eq!(value.to_string().parse::<T>(), Ok(value), "{line}"),
        Err(why) => assert!(!why.is_empty(), "{line}"),
    }
}

/// The scalar, the solver and the inputs that a line names are refused, or sound.
fn arithmetic(line: &str) {
    let mut read = Arithmetic::default();
    for word in line.split([' ', '=']) {
        word.parse().into_iter().for_each(|scalar| read.scalar = scalar);
        word.parse().into_iter().for_each(|solver| read.solver = Some(solver));
        word.parse().into_iter().for_each(|inputs| read.inputs = inputs);
    }
    if let Err(error) = read.check() {
        sound::input_error(&error);
    }
}

/// A generator refuses its parameters, or makes a scene that is sound.
fn generator(line: &str) {
    let command = Kind::augment_subcommands(Command::new("mesh"));
    let words = ["mesh"].into_iter().chain(line.split_whitespace());
    let Ok(matches) = command.try_get_matches_from(words) else { return };
    let Ok(kind) = Kind::from_arg_matches(&matches) else { return };
    if !line.split([' ', '=']).all(is_small) {
        return;
    }
    match kind.generate() {
        Ok(scene) => drop(scene.build().unwrap_or_else(|error| panic!("{line}: {error}"))),
        Err(error) => sound::input_error(&error),
    }
}

/// Whether a word is none of the numbers that make a mesh of too many triangles for a moment.
fn is_small(word: &str) -> bool {
    word.parse::<f64>().map_or(true, |x| !x.is_finite() || x <= 0.0 || (0.5..=24.0).contains(&x))
}
