'use strict';
// The picture at the top: a torus that is pulled apart and closed.

// A torus in pieces, one of each Voronoi cell, which are pulled apart; and K, which joins the sites whose pieces meet.
// pieces: {site, points, surface, ends}, the last two by numbers of points.
function put_torus(figure, pieces) {
  const kScale = 0.52, kApart = 0.28;
  const middle = box_middle(box_of_points(pieces.flatMap(({ points }) => points.flat())));
  const placed = (p) => scaled(subtract(p, middle), kScale);
  const shifts = pieces.map(({ points }) => scaled(placed(scaled(points.reduce(add), 1 / points.length)), kApart));
  const polygons = pieces.flatMap(({ points, surface, ends }, n) => {
    const at = points.map(placed), shift = shifts[n];
    const side = { front: 'outer', back: 'inner', lit: true, shift };
    return [...surface.map((polygon) => ({ points: polygon.map((v) => at[v]), ...side })),
            ...ends.map((end) => ({ points: end.map((v) => at[v]), line: 'end', lift: 0.04, shift }))];
  });
  let shows_mesh = false;
  for (const [a, b] of neighbors_of(pieces).pairs) {
    polygons.push({ points: [a, b].map((n) => placed(pieces[n].site)), shift: [shifts[a], shifts[b]], line: 'joined',
                    lift: 0.22, is_hidden: () => !shows_mesh });
  }
  const svg = svg_element('svg', { role: 'img', tabindex: 0 }), solid = new Solid(svg, polygons, 2.3, 1.22);
  let [yaw, pitch] = [0.35, 0.55];
  const draw = () => {
    solid.draw(yaw, pitch);
    svg.setAttribute('aria-label', `A torus in ${pieces.length} pieces, ` +
      `${solid.apart < 0.02 ? 'closed' : 'pulled apart'}${shows_mesh ? ', with its mesh' : ''}. Arrow keys turn it.`);
  };
  listen_to_turns(svg, (across, up) => {
    yaw += across;
    pitch = clamp(pitch + up, -1.5, 1.5);
    draw();
  });
  const open = (apart) => {
    cancelAnimationFrame(coming);
    set(apart);
  };
  const set = (apart) => {
    solid.apart = apart;
    control.input.value = apart;
    draw();
  };
  const control = slider('Apart', { min: 0, max: 1, step: 0.01, value: 1 }, open);
  const mesh = button('Mesh', 'The mesh joins the sites whose pieces meet', () => {
    shows_mesh = !shows_mesh;
    mesh.setAttribute('aria-pressed', shows_mesh);
    draw();
  });
  mesh.setAttribute('aria-pressed', false);
  const controls = element('div', { class: 'controls' }, control, mesh);
  figure.querySelector('img').after(element('div', { class: 'torus' }, svg, controls));
  // It opens once, unless the reader wants no motion or is faster.
  const begun = performance.now(), kPause = 600, kLength = 1600;
  let coming = 0;
  const grow = (now) => {
    const t = clamp((now - begun - kPause) / kLength, 0, 1);
    set(t * t * (3 - 2 * t));
    if (t < 1) coming = requestAnimationFrame(grow);
  };
  if (prefers_stillness()) set(1);
  else grow(begun);
}

// Which pieces meet, by their numbers: three in a point, two along a curve. A point is printed alike for each, nearly.
function neighbors_of(pieces) {
  const corners = [];
  pieces.forEach(({ points, ends }, n) => {
    for (const v of new Set(ends.flat())) {
      const corner = corners.find(({ p }) => length_of(subtract(p, points[v])) < 0.004);
      if (corner) corner.pieces.add(n);
      else corners.push({ p: points[v], pieces: new Set([n]) });
    }
  });
  const triples = corners.filter(({ pieces: around }) => around.size >= 3).map(({ pieces: around }) => [...around]);
  const pairs = new Map();
  for (const around of triples) {
    for (const a of around) for (const b of around) if (a < b) pairs.set(`${a} ${b}`, [a, b]);
  }
  return { triples, pairs: [...pairs.values()] };
}
