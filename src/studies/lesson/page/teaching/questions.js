// What comes next? Questions about the next step, made from the trace, with the reason of the answer.

const score = { right: 0, asked: 0 };

/** The question about the next step: its words, the answers to choose from, the right one and the
 * reason; none where nothing is decided. */
function question(machine, mesh) {
  const step = machine.next;
  if (!step) return null;
  const { number, text } = machine.lines[step.line];
  if (step.held !== null) {
    const condition = text.includes(" if ") ? text.split(" if ")[1] : text.replace(/^if /, "");
    return {
      words: t("Line {number}: will “{condition}” hold?", { number, condition }),
      given: step.reads,
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
  if (operands.length === 0) return t("It compares {values}.", { values: [...new Set(reads.map(({ name, value }) => `${name} = ${brief(value)}`))].join(", ") });
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
  return {
    words: t("Which target edge will node {node} get (lines 4 to 7)?", { node: mesh.name(mesh.contact[turn - 1]) }),
    given: [],
    answers: [0, ...mesh.edges.map(([number]) => number)].slice(0, 12).map(inWords),
    right: inWords(writes.at(-1)?.value ?? 0),
    reason: hits.length
      ? t("The boxes that hold the node, in the order of trg: {boxes}. The last one stays (C2).", { boxes: hits.map(inWords).join(", ") })
      : t("No box of lines 5 and 6 holds the node."),
  };
}

/** Shows the question about the next step, where questions are wanted. */
function ask(machine, mesh) {
  const place = byId("question");
  const asked = byId("ask").checked ? question(machine, mesh) : null;
  place.hidden = !asked;
  if (!asked) return;
  const verdict = make("p", { role: "status" });
  const buttons = asked.answers.map((text) =>
    button(text, () => {
      const isRight = text === asked.right;
      score.asked += 1;
      score.right += isRight ? 1 : 0;
      for (const other of buttons) other.disabled = true;
      verdict.textContent = `${isRight ? t("Right.") : t("No: {right}.", asked)} ${asked.reason} ${t("({right} of {asked} right)", score)}`;
      lightLine(machine);
      verdict.scrollIntoView({ block: "nearest" });
    }),
  );
  const given = asked.given.length ? [make("p", {}, t("Given:") + " ", ...accesses(asked.given, "="))] : [];
  byId("below").scrollTop = 0;
  place.replaceChildren(make("h3", {}, t("What comes next?")), make("p", {}, asked.words), make("p", { class: "answers" }, ...buttons), verdict, ...given);
}
