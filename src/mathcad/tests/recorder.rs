//! A run as it is recorded.

use super::program;
use mathcad::observe::Executed;
use mathcad::{Array, Limits, Recorder, Settings, Sheet, Value};

/// Runs the program with v = (1 2 3)ᵀ and x = 5.
fn record(lines: &str, recorder: &mut Recorder) {
    let listing = program(lines);
    let mut worksheet = Sheet::empty();
    worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
    listing
        .runner(&worksheet, &Settings::default(), &Limits::default())
        .call_recorded(&[Value::Number(5.0)], Some(recorder))
        .unwrap();
}

fn show(executed: &Executed) -> String {
    let mut text = executed.line.to_string();
    for (mark, accesses) in [("", &executed.reads), ("← ", &executed.writes)] {
        for access in accesses {
            text += &format!(" {mark}{}{:?}={}", access.name, access.subscripts, access.value);
        }
    }
    text
}

#[test]
fn the_recorder_hands_over_each_statement() {
    let mut shown = vec![];
    record(
        "for i ∈ 1 .. 2\n  a[i,i+1] ← v[v[i]] + x",
        &mut Recorder::new(|executed| shown.push(show(executed))),
    );
    let expected = [
        "2 ← i[]=1",
        "3 i[]=1 v[1]=1 v[1]=1 x[]=5 i[]=1 i[]=1 ← a[1, 2]=6",
        "2 ← i[]=2",
        "3 i[]=2 v[2]=2 v[2]=2 x[]=5 i[]=2 i[]=2 ← a[2, 3]=7",
    ];
    assert_eq!(shown, expected);
}

/// A statement that reads nothing and writes nothing is handed over too, the last one included.
#[test]
fn the_recorder_hands_over_statements_without_names() {
    let mut shown = vec![];
    record("1\nx\n2\n3", &mut Recorder::new(|executed| shown.push(show(executed))));
    assert_eq!(shown, ["2", "3 x[]=5", "4", "5"]);
}
