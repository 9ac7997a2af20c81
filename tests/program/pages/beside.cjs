// What stands beside the runs of a report: node beside.cjs PAGE KIND. KIND is `calculix` or `hertz`.

const assert = require("node:assert");
const { open, run } = require("./browser.cjs");

const [file, kind] = process.argv.slice(2);

/** CalculiX is a run as any other in the picture of all runs. */
async function calculix(page) {
  assert.equal(await page.locator('article img[alt^="von Mises stress"][alt*="CalculiX"]').count(), 1);
  assert.equal(await page.locator('article div[aria-label^="Largest differences"]').count(), 1);
}

/** Hertz's curve is the last in the picture of the pressure, and the equilibrium's before it lies on it, but for the node on the axis. */
async function hertz(page) {
  const curves = await page.locator('article img[alt^="Contact pressure"]').evaluate((image) => {
    const svg = new DOMParser().parseFromString(atob(image.src.split(",")[1]), "image/svg+xml");
    const points = (line) => line.getAttribute("d").match(/[\d.]+,[\d.]+/g).map((point) => point.split(",").map(Number));
    return [...svg.querySelectorAll("path")].map(points);
  });
  const [own, exact] = curves.slice(-2);
  const extent = [0, 1].map((axis) => Math.max(...exact.map((point) => point[axis])) - Math.min(...exact.map((point) => point[axis])));
  const near = ([x, y]) => Math.min(...exact.map(([ex, ey]) => Math.hypot((ex - x) / extent[0], (ey - y) / extent[1])));
  const loaded = own.slice(1).filter(([x]) => x <= Math.max(...exact.map(([ex]) => ex)));
  assert.ok(loaded.length > 5 && loaded.every((point) => near(point) < 0.05), String(loaded));
}

run(async (browser) => {
  const { page, said } = await open(browser, file);
  await { calculix, hertz }[kind](page);
  assert.deepEqual(said, []);
});
