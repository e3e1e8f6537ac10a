// SPDX-License-Identifier: MIT
// Keeps Stage 2 from making facets that cross others, in the voxels where it has done so: there
// every new facet is held, by exact predicates, against all facets near by. Elsewhere the surface
// itself keeps facets apart, and asking would only cost time.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

class CrossingGuard {
 public:
  // Guards these voxels (voxel_number()s) and all that touch one of them, looking facets up by
  // cells of about `cell`, voxels at most: best the size of most facets. Keeps references.
  CrossingGuard(const Volume& volume, const TriMesh& mesh, std::span<const std::uint64_t> voxels,
                double cell);

  // Where facets keep crossing whatever is refused, Stage 2 would go on for ever: the guard goes
  // off after so many tests.
  bool is_on() const { return tests_left_ > 0; }
  // f is new, or has other corners than before.
  void add(FaceId f);
  // Whether one of the `created` triangles crosses another of them, or a facet of the mesh that is
  // none of the `removed` ones. Triangles without area count as crossing.
  bool would_cross(std::span<const Triangle> created, std::span<const FaceId> removed) const;

 private:
  // Calls visit(cell number) for every cell in a guarded voxel that the box of the triangle meets.
  template <class Visit>
  void for_each_cell(const Triangle& t, Visit&& visit) const;

  const Volume& volume_;
  const TriMesh& mesh_;
  std::unordered_set<std::uint64_t> voxels_;  // guarded
  Index3 cells_;                              // of a voxel, along each axis
  // The facets that meet a cell; also such as did once, until there are `full` of them.
  struct List {
    std::vector<FaceId> facets;
    std::size_t full = 32;
  };
  void tidy(std::uint64_t cell, List& list) const;
  std::unordered_map<std::uint64_t, List> facets_;
  mutable std::size_t tests_left_ = 0;
};

}  // namespace deliso
