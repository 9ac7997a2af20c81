// The listing, its current line lit, and what the last step read, decided and wrote.

/** Builds the lines; the number of a line runs to it. Lines that are not as before, in the print or after a
 * repair less, are marked. */
function showLines(machine, before, runTo) {
  const list = byId("listing");
  const words = ({ level, text }) => `${level} ${text}`;
  const same = commonPlaces(machine.lines.map(words), before.map(words));
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
  const { last, next } = machine;
  const items = byId("listing").children;
  [...items].forEach((item, k) => {
    k === last?.line ? item.setAttribute("aria-current", "step") : item.removeAttribute("aria-current");
    item.classList.toggle("next", k === next?.line);
  });
  const lit = items[last?.line];
  showLegend(machine);
  const box = byId("listing-box");
  const top = lit ? lit.offsetTop - box.offsetTop : 0;
  if (top < box.scrollTop || top + (lit?.offsetHeight ?? 0) > box.scrollTop + box.clientHeight) box.scrollTop = top - box.clientHeight / 3;
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
  if (!step) return byId("step").replaceChildren(make("p", { class: "muted" }, t("Nothing is executed yet.")));
  const rows = [
    [t("line"), String(machine.lines[step.line].number)],
    ...(step.reads.length ? [[t("reads"), ...accesses(step.reads, "=")]] : []),
    ...step.operands.map(([text, held]) => ["∧", make("code", {}, text), ` ${t("is")} `, truth(held)]),
    ...(step.held === null ? [] : [[t("decision"), t("the condition is") + " ", truth(step.held)]]),
    ...(step.writes.length ? [[t("writes"), ...accesses(step.writes, "←")]] : []),
  ];
  byId("step").replaceChildren(described(rows));
}
