// SPDX-License-Identifier: MIT
// The first cells, and bulk insertion.
#include "delaunay/triangulation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "delaunay/hilbert.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

// Returns the first four points, in the given order, that span a tetrahedron; positively oriented.
std::optional<std::array<std::uint32_t, 4>> first_tetrahedron(
    std::span<const Vec3> points, std::span<const std::uint32_t> order) {
  std::array<std::uint32_t, 4> corner;
  int found = 0;
  for (std::uint32_t i : order) {
    const Vec3& p = points[i];
    const auto at = [&](int k) { return points[corner[k]]; };
    const bool independent = found == 0   ? true
                             : found == 1 ? p != at(0)
                             : found == 2 ? !collinear(at(0), at(1), p)
                                          : orient3d(at(0), at(1), at(2), p) != 0;
    if (independent) corner[found++] = i;
    if (found == 4) {
      if (orient3d(at(0), at(1), at(2), at(3)) < 0) std::swap(corner[0], corner[1]);
      return corner;
    }
  }
  return std::nullopt;
}

}  // namespace

void Triangulation::clear() {
  *this = Triangulation();
}

void Triangulation::create_first_cells(const std::array<Vec3, 4>& corners) {
  // Vertex ids: corner k is 1 + k. Cell ids: the finite one is 0, behind its facet i lies 1 + i.
  points_.assign({Vec3{}, corners[0], corners[1], corners[2], corners[3]});
  incident_.assign({1, 0, 0, 0, 0});
  cells_.push_back({{1, 2, 3, 4}, {}});
  for (int i = 0; i < 4; ++i) {
    const auto& f = kFacetVertices[i];
    const auto id = [](int k) { return SiteId(1 + k); };
    cells_.push_back({{kInfinite, id(f[0]), id(f[2]), id(f[1])}, {}});
  }
  marks_.assign(5, 0);
  ranks_.assign(5, 0);
  last_created_ = 0;

  // Any two of these five cells share the one facet that leaves out a vertex of each.
  const auto vertex_missing_in = [](std::uint32_t c) { return SiteId(c); };
  const auto index_of = [&](CellId c, SiteId v) {
    int i = 0;
    while (cells_[c].vertices[i] != v) ++i;
    return i;
  };
  for (CellId a = 0; a < 5; ++a) {
    for (CellId b(a + 1); b < 5; ++b) {
      connect(link({a, index_of(a, vertex_missing_in(b))}),
              link({b, index_of(b, vertex_missing_in(a))}));
    }
  }
}

bool Triangulation::build(std::span<const Vec3> points, std::vector<SiteId>& ids,
                          std::size_t max_cells) {
  clear();
  ids.assign(points.size(), kNoId);
  const std::vector<std::uint32_t> order = biased_hilbert_order(points);
  const auto first = first_tetrahedron(points, order);
  if (!first) return false;

  // Random points have 6.8 cells each; unused memory is never touched.
  const std::size_t expected_cells = 7 * points.size() + 100;
  points_.reserve(points.size() + 1);
  incident_.reserve(points.size() + 1);
  ranks_.reserve(points.size() + 1);
  cells_.reserve(expected_cells);
  marks_.reserve(expected_cells);

  const auto& f = *first;
  create_first_cells({points[f[0]], points[f[1]], points[f[2]], points[f[3]]});
  for (int k = 0; k < 4; ++k) ids[f[k]] = SiteId(1 + k);
  // The order jumps in memory where the points do not: prefetch.
  constexpr std::size_t kPrefetchedPoints = 8;
  std::size_t work = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k],
                        ahead = order[std::min(k + kPrefetchedPoints, order.size() - 1)];
    __builtin_prefetch(&points[ahead]);
    __builtin_prefetch(&ids[ahead]);
    if (ids[i] != kNoId) continue;
    ids[i] = insert(points[i]);
    work += scratch_created_.size() + scratch_zone_.walked;
    if (work / max_cells > points.size()) {
      clear();
      return false;
    }
  }
  return true;
}

void append_auxiliary(const Box3& box, std::vector<Vec3>& points) {
  const Vec3 middle = box.middle();
  const double d = 16 * length(box.size());
  for (const Vec3& to : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    points.push_back(middle + d * to);
  }
}

}  // namespace deliso
