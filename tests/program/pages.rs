//! The pages in a real browser, where there is one: what is shown against the program's own JSON, by
//! pointer and by keyboard; in both schemes and three widths no message on the console, nothing from
//! outside, nothing wider than the window, and nothing that axe-core finds.

use std::path::Path;
use std::process::Command;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plane_contact::mathcad::observe::{Executed, Named};
use plane_contact::mathcad::{self, Listing, Recorder};
use plane_contact::paper::corrected::{self, program};
use plane_contact::paper::door::Call;
use plane_contact::paper::listings::{self, Which, settings};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::scene::{Scene, sha256_of};
use plane_contact::studies::audit::{Case, prices};
use plane_contact::studies::lesson::{Repairs, Switch};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::golden_file::is_written;
use crate::common::program::run;
use crate::common::tools::{browser, has_ccx};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Writes what a command prints, or the page that it makes, to a file of the folder.
fn made(folder: &Path, name: &str, args: &[&str]) -> String {
    let path = folder.join(name).to_string_lossy().into_owned();
    let is_page = name.ends_with(".html");
    let args = if is_page { [args, &["--out", &path]].concat() } else { args.to_vec() };
    let output = run(folder, &args);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    if !is_page {
        std::fs::write(&path, output.stdout).expect("a file");
    }
    path
}

/// Runs a script of `tests/program/pages/`.
fn in_browser(modules: &Path, script: &str, args: &[&str]) {
    let output = Command::new("node")
        .arg(Path::new(ROOT).join("tests/program/pages").join(script))
        .args(args)
        .env("BROWSER_MODULES", modules)
        .output()
        .expect("node starts");
    let said =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{}", said.concat());
    println!("{}", said.concat());
}

testing::tolerances! {
    /// The share of the squares of a page's picture whose brightness differs from the golden one's by a tenth of white.
    PAGE_SQUARES = 0.05,
        "fonts of another release move words by some pixels; on one machine the pictures are the same";
}

/// Compares the picture of a page with that in `golden/pages`: its size, and the brightness of its squares.
fn assert_picture(folder: &Path, name: &str) {
    let (taken, golden) = (folder.join(name), Path::new(ROOT).join("golden/pages").join(name));
    if is_written() {
        std::fs::copy(taken, golden).expect("a file");
        return;
    }
    let [(size, taken), (golden_size, golden)] = [taken, golden].map(|path| squares(&path));
    assert_eq!(size, golden_size, "{name}");
    let differs = |(a, b): (&f64, &f64)| (a - b).abs() > 25.5;
    let share = taken.iter().zip(&golden).filter(|pair| differs(*pair)).count() as f64
        / golden.len() as f64;
    assert!(share <= PAGE_SQUARES.limit, "{name}: {share} of its squares differ");
}

/// Returns the width and height of a picture, and the mean brightness, 0 to 255, of each square of 16 pixels.
fn squares(path: &Path) -> ([usize; 2], Vec<f64>) {
    const SIDE: usize = 16;
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("a picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut pixels).expect("pixels");
    let (width, height) = (frame.width as usize, frame.height as usize);
    let channels = frame.line_size / width;
    let mut sums = vec![(0.0, 0.0); width.div_ceil(SIDE) * height.div_ceil(SIDE)];
    for (i, pixel) in pixels.chunks(channels).enumerate() {
        let (x, y) = (i % width / SIDE, i / width / SIDE);
        let (sum, count) = &mut sums[y * width.div_ceil(SIDE) + x];
        *sum += pixel[..3].iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0;
        *count += 1.0;
    }
    ([width, height], sums.into_iter().map(|(sum, count)| sum / count).collect())
}

#[test]
fn the_lesson_shows_what_the_trace_has() {
    let Some(modules) = browser() else { return };
    let folder = TempDir::new().expect("a folder");
    let page = made(folder.path(), "lesson.html", &["lesson", "fig1"]);
    let [c_cnt, km] = traces(folder.path());
    let args = ["audit", "fig1", "--prices", "--repairs", "--json"];
    let repairs = made(folder.path(), "repairs", &args);
    let listings = folder.path().join("listings").to_string_lossy().into_owned();
    std::fs::write(&listings, repaired_listings().to_string()).expect("a file");
    let pictures = folder.path().to_string_lossy().into_owned();
    let files = [&page, &pictures, &c_cnt, &km, &repairs, &listings];
    in_browser(&modules, "lesson.cjs", &files.map(String::as_str));
    assert_picture(folder.path(), "lesson-1024-light.png");
    // What the page saved of an edited listing runs.
    let saved = folder.path().join("my-c_cnt.txt").to_string_lossy().into_owned();
    let output = run(folder.path(), &["listing", "run", "c_cnt", "fig1", "--listing", &saved]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
}

/// Writes what each listing reads and writes on fig. 1, statement by statement, and the entries of MJS that
/// are not 0.
fn traces(folder: &Path) -> [String; 2] {
    let scene = Scene::open("fig1").expect("an embedded scene");
    let model = Switch::as_printed().model(&scene).expect("a sound model");
    let call = Call::c_cnt(&model, &Reading::default(), &model.nodes).expect("it runs");
    [Which::CCnt, Which::Km].map(|which| {
        let listing = Switch::as_printed().listing(which);
        let (mut turn, mut steps) = (None, Vec::new());
        let mut recorder = Recorder::new(|done: &Executed| {
            turn = begun(&listing, done).unwrap_or(turn);
            let [reads, writes] = [&done.reads, &done.writes]
                .map(|list| list.iter().map(accessed).collect::<Vec<_>>());
            steps
                .push(json!({ "turn": turn, "line": done.line, "reads": reads, "writes": writes }));
        });
        let settings = settings(&Reading::default());
        let mut entries = Vec::new();
        match which {
            Which::CCnt => {
                let of = (&call.sheet, &call.sheet.node);
                listings::c_cnt(&listing, &settings, of.0, of.1, Some(&mut recorder))
                    .expect("it runs");
            }
            Which::Km => {
                let of = (&call.sheet, &call.pairs.k_cnt);
                let done = listings::km(&listing, &settings, of.0, of.1, Some(&mut recorder));
                let (matrix, _) = done.expect("it runs");
                let places =
                    (1..=matrix.rows()).flat_map(|i| (1..=matrix.cols()).map(move |j| (i, j)));
                entries.extend(
                    places
                        .map(|at| (at.0, at.1, *matrix.at(at.0 - 1, at.1 - 1)))
                        .filter(|entry| entry.2 != 0.0),
                );
            }
        }
        drop(recorder);
        let path = folder.join(which.name()).to_string_lossy().into_owned();
        let text = json!({ "steps": steps, "result": { "entries": entries } }).to_string();
        std::fs::write(&path, text).expect("a file");
        path
    })
}

/// The contact node or triangle whose turn a `for` line begins, or that none does; None of another line.
fn begun(listing: &Listing, done: &Executed) -> Option<Option<usize>> {
    let text = &listing.lines().iter().find(|line| line.printed == done.line)?.text;
    let value = done.writes.first().and_then(|written| written.value.number())? as usize;
    match text.strip_prefix("for ")? {
        range if range.starts_with("n ") || range.contains("rows(cnt)") => Some(Some(value)),
        range => (range.starts_with("i1 ") && listing.name() == "c_cnt").then_some(None),
    }
}

/// A name or an entry and its value: a number, a small array as its entries, all else by its kind.
fn accessed(named: &Named) -> Value {
    let subscripts: Vec<String> = named.subscripts.iter().map(i64::to_string).collect();
    let name = match subscripts.is_empty() {
        true => named.name.clone(),
        false => format!("{}[{}]", named.name, subscripts.join(",")),
    };
    let value = match &named.value {
        mathcad::Value::Number(x) => json!(x),
        mathcad::Value::Array(a) if a.rows() * a.cols() > 36 => json!(named.value.kind()),
        mathcad::Value::Array(a) if a.cols() == 1 => json!(a.entries().collect::<Vec<_>>()),
        mathcad::Value::Array(a) => (0..a.rows())
            .map(|i| (0..a.cols()).map(|j| json!(a.at(i, j))).collect::<Value>())
            .collect(),
        other => json!(other.kind()),
    };
    json!({ "name": name, "value": value })
}

/// The lines of the corrected listings on fig. 1 with the faults that are left after each repair that the lesson shows.
fn repaired_listings() -> Value {
    let scene = Scene::open("fig1").expect("an embedded scene");
    let case = Case::new(scene);
    let alone = prices::on(&case, &|| ()).expect("fig. 1 has a solution");
    let (repairs, _) = Repairs::new(&case, &alone).expect("the repairs lead to the solution");
    let lines = |own: corrected::Program, edits: &[&str]| -> Vec<String> {
        program(own, edits).lines().iter().map(|line| line.text.clone()).collect()
    };
    let after = |count: usize| {
        let edits: Vec<&str> = repairs.left(count).map(|fault| fault.edit).collect();
        json!({ "c_cnt": lines(corrected::Program::CCnt, &edits), "Km": lines(corrected::Program::Km, &edits) })
    };
    repairs.shown().map(after).collect()
}

/// Nothing but names is English, and nothing is cut off.
#[test]
fn the_lesson_is_in_russian() {
    let Some(modules) = browser() else { return };
    let folder = TempDir::new().expect("a folder");
    let page = made(folder.path(), "lesson.html", &["lesson", "fig1", "--lang", "ru"]);
    in_browser(&modules, "russian.cjs", &[&page]);
}

#[test]
fn the_report_shows_what_the_audit_has() {
    let folder = TempDir::new().expect("a folder");
    let Some(modules) = browser() else { return };
    let page = made(folder.path(), "report.html", &["report", "fig1"]);
    let audit = made(folder.path(), "audit.json", &["audit", "fig1", "--json"]);
    in_browser(&modules, "report.cjs", &[&page, &audit]);
}

/// The page of the paper's example, and its first screen.
#[test]
fn the_report_of_strand_is_small() {
    let folder = TempDir::new().expect("a folder");
    let page = made(folder.path(), "report.html", &["report", "strand"]);
    let size = std::fs::metadata(&page).expect("a file").len();
    assert!(size < 1_500_000, "{size} bytes");
    let Some(modules) = browser() else { return };
    let pictures = folder.path().to_string_lossy().into_owned();
    in_browser(&modules, "first.cjs", &[&page, &pictures]);
    assert_picture(folder.path(), "report-1440-light.png");
}

#[test]
fn a_report_has_hertz_and_calculix_beside_the_runs() {
    let Some(modules) = browser() else { return };
    let folder = TempDir::new().expect("a folder");
    let report = |kind: &str, args: &[&str]| {
        let args = [&["report"], args].concat();
        in_browser(&modules, "beside.cjs", &[&made(folder.path(), "report.html", &args), kind]);
    };
    made(folder.path(), "mesh", &["scene", "mesh", "hertz", "--size", "10"]);
    report("hertz", &["out/mesh-hertz"]);
    if has_ccx() {
        report("calculix", &["fig1", "--ccx"]);
    }
}

#[test]
fn a_page_is_the_same_on_every_run_and_has_nothing_from_outside() {
    let folder = TempDir::new().expect("a folder");
    let page = |name, args: &[&str]| {
        std::fs::read_to_string(made(folder.path(), name, args)).expect("UTF-8")
    };
    for args in [&["lesson"][..], &["report", "fig1"]] {
        let text = page("a.html", args);
        assert_eq!(text, page("b.html", args));
        let text = text.replace("http://www.w3.org/2000/svg", "the name of SVG");
        let text = text.replace("src=\"data:image/svg+xml;base64,", "a picture");
        for outside in ["http://", "https://", "src=", "@import", "url("] {
            assert!(!text.contains(outside), "{args:?}: {outside}");
        }
    }
}

/// The policy of a page lets in its own script and style by their hashes, and nothing else.
#[test]
fn a_page_lets_in_no_other_script() {
    let folder = TempDir::new().expect("a folder");
    for args in [&["lesson", "two-blocks"][..], &["report", "two-blocks"]] {
        let page = std::fs::read_to_string(made(folder.path(), "a.html", args)).expect("UTF-8");
        let between = |start: &str, end: &str| {
            let (_, rest) = page.split_once(start).expect(start);
            rest.split_once(end).expect(end).0
        };
        let policy = between("Content-Security-Policy\" content=\"", "\"");
        let hash = |text: &str| {
            let hexadecimal = sha256_of(text.as_bytes()).expect("memory can be read");
            let bytes = (0..32).map(|k| u8::from_str_radix(&hexadecimal[2 * k..2 * k + 2], 16));
            BASE64_STANDARD.encode(bytes.collect::<Result<Vec<u8>, _>>().expect("hexadecimal"))
        };
        let script = hash(between("<script type=\"module\">", "</script>"));
        let style = hash(between("<style>", "</style>"));
        assert_eq!(
            policy,
            format!(
                "default-src 'none'; script-src 'sha256-{script}'; style-src 'sha256-{style}'; \
                 img-src data: blob:; base-uri 'none'; form-action 'none'"
            )
        );
        assert!(!page.contains(" style=") && !page.contains(" onclick="), "{args:?}");
    }
}

/// What a scene says ends no element of the page.
#[test]
fn texts_of_a_scene_are_escaped() {
    let folder = TempDir::new().expect("a folder");
    let fig1 = std::fs::read_to_string(Path::new(ROOT).join("golden/fig1/scene.json"));
    let hostile = r#""title": "</script><script>throw 1</script><!-- &amp;","#;
    let scene = fig1.expect("UTF-8").replacen('{', &format!("{{{hostile}"), 1);
    let own =
        scene.lines().filter(|line| !line.contains("figure 1")).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.path().join("scene.json"), own).expect("a file");
    let page = made(folder.path(), "lesson.html", &["lesson", "scene.json"]);
    let report = made(folder.path(), "report.html", &["report", "scene.json"]);
    let texts = [&page, &report].map(|page| std::fs::read_to_string(page).expect("UTF-8"));
    for text in &texts {
        assert_eq!(text.matches("</script>").count(), 2, "those of the page itself");
        assert!(!text.contains("<!--"));
    }
    assert!(texts[0].contains("<title>Lesson: &lt;/script&gt;&lt;script&gt;throw 1"));
    assert!(texts[1].contains("(&lt;/script&gt;&lt;script&gt;throw 1"));
    if let Some(modules) = browser() {
        let title = "Lesson: </script><script>throw 1</script><!-- &amp;";
        in_browser(&modules, "title.cjs", &[&page, title]);
    }
}

#[test]
fn a_lesson_is_of_a_small_scene_or_of_chosen_nodes() {
    let folder = TempDir::new().expect("a folder");
    let refused = |args: &[&str], words: &str| {
        let output = run(folder.path(), args);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words), "{said}");
    };
    refused(&["lesson", "strand"], "choose contact nodes");
    refused(&["lesson", "fig1", "--nodes", "12"], "node 12 is no contact node");
    refused(&["lesson", "fig1", "--listing", "nowhere.txt"], "cannot be read");
    made(folder.path(), "lesson.html", &["lesson", "strand", "--nodes", "113,114"]);
}
