'use strict';
// What the text asks the reader to do, and its numbers: from the state.

// By name: true when it is done.
const kTasks = {
  cubes: (s) => marching_cubes_of(s.contour).loops === s.contour.loops.length,
  saddles: (s) => s.contour.saddles.length >= 2,
  neck: (s) => s.kappa === s.header.isovalue && s.contour.loops.length >= 2,
  pieces: (s) => s.sites.length === 10 && s.regions.arcs.every((arcs) => arcs.length === 1),
  c1: (s) => s.sites.length === 11 && s.fault?.condition === 'C1',
  coarse: (s) => s.coarsened.loops.flat().length <= 20,
  refused: (s) => s.round.why !== '',
  edges: (s) => s.finished().at(-1).loops.flat().length <= 20,
};

const kNumbers = {
  inside: (s) => s.field.samples.filter((value) => value >= s.kappa).length,
  samples: (s) => s.field.samples.length,
  vertices: (s) => s.contour.points.length,
  loops: (s) => counted(s.contour.loops.length, 'loop', 'loops'),
  pieces: (s) => counted(s.regions.arcs[0].length, 'piece', 'pieces'),
  sites: (s) => s.sites.length + s.added.length,
  edges: (s) => s.finished().at(-1).loops.flat().length,
  cubes: (s) => marching_cubes_of(s.contour).loops,
  saddle: (s) => s.contour.saddles.length > 0 ? s.contour.saddles[0].value.toFixed(1) : 'gone',
  left: (s) => s.coarsened.loops.flat().length,
  h: (s) => s.facet(s.facets()).h.toFixed(2),
};
