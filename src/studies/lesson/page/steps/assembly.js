// The assembly of the stiffness matrix: the numbers of K fly from their cells to their places in MJS.

/** What the steps from `from` on brought into MJS of the last element: each entry with its cell of K. */
function broughtIn(machine, from) {
  const brought = machine.steps.slice(from, machine.at).flatMap(({ turn, all, writes }) => {
    const [source, place] = [all.find(({ name }) => name === "K"), writes.find(({ name }) => name.startsWith("MJS["))];
    return source && place ? [{ turn, from: `K[${source.subscripts}]`, to: place.name }] : [];
  });
  return brought.filter(({ turn }) => turn === brought.at(-1).turn);
}

/** Marks the cells of K whose numbers were brought in; where motion is wanted, the numbers fly. */
function showAssembly(brought, map, isFlying) {
  for (const { from } of brought) document.querySelector(`td[data-name="${from}"]`)?.classList.add("read");
  if (!isFlying || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  for (const { from, to } of brought) fly(document.querySelector(`td[data-name="${from}"]`), map.placeOf(to));
}

/** Lets a copy of a cell's number fly to a place in the window. */
function fly(cell, place) {
  if (!cell || !place) return;
  const { left, top, width, height } = cell.getBoundingClientRect();
  const number = make("span", { class: "flying", "aria-hidden": "true", style: `left: ${left}px; top: ${top}px` }, cell.textContent);
  document.body.append(number);
  const by = [place[0] - left - width / 2, place[1] - top - height / 2];
  const flight = number.animate([{}, { transform: `translate(${by[0]}px, ${by[1]}px) scale(0.5)`, opacity: 0.6 }], { duration: 700, easing: "ease-in-out" });
  flight.onfinish = () => number.remove();
}
