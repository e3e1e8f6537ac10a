'use strict';
// What the pictures of the slice draw, and what several of them tell.

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
      // Of a region in pieces, those without its site.
      const style = arcs.length > 1 && !vertices.includes(state.sites[n]) ? 'astray' : `style${styles[n]}`;
      picture.polyline(points, `band ${style}`, closed);
      for (const p of points) picture.dot(p, `vertex ${style}`, 0.09 * picture.scale + 1);
    }
  });
}

// The vertices at fault in rings, and v, the one that the certificate asks for.
function draw_fault(picture, state) {
  const { fault, contour } = state;
  if (!fault) return;
  for (const v of fault.stray) picture.dot(contour.points[v], 'stray', 0.2 * picture.scale + 3);
  if (fault.insert < 0) return;
  const v = fault.insert, p = contour.points[contour.previous[v]], q = contour.points[contour.next[v]];
  // Above or below, away from the body; letters of sites stand aside.
  const down = q[0] > p[0] ? 27 : -16, [x, y] = picture.to_paper(contour.points[v]);
  picture.text(contour.points[v], 'v', 'asked', [0, down]);
  picture.letters.push([x, y + down - 5], [x, y]);
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

// Which vertex is astray, and where its site is.
function point_out_stray(picture, state) {
  const { fault, contour, field, kappa } = state;
  if (fault?.kind !== 'pieces' || fault.insert < 0) return;
  const p = contour.points[fault.insert], site = contour.points[state.sites[fault.site]];
  const where = field.value(between(p, site, 0.5)) >= kappa ? 'across the neck' : 'across the gap';
  picture.point_out(p, [`nearest to ${state.name(fault.site)} too,`, where], contour.curves);
}

// How many edges of K meet at the site at fault.
function point_out_fault(picture, state, curves) {
  const { fault, contour, regions, sites } = state;
  if (!fault) return;
  const count = regions.interfaces.filter(({ a, b }) => a === fault.site || b === fault.site).length;
  if (count < 3) return;
  picture.point_out(contour.points[sites[fault.site]], [`${count} edges meet`, `at ${state.name(fault.site)}`], curves);
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

// A sentence in lines of some 22 letters.
const in_lines = (text) => text.match(/.{1,22}(?= |$)/g).map((line) => line.trim());

// K's edges, as lines of points.
const edges_of_dual = ({ contour, regions, sites }) => regions.interfaces.map(({ a, b }) =>
  [0, 0.2, 0.4, 0.6, 0.8, 1].map((t) => between(contour.points[sites[a]], contour.points[sites[b]], t)));

function draw_voxel(picture, [i, j], name = 'zoomed') {
  picture.polyline([[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], name, true);
}

// A voxel by itself: its samples, how Sigma and T pass it, and what the saddle decides.
function draw_large_voxel(picture, state) {
  const { contour, field, kappa, zoomed: [i, j] } = state;
  picture.draw_sides(contour);
  picture.draw_grid();
  draw_voxel(picture, [i, j]);
  for (const curve of contour.curves) picture.polyline(curve, 'sigma dashed', true);
  picture.draw_contour(contour, 'contour', false);
  const sides = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9].map((t) => [[i + t, j], [i + 1, j + t], [i + 1 - t, j + 1], [i, j + 1 - t]]);
  const corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
  const is_here = ([x, y]) => x >= i && x <= i + 1 && y >= j && y <= j + 1;
  for (const p of contour.points) if (is_here(p)) picture.dot(p, 'vertex', 5);
  // Names on the two sides of an edge of T here: Sigma on the one that it bends to.
  const names = [];
  const v = contour.points.findIndex((p, u) => is_here(p) && is_here(contour.points[contour.next[u]]));
  if (v >= 0) {
    const p = contour.points[v], q = contour.points[contour.next[v]], size = distance(p, q) || 1, m = between(p, q, 0.5);
    const [dx, dy] = [(q[1] - p[1]) / size, (p[0] - q[0]) / size], at = (t) => [m[0] + t * dx, m[1] + t * dy];
    const side = field.value(m) >= kappa ? 1 : -1;
    let t = 0;
    while (t < 0.5 && (field.value(at(side * t)) >= kappa) === side > 0) t += 0.01;
    names.push(at(-0.09 * side), at(side * (t + 0.09)));
    ['T', '\u03a3'].forEach((name, n) => picture.text(names[n], name, 'label', [0, 5]));
  }
  picture.draw_samples(field, kappa, state.chosen_sample, 0.1);
  const saddle = contour.saddles.find(({ at }) => is_here(at));
  if (saddle) {
    const { at, value, joined } = saddle;
    picture.cross(at, 7);
    picture.point_out(at, [`saddle ${value.toFixed(1)} ${joined ? '\u2265' : '<'} ${kappa}:`, joined ? 'joined' : 'apart'],
                      [...contour.curves, corners, names], sides);
  }
  const [left, right] = [field.at(i, j), field.at(i + 1, j)];
  if ((left >= kappa) === (right >= kappa)) return;
  const t = ((left - kappa) / (left - right)).toFixed(2);
  picture.text([i + 0.5, j], `t = (${left} \u2212 ${kappa}) / (${left} \u2212 ${right}) = ${t}`, 'formula', [0, 40]);
}

// The vertex p that coarsening tries, the edge to come, and what may not be near it: within D on the wrong
// side, and in the ball.
function draw_removal(picture, { a, b, center, outwards, ball, why }, bound) {
  const [dx, dy] = outwards, across = (t) => [center[0] + t * dx, center[1] + t * dy];
  const [cx, cy] = picture.to_paper(center);
  picture.put('circle', { cx, cy, r: ball * picture.scale, class: 'ball' });
  const aside = (p, t) => [p[0] + t * dx, p[1] + t * dy];
  picture.polyline([aside(a, bound), aside(b, bound), aside(b, -bound), aside(a, -bound)], 'bound', true);
  picture.polyline([a, b], why === '' ? 'coming' : 'coming refused');
  picture.polyline([across(-bound), across(bound)], 'height');
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
  picture.text(center, 'c', 'label', [-2 * aside[0] - 2, -2 * aside[1] + 5]);
  for (const [p, name] of [[facet.a, 'a'], [facet.b, 'b']]) picture.text(p, name, 'label', [-15 * dx, 15 * dy + 5]);
  picture.text([center[0] - reach * dx, center[1] - reach * dy], '\u2113', 'label', [10, 5]);
  if (!x) return;
  picture.dot(x, 'surface-point', 6);
  picture.text(x, 'x', 'label', [16 * dx - 4, -16 * dy + 5]);
  const [hx, hy] = picture.to_paper(between(center, x, 0.5));
  picture.put('text', { x: clamp(hx + 3.6 * aside[0], 36, picture.width - 36), y: hy + 3.6 * aside[1] + 5, class: 'label' },
              `h = ${facet.h.toFixed(2)}`);
  // On the side of the ball that the edge is not on.
  const side = center[1] > x[1] ? -1 : 1;
  const [px, py] = picture.to_paper([x[0], x[1] + side * facet.radius]);
  picture.put('text', { x: clamp(px, 60, picture.width - 60), class: 'label',
                        y: clamp(py + (side < 0 ? 16 : -6), 16, picture.height - 6) }, 'surface ball');
}
