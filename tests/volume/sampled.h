// SPDX-License-Identifier: MIT
// Volumes from functions of their samples' indices.
#pragma once

#include <cstring>
#include <vector>

#include "volume/volume.h"

namespace deliso {

// Calls f(i, j, k) for all indices below n, those along x first.
template <class F>
void for_each_index(Index3 n, F&& f) {
  for (int k = 0; k < n.k; ++k) {
    for (int j = 0; j < n.j; ++j) {
      for (int i = 0; i < n.i; ++i) f(i, j, k);
    }
  }
}

// The volume whose sample (i, j, k) is f(i, j, k).
template <class T, class F>
Volume sampled(Index3 dims, Vec3 spacing, F&& f) {
  std::vector<T> samples;
  for_each_index(dims, [&](int i, int j, int k) { samples.push_back(static_cast<T>(f(i, j, k))); });
  return Volume::from_samples(dims, spacing, samples);
}

inline bool same_samples(const Volume& a, const Volume& b) {
  return a.dims() == b.dims() && a.type() == b.type() && a.visit([&](const auto* s) {
    return b.visit(
        [&](const auto* t) { return std::memcmp(s, t, a.sample_count() * sizeof *s) == 0; });
  });
}

}  // namespace deliso
