// The first minute: a tour of five steps, and what each array is.

/** The steps of the tour: what is looked at, and what is said of it. */
const tourSteps = () => [
  ["#pictures", t("The stamp stands above the target, heights magnified. The green band reaches c_tll above and below each edge. Which nodes touch?")],
  ["#listing-box", t("c_cnt answers line by line, as the paper prints it. The key → makes a step, ← takes it back, N runs to the next node.")],
  ["#values", t("What the lines write stands here: ct, yt, dy, k_cnt. Pointer or focus on a value says what its array is.")],
  ["#tolerance", t("Change something: move c_tll, drag a node, choose a reading, edit the listing. Everything follows at once.")],
  ["fieldset", t("Km assembles the stiffness matrix, the iterations make all twenty of them. Each chapter shows what goes wrong at one place.")],
];

/** Shows a step of the tour beside what it explains, which it never covers; nothing behind the last. */
function showTour(k) {
  byId("tour")?.remove();
  document.querySelector(".toured")?.classList.remove("toured");
  const [selector, words] = tourSteps()[k] ?? [];
  if (!selector) return;
  const place = document.querySelector(selector);
  place.classList.add("toured");
  if (place.closest("details")) place.closest("details").open = true;
  place.scrollIntoView({ block: "nearest" });
  const leading = (text, to) => button(text, () => showTour(to), { disabled: to < 0 });
  const isLast = k === tourSteps().length - 1;
  const next = leading(isLast ? t("close") : t("next"), k + 1);
  const close = isLast ? [] : [leading(t("close"), Infinity)];
  const head = make("h2", { id: "tour-title" }, t("Tour, {k} of {count}", { k: k + 1, count: tourSteps().length }));
  const box = make("section", { id: "tour", "aria-labelledby": "tour-title" }, head, make("p", { id: "tour-words" }, words), make("p", { class: "answers" }, leading(t("back"), k - 1), next, ...close));
  document.querySelector("main").append(box);
  putBeside(box, place.getBoundingClientRect());
  next.setAttribute("aria-describedby", "tour-words");
  next.focus();
}

/** Puts a box to the right or the left of a place, below it or above it: where it covers least of it. */
function putBeside(box, { left, right, top, bottom }) {
  const { offsetWidth: width, offsetHeight: height } = box;
  const inside = (x, size, room) => Math.max(4, Math.min(x, room - size - 4));
  const corners = [[right + 8, top], [left - width - 8, top], [left, bottom + 8], [left, top - height - 8]].map(([x, y]) => [inside(x, width, innerWidth), inside(y, height, innerHeight)]);
  const covers = (/** @type {number[]} */ [x, y]) => Math.max(0, Math.min(x + width, right) - Math.max(x, left)) * Math.max(0, Math.min(y + height, bottom) - Math.max(y, top));
  const [x, y] = corners.sort((a, b) => covers(a) - covers(b))[0];
  Object.assign(box.style, { left: `${x}px`, top: `${y}px` });
}

/** What an array or a name of the listings is; nothing of a name that an edit brought in. */
function meaningOf(name) {
  const turn = t("the turn of a loop");
  const ofCorrected = run().programs && {
    yt: t("the distance of each contact node from its target edge, along the normal: positive apart, as a gap is; the print has it the other way round"),
    gt: t("that distance in the initial shape"),
    kt: t("where on its edge the node has its nearest point: 0 at the first end, 1 at the second"),
    k_cnt: t("of each node the two nodes of its target edge with their weights, the normal, and the gap"),
    ntx: t("x of the edge's ends"),
    nty: t("y of the edge's ends"),
    ξ: t("where on the edge's line the node has its nearest point: 0 at the first end, 1 at the second"),
    far: t("the distance of the node from the edge"),
    near: t("the least distance from an edge so far"),
    ...(isBordered(page.machine.lines) && { W: t("the contact node and the two nodes of its edge"), fl: t("the weights of these nodes in the equation of contact") }),
  };
  return {
    ct: t("the number of each contact node's target edge, 0 for none"),
    yt: t("the height of the target's line over each contact node: negative where the node lies above the line"),
    dy: t("1 for a contact node in contact, else 0"),
    k_cnt: t("of each node its master node, weight, master node, weight"),
    ntx: t("the ends of the search box along x: the edge's nodes, with c_tll"),
    nty: t("the ends of the search box along y: the edge's nodes, with c_tll"),
    k1: t("the weight of the edge's first node"),
    k2: t("the weight of the edge's second node"),
    V: t("the equations of the element's nodes: 2n − 1 for x of node n, 2n for y"),
    W: t("the equations of the nodes that are linked to the element's"),
    cx: t("0 for an equation that is restrained, else 1"),
    fl: t("the weight with which K is added for the linked node"),
    K: t("the stiffness matrix of the element, force over length"),
    MJS: t("the stiffness matrix of the whole, force over length"),
    n: t("the number of the element"),
    i1: turn,
    i2: turn,
    i: turn,
    j: turn,
    ...ofCorrected,
  }[name];
}

/** Says in a line what the array is that has the pointer or the focus. */
function watchMeanings() {
  const explain = ({ target }) => {
    const name = target.closest?.("#arrays [data-name]")?.dataset.name.split("[")[0];
    const meaning = meaningOf(name);
    if (meaning) say("meaning", `${name}: ${meaning}.`);
  };
  for (const event of ["pointerover", "focusin"]) document.addEventListener(event, explain);
  document.addEventListener("keydown", ({ key }) => key === "Escape" && showTour(Infinity));
}
