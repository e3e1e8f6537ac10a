'use strict';
// Bodies in space, to be turned: polygons drawn from the furthest to the nearest, as SVG. All bodies of a
// figure turn together.

// polygons: {points, front, back}: closed, by the classes of its two sides, `lit` if light falls on it;
// {points, line}: an open line; {points, letter}: letters at a point. Where all of it is: a ball around the origin of
// radius 1. What has a `shift` goes so far when the body is pulled `apart`.
class Solid {
  constructor(svg, polygons, width, height) {
    this.svg = svg;
    this.polygons = polygons;
    this.apart = 0;
    svg.setAttribute('viewBox', `${-width / 2} ${-height / 2} ${width} ${height}`);
  }

  // yaw, pitch: in radians. The eye looks along -z.
  draw(yaw, pitch) {
    const turned = turning(yaw, pitch);
    const seen = this.polygons.filter(({ is_hidden }) => !is_hidden?.()).map((polygon) => {
      const { shift } = polygon, move = ([x, y, z], n) => {
        const by = Array.isArray(shift[0]) ? shift[n] : shift;
        return [x + this.apart * by[0], y + this.apart * by[1], z + this.apart * by[2]];
      };
      const points = (shift ? polygon.points.map(move) : polygon.points).map(turned);
      // What is drawn on a polygon lies a little before it.
      const depth = points.reduce((sum, p) => sum + p[2], 0) / points.length + (polygon.lift ?? 0);
      return { polygon, points, depth };
    }).sort((a, b) => a.depth - b.depth);
    const letters = seen.filter(({ polygon }) => polygon.letter), faces = seen.filter(({ polygon }) => !polygon.letter);
    this.svg.replaceChildren(...faces.map(({ polygon, points }) => {
      const places = points.map(([x, y]) => `${x.toFixed(3)} ${(-y).toFixed(3)}`);
      const d = `M${places.join('L')}${polygon.line ? '' : 'Z'}`, is_front = area_of(points) > 0;
      const name = polygon.line ?? (is_front ? polygon.front : polygon.back);
      const path = polygon.path ??= svg_element('path', { 'vector-effect': 'non-scaling-stroke' });
      path.setAttribute('d', d);
      path.setAttribute('class', polygon.lit ? `${name} lit${light_on(points, is_front)}` : name);
      return path;
    }), ...this.placed(letters).map(({ polygon, at: [x, y] }) =>
      svg_element('text', { x: x.toFixed(3), y: (-y).toFixed(3), dy: '.05' }, polygon.letter)));
  }
  // Letters over all else, the nearest first, each pushed away from the middle until it is clear of those before. One
  // that would stand beside the same letter is left out.
  placed(letters) {
    const made = [], kApart = 0.17;
    for (const { polygon, points: [[x, y]] } of [...letters].reverse()) {
      const size = Math.hypot(x, y) || 1, at = (t) => [x + t * x / size, y + t * y / size];
      const other = (p) => made.find((one) => distance(one.at, p) < kApart);
      let t = 0.1;
      while (other(at(t)) && t < 0.6) t += 0.02;
      if (other(at(0.1))?.polygon.letter !== polygon.letter) made.push({ polygon, at: at(t) });
    }
    return made;
  }
}

// From the body to the eye's right, up and back; `back` goes the other way.
function turning(yaw, pitch) {
  const [s, c, u, v] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  const turned = ([x, y, z]) => {
    const across = c * x - s * y, deep = s * x + c * y;
    return [across, v * z + u * deep, u * z - v * deep];
  };
  turned.back = ([x, y, z]) => {
    const deep = u * y - v * z;
    return [c * x + s * deep, c * deep - s * x, v * y + u * z];
  };
  return turned;
}

// How bright a side is, from 0 to 10: it faces a light over the eye's left shoulder, or away from it.
const kToLight = unit([-0.5, 0.8, 0.9]);
function light_on(points, is_front) {
  const normal = unit(cross(subtract(points[1], points[0]), subtract(points[2], points[0])));
  return Math.round(5 + 5 * dot(scaled(normal, is_front ? 1 : -1), kToLight));
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

// The same around the origin, and so large that it is seen to be `width` by `height` at most, turned as said.
function fitted(polygons, turned, width, height) {
  const middle = box_middle(box_of_points(polygons.flatMap(({ points }) => points.flat())));
  const box = empty_box();
  for (const { points } of polygons) for (const p of points) extend_box(box, ...turned(subtract(p, middle)));
  const size = Math.min(width / (box.hi[0] - box.lo[0]), height / (box.hi[1] - box.lo[1]));
  // What is seen is in the middle, too.
  const off = turned.back([(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2, 0]);
  const moved = (p) => scaled(subtract(subtract(p, middle), off), size);
  return polygons.map((polygon) => ({ ...polygon, points: polygon.points.map(moved) }));
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
    const pictures = are_cells ? [cell_polygons(body)]
      : labeled_polygons(body).map((polygons) => fitted(polygons, turning(yaw, pitch), 1.72, 1.5));
    const svgs = pictures.map((polygons, n) => {
      const svg = svg_element('svg', { role: 'img', tabindex: 0,
        'aria-label': `${body.title}, ${body.text}${n === 1 ? ': K' : ''}. Arrow keys turn it.` });
      solids.push(new Solid(svg, polygons, 2.1, are_cells ? 2.1 : 1.9));
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
