'use strict';
// Stage 1 of the exact program on a slice: T loses vertices as long as nothing is lost. A mesh is a list of
// loops of T's vertices. That no edges cross is tested in the end only, as in space.

// It goes in rounds: {loops, vertex, why, pass, waiting, removed}, the mesh after the round, the vertex that
// was tried, why it stays ('': it went), which pass over the vertices this is, those left to try in it, and how
// many it has removed.
const uncoarsened = (contour) =>
  ({ loops: contour.loops, vertex: -1, why: '', pass: 1, waiting: contour.loops.flat(), removed: 0 });

// What would change if v went, as {vertex, before, after, a, b, center, outwards, ball, off, why}: its neighbors,
// the edge from a to b that would join them, the radius that no other sheet may come into, and how far v is from
// the edge. `why` it may not go; '': it may.
function removal_of(field, kappa, contour, loops, v, bound) {
  const l = loops.findIndex((loop) => loop.includes(v)), loop = loops[l], n = loop.indexOf(v);
  const count = loop.length, p = contour.points[v];
  const [before, after] = [loop[(n + count - 1) % count], loop[(n + 1) % count]];
  const [a, b] = [contour.points[before], contour.points[after]];
  const { center, outwards } = facet_of(field, kappa, a, b), off = distance_from_edge(a, b, p);
  const is_inside = (t) => field.value([center[0] + t * outwards[0], center[1] + t * outwards[1]]) >= kappa;
  // No other sheet between the center and the ends of the edge's ball.
  const ball = 0.9 * distance(a, b) / 2;
  const why = count <= 3 ? 'three edges are the least that a loop has'
    : off > bound ? 'it would be further than D from the new edge'
    : !is_inside(-bound) || is_inside(bound) ? '\u03a3 is further than D from the new edge'
    : !is_inside(-ball) || is_inside(ball) ? 'another piece of \u03a3 is in the ball of the new edge'
    : '';
  return { vertex: v, before, after, a, b, center, outwards, ball, off, why };
}

function distance_from_edge(a, b, p) {
  const along = ((b[0] - a[0]) * (p[0] - a[0]) + (b[1] - a[1]) * (p[1] - a[1])) / (distance(a, b) ** 2 || 1);
  return distance(p, between(a, b, clamp(along, 0, 1)));
}

// The round in which v is tried. After it is gone its neighbors wait for the next pass, so that those that
// go are spread evenly.
function coarsening_round(field, kappa, contour, round, v, bound) {
  const { why, before, after } = removal_of(field, kappa, contour, round.loops, v, bound);
  const done = why === '' ? [v, before, after] : [v];
  const loops = why === '' ? round.loops.map((loop) => loop.filter((u) => u !== v)) : round.loops;
  const removed = round.removed + (why === '' ? 1 : 0);
  const next = { ...round, loops, vertex: v, why, removed, waiting: round.waiting.filter((u) => !done.includes(u)) };
  // Another pass, if this one has removed something.
  if (next.waiting.length > 0 || removed === 0) return next;
  return { ...next, pass: round.pass + 1, removed: 0, waiting: loops.flat() };
}

// All rounds from `first` on. No pass is without a removal but the last.
function coarsen(field, kappa, contour, first, bound) {
  const rounds = [first];
  while (rounds.at(-1).waiting.length > 0) {
    const round = rounds.at(-1);
    rounds.push(coarsening_round(field, kappa, contour, round, round.waiting[0], bound));
  }
  return rounds;
}
