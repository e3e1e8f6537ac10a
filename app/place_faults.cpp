// SPDX-License-Identifier: MIT
#include "app/place_faults.h"

#include <algorithm>
#include <vector>

#include "app/text.h"
#include "delaunay/predicates.h"
#include "embedding/self_intersections.h"
#include "mesh/first_at_place.h"

namespace deliso {

PlaceFaults PlaceFaults::beyond(const PlaceFaults& others) const {
  const auto more = [](std::size_t n, std::size_t m) { return n - std::min(n, m); };
  return {more(crossings, others.crossings), more(flat, others.flat),
          more(coincident, others.coincident)};
}

PlaceFaults count_place_faults(std::span<const Vec3> points, std::span<const Face> faces,
                               int threads) {
  PlaceFaults faults;
  faults.crossings = count_crossings(points, faces, threads);
  for (const Face& face : faces) {
    const auto& [a, b, c] = face.v;
    faults.flat += collinear(points[a.number()], points[b.number()], points[c.number()]) ? 1 : 0;
  }
  const std::vector<VertexId> first = first_at_place(points);
  for (std::size_t v = 0; v < first.size(); ++v) faults.coincident += first[v] < v ? 1 : 0;
  return faults;
}

std::string place_faults_text(const PlaceFaults& faults) {
  std::string text;
  const auto add = [&](std::size_t n, const char* one, const char* many, const char* what) {
    if (n > 0) text.append(text.empty() ? "" : ", ").append(counted(n, one, many)).append(what);
  };
  add(faults.crossings, "pair", "pairs", " of triangles cross");
  add(faults.flat, "triangle", "triangles", " flat");
  add(faults.coincident, "vertex", "vertices", " coincide with others");
  return text;
}

}  // namespace deliso
