// SPDX-License-Identifier: MIT
#include "view/render/seen_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace deliso {
namespace {

// Whether a sample at p, or one of the eight around it, has one of the two facets.
bool is_seen(const Layer& layer, const ProjectedMesh& projected, int row_begin, const Vec2& p,
             FaceId f, FaceId g) {
  const int rows = static_cast<int>(layer.faces.size()) / projected.columns;
  const int column = static_cast<int>(std::floor(p.x));
  const int row = static_cast<int>(std::floor(p.y)) - row_begin;
  for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(projected.columns - 1, column + 1); ++x) {
      const FaceId seen =
          layer.faces[static_cast<std::size_t>(y) * static_cast<std::size_t>(projected.columns) +
                      static_cast<std::size_t>(x)];
      if (seen != kNoId && (seen == f || seen == g)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<SeenEdge> seen_edges(const TriMesh& mesh, const ProjectedMesh& projected,
                                 const Layer& layer, int row_begin) {
  const int rows = static_cast<int>(layer.faces.size()) / projected.columns;
  const auto place = [&](VertexId v) {
    const ProjectedMesh::Point& p = projected.points[v];
    return Vec2{static_cast<double>(p.x) / ProjectedMesh::kUnit,
                static_cast<double>(p.y) / ProjectedMesh::kUnit};
  };
  std::vector<SeenEdge> edges;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const FaceId g = mesh.faces[f].n[i];
      if (g != kNoId && g < f) continue;
      const Vec2 a = place(mesh.faces[f].v[(i + 1) % 3]), b = place(mesh.faces[f].v[(i + 2) % 3]);
      // The part of it within the layer; half a sample at a time.
      double begin = 0, end = 1;
      const auto cut = [&](double from, double to, double lo, double hi) {
        if (from == to) {
          if (from < lo || from > hi) end = -1;
          return;
        }
        const double at_lo = (lo - from) / (to - from), at_hi = (hi - from) / (to - from);
        begin = std::max(begin, std::min(at_lo, at_hi));
        end = std::min(end, std::max(at_lo, at_hi));
      };
      cut(a.x, b.x, 0, projected.columns);
      cut(a.y, b.y, row_begin, row_begin + rows);
      if (begin > end) continue;
      const int steps =
          std::max(1, static_cast<int>(2 * (end - begin) * std::sqrt(distance2(a, b))));
      std::optional<Vec2> first;
      Vec2 last;
      for (int n = 0; n <= steps; ++n) {
        const double t = begin + (end - begin) * n / steps;
        const Vec2 p = a + t * (b - a);
        if (is_seen(layer, projected, row_begin, p, f, g)) {
          if (!first) first = p;
          last = p;
        } else if (first) {
          edges.push_back({*first, last});
          first.reset();
        }
      }
      if (first) edges.push_back({*first, last});
    }
  }
  return edges;
}

}  // namespace deliso
