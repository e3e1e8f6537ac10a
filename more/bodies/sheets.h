// SPDX-License-Identifier: MIT
// The borders of bodies, or a part of them, as facets between two bodies each. Facets between the
// same two bodies are a sheet. It ends in curves: edges at which there are not just two facets of
// one sheet.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/tri_mesh.h"
#include "more/bodies/partition.h"

namespace deliso {

struct SheetFacet {
  Triangle v;                    // counter-clockwise seen from the body in front
  std::array<BodyId, 2> bodies;  // in front and behind (Partition::in_order)
  bool is_done = false;          // nothing near it is left to do in this stage
};

// Numbers the corners of facets (`v`) anew, from 0 on in their order. Returns their old numbers.
template <class Facet>
std::vector<VertexId> number_vertices(std::vector<Facet>& facets) {
  std::uint32_t least = kNoId, most = 0;
  for (const Facet& f : facets) {
    for (const VertexId v : f.v) {
      least = std::min(least, v.number());
      most = std::max(most, v.number());
    }
  }
  // 64 old numbers: which are used, and how many are before them.
  struct Run {
    std::uint64_t is_used = 0;
    std::uint32_t before = 0;
  };
  std::vector<Run> runs(facets.empty() ? 0 : (most - least) / 64 + 1);
  const auto bit = [least](VertexId v) { return std::uint64_t{1} << (v.number() - least) % 64; };
  const auto run = [&](VertexId v) -> Run& { return runs[(v.number() - least) / 64]; };
  for (const Facet& f : facets) {
    for (const VertexId v : f.v) run(v).is_used |= bit(v);
  }
  std::vector<VertexId> used;
  for (std::size_t n = 0; n < runs.size(); ++n) {
    runs[n].before = static_cast<std::uint32_t>(used.size());
    for (std::uint64_t left = runs[n].is_used; left != 0; left &= left - 1) {
      used.emplace_back(least + 64 * n + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }
  for (Facet& f : facets) {
    for (VertexId& v : f.v) {
      const Run& in = run(v);
      v = VertexId(in.before + static_cast<std::size_t>(std::popcount(in.is_used & (bit(v) - 1))));
    }
  }
  return used;
}

struct Sheets {
  std::vector<Vec3> points;
  std::vector<SheetFacet> facets;
  // The facets from this one on may not change: they are there for what is beside them.
  std::size_t free_facets = 0;
};

// Sheets cut along their curves. There each vertex has a copy in every sheet, and two where a sheet
// ends twice; so the mesh is a manifold with a boundary.
struct CutSheets {
  explicit CutSheets(const Sheets& sheets);

  TriMesh mesh;                               // facet f is that of the sheets
  IdArray<VertexId, VertexId> vertex;         // of each copy
  IdArray<VertexId, VertexId> next;           // copy of the same vertex, in a ring
  IdArray<VertexId, FaceId> facet;            // one at each copy; kNoId: none
  IdArray<VertexId, std::uint8_t> is_open;    // the copy is on a curve
  std::vector<std::uint32_t> sheet;           // of each facet
  std::vector<std::array<BodyId, 2>> sheets;  // the bodies of each
};

}  // namespace deliso
