'use strict';
// Stage 2 on a slice. A mesh is a list of loops of points, with the inside on the left.

// The edge from a to b: its center, its dual line, its surface point x, the distance h of x from
// the center, and the radius of its surface ball. There is no x if the line does not meet Sigma
// near the edge.
function facet_of(field, kappa, a, b) {
  const length = distance(a, b), center = between(a, b, 0.5);
  const outwards = [(b[1] - a[1]) / length, -(b[0] - a[0]) / length];
  const at = (t) => [center[0] + t * outwards[0], center[1] + t * outwards[1]];
  const is_inside = (t) => field.value(at(t)) >= kappa;
  // Sigma faces outwards as the edge does, so it lies outwards of a center that is inside.
  const side = is_inside(0) ? 1 : -1, kStep = 1 / 64;
  const facet = { a, b, center, outwards, x: null, h: 0, radius: 0 };
  for (let n = 0; n * kStep < length; ++n) {
    let near = side * n * kStep, far = side * (n + 1) * kStep;
    if (is_inside(near) === is_inside(far)) continue;
    for (let k = 0; k < 40; ++k) {
      const middle = (near + far) / 2;
      if (is_inside(middle) === is_inside(near)) near = middle;
      else far = middle;
    }
    facet.x = at(near);
    facet.h = Math.abs(near);
    facet.radius = distance(facet.x, a);
    break;
  }
  return facet;
}

const facets_of = (field, kappa, loops) => loops.flatMap((loop, l) => loop.map((a, n) =>
  ({ ...facet_of(field, kappa, a, loop[(n + 1) % loop.length]), loop: l, n })));

// The facets whose surface balls hold p: the cavity of an insertion.
const cavity_of = (facets, p) => facets.filter((f) => f.x && distance(f.x, p) < f.radius * (1 - 1e-9));

function segments_cross(a, b, c, d) {
  const turn = (p, q, r) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  return turn(a, b, c) !== turn(a, b, d) && turn(c, d, a) !== turn(c, d, b);
}

// Why the surface point of a facet is not inserted: '' when it is, then `loops` have it. As in space,
// nothing is changed where the mesh would lose a vertex, lose sight of Sigma, or cross itself.
function insert_surface_point(field, kappa, loops, facets, facet) {
  const { a, b, x } = facet;
  if (!x) return 'its dual line does not meet \u03a3 near it';
  if (cavity_of(facets, x).some((f) => f.loop !== facet.loop || f.n !== facet.n))
    return 'x lies in the ball of another edge too';
  const halves = [facet_of(field, kappa, a, x), facet_of(field, kappa, x, b)];
  if (halves.some((half) => !half.x)) return 'a new edge would have no surface point';
  for (const f of facets) {
    if (f.loop === facet.loop && f.n === facet.n) continue;
    const crosses = ([p, q]) => f.b !== p && f.a !== q && segments_cross(p, q, f.a, f.b);
    if ([[a, x], [x, b]].some(crosses)) return 'a new edge would cross the mesh';
  }
  loops[facet.loop].splice(facet.n + 1, 0, x);
  return '';
}

// Inserts surface points, the worst facet's first, until no h is above `limit` or all such are refused.
// Edges with a circumradius (half their length) below r_min are left. Returns {inserted, refused}.
function refine(field, kappa, loops, limit, r_min) {
  const refused = new Set();
  const key = (f) => [...f.a, ...f.b].join();
  for (let inserted = 0; ; ) {
    const facets = facets_of(field, kappa, loops);
    let worst = null;
    for (const f of facets) {
      const is_candidate = f.h > limit && distance(f.a, f.b) / 2 > r_min && !refused.has(key(f));
      if (is_candidate && (!worst || f.h > worst.h)) worst = f;
    }
    if (!worst) return { inserted, refused: facets.filter((f) => refused.has(key(f))).length };
    if (insert_surface_point(field, kappa, loops, facets, worst) === '') ++inserted;
    else refused.add(key(worst));
  }
}
