'use strict';
// Parts of the page of a trace: numbers that run along, the regions of T, the tetrahedra at the
// switch, components of the surface.

// How many there are and what they cost, up to an event.
class RunningNumbers {
  constructor(trace) {
    this.trace = trace;
    this.cells = {};
    const row = (key, label, title) => {
      this.cells[key] = [element('td', {}), element('td', {})];
      return element('tr', {}, element('th', { scope: 'row', title }, label), ...this.cells[key]);
    };
    this.ratio = element('p', { class: 'hint' });
    this.element = element('div', {}, element('table', { class: 'numbers' },
      element('thead', {}, element('tr', {}, element('td', {}), element('th', { scope: 'col' }, 'Stage 1'),
                                   element('th', { scope: 'col' }, 'Stage 2'))),
      element('tbody', {},
              row('inserted', 'points inserted', 'points inserted by the stage so far'),
              row('time', 'time per point', 'mean time of an insertion, t_RC and t_RF of Table 3'),
              row('searches', 'searches', 'times the surface was asked for along a line'),
              row('cpi', 'CPI', 'voxels computed per search, Table 4'),
              row('vertices', 'vertices so far', 'all that have been, those that moved once more'),
              row('facets', 'facets', 'facets of the surface'))), this.ratio);
  }

  show(e) {
    const { trace } = this;
    const end = Math.min(e + 1, trace.count);
    const put = (key, values) => this.cells[key].forEach((cell, n) => { cell.textContent = values[n]; });
    const inserted = trace.inserted.map((sums) => sums[end] ?? 0);
    const micros = trace.micros.map((sums, s) => inserted[s] > 0 ? sums[end] / inserted[s] : NaN);
    put('inserted', inserted.map(grouped));
    put('time', micros.map((t) => Number.isFinite(t) ? `${rounded(t)} \u00b5s` : ''));
    const { event_searches: searches, event_computations: computed } = trace.arrays;
    if (searches && computed && trace.count > 0) {
      const turn = trace.switch_at >= 0 ? Math.min(end - 1, trace.switch_at) : end - 1;
      const in_stage = (sums) => [sums[turn], sums[end - 1] - sums[turn]];
      const asked = in_stage(searches), voxels = in_stage(computed);
      put('searches', asked.map(grouped));
      put('cpi', asked.map((n, s) => n > 0 ? (voxels[s] / n).toFixed(2) : ''));
    }
    const facets = trace.begin('added', end) - trace.begin('removed', end);
    const by_stage = (n) => trace.switch_at >= 0 && e >= trace.switch_at ? ['', grouped(n)]
                                                                         : [grouped(n), ''];
    put('vertices', by_stage(trace.vertices[end]));
    put('facets', by_stage(facets));
    const ratio = micros[0] / micros[1];
    this.ratio.textContent = Number.isFinite(ratio)
      ? `t_RC / t_RF = ${rounded(ratio)}: what an insertion among tetrahedra costs against one in the mesh`
      : '';
  }
}

// The exact contour T, each vertex in the region of a site: the certified Stage 1.
class Regions {
  constructor(trace) {
    const { contour_points: points, contour_triangles: triangles, contour_label: label } = trace.arrays;
    this.trace = trace;
    this.labels = Uint32Array.from(label ?? new Uint32Array(points.length / 3).fill(kNone));
    this.step = 0;
    this.site = kNone;  // whose region stands out
    // What each change of a label replaced, so that steps can be taken back.
    const { relabel } = trace.arrays;
    const count = trace.begin('relabel', trace.count);
    this.before = new Uint32Array(count);
    const labels = Uint32Array.from(this.labels);
    for (let n = 0; n < count; ++n) {
      this.before[n] = labels[relabel[2 * n]];
      labels[relabel[2 * n]] = relabel[2 * n + 1];
    }
    this.points = texels_of_points(points);
    this.layer = new FacetLayer(this.points, { edge_width: 0, regions: true });
    this.layer.set_all(triangles, () => 0);
    this.layer.normals = vertex_normals(points, triangles);
    for (let v = 0; v < this.labels.length; ++v) this.paint(v);
  }

  go_to(step) {
    const { trace, labels } = this;
    const { relabel } = trace.arrays;
    const end = Math.min(step, trace.count);
    const target = trace.begin('relabel', end);
    let at = trace.begin('relabel', this.step);
    const set = (v, label) => {
      labels[v] = label;
      this.paint(v);
    };
    for (; at < target; ++at) set(relabel[2 * at], relabel[2 * at + 1]);
    for (; at > target; --at) set(relabel[2 * at - 2], this.before[at - 1]);
    this.step = end;
  }

  // Has the region of one site stand out.
  point_out(site) {
    const before = this.site;
    this.site = site;
    if (site === before) return;
    this.labels.forEach((label, v) => {
      if (label === site || label === before) this.paint(v);
    });
  }

  // Colors are as many as there are kinds, each in three tones, so that neighbors mostly differ.
  paint(v) {
    const label = this.labels[v];
    const tone = 0.15 + 0.2 * (Math.floor(label / kKinds.length) % 3);
    const color = label === kNone ? 0xb8bec8 : label === this.site ? kMarks.caller.color
                                             : mixed(kind_color(label), 0xffffff, tone);
    this.points.data[4 * v + 3] = color;
    this.points.touch(v);
  }
}

// Finds the tetrahedra inside a surface, which is made of some of their facets, counter-clockwise seen
// from outside. A tetrahedron on the inner side of such a facet is inside. So are its neighbors across
// other facets. Where the surface has holes or facets of no tetrahedron, the nearest facet decides.
function inside_of(tetrahedra, surface, points) {
  const key = (corners) => corners.sort((a, b) => a - b).join(' ');
  const at_facet = new Map();  // of the two tetrahedra there, and -1 in front where it is the surface's
  const count = Math.floor(tetrahedra.length / 4);
  const facet_of = (n, i) => [0, 1, 2, 3].filter((k) => k !== i).map((k) => tetrahedra[4 * n + k]);
  for (let n = 0; n < count; ++n) {
    for (let i = 0; i < 4; ++i) {
      const name = key(facet_of(n, i));
      if (at_facet.has(name)) at_facet.get(name).push(n);
      else at_facet.set(name, [n]);
    }
  }
  const side = new Int8Array(count);  // 1: inside, -1: outside
  const queue = [];
  for (const corners of surface) {
    const [a, b, c] = corners.map((v) => point_at(points, v));
    const normal = cross(subtract(b, a), subtract(c, a));
    const beside = at_facet.get(key([...corners])) ?? [];
    for (const n of beside) {
      if (n < 0 || side[n] !== 0) continue;
      const apex = [0, 1, 2, 3].map((k) => tetrahedra[4 * n + k]).find((v) => !corners.includes(v));
      side[n] = dot(normal, subtract(point_at(points, apex), a)) > 0 ? -1 : 1;
      queue.push(n);
    }
    if (beside.length > 0 && beside[0] >= 0) beside.unshift(-1);
  }
  for (let head = 0; head < queue.length; ++head) {
    const n = queue[head];
    for (let i = 0; i < 4; ++i) {
      const beside = at_facet.get(key(facet_of(n, i)));
      if (beside[0] < 0) continue;
      for (const other of beside) {
        if (side[other] !== 0) continue;
        side[other] = side[n];
        queue.push(other);
      }
    }
  }
  return side;
}

// The tetrahedra of Del S when the stages switch, those inside the surface, shrunk. Made when they
// are first asked for.
class SwitchTetrahedra {
  constructor(trace, history) {
    this.trace = trace;
    this.history = history;
    this.there = trace.switch_at >= 0 && (trace.arrays.tets?.length ?? 0) >= 4;
    this.layer = new FacetLayer(new Texels(true), { edge_width: 0.7 });
  }

  make() {
    if (!this.there || this.layer.count > 0) return;
    const { tets } = this.trace.arrays;
    const { points, switch_at: e } = this.trace;
    const { birth, death, corners } = this.history;
    const surface = [];
    for (let id = 0; id < this.history.count && birth[id] < e; ++id) {
      if (death[id] >= e) surface.push(Array.from(corners.subarray(3 * id, 3 * id + 3)));
    }
    const side = inside_of(tets, surface, points);
    const chosen = [];
    side.forEach((s, n) => {
      if (s > 0) chosen.push(...tets.subarray(4 * n, 4 * n + 4));
    });
    const { layer } = this;
    layer.points.reserve(3 * chosen.length);
    add_shrunk(chosen, (v) => point_at(points, v), 0.86, (facet) => {
      const at = 3 * layer.count;
      facet.forEach((p, i) => layer.points.data.set(p, 4 * (at + i)));
      layer.set(layer.count++, at, at + 1, at + 2, 0xe8b878);
    });
    layer.points.touch_all();
  }
}

// Connected components of facets, joined through their vertices. Colors are by the smallest vertex,
// so that they stay while a component grows.
class Components {
  constructor(vertices) {
    this.parent = new Uint32Array(vertices);
    for (let v = 0; v < vertices; ++v) this.parent[v] = v;
    this.numbers = new Map();
  }
  find(v) {
    const { parent } = this;
    while (parent[v] !== v) {
      parent[v] = parent[parent[v]];
      v = parent[v];
    }
    return v;
  }
  unite(a, b) {
    const p = this.find(a), q = this.find(b);
    if (p < q) this.parent[q] = p;
    else this.parent[p] = q;
  }
  add(corners, id) {
    this.unite(corners[3 * id], corners[3 * id + 1]);
    this.unite(corners[3 * id], corners[3 * id + 2]);
  }
  color(v) {
    const root = this.find(v);
    if (!this.numbers.has(root)) this.numbers.set(root, this.numbers.size);
    return kind_color(this.numbers.get(root));
  }
}
