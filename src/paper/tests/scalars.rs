//! The mirror in f32 beside the mirror in f64, and its failures in every scalar.

use mathcad::array::Column;
use numbers::scalar::{Exact, F64x2, Scalar, scope};
use paper::door;
use paper::mirror::{Cause, Failure, Km, Reading, c_cnt};
use problem::model::Model;
use problem::scene::Scene;
use testing::tolerances::assert_near;

testing::tolerances! {
    /// f32 beside f64 for yt, relative to the coordinates, which it subtracts.
    SINGLE_GAP = 1e-6, "a difference of coordinates rounded at 6e-8";
    /// f32 beside f64, relative to the largest entry of the table or matrix.
    SINGLE = 2e-6, "inputs and a handful of operations rounded at 6e-8 each, sums of six elements";
}

#[test]
fn f32_follows_f64() {
    let reading = Reading::default();
    for name in ["fig1", "two-blocks", "strand"] {
        let model = Scene::open(name).unwrap().model;
        let double = door::worksheet(&model, |x| x);
        let single = door::worksheet(&model, f32::from_f64);
        let (d, s) = (
            c_cnt(&double, &reading, &double.node).unwrap(),
            c_cnt(&single, &reading, &single.node).unwrap(),
        );
        assert_eq!((&d.ct, &d.dy), (&s.ct, &s.dy), "{name}: statuses");
        let size = double.node.as_matrix().columns(1, 2).amax();
        for (d, s) in d.yt.iter().zip(s.yt.iter()) {
            assert_near("yt", f64::from(*s), *d, size, &SINGLE_GAP);
        }
        let weights = d
            .k_cnt
            .as_matrix()
            .zip_fold(s.k_cnt.as_matrix(), 0.0_f64, |m, d, s| m.max((d - f64::from(s)).abs()));
        assert_near("k_cnt", weights, 0.0, size, &SINGLE_GAP);
        let d = Km(&double, &reading, &d.k_cnt).unwrap().to_table();
        let s = Km(&single, &reading, &s.k_cnt).unwrap().to_table();
        let error = d
            .as_matrix()
            .zip_fold(s.as_matrix(), 0.0_f64, |m, d, s| m.max((d - f64::from(s)).abs()));
        assert_near("MJS", error, 0.0, d.as_matrix().amax(), &SINGLE);
    }
}

/// What `c_cnt` finds in the initial shape in one scalar: target edges and statuses.
fn found<T: Scalar>(
    model: &Model,
    reading: &Reading,
    number: impl Fn(f64) -> T,
) -> Result<(Column<usize>, Column<usize>), Failure> {
    let sheet = door::worksheet(model, number);
    c_cnt(&sheet, reading, &sheet.node).map(|pairs| (pairs.ct, pairs.dy))
}

/// Listing failures are the same in every scalar: the smallest scenes of findings C3 (a vertical
/// edge) and C10.
#[test]
fn the_mirror_fails_at_the_same_line_in_every_scalar() {
    let mut failures = 0;
    for name in ["fig1", "two-blocks", "findings/C3", "findings/C6", "findings/C10"] {
        let scene = Scene::open(name).unwrap();
        for reading in ["", "R4=left-to-right", "R4=eager"] {
            let reading: Reading = reading.parse().unwrap();
            let model = door::under(scene.model.clone(), "", &reading).unwrap();
            let double = found(&model, &reading, |x| x);
            let dd = found(&model, &reading, F64x2::from_f64);
            let single = found(&model, &reading, f32::from_f64);
            let rational = scope(|| found(&model, &reading, Exact::from_f64));
            for other in [&dd, &single, &rational] {
                match (&double, other) {
                    (Ok(a), Ok(b)) => assert_eq!(a, b, "{name}"),
                    (Err(a), Err(b)) => assert_eq!((a.line, a.cause), (b.line, b.cause), "{name}"),
                    (a, b) => panic!("{name}: {a:?} and {b:?}"),
                }
            }
            if let Err(failure) = double {
                failures += 1;
                assert!(matches!(failure.cause, Cause::Singularity | Cause::InvalidIndex));
            }
        }
    }
    assert!(failures > 0, "the scenes are here to fail");
}
