// Nodes that are dragged in the contact zone: the listings run again while the pointer moves.

/** The most nodes of a scene that runs again in the time of a frame. */
const MOST_DRAGGED = 100;

/** The node of the zone under the pointer; nothing where there is none. */
function nodeAt({ offsetX, offsetY }) {
  const { mesh, zone, view } = page;
  const nodes = mesh.count > MOST_DRAGGED || !view ? [] : [...zone.nodes, ...zone.edges.flatMap(([, ends]) => ends)];
  const distance = (n) => Math.hypot(...view.to(mesh.at(n)).map((x, k) => x - [offsetX, offsetY][k]));
  return nodes.filter((n) => distance(n) < 12).sort((a, b) => distance(a) - distance(b))[0];
}

function watchDrag() {
  const canvas = byId("zone");
  canvas.addEventListener("pointerdown", (event) => {
    page.dragged = nodeAt(event);
    if (page.dragged) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    canvas.style.cursor = page.dragged || nodeAt(event) ? "grab" : "";
    if (!page.dragged) return;
    const at = page.view.from([event.offsetX, event.offsetY]).map((x) => Number(x.toPrecision(6)));
    choose({ moved: new Map(page.moved).set(page.dragged, at) });
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, () => {
      if (!page.dragged) return;
      page.dragged = undefined;
      choose({});
    });
  }
}
