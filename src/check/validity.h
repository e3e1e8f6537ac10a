// SPDX-License-Identifier: MIT
// Whether triangles are a mesh at all: an oriented manifold that ends on the box only. Counts on
// the corners, by sorting; stored neighbors are not looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box3.h"
#include "check/faults.h"
#include "mesh/check_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// What is left of a mesh once doubles and degenerate triangles are out. Ids of vertices are those
// of the mesh; `id` gives those of the triangles.
struct CleanMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<FaceId> id;

  // Connected through shared vertices; numbered by their smallest vertex.
  std::vector<std::uint32_t> component;  // per vertex; kNoId where no triangle uses it
  MeshTopology topology;
  std::vector<std::uint8_t> broken;  // per component: it has a fault of its own

  // A side of a triangle that no other one shares, as it runs along it.
  struct End {
    std::uint32_t triangle;
    VertexId from, to;
  };
  std::vector<End> ends;  // by triangle, then `from`
  bool as_given = false;  // nothing was left out, and no vertices are at one position
};

// Where triangles may have edges that no other one shares.
enum class MayEnd : std::uint8_t { on_box, nowhere };

// Reports into `faults`, which have none yet. `tolerance`: how far a vertex may be from the box and
// count as on it.
CleanMesh check_validity(const TriMesh& mesh, const Box3& box, double tolerance, MayEnd may_end,
                         Faults& faults);

}  // namespace deliso
