'use strict';
// The page of `deliso trace`: one run of both stages, event by event.

const kPointColor = 0x7a8aa3;

const legend_item = ([color, text, dash = 'solid']) =>
  element('li', {}, element('span', { class: `swatch ${dash}`, style: `--swatch:${css_color(color)}` }), text);

class TraceView {
  constructor(scene, data) {
    this.scene = scene;
    this.trace = new Trace(data);
    this.samples = new Samples(data);
    const { trace } = this;
    this.points = texels_of_points(trace.points);
    this.after = true;
    this.follow = false;
    this.both = false;             // both structures side by side
    this.surface_style = 'auto';
    this.regions_on = true;
    this.surface = new TraceSurface(trace, this.points);
    this.marks = new EventMarks(trace);
    this.vertices = this.make_vertices();
    this.regions = trace.arrays.contour_triangles ? new Regions(trace) : null;
    this.tetrahedra = new SwitchTetrahedra(trace, this.surface.history);
    this.frame = new LineLayer();
    this.slice_lines = new LineLayer({ ghost: 0.4, clipped: false });
    const { box } = trace.header;
    this.box = box ? { lo: box.slice(0, 3), hi: box.slice(3) } : box_of_points(trace.points);
    const layers = [this.surface.layer, ...(this.regions ? [this.regions.layer] : []), this.frame,
                    this.vertices, this.slice_lines, ...this.marks.layers];
    this.main_pane = { layers, caption: '', clip: null };
    this.tetrahedra_pane = { layers: [this.tetrahedra.layer, this.frame], caption: '', clip: null };
    scene.panes = [this.main_pane];
    scene.arrows_step = true;
    // What is to be seen is the surface; the box may be far larger.
    scene.camera.set_scene(trace.points.length > 0 ? box_of_points(trace.points) : this.box);
    scene.camera.radius = Math.max(scene.camera.radius, box_radius(this.box));
    scene.fit(false);
    scene.on_pick = (ray, pane, twice) => this.pick(ray, twice);

    this.telling = element('div', { class: 'telling', 'aria-live': 'polite' });
    this.build_panel(document.getElementById('panel'));
    const place = document.getElementById('timeline');
    place.hidden = false;
    this.timeline = new Timeline(place, trace, (e) => this.show(e));
    this.show_legend();
    this.show_title();
    this.draw_frame();
    this.timeline.show(trace.count - 1);
    scene.fit(false);
    this.follow = true;
    this.tour = new Tour(document.getElementById('tour'), trace, (stop, n) => this.show_stop(stop, n),
                         () => this.end_tour());
    show_terms_of(document.body);
  }

  show_title() {
    const { header } = this.trace;
    document.getElementById('title').textContent = (header.input ?? 'Trace').replace(/^.*\//, '');
    const parts = [`isovalue ${rounded(header.isovalue)}`,
                   header.program === 'published' ? 'the published program' : 'the exact program'];
    if (header.truncated) {
      parts.push(`the first ${grouped(this.trace.count)} of ${grouped(header.events_seen)} events`);
    }
    document.getElementById('subtitle').textContent = parts.join(', ');
  }

  show(e) {
    this.event = e;
    const { trace, marks } = this;
    marks.show(e, this.after);
    const small = trace.count > 0 && marks.is_small(e);
    this.surface.show(e, this.after, small ? marks.on : {});
    this.vertices.count = Math.min(trace.vertices[Math.min(e + 1, trace.count)] ?? 0,
                                   trace.points.length / 3);
    this.regions?.go_to(this.after ? e + 1 : e);
    const caller = marks.on.caller && trace.count > 0 ? trace.caller(e) : [];
    this.regions?.point_out(caller.length === 1 ? caller[0] : kNone);
    this.arrange_surface();
    this.arrange_panes(e);
    this.telling.setAttribute('aria-live', this.timeline?.playing ? 'off' : 'polite');
    this.tell(e);
    this.numbers.show(e);
    // Of quick play, the eye could not follow.
    if (this.follow && !(this.timeline?.playing && this.timeline.stay(e) < 1 / 15)) this.zoom_to_step();
    this.show_canvas_legend();
    this.scene.invalidate();
  }

  show_stop(stop, n) {
    this.timeline.play(false);
    this.vertices.visible = n === 0;
    this.timeline.show(stop.event);
    if (stop.whole) this.scene.fit();
    else this.zoom_to_step();
  }

  end_tour() {
    this.vertices.visible = false;
    this.show_canvas_legend();
    this.scene.invalidate();
  }

  show_legend() {
    this.legend.replaceChildren(...this.surface.legend().map(legend_item));
  }

  // Just what this step shows.
  show_canvas_legend() {
    const regions = this.regions?.layer.visible;
    document.getElementById('canvas-legend').replaceChildren(
      ...(regions ? [] : this.surface.legend().slice(0, 6)).map(legend_item),
      ...(regions ? [element('li', {}, 'one tone for each region of T')] : []),
      ...(this.vertices.visible ? [legend_item([kPointColor, 'points so far'])] : []),
      ...this.marks.shown(this.event).map(legend_row).map(legend_item));
  }

  // Side by side at the switch, or where that is asked for.
  arrange_panes(e) {
    const wanted = this.tetrahedra.there && (this.both || e === this.trace.switch_at);
    if (wanted) this.tetrahedra.make();
    const { scene } = this;
    this.main_pane.caption = wanted ? (e >= this.trace.switch_at ? 'the plain mesh' : 'the surface') : '';
    this.tetrahedra_pane.caption = 'Del S: its tetrahedra inside the surface';
    if (wanted === (scene.panes.length === 2)) return;
    scene.panes = wanted ? [this.tetrahedra_pane, this.main_pane] : [this.main_pane];
    scene.show_captions();
    this.clip.apply();
  }

  tell(e) {
    if (this.trace.count === 0) {
      this.telling.replaceChildren(element('p', {}, 'The trace has no events.'));
      return;
    }
    const { title, where, lines } = tell_event(this.trace, e);
    const outcome = this.trace.refused(e) ? [element('span', { class: 'badge refused' }, 'refused')] : [];
    this.telling.replaceChildren(
      element('p', { class: 'where' }, where),
      element('h2', {}, element('span', { class: 'swatch', style:
        `background:${css_color(this.trace.routine_style(this.trace.arrays.event_routine[e]).color)}` }),
              title, ...outcome),
      ...lines.map(([kind, text, heading]) =>
        element('p', { class: kind }, ...(heading ? [element('strong', {}, heading)] : []), ...with_terms(text))));
  }

  zoom_to_step() {
    const { box, normal } = this.marks;
    if (!box) {
      this.scene.fit();
      return;
    }
    const { camera, aspect } = this.scene;
    const radius = Math.max(box_radius(box), 0.003 * camera.radius);
    const target = box_middle(box);
    const distance = 1.7 * radius / Math.sin(kHalfAngle) / Math.min(1, aspect);
    // The eye stays on its side where it sees the front of the surface there and nothing is between;
    // else it goes round.
    const tilted = (by) => unit(add(normal, by));
    const sides = [scaled(camera.up, 0.4), scaled(camera.right, 0.7), scaled(camera.right, -0.7),
                   scaled(camera.up, 1), scaled(camera.up, -1)];
    const ways = [camera.back, ...sides.map(tilted), normal];
    const sees = (back) => dot(normal, back) >= 0.4 &&
                           this.surface.nearest(add(target, scaled(back, distance)), scaled(back, -1))
                             .distance > distance - 1.2 * radius;
    const back = (length_of(normal) > 0 && ways.find(sees)) || camera.back;
    camera.glide_to({ target, distance, ...camera.angles_of(back) });
    this.scene.invalidate();
  }

  make_vertices() {
    const layer = new DotLayer({ visible: false });
    const { points } = this.trace;
    for (let n = 0; n < points.length / 3; ++n) layer.add(point_at(points, n), kPointColor, 4);
    return layer;
  }

  draw_frame() {
    this.frame.clear();
    this.frame.add_box(this.box.lo, this.box.hi, style_color('--line'), 1);
  }

  build_panel(panel) {
    this.numbers = new RunningNumbers(this.trace);
    this.clip = new ClipPlane(this.scene, this.box);
    this.legend = element('ul', { class: 'legend' });
    const seen = (layer) => (on) => {
      layer.visible = on;
      this.scene.invalidate();
    };
    const toggles = [
      toggle('Surface', true, seen(this.surface.layer)),
      ...Object.entries(kMarks).filter(([key]) => this.has_marks(key)).map(([key, { label, color }]) =>
        toggle(label, true, (on) => {
          this.marks.switch_on(key, on);
          this.show(this.event);
        }, color)),
      toggle('All points so far', false, seen(this.vertices)),
      toggle('Box of the volume', true, seen(this.frame))];
    if (this.regions) {
      toggles.splice(1, 0, toggle('Regions of T, in Stage 1', true, (on) => {
        this.regions_on = on;
        this.show(this.event);
      }));
    }
    const both = toggle('Tetrahedra of Del S beside it', false, (on) => {
      this.both = on;
      this.show(this.event);
    });
    if (this.tetrahedra.there) toggles.push(both);
    this.after_toggle = toggle('Show the surface after the step', true, (on) => {
      this.after = on;
      this.show(this.event);
    });
    this.follow_toggle = toggle('Follow: go to every step', true, (on) => {
      this.follow = on;
      if (on) this.zoom_to_step();
      else this.scene.fit();
    });
    panel.append(
      element('section', { class: 'section open', 'aria-label': 'This step' },
              element('div', { class: 'content' }, this.telling,
                      element('div', { class: 'row' },
                              button('Go there', 'Zoom to the step (Z)', () => this.zoom_to_step()),
                              button('See all', 'See all (F)', () => this.scene.fit())),
                      this.after_toggle, this.follow_toggle)),
      section('Running numbers', true, this.numbers.element),
      section('Look', true,
              choice('Color by', kColorsOfSurface, 'side', (value) => {
                this.surface.set_color_by(value);
                this.show_legend();
                this.show(this.event);
              }), this.legend,
              choice('Surface', [['auto', 'automatic'], ['solid', 'solid'], ['glass', 'glass'],
                                 ['wires', 'edges only']], 'auto',
                     (value) => this.set_surface_style(value))),
      section('Show', true, ...toggles), this.clip.element);
    if (this.samples.there) {
      this.slice = new SlicePanel(this.samples, this.trace.header.kappa, this.slice_lines,
                                  () => this.scene.invalidate());
      panel.append(this.slice.element);
    } else {
      panel.append(section('Slice and kd-tree (Figure 13)', false, element('p', { class: 'hint' },
        'The page is without the volume, which has too many samples: deliso trace --roi takes a part.')));
    }
  }

  // Whether any event has something of a kind.
  has_marks(key) {
    const { trace } = this;
    const list = { zone: 'zone', star: 'star', cone: 'cone', came: 'added', went: 'removed' }[key];
    if (key === 'star' && trace.switch_at >= 0) return true;
    if (list) return trace.begin(list, trace.count) > 0;
    if (key === 'edge') return trace.arrays.event_edge?.some(Number.isFinite) ?? false;
    if (key === 'ball') return trace.arrays.event_ball?.some(Number.isFinite) ?? false;
    return true;
  }

  // In the certified Stage 1 the regions on T are what is worked on; K's facets, which cut through T, are
  // then their edges.
  arrange_surface() {
    const { regions, trace } = this;
    const surface = this.surface.layer;
    const style = this.surface_style;
    const before = trace.switch_at < 0 || this.event < trace.switch_at;
    if (regions) regions.layer.visible = this.regions_on && before;
    // Colors under the zone are to be told from each other.
    this.marks.fills.zone.opacity = regions?.layer.visible ? 0.1 : 0.22;
    surface.wires = style === 'wires' || (style === 'auto' && Boolean(regions?.layer.visible));
    surface.opacity = style === 'glass' ? 0.35 : 1;
    surface.ghost = surface.wires ? 0.3 : 0;
    surface.edge_width = surface.wires ? 1.8 : kEdgeWidth;
  }

  set_surface_style(value) {
    this.surface_style = value;
    this.arrange_surface();
    this.scene.invalidate();
  }

  // A click tells of a facet of the surface: what made it, and when.
  pick({ origin, direction }, twice) {
    const { trace } = this;
    const { history } = this.surface;
    const { id: found, distance: nearest } = this.surface.nearest(origin, direction);
    const readout = document.getElementById('readout');
    if (found < 0) {
      readout.textContent = '';
      return;
    }
    const corners = [0, 1, 2].map((i) => history.corners[3 * found + i]);
    const e = history.birth[found], reason = trace.reason(e)?.name;
    readout.textContent = `Facet (${corners.join(', ')}): came at event ${grouped(e + 1)}, ` +
                          `${trace.routine(e).name}${reason ? `, ${reason}` : ''}`;
    if (twice) {
      this.scene.camera.glide_to({ target: add(origin, scaled(direction, nearest)) });
      this.scene.invalidate();
    }
  }

  keys() {
    const { timeline, scene } = this;
    return { ' ': () => timeline.play(!timeline.playing), ArrowRight: () => this.tour.on ? this.tour.step(1) : timeline.step(1),
             ArrowLeft: () => this.tour.on ? this.tour.step(-1) : timeline.step(-1),
             Escape: () => this.tour.end(), PageDown: () => timeline.step(100),
             PageUp: () => timeline.step(-100), Home: () => timeline.show(0),
             End: () => timeline.show(this.trace.count - 1), n: () => timeline.next_of_kind(1),
             p: () => timeline.next_of_kind(-1), z: () => this.zoom_to_step(), f: () => scene.fit(),
             s: () => this.slice?.turn_open(), b: () => this.after_toggle.input.click(), l: () => this.follow_toggle.input.click() };
  }

  theme_changed() {
    this.draw_frame();
    this.timeline.redraw();
    this.slice?.draw();
  }

  static help() {
    return ['Timeline', [['Space', 'play, stop'], ['Left Right', 'one step; in the tour one stop'],
                         ['Escape', 'leave the tour'],
                         ['PageUp PageDown', 'a hundred steps'], ['Home End', 'first, last'],
                         ['N P', 'next, previous of the kind'], ['Z', 'go to what this step changes'],
                         ['L', 'follow: go to every step'], ['B', 'the surface before, after the step'],
                         ['S', 'a slice of the volume and the kd-tree']]];
  }
}

TraceView.intro = [
  'One run of DelIso, as it went: every step inserts a point, or tries to, and says which routine ' +
  'asked for it and why. Stage 1 coarsens the exact contour, or, as published, works on a Delaunay ' +
  'triangulation of tetrahedra; Stage 2 works on the plain triangle mesh alone. The timeline has a lane ' +
  'for each routine. Click the name of a lane to go to its next event.'];
