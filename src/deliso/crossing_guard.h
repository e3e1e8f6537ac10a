// SPDX-License-Identifier: MIT
// Keeps Stage 2 from making facets that cross others, in the voxels where it has done so: there
// every new facet is held, by exact predicates, against all facets near by. Elsewhere the surface
// itself keeps facets apart, and asking would only cost time.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

class CrossingGuard {
 public:
  // Guards these voxels (voxel_number()s) and all that touch one of them. Keeps references.
  CrossingGuard(const Volume& volume, const TriMesh& mesh, std::span<const std::uint64_t> voxels);

  bool is_on() const { return !facets_.empty(); }
  // f is new, or has other corners than before.
  void add(FaceId f);
  // Whether one of the `created` triangles crosses another of them, or a facet of the mesh that is
  // none of the `removed` ones. Triangles without area count as crossing.
  bool would_cross(std::span<const Triangle> created, std::span<const FaceId> removed) const;

 private:
  // Calls visit(voxel number) for every voxel that the box of the triangle meets.
  template <class Visit>
  void for_each_voxel(const Triangle& t, Visit&& visit) const;

  const Volume& volume_;
  const TriMesh& mesh_;
  // By guarded voxel, the facets that meet it; also such as did once.
  std::unordered_map<std::uint64_t, std::vector<FaceId>> facets_;
};

}  // namespace deliso
