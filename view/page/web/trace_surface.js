'use strict';
// The surface of a trace at the present step. A facet's color stands for what made it. Facets that come
// or go have colors of their own.

const kColorsOfSurface = [['side', 'side of the surface'], ['routine', 'routine that made it'],
                          ['reason', 'criterion that made it'], ['age', 'age'],
                          ['component', 'component']];

const legend_row = ({ color, label, dash }) => [color, label, dash];

class TraceSurface {
  constructor(trace, points) {
    this.trace = trace;
    this.history = new FacetHistory(trace);
    this.layer = new FacetLayer(points, { edge_width: kEdgeWidth });
    this.live = new LiveFacets(trace, this.history, (slot, id) => this.write(slot, id));
    this.color_by = 'side';
    this.components = null;
    this.marked = [];  // facets with a color of the event
  }

  // The paint of a facet, without what the event does to it.
  paint_of(id) {
    const { trace } = this;
    const e = this.history.birth[id];
    switch (this.color_by) {
      case 'routine': return trace.routine_style(trace.arrays.event_routine[e]).color;
      case 'reason': return trace.reason_style(trace.arrays.event_reason?.[e] ?? 0).color;
      case 'age': return kSides | Math.min(e, 0xffffff);
      case 'component': return this.components?.color(this.history.corners[3 * id]) ?? kSides;
      default: return kSides;
    }
  }

  write(slot, id) {
    const { corners } = this.history;
    this.layer.set(slot, corners[3 * id], corners[3 * id + 1], corners[3 * id + 2],
                   this.color_by === 'component' ? kSides : this.paint_of(id));
  }

  // As it is before event e, or after it; `marks`: which of what comes and goes has its color.
  show(e, after, marks) {
    const { trace, layer, live } = this;
    for (const id of this.marked) {
      if (live.slot[id] >= 0) layer.set_paint(live.slot[id], this.paint_of(id));
    }
    this.marked.length = 0;
    live.go_to(trace.count === 0 ? 0 : after ? e + 1 : e);
    layer.count = live.count;
    layer.age = this.color_by === 'age' ? { step: e, span: Math.max(50, e) } : null;
    if (this.color_by === 'component') this.paint_components();
    const key = after ? 'came' : 'went', name = after ? 'added' : 'removed';
    if (trace.count === 0 || !marks[key]) return;
    for (let n = trace.begin(name, e); n < trace.begin(name, e + 1); ++n) {
      const id = after ? n : this.history.removed[n];
      if (id < 0 || live.slot[id] < 0) continue;
      this.marked.push(id);
      layer.set_paint(live.slot[id], mixed(kMarks[key].color, 0xffffff, 0.35));
    }
  }

  set_color_by(what) {
    this.color_by = what;
    this.components = null;
    this.marked.length = 0;
    for (let slot = 0; slot < this.live.count; ++slot) {
      this.layer.set_paint(slot, this.paint_of(this.live.ids[slot]));
    }
  }

  paint_components() {
    const { live, history, layer } = this;
    this.components = new Components(this.trace.points.length / 3);
    for (let slot = 0; slot < live.count; ++slot) this.components.add(history.corners, live.ids[slot]);
    for (let slot = 0; slot < live.count; ++slot) {
      layer.set_paint(slot, this.paint_of(live.ids[slot]));
    }
  }

  // A color, what it stands for, and a dash.
  legend() {
    const { trace } = this;
    switch (this.color_by) {
      case 'routine':
        return trace.routines_used.map((n) => trace.routine_style(n)).map(legend_row);
      case 'reason':
        return trace.reasons_used.map((n) => trace.reason_style(n)).map(legend_row);
      case 'age':
        return [[sequential_color(1), 'new'], [sequential_color(0.5), 'half way back'],
                [sequential_color(0), 'from the beginning']];
      case 'side':
        return [[kOutside, 'below the isovalue'], [kInside, 'above it']];
      default:
        return [];
    }
  }

  // Returns the id of the facet that a ray meets first, and how far it is, in multiples of the
  // direction. Returns -1 and Infinity if the ray meets none.
  nearest(origin, direction) {
    const { live, history } = this;
    const { points } = this.trace;
    let distance = Infinity, id = -1;
    for (let slot = 0; slot < live.count; ++slot) {
      const at = 3 * live.ids[slot];
      const t = ray_meets_triangle(origin, direction, point_at(points, history.corners[at]),
                                   point_at(points, history.corners[at + 1]),
                                   point_at(points, history.corners[at + 2]));
      if (t < distance) {
        distance = t;
        id = live.ids[slot];
      }
    }
    return { id, distance };
  }
}
