// SPDX-License-Identifier: MIT
#include "check/place_faults.h"

#include <algorithm>

#include "base/sorted_list.h"
#include "check/self_intersections.h"
#include "check/triangle_tree.h"
#include "exact/predicates.h"
#include "mesh/first_at_place.h"

namespace deliso {
PlaceFaults PlaceFaults::beyond(const PlaceFaults& others) const {
  const auto more = [](std::size_t n, std::size_t m) { return n - std::min(n, m); };
  return {more(crossings, others.crossings), more(flat, others.flat),
          more(coincident, others.coincident)};
}

PlaceFaults find_place_faults(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                              int threads, std::vector<VertexId>* where) {
  PlaceFaults faults;
  std::vector<VertexId> vertices;
  const auto add = [&](const Triangle& t) { vertices.insert(vertices.end(), t.begin(), t.end()); };
  const std::vector<VertexId> first = first_at_place(points);
  for (VertexId v(0); v < first.size(); ++v) {
    if (first[v] == v) continue;
    ++faults.coincident;
    vertices.push_back(v);
    vertices.push_back(first[v]);
  }
  std::vector<Triangle> merged, given;
  for (const Triangle& t : triangles) {
    const Triangle m{first[t[0]], first[t[1]], first[t[2]]};
    if (collinear(points[t[0]], points[t[1]], points[t[2]])) {
      ++faults.flat;
      add(t);
    }
    if (m[0] == m[1] || m[1] == m[2] || m[2] == m[0]) continue;
    merged.push_back(m);
    given.push_back(t);
  }
  const Crossings found =
      find_crossings(points, merged, TriangleTree(points, merged, threads), threads);
  faults.crossings = found.pairs.size() + found.given_up.size();
  if (where == nullptr) return faults;
  for (const auto& [f, g] : found.pairs) {
    add(given[f]);
    add(given[g]);
  }
  for (const FaceId f : found.given_up) add(given[f]);
  sort_unique(vertices);
  *where = std::move(vertices);
  return faults;
}

}  // namespace deliso
