// SPDX-License-Identifier: MIT
#include "mesh/star.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "base/disjoint_sets.h"

namespace deliso {
namespace {

struct LinkEdge {
  VertexId a, b;
};

// Returns the side of t opposite q; a == b == q if t is degenerate and has none.
LinkEdge link_edge(VertexId q, const Triangle& t) {
  const int i = t[0] == q ? 0 : t[1] == q ? 1 : 2;
  DELISO_ASSERT(t[i] == q);
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

bool is_degenerate(VertexId q, const LinkEdge& e) {
  return e.a == e.b || e.a == q || e.b == q;
}

}  // namespace

Star classify_star(VertexId q, std::span<const Triangle> triangles) {
  if (triangles.empty()) return Star::empty;
  const std::size_t count = triangles.size();
  for (const Triangle& t : triangles) {
    if (is_degenerate(q, link_edge(q, t))) return Star::singular;
  }
  // Connected, with as many vertices as edges and no loose end, the link is a cycle. A tree with
  // two loose ends is a path.
  const VertexLink link = link_of(q, triangles);
  if (link.fans != 1) return Star::singular;
  if (link.vertices == count && link.loose_ends == 0 && count > 2) return Star::disk;
  return link.vertices == count + 1 && link.loose_ends == 2 ? Star::half_disk : Star::singular;
}

VertexLink link_of(VertexId q, std::span<const Triangle> triangles) {
  // The ends of the link's edges, with their triangles: sorted, those at one vertex are adjacent.
  std::vector<std::uint64_t> ends;
  ends.reserve(2 * triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const LinkEdge edge = link_edge(q, triangles[n]);
    for (const std::uint64_t end : {edge.a, edge.b}) ends.push_back(end << 32 | n);
  }
  std::sort(ends.begin(), ends.end());
  DisjointSets pieces(triangles.size());
  VertexLink link;
  for (std::size_t i = 0, j; i < ends.size(); i = j) {
    const auto triangle = static_cast<std::uint32_t>(ends[i]);
    for (j = i + 1; j < ends.size() && ends[j] >> 32 == ends[i] >> 32; ++j) {
      pieces.unite(triangle, static_cast<std::uint32_t>(ends[j]));
    }
    ++link.vertices;
    link.loose_ends += j == i + 1;
  }
  for (std::uint32_t n = 0; n < triangles.size(); ++n) link.fans += pieces.find(n) == n;
  return link;
}

}  // namespace deliso
