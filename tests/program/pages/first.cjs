// The first screen of a report: node first.cjs PAGE FOLDER. It is whole at 1440 x 900 and on the first page of the
// print, short, and the folder receives its picture.

const assert = require("node:assert");
const { open, inAllViews, runAll } = require("./browser.cjs");

const [file, folder] = process.argv.slice(2);
const PARTS = [".verdict", ".runs", ".claims", ".faults", ".pictures", ".assumed", ".again"];
const bottoms = (page) => page.evaluate((parts) => parts.map((part) => [part, document.querySelector(part).getBoundingClientRect().bottom]), PARTS);

async function screen(browser) {
  const { page, said } = await open(browser, file);
  for (const [part, bottom] of await bottoms(page)) assert.ok(bottom <= 900, `${part} ends at ${bottom}`);
  await page.screenshot({ path: `${folder}/report-1440-light.png` });
  const prose = await page.locator("header h1, header p, #first p, #first li").evaluateAll((all) => all.filter((one) => one.checkVisibility()).map((one) => one.innerText));
  const words = (text) => text.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;
  const count = words(prose.join(" "));
  assert.ok(count <= 220, `${count} words of prose`);
  const all = words(await page.innerText("header div") + " " + (await page.innerText("#first")));
  assert.ok(all <= 350, `${all} words`);
  assert.match(await page.innerText(".verdict h2"), /^No\. /);
  for (const sentence of prose.flatMap((text) => text.split(/[.:;](?=\s)/))) assert.ok(words(sentence) <= 30, sentence);
  assert.deepEqual(said, []);
}

/** A4 has 180 x 273 mm between the margins. */
async function paper(browser) {
  const { page } = await open(browser, file);
  const [width, height] = [180, 273].map((mm) => Math.floor((mm / 25.4) * 96));
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ media: "print" });
  for (const [part, bottom] of await bottoms(page)) assert.ok(bottom <= height, `${part} ends at ${bottom}`);
  const sizes = await page.evaluate(() => [...document.querySelectorAll("#first *, article *")].filter((one) => one.checkVisibility() && one.textContent.trim()).map((one) => 0.75 * parseFloat(getComputedStyle(one).fontSize)));
  assert.ok(Math.min(...sizes) >= 6.99, `${Math.min(...sizes)} pt`);
  const printed = (await page.pdf({ preferCSSPageSize: true })).toString("latin1").match(/\/Type\s*\/Page\b/g);
  assert.ok(printed.length <= 24, `${printed.length} pages`);
  const meanings = await page.innerText(".key");
  const ids = await page.locator(".claims a").evaluateAll((all) => all.map(({ textContent }) => textContent));
  for (const id of ids) assert.match(meanings, new RegExp(`\\b${id} \\w`));
}

const views = (browser) => inAllViews(browser, file, ({ check }) => check());

runAll([screen, paper, views]);
