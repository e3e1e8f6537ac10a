// SPDX-License-Identifier: MIT
// The topology of Sigma in one voxel in exact arithmetic, for any finite samples. Values minus
// kappa are integers of any width; src/ shares only the numbering of edges.
//
// The voxel is swept along an axis. A slice is bilinear. It can change at the zeros of its four
// corners (rational) and of its saddle product E = c0 c3 - c1 c2. The sign of E is evaluated at the
// ends of each slab between two corner events, and at E's extremum if that lies within. E is
// monotonic on both sides of it. So every height examined is rational. Arcs of slices are joined
// through the slabs, and V - E + F is counted as disks of slabs minus arcs of slices. The three
// axes must agree; if they do not, the oracle itself is wrong: `resolved` is false.
//
// "Inside is >= kappa" means Sigma at a kappa that is lowered by less than any distance between two
// events. Integers say how much less. With values as integers below 2^n, a polynomial of degree 4
// is 0 or at least 1. It moves by less than 1 when the values move by 2^-(4 n). So all values are
// raised by 2^-(4 n); after that only equal columns are tied.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "contour/voxel_topology.h"
#include "contour/voxel_truth.h"
#include "exact/big_int.h"

namespace deliso {

class ExactVoxel {
 public:
  static VoxelTruth solve(const Corners& samples, double kappa) {
    const ExactVoxel voxel(samples, kappa);
    VoxelTruth truth = voxel.sweep(2);
    truth.resolved = truth.pieces == voxel.sweep(0).pieces && truth.pieces == voxel.sweep(1).pieces;
    return truth;
  }

 private:
  using BigInt = oracle::BigInt;
  // A height p / q, 0 <= p <= q.
  struct Height {
    BigInt p, q;
    friend bool operator<(const Height& a, const Height& b) {
      return (a.p * b.q - b.p * a.q).sign() < 0;
    }
  };
  // A slice between two changes, and the column that changes sign on the way to it, or -1.
  struct Slice {
    std::array<bool, 4> inside;  // round the slice: columns 0, 1, 3, 2
    bool joined;                 // where they alternate
    int event = -1;
    int arcs() const {
      int changes = 0;
      for (int s = 0; s < 4; ++s) changes += crosses(s);
      return changes / 2;
    }
    bool crosses(int side) const { return inside[side] != inside[(side + 1) % 4]; }
  };

  ExactVoxel(const Corners& samples, double kappa) {
    constexpr int kNone = 100000;
    int low = oracle::lowest_exponent(kappa, kNone), high = -kNone;
    for (const double v : samples) low = std::min(low, oracle::lowest_exponent(v, kNone));
    if (low == kNone) low = 0;
    for (const double v : samples) high = std::max(high, v == 0 ? low : std::ilogb(v) + 2);
    high = std::max(high, kappa == 0 ? low : std::ilogb(kappa) + 2);
    const int below = 4 * (high - low) + 16;
    for (int m = 0; m < 8; ++m) {
      const BigInt difference =
          oracle::to_integer(samples[m], low) - oracle::to_integer(kappa, low);
      c_[m] = difference.shifted_left(below) + BigInt(1);
    }
  }

  bool inside(int corner) const { return c_[corner].sign() > 0; }

  // The edge of the voxel from `corner` along an axis.
  static int edge_from(int corner, int axis) {
    for (int e = 0; e < 12; ++e) {
      if (e / 4 == axis && corners_of_edge(e)[0] == (corner & ~(1 << axis))) return e;
    }
    return -1;
  }

  VoxelTruth sweep(int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::array<int, 4> ring{0, 1 << u, 1 << u | 1 << v, 1 << v};
    const std::vector<Slice> slices = slices_along(axis, ring);
    const int stages = static_cast<int>(slices.size());
    // Elements: the voxel's edges, then every slice's four sides.
    UnionFind whole(static_cast<std::size_t>(12 + 4 * stages));
    const auto side = [](int stage, int s) { return 12 + 4 * stage + s % 4; };
    std::vector<std::pair<int, int>> parts;  // an element of each disk of a slab, and 1 or -1
    for (int t = 0; t < stages; ++t) {
      unite_arcs(whole, slices[t], [&](int s) { return side(t, s); });
      // Down to the voxel's face or to the middle of the slab below, and up likewise. These are
      // arcs times an interval, which count only at the two faces.
      for (int s = 0; s < 4; ++s) {
        if (!slices[t].crosses(s)) continue;
        const int from = ring[s], to = ring[(s + 1) % 4], along = s % 2 == 0 ? u : v;
        const int low_corner = from & to;
        if (t == 0) whole.unite(side(t, s), edge_from(low_corner, along));
        if (t == stages - 1) whole.unite(side(t, s), edge_from(low_corner | 1 << axis, along));
      }
    }
    // Disks of the slab from slice t to t + 1.
    for (int t = 0; t + 1 < stages; ++t) {
      UnionFind local(static_cast<std::size_t>(12 + 4 * stages));
      for (const int stage : {t, t + 1}) {
        unite_arcs(local, slices[stage], [&](int s) { return side(stage, s); });
      }
      const auto unite = [&](int a, int b) {
        local.unite(a, b);
        whole.unite(a, b);
      };
      const int event = slices[t + 1].event;
      for (int s = 0; s < 4; ++s) {
        const bool near = event >= 0 && (s == event || (s + 1) % 4 == event);
        if (!near) {
          if (slices[t].crosses(s)) unite(side(t, s), side(t + 1, s));
          continue;
        }
        const int e = edge_from(ring[event], axis);
        if (slices[t].crosses(s)) unite(side(t, s), e);
        if (slices[t + 1].crosses(s)) unite(side(t + 1, s), e);
      }
      std::vector<int> roots;
      for (const int stage : {t, t + 1}) {
        for (int s = 0; s < 4; ++s) {
          if (!slices[stage].crosses(s)) continue;
          const int root = local.root(side(stage, s));
          if (std::find(roots.begin(), roots.end(), root) != roots.end()) continue;
          roots.push_back(root);
          parts.push_back({side(stage, s), 1});
        }
      }
    }
    // Arcs of the slices between two slabs; the one slice of a voxel without events is its disks.
    for (int t = 0; t < stages; ++t) {
      const int sign = stages == 1 ? 1 : t == 0 || t == stages - 1 ? 0 : -1;
      UnionFind local(static_cast<std::size_t>(12 + 4 * stages));
      unite_arcs(local, slices[t], [&](int s) { return side(t, s); });
      for (int s = 0; s < 4; ++s) {
        if (slices[t].crosses(s) && local.root(side(t, s)) == side(t, s)) {
          parts.push_back({side(t, s), sign});
        }
      }
    }
    return pieces(whole, parts);
  }

  template <class Side>
  static void unite_arcs(UnionFind& sets, const Slice& slice, Side side) {
    const int arcs = slice.arcs();
    if (arcs == 1) {
      int first = -1;
      for (int s = 0; s < 4; ++s) {
        if (!slice.crosses(s)) continue;
        if (first >= 0) sets.unite(side(first), side(s));
        first = s;
      }
    }
    if (arcs == 2) {
      // Around the columns that are not joined.
      for (int n = 0; n < 4; ++n) {
        if (slice.inside[n] != slice.joined) sets.unite(side(n), side(n + 3));
      }
    }
  }

  std::vector<Slice> slices_along(int axis, const std::array<int, 4>& ring) const {
    const auto low = [&](int n) -> const BigInt& { return c_[ring[n]]; };
    const auto high = [&](int n) -> const BigInt& { return c_[ring[n] | 1 << axis]; };
    // q times the value of column n at p / q.
    const auto at = [&](int n, const Height& z) { return low(n) * (z.q - z.p) + high(n) * z.p; };
    const auto saddle = [&](const Height& z) {
      return (at(0, z) * at(2, z) - at(1, z) * at(3, z)).sign();
    };
    struct Event {
      Height height;
      int column;
    };
    std::vector<Event> events;
    Slice slice{{}, false};
    for (int n = 0; n < 4; ++n) {
      slice.inside[n] = low(n).sign() > 0;
      if (low(n).sign() == high(n).sign()) continue;
      const BigInt p = low(n).sign() > 0 ? low(n) : -low(n);
      events.push_back({{p, p + (high(n).sign() > 0 ? high(n) : -high(n))}, n});
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.height < b.height; });
    // Where E has its extremum: -r1 / (2 r2).
    const auto d = [&](int n) { return high(n) - low(n); };
    const BigInt r2 = d(0) * d(2) - d(1) * d(3);
    const BigInt r1 = low(0) * d(2) + low(2) * d(0) - low(1) * d(3) - low(3) * d(1);
    const Height extremum = r2.sign() > 0 ? Height{-r1, r2 + r2} : Height{r1, -(r2 + r2)};
    const Height floor{BigInt(0), BigInt(1)}, ceiling{BigInt(1), BigInt(1)};

    std::vector<Slice> slices;
    for (std::size_t n = 0; n <= events.size(); ++n) {
      const Height& from = n == 0 ? floor : events[n - 1].height;
      const Height& to = n == events.size() ? ceiling : events[n].height;
      slice.event = n == 0 ? -1 : events[n - 1].column;
      const auto& s = slice.inside;
      if (s[0] == s[2] && s[1] == s[3] && s[0] != s[1]) {
        std::vector<int> signs{saddle(from)};
        if (r2.sign() != 0 && from < extremum && extremum < to) signs.push_back(saddle(extremum));
        signs.push_back(saddle(to));
        for (std::size_t k = 0; k < signs.size(); ++k) {
          const bool joined = s[0] ? signs[k] >= 0 : signs[k] <= 0;
          if (k > 0 && joined == slice.joined) continue;
          slice.joined = joined;
          slices.push_back(slice);
          slice.event = -1;
        }
      } else {
        slices.push_back(slice);
      }
      if (n < events.size()) slice.inside[events[n].column] = !slice.inside[events[n].column];
    }
    return slices;
  }

  // Edges that face f joins to each other.
  std::array<int, 12> mates(int f) const {
    std::array<int, 12> mate;
    mate.fill(-1);
    const int axis = f / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, base = (f & 1) << axis;
    const std::array<int, 4> k{base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v};
    const std::array<int, 4> edge{edge_from(k[0], u), edge_from(k[1], v), edge_from(k[3], u),
                                  edge_from(k[0], v)};
    Slice slice{{inside(k[0]), inside(k[1]), inside(k[2]), inside(k[3])}, false};
    const int sign = (c_[k[0]] * c_[k[2]] - c_[k[1]] * c_[k[3]]).sign();
    slice.joined = inside(k[0]) ? sign >= 0 : sign <= 0;
    UnionFind sides(4);
    unite_arcs(sides, slice, [](int s) { return s % 4; });
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) {
        const bool both = s != t && slice.crosses(s) && slice.crosses(t);
        if (both && sides.root(s) == sides.root(t)) mate[edge[s]] = edge[t];
      }
    }
    return mate;
  }

  VoxelTruth pieces(UnionFind& whole, const std::vector<std::pair<int, int>>& parts) const {
    VoxelTruth truth;
    UnionFind loops(12);
    for (int f = 0; f < 6; ++f) {
      truth.mate[f] = mates(f);
      for (int e = 0; e < 12; ++e) {
        if (truth.mate[f][e] >= 0) loops.unite(e, truth.mate[f][e]);
      }
    }
    for (int e = 0; e < 12; ++e) {
      if (!crossed(e)) continue;
      VoxelPiece piece;
      for (int g = 0; g < 12; ++g) {
        if (!crossed(g) || whole.root(g) != whole.root(e)) continue;
        piece.edges |= 1 << g;
        piece.loops += loops.root(g) == g;
      }
      if ((piece.edges & ((1 << e) - 1)) != 0) continue;  // found by its first edge
      for (const auto& [element, count] : parts) {
        if (whole.root(element) == whole.root(e)) piece.euler += count;
      }
      truth.pieces.push_back(piece);
    }
    std::sort(truth.pieces.begin(), truth.pieces.end());
    return truth;
  }
  bool crossed(int e) const {
    const auto [low, high] = corners_of_edge(e);
    return inside(low) != inside(high);
  }

  std::array<BigInt, 8> c_;  // value minus kappa, raised, in units
};

}  // namespace deliso
