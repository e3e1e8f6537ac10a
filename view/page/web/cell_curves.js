'use strict';
// The curves of a cell where its bilinear interpolant is zero, from the values at (0,0), (1,0), (0,1)
// and (1,1): each a list of points. They are pieces of hyperbolas, monotone in x and y.
function cell_curves(f00, f10, f01, f11, parts = 8) {
  const crossing = (a, b) => a / (a - b);
  const differ = (a, b) => (a >= 0) !== (b >= 0);
  const bottom = differ(f00, f10) ? [crossing(f00, f10), 0] : null;
  const top = differ(f01, f11) ? [crossing(f01, f11), 1] : null;
  const left = differ(f00, f01) ? [0, crossing(f00, f01)] : null;
  const right = differ(f10, f11) ? [1, crossing(f10, f11)] : null;
  const ends = [bottom, top, left, right].filter((end) => end !== null);
  let pairs = [];
  if (ends.length === 2) pairs = [ends];
  if (ends.length === 4) {
    // Each branch is on one side of the asymptote x = middle.
    const middle = (f00 - f01) / (f00 - f10 - f01 + f11);
    pairs = bottom[0] < middle ? [[left, bottom], [top, right]] : [[left, top], [bottom, right]];
  }
  const bend = f00 - f10 - f01 + f11;
  const y_at = (x) => -(f00 + (f10 - f00) * x) / (f01 - f00 + bend * x);
  const x_at = (y) => -(f00 + (f01 - f00) * y) / (f10 - f00 + bend * y);
  return pairs.map(([p, q]) => {
    const along = Math.abs(q[0] - p[0]) >= Math.abs(q[1] - p[1]) ? 0 : 1;
    const curve = [p];
    for (let n = 1; n < parts; ++n) {
      const s = p[along] + (q[along] - p[along]) * n / parts;
      const other = clamp(along === 0 ? y_at(s) : x_at(s), 0, 1);
      curve.push(along === 0 ? [s, other] : [other, s]);
    }
    curve.push(q);
    return curve;
  });
}
