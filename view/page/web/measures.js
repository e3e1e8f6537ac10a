'use strict';
// What a triangle is like: check/quality.h. All from flat arrays of coordinates and corners.

// The smallest angle in degrees, circumradius over shortest edge, the circumradius, and the area, per
// triangle. Without area: 0, Infinity, Infinity, 0.
function measure_triangles(points, triangles) {
  const count = triangles.length / 3;
  const angle = new Float32Array(count), r_over_l = new Float32Array(count);
  const radius = new Float32Array(count), area = new Float32Array(count);
  const distance = (a, b) => {
    const x = points[a] - points[b], y = points[a + 1] - points[b + 1];
    const z = points[a + 2] - points[b + 2];
    return Math.sqrt(x * x + y * y + z * z);
  };
  for (let n = 0; n < count; ++n) {
    const a = 3 * triangles[3 * n], b = 3 * triangles[3 * n + 1], c = 3 * triangles[3 * n + 2];
    const p = distance(b, c), q = distance(c, a), s = distance(a, b);
    const least = Math.min(p, q, s), most = Math.max(p, q, s);
    const middle = p + q + s - least - most;
    // Twice the area by Kahan's formula, which needles do not spoil.
    const product = (most + (middle + least)) * (least - (most - middle)) *
                    (least + (most - middle)) * (most + (middle - least));
    const twice_area = 0.5 * Math.sqrt(Math.max(product, 0));
    area[n] = twice_area / 2;
    angle[n] = twice_area > 0 ? Math.asin(Math.min(1, twice_area / (middle * most))) * 180 / Math.PI : 0;
    radius[n] = twice_area > 0 ? p * q * s / (2 * twice_area) : Infinity;
    r_over_l[n] = twice_area > 0 ? radius[n] / least : Infinity;
  }
  return { angle, r_over_l, radius, area };
}

// The triangles of the largest components that together have 99 % of the area, so that small ones far
// away do not shrink the picture.
function triangles_of_most_area(area, component, triangles) {
  const areas = [];
  let left = 0.99 * area.reduce((sum, a) => sum + a, 0);
  area.forEach((a, n) => { areas[component[n]] = (areas[component[n]] ?? 0) + a; });
  const kept = new Set();
  for (const c of [...areas.keys()].sort((a, b) => (areas[b] ?? 0) - (areas[a] ?? 0))) {
    if (left <= 0 && kept.size > 0) break;
    kept.add(c);
    left -= areas[c] ?? 0;
  }
  return triangles.filter((_, i) => kept.has(component[Math.floor(i / 3)]));
}

// The value that a share of the finite ones does not exceed; 0 where there are none.
function quantile(arrays, share) {
  const all = Float32Array.from(arrays.flatMap((values) => Array.from(values)).filter(Number.isFinite));
  all.sort();
  return all.length > 0 ? all[Math.min(all.length - 1, Math.floor(share * all.length))] : 0;
}

// The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is at least x.
function round_up(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  for (const step of [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) {
    if (step * power >= x * (1 - 1e-12)) return step * power;
  }
  return 10 * power;
}

// How many values fall into each of equal bins from lo to hi; what is beyond counts in the last.
function count_bins(values, lo, hi, bins) {
  const counts = new Uint32Array(bins);
  const per_bin = bins / (hi - lo);
  for (const value of values) {
    const bin = Math.floor((value - lo) * per_bin);
    counts[value < hi ? clamp(bin, 0, bins - 1) : bins - 1] += 1;
  }
  return counts;
}
