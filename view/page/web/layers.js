'use strict';
// Things that a view draws: facets, lines, dots. Each keeps its content in texels and is drawn by
// draw(gl, view), where view has what the camera gives: project, light, size, clip, edge colors.

// Flags of a facet's paint, above its color.
const kSides = 0x01000000;   // the colors of the two sides, or in the age mode of its age
const kHidden = 0x02000000;

const kEdgeWidth = 0.8;      // of facets' edges, in CSS pixels

const kTriangleProgram = new Program(kTriangleVertex, kTriangleFragment);
const kLineProgram = new Program(kLineVertex, kLineFragment);
const kDotProgram = new Program(kDotVertex, kDotFragment);

const kSequenceParts = new Float32Array(kSequence.flatMap(parts_of_color));

// Facets over points that may be others' too. Those from `count` on are not drawn.
class FacetLayer {
  constructor(points, options = {}) {
    this.points = points;              // Texels
    this.facets = new Texels(false);
    this.normals = null;               // Texels, for smooth shading
    this.count = 0;
    this.visible = true;
    this.opacity = 1;
    this.edge_width = 1;
    this.edge_color = null;            // the view's, unless it has its own
    this.wires = false;
    this.ghost = 0;                    // how strongly it is seen through what hides it
    this.clipped = true;
    this.age = null;                   // {step, span}
    this.regions = false;              // points have colors, not facets
    Object.assign(this, options);
  }

  set(n, a, b, c, paint) {
    if (n >= this.facets.capacity) this.facets.reserve(n + 1);
    const { data } = this.facets;
    data[4 * n] = a;
    data[4 * n + 1] = b;
    data[4 * n + 2] = c;
    data[4 * n + 3] = paint;
    this.facets.touch(n);
  }
  set_paint(n, paint) {
    if (this.facets.data[4 * n + 3] === paint) return;
    this.facets.data[4 * n + 3] = paint;
    this.facets.touch(n);
  }
  // triangles: a flat array of corners; paint(n) for each.
  set_all(triangles, paint) {
    const count = triangles.length / 3;
    this.facets.reserve(count);
    for (let n = 0; n < count; ++n) {
      this.set(n, triangles[3 * n], triangles[3 * n + 1], triangles[3 * n + 2], paint(n));
    }
    this.count = count;
  }

  // Nothing of it lets see through.
  get solid() { return this.opacity >= 1 && !this.wires; }

  draw(gl, view) {
    const program = kTriangleProgram;
    program.use(gl);
    const u = program.uniforms;
    const smooth = this.normals !== null;
    gl.uniform1i(u.u_points, 0);
    gl.uniform1i(u.u_normals, 1);
    gl.uniform1i(u.u_facets, 2);
    this.points.bind(gl, 0);
    (smooth ? this.normals : this.points).bind(gl, 1);
    this.facets.bind(gl, 2);
    gl.uniformMatrix4fv(u.u_project, false, view.project);
    gl.uniform1i(u.u_smooth, smooth);
    gl.uniform3fv(u.u_key, view.key);
    gl.uniform3fv(u.u_fill, view.fill);
    gl.uniform3fv(u.u_gloss, view.gloss);
    gl.uniform3fv(u.u_outside, view.outside);
    gl.uniform3fv(u.u_inside, view.inside);
    gl.uniform3fv(u.u_edge_color, this.edge_color ?? view.edge_color);
    gl.uniform3fv(u.u_sequence, kSequenceParts);
    const clip = this.clipped ? view.clip : view.no_clip;
    gl.uniform3fv(u.u_target, view.target);
    gl.uniform1f(u.u_unit, view.unit);
    gl.uniform4f(u.u_clip, clip[0], clip[1], clip[2], (clip[3] - dot(clip, view.target)) * view.unit);
    gl.uniform1f(u.u_edge_width, this.edge_width * view.ratio);
    gl.uniform1i(u.u_wires, this.wires);
    gl.uniform1i(u.u_regions, this.regions);
    gl.uniform1i(u.u_age, this.age !== null);
    gl.uniform1f(u.u_step, this.age ? this.age.step : 0);
    gl.uniform1f(u.u_span, this.age ? this.age.span : 1);
    gl.uniform1f(u.u_opacity, this.opacity);
    if (this.solid) {
      gl.disable(gl.BLEND);
      gl.drawArrays(gl.TRIANGLES, 0, 3 * this.count);
      gl.enable(gl.BLEND);
    } else if (this.wires) {
      gl.drawArrays(gl.TRIANGLES, 0, 3 * this.count);
    } else {
      // Of what lets see through, only the nearest is drawn: first depth alone, then color.
      gl.colorMask(false, false, false, false);
      gl.drawArrays(gl.TRIANGLES, 0, 3 * this.count);
      gl.colorMask(true, true, true, true);
      gl.depthFunc(gl.EQUAL);
      gl.drawArrays(gl.TRIANGLES, 0, 3 * this.count);
      gl.depthFunc(gl.LEQUAL);
    }
    if (this.ghost > 0) {
      gl.uniform1f(u.u_opacity, this.opacity * this.ghost);
      draw_behind(gl, 3 * this.count);
    }
  }
}

// What is hidden by something else, weakly.
function draw_behind(gl, vertices) {
  gl.depthFunc(gl.GREATER);
  gl.depthMask(false);
  gl.drawArrays(gl.TRIANGLES, 0, vertices);
  gl.depthMask(true);
  gl.depthFunc(gl.LEQUAL);
}

// What lines and dots share: texels that are written anew from the first on.
class MarkLayer {
  constructor(program, texels_each, options) {
    this.program = program;
    this.texels_each = texels_each;
    this.texels = new Texels(false);
    this.as_floats = null;
    this.count = 0;
    this.visible = true;
    this.opacity = 1;
    this.ghost = 0;
    this.clipped = true;
    this.pull = 4e-4;
    Object.assign(this, options);
  }

  get solid() { return false; }
  clear() { this.count = 0; }

  put(texel, x, y, z, word) {
    const { texels } = this;
    if (texel >= texels.capacity) texels.reserve(texel + 1);
    if (this.as_floats?.buffer !== texels.data.buffer) {
      this.as_floats = new Float32Array(texels.data.buffer);
    }
    this.as_floats[4 * texel] = x;
    this.as_floats[4 * texel + 1] = y;
    this.as_floats[4 * texel + 2] = z;
    texels.data[4 * texel + 3] = word;
    texels.touch(texel);
  }

  draw(gl, view) {
    this.program.use(gl);
    const u = this.program.uniforms;
    gl.uniform1i(u.u_lines ?? u.u_dots, 0);
    this.texels.bind(gl, 0);
    gl.uniformMatrix4fv(u.u_project, false, view.project);
    gl.uniform2fv(u.u_size, view.half_size);
    gl.uniform4fv(u.u_clip, this.clipped ? view.clip : view.no_clip);
    gl.uniform1f(u.u_pull, this.pull);
    gl.uniform1f(u.u_opacity, this.opacity);
    gl.uniform1f(u.u_ratio, view.ratio);
    if (u.u_edge_color) gl.uniform3fv(u.u_edge_color, view.edge_color);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * this.count);
    if (this.ghost > 0) {
      gl.uniform1f(u.u_opacity, this.opacity * this.ghost);
      draw_behind(gl, 6 * this.count);
    }
  }
}

class LineLayer extends MarkLayer {
  constructor(options = {}) { super(kLineProgram, 2, options); }

  // Width in CSS pixels.
  add(a, b, color, width) {
    this.put(2 * this.count, a[0], a[1], a[2], color);
    this.put(2 * this.count + 1, b[0], b[1], b[2], Math.round(8 * width));
    ++this.count;
  }
  add_dashed(a, b, color, width) {
    const kParts = 9;
    const at = (n) => add(a, scaled(subtract(b, a), n / kParts));
    for (let n = 0; n < kParts; n += 2) this.add(at(n), at(n + 1), color, width);
  }
  add_triangle(a, b, c, color, width) {
    this.add(a, b, color, width);
    this.add(b, c, color, width);
    this.add(c, a, color, width);
  }
  add_box(lo, hi, color, width) {
    const corner = (n) => [n & 1 ? hi[0] : lo[0], n & 2 ? hi[1] : lo[1], n & 4 ? hi[2] : lo[2]];
    for (let n = 0; n < 8; ++n) {
      for (const bit of [1, 2, 4]) if (!(n & bit)) this.add(corner(n), corner(n | bit), color, width);
    }
  }
  add_circle(center, u, v, radius, color, width) {
    const kParts = 64;
    let before = add(center, scaled(u, radius));
    for (let n = 1; n <= kParts; ++n) {
      const angle = 2 * Math.PI * n / kParts;
      const at = add(center, add(scaled(u, radius * Math.cos(angle)),
                                 scaled(v, radius * Math.sin(angle))));
      this.add(before, at, color, width);
      before = at;
    }
  }
}

class DotLayer extends MarkLayer {
  constructor(options = {}) { super(kDotProgram, 1, { pull: 8e-4, ...options }); }

  // Diameter in CSS pixels, below 256.
  add(p, color, diameter) {
    this.put(this.count, p[0], p[1], p[2], (diameter << 24 | color) >>> 0);
    ++this.count;
  }
}

// Means of the facets' normals at each vertex, weighted by area, as Texels.
function vertex_normals(points, triangles) {
  const count = points.length / 3;
  const normals = new Float64Array(points.length);
  for (let n = 0; n < triangles.length; n += 3) {
    const a = 3 * triangles[n], b = 3 * triangles[n + 1], c = 3 * triangles[n + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1];
    const uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1];
    const vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner] += x;
      normals[corner + 1] += y;
      normals[corner + 2] += z;
    }
  }
  const texels = new Texels(true);
  texels.reserve(count);
  for (let n = 0; n < count; ++n) {
    const x = normals[3 * n], y = normals[3 * n + 1], z = normals[3 * n + 2];
    const size = Math.sqrt(x * x + y * y + z * z) || 1;
    texels.data[4 * n] = x / size;
    texels.data[4 * n + 1] = y / size;
    texels.data[4 * n + 2] = z / size;
  }
  return texels;
}
