// SPDX-License-Identifier: MIT
// Tests of what the scripts of view/page/web compute, without a browser: run by scripts.sh, which puts
// the sources and then this file into one context. Each case is an oracle: brute force, another
// formula, or the same state reached another way.
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

test('base64: every length, against the system', () => {
  const random = random_from(1);
  for (let size = 0; size < 400; ++size) {
    const bytes = Uint8Array.from({ length: size }, () => random.below(256));
    const decoded = decode_base64(Buffer.from(bytes).toString('base64'));
    assert.deepEqual(Array.from(decoded), Array.from(bytes));
  }
});

test('arrays of data that were cut off are as long as what is there', () => {
  const bytes = new Uint8Array(22);
  const arrays = arrays_of({ a: { type: 'u32', offset: 0, length: 3 },
                             b: { type: 'f32', offset: 12, length: 5 },
                             c: { type: 'u8', offset: 40, length: 7 } }, bytes);
  assert.deepEqual([arrays.a.length, arrays.b.length, arrays.c.length], [3, 2, 0]);
});

test('data that end early are read as far as they go', async () => {
  const bytes = Uint8Array.from({ length: 300000 }, (_, n) => n * n >> 5);
  const packed = zlib.deflateSync(bytes);
  assert.deepEqual(Buffer.from(await inflate(packed)), Buffer.from(bytes));
  const part = await inflate(packed.subarray(0, packed.length >> 1));
  assert.ok(part.length > 0 && part.length < bytes.length);
  assert.deepEqual(Buffer.from(part), Buffer.from(bytes.subarray(0, part.length)));
});

test('measures of triangles, against angles and sides', () => {
  const random = random_from(2);
  for (let n = 0; n < 2000; ++n) {
    const size = 10 ** (6 * random.real() - 3);
    const points = Float32Array.from({ length: 9 }, () => size * (random.real() - 0.5));
    const [a, b, c] = [0, 1, 2].map((v) => point_at(points, v));
    const angle_at = (p, q, r) => {
      const u = subtract(q, p), v = subtract(r, p);
      return Math.atan2(length_of(cross(u, v)), dot(u, v));
    };
    const least = Math.min(angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b));
    const radius = length_of(subtract(c, b)) / (2 * Math.sin(angle_at(a, b, c)));
    const shortest = Math.min(...[[a, b], [b, c], [c, a]].map(([p, q]) => length_of(subtract(p, q))));
    const measured = measure_triangles(points, Uint32Array.of(0, 1, 2));
    const near = (x, y) => assert.ok(Math.abs(x - y) <= 1e-3 * Math.abs(y) + 1e-9, `${x} ${y}`);
    if (least < 1e-3) continue;
    near(measured.angle[0], least * 180 / Math.PI);
    near(measured.radius[0], radius);
    near(measured.r_over_l[0], radius / shortest);
  }
  const flat = measure_triangles(Float32Array.of(0, 0, 0, 1, 0, 0, 3, 0, 0), Uint32Array.of(0, 1, 2));
  assert.deepEqual([flat.angle[0], flat.radius[0], flat.r_over_l[0]], [0, Infinity, Infinity]);
  const right = measure_triangles(Float32Array.of(0, 0, 0, 3, 0, 0, 0, 4, 0), Uint32Array.of(0, 1, 2));
  assert.ok(Math.abs(right.area[0] - 6) < 1e-5);
  assert.equal(flat.area[0], 0);
});

test('a view frames the largest components, which have 99 % of the area', () => {
  const triangles = Uint32Array.from({ length: 12 }, (_, n) => n);
  const framed = (areas, component) =>
    Array.from(triangles_of_most_area(Float32Array.from(areas), component, triangles));
  assert.deepEqual(framed([50, 49.5, 0.3, 0.2], [0, 0, 1, 2]), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual(framed([50, 40, 9, 1], [0, 0, 1, 2]), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
  assert.deepEqual(framed([50, 40, 8, 2], [0, 0, 1, 2]), Array.from(triangles));
  assert.deepEqual(framed([0, 0, 0, 0], [0, 0, 0, 0]), Array.from(triangles));
});

test('bins hold every value once, and round_up gives the next round number', () => {
  const values = Float32Array.of(-1, 0, 0.5, 0.999, 1, 7, Infinity, NaN);
  const counts = count_bins(values, 0, 1, 4);
  assert.deepEqual(Array.from(counts), [2, 0, 1, 5]);
  assert.deepEqual([0, 0.9, 1, 1.01, 23, 0.081, -1].map(round_up), [1, 1, 1, 1.2, 25, 0.1, 1]);
  assert.equal(quantile([Float32Array.of(3, NaN, 1), Float32Array.of(2, Infinity)], 0.5), 2);
  assert.equal(quantile([new Float32Array(0)], 0.5), 0);
});

function random_volume(random) {
  const dims = [0, 1, 2].map(() => 2 + random.below(20));
  const rare = random.below(3);
  const samples = Uint8Array.from({ length: dims[0] * dims[1] * dims[2] }, () =>
    rare > 0 && random.below(80) > 0 ? 10 : random.below(256));
  return { dims, samples };
}

test('the kd-tree: ranges and leaves, by looking at everything', () => {
  for (let seed = 0; seed < 40; ++seed) {
    const { dims, samples } = random_volume(random_from(seed));
    const tree = new VoxelTree(samples, dims);
    let voxels = 0;
    const visit = (node, level, lo, hi) => {
      let least = 256, most = -1;
      for (let k = lo[2]; k <= hi[2]; ++k)
        for (let j = lo[1]; j <= hi[1]; ++j)
          for (let i = lo[0]; i <= hi[0]; ++i) {
            const value = samples[(k * dims[1] + j) * dims[0] + i];
            least = Math.min(least, value);
            most = Math.max(most, value);
          }
      assert.deepEqual([tree.min[node], tree.max[node]], [least, most], `seed ${seed}`);
      const size = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
      if (level === tree.depth) {
        assert.ok(size >= 1 && (size <= kLeafVoxels || Math.min(...tree.voxels) < 2));
        voxels += size;
        return;
      }
      const axis = tree.axis[level], middle = VoxelTree.middle(lo[axis], hi[axis]);
      const lower = [...hi], upper = [...lo];
      lower[axis] = upper[axis] = middle;
      visit(2 * node, level + 1, lo, lower);
      visit(2 * node + 1, level + 1, upper, hi);
    };
    visit(1, 0, [0, 0, 0], tree.voxels);
    assert.equal(voxels, tree.voxels.reduce((a, b) => a * b));
  }
});

test('what a ray finds by the kd-tree is what it finds among all voxels', () => {
  let found = 0, pruned = 0;
  for (let seed = 0; seed < 400; ++seed) {
    const random = random_from(1000 + seed);
    const { dims, samples } = random_volume(random);
    const tree = new VoxelTree(samples, dims);
    // Some rays run along axes, through lattice points, or in planes of them.
    const end = () => dims.map((n) => random.below(2) ? random.below(n + 2) - 1
                                                      : random.real() * (n + 1) - 1);
    const from = end(), to = end();
    for (const axis of [0, 1, 2]) if (random.below(4) === 0) to[axis] = from[axis];
    const kappa = 1 + random.below(255);
    const line = new LatticeLine(from, subtract(to, from), tree.voxels);
    const { nodes, voxels } = tree.walk(line, kappa);

    const expected = [];
    const range = line.clip(0, 1);
    for (let k = 0; range && k < tree.voxels[2]; ++k)
      for (let j = 0; j < tree.voxels[1]; ++j)
        for (let i = 0; i < tree.voxels[0]; ++i) {
          const part = line.part_in([i, j, k], [i + 1, j + 1, k + 1], range.t0, range.t1);
          if (part && tree.voxel_is_active(i, j, k, kappa)) expected.push({ voxel: [i, j, k], ...part });
        }
    expected.sort((a, b) => a.t0 - b.t0);
    assert.deepEqual(voxels, expected, `seed ${seed}`);
    found += expected.length;
    for (const node of nodes) {
      assert.ok(line.part_in(node.lo, node.hi, 0, 1), `seed ${seed}: a node off the ray`);
      pruned += !node.active;
    }
  }
  assert.ok(found > 500 && pruned > 100, `${found} ${pruned}`);
});

test('curves of a cell lie on its bilinear interpolant, and part its corners', () => {
  let saddles = 0;
  for (let seed = 0; seed < 3000; ++seed) {
    const random = random_from(seed);
    const [f00, f10, f01, f11] = [0, 1, 2, 3].map(() => random.real() - 0.5);
    const value = ([x, y]) => (1 - y) * ((1 - x) * f00 + x * f10) + y * ((1 - x) * f01 + x * f11);
    const curves = cell_curves(f00, f10, f01, f11);
    for (const curve of curves) {
      for (const p of curve) assert.ok(Math.abs(value(p)) < 1e-9, `seed ${seed}`);
      for (const p of [curve[0], curve.at(-1)]) {
        assert.ok(p.some((x) => x === 0 || x === 1), `seed ${seed}: an end within the cell`);
      }
    }
    const signs = [f00, f10, f11, f01].map((f) => f >= 0);
    const changes = signs.filter((s, n) => s !== signs[(n + 1) % 4]).length;
    assert.equal(2 * curves.length, changes);
    if (changes < 4) continue;
    // Where the saddle has the sign of (0,0), no branch cuts off that corner.
    ++saddles;
    const middle = (f00 - f01) / (f00 - f10 - f01 + f11);
    const saddle = value([middle, (f00 - f10) / (f00 - f10 - f01 + f11)]);
    const cuts_off = curves.some((curve) => curve[0][0] === 0 && curve.at(-1)[1] === 0);
    assert.equal(cuts_off, (saddle >= 0) !== (f00 >= 0), `seed ${seed}`);
  }
  assert.ok(saddles > 100);
});

// A trace in which events take facets away, at random and rotated, and put others there; the same
// triangle may be there more than once.
function random_trace(random, events) {
  const lists = { removed: [], added: [], relabel: [] };
  const begins = { removed: [0], added: [0], relabel: [0] };
  const states = [[]], labels = [new Array(9).fill(0)];
  for (let e = 0; e < events; ++e) {
    const state = [...states[e]], label = [...labels[e]];
    for (let n = random.below(4); n > 0 && state.length > 0; --n) {
      const [[a, b, c]] = state.splice(random.below(state.length), 1);
      lists.removed.push(...[[a, b, c], [b, c, a], [c, a, b]][random.below(3)]);
    }
    for (let n = random.below(6); n > 0; --n) {
      const a = random.below(7), b = 7 + random.below(7), c = 14 + random.below(7);
      const facet = random.below(2) ? [a, b, c] : [b, a, c];
      state.push(facet);
      lists.added.push(...facet);
    }
    for (let n = random.below(3); n > 0; --n) {
      const v = random.below(9);
      label[v] = random.below(5);
      lists.relabel.push(v, label[v]);
    }
    begins.removed.push(lists.removed.length / 3);
    begins.added.push(lists.added.length / 3);
    begins.relabel.push(lists.relabel.length / 2);
    states.push(state);
    labels.push(label);
  }
  const arrays = { event_routine: new Uint8Array(events) };
  for (const name of Object.keys(lists)) {
    arrays[name] = Uint32Array.from(lists[name]);
    arrays[name + '_begin'] = Uint32Array.from(begins[name]);
  }
  return { arrays, states, labels };
}

const canonical = ([a, b, c]) => (a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b]).join(' ');

test('a trace replayed: any step from any other, forwards and back, step by step or at once', () => {
  for (let seed = 0; seed < 30; ++seed) {
    const random = random_from(seed);
    // Long ones are gathered when the way is long.
    const { arrays, states } = random_trace(random, seed < 4 ? 3000 : 60);
    const trace = new Trace({ header: { routines: [{ name: 'x', stage: 1 }] }, arrays });
    const history = new FacetHistory(trace);
    assert.equal(history.unknown, 0);
    const slots = [];
    const live = new LiveFacets(trace, history, (slot, id) => { slots[slot] = id; });
    for (let jump = 0; jump < 60; ++jump) {
      const near = clamp(live.step + random.below(7) - 3, 0, trace.count);
      const step = random.below(2) ? near : random.below(trace.count + 1);
      live.go_to(step);
      const there = slots.slice(0, live.count)
        .map((id) => canonical(Array.from(history.corners.subarray(3 * id, 3 * id + 3))));
      assert.deepEqual(there.sort(), states[step].map(canonical).sort(), `seed ${seed} step ${step}`);
      for (let slot = 0; slot < live.count; ++slot) assert.equal(live.slot[slots[slot]], slot);
    }
  }
});

test('the curves have the vertices of the surface at every step, and the worst distance of a column', () => {
  for (let seed = 0; seed < 20; ++seed) {
    const events = 40;
    const { arrays, states } = random_trace(random_from(seed), events);
    arrays.points = new Float32Array(3 * 21);
    arrays.event_worst = Float32Array.from({ length: events }, (_, e) => e < 10 ? NaN : events - e);
    const trace = new Trace({ header: {}, arrays });
    const live = states.slice(1).map((state) => new Set(state.flat()).size);
    assert.deepEqual(Array.from(live_vertices(trace)), live);
    const { worst, vertices } = curves_of(trace, live, places_of(trace), events / 2);
    assert.deepEqual(Array.from(vertices), live.filter((_, e) => e % 2 === 1));
    assert.deepEqual(Array.from(worst), Array.from(worst, (_, n) => n < 5 ? NaN : events - 2 * n));
  }
});

test('labels of the contour are taken back as they were', () => {
  for (let seed = 0; seed < 20; ++seed) {
    const random = random_from(seed);
    const { arrays, labels } = random_trace(random, 80);
    arrays.contour_points = new Float32Array(27);
    arrays.contour_triangles = Uint32Array.of(0, 1, 2);
    arrays.contour_label = new Uint32Array(9);
    const trace = new Trace({ header: {}, arrays });
    const regions = new Regions(trace);
    for (let jump = 0; jump < 50; ++jump) {
      const step = random.below(trace.count + 1);
      regions.go_to(step);
      assert.deepEqual(Array.from(regions.labels), labels[step], `seed ${seed} step ${step}`);
    }
  }
});

test('tetrahedra inside a surface of their facets, and those outside', () => {
  // Cubes of six tetrahedra each; the surface is the boundary of some of the cubes.
  const size = 4;
  const vertex = (i, j, k) => (k * size + j) * size + i;
  const points = new Float32Array(3 * size ** 3);
  for (let n = 0; n < size ** 3; ++n) {
    points.set([n % size, Math.floor(n / size) % size, Math.floor(n / size ** 2)], 3 * n);
  }
  for (let seed = 0; seed < 20; ++seed) {
    const random = random_from(seed);
    const tetrahedra = [], chosen = [];
    for (let k = 0; k < size - 1; ++k)
      for (let j = 0; j < size - 1; ++j)
        for (let i = 0; i < size - 1; ++i) {
          const inside = seed === 0 ? i === 1 && j === 1 && k === 1 : random.below(3) === 0;
          for (const way of [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]) {
            const at = [i, j, k], corners = [vertex(...at)];
            for (const axis of way) {
              ++at[axis];
              corners.push(vertex(...at));
            }
            tetrahedra.push(...corners);
            chosen.push(inside);
          }
        }
    const facets = new Map();
    chosen.forEach((inside, n) => {
      if (!inside) return;
      add_shrunk(tetrahedra.slice(4 * n, 4 * n + 4), (v) => point_at(points, v), 1,
                 (corners) => {
        const facet = corners.map((p) => vertex(...p.map(Math.round)));
        const name = [...facet].sort((a, b) => a - b).join(' ');
        if (facets.has(name)) facets.delete(name);
        else facets.set(name, facet);
      });
    });
    const side = inside_of(Uint32Array.from(tetrahedra), [...facets.values()], points);
    if (facets.size === 0) continue;
    assert.deepEqual(Array.from(side, (s) => s > 0), chosen, `seed ${seed}`);
  }
});

test('a trace that was cut off ends with its last whole event', () => {
  const { arrays } = random_trace(random_from(5), 50);
  const whole = new Trace({ header: {}, arrays });
  assert.equal(whole.count, 50);
  const added = arrays.added.subarray(0, arrays.added.length >> 1);
  const cut = new Trace({ header: {}, arrays: { ...arrays, added } });
  assert.ok(cut.count > 0 && cut.count < 50);
  assert.ok(3 * cut.begin('added', cut.count) <= added.length);
  assert.ok(3 * cut.begin('added', cut.count + 1) > added.length);
  assert.equal(new Trace({ header: {}, arrays: {} }).count, 0);
});

test('an event is told with who asked for it, why and what came of it', () => {
  const header = {
    routines: [{ name: 'refine', figure: '9', stage: 2, text: 'a facet is refined' }],
    outcomes: ['done', 'refused: turned'], outcome_texts: ['done', 'an edge would be too sharp'],
    reasons: [{ name: 'r/l', text: 'radius over edge; value: times the limit' }] };
  const none = kNone;
  const arrays = { event_routine: Uint8Array.of(0, 0), event_outcome: Uint8Array.of(0, 1),
                   event_reason: Uint8Array.of(0, 0), event_value: Float32Array.of(1.25, 3),
                   event_vertex: Uint32Array.of(7, none), event_caller: Uint32Array.of(1, 2, 3, 4, none, none),
                   event_place: Float32Array.of(1, 2, 3, NaN, NaN, NaN) };
  const trace = new Trace({ header, arrays });
  const told = [0, 1].map((e) => tell_event(trace, e));
  const text = told.map(({ lines }) => lines.map(([, words, heading = '']) => heading + words).join(' '));
  assert.match(text[0], /r\/l of facet \(1, 2, 3\): radius over edge; times the limit: 1\.25\./);
  assert.match(text[0], /Vertex 7 comes in at \(1, 2, 3\)/);
  assert.match(text[1], /vertex 4/);
  assert.match(text[1], /Refused, .turned.: an edge would be too sharp\. Nothing is changed/);
  assert.equal(told[1].where, 'Stage 2, Figure 9');
});

test('the boundary of a disk is what one triangle alone has', () => {
  const boundary = boundary_of([0, 1, 2, 0, 2, 3]).map((edge) => edge.join(' ')).sort();
  assert.deepEqual(boundary, ['0 1', '1 2', '2 3', '3 0']);
});

test('triangles that name points beyond the last are left out', () => {
  const triangles = Uint32Array.of(0, 1, 2, 2, 1, 3, 0, 1, 9, 0, 1, 2);
  assert.equal(complete_triangles(triangles, 4).length, 6);
  assert.equal(complete_triangles(triangles, 10).length, 12);
  assert.equal(complete_triangles(new Uint32Array(0), 0).length, 0);
});

test('points of no triangle are not what a camera has to see', () => {
  const points = Float32Array.from({ length: 15 }, (_, n) => n);
  assert.deepEqual(Array.from(points_named(points, Uint32Array.of(3, 1, 4, 1, 4, 3))),
                   [3, 4, 5, 9, 10, 11, 12, 13, 14]);
});

test('a camera that fits a box sees its corners', () => {
  for (let seed = 0; seed < 200; ++seed) {
    const random = random_from(seed);
    const lo = [0, 1, 2].map(() => 100 * random.real() - 50);
    const box = { lo, hi: lo.map((x) => x + 0.1 + 30 * random.real()) };
    const aspect = 0.3 + 2 * random.real();
    const camera = new Camera();
    camera.stand([random.below(3), random.below(2) ? 1 : -1]);
    camera.turn(360 * random.real(), 180 * random.real() - 90);
    camera.set_scene(box);
    const free = random.below(2) * 0.4 * random.real();
    Object.assign(camera, camera.place_for(aspect, free));
    const project = new Float64Array(16);
    camera.project(project, aspect);
    const extent = [[1, -1], [1, -1]];
    for (let n = 0; n < 8; ++n) {
      const p = [0, 1, 2].map((axis) => n >> axis & 1 ? box.hi[axis] : box.lo[axis]);
      const at = [0, 1, 2, 3].map((row) => project[row] * p[0] + project[4 + row] * p[1] +
                                           project[8 + row] * p[2] + project[12 + row]);
      const [x, y, z] = at.map((value) => value / at[3]);
      assert.ok(Math.abs(x) <= 1 && Math.abs(y) <= 1 && Math.abs(z) <= 1, `seed ${seed}`);
      [x, y].forEach((at_axis, axis) => {
        extent[axis] = [Math.min(extent[axis][0], at_axis), Math.max(extent[axis][1], at_axis)];
      });
    }
    // But for the margins it is filled in one direction, from border to border, and not beyond.
    const room = [[-1, 1], [-1, 1 - 2 * free]].map((ends) => ends.map((end) => end / 1.08));
    const gaps = extent.map(([low, high], axis) => [low - room[axis][0], room[axis][1] - high]);
    assert.ok(gaps.flat().every((gap) => gap > -1e-5), `seed ${seed}`);
    assert.ok(gaps.some(([low, high]) => low + high < 1e-5), `seed ${seed}`);
  }
});

test('the axis that is up is up for the eye, and angles lead back to the direction', () => {
  for (let seed = 0; seed < 200; ++seed) {
    const random = random_from(seed);
    const axis = random.below(3), sign = random.below(2) ? 1 : -1;
    const camera = new Camera();
    camera.stand([axis, sign]);
    const wanted = unit([0, 1, 2].map(() => random.real() - 0.5));
    const { azimuth, elevation } = camera.angles_of(wanted);
    camera.turn(azimuth - camera.azimuth, elevation - camera.elevation);
    assert.ok(length_of(subtract(camera.back, wanted)) < 1e-9, `seed ${seed}`);
    assert.ok(Math.abs(camera.right[axis]) < 1e-12);
    assert.ok(sign * camera.up[axis] > 0);
    assert.ok(length_of(subtract(cross(camera.right, camera.up), camera.back)) < 1e-9);
  }
});

test('a camera\'s text gives the camera back, and what is no text of one changes nothing', () => {
  for (let seed = 0; seed < 100; ++seed) {
    const random = random_from(seed);
    const cameras = [new Camera(), new Camera()];
    for (const camera of cameras) camera.set_scene({ lo: [1, 2, 3], hi: [4, 9, 5] });
    const [one, other] = cameras;
    one.target = [1 + random.real(), 2, 3];
    one.distance = 20 * random.real() + 0.1;
    one.turn(360 * random.real(), 80 * random.real() - 60);
    one.zoom(0.5 + random.real());
    assert.ok(set_camera(other, camera_text(one)));
    const near = (a, b) => assert.ok(length_of(subtract(a, b)) < 2e-3, `seed ${seed}: ${a}, ${b}`);
    near(one.eye(), other.eye());
    near(one.up, other.up);
    const before = camera_text(other);
    for (const text of ['', '1', '1,2,3', '1,x', 'NaN,0', '1,2,3,4,5,6,7']) {
      assert.ok(!set_camera(other, text), text);
    }
    assert.equal(camera_text(other), before);
  }
});

test('an address opens what it was written from, and an empty one what was there at first', () => {
  globalThis.window = { addEventListener() {} };
  globalThis.location = { hash: '' };
  const inputs = [['Cut', 'checkbox', ''], ['Across', 'select', '0'], ['Where', 'range', '0.5'],
                  ['Across', 'select', 'smooth']].map(([label, type, value]) =>
    ({ type, value, checked: false, getAttribute: () => label,
       dispatchEvent() { if (type !== 'checkbox') inputs[0].checked = true; } }));
  const histogram = { key: 'angle', brush: null, set(brush) { this.brush = brush; } };
  const camera = new Camera();
  camera.set_scene({ lo: [0, 0, 0], hi: [1, 1, 1] });
  const scene = { camera, invalidate() {}, fit() {} };
  const address = new Address(scene, { querySelectorAll: () => inputs },
                              [brush_word(histogram)]);
  camera.zoom(0.5);
  const first = address.text();
  const written = [];
  const random = random_from(9);
  for (let n = 0; n < 50; ++n) {
    inputs[1].value = String(random.below(3));
    inputs[2].value = String(random.below(10) / 10);
    inputs[3].value = random.below(2) ? 'flat' : 'smooth';
    inputs[0].checked = random.below(2) === 0;
    const from = random.below(kBins);
    histogram.brush = random.below(2) ? { from, to: from + random.below(kBins - from) } : null;
    camera.turn(10, random.real());
    written.push(address.text());
  }
  assert.ok(new Set(written).size === 50);
  for (const text of [...written.reverse(), first]) {
    address.open('#' + text);
    assert.equal(address.text(), text);
  }
  address.open('#brush-angle=3-99&across=');
  assert.equal(histogram.brush, null);
});

test('hidden components are told by the shorter list, and read back', () => {
  for (let seed = 0; seed < 300; ++seed) {
    const random = random_from(seed);
    const count = random.below(12), share = random.real();
    const hidden = new Set(Array.from({ length: count }, (_, c) => c).filter(() => random.real() < share));
    const text = components_text(hidden, count);
    assert.deepEqual(hidden_components(text, count), hidden, `seed ${seed}: ${text}`);
  }
  assert.equal(components_text(hidden_components('3', 900), 900), '3');
  for (const text of ['', 'x', '9']) assert.equal(hidden_components(text, 8).size, 0);
  assert.equal(components_text(new Set([1, 4]), 900), '-2,5');
});

test('the legend has the color of every value, and says what lies beyond the scale', () => {
  const measure = { name: 'Size', unit: '', lo: 1, hi: 5, open: true };
  const entries = legend_of('size', measure, false);
  assert.deepEqual(entries.map(([, text]) => text), ['size: 1', '2', '3', '4', '5 or more']);
  assert.equal(entries.at(-1)[0], sequential_color(7));
  assert.equal(legend_of('size', { ...measure, open: false }, false).at(-1)[1], '5');
});

test('panes lie along the longer side, and every place is in its pane', () => {
  for (const [width, height, stacked] of [[800, 400, false], [300, 500, true]]) {
    const scene = Object.create(Scene.prototype);
    Object.assign(scene, { canvas: { clientWidth: width, clientHeight: height }, panes: [{}, {}] });
    assert.equal(scene.stacked, stacked);
    const at = scene.place_of(0.75 * width, 0.75 * height);
    assert.deepEqual([at.x, at.y], stacked ? [0.5, 0] : [0, -0.5]);
    assert.equal(at.pane, 1);
    assert.equal(at.aspect, stacked ? 1.2 : 1);
    assert.equal(scene.place_of(-5, -5).pane, 0);
  }
});

// The names that the program writes into a trace.
const source_of = (name) => fs.readFileSync(path.join(root, name), 'utf8');
function names_in(file, from, shape) {
  const text = source_of(file);
  const begin = text.indexOf(from);
  assert.ok(begin >= 0, from);
  return [...text.slice(begin, text.indexOf('};', begin)).matchAll(shape)].map((match) => match[1]);
}

test('tables of colors: every operation and criterion, fixed, distinct, not red against green', () => {
  const routines = names_in('view/trace/trace_names.cpp', 'name_of(Routine ', /Routine::\w+,\s*\{"(\w+)"/g);
  const operations = names_in('src/run/report.h', 'kOperationTable', /Operation::\w+,\s*"(\w+)"/g);
  const reasons = ['Reason', 'PaperReason'].flatMap((kind) =>
    names_in('view/trace/trace_names.cpp', `name_of(${kind} `, /Reason::\w+,\s*\{"([^"]+)",/g));
  assert.ok(routines.length === 11 && operations.length >= 7 && reasons.length >= 16);
  assert.deepEqual(Object.keys(kOperations), [...routines, ...operations]);
  for (const reason of [...reasons, ...kMeasured]) assert.ok(kCriteria[reason], reason);
  for (const table of [kOperations, kCriteria]) {
    const rows = Object.values(table);
    for (const key of ['color', 'label']) {
      assert.equal(new Set(rows.map((row) => row[key])).size, rows.length, key);
    }
    // Blue has its strongest part last, orange first; green never leads.
    for (const { color } of [...rows, ...Object.values(kMarks)]) {
      assert.ok(green_of(color) <= Math.max(red_of(color), blue_of(color)), color.toString(16));
    }
  }
  // The same, whatever a trace has most of.
  const { arrays } = random_trace(random_from(1), 20);
  const trace = new Trace({ header: { routines: [{ name: 'flip', stage: 2 }] }, arrays });
  assert.equal(trace.routine_style(0), kOperations.flip);
});

test('terms of the page stand in the glossary, with their definitions', () => {
  const rows = source_of('docs/glossary.md').split('\n').filter((line) => line.startsWith('| <a'));
  for (const [term, meaning] of Object.entries(kTerms)) {
    const row = rows.find((line) => line.split(' | ')[1]?.startsWith(meaning));
    assert.ok(row, `${term}: ${meaning}`);
    assert.ok(row.includes(term) || row.includes(term.replace('circumradius', 'r')), term);
  }
});

test('removals that were refused are folded, and every event is found at its place', () => {
  const random = random_from(3);
  for (let n = 0; n < 50; ++n) {
    const events = 1 + random.below(n < 20 ? 3 : 300);
    const arrays = { event_routine: Uint8Array.from({ length: events }, () => random.below(2)),
                     event_outcome: Uint8Array.from({ length: events }, () => random.below(4) ? 1 : 0) };
    const header = { routines: [{ name: 'flip' }, { name: 'removal' }], outcomes: ['done', 'refused: no gain'] };
    const trace = new Trace({ header, arrays });
    const places = places_of(trace);
    assert.equal(places[0], 0);
    assert.equal(places[events], 1);
    let folded = 0;
    for (let e = 0; e < events; ++e) {
      assert.ok(places[e] < places[e + 1]);
      assert.equal(event_at(places, (places[e] + places[e + 1]) / 2), e);
      if (arrays.event_routine[e] === 1 && arrays.event_outcome[e] === 1) folded += places[e + 1] - places[e];
    }
    assert.ok(folded <= 0.1 || folded > 1 - 1e-9);
  }
});

test('playback: the rare lasts longer, the whole about a minute', () => {
  const events = 4000;
  const arrays = { event_routine: Uint8Array.from({ length: events }, (_, e) => e % 400 === 7 ? 1 : 0) };
  const trace = new Trace({ header: { routines: [{ name: 'a' }, { name: 'b' }] }, arrays });
  const seconds = seconds_of_events(trace);
  assert.ok(seconds[7] > 5 * seconds[8]);
  assert.ok(Math.abs(seconds.reduce((a, b) => a + b) - kPlaySeconds) < 1);
});

test('the tour stops at events of the trace, and says where there is none', () => {
  const arrays = { event_routine: Uint8Array.of(0, 1, 2, 2), event_outcome: Uint8Array.of(0, 0, 0, 1),
                   event_reason: Uint8Array.of(0, 0, 1, 1), event_value: Float32Array.of(1, 1, 3, 2) };
  for (const [program, first, at_switch, events] of [
    ['published', 'certify', 'build_tri_mesh', [0, -1, 1, -1, -1, 2, 3]],
    ['published', 'init_triangulation', 'build_tri_mesh', [0, -1, -1, 1, -1, -1, 2, 3]],
    ['exact', 'contour', 'coarsen', [0, -1, -1, 1, -1, -1, 2, 3]],
    ['exact', 'remove_vertices', 'coarsen', [0, 0, -1, 1, -1, -1, 2, 3]]]) {
    const header = { program, routines: [{ name: first, stage: 1 }, { name: at_switch, stage: 1 },
                                         { name: 'flip', stage: 2 }],
                     outcomes: ['done', 'refused: turned'], reasons: [{ name: 'beginning' }, { name: 'h' }] };
    const stops = tour_stops(new Trace({ header, arrays }));
    assert.deepEqual(stops.map(({ event }) => event), events);
    for (const { text, event } of stops) assert.ok(text && (event >= 0 || /\bno\b/i.test(text)));
    assert.ok(tour_stops(new Trace({ header: { program }, arrays: {} })).every(({ event }) => event === -1));
  }
});

test('the tour calls the topology right where the counts of the run are the surface\u2019s', () => {
  const header = { routines: [{ name: 'coarsen', stage: 1 }] };
  const said = (more) => tour_stops(new Trace({ header: { ...header, ...more },
                                                arrays: { event_routine: Uint8Array.of(0) } }))[3].text;
  const exact_topology = { components: 16, euler: -40, boundary_loops: 9 };
  assert.match(said({ topology: { ...exact_topology }, exact_topology }), /is right, 16 components, Euler number -40 and 9 /);
  for (const key of Object.keys(exact_topology)) {
    assert.match(said({ topology: { ...exact_topology, [key]: 7 }, exact_topology }), /is wrong, .*\b7 .*16 components/);
  }
  // Of chosen components alone.
  assert.doesNotMatch(said({ topology: exact_topology }), /right|wrong/);
});

test('the tour explains no refusal but that of an insertion', () => {
  const arrays = { event_routine: Uint8Array.of(0, 1, 0), event_outcome: Uint8Array.of(1, 1, 0) };
  const header = { routines: [{ name: 'removal', stage: 2 }, { name: 'foot', stage: 2 }], outcomes: ['done', 'refused: no_gain'] };
  assert.equal(tour_stops(new Trace({ header, arrays }))[5].event, 1);
});
