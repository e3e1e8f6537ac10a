'use strict';
// The pictures of the slice: what each draws, tells, and lets the reader do.
// name: {draw(picture, state), legend(state): [shape, class, words] each, tell(state): lines, controls: names, code:
// the functions that make it}, and where pseudocode is beside it, line(state): the line that runs next. With `zoom` a
// part of it is shown large beside it: {view(state), draw(picture, state)}. `handles` take the place of sites'.

const kSites = ['add', 'remove', 'again'];
// Why the last round changed nothing.
const tell_refused = ({ why }) => why === '' ? [] : [`Refused: ${why}.`];
const kSigma = ['line', 'sigma', '\u03a3'], kDual = ['line', 'dual', 'the mesh'];
// The mesh that Stage 2 makes, its vertices and those of Stage 1.
const kOfStages = [['ring', 'knob', 'a site of Stage 1'], ['dot', 'vertex', 'a surface point of Stage 2']];
// Edges shorter than this share of a voxel get a ring.
const kShort = 0.3;

// The mesh of the sites, right or not, at the end of Stage 2.
const few_points_refined = (state) =>
  refine(state.field, state.kappa, first_round(state.walks(state.sites)), state.limit, kRMin).at(-1);

const kPictures = {
  need: {
    controls: ['cubes', 'refined', 'kappa', 'undo', 'again'],
    code: () => [marching_cubes_of],
    legend: ({ way }) => [['line', 'sigma dashed', '\u03a3'], ...way === 'cubes'
      ? [['line', 'contour', 'Marching Cubes'], ['line', 'wrong', 'not as in \u03a3'],
         ['ring', 'short', `shorter than ${in_voxels(kShort)}`]]
      : [['line', 'dual', 'ten points, refined'], ['ring', 'stray', 'where it meets itself']]],
    draw(picture, state) {
      draw_body(picture, state);
      picture.name_sides(state.contour, state.field, state.kappa);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma dashed', true);
      if (state.way === 'cubes') {
        const { edges, wrong } = marching_cubes_of(state.contour);
        for (const edge of edges) {
          picture.polyline(edge, wrong.includes(edge) ? 'wrong' : 'contour');
          picture.dot(edge[0], 'vertex', 0.07 * picture.scale);
        }
        for (const [p, q] of edges) {
          if (distance(p, q) < kShort) picture.dot(between(p, q, 0.5), 'short', 0.3 * picture.scale);
        }
        const cuts = ['Marching Cubes', 'cuts the neck'];
        if (wrong.length > 0) picture.point_out(between(...wrong[0], 0.5), cuts, state.contour.curves);
        return;
      }
      for (const loop of few_points_refined(state).loops) {
        picture.polyline(loop, 'dual', true);
        for (const p of loop) picture.dot(p, 'vertex', 0.09 * picture.scale + 1);
      }
      if (state.fault) {
        const site = state.contour.points[state.sites[state.fault.site]];
        picture.dot(site, 'stray', 0.3 * picture.scale);
        point_out_fault(picture, state, state.contour.curves);
      }
    },
    tell(state) {
      const true_loops = `\u03a3 has ${counted(state.contour.loops.length, 'loop', 'loops')}.`;
      if (state.way === 'cubes') {
        const { edges, loops } = marching_cubes_of(state.contour), sizes = edges.map((edge) => distance(...edge));
        const short = sizes.filter((size) => size < kShort).length;
        return [`${counted(edges.length, 'edge', 'edges')} in ${counted(loops, 'loop', 'loops')}. ${true_loops}`,
                `${counted(short, 'edge is', 'edges are')} shorter than ${in_voxels(kShort)}: ringed.`];
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
    code: () => [Field.prototype.value],
    legend: () => [['ring', 'sample inside', 'at least \u03ba: inside'],
                   ['ring', 'sample outside', 'below \u03ba: outside'],
                   ['square', 'zoomed filled', 'a voxel whose corners alternate']],
    draw(picture, state) {
      picture.draw_sides(null);
      picture.draw_grid();
      for (const { at } of state.contour.saddles) draw_voxel(picture, at.map(Math.floor), 'zoomed filled');
      picture.draw_samples(state.field, state.kappa, state.chosen_sample, 0.34);
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
    code: () => [cell_curves],
    legend: () => [['line', 'contour', 'T'], ['line', 'sigma dashed', '\u03a3'], ['cross', 'cross', 'a saddle'],
                   ['square', 'zoomed', 'the voxel that is shown large']],
    draw(picture, state) {
      draw_body(picture, state);
      draw_voxel(picture, state.zoomed);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma dashed', true);
      picture.draw_contour(state.contour, 'contour', true);
      for (const { at } of state.contour.saddles) picture.cross(at, 0.12 * picture.scale);
      picture.draw_numbers(state.field, state.chosen_sample, state.contour, state.zoomed);
      picture.name_sides(state.contour, state.field, state.kappa);
    },
    zoom: {
      view: ({ zoomed: [i, j] }) => ({ x: i - 0.3, y: j - 0.42, width: 1.6, height: 1.75 }),
      draw: draw_large_voxel,
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
    code: () => [regions_of],
    legend: ({ regions }) => [
      ['ring', 'knob', 'a site, a vertex of T'], ['line', 'band style0', 'a region: nearest to one site'],
      ...regions.arcs.some((arcs) => arcs.length > 1) ? [['line', 'band astray', 'a piece without its site']] : [],
      ['line', 'voronoi', 'as far from one site as from another']],
    takes_keys: true,
    line: (state) => state.fault ? 'recover' : state.next_facet(state.facets()) ? 'refine' : 'return',
    draw(picture, state) {
      draw_body(picture, state);
      draw_regions(picture, state);
      put_sites(picture, state);
      point_out_stray(picture, state);
    },
    tell(state) {
      const broken = state.regions.arcs.flatMap((arcs, n) => arcs.length > 1 ? [state.name(n)] : []);
      return [`Site ${state.name(state.chosen)}: ${state.note(state.chosen)}.`,
              broken.length > 0 ? `In more than one piece: ${broken.join(', ')}.` : 'Every region is in one piece.'];
    },
  },
  dual: {
    controls: ['back', 'ask', 'play_sites', ...kSites],
    code: () => [certificate_of, certify],
    legend: ({ fault }) => [['line', 'dual', 'K'], ['line', 'contour thin', 'T'], ['ring', 'knob', 'a site'],
      ...fault ? [['line', 'dual wrong', 'where the certificate fails'], ['ring', 'stray', 'vertices at fault']] : []],
    takes_keys: true,
    line: ({ fault }) => fault?.condition ?? 'return',
    draw(picture, state) {
      draw_body(picture, state);
      picture.draw_contour(state.contour, 'contour thin', true);
      draw_dual(picture, state);
      draw_fault(picture, state);
      put_sites(picture, state);
      point_out_fault(picture, state, [...state.contour.curves, ...edges_of_dual(state)]);
    },
    tell: tell_fault,
  },
  coarsen: {
    controls: ['back_removal', 'remove_vertex', 'play_removals', 'limit'],
    code: () => [removal_of, coarsening_round],
    legend: () => [['line', 'dual', 'what is left of T'], ['line', 'contour faint', 'T'], kSigma,
                   ['line', 'coming', 'the new edge'], ['square', 'bound', 'within D of it'], ['ring', 'ball', 'its ball']],
    takes_keys: true,
    // Of p, the vertex that is tried.
    handles: {
      select() {},
      move: (state, n, v) => state.choose_vertex(v),
      remove: (state) => state.remove_vertex(),
    },
    line: (state) => state.tried_vertex() < 0 ? 'return' : state.removal().why === '' ? 'goes' : 'refuse',
    press: (state, at) => state.choose_vertex(nearest_vertex(state.contour, at, (v) => state.is_left(v))),
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      picture.draw_contour(state.contour, 'contour faint', false);
      const { points } = state.contour, { loops } = state.coarsened;
      for (const loop of loops) {
        picture.polyline(loop.map((v) => points[v]), 'dual', true);
        for (const v of loop) picture.dot(points[v], 'vertex', 0.09 * picture.scale + 1);
      }
      const v = state.tried_vertex();
      if (v >= 0) draw_removal(picture, state.removal(), state.limit);
      picture.put_sites(state.contour, v < 0 ? [] : [v], ['p'], 0, [this.tell(state).join(' ')],
                        { role: 'Vertex', allowed: (u) => state.is_left(u) });
      if (v < 0) return;
      const { why, off } = state.removal();
      const reason = off > state.limit ? `it is ${off.toFixed(2)} from the new edge` : why;
      const told = why === '' ? ['p may go'] : ['p stays:', ...in_lines(reason)];
      picture.point_out(points[v], told, [...state.contour.curves, ...loops.map((loop) => loop.map((u) => points[u]))]);
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
    code: () => [facet_of, cavity_of, why_not_inserted],
    legend: () => [kDual, kSigma, ['line', 'line', 'the dual line \u2113'], ['ring', 'ball', 'the surface ball'],
                   ['line', 'coming', 'the edges to come']],
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
      const facets = state.facets(), facet = state.facet(facets);
      const why = why_not_inserted(state.field, state.kappa, facets, facet);
      if (why === '') return;
      picture.point_out(facet.x ?? facet.center, ['refused:', ...in_lines(why)], [...state.contour.curves, ...state.loops]);
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
    code: () => [refine, worst_of, next_round],
    legend: () => [kDual, kSigma, ...kOfStages],
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
      const facets = facets_of(state.field, state.kappa, round.loops);
      const { x, center, h } = facets.reduce((best, f) => f.h > best.h ? f : best);
      picture.point_out(x ?? center, [`largest h: ${h.toFixed(2)}`], [...state.contour.curves, ...round.loops]);
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
