// The fields of a report, drawn pixel by pixel: node large.cjs PAGE TRIANGLES. Prints how long the
// page takes to load and how many frames a second a moving view has.

const assert = require("node:assert");
const { open, run, drawn } = require("./browser.cjs");

const [file, count] = process.argv.slice(2);
const FIELD = "displacement uy";

/** What the page holds of its mesh, and the left canvas with its place. */
const held = (page) => page.evaluate(() => {
  const { mesh, colours } = JSON.parse(document.getElementById("data").textContent);
  const numbers = (Kind, text) => [...new Kind(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer)];
  const canvas = document.getElementById("view-0");
  const { width, height } = canvas;
  return {
    nodes: numbers(Float32Array, mesh.nodes), triangles: numbers(Uint32Array, mesh.triangles),
    surfaces: [...mesh.contact, ...mesh.edges.flat()], colours,
    width, height, pixels: [...canvas.getContext("2d").getImageData(0, 0, width, height).data],
    shown: canvas.clientWidth,
  };
});

/** Where a node is in the left picture of the whole mesh, in its pixels. */
function places({ nodes, width, height }) {
  const [x, y] = [0, 1].map((j) => nodes.filter((_, k) => k % 2 === j));
  const ends = (all) => all.reduce(([low, high], at) => [Math.min(low, at), Math.max(high, at)], [Infinity, -Infinity]);
  const [[left, right], [low, high]] = [ends(x), ends(y)];
  const scale = 0.94 * Math.min(width / (right - left), height / (high - low));
  return (n) => [width / 2 + (x[n] - (left + right) / 2) * scale, height / 2 - (y[n] - (low + high) / 2) * scale];
}

/** A hundred triangles drawn at random that no line of a surface crosses: the colour in the middle of
 * each, and what the page says of it under the pointer. */
async function pictures(page) {
  await page.selectOption("#field", { label: FIELD });
  const own = await held(page);
  assert.equal(own.triangles.length / 3, Number(count));
  const at = places(own);
  const onSurface = new Set(own.surfaces.map((n) => n - 1));
  const [low, high] = (await page.getAttribute("#scale", "aria-label")).match(/[−\d.e]+/g).map((text) => Number(text.replaceAll("−", "-"))).filter(Number.isFinite);
  const canvas = page.locator("#view-0");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const random = drawn(7);
  for (let k = 0; k < 100; ) {
    const t = Math.floor(random() * count);
    const corners = own.triangles.slice(3 * t, 3 * t + 3);
    if (corners.some((n) => onSurface.has(n))) continue;
    k += 1;
    const [x, y] = [0, 1].map((j) => corners.reduce((sum, n) => sum + at(n)[j], 0) / 3);
    const ratio = own.width / own.shown;
    await page.mouse.move(box.x + 1 + x / ratio, box.y + 1 + y / ratio);
    const said = await page.textContent("#pointed");
    assert.ok(said.startsWith(`triangle ${t + 1}, `), `triangle ${t + 1} under the pointer: ${said}`);
    const value = Number(/ (\S+) mm;/.exec(said)[1].replaceAll("−", "-"));
    const pixel = 4 * (Math.floor(y) * own.width + Math.floor(x));
    const shade = own.colours.findIndex((shade) => shade.every((part, j) => part === own.pixels[pixel + j]));
    assert.equal(own.pixels[pixel + 3], 255, `triangle ${t + 1} is drawn`);
    const expected = ((value - low) / (high - low)) * own.colours.length;
    assert.ok(Math.abs(shade + 0.5 - expected) < 0.6, `triangle ${t + 1}: shade ${shade} for ${value}, which is ${expected}`);
  }
}

/** A dragged picture goes with the pointer. */
async function drags(page) {
  const box = await page.locator("#view-0").boundingBox();
  const start = [box.x + box.width / 2 - 80, box.y + box.height * 0.75];
  const pointed = async (x, y) => (await page.mouse.move(x, y), page.textContent("#pointed"));
  const before = await pointed(...start);
  assert.match(before, /^triangle/);
  await page.mouse.down();
  await page.mouse.move(start[0] + 60, start[1] - 40, { steps: 6 });
  await page.mouse.up();
  assert.equal(await pointed(start[0] + 60, start[1] - 40), before);
}

/** Frames a second while the view moves, by its own events. */
const frames = (page) => page.evaluate(async () => {
  const canvas = document.getElementById("view-0");
  const press = (key) => canvas.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const frame = () => new Promise(requestAnimationFrame);
  const begin = await frame();
  let now = begin;
  for (let k = 0; k < 60; k += 1) {
    press(k % 20 < 10 ? "ArrowLeft" : "ArrowRight");
    now = await frame();
  }
  return 60000 / (now - begin);
});

run(async (browser) => {
  const { page, said } = await open(browser, file);
  const load = await page.evaluate(() => performance.getEntriesByType("navigation")[0].loadEventEnd);
  await pictures(page);
  await drags(page);
  console.log(`${count} triangles: loaded in ${Math.round(load)} ms, ${Math.round(await frames(page))} frames a second`);
  assert.deepEqual(said, []);
});
