'use strict';
// The pictures of the slice: what each draws, tells, and lets the reader do.
// name: {draw(picture, state), tell(state): lines, controls: names}, and where pseudocode is beside it, line(state):
// the line that runs next

function draw_body(picture, state) {
  picture.draw_sides(state.contour);
  picture.draw_grid();
}

// A region's edges in one of four styles, so that neighbors differ.
function region_styles(state) {
  const styles = [];
  state.sites.forEach((_, n) => {
    const taken = state.regions.interfaces.flatMap(({ a, b }) => a === n ? [styles[b]] : b === n ? [styles[a]] : []);
    const free = [0, 1, 2, 3].filter((style) => !taken.includes(style));
    styles[n] = free.length > 0 ? free[0] : n % 4;
  });
  return styles;
}

function draw_regions(picture, state) {
  const { contour, regions } = state, styles = region_styles(state);
  picture.draw_voronoi(state.sites.map((v) => contour.points[v]));
  picture.draw_contour(contour, 'contour thin', false);
  regions.arcs.forEach((arcs, n) => {
    for (const { vertices, closed } of arcs) {
      const points = vertices.map((v) => contour.points[v]);
      picture.polyline(points, `band style${styles[n]}`, closed);
      for (const p of points) picture.dot(p, `vertex style${styles[n]}`, 0.09 * picture.scale + 1);
    }
  });
  draw_fault(picture, state);
}

// The vertices at fault in rings, and v, the one that the certificate asks for.
function draw_fault(picture, state) {
  const { fault, contour } = state;
  if (!fault) return;
  for (const v of fault.stray) picture.dot(contour.points[v], 'stray', 0.2 * picture.scale + 3);
  if (fault.insert < 0) return;
  const v = fault.insert, p = contour.points[contour.previous[v]], q = contour.points[contour.next[v]];
  // Above or below, away from the body; letters of sites stand aside.
  picture.text(contour.points[v], 'v', 'asked', [0, q[0] > p[0] ? 27 : -16]);
}

function draw_dual(picture, state) {
  const { contour, regions, sites, fault } = state;
  for (const { a, b, from, to } of regions.interfaces) {
    const is_wrong = fault && (fault.stray.includes(from) || fault.stray.includes(to));
    const p = contour.points[sites[a]], q = contour.points[sites[b]];
    // Two edges between the same two sites are bent, each to its right.
    const is_twin = regions.interfaces.some((other) => other.a === b && other.b === a);
    const bend = is_twin ? 0.15 : 0, m = between(p, q, 0.5);
    const aside = [m[0] + bend * (q[1] - p[1]), m[1] - bend * (q[0] - p[0])];
    picture.polyline([p, aside, q], is_wrong ? 'dual wrong' : 'dual');
  }
}

function put_sites(picture, state) {
  picture.put_sites(state.contour, state.sites, state.sites.map((_, n) => state.name(n)), state.chosen,
                    state.sites.map((_, n) => state.note(n)));
}

function tell_fault(state) {
  const { fault } = state;
  if (!fault) {
    const loops = counted(state.contour.loops.length, 'loop', 'loops');
    return ['The certificate holds: ' + `K is ${loops}, as T is.`];
  }
  const name = state.name(Math.min(fault.site, fault.other ?? fault.site)), v = fault.insert;
  const what = {
    pieces: `The region of ${name} is in ${state.regions.arcs[fault.site].length} pieces.`,
    closed: `The region of ${name} is a whole loop.`,
    interface: `The regions of ${name} and ${state.name(Math.max(fault.site, fault.other))} meet at more than one place.`,
  }[fault.kind];
  if (v < 0) return [`${fault.condition} fails. ${what}`, 'All vertices there are sites already.'];
  const site = state.name(state.regions.site_of[v]);
  const which = fault.stray.length > 1 ? 'of the ringed vertices the furthest from its site' : 'the ringed vertex';
  return [`${fault.condition} fails. ${what}`, `Next comes v: ${which}, ${in_voxels(state.regions.far[v])} from ${site}.`];
}

// Sites that the certificate asks for where it fails: the mesh has them, the pictures above do not.
function draw_added(picture, state) {
  for (const v of state.added) picture.dot(state.contour.points[v], 'added', 9);
}
function tell_added({ added }) {
  if (added.length === 0) return [];
  return [`The certificate fails; here it holds, with ${counted(added.length, 'site', 'sites')} more (dashed).`];
}

// The worst edge of a mesh: its h.
const largest_h = (state, loops) => Math.max(...facets_of(state.field, state.kappa, loops).map((f) => f.h));

const in_voxels = (x) => `${x.toFixed(2)} voxels`;
const kSites = ['add', 'remove', 'again'];
// Why the last round changed nothing.
const tell_refused = ({ why }) => why === '' ? [] : [`Refused: ${why}.`];
// Edges shorter than this share of a voxel get a ring.
const kShort = 0.3;

// The mesh of the sites, right or not, at the end of Stage 2.
const few_points_refined = (state) =>
  refine(state.field, state.kappa, first_round(state.walks(state.sites)), state.limit, kRMin).at(-1);

const kPictures = {
  need: {
    controls: ['cubes', 'refined', 'kappa', 'undo', 'again'],
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma dashed', true);
      if (state.way === 'cubes') {
        const { edges } = marching_cubes_of(state.contour);
        for (const edge of edges) {
          picture.polyline(edge, 'contour');
          picture.dot(edge[0], 'vertex', 0.07 * picture.scale);
        }
        for (const [p, q] of edges) {
          if (distance(p, q) < kShort) picture.dot(between(p, q, 0.5), 'short', 0.3 * picture.scale);
        }
        return;
      }
      for (const loop of few_points_refined(state).loops) {
        picture.polyline(loop, 'dual', true);
        for (const p of loop) picture.dot(p, 'vertex', 0.09 * picture.scale + 1);
      }
      if (state.fault) {
        const site = state.contour.points[state.sites[state.fault.site]];
        picture.dot(site, 'stray', 0.3 * picture.scale);
        picture.text(site, state.name(state.fault.site), 'label', [0, -0.4 * picture.scale]);
      }
    },
    tell(state) {
      const true_loops = `\u03a3 has ${state.contour.loops.length}.`;
      if (state.way === 'cubes') {
        const { edges, loops } = marching_cubes_of(state.contour), sizes = edges.map((edge) => distance(...edge));
        const short = sizes.filter((size) => size < kShort).length;
        return [`${counted(edges.length, 'edge', 'edges')} in ${counted(loops, 'loop', 'loops')}. ${true_loops}`,
                `${short} are shorter than ${in_voxels(kShort)}: ringed.`];
      }
      const { loops, refused } = few_points_refined(state);
      if (!state.fault) return [`Now the sites are enough: ${counted(loops.length, 'loop', 'loops')}. ${true_loops}`];
      return [`The mesh meets itself at ${state.name(state.fault.site)}, so it is no curve. ` +
              `${counted(refused.length, 'edge', 'edges')} cannot be mended; the worst is ` +
              `${in_voxels(largest_h(state, loops))} from \u03a3.`];
    },
  },
  samples: {
    controls: ['kappa', 'sample', 'undo', 'again'],
    draw(picture, state) {
      picture.draw_sides(null);
      picture.draw_grid();
      picture.draw_samples(state.field, state.kappa, state.chosen_sample, false);
    },
    tell(state) {
      const inside = state.field.samples.filter((value) => value >= state.kappa).length;
      const lines = [`\u03ba = ${state.kappa}: ${inside} samples inside, ${state.field.samples.length - inside} outside.`];
      if (state.place) {
        const value = state.field.value(state.place);
        lines.push(`At the pointer g is ${value.toFixed(1)}, ${value >= state.kappa ? 'inside' : 'outside'}.`);
      }
      return lines;
    },
  },
  contour: {
    controls: ['kappa', 'sample', 'undo', 'again'],
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma dashed', true);
      picture.draw_contour(state.contour, 'contour', true);
      for (const { at } of state.contour.saddles) {
        const d = 0.16;
        picture.polyline([[at[0] - d, at[1] - d], [at[0] + d, at[1] + d]], 'cross');
        picture.polyline([[at[0] - d, at[1] + d], [at[0] + d, at[1] - d]], 'cross');
      }
      picture.draw_samples(state.field, state.kappa, state.chosen_sample, true);
    },
    tell(state) {
      const { points, loops, saddles } = state.contour;
      return [`T has ${points.length} vertices in ${counted(loops.length, 'loop', 'loops')}.`,
              ...saddles.map(({ value, joined }) => `The saddle is ${value.toFixed(1)}, ` +
                (joined ? `at least ${state.kappa}: joined.` : `below ${state.kappa}: apart.`))];
    },
  },
  sites: {
    controls: ['undo', ...kSites],
    takes_keys: true,
    line: (state) => state.fault ? 'recover' : state.next_facet(state.facets()) ? 'refine' : 'return',
    draw(picture, state) {
      draw_body(picture, state);
      draw_regions(picture, state);
      put_sites(picture, state);
    },
    tell(state) {
      const broken = state.regions.arcs.flatMap((arcs, n) => arcs.length > 1 ? [state.name(n)] : []);
      return [`Site ${state.name(state.chosen)}: ${state.note(state.chosen)}.`,
              broken.length > 0 ? `In more than one piece: ${broken.join(', ')}.` : 'Every region is in one piece.'];
    },
  },
  dual: {
    controls: ['back', 'ask', 'play_sites', ...kSites],
    takes_keys: true,
    line: ({ fault }) => fault?.condition ?? 'return',
    draw(picture, state) {
      draw_body(picture, state);
      picture.draw_contour(state.contour, 'contour thin', true);
      draw_dual(picture, state);
      draw_fault(picture, state);
      put_sites(picture, state);
    },
    tell: tell_fault,
  },
  coarsen: {
    controls: ['back_removal', 'remove_vertex', 'play_removals', 'limit'],
    line: (state) => state.tried_vertex() < 0 ? 'return' : state.removal().why === '' ? 'goes' : 'refuse',
    press(state, at) { state.chosen_vertex = nearest_vertex(state.contour, at); },
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      picture.draw_contour(state.contour, 'contour faint', false);
      const { points } = state.contour, { loops } = state.coarsened;
      for (const loop of loops) {
        picture.polyline(loop.map((v) => points[v]), 'dual', true);
        for (const v of loop) picture.dot(points[v], 'vertex', 0.09 * picture.scale + 1);
      }
      if (state.tried_vertex() >= 0) draw_removal(picture, state.removal(), points, state.limit);
    },
    tell(state) {
      const { loops, pass } = state.coarsened, v = state.tried_vertex();
      const left = `${loops.flat().length} of ${state.contour.points.length} vertices are left, in ` +
                   `${counted(loops.length, 'loop', 'loops')} as in T.`;
      if (v < 0) return [left, 'A whole pass has removed nothing: the end.'];
      const { why, off } = state.removal();
      return [left, `Pass ${pass}. Next is p, ${in_voxels(off)} from the new edge; D = ${state.limit.toFixed(2)}.`,
              why === '' ? 'It may go.' : `It stays: ${why}.`];
    },
  },
  insertion: {
    controls: ['back_round', 'insert', 'play_rounds', 'worst', 'next', 'certify', 'again'],
    line(state) {
      const facets = state.facets();
      if (!state.edge && !state.next_facet(facets)) return 'end';
      return why_not_inserted(state.field, state.kappa, facets, state.facet(facets)) === '' ? 'goes' : 'refuse';
    },
    press(state, at) { state.edge = at; },
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      draw_insertion(picture, state);
      draw_added(picture, state);
      put_sites(picture, state);
    },
    tell(state) {
      const facets = state.facets(), facet = state.facet(facets), next = state.next_facet(facets);
      const which = facet === next ? 'the largest that is left'
                  : state.edge ? 'of the edge that you chose' : 'the largest';
      return [...tell_added(state), ...tell_refused(state.round),
              facet.x ? `h = ${in_voxels(facet.h)}, ${which}; D = ${state.limit.toFixed(2)}. Radius of the ball: ` +
                        `${in_voxels(facet.radius)}.`
                      : 'The dual line does not meet \u03a3 near this edge.',
              next ? `${counted(state.by_hand, 'point', 'points')} inserted.`
                   : `${counted(state.by_hand, 'point', 'points')} inserted; none is left to insert.`];
    },
  },
  mesh: {
    controls: ['limit', 'shown', 'certify', 'again'],
    line(state) {
      const { last, shown } = shown_rounds(state);
      return shown === last ? 'return' : shown === 0 ? 'build' : 'insert';
    },
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      const { round, shown, last } = shown_rounds(state);
      for (const loop of round.loops) {
        picture.polyline(loop, 'dual', true);
        for (const p of loop) picture.dot(p, 'vertex', 0.09 * picture.scale + 1);
      }
      // The one that the slider has come to.
      if (round.facet && shown < last && round.why === '') picture.dot(round.facet.x, 'surface-point', 6);
      draw_added(picture, state);
      put_sites(picture, state);
    },
    tell(state) {
      const { round, shown, last } = shown_rounds(state);
      // A loop has as many edges as vertices.
      const edges = round.loops.flat().length, sites = state.sites.length + state.added.length;
      const refused = round.refused.length;
      return [...tell_added(state), `${sites} sites and ${counted(edges - sites, 'surface point', 'surface points')}: ` +
              `${edges} edges. T has ${state.contour.points.length}.`,
              ...(shown < last ? [`Round ${shown} of ${last}.`] : []),
              `Largest h: ${in_voxels(largest_h(state, round.loops))}; D = ${in_voxels(state.limit)}.` +
              (refused > 0 ? ` ${counted(refused, 'insertion was', 'insertions were')} refused.` : '')];
    },
  },
};

// The rounds of Stage 2 from K to its end, and the one that the last picture shows: at first the last.
function shown_rounds(state) {
  const rounds = [...state.rounds.slice(0, -1), ...state.finished()], last = rounds.length - 1;
  const shown = Math.min(state.shown ?? last, last);
  return { round: rounds[shown], shown, last };
}

// The vertex p that coarsening tries, the edge to come, and what may not be near it: within D on the wrong
// side, and in the ball.
function draw_removal(picture, { vertex, a, b, center, outwards, ball, why }, points, bound) {
  const [dx, dy] = outwards, across = (t) => [center[0] + t * dx, center[1] + t * dy];
  const [cx, cy] = picture.to_paper(center);
  picture.put('circle', { cx, cy, r: ball * picture.scale, class: 'ball' });
  const aside = (p, t) => [p[0] + t * dx, p[1] + t * dy];
  picture.polyline([aside(a, bound), aside(b, bound), aside(b, -bound), aside(a, -bound)], 'bound', true);
  picture.polyline([a, b], why === '' ? 'coming' : 'coming refused');
  picture.polyline([across(-bound), across(bound)], 'height');
  picture.dot(points[vertex], why === '' ? 'surface-point' : 'stray', 0.09 * picture.scale + (why === '' ? 3 : 6));
  picture.text(points[vertex], 'p', 'label', [18 * dx - 4, -18 * dy + 5]);
}

// The chosen edge with its center c, dual line, surface point x, ball, and the edges to come.
function draw_insertion(picture, state) {
  const facets = state.facets(), facet = state.facet(facets);
  if (facet.x) {
    const [cx, cy] = picture.to_paper(facet.x);
    picture.put('circle', { cx, cy, r: facet.radius * picture.scale, class: 'ball' });
  }
  const cavity = facet.x ? [...cavity_of(facets, facet.x)] : [];
  for (const f of facets) {
    const is_in = f === facet || cavity.includes(f);
    picture.polyline([f.a, f.b], is_in ? 'dual going' : 'dual');
  }
  const [dx, dy] = facet.outwards, { center, x } = facet, reach = Math.max(facet.radius, 0.5);
  picture.polyline([[center[0] - reach * dx, center[1] - reach * dy],
                    [center[0] + reach * dx, center[1] + reach * dy]], 'line');
  if (x) {
    picture.polyline([facet.a, x, facet.b], 'coming');
    picture.polyline([center, x], 'height');
  }
  for (const loop of state.loops) for (const p of loop) picture.dot(p, 'vertex', 0.09 * picture.scale + 1);
  picture.dot(center, 'center', 5);
  const aside = [9 * -dy, 9 * -dx];  // on paper, along the edge
  picture.text(center, 'c', 'label', [2 * aside[0] - 5, 2 * aside[1] + 5]);
  picture.text([center[0] - reach * dx, center[1] - reach * dy], '\u2113', 'label', [10, 5]);
  if (!x) return;
  picture.dot(x, 'surface-point', 6);
  picture.text(x, 'x', 'label', [16 * dx - 4, -16 * dy + 5]);
  picture.text(between(center, x, 0.5), 'h', 'label', [1.4 * aside[0], 1.4 * aside[1] + 5]);
  // On the side of the ball that the edge is not on.
  const side = center[1] > x[1] ? -1 : 1;
  const [px, py] = picture.to_paper([x[0], x[1] + side * facet.radius]);
  picture.put('text', { x: clamp(px, 60, picture.width - 60), class: 'label',
                        y: clamp(py + (side < 0 ? 16 : -6), 16, picture.height - 6) }, 'surface ball');
}
