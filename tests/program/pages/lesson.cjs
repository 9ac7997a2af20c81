// The lesson of fig. 1 in a browser: node lesson.cjs PAGE FOLDER TRACE_OF_C_CNT TRACE_OF_KM REPAIRS LISTINGS. The
// folder receives a picture.

const assert = require("node:assert");
const fs = require("node:fs");
const { WIDTHS, open, violations, overflows, inAllViews, runAll, drawn } = require("./browser.cjs");
const { comparing, read } = require("./traced.cjs");

const [file, folder, ofContact, ofStiffness, ofRepairs, ofListings] = process.argv.slice(2);
const traces = { c_cnt: read(ofContact), Km: read(ofStiffness) };

const compare = comparing(traces);

const cellsOf = (page) => page.locator("td[data-name]").evaluateAll((all) => all.map((cell) => cell.dataset.exact));
const chosen = (page, which) => page.locator(`input[value=${which}]`).evaluate((radio) => radio.click());
const select = (page, id, index) =>
  page.locator(id).evaluate((list, index) => {
    list.selectedIndex = index;
    list.dispatchEvent(new Event("change", { bubbles: true }));
  }, index);
const stepsDone = async (page) => Number(/^step (\d+)/.exec(await page.textContent("#status"))[1]);

/** 200 moves drawn at random, each compared with the trace. */
async function walk(browser) {
  const { page, said } = await open(browser, file);
  const random = drawn(14);
  const keys = ["ArrowRight", "ArrowRight", "ArrowLeft", "o", "d", "n", "End", "Home"];
  const visited = new Set();
  for (let k = 0; k < 200; k += 1) {
    const which = k < 100 ? "c_cnt" : "Km";
    if (k % 100 === 0) await chosen(page, which);
    if (random() < 0.4) {
      const at = Math.floor(random() * (traces[which].steps.length + 1));
      await page.locator("#slider").fill(String(at));
    } else {
      await page.evaluate(() => document.activeElement.blur());
      await page.keyboard.press(keys[Math.floor(random() * keys.length)]);
    }
    visited.add(`${which} ${await compare(page, which)}`);
  }
  assert.ok(visited.size > 80, `${visited.size} different states were compared`);
  assert.deepEqual(said, []);
}

/** The steps that a line's number, "decision" and "over" lead to. */
async function runs(browser) {
  const { page } = await open(browser, file);
  const { steps } = traces.c_cnt;
  await page.click("#listing button:text-is('16')");
  assert.equal(await compare(page, "c_cnt"), steps.findIndex(({ line }) => line === 16) + 1);
  await page.click("#start");
  await page.click("#decision");
  assert.equal(steps[await compare(page, "c_cnt")].line, 7, "the first decision is line 7");
  await page.click("#over");
  assert.equal(await compare(page, "c_cnt") > 0, true);
  await page.selectOption("#turns", { index: 2 });
  assert.equal(steps[(await compare(page, "c_cnt")) - 1].turn, 2);
}

/** By keyboard alone: to each control by Tab, a line's number by arrows, a value in full. */
async function keyboard(browser) {
  const { page } = await open(browser, file);
  const reached = new Set();
  for (let k = 0; k < 60; k += 1) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.name || document.activeElement.tagName));
  }
  for (const id of ["run", "which", "forward", "decision", "slider", "turns", "TD"]) assert.ok(reached.has(id), `${id} by Tab: ${[...reached]}`);
  await page.focus("#listing button");
  for (let k = 0; k < 4; k += 1) await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent("#status"), /line 5, as printed$/);
  await page.focus("td[data-name='ct[1]']");
  assert.equal(await page.textContent("#tip"), "ct[1] = 0");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.textContent("#tip"), "yt[1] has no value yet");
}

/** The pointer over a value and over an entry of MJS. */
async function hover(browser) {
  const { page } = await open(browser, file);
  await page.click("#end");
  await page.hover("td[data-name='yt[1]']");
  assert.equal(await page.textContent("#tip"), "yt[1] = -0.0004999999999999996");
  await chosen(page, "Km");
  await page.click("#end");
  const entries = new Map(traces.Km.result.entries.map(([i, j, x]) => [`${i},${j}`, x]));
  const box = await page.locator("#mjs").boundingBox();
  const cell = (box.width - 22) / 26;
  for (const [i, j] of [[1, 1], [3, 4], [17, 3], [12, 12]]) {
    await page.locator("#mjs").hover({ position: { x: 22 + (j - 0.5) * cell, y: 22 + (i - 0.5) * cell } });
    assert.match(await page.textContent("#entry"), new RegExp(`^MJS\\[${i},${j}\\] = ${String(entries.get(`${i},${j}`) ?? 0).replace(".", "\\.")} `));
  }
}

/** Every reading can be chosen; one that stops the listing says so. */
async function readings(browser) {
  const { page, said } = await open(browser, file);
  const names = await page.locator("#run option").allTextContents();
  assert.ok(names.length > 15, names.join(", "));
  const ends = new Map();
  for (const [index, name] of names.entries()) {
    await page.selectOption("#run", { index });
    await page.locator("#slider").evaluate((slider) => {
      slider.value = slider.max;
      slider.dispatchEvent(new Event("input"));
    });
    const stops = await page.textContent("#failure");
    const cells = await page.locator("td[data-name^='dy'], td[data-name^='k_cnt']").evaluateAll((all) => all.map((cell) => cell.dataset.exact));
    ends.set(name, stops + cells.join());
  }
  const printed = ends.get("as printed");
  assert.match(ends.get("R4 = left-to-right"), /The listing stops: .*line 18/);
  for (const name of ["R1 = inside", "R8 = m"]) assert.notEqual(ends.get(name), printed, name);
  for (const name of ["R9: 0/0 = 0", "R5 = node_n"]) assert.equal(ends.get(name), printed, name);
  await chosen(page, "Km");
  await page.selectOption("#run", { label: "R2 = printed" });
  assert.equal(await page.locator("#listing li.edited").count(), 1, "line 7 is marked");
  assert.deepEqual(said, []);
}

/** Questions about what comes next, answered: the verdict is the trace's. */
async function questions(browser) {
  const { page, said } = await open(browser, file);
  const { steps } = traces.c_cnt;
  await page.check("#ask");
  const begin = steps.findIndex(({ turn, line }) => turn === 3 && line === 2);
  await page.locator("#slider").fill(String(begin));
  assert.match(await page.textContent("#question"), /Which target edge will node 2.3 \(7\) get/);
  await page.click("#question button:text-is('edge 2')");
  assert.match(await page.textContent("#question [role=status]"), /^Right\. The boxes that hold the node, in the order of trg: edge 2\./);
  for (const [at, step] of steps.entries()) {
    if (![16, 17, 18].includes(step.line)) continue;
    await page.locator("#slider").fill(String(at));
    await page.click("#question button:text-is('yes')");
    assert.match(await page.textContent("#question [role=status]"), step.writes.length ? /^Right/ : /^No: the answer is no\. .*is false/);
  }
  assert.deepEqual(said, []);
}

/** The tolerance by its slider, a node by the pointer, an edge by its name: the listings run again; the address opens the same. */
async function changed(browser) {
  const { page, said } = await open(browser, file);
  await page.click("#end");
  const printed = await cellsOf(page);
  await page.locator("#tolerance").fill("1");
  assert.equal(await page.textContent("#tolerance-label"), "c_tll 0.01");
  assert.ok((await cellsOf(page)).includes("dy[4] = 1"), "node 2.4 lies within 0.01");
  await page.click("#reset");
  assert.deepEqual(await cellsOf(page), printed);
  const box = await page.locator("#nodes button").nth(2).boundingBox();
  await page.mouse.move(box.x + 12, box.y + 12);
  await page.mouse.down();
  const still = page.locator("#nodes button").nth(2);
  for (let k = 1; k <= 5; k += 1) {
    await page.mouse.move(box.x + 12 + 5 * k, box.y + 12 + k);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const at = await still.boundingBox();
    assert.ok(Math.hypot(at.x - box.x - 5 * k, at.y - box.y - k) < 1, "the node stays under the pointer");
  }
  await page.mouse.up();
  const moved = await cellsOf(page);
  assert.notDeepEqual(moved, printed);
  assert.ok((await page.locator("#changes tbody tr").count()) > 0);
  await page.waitForURL(/moved=\d/);
  const again = await page.context().newPage();
  await again.goto(page.url());
  assert.deepEqual(await cellsOf(again), moved, "the address opens the same situation");
  await page.click("#reset");
  await page.click("#nodes [data-edge='3']");
  const turned = await cellsOf(page);
  assert.notDeepEqual(turned, printed, "the last edge runs the other way");
  await page.waitForURL(/turned=3/);
  await again.goto(page.url());
  assert.deepEqual(await cellsOf(again), turned, "the address turns the edge");
  await page.click("#nodes [data-edge='3']");
  assert.deepEqual(await cellsOf(page), printed);
  assert.deepEqual(said, []);
}

/** The listing edited in place: the page runs it, says where it leaves the notation, shows what differs, keeps it over
 * chapters and reloads, and shows the print again at a click; the file that it saves is what was typed. */
async function edited(browser) {
  const { page, said } = await open(browser, file);
  await page.click("#end");
  const printed = await cellsOf(page);
  const [title, error] = [page.locator("#listing-title"), page.locator("#text-error")];
  await page.click("#edit");
  const text = await page.inputValue("#text");
  assert.equal(await page.textContent("#caret"), "line 1, column 1");
  const typed = async (from, to) => {
    assert.equal(text.split(from).length, 2, `${from} stands in one line`);
    await page.fill("#text", text.replace(from, to));
  };
  const status = await page.textContent("#status");
  await page.press("#text", "ArrowLeft");
  await page.press("#text", "Home");
  assert.equal(await page.textContent("#status"), status, "the keys of the text do not step");

  await typed("|yt[i1]| < c_tll ∧", "|yt[i1]| < ∧");
  await error.filter({ hasText: "Line 16, column 30: found `∧`, expected an operand. Likely: an operand is missing, or a sign stands twice." }).waitFor();
  assert.equal(await page.getAttribute("#text", "aria-invalid"), "true");
  assert.equal(await page.textContent("#marks mark"), "∧");
  assert.deepEqual(await violations(page), []);
  assert.deepEqual(await cellsOf(page), printed, "a text with an error is not run");
  await page.click("#text-error button");
  assert.equal(await page.textContent("#caret"), "line 16, column 30");
  await page.press("#text", "Home");
  await page.click("#edit");
  assert.equal(await page.isVisible("#text"), true, "an error is mended or taken back first");
  assert.equal(await page.textContent("#caret"), "line 16, column 30", "done leads back to the error");
  assert.match(await error.textContent(), /“done” leads back to the error; “as printed” takes the text back/);
  for (const place of ["#status", "#listing-title"]) assert.match(await page.textContent(place), /as printed, your text has an error and is not run/);
  assert.equal(await page.locator(".columns.stale").count(), 1, "what is shown is not of the text");
  await page.click("#printed");
  assert.equal(await page.inputValue("#text"), text);
  assert.equal(await page.locator(".columns.stale").count(), 0);
  const reloaded = await page.context().newPage();
  await reloaded.goto(page.url().split("#")[0]);
  assert.equal(await reloaded.textContent("#listing-title"), "c_cnt, as printed", "as printed over a reload");
  await reloaded.close();
  await page.click("#mine");
  assert.match(await page.inputValue("#text"), /< ∧/, "a text with an error is kept too");
  await page.locator("#editor").evaluate((editor) => (editor.hidden = true));
  assert.equal(await page.isVisible("#text-error"), true, "its error is said beside the listing too");
  await page.click("#text-error button");
  assert.equal(await page.isVisible("#text"), true);

  await typed("|yt[i1]| < c_tll ∧", "|yt[i1]| ≤ 20 · c_tll ∧");
  await title.filter({ hasText: "c_cnt, edited" }).waitFor();
  assert.match(await page.textContent("#status"), /, edited$/);
  assert.deepEqual([await error.textContent(), await page.getAttribute("#text", "aria-invalid")], ["", "false"]);
  const after = await cellsOf(page);
  assert.ok(!printed.includes("dy[4] = 1") && after.includes("dy[4] = 1"), "node 2.4 comes into contact");
  assert.match(await page.textContent("#changes"), /the edited listing beside as printed.*dy\[4\]01/);
  assert.deepEqual(await violations(page), []);
  await page.click("#edit");
  assert.deepEqual(await page.locator("#listing li.edited button").allTextContents(), ["16"]);
  assert.match(await page.locator("#listing li.edited").textContent(), /^16not as printed: .*20 · c_tll/);
  assert.match(await page.textContent("#legend"), /^yellow: executed last blue: not as printed$/);
  assert.deepEqual(await violations(page), []);
  const saved = page.waitForEvent("download");
  await page.click("#download");
  await (await saved).saveAs(`${folder}/my-c_cnt.txt`);

  await page.waitForURL(/c_cnt=/);
  const again = await page.context().newPage();
  await again.goto(page.url());
  assert.deepEqual(await cellsOf(again), after, "the address opens the same edit");
  assert.equal(await again.textContent("#listing-title"), "c_cnt, edited");
  await again.click("#printed");
  assert.deepEqual(await cellsOf(again), printed);
  assert.equal(await again.textContent("#listing-title"), "c_cnt, as printed");
  assert.equal(await again.locator("#listing li.edited").count(), 0);
  assert.equal(await again.isHidden("#printed"), true);
  await again.click("#mine");
  assert.deepEqual(await cellsOf(again), after, "what was typed comes back");

  await select(page, "#chapter", 3);
  assert.equal(await page.textContent("#listing-title"), "c_cnt, as printed");
  await select(page, "#chapter", 0);
  await page.click("#end");
  assert.deepEqual(await cellsOf(page), after, "another chapter and back");
  await page.goto(page.url().split("#")[0]);
  await page.reload();
  await page.click("#end");
  assert.deepEqual(await cellsOf(page), after, "opened anew");
  await page.goto(page.url().split("#")[0] + "#chapter=fig1&step=3");
  await page.reload();
  assert.equal(await page.textContent("#status"), "step 3 of 277, line 4, as printed", "what a link does not say is as printed");
  assert.deepEqual(said, []);
}

/** What can be read and is hardly meant is marked at once, with its place: each text with what is said of it. */
async function checked(browser) {
  const { page, said } = await open(browser, file);
  await page.click("#edit");
  const text = await page.inputValue("#text");
  for (const [from, to, words] of [
    ["ct[i1] ← 0", "ct[i1] = 0", "Line 3, column 5: = compares and assigns nothing: to assign, write ← or <-."],
    ["dy[i1] ← 0", "dyy[i1] ← 0", "Line 15, column 5: dyy is written, and no line reads it. Did you mean dy?"],
    ["max(ntx)", "mx(ntx)", "mx is not defined. Did you mean"],
    ["i1 ∈ 1 .. R", "i1 ∈ 1 .. Rr", "Line 11, column 17: Rr is not defined. Did you mean R?"],
    ["if dy[i1] = 1", "if dy[i1] == 1", "Likely: to compare, write one =; to assign, write ← or <-"],
    ["yt[i1] ← 0", "yt[i1] ← 0,5", "Likely: a decimal number has a point here: 0.5"],
    ["      trace(ct[i1])", "         trace(ct[i1])", "Likely: two spaces for each level"],
    ["trace(ct[i1])", "trace(ct[i1]", "Line 20, column 12: the bracket that is opened here is not closed."],
    ["ct[i1] ← 0", "ct[i1 ← 0", "Line 3, column 7: the bracket that is opened here is not closed."],
    ["k1 ← 1 −", "k1 ← 1 − 2 k1", "Likely: an operator is missing between two operands"],
  ]) {
    assert.ok(text.includes(from), from);
    await page.fill("#text", text.replace(from, to));
    await page.locator("#text-error", { hasText: words }).waitFor();
    assert.ok((await page.locator("#marks mark").count()) > 0, words);
  }
  for (const which of ["c_cnt", "Km"]) {
    await page.click("#printed");
    await chosen(page, which);
    for (let k = 0; k < (await page.locator("#run option").count()); k += 1) {
      await select(page, "#run", k);
      await page.fill("#text", (await page.inputValue("#text")) + "\n");
      await page.locator("#listing-title", { hasText: "edited" }).waitFor();
      assert.equal(await page.textContent("#text-error"), "", `${which}, reading ${k}: nothing is wrong in what is given`);
    }
  }
  assert.deepEqual(said, []);
}

/** An edit that writes what no scene has, or repeats a line for ever, leaves the page whole. */
async function unforeseen(browser) {
  const { page, said } = await open(browser, file);
  const edits = {
    c_cnt: [["ct[i1] ← 0", "ct[i1] ← 7.5"], ["yt[i1] ← 0\n", 'yt[i1] ← "no"\n'], ["k_cnt[i1,i2] ← 0", "k_cnt[i1,i2] ← 9999"], ["dy[i1] ← 0", "while 1\n      dy[i1] ← 0"], ["i1 ∈ 1 .. R", "i1 ∈ 1 .. R + 5"]],
    Km: [["n ∈ 1 .. M", "n ∈ 0 .. M + 1"], ["MJS[V[i],V[j]] +", "5000 +"]],
  };
  for (const [which, pairs] of Object.entries(edits)) {
    await chosen(page, which);
    await page.click("#edit");
    for (const [from, to] of pairs) {
      const text = await page.inputValue("#text");
      assert.ok(text.includes(from), from);
      await page.fill("#text", text.replace(from, to));
      await page.locator("#listing-title", { hasText: ", edited" }).waitFor();
      for (const at of [0, 0.3, 0.6, 1]) {
        const last = Number(await page.getAttribute("#slider", "max"));
        await page.locator("#slider").fill(String(Math.floor(at * last)));
      }
      assert.equal(await page.getAttribute("#text", "aria-invalid"), "false");
      await page.click("#printed");
    }
    await page.click("#edit");
  }
  assert.deepEqual(said, []);
}

/** The chapter of each finding, and what its repair changes. */
async function chapters(browser) {
  const { page, said } = await open(browser, file);
  const names = await page.locator("#chapter option").allTextContents();
  assert.equal(names.length, 26);
  let [repaired, priced] = [0, 0];
  for (const [index, name] of names.entries()) {
    await page.selectOption("#chapter", { index });
    await page.click("#end");
    if (index < 2) continue;
    assert.match(await page.textContent("#finding h2"), new RegExp(`^${name.split(":")[0]} `));
    assert.equal(await page.textContent("#title"), name, "the chapter's name says what it is about");
    const conclusion = await page.locator("#conclusion dd").allTextContents();
    assert.equal(conclusion.length, 4, `${name}: what was done, what is wrong, what it costs, what repairs it`);
    for (const text of conclusion) assert.match(text, /\.$/, "a sentence");
    assert.match(conclusion[0], /^On scene [CK]\d+, /);
    assert.doesNotMatch(conclusion[0], /(ct|yt|dy|k_cnt) −?\d|\[\d/, "no values by the names of variables");
    assert.doesNotMatch(conclusion[2], /: −?[\d.]+\.$/, "no number behind a label");
    priced += conclusion[2].includes("in energy") ? 1 : 0;
    if ((await page.locator("#run option").count()) < 2) {
      assert.match(conclusion[3], /; solve findings\//, `${name}: why there is no repair`);
      continue;
    }
    assert.match(conclusion[3], /; choose the reading “repaired”/);
    await page.selectOption("#run", { label: "repaired" });
    assert.ok((await page.locator("#changes tbody tr").count()) > 0, `${name}: the repair changes something`);
    for (const which of ["c_cnt", "Km"]) {
      if (!(await page.locator(`input[value=${which}]`).isEnabled())) continue;
      await chosen(page, which);
      const last = Number(await page.getAttribute("#slider", "max"));
      for (let at = 0; at <= last; at += Math.ceil(last / 12)) await page.locator("#slider").fill(String(at));
    }
    repaired += 1;
  }
  assert.equal(repaired, 20);
  assert.ok(priced > 3, `${priced} conclusions have the audit's error`);
  await page.selectOption("#chapter", { index: names.findIndex((name) => name.startsWith("C4")) });
  await page.selectOption("#run", { label: "repaired" });
  const changed = await page.locator("#changes tbody tr").allTextContents();
  assert.deepEqual(changed.slice(0, 2), ["dy[1]10", "dy[2]01"]);
  await page.selectOption("#chapter", { index: names.findIndex((name) => name.startsWith("C1:")) });
  await page.click("#question button:text-is('no')");
  assert.match(await page.textContent("#question [role=status]"), /^Right\. .*: no box of lines 5 and 6 holds it, although it is nearer than c_tll = 0\.1\./);
  assert.deepEqual(said, []);
}

/** A link to one edited line is short, and opens what was edited. */
async function linked(browser) {
  const { page, said } = await open(browser, file);
  await page.click("#edit");
  const text = (await page.inputValue("#text")).replace("max(nty)", "max(nty) + c_tll");
  await page.fill("#text", text);
  await page.waitForURL(/c_cnt=/);
  await page.click("#link");
  const link = new URL(page.url()).hash;
  assert.ok(link.includes("c_cnt=") && link.length < 300, `${link.length} characters`);
  assert.doesNotMatch(await page.textContent("#said"), /file:/);
  const { page: other } = await open(browser, file);
  await other.goto(other.url().split("#")[0] + link);
  await other.click("#edit");
  assert.equal(await other.inputValue("#text"), text);
  assert.deepEqual(said, []);
}

/** K1: as printed nothing joins the bodies and the target bears nothing; repaired its matrix joins them, and solved it
 * has the corrected algorithm's result. What else is written between the bodies is not taken for eq. (1). */
async function joined(browser) {
  const { page, said } = await open(browser, file);
  const caption = () => page.textContent("#matrix-caption");
  const offered = () => page.locator("#variant option").evaluateAll((all) => all.map(({ value }) => value));
  const last = async (variant) => {
    await page.selectOption("#variant", variant);
    await page.locator("#slider").fill("20");
    return /The target bears .*$/.exec(await page.textContent("#state"))[0];
  };
  await page.goto(page.url().split("#")[0] + "#chapter=K1&step=9999");
  assert.match(await caption(), /0 of \d+ filled; these are framed\. Framed red: the 4 entries at stake/);
  await page.selectOption("#run", { label: "repaired" });
  assert.match(await caption(), /4 of \d+ filled/, "node 7 along y with nodes 1 and 2 along y, both ways");
  await page.locator("#finding button:text-is('play them repaired')").evaluate((trial) => trial.click());
  assert.equal(await page.inputValue("#variant"), "printed");
  assert.deepEqual(await offered(), ["printed", "corrected"]);
  assert.match(await page.textContent("#course"), /MJS has eq\. \(1\) in it/);
  const right = "The target bears 85.7 % of the load. Error 0 %.";
  for (const variant of await offered()) assert.equal(await last(variant), right, variant);
  await page.selectOption("#variant", "printed");
  assert.match(await page.textContent("#status"), /, c_cnt as printed, Km repaired$/);
  assert.equal(await page.isDisabled("#ask"), true);
  await page.locator("#finding button:text-is('play the iterations')").evaluate((trial) => trial.click());
  assert.match(await page.textContent("#status"), /, as printed$/);
  assert.equal(await last("printed"), "The target bears 0 % of the load. Error 96.8 %.");
  for (const variant of ["tied", "stepped", "corrected"]) assert.equal(await last(variant), right, variant);
  assert.match(await page.textContent("#errors-caption"), /\(node to segment, initial geometry, without friction\)/);

  await chosen(page, "Km");
  await page.click("#edit");
  const text = await page.inputValue("#text");
  const line = "      for j ∈ 1 .. 6\n        MJS[V[i],V[j]] ←";
  assert.ok(text.includes(line));
  await page.fill("#text", text.replace(line, "      for j ∈ 1 .. 6\n        MJS[V[i],1] ← MJS[V[i],1] + 1\n        MJS[V[i],V[j]] ←"));
  await page.locator("#changes", { hasText: "Your edit is another one than the chapter's repair" }).waitFor();
  await chosen(page, "iterations");
  assert.deepEqual(await offered(), ["printed", "corrected"]);
  assert.doesNotMatch(await last("printed"), /Error 0 %/, "a nonsense between the bodies");
  assert.match(await page.textContent("#course"), /Your edit is another one than the chapter's repair: \d+ values differ/);
  await chosen(page, "Km");
  await page.selectOption("#run", { label: "repaired" });
  await page.click("#printed");
  await page.selectOption("#run", { label: "repaired" });
  const repaired = await page.inputValue("#text");
  await page.click("#printed");
  await page.fill("#text", repaired);
  await page.locator("#changes", { hasText: "Your edit does what the chapter's repair does" }).waitFor();
  await chosen(page, "iterations");
  assert.equal(await last("printed"), right, "the repair, typed");
  assert.deepEqual(said, []);
}

/** C9: the repair alone finds the deep node an edge and, the scene being turned, brings it into contact. C1 says that no
 * load acts. A conclusion says of what it speaks and a file what it holds. */
async function deep(browser) {
  const { page, said } = await open(browser, file);
  const to = (address) => page.goto(page.url().split("#")[0] + address);
  await to("#chapter=C9&run=repaired&step=9999");
  const changes = await page.locator("#changes tbody tr").allTextContents();
  assert.deepEqual(changes.slice(0, 3), ["ct[2]01", "yt[2]0−0.3", "dy[2]01"]);
  assert.match(await page.textContent("#gaps-caption"), /The target's side is tinted\. Above the line: yt < 0/);
  const nameOf = async () => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
    return file.suggestedFilename();
  };
  assert.equal(await nameOf(), "repaired-c_cnt.txt");
  await page.selectOption("#run", { label: "as printed" });
  assert.match(await page.textContent("#zone-caption"), /Open: not in contact\./);
  assert.equal(await nameOf(), "c_cnt.txt");
  assert.equal(await page.locator("#conclusion dt", { hasText: "Of what" }).count(), 0);
  await page.locator("#tolerance").fill("1");
  assert.match(await page.locator("#conclusion dd").last().textContent(), /as given, not of your changes/);
  await to("#chapter=C1");
  await page.locator("#title", { hasText: "C1: the search box grows" }).waitFor();
  assert.match(await page.textContent("#finding"), /No load acts on this scene: only the corrected iterations/);
  await page.click("#end");
  assert.match(await page.textContent("#conclusion"), /On scene fig1 with contact nodes lower by 10 c_tll, the fault C1 and C14 stops the run/);
  await to("#chapter=K1&step=999");
  await page.locator("#conclusion", { hasText: "the stamp moves by 0.05, the target by 0" }).waitFor();
  assert.deepEqual(said, []);
}

/** The chapter from the print to the right answer: its rows are those of `audit --prices --repairs`, and each opens the
 * programs with the faults that are left, whose last iteration has the row's error. */
async function repairs(browser) {
  const { page, said } = await open(browser, file);
  const { repairs } = read(ofRepairs);
  const listings = read(ofListings);
  // A row that rounding decides has no figure, and is not at the answer.
  const needed = repairs.findLastIndex(({ energy_relative }) => !(energy_relative <= 1e-9)) + 1;
  await select(page, "#chapter", 1);
  assert.equal(await page.textContent("#title"), `From the print to the right answer in ${needed} edits`);
  const rows = await page.locator("#repairs tbody tr").evaluateAll((all) => all.map(({ cells }) => [...cells].map(({ textContent, dataset }) => dataset.exact ?? textContent)));
  assert.deepEqual(rows.map(([count]) => Number(count)), [...Array(needed + 1).keys(), repairs.length - 1]);
  for (const [k, [count, finding, error, transmitted, inContact, words]] of rows.entries()) {
    const row = repairs[count];
    if (row.energy_relative === undefined) {
      assert.ok(Number.isNaN(Number(error)), error);
      continue;
    }
    assert.ok(Math.abs(error - row.energy_relative) < 1e-9, `${error}, ${row.energy_relative}`);
    assert.deepEqual([Number(transmitted), Number(inContact)], [row.transmitted, row.in_contact]);
    if (k < rows.length - 1) assert.ok(finding === (row.finding ?? "–") && words.startsWith(row.fault), words);
    else assert.match(words, /^Not needed here: /);
    await page.locator("#repairs tbody td.words").nth(k).click();
    assert.equal(await page.locator("#repairs tr.current button").textContent(), count);
    for (const which of ["c_cnt", "Km"]) {
      await chosen(page, which);
      await page.click("#end");
      assert.deepEqual(await page.locator("#listing li code").allTextContents(), listings[k][which], `${which} after ${count} repairs`);
      assert.equal(await page.textContent("#failure"), "");
    }
    await chosen(page, "iterations");
    await page.click("#end");
    const [share, last] = [.../[\d.]+(?= %)/g[Symbol.matchAll](await page.textContent("#state"))].map(Number);
    assert.equal(last, Number((100 * error).toPrecision(3)), `the error after ${count} repairs`);
    assert.equal(share, Number((100 * transmitted).toPrecision(3)), `the load on the target after ${count} repairs`);
    await chosen(page, "c_cnt");
  }
  await page.focus("#repairs button");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent("#listing-title"), /after 1 repair$/);
  assert.equal(await page.isChecked("input[value=Km]"), true, "K1 is repaired in Km");
  await page.waitForURL(/chapter=repairs&run=after\+1/);
  await page.click("#repairs a:text-is('K5')");
  await page.locator("#title", { hasText: "K5: eq. (1) on total" }).waitFor();
  assert.deepEqual(said, []);
}

/** The iterations by their keys and played to the end: the words, and the columns of the table. K5 alternates. */
async function iterations(browser) {
  const { page, said } = await open(browser, file);
  await chosen(page, "iterations");
  const variants = await page.locator("#variant option").evaluateAll((all) => all.map(({ value }) => value));
  assert.deepEqual(variants, ["printed", "tied", "stepped", "corrected"]);
  for (const variant of variants) {
    await page.selectOption("#variant", variant);
    await page.click("#end");
    assert.match(await page.textContent("#course"), variant === "corrected" ? /^It ends with iteration 3/ : /settled from iteration 1 on, in contact: 2\.1 \(5\), 2\.2/);
    assert.match(await page.textContent("#state"), /^Iteration \d+ of \d+, in contact: .* The target bears \d+ % of the load\. Error [\d.]+ %\.$/);
    assert.match(await page.textContent("#shape-caption"), /^Displacements are drawn \d+ times/);
  }
  await page.selectOption("#chapter", { label: (await page.locator("#chapter option").allTextContents()).find((name) => name.startsWith("K5")) });
  assert.equal(await page.textContent("#title"), "K5: eq. (1) on total displacements takes a gap that closed back to its initial width");
  await page.click("#finding button:text-is('play the iterations')");
  await page.locator("#status", { hasText: "iteration 3 of 20" }).waitFor();
  await page.keyboard.press("p");
  assert.match(await page.textContent("#course"), /two states alternate \(no node in contact; in contact: 2\.1 \(4\)\)/);
  const cells = await page.locator("#states tbody tr").first().locator("td").allTextContents();
  assert.equal(cells.join(""), "○●".repeat(10));
  await page.waitForURL(/listing=iterations.*variant=tied/);
  const again = await page.context().newPage();
  await again.goto(page.url());
  assert.equal(await again.textContent("#course"), await page.textContent("#course"), "the address opens the iterations");
  assert.deepEqual(said, []);
}

/** What a button brings into MJS on the way over an element is marked in K. */
async function assembly(browser) {
  const { page, said } = await open(browser, file);
  await chosen(page, "Km");
  for (let k = 0; k < 3; k += 1) await page.click("#turn");
  assert.equal(await page.locator("#block td.read").count(), 36);
  await page.click("#end");
  assert.match(await page.textContent("#matrix-caption"), /Grey: the entries between the two bodies, 0 of \d+ filled;/);
  assert.deepEqual(said, []);
}

/** The page opens with a question about each contact node, with a hint and the reason; the tour goes on by keyboard alone and
 * covers nothing that it explains; what has the focus is explained; at the end stands the conclusion. */
async function opening(browser) {
  const { page, said } = await open(browser, file);
  const verdict = () => page.textContent("#question [role=status]");
  for (const [k, [answer, hint, why]] of [
    ["yes", /^It is 0\.0005 away from the target\./, /^Right\. 2\.1 \(5\) is 0\.0005 away from the target, and is found: yt = −0\.0005; line 16 holds\./],
    ["no", /^It is 0\.0005 away/, /^No: the answer is yes\. 2\.2/],
    ["yes", /^It is 0\.0015 away/, /^Right\. 2\.3 \(7\) is 0\.0015 away from the target, and is taken all the same: yt = −0\.0015; line 17 holds\./],
    ["yes", /^It is 0\.004 inside/, /^No: the answer is no\. 2\.4 \(8\) is the deepest, 0\.004 inside the target, and is missed: yt = 0\.004; line 16 wants \|yt\[i1\]\| < c_tll; line 17 wants yt\[i1\] < 0/],
    ["no", /^It is 0\.0008 away/, /^No: the answer is yes\. 2\.5/],
  ].entries()) {
    assert.equal(await page.textContent("#question h3"), `Which nodes touch? Node ${k + 1} of 5`);
    await page.click("#question button:text-is('hint')");
    assert.match(await page.locator("#question p").nth(2).textContent(), hint);
    await page.click(`#question button:text-is('${answer}')`);
    assert.match(await verdict(), why);
    assert.equal((await verdict()).includes("That was the last node."), k === 4);
    await page.click("#question button:text-is('next')");
  }
  assert.equal(await page.isHidden("#question"), true);
  assert.equal(await page.isHidden("#conclusion"), true, "what is to be found out is not said before");
  await page.click("#end");
  const conclusion = await page.locator("#conclusion dd").allTextContents();
  assert.deepEqual(conclusion, ["c_cnt (as printed) finds, in contact: 2.1 (5), 2.2 (6), 2.3 (7), 2.5 (9).", "Inside the target and missed: 2.4 (8). Farther away than c_tll and taken: 2.3 (7).", "Under printed it leaves an error of 95.9 % in energy.", "From the print to the right answer in 7 edits", "2 of 5 right"]);
  await select(page, "#chapter", 2);
  await page.click("#question button:text-is('no')");
  assert.match(await page.textContent("#question [role=status]"), /\(\d of 1 right\).* That was the last node\./, "each chapter counts anew");
  await select(page, "#chapter", 0);

  await page.reload();
  await page.goto(page.url().split("#")[0]);
  await page.reload();
  await page.focus("#question button:text-is('tour: five steps')");
  await page.keyboard.press("Enter");
  for (let k = 1; k <= 5; k += 1) {
    assert.equal(await page.textContent("#tour h2"), `Tour, ${k} of 5`);
    assert.deepEqual(await violations(page), []);
    const [a, b] = await page.evaluate(() => [".toured", "#tour"].map((selector) => document.querySelector(selector).getBoundingClientRect().toJSON()));
    assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top, `step ${k}: the box covers what it explains`);
    await page.keyboard.press("Enter");
  }
  assert.equal(await page.locator("#tour").count(), 0, "the last step closes it");
  await page.click("#question button:text-is('tour: five steps')");
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#tour").count(), 0);
  await page.focus("td[data-name='ct[1]']");
  assert.match(await page.textContent("#meaning"), /^ct: the number of each contact node's target edge/);
  await page.hover("th[data-name='dy']");
  assert.match(await page.textContent("#meaning"), /^dy: 1 for a contact node in contact/);
  assert.deepEqual(said, []);
}

/** A number may be typed with a point or a comma; what is none is said. */
async function numbers(browser) {
  const { page, said } = await open(browser, file);
  const at = traces.c_cnt.steps.findIndex(({ line, turn, writes }) => line === 10 && turn === 4 && writes.length);
  await page.check("#ask");
  for (const [text, verdict] of [["0,5o", /^“0,5o” is not a number\.$/], ["0,004", /^Right\./], ["0.004", /^Right\./], ["−0.004", /^No: the answer is 0\.004\./], ["4", /^No/]]) {
    await page.locator("#slider").fill("0");
    await page.locator("#slider").fill(String(at));
    assert.match(await page.textContent("#question"), /Line 10: what will yt\[4\] be\?/);
    await page.fill("#question input", text);
    await page.press("#question input", "Enter");
    assert.match(await page.textContent("#question [role=status]"), verdict, text);
  }
  assert.deepEqual(said, []);
}

/** Whether an element is in the window, above the bar of controls, and in each box that scrolls around it;
 * of what is higher than such a box, its top. */
const isSeen = (page, selector) =>
  page.locator(selector).first().evaluate((element) => {
    const { left, top, right, bottom } = element.getBoundingClientRect();
    let seen = { top: 0, bottom: document.querySelector(".controls").getBoundingClientRect().top, left: 0, right: window.innerWidth };
    for (let box = element.parentElement; box; box = box.parentElement) {
      if (getComputedStyle(box).overflow === "visible") continue;
      const own = box.getBoundingClientRect();
      seen = { top: Math.max(seen.top, own.top), bottom: Math.min(seen.bottom, own.bottom), left: Math.max(seen.left, own.left), right: Math.min(seen.right, own.right) };
    }
    const isIn = left >= seen.left - 1 && right <= seen.right + 1 && top >= seen.top - 1 && (bottom <= seen.bottom + 1 || bottom - top > seen.bottom - seen.top);
    const middle = document.elementFromPoint((left + right) / 2, (Math.max(top, seen.top) + Math.min(bottom, seen.bottom)) / 2);
    return bottom > top && isIn && (element.contains(middle) || element.parentElement.contains(middle));
  });

/** Figure, current line and question are seen together at each size, in chapters and steps drawn at random. */
async function together(browser) {
  const random = drawn(46);
  for (const width of Object.keys(WIDTHS).map(Number)) {
    const { page, said } = await open(browser, file, { width });
    await page.locator("#ask").evaluate((ask) => ask.click());
    let asked = 0;
    for (const [chapter, which] of [[0, "c_cnt"], [0, "Km"], [3, "c_cnt"], [5, "c_cnt"], [10, "c_cnt"], [17, "Km"]]) {
      await select(page, "#chapter", chapter);
      await chosen(page, which);
      const last = Number(await page.getAttribute("#slider", "max"));
      for (let k = 0; k < 12; k += 1) {
        await page.locator("#slider").fill(String(Math.floor(random() * last)));
        await page.click("#decision");
        const at = `${width}, chapter ${chapter}, ${await page.textContent("#status")}`;
        for (const seen of [which === "Km" ? "#whole" : "#zone", "#listing li[aria-current]"]) assert.ok(await isSeen(page, seen), `${at}: ${seen}`);
        if (await page.isHidden("#question")) continue;
        assert.ok(await isSeen(page, "#question"), `${at}: the question`);
        assert.ok(await isSeen(page, "#question .answer"), `${at}: the first answer`);
        await page.click("#question button");
        assert.ok(await isSeen(page, "#question [role=status]"), `${at}: the verdict`);
        assert.ok(await isSeen(page, "#listing li[aria-current]"), `${at}: the line beside the verdict`);
        asked += 1;
      }
      assert.equal(await overflows(page), false);
    }
    assert.ok(asked > 40, `${asked} questions at ${width}`);
    assert.deepEqual(said, []);
  }
}

/** The keys step where nothing has the focus; what has it keeps the keys that are its own. */
async function keys(browser) {
  const { page, said } = await open(browser, file);
  const steps = async (why) => {
    for (const [key, to] of [["Home", 0], ["ArrowRight", 1], ["ArrowRight", 2], [" ", 3], ["ArrowLeft", 2], ["End", Infinity]]) {
      await page.keyboard.press(key);
      assert.equal(await stepsDone(page), Math.min(to, Number(await page.getAttribute("#slider", "max"))), `${key} after ${why}`);
    }
    await page.keyboard.press("Home");
  };
  await steps("opening");
  for (const clicked of ["#decision", "#forward", "h1", "#edit"]) {
    await page.click(clicked);
    if (clicked === "#edit") await page.click(clicked);
    await steps(clicked);
  }
  for (const focused of ["#run", "#tolerance", "#ask", "input[value=c_cnt]", "#turns", "#listing button", "#values td", "#pictures"]) {
    await page.locator("#slider").fill("7");
    await page.locator(focused).first().evaluate((element) => element.focus());
    if (await page.evaluate(() => document.activeElement === document.body)) continue;
    for (const key of ["Home", "ArrowRight", "End", "ArrowLeft"]) await page.keyboard.press(key);
    if (["#run", "input[value=c_cnt]"].includes(focused)) await page.evaluate(() => document.activeElement.blur());
    else assert.equal(await stepsDone(page), focused === "#turns" ? await stepsDone(page) : 7, `the arrows are those of ${focused}`);
  }
  await page.focus("#edit");
  for (const [key, to] of [["Home", 0], ["ArrowRight", 1], ["End", Number(await page.getAttribute("#slider", "max"))]]) {
    await page.keyboard.press(key);
    assert.equal(await stepsDone(page), to, `${key} with a button that has the focus`);
  }
  for (const chosen of ["#chapter", "#run"]) {
    await page.locator("#slider").fill("7");
    await page.click(chosen);
    await page.keyboard.press("Escape");
    await page.locator(chosen).evaluate((list) => list.dispatchEvent(new Event("change", { bubbles: true })));
    await page.locator("#slider").fill("7");
    await page.evaluate(() => document.activeElement.id === "slider" && document.activeElement.blur());
    await page.keyboard.press("ArrowRight");
    assert.equal(await stepsDone(page), 8, `the right arrow after a choice of ${chosen}`);
  }
  for (let k = 0; k < 4; k += 1) await select(page, "#chapter", k);
  await page.focus("#listing button");
  for (const line of ["2", "3"]) {
    await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), line, "a line by each arrow, after changes of chapter");
  }
  assert.match(await page.textContent("#colophon"), /scene findings\/C2, SHA-256 [0-9a-f]{64}/);
  await select(page, "#chapter", 0);
  await page.locator("#tolerance").fill("0");
  await page.focus("#tolerance");
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await page.textContent("#tolerance-label"), "c_tll 0.001");
  const isAsking = await page.isChecked("#ask");
  await page.focus("#ask");
  await page.keyboard.press(" ");
  assert.equal(await page.isChecked("#ask"), !isAsking);
  await page.locator("#slider").fill("0");
  await page.focus("#listing button");
  await page.keyboard.press("End");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "31", "the last line's number");
  await page.keyboard.press("o");
  assert.equal(await stepsDone(page), 1, "a letter steps, as no button takes it");
  assert.deepEqual(said, []);
}

/** A node is moved by the arrow keys and by a finger; each step is said. */
async function moved(browser) {
  const { page, said } = await open(browser, file);
  const { steps } = traces.c_cnt;
  const at = steps.findIndex(({ line, writes }) => line === 16 && writes.some(({ name, value }) => name === "dy[3]" || value === 1)) + 1;
  await page.locator("#slider").fill(String(at));
  assert.match(await page.textContent("#said[aria-live=polite]"), /^line 16: the condition is true, dy \d becomes 1$/);
  await page.click("#end");
  const printed = await cellsOf(page);
  await page.focus("#nodes button[aria-label^='node 2.4']");
  for (let k = 0; k < 10; k += 1) await page.keyboard.press("Shift+ArrowDown");
  assert.match(await page.textContent("#said"), /^node 2\.4 \(8\): x 2\.3, y −?0\.\d+$/);
  assert.notDeepEqual(await cellsOf(page), printed);
  await page.click("#reset");
  assert.deepEqual(await cellsOf(page), printed);
  const phone = await open(browser, file, { width: 390, hasTouch: true, isMobile: true });
  await phone.page.click("#end");
  const finger = await phone.page.context().newCDPSession(phone.page);
  const { x, y } = await phone.page.locator("#nodes button").nth(3).boundingBox();
  const touch = (type, by) => finger.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x: x + 12, y: y + 12 + by }] });
  await touch("touchStart", 0);
  for (const by of [10, 20, 30]) await touch("touchMove", by);
  await touch("touchEnd");
  assert.notDeepEqual(await cellsOf(phone.page), printed);
  assert.deepEqual([...said, ...phone.said], []);
}

/** On a phone each button is as large as a finger. */
async function fingers(browser) {
  const { page } = await open(browser, file, { width: 390, hasTouch: true, isMobile: true });
  const small = await page.locator(".buttons button, header button, .heading button, #question button").evaluateAll((all) => all.filter((button) => button.offsetParent && (button.offsetHeight < 40 || button.offsetWidth < 40)).map((button) => button.outerHTML));
  assert.deepEqual(small, []);
}

/** Printed on A4, nothing is cut off and nothing covers another, each matrix is square, and no control is there; what
 * moves stands still where that is wished. */
async function printed(browser) {
  const { page, said } = await open(browser, file, { scheme: "dark", reducedMotion: "reduce" });
  const inPrint = () => page.evaluate(() => {
    const seen = [...document.querySelectorAll("main *")].filter((element) => element.clientHeight > 1);
    const isCut = (element) => getComputedStyle(element).overflowY !== "visible" && element.scrollHeight > element.clientHeight + 1;
    const parts = [...document.querySelectorAll("main > *, .columns > *, .way > *, .played > *")].map((element) => element.getBoundingClientRect());
    const own = (element) => element.id || element.outerHTML.slice(0, 60);
    const deepest = Math.max(...[...document.querySelectorAll("#finding *")].filter((element) => element.checkVisibility()).map((element) => element.getBoundingClientRect().bottom));
    const matrix = document.getElementById("mjs");
    return {
      cut: seen.filter(isCut).map(own),
      wide: [...document.querySelectorAll("table, canvas")].filter((element) => element.getBoundingClientRect().right > innerWidth).map(own),
      empty: parts.filter(({ width, height }) => (width > 0) !== (height > 0)).length,
      covers: deepest > document.getElementById("finding").getBoundingClientRect().bottom + 1,
      isSquare: Math.abs(matrix.clientWidth - matrix.clientHeight) <= 1 && (!matrix.clientWidth || matrix.width === matrix.height),
    };
  });
  for (const address of ["fig1&step=9999", "K1&listing=Km&step=9999", "K5&listing=iterations&variant=tied&step=20", "repairs&run=after+3"]) {
    await page.emulateMedia({ media: "screen" });
    await page.setViewportSize({ width: 1440, height: 900 });
    await page.goto(page.url().split("#")[0] + `#chapter=${address}`);
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: Math.floor((186 / 25.4) * 96), height: 1000 });
    await page.waitForTimeout(100);
    assert.equal(await page.isHidden(".controls"), true);
    assert.match(await page.textContent("#place"), /^Scene .* Reading: .*(step|iteration) \d+ of \d+.*c_tll/);
    assert.equal(await page.isVisible("#place"), true);
    assert.deepEqual(await page.locator("button:not(#listing button, #repairs button)").evaluateAll((all) => all.filter((button) => button.checkVisibility()).map(({ textContent }) => textContent)), []);
    assert.deepEqual(await inPrint(), { cut: [], wide: [], empty: 0, covers: false, isSquare: true }, address);
  }
  assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
  assert.deepEqual(said, []);
}

/** 500 moves by events drawn at random leave the page whole: it says nothing, and shows what a page shows
 * that opens the same address. */
async function soak(browser) {
  const { page, said } = await open(browser, file);
  await page.evaluate(async () => {
    let state = 46;
    const below = (n) => (state = (state * 48271) % 2147483647) % n;
    const byId = (id) => document.getElementById(id);
    const change = (input, value) => {
      input.value = value;
      for (const name of ["input", "change"]) input.dispatchEvent(new Event(name, { bubbles: true }));
    };
    const press = (target, key) => target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, shiftKey: below(2) === 0 }));
    const arrows = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"];
    const edit = () => {
      if (byId("editor").hidden) byId("edit").click();
      const text = [...byId("text").value];
      text[below(text.length)] = "cky01+=".charAt(below(7));
      change(byId("text"), text.join(""));
      byId("edit").click();
      if (below(3)) byId("printed").click();
    };
    const node = () => {
      const nodes = byId("nodes").children;
      if (!nodes.length || !byId("nodes").offsetParent) return;
      const button = nodes[below(nodes.length)];
      if (button.dataset.edge) button.click();
      else press(button, arrows[below(4)]);
    };
    const list = (id) => change(byId(id), byId(id).options[below(byId(id).options.length)].value);
    for (let k = 0; k < 500; k += 1) {
      const kind = below(40);
      if (kind < 24) press(document.body, ["ArrowRight", "ArrowLeft", "o", "d", "n", " ", "Home", "End"][below(8)]);
      else if (kind < 28) change(byId("slider"), below(Number(byId("slider").max) + 1));
      else if (kind < 34) node();
      else if (kind < 35) edit();
      else if (kind < 36) list("run");
      else if (kind < 37) list("chapter");
      else if (kind < 38) document.querySelectorAll("[name=which]")[below(3)].click();
      else if (kind < 39) change(byId("tolerance"), below(5) - 2);
      else byId("ask").click();
      if (k % 50 === 0) await new Promise(requestAnimationFrame);
    }
    if (!byId("editor").hidden) byId("printed").click();
  });
  await page.waitForTimeout(600);
  const again = await page.context().newPage();
  await again.goto(page.url());
  const [shown, opened] = [await cellsOf(page), await cellsOf(again)];
  assert.deepEqual(opened.filter((cell, k) => cell !== shown[k]), [], page.url());
  assert.deepEqual(said, []);
}

/** All widths and both schemes: nothing is cut off, axe-core finds nothing. */
async function views(browser) {
  await inAllViews(browser, file, async ({ page, check, view }) => {
    for (const [which, at] of [["c_cnt", 230], ["Km", 1000], ["iterations", 20]]) {
      await chosen(page, which);
      await page.locator("#slider").fill(String(at));
      await page.evaluate(() => window.scrollTo(0, 0));
      await check();
      if (which === "c_cnt" && view === "1024-light") await page.screenshot({ path: `${folder}/lesson-${view}.png` });
    }
    if (!view.endsWith("dark")) return;
    await chosen(page, "c_cnt");
    await page.evaluate(() => document.querySelectorAll("details").forEach((part) => (part.open = true)));
    await chosen(page, "Km");
    await page.check("#ask");
    await page.click("#end");
    await check();
    await page.click("#edit");
    await check();
  });
}

/** A text with an error is said beside the iterations as beside the listing, and after a reload; the editor opens at
 * its top and its numbers stay beside its lines; without a load no error is drawn. */
async function unread(browser) {
  const { page, said } = await open(browser, file);
  await page.goto(`${page.url()}#chapter=K1&run=repaired&listing=Km`);
  const field = page.locator("#text");
  const places = () => page.evaluate(() => [document.getElementById("text").scrollTop, document.getElementById("gutter").style.transform]);
  await page.click("#edit");
  assert.deepEqual(await places(), [0, "translateY(0px)"]);
  await field.fill((await field.inputValue()).replace("←", "← ((("));
  await page.locator("#listing-title", { hasText: "is not run" }).waitFor();
  assert.ok((await page.locator(".code").boundingBox()).height >= 10 * 17.5, "ten lines stay in sight");
  await field.evaluate((text) => (text.scrollTop = 150));
  await chosen(page, "iterations");
  await page.locator("#slider").fill("7");
  const words = /^iteration 7 of 20, .*Km repaired, your text has an error and is not run$/;
  assert.match(await page.textContent("#status"), words);
  await page.waitForURL(/step=7/);
  await chosen(page, "Km");
  assert.deepEqual(await places(), [150, "translateY(-150px)"]);
  await chosen(page, "iterations");
  await page.locator("#slider").fill("7");
  await page.waitForURL(/iterations&step=7/);
  await page.reload();
  assert.match(await page.textContent("#status"), words);
  await page.goto(`${page.url().split("#")[0]}#chapter=C1&listing=iterations`);
  assert.match(await page.textContent("#shape-caption"), /^Thin lines/);
  assert.equal(await page.isHidden("#errors"), true);
  assert.deepEqual(said, []);
}

const tests = [walk, runs, keyboard, hover, readings, questions, numbers, changed, edited, unread, checked, unforeseen, chapters, linked, joined, deep, repairs, iterations, assembly, opening, together, keys, moved, fingers, printed, soak, views];
runAll(tests);
