//! Random tests, which draw the same cases on every run.

use proptest::test_runner::{Config, RngSeed};

/// Returns the settings of a test of `cases` random cases from a fixed seed. PROPTEST_CASES and
/// PROPTEST_RNG_SEED in the environment ask for other ones.
pub fn fixed(cases: u32) -> Config {
    let asked = Config::default();
    Config {
        cases: if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { cases },
        rng_seed: match asked.rng_seed {
            RngSeed::Random => RngSeed::Fixed(2026),
            fixed => fixed,
        },
        failure_persistence: None,
        ..asked
    }
}
