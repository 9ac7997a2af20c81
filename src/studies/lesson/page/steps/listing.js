// The listing, its current line lit, and what the last step read, decided and wrote.

/** Builds the lines; the number of a line runs to it. Lines that are not as before, in the print or after a
 * repair less, are marked. */
function showLines(machine, before, runTo) {
  const list = byId("listing");
  const words = ({ level, text }) => `${level} ${text}`;
  const same = placesAsPrinted(machine.lines.map(words), before.map(words));
  const changed = run().programs ? t("changed:") : t("not as printed:");
  list.replaceChildren(
    ...machine.lines.map((line, place) => {
      const number = button(String(line.number), () => runTo(place), { "aria-label": t("run to line {number}", line) });
      const text = make("code", { style: `--level: ${line.level}` }, line.text);
      const mark = same.has(place) ? [] : [make("span", { class: "unseen" }, changed + " ")];
      return make("li", { class: same.has(place) ? undefined : "edited" }, number, ...mark, text);
    }),
  );
  roving(list, "button");
}

/** Says what the colours of the lines mean, of those that are there. */
function showLegend(machine) {
  const is = (name) => [...byId("listing").children].some((item) => item.classList.contains(name));
  byId("legend").replaceChildren(
    ...(machine.last ? [make("span", { class: "lit" }, t("yellow: executed last")), " "] : []),
    ...(machine.next ? [make("span", { class: "bar" }, t("red bar: comes next")), " "] : []),
    ...(is("edited") ? [make("span", { class: "blue" }, run().programs ? t("blue: changed by the last repair") : t("blue: not as printed"))] : []),
  );
}

/** Lights the line that was executed last and marks the next; keeps them in sight. */
function lightLine(machine) {
  const items = byId("listing").children;
  for (const item of items) {
    item.removeAttribute("aria-current");
    item.classList.remove("next");
  }
  if (machine.next) items[machine.next.line].classList.add("next");
  const lit = machine.last && items[machine.last.line];
  lit?.setAttribute("aria-current", "step");
  showLegend(machine);
  const seen = lit ?? items[0];
  if (!seen) return;
  const box = byId("listing-box");
  const top = seen.offsetTop - box.offsetTop;
  if (top < box.scrollTop || top + seen.offsetHeight > box.scrollTop + box.clientHeight) { box.scrollTop = top - box.clientHeight / 3; }
}

/** Writes accesses, each with its exact value at hand. */
function accesses(list, sign) {
  return list.map(({ name, value }) =>
    make("span", { class: "access", "data-exact": exact(value) }, `${name} ${sign} ${brief(value)}`),
  );
}

const truth = (held) => make("span", { class: String(held) }, held === null ? t("not evaluated") : held ? t("true") : t("false"));

/** The last step in words: "line 16: dy 3 becomes 1". */
function stepInWords({ lines, last }) {
  if (!last) return "";
  const written = last.writes.map(({ name, value }) => t("{name} becomes {value}", { name: name.replace(/[[\],]+/g, " ").trim(), value: brief(value) }));
  const decided = last.held === null ? [] : [t("the condition is {held}", { held: last.held ? t("true") : t("false") })];
  return t("line {line}: {what}", { line: lines[last.line].number, what: [...decided, ...written].join(", ") || t("nothing is written") });
}

/** Writes what the last step did. */
function showStep(machine) {
  const step = machine.last;
  say("said", stepInWords(machine));
  const rows = [];
  const row = (term, ...content) => rows.push(make("dt", {}, term), make("dd", {}, ...content));
  if (!step) {
    byId("step").replaceChildren(make("p", { class: "muted" }, t("Nothing is executed yet.")));
    return;
  }
  row(t("line"), String(machine.lines[step.line].number));
  if (step.reads.length) row(t("reads"), ...accesses(step.reads, "="));
  for (const [text, held] of step.operands) row("∧", make("code", {}, text), ` ${t("is")} `, truth(held));
  if (step.held !== null) row(t("decision"), t("the condition is") + " ", truth(step.held));
  if (step.writes.length) row(t("writes"), ...accesses(step.writes, "←"));
  byId("step").replaceChildren(make("dl", {}, ...rows));
}
