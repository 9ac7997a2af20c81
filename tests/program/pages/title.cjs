// A page opens without an error and shows its title as it is: node title.cjs PAGE TITLE.

const assert = require("node:assert");
const { open, run } = require("./browser.cjs");

const [file, title] = process.argv.slice(2);

run(async (browser) => {
  const { page, said } = await open(browser, file);
  assert.equal(await page.textContent("h1"), title);
  assert.deepEqual(said, []);
});
