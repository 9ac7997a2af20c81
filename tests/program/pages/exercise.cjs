// The page of an exercise: answers are typed and saved: node exercise.cjs PAGE TYPED SAVED.

const assert = require("node:assert");
const fs = require("node:fs");
const { open, violations, overflows, run } = require("./browser.cjs");

const [file, typed, saved] = process.argv.slice(2);
const { student, answers } = JSON.parse(fs.readFileSync(typed, "utf8"));

run(async (browser) => {
  const phone = await open(browser, file, { width: 390, scheme: "dark" });
  assert.deepEqual(await violations(phone.page), []);
  assert.equal(await overflows(phone.page), false);
  const { page, said } = await open(browser, file);
  // Nothing of the answers is shown: no boxes, arrows or statuses; coordinates have two decimals.
  const picture = await page.evaluate(() => atob(document.getElementById("picture").src.split("base64,")[1]));
  for (const sign of ["dash", "filled nodes", "arrow"]) assert.ok(!picture.includes(sign), sign);
  const [nodes] = await page.locator("#scene table").all();
  for (const text of await nodes.locator("td:not(:first-child)").allTextContents()) assert.match(text, /^-?\d\.\d\d$/);
  assert.deepEqual((await page.locator("#listing li span").allTextContents()).slice(0, 3), ["1", "2", "3"]);
  assert.deepEqual(await violations(page), []);
  await page.fill("#student", student);
  for (const { node, ...values } of answers) {
    for (const [of, value] of Object.entries(values)) await page.fill(`[data-node="${node}"][data-of="${of}"]`, String(value));
  }
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#form button")]);
  assert.match(download.suggestedFilename(), /^answers-\d+\.json$/);
  await download.saveAs(saved);
  assert.deepEqual([...said, ...phone.said], []);
});
