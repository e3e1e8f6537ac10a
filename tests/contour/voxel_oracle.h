// SPDX-License-Identifier: MIT
// The trilinear value and its derivatives have their extremes over a cell at its corners. So the
// following can be certified from corners alone. A cell without a change of sign holds no piece of
// Sigma. A cell is simple if one partial derivative has one sign in it. Moreover, in each face with
// a change of sign, one of the two derivatives along the face must have one sign. Then Sigma is a
// graph over a face of the cell, each face holds at most one arc, and the cell one disk. So V - E +
// F is counted over cells, faces and edges with a change of sign. Components and boundary loops are
// joined through them. A cell that is not simple has its intervals cut in two along all axes, so
// the grid is fine only where a saddle is close to Sigma. If kMaxPlanes planes along an axis do not
// suffice, a saddle lies on Sigma to within rounding: not resolved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "contour/voxel_topology.h"

namespace deliso {

struct VoxelPiece {
  int edges = 0;  // bit e: its boundary crosses the voxel's edge e
  int euler = 0;
  int loops = 0;
  friend auto operator<=>(const VoxelPiece&, const VoxelPiece&) = default;
};

struct VoxelTruth {
  bool resolved = false;
  std::vector<VoxelPiece> pieces;           // sorted
  std::array<std::array<int, 12>, 6> mate;  // [face][edge]: the crossing joined to it there, or -1
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

class VoxelOracle {
 public:
  // c: values minus kappa.
  static VoxelTruth solve(const Corners& c) {
    VoxelOracle oracle(c);
    while (!oracle.rounding_decides_) {
      if (oracle.all_simple()) return oracle.count();
      if (!oracle.refine()) break;
    }
    return {};
  }

 private:
  using Node = std::array<int, 3>;
  static constexpr std::size_t kMaxPlanes = 40;
  static constexpr double kRounding = 1e-12;

  explicit VoxelOracle(const Corners& c) : c_(c) {
    for (const double v : c) scale_ = std::max(scale_, std::abs(v));
    for (auto& planes : planes_) planes = {0, 0.47, 1};
    evaluate();
  }

  void evaluate() {
    nodes_ = 1;
    for (int axis = 0; axis < 3; ++axis) {
      n_[axis] = static_cast<int>(planes_[axis].size()) - 1;
      step_[axis] = nodes_;
      nodes_ *= n_[axis] + 1;
    }
    inside_.resize(static_cast<std::size_t>(nodes_));
    for (int at = 0; at < nodes_; ++at) {
      const double v = value(node_of(at));
      inside_[at] = v >= 0;
      rounding_decides_ = rounding_decides_ || std::abs(v) <= kRounding * scale_;
    }
  }

  // Cuts the intervals of every cell that is not simple. Returns whether there is room for it.
  bool refine() {
    std::array<std::vector<bool>, 3> cut;
    for (int axis = 0; axis < 3; ++axis) cut[axis].resize(planes_[axis].size());
    for_each_active_cell([&](Node a) {
      if (cell_simple(a)) return;
      for (int axis = 0; axis < 3; ++axis) cut[axis][a[axis]] = true;
    });
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> old = std::exchange(planes_[axis], {});
      for (std::size_t n = 0; n < old.size(); ++n) {
        planes_[axis].push_back(old[n]);
        if (cut[axis][n]) planes_[axis].push_back(mix(old[n], old[n + 1], 0.47));
      }
      if (planes_[axis].size() > kMaxPlanes) return false;
    }
    evaluate();
    return true;
  }

  int id(Node a) const { return a[0] * step_[0] + a[1] * step_[1] + a[2] * step_[2]; }
  Node node_of(int at) const { return {at % step_[1], at % step_[2] / step_[1], at / step_[2]}; }
  static Node moved(Node a, int axis, int by = 1) {
    a[axis] += by;
    return a;
  }
  bool inside(Node a) const { return inside_[id(a)]; }

  double value(Node a) const {
    const double x = planes_[0][a[0]], y = planes_[1][a[1]], z = planes_[2][a[2]];
    const double low = mix(mix(c_[0], c_[1], x), mix(c_[2], c_[3], x), y);
    const double high = mix(mix(c_[4], c_[5], x), mix(c_[6], c_[7], x), y);
    return mix(low, high, z);
  }
  static double mix(double from, double to, double t) { return (1 - t) * from + t * to; }

  // -1, 0 or 1; 0 where rounding could decide.
  int derivative_sign(Node a, int axis) const {
    double sum = 0;
    for (int m = 0; m < 8; ++m) {
      if ((m >> axis & 1) != 0) continue;
      double weight = 1;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        const double u = planes_[other][a[other]];
        weight *= (m >> other & 1) != 0 ? u : 1 - u;
      }
      sum += weight * (c_[m | 1 << axis] - c_[m]);
    }
    return sum > kRounding * scale_ ? 1 : sum < -kRounding * scale_ ? -1 : 0;
  }

  bool edge_crossed(Node a, int axis) const { return inside(a) != inside(moved(a, axis)); }
  bool face_active(Node a, int u, int v) const {
    return edge_crossed(a, u) || edge_crossed(a, v) || edge_crossed(moved(a, v), u);
  }
  bool cell_active(Node a) const {
    return face_active(a, 0, 1) || face_active(moved(a, 2), 0, 1) || edge_crossed(a, 2);
  }

  bool face_simple(Node a, int u, int v) const {
    if (!face_active(a, u, v)) return true;
    const int du = derivative_sign(a, u), dv = derivative_sign(a, v);
    return (du != 0 && du == derivative_sign(moved(a, v), u)) ||
           (dv != 0 && dv == derivative_sign(moved(a, u), v));
  }

  bool cell_simple(Node a) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (!face_simple(a, u, v) || !face_simple(moved(a, axis), u, v)) return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3, d = derivative_sign(a, axis);
      if (d != 0 && d == derivative_sign(moved(a, u), axis) &&
          d == derivative_sign(moved(a, v), axis) &&
          d == derivative_sign(moved(moved(a, u), v), axis)) {
        return true;
      }
    }
    return false;
  }

  template <class F>
  void for_each_active_cell(F f) const {
    for (int k = 0; k < n_[2]; ++k) {
      for (int j = 0; j < n_[1]; ++j) {
        for (int i = 0; i < n_[0]; ++i) {
          if (cell_active({i, j, k})) f(Node{i, j, k});
        }
      }
    }
  }

  bool all_simple() const {
    bool simple = true;
    for_each_active_cell([&](Node a) { simple = simple && cell_simple(a); });
    return simple;
  }

  // Crossed edges are elements: 3 * node + axis.
  int edge_id(Node a, int axis) const { return 3 * id(a) + axis; }
  std::array<int, 4> face_edges(Node a, int u, int v) const {
    return {edge_id(a, u), edge_id(a, v), edge_id(moved(a, v), u), edge_id(moved(a, u), v)};
  }
  bool crossed(int edge) const { return inside_[edge / 3] != inside_[edge / 3 + step_[edge % 3]]; }

  // The edge elements of a cell (or face), joined; returns one of them.
  template <std::size_t N>
  int join(UnionFind& sets, const std::array<int, N>& edges) const {
    int first = -1;
    for (const int e : edges) {
      if (!crossed(e)) continue;
      if (first >= 0) sets.unite(first, e);
      first = e;
    }
    return first;
  }

  VoxelTruth count() const {
    VoxelTruth truth;
    truth.resolved = true;
    const std::size_t elements = 3 * static_cast<std::size_t>(nodes_);
    UnionFind sheets(elements), loops(elements);
    for_each_active_cell([&](Node a) {
      std::array<int, 12> edges;
      int n = 0;
      for (int axis = 0; axis < 3; ++axis) {
        for (const Node b : {a, moved(a, (axis + 1) % 3)}) {
          edges[n++] = edge_id(b, axis);
          edges[n++] = edge_id(moved(b, (axis + 2) % 3), axis);
        }
      }
      join(sheets, edges);
    });
    // V - E + F of each sheet: every crossed edge, active face and active cell once.
    std::vector<int> euler(elements);
    for (std::size_t e = 0; e < elements; ++e) {
      const Node a = node_of(static_cast<int>(e) / 3);
      if (a[e % 3] < n_[e % 3] && crossed(static_cast<int>(e)))
        ++euler[sheets.root(static_cast<int>(e))];
    }
    for (int at = 0; at < nodes_; ++at) {
      const Node a = node_of(at);
      for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (a[u] == n_[u] || a[v] == n_[v] || !face_active(a, u, v)) continue;
        int on_face = -1;
        for (const int e : face_edges(a, u, v)) on_face = crossed(e) ? e : on_face;
        --euler[sheets.root(on_face)];
        if (a[axis] == 0 || a[axis] == n_[axis]) join(loops, face_edges(a, u, v));
      }
    }
    for_each_active_cell([&](Node a) {
      int in_cell = -1;
      for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const Node b : {a, moved(a, axis)}) {
          for (const int e : face_edges(b, u, v)) in_cell = crossed(e) ? e : in_cell;
        }
      }
      ++euler[sheets.root(in_cell)];
    });
    std::array<int, 12> crossing;
    for (int e = 0; e < 12; ++e) crossing[e] = crossing_of(e);
    for (int e = 0; e < 12; ++e) {
      if (crossing[e] < 0) continue;
      const int sheet = sheets.root(crossing[e]);
      VoxelPiece piece{0, euler[sheet], 0};
      bool first_of_piece = true;
      for (int f = 0; f < 12; ++f) {
        if (crossing[f] < 0 || sheets.root(crossing[f]) != sheet) continue;
        first_of_piece = first_of_piece && f >= e;
        piece.edges |= 1 << f;
        bool first_of_loop = true;
        for (int g = 0; g < f; ++g) {
          if (crossing[g] >= 0 && loops.root(crossing[g]) == loops.root(crossing[f])) {
            first_of_loop = false;
          }
        }
        piece.loops += first_of_loop;
      }
      if (first_of_piece) truth.pieces.push_back(piece);
    }
    std::sort(truth.pieces.begin(), truth.pieces.end());
    for (int f = 0; f < 6; ++f) truth.mate[f] = mates(f, crossing);
    return truth;
  }

  // The crossed small edge along edge e of the voxel.
  int crossing_of(int e) const {
    const auto [low, high] = corners_of_edge(e);
    const int axis = e / 4;
    for (int s = 0; s < n_[axis]; ++s) {
      Node a{(low & 1) * n_[0], (low >> 1 & 1) * n_[1], (low >> 2) * n_[2]};
      a[axis] = s;
      if (edge_crossed(a, axis)) return edge_id(a, axis);
    }
    return -1;
  }

  std::array<int, 12> mates(int f, const std::array<int, 12>& crossing) const {
    const int axis = f / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    UnionFind arcs(3 * static_cast<std::size_t>(nodes_));
    for (int p = 0; p < n_[u]; ++p) {
      for (int q = 0; q < n_[v]; ++q) {
        Node a;
        a[axis] = (f & 1) * n_[axis];
        a[u] = p;
        a[v] = q;
        join(arcs, face_edges(a, u, v));
      }
    }
    std::array<int, 12> mate;
    mate.fill(-1);
    for (int e = 0; e < 12; ++e) {
      for (int g = 0; g < 12; ++g) {
        if (e == g || crossing[e] < 0 || crossing[g] < 0) continue;
        if (lies_on(crossing[e], f) && lies_on(crossing[g], f) &&
            arcs.root(crossing[e]) == arcs.root(crossing[g])) {
          mate[e] = g;
        }
      }
    }
    return mate;
  }
  bool lies_on(int edge, int f) const {
    return edge % 3 != f / 2 && node_of(edge / 3)[f / 2] == (f & 1) * n_[f / 2];
  }

  Corners c_;
  std::array<std::vector<double>, 3> planes_;  // along each axis, from 0 to 1
  Node n_{}, step_{};
  int nodes_ = 0;
  double scale_ = 0;
  bool rounding_decides_ = false;  // the value at some node is zero to within rounding
  std::vector<char> inside_;
};

}  // namespace deliso
