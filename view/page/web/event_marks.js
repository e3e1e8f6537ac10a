'use strict';
// What is drawn of one event over the surface: the point and what called for it, the conflict zone
// or the cavity, and the Voronoi edge with its hits. Also the cone, the surface ball, and the
// facets that came and went. Each kind of thing has a color and a switch of its own; colors are seen on
// light and on dark ground.

const kMarks = {
  point: { label: 'Point', color: 0x7a5cc9 },
  caller: { label: 'What called for it', color: 0xffc233 },
  edge: { label: 'Voronoi edge and its hits', color: 0x0b90b1 },
  ball: { label: 'Surface ball', color: 0x3f76bd },
  zone: { label: 'Conflict zone', color: 0x7b9fd6 },
  star: { label: 'Disk looked at (D_q or E), its boundary', color: 0xa0622d },
  cone: { label: 'Cone D that was refused', color: 0x4361ee, dash: 'dashed' },
  came: { label: 'Facets that come', color: 0x1d74d8 },
  went: { label: 'Facets that go', color: 0xf08a24, dash: 'dashed' },
};

const kRefusedPoint = { label: 'Point that was refused', color: kMarks.went.color };
const kCulprit = { label: 'Dual line or edge that refuses it', color: 0xd1345b };

// The edges that one of these triangles alone has: pairs of vertices.
function boundary_of(triangles) {
  const edges = new Map();
  for (let n = 0; n < triangles.length; n += 3) {
    for (let i = 0; i < 3; ++i) {
      const a = triangles[n + i], b = triangles[n + (i + 1) % 3];
      const key = Math.min(a, b) + ' ' + Math.max(a, b);
      edges.set(key, edges.has(key) ? null : [a, b]);
    }
  }
  return [...edges.values()].filter((edge) => edge !== null);
}

class EventMarks {
  constructor(trace) {
    this.trace = trace;
    this.on = {};
    this.fills = {};
    for (const key of ['caller', 'zone', 'star', 'cone', 'came', 'went']) {
      this.fills[key] = new FacetLayer(new Texels(true), {
        opacity: { zone: 0.22, came: 0.0, went: 0.3 }[key] ?? 0.55, ghost: key === 'zone' ? 0.25 : 0.3,
        edge_width: key === 'zone' ? 1 : 0, clipped: false });
    }
    this.lines = {};
    for (const key of ['caller', 'edge', 'ball', 'star', 'cone', 'came', 'went']) {
      this.lines[key] = new LineLayer({ ghost: key === 'ball' ? 0.2 : 0.35, clipped: false });
    }
    this.dots = { edge: new DotLayer({ ghost: 0.4, clipped: false }),
                  point: new DotLayer({ ghost: 0.5, clipped: false, pull: 1.2e-3 }) };
    for (const key of Object.keys(kMarks)) this.on[key] = true;
    this.layers = [...Object.values(this.fills), ...Object.values(this.lines),
                   ...Object.values(this.dots)];
    this.box = null;            // around what is marked, but for the zone and the Voronoi edge
    this.normal = [0, 0, 0];    // of the facets there, on average
  }

  switch_on(key, on) {
    this.on[key] = on;
    for (const group of [this.fills, this.lines, this.dots]) if (group[key]) group[key].visible = on;
  }

  // after: the surface is shown as the event leaves it.
  show(e, after) {
    const { trace } = this;
    this.box = empty_box();
    this.normal = [0, 0, 0];
    for (const layer of this.layers) layer.count = 0;
    if (trace.count === 0) return;
    const place = trace.place(e);
    const point = (v) => v === kNone && place ? Array.from(place) : this.look_up(v);
    this.show_caller(trace.caller(e).map(point));
    this.show_edge(e);
    const ball = trace.ball(e);
    if (ball) this.show_ball(Array.from(ball));
    if (place) {
      this.dots.point.add(place, this.mark('point', e).color, 13);
      extend_box(this.box, ...place);
    }
    this.show_zone(trace.items('zone', e));
    const star = trace.items('star', e);
    this.show_facets('star', star, point, 0);
    // In Stage 2 the disk E of a point that came is what went.
    const went = trace.stage(e) === 2 && this.is_small(e) ? trace.items('removed', e) : [];
    for (const [a, b] of boundary_of(star.length > 0 ? star : went)) {
      this.lines.star.add(point(a), point(b), kMarks.star.color, 3);
    }
    this.show_facets('cone', trace.items('cone', e), point, 1.5);
    // Of what comes and goes, that is drawn over the surface which is not in it.
    if (this.is_small(e)) {
      const gone = after ? 'went' : 'came', there = after ? 'came' : 'went';
      const list = (key) => trace.items(key === 'came' ? 'added' : 'removed', e);
      this.show_facets(gone, list(gone), point, 1.5, false);
      this.show_facets(there, list(there), point, 1.8, false);
    }
    if (!(this.box.lo[0] <= this.box.hi[0])) this.box = null;
    this.normal = unit(this.normal);
  }

  // Marks that this event has and that are switched on.
  shown(e) {
    const there = (key) => key === 'caller' ? this.trace.count > 0 && this.trace.caller(e).length > 0 :
      [this.fills, this.lines, this.dots].some((group) => group[key]?.count > 0);
    return Object.entries(kMarks).filter(([key]) => this.on[key] && there(key))
      .map(([key]) => this.mark(key, e));
  }
  mark(key, e) {
    if (!this.trace.refused(e)) return kMarks[key];
    return key === 'point' ? kRefusedPoint : key === 'edge' && this.trace.stage(e) === 2 ? kCulprit : kMarks[key];
  }

  // Whether so little changes that it can be pointed at.
  is_small(e) {
    const { trace } = this;
    return trace.size('added', e) + trace.size('removed', e) < 400 && e !== trace.switch_at && e > 0;
  }

  look_up(v) {
    const { points } = this.trace;
    return 3 * v + 2 < points.length ? point_at(points, v) : [NaN, NaN, NaN];
  }

  // A triangle of points of its own, so that points need not be trace vertices.
  add_fill(layer, corners, color) {
    const at = 3 * layer.count;
    layer.points.reserve(at + 3);
    corners.forEach((p, i) => {
      layer.points.data.set(p, 4 * (at + i));
      layer.points.touch(at + i);
    });
    layer.set(layer.count++, at, at + 1, at + 2, color);
  }

  show_facets(key, triangles, point, width, fill = true) {
    const { color } = kMarks[key];
    for (let n = 0; n < triangles.length; n += 3) {
      const corners = [0, 1, 2].map((i) => point(triangles[n + i]));
      if (fill) this.add_fill(this.fills[key], corners, color);
      corners.forEach((p) => extend_box(this.box, ...p));
      this.normal = add(this.normal, cross(subtract(corners[1], corners[0]),
                                           subtract(corners[2], corners[0])));
      if (width > 0 && kMarks[key].dash) {
        corners.forEach((p, i) => this.lines[key].add_dashed(p, corners[(i + 1) % 3], color, width));
      } else if (width > 0) {
        this.lines[key].add_triangle(...corners, color, width);
      }
    }
  }

  show_caller(corners) {
    const { color } = kMarks.caller;
    corners.forEach((p) => extend_box(this.box, ...p));
    if (corners.length === 3) {
      this.normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
      this.add_fill(this.fills.caller, corners, color);
      this.lines.caller.add_triangle(...corners, color, 3);
    } else if (corners.length === 2) {
      this.lines.caller.add(...corners, color, 4);
    } else if (corners.length === 1) {
      this.dots.point.add(corners[0], color, 11);
    }
  }

  show_edge(e) {
    const edge = this.trace.edge(e);
    if (edge) {
      this.lines.edge.add(edge.subarray(0, 3), edge.subarray(3, 6), this.mark('edge', e).color, 3);
    }
    const hits = this.trace.items('hits', e);
    for (let n = 0; n < hits.length; n += 3) {
      const hit = hits.subarray(n, n + 3);
      this.dots.edge.add(hit, kMarks.edge.color, 9);
    }
  }

  show_ball([x, y, z, radius]) {
    if (!(radius > 0)) return;
    const center = [x, y, z];
    const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for (let n = 0; n < 3; ++n) {
      this.lines.ball.add_circle(center, axes[n], axes[(n + 1) % 3], radius, kMarks.ball.color, 1.3);
    }
  }

  // Tetrahedra, shrunk towards their middles so that they can be told apart.
  show_zone(tetrahedra) {
    add_shrunk(tetrahedra, (v) => this.look_up(v), 0.84, (corners) => {
      this.add_fill(this.fills.zone, corners, kMarks.zone.color);
    });
  }
}

// Calls add(corners) for the four facets of each tetrahedron, counter-clockwise from outside.
function add_shrunk(tetrahedra, point, size, add_facet) {
  for (let n = 0; n + 3 < tetrahedra.length; n += 4) {
    const corners = [0, 1, 2, 3].map((i) => point(tetrahedra[n + i]));
    const middle = scaled(corners.reduce(add), 0.25);
    const at = corners.map((p) => add(scaled(p, size), scaled(middle, 1 - size)));
    const turned = dot(cross(subtract(at[1], at[0]), subtract(at[2], at[0])),
                       subtract(at[3], at[0])) > 0;
    for (const [a, b, c] of [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]) {
      add_facet(turned ? [at[a], at[c], at[b]] : [at[a], at[b], at[c]]);
    }
  }
}
