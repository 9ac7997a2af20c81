// What the tests of pages in a browser share. A script is run as
//   node SCRIPT PAGE OUT ...
// with BROWSER_MODULES, the folder of playwright-core and axe-core. It ends with status 1 at the
// first expectation that is not met.

const assert = require("node:assert");
const { createRequire } = require("node:module");
const { pathToFileURL } = require("node:url");
const fs = require("node:fs");

const modules = createRequire(process.env.BROWSER_MODULES + "/");
const { chromium } = modules("playwright-core");
const axe = fs.readFileSync(modules.resolve("axe-core/axe.min.js"), "utf8");

/** The widths of the tests, a phone's, a tablet's and a screen's, with their heights. */
const WIDTHS = { 390: 844, 1024: 768, 1440: 900 };

/** Opens a page from its file; whatever it says on the console or asks of the network is kept in
 * `said`. */
async function open(browser, file, { width = 1440, scheme = "light", ...others } = {}) {
  const context = await browser.newContext({
    viewport: { width, height: WIDTHS[width] },
    colorScheme: scheme,
    ...others,
  });
  const page = await context.newPage();
  const said = [];
  page.on("console", (message) => said.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => said.push(`error: ${error.stack}`));
  page.on("request", (request) => {
    const own = [pathToFileURL(file).href, "data:", "blob:"];
    if (!own.some((start) => request.url().startsWith(start))) said.push(`request: ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  return { page, said };
}

/** The violations that axe-core finds, in words. */
async function violations(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"] }));
  return found.violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html}: ${node.failureSummary}`));
}

/** Whether a page is wider than its window. */
const overflows = (page) => page.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);

/** Looks at a page in all widths and both schemes: `look` gets it, a function that checks that
 * nothing is cut off and that axe-core finds nothing, and the view's name. */
async function inAllViews(browser, file, look) {
  for (const width of Object.keys(WIDTHS).map(Number)) {
    for (const scheme of ["light", "dark"]) {
      const view = `${width}-${scheme}`;
      const { page, said } = await open(browser, file, { width, scheme });
      const check = async () => {
        assert.deepEqual(await violations(page), []);
        assert.equal(await overflows(page), false, view);
      };
      await look({ page, check, view });
      assert.deepEqual(said, []);
    }
  }
}

/** Runs tests one after the other, or those that ONLY names. */
const runAll = (tests) =>
  run(async (browser) => {
    for (const test of tests.filter(({ name }) => (process.env.ONLY ?? name).includes(name))) {
      await test(browser);
      console.log(`${test.name}: done`);
    }
  });

/** Runs a test with a browser, which is closed at its end. */
async function run(test) {
  const browser = await chromium.launch({
    executablePath: process.env.BROWSER ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--font-render-hinting=none", "--disable-lcd-text"],
  });
  try {
    await test(browser);
  } catch (error) {
    console.error(error.stack);
    process.exitCode = 1;
  } finally {
    await browser.close();
  }
}

/** A generator of numbers from 0 to 1 that are the same on every run (Park and Miller). */
function drawn(seed) {
  let state = seed;
  return () => ((state = (state * 48271) % 2147483647), state / 2147483647);
}

module.exports = { WIDTHS, open, violations, overflows, inAllViews, run, runAll, drawn };
