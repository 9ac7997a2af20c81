// Curves over the distance along the contact surface, as SVG.

/** Colours that the colour-blind tell apart (Okabe and Ito), each with a dash of its own. */
const CURVES = [
  ["#0072b2", ""], ["#d55e00", "7 3"], ["#009e73", "2 3"], ["#cc79a7", "9 3 2 3"],
  ["#e69f00", "4 2"], ["#56b4e9", "12 4"], ["#7f7f7f", "1 2"], ["#b09c00", "6 2 1 2"],
];

function svg(tag, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** About five round numbers in a range. */
function ticks(low, high) {
  const raw = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((step) => step >= raw);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** Draws series, each with a name and points, under axes with their labels. */
function chart(title, across, up, series) {
  const [width, tall, left, top, bottom] = [900, 360 + 20 * Math.ceil(series.length / 3), 70, 30, 60 + 20 * Math.ceil(series.length / 3)];
  const all = series.flatMap(({ points }) => points);
  const [x0, x1] = range(all.map(([x]) => x));
  const spread = range([0, ...all.map(([, y]) => y)]);
  const [y0, y1] = spread[0] === spread[1] ? [spread[0], spread[0] + 1] : spread;
  const x = (value) => left + ((value - x0) / (x1 - x0 || 1)) * (width - left - 20);
  const y = (value) => tall - bottom - ((value - y0) / (y1 - y0)) * (tall - top - bottom);
  const grid = [];
  for (const value of ticks(y0, y1)) {
    grid.push(svg("line", { x1: left, x2: width - 20, y1: y(value), y2: y(value), stroke: "var(--rule)" }));
    grid.push(svg("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end" }, short(value)));
  }
  for (const value of ticks(x0, x1)) grid.push(svg("text", { x: x(value), y: tall - bottom + 18, "text-anchor": "middle" }, short(value)));
  const curves = series.map(({ name, points }, k) => {
    const [stroke, dash] = CURVES[k % CURVES.length];
    const line = points.map(([px, py]) => `${x(px).toFixed(2)},${y(py).toFixed(2)}`).join(" ");
    const drawn = svg("polyline", { points: line, fill: "none", stroke, "stroke-width": 2, "stroke-dasharray": dash });
    drawn.append(svg("title", {}, name));
    const [lx, ly] = [left + (k % 3) * 275, tall - bottom + 58 + 20 * Math.floor(k / 3)];
    return [drawn, svg("line", { x1: lx, x2: lx + 34, y1: ly - 4, y2: ly - 4, stroke, "stroke-width": 3, "stroke-dasharray": dash }), svg("text", { x: lx + 40, y: ly }, name)];
  });
  const labels = [svg("text", { x: width - 20, y: tall - bottom + 36, "text-anchor": "end" }, across), svg("text", { x: left, y: top - 12 }, up)];
  return svg("svg", { viewBox: `0 0 ${width} ${tall}`, role: "img", "aria-label": title }, ...grid, ...labels, ...curves.flat());
}
