// The first minute: a tour of five steps, and what each array is.

/** The steps of the tour: what is looked at, and what is said of it. */
const tourSteps = () => [
  ["#pictures", t("Blue is the stamp, brown the target; heights are magnified. The green band reaches c_tll to both sides of each edge. Which nodes touch?")],
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

/** What an array or a name of the listings is (meanings.tsv); nothing of a name that an edit brought in. */
function meaningOf(name) {
  const { programs } = run();
  const kinds = ["print", programs && "corrected", programs && isBordered(page.machine.lines) && "bordered"];
  const found = data.meanings.findLast(([of, own]) => own === name && kinds.includes(of));
  return found && t(found[2]);
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
