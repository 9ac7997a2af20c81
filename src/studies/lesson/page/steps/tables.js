// The arrays as tables: values short, in full on hover and focus; what the last step wrote and read
// is marked.

/** Marks of the last step, by name. */
function marks(machine) {
  const found = new Map();
  for (const { name } of machine.last?.reads ?? []) found.set(name, "read");
  for (const { name, value } of machine.last?.writes ?? []) {
    found.set(name, "written");
    if (Array.isArray(value)) value.forEach((_, k) => found.set(`${name}[${k + 1}]`, "written"));
  }
  return found;
}

/** Writes a cell's value, where another one stands. */
function fill(cell, machine, marked) {
  const { name } = cell.dataset;
  const value = machine.get(name);
  const full = value === undefined ? t("{name} has no value yet", { name }) : `${name} = ${exact(value)}`;
  if (cell.dataset.exact !== full) {
    cell.dataset.exact = full;
    cell.textContent = value === undefined ? "·" : brief(value);
  }
  const mark = marked.get(name) ?? "";
  if (cell.className !== mark) cell.className = mark;
}

/** A cell of a value that does not change. */
const valueCell = (value) => (value === undefined ? make("td", {}, "·") : make("td", { "data-exact": exact(value) }, brief(value)));

/** A table of entries with a heading a column; each row has its heading and its names. */
function entriesTable(caption, heads, rows) {
  const cell = (name) => make("td", { "data-name": name, "aria-describedby": "meaning" });
  const body = rows.map(([head, names]) => [make("th", { scope: "row", "data-name": head === names[0] ? head : undefined }, head), ...names.map(cell)]);
  const head = heads.map((text) => make("th", { scope: "col", "data-name": meaningOf(text) && text }, text));
  const box = make("div", { class: "scroll" }, tableFrom(caption, head, body));
  roving(box, "td", () => heads.length - 1);
  return box;
}

/** Shows tables, made anew where their names are others: to write cells takes a tenth of the time. The row at
 * `current` of the first is lit. */
function showTables(place, machine, tables, current) {
  const names = JSON.stringify(tables);
  if (place.dataset.names !== names) {
    place.dataset.names = names;
    place.replaceChildren(...tables.map((parts) => entriesTable(...parts)));
  }
  const marked = marks(machine);
  for (const cell of place.querySelectorAll("td")) fill(cell, machine, marked);
  [...place.querySelector("tbody").rows].forEach((row, k) => row.classList.toggle("current", k === current));
}

const rowsOf = (rows, names) => rows.map(([head, index]) => [head, names.map((name) => `${name}[${index}]`)]);

/** The tables of c_cnt: contact nodes, k_cnt, and the names of one value. */
function contactTables(mesh, machine) {
  const contact = mesh.contact.map((n, k) => [mesh.name(n), k + 1]);
  const nodes = Array.from({ length: mesh.count }, (_, k) => k + 1);
  const heads = [t("node"), t("1: mate"), t("2: weight"), t("3: mate"), t("4: weight"), ...(run().programs ? [t("5: normal x"), t("6: normal y"), t("7: gap")] : [])];
  const columns = heads.slice(1).map((_, j) => j + 1);
  const touched = (n) => columns.some((j) => machine.get(`k_cnt[${n},${j}]`));
  const shown = mesh.count <= 40 ? nodes : nodes.filter(touched);
  const k_cnt = shown.map((n) => [mesh.name(n), columns.map((j) => `k_cnt[${n},${j}]`)]);
  const [own, now] = run().programs ? [["ct", "kt", "yt", "gt", "dy"], ["ξ", "k2", "far", "near"]] : [["ct", "yt", "dy"], ["k1", "k2"]];
  return [
    [t("by contact node"), [t("node"), ...own], rowsOf(contact, own)],
    [t("now"), [t("name"), t("value")], ["i1", "i2", "ntx", "nty", ...now].map((name) => [name, [name]])],
    ["k_cnt", heads, k_cnt],
  ];
}

/** The tables of Km: the element's equations, and the names of one value; in the corrected one the contact node's too. */
function stiffnessTables({ lines }) {
  const numbered = (count, names) => rowsOf(Array.from({ length: count }, (_, k) => [String(k + 1), k + 1]), names);
  const [own, now] = isBordered(lines) ? [["V", "cx"], ["n", "i1", "i2", "i", "j"]] : [["V", "W", "cx"], ["n", "i1", "i", "j", "fl"]];
  return [
    [t("by equation of the element"), [t("equation"), ...own], numbered(6, own)],
    ...(isBordered(lines) ? [[t("by node of the contact pair"), [t("node"), "W", "fl"], numbered(3, ["W", "fl"])]] : []),
    [t("now"), [t("name"), t("value")], now.map((name) => [name, [name]])],
  ];
}

/** The element's stiffness; each row and column with its equation in MJS. */
function elementTable(machine) {
  const six = [1, 2, 3, 4, 5, 6];
  const equation = (k) => `${k} → ${machine.get(`V[${k}]`) ?? "·"}`;
  return [t("K, each row and column with its equation in MJS"), [t("row"), ...six.map(equation)], six.map((i) => [equation(i), six.map((j) => `K[${i},${j}]`)])];
}
