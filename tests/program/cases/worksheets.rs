//! Worksheets and programs in the notation of the listings.

use super::{Case, check};

#[test]
fn worksheets() {
    check("worksheets", CASES);
}

/// A row whose command ends with exit status 0, or with the one behind `->`.
macro_rules! case {
    ($input:literal, $command:expr, [$($has:literal),*], [$($lacks:literal),*]) => {
        case!($input, $command => 0, [$($has),*], [$($lacks),*])
    };
    ($input:literal, $command:expr => $status:literal, [$($has:literal),*], [$($lacks:literal),*]) => {
        Case {
            input: $input,
            command: $command,
            status: $status,
            contains: &[$($has),*],
            lacks: &[$($lacks),*],
        }
    };
}

/// Writes the text of a program to p.txt and executes a call of it.
macro_rules! program {
    ($text:literal, $call:literal) => {
        concat!(
            "printf '",
            $text,
            "' > p.txt && plane-contact listing evaluate p.txt --call '",
            $call,
            "'"
        )
    };
}

const CASES: &[Case] = &[
    // A function's names are those above its definition, its own name too.
    case!("public", "plane-contact mathcad run bind-variable.xmcd", ["1 results same"], []),
    case!("public", "plane-contact mathcad run bind-function.xmcd", ["1 results same"], []),
    case!("public", "plane-contact mathcad run bind-self.xmcd", ["1 results same"], []),
    // Mathematics within text counts.
    case!("public", "plane-contact mathcad run text.xmcd", ["2 results same", "0 differ"], []),
    // What is no plain name on the left side, or comes from a component, loses its old value.
    case!("public", "plane-contact mathcad run left-side.xmcd", ["8 results same", "0 differ"], []),
    case!(
        "public",
        "plane-contact mathcad run component.xmcd" => 1,
        ["unsupported: a component (it rests on D)", "0 differ", "3 are unsupported"],
        []
    ),
    // A result shown in a unit is neither compared nor goes on as input.
    case!(
        "public",
        "plane-contact mathcad run override.xmcd" => 1,
        ["unsupported: units: %", "0 differ", "4 are unsupported"],
        ["as input"]
    ),
    // A number over a column.
    case!("public", "plane-contact mathcad run over-column.xmcd", ["2 results same"], []),
    // Loops over range variables, vectors and lists.
    case!(
        "for-over-a-range-variable",
        "plane-contact mathcad run range-for.xmcd",
        ["1 results same"],
        ["unsupported:"]
    ),
    case!(
        "for-over-a-range-variable",
        "plane-contact mathcad run range-for-inline.xmcd",
        ["1 results same"],
        []
    ),
    case!(
        "for-over-a-range-variable",
        "plane-contact mathcad run for-list.xmcd",
        ["1 results same"],
        []
    ),
    case!(
        "for-over-a-range-variable",
        "plane-contact listing evaluate lst.txt --call 'f(1)'",
        ["15\n"],
        []
    ),
    case!(
        "",
        program!(
            "f(v) :=\n  s <- 0\n  for x in v, 7, (1 2; 3 4)\n    s <- 10*s + x\n  s\n",
            "f(9)"
        ),
        ["971324\n"],
        []
    ),
    case!("", program!("f(v) :=\n  s <- 0\n  for x in 1, 2, 3 .. 9\n    s <- s + x\n  s\n", "f(9)") => 2, ["a range within a list"], []),
    case!(
        "",
        program!("f(v) :=\n  s <- \"\"\n  for x in \"a\", \"b\"\n    s <- x\n  s\n", "f(1)"),
        ["b\n"],
        []
    ),
    // Strings compared.
    case!(
        "strings-compared",
        "plane-contact mathcad run string-eq.xmcd",
        ["0 differ"],
        ["Expected a number", "unsupported:"]
    ),
    case!(
        "strings-compared",
        "plane-contact mathcad run string-order.xmcd",
        ["1 results same"],
        []
    ),
    case!(
        "strings-compared",
        "plane-contact listing evaluate streq.txt --call 'f(\"yes\")'",
        ["2\n"],
        []
    ),
    case!(
        "strings-compared",
        "plane-contact listing evaluate streq.txt --call 'f(\"no\")'",
        ["1\n"],
        []
    ),
    case!("strings-compared", "plane-contact listing evaluate streq.txt --call 'f(3)'" => 2, ["Expected a number, found a string"], []),
    case!(
        "",
        program!(
            "f(x) := (\"Z\" < \"a\") + (\"a\" <= \"a\") + (\"b\" != \"a\") + (\"a\" > \"я\")",
            "f(0)"
        ),
        ["3\n"],
        []
    ),
    case!("", program!("f(x) := \"a\" < \"b\" < \"c\"", "f(0)"), ["1\n"], []),
    case!("", program!("f(x) := \"a\" = x", "f(1)") => 2, ["Expected a string, found the number 1"], []),
    // The function if.
    case!(
        "the-function-if",
        "plane-contact mathcad run if-function.xmcd",
        ["if(x > 2,10,20) =", "3 results same", "0 differ"],
        ["unsupported:"]
    ),
    case!(
        "the-function-if",
        "plane-contact listing evaluate iffun.txt --call 'f(-3)'",
        ["9\n"],
        []
    ),
    case!(
        "",
        program!("f(x) := if(x = 0, 1, 1 / x) + if(if(x > 5, 0, 1), 10, (1 2)[9])", "f(0)"),
        ["11\n"],
        []
    ),
    case!("", program!("f(n) := if(n <= 1, 1, n*f(n - 1))", "f(6)"), ["720\n"], []),
    case!(
        "",
        program!(
            "f(x) :=\n  if(x > 1)\n    return if(x > 2, \"big\", \"small\") if (x > 1)\n  0\n",
            "f(2)"
        ),
        ["small\n"],
        []
    ),
    case!("", program!("f(x) := (1 if(x, 2, 3) if(0, 4, 5))", "f(1)"), ["1 2 5\n"], []),
    case!("", program!("f(x) := if(x, 1)", "f(1)") => 2, ["line 1"], ["panicked"]),
    // Units.
    case!(
        "units-called-undefined",
        "plane-contact mathcad run units.xmcd",
        [
            "unsupported: units: cm",
            "unsupported: units: m",
            "unsupported: units: cm (it rests on b)",
            "1 results same"
        ],
        ["not defined"]
    ),
    case!("", program!("f(x) := 3*cm", "f(1)") => 2, ["unsupported: units: cm"], ["not defined", "correct the program"]),
    case!("", program!("f(cm) := 3*cm", "f(2)"), ["6\n"], []),
    // In a call it is a name that --inputs lacks.
    case!("", program!("f(m) := 3*m", "f(m)") => 2, ["m is not defined", "--inputs"], ["unsupported", "panicked"]),
    case!("", "printf 'f(A) := 3*A' > p.txt && plane-contact listing evaluate p.txt" => 2, ["A is not defined", "--inputs"], ["unsupported"]),
    case!(
        "",
        "printf 'f(A) := 3*A' > p.txt && plane-contact listing evaluate p.txt --inputs '{\"A\": 2}'",
        ["6\n"],
        []
    ),
    // The listings take the contact nodes as the scene lists them, whatever its variant; a listing's name is compared whole.
    case!(
        "",
        "plane-contact scene copy fig1 --out s >log; for variant in tied unilateral; do \
         sed \"s/5, 6, 7, 8, 9/9, 8, 7, 6, 5, 9/; s/stepped/$variant/\" s/scene.json >s/$variant.json; \
         plane-contact listing run c_cnt s/$variant.json --json | sed 's/.*\"cnt\"/\"cnt\"/; s/,\"k_cnt.*//' || exit; \
         plane-contact listing run Km s/$variant.json | grep -v scene | cksum; done | sort | uniq -c",
        ["2 \"cnt\":[9,8,7,6,5,9],\"ct\":[3,3,2,2,1,3],", "\"dy\":[1,0,1,1,1,1]"],
        []
    ),
    case!(
        "",
        "for name in Kmeans c_cnts Km2 Km_ kM; do printf \"$name(x) :=\\n  x\\n\" > p.txt; \
         plane-contact listing run Km fig1 --listing p.txt; echo $name $?; done; \
         plane-contact solve fig1 --variant tied --no-pictures --out o --km p.txt" => 2,
        ["begins with neither c_cnt nor Km", "Kmeans 2", "c_cnts 2", "Km2 2", "Km_ 2", "kM 2"],
        ["panicked"]
    ),
    case!(
        "",
        "printf 'f(x) := x*kN' > p.txt && plane-contact listing evaluate p.txt --call 'f(2)' --inputs '{\"kN\": 3}'",
        ["6\n"],
        []
    ),
    // Functions that are not had.
    case!(
        "root-called-x",
        "plane-contact mathcad run root.xmcd",
        ["unsupported: the function root"],
        ["`x`", "not defined"]
    ),
    case!(
        "root-called-x",
        "plane-contact mathcad run builtins.xmcd",
        ["0 differ"],
        ["not defined"]
    ),
    case!("", program!("f(x) := root(g(y), y, 0, 1)", "f(1)") => 2, ["unsupported: the function root"], ["not defined", "correct the program"]),
    case!("", program!("f(x) := √(x)", "f(-1)") => 2, ["unsupported: complex numbers"], ["correct the program"]),
    case!("", program!("f(x) := h(x)", "f(1)") => 2, ["not defined above: h", "correct the program or its inputs"], ["unsupported"]),
    case!(
        "what-evaluate-lacks",
        "plane-contact listing evaluate ex.txt --call 'f(v)' --inputs '{\"v\":[3,1,2]}'",
        ["6\n"],
        []
    ),
    case!(
        "what-evaluate-lacks",
        "plane-contact listing evaluate othr3.txt --call 'f(1)'",
        ["1.7320508075688772\n"],
        []
    ),
    case!(
        "what-evaluate-lacks",
        "plane-contact listing evaluate othr3.txt --call 'f(3)'",
        ["1\n"],
        []
    ),
    case!(
        "what-evaluate-lacks",
        "plane-contact listing evaluate sq.txt --call 'f(4)'",
        ["2\n"],
        []
    ),
    case!("", program!("f(x) := x\n  x + 1\n", "f(1)") => 2, ["a function whose body stands behind `:=`", "line 2 of the file"], []),
    case!("", program!("f(x) := while x\n", "f(1)") => 2, ["expected it indented below"], []),
    case!("", program!("f(x) := g(x)\ng(x) := y <- 2*x\n", "f(4)"), ["8\n"], []),
    // Exit status.
    case!("exit-status-of-mathcad", "plane-contact mathcad run differs.xmcd" => 1, ["1 differ"], []),
    case!("exit-status-of-mathcad", "plane-contact mathcad run differs.xmcd --json" => 1, ["\"differs\""], []),
    case!("", "plane-contact mathcad run --help", ["The exit status also tells"], []),
    // Packed worksheets.
    case!(
        "for-over-a-range-variable",
        "gzip < range-for.xmcd > r.xmcdz && plane-contact mathcad run r.xmcdz",
        ["1 results same"],
        []
    ),
    case!("", "head -c 90000000 /dev/zero | gzip > r.xmcdz && plane-contact mathcad run r.xmcdz" => 2, ["more than 67108864 bytes"], []),
    case!("", "printf '\\037\\213xx' > r.xmcdz && plane-contact mathcad run r.xmcdz" => 2, ["cannot be read"], []),
    // Limits.
    case!("steps-do-not-bound-time", "timeout 60 plane-contact listing evaluate listing.txt --call 'f(1)' --limit 100000000" => 2, ["The limit of 100000000 steps is reached", "--limit"], []),
    case!("", program!("f(x) :=\n  while 1\n    try\n      g(x)\n    on error\n      0\ng(x) :=\n  for i in 1 .. 1000000\n    y <- i\n  y[3]\n", "f(1)' --limit '10000000") => 2, ["The limit of 10000000 steps"], []),
    case!(
        "",
        "python3 -c \"print('f(x) :=\\n  ' + '0<(0<'*30 + 'x' + '<1)<1'*30)\" > p.txt && timeout 20 plane-contact listing evaluate p.txt --call 'f(1)'",
        ["0\n"],
        []
    ),
    case!("", "python3 -c \"print('f(x) :=\\n  y <- ' + 'x['*40 + '1 2' + ']'*40)\" > p.txt && timeout 20 plane-contact listing evaluate p.txt --call 'f(1)'" => 2, ["found `2`"], []),
    case!("", "python3 -c \"print('f(x) :=\\n' + '  x\\n' * 6000000)\" > p.txt && ulimit -v 8000000 && plane-contact listing evaluate p.txt --call 'f(1)'" => 2, ["more than 16777216 bytes"], []),
    case!("", "python3 -c \"print('f(x) :=\\n' + '  x\\n' * 3000000)\" > p.txt && ulimit -v 8000000 && plane-contact listing evaluate p.txt --call 'f(1)'" => 2, ["at most 1000"], []),
    case!("", "python3 -c \"print('<worksheet ' + ' '.join('a%d=\\\"1\\\"' % i for i in range(200000)) + '/>')\" > a.xmcd && timeout 10 plane-contact mathcad run a.xmcd" => 2, ["more than 64 attributes"], []),
    case!("", "python3 -c \"print('<worksheet>' + ''.join('<a xmlns:a%d=\\\"1\\\">' % i for i in range(60000)))\" > a.xmcd && timeout 10 plane-contact mathcad run a.xmcd" => 2, ["more than 64 namespaces"], []),
    case!(
        "",
        "python3 -c \"print(''.join('f%d(x) :=\\n  x\\n' % i for i in range(10000)))\" > p.txt && timeout 30 plane-contact listing evaluate p.txt --call 'f9999(7)'",
        ["7\n"],
        []
    ),
];
