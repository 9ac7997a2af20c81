// What stands beside the runs of a report: node beside.cjs PAGE KIND. KIND is `calculix`, `charts` of
// trade, or `hertz`.

const assert = require("node:assert");
const { open, run } = require("./browser.cjs");

const [file, kind] = process.argv.slice(2);

/** CalculiX is a run as any other: all that its displacements imply is known. */
async function calculix(page) {
  await page.selectOption("#run-1", { label: "CalculiX" });
  for (const field of ["strain εx", "von Mises strain", "gap", "contact pressure", "von Mises stress"]) {
    await page.selectOption("#field", { label: field });
    assert.match(await page.textContent("#said-1"), new RegExp(`^CalculiX: ${field} from `));
  }
  assert.equal(await page.locator('article div[aria-label^="Largest"]').count(), 2);
}

/** Each chart is a picture that the browser reads, after the seven of any report with contact. */
async function charts(page) {
  const sizes = await page.locator("img").evaluateAll((all) => Promise.all(all.map(async (image) => (await image.decode(), [image.alt, image.naturalWidth]))));
  assert.ok(sizes.length > 7 && sizes.every(([name, width]) => name !== "" && width > 100), String(sizes));
}

/** Hertz's curve is the last in the picture of the pressure, and unilateral's lies on it. */
async function hertz(page) {
  const curves = await page.locator('article img[alt^="Contact pressure"]').evaluate((image) => {
    const svg = new DOMParser().parseFromString(atob(image.src.split(",")[1]), "image/svg+xml");
    const points = (line) => line.getAttribute("d").match(/[\d.]+,[\d.]+/g).map((point) => point.split(",").map(Number));
    return [...svg.querySelectorAll("path")].map(points);
  });
  const [own, exact] = [curves[0], curves.at(-1)];
  assert.equal(curves.length, 2);
  const height = Math.max(...exact.map(([, y]) => y)) - Math.min(...exact.map(([, y]) => y));
  const near = ([x, y]) => Math.min(...exact.map(([ex, ey]) => Math.hypot(ex - x, ey - y)));
  const loaded = own.filter(([x]) => x <= Math.max(...exact.map(([ex]) => ex)));
  assert.ok(loaded.length > 5 && loaded.every((point) => near(point) < 0.05 * height), String(loaded));
}

run(async (browser) => {
  const { page, said } = await open(browser, file);
  await { calculix, charts, hertz }[kind](page);
  assert.deepEqual(said, []);
});
