// node page_interpreter.cjs INTERPRETER KNOWN CASES TEXTS: executes each case in the page's interpreter and
// compares every statement with its digest; reads each text and compares the error. Prints as JSON where the
// first case differs, or how many are the same. With BROWSER_MODULES, the folder of playwright-core, it does so in a
// browser, else in node.

const fs = require("node:fs");
const { createRequire } = require("node:module");
const digests = require("./page_digest.cjs");

const given = process.argv.slice(2).map((path) => JSON.parse(fs.readFileSync(path, "utf8")));

/** What differs, or the counts, as JSON; it needs nothing but its arguments. */
function compare([source, known, cases, texts], digests) {
  const names = "Grid, ParseError, executed, isArray, isNumber, lineOf, linesOf, readListing, share, unexpected, valueOf, worksheetOf";
  const page = new Function(`"use strict";\n${source}\nreturn { ${names} };`)();

  const Digest = digests(page);

  const words = (text) => new Set(text.split(/\s+/).filter(Boolean));
  const mathcad = { functions: words(known.functions), units: words(known.units) };
  const limits = { steps: 400_000, entries: 1 << 20, calls: 60 };

  /** Numbers that JSON does not have, by their names. */
  const NUMBERS = { inf: Infinity, "-inf": -Infinity, NaN };
  const revived = (json) => (Array.isArray(json) ? json.map(revived) : (NUMBERS[json] ?? json));

  /** The listing of these lines, read once. */
  const read = new Map();
  function listingOf(name, lines) {
    const key = JSON.stringify([name, lines]);
    if (!read.has(key)) read.set(key, page.readListing(name, lines.map(([number, inFile, level, text]) => ({ number, inFile, level, text }))));
    return read.get(key);
  }

  function executed(of) {
    const listing = listingOf(of.name, of.lines);
    const tables = Object.fromEntries(of.tables.map(([name, json]) => [name, revived(json)]));
    const worksheet = page.worksheetOf(tables, of.plane, mathcad);
    if (of.plane === null) {
      worksheet.functions.clear();
      worksheet.values.delete("nu");
    }
    for (const [name, lines] of of.programs) worksheet.programs.set(name, listingOf(name, lines));
    const values = of.arguments.map((json) => page.valueOf(revived(json)));
    const done = page.executed(listing, worksheet, of.settings, values, limits);
    if (!done.failure && of.plane !== null) done.failure = page.unexpected(listing, done);
    return { ...done, listing };
  }

  const counts = { same: 0, failed: 0, limited: 0, beyond: 0, refused: 0, steps: 0 };

  /** The step at which a case differs; nothing where it does not. */
  function differs(of, { steps, failure, value, output, listing }) {
    if (failure?.isLimit || of.is_limit) return void (counts.limited += 1);
    const ends = steps.map((step) => new Digest().executed(listing.lines[step.line], step).result);
    // What the page has not it refuses by its name; the statements before are compared.
    const isBeyond = failure?.cause.endsWith(" in the page.");
    const first = ends.slice(0, isBeyond ? -1 : undefined).findIndex((digest, k) => digest !== of.steps[k]);
    if (first >= 0) return first;
    if (isBeyond) return void (counts.beyond += 1);
    if (ends.length !== of.steps.length) return ends.length;
    counts.steps += ends.length;
    if (String(failure ?? null) !== String(of.failure)) return ends.length;
    if (failure) return void (counts.failed += 1);
    if (new Digest().value(value).result !== of.value || output.join("\n") !== of.output.join("\n")) return ends.length;
    counts.same += 1;
  }

  /** The place at which a text is refused; null where it is read. */
  function error({ name, text }) {
    try {
      page.readListing(name, page.linesOf(text));
      return null;
    } catch (error) {
      if (!(error instanceof page.ParseError)) throw error;
      counts.refused += 1;
      return { ...error };
    }
  }

  const said = (value) => JSON.stringify(value);
  for (const [k, of] of cases.entries()) {
    const done = executed(of);
    const step = differs(of, done);
    if (step === undefined) continue;
    const at = done.steps[step];
    const words = `${at ? `line ${done.listing.lines[at.line].number} ${said(at)}` : "no such step"}; ${done.failure ?? said(done.value)}`;
    return said({ differs: [k, step], page: words });
  }
  const unlike = texts.map((of) => ({ ...of, page: error(of) })).filter((of) => said(of.page) !== said(of.error));
  return said({ ...counts, texts: unlike.slice(0, 3) });
}

/** Does the same in a browser. */
async function compareInBrowser() {
  const { chromium } = createRequire(process.env.BROWSER_MODULES + "/")("playwright-core");
  const browser = await chromium.launch({ executablePath: process.env.BROWSER ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  try {
    const page = await browser.newPage();
    const act = ({ texts: [compare, digests], given }) => new Function(`return (${compare})`)()(given, new Function(`return (${digests})`)());
    return await page.evaluate(act, { texts: [compare, digests].map(String), given });
  } finally {
    await browser.close();
  }
}

const isInBrowser = Boolean(process.env.BROWSER_MODULES);
Promise.resolve(isInBrowser ? compareInBrowser() : compare(given, digests)).then((said) => console.log(said));
