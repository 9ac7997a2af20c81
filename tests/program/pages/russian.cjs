// The lesson in Russian: every word of it but the listings' and names, in each view and on each chapter.

const assert = require("node:assert");
const { open, inAllViews, run } = require("./browser.cjs");

const [file] = process.argv.slice(2);

/** What has words of its own: the listings and the names in them. */
const OWN = "#listing, #mended code, #step, #editor, #language, #question code, script, style, noscript";

/** Latin words that Russian has too: names of the program, the listings, the keys and the scenes, and what the
 * interpreter says. */
const KEPT = /^(plane|contact|rows|node|elem|trg|cnt|printed|tied|stepped|unilateral|mortar|per|nested|eager|inside|left|right|total|stress|strain|left-to-right|corrected|ntx|nty|far|near|for|min|max|cos|Shift|Home|End|solve|findings|reading|variant|last)$/;

/** The English words that a page shows or says. */
const english = async (page) => {
  const texts = await page.evaluate((own) => {
    const body = document.body.cloneNode(true);
    body.querySelectorAll(own).forEach((element) => element.remove());
    const said = ["title", "alt", "aria-label", "aria-valuetext"].flatMap((name) => [...body.querySelectorAll(`[${name}]`)].map((element) => element.getAttribute(name)));
    const walker = document.createTreeWalker(body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) said.push(walker.currentNode.textContent);
    return [...said, document.title];
  }, OWN);
  return texts.flatMap((text) => (text.match(/(?<![\w:.\/[-])[a-z]{3,}(?![\w[(])/gi) ?? []).filter((word) => /^[a-z]+$/.test(word.slice(1)) && !KEPT.test(word)).map((word) => `${word} in ${text.trim()}`));
};

run(async (browser) => {
  const { page, said } = await open(browser, file);
  assert.equal(await page.getAttribute("html", "lang"), "ru");
  const texts = () => page.evaluate(() => [document.title, document.body.innerText].join());
  const russian = await texts();
  await page.click("#language");
  assert.doesNotMatch((await texts()).replace("Русский", ""), /[а-яё]/i, "all is English");
  const edges = () => page.locator("#nodes button").evaluateAll((all) => all.map((button) => button.getAttribute("aria-label")).join());
  assert.doesNotMatch(await edges(), /[а-яё]/i);
  await page.click("#language");
  assert.doesNotMatch(await edges(), /[a-z]/i);
  assert.equal(await texts(), russian, "the switch there and back leaves nothing behind");
  await page.click("#edit");
  const text = await page.inputValue("#text");
  for (const [from, to, words] of [
    ["|yt[i1]| < c_tll ∧", "|yt[i1]| < ∧", "Строка 16, позиция 30: встретилось `∧`, а ожидается операнд. Вероятная причина: не хватает операнда или знак стоит дважды."],
    ["yt[i1] ← 0", "yt[i1] ← 0 & 1", "такого знака в записи нет"],
    ["      trace(ct[i1])", "        trace(ct[i1])", "Строка 20, позиция 9: отступ 8, а должен быть 6."],
    ["dy[i1] ← 0", "dyy[i1] ← 0", "Имени dyy присваивается значение, но ни одна строка его не использует. Может быть, dy?"],
  ]) {
    await page.fill("#text", text.replace(from, to));
    await page.locator("#text-error", { hasText: words }).waitFor();
  }
  await page.fill("#text", text);
  await page.click("#edit");
  await page.check("#ask");
  for (const index of (await page.locator("#chapter option").all()).keys()) {
    await page.selectOption("#chapter", { index });
    for (const at of ["0", "40"]) {
      await page.locator("#slider").fill(at);
      assert.deepEqual(await english(page), [], `chapter ${index}, step ${at}: ${await english(page)}`);
    }
  }
  await page.selectOption("#chapter", { index: 1 });
  for (const index of (await page.locator("#repairs button").all()).keys()) {
    await page.locator("#repairs button").nth(index).click();
    for (const which of ["c_cnt", "Km", "iterations"]) {
      await page.locator(`input[value=${which}]`).evaluate((radio) => radio.click());
      await page.click("#end");
      assert.deepEqual(await english(page), [], `repair ${index}, ${which}`);
    }
  }
  assert.deepEqual(said, []);
  await inAllViews(browser, file, async ({ page, check }) => {
    await page.locator("#slider").fill("230");
    await page.evaluate(() => window.scrollTo(0, 0));
    await check();
  });
});
