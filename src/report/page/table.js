// Tables that copy as CSV.

/** A field as CSV has it (RFC 4180). */
function csvField(value) {
  const text = value === null || value === undefined ? "" : exact(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Copies text; a page opened from a file may have no clipboard of its own. */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = make("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

/** A table of rows: each column has a heading, the value of a row, and a class where it is text. */
function tableOf(title, columns, rows) {
  const csv = () => [columns.map(([head]) => head), ...rows.map((row) => columns.map(([, of]) => of(row)))]
    .map((line) => line.map(csvField).join(",")).join("\r\n") + "\r\n";
  const button = make("button", { "aria-label": `copy as CSV: ${title}` }, "copy as CSV");
  button.addEventListener("click", async () => {
    await copy(csv());
    button.textContent = "copied";
  });
  const head = columns.map(([text, , kind]) => make("th", { scope: "col", class: kind && "text" }, text));
  const cell = (row) => ([, of, kind]) => {
    const value = of(row);
    const shown = value === null || value === undefined ? "-" : brief(value);
    const full = typeof value === "number" && shown.replace("−", "-") !== String(value) ? exact(value) : undefined;
    return make("td", { class: kind, "data-exact": full }, shown);
  };
  const body = rows.map((row) => make("tr", {}, ...columns.map(cell(row))));
  const table = make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...body));
  const box = make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": title }, table);
  return make("figure", {}, make("figcaption", {}, title, button), box);
}
