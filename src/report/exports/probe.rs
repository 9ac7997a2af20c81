//! Small regions that ask Mathcad what no source says, and what each answer decides.

use ::mathcad::worksheet::ExecutedRegion;
use ::mathcad::xmcd::document::{Content, Saved, Worksheet};
use ::mathcad::xmcd::{page::Page, write};
use ::mathcad::{Listing, Settings, Value};

/// A question to Mathcad: a program, and what its answers mean.
struct Probe {
    tag: &'static str,
    question: &'static str,
    /// The body of the program, which has one parameter, `x` = 1, and the column `v` = (1 2 3).
    program: &'static str,
    answers: &'static [Answer],
}

/// What a saved result decides; the first that fits counts.
struct Answer {
    result: Expected,
    decides: &'static str,
}

enum Expected {
    Number(f64),
    Failure,
    Text,
    Any,
}

use Expected::{Any, Failure, Number, Text};

const fn answer(result: Expected, decides: &'static str) -> Answer {
    Answer { result, decides }
}

const PROBES: [Probe; 20] = [
    Probe {
        tag: "and-first-fails",
        question: "∧: the first operand fails, the second is false (R4)",
        program: "v[0] > 0 ∧ x < 0",
        answers: &[
            answer(Number(0.0), "R4=guarded: a false operand decides, though another fails"),
            answer(Failure, "not guarded: R4=left-to-right or eager"),
        ],
    },
    Probe {
        tag: "and-second-fails",
        question: "∧: the first operand is false, the second fails (R4)",
        program: "x < 0 ∧ v[0] > 0",
        answers: &[
            answer(Number(0.0), "R4=guarded or left-to-right: not eager"),
            answer(Failure, "R4=eager: all operands are evaluated"),
        ],
    },
    Probe {
        tag: "and-line-18",
        question: "∧ as in line 18 of c_cnt: the third operand guards the second (R4)",
        program: "y ← 7\ny ← 1 if x > 0 ∧ v[x−1] > 0 ∧ x ≥ 2\ny",
        answers: &[
            answer(Number(7.0), "R4=guarded: line 18 runs as printed"),
            answer(Failure, "line 18 fails as printed: default R4 changes"),
        ],
    },
    Probe {
        tag: "or-second-fails",
        question: "∨: the first operand is true, the second fails",
        program: "x > 0 ∨ v[0] > 0",
        answers: &[
            answer(Number(1.0), "∨ stops or is guarded"),
            answer(Failure, "∨ evaluates all operands"),
        ],
    },
    Probe {
        tag: "for-if-false",
        question: "for ... if on one line: the condition is false",
        program: "y ← 7\nfor i ∈ 1 .. 3 if x < 0\n  y ← i\ny",
        answers: &[
            answer(Number(7.0), "`for ... if` guards the loop, as here"),
            answer(Any, "`for ... if` does something else"),
        ],
    },
    Probe {
        tag: "for-if-changes",
        question: "for ... if on one line: the body makes the condition false",
        program: "y ← 0\nfor i ∈ 1 .. 3 if x > 0\n  y ← y + 1\n  x ← −1\ny",
        answers: &[
            answer(Number(3.0), "the condition is asked once, as here"),
            answer(Number(1.0), "the condition is asked in every turn"),
        ],
    },
    Probe {
        tag: "equal-1e-13",
        question: "exact-boolean is true: 1 + 1e-13 = 1",
        program: "1 + 1E-13 = 1",
        answers: &[
            answer(Number(0.0), "comparisons are exact, as here"),
            answer(Number(1.0), "comparisons are to 1e-12: exact-boolean=false"),
        ],
    },
    Probe {
        tag: "less-1e-13",
        question: "exact-boolean is true: 1 < 1 + 1e-13",
        program: "1 < 1 + 1E-13",
        answers: &[
            answer(Number(1.0), "inequalities are exact, as here"),
            answer(Number(0.0), "inequalities are to 1e-12"),
        ],
    },
    Probe {
        tag: "tiny-is-zero",
        question: "1e-308 > 0",
        program: "1E-308 > 0",
        answers: &[
            answer(Number(1.0), "tiny numbers compare as themselves, as here"),
            answer(Number(0.0), "numbers below 1e-307 compare as 0: tiny=0"),
        ],
    },
    Probe {
        tag: "denormal",
        question: "1e-300 · 1e-15, a denormal, times 1e300",
        program: "1E-300·1E-15·1E300",
        answers: &[
            answer(Number(0.0), "denormals are 0"),
            answer(Any, "denormals are kept, as here"),
        ],
    },
    Probe {
        tag: "beyond-1e307",
        question: "5e307, between 1e307 and the largest double",
        program: "5·1E307 / 1E307",
        answers: &[
            answer(Failure, "the limit is 1e307"),
            answer(Number(5.0), "the limit is that of doubles, as here"),
        ],
    },
    Probe {
        tag: "trace-value",
        question: "the value of trace",
        program: "trace(\"{0}\",x)",
        answers: &[
            answer(Text, "trace returns a string, as here"),
            answer(Number(1.0), "trace returns its argument"),
            answer(Number(0.0), "trace returns 0"),
            answer(Any, "trace returns something else"),
        ],
    },
    Probe {
        tag: "entry-value",
        question: "the value of an assignment to an entry",
        program: "y ← 1\ny[2] ← 5",
        answers: &[
            answer(Number(5.0), "what was assigned, as here"),
            answer(Any, "the whole array"),
        ],
    },
    Probe {
        tag: "last-if",
        question: "the value of a program whose last if fails",
        program: "7\n8 if x < 0",
        answers: &[
            answer(Number(7.0), "that of the statement before, as here"),
            answer(Number(0.0), "0: last-if=0"),
        ],
    },
    Probe {
        tag: "range-end",
        question: "whether 0, 0.1 .. 0.3 has its end, which 3 · 0.1 is just beyond",
        program: "y ← 0\nfor i ∈ 0, 0.1 .. 0.3\n  y ← y + 1\ny",
        answers: &[
            answer(Number(4.0), "ranges end with a tolerance, as here"),
            answer(Number(3.0), "ranges end exactly"),
        ],
    },
    Probe {
        tag: "sum-down",
        question: "a sum from 1 to 0",
        program: "∑(i ∈ 1 .. 0, 10 + i)",
        answers: &[answer(Number(0.0), "empty, as here"), answer(Number(21.0), "it counts down")],
    },
    Probe {
        tag: "unset-entry",
        question: "an entry of a local name without a value",
        program: "y ← z[1]\nz[1] ← 3\ny",
        answers: &[
            answer(Failure, "an error, as here"),
            answer(Number(0.0), "0, as the name itself"),
        ],
    },
    Probe {
        tag: "x87-sine",
        question: "sin(π), times 1e16",
        program: "sin(3.1415926535897931)·1E16",
        answers: &[
            answer(Number(1.224_606_353_822_377_3), "the sine is x87's, as here"),
            answer(Any, "the sine is another"),
        ],
    },
    Probe {
        tag: "x87-sum",
        question: "(1 + 2^-53) + 2^-53 − 1, times 2^53, held in 64 bits or in 80",
        program: "(1 + 2^−53 + 2^−53 − 1)·2^53",
        answers: &[
            answer(Number(0.0), "each step is rounded to 64 bits, as here"),
            answer(Number(2.0), "expressions are held in 80 bits"),
        ],
    },
    Probe {
        tag: "product-order",
        question: "(1 1e16 -1e16) · (1 1 1), added from the left or from the right",
        program: "(1   1E16   −1E16)·(1; 1; 1)",
        answers: &[
            answer(Number(0.0), "from the left, as here"),
            answer(Number(1.0), "from the right"),
        ],
    },
];

fn listing(probe: &Probe) -> Listing {
    let body = probe.program.replace('\n', "\n  ");
    let name = probe.tag.replace('-', "_");
    let text = format!("{name}(x) :=\n  {body}");
    Listing::parse("probe", &text).expect("the probes are sound")
}

/// Writes the worksheet of all probes.
pub fn worksheet() -> String {
    let mut page = Page::default();
    page.heading("plane-contact: questions to Mathcad / Вопросы к Mathcad");
    page.text(
        "Open this worksheet in Mathcad 14 or 15, let it calculate, save it, and send it: \
         plane-contact mathcad run FILE prints what it decides. Errors are answers too.\n\
         Откройте этот лист в Mathcad 14 или 15, дайте ему вычислиться, сохраните и пришлите: \
         plane-contact mathcad run FILE напечатает, что из него следует. Ошибки — тоже ответы.",
    );
    let v = ::mathcad::Array::column(vec![1.0, 2.0, 3.0]);
    page.define("v", write::matrix(&v), 3);
    for probe in &PROBES {
        let candidates = probe.answers.iter().map(|a| format!("{}: {}", shown(a), a.decides));
        let candidates = candidates.collect::<Vec<_>>().join("\n");
        page.text(&format!("{}\n{candidates}", probe.question));
        let program = listing(probe);
        page.program(&program);
        let call = format!("_() :=\n  {}(1)", program.function());
        let call = Listing::parse("probe", &call).expect("a call");
        page.evaluate(write::expression(&call), 1, &format!("probe {}", probe.tag));
    }
    page.finish("plane-contact: questions to Mathcad", &Settings::default())
}

fn shown(answer: &Answer) -> String {
    match answer.result {
        Number(x) => write::number(x),
        Failure => "error / ошибка".into(),
        Text => "a string / строка".into(),
        Any => "else / иначе".into(),
    }
}

/// Returns, for a worksheet of probes, what each saved result decides; nothing for another
/// worksheet.
pub fn decided(worksheet: &Worksheet, checked: &[ExecutedRegion]) -> Vec<(String, String)> {
    let mut decided = Vec::new();
    for probe in &PROBES {
        let tag = format!("probe {}", probe.tag);
        let is = |content: &Content| matches!(content, Content::Evaluation(_));
        let region = worksheet.regions.iter().find(|r| r.tag == tag && is(&r.content));
        let (Some(region), true) = (region, checked.iter().any(|c| c.tag == tag)) else {
            continue;
        };
        let fits = |answer: &&Answer| match (&answer.result, &region.saved) {
            (_, None) => false,
            (Number(x), Some(Saved::Value(Value::Number(y)))) => x == y,
            (Failure, Some(Saved::Error(_))) => true,
            (Text, Some(Saved::Value(Value::Text(_)))) => true,
            (Any, Some(_)) => true,
            _ => false,
        };
        let words = match (probe.answers.iter().find(fits), &region.saved) {
            (Some(answer), _) => answer.decides.to_string(),
            (None, None) => "nothing is saved: open it in Mathcad, and save it".into(),
            (None, Some(saved)) => format!("none of the candidates: {saved:?}"),
        };
        decided.push((probe.question.into(), words));
    }
    decided
}
