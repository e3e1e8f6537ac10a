'use strict';
// A camera that turns about a point. Azimuth and elevation are those of `deliso render --view`: from
// +x towards +y, and above the xy plane. If another axis is up, the camera is rotated as there
// (rotated() of view/render/camera.cpp). Lengths are the scene's.

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
    this.fitted = false;      // nothing moved it since all was seen
    this.up_axis = [2, 1];    // and its sign
    this.eye_space = new Float64Array(16);
    this.lens = new Float64Array(16);
    this.product = new Float64Array(16);
    this.turn(0, 0);
  }

  stand([axis, sign]) {
    this.up_axis = [axis, sign];
    this.turn(0, 0);
  }
  rotated([x, y, z]) {
    const [axis, sign] = this.up_axis, out = [0, 0, 0];
    out[(axis + 1) % 3] = x;
    out[(axis + 2) % 3] = sign * y;
    out[axis] = sign * z;
    return out;
  }
  // Azimuth and elevation of a direction; along the axis that is up, any azimuth would do.
  angles_of(direction) {
    const [axis, sign] = this.up_axis;
    const x = direction[(axis + 1) % 3], y = sign * direction[(axis + 2) % 3];
    const z = sign * direction[axis];
    return { azimuth: x === 0 && y === 0 ? -90 : Math.atan2(y, x) * 180 / Math.PI,
             elevation: clamp(Math.atan2(z, Math.hypot(x, y)) * 180 / Math.PI, -89.9, 89.9) };
  }

  // What there is to see: a box, and flat arrays of the points that have to be seen, its corners
  // unless given.
  set_scene(box, points) {
    this.points = points ?? [Float64Array.from({ length: 24 }, (_, n) =>
      (n / 3 >> n % 3 & 1 ? box.hi : box.lo)[n % 3])];
    this.middle = box_middle(box);
    this.radius = box_radius(box);
  }
  // The smallest distance from which all points are seen. A point at (x, y, depth) along the
  // camera's axes is seen from a distance of at least depth + |x - center| / tangent. The borders
  // of the picture are planes, so four maxima are enough. A share
  // of the height is left free at the top.
  place_for(aspect, free = 0) {
    const { right, up, back, middle } = this;
    const low = Math.tan(kHalfAngle) / 1.08, wide = low * aspect, high = low * (1 - 2 * free);
    const most = [-Infinity, -Infinity, -Infinity, -Infinity];
    for (const points of this.points) {
      for (let n = 0; n < points.length; n += 3) {
        const px = points[n] - middle[0], py = points[n + 1] - middle[1], pz = points[n + 2] - middle[2];
        const x = right[0] * px + right[1] * py + right[2] * pz;
        const y = up[0] * px + up[1] * py + up[2] * pz;
        const depth = back[0] * px + back[1] * py + back[2] * pz;
        if (x + depth * wide > most[0]) most[0] = x + depth * wide;
        if (depth * wide - x > most[1]) most[1] = depth * wide - x;
        if (y + depth * high > most[2]) most[2] = y + depth * high;
        if (depth * low - y > most[3]) most[3] = depth * low - y;
      }
    }
    if (!Number.isFinite(most[0])) return { target: middle, distance: this.radius };
    const distance = Math.max((most[0] + most[1]) / (2 * wide), (most[2] + most[3]) / (low + high),
                              1e-3 * this.radius);
    const x = (most[0] - most[1]) / 2, y = (most[2] - most[3] + distance * (low - high)) / 2;
    return { target: add(middle, add(scaled(right, x), scaled(up, y))), distance };
  }

  turn(azimuth, elevation) {
    if (azimuth !== 0 || elevation !== 0) this.fitted = false;
    this.azimuth = (this.azimuth + azimuth) % 360;
    this.elevation = clamp(this.elevation + elevation, -89.9, 89.9);
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    this.back = this.rotated([Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)]);
    this.right = this.rotated([-Math.sin(a), Math.cos(a), 0]);
    this.up = cross(this.back, this.right);
  }
  // By a part of the height that is seen at the target.
  pan(x, y) {
    this.fitted = false;
    const height = 2 * this.distance * Math.tan(kHalfAngle);
    this.target = subtract(this.target,
                           add(scaled(this.right, x * height), scaled(this.up, y * height)));
  }
  // Towards a place in the view: x, y from -1 to 1, x times the aspect.
  zoom(factor, x = 0, y = 0) {
    this.fitted = false;
    const before = this.distance;
    this.distance = clamp(before * factor, 1e-4 * this.radius, 40 * this.radius);
    const share = (before - this.distance) / before;
    const half = before * Math.tan(kHalfAngle);
    this.target = add(this.target, add(scaled(this.right, x * half * share),
                                       scaled(this.up, y * half * share)));
  }
  eye() { return add(this.target, scaled(this.back, this.distance)); }

  // Writes the projection into `out`, 16 floats. Lengths are in multiples of the scene's size, since
  // the card's numbers end at 1e38 and only ratios matter.
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
    this.fitted = false;
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
