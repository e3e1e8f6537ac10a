// SPDX-License-Identifier: MIT
#include "blocks/components.h"

#include <algorithm>
#include <numeric>
#include <tuple>

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
  std::vector<ContourComponent> pieces;
  std::vector<std::uint64_t> segments;
  std::vector<Vec3> crossings;          // of all blocks
  std::vector<std::uint32_t> piece_at;  // of each crossing
  std::vector<std::uint32_t> first_piece;
  for (const BlockComponents& block : blocks) {
    const auto first = static_cast<std::uint32_t>(pieces.size());
    first_piece.push_back(first);
    pieces.insert(pieces.end(), block.components.begin(), block.components.end());
    segments.insert(segments.end(), block.segments_on_inner.begin(), block.segments_on_inner.end());
    for (const BlockComponents::Crossing& c : block.crossings) {
      crossings.push_back(c.point);
      piece_at.push_back(first + c.component);
    }
  }
  DisjointSets sets(pieces.size());
  const std::vector<VertexId> first_at = first_at_place(crossings);
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    if (first_at[n] == n) continue;
    sets.unite(piece_at[first_at[n]], piece_at[n]);
    --pieces[piece_at[n]].crossings;  // counted by both
    --pieces[piece_at[n]].euler;
  }
  // Segments were counted by both blocks, too; the first gives up its count in pairs below.
  const std::vector<std::uint32_t> set = sets.take_numbers();
  const std::size_t count = set.empty() ? 0 : 1 + *std::ranges::max_element(set);
  std::vector<ContourComponent> all(count);
  std::vector<std::uint64_t> twice(count, 0);
  // The piece that visits the component's first voxel. Two components may have the same first
  // voxel; then both pieces are of its block, which has them in the order of the whole.
  std::vector<std::size_t> first_of(count, pieces.size());
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    ContourComponent& into = all[set[n]];
    const ContourComponent& piece = pieces[n];
    twice[set[n]] += segments[n];
    std::size_t& first = first_of[set[n]];
    if (first == pieces.size()) {
      first = n;
      into = piece;
      into.boundary_loops = 0;
      continue;
    }
    into.add(piece);
    if (voxel_number(dims, piece.first) < voxel_number(dims, into.first)) {
      into.first = piece.first;
      first = n;
    }
  }
  AllComponents out;
  std::vector<std::uint32_t> order(count), place(count);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t c) {
    return std::pair(voxel_number(dims, all[c].first), first_of[c]);
  });
  out.topology.components = count;
  for (std::uint32_t n = 0; n < count; ++n) {
    place[order[n]] = n;
    ContourComponent& component = all[order[n]];
    component.euler += static_cast<std::int64_t>(twice[order[n]] / 2);
    out.topology.euler += component.euler;
    out.components.push_back(component);
  }
  out.topology.boundary_loops = loops_of(blocks);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<std::uint32_t>& numbers = out.number.emplace_back();
    for (std::size_t c = 0; c < blocks[b].components.size(); ++c) {
      numbers.push_back(place[set[first_piece[b] + c]]);
    }
  }
  return out;
}

}  // namespace deliso
