//! Worksheets that the program exports, executed by the interpreter: the mirror's bits.

use plane_contact::mathcad::Limits;
use plane_contact::mathcad::array::Table;
use plane_contact::mathcad::worksheet::execute;
use plane_contact::mathcad::xmcd::document;
use plane_contact::output::exports::{self, Export};
use plane_contact::paper::mirror::{Km, c_cnt};
use proptest::prelude::*;
use testing::random::fixed;
use testing::worksheets::{bits, draw, reading, worksheet};

/// `export --to mathcad`, read back and executed by the interpreter, has the mirror's bits on
/// random scenes; where the mirror fails, the worksheet fails too.
#[test]
fn an_exported_worksheet_has_the_mirror_s_bits() {
    let mut runner = proptest::test_runner::TestRunner::new(fixed(1_400));
    let seen = std::cell::Cell::new([0; 2]);
    let result = runner.run(&(draw(), reading()), |(draw, reading)| {
        let (sheet, node_n) = worksheet(&draw);
        // The worksheet divides by the area where the mirror's gradients are infinite.
        if sheet.B.iter().any(|b| b.iter().any(|x| !x.is_finite())) {
            return Ok(());
        }
        let export = Export {
            title: "random",
            sheet: &sheet,
            reading: &reading,
            node_n: &node_n,
            thickness: 1.0,
            run: None,
        };
        let mut read = document::read(&exports::mathcad::worksheet(&export), "export")
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        read.settings.conjunction = reading.r4;
        let limits = Limits { characters: 1 << 20, ..Limits::default() };
        let checked = execute(&read, &limits);
        let value = |tag: &str| {
            let region = checked.iter().find(|region| region.tag == tag).expect("a region");
            region.value.as_ref().map(|value| {
                bits(Table::<f64>::try_from(value).expect("an array").as_matrix().iter().copied())
            })
        };
        let pairs = c_cnt(&sheet, &reading, &node_n).ok();
        let flat = |table: &Table<f64>| bits(table.as_matrix().iter().copied());
        prop_assert_eq!(value("k_cnt"), pairs.as_ref().map(|pairs| flat(&pairs.k_cnt)));
        let mjs =
            pairs.and_then(|pairs| Km(&sheet, &reading, &pairs.k_cnt).ok()).map(|m| m.to_table());
        let [scenes, matrices] = seen.get();
        seen.set([scenes + 1, matrices + usize::from(mjs.is_some())]);
        prop_assert_eq!(value("MJS"), mjs.as_ref().map(flat));
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    let [scenes, matrices] = seen.get();
    assert!(scenes >= 1_000 && matrices >= 300, "{scenes} scenes, {matrices} with a matrix");
}
