// The language of the page, switched in it: what the body says by its English, and what is made anew.

/** What says a text of the body again, each with its English. */
const FIXED = [];

/** Finds the texts of the body, and of its attributes that are read. */
function readBody() {
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = /** @type {Text} */ (walker.currentNode);
    const words = node.data.trim();
    const english = words.replace(/\s+/g, " ");
    const [before, after] = words ? node.data.split(words) : [];
    if (english in data.messages && !node.parentElement.closest("script")) FIXED.push([english, (said) => (node.data = before + said + after)]);
  }
  for (const name of ["title", "aria-label"]) {
    for (const element of document.querySelectorAll(`body [${name}]`)) FIXED.push([element.getAttribute(name), (said) => element.setAttribute(name, said)]);
  }
}

/** Says the body in a language; what is made anew says itself so. */
function setLanguage(language) {
  speech.language = document.documentElement.lang = language;
  for (const [english, write] of FIXED) write(t(english));
  byId("language").textContent = language === "ru" ? "English" : "Русский";
  byId("language").lang = language === "ru" ? "en" : "ru";
}

/** Says everything in the other language, where it is. */
function switchLanguage() {
  setLanguage(speech.language === "ru" ? "en" : "ru");
  fillChapters();
  fillChapter();
  choose({ run: page.run });
}
