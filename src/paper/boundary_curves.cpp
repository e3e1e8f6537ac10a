// SPDX-License-Identifier: MIT
#include "paper/boundary_curves.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace deliso::paper {

BoundaryCurves marching_squares(const Volume& volume, double kappa) {
  BoundaryCurves curves;
  const Index3 dims = volume.dims();
  const auto value = [&](Index3 p) { return volume.sample(p.i, p.j, p.k) - kappa; };
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> point_on;  // by the edge's samples
  const auto crossing = [&](Index3 a, Index3 b) {
    std::size_t first = volume.index(a.i, a.j, a.k), second = volume.index(b.i, b.j, b.k);
    if (first > second) {
      std::swap(first, second);
      std::swap(a, b);
    }
    const auto [at, is_new] =
        point_on.try_emplace({first, second}, static_cast<std::uint32_t>(curves.points.size()));
    if (is_new) {
      const double t = value(a) / (value(a) - value(b));
      const Vec3 from = volume.position(a);
      curves.points.push_back(from + t * (volume.position(b) - from));
    }
    return at->second;
  };
  for (BoxFace face = 0; face < 6; ++face) {
    const int w = axis_of(face), u = (w + 1) % 3, v = (w + 2) % 3;
    const int columns = dims[u] - 1, squares = columns * (dims[v] - 1);
    for (int n = 0; n < squares; ++n) {
      std::array<Index3, 4> corner;  // around the square
      std::array<double, 4> g{};
      for (int m = 0; m < 4; ++m) {
        Index3& c = corner[static_cast<std::size_t>(m)];
        c[w] = face % 2 == 0 ? 0 : dims[w] - 1;
        c[u] = n % columns + (m == 1 || m == 2 ? 1 : 0);
        c[v] = n / columns + (m >= 2 ? 1 : 0);
        g[static_cast<std::size_t>(m)] = value(c);
      }
      std::vector<std::uint32_t> x;  // the crossings around the square
      for (std::size_t m = 0; m < 4; ++m) {
        const std::size_t next = (m + 1) % 4;
        if ((g[m] >= 0) != (g[next] >= 0)) x.push_back(crossing(corner[m], corner[next]));
      }
      if (x.size() == 2) curves.edges.push_back({x[0], x[1], face});
      if (x.size() != 4) continue;
      // The saddle's sign is that of the larger product. If it is on the side of corner 0, corners
      // 1 and 3 are cut off. A saddle at kappa is inside.
      const double even = g[0] * g[2], odd = g[1] * g[3];
      const std::size_t s = even > odd || (even == odd && g[0] >= 0) ? 0 : 1;
      curves.edges.push_back({x[s], x[s + 1], face});
      curves.edges.push_back({x[s + 2], x[(s + 3) % 4], face});
    }
  }
  return curves;
}

}  // namespace deliso::paper
