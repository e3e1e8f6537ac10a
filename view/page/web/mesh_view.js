'use strict';
// The page of `deliso view`: one finished mesh, or two side by side with one camera. It has
// histograms that highlight what is brushed, components, and a clipping plane.

class MeshView {
  constructor(scene, { header, arrays }) {
    this.scene = scene;
    this.header = header;
    this.meshes = header.meshes.map((about, n) => this.read_mesh(about, arrays, n));
    this.color_by = 'side';
    this.hidden = new Set();   // components
    const box = empty_box();
    for (const mesh of this.meshes) {
      extend_box(box, ...mesh.box.lo);
      extend_box(box, ...mesh.box.hi);
    }
    this.box = box;
    scene.panes = this.meshes.map((mesh) =>
      ({ layers: [mesh.layer, mesh.mark], caption: '', clip: null }));
    scene.camera.set_scene(box, this.meshes.map((mesh) => points_named(mesh.points, mesh.framed)));
    scene.before_draw = () => this.stale && this.paint_now();
    scene.on_pick = (ray, pane, twice) => this.pick(ray, pane, twice);
    this.build_panel(document.getElementById('panel'));
    this.paint();
    this.show_captions();
    scene.fit(false);
    this.address = new Address(scene, document.getElementById('panel'), [
      { name: 'components', get: () => components_text(this.hidden, this.component_count),
        set: (text) => this.hide(hidden_components(text, this.component_count)) },
      ...this.histograms.map(brush_word)]);
    document.getElementById('title').textContent = this.meshes.map((mesh) => mesh.about.name).join(' | ');
    document.getElementById('subtitle').textContent = header.volume
      ? `measured against ${header.volume} at ${rounded(header.iso)}` : '';
  }

  read_mesh(about, arrays, n) {
    const points = arrays['points' + n] ?? new Float32Array(0);
    const all = arrays['triangles' + n] ?? new Uint32Array(0);
    // A page that was cut off may name points that it does not have.
    const triangles = complete_triangles(all, points.length / 3);
    const count = triangles.length / 3;
    const component = arrays['component' + n]?.length >= count ? arrays['component' + n]
                                                              : new Uint32Array(count);
    const mesh = { about, points, triangles, component, count,
                   box: box_of_points(points, triangles), ...measure_triangles(points, triangles) };
    if (arrays['h' + n]?.length >= count && arrays['h' + n].length > 0) mesh.h = arrays['h' + n];
    if (this.header.voxel) mesh.radius = mesh.radius.map((r) => r / this.header.voxel);
    mesh.framed = triangles_of_most_area(mesh.area, component, triangles);
    mesh.sizes = [];
    for (const c of component) mesh.sizes[c] = (mesh.sizes[c] ?? 0) + 1;
    mesh.layer = new FacetLayer(texels_of_points(points), { edge_width: kEdgeWidth });
    mesh.layer.set_all(triangles, () => kSides);
    mesh.smooth_normals = vertex_normals(points, triangles);
    mesh.layer.normals = mesh.smooth_normals;
    mesh.mark = new LineLayer({ ghost: 0.35 });
    return mesh;
  }

  // What is known of every triangle, each with a scale that a few outliers do not set.
  measures() {
    const of = (key) => this.meshes.map((mesh) => mesh[key]);
    const list = [{ key: 'angle', name: 'Smallest angle', unit: '\u00b0', lo: 0, hi: 60, open: false },
                  { key: 'r_over_l', name: 'r / l', unit: '', lo: 0.5,
                    hi: clamp(round_up(quantile(of('r_over_l'), 0.999)), 2, 4), open: true },
                  { key: 'radius', name: this.header.voxel ? 'Circumradius (voxels)' : 'Circumradius',
                    unit: '', lo: 0,
                    hi: round_up(quantile(of('radius'), 0.999)), open: true }];
    if (this.meshes.every((mesh) => mesh.h)) {
      list.splice(2, 0, { key: 'h', name: 'Distance (voxels)', unit: '', lo: 0,
                          hi: round_up(quantile(of('h'), 0.995)), open: true });
    }
    return list.map((measure) => ({ ...measure, values: of(measure.key) }));
  }

  build_panel(panel) {
    this.histograms = this.measures().map((measure) => {
      const histogram = new Histogram(measure, () => this.paint());
      histogram.key = measure.key;
      return histogram;
    });
    const { scene } = this;
    const each = (act) => {
      for (const mesh of this.meshes) act(mesh);
      scene.invalidate();
    };
    const colors = [['side', 'side of the surface'], ['component', 'component'],
                    ...this.histograms.map((h) => [h.key, h.measure.name.toLowerCase()])];
    this.color_choice = choice('Color by', colors, this.color_by, (value) => {
      this.color_by = value;
      this.paint();
    });
    this.share_note = element('p', { class: 'note', 'aria-live': 'polite' });
    const hint = element('p', { class: 'hint' }, 'Drag over the bars to see where such triangles are.');
    const marks = this.meshes.length < 2 ? [] :
      [element('ul', { class: 'legend' }, ...this.meshes.map(({ about }, n) =>
        element('li', {}, element('span', { class: n === 0 ? 'swatch bars' : 'swatch line' }),
                `${kMarksOfMeshes[n]}: ${about.name}`)))];
    this.legend = element('ul', { class: 'legend' });
    panel.append(
      section('Look', true, this.color_choice, this.legend,
              choice('Shading', [['smooth', 'smooth'], ['flat', 'flat']], 'smooth',
                     (value) => each((mesh) => {
                       mesh.layer.normals = value === 'smooth' ? mesh.smooth_normals : null;
                     })),
              choice('Edges', [['on', 'on the surface'], ['off', 'off'], ['wires', 'wireframe']], 'on',
                     (value) => each(({ layer }) => {
                       layer.edge_width = value === 'off' ? 0 : kEdgeWidth;
                       layer.wires = value === 'wires';
                     })),
              button('Save a picture', 'Save the view as a PNG file (P)', () => this.save())),
      section('Triangles', true, hint, ...marks, ...this.histograms.map((h) => h.element), this.share_note),
      new ClipPlane(scene, this.box).element,
      section('Components', false, this.component_list()));
  }

  get component_count() { return Math.max(...this.meshes.map((mesh) => mesh.sizes.length), 0); }

  hide(components) {
    this.hidden = components;
    this.rows.forEach((row, n) => { row.querySelector('input').checked = !components.has(n); });
    this.paint();
  }

  component_list() {
    const kMost = 60;
    const count = this.component_count;
    this.rows = [];
    for (let c = 0; c < Math.min(count, kMost); ++c) {
      const sizes = this.meshes.map((mesh) => grouped(mesh.sizes[c] ?? 0)).join(' | ');
      const shown = toggle(`${c + 1}: ${sizes}`, true, (on) => {
        if (on) this.hidden.delete(c);
        else this.hidden.add(c);
        this.paint();
      }, kind_color(c));
      const alone = button('only', `Show component ${c + 1} alone`, () => {
        const was_alone = this.hidden.size === count - 1 && !this.hidden.has(c);
        this.hide(hidden_components(was_alone ? '' : String(c + 1), count));
      });
      alone.setAttribute('aria-label', `only component ${c + 1}`);
      shown.input.dataset.own = '';
      this.rows.push(element('li', {}, shown, alone));
    }
    const rest = count > kMost ? [element('p', { class: 'hint' },
                                          `and ${grouped(count - kMost)} smaller ones`)] : [];
    return element('div', {},
                   element('p', { class: 'hint' },
                           count === 0 ? 'There are no triangles.' : 'By triangles, the largest first.'),
                   element('ul', { class: 'list' }, ...this.rows), ...rest);
  }

  // Every triangle's color anew, once before the next picture.
  paint() {
    this.stale = true;
    this.scene.invalidate();
  }
  paint_now() {
    this.stale = false;
    const colored = this.histograms.find((h) => h.key === this.color_by);
    const brushed = this.histograms.filter((h) => h.brush);
    for (const h of this.histograms) {
      if (h.colored !== (h === colored)) {
        h.colored = h === colored;
        h.draw();
      }
    }
    const accent = style_color('--accent'), dim = style_color('--dim');
    const shares = this.meshes.map((mesh) => {
      let chosen = 0;
      for (let n = 0; n < mesh.count; ++n) {
        const c = mesh.component[n];
        let paint = kSides;
        if (colored) {
          const { lo, hi } = colored.measure;
          paint = sequential_color((mesh[colored.key][n] - lo) / (hi - lo));
        } else if (this.color_by === 'component') {
          paint = kind_color(c);
        }
        if (brushed.length > 0) {
          if (!brushed.every((h) => h.holds(mesh[h.key][n]))) {
            paint = dim;
          } else {
            ++chosen;
            if (paint === kSides) paint = accent;
          }
        }
        mesh.layer.set_paint(n, this.hidden.has(c) ? kHidden : paint);
      }
      return `${grouped(chosen)} of ${counted(mesh.count, 'triangle', 'triangles')}`;
    });
    this.legend.replaceChildren(...legend_of(this.color_by, colored?.measure, brushed.length > 0)
      .map(([color, text]) => element('li', {}, element('span', { class: 'swatch', style:
        `background:${css_color(color)}` }), text)));
    this.share_note.textContent = brushed.length > 0 ? `Brushed: ${shares.join(' | ')}` : '';
  }

  show_captions() {
    this.scene.panes.forEach((pane, n) => {
      const { about, count } = this.meshes[n];
      pane.caption = `${about.name}: ${counted(count, 'triangle', 'triangles')}, ` +
                     counted(about.vertices, 'vertex', 'vertices');
      if (this.meshes.length > 1) pane.caption += ` (${kMarksOfMeshes[n]})`;
    });
    this.scene.show_captions();
  }

  save() {
    const colored = this.histograms.find((h) => h.key === this.color_by);
    save_picture(this.scene, legend_of(this.color_by, colored?.measure,
                                       this.histograms.some((h) => h.brush)),
                 this.meshes.map((mesh) => mesh.about.name.replace(/\.[^.]*$/, '')).join('-') + '.png');
  }

  // A click tells of a triangle; a double one makes it the middle of the view.
  pick({ origin, direction }, pane, twice) {
    const mesh = this.meshes[pane];
    const { points, triangles } = mesh;
    const plane = this.scene.panes[pane].clip;
    let nearest = Infinity, found = -1;
    for (let n = 0; n < mesh.count; ++n) {
      if (this.hidden.has(mesh.component[n])) continue;
      const t = ray_meets_triangle(origin, direction, point_at(points, triangles[3 * n]),
                                   point_at(points, triangles[3 * n + 1]),
                                   point_at(points, triangles[3 * n + 2]));
      if (t >= nearest) continue;
      if (plane && dot(plane, add(origin, scaled(direction, t))) > plane[3]) continue;
      nearest = t;
      found = n;
    }
    for (const { mark } of this.meshes) mark.clear();
    const readout = document.getElementById('readout');
    if (found < 0) {
      readout.textContent = '';
    } else {
      const corners = [0, 1, 2].map((i) => triangles[3 * found + i]);
      mesh.mark.add_triangle(...corners.map((v) => point_at(points, v)), style_color('--accent'), 3);
      const values = this.histograms.map((h) =>
        `${h.measure.name.toLowerCase()} ${rounded(mesh[h.key][found])}${h.measure.unit}`);
      const place = add(this.header.origin, add(origin, scaled(direction, nearest)));
      readout.textContent = `Triangle ${grouped(found)} (vertices ${corners.join(', ')}), component ` +
                            `${mesh.component[found] + 1}: ${values.join(', ')}; at ` +
                            `(${place.map(rounded).join(', ')}) ${mesh.about.space}`;
      if (twice) this.scene.camera.glide_to({ target: add(origin, scaled(direction, nearest)) });
    }
    this.scene.invalidate();
  }

  keys() {
    const { scene } = this;
    const next_color = () => {
      const { select } = this.color_choice;
      select.selectedIndex = (select.selectedIndex + 1) % select.length;
      select.dispatchEvent(new Event('change'));
    };
    return { f: () => scene.fit(), c: next_color, p: () => this.save(),
             Escape: () => this.histograms.forEach((h) => h.brush && h.set(null)) };
  }

  theme_changed() {
    this.histograms.forEach((h) => h.draw());
    this.paint();
  }

  static help() {
    return ['View', [['C', 'next color'], ['P', 'save a picture'], ['Esc', 'clear what is brushed']]];
  }
}

// Without points of no triangle, which may lie anywhere.
function points_named(points, triangles) {
  const named = new Uint8Array(points.length / 3);
  for (const v of triangles) named[v] = 1;
  return points.filter((_, n) => named[Math.floor(n / 3)]);
}

// Components by their numbers from 1: those that are shown or, behind a minus, those hidden,
// whichever are fewer; nothing where all are shown.
function components_text(hidden, count) {
  if (hidden.size === 0) return '';
  const few = 0 < count - hidden.size && count - hidden.size < hidden.size;
  const numbers = Array.from({ length: count }, (_, c) => c).filter((c) => hidden.has(c) !== few);
  return (few ? '' : '-') + numbers.map((c) => c + 1).join(',');
}
function hidden_components(text, count) {
  const minus = text.startsWith('-');
  const named = new Set(text.slice(Number(minus)).split(',').map((number) => number - 1));
  const hidden = Array.from({ length: count }, (_, c) => c).filter((c) => named.has(c) === minus);
  return new Set(minus || hidden.length < count ? hidden : []);  // a list of none is no list
}

// How histograms draw the first mesh, and the second.
const kMarksOfMeshes = ['bars', 'line'];

// Pairs of a color and what it stands for. Values beyond an open scale's end have the end's color.
function legend_of(color_by, measure, brushed) {
  const others = brushed ? [[style_color('--dim'), 'not brushed']] : [];
  if (measure) {
    const { name, unit, lo, hi, open } = measure;
    return [0, 0.25, 0.5, 0.75, 1].map((share) =>
      [sequential_color(share), (share === 0 ? `${name.toLowerCase()}: ` : '') +
       rounded(lo + share * (hi - lo)) + unit + (share === 1 && open ? ' or more' : '')])
      .concat(others);
  }
  if (brushed) return (color_by === 'side' ? [[style_color('--accent'), 'brushed']] : []).concat(others);
  return color_by === 'side' ? [[kOutside, 'field below the isovalue'], [kInside, 'above it']] : [];
}

MeshView.intro = [
  'Histograms of what the triangles are like: drag over the bars, and the triangles that are so stand ' +
  'out on the mesh. A click on the mesh tells of a triangle, a double one makes the place the middle ' +
  'of the view. The address of the page keeps the view: a link with it opens the same.'];

// The triangles up to the first that names a point beyond `count`.
function complete_triangles(triangles, count) {
  const end = triangles.findIndex((v) => v >= count);
  const whole = Math.floor((end < 0 ? triangles.length : end) / 3);
  return triangles.subarray(0, 3 * whole);
}
