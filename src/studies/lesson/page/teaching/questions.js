// What comes next? Questions about a node or the next step, made from the trace: a hint before the answer, then why.

const score = { right: 0, asked: 0 };

/** The number that a reader types, with a decimal point or a comma; nothing where any character is no part of one. */
function numberIn(text) {
  const typed = text.trim().replace("−", "-").replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(typed) ? Number(typed) : null;
}

/** The question about the next step: its words, the answers to choose from or a number to type, the right one, a hint and
 * the reason; none where nothing is decided. */
function question(machine, mesh) {
  const step = machine.next;
  if (!step) return null;
  const { number, text } = machine.lines[step.line];
  const hint = () => [t("Given:") + " ", ...accesses(step.reads, "=")];
  const gap = step.writes.find(({ name, value }) => /^yt\[/.test(name) && isNumber(value) && value !== 0);
  if (gap) return { words: t("Line {number}: what will {name} be?", { number, name: gap.name }), hint, number: gap.value, right: short(gap.value), reason: `${text}.` };
  if (step.held !== null) {
    const condition = text.includes(" if ") ? text.split(" if ")[1] : text.replace(/^if /, "");
    return {
      words: t("Line {number}: will “{condition}” hold?", { number, condition }),
      hint,
      answers: [t("yes"), t("no")],
      right: step.held ? t("yes") : t("no"),
      reason: reasonOf(step),
    };
  }
  const turn = machine.turnAt(machine.at);
  const begins = turn !== null && !run().programs && text.includes("rows(cnt)") && machine.turnAt(machine.at - 1) !== turn;
  return begins && machine.get(`ct[${turn}]`) === undefined ? edgeQuestion(machine, mesh, turn) : null;
}

/** Why a condition holds or does not: of an ∧ each operand, else what was compared. */
function reasonOf({ operands, reads, held }) {
  if (operands.length === 0) return t("It compares {values}.", { values: [...new Set(reads.map(({ name, value }) => `${name} = ${brief(value)}`))].join("; ") });
  const words = operands.map(([text, holds]) => `${text} ${t("is")} ${holds === null ? t("not to be evaluated") : holds ? t("true") : t("false")}`).join("; ");
  return `${words}. ${held ? t("All operands are true.") : t("One operand that is false is enough.")}`;
}

/** Which target edge the search of a turn ends with, and which boxes had the node. */
function edgeQuestion(machine, mesh, turn) {
  const end = machine.turns.find(({ from }) => from > machine.at)?.from ?? machine.steps.length;
  const name = `ct[${turn}]`;
  const writes = machine.steps.slice(machine.at, end).flatMap((step) => step.writes.filter((write) => write.name === name));
  const hits = writes.map(({ value }) => value).filter((edge) => edge !== 0);
  const inWords = (edge) => (edge === 0 ? t("none") : t("edge {edge}", { edge }));
  const [x, y] = mesh.at(mesh.contact[turn - 1]).map(short);
  return {
    words: t("Which target edge will node {node} get (lines 4 to 7)?", { node: mesh.name(mesh.contact[turn - 1]) }),
    hint: () => [t("The node is at x = {x}, y = {y}. A box reaches from one end of an edge to the other and c_tll farther; the edges are tried in the order of trg.", { x, y })],
    answers: [0, ...mesh.edges.map(([number]) => number)].slice(0, 12).map(inWords),
    right: inWords(writes.at(-1)?.value ?? 0),
    reason: hits.length
      ? t("The boxes that hold the node, in the order of trg: {boxes}. The last one stays (C2).", { boxes: hits.map(inWords).join(", ") })
      : t("No box of lines 5 and 6 holds the node."),
  };
}

/** Shows the question about the next step, where questions are wanted; before the first step, that about the nodes. */
function ask(machine, mesh) {
  const place = byId("question");
  const isOpening = machine.at === 0 && page.which === "c_cnt" && !run().programs && machine.steps.length > 0;
  const asked = isOpening && page.asked < mesh.contact.length ? nodeQuestion(mesh, page.asked) : byId("ask").checked ? question(machine, mesh) : null;
  place.hidden = !asked;
  const key = asked && JSON.stringify([asked.words, asked.reason, page.chapter, page.run, page.which, machine.at]);
  // A question that stands stays as far as it was answered.
  const isNew = page.question !== key;
  page.question = key;
  if (asked && isNew) pose(asked, place);
}

/** Writes a question with its answers, the hint folded, and room for the verdict. */
function pose(asked, place) {
  const verdict = make("p", { role: "status" });
  const hint = make("p", { hidden: true });
  const answered = (isRight) => {
    score.asked += 1;
    score.right += isRight ? 1 : 0;
    for (const other of place.querySelectorAll(".answer")) other.disabled = true;
    verdict.textContent = `${isRight ? t("Right.") : t("No: the answer is {right}.", asked)} ${asked.reason} ${t("({right} of {asked} right)", score)}${asked.isLast ? ` ${t("That was the last node. Now step through the listing and see why.")}` : ""}`;
    showConclusion();
    if (asked.next) verdict.append(" ", button(t("next"), asked.next));
    lightLine(page.machine);
    // The button that had the focus is disabled.
    (verdict.querySelector("button") ?? byId("forward")).focus();
    verdict.scrollIntoView({ block: "nearest" });
  };
  const showHint = button(t("hint"), () => {
    hint.replaceChildren(...asked.hint());
    hint.hidden = false;
  });
  const answers = asked.number === undefined ? asked.answers.map((text) => button(text, () => answered(text === asked.right), { class: "answer" })) : numberToType(asked, answered, verdict);
  byId("below").scrollTop = 0;
  const tour = asked.next ? [button(t("tour: five steps"), () => showTour(0))] : [];
  place.replaceChildren(make("h3", {}, asked.title ?? t("What comes next?")), make("p", {}, asked.words), make("p", { class: "answers" }, ...answers, showHint, ...tour), hint, verdict);
}

/** A number to type: what is none is said, and nothing of it is dropped. It is right to a hundredth of its size. */
function numberToType({ number }, answered, verdict) {
  const typed = make("input", { type: "text", inputmode: "decimal", class: "answer", size: 10, "aria-label": t("your answer") });
  const judge = () => {
    const value = numberIn(typed.value);
    if (value !== null) return answered(Math.abs(value - number) <= 0.01 * Math.abs(number));
    verdict.textContent = t("“{text}” is not a number.", { text: typed.value });
    lightLine(page.machine);
  };
  typed.addEventListener("keydown", ({ key }) => key === "Enter" && judge());
  return [typed, button(t("check"), judge, { class: "answer" })];
}

/** Before any step, one contact node at a time: will c_cnt find it in contact? */
function nodeQuestion(mesh, k) {
  const end = atEnd(page.programs.c_cnt);
  const node = contactNodes(mesh, end)[k];
  const where = fromTarget(mesh, node.node);
  const name = mesh.name(node.node);
  const distance = short(Number(where.distance.toPrecision(3)));
  return {
    title: t("Which nodes touch? Node {k} of {count}", { k: k + 1, count: mesh.contact.length }),
    words: t("Look at the contact zone. Will c_cnt find node {name} in contact?", { name }),
    hint: () => [(where.isInside ? t("It is {distance} inside the target.", { distance }) : t("It is {distance} away from the target.", { distance })) + " " + t("Ask the listing in turn: does a box of lines 5 and 6 hold the node? Is |yt| below c_tll = {c_tll} (line 16)? Else, does yt change its sign towards a neighbour, as lines 17 and 18 want?", { c_tll: page.programs.c_tll })],
    answers: [t("yes"), t("no")],
    right: node.dy === 1 ? t("yes") : t("no"),
    reason: end.failure ? t("The listing stops: {failure}", end) : whyOf(mesh, end, node),
    isLast: k + 1 === mesh.contact.length,
    next: () => {
      page.asked = k + 1;
      show();
      (byId("question").querySelector("button") ?? byId("forward")).focus();
    },
  };
}

/** Why c_cnt finds a node in contact or misses it: where it is, and what the lines that decide on it say. */
function whyOf(mesh, end, { node, place, dy, ct, yt }) {
  const where = fromTarget(mesh, node);
  const others = mesh.contact.map((n) => fromTarget(mesh, n)).filter(({ isInside }) => isInside);
  const values = { name: mesh.name(node), distance: Number(where.distance.toPrecision(3)), c_tll: page.programs.c_tll };
  const isDeepest = where.isInside && others.every(({ distance }) => distance <= where.distance);
  const isFar = where.distance > page.programs.c_tll;
  const at = isDeepest ? t("{name} is the deepest, {distance} inside the target", values) : where.isInside ? t("{name} is {distance} inside the target", values) : t("{name} is {distance} away from the target", values);
  const verdict = dy === 1 ? (isFar && !where.isInside ? t("and is taken all the same") : t("and is found")) : where.isInside ? t("and is missed") : isFar ? t("and is left out") : t("and is left out all the same");
  if (!(ct > 0)) return `${at}, ${verdict}: ${isFar ? t("lines 5 to 7 look no further than c_tll = {c_tll} around an edge", values) : t("no box of lines 5 and 6 holds it, although it is nearer than c_tll = {c_tll}", values)}.`;
  const decisions = end.steps.filter((step, k) => step.held !== null && end.turnAt(k) === place && /^dy\[\w+\] ← 1/.test(end.lines[step.line].text));
  const said = decisions.map(({ line, held, operands }) => {
    const wrong = operands.find(([, holds]) => holds === false)?.[0];
    const { number } = end.lines[line];
    return held ? t("line {number} holds", { number }) : wrong ? t("line {number} wants {wrong}", { number, wrong }) : t("line {number} does not hold", { number });
  });
  const decisive = said.filter((_, k) => dy !== 1 || decisions[k].held);
  return `${at}, ${verdict}: ${[`yt = ${short(yt)}`, ...decisive].join("; ")}.`;
}
