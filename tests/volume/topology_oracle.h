// SPDX-License-Identifier: MIT
// Topology of a resolved trilinear isosurface, by counting. Crossed grid edges are vertices, arcs
// on voxel faces (asymptotic decider) are edges, and a closed loop of arcs in a voxel bounds a
// disk. Loops of one voxel that might bound a tube instead are counted, not decided.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "io/volume/builtin_volume.h"
#include "volume/volume.h"

namespace deliso::test {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

struct CountedTopology {
  SurfaceTopology topology;
  int doubtful_voxels;  // with more than one loop
};

class TopologyCounter {
 public:
  TopologyCounter(const Volume& volume, double kappa)
      : volume_(volume), sets_(3 * volume.sample_count()), rims_(sets_) {
    volume.visit([&](const auto* samples) {
      for (std::size_t n = 0; n < volume.sample_count(); ++n)
        values_.push_back(static_cast<double>(samples[n]) - kappa);
    });
  }

  CountedTopology run() {
    const Index3 n = volume_.dims();
    int vertices = 0, arcs = 0, disks = 0, doubtful = 0;
    for (int k = 0; k < n.k; ++k) {
      for (int j = 0; j < n.j; ++j) {
        for (int i = 0; i < n.i; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            vertices += is_crossed({i, j, k}, axis);
            arcs += add_face({i, j, k}, axis);
          }
          const int loops = loops_in({i, j, k});
          disks += loops;
          doubtful += loops > 1;
        }
      }
    }
    int components = 0, boundary_loops = 0;
    for (std::uint32_t edge = 0; edge < on_rim_.size(); ++edge) {
      components += on_surface_[edge] && sets_.root(edge) == edge;
      boundary_loops += on_rim_[edge] && rims_.root(edge) == edge;
    }
    return {{components, vertices - arcs + disks, boundary_loops}, doubtful};
  }

 private:
  double value(Index3 s) const { return values_[volume_.index(s.i, s.j, s.k)]; }
  bool is_sample(Index3 s) const {
    return s.i < volume_.dims().i && s.j < volume_.dims().j && s.k < volume_.dims().k;
  }
  static Index3 next(Index3 s, int axis) {
    ++s[axis];
    return s;
  }
  std::uint32_t edge(Index3 s, int axis) const {
    return static_cast<std::uint32_t>(3 * volume_.index(s.i, s.j, s.k)) +
           static_cast<unsigned>(axis);
  }
  bool is_crossed(Index3 s, int axis) const {
    const Index3 t = next(s, axis);
    return is_sample(t) && (value(s) >= 0) != (value(t) >= 0);
  }

  // Finds the arcs on the face at s with this normal, each as two edges, and returns their number.
  using Arc = std::array<std::uint32_t, 2>;
  int arcs_on(Index3 s, int normal, std::array<Arc, 2>& arcs) const {
    const int u = (normal + 1) % 3, v = (normal + 2) % 3;
    const Index3 s10 = next(s, u), s01 = next(s, v), s11 = next(s10, v);
    if (!is_sample(s11)) return 0;
    const double f00 = value(s), f10 = value(s10), f01 = value(s01), f11 = value(s11);
    // Edges around the face: below, right, above, left.
    const std::uint32_t below = edge(s, u), right = edge(s10, v), above = edge(s01, u),
                        left = edge(s, v);
    std::array<std::uint32_t, 4> crossed{};
    std::size_t count = 0;
    if ((f00 >= 0) != (f10 >= 0)) crossed[count++] = below;
    if ((f10 >= 0) != (f11 >= 0)) crossed[count++] = right;
    if ((f01 >= 0) != (f11 >= 0)) crossed[count++] = above;
    if ((f00 >= 0) != (f01 >= 0)) crossed[count++] = left;
    if (count == 0) return 0;
    if (count == 2) {
      arcs[0] = {crossed[0], crossed[1]};
      return 1;
    }
    if (f00 * f11 > f10 * f01) {  // corners 10 and 01 are cut off
      arcs = {Arc{below, right}, Arc{above, left}};
    } else {
      arcs = {Arc{below, left}, Arc{right, above}};
    }
    return 2;
  }

  int add_face(Index3 s, int normal) {
    std::array<Arc, 2> arcs;
    const int count = arcs_on(s, normal, arcs);
    const bool on_box = s[normal] == 0 || s[normal] == volume_.dims()[normal] - 1;
    for (int n = 0; n < count; ++n) {
      const auto [a, b] = arcs[static_cast<std::size_t>(n)];
      sets_.unite(a, b);
      on_surface_[a] = on_surface_[b] = true;
      if (!on_box) continue;
      rims_.unite(a, b);
      on_rim_[a] = on_rim_[b] = true;
    }
    return count;
  }

  int loops_in(Index3 s) const {
    if (!is_sample({s.i + 1, s.j + 1, s.k + 1})) return 0;
    std::vector<Arc> all;
    for (int normal = 0; normal < 3; ++normal) {
      for (const Index3& face : {s, next(s, normal)}) {
        std::array<Arc, 2> arcs;
        const int count = arcs_on(face, normal, arcs);
        all.insert(all.end(), arcs.begin(), arcs.begin() + count);
      }
    }
    int loops = 0;
    while (!all.empty()) {  // follow one loop and take its arcs away
      ++loops;
      const std::uint32_t start = all.back()[0];
      std::uint32_t at = all.back()[1];
      all.pop_back();
      while (at != start) {
        std::size_t n = 0;
        while (all[n][0] != at && all[n][1] != at) ++n;
        at = all[n][0] == at ? all[n][1] : all[n][0];
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(n));
      }
    }
    return loops;
  }

  const Volume& volume_;
  std::vector<double> values_;  // less kappa
  DisjointSets sets_, rims_;
  std::vector<bool> on_surface_ = std::vector<bool>(3 * volume_.sample_count());
  std::vector<bool> on_rim_ = std::vector<bool>(3 * volume_.sample_count());
};

}  // namespace deliso::test
