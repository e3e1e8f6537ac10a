'use strict';
// The min/max kd-tree over a volume's voxels, as in src/kdtree/voxel_tree.h (rules K1 to K4 there).
// It is implicit, so that a page holds the samples alone.
// Lengths are in voxels; sample (i, j, k) lies at (i, j, k).

const kLeafVoxels = 128;

// A line among voxels: src/isosurface/lattice_line.h.
class LatticeLine {
  constructor(origin, direction, voxels) {
    this.origin = [...origin];
    this.direction = [...direction];
    this.base = [...origin];
    this.inverse = [0, 0, 0];
    this.ahead = [0, 0, 0];  // 1 where indices grow along the line
    this.valid = false;
    for (let axis = 0; axis < 3; ++axis) {
      this.inverse[axis] = 1 / direction[axis];
      this.ahead[axis] = this.inverse[axis] > 0 ? 1 : 0;
      if (Number.isFinite(this.inverse[axis])) {
        this.valid = true;
        continue;
      }
      // Parallel: in the layer of voxels above it, at the far side below it.
      const o = clamp(origin[axis], -1, voxels[axis] + 1);
      this.base[axis] = (o === voxels[axis] ? voxels[axis] - 1 : Math.floor(o)) + 0.5;
      this.direction[axis] = 0;
      this.inverse[axis] = Infinity;
      this.ahead[axis] = 1;
    }
    this.voxels = voxels;
  }
  at_plane(axis, plane) { return (plane - this.base[axis]) * this.inverse[axis]; }

  // The part from t0 to t1 that is in the box of all voxels, or null.
  clip(t0, t1) {
    if (!this.valid) return null;
    for (let axis = 0; axis < 3; ++axis) {
      const far = this.ahead[axis] * this.voxels[axis];
      t0 = Math.max(t0, this.at_plane(axis, this.voxels[axis] - far));
      t1 = Math.min(t1, this.at_plane(axis, far));
    }
    return t0 < t1 ? { t0, t1 } : null;
  }

  // The part of t0 to t1 in a box of voxels lo .. hi - 1, or null.
  part_in(lo, hi, t0, t1) {
    for (let axis = 0; axis < 3; ++axis) {
      const ahead = this.ahead[axis];
      t0 = Math.max(t0, this.at_plane(axis, ahead ? lo[axis] : hi[axis]));
      t1 = Math.min(t1, this.at_plane(axis, ahead ? hi[axis] : lo[axis]));
    }
    return t0 < t1 ? { t0, t1 } : null;
  }
}

class VoxelTree {
  // samples: x fastest; dims: how many samples along each axis.
  constructor(samples, dims) {
    this.samples = samples;
    this.dims = dims;
    this.voxels = dims.map((n) => n - 1);
    this.axis = this.choose_axes();
    const nodes = 2 << this.axis.length;
    this.min = new Float32Array(nodes);
    this.max = new Float32Array(nodes);
    this.build(1, 0, [0, 0, 0], [...this.voxels]);
  }
  get depth() { return this.axis.length; }
  get node_count() { return (2 << this.depth) - 1; }

  choose_axes() {
    const longest = [...this.voxels], shortest = [...this.voxels], chosen = [];
    if (Math.min(...longest) < 1) return chosen;
    while (longest[0] * longest[1] * longest[2] > kLeafVoxels) {
      // Ties go to z, then y.
      let axis = 2;
      for (const other of [1, 0]) if (longest[other] > longest[axis]) axis = other;
      if (shortest[axis] < 2) break;
      chosen.push(axis);
      longest[axis] = (longest[axis] + 1) >> 1;
      shortest[axis] >>= 1;
    }
    return chosen;
  }

  static middle(lo, hi) { return lo + ((hi - lo) >> 1); }

  build(node, level, lo, hi) {
    if (level === this.depth) {
      this.scan(node, lo, hi);
      return;
    }
    const axis = this.axis[level], end = hi[axis], begin = lo[axis];
    const middle = VoxelTree.middle(begin, end);
    hi[axis] = middle;
    this.build(2 * node, level + 1, lo, hi);
    hi[axis] = end;
    lo[axis] = middle;
    this.build(2 * node + 1, level + 1, lo, hi);
    lo[axis] = begin;
    this.min[node] = Math.min(this.min[2 * node], this.min[2 * node + 1]);
    this.max[node] = Math.max(this.max[2 * node], this.max[2 * node + 1]);
  }

  scan(node, lo, hi) {
    const [nx, ny] = this.dims;
    let least = Infinity, most = -Infinity;
    for (let k = lo[2]; k <= hi[2]; ++k) {
      for (let j = lo[1]; j <= hi[1]; ++j) {
        const row = (k * ny + j) * nx;
        for (let i = lo[0]; i <= hi[0]; ++i) {
          const value = this.samples[row + i];
          if (value < least) least = value;
          if (value > most) most = value;
        }
      }
    }
    this.min[node] = least;
    this.max[node] = most;
  }

  is_active(node, kappa) { return this.min[node] < kappa && this.max[node] >= kappa; }

  voxel_is_active(i, j, k, kappa) {
    const [nx, ny] = this.dims;
    let inside = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const at = ((k + (corner >> 2)) * ny + j + (corner >> 1 & 1)) * nx + i + (corner & 1);
      if (this.samples[at] >= kappa) ++inside;
    }
    return inside !== 0 && inside !== 8;
  }

  // CollectVoxels of Figure 12 along a line. Returns all that it looks at: the nodes in the order
  // of the visit, and the active voxels with their pieces of the line.
  walk(line, kappa, t0 = 0, t1 = 1) {
    const nodes = [], voxels = [];
    const range = line.clip(t0, t1);
    const visit = (node, level, lo, hi, from, to) => {
      const active = this.is_active(node, kappa);
      const leaf = level === this.depth;
      nodes.push({ node, level, lo: [...lo], hi: [...hi], t0: from, t1: to, active, leaf });
      if (!active) return;
      if (leaf) {
        this.walk_leaf(line, kappa, lo, hi, from, to, voxels);
        return;
      }
      const axis = this.axis[level], middle = VoxelTree.middle(lo[axis], hi[axis]);
      const split = line.at_plane(axis, middle);
      const child = (upper, begin, end) => {
        const child_lo = [...lo], child_hi = [...hi];
        (upper ? child_lo : child_hi)[axis] = middle;
        visit(2 * node + upper, level + 1, child_lo, child_hi, begin, end);
      };
      const second = line.ahead[axis];
      if (split <= from) {
        child(second, from, to);
      } else if (split >= to) {
        child(1 - second, from, to);
      } else {
        child(1 - second, from, split);
        child(second, split, to);
      }
    };
    if (range && Math.min(...this.voxels) >= 1) {
      visit(1, 0, [0, 0, 0], [...this.voxels], range.t0, range.t1);
    }
    return { nodes, voxels };
  }

  // Of at most kLeafVoxels voxels, all are asked.
  walk_leaf(line, kappa, lo, hi, t0, t1, found) {
    const first = found.length;
    for (let k = lo[2]; k < hi[2]; ++k) {
      for (let j = lo[1]; j < hi[1]; ++j) {
        for (let i = lo[0]; i < hi[0]; ++i) {
          const part = line.part_in([i, j, k], [i + 1, j + 1, k + 1], t0, t1);
          if (part && this.voxel_is_active(i, j, k, kappa)) found.push({ voxel: [i, j, k], ...part });
        }
      }
    }
    const here = found.splice(first).sort((a, b) => a.t0 - b.t0);
    found.push(...here);
  }
}
