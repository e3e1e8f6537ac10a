// SPDX-License-Identifier: MIT
#include "mesh/star.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "base/disjoint_sets.h"
#include "base/sorted_list.h"

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

const char* name_of(Star star) {
  constexpr const char* names[] = {"empty", "disk", "half disk", "singular"};
  return names[static_cast<std::size_t>(star)];
}

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
  std::vector<VertexId> ends, around;
  for (const Triangle& t : triangles) {
    const LinkEdge edge = link_edge(q, t);
    ends.insert(ends.end(), {edge.a, edge.b});
  }
  around = ends;
  sort_unique(around);
  for (VertexId& end : ends) {
    end = VertexId(std::lower_bound(around.begin(), around.end(), end) - around.begin());
  }
  DisjointSets pieces(around.size());
  std::vector<std::uint8_t> uses(around.size(), 0);
  for (std::size_t n = 0; n < ends.size(); n += 2) pieces.unite(ends[n], ends[n + 1]);
  for (const VertexId end : ends) uses[end] = static_cast<std::uint8_t>(std::min(2, uses[end] + 1));
  const auto loose_ends = static_cast<std::size_t>(std::count(uses.begin(), uses.end(), 1));
  VertexLink link{0, around.size(), loose_ends};
  for (std::uint32_t n = 0; n < around.size(); ++n) link.fans += pieces.find(n) == n;
  return link;
}

}  // namespace deliso
