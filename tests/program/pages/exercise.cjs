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
