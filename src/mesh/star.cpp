// SPDX-License-Identifier: MIT
#include "mesh/star.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/disjoint_sets.h"
#include "base/sorted_list.h"

namespace deliso {
namespace {

constexpr std::size_t kSmall = 64;

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

enum class Step { moved, stuck, branched };

// Moves `end` along the only edge of `rest` that holds it, and removes that edge from `rest`.
Step advance(VertexId& end, std::span<LinkEdge>& rest) {
  std::size_t found = rest.size();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i].a != end && rest[i].b != end) continue;
    if (found != rest.size()) return Step::branched;
    found = i;
  }
  if (found == rest.size()) return Step::stuck;
  end = rest[found].a == end ? rest[found].b : rest[found].a;
  std::swap(rest[found], rest.back());
  rest = rest.first(rest.size() - 1);
  return Step::moved;
}

// Walks from the first edge in both directions. A walked edge is removed, and a vertex is left only
// if it has no other edge. So the walk is simple, and the remaining edges are apart from it.
Star walk_small_link(std::span<LinkEdge> edges) {
  const std::size_t count = edges.size();
  VertexId head = edges[0].a, tail = edges[0].b;
  std::span<LinkEdge> rest = edges.subspan(1);
  for (Step step = Step::moved; step != Step::stuck;) {
    step = advance(tail, rest);
    if (step == Step::branched) return Star::singular;
    if (tail == head) return rest.empty() && count > 2 ? Star::disk : Star::singular;
  }
  for (Step step = Step::moved; step != Step::stuck;) {
    step = advance(head, rest);
    if (step == Step::branched) return Star::singular;
  }
  return rest.empty() ? Star::half_disk : Star::singular;
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
  const std::size_t count = triangles.size();
  if (count == 0) return {};
  if (count <= kSmall) {
    std::array<LinkEdge, kSmall> edges;
    for (std::size_t n = 0; n < count; ++n) edges[n] = link_edge(q, triangles[n]);
    const Star star = walk_small_link(std::span(edges).first(count));
    if (star == Star::disk) return {1, count, 0};
    if (star == Star::half_disk) return {1, count + 1, 2};
  }
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
