'use strict';
// Bodies in space, to be turned: polygons drawn from the furthest to the nearest, as SVG. All bodies of a
// figure turn together.

// polygons: {points, front, back}: closed, by the classes of its two sides; {points, line}: an open line;
// {points, letter}: letters at a point. Where all of it is: a ball around the origin of radius 1.
class Solid {
  constructor(svg, polygons, width, height) {
    this.svg = svg;
    this.polygons = polygons;
    svg.setAttribute('viewBox', `${-width / 2} ${-height / 2} ${width} ${height}`);
  }

  // yaw, pitch: in radians. The eye looks along -z.
  draw(yaw, pitch) {
    const [s, c, u, v] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
    const turned = ([x, y, z]) => {
      const across = c * x - s * y, deep = s * x + c * y;
      return [across, v * z + u * deep, u * z - v * deep];
    };
    const seen = this.polygons.map((polygon) => {
      const points = polygon.points.map(turned);
      // What is drawn on a polygon lies a little before it.
      const depth = points.reduce((sum, p) => sum + p[2], 0) / points.length + (polygon.lift ?? 0);
      return { polygon, points, depth };
    }).sort((a, b) => a.depth - b.depth);
    this.svg.replaceChildren(...seen.map(({ polygon, points }) => {
      const places = points.map(([x, y]) => `${x.toFixed(3)} ${(-y).toFixed(3)}`);
      if (polygon.letter) {
        const [x, y] = places[0].split(' ');
        return svg_element('text', { x, y, dy: '.06', style: 'font-size:.14px;stroke-width:.04px' }, polygon.letter);
      }
      const d = `M${places.join('L')}${polygon.line ? '' : 'Z'}`;
      const name = polygon.line ?? (area_of(points) > 0 ? polygon.front : polygon.back);
      return svg_element('path', { d, class: name, 'vector-effect': 'non-scaling-stroke' });
    }));
  }
}

// Twice the area in x and y; positive: counter-clockwise.
const area_of = (points) => points.reduce((sum, p, n) => {
  const q = points[(n + 1) % points.length];
  return sum + p[0] * q[1] - p[1] * q[0];
}, 0);

// A triangle in pieces, one for each of the labels of its corners: {points, label}. Edges are cut in the
// middle, triangles of three labels at their barycenter.
function patches_of(corners, labels) {
  const middle = (p, q) => scaled(add(p, q), 0.5);
  if (labels.every((label) => label === labels[0])) return [{ points: corners, label: labels[0] }];
  const single = [0, 1, 2].find((i) => labels[(i + 1) % 3] === labels[(i + 2) % 3]);
  const around = (i) => [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
  if (single !== undefined) {
    const [v, u, w] = around(single), to_u = middle(v, u), to_w = middle(v, w);
    return [{ points: [v, to_u, to_w], label: labels[single] },
            { points: [to_u, u, w, to_w], label: labels[(single + 1) % 3] }];
  }
  const center = scaled(corners.reduce(add), 1 / 3);
  return [0, 1, 2].map((i) => {
    const [v, u, w] = around(i);
    return { points: [v, middle(v, u), center, middle(v, w)], label: labels[i] };
  });
}

// Where patches of two labels meet on a surface: lines, of two points. With '-' for the second label, the
// first one's share of the surface's boundary. triangles: of numbers of points.
function arcs_between(points, labels, triangles, [first, second]) {
  const middle = (u, v) => scaled(add(points[u], points[v]), 0.5), arcs = [];
  for (const t of triangles) {
    const center = scaled(t.map((v) => points[v]).reduce(add), 1 / 3);
    const is_triple = new Set(t.map((v) => labels[v])).size === 3;
    const ends = [];
    t.forEach((u, n) => {
      const v = t[(n + 1) % 3];
      if (second === '-') {
        const is_inner = triangles.some((other) => other.some((w, k) => w === v && other[(k + 1) % 3] === u));
        if (is_inner) return;
        if (labels[u] === first) arcs.push([points[u], middle(u, v)]);
        if (labels[v] === first) arcs.push([middle(u, v), points[v]]);
      } else if ([labels[u], labels[v]].sort().join('') === first + second) {
        if (is_triple) arcs.push([center, middle(u, v)]);
        else ends.push(middle(u, v));
      }
    });
    if (ends.length === 2) arcs.push(ends);
  }
  return arcs;
}

// A Voronoi cell, its neighbors' sites, and the piece of the surface in it, from the page's data.
function cell_polygons({ sides, surface, ends }) {
  return [...sides.map((points) => ({ points, front: 'side', back: 'side' })),
          ...surface.map((points) => ({ points, front: 'front', back: 'back' })),
          ...ends.map((points) => ({ points, line: 'end', lift: 0.01 }))];
}

// A surface in patches of its labels, and K on its right.
function labeled_polygons({ points: at, labels, triangles, dual: of_dual, facets, wrong, marks }) {
  const number = (n) => labels.charCodeAt(n) - 'a'.charCodeAt(0);
  const surface = triangles.flatMap((t) => [
    ...patches_of(t.map((n) => at[n]), t.map(number)).map((piece) =>
      ({ points: piece.points, front: `label${piece.label}`, back: `label${piece.label}` })),
    { points: [...t, t[0]].map((n) => at[n]), line: 'wire', lift: 0.02 }]);
  const fault = marks.split(' ').flatMap((pair) => arcs_between(at, labels, triangles, pair))
    .map((arc) => ({ points: arc, line: 'wrong', lift: 0.25 }));
  const letters = at.map((p, n) => ({ points: [p], letter: labels[n], lift: 0.35 }));
  const k = [...facets.map((f) => ({ points: f.map((n) => of_dual[n]), front: 'dual-facet', back: 'dual-facet' })),
             ...wrong.map((edge) => ({ points: edge.map((n) => of_dual[n]), line: 'wrong', lift: 0.25 })),
             ...of_dual.map((p, n) => ({ points: [p], letter: 'abcde'[n], lift: 0.35 }))];
  return [[...surface, ...fault, ...letters], k];
}

// Puts the bodies into the figure, with their titles.
function put_solids(figure, bodies) {
  const place = element('div', { class: 'solids board' }), solids = [];
  // Small surfaces are flat, and seen from above.
  const are_cells = 'sides' in bodies[0];
  let [yaw, pitch] = are_cells ? [0.5, 0.5] : [0.25, 1];
  const draw = () => { for (const solid of solids) solid.draw(yaw, pitch); };
  const turn = (across, up) => {
    yaw += across;
    pitch = clamp(pitch + up, -1.5, 1.5);
    draw();
  };
  for (const body of bodies) {
    const pictures = are_cells ? [cell_polygons(body)] : labeled_polygons(body);
    const svgs = pictures.map((polygons, n) => {
      const svg = svg_element('svg', { role: 'img', tabindex: 0,
        'aria-label': `${body.title}${n === 1 ? ': K' : ''}. Arrow keys turn it.` });
      solids.push(new Solid(svg, polygons, are_cells ? 2.1 : 2, are_cells ? 2.1 : 1.9));
      listen_to_turns(svg, turn);
      return svg;
    });
    const title = element('div', {}, element('strong', {}, body.title), ` ${body.text}`);
    place.append(element('div', { class: svgs.length > 1 ? 'solid pair' : 'solid' }, title, element('div', {}, ...svgs)));
  }
  figure.querySelector('img').after(place);
  draw();
}

// Drags and arrow keys.
function listen_to_turns(svg, turn) {
  let held = null;
  svg.addEventListener('pointerdown', (event) => {
    svg.setPointerCapture(event.pointerId);
    held = event;
  });
  svg.addEventListener('pointermove', (event) => {
    if (!held) return;
    turn((event.clientX - held.clientX) / 90, (event.clientY - held.clientY) / 90);
    held = event;
  });
  for (const kind of ['pointerup', 'pointercancel']) svg.addEventListener(kind, () => { held = null; });
  svg.addEventListener('keydown', (event) => {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way) return;
    event.preventDefault();
    turn(0.15 * way[0], 0.15 * way[1]);
  });
}
