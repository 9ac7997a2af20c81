// node page_iterations.cjs GIVEN: makes the iterations of each scene with the page's script; prints their states.

const fs = require("node:fs");

const { script, data, scenes } = JSON.parse(fs.readFileSync(process.argv[2], "utf8"));
const page = new Function("data", `"use strict";\n${script}\nreturn { Equations, VARIANTS, iterated, linesOf, readListing };`)(data);

const made = scenes.map(({ mesh, c_cnt, Km, c_tll, ...run }) => {
  const listings = { c_cnt: page.readListing("c_cnt", page.linesOf(c_cnt)), Km: page.readListing("Km", page.linesOf(Km)) };
  const equations = new page.Equations(run, listings, mesh, (n) => mesh.nodes[n - 1], c_tll);
  return Object.fromEntries(page.VARIANTS.map((variant) => [variant, page.iterated(equations, variant, data.corrected)]));
});
console.log(JSON.stringify(made));
