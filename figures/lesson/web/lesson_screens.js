'use strict';
// The six screens: what each says, draws and lets the reader do.
// {title, lead, more: paragraphs; draw(picture, state); tell(state): lines; controls: names}

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
  const name = state.name(Math.min(fault.site, fault.other ?? fault.site));
  const what = {
    pieces: `The region of ${name} is in ${state.regions.arcs[fault.site].length} pieces.`,
    closed: `The region of ${name} is a whole loop.`,
    interface: `The regions of ${name} and ${state.name(Math.max(fault.site, fault.other))} meet at more than one place.`,
  }[fault.kind];
  return [`The certificate fails. ${what}`,
          fault.insert >= 0 ? 'It asks for the vertex v as a site.' : 'All vertices there are sites already.'];
}

const tell_no_mesh = (state) =>
  [tell_fault(state)[0], 'Stage 2 begins when it holds: press \u201cInsert until it holds\u201d.'];

const in_voxels = (x) => `${x.toFixed(2)} voxels`;
const kSites = ['add', 'remove', 'again'];

const kScreens = [
  {
    title: 'Samples, and the isovalue',
    lead: ['A scan is a grid of numbers. Each number is a *sample*. The square between four samples is a *voxel*.',
           'You choose one number, the *isovalue* \u03ba (kappa). Samples of at least \u03ba are inside: orange. The others are outside: blue, with dashed rings.'],
    more: ['Move \u03ba and watch the sides change. Then point anywhere between the samples: the value there is interpolated from the four corners of the voxel.',
           'All points with exactly the value \u03ba form the *isosurface* \u03a3. On a slice it is a curve. The mesh must match it.'],
    controls: ['kappa'],
    draw(picture, state) {
      picture.draw_sides(null);
      picture.draw_grid();
      picture.draw_samples(state.kappa);
    },
    tell(state) {
      const inside = state.field.samples.filter((value) => value >= state.kappa).length;
      const lines = [`\u03ba = ${state.kappa}: ${inside} samples inside, ${state.field.samples.length - inside} outside.`];
      if (state.place) {
        const value = state.field.value(state.place);
        lines.push(`At the pointer: ${value.toFixed(1)}, ${value >= state.kappa ? 'inside' : 'outside'}.`);
      }
      return lines;
    },
  },
  {
    title: 'The exact contour',
    lead: ['\u03a3 crosses a side of a voxel where one end is inside and the other outside. Segments between the crossings form the *contour* T.',
           'The thin dashed curve is \u03a3. T has the same *topology*: here, as many loops.'],
    more: ['A cross marks a voxel whose corners alternate. Four crossings could be joined in two ways. The *saddle* of the interpolant decides: if it is at least \u03ba, the inside is joined there.',
           'Raise \u03ba to 53: the saddle is outside then, and the body falls into two. T notices at once.'],
    controls: ['kappa'],
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma dashed', true);
      picture.draw_contour(state.contour, 'contour', true);
      for (const { at } of state.contour.saddles) {
        const d = 0.16;
        picture.polyline([[at[0] - d, at[1] - d], [at[0] + d, at[1] + d]], 'cross');
        picture.polyline([[at[0] - d, at[1] + d], [at[0] + d, at[1] - d]], 'cross');
      }
    },
    tell(state) {
      const { points, loops, saddles } = state.contour;
      return [`T has ${points.length} vertices in ${counted(loops.length, 'loop', 'loops')}.`,
              ...saddles.map(({ value, joined }) => `The saddle is ${value.toFixed(1)}, ` +
                (joined ? `at least ${state.kappa}: joined.` : `below ${state.kappa}: apart.`))];
    },
  },
  {
    title: 'Sites and their regions',
    lead: ['A coarse mesh needs a few vertices only. They are called *sites*, and each is a vertex of T. Drag them.',
           'The *region* of a site is the set of vertices of T that are nearest to it. Thick lines show regions. Dashed lines are equally far from two sites.'],
    more: ['Look at site A, at the neck. Rings mark a vertex that is nearest to A, but on the other side of the neck. So the region of A is in two pieces.',
           'Drag A away from the neck, or drag another site near to v. When are the regions whole?'],
    controls: kSites,
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
  {
    title: 'The dual mesh',
    lead: ['Two sites are joined where their regions meet on T. These edges are the *dual* mesh K.',
           'K must be as T is. The *certificate* asks: is each region one arc, and do two regions meet at one place only?'],
    more: ['Where it fails, it names a vertex v: the one furthest from its site among the vertices at fault. Make v a site, and look again.',
           'Remove sites until two are left. Their regions meet at two places. So K has two edges between the same two sites, and these are no loop.',
           'In space a region must be a disk, and two regions must meet along one arc. It always ends: at worst all vertices of T are sites.',
           'The paper joins sites whose Voronoi cells meet on \u03a3: the *restricted Delaunay triangulation*. K is that idea with T in the place of \u03a3.'],
    controls: ['ask', 'certify', ...kSites],
    draw(picture, state) {
      draw_body(picture, state);
      picture.draw_contour(state.contour, 'contour thin', true);
      draw_dual(picture, state);
      draw_fault(picture, state);
      put_sites(picture, state);
    },
    tell: tell_fault,
  },
  {
    title: 'One insertion',
    lead: ['K has the right topology, but it is far from \u03a3. Stage 2 adds vertices on \u03a3. A click or a tap selects an edge.',
           'c is the center of the edge. The *dual line* \u2113 goes through c at a right angle. It meets \u03a3 in the *surface point* x, at the distance h.'],
    more: ['The *surface ball* is centered at x and passes through the ends of the edge. An edge whose ball holds the new vertex is removed. These edges are the *cavity*. On a slice it is one edge; with two a vertex would be lost, and the insertion is refused. In space it is a disk of triangles, called *facets*.',
           'The new edges join x to the ends of the cavity: dashed before, solid once you insert. Drag a site: the ball follows at once.'],
    controls: ['insert', 'worst', 'next', 'certify', 'again'],
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      if (!state.loops) {
        draw_dual(picture, state);
        draw_fault(picture, state);
        put_sites(picture, state);
        return;
      }
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
      if (x) {
        picture.dot(x, 'surface-point', 6);
        picture.text(x, 'x', 'label', [16 * dx - 4, -16 * dy + 5]);
        picture.text(between(center, x, 0.5), 'h', 'label', [1.4 * aside[0], 1.4 * aside[1] + 5]);
        // On the side of the ball that the edge is not on.
        const side = center[1] > x[1] ? -1 : 1;
        const [px, py] = picture.to_paper([x[0], x[1] + side * facet.radius]);
        picture.put('text', { x: clamp(px, 60, picture.width - 60), class: 'label',
                              y: clamp(py + (side < 0 ? 16 : -6), 16, picture.height - 6) }, 'surface ball');
      }
      put_sites(picture, state);
    },
    tell(state) {
      if (!state.loops) return tell_no_mesh(state);
      const facet = state.facet(state.facets());
      return [facet.x ? `h = ${in_voxels(facet.h)}; radius of the ball: ${in_voxels(facet.radius)}.`
                      : 'The dual line does not meet \u03a3 near this edge.',
              state.said || `${counted(state.by_hand, 'point', 'points')} inserted by hand.`];
    },
  },
  {
    title: 'The finished mesh',
    lead: ['Stage 2 goes on, the worst edge first, until no edge is further from \u03a3 than the limit D.',
           'Move D: a smaller limit needs more vertices, most of them where \u03a3 bends.'],
    more: ['Rings are the sites of Stage 1, dots the surface points of Stage 2. Drag the sites: another beginning gives another mesh, with the same topology and the same limit.',
           'In space the edges are triangles, and their shape is bounded too. Edges shorter than 0.2 voxels are left as they are; the program has such a limit, r_min.',
           'That is the whole method. The guide explains each step with the code, and the command-line program meshes your own volumes.'],
    controls: ['limit', 'certify', 'again'],
    draw(picture, state) {
      draw_body(picture, state);
      for (const curve of state.contour.curves) picture.polyline(curve, 'sigma', true);
      if (!state.loops) {
        draw_dual(picture, state);
        draw_fault(picture, state);
      } else {
        for (const loop of state.finished().loops) {
          picture.polyline(loop, 'dual', true);
          for (const p of loop) picture.dot(p, 'vertex', 0.09 * picture.scale + 1);
        }
      }
      put_sites(picture, state);
    },
    tell(state) {
      if (!state.loops) return tell_no_mesh(state);
      const { loops, inserted, refused } = state.finished();
      const most = Math.max(...facets_of(state.field, state.kappa, loops).map((f) => f.h));
      const edges = loops.reduce((sum, loop) => sum + loop.length, 0);
      return [`${state.sites.length} sites and ${inserted} surface points: ${edges} edges. T has ${state.contour.points.length}.`,
              `Largest h: ${in_voxels(most)}; D = ${in_voxels(state.limit)}.` +
              (refused > 0 ? ` ${counted(refused, 'insertion was', 'insertions were')} refused.` : '')];
    },
  },
];
