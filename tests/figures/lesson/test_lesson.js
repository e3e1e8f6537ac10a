// SPDX-License-Identifier: MIT
// Tests of what the scripts of the lesson compute, without a browser: run by scripts.sh. Each case is an
// oracle: brute force, another definition, or a property of all that is made.
'use strict';

// Numerical Recipes' linear congruence; cases come from numbered seeds.
function random_from(seed) {
  let state = seed >>> 0;
  const next = () => {
    state = Math.imul(state, 1664525) + 1013904223 >>> 0;
    return state / 2 ** 32;
  };
  next();
  return { real: next, below: (n) => Math.floor(next() * n) };
}

const kKappa = 50;

// Noise, or a few blobs, with a border that is outside.
function random_field(seed) {
  const random = random_from(seed), columns = 4 + random.below(9), rows = 4 + random.below(9);
  const blobs = Array.from({ length: 1 + random.below(4) }, () =>
    [random.real() * columns, random.real() * rows, 1 + 2 * random.real()]);
  const samples = Array.from({ length: columns * rows }, (_, n) => {
    const i = n % columns, j = Math.floor(n / columns);
    if (i === 0 || j === 0 || i === columns - 1 || j === rows - 1) return random.below(40);
    if (seed % 2 === 0) return random.below(100);
    return Math.round(kKappa + 20 * Math.max(...blobs.map(([x, y, r]) => r - Math.hypot(i - x, j - y))));
  });
  return new Field({ columns, rows, samples });
}

// Contours, each with random sites.
function* scenes() {
  for (let seed = 1; seed <= 300; ++seed) {
    const field = random_field(seed), contour = contour_of(field, kKappa);
    if (contour.points.length === 0) continue;
    const random = random_from(1000 + seed);
    const sites = [];
    const count = 1 + random.below(Math.min(9, contour.points.length));
    while (sites.length < count) {
      const v = random.below(contour.points.length);
      if (!sites.includes(v)) sites.push(v);
    }
    yield { seed, field, contour, sites };
  }
}

test('the interpolant: the samples at the corners, and linear along every line of the grid', () => {
  const field = random_field(5);
  for (let j = 0; j < field.rows; ++j) {
    for (let i = 0; i < field.columns; ++i) {
      assert.equal(field.value([i, j]), field.at(i, j));
      if (i === 0) continue;
      const mean = 0.75 * field.at(i - 1, j) + 0.25 * field.at(i, j);
      assert.ok(Math.abs(field.value([i - 0.75, j]) - mean) < 1e-9);
    }
  }
});

test('T: as many loops as there are borders between sides, by flooding the samples', () => {
  let joined = 0, apart = 0;
  for (const { seed, field, contour } of scenes()) {
    const { columns, rows } = field, parent = Array.from({ length: columns * rows }, (_, n) => n);
    const root = (n) => parent[n] === n ? n : root(parent[n]);
    const is_inside = (i, j) => field.at(i, j) >= kKappa;
    const join = (i, j, k, l) => { parent[root(j * columns + i)] = root(l * columns + k); };
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        if (i > 0 && is_inside(i, j) === is_inside(i - 1, j)) join(i, j, i - 1, j);
        if (j > 0 && is_inside(i, j) === is_inside(i, j - 1)) join(i, j, i, j - 1);
        if (i === 0 || j === 0) continue;
        const [a, b, c, d] = [[i - 1, j - 1], [i, j - 1], [i - 1, j], [i, j]];
        const sides = [a, b, c, d].map(([x, y]) => is_inside(x, y));
        if (sides[0] !== sides[3] || sides[1] !== sides[2] || sides[0] === sides[1]) continue;
        // The saddle's value, by the asymptotic decider; samples that are kappa are inside by a hair.
        const [fa, fb, fc, fd] = [a, b, c, d].map(([x, y]) => field.at(x, y) - kKappa || 1e-6);
        const is_saddle_inside = (fa * fd - fb * fc) / (fa + fd - fb - fc) >= 0;
        if (is_saddle_inside) ++joined;
        else ++apart;
        if (sides[0] === is_saddle_inside) join(...a, ...d);
        else join(...b, ...c);
      }
    }
    const pieces = new Set(parent.map((_, n) => root(n))).size;
    assert.equal(contour.loops.length, pieces - 1, `seed ${seed}`);
    assert.equal(contour.loops.flat().length, contour.points.length);
  }
  assert.ok(joined > 100 && apart > 100);
});

test('T: vertices lie on Sigma, and the inside is on the left', () => {
  for (const { seed, field, contour } of scenes()) {
    for (const p of contour.points) assert.ok(Math.abs(field.value(p) - kKappa) < 1e-4, `seed ${seed}`);
    for (const loop of contour.loops) {
      // Turning of the loop against what lies in it: inside samples are on the left of a border, so a
      // loop that runs counter-clockwise has an inside sample next to it within.
      loop.forEach((v, n) => {
        const p = contour.points[v], q = contour.points[loop[(n + 1) % loop.length]];
        const i = Math.floor((p[0] + q[0]) / 2), j = Math.floor((p[1] + q[1]) / 2);
        let votes = 0;
        for (const [x, y] of [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]]) {
          const side = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
          if (side !== 0) votes += (side > 0) === (field.at(x, y) >= kKappa) ? 1 : -1;
        }
        assert.ok(votes >= 0, `seed ${seed}`);
      });
    }
    for (const curve of contour.curves.flat()) assert.ok(Math.abs(field.value(curve) - kKappa) < 1e-4);
  }
});

test('Marching Cubes: as many loops as there are borders, where inside corners are never joined', () => {
  let differ = 0;
  for (const { seed, field, contour } of scenes()) {
    const { columns, rows } = field, is_inside = (i, j) => field.at(i, j) >= kKappa;
    const seen = new Set();
    let pieces = 0;
    for (let n = 0; n < columns * rows; ++n) {
      if (seen.has(n)) continue;
      ++pieces;
      for (const rest = [n]; rest.length > 0;) {
        const m = rest.pop(), i = m % columns, j = Math.floor(m / columns);
        if (seen.has(m)) continue;
        seen.add(m);
        for (let y = Math.max(0, j - 1); y <= Math.min(rows - 1, j + 1); ++y) {
          for (let x = Math.max(0, i - 1); x <= Math.min(columns - 1, i + 1); ++x) {
            // Outside samples are joined across a voxel too.
            const is_near = x === i || y === j || !is_inside(i, j);
            if (is_near && is_inside(x, y) === is_inside(i, j)) rest.push(y * columns + x);
          }
        }
      }
    }
    const { edges, loops } = marching_cubes_of(contour);
    assert.equal(loops, pieces - 1, `seed ${seed}`);
    assert.equal(edges.length, contour.points.length);
    // Each edge is in one voxel, with the inside on its left.
    for (const [p, q] of edges) {
      const corner = [0, 1].map((axis) => Math.floor((p[axis] + q[axis]) / 2 + 1e-12));
      for (const axis of [0, 1]) {
        for (const point of [p, q]) assert.ok(point[axis] >= corner[axis] - 1e-9 && point[axis] <= corner[axis] + 1 + 1e-9);
      }
    }
    if (loops !== contour.loops.length) ++differ;
  }
  assert.ok(differ > 50);
});

test('samples: a change moves T and keeps the sites apart; those at the sides stay', () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const state = new State(JSON.parse(/id="header">(.*?)<\/script>/s.exec(page)[1]));
  const random = random_from(7);
  for (let n = 0; n < 100; ++n) {
    const place = [random.below(state.field.columns), random.below(state.field.rows)];
    const before = state.field.at(...place), value = random.below(101);
    state.choose_sample(...place);
    state.set_sample(value);
    assert.ok([before, value].includes(state.field.at(...place)));
    if (!state.can_change(...place)) assert.equal(state.field.at(...place), before);
    assert.equal(new Set(state.sites).size, state.sites.length);
    const kinds = Object.values(kPictures);
    for (const line of kinds[n % kinds.length].tell(state)) assert.doesNotMatch(line, /NaN|undefined|Infinity/);
    if (n % 4 === 0) state.certify();
    if (n % 25 === 24) state.start_again();
  }
});

// Vertices minus edges plus facets, and the connected pieces, of polygons whose corners are rounded alike.
function topology_of(polygons) {
  const number = new Map(), parent = [], edges = new Set();
  const root_of = (n) => parent[n] === n ? n : root_of(parent[n]);
  const vertex = (p) => {
    const key = p.map((x) => Math.round(500 * x)).join();
    if (!number.has(key)) {
      number.set(key, parent.length);
      parent.push(parent.length);
    }
    return number.get(key);
  };
  let facets = 0;
  for (const polygon of polygons) {
    const corners = polygon.map(vertex).filter((v, n, all) => v !== all[(n + 1) % all.length]);
    if (corners.length < 3) continue;
    ++facets;
    corners.forEach((a, n) => {
      const b = corners[(n + 1) % corners.length];
      edges.add(`${Math.min(a, b)} ${Math.max(a, b)}`);
      parent[root_of(a)] = root_of(b);
    });
  }
  const used = new Set([...edges].flatMap((edge) => edge.split(' ')));
  const pieces = new Set([...used].map((v) => root_of(Number(v)))).size;
  return { euler: used.size - edges.size + facets, pieces };
}

test('cells: closed bodies that hold a disk, a ring, two disks, a disk and a ball', () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const { cells } = JSON.parse(/id="header">(.*?)<\/script>/s.exec(page)[1]);
  assert.deepEqual(cells.map(({ sides }) => topology_of(sides)), Array(4).fill({ euler: 2, pieces: 1 }));
  assert.deepEqual(cells.map(({ surface }) => topology_of(surface)),
                   [{ euler: 1, pieces: 1 }, { euler: 0, pieces: 1 }, { euler: 2, pieces: 2 }, { euler: 3, pieces: 2 }]);
  for (const point of cells.flatMap(({ sides, surface }) => [...sides, ...surface].flat())) {
    assert.ok(length_of(point) < 1.01);
  }
});

test('patches: pieces of a triangle cover it, each with a corner of its label', () => {
  const corners = [[0, 0, 0], [4, 0, 1], [1, 3, 2]];
  const area = (points) => length_of(points.slice(1, -1).map((p, n) =>
    cross(subtract(p, points[0]), subtract(points[n + 2], points[0]))).reduce(add));
  for (const labels of ['aaa', 'aab', 'aba', 'baa', 'abb', 'abc', 'cab'].map((word) => [...word])) {
    const patches = patches_of(corners, labels);
    assert.equal(new Set(patches.map(({ label }) => label)).size, new Set(labels).size);
    assert.ok(Math.abs(patches.reduce((sum, { points }) => sum + area(points), 0) - area(corners)) < 1e-9);
    for (const { points, label } of patches) {
      assert.ok(corners.some((p, n) => labels[n] === label && points.includes(p)));
    }
  }
});

test('regions: every vertex has its nearest site, and the arcs are the regions, in pieces', () => {
  for (const { seed, contour, sites } of scenes()) {
    const regions = regions_of(contour, sites);
    contour.points.forEach((p, v) => {
      const nearest = Math.min(...sites.map((s) => distance(p, contour.points[s])));
      assert.equal(distance(p, contour.points[sites[regions.site_of[v]]]), nearest, `seed ${seed}`);
      assert.equal(regions.far[v], nearest);
    });
    const found = [];
    regions.arcs.forEach((arcs, n) => arcs.forEach(({ vertices, closed }) => {
      vertices.forEach((v, k) => {
        assert.equal(regions.site_of[v], n);
        if (k > 0) assert.equal(contour.next[vertices[k - 1]], v);
      });
      const ends_at_others = regions.site_of[contour.previous[vertices[0]]] !== n;
      assert.equal(closed, !ends_at_others);
      found.push(...vertices);
    }));
    assert.equal(new Set(found).size, contour.points.length);
    assert.equal(found.length, contour.points.length);
  }
});

test('the certificate holds exactly where the dual is loops, as many as T has', () => {
  let holds = 0, fails = 0;
  for (const { seed, contour, sites } of scenes()) {
    for (let all = sites; ;) {
      const regions = regions_of(contour, all), fault = certificate_of(contour, all, regions);
      // By the graph alone: every site has two different neighbors, once each, and each loop has a border.
      const neighbors = all.map(() => []);
      for (const { a, b } of regions.interfaces) {
        neighbors[a].push(b);
        neighbors[b].push(a);
      }
      const is_cut = (loop) => loop.some((v) => regions.site_of[v] !== regions.site_of[contour.previous[v]]);
      const is_fine = neighbors.every((list) => list.length === 2 && list[0] !== list[1]) &&
                      contour.loops.every(is_cut);
      assert.equal(fault === null, is_fine, `seed ${seed}`);
      if (!fault) {
        ++holds;
        for (const loop of dual_loops(contour, regions)) {
          assert.ok(loop.length >= 3);
          loop.forEach((a, n) => assert.ok(neighbors[a].includes(loop[(n + 1) % loop.length])));
        }
        assert.equal(dual_loops(contour, regions).flat().length, all.length);
        break;
      }
      ++fails;
      assert.ok(fault.insert >= 0 && !all.includes(fault.insert), `seed ${seed}`);
      all = [...all, fault.insert];
    }
  }
  assert.ok(holds > 100 && fails > 100);
});

test('the certificate always comes to an end, at the latest with every vertex a site', () => {
  for (const { contour, sites } of scenes()) {
    const all = certify(contour, sites);
    assert.equal(certificate_of(contour, all, regions_of(contour, all)), null);
    assert.deepEqual(all.slice(0, sites.length), sites);
    const every = contour.points.map((_, v) => v);
    assert.equal(certificate_of(contour, every, regions_of(contour, every)), null);
  }
});

test('surface points: on Sigma, as far from both ends, where Sigma faces as the edge does, none such nearer', () => {
  let found = 0, inward = 0;
  for (const { field, contour, sites } of scenes()) {
    const all = certify(contour, sites), regions = regions_of(contour, all);
    const loops = dual_loops(contour, regions).map((loop) => loop.map((n) => contour.points[all[n]]));
    for (const { a, b, center, outwards, x, h, radius } of facets_of(field, kKappa, loops)) {
      if (!x) continue;
      ++found;
      assert.ok(Math.abs(field.value(x) - kKappa) < 1e-6);
      assert.ok(Math.abs(distance(x, a) - distance(x, b)) < 1e-9);
      assert.ok(Math.abs(distance(x, a) - radius) < 1e-9);
      assert.ok(Math.abs(distance(x, center) - h) < 1e-9);
      assert.ok(h <= distance(a, b) / 2);
      // Sigma faces outwards there, and nowhere nearer, on either side of the center.
      const value = (t) => field.value([center[0] + t * outwards[0], center[1] + t * outwards[1]]) - kKappa;
      const t = (x[0] - center[0]) * outwards[0] + (x[1] - center[1]) * outwards[1];
      assert.ok(value(t - 1e-4) > value(t + 1e-4));
      const clear = Array.from({ length: 39 }, (_, n) => value(h * (n - 19) / 20)).filter((g) => Math.abs(g) > 1);
      assert.ok(clear.every((g, n) => n === 0 || !(clear[n - 1] > 0 && g < 0)));
      inward += t < 0 && value(0) > 1 || t > 0 && value(0) < -1;
    }
  }
  // Some lie on the other side of an edge than the nearest crossing, which faces inwards.
  assert.ok(inward > 0);
  assert.ok(found > 1000);
});

test('Stage 2: the limit is kept or refused, the loops stay, and no edges come to cross', () => {
  let inserted = 0;
  for (const { seed, field, contour, sites } of scenes()) {
    const all = certify(contour, sites), regions = regions_of(contour, all);
    const loops = dual_loops(contour, regions).map((loop) => loop.map((n) => contour.points[all[n]]));
    const crossings = (mesh) => {
      const facets = facets_of(field, kKappa, mesh);
      let count = 0;
      facets.forEach((f, n) => facets.slice(n + 1).forEach((g) => {
        const is_apart = f.a !== g.b && f.b !== g.a;
        if (is_apart && segments_cross(f.a, f.b, g.a, g.b)) ++count;
      }));
      return count;
    };
    const crossed = crossings(loops), rounds = refine(field, kKappa, first_round(loops), 0.1, 0.1);
    const last = rounds.at(-1);
    // A round inserts one point or none, and says so.
    rounds.slice(1).forEach(({ loops: after, facet, why }, n) => {
      const [more, less] = [after, rounds[n].loops].map((all) => all.flat().length);
      assert.equal(more - less, why === '' ? 1 : 0, `seed ${seed}`);
      assert.equal(after.flat().includes(facet.x), why === '');
      if (why === '') ++inserted;
      // None is tried again before a neighbor has changed.
      const earlier = rounds.slice(0, n + 1).findLastIndex((round) => round.facet && is_same_edge(round.facet, facet));
      if (earlier >= 0) {
        assert.ok(rounds.slice(earlier, n + 1).some((round) => round.why === '' &&
          [round.facet.a, round.facet.b].some((p) => p === facet.a || p === facet.b)), `seed ${seed}`);
      }
    });
    const over = facets_of(field, kKappa, last.loops).filter((f) => f.h > 0.1 && distance(f.a, f.b) > 0.2);
    assert.equal(over.length, last.refused.length, `seed ${seed}`);
    last.loops.forEach((loop, l) => {
      assert.deepEqual(loop.filter((p) => loops[l].includes(p)), loops[l]);
      for (const p of loop) assert.ok(Math.abs(field.value(p) - kKappa) < 1e-4);
    });
    assert.ok(crossings(last.loops) <= crossed, `seed ${seed}`);
  }
  assert.ok(inserted > 1000);
});

test('insertion: refused exactly where a ball, a half or a crossing is against it', () => {
  // By parameters on both segments, where the lesson's own test goes by orientations.
  const cross = (a, b, c, d) => {
    const u = [b[0] - a[0], b[1] - a[1]], v = [d[0] - c[0], d[1] - c[1]], w = [c[0] - a[0], c[1] - a[1]];
    const det = u[0] * v[1] - u[1] * v[0];
    const s = (w[0] * v[1] - w[1] * v[0]) / det, t = (w[0] * u[1] - w[1] * u[0]) / det;
    return s > 0 && s < 1 && t > 0 && t < 1;
  };
  const counts = { done: 0, line: 0, ball: 0, half: 0, crossing: 0 };
  for (const { seed, field, contour, sites } of scenes()) {
    const all = certify(contour, sites), regions = regions_of(contour, all);
    const loops = dual_loops(contour, regions).map((loop) => loop.map((n) => contour.points[all[n]]));
    const facets = facets_of(field, kKappa, loops);
    for (const f of facets) {
      const others = facets.filter((g) => g !== f), { a, b, x } = f;
      let expected = 'done';
      if (!x) expected = 'line';
      else if (others.some((g) => g.x && distance(g.x, x) < distance(g.x, g.a) - 1e-9)) expected = 'ball';
      else if (!facet_of(field, kKappa, a, x).x || !facet_of(field, kKappa, x, b).x) expected = 'half';
      else if (others.some((g) => g.b !== a && cross(a, x, g.a, g.b) || g.a !== b && cross(x, b, g.a, g.b)))
        expected = 'crossing';
      const why_not = why_not_inserted(field, kKappa, facets, f);
      assert.equal(why_not === '', expected === 'done', `seed ${seed}: ${expected}, ${why_not}`);
      ++counts[expected];
    }
  }
  for (const [what, count] of Object.entries(counts)) assert.ok(count > 0, what);
});

test('coarsening: what goes may go, what is left may not, the loops stay, and no edges come to cross', () => {
  let removed = 0;
  const refused = new Set();
  for (const { seed, field, contour } of scenes()) {
    const rounds = coarsen(field, kKappa, contour, uncoarsened(contour), 0.2);
    rounds.slice(1).forEach(({ loops, vertex, why }, n) => {
      const before = rounds[n].loops, l = before.findIndex((loop) => loop.includes(vertex));
      assert.deepEqual(loops, before.map((loop) => loop.filter((v) => why !== '' || v !== vertex)), `seed ${seed}`);
      if (why !== '') return refused.add(why);
      ++removed;
      // Straight on from the middle of the new edge Sigma comes within the limit, with its inside on the left.
      const at = before[l].indexOf(vertex), size = before[l].length;
      const [a, b] = [at + size - 1, at + 1].map((k) => contour.points[before[l][k % size]]);
      const m = between(a, b, 0.5), step = 0.2 / distance(a, b);
      const left = field.value([m[0] - (b[1] - a[1]) * step, m[1] + (b[0] - a[0]) * step]);
      const right = field.value([m[0] + (b[1] - a[1]) * step, m[1] - (b[0] - a[0]) * step]);
      assert.ok(left >= kKappa && right < kKappa, `seed ${seed}`);
      // By Heron's formula, where the lesson goes by a cross product.
      const p = contour.points[vertex], sides = [distance(a, b), distance(p, a), distance(p, b)];
      const half = sides.reduce((sum, x) => sum + x) / 2;
      const area2 = half * (half - sides[0]) * (half - sides[1]) * (half - sides[2]);
      assert.ok(2 * Math.sqrt(Math.max(area2, 0)) / sides[0] < 0.2 + 1e-6, `seed ${seed}`);
    });
    const { loops } = rounds.at(-1);
    loops.forEach((loop, l) => {
      assert.ok(loop.length >= Math.min(3, contour.loops[l].length), `seed ${seed}`);
      for (const v of loop) assert.notEqual(removal_of(field, kKappa, contour, loops, v, 0.2).why, '', `seed ${seed}`);
    });
    const edges = (all) => all.flatMap((loop) => loop.map((v, n) => [v, loop[(n + 1) % loop.length]]));
    const crossings = (all) => edges(all).flatMap(([a, b], n, list) => list.slice(n + 1).filter(([c, d]) =>
      ![c, d].includes(a) && ![c, d].includes(b) && segments_cross(...[a, b, c, d].map((v) => contour.points[v])))).length;
    assert.equal(crossings(loops), crossings(contour.loops), `seed ${seed}`);
  }
  assert.ok(removed > 1000 && refused.size === 4);
});

const new_state = () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  return new State(JSON.parse(/id="header">(.*?)<\/script>/s.exec(page)[1]));
};
// All that the reader has made, as text.
const made = ({ kappa, field, sites, rounds, coarse, chosen_sample }) =>
  JSON.stringify([kappa, field.samples, sites, rounds, coarse, chosen_sample]);

test('steps: each goes back to what was before it, and forward again to the same', () => {
  const random = random_from(3), state = new_state();
  let stage1 = 0, stage2 = 0, removals = 0;
  for (let n = 0; n < 300; ++n) {
    const v = random.below(state.contour.points.length), way = random.below(9);
    const before = made(state);
    if (way === 0) state.set_kappa(40 + random.below(26));
    if (way === 1) state.add_site(v);
    if (way === 2) state.remove_site(random.below(state.sites.length));
    if (way === 3 && state.fault) state.add_site(state.fault.insert);
    if (way === 4) state.start_again();
    if (way < 5) {
      if (made(state) === before) continue;
      ++stage1;
      const after = made(state), { past } = state;
      // Changes of kappa in a row are one change.
      if (way !== 0 || past.at(-1).kind !== 'isovalue') {
        state.undo();
        assert.equal(made(state), before, `step ${n}`);
        if (way === 3) {
          state.add_site(state.fault.insert);
          assert.equal(made(state), after);
        }
      }
      continue;
    }
    const [go, back] = way < 7 ? ['insert', 'take_back_round'] : ['remove_vertex', 'take_back_removal'];
    if (way < 7) state.edge = random.below(2) ? state.contour.points[v] : null;
    else state.chosen_vertex = random.below(2) ? v : -1;
    const { edge, chosen_vertex } = state;
    state[go]();
    const after = made(state);
    if (after === before) continue;
    if (way < 7) ++stage2;
    else ++removals;
    state[back]();
    assert.equal(made(state), before, `step ${n}`);
    Object.assign(state, { edge, chosen_vertex });
    state[go]();
    assert.equal(made(state), after, `step ${n}`);
  }
  assert.ok(stage1 > 50 && stage2 > 50 && removals > 20);
  while (state.past.length > 0) state.undo();
  assert.deepEqual([state.kappa, state.field.samples, state.sites],
                   [new_state().kappa, new_state().field.samples, new_state().sites]);
  // A drag is one change.
  for (const n of [1, 2, 3]) state.move_site(0, state.contour.next[state.sites[0]]);
  state.undo();
  assert.deepEqual(state.sites, new_state().sites);
});

test('code: the marked line is what the next step does', () => {
  const state = new_state();
  const { sites, dual, coarsen: coarsening, insertion, mesh } = kPictures;
  assert.deepEqual([sites.line(state), dual.line(state)], ['recover', 'C1']);
  state.add_site(state.fault.insert);
  assert.deepEqual([sites.line(state), dual.line(state)], ['refine', 'return']);
  for (let n = 0; insertion.line(state) !== 'end'; ++n) {
    const line = insertion.line(state);
    state.insert();
    assert.equal(state.round.why === '', line === 'goes', `round ${n}`);
  }
  assert.equal(sites.line(state), 'return');
  for (const [shown, line] of [[0, 'build'], [5, 'insert'], [null, 'return']]) {
    state.shown = shown;
    assert.equal(mesh.line(state), line);
  }
  for (let n = 0; coarsening.line(state) !== 'return'; ++n) {
    const line = coarsening.line(state);
    state.remove_vertex();
    assert.equal(state.coarsened.why === '', line === 'goes', `round ${n}`);
  }
  // All that the pictures mark stands on the page.
  const page = fs.readFileSync(path.join(root, 'figures/lesson/web/lesson.html'), 'utf8');
  const lines = [...page.matchAll(/data-line="(.*?)"/g)].map((match) => match[1]);
  for (const line of ['recover', 'C1', 'C2', 'goes', 'refuse', 'end', 'build', 'insert', 'return']) {
    assert.ok(lines.includes(line), line);
  }
});

test('tasks: none is done at first, and each can be; numbers in the text are those of the beginning', () => {
  const ways = {
    cubes: (s) => s.set_kappa(53),
    saddles: (s) => {
      s.choose_sample(6, 5);
      s.set_sample(40);
      s.choose_sample(5, 5);
      s.set_sample(60);
    },
    neck: (s) => {
      s.choose_sample(6, 4);
      s.set_sample(49);
    },
    pieces: (s) => {
      // Some site at some other vertex.
      for (let n = 0; n < 10; ++n) {
        for (let v = 0; v < s.contour.points.length && !kTasks.pieces(s); ++v) {
          if (s.sites.includes(v)) continue;
          const before = s.sites[n];
          s.move_site(n, v);
          if (!kTasks.pieces(s)) s.move_site(n, before);
        }
      }
    },
    c1: (s) => s.add_furthest_site(),
    coarse: (s) => {
      s.limit = 0.3;
      while (s.coarsened.waiting.length > 0) s.remove_vertex();
    },
    refused: (s) => {
      for (const { center } of s.facets()) {
        s.edge = center;
        s.insert();
        if (s.round.why !== '') return;
        s.take_back_round();
      }
    },
    edges: (s) => { s.limit = 0.3; },
  };
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const asked = [...page.matchAll(/data-task="(.*?)"/g)].map((match) => match[1]);
  assert.deepEqual(asked.sort(), Object.keys(kTasks).sort());
  for (const name of asked) {
    const state = new_state();
    assert.ok(!kTasks[name](state), name);
    ways[name](state);
    assert.ok(kTasks[name](state), name);
  }
  const numbers = [...page.matchAll(/<output\s+data-number="(.*?)">(.*?)<\/output>/g)];
  assert.ok(numbers.length >= 8);
  for (const [, name, text] of numbers) assert.equal(text, String(kNumbers[name](new_state())), name);
});

test('faults on small surfaces: two arcs, two triangles, two ends, as their titles say', () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const { broken } = JSON.parse(/id="header">(.*?)<\/script>/s.exec(page)[1]);
  // Chains of the arcs that a pair of labels marks: [how many, how many of them are closed].
  const chains = ({ points, labels, triangles }, pairs) => {
    const arcs = pairs.flatMap((pair) => arcs_between(points, labels, triangles, pair)), ends = new Map(), parent = [];
    const root_of = (n) => parent[n] === n ? n : root_of(parent[n]);
    const key = (p) => p.map((x) => x.toFixed(4)).join();
    arcs.flat().forEach((p) => {
      if (!ends.has(key(p))) {
        ends.set(key(p), { number: parent.length, count: 0 });
        parent.push(parent.length);
      }
      ++ends.get(key(p)).count;
    });
    for (const [p, q] of arcs) parent[root_of(ends.get(key(p)).number)] = root_of(ends.get(key(q)).number);
    const all = new Set(parent.map((_, n) => root_of(n)));
    const open = new Set([...ends.values()].filter(({ count }) => count === 1).map(({ number }) => root_of(number)));
    return [all.size, all.size - open.size];
  };
  const [c1, c2, c3, c4] = broken;
  assert.deepEqual(chains(c1, c1.marks.split(' ')), [2, 2]);  // both ends of the annulus
  assert.deepEqual(chains(c2, ['ab']), [2, 0]);
  assert.deepEqual(chains(c3, ['ab']), [1, 0]);               // from one triangle abc to the other
  assert.deepEqual(chains(c3, c3.marks.split(' ')), [1, 1]);
  assert.deepEqual(chains(c4, ['b-']), [2, 0]);
});

test('the lesson itself: what its text and the pictures of the guide say', () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const header = /id="header">(.*?)<\/script>/s.exec(page)[1];
  const state = new State(JSON.parse(header));
  assert.equal(state.contour.points.length, 38);
  assert.equal(state.contour.loops.length, 1);
  assert.equal(state.contour.saddles[0].value.toFixed(1), '52.4');
  assert.deepEqual([state.fault.kind, state.fault.site], ['pieces', 0]);
  // The pictures of Stage 2 have a right mesh from the beginning, and say whose it is.
  assert.deepEqual(kPictures.mesh.tell(state).slice(0, 2), [
    'The certificate fails; here it holds, with 1 site more (dashed).',
    '11 sites and 19 surface points: 30 edges. T has 38.']);
  assert.match(kPictures.insertion.tell(state).join(' '), /with 1 site more.* h = 0\.\d\d voxels/);
  assert.match(kPictures.dual.tell(state).join(' '), /^C1 fails\. .*in 2 pieces\. Next comes v: the ringed vertex, 0\.91 voxels from A/);
  assert.match(kPictures.coarsen.tell(state).join(' '), /^38 of 38 .*It stays: it would be further than D/);
  assert.equal(state.sites.length, 10);
  state.set_kappa(53);
  assert.equal(state.contour.loops.length, 2);
  state.start_again();
  state.add_site(state.fault.insert);
  assert.equal(state.fault, null);
  const rounds = state.finished(), { loops, refused } = rounds.at(-1);
  assert.deepEqual([state.sites.length, rounds.length - 1, loops[0].length, refused.length], [11, 19, 30, 0]);
  // What is told counts points that were inserted by hand.
  state.insert();
  state.insert();
  assert.equal(kPictures.mesh.tell(state)[0], '11 sites and 19 surface points: 30 edges. T has 38.');
  assert.match(kPictures.insertion.tell(state).join(' '), /2 points inserted\./);
  state.start_again();
  state.way = 'few';
  assert.match(kPictures.need.tell(state)[0], /meets itself at A/);
  state.way = 'cubes';
  assert.match(kPictures.need.tell(state)[0], /38 edges in 2 loops\. \u03a3 has 1 loop\./);
  for (let kappa = 40; kappa <= 65; ++kappa) {
    state.start_again();
    state.set_kappa(kappa);
    state.certify();
    assert.equal(state.fault, null, `isovalue ${kappa}`);
    const { loops, refused } = state.finished().at(-1);
    const most = Math.max(...facets_of(state.field, kappa, loops).map((f) => f.h));
    assert.ok(most <= 0.1 || refused.length > 0, `isovalue ${kappa}`);
  }
});

test('the torus at the top: every piece is a disk, two meet along one curve or not at all, and K is a torus', () => {
  const page = fs.readFileSync(path.join(root, 'docs/index.html'), 'utf8');
  const { torus } = JSON.parse(/id="header">(.*?)<\/script>/s.exec(page)[1]);
  assert.equal(torus.length, 40);
  for (const { surface, ends } of torus) {
    const edges = new Map();
    // Where an edge of T lies in the plane between two sites, a triangle leaves an edge to one of them.
    const polygons = surface.filter((polygon) => new Set(polygon).size > 2)
      .map((polygon) => polygon.filter((v, n) => v !== polygon.at(n - 1)));
    for (const polygon of polygons) {
      polygon.forEach((v, n) => {
        const key = [v, polygon[(n + 1) % polygon.length]].sort((a, b) => a - b).join();
        edges.set(key, (edges.get(key) ?? 0) + 1);
      });
    }
    assert.equal(new Set(polygons.flat()).size - edges.size + polygons.length, 1);
    const border = [...edges].filter(([, count]) => count === 1).map(([key]) => key);
    const drawn = ends.filter(([a, b]) => a !== b).map((end) => [...end].sort((a, b) => a - b).join());
    assert.deepEqual([...new Set(drawn)].sort(), border.sort());
  }
  const { pairs, triples } = neighbors_of(torus);
  assert.equal(torus.length - pairs.length + triples.length, 0);
  for (const pair of pairs) {
    assert.equal(triples.filter((triple) => pair.every((n) => triple.includes(n))).length, 2, String(pair));
  }
});
