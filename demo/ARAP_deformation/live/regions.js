// Which vertices are meant: by what is connected, and by where they are on the screen.
import { cornersOf } from './faces.js';

// the neighbors of each vertex in compressed rows
function neighborLists(shape) {
  if (shape.neighbors) return shape.neighbors;
  const n = shape.status.length,
    m = shape.starts.length - 1,
    starts = new Uint32Array(n + 1);
  for (let s = 0; s < m; ++s) {
    const corners = cornersOf(shape, s);
    for (const v of corners) starts[v + 1] += corners.length - 1;
  }
  for (let v = 0; v < n; ++v) starts[v + 1] += starts[v];
  const list = new Uint32Array(starts[n]),
    next = starts.slice();
  for (let s = 0; s < m; ++s) {
    const corners = cornersOf(shape, s);
    for (let a = 0; a < corners.length; ++a)
      for (let b = 0; b < corners.length; ++b)
        if (a !== b) list[next[corners[a]]++] = corners[b];
  }
  return (shape.neighbors = { starts, list });
}

// what is connected to a vertex by vertices of its status
export function flood(shape, seed) {
  const { starts, list } = neighborLists(shape),
    wanted = shape.status[seed],
    reached = new Uint8Array(shape.status.length),
    queue = [seed];
  reached[seed] = 1;
  for (let i = 0; i < queue.length; ++i)
    for (let k = starts[queue[i]]; k < starts[queue[i] + 1]; ++k)
      if (!reached[list[k]] && shape.status[list[k]] === wanted) {
        reached[list[k]] = 1;
        queue.push(list[k]);
      }
  return queue;
}

// the vertices that a round brush touches on its way from one place to the next
export function brushed({ xs, ys, seen }, [x0, y0], [x1, y1], radius) {
  const dx = x1 - x0,
    dy = y1 - y0,
    l = dx * dx + dy * dy,
    list = [];
  for (let v = 0; v < xs.length; ++v) {
    if (!seen[v]) continue;
    const t = l ? Math.max(0, Math.min(1, ((xs[v] - x0) * dx + (ys[v] - y0) * dy) / l)) : 0;
    if ((xs[v] - x0 - t * dx) ** 2 + (ys[v] - y0 - t * dy) ** 2 < radius * radius) list.push(v);
  }
  return list;
}

export const isInside = (polygon, x, y) => {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [a, b] = polygon[i],
      [c, d] = polygon[j];
    if (b > y !== d > y && x < ((c - a) * (y - b)) / (d - b) + a) inside = !inside;
  }
  return inside;
};

export function nearestSeen(screen, x, y, within, accepts = () => true) {
  let best = -1,
    least = within * within;
  for (let v = 0; v < screen.xs.length; ++v) {
    if (!screen.seen[v]) continue;
    const d = (screen.xs[v] - x) ** 2 + (screen.ys[v] - y) ** 2;
    if (d < least && accepts(v)) {
      least = d;
      best = v;
    }
  }
  return best;
}

// values at vertices as means in simplices
export const ofSimplices = (shape, values) =>
  Float64Array.from({ length: shape.starts.length - 1 }, (_, s) => {
    const corners = cornersOf(shape, s);
    return corners.reduce((sum, v) => sum + values[v] / corners.length, 0);
  });
