// SPDX-License-Identifier: MIT
#include "blocks/components.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

std::uint64_t loops_of(std::span<const BlockComponents> blocks) {
  std::vector<Vec3> ends;  // two of each arc
  std::uint64_t loops = 0;
  for (const BlockComponents& block : blocks) {
    loops += block.closed_curves;
    for (const BlockComponents::Arc& arc : block.arcs) {
      ends.insert(ends.end(), {arc.from, arc.to});
    }
  }
  const std::vector<VertexId> first = first_at_place(ends);
  DisjointSets arcs(ends.size() / 2);
  for (std::uint32_t n = 0; n < ends.size(); ++n) arcs.unite(n / 2, first[n].number() / 2);
  for (std::uint32_t arc = 0; arc < ends.size() / 2; ++arc) loops += arcs.find(arc) == arc;
  return loops;
}

// A component of a block's contour.
struct Piece {
  std::uint64_t first_voxel;
  std::uint32_t block, component;
};

// Returns the components of all blocks by first voxel. Those with the same one are of one block,
// and stay in its order, which is that of the whole.
std::vector<Piece> by_first_voxel(std::span<const BlockComponents> blocks, Index3 dims) {
  std::vector<Piece> pieces;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    const std::vector<ContourComponent>& components = blocks[b].components;
    for (std::uint32_t c = 0; c < components.size(); ++c) {
      pieces.push_back({voxel_number(dims, components[c].first), b, c});
    }
  }
  std::ranges::stable_sort(pieces, {}, &Piece::first_voxel);
  return pieces;
}

// Unites pieces that have a crossing in common. Returns a piece for every time that a crossing was
// counted before by another block. `number`: the pieces, per block and component.
std::vector<std::uint32_t> unite_at_crossings(std::span<const BlockComponents> blocks,
                                              std::span<const std::vector<std::uint32_t>> number,
                                              DisjointSets& sets) {
  std::vector<Vec3> crossings;          // of all blocks
  std::vector<std::uint32_t> piece_at;  // of each crossing
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const BlockComponents::Crossing& c : blocks[b].crossings) {
      crossings.push_back(c.point);
      piece_at.push_back(number[b][c.component]);
    }
  }
  const std::vector<VertexId> first_at = first_at_place(crossings);
  std::vector<std::uint32_t> repeats;
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    if (first_at[n] == n) continue;
    sets.unite(piece_at[first_at[n]], piece_at[n]);
    repeats.push_back(piece_at[n]);
  }
  return repeats;
}

}  // namespace

BlockComponents components_of(const ContourMesh& contour, const Volume& block) {
  BlockComponents out;
  out.components = contour.summary.components;
  out.segments_on_inner.resize(out.components.size(), 0);
  const Index3 begin = block.first();
  for (ContourComponent& c : out.components) {
    c.first = c.first + begin;
    c.lo = c.lo + begin;
    c.hi = c.hi + begin;
  }
  for (std::size_t l = 0; l < contour.boundary.size(); ++l) {
    const std::uint32_t component = contour.boundary.component[l];
    const BoundaryLoop& loop = contour.boundary.loops[l];
    const std::size_t n = loop.size();
    const auto is_inner = [&](std::size_t k) { return loop[k % n].is_fixed; };
    const auto point = [&](std::size_t k) { return loop[k % n].point; };
    std::size_t begin_outer = n;
    for (std::size_t k = 0; k < n; ++k) {
      out.segments_on_inner[component] += is_inner(k);
      if (is_inner(k) || is_inner(k + n - 1)) out.crossings.push_back({point(k), component});
      if (!is_inner(k) && is_inner(k + n - 1)) begin_outer = k;
    }
    if (begin_outer == n) {
      out.closed_curves += !is_inner(0);
      continue;
    }
    for (std::size_t k = begin_outer, start = k; k < begin_outer + n; ++k) {
      if (is_inner(k)) continue;
      if (is_inner(k + n - 1)) start = k;
      if (is_inner(k + 1)) out.arcs.push_back({point(start), point(k + 1)});
    }
  }
  return out;
}

AllComponents joined(std::span<const BlockComponents> blocks, Index3 dims) {
  // Pieces are numbered by first voxel, and sets by first piece. So components are, too.
  const std::vector<Piece> pieces = by_first_voxel(blocks, dims);
  AllComponents out;
  for (const BlockComponents& block : blocks) out.number.emplace_back(block.components.size());
  for (std::uint32_t n = 0; n < pieces.size(); ++n) {
    out.number[pieces[n].block][pieces[n].component] = n;
  }
  DisjointSets sets(pieces.size());
  const std::vector<std::uint32_t> repeats = unite_at_crossings(blocks, out.number, sets);
  const std::vector<std::uint32_t> set = sets.take_numbers();

  std::vector<std::uint64_t> segments;  // on inner faces, per component
  for (std::uint32_t n = 0; n < pieces.size(); ++n) {
    const BlockComponents& block = blocks[pieces[n].block];
    const ContourComponent& piece = block.components[pieces[n].component];
    if (set[n] == out.components.size()) {
      out.components.push_back(piece);
      out.components.back().boundary_loops = 0;
      segments.push_back(0);
    } else {
      out.components[set[n]].add(piece);
    }
    segments[set[n]] += block.segments_on_inner[pieces[n].component];
    out.number[pieces[n].block][pieces[n].component] = set[n];
  }
  // Euler is V - E + F. Vertices and edges on inner faces count once.
  for (const std::uint32_t n : repeats) {
    --out.components[set[n]].crossings;
    --out.components[set[n]].euler;
  }
  for (std::size_t c = 0; c < out.components.size(); ++c) {
    out.components[c].euler += static_cast<std::int64_t>(segments[c] / 2);  // two blocks had each
    out.topology.euler += out.components[c].euler;
  }
  out.topology.components = out.components.size();
  out.topology.boundary_loops = loops_of(blocks);
  return out;
}

}  // namespace deliso
