// Tables that copy as CSV.

/** A cell as a field of CSV (RFC 4180): a number with all its digits, nothing where there is none; an apostrophe before what a spreadsheet would take for a formula. */
function csvField(cell) {
  const whole = cell.dataset.exact ?? (cell.textContent === "-" ? "" : cell.textContent);
  const text = /^[=+\-@\t\r\n]/.test(whole) && isNaN(whole) ? `'${whole}` : whole;
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

/** Adds a button to a table's caption that copies the table as CSV. */
function addCopying(table) {
  const rows = [...table.rows].map((row) => [...row.cells]);
  const copying = async ({ target }) => {
    await copy(rows.map((row) => row.map(csvField).join(",") + "\r\n").join(""));
    target.textContent = t("copied");
  };
  table.caption.append(" ", button(t("copy as CSV"), copying, { "aria-label": t("copy as CSV: {title}", { title: table.caption.textContent }) }));
}

/** A table of rows: each column has a heading, the value of a row, and a class where it is text. */
function tableOf(title, columns, rows) {
  const head = columns.map(([text, , kind]) => make("th", { scope: "col", class: kind ?? "number" }, text));
  const cell = (row) => ([, of, kind]) => {
    const value = of(row);
    const shown = value === null || value === undefined ? "-" : brief(value);
    const full = typeof value === "number" && shown !== String(value) ? exact(value) : undefined;
    return make("td", { class: kind ?? "number", "data-exact": full }, shown);
  };
  const table = tableFrom(title, head, rows.map((row) => columns.map(cell(row))));
  addCopying(table);
  return make("div", { class: "table", tabindex: 0, role: "region", "aria-label": title }, table);
}
