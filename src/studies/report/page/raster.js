// Triangles to pixels, each triangle in one colour. The paths of a canvas take seconds for 100,000
// triangles, and WebGL is slower than this loop where there is no graphics card.

/** A colour as a pixel holds it: opacity, blue, green, red, from the highest byte to the lowest. */
const packed = ([red, green, blue]) => ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;

/** Fills the pixels whose centres lie in triangles. `pixels` are the rows of an image, each of `width`
 * pixels; `x` and `y` are those of the nodes, in pixels; `colours` has a colour for each triangle. */
function fillTriangles(pixels, width, triangles, x, y, colours) {
  const height = pixels.length / width;
  for (let t = 0; t < colours.length; t += 1) {
    let [a, b, c] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
    // An edge is always followed from its upper end, so that its two triangles leave no gap.
    if (y[b] < y[a]) [a, b] = [b, a];
    if (y[c] < y[b]) [b, c] = [c, b];
    if (y[b] < y[a]) [a, b] = [b, a];
    fillSorted(pixels, width, height, x[a], y[a], x[b], y[b], x[c], y[c], colours[t]);
  }
}

/** Fills a triangle whose corners a, b and c follow each other downwards. */
function fillSorted(pixels, width, height, ax, ay, bx, by, cx, cy, colour) {
  const first = Math.max(0, Math.ceil(ay - 0.5));
  const last = Math.min(height, Math.ceil(cy - 0.5));
  if (first >= last || Math.max(ax, bx, cx) < 0 || Math.min(ax, bx, cx) > width) return;
  const long = (cx - ax) / (cy - ay);
  const upper = (bx - ax) / (by - ay);
  const lower = (cx - bx) / (cy - by);
  for (let row = first; row < last; row += 1) {
    const at = row + 0.5;
    const one = ax + (at - ay) * long;
    const other = at < by ? ax + (at - ay) * upper : bx + (at - by) * lower;
    const from = row * width + Math.max(0, Math.ceil(Math.min(one, other) - 0.5));
    const to = row * width + Math.min(width, Math.ceil(Math.max(one, other) - 0.5));
    for (let k = from; k < to; k += 1) pixels[k] = colour;
  }
}
