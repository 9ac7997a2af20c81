// What a lesson shows against the traces of the listings, in any browser.

const assert = require("node:assert");
const fs = require("node:fs");

const read = (path) => JSON.parse(fs.readFileSync(path, "utf8"));

/** What the names of a listing hold after some steps of its trace. */
function valuesAfter(steps) {
  const values = new Map();
  for (const { writes } of steps) {
    for (const { name, value } of writes) {
      if (typeof value !== "number") for (const other of [...values.keys()]) if (other.startsWith(`${name}[`)) values.delete(other);
      values.set(name, value);
      if (!Array.isArray(value)) continue;
      value.forEach((row, i) => {
        if (Array.isArray(row)) row.forEach((x, j) => values.set(`${name}[${i + 1},${j + 1}]`, x));
        else values.set(`${name}[${i + 1}]`, row);
      });
    }
  }
  return values;
}

const flat = (value) => (Array.isArray(value) ? `(${value.map((row) => [row].flat().join("  ")).join(Array.isArray(value[0]) ? ";  " : "  ")})` : String(value).replaceAll(" x ", " × "));

/** A function that compares what a page shows of a listing with its trace, and returns how many steps
 * were executed. */
const comparing = (traces) => async (page, which) => {
  const shown = await page.evaluate(() => ({
    status: document.getElementById("status").textContent,
    lit: document.querySelector("#listing li[aria-current] button")?.textContent,
    step: [...document.querySelectorAll("#step .access")].map((item) => [item.textContent.replace(/ .*/, ""), item.dataset.exact]),
    cells: [...document.querySelectorAll("td[data-name]")].map((cell) => [cell.dataset.name, cell.dataset.exact, cell.textContent]),
  }));
  const at = Number(/step (\d+) of/.exec(shown.status)[1]);
  const { steps } = traces[which];
  const last = steps[at - 1];
  assert.equal(shown.lit, last && String(last.line), `the lit line after ${at} steps of ${which}`);
  const reads = [...new Set((last?.reads ?? []).map((read) => JSON.stringify([read.name, flat(read.value)])))].map((text) => JSON.parse(text));
  const writes = (last?.writes ?? []).map(({ name, value }) => [name, flat(value)]);
  assert.deepEqual(shown.step, [...reads, ...writes], `what step ${at} of ${which} read and wrote`);
  const values = valuesAfter(steps.slice(0, at));
  assert.ok(shown.cells.length > 20, "the tables have cells");
  for (const [name, full, text] of shown.cells) {
    const value = values.get(name);
    assert.equal(full, value === undefined ? `${name} has no value yet` : `${name} = ${flat(value)}`, `after ${at} steps of ${which}`);
    if (typeof value === "number") {
      const read = Number(text.replaceAll("−", "-"));
      assert.ok(Math.abs(read - value) <= 1e-3 * Math.abs(value), `${name} is shown as ${text}, and is ${value}`);
    }
  }
  return at;
};

module.exports = { comparing, read };
