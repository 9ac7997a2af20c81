// node page_moves.cjs PAGE SITUATIONS: drags nodes, edits listings and switches readings in the scripts of a
// lesson as its page does, compares every statement with its digest, and steps at random in between: after each
// move the values are those of a machine that went there from the start. Prints what differs, or the counts.

const fs = require("node:fs");
const digests = require("./page_digest.cjs");

const [text, situations] = process.argv.slice(2).map((path) => fs.readFileSync(path, "utf8"));
const part = (from) => text.split(from)[1].split("</script>")[0];
const [json, script] = [part('id="data">'), part('<script type="module">').split("// The page: what is chosen")[0]];
const document = { getElementById: () => ({ textContent: json }) };
const page = new Function("document", `${script}\nreturn { data, Machine, Mesh, Programs, isArray };`)(document);
const Digest = digests(page);

const counts = { moves: 0, compared: 0, failed: 0, limited: 0 };

/** A generator of numbers from 0 to 1 that are the same on every run (Park and Miller). */
let state = 46;
const drawn = () => ((state = (state * 48271) % 2147483647), state / 2147483647);

/** What a program does otherwise than its case; nothing where it does the same. */
function difference(program, of) {
  if (of.is_limit || program.failure?.isLimit) return void (counts.limited += 1);
  const ends = program.steps.map((step) => new Digest().executed(program.lines[step.line], step).result);
  const first = of.steps.findIndex((digest, k) => digest !== ends[k]);
  if (first >= 0 || ends.length !== of.steps.length) return `step ${first} of ${ends.length}`;
  if (String(program.failure ?? null) !== String(of.failure)) return `${program.failure} for ${of.failure}`;
  if (!program.failure && new Digest().value(program.value).result !== of.value) return "the value";
  counts.compared += 1;
  counts.failed += program.failure ? 1 : 0;
}

const MOVES = [
  (machine) => machine.at + 1,
  (machine) => machine.at - 1,
  (machine) => machine.over(),
  (machine) => machine.nextDecision(),
  (machine) => machine.nextTurn(),
  (machine) => machine.runTo(Math.floor(drawn() * machine.lines.length)),
  (machine) => Math.floor(drawn() * (machine.steps.length + 1)),
];

/** Nine moves in a program, each compared with a machine that goes there at once. */
function walk(program) {
  const machine = new page.Machine(program);
  for (let k = 0; k < 9; k += 1) {
    machine.goTo(MOVES[Math.floor(drawn() * MOVES.length)](machine));
    counts.moves += 1;
    const straight = new page.Machine(program);
    straight.goTo(machine.at);
    const values = (of) => JSON.stringify([...of.values].sort());
    if (values(machine) !== values(straight)) return `the values after step ${machine.at}`;
  }
}

const chapter = page.data.scenes[0];
for (const [k, { run, moved, factor, edits, c_cnt, km }] of JSON.parse(situations).entries()) {
  counts.moves += 1;
  const chosen = chapter.runs[run];
  const mesh = new page.Mesh(page.data.meshes[chosen.mesh], chapter.units, new Map(moved));
  const places = new Map(Object.entries(edits).map(([name, text]) => [chosen[name], text]));
  const programs = new page.Programs(chosen, mesh, chapter.nodes, factor * chosen.c_tll, places);
  const pairs = [["c_cnt", c_cnt], ["Km", programs.c_cnt.failure ? null : km]].filter(([, of]) => of);
  for (const [name, of] of pairs) {
    const differs = difference(programs[name], of) ?? walk(programs[name]);
    if (differs === undefined) continue;
    console.log(JSON.stringify({ differs: `situation ${k}, ${name}: ${differs}`, run, moved, factor, edits }));
    process.exit(0);
  }
}
console.log(JSON.stringify(counts));
