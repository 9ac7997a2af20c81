//! Whether the tests notice a mutant: those that reach its place are run until one fails, first
//! those that catch the most mutants a second.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::mutant::Mutant;
use crate::processes::{self, End};
use crate::select::Options;
use crate::tests::{self, Test};
use crate::workers::share;
use crate::{Failure, Work};

/// A test has this many times its own time, and some seconds on top.
const SLOWER: f64 = 10.0;
const SECONDS: f64 = 5.0;
/// Of a test that takes longer than these seconds, or a quarter of the budget, only as much is run: most
/// fail early or not at all.
const BEGINNING: f64 = 2.0;
/// The first process of a mutant has tests of this many seconds, each further one of twice as many.
const FIRST_BATCH: f64 = 0.5;
/// What is believed of a test before it ran: of how many mutants it catches how many, and how long
/// its process takes to start, in seconds. Tests that record many numbers notice most.
const BELIEF: [f64; 2] = [10.0, 0.5];
const BELIEF_RECORDED: [f64; 2] = [10.0, 5.0];
const START: f64 = 0.1;
/// A test that reaches fewer places than these is believed to catch more of them: it was written for them.
const FEW: f64 = 500.0;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    Caught,
    /// The tests do not end.
    Timeout,
    Missed,
    /// Missed, as no test comes there.
    Unreached,
    /// Not noticed by the tests for which there is time.
    Open,
}

#[derive(Clone, Serialize, Deserialize)]
pub struct Graded {
    pub name: String,
    pub outcome: Outcome,
    /// The test that noticed it.
    pub by: Option<String>,
    pub seconds: f64,
    /// How long its tests were allowed to take.
    budget: f64,
}

impl Graded {
    /// The result of an earlier run.
    pub fn earlier(name: &str, outcome: Outcome) -> Self {
        Graded { name: name.to_owned(), outcome, by: None, seconds: 0.0, budget: 0.0 }
    }
}

/// What the workers share.
struct Bench<'a> {
    work: &'a Work,
    tests: &'a [Test],
    reaching: BTreeMap<usize, Vec<usize>>,
    budget: f64,
    results: Mutex<File>,
    /// For how many mutants of a file or a module a test was run, and how many it caught.
    known: Mutex<BTreeMap<(String, usize), [f64; 2]>>,
}

/// Grades the mutants that are chosen and have no result yet.
pub fn grade(work: &Work, options: &Options) -> Result<(), Failure> {
    let mutants: Vec<Mutant> = serde_json::from_str(&fs::read_to_string(work.mutants())?)?;
    let tests = tests::read(work)?;
    let is_done =
        |graded: &Graded| graded.outcome != Outcome::Open || graded.budget >= options.budget;
    let done: BTreeSet<String> =
        read(work)?.into_iter().filter(is_done).map(|graded| graded.name).collect();
    let chosen = options.select(&mutants);
    if chosen.is_empty() || tests.is_empty() {
        return Err("there is nothing to grade".into());
    }
    let left = chosen.iter().copied().filter(|mutant| !done.contains(&mutant.name));
    println!("{} mutants chosen, {} to grade", chosen.len(), left.clone().count());
    let results = OpenOptions::new().create(true).append(true).open(work.results())?;
    let bench = Bench {
        work,
        tests: &tests,
        reaching: by_place(&tests),
        budget: options.budget,
        results: Mutex::new(results),
        known: Mutex::default(),
    };
    share(left, options.jobs, |mutant, worker| {
        bench.one(mutant, worker).map_err(|why| format!("{}: {why}", mutant.name).into())
    })
}

/// Returns the results so far.
pub fn read(work: &Work) -> Result<Vec<Graded>, Failure> {
    let text = fs::read_to_string(work.results()).unwrap_or_default();
    Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
}

/// Returns which tests reach each place, the fastest first.
fn by_place(tests: &[Test]) -> BTreeMap<usize, Vec<usize>> {
    let mut reaching: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (k, test) in tests.iter().enumerate() {
        test.reached.iter().for_each(|place| reaching.entry(*place).or_default().push(k));
    }
    reaching
}

impl Bench<'_> {
    /// Returns the seconds that are run of a longer test.
    fn beginning(&self) -> f64 {
        BEGINNING.max(self.budget / 4.0)
    }

    /// Returns for how many mutants a test was run, and how many it caught, as is believed before.
    fn belief(&self, test: usize) -> [f64; 2] {
        let Test { name, reached, .. } = &self.tests[test];
        let [runs, caught] = if name.contains("recorded::") { BELIEF_RECORDED } else { BELIEF };
        [runs, caught * (FEW / reached.len() as f64).sqrt()]
    }

    fn is_long(&self, test: usize) -> bool {
        self.tests[test].seconds > self.beginning()
    }

    fn one(&self, mutant: &Mutant, worker: usize) -> Result<(), Failure> {
        let start = Instant::now();
        let temporary = self.work.temporary(worker);
        tests::clear(&temporary)?;
        let mut outcome = (Outcome::Unreached, None);
        let (mut spent, mut is_cut) = (0.0, false);
        for batch in self.batches(mutant) {
            if spent > self.budget {
                outcome = (Outcome::Open, None);
                break;
            }
            outcome = (Outcome::Missed, None);
            let end = self.run(mutant, &batch, worker)?;
            self.learn(mutant, &batch, &end);
            match end {
                End::Passed => spent += batch.iter().map(|k| self.tests[*k].seconds).sum::<f64>(),
                End::TooLong(_) if self.is_long(batch[0]) => {
                    (spent, is_cut) = (spent + self.beginning(), true);
                }
                End::Failed(by) => outcome = (Outcome::Caught, Some(by)),
                End::TooLong(by) => outcome = (Outcome::Timeout, Some(by)),
            }
            if outcome.0 != Outcome::Missed {
                break;
            }
        }
        let (mut outcome, by) = outcome;
        if outcome == Outcome::Missed && is_cut {
            outcome = Outcome::Open;
        }
        let seconds = start.elapsed().as_secs_f64();
        let graded =
            Graded { name: mutant.name.clone(), outcome, by, seconds, budget: self.budget };
        tests::append(&mut self.results.lock().expect("no worker panics"), &graded)
    }

    fn learn(&self, mutant: &Mutant, batch: &[usize], end: &End) {
        let mut known = self.known.lock().expect("no worker panics");
        for &k in batch {
            let is_by = |name: &String| *name == self.tests[k].name;
            let (runs, caught) = match end {
                End::Passed => (1.0, 0.0),
                End::TooLong(_) if self.is_long(k) => (1.0, 0.0),
                End::Failed(by) | End::TooLong(by) if is_by(by) => (1.0, 1.0),
                _ => (0.0, 0.0),
            };
            for place in [mutant.file.clone(), mutant.module()] {
                let of_test = known.entry((place, k)).or_insert(self.belief(k));
                *of_test = [of_test[0] + runs, of_test[1] + caught];
            }
        }
    }

    /// Returns the tests that reach a mutant in groups, each of one binary for one process; first
    /// those that may be expected to catch the most mutants a second.
    fn batches(&self, mutant: &Mutant) -> Vec<Vec<usize>> {
        let mut reaching = self.reaching.get(&mutant.first).cloned().unwrap_or_default();
        let known = self.known.lock().expect("no worker panics");
        let pace = |k: &usize| {
            let rate = |place: String| {
                let [runs, caught] = *known.get(&(place, *k)).unwrap_or(&self.belief(*k));
                caught / runs
            };
            let rate = rate(mutant.file.clone()) + rate(mutant.module());
            rate / (self.tests[*k].seconds.min(self.beginning()) + START)
        };
        // Positive numbers are in the order of their bits.
        reaching.sort_by_cached_key(|k| std::cmp::Reverse(pace(k).to_bits()));
        // With each group the place of its first test in that order, so that a group that is never
        // full waits for no slower test.
        let mut batches = Vec::new();
        let mut room = FIRST_BATCH;
        let mut open: BTreeMap<_, (usize, Vec<usize>, f64)> = BTreeMap::new();
        for (place, k) in reaching.into_iter().enumerate() {
            let test = &self.tests[k];
            if self.is_long(k) {
                batches.push((place, vec![k]));
                continue;
            }
            let (first, batch, seconds) =
                open.entry(&test.binary).or_insert_with(|| (place, vec![], 0.0));
            batch.push(k);
            *seconds += test.seconds;
            if *seconds > room {
                batches.push((*first, std::mem::take(batch)));
                open.remove(&test.binary);
                room = (2.0 * room).min(self.budget / 4.0);
            }
        }
        batches.extend(open.into_values().map(|(first, batch, _)| (first, batch)));
        batches.sort_by_key(|(first, _)| *first);
        batches.into_iter().map(|(_, batch)| batch).collect()
    }

    /// Runs tests of one binary with a mutant on, until the first of them fails.
    fn run(&self, mutant: &Mutant, batch: &[usize], worker: usize) -> Result<End, Failure> {
        let names: Vec<&str> = batch.iter().map(|k| self.tests[*k].name.as_str()).collect();
        let slowest = batch.iter().map(|k| self.tests[*k].seconds).fold(0.0, f64::max);
        let is_long = self.is_long(batch[0]);
        let limit = if is_long { self.beginning() } else { SLOWER * slowest + SECONDS };
        let limit = Duration::from_secs_f64(limit);
        let binary = &self.tests[batch[0]].binary;
        let temporary = self.work.temporary(worker);
        let mut command = processes::command(self.work, binary, &names, &temporary);
        processes::run(command.env("MUTANT", mutant.id.to_string()), limit, names[0])
    }
}
