'use strict';
// Stage 1 on a slice: the regions of sites on T, the certificate, and the dual mesh K.

// sites: vertices of T, all different. Returns {site_of, far, arcs, interfaces}. For each vertex,
// site_of has the number of its nearest site, and far the distance from it. For each site, arcs has the
// arcs of its region, as {vertices, closed}. interfaces has the edges of T whose ends have different
// sites, as {a, b, from, to}.
function regions_of(contour, sites) {
  const far = contour.points.map(() => Infinity);
  const site_of = contour.points.map((p, v) => {
    let best = -1;
    sites.forEach((s, n) => {
      const d = distance(p, contour.points[s]);
      if (d < far[v]) [far[v], best] = [d, n];
    });
    return best;
  });
  const arcs = sites.map(() => []), interfaces = [];
  for (const loop of contour.loops) {
    const begins = loop.findIndex((v) => site_of[v] !== site_of[contour.previous[v]]);
    if (begins < 0) {
      arcs[site_of[loop[0]]].push({ vertices: [...loop], closed: true });
      continue;
    }
    for (let n = 0; n < loop.length; ++n) {
      const v = loop[(begins + n) % loop.length], before = contour.previous[v];
      if (site_of[v] !== site_of[before]) {
        interfaces.push({ a: site_of[before], b: site_of[v], from: before, to: v });
        arcs[site_of[v]].push({ vertices: [], closed: false });
      }
      arcs[site_of[v]].at(-1).vertices.push(v);
    }
  }
  return { site_of, far, arcs, interfaces };
}

// The certificate. Returns nothing if K has the topology of T. Otherwise returns the first
// condition that fails: {condition, kind, site, other, stray, insert}. `stray` are the vertices at fault.
// `insert` is the one of them that is furthest from its site.
function certificate_of(contour, sites, regions) {
  const furthest = (vertices) => vertices.reduce(
    (best, v) => regions.far[v] > 0 && (best < 0 || regions.far[v] > regions.far[best]) ? v : best, -1);
  for (let n = 0; n < sites.length; ++n) {
    const arcs = regions.arcs[n];
    if (arcs.length === 1 && !arcs[0].closed) continue;
    const others = arcs.filter((arc) => !arc.vertices.includes(sites[n]));
    const stray = (others.length > 0 ? others : arcs).flatMap((arc) => arc.vertices);
    return { condition: 'C1', kind: others.length > 0 ? 'pieces' : 'closed', site: n, stray, insert: furthest(stray) };
  }
  for (const { a, b } of regions.interfaces) {
    const shared = regions.interfaces.filter((i) => i.a === a && i.b === b || i.a === b && i.b === a);
    if (shared.length < 2) continue;
    const stray = shared.flatMap(({ from, to }) => [from, to]);
    return { condition: 'C2', kind: 'interface', site: a, other: b, stray, insert: furthest(stray) };
  }
  return null;
}

// Inserts what the certificate asks for until it holds. Ends, since T has finitely many vertices: with
// all as sites K is T.
function certify(contour, sites) {
  const all = [...sites];
  for (;;) {
    const fault = certificate_of(contour, all, regions_of(contour, all));
    if (!fault || fault.insert < 0) return all;
    all.push(fault.insert);
  }
}

// K's loops as lists of sites' numbers. pre: the certificate holds.
function dual_loops(contour, regions) {
  return contour.loops.map((loop) => loop.filter(
    (v) => regions.site_of[v] !== regions.site_of[contour.previous[v]]).map((v) => regions.site_of[v]));
}
