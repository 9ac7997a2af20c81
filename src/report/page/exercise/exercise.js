// The exercise: the scene in tables, and the answers as a file.

const ASKED = ["ct", "dy", "k1"];

function answerRow(node) {
  const input = (of) => make("input", { type: "number", step: "any", required: true, "data-node": node, "data-of": of, "aria-label": t("{of} of node {node}", { of, node }) });
  return make("tr", {}, make("th", { scope: "row" }, String(node)), ...ASKED.map((of) => make("td", {}, input(of))));
}

/** The answers as they are typed. */
function answers() {
  const of = (node, what) => Number(document.querySelector(`[data-node="${node}"][data-of="${what}"]`).value);
  return {
    kind: data.kind, exercise: data.exercise, seed: data.seed, student: byId("student").value,
    answers: data.contact.map((node) => ({ node, ...Object.fromEntries(ASKED.map((what) => [what, of(node, what)])) })),
  };
}

function save(event) {
  event.preventDefault();
  const text = JSON.stringify(answers(), null, 2) + "\n";
  const link = make("a", { download: `answers-${data.exercise}.json`, href: URL.createObjectURL(new Blob([text], { type: "application/json" })) });
  link.click();
  byId("saved").textContent = t("Saved: hand in the file.");
}

byId("title").textContent = document.title;
byId("listing").append(
  ...data.listing.map(([number, level, text]) => make("li", {}, make("span", {}, String(number)), make("code", { style: `--level: ${level}` }, text))),
);
byId("picture").src = `data:image/svg+xml;base64,${data.picture}`;
byId("scene").append(
  make("p", {}, `c_tll = ${data.c_tll}; cnt = (${data.contact.join("  ")}); trg = (${data.edges.map(([number]) => number).join("  ")})`),
  tableOf("node", [[t("node"), ([n]) => n], ["x", ([, [x]]) => x.toFixed(2)], ["y", ([, [, y]]) => y.toFixed(2)]], data.nodes),
  tableOf(t("elem: the target edges"), [[t("number"), ([n]) => n], [t("column {n}", { n: 6 }), ([, [a]]) => a], [t("column {n}", { n: 7 }), ([, [, b]]) => b]], data.edges),
);
byId("answers").append(make("table", {}, headOf([t("node"), ...ASKED]), make("tbody", {}, ...data.contact.map(answerRow))));
byId("form").addEventListener("submit", save);
showExactValues();
