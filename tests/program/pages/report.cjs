// A report in a browser: node report.cjs PAGE RESULT AUDIT. RESULT is the result.json of
// the scene's own variant, with its fields; AUDIT what audit --json prints.

const assert = require("node:assert");
const fs = require("node:fs");
const { pathToFileURL } = require("node:url");
const { open, inAllViews, runAll, drawn } = require("./browser.cjs");

const [file, resultFile, auditFile] = process.argv.slice(2);
const result = JSON.parse(fs.readFileSync(resultFile, "utf8"));
const audit = JSON.parse(fs.readFileSync(auditFile, "utf8"));

const rows = (page, title) => page.locator(`article div[aria-label^="${title}"] tbody tr`).count();

/** Each field at triangles drawn at random, by probes on the undeformed shape. */
async function fields(browser) {
  const { page, said } = await open(browser, file);
  await page.locator("#factor").fill("0");
  await page.locator("#factor").blur();
  const random = drawn(3);
  const of = {
    "von Mises stress": (e) => e.von_mises_stress, "stress σy": (e) => e.sigma[1],
    "strain γxy": (e) => e.epsilon[2], "von Mises strain": (e) => e.von_mises_strain,
    "displacement uy": (e) => e.nodes.reduce((sum, n) => sum + result.u[n - 1][1], 0) / 3,
  };
  for (const [name, value] of Object.entries(of)) {
    await page.selectOption("#field", { label: name });
    const element = result.elements[Math.floor(random() * result.elements.length)];
    const place = [0, 1].map((j) => element.nodes.reduce((sum, n) => sum + result.nodes[n - 1][j], 0) / 3);
    await page.fill("#probe-x", String(place[0]));
    await page.fill("#probe-y", String(place[1]));
    await page.click("#probe button");
    const cells = await page.locator("#probes tbody tr").last().locator("td").evaluateAll((all) => all.map((cell) => cell.dataset.exact ?? cell.textContent));
    assert.equal(cells[2], `triangle ${element.n}`, `the triangle at ${place}`);
    const shown = Number(cells[6].replaceAll("−", "-"));
    assert.ok(Math.abs(shown - value(element)) <= 1e-4 * Math.abs(value(element)) + 1e-12, `${name}: ${shown}, ${value(element)}`);
  }
  for (const name of await page.locator("#field option").allTextContents()) await page.selectOption("#field", { label: name });
  assert.deepEqual(said, []);
}

/** Gap, pressure and shear at contact nodes, by probes. */
async function surface(browser) {
  const { page, said } = await open(browser, file);
  const nodes = result.contact.filter(({ dy }) => dy === 1);
  const of = { gap: "gap", "contact pressure": "pressure", "contact shear": "shear" };
  await page.click("#zoom-contact");
  for (const [name, key] of Object.entries(of)) {
    await page.selectOption("#field", { label: name });
    for (const node of nodes.slice(0, 3)) {
      const [x, y] = result.nodes[node.node - 1];
      await page.fill("#probe-x", String(x));
      await page.fill("#probe-y", String(y));
      await page.click("#probe button");
      const cells = await page.locator("#probes tbody tr").last().locator("td").evaluateAll((all) => all.map((cell) => cell.dataset.exact ?? cell.textContent));
      assert.deepEqual([cells[2], cells[6]], [`node ${node.node}`, String(node[key])]);
    }
  }
  await page.locator("#view-0").focus();
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#probes tbody tr").last().locator("td").nth(2).textContent(), /^node \d+$/);
  assert.deepEqual(said, []);
}

/** The tables of a run; both runs can be any. */
async function iterations(browser) {
  const { page, said } = await open(browser, file);
  for (const [k, list] of [result.iterations, result.bodies, result.contact].entries()) {
    assert.equal(await page.locator("#iterations table").nth(k).locator("tbody tr").count(), list.length);
  }
  for (const side of [0, 1]) {
    const count = await page.locator(`#run-${side} option`).count();
    for (let k = 0; k < count; k += 1) await page.selectOption(`#run-${side}`, { index: k });
  }
  await page.click("#zoom-contact");
  await page.click("#whole");
  assert.deepEqual(said, []);
}

/** The audit's tables, whole, and as CSV; what its verdict leaves out. */
async function tables(browser) {
  const { page } = await open(browser, file);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  for (const [title, list] of [["Claims of the paper", audit.claims], ["1. Readings", audit.readings], ["2. Findings", audit.findings], ["3. Variants", audit.variants]]) {
    assert.equal(await rows(page, title), list.length, title);
  }
  const text = await page.textContent("article");
  for (const id of audit.conclusion.unpriced) assert.ok(text.includes("Present, but not reintroduced:") && text.includes(id), id);
  await page.click("#menu > summary");
  await page.click('#menu a[href="#readings"]');
  await page.click('button[aria-label^="copy as CSV: 2. Findings"]');
  const csv = await page.evaluate(() => navigator.clipboard.readText());
  const lines = csv.trimEnd().split("\r\n");
  assert.equal(lines.length, audit.findings.length + 1);
  const fourth = audit.findings[3];
  const [start, value] = lines[4].split(`,${fourth.verdict},`);
  assert.equal(start, `${fourth.id},"${fourth.listing} ${fourth.lines.join(", ")}"`);
  assert.equal(Number(value.split(",")[0]), fourth.number);
  await page.click("#menu > summary");
  await page.locator("#menu a").last().click();
  await page.locator("#fields").waitFor();
}

/** Each part unfolds from its row: a claim its sentence, value and command, a finding its lines, scene and picture. */
async function unfolds(browser) {
  const { page, said } = await open(browser, file);
  const claim = audit.claims[2];
  const part = page.locator(`#${claim.id.toLowerCase()}`);
  assert.equal(await part.getByText(claim.quote).isVisible(), false);
  await page.locator(`.claims a[href="#${claim.id.toLowerCase()}"]`).focus();
  await page.keyboard.press("Enter");
  for (const words of [claim.quote, claim.condition, claim.command.join(" ")]) await part.getByText(words).first().waitFor();
  const finding = page.locator("#k1");
  await page.locator('.verdict a[href="#k1"]').click();
  await finding.locator("pre").first().waitFor();
  assert.ok(await finding.locator("img").evaluate(async (image) => (await image.decode(), image.naturalWidth > 100)));
  const titles = await page.locator('#first a[href^="#"]').evaluateAll((all) => all.map(({ title }) => title));
  assert.ok(titles.length > 10 && titles.every((title) => title.length > 10), String(titles));
  assert.deepEqual(said, []);
}

/** Without a script the page has the whole report. */
async function readable(browser) {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(pathToFileURL(file).href);
  const text = await page.textContent("body");
  for (const part of ["No. As printed", "Beside the verdict", "Each finding in full", "SHA-256"]) assert.ok(text.includes(part), part);
  assert.equal(await page.locator("#first img").evaluateAll((all) => all.filter((image) => image.checkVisibility()).length), 2);
  assert.equal(await page.locator("#fields").isVisible(), false);
}

/** Printed on A4, 180 mm between the margins: no table is wider, no cell is cut, and figures stand in
 * place of the fields under the pointer. */
async function printed(browser) {
  const { page } = await open(browser, file);
  const width = Math.floor((180 / 25.4) * 96);
  await page.setViewportSize({ width, height: 1000 });
  await page.emulateMedia({ media: "print" });
  const wide = await page.evaluate((width) => {
    const right = (element) => element.getBoundingClientRect().right > width + 0.5;
    const cut = (element) => element.scrollWidth > element.clientWidth + 1;
    const of = (selector, is) => [...document.querySelectorAll(selector)].filter(is).map((element) => element.textContent.slice(0, 80));
    return [...of("table, pre, img", right), ...of("th, td, pre", cut)];
  }, width);
  assert.deepEqual(wide, []);
  assert.equal(await page.locator("#fields").isVisible(), false);
  assert.ok((await page.locator("article figure img").count()) >= 6);
}

/** The pointer over a picture, dragging, and keys. */
async function moves(browser) {
  const { page, said } = await open(browser, file);
  const canvas = page.locator("#view-0");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height * 0.7];
  await page.mouse.move(...middle);
  assert.match(await page.textContent("#pointed"), /^triangle \d+, .*MPa/);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 40, middle[1] + 20, { steps: 4 });
  await page.mouse.up();
  assert.equal(await page.locator("#probes tbody tr").count(), 0, "a drag takes no probe");
  await page.mouse.click(...middle);
  assert.equal(await page.locator("#probes tbody tr").count(), 1);
  await canvas.focus();
  for (const key of ["ArrowLeft", "+", "-", "Enter"]) await page.keyboard.press(key);
  assert.equal(await page.locator("#probes tbody tr").count(), 2);
  assert.deepEqual(said, []);
}

async function views(browser) {
  await inAllViews(browser, file, async ({ page, check, view }) => {
    await check();
    if (view !== "1440-light") return;
    assert.ok((await page.pdf()).length > 20000, "it prints");
  });
}

const tests = [fields, surface, iterations, tables, unfolds, readable, printed, moves, views];
runAll(tests);
