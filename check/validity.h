// SPDX-License-Identifier: MIT
// Checks that triangles are an oriented manifold that ends on the box only. Counts on the corners,
// by sorting; ignores stored neighbors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/box3.h"
#include "base/topology_counts.h"
#include "check/check_mesh.h"
#include "check/faults.h"
#include "mesh/incidence.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// A mesh without duplicate and degenerate triangles. Ids of vertices are those of the mesh; `id`
// gives those of the triangles.
struct CleanMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<FaceId> id;
  std::vector<EdgeUse> uses;  // of the edges, by the triangles

  // Connected through shared vertices; numbered by their smallest vertex.
  std::vector<std::uint32_t> component;  // per vertex; kNoId if no triangle uses it
  MeshTopology topology;
  std::vector<std::uint8_t> broken;  // per component: it has a fault of its own

  // A side of a triangle that no other triangle shares, in its direction.
  struct End {
    std::uint32_t triangle;
    VertexId from, to;
  };
  std::vector<End> ends;  // by triangle, then `from`
  bool as_given = false;  // no triangle was removed, and no vertices are at one position
};

// Where triangles may have edges that no other triangle shares.
enum class MayEnd : std::uint8_t { on_box, nowhere, anywhere };

// Returns the clean mesh and reports its faults. pre: `faults` is empty.
CleanMesh check_validity(const TriMesh& mesh, const Box3& box, MayEnd may_end, Faults& faults);

// Returns the counts of the mesh as it was given.
TopologyCounts counts_of(const TriMesh& mesh, const CleanMesh& clean);

// Return a triangle's words in a fault, and its place.
std::string name_of_triangle(const TriMesh& mesh, FaceId f);
Vec3 middle_of(const TriMesh& mesh, FaceId f);

}  // namespace deliso
