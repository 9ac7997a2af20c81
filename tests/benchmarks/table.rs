//! `golden/tables/benchmarks.md`: published numbers beside ours. `INSTA_UPDATE=always` writes it anew.

use std::f64::consts::PI;

use plane_contact::engine::Solution;
use plane_contact::problem::modelling::Coupling;
use plane_contact::studies::benchmark::{Blocks, Hertz};

use crate::common::fitted_hertz::{over_hertz, peak_pressure};
use crate::common::page::{assert_table, markdown, percent};
use crate::common::recovery::{averaged, extrapolated, node_at, order, solved, solved_by};
use crate::{cook, kirsch, lame, le1, punch, punch_patch};

#[test]
fn published_numbers_beside_ours() {
    let rows = [patches(), pressures(), plates()].concat();
    let table = markdown("benchmark | quantity | published | here", rows);
    let source = "Made by the test `published_numbers_beside_ours`";
    assert_table("benchmarks", "Problems with a known solution.", source, &table);
}

/// The largest error of sigma_y over the pressure.
fn misses(solution: &Solution, pressure: f64) -> String {
    let misses = solution.elements.iter().map(|state| (state.sigma[1] / pressure + 1.0).abs());
    percent(misses.fold(0.0, f64::max), 1)
}

fn patches() -> Vec<String> {
    let row = |name: &str, upper, lower, coupling| {
        let blocks = Blocks { upper, lower }.generate().expect("in range");
        let miss = misses(&solved_by(blocks, |model| model.coupling = coupling), 6.3);
        format!(
            "patch test, {upper} on {lower} edges, {name} | largest error of sigma_y | 0 | {miss}"
        )
    };
    vec![
        row("`mortar`", 7, 10, Coupling::Mortar),
        row("`nts`", 7, 10, Coupling::Nts),
        row("`nts`", 28, 40, Coupling::Nts),
        row("`nts`", 10, 7, Coupling::Nts),
        format!(
            "Taylor and Papadopoulos, `mortar` | largest error of sigma_y | 0 | {}",
            misses(&punch_patch::punch(Coupling::Mortar), 1.0)
        ),
    ]
}

fn pressures() -> Vec<String> {
    let hertz = Hertz::default();
    let [half_width, peak] = over_hertz(hertz.size, hertz.load, |_| ());
    let [width, pressure] = [hertz.half_width(), peak_pressure(&hertz)];
    let punch = punch::punch(24);
    let load: f64 = punch.contact.iter().filter_map(|node| node.force).sum();
    let errors = punch.contact.iter().filter(|node| node.arc < 0.75).map(|node| {
        let exact = 2.0 * load / (PI * (1.0 - node.arc.powi(2)).sqrt());
        (node.pressure.expect("it is in contact") / exact - 1.0).abs()
    });
    vec![
        format!("Hertz, NAFEMS CGS-1 | half width, mm | {width:.4} | {:.4}", half_width * width),
        format!(
            "Hertz, NAFEMS CGS-1 | largest pressure, MPa | {pressure:.1} | {:.1}",
            peak * pressure
        ),
        format!(
            "flat punch | largest error of the pressure up to 0.75 of the half width | 0 | {}",
            percent(errors.fold(0.0, f64::max), 1)
        ),
    ]
}

/// Lamé, Kirsch, Cook, NAFEMS LE1.
fn plates() -> Vec<String> {
    let [coarse, fine] = [32, 64].map(|n| {
        let ring = lame::annulus(n);
        let bore = node_at(&ring.model, [50f64.sqrt(); 2]);
        let [x, y] = bore.components(&ring.u);
        let [xx, yy, xy] = extrapolated(&ring, bore);
        [x.hypot(y), (xx + yy) / 2.0 - xy]
    });
    let (exact, hoop) = (lame::exact(10.0), 50.0 / 3.0);
    let hole = solved(kirsch::sheet(64, 5.0));
    let [top, side] =
        [[0.0, 1.0], [1.0, 0.0]].map(|place| extrapolated(&hole, node_at(&hole.model, place)));
    let cook = |(n, published): (usize, f64)| {
        let panel = solved(cook::membrane(n));
        let v = node_at(&panel.model, [48.0, 52.0]).components(&panel.u)[1];
        format!("Cook, {n} x {n} | displacement of (48, 52) | {published} | {v:.3}")
    };
    let cook = [cook::KNOWN[0], cook::KNOWN[5]].map(cook);
    let ellipse = solved(le1::membrane(64));
    let corner = node_at(&ellipse.model, [2.0, 0.0]);
    let [mean, limit] = [averaged(&ellipse, corner)[1], extrapolated(&ellipse, corner)[1]];
    let rows = [
        format!("Lamé | displacement of the bore, mm | {exact:.8} | {:.8}", fine[0]),
        format!(
            "Lamé | order of convergence of the displacement | 2 | {:.2}",
            order(coarse[0] - exact, fine[0] - exact)
        ),
        format!("Lamé | hoop stress at the bore, MPa | {hoop:.4} | {:.4}", fine[1]),
        format!("Kirsch | sigma_x at (0, 1) | {} | {:.3}", kirsch::stress([0.0, 1.0])[0], top[0]),
        format!("Kirsch | sigma_y at (1, 0) | {} | {:.3}", kirsch::stress([1.0, 0.0])[1], side[1]),
        format!("NAFEMS LE1, 64 x 64 | sigma_y at (2, 0), MPa | 89.06 | {mean:.2}"),
        format!("NAFEMS LE1, extrapolated | sigma_y at (2, 0), MPa | 92.7 | {limit:.1}"),
    ];
    rows.into_iter().chain(cook).collect()
}
