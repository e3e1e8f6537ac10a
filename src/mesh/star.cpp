// SPDX-License-Identifier: MIT
#include "mesh/star.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/check.h"

namespace deliso {
namespace {

constexpr std::size_t kSmall = 64;

struct LinkEdge {
  VertexId a, b;
};

// The side of t opposite q; a == b == q when t is degenerate in a way that leaves no such side.
LinkEdge link_edge(VertexId q, const Triangle& t) {
  const int i = t[0] == q ? 0 : t[1] == q ? 1 : 2;
  DELISO_ASSERT(t[i] == q);
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

bool is_degenerate(VertexId q, const LinkEdge& e) {
  return e.a == e.b || e.a == q || e.b == q;
}

enum class Step { moved, stuck, branched };

// Moves `end` along the only edge of `rest` that holds it and takes that edge out of `rest`.
Step advance(VertexId& end, std::span<LinkEdge>& rest) {
  std::size_t found = rest.size();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i].a != end && rest[i].b != end) continue;
    if (found != rest.size()) return Step::branched;
    found = i;
  }
  if (found == rest.size()) return Step::stuck;
  end = rest[found].a == end ? rest[found].b : rest[found].a;
  rest[found] = rest.back();
  rest = rest.first(rest.size() - 1);
  return Step::moved;
}

// Walks from the first edge both ways. An edge once walked is gone, and a vertex is left only when
// it has no other edge, so the walk is simple; what remains lies apart from it.
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

// The same decision for long links. Each end of a link edge is an arc out of a vertex; in the
// sorted list the two arcs of a vertex lie side by side.
Star walk_large_link(std::span<const LinkEdge> edges) {
  std::vector<std::pair<VertexId, std::uint32_t>> arcs;  // vertex, 2 * edge + end
  for (std::size_t e = 0; e < edges.size(); ++e) {
    arcs.emplace_back(edges[e].a, static_cast<std::uint32_t>(2 * e));
    arcs.emplace_back(edges[e].b, static_cast<std::uint32_t>(2 * e + 1));
  }
  std::sort(arcs.begin(), arcs.end());

  // mate[arc] is the other arc at the same vertex, the arc itself at the end of a path.
  std::vector<std::uint32_t> mate(arcs.size());
  std::uint32_t start = 0;
  std::size_t loose_ends = 0;
  for (std::size_t i = 0, j; i < arcs.size(); i = j) {
    for (j = i + 1; j < arcs.size() && arcs[j].first == arcs[i].first;) ++j;
    if (j - i > 2) return Star::singular;
    if (j - i == 1) {
      ++loose_ends;
      start = arcs[i].second;
    }
    mate[arcs[i].second] = arcs[j - 1].second;
    mate[arcs[j - 1].second] = arcs[i].second;
  }

  // With at most two arcs a vertex the link is a union of paths and cycles: one of them has to
  // hold all edges. Arcs 2 e and 2 e + 1 are the ends of e.
  std::uint32_t arc = start;
  std::size_t walked = 0;
  do {
    ++walked;
    const std::uint32_t far_end = arc ^ 1;
    arc = mate[far_end];
    if (arc == far_end) break;
  } while (arc != start);
  if (walked != edges.size()) return Star::singular;
  return loose_ends == 0 ? Star::disk : Star::half_disk;
}

}  // namespace

const char* name_of(Star star) {
  constexpr const char* names[] = {"empty", "disk", "half disk", "singular"};
  return names[static_cast<std::size_t>(star)];
}

Star classify_star(VertexId q, std::span<const Triangle> triangles) {
  if (triangles.empty()) return Star::empty;
  std::array<LinkEdge, kSmall> small;
  std::vector<LinkEdge> large;
  if (triangles.size() > kSmall) large.resize(triangles.size());
  const std::span<LinkEdge> edges =
      large.empty() ? std::span(small).first(triangles.size()) : std::span(large);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    edges[i] = link_edge(q, triangles[i]);
    if (is_degenerate(q, edges[i])) return Star::singular;
  }
  return large.empty() ? walk_small_link(edges) : walk_large_link(edges);
}

}  // namespace deliso
