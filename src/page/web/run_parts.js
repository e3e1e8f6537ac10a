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
      element('thead', {}, element('tr', {}, element('td', {}), element('th', { scope: 'col' }, 'Recover'),
                                   element('th', { scope: 'col' }, 'Refine'))),
      element('tbody', {},
              row('inserted', 'points inserted', 'points inserted by the stage so far'),
              row('time', 'time per point', 'mean time of an insertion, t_RC and t_RF of Table 3'),
              row('searches', 'searches', 'times the surface was asked for along a line'),
              row('cpi', 'CPI', 'voxels computed per search, Table 4'),
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
    put('facets', trace.switch_at >= 0 && e >= trace.switch_at ? ['', grouped(facets)]
                                                               : [grouped(facets), '']);
    const ratio = micros[0] / micros[1];
    this.ratio.textContent = Number.isFinite(ratio)
      ? `t_RC / t_RF = ${rounded(ratio)}: what an insertion among tetrahedra costs against one in the mesh`
      : '';
  }
}

// The exact contour T, each vertex in the region of a site: certified Stage 1.
class Regions {
  constructor(trace) {
    const { contour_points: points, contour_triangles: triangles, contour_label: label } = trace.arrays;
    this.trace = trace;
    this.labels = Uint32Array.from(label ?? new Uint32Array(points.length / 3).fill(kNone));
    this.step = 0;
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

  // Colors are as many as there are kinds, each in three tones, so that neighbours mostly differ.
  paint(v) {
    const label = this.labels[v];
    const tone = 0.15 + 0.2 * (Math.floor(label / kKinds.length) % 3);
    const color = label === kNone ? 0xb8bec8 : mixed(kind_color(label), 0xffffff, tone);
    this.points.data[4 * v + 3] = color;
    this.points.touch(v);
  }
}

// The tetrahedra of Del S when the stages switch, those inside the surface, shrunk.
class SwitchTetrahedra {
  constructor(trace, samples) {
    this.layer = new FacetLayer(new Texels(true), { edge_width: 0.7, clipped: true });
    const { tets } = trace.arrays;
    if (!tets || tets.length === 0) return;
    const point = (v) => point_at(trace.points, v);
    const { layer } = this;
    let inside = true;
    const chosen = [];
    for (let n = 0; n + 3 < tets.length; n += 4) {
      const middle = scaled([0, 1, 2, 3].map((i) => point(tets[n + i])).reduce(add), 0.25);
      inside = !samples.there || samples.value(middle) >= trace.header.iso;
      if (inside) chosen.push(tets[n], tets[n + 1], tets[n + 2], tets[n + 3]);
    }
    layer.points.reserve(3 * chosen.length);
    add_shrunk(chosen, point, 0.86, (corners) => {
      const at = 3 * layer.count;
      corners.forEach((p, i) => layer.points.data.set(p, 4 * (at + i)));
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
