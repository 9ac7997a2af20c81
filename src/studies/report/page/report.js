// What a script adds to the report: parts that unfold when they are linked to, tables that copy as CSV.

/** Unfolds the part that the address names, and those around it. */
function unfold() {
  const named = byId(decodeURIComponent(location.hash.slice(1)));
  for (let part = named; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  named?.scrollIntoView();
}

byId("menu").addEventListener("click", ({ target }) => target.closest("a") && (byId("menu").open = false));
byId("menu").after(button(t("print"), () => window.print()));
document.addEventListener("click", (/** @type {any} */ { target }) => target.closest?.("a")?.hash === location.hash && unfold());
window.addEventListener("hashchange", unfold);
document.querySelectorAll("article table").forEach(addCopying);
showExactValues();
unfold();
