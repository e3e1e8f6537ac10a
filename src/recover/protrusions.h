// SPDX-License-Identifier: MIT
// Protrusions: vertices of T that the mesh misses. A thin branch within one Voronoi cell is a disk
// too, so the certificate does not see it. Where a facet faces such a vertex, Stage 2 will reach it
// for a tenth of the price; at a tip none does, and Stage 2's insertions are refused there.
#pragma once

#include <span>
#include <vector>

#include "contour/contour.h"
#include "delaunay/triangulation.h"
#include "isosurface/isosurface.h"
#include "recover/certificate.h"
#include "recover/labels.h"
#include "surface/parameters.h"

namespace deliso {

// One for each thread.
class ProtrusionSearch {
 public:
  // Keeps references.
  ProtrusionSearch(const ContourMesh& contour, const Labels& labels,
                   const Triangulation& triangulation, const Isosurface& surface,
                   const Parameters& parameters);

  // The vertex of T, of those at `site`, that is furthest from these facets, of those that are too
  // far; where a facet has no area, that furthest from the site. kNoId: none is. pre: each facet
  // begins with the site.
  VertexId find(SiteId site, std::span<const DualFacet> facets);

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
  // Whether the facet nearest to the vertex v of T, or one that v lies over, is turned as Sigma is
  // there. d: from the site to v, which is nearest2 from the facets.
  bool is_faced(VertexId v, const Vec3& d, double nearest2) const;

  const ContourMesh& contour_;
  const Labels& labels_;
  const Triangulation& triangulation_;
  const Isosurface& surface_;
  double limit2_, near2_;  // how far a vertex may be that is faced, and one that is not
  std::vector<Frame> frames_;
};

}  // namespace deliso
