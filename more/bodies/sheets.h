// SPDX-License-Identifier: MIT
// The borders of bodies, or a part of them, as facets between two bodies each. Facets between the
// same two bodies are a sheet. It ends in curves: edges at which there are not just two facets of
// one sheet.
#pragma once

#include <array>
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

// Numbers the corners of facets (`v`) anew, as they come. Returns their old numbers. `known`: of
// each vertex, all kNoId before and afterwards.
template <class Facet>
std::vector<VertexId> number_vertices(std::vector<Facet>& facets,
                                      IdArray<VertexId, VertexId>& known) {
  std::vector<VertexId> used;
  for (Facet& f : facets) {
    for (VertexId& v : f.v) {
      if (known[v] == kNoId) {
        known[v] = VertexId(used.size());
        used.push_back(v);
      }
      v = known[v];
    }
  }
  for (const VertexId v : used) known[v] = kNoId;
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
