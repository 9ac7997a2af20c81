//! The source distribution of PyPI `xmcd` 0.4.0 (MIT): twenty worksheets that Mathcad 14.1.5
//! calculated and saved, and the package itself, which reads and checks what we write.
//!
//! `XMCD_SOURCE` names the folder of the distribution; `.ci/run` gets it. Without it nothing is
//! compared.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use plane_contact::mathcad::Limits;
use plane_contact::mathcad::worksheet::{Verdict, execute};
use plane_contact::mathcad::xmcd::document;

fn source() -> Option<PathBuf> {
    let source = std::env::var_os("XMCD_SOURCE").map(PathBuf::from);
    if source.is_none() {
        eprintln!("XMCD_SOURCE is not set: the worksheets of PyPI xmcd are not executed");
    }
    source
}

fn worksheets(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.extension() {
            _ if path.is_dir() => worksheets(&path, found),
            Some(extension) if extension == "xmcd" => found.push(path),
            _ => {}
        }
    }
}

/// How many results of the twenty worksheets came out how.
#[test]
fn mathcad_s_own_worksheets() {
    let Some(source) = source() else { return };
    let mut files = vec![];
    worksheets(&source.join("tests").join("fixtures"), &mut files);
    assert_eq!(files.len(), 20);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a worksheet");
        let sheet = document::read(&text, "worksheet").expect("a worksheet");
        for region in execute(&sheet, &Limits::default()) {
            let kind = match region.verdict {
                Verdict::NothingSaved => continue,
                Verdict::Same => "same",
                Verdict::Digits(_) => "digits",
                Verdict::SameFailure { .. } => "failure",
                Verdict::Differs { .. } | Verdict::Fails(_) => {
                    panic!("{}, {}: {:?}", file.display(), region.id, region.verdict)
                }
                Verdict::Unsupported(_) => "unsupported",
            };
            *counts.entry(kind).or_default() += 1;
        }
    }
    println!("{counts:?}");
    assert_eq!([counts["same"], counts["digits"], counts["failure"]], [84, 6, 6]);
}

/// The package reads what is written, writes it back byte for byte, and finds no error but names
/// that it does not know.
///
/// Those are of two kinds, both limits of its `check`: Mathcad's functions `identity` and `trace`,
/// which its registry lacks, and names that a loop writes entry by entry, which it does not follow
/// out of the loop. The listings as printed have both, and so have worksheets that Mathcad 14.1
/// saved: github:flying-pi/MS_2_2_lab, lab3.xmcd region 246 (`R`) and lab5.xmcd (`trace`). A loop
/// made by the package itself is refused in the same way.
#[test]
fn the_package_reads_and_checks_what_is_written() {
    let Some(source) = source() else { return };
    let folder = tempfile::TempDir::new().expect("a folder");
    let names = ["fig1", "two-blocks"];
    for name in names {
        let text = super::exported(name);
        std::fs::write(folder.path().join(format!("{name}.xmcd")), text).expect("a file");
    }
    let script = "
import re, sys
from xmcd import Define, DefinitionKind, For, Function, Program, Range, Symbol, ValidationContext, Worksheet

def undefined(report):
    return {re.search(\"'(.*?)' is not\", str(e))[1] for e in report.errors if 'undefined' in str(e)}

own, i, z = Worksheet(), Symbol('i'), Symbol('z')
entry = Define(z[i], i, kind=DefinitionKind.LOCAL)
own.define(Function(Symbol('f'), [Symbol('x')]), Program(For(i, Range(1, 2), entry), z))
assert undefined(own.check()) == {'z'}, own.check().errors

names = 'a b all ct yt dy k_cnt V cx MJS W d y z'.split()
symbols = tuple(map(Symbol, names))
for file in sys.argv[1:]:
    x = [Symbol('x'), Symbol('y')]
    trace = Function(Symbol('trace'), x[:1])
    context = ValidationContext(symbols, (Function(Symbol('identity'), x[:1]), trace))
    sheet = Worksheet.read(file)
    assert sheet.to_bytes() == open(file, 'rb').read(), file
    unknown = undefined(sheet.check())
    assert 'trace' in unknown and unknown <= {*names, 'identity', 'trace'}, (file, unknown)
    errors = [str(e) for e in sheet.check(context=context).errors]
    assert not errors, (file, errors)
";
    let files = names.map(|name| folder.path().join(format!("{name}.xmcd")));
    let output = Command::new("python3")
        .args(["-c", script])
        .args(files)
        .env("PYTHONPATH", source.join("src"))
        .output()
        .expect("Python starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
