// SPDX-License-Identifier: MIT
// The hole that a removed vertex leaves, filled by the triangle of the largest angle at each edge:
// in the plane, the Delaunay triangulation.
#pragma once

#include <array>

#include "surface/facet_test.h"
#include "surface/ring.h"

namespace deliso {

class Hole {
 public:
  struct Facet {
    std::array<int, 3> corner;  // numbers in the ring
    // What is across from each corner: n >= 0: facet n of the filling; otherwise the ring's edge
    // ~n, from neighbor ~n to the next.
    std::array<int, 3> across;
  };

  // Fills the hole. False if a facet turns over, is no better than the limits of `test` and the
  // worst of the star, or has no Sigma near, or if the vertex is further than `test.bound` from the
  // facet over it.
  bool fill(const Ring& ring, const FacetTest& test);

  int size() const { return size_; }  // facets
  const Facet& facet(int n) const { return facets_[n]; }
  // The corners of the facet that was tried last: where the filling failed, it was refused. Two of
  // them are the same where there was none to try.
  const std::array<int, 3>& tried() const { return tried_; }

 private:
  // Fills the part between neighbors i and j. Returns what lies across from the edge that joins
  // them: a facet, or the ring's edge ~i; kFailed.
  static constexpr int kFailed = 127;
  int fill(int i, int j);
  double worst_of_star() const;
  // True if the vertex lies over the facet of neighbors i, k and j, seen along the star's normal.
  bool is_over(int i, int k, int j) const;
  // True if the vertex is within the bound of the facet's plane, along the star's normal.
  bool is_near(const FacetTest::Facet& facet) const;

  const Ring* ring_ = nullptr;
  const FacetTest* test_ = nullptr;
  std::array<Facet, Ring::kMost> facets_;
  std::array<int, 3> tried_{};
  int size_ = 0;
  bool is_covered_ = false;  // a facet is over the vertex
  double worst2_ = -1;       // of the star's (r/l)^2; negative: not known yet
};

// Puts the filling in the place of the star of the ring's vertex, which then has no facet. Facets
// that are too many die. `facet`: one at each vertex.
void replace_star(TriMesh& mesh, IdArray<VertexId, FaceId>& facet, const Ring& ring,
                  const Hole& hole);

}  // namespace deliso
