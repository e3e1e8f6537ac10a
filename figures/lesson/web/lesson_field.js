'use strict';
// The samples of a slice, their bilinear interpolant g, and the contour T of an isovalue.

class Field {
  constructor({ columns, rows, samples }) {
    this.columns = columns;
    this.rows = rows;
    this.samples = samples;
  }

  at(i, j) { return this.samples[j * this.columns + i]; }
  set(i, j, value) { this.samples[j * this.columns + i] = value; }

  // The interpolant at (x, y); outside of the samples it is as at the nearest side.
  value([x, y]) {
    const i = clamp(Math.floor(x), 0, this.columns - 2), j = clamp(Math.floor(y), 0, this.rows - 2);
    const s = clamp(x - i, 0, 1), t = clamp(y - j, 0, 1);
    return (1 - t) * ((1 - s) * this.at(i, j) + s * this.at(i + 1, j)) +
           t * ((1 - s) * this.at(i, j + 1) + s * this.at(i + 1, j + 1));
  }
}

const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
const between = (p, q, t) => [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];

// T: {points, loops, curves, saddles, next, previous}. A vertex is a crossing of a grid edge. A loop is
// a list of vertices with the inside on the left. curves[n] is the piece of Sigma along loop n. A saddle
// is a voxel whose corners alternate: {at, value, joined, vertices}, these on its left, lower, right and
// upper side.
// pre: the samples at the sides of the slice are below kappa.
function contour_of(field, kappa) {
  // A sample that equals kappa is inside.
  const excess = (i, j) => field.at(i, j) - kappa || 1e-6;
  const number = new Map(), points = [], neighbors = [], saddles = [];
  const vertex = (key, point) => {
    if (!number.has(key)) {
      number.set(key, points.length);
      points.push(point);
      neighbors.push([]);
    }
    return number.get(key);
  };
  for (let j = 0; j + 1 < field.rows; ++j) {
    for (let i = 0; i + 1 < field.columns; ++i) {
      const f = [excess(i, j), excess(i + 1, j), excess(i, j + 1), excess(i + 1, j + 1)];
      const inside = f.filter((value) => value >= 0).length;
      if (inside === 0 || inside === 4) continue;
      const curves = cell_curves(...f);
      for (const curve of curves) {
        const [p, q] = [curve[0], curve[curve.length - 1]].map(([s, t]) => {
          const key = t === 0 ? `h${i},${j}` : t === 1 ? `h${i},${j + 1}`
                    : s === 0 ? `v${i},${j}` : `v${i + 1},${j}`;
          return vertex(key, [i + s, j + t]);
        });
        const piece = curve.map(([s, t]) => [i + s, j + t]);
        neighbors[p].push({ to: q, piece });
        neighbors[q].push({ to: p, piece: [...piece].reverse() });
      }
      if (curves.length === 2) {
        const bend = f[0] - f[1] - f[2] + f[3];
        const value = (f[0] * f[3] - f[1] * f[2]) / bend;
        const sides = [`v${i},${j}`, `h${i},${j}`, `v${i + 1},${j}`, `h${i},${j + 1}`];
        saddles.push({ at: [i + (f[0] - f[2]) / bend, j + (f[0] - f[1]) / bend], value: value + kappa,
                       joined: value >= 0, vertices: sides.map((key) => number.get(key)) });
      }
    }
  }
  return { points, saddles, ...loops_of(field, kappa, points, neighbors) };
}

function loops_of(field, kappa, points, neighbors) {
  const loops = [], curves = [], seen = new Set();
  for (let start = 0; start < points.length; ++start) {
    if (seen.has(start)) continue;
    const loop = [], pieces = [];
    for (let at = start, from = -1; ;) {
      seen.add(at);
      loop.push(at);
      const [first, second] = neighbors[at];
      const way = from < 0 || second.to === from && first.to !== from ? first : second;
      pieces.push(way.piece);
      from = at;
      at = way.to;
      if (at === start) break;
    }
    // The inside is on the left: there g is larger.
    let sum = 0;
    loop.forEach((v, n) => {
      const p = points[v], q = points[loop[(n + 1) % loop.length]], size = distance(p, q) || 1;
      const m = between(p, q, 0.5), step = 0.05 / size;
      const left = [-(q[1] - p[1]) * step, (q[0] - p[0]) * step];
      sum += field.value([m[0] + left[0], m[1] + left[1]]) - field.value([m[0] - left[0], m[1] - left[1]]);
    });
    if (sum < 0) {
      loop.reverse();
      pieces.reverse();
      for (const piece of pieces) piece.reverse();
      pieces.push(pieces.shift());
    }
    loops.push(loop);
    curves.push(pieces.flatMap((piece) => piece.slice(0, -1)));
  }
  const next = [], previous = [];
  for (const loop of loops) {
    loop.forEach((v, n) => {
      next[v] = loop[(n + 1) % loop.length];
      previous[next[v]] = v;
    });
  }
  return { loops, curves, next, previous };
}

// The vertex of T nearest to a place, of those that are allowed; -1: none is.
function nearest_vertex(contour, place, is_allowed = () => true) {
  let best = -1;
  contour.points.forEach((p, v) => {
    if (is_allowed(v) && (best < 0 || distance(p, place) < distance(contour.points[best], place))) best = v;
  });
  return best;
}

// Marching Cubes on a slice: the edges that its table joins, as pairs of points, into how many loops, and which of
// them T does not have.
// Of corners that alternate, the inside ones are never joined.
function marching_cubes_of(contour) {
  const { points, next } = contour;
  const after = [...next];
  for (const { joined, vertices: [left, bottom, right, top] } of contour.saddles) {
    if (!joined) continue;
    // T joins the four by two edges, each around an outside corner; the other two ways go around the inside.
    const pairs = [[left, bottom], [right, top], [bottom, right], [top, left]];
    const is_edge = ([p, q]) => next[p] === q || next[q] === p;
    const ends = pairs.filter(is_edge).map(([p, q]) => next[p] === q ? [p, q] : [q, p]);
    after[ends[0][0]] = ends[1][1];
    after[ends[1][0]] = ends[0][1];
  }
  const seen = new Set();
  let loops = 0;
  points.forEach((_, v) => {
    if (!seen.has(v)) ++loops;
    for (let at = v; !seen.has(at); at = after[at]) seen.add(at);
  });
  const edges = points.map((p, v) => [p, points[after[v]]]);
  return { edges, loops, wrong: edges.filter((_, v) => after[v] !== next[v]) };
}
