// SPDX-License-Identifier: MIT
// Fingers: where T leads away from the facets at its site. A thin branch within one Voronoi cell is
// a disk too, so the certificate does not see it.
#pragma once

#include <span>
#include <vector>

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "recover/certificate.h"
#include "recover/labels.h"

namespace deliso {

// One for each thread.
class FingerSearch {
 public:
  // Keeps references. `limit`: how far a vertex of T may be from the facets at its site.
  FingerSearch(const ContourMesh& contour, const Labels& labels, const Triangulation& triangulation,
               double limit)
      : contour_(contour), labels_(labels), triangulation_(triangulation), limit_(limit) {}

  // The vertex of T, of those at `site`, that is furthest from these facets, and further than the
  // limit; kNoId: none is. pre: each facet begins with the site.
  VertexId find(VertexId site, std::span<const DualFacet> facets);

 private:
  // A facet seen from the site; its other corners are b and c. What lies over it has coordinates
  // along b and along c of 0 or more, whose sum is at most 1: nothing, where it has no area.
  struct Frame {
    Vec3 b, c, along_b, along_c, normal;

    bool is_within(const Vec3& d, double distance2) const {
      const double u = dot(d, along_b), v = dot(d, along_c), height = dot(d, normal);
      return u >= 0 && v >= 0 && u + v <= 1 && height * height <= distance2;
    }
  };

  const ContourMesh& contour_;
  const Labels& labels_;
  const Triangulation& triangulation_;
  double limit_;
  std::vector<Frame> frames_;
};

}  // namespace deliso
