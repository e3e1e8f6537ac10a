'use strict';
// Stage 2 on a slice. A mesh is a list of loops of points, with the inside on the left.

// The edge from a to b: its center, its dual line, its surface point x, the distance h of x from
// the center, and the radius of its surface ball. There is no x if the line does not meet Sigma
// as far from the center as the ends are.
function facet_of(field, kappa, a, b) {
  const length = distance(a, b), center = between(a, b, 0.5);
  const outwards = [(b[1] - a[1]) / length, -(b[0] - a[0]) / length];
  const at = (t) => [center[0] + t * outwards[0], center[1] + t * outwards[1]];
  const is_inside = (t) => field.value(at(t)) >= kappa;
  const kStep = 1 / 64, reach = length / 2;
  const facet = { a, b, center, outwards, x: null, h: 0, radius: 0 };
  // Sigma faces outwards as the edge does: the inside ends there.
  const leave = (low, high) => {
    if (!is_inside(low) || is_inside(high)) return Infinity;
    for (let k = 0; k < 40; ++k) {
      const middle = (low + high) / 2;
      if (is_inside(middle)) low = middle;
      else high = middle;
    }
    return low;
  };
  for (let n = 0; n * kStep < reach; ++n) {
    const low = n * kStep, high = Math.min(reach, low + kStep);
    const [out, back] = [leave(low, high), leave(-high, -low)];
    const t = Math.abs(out) <= Math.abs(back) ? out : back;
    if (t === Infinity) continue;
    facet.x = at(t);
    facet.h = Math.abs(t);
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

// True if one of some new edges would cross an edge of the mesh, other than those that `goes` takes away.
const is_crossed_by = (facets, goes, edges) => facets.some((f) => !goes(f) && edges.some(
  ([p, q]) => f.b !== p && f.a !== q && segments_cross(p, q, f.a, f.b)));

// Why the surface point of a facet is not inserted; '': it may be. As in space, nothing is changed where
// the mesh would lose a vertex, lose sight of Sigma, or cross itself.
function why_not_inserted(field, kappa, facets, facet) {
  const { a, b, x } = facet;
  const is_facet = (f) => f.loop === facet.loop && f.n === facet.n;
  if (!x) return 'its dual line does not meet \u03a3 near it';
  if (!cavity_of(facets, x).every(is_facet)) return 'x lies in the ball of another edge too';
  const halves = [[a, x], [x, b]];
  if (halves.some(([p, q]) => !facet_of(field, kappa, p, q).x)) return 'a new edge would have no surface point';
  if (is_crossed_by(facets, is_facet, halves)) return 'a new edge would cross the mesh';
  return '';
}

// Stage 2 goes in rounds: {loops, facet, why, refused}, the mesh after the round, the facet that was tried,
// why its surface point was refused ('': it was not), and the facets that are not tried again: those that were
// refused, until a neighbor changes.
const first_round = (loops) => ({ loops, facet: null, why: '', refused: [] });
const is_same_edge = (f, g) => f.a === g.a && f.b === g.b;

// The edge of the next round: of those with h above the limit that were not refused, the one with the largest
// h. Edges with a circumradius (half their length) below r_min are left. null: Stage 2 is at its end.
function worst_of(facets, limit, r_min, refused) {
  const is_candidate = (f) => f.h > limit && distance(f.a, f.b) / 2 > r_min && !refused.some((g) => is_same_edge(f, g));
  return facets.reduce((worst, f) => is_candidate(f) && (!worst || f.h > worst.h) ? f : worst, null);
}

// The round in which the surface point of a facet is inserted, or refused.
function next_round(field, kappa, { loops, refused }, facets, facet) {
  const why = why_not_inserted(field, kappa, facets, facet);
  if (why !== '') return { loops, facet, why, refused: [...refused.filter((f) => !is_same_edge(f, facet)), facet] };
  const changed = loops.map((loop, l) => l !== facet.loop ? loop
    : [...loop.slice(0, facet.n + 1), facet.x, ...loop.slice(facet.n + 1)]);
  const is_neighbor = (f) => f.a === facet.b || f.b === facet.a;
  return { loops: changed, facet, why, refused: refused.filter((f) => !is_neighbor(f) && !is_same_edge(f, facet)) };
}

// All rounds of Stage 2 from `first` on, the worst facet first.
function refine(field, kappa, first, limit, r_min) {
  const rounds = [first];
  for (;;) {
    const round = rounds.at(-1), facets = facets_of(field, kappa, round.loops);
    const worst = worst_of(facets, limit, r_min, round.refused);
    if (!worst) return rounds;
    rounds.push(next_round(field, kappa, round, facets, worst));
  }
}
