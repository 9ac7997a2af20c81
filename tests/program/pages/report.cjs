// A report in a browser: node report.cjs PAGE AUDIT. AUDIT is what audit --json prints.

const assert = require("node:assert");
const fs = require("node:fs");
const { pathToFileURL } = require("node:url");
const { open, inAllViews, runAll } = require("./browser.cjs");

const [file, auditFile] = process.argv.slice(2);
const audit = JSON.parse(fs.readFileSync(auditFile, "utf8"));

const rows = (page, title) => page.locator(`article div[aria-label^="${title}"] tbody tr`).count();

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
  await page.locator("article details[open] pre").last().waitFor();
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
}

/** Printed on A4, 180 mm between the margins: no table is wider, no cell is cut, and figures stand in
 * their places. */
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
  assert.ok((await page.locator("article figure img").count()) >= 6);
}

async function views(browser) {
  await inAllViews(browser, file, async ({ page, check, view }) => {
    await check();
    if (view !== "1440-light") return;
    assert.ok((await page.pdf()).length > 20000, "it prints");
  });
}

const tests = [tables, unfolds, readable, printed, views];
runAll(tests);
