// SPDX-License-Identifier: MIT
// The mesh cut into parts that are refined by themselves, side by side, and put together again.
//
// Space is cut by planes into boxes that share no point. A part is the facets that lie in one box
// and touch no boundary edge; they alone are replaced, and by facets in the same box alone, so that
// facets of two parts never meet, and the gates of refine/replace_disk.h keep what they keep. Other
// facets that reach into the box are there to be seen, and stay as they are; once all is put
// together they, and what was refused for their sake, are refined like any other.
//
// The cuts follow from the mesh alone, so the result does not depend on who refines what or when.
// And a part is small: what it takes of mesh, grids and volume stays in a cache.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "surface/surface_mesh.h"

namespace deliso {

// What may be replaced: facets from `first` on, by such that lie in the box, which is half open.
struct Part {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  FaceId first = 0;
  Vec3 lo{-kFar, -kFar, -kFar}, hi{kFar, kFar, kFar};

  bool is_whole() const { return lo == Part{}.lo && hi == Part{}.hi; }
  bool holds(const Vec3& p) const {
    return lo.x <= p.x && p.x < hi.x && lo.y <= p.y && p.y < hi.y && lo.z <= p.z && p.z < hi.z;
  }
  // The box holds all that is no further than `radius` from p.
  bool holds(const Vec3& p, double radius) const {
    const Vec3 r{radius, radius, radius};
    return holds(p - r) && holds(p + r);
  }
};

// A part with a mesh of its own: what stays as it is first, then the part, then what is new.
struct MeshPart {
  Part part;
  SurfaceMesh surface;  // without chain
  // In the whole mesh, of the vertices and facets that are not new.
  std::vector<VertexId> vertices;
  std::vector<FaceId> facets;
};

// The boxes, by number; empty: the mesh is too small to be cut. Each has about `most` facets or
// fewer.
class Cut {
 public:
  // pre: no facet is dead.
  Cut(const SurfaceMesh& whole, std::size_t most);

  std::size_t size() const { return leaves_.size(); }
  // The part in box n.
  MeshPart take(const SurfaceMesh& whole, std::size_t n) const;
  // The box that holds p.
  std::size_t box_at(const Vec3& p) const;
  const Part& box(std::size_t n) const { return leaves_[n].box; }

 private:
  struct Leaf {
    Part box;
    std::vector<FaceId> fixed, facets;  // that reach into it; that lie in it; ascending
  };
  struct Node {
    int axis = -1;             // -1: a leaf
    double plane = 0;          // the upper child begins there
    std::size_t children = 0;  // number of the lower one, the upper one follows; or of the leaf
  };
  void divide(const SurfaceMesh& whole, std::size_t node, Leaf&& leaf, std::size_t most);

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

// Puts a part back where it was taken from; what it has more is appended. Dead facets stay.
void put_back(SurfaceMesh& whole, const MeshPart& part);
// Where its facet f is in the whole mesh, when `appended` facets were there before put_back().
inline FaceId in_whole(const MeshPart& part, FaceId f, std::size_t appended) {
  return f < part.facets.size() ? part.facets[f]
                                : static_cast<FaceId>(appended + f - part.facets.size());
}

}  // namespace deliso
