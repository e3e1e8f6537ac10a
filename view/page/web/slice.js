'use strict';
// The volume's samples, a slice of them with the exact contour, and the kd-tree's nodes that a ray
// in the slice visits (paper, Figure 13).

class Samples {
  constructor({ header, arrays }) {
    this.there = arrays.samples !== undefined && header.dims !== undefined &&
                 arrays.samples.length >= header.dims.reduce((a, b) => a * b);
    if (!this.there) return;
    this.stored = arrays.samples;
    this.dims = header.dims;
    this.spacing = header.spacing ?? [1, 1, 1];
    this.origin = header.origin ?? [0, 0, 0];
    [this.base, this.factor] = header.sample_scale ?? [0, 1];
  }

  at(i, j, k) {
    return this.base + this.factor * this.stored[(k * this.dims[1] + j) * this.dims[0] + i];
  }
  // An isovalue as the stored numbers have it.
  as_stored(value) { return (value - this.base) / this.factor; }

  to_indices(p) { return p.map((x, axis) => (x - this.origin[axis]) / this.spacing[axis]); }
  to_place(u) { return u.map((x, axis) => this.origin[axis] + x * this.spacing[axis]); }

  // The trilinear interpolant; outside it is as at the nearest face.
  value(p) {
    const u = this.to_indices(p).map((x, axis) => clamp(x, 0, this.dims[axis] - 1));
    const n = u.map((x, axis) => Math.min(Math.floor(x), Math.max(0, this.dims[axis] - 2)));
    const [x, y, z] = u.map((t, axis) => t - n[axis]);
    let sum = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const [i, j, k] = [corner & 1, corner >> 1 & 1, corner >> 2];
      const weight = (i ? x : 1 - x) * (j ? y : 1 - y) * (k ? z : 1 - z);
      if (weight > 0) sum += weight * this.at(n[0] + i, n[1] + j, n[2] + k);
    }
    return sum;
  }
}

class SlicePanel {
  // lines: a layer of the 3D view, for the slice's frame, the ray and the leaves that it visits.
  constructor(samples, isovalue, lines, changed) {
    this.samples = samples;
    this.isovalue = isovalue;
    this.lines = lines;
    this.changed = changed;
    this.tree = null;      // built when the panel is first opened
    this.axis = 2;
    this.number = samples.dims[2] >> 1;
    this.rays = {};        // by axis: two ends in samples
    this.canvas = element('canvas', { class: 'slice', role: 'img', tabindex: 0,
      'aria-label': 'A slice of the samples with the contour, and the nodes of the kd-tree that a ray visits. Drag the ends of the ray.' });
    this.picture = document.createElement('canvas');
    this.note = element('p', { class: 'hint', 'aria-live': 'polite' });
    this.in_space = toggle('Show it in 3D', true, () => this.draw());
    this.position = slider('Slice', { min: 0, max: samples.dims[2] - 1, step: 1, value: this.number },
                           (n) => {
                             this.number = n;
                             this.draw();
                           });
    this.element = section('Slice and kd-tree (Figure 13)', false,
                           choice('Slice across', [['0', 'x'], ['1', 'y'], ['2', 'z']], '2', (axis) => this.turn(Number(axis))),
                           this.position, this.canvas, this.note, this.in_space);
    this.element.addEventListener('toggle', () => {
      this.draw();
      if (this.element.open) this.element.scrollIntoView({ block: 'nearest' });
    });
    on_resize(this.canvas, () => this.draw());
    this.listen();
  }

  get u() { return this.axis === 0 ? 1 : 0; }
  get v() { return this.axis === 2 ? 1 : 2; }
  get ray() {
    const { dims } = this.samples;
    this.rays[this.axis] ??= [[0.06 * (dims[this.u] - 1), 0.30 * (dims[this.v] - 1)],
                              [0.94 * (dims[this.u] - 1), 0.62 * (dims[this.v] - 1)]];
    return this.rays[this.axis];
  }

  turn_open() {
    this.element.open = !this.element.open;
  }

  turn(axis) {
    this.axis = axis;
    const { input } = this.position;
    input.max = this.samples.dims[axis] - 1;
    this.number = this.samples.dims[axis] >> 1;
    input.value = this.number;
    this.draw();
  }

  // From indices in the slice to CSS pixels: a margin of half a sample all round.
  layout() {
    const { dims, spacing } = this.samples;
    const wide = dims[this.u] * spacing[this.u], high = dims[this.v] * spacing[this.v];
    const width = this.canvas.clientWidth;
    const height = Math.round(clamp(width * high / wide, 60, 1.4 * width));
    this.canvas.style.height = `${height}px`;
    const unit_size = Math.min(width / wide, height / high);
    const left = (width - wide * unit_size) / 2, top = (height - high * unit_size) / 2;
    const x = (i) => left + (i + 0.5) * spacing[this.u] * unit_size;
    const y = (j) => top + (high - (j + 0.5) * spacing[this.v]) * unit_size;
    const back = (px, py) => [(px - left) / unit_size / spacing[this.u] - 0.5,
                              (top + high * unit_size - py) / unit_size / spacing[this.v] - 0.5];
    return { width, height, x, y, back };
  }

  listen() {
    const { canvas } = this;
    let held = -1;
    canvas.addEventListener('pointerdown', (event) => {
      const { x, y } = this.layout();
      const off = this.ray.map(([i, j]) => Math.hypot(x(i) - event.offsetX, y(j) - event.offsetY));
      held = off[0] < off[1] ? 0 : 1;
      canvas.setPointerCapture(event.pointerId);
      this.drag(held, event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (held >= 0) this.drag(held, event);
    });
    const end = () => { held = -1; };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
    // The arrow keys move the ray's end, with Shift its beginning.
    canvas.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const end_of_ray = this.ray[event.shiftKey ? 0 : 1];
      this.set_end(event.shiftKey ? 0 : 1, [end_of_ray[0] + by[0], end_of_ray[1] + by[1]]);
    });
  }

  drag(end, event) { this.set_end(end, this.layout().back(event.offsetX, event.offsetY)); }
  set_end(end, [i, j]) {
    const { dims } = this.samples;
    this.ray[end] = [clamp(i, 0, dims[this.u] - 1), clamp(j, 0, dims[this.v] - 1)];
    this.draw();
  }

  // A place of the slice as indices of the volume.
  indices([i, j]) {
    const at = [0, 0, 0];
    at[this.u] = i;
    at[this.v] = j;
    at[this.axis] = this.number;
    return at;
  }
  sample(i, j) { return this.samples.at(...this.indices([i, j])); }

  draw() {
    this.lines.clear();
    if (this.element.open && this.canvas.clientWidth > 0) {
      this.tree ??= new VoxelTree(this.samples.stored, this.samples.dims);
      const place = this.layout();
      const context = fit_canvas(this.canvas, place.width, place.height);
      this.draw_samples(context, place);
      this.draw_contour(context, place);
      this.draw_ray(context, place);
    }
    this.changed();
  }

  draw_samples(context, { x, y }) {
    const columns = this.samples.dims[this.u], rows = this.samples.dims[this.v];
    this.picture.width = columns;
    this.picture.height = rows;
    const picture = this.picture.getContext('2d');
    const image = picture.createImageData(columns, rows);
    const values = new Float32Array(columns * rows);
    let least = Infinity, most = -Infinity;
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        const value = this.sample(i, j);
        values[j * columns + i] = value;
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
    }
    this.values = values;
    const per_gray = most > least ? 255 / (most - least) : 0;
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        const gray = (values[j * columns + i] - least) * per_gray;
        const at = 4 * ((rows - 1 - j) * columns + i);
        image.data[at] = image.data[at + 1] = image.data[at + 2] = gray;
        image.data[at + 3] = 255;
      }
    }
    picture.putImageData(image, 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(this.picture, x(-0.5), y(rows - 0.5), x(columns - 0.5) - x(-0.5),
                      y(-0.5) - y(rows - 0.5));
  }

  draw_contour(context, { x, y }) {
    const columns = this.samples.dims[this.u], rows = this.samples.dims[this.v];
    const { values, isovalue } = this;
    context.strokeStyle = css_color(kInside);
    context.lineWidth = 1.8;
    context.lineJoin = 'round';
    context.beginPath();
    for (let j = 0; j + 1 < rows; ++j) {
      for (let i = 0; i + 1 < columns; ++i) {
        const at = j * columns + i;
        const f00 = values[at] - isovalue, f10 = values[at + 1] - isovalue;
        const f01 = values[at + columns] - isovalue, f11 = values[at + columns + 1] - isovalue;
        const inside = (f00 >= 0) + (f10 >= 0) + (f01 >= 0) + (f11 >= 0);
        if (inside === 0 || inside === 4) continue;
        for (const curve of cell_curves(f00, f10, f01, f11)) {
          curve.forEach(([s, t], n) => {
            if (n === 0) context.moveTo(x(i + s), y(j + t));
            else context.lineTo(x(i + s), y(j + t));
          });
        }
      }
    }
    context.stroke();
  }

  draw_ray(context, place) {
    const { x, y } = place;
    const { samples, tree } = this;
    const [from, to] = this.ray.map((end) => this.indices(end));
    const line = new LatticeLine(from, subtract(to, from), tree.voxels);
    const { nodes, voxels } = tree.walk(line, samples.as_stored(this.isovalue));
    const box = ({ lo, hi }, inset) => {
      const left = x(lo[this.u]) + inset, top = y(hi[this.v]) + inset;
      return [left, top, x(hi[this.u]) - inset - left, y(lo[this.v]) - inset - top];
    };
    for (const node of nodes) {
      const share = node.level / Math.max(1, tree.depth);
      const inset = 1.2 * (1 - share) - 0.2;
      if (!node.active) {
        context.fillStyle = 'rgb(214 96 92 / 26%)';
        context.fillRect(...box(node, 0.5));
      }
      context.strokeStyle = node.active ? css_color(sequential_color(0.25 + 0.65 * share))
                                        : 'rgb(230 110 104 / 90%)';
      context.lineWidth = node.leaf && node.active ? 1.6 : 0.9;
      context.strokeRect(...box(node, inset));
    }
    context.fillStyle = 'rgb(237 168 97 / 55%)';
    for (const { voxel } of voxels) {
      context.fillRect(...box({ lo: voxel, hi: voxel.map((n) => n + 1) }, 0.5));
    }
    const at = (t) => add(from, scaled(subtract(to, from), t));
    const hits = this.hits(voxels, at);
    const draw_line = (color, width) => {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(x(from[this.u]), y(from[this.v]));
      context.lineTo(x(to[this.u]), y(to[this.v]));
      context.stroke();
    };
    draw_line('rgb(10 14 20 / 70%)', 4);
    draw_line('#ffffff', 1.8);
    const spot = (p, radius, color) => {
      context.fillStyle = color;
      context.strokeStyle = '#10141c';
      context.lineWidth = 1.5;
      context.beginPath();
      context.arc(x(p[this.u]), y(p[this.v]), radius, 0, 7);
      context.fill();
      context.stroke();
    };
    for (const end of [from, to]) spot(end, 6.5, '#ffffff');
    for (const t of hits) spot(at(t), 4.5, '#d6246e');
    const pruned = nodes.filter((n) => !n.active).length;
    const leaves = nodes.filter((n) => n.leaf && n.active).length;
    this.note.textContent =
      `The ray visits ${nodes.length} of ${grouped(tree.node_count)} nodes: ${pruned} are left at ` +
      `once (red: all of it on one side of the isovalue), ${leaves} are leaves it walks through. ` +
      `${counted(voxels.length, 'active voxel', 'active voxels')}, ${counted(hits.length, 'hit', 'hits')}. ` +
      'Drag the ends.';
    this.draw_in_space(nodes, from, to, hits.map(at));
  }

  // Where the interpolant along the ray is the isovalue, within the active voxels.
  hits(voxels, at) {
    const value = (t) => this.samples.value(this.samples.to_place(at(t))) - this.isovalue;
    const found = [];
    for (const { t0, t1 } of voxels) {
      const kParts = 8;
      for (let n = 0; n < kParts; ++n) {
        let lo = t0 + (t1 - t0) * n / kParts, hi = t0 + (t1 - t0) * (n + 1) / kParts;
        const begins_inside = value(lo) >= 0;
        if (begins_inside === (value(hi) >= 0)) continue;
        for (let step = 0; step < 40; ++step) {
          const middle = (lo + hi) / 2;
          if ((value(middle) >= 0) === begins_inside) lo = middle;
          else hi = middle;
        }
        found.push(lo);
      }
    }
    return found;
  }

  draw_in_space(nodes, from, to, hits) {
    if (!this.in_space.input.checked) return;
    const { lines, samples } = this;
    const place = (u) => samples.to_place(u);
    const last = samples.dims.map((n) => n - 1);
    const corners = [[0, 0], [last[this.u], 0], [last[this.u], last[this.v]], [0, last[this.v]]]
      .map((corner) => place(this.indices(corner)));
    corners.forEach((p, n) => lines.add(p, corners[(n + 1) % 4], style_color('--focus'), 1.5));
    for (const node of nodes) {
      if (node.leaf || !node.active) {
        lines.add_box(place(node.lo), place(node.hi), node.active ? 0x0b90b1 : 0xd6605c,
                      node.active ? 1.2 : 0.7);
      }
    }
    lines.add(place(from), place(to), style_color('--ink'), 2.5);
    const size = 0.012 * length_of(subtract(place(last), place([0, 0, 0])));
    for (const hit of hits) {
      const p = place(hit);
      for (const axis of [[size, 0, 0], [0, size, 0], [0, 0, size]]) {
        lines.add(subtract(p, axis), add(p, axis), 0xd6246e, 3);
      }
    }
  }
}
