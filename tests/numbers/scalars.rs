//! The mirror in f32 beside the mirror in f64.

use crate::common::tolerances::{SINGLE, SINGLE_GAP, assert_near};
use plane_contact::numbers::scalar::Scalar;
use plane_contact::paper::door;
use plane_contact::paper::mirror::{Km, Reading, c_cnt};
use plane_contact::problem::scene::Scene;

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
