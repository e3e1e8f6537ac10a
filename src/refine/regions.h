// SPDX-License-Identifier: MIT
// The mesh cut into regions that are refined by themselves, side by side, and put together again.
//
// Planes cut space into boxes that share no point. A region is the facets that lie in one box and
// touch no boundary edge; they alone are replaced, and by facets in the same box, so facets of two
// regions never meet, and the tests of refine/refinement.h keep what they keep. Other facets that
// reach into the box are there to be seen, and are frozen. Once all is put together, facets near
// the cuts are refined like any other.
//
// The cuts follow from the mesh alone, so the result does not depend on who refines what or when.
// And a region is small: what it uses of mesh, hashes and volume stays in a cache.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/region.h"
#include "surface/surface_mesh.h"

namespace deliso {

// A region with a mesh of its own: the frozen facets first, then its own, then what is new.
struct MeshRegion {
  Region region;
  SurfaceMesh surface;  // without chain
  // In the whole mesh, of the vertices and facets that are not new.
  std::vector<VertexId> vertices;
  std::vector<FaceId> facets;
};

// The boxes, by number; fewer than two: the mesh is too small to be cut. Each has about `most`
// facets or fewer.
class Cut {
 public:
  // pre: no facet is dead.
  Cut(const SurfaceMesh& whole, std::size_t most);

  std::size_t size() const { return leaves_.size(); }
  // The region in box n.
  MeshRegion extract(const SurfaceMesh& whole, std::size_t n) const;
  // The box that holds p.
  std::size_t box_at(const Vec3& p) const;
  const Region& box(std::size_t n) const { return leaves_[n].box; }

 private:
  struct Leaf {
    Region box;
    std::vector<FaceId> frozen, facets;  // that reach into it; that lie in it; ascending
  };
  struct Node {
    int axis = -1;             // -1: a leaf
    double plane = 0;          // the upper child begins there
    std::size_t children = 0;  // the lower one, and the upper one behind it; of a leaf its number
  };
  void divide(const SurfaceMesh& whole, std::size_t node, Leaf&& leaf, std::size_t most);

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

// Puts a region back where it was taken from; what it has more is appended. Dead facets stay.
// Returns the numbers in the whole mesh of the region's facets.
std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshRegion& region);

}  // namespace deliso
