'use strict';
// A camera that turns about a point. Azimuth and elevation are those of `deliso render --view`: from
// +x towards +y, and above the xy plane. Lengths are the scene's.

const kHalfAngle = 14 * Math.PI / 180;  // of what is seen from bottom to top

class Camera {
  constructor() {
    this.target = [0, 0, 0];
    this.azimuth = -60;
    this.elevation = 25;
    this.distance = 1;
    this.middle = [0, 0, 0];  // of all that can be seen, and its radius
    this.radius = 1;
    this.glide = null;
    this.eye_space = new Float64Array(16);
    this.lens = new Float64Array(16);
    this.product = new Float64Array(16);
    this.turn(0, 0);
  }

  // What there is to see.
  set_scene(box) {
    this.box = box;
    this.middle = box_middle(box);
    this.radius = box_radius(box);
  }
  // How far from its middle all of a box is seen in a view of this aspect.
  distance_for(box, aspect) {
    const half = scaled(subtract(box.hi, box.lo), 0.5);
    const tangent = Math.tan(kHalfAngle);
    let distance = 1e-3 * this.radius;
    for (let n = 0; n < 8; ++n) {
      const corner = half.map((x, axis) => n >> axis & 1 ? x : -x);
      const off = Math.max(Math.abs(dot(corner, this.up)), Math.abs(dot(corner, this.right)) / aspect);
      distance = Math.max(distance, dot(corner, this.back) + 1.08 * off / tangent);
    }
    return distance;
  }

  turn(azimuth, elevation) {
    this.azimuth = (this.azimuth + azimuth) % 360;
    this.elevation = clamp(this.elevation + elevation, -89.9, 89.9);
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    this.back = [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
    this.right = [-Math.sin(a), Math.cos(a), 0];
    this.up = cross(this.back, this.right);
  }
  // By a part of the height that is seen at the target.
  pan(x, y) {
    const height = 2 * this.distance * Math.tan(kHalfAngle);
    this.target = subtract(this.target,
                           add(scaled(this.right, x * height), scaled(this.up, y * height)));
  }
  // Towards a place in the view: x, y from -1 to 1, x times the aspect.
  zoom(factor, x = 0, y = 0) {
    const before = this.distance;
    this.distance = clamp(before * factor, 1e-4 * this.radius, 40 * this.radius);
    const share = (before - this.distance) / before;
    const half = before * Math.tan(kHalfAngle);
    this.target = add(this.target, add(scaled(this.right, x * half * share),
                                       scaled(this.up, y * half * share)));
  }
  eye() { return add(this.target, scaled(this.back, this.distance)); }

  // Into `out`, of 16 floats; in multiples of the scene's size, as such places matter by their ratios
  // alone, and the card's numbers end at 1e38.
  project(out, aspect) {
    const eye = this.eye();
    const depth = dot(subtract(eye, this.middle), this.back);
    const near = Math.max(depth - 1.6 * this.radius, 2e-3 * this.distance);
    const far = Math.max(depth + 1.6 * this.radius, 1.01 * near);
    look_from(this.eye_space, eye, this.right, this.up, this.back);
    perspective(this.lens, Math.tan(kHalfAngle), aspect, near, far);
    multiply(this.product, this.lens, this.eye_space);
    for (let n = 0; n < 16; ++n) out[n] = this.product[n] / this.radius;
  }

  // The ray through a place in the view, from -1 to 1 each.
  ray(x, y, aspect) {
    const tangent = Math.tan(kHalfAngle);
    const direction = subtract(add(scaled(this.right, x * aspect * tangent),
                                   scaled(this.up, y * tangent)), this.back);
    return { origin: this.eye(), direction };
  }

  // Goes to another place smoothly: step(now) until it returns false. goal: some of target,
  // distance, azimuth, elevation.
  glide_to(goal) {
    const from = { target: this.target, distance: this.distance, azimuth: this.azimuth,
                   elevation: this.elevation };
    const to = { ...from, ...goal };
    to.azimuth = from.azimuth + ((to.azimuth - from.azimuth + 540) % 360 + 360) % 360 - 180;
    this.glide = { from, to, began: null, lasts: prefers_stillness() ? 0 : 350 };
  }
  step(now) {
    const { glide } = this;
    if (!glide) return false;
    glide.began ??= now;
    const t = glide.lasts > 0 ? clamp((now - glide.began) / glide.lasts, 0, 1) : 1;
    const share = t * t * (3 - 2 * t);
    const { from, to } = glide;
    this.target = add(scaled(from.target, 1 - share), scaled(to.target, share));
    this.distance = from.distance ** (1 - share) * to.distance ** share;
    this.azimuth = from.azimuth + (to.azimuth - from.azimuth) * share;
    this.elevation = from.elevation + (to.elevation - from.elevation) * share;
    this.turn(0, 0);
    if (t >= 1) this.glide = null;
    return true;
  }
}
