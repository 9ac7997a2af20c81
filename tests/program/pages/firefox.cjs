// A lesson and a report in Firefox, by WebDriver BiDi:
//   node firefox.cjs LESSON TRACE_OF_C_CNT TRACE_OF_KM REPORT RESULT
// with BROWSER_MODULES, the folder of puppeteer-core. It ends with status 1 at the first expectation
// that is not met.

const assert = require("node:assert");
const { createRequire } = require("node:module");
const { pathToFileURL } = require("node:url");
const { drawn } = require("./browser.cjs");
const { comparing, read } = require("./traced.cjs");

const [lesson, ofContact, ofStiffness, report, resultFile] = process.argv.slice(2);
const traces = { c_cnt: read(ofContact), Km: read(ofStiffness) };
const result = read(resultFile);
const puppeteer = createRequire(process.env.BROWSER_MODULES + "/")("puppeteer-core");

/** Opens a page, tests it, and finds that it said nothing and asked for nothing. */
async function visit(browser, file, width, test) {
  const page = await browser.newPage();
  const said = [];
  page.on("console", (message) => said.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => said.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const own = [pathToFileURL(file).href, "data:", "blob:"];
    if (!own.some((start) => request.url().startsWith(start))) said.push(`request: ${request.url()}`);
  });
  await page.setViewport({ width, height: 900 });
  await page.goto(pathToFileURL(file).href);
  await test(page);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `${file} at ${width}`);
  assert.deepEqual(said, []);
  await page.close();
}

const text = (page, selector) => page.$eval(selector, (element) => element.textContent);

/** Sets an input as a person would: a value, and the event that follows. */
const set = (page, selector, value) =>
  page.$eval(selector, (input, value) => {
    if (input.type === "radio") input.click();
    else input.value = value;
    input.dispatchEvent(new Event("input", { bubbles: true }));
    input.dispatchEvent(new Event("change", { bubbles: true }));
  }, value);

/** Both listings: 40 moves drawn at random, each compared with the trace; then a reading. */
async function steps(page) {
  const compare = comparing(traces);
  const random = drawn(14);
  const keys = ["ArrowRight", "ArrowRight", "ArrowLeft", "o", "d", "n", "End", "Home"];
  for (const which of ["c_cnt", "Km"]) {
    await set(page, `input[value=${which}]`);
    for (let k = 0; k < 20; k += 1) {
      if (random() < 0.4) {
        await set(page, "#slider", String(Math.floor(random() * (traces[which].steps.length + 1))));
      } else {
        await page.evaluate(() => document.activeElement.blur());
        await page.keyboard.press(keys[Math.floor(random() * keys.length)]);
      }
      await compare(page, which);
    }
  }
  await set(page, "input[value=c_cnt]");
  const readings = await page.$$eval("#run option", (all) => all.map((option) => [option.textContent, option.value]));
  const [, stops] = readings.find(([name]) => name === "R4 = left-to-right");
  await set(page, "#run", stops);
  await set(page, "#slider", "100000");
  assert.match(await text(page, "#failure"), /The listing stops: .*line 18/);
}

/** The listing edited in place, and a node moved by the arrow keys. */
async function edited(page) {
  const cells = () => page.$$eval("td[data-name]", (all) => all.map((cell) => cell.dataset.exact));
  await set(page, "#run", "0");
  await page.click("#end");
  const printed = await cells();
  await page.click("#edit");
  const listing = await page.$eval("#text", (area) => area.value);
  const typed = async (to, wanted) => {
    await set(page, "#text", listing.replace("|yt[i1]| < c_tll ∧", to));
    await page.waitForFunction(wanted);
  };
  await typed("|yt[i1]| < ∧", () => document.getElementById("text-error").textContent.startsWith("Line 16, column 30: found"));
  await typed("|yt[i1]| ≤ 20 · c_tll ∧", () => document.getElementById("listing-title").textContent === "The listing, edited");
  assert.ok((await cells()).includes("dy[4] = 1"), "node 2.4 comes into contact");
  await page.click("#edit");
  await page.$eval("#reset", (button) => button.click());
  assert.deepEqual(await cells(), printed);
  await page.focus("#nodes button[aria-label^='node 2.4']");
  for (let k = 0; k < 10; k += 1) await page.keyboard.press("ArrowDown");
  assert.notDeepEqual(await cells(), printed);
  await page.keyboard.press("Home");
  assert.match(await text(page, "#status"), /^step 0 /);
}

/** The field under the pointer, probes, and every field in turn. */
async function fields(page) {
  for (const value of await page.$$eval("#field option", (all) => all.map((option) => option.value))) await set(page, "#field", value);
  await set(page, "#factor", "0");
  const element = result.elements[result.elements.length - 1];
  const stress = await page.$$eval("#field option", (all) => all.find((option) => option.textContent === "von Mises stress").value);
  await set(page, "#field", stress);
  for (const [axis, j] of [["x", 0], ["y", 1]]) {
    await set(page, `#probe-${axis}`, String(element.nodes.reduce((sum, n) => sum + result.nodes[n - 1][j], 0) / 3));
  }
  await page.click("#probe button");
  const cells = await page.$$eval("#probes tbody tr:last-child td", (all) => all.map((cell) => cell.dataset.exact ?? cell.textContent));
  assert.equal(cells[2], `triangle ${element.n}`);
  const shown = Number(cells[6].replaceAll("−", "-"));
  assert.ok(Math.abs(shown - element.von_mises_stress) <= 1e-4 * element.von_mises_stress, `${shown}, ${element.von_mises_stress}`);
  await page.$eval("#view-0", (canvas) => canvas.scrollIntoView({ block: "center" }));
  const box = await page.$eval("#view-0", (canvas) => {
    const { x, y, width, height } = canvas.getBoundingClientRect();
    return { x, y, width, height };
  });
  await page.mouse.move(box.x + box.width / 2, box.y + 0.7 * box.height);
  assert.match(await text(page, "#pointed"), /^triangle \d+, .*MPa/);
}

(async () => {
  const browser = await puppeteer.launch({ browser: "firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr", headless: true });
  try {
    for (const width of [1440, 390]) {
      await visit(browser, lesson, width, steps);
      await visit(browser, lesson, width, edited);
      await visit(browser, report, width, fields);
    }
  } catch (error) {
    console.error(error.stack);
    process.exitCode = 1;
  } finally {
    await browser.close();
  }
})();
