'use strict';
// Vectors, boxes and matrices: plain arrays of numbers. Functions that are called for every picture
// write into `out`, so that drawing allocates nothing.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length_of = (a) => Math.sqrt(dot(a, a));
const unit = (a) => {
  const size = length_of(a);
  return size > 0 ? scaled(a, 1 / size) : [0, 0, 0];
};
const clamp = (x, lo, hi) => Math.min(Math.max(x, lo), hi);

// Point number n of a flat array of coordinates.
const point_at = (points, n) => [points[3 * n], points[3 * n + 1], points[3 * n + 2]];

const empty_box = () =>
  ({ lo: [Infinity, Infinity, Infinity], hi: [-Infinity, -Infinity, -Infinity] });

function extend_box(box, x, y, z) {
  const { lo, hi } = box;
  if (x < lo[0]) lo[0] = x;
  if (y < lo[1]) lo[1] = y;
  if (z < lo[2]) lo[2] = z;
  if (x > hi[0]) hi[0] = x;
  if (y > hi[1]) hi[1] = y;
  if (z > hi[2]) hi[2] = z;
}

// Around the points that `corners` name, or all of them.
function box_of_points(points, corners) {
  const box = empty_box();
  const count = corners ? corners.length : points.length / 3;
  for (let n = 0; n < count; ++n) {
    const at = 3 * (corners ? corners[n] : n);
    extend_box(box, points[at], points[at + 1], points[at + 2]);
  }
  return box.lo[0] <= box.hi[0] ? box : { lo: [-1, -1, -1], hi: [1, 1, 1] };
}

const box_middle = (box) => scaled(add(box.lo, box.hi), 0.5);
const box_radius = (box) => Math.max(0.5 * length_of(subtract(box.hi, box.lo)), 1e-20);

// Matrices are of four columns, as the graphics card takes them. out = a * b, out neither of them.
function multiply(out, a, b) {
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += a[4 * k + row] * b[4 * column + k];
      out[4 * column + row] = sum;
    }
  }
  return out;
}

// From the world to the eye, whose axes are right, up and back.
function look_from(out, eye, right, up, back) {
  for (let n = 0; n < 3; ++n) {
    out[4 * n] = right[n];
    out[4 * n + 1] = up[n];
    out[4 * n + 2] = back[n];
    out[4 * n + 3] = 0;
  }
  out[12] = -dot(right, eye);
  out[13] = -dot(up, eye);
  out[14] = -dot(back, eye);
  out[15] = 1;
  return out;
}

// `tangent`: of half the angle that is seen from bottom to top.
function perspective(out, tangent, aspect, near, far) {
  out.fill(0);
  out[0] = 1 / (tangent * aspect);
  out[5] = 1 / tangent;
  out[10] = (far + near) / (near - far);
  out[11] = -1;
  out[14] = 2 * far * near / (near - far);
  return out;
}

// Where a ray meets a triangle, as a multiple of its direction; Infinity where it does not
// (Moeller and Trumbore 1997).
function ray_meets_triangle(origin, direction, a, b, c) {
  const u = subtract(b, a), v = subtract(c, a);
  const p = cross(direction, v);
  const determinant = dot(u, p);
  if (determinant === 0) return Infinity;
  const s = subtract(origin, a);
  const beta = dot(s, p) / determinant;
  if (!(beta >= 0 && beta <= 1)) return Infinity;
  const q = cross(s, u);
  const gamma = dot(direction, q) / determinant;
  if (!(gamma >= 0 && beta + gamma <= 1)) return Infinity;
  const t = dot(v, q) / determinant;
  return t > 0 ? t : Infinity;
}
