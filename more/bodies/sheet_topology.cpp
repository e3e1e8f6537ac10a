// SPDX-License-Identifier: MIT
#include "more/bodies/sheet_topology.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/sorted_list.h"

namespace deliso {
namespace {

// A node: a copy of a vertex, on one of the two sides of its sheet.
constexpr std::uint32_t node(VertexId copy, std::size_t side) {
  return 2 * copy.number() + static_cast<std::uint32_t>(side);
}

class Surfaces {
 public:
  Surfaces(const Sheets& sheets, const Partition& partition, bool is_closed,
           std::span<const std::uint64_t> key)
      : cut_(sheets),
        partition_(partition),
        is_closed_(is_closed),
        key_(key),
        box_(partition.shape().box()),
        joined_(2 * cut_.vertex.size()),
        rim_(2 * cut_.vertex.size()),
        is_on_rim_(2 * cut_.vertex.size()) {
    counts_.twice_euler.resize(partition.size());
  }

  SurfaceCounts count() {
    for (FaceId f = 0; f < cut_.mesh.faces.size(); ++f) {
      if (is_counted(cut_.sheet[f])) add_facet(f);
    }
    IdArray<VertexId, std::uint8_t> is_seen(key_.size());
    for (VertexId c = 0; c < cut_.vertex.size(); ++c) {
      if (std::exchange(is_seen[cut_.vertex[c]], 1) == 0) join_copies(c);
    }
    add_vertices();
    return std::move(counts_);
  }

 private:
  bool is_counted(std::uint32_t sheet) const {
    return is_closed_ || !partition_.is_beyond(cut_.sheets[sheet][0]);
  }
  bool is_counted(std::uint32_t sheet, std::size_t side) const {
    return is_counted(sheet) && !partition_.is_beyond(cut_.sheets[sheet][side]);
  }

  // A facet has three halves of edges on each side, and another for each end of the surface.
  void add_facet(FaceId f) {
    const Face& face = cut_.mesh.faces[f];
    for (std::size_t side = 0; side < 2; ++side) {
      if (!is_counted(cut_.sheet[f], side)) continue;
      std::int64_t& twice = counts_.twice_euler[cut_.sheets[cut_.sheet[f]][side]];
      twice += 2 - 3;
      joined_.unite(node(face.v[0], side), node(face.v[1], side));
      joined_.unite(node(face.v[0], side), node(face.v[2], side));
      for (std::size_t i = 0; i < 3 && !is_closed_; ++i) {
        const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
        if (face.n[i] != kNoId || !on_one_face(cut_.mesh.points[a], cut_.mesh.points[b], box_)) {
          continue;
        }
        --twice;
        rim_.unite(node(a, side), node(b, side));
        is_on_rim_[node(a, side)] = is_on_rim_[node(b, side)] = 1;
      }
    }
  }

  // Joins the nodes of one body at the vertex of this copy, and remembers the first of each.
  void join_copies(VertexId copy) {
    std::vector<std::pair<BodyId, std::uint32_t>> nodes;
    VertexId c = copy;
    do {
      const std::uint32_t sheet = cut_.sheet[cut_.facet[c]];
      for (std::size_t side = 0; side < 2; ++side) {
        if (is_counted(sheet, side)) nodes.emplace_back(cut_.sheets[sheet][side], node(c, side));
      }
      c = cut_.next[c];
    } while (c != copy);
    std::ranges::sort(nodes);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& [body, at] = nodes[n];
      if (n == 0 || nodes[n - 1].first != body) {
        firsts_.push_back({at, body, cut_.vertex[copy]});
        continue;
      }
      const std::uint32_t first = firsts_.back().node;
      joined_.unite(first, at);
      rim_.unite(first, at);
      is_on_rim_[first] |= is_on_rim_[at];
    }
  }

  void add_vertices() {
    const std::vector<std::uint32_t> component = joined_.take_numbers(), loop = rim_.take_numbers();
    std::vector<std::uint32_t> components(component.size(), kNoId), loops(loop.size(), kNoId);
    const auto number = [](std::uint32_t& known, std::vector<BodyId>& all, BodyId body) {
      if (known == kNoId) {
        known = static_cast<std::uint32_t>(all.size());
        all.push_back(body);
      }
      return known;
    };
    for (const First& first : firsts_) {
      const std::uint32_t in =
          number(components[component[first.node]], counts_.components, first.body);
      const std::uint32_t on = is_on_rim_[first.node] != 0
                                   ? number(loops[loop[first.node]], counts_.loops, first.body)
                                   : std::uint32_t(kNoId);
      const std::uint64_t key = key_[first.vertex.number()];
      if (key == SurfaceCounts::kOwn) {
        counts_.twice_euler[first.body] += 2;
      } else {
        counts_.shared.push_back({key, first.body, in, on});
      }
    }
  }

  CutSheets cut_;
  const Partition& partition_;
  const bool is_closed_;
  std::span<const std::uint64_t> key_;
  const Box3 box_;
  DisjointSets joined_, rim_;
  std::vector<std::uint8_t> is_on_rim_;
  // The first node of each body at each vertex.
  struct First {
    std::uint32_t node;
    BodyId body;
    VertexId vertex;
  };
  std::vector<First> firsts_;
  SurfaceCounts counts_;
};

}  // namespace

SurfaceCounts count_surfaces(const Sheets& sheets, const Partition& partition, bool is_closed,
                             std::span<const std::uint64_t> key) {
  return Surfaces(sheets, partition, is_closed, key).count();
}

std::vector<TopologyCounts> total(std::span<const SurfaceCounts> pieces, std::size_t bodies) {
  std::vector<std::int64_t> twice_euler(bodies);
  std::vector<BodyId> components, loops;
  std::vector<SurfaceCounts::Shared> shared;
  for (const SurfaceCounts& piece : pieces) {
    for (BodyId b = 0; b < bodies; ++b) twice_euler[b] += piece.twice_euler[b];
    for (SurfaceCounts::Shared s : piece.shared) {
      s.component += static_cast<std::uint32_t>(components.size());
      if (s.loop != kNoId) s.loop += static_cast<std::uint32_t>(loops.size());
      shared.push_back(s);
    }
    components.insert(components.end(), piece.components.begin(), piece.components.end());
    loops.insert(loops.end(), piece.loops.begin(), piece.loops.end());
  }
  std::ranges::sort(shared, {},
                    [](const auto& s) { return std::tuple(s.key, s.body, s.loop, s.component); });
  DisjointSets joined(components.size()), rim(loops.size());
  for (std::size_t n = 0; n < shared.size(); ++n) {
    const SurfaceCounts::Shared &s = shared[n], &last = shared[n == 0 ? 0 : n - 1];
    if (n == 0 || s.key != last.key || s.body != last.body) {
      twice_euler[s.body] += 2;
      continue;
    }
    joined.unite(s.component, last.component);
    if (s.loop != kNoId) rim.unite(s.loop, last.loop);
  }
  std::vector<TopologyCounts> counts(bodies);
  for (BodyId b = 0; b < bodies; ++b) counts[b].euler = twice_euler[b] / 2;
  for (std::uint32_t n = 0; n < components.size(); ++n) {
    if (joined.find(n) == n) ++counts[components[n]].components;
  }
  for (std::uint32_t n = 0; n < loops.size(); ++n) {
    if (rim.find(n) == n) ++counts[loops[n]].boundary_loops;
  }
  return counts;
}

}  // namespace deliso
