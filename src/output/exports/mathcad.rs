//! The worksheet: tables, `Ae`, `B`, `D`, the listings, the iterations, and our results beside
//! Mathcad's.

use super::{CorrectedExport, Export, ITERATED, Iterated, MOVED, listing};
use ::mathcad::value::Array;
use ::mathcad::xmcd::{page::Page, write};
use ::mathcad::{Settings, Value};
use paper::corrected::{Bound, Program, STEPS, program};
use paper::listings::{Which, elasticity, settings, tables};
use paper::mirror::Worksheet;
use problem::element::Plane;

/// The tables that programs of the worksheet compute.
const COMPUTED: [&str; 4] = ["Ae", "B", "R", "M"];

const AREAS: &str = "Ae() :=
  for n ∈ 1 .. M
    p ← EL[n,ind_1]
    q ← EL[n,ind_1+1]
    r ← EL[n,ind_1+2]
    x ← (node[q,2] − node[p,2])·(node[r,3] − node[p,3])
    y ← (node[r,2] − node[p,2])·(node[q,3] − node[p,3])
    a[n] ← (x − y) / 2·thickness
  a
";

const GRADIENTS: &str = "B() :=
  for n ∈ 1 .. M
    c ← (EL[n,ind_1] EL[n,ind_1+1] EL[n,ind_1+2] EL[n,ind_1] EL[n,ind_1+1])ᵀ
    p ← c[1]
    q ← c[2]
    r ← c[3]
    x ← (node[q,2] − node[p,2])·(node[r,3] − node[p,3])
    y ← (node[r,2] − node[p,2])·(node[q,3] − node[p,3])
    a ← (x − y) / 2
    for k ∈ 1 .. 3
      p ← c[k+1]
      q ← c[k+2]
      b[1,2·k−1] ← (node[p,3] − node[q,3]) / (a + a)
      b[2,2·k] ← (node[q,2] − node[p,2]) / (a + a)
      b[3,2·k−1] ← b[2,2·k]
      b[3,2·k] ← b[1,2·k−1]
    all[n] ← b
  all
";

/// Strains, stresses and the von Mises stress of each element, by rows: e_xx, e_yy, g_xy, s_xx,
/// s_yy, s_xy, s_zz, von Mises.
const STATES: &str = "states(u) :=
  for n ∈ 1 .. M
    for k ∈ 1 .. 3
      d[2·k−1] ← u[2·EL[n,k+ind_1−1] − 1]
      d[2·k] ← u[2·EL[n,k+ind_1−1]]
    g ← B[n]·d
    s ← D(E[n],ν[n])·g
    z ← PLANE
    for k ∈ 1 .. 3
      a[n,k] ← g[k]
      a[n,k+3] ← s[k]
    a[n,7] ← z
    a[n,8] ← √(((s[1] − s[2])^2 + (s[2] − z)^2 + (z − s[1])^2) / 2 + 3·s[3]^2)
  a
";

const INTRODUCTION: &str = "A. M. Filipov, M. V. Khomenko: plane contact by the finite element method. The two listings \
    of the paper as printed, c_cnt and Km, with the tables of one scene. ORIGIN is 1; 0/0 is an \
    error; comparisons are exact. What the paper does not print is assumed: Ae, B and D of the \
    three-node triangle, and the load of all iterations on the initial shape.\n\
    Written by plane-contact, which executed the same listings: its results stand beside \
    Mathcad's, with their difference. Nothing here was calculated by Mathcad yet.";

const INTRODUCTION_RU: &str = "А. М. Филипов, М. В. Хоменко: решение плоской контактной задачи методом конечных элементов. \
    Два листинга статьи как напечатаны, c_cnt и Km, с таблицами одной сцены. ORIGIN равен 1; \
    0/0 — ошибка; сравнения точные. Чего в статье нет, то принято: Ae, B и D трёхузлового \
    треугольника и вся нагрузка на начальной форме в каждой итерации.\n\
    Записано программой plane-contact, которая исполнила те же листинги: её результаты стоят \
    рядом с результатами Mathcad и разностью. Здесь Mathcad ещё ничего не вычислял.";

/// Above so many equations our matrix does not stand beside Mathcad's.
const SHOWN_EQUATIONS: usize = 60;

/// Writes the worksheet of an export.
pub fn worksheet(export: &Export) -> String {
    let mut page = Page::default();
    page.heading(export.title);
    page.text(INTRODUCTION);
    page.text(INTRODUCTION_RU);
    scene_tables(&mut page, export.sheet, export.thickness);
    let node_n = Value::from(export.node_n);
    if export.node_n == &export.sheet.node {
        page.define("node_n", write::id("node"), 1);
    } else {
        define(&mut page, "node_n", &node_n);
    }
    elements(&mut page, export.sheet);
    page.heading("The paper's listings / Листинги статьи");
    let given = export.reading.to_string();
    let given = if given.is_empty() { "all by default" } else { &given };
    page.text(&format!(
        "Readings: {given}. R1 where the weights' loop stands, R2 the restraint's index, R3 how Km adds \
         linked nodes, R5 the shape of the weights are in the text below. R4, how a conjunction is \
         evaluated, is Mathcad's own: line 18 of c_cnt reads yt below ORIGIN at the first node, before \
         its own guard, unless a false operand decides.\n\
         Прочтения: {given}. R4, порядок вычисления конъюнкции, решает сам Mathcad: строка 18 листинга \
         c_cnt читает yt ниже ORIGIN у первого узла."
    ));
    for which in Which::ALL {
        page.program(&which.under(export.reading));
    }
    page.heading("One call of each / По одному вызову");
    page.define("k_cnt", expression("c_cnt(node_n)"), 1);
    page.evaluate(expression("k_cnt"), export.sheet.R(), "k_cnt");
    page.define("MJS", expression("Km(k_cnt)"), 1);
    page.evaluate(expression("MJS"), 20, "MJS");
    if let Some(run) = &export.run {
        iterations(&mut page, export, run);
    }
    page.finish(export.title, &settings(export.reading))
}

/// Writes the worksheet of the corrected algorithm.
pub fn corrected(export: &CorrectedExport) -> String {
    let mut page = Page::default();
    page.heading(export.title);
    page.text(
        "The corrected algorithm of plane-contact (plane-contact guide corrected) with the tables of one \
         scene: what the findings ask for, in the notation of A. M. Filipov's and M. V. Khomenko's \
         listings. It is not the paper's. Nothing here was calculated by Mathcad yet.",
    );
    scene_tables(&mut page, export.sheet, export.thickness);
    define(&mut page, "F", &Array::column(export.force.clone()).into());
    define(&mut page, "both", &Bound::Normal.both().into());
    elements(&mut page, export.sheet);
    page.heading("The corrected listings / Исправленные листинги");
    for own in Program::ALL {
        page.program(&program(*own, &[]));
    }
    page.heading("The iterations / Итерации");
    page.define("U", expression(&format!("iterate({STEPS})")), 1);
    page.define("u", expression("submatrix(U,1,2·R,1,1)"), 1);
    page.evaluate(expression("u"), export.u.len(), "u");
    page.heading(
        "plane-contact's results, and the difference / Результаты plane-contact и разность",
    );
    beside(&mut page, "u_ours", Array::column(export.u.clone()), "u");
    page.finish(export.title, &Settings::default())
}

/// Defines the tables of a scene that no program computes.
fn scene_tables(page: &mut Page, sheet: &Worksheet<f64>, thickness: f64) {
    page.heading("The scene's tables / Таблицы сцены");
    for (name, value) in tables(sheet) {
        if !COMPUTED.contains(&name) {
            define(page, name, &value);
        }
    }
    define(page, "thickness", &thickness.into());
    for (name, table) in [("R", "node"), ("M", "EL")] {
        page.define(name, expression(&format!("rows({table})")), 1);
    }
}

/// Adds the programs of what the paper does not print of the elements.
fn elements(page: &mut Page, sheet: &Worksheet<f64>) {
    page.heading("Elements (not printed in the paper) / Элементы (в статье не напечатаны)");
    page.program(&listing(AREAS)).program(&listing(GRADIENTS));
    page.program(&listing(elasticity(sheet.plane)));
}

fn iterations(page: &mut Page, export: &Export, run: &Iterated) {
    page.heading("The iterations / Итерации");
    define(page, "F", &Array::column(run.force.clone()).into());
    let states = STATES.replace(
        "PLANE",
        match export.sheet.plane {
            Plane::Strain => "ν[n]·(s[1] + s[2])",
            Plane::Stress => "0",
        },
    );
    for text in [MOVED, ITERATED, &states] {
        page.program(&listing(text));
    }
    page.define("U", expression(&format!("iterated({})", run.iterations)), 1);
    page.define("node_end", expression("moved(U)"), 1);
    page.define("state", expression("states(U)"), 1);
    page.evaluate(expression("U"), run.u.len(), "U");
    page.evaluate(expression("state"), export.sheet.M(), "state");
    page.heading(
        "plane-contact's results, and the difference / Результаты plane-contact и разность",
    );
    page.text("Each difference should be 0, or rounding. / Каждая разность — 0 или округление.");
    let k_cnt = Array::from_fn(export.sheet.R(), 4, |i, j| run.pairs.k_cnt[(i + 1, j + 1)]);
    beside(page, "k_ours", k_cnt, "k_cnt");
    if export.sheet.R() * 2 <= SHOWN_EQUATIONS
        && let Ok(mjs) = paper::mirror::Km(export.sheet, export.reading, &run.pairs.k_cnt)
    {
        let mjs = mjs.to_table();
        let n = mjs.rows();
        let mjs = Array::from_fn(n, n, |i, j| mjs[(i + 1, j + 1)]);
        beside(page, "M_ours", mjs, "MJS");
    }
    beside(page, "U_ours", Array::column(run.u.clone()), "U");
    beside(page, "s_ours", Array::column(run.stress.clone()), "state⟨8⟩");
}

/// Defines our values under a name, and evaluates the largest difference from Mathcad's.
fn beside(page: &mut Page, name: &str, ours: Array, theirs: &str) {
    define(page, name, &ours.into());
    let difference = format!("max({theirs} − {name}) − min({theirs} − {name})");
    page.evaluate(expression(&difference), 1, &format!("difference {name}"));
}

fn define(page: &mut Page, name: &str, value: &Value) {
    page.define(name, write::literal(value), value.size().0);
}

fn expression(text: &str) -> base::xml::Element {
    write::expression(&listing(&format!("_() :=\n  {text}")))
}
