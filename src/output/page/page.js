// What all pages share: elements, numbers, colours, canvases, and the exact value of what is shown
// short.

const data = JSON.parse(document.getElementById("data").textContent);
/** @returns {any} */
const byId = (id) => document.getElementById(id);

/** Makes an element; attributes that are undefined are left out, texts are never read as HTML. @returns {any} */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    // The page's content policy allows no attribute `style`; what a script sets is allowed.
    if (name === "style") element.style.cssText = value;
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children);
  return element;
}

/** Makes a button that does something. */
function button(text, act, attributes = {}) {
  const made = make("button", attributes, text);
  made.addEventListener("click", act);
  return made;
}

/** Makes a table: its caption where it has one, a heading a column, and rows that begin with theirs; a heading is a text,
 * or a cell of its own. */
function tableFrom(caption, heads, rows) {
  const headed = ([first, ...cells]) => [typeof first === "string" ? make("th", { scope: "row" }, first) : first, ...cells];
  const head = heads.map((text) => (typeof text === "string" ? make("th", { scope: "col" }, text) : text));
  const body = rows.map((row) => make("tr", {}, ...headed(row)));
  return make("table", {}, ...(caption ? [make("caption", {}, caption)] : []), make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...body));
}

/** The language in which the page speaks. */
const speech = { language: data.language ?? "en" };

/** Digits with the decimal sign of the page's language. */
const decimal = (digits) => (speech.language === "ru" ? digits.replaceAll(".", ",") : digits);

/** Writes a number with six digits at most. */
function short(x) {
  if (typeof x !== "number") return String(x);
  const size = Math.abs(x);
  const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? x.toExponential(3) : String(Number(x.toPrecision(6)));
  return decimal(text.replaceAll("-", "−"));
}

/** Writes a value, an array as Mathcad shows it: each number by `number`. */
function written(value, number) {
  if (!Array.isArray(value)) return number(value);
  const isMatrix = Array.isArray(value[0]);
  return `(${value.map((row) => (isMatrix ? row.map(number).join("  ") : number(row))).join(isMatrix ? ";  " : "  ")})`;
}

/** Writes a value in full, a number with all its digits. */
const exact = (value) => written(value, (x) => (typeof x === "number" ? decimal(String(x)) : String(x)));

/** Writes a value short. */
const brief = (value) => written(value, short);

/** Says a sentence in the page's language. `english` is its key in the table of messages; `{name}` stands for a value. */
function t(english, values = {}) {
  const text = (speech.language === "ru" && data.messages[english]) || english;
  return text.replace(/\{(\w+)\}/g, (_, name) => inProse(values[name]));
}

/** Says a text of the data: a sentence, or one with its values. */
const tell = (of) => (typeof of === "string" ? t(of) : t(of.text, of.values));

/** Writes a value of a sentence: a number short, names one behind the other. */
function inProse(value) { return Array.isArray(value) ? value.map((name) => t(name)).join(", ") : short(value); }

/** Writes a text where another one stands. */
function say(id, text) { if (byId(id).textContent !== text) byId(id).textContent = text; }

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

/** Clears a canvas for its size on the page, in CSS pixels; returns its context. A size that stays is not
 * set again, for the whole page would be laid out anew. */
function prepared(canvas, height, width = canvas.clientWidth) {
  const ratio = window.devicePixelRatio || 1;
  const size = [width, height].map((x) => Math.round(x * ratio));
  if (canvas.style.height !== height + "px") canvas.style.height = height + "px";
  if (String([canvas.width, canvas.height]) !== String(size)) [canvas.width, canvas.height] = size;
  const context = canvas.getContext("2d");
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, ...size);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.font = "13px system-ui, sans-serif";
  return { context, width, height };
}

/** The smallest and the largest of many numbers. */
function range(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const x of values) {
    if (x < low) low = x;
    if (x > high) high = x;
  }
  return [low, high];
}

/** Draws a path through points. @param {any} context @param {any[]} points @param {any} style */
function path(context, points, { close = false, ...style }) {
  context.beginPath();
  points.forEach((point) => context.lineTo(...point));
  if (close) context.closePath();
  inked(context, style);
}

/** Draws a circle. @param {any} context @param {any[]} middle @param {number} radius @param {any} style */
function circle(context, middle, radius, style) {
  context.beginPath();
  context.arc(...middle, radius, 0, 2 * Math.PI);
  inked(context, style);
}

/** Fills and strokes the path that was begun. @param {any} context @param {any} style */
function inked(context, { fill = null, stroke = null, width = 1, dash = [], alpha = 1 }) {
  Object.assign(context, { globalAlpha: alpha, fillStyle: fill, strokeStyle: stroke, lineWidth: width });
  context.setLineDash(dash);
  if (fill) context.fill();
  if (stroke) context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/** Shows the exact value of what has `data-exact`, under the pointer or with the focus. */
function showExactValues() {
  const tip = make("div", { id: "tip", hidden: true });
  document.body.append(tip);
  const show = (event) => {
    const of = event.target.closest?.("[data-exact]");
    tip.hidden = !of;
    if (!of) return;
    tip.textContent = of.dataset.exact;
    const place = of.getBoundingClientRect();
    tip.style.left = Math.max(4, Math.min(place.left, window.innerWidth - tip.offsetWidth - 4)) + "px";
    tip.style.top = (place.top > 32 ? place.top - 28 : place.bottom + 4) + "px";
  };
  document.addEventListener("pointerover", show);
  document.addEventListener("focusin", show);
  document.addEventListener("scroll", () => (tip.hidden = true), true);
}

/** The way of each arrow key: right and down. */
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };

/** Makes what `selector` finds in `container` one stop of the Tab key; arrow keys go from one to the
 * next. Called again when the content was made anew. */
function roving(container, selector, columns = () => 1) {
  const all = () => [...container.querySelectorAll(selector)];
  all().forEach((item, k) => (item.tabIndex = k === 0 ? 0 : -1));
  if ("roving" in container.dataset) return;
  container.dataset.roving = "";
  container.addEventListener("keydown", (event) => {
    const items = all();
    const at = items.indexOf(document.activeElement);
    const across = columns() > 1 ? { ArrowLeft: -1, ArrowRight: 1 } : {};
    const by = { ArrowUp: -columns(), ArrowDown: columns(), Home: -at, End: items.length - 1 - at, ...across }[event.key];
    if (at < 0 || by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const next = items[at + by];
    if (!next) return;
    items[at].tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
  });
}
