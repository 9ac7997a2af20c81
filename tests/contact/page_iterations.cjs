// node page_iterations.cjs GIVEN: makes the iterations of each scene with the page's script; prints their states.

const fs = require("node:fs");

const { script, data, settings, scenes } = JSON.parse(fs.readFileSync(process.argv[2], "utf8"));
const page = new Function("data", `"use strict";\n${script}\nreturn { Equations, VARIANTS, iterated, linesOf, readListing };`)(data);

const read = ([name, text]) => [name, page.readListing(name, page.linesOf(text))];
const made = scenes.map(({ mesh, c_cnt, Km, c_tll, corrected, ...run }) => {
  const equations = new page.Equations(run, Object.fromEntries(Object.entries({ c_cnt, Km }).map(read)), mesh, (n) => mesh.nodes[n - 1], c_tll);
  const published = page.VARIANTS.filter((variant) => variant !== "corrected");
  const programs = corrected.map((texts) => new Map(Object.entries(texts).map(read)));
  return {
    ...Object.fromEntries(published.map((variant) => [variant, page.iterated(equations, variant)])),
    corrected: programs.map((programs) => page.iterated(equations, "corrected", { programs, settings })),
  };
});
console.log(JSON.stringify(made));
