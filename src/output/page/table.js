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
