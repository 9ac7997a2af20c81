// Nodes that are dragged in the contact zone, by the pointer or by the arrow keys: the listings run again
// once a frame. Edges are reversed by their names.

/** The most nodes of a scene that runs again in the time of a frame. */
const MOST_DRAGGED = 100;

/** How far an arrow key moves a node, in pixels, and with Shift. */
const [NUDGE, FAR_NUDGE] = [2, 20];

/** Puts a button over each node that can be dragged, and over the name of each edge. */
function placeButtons({ nodes, edges }) {
  const place = byId("nodes");
  const isDragged = page.mesh.count <= MOST_DRAGGED;
  const all = isDragged ? [...new Set([...nodes, ...edges.flatMap(([, ends]) => ends)])] : [];
  const made = [
    ...all.map((n) => make("button", { value: n, "aria-label": t("node {n}", { n: page.mesh.name(n) }) })),
    ...(isDragged ? edges : []).map(([edge]) => make("button", { "data-edge": edge, "aria-label": t("reverse edge {edge}", { edge }) })),
  ];
  // One that has the focus, or is dragged, stays.
  const labels = (buttons) => [...buttons].map((button) => button.getAttribute("aria-label")).join();
  if (labels(place.children) !== labels(made)) place.replaceChildren(...made);
  for (const button of place.children) {
    const [x, y] = button.value ? page.view.to(page.mesh.at(Number(button.value))) : edgeName(Number(button.dataset.edge));
    Object.assign(button.style, { left: `${x}px`, top: `${y}px` });
  }
}

/** Where an edge's name is drawn. */
function edgeName(edge) {
  const [x, y] = besideEdge(...page.mesh.edge.get(edge).map((n) => page.view.to(page.mesh.at(n))));
  return [x, y - 5];
}

/** Reverses an edge. */
function reverseEdge(edge) {
  const turned = new Set(page.turned);
  if (!turned.delete(edge)) turned.add(edge);
  choose({ turned });
  const [a, b] = page.mesh.edge.get(edge).map((n) => page.mesh.name(n));
  say("said", t("edge {edge} runs from node {a} to node {b}", { edge, a, b }));
}

/** Moves a node to a pixel of the zone. */
function moveNode(n, pixel) {
  const at = page.view.from(pixel).map((x) => Number(x.toPrecision(6)));
  choose({ moved: new Map(page.moved).set(n, at) });
}

function watchDrag() {
  const place = byId("nodes");
  let frame;
  // How far the node is from the pointer that took it, in pixels: it stays so.
  let [besideX, besideY] = [0, 0];
  const pointed = ({ clientX, clientY }) => {
    const { left, top } = place.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  place.addEventListener("pointerdown", (event) => {
    if (!event.target.value) return;
    page.dragged = Number(event.target.value);
    event.target.setPointerCapture(event.pointerId);
    const [[x, y], [ownX, ownY]] = [pointed(event), page.view.to(page.mesh.at(page.dragged))];
    [besideX, besideY] = [ownX - x, ownY - y];
  });
  place.addEventListener("pointermove", (event) => {
    if (!page.dragged) return;
    const [x, y] = pointed(event);
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(() => page.dragged && moveNode(page.dragged, [x + besideX, y + besideY]));
  });
  for (const name of ["pointerup", "pointercancel"]) place.addEventListener(name, () => {
    if (!page.dragged) return;
    page.dragged = undefined;
    choose({});
  });
  place.addEventListener("click", ({ target }) => target.dataset.edge && reverseEdge(Number(target.dataset.edge)));
  place.addEventListener("keydown", (event) => {
    if (!event.target.value) return;
    const by = byArrow(event);
    if (!by) return;
    const n = Number(event.target.value);
    const far = event.shiftKey ? FAR_NUDGE : NUDGE;
    moveNode(n, page.view.to(page.mesh.at(n)).map((x, k) => x + far * by[k]));
    const [x, y] = page.mesh.at(n);
    say("said", t("node {name}: x {x}, y {y}", { name: page.mesh.name(n), x, y }));
  });
}
